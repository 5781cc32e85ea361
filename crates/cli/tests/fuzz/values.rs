//! Values for options: valid ones of each kind, extreme numbers, and texts that are no value at all.

use std::ffi::OsString;
use std::os::unix::ffi::OsStringExt;

use clap::Arg;

use crate::lists::{EXTREME, FITTING, GARBAGE, HUGE, NAMES, ORDINARY, OUTPUTS, SMALL, UNITS};
use crate::source::Source;

/// What an option takes, as far as its definition tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// One of the values that the definition lists.
    Listed,
    /// The name of a coin, a solver, a coordinate and so on.
    Name,
    /// A number of launches, steps or the like, which determines how long the command takes.
    Count,
    /// Another whole number.
    Whole,
    /// Numbers separated by commas.
    List(usize),
    /// A range, a distribution or a value.
    Axis,
    /// A range.
    Range,
    /// A file that is read.
    Input,
    /// A file that is written.
    Output,
    /// A number.
    Number,
}

/// The kind of `argument`, from its listed values and from the name of its value in the help text.
pub(crate) fn kind(argument: &Arg) -> Kind {
    let names = argument.get_value_names().unwrap_or_default();
    let name = names.first().map_or("", |name| name.as_str());
    match name {
        _ if !argument.get_possible_values().is_empty() => Kind::Listed,
        _ if matches!(argument.get_id().as_str(), "svg" | "out") => Kind::Output,
        _ if name.contains("FILE") => Kind::Input,
        _ if name.contains(',') => Kind::List(name.split(',').count()),
        _ if name.contains("AXIS") => Kind::Axis,
        _ if name.contains(':') => Kind::Range,
        "N" | "EXPONENT" => Kind::Count,
        "S" | "K" => Kind::Whole,
        "NAME" | "COORDINATE" | "COMMAND" => Kind::Name,
        _ => Kind::Number,
    }
}

/// A value for the option with this definition.
pub(crate) fn value_of(source: &mut Source, argument: &Arg) -> OsString {
    let fitting = FITTING.iter().find(|(id, _)| argument.get_id() == id);
    if let Some((_, values)) = fitting
        && (source.careful || source.chance(70))
    {
        return source.pick(values).to_string().into();
    }
    let listed: Vec<String> = argument.get_possible_values().iter().map(|value| value.get_name().to_owned()).collect();
    value(source, kind(argument), &listed)
}

/// A value for an option of `kind`, whose definition lists the values `listed`.
pub(crate) fn value(source: &mut Source, kind: Kind, listed: &[String]) -> OsString {
    match source.below(100) {
        _ if source.careful => valid(source, kind, listed).into(),
        0..80 => valid(source, kind, listed).into(),
        80..86 => source.pick(&EXTREME).to_string().into(),
        86..90 => {
            let other = *source.pick(&[Kind::Name, Kind::Count, Kind::List(3), Kind::Axis, Kind::Number]);
            valid(source, other, listed).into()
        }
        _ if kind == Kind::Output => source.pick(&OUTPUTS).to_string().into(),
        90..97 => source.pick(&GARBAGE).to_string().into(),
        _ => garbage(source),
    }
}

/// A value that an option of `kind` would often accept.
fn valid(source: &mut Source, kind: Kind, listed: &[String]) -> String {
    match kind {
        Kind::Listed if !listed.is_empty() => source.pick(listed).clone(),
        Kind::Listed | Kind::Name => source.pick(&NAMES).to_string(),
        Kind::Count | Kind::Whole => count(source),
        Kind::List(length) => {
            let length = if source.careful || source.chance(90) { length } else { source.below(8) };
            (0..length).map(|_| number(source)).collect::<Vec<_>>().join(",")
        }
        Kind::Range if source.careful => source.pick(&["2:3", "3:5", "0:1"]).to_string(),
        Kind::Axis | Kind::Range => axis(source),
        Kind::Input if source.careful => source.pick(&["file.toml", "file.toml", "cheated", "tails"]).to_string(),
        Kind::Input => source.pick(&["file.toml", "file.json", "cheated", "tails", "missing.toml", "."]).to_string(),
        Kind::Output => {
            let outputs = if source.careful { &OUTPUTS[..6] } else { OUTPUTS.as_slice() };
            source.pick(outputs).to_string()
        }
        Kind::Number => number(source),
    }
}

fn count(source: &mut Source) -> String {
    let counts = if source.careful || source.chance(85) { SMALL } else { HUGE.as_slice() };
    source.pick(counts).to_string()
}

/// A number, here and there extreme or with a unit.
pub(crate) fn number(source: &mut Source) -> String {
    match source.below(100) {
        _ if source.careful => source.pick(&ORDINARY[..13]).to_string(),
        0..60 => source.pick(&ORDINARY).to_string(),
        60..85 => format!("{:.3}", 4.0 * source.fraction()),
        85..90 => source.pick(&EXTREME).to_string(),
        90..92 => format!("{:e}", source.any_number()),
        _ => format!("{}{}", source.pick(&ORDINARY), source.pick(UNITS)),
    }
}

/// A coordinate of a space. The points of its grid are few, or so many that they have to be refused.
pub(crate) fn axis(source: &mut Source) -> String {
    let (one, other) = (number(source), number(source));
    let counts = if source.careful || source.chance(90) { &["1", "2", "3", "4"] } else { HUGE.as_slice() };
    let points = *source.pick(counts);
    match source.below(100) {
        _ if source.has_grid => source.pick(&["0:9:3", "3:5:4", "1:2:2", &one]).to_string(),
        _ if source.careful => source.pick(&["0:1", "2:3", "normal:3:0.1", &one, &one]).to_string(),
        0..30 => one,
        30..50 => format!("{one}:{other}"),
        50..65 => format!("{one}:{other}:{points}"),
        65..75 => format!("normal:{one}:{other}"),
        75..80 => format!("normal:{one}:{other}:{points}"),
        80..85 => format!("{one}:{one}"),
        _ => source.pick(&["x", "y", "z", "0:1", "0:9:3", "2:3", "3:5:4", "normal:3:0.1"]).to_string(),
    }
}

/// Text or bytes that are no value of anything.
fn garbage(source: &mut Source) -> OsString {
    match source.below(4) {
        0 => {
            OsString::from_vec((0..source.below(9)).map(|_| [0xff, b'1', 0xc3, b',', 0x80][source.below(5)]).collect())
        }
        1 => source.pick(&["9", "a", "1,", "0:1:", "ω", "-", "("]).repeat(1 + source.below(20_000)).into(),
        2 => (0..source.below(20))
            .filter_map(|_| char::from_u32(1 + source.below(0x3000) as u32))
            .filter(|letter| *letter != '/')
            .collect::<String>()
            .into(),
        _ => format!("{}{}", source.pick(&GARBAGE), source.pick(&EXTREME)).into(),
    }
}
