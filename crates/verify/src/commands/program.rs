//! The options that put a program in another language under the checks, in place of the solvers of the suite.

use std::path::Path;
use std::time::Duration;

use crate::measure::replay::Commands;
use crate::process::{Claim, Limits, Program};
use crate::shown::is_unseen;
use crate::suite::Suite;
use clap::Args;

/// The name of the program in rows.
const NAME: &str = "command";

/// A program, its claim and its limits.
#[derive(Debug, Args)]
pub(super) struct Foreign {
    /// Judge the program that the shell starts by this line, instead of solvers in Rust; see docs/your-solver.md
    #[arg(long, value_name = "LINE", value_parser = command_line)]
    command: Option<String>,
    /// Judge the program by this error of cos θ, instead of by the tolerance: 1e-9 at any toss, or 1e-12/rad, which is
    /// multiplied by 1 + φ for a phase φ
    #[arg(long, value_name = "ERROR", requires = "command", value_parser = str::parse::<Claim>)]
    claim: Option<Claim>,
    /// Ask the program for bodies with three moments, too; it is asked without this option if it answers bodies=yes
    #[arg(long, requires = "command")]
    bodies: bool,
    /// End the program if it takes longer for an answer; the first of a process may take six times as long [default:
    /// 10]
    #[arg(long, value_name = "S", requires = "command", value_parser = seconds)]
    answer_seconds: Option<Duration>,
    /// Ask the program no more after so much time for all answers [default: 1800]
    #[arg(long, value_name = "S", requires = "command", value_parser = seconds)]
    total_seconds: Option<Duration>,
    /// End the program if it uses more memory with its children; on Linux only [default: 2048]
    #[arg(long, value_name = "MB", requires = "command", value_parser = megabytes)]
    memory_mb: Option<u64>,
}

impl Foreign {
    /// Whether a program takes the place of the suite's solvers.
    pub(super) fn is_given(&self) -> bool {
        self.command.is_some()
    }

    /// The suite of the program, or `suite` without one. Its limits, baseline and records are in the folder that was
    /// `named`; without one, those of the program of this workspace are in a folder below `out`.
    pub(super) fn in_place_of(&self, suite: Suite, named: Option<&Path>, out: &Path) -> anyhow::Result<Suite> {
        let Some(program) = self.program() else { return Ok(suite) };
        let is_standard = *suite.commands() == Commands::of_this_workspace() && named.is_none();
        let folder = if is_standard { out.join(NAME) } else { suite.data().to_owned() };
        let commands = Commands { options: self.options(), ..suite.commands().clone() };
        Ok(Suite::of_program(program.running(NAME))?.folder(folder).repeated_by(commands))
    }

    /// The options that give the same program, for the command that repeats a row.
    fn options(&self) -> String {
        let quoted = |line: &String| format!(" --command {}", quoted(line));
        let seconds = |name: &str, value: Option<Duration>| {
            value.map(|value| format!(" --{name}-seconds {:?}", value.as_secs_f64())).unwrap_or_default()
        };
        [
            self.command.as_ref().map(quoted).unwrap_or_default(),
            self.claim.map(|claim| format!(" --claim {claim}")).unwrap_or_default(),
            if self.bodies { " --bodies".to_owned() } else { String::new() },
            seconds("answer", self.answer_seconds),
            seconds("total", self.total_seconds),
            self.memory_mb.map(|megabytes| format!(" --memory-mb {megabytes}")).unwrap_or_default(),
        ]
        .concat()
    }

    /// The program, if there is one.
    fn program(&self) -> Option<Program> {
        let command = self.command.as_ref()?;
        let usual = Limits::default();
        let limits = Limits {
            answer: self.answer_seconds.unwrap_or(usual.answer),
            total: self.total_seconds.unwrap_or(usual.total),
            memory: self.memory_mb.map_or(usual.memory, |megabytes| megabytes << 20),
        };
        Some(Program { claim: self.claim, takes_bodies: self.bodies, limits, ..Program::new(command) })
    }
}

/// A line for the shell that is not empty.
fn command_line(text: &str) -> Result<String, String> {
    if text.trim().is_empty() {
        Err("expected the line that starts the program".to_owned())
    } else {
        Ok(text.to_owned())
    }
}

/// A line as a word of the shell. With controls in it, such as an end of line, it is written as bash and zsh read it.
fn quoted(line: &str) -> String {
    if !line.chars().any(is_unseen) {
        return format!("'{}'", line.replace('\'', "'\\''"));
    }
    let escaped = |character: char| match character {
        '\\' | '\'' => format!("\\{character}"),
        seen if !is_unseen(seen) => seen.to_string(),
        unseen => format!("\\U{:08x}", u32::from(unseen)),
    };
    format!("$'{}'", line.chars().map(escaped).collect::<String>())
}

/// A time from a millisecond to a day.
fn seconds(text: &str) -> Result<Duration, String> {
    let valid = |seconds: &f64| (1e-3..=86_400.0).contains(seconds);
    let seconds = text.parse().ok().filter(valid).ok_or("expected 0.001 to 86400 s")?;
    Ok(Duration::from_secs_f64(seconds))
}

/// An amount of memory from a megabyte to a terabyte.
fn megabytes(text: &str) -> Result<u64, String> {
    if !cfg!(target_os = "linux") {
        return Err("memory is looked at on Linux only".to_owned());
    }
    text.parse().ok().filter(|megabytes| (1..=1 << 20).contains(megabytes)).ok_or("expected 1 to 1048576 MB".to_owned())
}
