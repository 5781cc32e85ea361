//! The command line of the program `verify`: each command is a file of this folder. `verify run`, which runs the
//! checks, is what `cargo xtask verify` starts.

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

/// The folders of the suite; the defaults are relative to the root of the workspace.
#[derive(Debug, Args)]
struct Folders {
    /// Read bounds, reference numbers, baseline and records from this folder
    #[arg(long, global = true, value_name = "FOLDER", default_value = "validation", hide = true)]
    validation: PathBuf,
    /// Write reports and charts into this folder
    #[arg(long, global = true, value_name = "FOLDER", default_value = "target/verify", hide = true)]
    out: PathBuf,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::Run),
    /// List the checks
    List,
    Replay(Box<replay::Replay>),
    Bench(bench::Bench),
    Work(work::Work),
    /// Measure the planner's table of costs and errors, and write it
    Fit,
    /// Draw the accuracy of the committed records over time
    History,
    Figure(figure::Figure),
}

impl Program {
    /// Runs the command and returns the exit code.
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
