//! This is the program `verify`, which `cargo xtask` starts. It parses the command line, runs one command and turns its
//! result into an exit code, which tells a script what happened.
//!
//! Exit codes: 0, all checks pass; 1, a check fails; 2, bad usage; 3, accuracy or work is worse than the baseline,
//! though within its bounds; 4, the command could not run.

mod commands;

use std::process::ExitCode;

use clap::Parser;
use commands::Program;
use verify::files;

/// Arguments that are not understood.
const BAD_USAGE: u8 = 2;

/// Exit code of a command that could not run.
const COULD_NOT_RUN: u8 = 4;

fn main() -> ExitCode {
    let ended = match Program::try_parse() {
        Ok(program) => program.run(),
        Err(asked) if !asked.use_stderr() => files::printed(whole_file::unless_closed(asked.print())).map(|()| 0),
        // Without a standard error there is nobody to say it to.
        Err(error) => {
            let _ = error.print();
            Ok(BAD_USAGE)
        }
    };
    ExitCode::from(ended.unwrap_or_else(|error| {
        whole_file::report(format_args!("{error:#}"));
        COULD_NOT_RUN
    }))
}
