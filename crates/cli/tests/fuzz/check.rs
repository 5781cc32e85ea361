//! What holds for every run of the program, whatever its input is.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::{LazyLock, Mutex};
use std::time::Duration;

use serde_json::Value;

use crate::case::Case;
use crate::fields::{Fields, collect, documented};

/// A run may take this long, on a busy machine. Most take some milliseconds, because the commands of the cases ask for
/// little. The longest is `compare` where each of ten integrators takes its million steps, with 4 s of one core.
const LONGEST: Duration = Duration::from_secs(10);

/// The memory of a process that runs any case (KiB).
const MOST_MEMORY: u64 = 1 << 20;

/// What a run has left.
#[derive(Debug)]
pub(crate) struct Ran {
    /// The exit code; `None` if the program was ended by a signal.
    pub(crate) code: Option<i32>,
    pub(crate) out: Vec<u8>,
    pub(crate) err: Vec<u8>,
    /// The messages of panics, caught ones too.
    pub(crate) panics: Vec<String>,
    pub(crate) wall: Duration,
    /// The largest memory of the process (KiB), where it is measured instead of limited.
    pub(crate) memory: u64,
    /// The files in the working folder.
    pub(crate) files: BTreeMap<String, Vec<u8>>,
}

/// The claims that a run of `case` breaks.
pub(crate) fn violations(case: &Case, ran: &Ran) -> Vec<String> {
    let mut found: Vec<String> = ran.panics.iter().map(|message| format!("a panic: {message}")).collect();
    found.extend(exit(ran));
    found.extend(standard_streams(case, ran));
    found.extend(files(case, ran));
    if ran.memory > MOST_MEMORY {
        found.push(format!("took {} KiB", ran.memory));
    }
    if ran.wall > LONGEST {
        found.push(format!("took {:?}", ran.wall));
    }
    found
}

fn exit(ran: &Ran) -> Option<String> {
    (!matches!(ran.code, Some(0..=2))).then(|| format!("ended with {:?}", ran.code))
}

fn standard_streams(case: &Case, ran: &Ran) -> Option<String> {
    let (Ok(out), Ok(err)) = (std::str::from_utf8(&ran.out), std::str::from_utf8(&ran.err)) else {
        return Some("printed what is not UTF-8".to_owned());
    };
    // An answer of what was known when the time was up.
    let err = err.lines().filter(|line| !line.starts_with("note: out of time")).collect::<Vec<_>>().join("\n");
    let answered = ran.code == Some(0);
    // Rows are printed as they come, so that some may stand before an error.
    let in_rows = case.command() == "sample";
    let is_trace = case.command() == "trace";
    match (answered, case.wants_json()) {
        (true, _) if out.trim().is_empty() && !in_rows => Some("answered nothing".to_owned()),
        (true, _) if !err.is_empty() => Some(format!("answered with a complaint: {err}")),
        (false, _) if err.trim().len() < "error: ".len() => Some("failed without a message".to_owned()),
        (false, _) if err.contains("panicked") => Some("failed by a panic".to_owned()),
        (true, true) if asks_for_help(case) || draws_on_standard_output(case) => None,
        (_, true) if in_rows => {
            let rows = out.lines().count() - usize::from(!answered);
            out.lines().enumerate().find_map(|(at, line)| json_value(case, line, at == rows))
        }
        (_, true) => json_value(case, out, !answered),
        (false, false) if !out.is_empty() && !in_rows && !is_trace => Some("failed and printed an answer".to_owned()),
        (true, false) => words(out).find_map(no_number),
        (false, false) => None,
    }
}

/// The words of an answer, but not those in which `compare` says why a solver has none.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let lines = text.lines().filter(|line| !line.contains("claims an error of"));
    lines.flat_map(|line| line.split(|letter: char| letter.is_whitespace() || ",;()".contains(letter)))
}

/// A word of an answer that is a number which no answer may have.
fn no_number(word: &str) -> Option<String> {
    let word = word.trim_start_matches(['+', '±']);
    let bad = matches!(word, "NaN" | "-NaN" | "inf" | "-inf" | "-0" | "-0.0");
    bad.then(|| format!("answered {word}"))
}

