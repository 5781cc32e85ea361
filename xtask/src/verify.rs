//! The tasks that the program `verify` does: the suite, the benchmark, the accuracy over time.
//!
//! Their flags are defined here a second time, so that `--help` and a wrong flag are answered before the program is built.

use std::process::ExitCode;

use clap::{Args, ValueEnum};

use crate::program;

const PROGRAM: &str = "verify";

/// Run the verification suite: one line a check, and in full what fails
///
/// Writes report.html, report.json, junit.xml, summary.md, metrics for services that follow numbers, and charts to
/// target/verify.
///
/// Exit codes: 0 all checks pass; 1 a check fails; 2 bad usage; 3 accuracy or work is worse than the baseline, though
/// within bounds; 4 could not run.
#[derive(Debug, Args)]
pub(crate) struct Verify {
    /// Take fewer cases: within a minute on two cores, once built
    #[arg(long, conflicts_with = "deep")]
    quick: bool,
    /// Take ten times as many cases
    #[arg(long)]
    deep: bool,
    /// Run this check alone
    #[arg(long, value_name = "ID")]
    only: Option<String>,
    /// Take what is better or new into the baseline and write a dated record; what is worse is not taken
    #[arg(long, conflicts_with = "only")]
    bless: bool,
    /// What goes to standard output
    #[arg(long, value_enum, conflicts_with = "verbose")]
    format: Option<Format>,
    /// Print one line a row instead of one a check
    #[arg(long)]
    verbose: bool,
    /// Multiply the time limit of every check, for a slow machine or a slow solver
    #[arg(long, value_name = "FACTOR")]
    time_factor: Option<String>,
    /// With --replay: print what this row, given as CHECK / SUBJECT, measures on the toss, and the verdict
    #[arg(long, value_name = "ROW", requires = "replay")]
    row: Option<String>,
    #[command(flatten)]
    foreign: Foreign,
    #[command(flatten)]
    instead: Instead,
}

/// A program in another language, in place of the solvers.
#[derive(Debug, Args)]
struct Foreign {
    /// Judge the program that the shell starts by this line, instead of solvers in Rust; see docs/your-integrator.md
    #[arg(long, value_name = "LINE", conflicts_with = "list")]
    command: Option<String>,
    /// Judge the program by this error of cos θ at any tolerance, instead of by the tolerance
    #[arg(long, value_name = "ERROR", requires = "command")]
    claim: Option<String>,
    /// End the program if it takes longer for an answer; the first of a process may take six times as long [default: 10]
    #[arg(long, value_name = "S", requires = "command")]
    answer_seconds: Option<String>,
    /// Ask the program no more after so much time for all answers [default: 1800]
    #[arg(long, value_name = "S", requires = "command")]
    total_seconds: Option<String>,
    /// End the program if it uses more memory with its children; on Linux only [default: 2048]
    #[arg(long, value_name = "MB", requires = "command")]
    memory_mb: Option<String>,
}

impl Foreign {
    fn arguments(&self) -> impl Iterator<Item = String> {
        let given = [
            ("--command", &self.command),
            ("--claim", &self.claim),
            ("--answer-seconds", &self.answer_seconds),
            ("--total-seconds", &self.total_seconds),
            ("--memory-mb", &self.memory_mb),
        ];
        given.into_iter().flat_map(|(flag, value)| value.iter().flat_map(|value| [flag.to_owned(), value.clone()]))
    }
}

/// What the task does instead of running the checks.
#[derive(Debug, Args)]
#[group(multiple = false, conflicts_with_all = ["quick", "deep", "only", "bless", "format", "verbose", "time_factor"])]
struct Instead {
    /// List the checks and what they claim
    #[arg(long)]
    list: bool,
    /// Fly one toss, given as the text of a worst input, by every solver, scheme and formulation, and take every
    /// measure of proofs, batches and margins on it
    #[arg(long, value_name = "INPUT")]
    replay: Option<String>,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Format {
    Text,
    Json,
    Junit,
    Github,
}

impl Verify {
    pub(crate) fn run(&self) -> Result<ExitCode, String> {
        program::run(PROGRAM, &self.arguments())
    }

