//! One grammar for all options: each option of each command, as the program itself defines them, is given wrong values of every
//! kind. The answer is an error with code 2 that names the option, the value and what is valid.

use crate::registry::answer;
use clap::{Arg, Command};
use serde_json::Value;
use toss::Registry;

/// Values that no option takes, but one that is the name of a file.
const WRONG: [&str; 9] = ["abc", "−3", "3−4", "15º", "30±1", "0x10", "1e999x", "7 apples", "~"];

/// Options that are no numbers.
const TEXTS: &str = "coin solver scheme formulation method want format across up space scene svg out shard";

/// Options whose values are whole numbers.
const COUNTS: [&str; 7] = ["points", "seed", "threads", "steps", "repeats", "replicates", "up_to"];

/// Effects that are outside the model: no value of these is valid.
const OUTSIDE: [&str; 2] = ["drag", "bounce"];

/// Files that are written or read, which may have any name in a folder that exists.
const FILES: [&str; 3] = ["svg", "out", "scene"];

/// The other options of a command line with `option`, such that the value of the option is what is wrong with it.
fn others(command: &str, option: &str) -> Vec<String> {
    let answered = match command {
        "toss" | "compare" => "--rate 1,2,3 --speed 3",
        "trace" => "--rate 1,2,3 --speed 3 --points 3",
        "spread" => "--rate 1,2,3 --speed 3 --heads 0.9",
        "plan" => "--rate 1,2,3 --speed 3 --want tilt --accuracy 1e-6",
        "intervals" => "--rate 1,2,3 --speed 3:4",
        "inverse" => "--probability 0.7",
        "limit" => "--points 9",
        "probability" | "sample" => "--rate-x 1:2 --rate-y 1 --rate-z 1 --speed 3 --points 8 --method random",
        "map" => "--rate-x 1:2:2 --rate-y 1 --rate-z 1:2:2 --speed 3",
        "errors" => "--rate-x 1:2 --rate-y 1 --rate-z 1 --speed 3 --up-to 8 --replicates 1 --reference 0.5",
        "convergence" => "--rate-x 1:2:4 --rate-y 1 --rate-z 1 --speed 3",
        _ => "",
    };
    let rates = "--rate --rate-x --rate-y --rate-z";
    // What is left out, and what stands in its place.
    let (without, with) = match (command, option) {
        (_, "turn") => (rates, "--psi 1"),
        (_, "psi") => (rates, "--turn 1"),
        (_, "time") => ("--speed", ""),
        (_, "counts") => ("--probability", ""),
        ("plan", "scene") => ("--rate --speed --want --accuracy", ""),
        ("plan", "space") => ("--rate --speed --want", "--want probability"),
        ("plan", "points") => ("--want", "--want trace"),
        ("trace", "dt") => ("--points", ""),
        (_, "space") => ("--rate-x --rate-y --rate-z --speed", ""),
        ("probability", "shard") => ("", "--out /no/such/folder/part.json"),
        ("probability", "out") => ("", "--shard 1/2"),
        ("probability", "accuracy") => ("--points --method", ""),
        ("compare", _) => ("", ""),
        ("map", "step") => ("", "--method random --points 8 --solver gamma --scheme rk4"),
        ("map", "scheme" | "tolerance" | "formulation") => ("", "--method random --points 8 --solver gamma"),
        (_, "step") => ("", "--solver gamma --scheme rk4"),
        (_, "scheme" | "tolerance" | "formulation") => ("", "--solver gamma"),
        _ => ("", ""),
    };
    let pairs: Vec<&str> = answered.split_whitespace().collect();
    let kept = pairs.chunks(2).filter(|pair| !without.split(' ').any(|name| name == pair[0])).flatten().copied();
    kept.chain(with.split_whitespace()).map(str::to_owned).collect()
}

/// A run in this process: code, standard output and standard error.
fn ran(arguments: &[String]) -> (u8, String, String) {
    answer(Registry::standard(), arguments.iter().map(String::as_str))
}

fn is_text(id: &str) -> bool {
    TEXTS.split(' ').any(|text| text == id)
}

/// A text in which an option is called as in messages: `rate x` for `--rate-x`.
fn spaced(text: &str) -> String {
    text.replace(['_', '-'], " ")
}

