//! Charts of the records, as SVG.

mod atlas_lines;
mod atlas_matrix;
mod history;
mod ladder;
mod long_flights;
mod order;
mod work_precision;

use chart::{BLUE, ChartError, GREEN, LINE_WIDTH, Marker, Series, VERMILION};
use plotters::style::{BLACK, RGBColor};
use sampling::RunningStep;

use crate::atlas::expected::{Expectation, Expected};
use crate::context::Records;
use crate::record::Record;
use crate::work_precision::Sweep;

/// A chart and the name of its file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chart {
    /// Name of the file, without a folder.
    pub file: String,
    /// The SVG.
    pub svg: String,
    /// What it shows, where that does not follow from its chapter.
    pub caption: Option<String>,
}

/// The errors of committed records over time, as SVG; `records` are not empty.
///
/// # Errors
/// [`ChartError`] if it can't be drawn.
pub fn history(records: &[Record]) -> Result<String, ChartError> {
    history::history(records)
}

/// What the contestants called `names` are known to do where methods fail, as SVG.
///
/// # Errors
/// [`ChartError`] if it can't be drawn.
pub fn known_failures(names: &[String], expected: &Expected) -> Result<String, ChartError> {
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    atlas_matrix::matrix(&names, |subject, hazard| expected.get(subject, hazard))
}

/// Speed against accuracy on the problem `problem` of a record, made on the day `date`, as SVG.
///
/// # Errors
/// [`ChartError`] if the sweep has no such problem, or if it can't be drawn.
pub fn recorded(sweep: &Sweep, problem: &str, date: &str) -> Result<String, ChartError> {
    let launches = sweep.problems.iter().find(|(name, ..)| name == problem).map(|(.., launches)| *launches);
    let launches = launches.ok_or_else(|| ChartError(format!("no problem '{problem}' in the record of {date}")))?;
    work_precision::work_precision(sweep, problem, launches, &format!("{problem}, record of {date}"))
}

/// The charts of the records that there are.
///
/// # Errors
/// [`ChartError`] if one can't be drawn.
pub fn charts(records: &Records<'_>) -> Result<Vec<Chart>, ChartError> {
    let mut charts = Vec::new();
    if let Some(atlas) = records.atlas {
        let worst = |subject: &str, hazard: &str| atlas.worst(hazard, subject).map(Expectation::from);
        charts.push(chart("atlas-matrix.svg", atlas_matrix::matrix(&atlas.subjects(), worst)?));
        charts.push(chart("atlas-error.svg", atlas_lines::errors(atlas)?));
        charts.push(chart("atlas-work.svg", atlas_lines::work(atlas)?));
    }
    if let Some(flights) = records.long_flights {
        charts.push(chart("long-flights.svg", long_flights::long_flights(flights)?));
    }
    if let Some(steps) = records.fig4 {
        let columns: Vec<[f64; 5]> = steps.iter().map(RunningStep::columns).collect();
        charts.push(chart("fig4.svg", chart::running(&columns)?));
    }
    if let Some(all) = records.convergence {
        charts.push(chart("order.svg", order::order(all)?));
    }
    if let Some(thrift) = &records.thrift {
        charts.push(chart("ladder.svg", ladder::ladder(&thrift.t_costs_ns)?));
    }
    if let Some(sweep) = records.sweep {
        for (problem, stresses, launches) in &sweep.problems {
            charts.push(Chart {
                file: format!("work-precision-{problem}.svg"),
                svg: work_precision::work_precision(sweep, problem, *launches, problem)?,
                caption: Some(format!("{problem}: {stresses}")),
            });
        }
    }
    Ok(charts)
}

fn chart(file: &str, svg: String) -> Chart {
    Chart { file: file.to_owned(), svg, caption: None }
}

/// One colour a solver.
fn colour(subject: &str) -> RGBColor {
    match subject.split('/').next() {
        Some("gamma") => VERMILION,
        Some("euler") => BLUE,
        Some("quaternion") => GREEN,
        _ => BLACK,
    }
}

/// The line of a subject: its solver's colour, and a form for its method.
fn line(subject: &str, label: String, points: Vec<(f64, f64)>, failures: Vec<f64>) -> Series {
    let (marker, dashed) = match subject.split('/').nth(1) {
        Some("dopri5") => (Marker::Triangle, false),
        Some("rk4") => (Marker::Ring, true),
        Some("taylor") => (Marker::Square, false),
        _ => (Marker::Disc, false),
    };
    Series { label, colour: colour(subject), width: LINE_WIDTH, dashed, marker, points, failures }
}
