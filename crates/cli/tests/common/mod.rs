//! Functions that the tests of the command line share: they run the program and return its output. Each test runs the
//! real program, so that options, exit codes and standard output are tested together.

use std::process::{Command, Output};

/// The program of this build, or what the environment names instead: `ANSWERS_OF` holds a program with what starts it, such
/// as one that was built for another processor, and its emulator.
pub(crate) fn run(arguments: &str) -> Output {
    let program = std::env::var("ANSWERS_OF").unwrap_or(env!("CARGO_BIN_EXE_unfair-toss").to_owned());
    let mut words = program.split(' ').chain(arguments.split_whitespace());
    Command::new(words.next().unwrap_or_default()).args(words).output().expect("the program starts")
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}
