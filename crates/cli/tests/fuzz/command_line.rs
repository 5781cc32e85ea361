//! Command lines from the definition of the program's options, so that a new command or option is covered as soon as it
//! exists.

use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::OsStrExt;

use clap::{Arg, ArgAction, Command};

use crate::files;
use crate::source::Source;
use crate::values::{Kind, kind, value, value_of};

/// The options without which a command has hardly any answer.
const CORE: &str = "rate speed time rate_x rate_y rate_z space scene want accuracy probability method";

/// Options that contradict each other in a toss. The program refuses them where it reads the toss, so that the definition of its
/// options does not know.
const CONTRADICTIONS: [&str; 5] =
    ["coin cylinder moments inertia", "rate turn", "rate psi", "speed time", "tilt attitude"];

fn contradict(one: &Arg, other: &Arg) -> bool {
    let has = |names: &str, of: &Arg| names.split(' ').any(|name| of.get_id() == name);
    CONTRADICTIONS.iter().any(|names| has(names, one) && has(names, other))
}

/// What is given to the program.
#[derive(Debug, Clone)]
pub(crate) struct Case {
    /// The arguments after the name of the program, an option together with its value.
    pub(crate) arguments: Vec<Vec<OsString>>,
    /// Names and contents of the files in the working folder.
    pub(crate) files: Vec<(String, Vec<u8>)>,
    /// What stands on standard input.
    pub(crate) input: Vec<u8>,
}

impl Case {
    /// The case with this number.
    pub(crate) fn new(program: &Command, number: u64) -> Self {
        let source = &mut Source::new(number);
        let commands: Vec<&Command> =
            program.get_subcommands().filter(|command| command.get_name() != "help").collect();
        let mut command = *source.pick(&commands);
        // Those that have hardly an option are soon covered.
        if command.get_arguments().count() < 4 && source.chance(75) {
            command = *source.pick(&commands);
        }
        let mut arguments = options(source, command);
        spoil(source, &mut arguments);
        let at = if source.careful || source.chance(98) { 0 } else { source.below(arguments.len() + 1) };
        arguments.insert(at, vec![command.get_name().into()]);
        let mut case = Self { arguments, files: Vec::new(), input: Vec::new() };
        let scene_wanted = case.flat().any(|argument| argument.as_bytes().starts_with(b"--scene"));
        let named = ["file.toml", "file.json", "part.json"].into_iter().filter(|name| case.names(name));
        case.files = named.map(|name| files::file(source, name, scene_wanted)).collect();
        if case.flat().any(|argument| argument == "-") {
            case.input = files::rows(source);
        }
        case
    }

    /// All arguments in their order.
    pub(crate) fn flat(&self) -> impl Iterator<Item = &OsString> {
        self.arguments.iter().flatten()
    }

    /// Whether the arguments ask for JSON.
    pub(crate) fn wants_json(&self) -> bool {
        let all: Vec<&OsString> = self.flat().collect();
        all.contains(&&"--format=json".into()) || all.windows(2).any(|pair| pair[0] == "--format" && pair[1] == "json")
    }

    /// The name of the command.
    pub(crate) fn command(&self) -> String {
        self.flat().next().map_or_else(String::new, |first| first.to_string_lossy().into_owned())
    }

    /// Whether an argument is `text`, as the value of an option too.
    pub(crate) fn names(&self, text: &str) -> bool {
        self.flat().any(|argument| argument == text || argument.as_bytes().ends_with(format!("={text}").as_bytes()))
    }

    /// The outputs that the arguments name by `--svg` and `--out`.
    pub(crate) fn outputs(&self) -> Vec<&OsStr> {
        let all: Vec<&OsString> = self.flat().collect();
        let apart =
            all.windows(2).filter(|pair| pair[0] == "--svg" || pair[0] == "--out").map(|pair| pair[1].as_os_str());
        let joined = all.iter().filter_map(|argument| {
            let argument = argument.as_bytes();
            argument.strip_prefix(b"--svg=").or_else(|| argument.strip_prefix(b"--out="))
        });
        apart.chain(joined.map(OsStr::from_bytes)).collect()
    }
}

/// Some options of `command`, each with a value. Most cases leave out what the definition says is in conflict.
fn options(source: &mut Source, command: &Command) -> Vec<Vec<OsString>> {
    let heedless = !source.careful && source.chance(10);
    let further = source.below(4);
    let mut given: Vec<&Arg> = Vec::new();
    let mut left = further;
    for argument in source.shuffled(command.get_arguments().collect()) {
        let in_conflict = |other: &&Arg| {
            command.get_arg_conflicts_with(argument).contains(other)
                || command.get_arg_conflicts_with(other).contains(&argument)
                || contradict(argument, other)
        };
        if matches!(argument.get_id().as_str(), "help" | "version") || (!heedless && given.iter().any(in_conflict)) {
            continue;
        }
        let percent = match argument.get_id().as_str() {
            "drag" | "bounce" if source.careful => 0,
            _ if argument.is_required_set() => 97,
            id if CORE.split(' ').any(|core| core == id) => 90 + 8 * usize::from(source.careful),
            // Without it, a command may take a number that is good for people and too slow for a hundred thousand cases.
            _ if kind(argument) == Kind::Count => 100,
            "format" => 60,
            _ if left > 0 => {
                left -= 1;
                60
            }
            _ => 2,
        };
        if source.chance(percent) {
            given.push(argument);
        }
    }
    let mut arguments: Vec<_> = given.into_iter().map(|argument| option(source, argument)).collect();
    if source.careful {
        leave_out_idle(command, &mut arguments);
    }
    keep_short(source, command, &mut arguments);
    arguments
}

