//! No option is ignored: each option of each command, beside command lines of many kinds, changes the answer or is refused.
//! What does neither stands in [`EXCEPTIONS`] with the reason.

use clap::{Arg, Command};
use serde_json::Value;

use crate::lines::{BASES, VALUES, ran, words, write_files};

/// Options, with a value if only that is meant, beside which command lines they change nothing, and why.
type Exception = (&'static str, fn(&str) -> bool, &'static str);

const EXCEPTIONS: &[Exception] = &[
    ("seconds", |_| true, "how long it may take, which is longer than it takes"),
    ("threads", |_| true, "how fast the answer is there, which is the same for any number"),
    ("svg", |_| true, "draws a chart beside the answer"),
    ("format", |_| true, "the form of the answer"),
    (
        "margin",
        |base| !base.contains("racket") && !base.contains("--moments"),
        "that of a coin is always there, as its help says",
    ),
    ("scheme=taylor", |base| base.contains("--prove"), "the default of --prove, as its help says"),
    (
        "tolerance",
        |base| base.starts_with("probability") && base.contains("--prove"),
        "for outcomes that the coarse flights of a proof leave open",
    ),
    ("method=random", |base| base.starts_with("sample"), "the default, as its help says"),
    ("method=exact-speed", |base| base.starts_with("map"), "the default, as its help says"),
    (
        "coin cylinder moments",
        |base| base.starts_with("limit"),
        "the limit and the shares are the same for all coins, as its help says",
    ),
    (
        "solver",
        |base| ["limit", "convergence", "map"].iter().any(|command| base.starts_with(command)),
        "a solver finds the outcomes that the exact motion has",
    ),
    (
        OF_A_TOSS,
        |base| ["tilt", "outcome", "trace"].iter().any(|want| is_planned(base) && base.contains(want)),
        "a closed form takes as long for every toss",
    ),
    (
        "coin cylinder moments",
        |base| {
            ["probability", "map", "convergence", "errors"].iter().any(|of| base.starts_with(of))
                && base.contains("--turn")
        },
        "n turns about S at its rate, whatever the coin",
    ),
    ("coin cylinder moments", |base| base.starts_with("plan --space"), "a sample takes as long for every coin"),
];

fn is_planned(base: &str) -> bool {
    base.starts_with("plan --rate") || base.starts_with("plan --turn")
}

/// Whether it is left out, because integrators take a minute for such long flights.
fn is_too_long(base: &str, option: &str) -> bool {
    base.starts_with("limit") && option == "solver"
}

/// Options that change the toss.
const OF_A_TOSS: &str = "coin cylinder moments gravity drop tilt attitude";

/// The answer as JSON without its input; of a command that prints lines, the lines.
fn answer(line: &[String]) -> Result<Value, (u8, String)> {
    let line: Vec<String> = line.iter().cloned().chain(["--format".to_owned(), "json".to_owned()]).collect();
    let (code, out, err) = ran(&line);
    if code != 0 {
        return Err((code, err));
    }
    let mut answer = serde_json::from_str(&out).unwrap_or(Value::String(out));
    answer.as_object_mut().map(|fields| fields.remove("input"));
    Ok(answer)
}

/// How many pairs there are, and how many of them were refused, could not be solved, or are exceptions.
#[derive(Debug, Default)]
struct Tried {
    pairs: u32,
    refused: u32,
    failed: u32,
    exceptions: u32,
}

impl Tried {
    /// Tries a value of an option beside a command line. What is ignored is returned.
    fn tries(&mut self, (base, before): (&str, &Value), option: &Arg, value: &str) -> Option<String> {
        let id = option.get_id().as_str();
        let long = format!("--{}", option.get_long()?);
        let given = [long].into_iter().chain((!value.is_empty()).then(|| value.to_owned()));
        let line: Vec<String> = words(base).into_iter().chain(given).collect();
        self.pairs += 1;
        let is_meant = |option: &str| option == id || option == format!("{id}={value}");
        let is_excepted = |(options, beside, _): &Exception| options.split(' ').any(is_meant) && beside(base);
        if is_too_long(base, id) {
            self.exceptions += 1;
            return None;
        }
        match answer(&line) {
            Err((1, _)) => self.failed += 1,
            Err((code, message)) => {
                assert_eq!(code, 2, "{}: {message}", line.join(" "));
                self.refused += 1;
            }
            Ok(now) if now != *before => {}
            Ok(_) if EXCEPTIONS.iter().any(is_excepted) => self.exceptions += 1,
            Ok(_) => return Some(line.join(" ")),
        }
        None
    }
}

#[test]
fn every_option_changes_the_answer_or_is_refused() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    write_files(folder.path());
    let placed = |text: &str| text.replace("{}", &folder.path().display().to_string());
    let program = unfair_toss::program();
    let is_tried = |command: &&Command| BASES.iter().any(|base| words(base)[0] == command.get_name());
    let not_tried: Vec<&str> = program.get_subcommands().filter(|of| !is_tried(of)).map(Command::get_name).collect();
    assert_eq!(not_tried, ["completions", "man"]);
    let (mut tried, mut ignored) = (Tried::default(), Vec::new());
    for base in BASES.iter().map(|base| placed(base)) {
        let before = answer(&words(&base)).unwrap_or_else(|(_, message)| panic!("{base}: {message}"));
        let command = program.find_subcommand(&words(&base)[0]).expect("a command");
        for option in absent(command, &base) {
            let id = option.get_id().as_str();
            let values = VALUES.iter().find(|(of, _)| *of == id).map(|(_, values)| *values);
            for value in values.unwrap_or_else(|| panic!("{base}: no values for {id}")) {
                ignored.extend(tried.tries((&base, &before), option, &placed(value)));
            }
        }
    }
    println!("{tried:?}");
    assert!(ignored.is_empty(), "ignored:\n{}", ignored.join("\n"));
    assert!(tried.pairs > 1200 && tried.refused > 300, "{tried:?}");
}

/// The options of `command` that are not in its command line.
fn absent<'a>(command: &'a Command, base: &str) -> Vec<&'a Arg> {
    let given = words(base);
    let is_absent = |option: &&Arg| option.get_long().is_some_and(|long| !given.contains(&format!("--{long}")));
    command.get_arguments().filter(|option| option.get_id() != "help").filter(is_absent).collect()
}
