//! Draws charts of flights by `trace --svg` and looks for what they have to show. A chart must also be written whole,
//! and flights that no scale can show must be refused.

mod charts;
mod common;

use charts::{lines_of_colour, svg, texts};
use common::{assert_near, assert_refused, json, run, stderr};

#[test]
fn a_chart_is_written_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flight.svg");
    let output = run(&format!("trace --rate 9,4,30 --speed 4 --points 200 --svg {}", path.display()));
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    let svg = std::fs::read_to_string(&path).unwrap();
    assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
    assert!(svg.contains("cos θ") && svg.contains("time [s]"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "no temporary file stays behind");
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
            "Coin &apos;paper&apos; (k = 0.5), launched horizontal, ω = ({}) rad/s: the coin lands {outcome}",
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
