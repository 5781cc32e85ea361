//! Command lines that are nearly right: one that is answered, of [`BASES`] or of the recorded answers, of which options and
//! values are changed. Options come from the definition of the program, so that a new one is covered as soon as it exists.

use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::{OsStrExt, OsStringExt};
use std::sync::LazyLock;

use clap::Command;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;

use crate::lines::{BASES, ROWS, VALUES, write_files};

/// Numbers at the ends of what numbers can be, some that are none, and ordinary ones with a unit.
const NUMBERS: &str = "0 -1 1 2.5 7 1e-3 1e-9 -0 -0.0 5e-324 -5e-324 1e-300 1e-16 1e16 1e300 -1e300 1.797e308 -1.797e308 1e999 -1e999 \
    inf -inf nan -nan 9007199254740993 18446744073709551616 340282366920938463463374607431768211456 000000000001 .5 5. +3 1_000 \
    0x10 1e 1e-999 1e99999999999999999999 15deg 38rev/s 600rpm 3m/s 24mm 5g 0.4s 30% 3furlong 2M 1m/s² 1.2g·cm²";

/// Texts that are the value of hardly an option.
const TEXTS: &str = "¦ ¦,¦,,¦:¦::¦1,,2¦1:¦:1¦1:2:3:4¦normal:¦normal:1¦normal:1:2:3:4¦normal:3:0.1¦0:1¦3:5:4¦0:9:100000000000000¦-¦--¦---¦\
    --rate¦--format¦-h¦=¦a=b¦é¦日本語¦🪙¦\u{202e}right¦\u{7f}¦\u{1b}[31mred¦\t¦\n¦a\r\nb¦{}¦%s%n¦$HOME¦'¦\"¦\\¦<svg>¦&amp;¦x¦y¦z¦null¦\
    [1,2,3]¦1 2 3¦1;2;3¦NaN,NaN,NaN¦1,2¦1,2,3,4¦0.6¦1¦\u{feff}1¦１¦−1¦Exact¦rk¦rate-x¦.¦a b¦.hidden¦missing/chart.svg¦chart.svg/inner¦\
    line\nbreak.svg¦missing.toml¦scene.json";

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
    /// The case with this number, which can be made again alone.
    pub(crate) fn new(program: &Command, number: u64) -> Self {
        let mut source = Source(ChaCha8Rng::seed_from_u64(number));
        let mut line = source.pick(&LINES).clone();
        if source.chance(30) {
            // Some commands have few lines.
            let commands: Vec<&str> = program.get_subcommands().map(Command::get_name).collect();
            let of_one = *source.pick(&commands);
            let lines: Vec<_> = LINES.iter().filter(|line| line[0] == of_one).collect();
            line = if lines.is_empty() { vec![of_one.to_owned()] } else { (*source.pick(&lines)).clone() };
        }
        let command = program.find_subcommand(&line[0]).expect("the lines are of its commands");
        let mut case = Self { arguments: grouped(line), files: Vec::new(), input: Vec::new() };
        let changes = *source.pick(&[0, 1, 1, 1, 2, 2, 3, 6]);
        for _ in 0..changes {
            source.change(command, &mut case.arguments);
        }
        if source.chance(50) && !case.gives("--format") {
            case.arguments.push(["--format", "json"].map(OsString::from).to_vec());
        }
        // No case takes long, whatever it asks for.
        if command.get_arguments().any(|option| option.get_id() == "seconds") && !case.gives("--seconds") {
            case.arguments.push(["--seconds", "0.5"].map(OsString::from).to_vec());
        }
        if case.names("-") {
            case.input = ROWS.into();
        }
        let named = FILES.iter().filter(|(name, _)| case.names(&format!("./{name}")) || case.names(name));
        case.files = named.map(|(name, content)| (name.clone(), content.clone())).collect();
        for content in case.files.iter_mut().map(|(_, content)| content).chain([&mut case.input]) {
            if source.chance(20) {
                source.damage(content);
            }
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

    /// Whether an option is given.
    fn gives(&self, option: &str) -> bool {
        self.arguments.iter().any(|given| name(given) == option)
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

/// The command lines that cases begin with, in words.
static LINES: LazyLock<Vec<Vec<String>>> = LazyLock::new(|| {
    let recorded = include_str!("../answers.jsonl").lines().map(|answer| {
        let answer: Value = serde_json::from_str(answer).expect("JSON");
        answer["line"].as_str().expect("a command line").to_owned()
    });
    let of_shells = ["completions bash", "man", "man toss"].map(str::to_owned);
    let lines = BASES.iter().map(|line| line.replace("{}", ".")).chain(of_shells).chain(recorded);
    lines.map(|line| line.split_whitespace().map(str::to_owned).collect()).collect()
});

/// The files that they name.
static FILES: LazyLock<BTreeMap<String, Vec<u8>>> = LazyLock::new(|| {
    let folder = tempfile::tempdir().expect("a temporary folder");
    write_files(folder.path());
    let files = std::fs::read_dir(folder.path()).expect("the folder is there").map(|file| file.expect("a file"));
    files
        .map(|file| (file.file_name().into_string().expect("text"), std::fs::read(file.path()).expect("a file")))
        .collect()
});

/// Words, each option together with its values.
fn grouped(words: Vec<String>) -> Vec<Vec<OsString>> {
    let mut groups: Vec<Vec<OsString>> = Vec::new();
    for word in words {
        match groups.last_mut() {
            Some(last) if !word.starts_with("--") && last[0].as_bytes().starts_with(b"--") => last.push(word.into()),
            _ => groups.push(vec![word.into()]),
        }
    }
    groups
}

/// The name of a given option.
fn name(given: &[OsString]) -> &str {
    given[0].to_str().unwrap_or_default().split('=').next().unwrap_or_default()
}

/// The source of random choices of a case.
struct Source(ChaCha8Rng);

impl Source {
    /// A whole number below `end`.
    fn below(&mut self, end: usize) -> usize {
        self.0.random_range(0..end)
    }

    /// True in `percent` of 100 cases.
    fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    /// One of `choices`.
    fn pick<'a, T>(&mut self, choices: &'a [T]) -> &'a T {
        &choices[self.below(choices.len())]
    }

    /// Changes an option, or adds, drops or repeats one.
    fn change(&mut self, command: &Command, arguments: &mut Vec<Vec<OsString>>) {
        let at = self.below(arguments.len());
        match self.below(20) {
            0..8 => self.set(command, arguments),
            8..13 => {
                if let Some(value) = arguments[at].get_mut(1) {
                    *value = self.other_number(&value.to_string_lossy()).into();
                }
            }
            13..15 => {
                if let Some(value) = arguments[at].get_mut(1) {
                    *value = self.text();
                }
            }
            15 => _ = arguments.remove(at),
            16 => arguments.push(arguments[at].clone()),
            17 => arguments[at].truncate(1),
            18 => arguments[at] = vec![arguments[at].join(OsStr::new("="))],
            _ => {
                let more = *self.pick(&["--help", "-h", "--version", "help", "--", "--no-such-option", "1", "--pr"]);
                arguments.insert(at, vec![more.into()]);
            }
        }
        if arguments.is_empty() {
            arguments.push(vec![command.get_name().into()]);
        }
    }

    /// Gives an option of `command` a value, in place of the one that it has.
    fn set(&mut self, command: &Command, arguments: &mut Vec<Vec<OsString>>) {
        let options: Vec<_> = command.get_arguments().filter(|option| option.get_id() != "help").collect();
        let Some(option) = (!options.is_empty()).then(|| *self.pick(&options)) else { return };
        let Some(long) = option.get_long() else { return };
        let long = format!("--{}", self.pick(&[&[long], &*option.get_all_aliases().unwrap_or_default()].concat()));
        let values = VALUES.iter().find(|(id, _)| option.get_id() == id).map_or(&["1"][..], |(_, values)| values);
        let value = self.pick(values).replace("{}", ".");
        arguments.retain(|given| name(given) != long);
        let value = (!value.is_empty()).then(|| value.into());
        arguments.push(std::iter::once(long.into()).chain(value).collect());
    }

    /// `text` with another number in the place of one that it has, or else in its place.
    fn other_number(&mut self, text: &str) -> String {
        let numbers: Vec<&str> = NUMBERS.split(' ').filter(|number| !number.is_empty()).collect();
        let number = *self.pick(&numbers);
        let places: Vec<usize> = (0..text.len()).filter(|at| is_start_of_number(text, *at)).collect();
        if places.is_empty() {
            return number.to_owned();
        }
        let start = *self.pick(&places);
        let length = text[start..].find(|letter: char| !letter.is_ascii_digit() && !".e-".contains(letter));
        let end = length.map_or(text.len(), |length| start + length.max(1));
        format!("{}{number}{}", &text[..start], &text[end..])
    }

    /// A text that is hardly a value.
    fn text(&mut self) -> OsString {
        let texts: Vec<&str> = TEXTS.split('¦').collect();
        let text = *self.pick(&texts);
        match self.below(10) {
            0 => OsString::from_vec((0..self.below(9)).map(|_| *self.pick(b"\xff1\xc3,\x80")).collect()),
            1 => text.repeat(1 + self.below(9_000)).into(),
            _ => text.into(),
        }
    }

    /// Replaces a number of a file, cuts the file, or puts something into it that does not belong there.
    fn damage(&mut self, content: &mut Vec<u8>) {
        let at = self.below(content.len() + 1);
        let more: Vec<u8> = match self.below(12) {
            0 => return content.truncate(at),
            1 => self.text().into_vec(),
            2 => vec![0],
            3 => vec![0xff, 0xfe],
            4 => "[".repeat(1 + self.below(20_000)).into(),
            5 => "9".repeat(1 << self.below(18)).into(),
            6 => "\r\n".into(),
            _ => {
                *content = self.other_number(&String::from_utf8_lossy(content)).into();
                return;
            }
        };
        content.splice(at..at, more);
    }
}

/// Whether a number begins at this byte.
fn is_start_of_number(text: &str, at: usize) -> bool {
    let bytes = text.as_bytes();
    bytes[at].is_ascii_digit() && (at == 0 || !bytes[at - 1].is_ascii_alphanumeric() && bytes[at - 1] != b'.')
}
