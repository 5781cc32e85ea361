//! `verify replay` solves one toss with every solver, scheme and formulation and prints their answers side by side. The
//! toss is given as the hex floats of a row's worst input, so a failure can be studied exactly.

use clap::Args;
use toss::Registry;
use verify::files;
use verify::measure::atlas;
use verify::measure::atlas::conditioning::Conditioning;
use verify::measure::case::Case;
use verify::render::runs;

/// Solve one toss with every solver, scheme and formulation
#[derive(Debug, Args)]
pub(super) struct Replay {
    /// The toss, as the hex floats of a row's worst input
    #[arg(value_parser = input)]
    pub(super) input: Case,
}

/// Reads the toss from a line of hex floats.
pub(super) fn input(line: &str) -> Result<Case, String> {
    Case::from_hex(line).map_err(|error| format!("{error:#}"))
}

pub(super) fn replay(case: &Case) -> anyhow::Result<u8> {
    let runs = atlas::replay(Registry::standard().entries(), case)?;
    files::print(&runs::text(&runs, Conditioning::new(&case.toss)?))?;
    Ok(0)
}
