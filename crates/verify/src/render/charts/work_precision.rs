//! Work against the error that it buys, one chart per problem: calls on the left, time on the right.

use chart::{Axis, ChartError, EndLabel, GREY, Marker, Panel, Series, TEXT, end_labels, log_log, svg};
use plotters::prelude::*;

use super::palette::Palette;
use crate::measure::work_precision::{Sample, Sweep};

const SIZE: (u32, u32) = (1800, 940);

/// Room for labels beside the lines (pixels).
const RIGHT: u32 = 290;

/// Errors from a radian down to the last bit.
const ERRORS: std::ops::Range<f64> = 10.0..1e-16;

/// Light grey, drawn wide under the lines.
const FRONT: RGBColor = RGBColor(205, 205, 205);

/// What work is, in the unit of its axis; `None` for none.
type Work = fn(&Sample) -> Option<f64>;

/// The chart of `problem`, of so many launches, as SVG.
pub(super) fn work_precision(
    sweep: &Sweep,
    (problem, launches): (&str, usize),
    title: &str,
    palette: &Palette<'_>,
) -> Result<String, ChartError> {
    let drawn = Drawing { sweep, problem, palette };
    let per_launch = if launches > 1 { format!(" (all {launches} launches)") } else { String::new() };
    let calls: Work = |sample| Some(sample.n_rhs as f64).filter(|calls| *calls > 0.0);
    let time: Work = |sample| Some(sample.t_min_ns as f64 * 1e-3);
    svg(SIZE, |root| {
        let (left, right) = root.split_horizontally(SIZE.0 / 2);
        drawn.panel(&left, title, &format!("calls of the right-hand side{per_launch}"), calls)?;
        drawn.panel(&right, title, &format!("time [µs]{per_launch}"), time)
    })
}

/// What is drawn.
struct Drawing<'a> {
    sweep: &'a Sweep,
    problem: &'a str,
    palette: &'a Palette<'a>,
}

impl Drawing<'_> {
    fn panel(&self, panel: &Panel<'_>, title: &str, label: &str, work: Work) -> chart::Drawn {
        let mut lines = vec![self.front(work)];
        lines.extend(self.sweep.subjects().iter().map(|subject| self.line(subject, work)));
        let values: Vec<f64> = lines.iter().flat_map(|line| line.points.iter().map(|point| point.1)).collect();
        let (least, most) =
            values.iter().fold((f64::INFINITY, 1.0_f64), |(lo, hi), value| (lo.min(*value), hi.max(*value)));
        let x = Axis::positive("error of the attitude [rad]", ERRORS);
        let y = Axis::positive(label, 0.5 * least.min(most)..2.0 * most);
        let mut labels = log_log(panel, title, (&x, &y), &lines, RIGHT)?;
        let (width, height) = panel.dim_in_pixel();
        // A closed form calls no right-hand side: it is below every axis.
        let bottom = i32::try_from(height).unwrap_or(0) - 110;
        let is_below = |line: &&Series| line.points.is_empty() && line.failures.is_empty();
        let below =
            |line: &Series| EndLabel { y: bottom, text: format!("{}: 0 calls", line.label), colour: line.colour };
        labels.extend(lines[1..].iter().filter(is_below).map(below));
        end_labels(panel, i32::try_from(width - RIGHT).unwrap_or(0) + 16, labels)?;
        panel.draw(&Text::new("grey: the front of the integrators", (160, 66), TEXT.into_font().color(&GREY)))?;
        Ok(())
    }

    fn line(&self, subject: &str, work: Work) -> Series {
        let samples: Vec<&Sample> = self.sweep.series(self.problem, subject).collect();
        let points = samples.iter().filter_map(|sample| Some((sample.err_attitude_rad?, work(sample)?))).collect();
        // A failed run has no error: it is drawn over the finest one.
        let failures = samples.iter().filter(|sample| sample.failure.is_some()).map(|_| ERRORS.end).collect();
        self.palette.line(subject, subject.to_owned(), points, failures)
    }

    /// The integrators' runs that none beats in both error and work, by falling error.
    fn front(&self, work: Work) -> Series {
        let runs = self.sweep.samples.iter();
        let mut runs: Vec<(f64, f64)> = runs
            .filter(|sample| sample.problem == self.problem && sample.scheme.is_some())
            .filter_map(|sample| Some((sample.err_attitude_rad?, work(sample)?)))
            .collect();
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
