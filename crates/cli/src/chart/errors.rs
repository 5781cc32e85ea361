//! Draws the error of each method of sampling against the number of launches, so that one sees how fast each converges.

use chart::{
    Axis, BLUE, ChartError, GREEN, GREY, Marker, PURPLE, SIZE, Series, VERMILION, end_labels, lines as draw_lines, svg,
};
use plotters::style::{BLACK, RGBColor};
use sampling::{ErrorLine, Errors};

const COLOURS: [RGBColor; 5] = [VERMILION, BLUE, GREEN, BLACK, PURPLE];

/// Room for the labels beside the lines (pixels), and where they begin (from the left).
const RIGHT: u32 = 420;
const LABELS: i32 = (SIZE.0 - RIGHT + 12).cast_signed();

/// The chart as SVG, of errors above 0. Its title says `of` what they are.
pub(crate) fn errors(Errors { lines, reference_error, .. }: &Errors, of: &str) -> Result<String, ChartError> {
    let [(fewest, most), (smallest, largest)] = spans(lines).ok_or(ChartError("every error is 0".to_owned()))?;
    let x = Axis::logarithmic("launches n", fewest..most);
    let y = Axis::logarithmic("error, root mean square over seeds", smallest..largest);
    let floor = [fewest, most].map(|launches| (launches, *reference_error)).to_vec();
    let floor = Series { width: 2, ..Series::new("error of the reference", GREY, Marker::None, floor) };
    let series = |(lines, colour): (&[ErrorLine], RGBColor)| {
        Series::new(lines[0].method, colour, Marker::Disc, drawn(lines).collect())
    };
    let methods = lines.chunk_by(|a, b| a.method == b.method).zip(COLOURS).map(series);
    let all: Vec<Series> = (*reference_error > smallest).then_some(floor).into_iter().chain(methods).collect();
    svg(SIZE, |root| {
        let labels = draw_lines(root, &format!("Error of P(heads), {of}"), (&x, &y), &all, RIGHT)?;
        end_labels(root, LABELS, labels)
    })
}

/// Launches and errors above 0.
fn drawn(lines: &[ErrorLine]) -> impl Iterator<Item = (f64, f64)> {
    lines.iter().filter(|line| line.rms_error > 0.0).map(|line| (line.launches as f64, line.rms_error))
}

/// The least and the largest of the launches and of the errors that are drawn; `None` if none is.
fn spans(lines: &[ErrorLine]) -> Option<[(f64, f64); 2]> {
    let span = |of: fn((f64, f64)) -> f64| {
        drawn(lines).map(of).fold((f64::INFINITY, 0.0_f64), |(lo, hi), value| (lo.min(value), hi.max(value)))
    };
    drawn(lines).next().map(|_| [span(|(launches, _)| launches), span(|(_, error)| error)])
}
