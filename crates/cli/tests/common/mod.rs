//! Functions that the tests of the command line share: they run the program and return its output. Each test runs the
//! real program, so that options, exit codes and standard output are tested together.

use std::process::{Command, Output};

pub(crate) fn run(arguments: &str) -> Output {
    let arguments: Vec<&str> = arguments.split_whitespace().collect();
    Command::new(env!("CARGO_BIN_EXE_unfair-toss")).args(arguments).output().expect("the program starts")
}

pub(crate) fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

pub(crate) fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}
