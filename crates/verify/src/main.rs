//! This is the program `verify`, which `cargo xtask` starts. It parses the command line, runs one command and turns its
//! result into an exit code, which tells a script what happened.
//!
//! Exit codes: 0, all checks pass; 1, a check fails; 2, bad usage; 3, accuracy or work is worse than the baseline,
//! though within its bounds; 4, the command could not run.

mod commands;

use std::process::ExitCode;

use clap::Parser;

use commands::Program;

/// Exit code of a command that could not run.
const COULD_NOT_RUN: u8 = 4;

fn main() -> ExitCode {
    match Program::parse().run() {
        Ok(code) => ExitCode::from(code),
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(COULD_NOT_RUN)
        }
    }
}
