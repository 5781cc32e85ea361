//! Runs mutation testing: cargo-mutants changes the numerical crates, and each change has to make a test fail. A change
//! that survives points to a claim that no test makes, unless `validation/mutants.md` explains why it makes no
//! difference.
//!
//! The code blocks of that file list the explained mutants as cargo-mutants names them, but without line and column, so
//! that the list stays valid when lines move. `.cargo/mutants.toml` says which crates are changed.

use std::collections::BTreeMap;
use std::process::{Command, ExitCode, ExitStatus};

use clap::Args;

use crate::{output, root};

const EXPLANATIONS: &str = "validation/mutants.md";
const FOLDER: &str = "target";

/// How often each mutant occurs. Two mutants in one function may have the same name.
type Counts = BTreeMap<String, usize>;

/// Change the numerical crates in some 11 000 ways; each change has to fail a test or be explained
///
/// The explanations are in validation/mutants.md. Exit code 1 if a change survived that is not explained or, in a run
/// without arguments, if one was caught that is explained.
#[derive(Debug, Args)]
pub(crate) struct Mutants {
    /// Passed on to cargo mutants, such as --file or --shard
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "ARGUMENTS")]
    arguments: Vec<String>,
}

impl Mutants {
    pub(crate) fn run(&self) -> Result<ExitCode, String> {
        let mut command = Command::new("cargo");
        command.args(["mutants", "--output", FOLDER]).args(&self.arguments).current_dir(root());
        // 2: some survived; 3: some ran out of time, which is how a loop without an end is caught.
        match command.status().as_ref().map(ExitStatus::code) {
            Ok(Some(0 | 2 | 3)) => compare(self.arguments.is_empty()),
            _ => Err("cargo mutants did not run to its end (cargo install cargo-mutants)".to_owned()),
        }
    }
}

fn compare(complete: bool) -> Result<ExitCode, String> {
    let survived = count(read(&format!("{FOLDER}/mutants.out/missed.txt"))?.lines().map(without_position));
    let explained = count(explained(&read(EXPLANATIONS)?).map(str::to_owned));
    let unexplained = beyond(&survived, &explained);
    let caught = if complete { beyond(&explained, &survived) } else { Vec::new() };
    let lines = unexplained.iter().map(|mutant| format!("survived, not explained: {mutant}\n"));
    let lines = lines.chain(caught.iter().map(|mutant| format!("explained, but caught:   {mutant}\n")));
    let all: usize = survived.values().sum();
    let sum = format!("{all} survived, {} of them not explained in {EXPLANATIONS}\n", unexplained.len());
    output::print(&lines.chain([sum]).collect::<String>())?;
    Ok(ExitCode::from(u8::from(!(unexplained.is_empty() && caught.is_empty()))))
}

fn read(path: &str) -> Result<String, String> {
    std::fs::read_to_string(root().join(path)).map_err(|error| format!("cannot read {path}: {error}"))
}

fn count(mutants: impl Iterator<Item = String>) -> Counts {
    mutants.fold(Counts::new(), |mut counts, mutant| {
        *counts.entry(mutant).or_default() += 1;
        counts
    })
}

/// Turns `file:line:column: change` into `file: change`.
fn without_position(line: &str) -> String {
    let mut parts = line.splitn(4, ':');
    let (file, change) = (parts.next().unwrap_or_default(), parts.nth(2).unwrap_or_default());
    format!("{file}:{change}")
}

/// The mutants that the code blocks of `markdown` list.
fn explained(markdown: &str) -> impl Iterator<Item = &str> {
    markdown.split("```").skip(1).step_by(2).flat_map(str::lines).filter(|line| line.contains(": "))
}

/// The mutants of `these` that `those` lacks or has less often, each as often as it is missing.
fn beyond<'a>(these: &'a Counts, those: &Counts) -> Vec<&'a str> {
    let rest = |(mutant, times): (&'a String, &usize)| {
        std::iter::repeat_n(mutant.as_str(), times.saturating_sub(those.get(mutant).copied().unwrap_or(0)))
    };
    these.iter().flat_map(rest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn survivors_are_explained_by_name_and_as_often_as_they_occur() {
        let missed = ["a/b.rs:1:2: replace < with <= in f::g", "a/b.rs:3:4: replace < with <= in f::g"];
        let survived = count(missed.into_iter().map(without_position));
        let once = count(explained("Why.\n\n```text\na/b.rs: replace < with <= in f::g\n```\n").map(str::to_owned));
        assert_eq!(beyond(&survived, &once), ["a/b.rs: replace < with <= in f::g"]);
        assert!(beyond(&once, &survived).is_empty());
        assert!(beyond(&survived, &survived).is_empty());
        assert_eq!(beyond(&once, &Counts::new()), ["a/b.rs: replace < with <= in f::g"]);
    }
}