    /// The command of the program and its arguments.
    fn arguments(&self) -> Vec<String> {
        let Instead { list, replay } = &self.instead;
        match replay {
            Some(input) => {
                let row = self.row.iter().flat_map(|row| ["--row".to_owned(), row.clone()]);
                ["replay".into(), input.clone()].into_iter().chain(row).chain(self.foreign.arguments()).collect()
            }
            None if *list => vec!["list".into()],
            None => self.run_arguments(),
        }
    }

    fn run_arguments(&self) -> Vec<String> {
        let mut arguments = vec!["run".to_owned()];
        let flags =
            [("--quick", self.quick), ("--deep", self.deep), ("--bless", self.bless), ("--verbose", self.verbose)];
        arguments.extend(flags.iter().filter(|(_, given)| *given).map(|(flag, _)| (*flag).to_owned()));
        let format = self.format.and_then(|format| format.to_possible_value());
        let format = format.map(|value| value.get_name().to_owned());
        for (flag, value) in [("--only", &self.only), ("--format", &format), ("--time-factor", &self.time_factor)] {
            arguments.extend(value.iter().flat_map(|value| [flag.to_owned(), value.clone()]));
        }
        arguments.extend(self.foreign.arguments());
        arguments
    }
}

/// Print what a toss costs, in ns and relative to a reference in C
///
/// Exit code 3 if a kernel takes more instructions than the baseline allows.
#[derive(Debug, Args)]
pub(crate) struct Bench {
    /// Count instructions by valgrind instead, and compare them with the baseline
    #[arg(long)]
    instructions: bool,
    /// Take fewer instructions into the baseline
    #[arg(long, requires = "instructions")]
    bless: bool,
    /// Print instead how long each method takes to this accuracy of P(heads), such as 1e-6
    #[arg(long, value_name = "EPS", conflicts_with = "instructions")]
    to: Option<String>,
}

impl Bench {
    pub(crate) fn run(&self) -> Result<ExitCode, String> {
        let flags = [("--instructions", self.instructions), ("--bless", self.bless)];
        let given = flags.iter().filter(|(_, given)| *given).map(|(flag, _)| (*flag).to_owned());
        let to = self.to.iter().flat_map(|accuracy| ["--to".to_owned(), accuracy.clone()]);
        program::run(PROGRAM, &std::iter::once("bench".to_owned()).chain(given).chain(to).collect::<Vec<_>>())
    }
}

/// Draw the accuracy of the committed records over time
#[derive(Debug, Args)]
pub(crate) struct History {}

impl History {
    #[expect(clippy::unused_self, reason = "every task is run in the same way")]
    pub(crate) fn run(&self) -> Result<ExitCode, String> {
        program::run(PROGRAM, &["history".to_owned()])
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    #[derive(Debug, Parser)]
    struct Line {
        #[command(flatten)]
        verify: Verify,
    }

    #[test]
    fn passes_each_flag_on_to_the_program() {
        for (given, passed) in [
            ("", "run"),
            ("--quick --bless", "run --quick --bless"),
            ("--deep --verbose", "run --deep --verbose"),
            ("--only rounding --format junit", "run --only rounding --format junit"),
            ("--quick --format github --time-factor 3", "run --quick --format github --time-factor 3"),
            ("--list", "list"),
            ("--only margins --quick", "run --quick --only margins"),
            ("--replay i1=1", "replay i1=1"),
            ("--replay i1=1 --command a", "replay i1=1 --command a"),
            ("--replay i1=1 --row a", "replay i1=1 --row a"),
            ("--quick --command a --claim 1e-9 --memory-mb 9", "run --quick --command a --claim 1e-9 --memory-mb 9"),
            (
                "--command a --answer-seconds 1 --total-seconds 2",
                "run --command a --answer-seconds 1 --total-seconds 2",
            ),
        ] {
            let line = Line::try_parse_from(std::iter::once("verify").chain(given.split_whitespace())).unwrap();
            assert_eq!(line.verify.arguments().join(" "), passed);
        }
        // A worst input is one argument with spaces, and may begin a field with a minus sign.
        let line = Line::try_parse_from(["verify", "--replay", "rate_x=-0x1p0 tilt=0x0p+0"]).unwrap();
        assert_eq!(line.verify.arguments(), ["replay", "rate_x=-0x1p0 tilt=0x0p+0"]);
    }
}
