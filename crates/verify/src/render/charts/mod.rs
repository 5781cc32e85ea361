//! Draws the records of a run as charts in SVG, for the report and for `docs/figures`.

mod atlas;
mod errors;
mod palette;
mod work;

use chart::ChartError;
use toss::SolverEntry;

use crate::measure::work_precision::Sweep;
use crate::render::Report;
pub(crate) use atlas::matrix;
pub(crate) use errors::history;
pub(crate) use palette::Palette;
pub(crate) use work::proofs;

/// A chart and the name of its file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chart {
    /// Name of the file, without a folder.
    pub file: String,
    /// The SVG.
    pub svg: String,
    /// What it shows, if its chapter does not say so.
    pub caption: Option<String>,
}

/// Draws speed against accuracy on the problem `problem` of the record of the day `date`, as SVG. Solvers have the colours
/// of `registry`.
///
/// # Errors
/// [`ChartError`] if the sweep has no such problem, or if it can't be drawn.
pub fn recorded(sweep: &Sweep, problem: &str, date: &str, registry: &[SolverEntry]) -> Result<String, ChartError> {
    let launches = sweep.problems.iter().find(|(name, ..)| name == problem).map(|(.., launches)| *launches);
    let launches = launches.ok_or_else(|| ChartError(format!("no problem '{problem}' in the record of {date}")))?;
    let title = format!("{problem}, record of {date}");
    work::work_precision(sweep, (problem, launches), &title, &Palette::new(registry))
}

pub(super) fn charts(report: &Report) -> Result<Vec<Chart>, ChartError> {
    let records = &report.context;
    let palette = Palette::new(&records.registry);
    let mut charts = Vec::new();
    if let Some(all) = records.convergence.found().filter(|all| !all.is_empty()) {
        charts.push(chart("order.svg", errors::order(all, &palette)?));
    }
    if let Some(sweep) = records.sweep.found() {
        for (problem, stresses, launches) in &sweep.problems {
            charts.push(Chart {
                file: format!("work-precision-{problem}.svg"),
                svg: work::work_precision(sweep, (problem, *launches), problem, &palette)?,
                caption: Some(format!("{problem}: {stresses}")),
            });
        }
    }
    Ok(charts)
}

fn chart(file: &str, svg: String) -> Chart {
    Chart { file: file.to_owned(), svg, caption: None }
}
