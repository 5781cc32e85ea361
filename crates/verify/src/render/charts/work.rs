//! Draws work against the error that it buys: a chart for each problem, with calls of the right-hand side on the left and
//! time on the right. A chart of Taylor series has the bounds that they prove beside their errors: a grey line joins the two
//! of each tolerance, and its length is what the proof costs in digits.

use chart::{
    Axis, BLUE, ChartError, Drawn, EndLabel, Marker, Panel, Series, VERMILION, centred, end_labels, lines, svg,
};
use plotters::style::RGBColor;

use super::palette::Palette;
use crate::measure::work_precision::proofs::Proof;
use crate::measure::work_precision::{Sample, Sweep};

const SIZE: (u32, u32) = (1800, 1000);

/// Height of a title (pixels).
const HEAD: u32 = 60;

/// Room for the labels beside the lines (pixels).
const RIGHT: u32 = 290;

/// Where the crosses of failed runs are (pixels from the top).
const TOP: i32 = 34;

/// Errors from ten radians down to below the last bit. An error of 0 is drawn at the end.
const ERRORS: std::ops::Range<f64> = 10.0..1e-18;

/// Of the front, drawn wide under the lines, and between error and bound.
const LIGHT: RGBColor = RGBColor(205, 205, 205);

/// The work of a sample, over all its launches, in the unit of its axis; `None` for none.
type Work = fn(&Sample) -> Option<f64>;

const CALLS: (&str, Work) =
    ("calls of the right-hand side per launch", |sample| Some(sample.n_rhs as f64).filter(|calls| *calls > 0.0));
const TIME: (&str, Work) = ("time per launch [µs]", |sample| Some(sample.t_min_ns as f64 * 1e-3));

/// The chart of `problem`, of so many launches, as SVG.
pub(super) fn work_precision(
    sweep: &Sweep,
    problem: (&str, usize),
    name: &str,
    palette: &Palette<'_>,
) -> Result<String, ChartError> {
    let drawing = Drawing::new(sweep, problem, palette);
    svg(SIZE, |root| {
        let (head, body) = root.split_vertically(HEAD);
        centred(&head, &format!("{name}; grey: the front, which no integrator beats"), (SIZE.0.cast_signed() / 2, 38))?;
        let (left, right) = body.split_horizontally(SIZE.0 / 2);
        drawing.panel(&left, CALLS)?;
        drawing.panel(&right, TIME)
    })
}

fn error_axis() -> Axis {
    Axis::logarithmic("error of the attitude [rad]", ERRORS)
}

/// From below the least to above the most work of `lines`.
fn work_range<'a>(lines: impl Iterator<Item = &'a Series>) -> std::ops::Range<f64> {
    let values = lines.flat_map(|line| line.points.iter().map(|point| point.1));
    let (least, most) = values.fold((f64::INFINITY, 0.0_f64), |(lo, hi), value| (lo.min(value), hi.max(value)));
    if least <= most { 0.7 * least..1.5 * most } else { 1.0..10.0 }
}

struct Drawing<'a> {
    sweep: &'a Sweep,
    problem: &'a str,
    launches: f64,
    palette: &'a Palette<'a>,
}

