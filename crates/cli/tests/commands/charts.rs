//! Draws the charts of the commands and looks in the SVG for what they have to show. A chart must also be written whole, and
//! flights that no scale can show must be refused.

use crate::common::{assert_near, assert_refused, json, run, stderr};

/// The chart that a command draws.
#[track_caller]
fn svg(arguments: &str) -> String {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let path = folder.path().join("chart.svg");
    let output = run(&format!("{arguments} --svg {}", path.display()));
    assert_eq!(output.status.code(), Some(0), "{arguments}: {}", stderr(&output));
    std::fs::read_to_string(&path).expect("the chart is written")
}

/// The points of every line of a chart that has this colour.
fn lines_of_colour(svg: &str, colour: &str) -> Vec<Vec<(i32, i32)>> {
    let number = |text: &str| text.parse::<i32>().expect("a whole pixel");
    let point = |pair: &str| pair.split_once(',').map(|(x, y)| (number(x), number(y)));
    let points = |line: &str| line.split_once("points=\"")?.1.split('"').next().map(str::to_owned);
    let coloured = svg.lines().filter(|line| line.starts_with("<polyline") && line.contains(colour));
    coloured.filter_map(points).map(|points| points.split_whitespace().filter_map(point).collect()).collect()
}

/// The texts of a chart and where they are anchored.
fn texts(svg: &str) -> Vec<(i32, i32, String)> {
    let lines: Vec<&str> = svg.lines().collect();
    let attribute = |line: &str, name: &str| line.split_once(&format!(" {name}=\""))?.1.split('"').next()?.parse().ok();
    let text = |pair: &[&str]| {
        let tag = pair[0].strip_prefix("<text").is_some();
        tag.then(|| Some((attribute(pair[0], "x")?, attribute(pair[0], "y")?, pair[1].to_owned()))).flatten()
    };
    lines.windows(2).filter_map(text).collect()
}

/// The two flights are those of the paper's Figs. 2 and 3.
#[test]
fn the_chart_of_a_flight_shows_how_it_lands() {
    const SIDES: [&str; 2] = ["fill=\"#FFFFFF\"", "fill=\"#464646\""];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flight.svg");
    for (rate, outcome, cos_tilt, side) in
        [("1,1,2.5", "heads", 0.665_661_286_6, 0), ("2,2,0.5", "tails", -0.156_081_419_0, 1)]
    {
        assert_near(&json(&format!("toss --rate {rate} --speed 3"), 0)["cos_tilt"], cos_tilt, 1e-9);
        let output = run(&format!("trace --rate {rate} --speed 3 --points 121 --svg {}", path.display()));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let svg = std::fs::read_to_string(&path).unwrap();
        let title = format!(
            "Coin &apos;paper&apos; (k = 0.5), launched horizontally, ω = ({}) rad/s: the coin lands {outcome}",
            rate.replace(',', ", ")
        );
        assert!(svg.contains(&title), "{rate}");
        let sides: Vec<&str> = svg
            .lines()
            .filter_map(|line| SIDES.into_iter().find(|side| line.starts_with("<polygon") && line.contains(side)))
            .collect();
        // The last two polygons belong to the legend.
        assert_eq!((sides.len(), sides[0], sides[10]), (13, SIDES[0], SIDES[side]), "{rate}");
    }
}

#[test]
fn flights_beyond_all_scales_are_drawn_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flight.svg");
    for flight in ["--rate 0,0,0 --time 1e-300", "--rate 0,0,0 --time 0", "--rate 1,2,3 --speed 3 --drop 50"] {
        let output = run(&format!("trace {flight} --points 3 --svg {}", path.display()));
        assert_eq!(output.status.code(), Some(0), "{flight}: {}", stderr(&output));
    }
    let too_high = format!("trace --rate 0,0,0 --time 1e300 --points 3 --svg {}", path.display());
    assert_refused(&[(&too_high, ["chart", "so high"])]);
}

/// The colour of n and of cos θ.
const NORMAL: &str = "#0072B2";

