//! Runs mutation testing: cargo-mutants changes the numerical crates, and each change has to make a test fail. A change
//! that survives points to a claim that no test makes, unless `validation/mutants.txt` explains why it makes no
//! difference.
//!
//! That file lists the explained mutants as cargo-mutants names them, but without line and column, so that the list stays
//! valid when lines move, and the reasons in lines that begin with `#`. `.cargo/mutants.toml` says which crates are changed.

use std::collections::{BTreeMap, HashSet};
use std::process::{Command, ExitCode, ExitStatus};

use clap::Args;

use crate::{output, root};

const EXPLANATIONS: &str = "validation/mutants.txt";
const FOLDER: &str = "target";

/// How often each mutant occurs. Two mutants in one function may have the same name.
type Counts = BTreeMap<String, usize>;

/// Change the numerical crates in some 12 000 ways; each change has to fail a test or be explained
///
/// The explanations are in validation/mutants.txt. Exit code 1 if a change survived that is not explained or, in a run
/// without arguments, if one was caught that is explained.
///
/// All of them take days. A sample says how many survive, with a limit: of all changes, or of those of some files.
#[derive(Debug, Args)]
pub(crate) struct Mutants {
    /// Draw this many changes, and say which share of them survives
    #[arg(long, value_name = "N", requires = "seed", value_parser = clap::value_parser!(u64).range(1..))]
    sample: Option<u64>,
    /// The seed of the sample; the same seed draws the same changes
    #[arg(long, value_name = "S", requires = "sample")]
    seed: Option<u64>,
    /// Passed on to cargo mutants, such as --file, --package or --in-place
    #[arg(trailing_var_arg = true, allow_hyphen_values = true, value_name = "ARGUMENTS")]
    arguments: Vec<String>,
}

impl Mutants {
    pub(crate) fn run(&self) -> Result<ExitCode, String> {
        let mut own = vec!["--output".to_owned(), FOLDER.to_owned()];
        let mut extent = if self.arguments.is_empty() { Extent::All } else { Extent::Some };
        if let (Some(number), Some(seed)) = (self.sample, self.seed) {
            let all = self.list()?;
            let drawn = drawn(&all, usize::try_from(number).unwrap_or(usize::MAX), seed);
            output::say(format_args!("{} of {} mutants drawn with the seed {seed}", drawn.len(), all.len()));
            own.extend(drawn.iter().flat_map(|mutant| ["--re".to_owned(), format!("^{}$", escaped(mutant))]));
            extent = Extent::Sample(drawn.into_iter().cloned().collect());
        }
        // 2: some survived; 3: some ran out of time, which is how a loop without an end is caught.
        match self.command(&own).status().as_ref().map(ExitStatus::code) {
            Ok(Some(0 | 2 | 3)) => compare(&extent),
            _ => Err(NOT_RUN.to_owned()),
        }
    }

    /// The command's own arguments come first: those after a `--` are for the tests.
    fn command(&self, own: &[String]) -> Command {
        let mut command = Command::new("cargo");
        command.arg("mutants").args(own).args(&self.arguments).current_dir(root());
        command
    }

    /// The names of the mutants to draw from, with line and column.
    fn list(&self) -> Result<Vec<String>, String> {
        let listed = self.command(&["--list".to_owned()]).output().map_err(|error| error.to_string())?;
        if !listed.status.success() {
            return Err(format!("{NOT_RUN}: {}", String::from_utf8_lossy(&listed.stderr).trim()));
        }
        Ok(String::from_utf8_lossy(&listed.stdout).lines().map(str::to_owned).collect())
    }
}

const NOT_RUN: &str = "cargo mutants did not run to its end (cargo install cargo-mutants)";

/// `number` of `all`, or all of them if there are fewer: each set of this size is as likely as any other.
fn drawn(all: &[String], number: usize, seed: u64) -> Vec<&String> {
    let mut all: Vec<&String> = all.iter().collect();
    let number = number.min(all.len());
    let mut state = seed;
    for index in 0..number {
        // The remainder favours small numbers by less than a part in 10^14.
        let rest = (all.len() - index) as u64;
        all.swap(index, index + usize::try_from(split_mix(&mut state) % rest).unwrap_or(0));
    }
    all.truncate(number);
    all
}

/// The next number of the generator SplitMix64 (Steele, Lea & Flood, OOPSLA 2014).
fn split_mix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mixed = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    mixed ^ (mixed >> 31)
}

/// The regular expression that matches this text alone.
fn escaped(text: &str) -> String {
    let special = |letter: char| r"\.+*?()|[]{}^$".contains(letter);
    text.chars().flat_map(|letter| special(letter).then_some('\\').into_iter().chain([letter])).collect()
}

/// The largest share of all mutants that survive with which `survived` or fewer of `tried` have a chance of 5 %: the upper
/// limit of Clopper and Pearson (Biometrika 26 (1934), 404), one-sided.
fn limit(survived: usize, tried: usize) -> f64 {
    // P(at most `survived`), each term from the one before.
    let chance = |share: f64| {
        let first = (1.0 - share).powf(tried as f64);
        let next = |term: &mut f64, index: usize| {
            let now = *term;
            *term *= (tried - index) as f64 / (index + 1) as f64 * share / (1.0 - share);
            Some(now)
        };
        (0..=survived).scan(first, next).sum::<f64>()
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if chance(middle) > 0.05 { low = middle } else { high = middle }
    }
    high
}

