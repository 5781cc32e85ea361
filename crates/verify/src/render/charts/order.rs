//! Draws the error against the step, with the order that each line shows beside that which theory gives.

use chart::{Axis, ChartError, EndLabel, Series, end_labels, log_log, svg};

use super::palette::Palette;
use crate::measure::convergence::Convergence;

/// Where the labels begin (pixels from the top).
const TOP: i32 = 80;

/// Room for labels beside the lines (pixels).
const RIGHT: u32 = 420;

/// The chart as SVG.
pub(super) fn order(all: &[Convergence], palette: &Palette<'_>) -> Result<String, ChartError> {
    let of_subject = |found: &Convergence| {
        let observed = found.observed.map_or_else(|| "none".to_owned(), |order| format!("{order:.2}"));
        let label = format!("{}: {observed} of {}", found.subject, found.order);
        palette.line(&found.subject, label, found.points.clone(), Vec::new())
    };
    let lines: Vec<Series> = all.iter().map(of_subject).collect();
    let (x, y) = (Axis::logarithmic("step [s]", 1.0..1e-4), Axis::logarithmic("error of the state", 1e-12..10.0));
    svg((2000, 1000), |root| {
        let labels =
            log_log(root, "Fixed steps: error, and the order observed of that expected", (&x, &y), &lines, RIGHT)?;
        // The lines end next to each other at the lower edge, so their names stand in a column from the top.
        let from_the_top = labels.into_iter().map(|label| EndLabel { y: TOP, ..label }).collect();
        end_labels(root, 2000 - i32::try_from(RIGHT).unwrap_or(0) + 20, from_the_top)
    })
}
