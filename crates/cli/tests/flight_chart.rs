//! Draws charts of flights by `trace --svg` and looks for what they have to show. A chart must also be written whole,
//! and flights that no scale can show must be refused.

mod common;

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
        assert!(svg.contains(&format!("the coin lands {outcome}")), "{rate}");
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
