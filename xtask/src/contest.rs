//! `cargo xtask contest`: flies other people's integrators beside those of this workspace. The contestants are a crate
//! outside the workspace, with dependencies of its own, so that nobody who builds the workspace builds a physics
//! engine.

use std::process::ExitCode;

use clap::Args;

use crate::program;

/// The manifest of the crate, from the root of the workspace.
const MANIFEST: &str = "crates/contestants/Cargo.toml";

/// Fly other people's integrators beside those of this workspace
///
/// Prints what each reaches, at what cost, and where it fails. SciPy takes part if python3 has it, or can install it.
///
/// Exit codes: 0; 1 something is worse than the newest record, or a page is not current; 2 bad usage; 4 could not run.
#[derive(Debug, Args)]
pub(crate) struct Contest {
    /// Take 40 launches instead of 1000, and leave out hazards and the chart
    #[arg(long)]
    quick: bool,
    /// Write a dated record, and from it docs/contestants.md and its chart
    #[arg(long, conflicts_with = "quick")]
    bless: bool,
    /// Fly nothing; end with 1 if what --bless writes from the newest record is not current
    #[arg(long, conflicts_with_all = ["quick", "bless"])]
    check: bool,
    /// Fly nothing; write the page, the chart and the table again from the newest record
    #[arg(long, conflicts_with_all = ["quick", "bless", "check"])]
    draw: bool,
}

impl Contest {
    pub(crate) fn run(&self) -> Result<ExitCode, String> {
        let flags = [("--quick", self.quick), ("--bless", self.bless), ("--check", self.check), ("--draw", self.draw)];
        let given = flags.iter().filter(|(_, given)| *given).map(|(flag, _)| (*flag).to_owned());
        program::run_of(Some(MANIFEST), "contest", &given.collect::<Vec<_>>())
    }
}
