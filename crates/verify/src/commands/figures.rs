//! The commands that draw. `figure` draws figures that repeat exactly: from what is committed, or of flights whose errors
//! and calls are the same in every run. `history` draws the accuracy of the committed records over time, which shows slow
//! changes that no single comparison with the baseline does.

use std::path::{Path, PathBuf};

use anyhow::{Context, ensure};
use clap::{Args, ValueEnum};

use crate::files;
use crate::judge::record;
use crate::measure::atlas;
use crate::measure::atlas::expected::Expected;
use crate::measure::work_precision::problems::{self, Problem};
use crate::measure::work_precision::{Sweep, proofs};
use crate::render::charts::{self, Palette};
use crate::render::text;
use crate::shown::shown;
use crate::suite::Suite;

/// Draw a figure that repeats exactly
#[derive(Debug, Args)]
pub(super) struct Figure {
    /// Which figure
    #[arg(value_enum)]
    name: Name,
    /// Into this file
    #[arg(long, value_name = "FILE")]
    svg: PathBuf,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Name {
    /// How contestants are known to answer where methods fail
    AtlasMatrix,
    /// Speed against accuracy, of the newest record
    WorkPrecision,
    /// The errors of Taylor series beside the bounds that they prove, of flights that repeat exactly
    ProvenError,
}

impl Figure {
    pub(super) fn run(&self, suite: &Suite) -> anyhow::Result<u8> {
        let svg = match self.name {
            Name::AtlasMatrix => atlas_matrix(suite)?,
            Name::WorkPrecision => work_precision(suite)?,
            Name::ProvenError => proven_error()?,
        };
        files::write(&self.svg, &svg)?;
        Ok(0)
    }
}

fn atlas_matrix(suite: &Suite) -> anyhow::Result<String> {
    let contestants = atlas::contestants_at(suite.registry().entries(), None)?;
    let expected = Expected::of_this_workspace()?;
    // A contestant that the table does not list is left out.
    let known = contestants.iter().map(|contestant| &*contestant.name).filter(|name| expected.knows(name));
    Ok(charts::matrix(&known.collect::<Vec<_>>(), |subject, hazard| expected.get(subject, hazard))?)
}

fn work_precision(suite: &Suite) -> anyhow::Result<String> {
    let folder = suite.data().join("record");
    let records = record::read(&folder)?;
    let date = &records.last().context("there are no records")?.host.date;
    let mut problems = problems::all()?;
    let samples = record::samples(&folder, date)?;
    // A problem that is newer than the record has no samples in it.
    problems.retain(|problem| samples.iter().any(|sample| sample.problem == problem.name));
    let sweep = Sweep::of(&problems, samples);
    Ok(charts::recorded(&sweep, "ensemble", date, suite.registry().entries())?)
}

/// The problems of the figure of proofs, with their titles.
const PROVEN: [(&str, &str); 2] =
    [("ensemble", "A coin: the worst of 256 random launches"), ("racket", "A racket that turns over twice")];

fn proven_error() -> anyhow::Result<String> {
    let problems = problems::all()?;
    let panel = |(name, title): (&str, &'static str)| {
        let problem = |problem: &&Problem| problem.name == name;
        let problem = problems.iter().find(problem).with_context(|| format!("no problem '{name}'"))?;
        Ok((title, proofs::proofs(problem)?))
    };
    let panels: Vec<_> = PROVEN.into_iter().map(panel).collect::<anyhow::Result<_>>()?;
    Ok(charts::proofs(&panels)?)
}

/// Prints and draws the accuracy of the committed records.
pub(super) fn history(suite: &Suite, out: &Path) -> anyhow::Result<u8> {
    let records = record::read(&suite.data().join("record"))?;
    ensure!(!records.is_empty(), "there are no records yet; `{}` writes one", suite.commands().bless());
    let path = out.join("history.svg");
    files::write(&path, &charts::history(&records, &Palette::new(suite.registry().entries()))?)?;
    files::print(&format!("{}\nchart: {}\n", text::history(&records), shown(&path.display().to_string())))?;
    Ok(0)
}
