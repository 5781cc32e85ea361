//! Draws work against the error of Taylor series, beside work against the bound that they prove for it. A grey line joins
//! the two of each tolerance: its length is what the proof costs in digits.

use chart::{Axis, BLUE, ChartError, Drawn, LINE_WIDTH, Marker, Panel, Series, VERMILION, end_labels, log_log, svg};
use plotters::style::RGBColor;

use crate::measure::work_precision::proofs::Proof;

const SIZE: (u32, u32) = (1800, 900);

/// Room for the labels beside the lines (pixels).
const RIGHT: u32 = 230;

/// Between error and bound.
const GAP: RGBColor = RGBColor(205, 205, 205);

/// The chart as SVG: a panel for each problem, with its title.
pub(super) fn proofs(panels: &[(&str, Vec<Proof>)]) -> Result<String, ChartError> {
    let columns = panels.len().max(1);
    svg(SIZE, |root| {
        let areas = root.split_evenly((1, columns));
        areas.iter().zip(panels).try_for_each(|(area, (title, proofs))| panel(area, title, proofs))
    })
}

fn panel(panel: &Panel<'_>, title: &str, proofs: &[Proof]) -> Drawn {
    let (least, most) = proofs
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(least, most), proof| (least.min(proof.calls), most.max(proof.calls)));
    let x = Axis::logarithmic("attitude's error and bound [rad]", 10.0..1e-17);
    let y = Axis::logarithmic("calls of the right-hand side per launch", 0.8 * least..1.25 * most);
    let line = |label: &str, colour, (width, marker), points| {
        let (label, failures) = (label.to_owned(), Vec::new());
        Series { label, colour, width, dashed: false, marker, points, failures }
    };
    let gap =
        |proof: &Proof| line("", GAP, (2, Marker::None), vec![(proof.bound, proof.calls), (proof.error, proof.calls)]);
    let of = |value: fn(&Proof) -> f64| proofs.iter().map(|proof| (value(proof), proof.calls)).collect::<Vec<_>>();
    let mut lines: Vec<Series> = proofs.iter().map(gap).collect();
    lines.push(line("proven bound", VERMILION, (LINE_WIDTH, Marker::Disc), of(|proof| proof.bound)));
    lines.push(line("error", BLUE, (LINE_WIDTH, Marker::Square), of(|proof| proof.error)));
    let mut labels = log_log(panel, title, (&x, &y), &lines, RIGHT)?;
    labels.retain(|label| !label.text.is_empty());
    end_labels(panel, i32::try_from(panel.dim_in_pixel().0 - RIGHT).unwrap_or(0) + 16, labels)
}
