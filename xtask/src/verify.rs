//! The tasks that the program `verify` does: the suite, the benchmark, the accuracy over time. Their options are those of
//! the program, which explains them by `--help` and refuses what it does not know.

use std::process::ExitCode;

use clap::Args;

use crate::program;

/// The arguments of a task as they were given.
#[derive(Debug, Args)]
pub(crate) struct Passed {
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "OPTIONS")]
    pub(crate) arguments: Vec<String>,
}

impl Passed {
    /// Runs `verify` with the words of `command` and these arguments.
    pub(crate) fn run(&self, command: &[&str]) -> Result<ExitCode, String> {
        let arguments = command.iter().map(|word| (*word).to_owned()).chain(self.arguments.iter().cloned());
        program::run("verify", &arguments.collect::<Vec<_>>())
    }
}
