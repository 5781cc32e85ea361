//! What the tests of charts share: they draw a chart by the command line and read the SVG.

use super::common::{run, stderr};

/// The chart that a command draws.
#[track_caller]
pub(crate) fn svg(arguments: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let path = folder.path().join("chart.svg");
    let output = run(&format!("{arguments} --svg {}", path.display()));
    assert_eq!(output.status.code(), Some(0), "{arguments}: {}", stderr(&output));
    std::fs::read_to_string(&path).expect("the chart is written")
}

/// The points of every line of a chart that has this colour.
pub(crate) fn lines_of_colour(svg: &str, colour: &str) -> Vec<Vec<(i32, i32)>> {
    let number = |text: &str| text.parse::<i32>().expect("a whole pixel");
    let point = |pair: &str| pair.split_once(',').map(|(x, y)| (number(x), number(y)));
    let points = |line: &str| line.split_once("points=\"")?.1.split('"').next().map(str::to_owned);
    let coloured = svg.lines().filter(|line| line.starts_with("<polyline") && line.contains(colour));
    coloured.filter_map(points).map(|points| points.split_whitespace().filter_map(point).collect()).collect()
}

/// The texts of a chart and where they are anchored.
pub(crate) fn texts(svg: &str) -> Vec<(i32, i32, String)> {
    let lines: Vec<&str> = svg.lines().collect();
    let attribute = |line: &str, name: &str| line.split_once(&format!(" {name}=\""))?.1.split('"').next()?.parse().ok();
    let text = |pair: &[&str]| {
        let tag = pair[0].strip_prefix("<text").is_some();
        tag.then(|| Some((attribute(pair[0], "x")?, attribute(pair[0], "y")?, pair[1].to_owned()))).flatten()
    };
    lines.windows(2).filter_map(text).collect()
}
