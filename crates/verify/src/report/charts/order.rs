//! Error against step, with the orders that the lines show.

use chart::{Axis, BLUE, ChartError, EndLabel, GREEN, LINE_WIDTH, Marker, Series, VERMILION, end_labels, log_log, svg};

use crate::convergence::Convergence;

/// Where labels begin (pixels).
const TOP: i32 = 80;

/// Room for labels beside the lines (pixels).
const RIGHT: u32 = 420;

/// The chart as SVG.
pub(super) fn order(all: &[Convergence]) -> Result<String, ChartError> {
    let line = |found: &Convergence| {
        let (solver, method) = found.subject.split_once('/').unwrap_or((&found.subject, ""));
        let colour = match solver {
            "gamma" => VERMILION,
            "euler" => BLUE,
            _ => GREEN,
        };
        let (marker, dashed) = match method {
            "dopri5" => (Marker::Triangle, false),
            "rk4" => (Marker::Ring, true),
            _ => (Marker::Disc, false),
        };
        let observed = found.observed.map_or_else(|| "none".to_owned(), |order| format!("{order:.2}"));
        let label = format!("{}: {observed} of {}", found.subject, found.order);
        let points = found.points.clone();
        Series { label, colour, width: LINE_WIDTH, dashed, marker, points, failures: Vec::new() }
    };
    let lines: Vec<Series> = all.iter().map(line).collect();
    let (x, y) = (Axis::positive("step [s]", 1.0..1e-4), Axis::positive("error of the state", 1e-12..10.0));
    svg((2000, 1000), |root| {
        let labels = log_log(root, "fixed steps: error, and observed order of theory's", (&x, &y), &lines, RIGHT)?;
        // The lines end next to each other at the lower edge: their names stand in a column from the top.
        let from_the_top = labels.into_iter().map(|label| EndLabel { y: TOP, ..label }).collect();
        end_labels(root, 2000 - i32::try_from(RIGHT).unwrap_or(0) + 20, from_the_top)
    })
}