#[test]
fn every_turn_is_drawn_whatever_number_of_points_is_printed() {
    // ωL = 10 rad/s for 15 turns, over which cos θ changes its sign 30 times.
    let flight = "trace --rate 6,8,0 --time 9.42477796076938";
    let drawn = svg(&format!("{flight} --points 20"));
    assert_eq!(drawn, svg(&format!("{flight} --points 1000")));
    let lines = lines_of_colour(&drawn, NORMAL);
    let curve = lines.iter().find(|line| line.len() > 2).unwrap();
    assert!(curve.len() > 60 * 15, "{} points", curve.len());
    let (highest, lowest) = (curve.iter().map(|at| at.1).min().unwrap(), curve.iter().map(|at| at.1).max().unwrap());
    let signs: Vec<bool> = curve.iter().map(|at| at.1 < (highest + lowest) / 2).collect();
    assert_eq!(signs.windows(2).filter(|pair| pair[0] != pair[1]).count(), 30);
}

/// At 100 000 turns in a second, equal times would meet few of its phases; n is at ψ = 80° from S, which leans by 80°.
#[test]
fn a_flight_of_many_turns_is_drawn_as_the_band_that_it_fills() {
    for (flight, [low, high]) in [
        ("--turn 100000rev/s --psi 80deg --time 1", [-0.94, 1.0]),
        ("--turn 1000rev/s --psi 30deg --time 1", [0.5, 1.0]),
        ("--turn 61rev/s --psi 90deg --time 1", [-1.0, 1.0]),
        ("--coin racket --rate 300,900,40 --time 1", [-1.0, 1.0]),
    ] {
        let drawn = svg(&format!("trace {flight} --points 2"));
        assert!(drawn.len() < 2_000_000, "{flight}: {} bytes", drawn.len());
        assert!(drawn.contains("fills the band"), "{flight}");
        let longest = lines_of_colour(&drawn, NORMAL).iter().map(Vec::len).max().unwrap();
        assert!(longest < 5, "{flight}: a line of {longest} points");
        let band = drawn.lines().find(|line| line.starts_with("<polygon") && line.contains(NORMAL)).unwrap();
        let points = band.split_once("points=\"").unwrap().1.split('"').next().unwrap();
        let heights: Vec<f64> =
            points.split_whitespace().map(|point| point.split_once(',').unwrap().1.parse().unwrap()).collect();
        // The axis goes from 1.1 to -1.1; its marks tell the scale.
        let marks = texts(&drawn);
        let at =
            |label: &str| f64::from(marks.iter().filter(|(.., text)| text == label).map(|mark| mark.1).max().unwrap());
        let (unit, zero) = (2.0 * (at("-1.0") - at("-0.5")), 2.0 * at("-0.5") - at("-1.0"));
        let ends = [heights.iter().copied().fold(0.0, f64::max), heights.iter().copied().fold(f64::MAX, f64::min)];
        let [lowest, highest] = ends.map(|height| (zero - height) / unit);
        assert!((lowest - low).abs() < 0.03 && (highest - high).abs() < 0.03, "{flight}: {lowest} to {highest}");
    }
}

#[test]
fn words_and_legend_stand_beside_the_flight() {
    let svg = svg("trace --rate 2,30,9 --tilt 1.2 --coin us-quarter --speed 3 --points 2");
    let texts = texts(&svg);
    let curve = lines_of_colour(&svg, NORMAL).into_iter().find(|line| line.len() > 2).unwrap();
    let rightmost = curve.iter().map(|at| at.0).max().unwrap();
    for words in ["heads", "tails", "heads side", "tails side", "coins enlarged"] {
        let (x, ..) = texts.iter().find(|(.., text)| text == words).unwrap();
        assert!(*x > rightmost + 30, "{words} at {x}, the flight ends at {rightmost}");
    }
    assert!(
        svg.contains("Coin &apos;us-quarter&apos; (k = 1.9862), launched at a tilt of 1.2 rad, ω = (2, 30, 9) rad/s")
    );
}

