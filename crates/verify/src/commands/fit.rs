//! The command `fit` measures the errors and costs by which the planner chooses an integrator, and writes them. It is a
//! command of its own because they must be measured again on a change of a model, which needs no run of the checks.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::files;
use crate::host::Host;
use crate::measure::planner::fit;
use crate::measure::replay::Commands;
use crate::suite::Suite;

/// Measure the errors and costs by which the planner chooses a model, and write them
#[derive(Debug, Default, Args)]
pub(super) struct Fit {
    /// Measure the models that answer for a space of launches, and keep the rest of the table
    #[arg(long)]
    spaces: bool,
}

/// Measures the table: in this workspace that of all models, into the file with which the library is built; elsewhere
/// that of the suite's own integrators, into the folder of the suite, for `Registry::measured`.
pub(super) fn fit(suite: &Suite, of: &Fit) -> anyhow::Result<u8> {
    let Host { date, cpu, .. } = Host::here();
    let measured = format!("{date} on {cpu}");
    let (fitted, path): (_, PathBuf) = match suite.commands() {
        Commands::Workspace if of.spaces => (fit::fit_spaces(&measured)?, Path::new(fit::FILE).into()),
        Commands::Workspace => (fit::fit(measured)?, Path::new(fit::FILE).into()),
        Commands::Program(_) | Commands::With(..) => {
            (fit::fit_others(suite.registry(), measured)?, suite.data().join("fitted.toml"))
        }
    };
    files::write(&path, &fit::text(&fitted)?)?;
    Ok(0)
}
