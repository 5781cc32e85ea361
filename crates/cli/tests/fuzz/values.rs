//! Values for options: valid ones of each kind, extreme numbers, and texts that are no value at all.

use std::ffi::OsString;
use std::os::unix::ffi::OsStringExt;

use clap::Arg;

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
        _ if argument.get_id() == "svg" => Kind::Output,
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

/// Numbers that many quantities may have.
const ORDINARY: &[&str] = &[
    "1",
    "2",
    "0.5",
    "0.3",
    "0.7",
    "0.95",
    "2.5",
    "3",
    "4",
    "9.81",
    "30",
    "1e-3",
    "1.5707963267948966",
    "0",
    "-1",
    "-2.5",
    "1e-6",
    "1e-9",
];

/// Numbers at the ends of what numbers can be, and some that are none.
pub(crate) const EXTREME: &[&str] = &[
    "-0",
    "-0.0",
    "5e-324",
    "-5e-324",
    "1e-308",
    "1e-300",
    "1e-16",
    "1e16",
    "1e100",
    "1e300",
    "-1e300",
    "1e308",
    "1.797e308",
    "-1.797e308",
    "1e999",
    "-1e999",
    "inf",
    "-inf",
    "infinity",
    "nan",
    "-nan",
    "9007199254740993",
    "18446744073709551616",
    "340282366920938463463374607431768211456",
    "00000000000000000000000001",
    ".5",
    "5.",
    "+3",
    "1_000",
    "0x10",
    "1e",
    "1e-999",
    "1e99999999999999999999",
];

/// Counts that are quickly computed.
const SMALL: &[&str] = &["1", "2", "3", "8", "16"];

/// Counts that are none, too small, or so large that they have to be refused.
const HUGE: &[&str] = &[
    "0",
    "-1",
    "9007199254740993",
    "9223372036854775807",
    "9223372036854775808",
    "18446744073709551615",
    "18446744073709551616",
    "99999999999999999999999999",
    "1e3",
    "1.5",
    "100000000000000",
];

const UNITS: &[&str] = &[
    "deg", "°", "rad", "turn", "rev", "rev/s", "rpm", "rad/s", "deg/s", "m/s", "km/h", "m", "mm", "cm", "g", "kg", "s",
    "ms", "min", "m/s²", "m/s^2", "kg·m²", "kg m²", "g·cm²", "%", "furlong", "M", "µs", " m/s", "/s", "°C",
];

const NAMES: &[&str] = &[
    "paper",
    "us-quarter",
    "disc",
    "rod",
    "sphere",
    "exact",
    "gamma",
    "euler",
    "quaternion",
    "dop853",
    "dopri5",
    "rk4",
    "taylor",
    "momentum",
    "vertical",
    "raw",
    "cheated",
    "tails",
    "rate_x",
    "rate_y",
    "rate_z",
    "speed",
    "gravity",
    "tilt",
    "toss",
    "map",
    "Exact",
    "rk",
    "rate-x",
];

const GARBAGE: &[&str] = &[
    "",
    " ",
    ",",
    ",,",
    ":",
    "::",
    "1,,2",
    "1:",
    ":1",
    "1:2:3:4",
    "normal:",
    "normal:1",
    "normal:1:2:3:4",
    "-",
    "--",
    "---",
    "--rate",
    "--format",
    "-h",
    "=",
    "a=b",
    "é",
    "ω",
    "日本語",
    "🪙",
    "\u{202e}right",
    "\u{7f}",
    "\u{1b}[31mred",
    "\t",
    "\n",
    "a\r\nb",
    "{}",
    "{0}",
    "%s%n",
    "$HOME",
    "'",
    "\"",
    "\\",
    "<svg>",
    "&amp;",
    "x",
    "y",
    "z",
    "null",
    "true",
    "[1,2,3]",
    "1 2 3",
    "1;2;3",
    "NaN,NaN,NaN",
    "\u{feff}1",
    "１",
    "−1",
];

