//! The command line of a suite. Without a command the checks are run, which is what `cargo xtask verify` starts.

mod bench;
mod figures;
mod program;
mod run;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::builder::{PathBufValueParser, TypedValueParser};
use clap::error::ContextValue;
use clap::{Args, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::files;
use crate::shown::shown;
use crate::suite::Suite;

/// Arguments that are not understood.
const BAD_USAGE: u8 = 2;

/// Exit code of a command that could not run.
const COULD_NOT_RUN: u8 = 4;

#[derive(Debug, Parser)]
#[command(about = "Run the checks: one line a check, and in full what fails", args_conflicts_with_subcommands = true)]
struct Program {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    run: run::RunArgs,
    #[command(flatten)]
    folders: Folders,
}

/// The folders of the suite.
#[derive(Debug, Args)]
struct Folders {
    /// Read limits, baseline and records from this folder, and write the latter two there [default: validation]
    #[arg(long, global = true, value_name = "FOLDER", value_parser = PathBufValueParser::new().try_map(existing))]
    validation: Option<PathBuf>,
    /// Write reports and charts into this folder
    #[arg(long, global = true, value_name = "FOLDER", default_value = "target/verify")]
    out: PathBuf,
}

#[derive(Debug, Subcommand)]
enum Command {
    Run(run::RunArgs),
    Bench(bench::Bench),
    Work(bench::Work),
    /// Draw the accuracy of the committed records over time
    History,
    Figure(figures::Figure),
}

/// Runs the program of `suite` with the arguments of the process, as `cargo xtask verify` does for the suite of this
/// workspace: `--help` lists them.
///
/// Exit codes: 0, all checks pass; 1, a check fails; 2, bad usage; 3, accuracy or work is worse than the baseline,
/// though within its limits; 4, the command could not run.
#[must_use]
pub fn main(suite: Suite) -> ExitCode {
    let arguments = Program::command().bin_name(suite.commands().program.clone()).try_get_matches();
    let ended = match arguments.and_then(|arguments| Program::from_arg_matches(&arguments)) {
        Ok(program) => program.run(suite),
        Err(asked) if !asked.use_stderr() => files::printed(whole_file::unless_closed(asked.print())).map(|()| 0),
        // Without a standard error there is nobody to say it to.
        Err(error) => {
            let _ = in_one_line(error).print();
            Ok(BAD_USAGE)
        }
    };
    ExitCode::from(ended.unwrap_or_else(|error| {
        whole_file::report(shown(&format!("{error:#}")));
        COULD_NOT_RUN
    }))
}

/// A folder that is there. In a name with a slip there would be no limits and no baseline, and nothing would be compared.
fn existing(folder: PathBuf) -> Result<PathBuf, &'static str> {
    if folder.is_dir() { Ok(folder) } else { Err("expected a folder that exists") }
}

/// The same error, with the arguments in it in one line.
fn in_one_line(mut error: clap::Error) -> clap::Error {
    let arguments = error.context().filter_map(|(kind, value)| match value {
        ContextValue::String(text) => Some((kind, ContextValue::String(shown(text)))),
        _ => None,
    });
    for (kind, value) in arguments.collect::<Vec<_>>() {
        error.insert(kind, value);
    }
    error
}

impl Program {
    /// Runs the command and returns the exit code.
    fn run(self, suite: Suite) -> anyhow::Result<u8> {
        let Folders { validation, out } = self.folders;
        let suite = match &validation {
            Some(folder) => suite.folder(folder),
            None => suite,
        };
        match self.command.unwrap_or(Command::Run(self.run)) {
            Command::Run(command) => command.run(suite, validation.as_deref(), &out),
            Command::Bench(command) => command.run(&suite),
            Command::Work(command) => command.run(),
            Command::History => figures::history(&suite, &out),
            Command::Figure(command) => command.run(&suite),
        }
    }
}
