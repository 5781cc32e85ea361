//! The command that repeats a worst case. A toss is repeated by the program that knows its solver: `unfair-toss` knows
//! those of this workspace, and only the suite that measured them knows others.

use std::path::Path;

use dynamics::Toss;

use super::case;
use super::subject::Subject;

/// What repeats a worst case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Replay {
    /// One toss by one solver.
    Toss {
        /// The toss as text, which the option `--replay` of a suite takes.
        input: String,
        /// The tolerance or the step of the solver, as a further field of that text; empty if it has none.
        settings: String,
        /// The command of `unfair-toss` with the solver and its settings, if it is a solver of this workspace.
        command: Option<String>,
        /// The row whose quantity is measured again, as `CHECK / SUBJECT`, if it is one of single tosses.
        row: Option<String>,
    },
    /// The whole check of this id, for a number that belongs to no toss.
    Check(String),
}

impl Replay {
    /// Repeats `toss` by the solver of `subject`.
    pub fn toss(toss: &Toss, subject: &Subject) -> Self {
        let (input, settings) = (case::text(toss), case::settings(subject));
        Self::Toss { input, settings, command: case::command(toss, subject), row: None }
    }

    /// Repeats the toss by the solver of `subject` too, with which the other was compared.
    #[must_use]
    pub fn beside(self, subject: &Subject) -> Self {
        let Self::Toss { input, settings, command: by_the_other, row } = self else { return self };
        let first = case::read(&input).ok().and_then(|toss| case::command(&toss, subject));
        let both = first.zip(by_the_other).map(|(first, then)| format!("{first} && {then}"));
        Self::Toss { input, settings, command: both, row }
    }

    /// The same, as the worst case of `row`, which gives the settings.
    #[must_use]
    pub fn in_row(self, row: String) -> Self {
        match self {
            Self::Toss { input, command, .. } => Self::Toss { input, settings: String::new(), command, row: Some(row) },
            whole @ Self::Check(_) => whole,
        }
    }
}

/// How the program of a suite is started from a shell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Commands {
    /// `cargo xtask verify` in this workspace.
    Workspace,
    /// A program with a suite of its own: everything before its arguments, such as `cargo run --release --`.
    Program(String),
    /// The same commands with these options at their end, which begin with a space.
    With(Box<Self>, String),
}

impl Commands {
    /// The command of the program that is running, as far as the place of its file tells: a binary or an example that
    /// cargo built, or any other file.
    pub fn of_this_program() -> Self {
        let path = std::env::current_exe().unwrap_or_default();
        Self::Program(of(&path))
    }

    /// How the program of the suite is started: everything before its arguments.
    pub fn program(&self) -> &str {
        match self {
            Self::Workspace => "cargo xtask verify",
            Self::Program(program) => program,
            Self::With(commands, _) => commands.program(),
        }
    }

    /// The command that does `replay`.
    pub fn line(&self, replay: &Replay) -> String {
        match (self, replay) {
            (Self::Workspace, Replay::Toss { command: Some(command), .. }) => command.clone(),
            (_, Replay::Toss { input, settings, row, .. }) => {
                self.with(&format!("--replay \"{input}{settings}\"{}", option(row)))
            }
            (_, Replay::Check(check)) => self.with(&format!("--only {check}")),
        }
    }

    /// The command that runs the checks and accepts what is better or new.
    pub fn bless(&self) -> String {
        self.with("--bless")
    }

    fn with(&self, arguments: &str) -> String {
        let options = if let Self::With(_, options) = self { options } else { "" };
        format!("{} {arguments}{options}", self.program())
    }
}

fn option(row: &Option<String>) -> String {
    row.as_ref().map(|row| format!(" --row \"{row}\"")).unwrap_or_default()
}

fn of(path: &Path) -> String {
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
            assert_eq!(of(Path::new(path)), command);
        }
    }

    #[test]
    fn only_the_workspaces_own_suite_repeats_a_toss_by_its_command_line() {
        let toss = crate::measure::adversary::launch(3, 0);
        let (replay, input) = (Replay::toss(&toss, &Subject::exact()), case::text(&toss));
        assert!(Commands::Workspace.line(&replay).starts_with("cargo run -q --release --bin unfair-toss -- toss "));
        let elsewhere = Commands::Program("checks".to_owned());
        assert_eq!(elsewhere.line(&replay), format!("checks --replay \"{input}\""));
        let of_row = format!("checks --replay \"{input}\" --row \"c / s\"");
        assert_eq!(elsewhere.line(&replay.clone().in_row("c / s".to_owned())), of_row);
        assert_eq!(elsewhere.line(&Replay::Check("c".to_owned())), "checks --only c");
        let settings = " tolerance=1e-6".to_owned();
        let foreign = Replay::Toss { input: input.clone(), settings, command: None, row: None };
        let with_settings = format!("cargo xtask verify --replay \"{input} tolerance=1e-6\"");
        assert_eq!(Commands::Workspace.line(&foreign), with_settings);
        let with = |commands| Commands::With(Box::new(commands), " --claim 1".to_owned());
        let line = format!("{with_settings} --claim 1");
        assert_eq!(with(Commands::Workspace).line(&foreign), line);
        assert_eq!(with(elsewhere.clone()).line(&Replay::Check("c".to_owned())), "checks --only c --claim 1");
        assert_eq!(with(elsewhere).bless(), "checks --bless --claim 1");
    }
}
