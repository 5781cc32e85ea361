//! Runs mutation testing: cargo-mutants changes the numerical crates, and each change has to make a test fail. A change
//! that survives points to a claim that no test makes, unless `validation/mutants.md` explains why it makes no
//! difference.
//!
//! The code blocks of that file list the explained mutants as cargo-mutants names them, but without line and column, so
//! that the list stays valid when lines move. `.cargo/mutants.toml` says which crates are changed.

use std::collections::BTreeMap;
use std::process::{Command, ExitCode, ExitStatus};

use crate::root;

const EXPLANATIONS: &str = "validation/mutants.md";
const FOLDER: &str = "target";

/// How often each mutant occurs. Two mutants in one function may have the same name.
type Mutants = BTreeMap<String, usize>;

/// Runs cargo-mutants with `args` and compares the survivors with the explained mutants.
///
/// Ends with 0 if every survivor is explained. Ends with 1 if one is not, or if a run without `args` (a complete one)
/// caught an explained mutant.
pub(crate) fn run(args: impl Iterator<Item = String>) -> Result<ExitCode, String> {
    let args: Vec<String> = args.collect();
    let ran = Command::new("cargo").args(["mutants", "--output", FOLDER]).args(&args).current_dir(root()).status();
    // Exit code 2: some mutants survived. Exit code 3: some exceeded the time limit, as endless loops do.
    match ran.as_ref().map(ExitStatus::code) {
        Ok(Some(0 | 2 | 3)) => compare(args.is_empty()),
        _ => Err("cargo mutants did not run to its end (cargo install cargo-mutants)".to_owned()),
    }
}

fn compare(complete: bool) -> Result<ExitCode, String> {
    let survived = count(read(&format!("{FOLDER}/mutants.out/missed.txt"))?.lines().map(without_position));
    let explained = count(explained(&read(EXPLANATIONS)?).map(str::to_owned));
    let unexplained = beyond(&survived, &explained);
    let caught = if complete { beyond(&explained, &survived) } else { Vec::new() };
    for mutant in &unexplained {
        println!("survived, not explained: {mutant}");
    }
    for mutant in &caught {
        println!("explained, but caught:   {mutant}");
    }
    let all: usize = survived.values().sum();
    println!("{all} survived, {} of them not explained in {EXPLANATIONS}", unexplained.len());
    Ok(ExitCode::from(u8::from(!(unexplained.is_empty() && caught.is_empty()))))
}

fn read(path: &str) -> Result<String, String> {
    std::fs::read_to_string(root().join(path)).map_err(|error| format!("cannot read {path}: {error}"))
}

fn count(mutants: impl Iterator<Item = String>) -> Mutants {
    mutants.fold(Mutants::new(), |mut counts, mutant| {
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
fn beyond<'a>(these: &'a Mutants, those: &Mutants) -> Vec<&'a str> {
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
        assert_eq!(beyond(&once, &Mutants::new()), ["a/b.rs: replace < with <= in f::g"]);
    }
}