/// The command line of `option` with `value`. The option stands first, so that the others do not hide it.
fn line(command: &Command, option: &Arg, value: &str) -> Vec<String> {
    let (command, id) = (command.get_name(), option.get_id().as_str());
    let long = format!("--{}", option.get_long().expect("an option"));
    let others = others(command, id);
    let kept = others.chunks(2).filter(|pair| pair[0] != long).flatten().cloned();
    [command.to_owned(), long.clone(), value.to_owned()].into_iter().chain(kept).collect()
}

/// Every option with a value of every command.
fn options(program: &Command) -> Vec<(&Command, &Arg)> {
    let of = |command| Command::get_arguments(command).map(move |option| (command, option));
    let all = program.get_subcommands().flat_map(of);
    all.filter(|(_, option)| option.get_long().is_some() && option.get_action().takes_values()).collect()
}

/// What is wrong with the refusal of a command line; `None` if nothing is.
fn complaint(line: &[String], id: &str, value: &str) -> Option<String> {
    let (code, out, message) = ran(line);
    let is_json = line.iter().any(|part| part == "json");
    let said = spaced(&message);
    let problem = if code != 2 {
        format!("ended with {code}")
    } else if !is_json && !out.is_empty() {
        "printed an answer".to_owned()
    } else if !said.contains(&spaced(id)) {
        "does not name the option".to_owned()
    } else if !OUTSIDE.contains(&id) && !message.contains(value) {
        "does not name the value".to_owned()
    } else if !OUTSIDE.contains(&id)
        && !["expected", "known:", "possible values", "valid range"].iter().any(|word| message.contains(word))
    {
        "does not say what is valid".to_owned()
    } else if value.contains('−') && !is_text(id) && !OUTSIDE.contains(&id) && !message.contains("U+2212") {
        "does not name the look-alike".to_owned()
    } else {
        return None;
    };
    Some(format!("{}: {problem}: {message}", line.join(" ")))
}

#[test]
fn every_option_refuses_wrong_values_by_its_name_with_the_value_and_what_is_valid() {
    let program = unfair_toss::program();
    let options = options(&program);
    let mut complaints = Vec::new();
    for (command, option) in &options {
        let id = option.get_id().as_str();
        let values: &[&str] =
            if FILES.contains(&id) { &["/no/such/folder/file.toml", "/no/such/folder/file.json"] } else { &WRONG };
        for value in values {
            complaints.extend(complaint(&line(command, option, value), id, value));
        }
        if id == "space" {
            for value in ["launches.json", "folder/launches", "/no/such/folder/launches.toml"] {
                complaints.extend(complaint(&line(command, option, value), id, value));
            }
        }
        // With another format, the error is JSON that names the field.
        let in_json = command.get_arguments().any(|argument| argument.get_id() == "format");
        if in_json && !["format", "out", "shard"].contains(&id) {
            let mut line = line(command, option, values[0]);
            line.retain(|part| part != "--format");
            line.extend(["--format", "json"].map(str::to_owned));
            let (code, out, _) = ran(&line);
            let error: Value = serde_json::from_str(&out).unwrap_or_default();
            let field = spaced(error["error"]["field"].as_str().unwrap_or_default());
            if code != 2 || !field.contains(&spaced(id)) {
                complaints.push(format!("{}: the field is '{field}': {out}", line.join(" ")));
            }
        }
    }
    assert!(options.len() > 150, "{}", options.len());
    assert!(complaints.is_empty(), "{} complaints:\n{}", complaints.len(), complaints.join("\n"));
}

/// A negative number is a value, and no unknown option; a fraction is no count, and neither is what no u64 holds.
#[test]
fn counts_are_whole_numbers_in_a_range_that_is_said() {
    let program = unfair_toss::program();
    let (mut complaints, mut counts) = (Vec::new(), 0);
    for (command, option) in options(&program) {
        let id = option.get_id().as_str();
        if is_text(id) || OUTSIDE.contains(&id) {
            continue;
        }
        let (code, _, message) = ran(&line(command, option, "-5"));
        if code != 0 && (message.contains("unexpected argument") || !message.contains("-5")) {
            complaints.push(format!("{} --{id} -5: {message}", command.get_name()));
        }
        if COUNTS.contains(&id) {
            counts += 1;
            for value in ["-5", "1.5", "1e-1", "18446744073709551616", "1e99", "nan", "inf", "1_000", "50%"] {
                complaints.extend(complaint(&line(command, option, value), id, value));
            }
        }
    }
    assert!(counts > 20, "{counts}");
    assert!(complaints.is_empty(), "{} complaints:\n{}", complaints.len(), complaints.join("\n"));
}
