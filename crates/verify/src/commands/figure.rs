//! `verify figure` draws figures from what is committed, without any measurement.

use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{Args, ValueEnum};
use toss::Registry;
use verify::files;
use verify::judge::record;
use verify::measure::atlas;
use verify::measure::atlas::expected::Expected;
use verify::measure::work_precision::{Sweep, problems};
use verify::render::charts;

use super::Folders;

/// Draw a figure from what is committed
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
}

impl Figure {
    pub(super) fn run(&self, folders: &Folders) -> anyhow::Result<u8> {
        let svg = match self.name {
            Name::AtlasMatrix => atlas_matrix(&folders.validation)?,
            Name::WorkPrecision => work_precision(&folders.validation)?,
        };
        files::write(&self.svg, &svg)?;
        Ok(0)
    }
}

fn atlas_matrix(validation: &Path) -> anyhow::Result<String> {
    let names = atlas::names(Registry::standard().entries())?;
    Ok(charts::known_failures(&names, &Expected::read(&validation.join("atlas.toml"))?)?)
}

fn work_precision(validation: &Path) -> anyhow::Result<String> {
    let folder = validation.join("record");
    let records = record::read(&folder)?;
    let date = &records.last().context("there are no records")?.host.date;
    let problems = problems::read(&validation.join("problems.toml"))?;
    let sweep = Sweep::of(&problems, record::samples(&folder, date)?);
    Ok(charts::recorded(&sweep, "ensemble", date, Registry::standard().entries())?)
}
