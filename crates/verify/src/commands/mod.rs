//! The commands, one file each; [`run`] is the suite.

mod bench;
mod figure;
mod fit;
mod history;
mod list;
mod replay;
mod run;
mod work;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

/// Verifies the solvers of tossed coins.
#[derive(Debug, Parser)]
#[command(name = "verify")]
pub(crate) struct Program {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    folders: Folders,
}

/// Where files are; the defaults are right in the root of the workspace.
#[derive(Debug, Args)]
struct Folders {
    /// Bounds, reference numbers, baseline and records
    #[arg(long, global = true, value_name = "FOLDER", default_value = "validation", hide = true)]
    validation: PathBuf,
    /// Reports and charts
    #[arg(long, global = true, value_name = "FOLDER", default_value = "target/verify", hide = true)]
    out: PathBuf,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::Run),
    /// List the checks
    List,
    Replay(replay::Replay),
    Bench(bench::Bench),
    Work(work::Work),
    /// Measure the planner's table
    Fit,
    /// Draw the accuracy of the committed records over time
    History,
    Figure(figure::Figure),
}

impl Program {
    /// The exit code.
    ///
    /// # Errors
    /// If the command could not run.
    pub(crate) fn run(&self) -> anyhow::Result<u8> {
        let folders = &self.folders;
        match &self.command {
            Command::Run(command) => command.run(folders),
            Command::List => list::list(),
            Command::Replay(command) => replay::replay(&command.input),
            Command::Bench(command) => command.run(folders),
            Command::Work(command) => command.run(),
            Command::Fit => fit::fit(),
            Command::History => history::history(folders),
            Command::Figure(command) => command.run(folders),
        }
    }
}