/// Outputs in the working folder, and some that can't be written.
const OUTPUTS: &[&str] = &[
    "chart.svg",
    "chart.svg",
    "chart.svg",
    "ω.svg",
    "a b",
    ".hidden",
    "-",
    "",
    ".",
    "missing/chart.svg",
    "line\nbreak.svg",
    "chart.svg/inner",
    "./chart.svg",
];

/// Values of options that accept few. An option that is not here has values of its kind.
const FITTING: &[(&str, &[&str])] = &[
    ("up_to", &["8", "9"]),
    ("coin", &["paper", "us-quarter", "disc"]),
    ("solver", &["exact", "exact", "gamma", "euler", "quaternion"]),
    ("scheme", &["dop853", "dopri5", "rk4", "taylor"]),
    ("formulation", &["momentum", "vertical", "raw"]),
    ("across", &["rate_x", "rate_y", "speed", "tilt"]),
    ("up", &["rate_z", "rate_z", "speed", "gravity"]),
    ("tolerance", &["1e-6", "1e-9", "1e-12"]),
    ("step", &["1e-2", "1e-3"]),
    ("accuracy", &["1e-2", "1e-3", "1e-6", "1e-9"]),
    ("probability", &["0.6", "0.95", "0.75", "1"]),
    ("heads", &["0.6", "0.95", "0.5"]),
    ("wobble", &["15deg", "0.3", "1"]),
    ("turn", &["38rev/s", "20", "3"]),
    ("drop", &["0", "1", "24mm", "-0.1"]),
    ("command", &["toss", "map", "sample", "man"]),
    ("reference", &["0", "0.5", "1"]),
    ("gravity", &["9.81", "1.62", "1", "0.5"]),
];

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
        80..86 => source.pick(EXTREME).to_string().into(),
        86..90 => {
            let other = *source.pick(&[Kind::Name, Kind::Count, Kind::List(3), Kind::Axis, Kind::Number]);
            valid(source, other, listed).into()
        }
        _ if kind == Kind::Output => source.pick(OUTPUTS).to_string().into(),
        90..97 => source.pick(GARBAGE).to_string().into(),
        _ => garbage(source),
    }
}

/// A value that an option of `kind` would often accept.
fn valid(source: &mut Source, kind: Kind, listed: &[String]) -> String {
    match kind {
        Kind::Listed if !listed.is_empty() => source.pick(listed).clone(),
        Kind::Listed | Kind::Name => source.pick(NAMES).to_string(),
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
            let outputs = if source.careful { &OUTPUTS[..6] } else { OUTPUTS };
            source.pick(outputs).to_string()
        }
        Kind::Number => number(source),
    }
}

fn count(source: &mut Source) -> String {
    let counts = if source.careful || source.chance(85) { SMALL } else { HUGE };
    source.pick(counts).to_string()
}

/// A number, here and there extreme or with a unit.
pub(crate) fn number(source: &mut Source) -> String {
    match source.below(100) {
        _ if source.careful => source.pick(&ORDINARY[..13]).to_string(),
        0..60 => source.pick(ORDINARY).to_string(),
        60..85 => format!("{:.3}", 4.0 * source.fraction()),
        85..90 => source.pick(EXTREME).to_string(),
        90..92 => format!("{:e}", source.any_number()),
        _ => format!("{}{}", source.pick(ORDINARY), source.pick(UNITS)),
    }
}

/// A coordinate of a space. The points of its grid are few, or so many that they have to be refused.
pub(crate) fn axis(source: &mut Source) -> String {
    let (one, other) = (number(source), number(source));
    let counts = if source.careful || source.chance(90) { &["1", "2", "3", "4"] } else { HUGE };
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
        _ => format!("{}{}", source.pick(GARBAGE), source.pick(EXTREME)).into(),
    }
}