/// Whether `option` is the one with this name.
fn gives(option: &[OsString], name: &str) -> bool {
    option[0].to_string_lossy().split('=').next() == Some(name)
}

/// Changes options with which a command rightly takes long.
fn keep_short(source: &mut Source, command: &Command, arguments: &mut Vec<Vec<OsString>>) {
    if command.get_name() == "toss" {
        // The margin of a body takes seconds.
        arguments.retain(|option| !gives(option, "--margin"));
    }
    let has = |name: &str| arguments.iter().any(|option| gives(option, name));
    let is_enclosure = |text: &OsString| text.to_string_lossy().ends_with("enclosure");
    let takes_enclosure = arguments.iter().any(|option| gives(option, "--method") && option.iter().any(is_enclosure));
    let (others, replacement): (&[&str], [&str; 2]) = match command.get_name() {
        // An integrator takes from 20 ms for each of these flights, which are long, and there are 25 for a point.
        "limit" if has("--solver") => (&["--points", "--formulation", "--scheme", "--tolerance"], ["--points", "1"]),
        // A plan and enclosure take as many launches as the accuracy needs.
        "probability" if !has("--method") || takes_enclosure => {
            let accuracy = *source.pick(&["1e-2", "1e-3", "0", "nan", "2"]);
            (&["--accuracy"], ["--accuracy", accuracy])
        }
        _ => return,
    };
    arguments.retain(|option| !others.iter().any(|name| gives(option, name)));
    arguments.push(replacement.map(OsString::from).to_vec());
}

/// Leaves out options that have no effect with others, and are refused for that.
fn leave_out_idle(command: &Command, arguments: &mut Vec<Vec<OsString>>) {
    let has = |option: &str, values: &[&str]| {
        arguments.iter().any(|given| {
            values
                .iter()
                .any(|value| *given == [option, value] || *given == [OsString::from(format!("{option}={value}"))])
        })
    };
    let plans = command.get_name() == "probability" && !arguments.iter().any(|option| gives(option, "--method"));
    let integrates = !plans && has("--solver", &["gamma", "euler", "quaternion"]);
    let idle = [
        (
            "--points",
            plans || has("--method", &["grid"]) || has("--want", &["outcome", "tilt", "attitude", "probability"]),
        ),
        ("--accuracy", command.get_name() == "probability" && !plans && !has("--method", &["enclosure"])),
        ("--seed", plans || has("--method", &["grid"])),
        ("--solver", plans),
        ("--space", has("--want", &["outcome", "tilt", "attitude", "trace"])),
        ("--step", !has("--scheme", &["rk4"])),
        ("--tolerance", !integrates || has("--scheme", &["rk4"])),
        ("--scheme", !integrates),
        ("--formulation", !has("--solver", &["gamma", "euler"])),
    ];
    arguments.retain(|given| !idle.iter().any(|(option, idle)| *idle && gives(given, option)));
}

/// An option, or a positional argument, with its value.
fn option(source: &mut Source, argument: &Arg) -> Vec<OsString> {
    let value = match argument.get_action() {
        ArgAction::Set | ArgAction::Append => Some(value_of(source, argument)),
        _ => None,
    };
    let names: Vec<&str> =
        argument.get_long().into_iter().chain(argument.get_all_aliases().unwrap_or_default()).collect();
    if names.is_empty() {
        return value.into_iter().collect();
    }
    let mut name = OsString::from(format!("--{}", source.pick(&names)));
    match value {
        Some(value) if source.chance(20) => {
            name.push("=");
            name.push(value);
            vec![name]
        }
        value => std::iter::once(name).chain(value).collect(),
    }
}

/// Repeats, drops or adds arguments in a few cases.
fn spoil(source: &mut Source, arguments: &mut Vec<Vec<OsString>>) {
    if arguments.is_empty() || source.careful || !source.chance(10) {
        return;
    }
    let at = source.below(arguments.len());
    match source.below(6) {
        0 => arguments.push(arguments[at].clone()),
        1 => arguments[at].truncate(1),
        2 => arguments.push(vec![source.pick(&["--help", "-h", "--version", "-V", "help"]).into()]),
        3 => arguments.insert(at, vec!["--".into()]),
        4 => arguments.push(vec![value(source, Kind::Number, &[])]),
        _ => arguments.push(vec!["--no-such-option".into(), "1".into()]),
    }
}
