//! The command that repeats a worst case: the program of the suite that measured it, because only it knows the solvers.

use std::path::Path;

use dynamics::Toss;
use serde::{Deserialize, Serialize};

use super::case;
use super::subject::Subject;
use crate::shown::shown;

/// What repeats the toss of a worst case.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Replay {
    /// The toss as text, which the option `--replay` of a suite takes.
    pub input: String,
    /// The tolerance or the step of the solver, as a further field of that text; empty if it has none.
    pub settings: String,
    /// The row whose quantity is measured again, as `CHECK / SUBJECT`, if it is one of single tosses.
    pub row: Option<String>,
}

impl Replay {
    /// Repeats `toss` by the solver of `subject`.
    pub fn new(toss: &Toss, subject: &Subject) -> Self {
        Self { input: case::text(toss), settings: case::settings(subject), row: None }
    }

    /// The same, as the worst case of `row`, which gives the settings.
    #[must_use]
    pub fn in_row(self, row: String) -> Self {
        Self { settings: String::new(), row: Some(row), ..self }
    }
}

/// How the program of a suite is started from a shell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Commands {
    /// Everything before its arguments, such as `cargo run --release --`.
    pub program: String,
    /// Options at the end of each command, which begin with a space; empty if there are none.
    pub options: String,
}

impl Commands {
    /// The commands of `program`, without further options.
    pub fn of(program: &str) -> Self {
        Self { program: program.to_owned(), options: String::new() }
    }

    /// `cargo xtask verify` in this workspace.
    pub fn of_this_workspace() -> Self {
        Self::of("cargo xtask verify")
    }

    /// The command of the program that is running, as far as the place of its file tells: a binary or an example that
    /// cargo built, or any other file.
    pub fn of_this_program() -> Self {
        Self::of(&by_place(&std::env::current_exe().unwrap_or_default()))
    }

    /// The command that does `replay`.
    pub fn line(&self, Replay { input, settings, row }: &Replay) -> String {
        let row = row.as_ref().map(|row| format!(" --row \"{row}\"")).unwrap_or_default();
        self.with(&format!("--replay \"{input}{settings}\"{row}"))
    }

    /// The command that runs the whole check of this id.
    pub fn check(&self, id: &str) -> String {
        self.with(&format!("--only {id}"))
    }

    /// The command that runs the checks and accepts what is better or new.
    pub fn bless(&self) -> String {
        self.with("--bless")
    }

    fn with(&self, arguments: &str) -> String {
        shown(&format!("{} {arguments}{}", self.program, self.options))
    }
}

fn by_place(path: &Path) -> String {
    let name = |path: &Path| path.file_stem().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let folders: Vec<String> = path.ancestors().skip(1).take(2).map(name).collect();
    match folders.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["release", _] => format!("cargo run --release --bin {} --", name(path)),
        ["debug", _] => format!("cargo run --bin {} --", name(path)),
        ["examples", "release"] => format!("cargo run --release --example {} --", name(path)),
        ["examples", "debug"] => format!("cargo run --example {} --", name(path)),
        _ => path.display().to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_of_a_program_tells_its_command() {
        for (path, command) in [
            ("/mine/target/release/checks", "cargo run --release --bin checks --"),
            ("/mine/target/debug/checks", "cargo run --bin checks --"),
            ("/mine/target/release/examples/own", "cargo run --release --example own --"),
            ("/usr/bin/checks", "/usr/bin/checks"),
        ] {
            assert_eq!(by_place(Path::new(path)), command);
        }
    }

    #[test]
    fn a_toss_is_repeated_in_its_row_or_with_its_settings_and_a_figure_by_its_check() {
        let toss = crate::measure::adversary::launch(3, 0);
        let input = case::text(&toss);
        let own = Commands::of("checks");
        let by_exact = Replay::new(&toss, &Subject::exact());
        assert_eq!(own.line(&by_exact), format!("checks --replay \"{input}\""));
        assert_eq!(own.check("c"), "checks --only c");
        let settings = " tolerance=1e-6".to_owned();
        let replay = Replay { input: input.clone(), settings, row: None };
        let with = Commands { options: " --claim 1".to_owned(), ..Commands::of_this_workspace() };
        let line = format!("cargo xtask verify --replay \"{input} tolerance=1e-6\" --claim 1");
        assert_eq!(with.line(&replay), line);
        let line = format!("cargo xtask verify --replay \"{input}\" --row \"c / s\" --claim 1");
        assert_eq!(with.line(&replay.in_row("c / s".to_owned())), line);
        assert_eq!(with.bless(), "cargo xtask verify --bless --claim 1");
    }
}