fn asks_for_help(case: &Case) -> bool {
    ["--help", "-h", "--version", "-V", "help"].iter().any(|asked| case.names(asked))
}

fn draws_on_standard_output(case: &Case) -> bool {
    case.outputs().contains(&"-".as_ref())
}

/// What is wrong with the JSON of an answer, or of an error if there is one.
fn json_value(case: &Case, text: &str, failed: bool) -> Option<String> {
    let value: Value = match serde_json::from_str(text) {
        Ok(value) => value,
        Err(error) => {
            return Some(format!("not one JSON value, {error}: {}", text.chars().take(300).collect::<String>()));
        }
    };
    let error = &value["error"];
    if error.is_object() != failed || !value.is_object() {
        return Some(format!("wrong kind of JSON: {text}"));
    }
    if failed && (error["message"].as_str().is_none_or(str::is_empty) || !error["kind"].is_string()) {
        return Some(format!("an error without words: {text}"));
    }
    if has_negative_zero(&value) {
        return Some("JSON with -0".to_owned());
    }
    let of_command = match case.command() {
        command if command == "sample" => "`sample`, each line".to_owned(),
        command => format!("`{command}`"),
    };
    // A trace prints its points as they are computed, before one fails.
    let has_points = failed && !value["points"].is_null();
    match failed {
        true if has_points => undocumented(&value, &["`error`", &of_command]),
        true => undocumented(&value, &["`error`"]),
        false => undocumented(&value, &[&of_command]),
    }
}

/// A field that the document of the JSON does not have, or has with another type. A number that is none is null.
fn undocumented(value: &Value, sections: &[&str]) -> Option<String> {
    static DOCUMENTED: LazyLock<Mutex<BTreeMap<String, Fields>>> = LazyLock::new(Mutex::default);
    let mut known = DOCUMENTED.lock().expect("a section that is missing ends the test");
    let of_sections =
        || ["Every answer", "`input`"].iter().chain(sections).flat_map(|section| documented(section)).collect();
    let known = known.entry(sections.concat()).or_insert_with(of_sections);
    let mut found = Fields::new();
    collect(value, "", &mut found);
    let is_known = |(path, types): &(String, BTreeSet<String>)| {
        let is_empty_list = || known.keys().any(|other| other.starts_with(&format!("{path}[]")));
        known.get(path).is_some_and(|known| types.is_subset(known)) || is_empty_list()
    };
    found.into_iter().find(|field| !is_known(field)).map(|field| format!("undocumented {field:?}"))
}

fn has_negative_zero(value: &Value) -> bool {
    match value {
        Value::Number(number) => number.as_f64().is_some_and(|number| number == 0.0 && number.is_sign_negative()),
        Value::Array(items) => items.iter().any(has_negative_zero),
        Value::Object(fields) => fields.values().any(has_negative_zero),
        _ => false,
    }
}

/// The working folder holds what it held, and the chart or the part if and only if the case was answered.
fn files(case: &Case, ran: &Ran) -> Option<String> {
    let drawn = |name: &String| {
        ran.code == Some(0)
            && case
                .outputs()
                .iter()
                .any(|output| Path::new(output) == Path::new("./").join(name) || *output == name.as_str())
    };
    for (name, content) in &ran.files {
        let before = case.files.iter().find(|(known, _)| known == name);
        match before {
            Some((_, before)) if before == content => {}
            _ if drawn(name) => {
                let text = String::from_utf8_lossy(content);
                let whole = text.starts_with("<svg ") && text.trim_end().ends_with("</svg>")
                    || text.starts_with("{\"schema\":") && text.ends_with("}\n");
                if !whole || ["NaN", "\"inf", "\"-inf"].iter().any(|bad| text.contains(bad)) {
                    return Some(format!("{name} is no whole chart or part"));
                }
            }
            _ => return Some(format!("{name} was left in the folder")),
        }
    }
    let wanted = case.outputs().into_iter().filter(|output| *output != "-");
    let mut names = wanted.map(|output| output.to_string_lossy().trim_start_matches("./").to_owned());
    let missing = names.find(|name| ran.code == Some(0) && !asks_for_help(case) && !ran.files.contains_key(name));
    missing.map(|name| format!("{name} was not drawn"))
}