impl<'a> Drawing<'a> {
    fn new(sweep: &'a Sweep, (problem, launches): (&'a str, usize), palette: &'a Palette<'a>) -> Self {
        Self { sweep, problem, launches: launches.max(1) as f64, palette }
    }

    /// Draws the lines with their names beside them.
    fn panel(&self, panel: &Panel<'_>, (label, work): (&str, Work)) -> Drawn {
        let mut drawn = vec![self.front(work)];
        drawn.extend(self.lines(work));
        let y = Axis::logarithmic(label, work_range(drawn.iter()));
        let mut labels = lines(panel, "", (&error_axis(), &y), &drawn, RIGHT)?;
        let (width, height) = panel.dim_in_pixel();
        // A closed form calls no right-hand side, so it is below every axis.
        let bottom = i32::try_from(height).unwrap_or(0) - 110;
        let is_below = |line: &&Series| line.points.is_empty() && line.failures.is_empty();
        let below =
            |line: &Series| EndLabel { y: bottom, text: format!("{}: 0 calls", line.label), colour: line.colour };
        labels.extend(drawn[1..].iter().filter(is_below).map(below));
        // A solver that fails at every setting has no line that could carry its name.
        let fails = |line: &&Series| line.points.is_empty() && !line.failures.is_empty();
        let above = |line: &Series| EndLabel { y: TOP, text: format!("{}: fails", line.label), colour: line.colour };
        labels.extend(drawn[1..].iter().filter(fails).map(above));
        end_labels(panel, i32::try_from(width - RIGHT).unwrap_or(0) + 16, labels)
    }

    /// The lines of the subjects that were flown: a solver that refuses the problem, or has no such scheme, is none.
    fn lines(&self, work: Work) -> Vec<Series> {
        let subjects = self.sweep.subjects();
        let flown = subjects.iter().filter(|subject| self.sweep.series(self.problem, subject).next().is_some());
        flown.map(|subject| self.line(subject, work)).collect()
    }

    fn line(&self, subject: &str, work: Work) -> Series {
        let samples: Vec<&Sample> = self.sweep.series(self.problem, subject).collect();
        let points = samples.iter().filter_map(|sample| self.point(sample, work)).collect();
        // A failed run has no error, so it is drawn over the finest one.
        let failures = samples.iter().filter(|sample| sample.failure.is_some()).map(|_| ERRORS.end).collect();
        self.palette.line(subject, subject, points, failures)
    }

    /// The error and the work per launch of a sample.
    fn point(&self, sample: &Sample, work: Work) -> Option<(f64, f64)> {
        Some((sample.err_attitude_rad?, work(sample)? / self.launches))
    }

    /// The integrators' runs that none beats in both error and work, by falling error.
    fn front(&self, work: Work) -> Series {
        let runs = self.sweep.samples.iter();
        let runs = runs.filter(|sample| sample.problem == self.problem && sample.scheme.is_some());
        let mut runs: Vec<(f64, f64)> = runs.filter_map(|sample| self.point(sample, work)).collect();
        runs.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut points: Vec<(f64, f64)> = Vec::new();
        for run in runs {
            if points.last().is_none_or(|best| run.0 < best.0) {
                points.push(run);
            }
        }
        Series { width: 16, ..Series::new("", LIGHT, Marker::None, points) }
    }
}

const PROOFS_SIZE: (u32, u32) = (1800, 900);

/// Room for the labels beside the lines (pixels).
const PROOFS_RIGHT: u32 = 230;

/// The chart as SVG: a panel for each problem, with its title.
pub(crate) fn proofs(panels: &[(&str, Vec<Proof>)]) -> Result<String, ChartError> {
    let columns = panels.len().max(1);
    svg(PROOFS_SIZE, |root| {
        let areas = root.split_evenly((1, columns));
        areas.iter().zip(panels).try_for_each(|(area, (title, proofs))| panel_of_proofs(area, title, proofs))
    })
}

fn panel_of_proofs(panel: &Panel<'_>, title: &str, proofs: &[Proof]) -> Drawn {
    let (least, most) = proofs
        .iter()
        .fold((f64::INFINITY, 0.0_f64), |(least, most), proof| (least.min(proof.calls), most.max(proof.calls)));
    let x = Axis::logarithmic("attitude's error and bound [rad]", 10.0..1e-17);
    let y = Axis::logarithmic("calls of the right-hand side per launch", 0.8 * least..1.25 * most);
    let gap = |proof: &Proof| {
        let ends = vec![(proof.bound, proof.calls), (proof.error, proof.calls)];
        Series { width: 2, ..Series::new("", LIGHT, Marker::None, ends) }
    };
    let of = |value: fn(&Proof) -> f64| proofs.iter().map(|proof| (value(proof), proof.calls)).collect::<Vec<_>>();
    let mut drawn: Vec<Series> = proofs.iter().map(gap).collect();
    drawn.push(Series::new("proven bound", VERMILION, Marker::Disc, of(|proof| proof.bound)));
    drawn.push(Series::new("error", BLUE, Marker::Square, of(|proof| proof.error)));
    let labels = lines(panel, title, (&x, &y), &drawn, PROOFS_RIGHT)?;
    end_labels(panel, i32::try_from(panel.dim_in_pixel().0 - PROOFS_RIGHT).unwrap_or(0) + 16, labels)
}

#[cfg(test)]
mod tests;