/// Which of the mutants were run.
#[derive(PartialEq)]
enum Extent {
    All,
    Some,
    /// Those of these names. cargo-mutants runs every deletion of a field beside them, whatever names it is given (its
    /// issue 632).
    Sample(HashSet<String>),
}

impl Extent {
    fn has(&self, mutant: &str) -> bool {
        !matches!(self, Self::Sample(names) if !names.contains(mutant))
    }
}

fn compare(extent: &Extent) -> Result<ExitCode, String> {
    let outcome = |of: &str| -> Result<Vec<String>, String> {
        let names = read(&format!("{FOLDER}/mutants.out/{of}.txt"))?;
        Ok(names.lines().filter(|name| extent.has(name)).map(without_position).collect())
    };
    let number = |of: &str| outcome(of).map(|names| names.len());
    let survived = count(outcome("missed")?.into_iter());
    let explained = count(explained(&read(EXPLANATIONS)?).map(str::to_owned));
    let unexplained = beyond(&survived, &explained);
    let caught = if *extent == Extent::All { beyond(&explained, &survived) } else { Vec::new() };
    let lines = unexplained.iter().map(|mutant| format!("survived, not explained: {mutant}\n"));
    let lines = lines.chain(caught.iter().map(|mutant| format!("explained, but caught:   {mutant}\n")));
    let all: usize = survived.values().sum();
    let [failed, endless, broken] = [number("caught")?, number("timeout")?, number("unviable")?];
    let mut sum = format!(
        "{failed} failed a test, {endless} exceeded the time limit, {broken} did not compile, {all} survived, {} of them \
         not explained in {EXPLANATIONS}\n",
        unexplained.len(),
    );
    if matches!(extent, Extent::Sample(_)) {
        let (survived, tried) = (unexplained.len(), failed + endless + unexplained.len());
        sum += &format!(
            "of those drawn {survived} of {tried} survive unexplained, of all at most {:.1} % (95 %, Clopper-Pearson)\n",
            100.0 * limit(survived, tried),
        );
    }
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

/// The mutants of a list with the reasons between them.
fn explained(list: &str) -> impl Iterator<Item = &str> {
    list.lines().filter(|line| !line.is_empty() && !line.starts_with('#'))
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
    fn a_sample_is_drawn_without_repetition_and_each_mutant_as_often_as_any_other() {
        let all: Vec<String> = (0..20).map(|index| index.to_string()).collect();
        let mut times = Counts::new();
        for seed in 0..10_000 {
            let sample = drawn(&all, 5, seed);
            assert_eq!(count(sample.iter().map(|mutant| (*mutant).clone())).len(), 5);
            assert_eq!(sample, drawn(&all, 5, seed));
            sample.into_iter().for_each(|mutant| *times.entry(mutant.clone()).or_default() += 1);
        }
        // 2500 each, with a standard deviation of 43.
        assert!(times.len() == 20 && times.values().all(|times| (2285..2715).contains(times)), "{times:?}");
        assert_eq!(drawn(&all, 99, 1).len(), 20);
    }

    #[test]
    fn the_limit_of_a_share_is_that_of_clopper_and_pearson() {
        // None of n: 1 - 0.05^(1/n). All of n: 1. The other two from exact binomial coefficients.
        for (survived, tried, expected) in
            [(0, 59, 1.0 - 0.05_f64.powf(1.0 / 59.0)), (3, 357, 0.021_574_705), (8, 400, 0.035_796_618), (4, 4, 1.0)]
        {
            let found = limit(survived, tried);
            assert!((found - expected).abs() < 1e-6, "{survived} of {tried}: {found}, not {expected}");
        }
    }

    #[test]
    fn a_name_is_matched_to_the_letter() {
        assert_eq!(
            escaped("a.rs:1:2: replace <impl A<4, 1>>::f -> [f64; 1] with {}"),
            r"a\.rs:1:2: replace <impl A<4, 1>>::f -> \[f64; 1\] with \{\}"
        );
    }

    #[test]
    fn survivors_are_explained_by_name_and_as_often_as_they_occur() {
        let missed = ["a/b.rs:1:2: replace < with <= in f::g", "a/b.rs:3:4: replace < with <= in f::g"];
        let survived = count(missed.into_iter().map(without_position));
        let once = count(explained("# Why: because.\n\na/b.rs: replace < with <= in f::g\n").map(str::to_owned));
        assert_eq!(beyond(&survived, &once), ["a/b.rs: replace < with <= in f::g"]);
        assert!(beyond(&once, &survived).is_empty());
        assert!(beyond(&survived, &survived).is_empty());
        assert_eq!(beyond(&once, &Counts::new()), ["a/b.rs: replace < with <= in f::g"]);
    }
}
