//! Draws work against the error that it buys: one chart of all problems on a common scale, which shows at a glance who needs
//! least, and one for each problem, with calls of the right-hand side on the left and time on the right.

use chart::{Axis, ChartError, Drawn, EndLabel, Marker, Panel, Series, centred, end_labels, log_log, svg};
use plotters::prelude::*;

use super::palette::Palette;
use crate::measure::work_precision::{Sample, Sweep};

const SIZE: (u32, u32) = (1800, 1000);

/// Height of a title (pixels).
const HEAD: u32 = 60;

/// Room for the labels beside the lines (pixels).
const RIGHT: u32 = 290;

/// Where the crosses of failed runs are (pixels from the top).
const TOP: i32 = 34;

/// Panels in a row of the chart of all problems, and the size of each (pixels).
const COLUMNS: usize = 4;
const PANEL: (u32, u32) = (510, 560);

/// Errors from ten radians down to below the last bit. An error of 0 is drawn at the end.
const ERRORS: std::ops::Range<f64> = 10.0..1e-18;

/// Light grey, drawn wide under the lines.
const FRONT: RGBColor = RGBColor(205, 205, 205);

/// The work of a sample, over all its launches, in the unit of its axis; `None` for none.
type Work = fn(&Sample) -> Option<f64>;

const CALLS: (&str, Work) =
    ("calls of the right-hand side per launch", |sample| Some(sample.n_rhs as f64).filter(|calls| *calls > 0.0));
const TIME: (&str, Work) = ("time per launch [µs]", |sample| Some(sample.t_min_ns as f64 * 1e-3));

/// The chart of all problems as SVG: a panel for each, on one scale, and the legend in the panel after them.
pub(super) fn all_problems(sweep: &Sweep, palette: &Palette<'_>) -> Result<String, ChartError> {
    let rows = (sweep.problems.len() + 1).div_ceil(COLUMNS);
    let width = PANEL.0 * u32::try_from(COLUMNS).unwrap_or(1);
    let height = HEAD + PANEL.1 * u32::try_from(rows).unwrap_or(1);
    let drawings: Vec<Drawing<'_>> = sweep
        .problems
        .iter()
        .map(|(problem, _, launches)| Drawing::new(sweep, (problem, *launches), palette))
        .collect();
    let lines: Vec<Vec<Series>> = drawings.iter().map(|drawing| drawing.lines(TIME.1)).collect();
    let y = Axis::logarithmic(TIME.0, work_range(lines.iter().flatten()));
    svg((width, height), |root| {
        let (head, body) = root.split_vertically(HEAD);
        title(&head, "All problems on one scale: lower is cheaper, further right more accurate")?;
        let panels = body.split_evenly((rows, COLUMNS));
        for ((drawing, lines), panel) in drawings.iter().zip(&lines).zip(&panels) {
            log_log(panel, drawing.problem, (&error_axis(), &y), lines, 20)?;
        }
        match (lines.first(), panels.get(lines.len())) {
            (Some(lines), Some(panel)) => chart::legend(panel, lines, 1, 480),
            _ => Ok(()),
        }
    })
}

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
        title(&head, &format!("{name}; grey: the front, which no integrator beats"))?;
        let (left, right) = body.split_horizontally(SIZE.0 / 2);
        drawing.panel(&left, CALLS)?;
        drawing.panel(&right, TIME)
    })
}

fn title(head: &Panel<'_>, words: &str) -> Drawn {
    centred(head, words, (i32::try_from(head.dim_in_pixel().0 / 2).unwrap_or(0), 38))
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

/// What is drawn of a problem.
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
        let mut lines = vec![self.front(work)];
        lines.extend(self.lines(work));
        let y = Axis::logarithmic(label, work_range(lines.iter()));
        let mut labels = log_log(panel, "", (&error_axis(), &y), &lines, RIGHT)?;
        let (width, height) = panel.dim_in_pixel();
        // A closed form calls no right-hand side, so it is below every axis.
        let bottom = i32::try_from(height).unwrap_or(0) - 110;
        let is_below = |line: &&Series| line.points.is_empty() && line.failures.is_empty();
        let below =
            |line: &Series| EndLabel { y: bottom, text: format!("{}: 0 calls", line.label), colour: line.colour };
        labels.extend(lines[1..].iter().filter(is_below).map(below));
        // A solver that fails at every setting has no line that could carry its name.
        let fails = |line: &&Series| line.points.is_empty() && !line.failures.is_empty();
        let above = |line: &Series| EndLabel { y: TOP, text: format!("{}: fails", line.label), colour: line.colour };
        labels.extend(lines[1..].iter().filter(fails).map(above));
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
        self.palette.line(subject, subject.to_owned(), points, failures)
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
        let label = String::new();
        let failures = Vec::new();
        Series { label, colour: FRONT, width: 16, dashed: false, marker: Marker::None, points, failures }
    }
}

#[cfg(test)]
mod tests;