#[test]
fn titles_have_the_units_that_were_typed_the_solver_and_the_space() {
    for (command, words) in [
        ("trace --rate 38rev/s,1rpm,5rev/s --speed 3", "launched horizontally, ω = (38 rev/s, 1 rpm, 5 rev/s)"),
        ("trace --rate 38rev/s,0rev/s,5rev/s --speed 3", "ω = (38, 0, 5) rev/s: the coin lands "),
        (
            "trace --turn 38rev/s --psi 60deg --tilt 15deg --speed 3",
            "at a tilt of 15 deg, n turns at 38 rev/s, ψ = 60 deg",
        ),
        ("trace --rate 1,2,3 --speed 3 --solver quaternion --scheme taylor", "solver quaternion, taylor"),
        ("map --space paper-fig4 --up speed --method random --points 1", "P(heads), space paper-fig4"),
        (
            "map --coin us-dime --rate-x 0:9:3 --rate-y 0 --rate-z 0rpm:9rpm:3 --speed 3:5",
            "ωx 0:9:3, ωy 0, ωz 0rpm:9rpm:3, v0 3:5",
        ),
        ("convergence --space tails --steps 3", "P(heads) of the first n launches, space tails"),
        (
            "convergence --rate-x 0:40:3 --rate-y 5 --rate-z 20 --speed 3:5:3 --drop 1 --steps 2",
            "ωx 0:40:3, ωy 5, ωz 20, v0 3:5:3, drop 1",
        ),
        ("convergence --space tails --coin us-dime --drop 1 --steps 3", "space tails, Coin &apos;us-dime&apos; (k = "),
        ("errors --space cheated --up-to 9 --replicates 1 --spread 7%", "Error of P(heads), space cheated, spread 7 %"),
        ("limit --coin us-dime --points 3", "long flights from horizontal, Coin &apos;us-dime&apos;"),
        (
            "map --rate-x 0:40:3 --rate-y 5 --rate-z 10:20:3 --speed 3:5 --method random --points 64 --solver quaternion --scheme rk4 --step 0.1",
            "white: no launch is decided",
        ),
        ("trace --rate 1,2,3 --speed 3 --drop 50cm --points 2", "ω = (1, 2, 3) rad/s, drop 50 cm: the coin"),
    ] {
        let drawn = svg(command);
        assert!(drawn.contains(words), "{command}: {:?}", texts(&drawn));
    }
}

#[test]
fn charts_are_written_whole_and_no_number_stands_twice_on_an_axis() {
    let folder = tempfile::tempdir().unwrap();
    for (command, word) in [
        ("trace --rate 9,4,30 --speed 4 --points 200", "time [s]"),
        ("convergence --space paper-fig4 --steps 20", "B, random: 0.6616"),
        ("convergence --space cheated --steps 20", "n launches, space cheated"),
        ("errors --space paper-fig4 --up-to 14 --replicates 2", "exact-speed, 8 scrambles"),
        ("limit --points 50", "share of 50 flights"),
        ("map --rate-x 0:40:5 --rate-y 0 --rate-z -60:60:5 --speed 3:5", "becomes certain, ψ = 45° and 135°"),
        ("map --rate-x -0.3:0.3:5 --rate-y 0 --rate-z -60:60:5 --speed 3:5", "P(heads)"),
    ] {
        let path = folder.path().join("chart.svg");
        let output = run(&format!("{command} --svg {}", path.display()));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        assert!(output.stderr.is_empty(), "a progress bar without a terminal: {}", stderr(&output));
        let svg = std::fs::read_to_string(&path).unwrap();
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>") && svg.contains(word), "{command}");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
        // Each of the pictures of a flight has axes of its own.
        if !command.starts_with("trace") {
            assert_numbers_stand_once(command, &svg);
        }
    }
}

/// No number stands twice on an axis, and zero has no sign.
#[track_caller]
fn assert_numbers_stand_once(command: &str, svg: &str) {
    let numbers = texts(svg).into_iter().filter(|(.., text)| text.parse::<f64>().is_ok());
    let numbers: Vec<(i32, i32, String)> = numbers.collect();
    assert!(numbers.len() >= 6, "{command}: {numbers:?}");
    for (index, (x, y, text)) in numbers.iter().enumerate() {
        assert!(!(text.starts_with('-') && text.parse() == Ok(0.0)), "{command}: {text}");
        let is_twin = |other: &(i32, i32, String)| other.2 == *text && (other.0 == *x || other.1 == *y);
        assert!(!numbers[index + 1..].iter().any(is_twin), "{command}: {text} stands twice");
    }
}
