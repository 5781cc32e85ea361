//! The command `replay` solves one toss with every solver, scheme and formulation and prints their answers side by side,
//! and below them what each check of the library measures on that toss: proofs, batches at every SIMD level, margins. The
//! toss is given as the hex floats of a row's worst input, so a failure can be studied exactly.

use std::path::Path;

use clap::Args;

use super::program::Foreign;
use crate::files;
use crate::measure::any_case::AnyCase;
use crate::measure::atlas;
use crate::measure::atlas::conditioning::Conditioning;
use crate::measure::checks::of_toss;
use crate::render::runs;
use crate::suite::Suite;

/// Solve one toss with every solver, scheme and formulation, and take every measure of the library on it
#[derive(Debug, Args)]
pub(super) struct Replay {
    /// The toss, as the hex floats of a row's worst input
    #[arg(value_parser = input)]
    pub(super) input: AnyCase,
    #[command(flatten)]
    foreign: Foreign,
}

/// Reads the toss from a line of hex floats.
pub(super) fn input(line: &str) -> Result<AnyCase, String> {
    AnyCase::from_hex(line).map_err(|error| format!("{error:#}"))
}

impl Replay {
    pub(super) fn run(&self, suite: Suite, out: &Path) -> anyhow::Result<u8> {
        let suite = self.foreign.in_place_of(suite, out)?;
        let runs = atlas::replay(suite.registry().entries(), &self.input)?;
        let solvers = runs::text(&runs, Conditioning::of_any(&self.input)?);
        // The checks of the library measure coins.
        let AnyCase::Coin(case) = &self.input else { return files::print(&solvers).map(|()| 0) };
        let measured = of_toss::replay(case);
        let of_library = runs::of_library(measured.iter().map(|(one, deviation)| (one.check, one.part, deviation)));
        files::print(&format!("{solvers}{of_library}"))?;
        Ok(0)
    }
}
