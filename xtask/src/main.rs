//! `cargo xtask TASK`: the tasks of the workspace, from the verification to the figures.
//!
//! This program is small so that it builds in moments and can show the build of the larger programs that do the work.
//!
//! Exit codes are those of the task; 2 for bad usage, 4 if the task could not be built or started.

mod contest;
mod figures;
mod fuzz;
mod mutants;
mod output;
mod program;
mod verify;
mod web;

use std::path::Path;
use std::process::ExitCode;

use clap::Parser;

/// Arguments that are not understood.
const BAD_USAGE: u8 = 2;

/// What could not be built or started.
const COULD_NOT_RUN: u8 = 4;

/// The tasks of the workspace
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
enum Task {
    Verify(verify::Verify),
    Bench(verify::Bench),
    History(verify::History),
    Figures(figures::Figures),
    Fuzz(fuzz::Fuzz),
    Contest(contest::Contest),
    Mutants(mutants::Mutants),
    Web(web::Web),
}

fn main() -> ExitCode {
    let ended = match Task::try_parse() {
        Ok(Task::Verify(task)) => task.run(),
        Ok(Task::Bench(task)) => task.run(),
        Ok(Task::History(task)) => task.run(),
        Ok(Task::Figures(task)) => task.run(),
        Ok(Task::Fuzz(task)) => task.run(),
        Ok(Task::Contest(task)) => task.run(),
        Ok(Task::Mutants(task)) => task.run(),
        Ok(Task::Web(task)) => task.run(),
        Err(asked) if !asked.use_stderr() => output::printed(asked.print()).map(|()| ExitCode::SUCCESS),
        // Without a standard error there is nobody to say it to.
        Err(error) => {
            let _ = error.print();
            Ok(ExitCode::from(BAD_USAGE))
        }
    };
    ended.unwrap_or_else(|message| {
        output::say(format_args!("error: {message}"));
        ExitCode::from(COULD_NOT_RUN)
    })
}

/// The root of the workspace.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;
    use clap::error::ErrorKind;

    use super::*;

    fn error_of(arguments: &[&str]) -> Option<ErrorKind> {
        Task::try_parse_from([&["cargo xtask"], arguments].concat()).err().map(|error| error.kind())
    }

    #[test]
    fn the_definition_of_the_flags_is_consistent() {
        Task::command().debug_assert();
    }

    #[test]
    fn each_task_has_a_help_of_its_own() {
        for task in Task::command().get_subcommands() {
            assert_eq!(error_of(&[task.get_name(), "--help"]), Some(ErrorKind::DisplayHelp), "{}", task.get_name());
            assert!(task.get_about().is_some(), "{}", task.get_name());
        }
    }

    #[test]
    fn refuses_flags_that_would_have_no_effect_together() {
        for line in [
            "verify --quick --deep",
            "verify --list --quick",
            "verify --list --format json",
            "verify --replay INPUT --verbose",
            "verify --format json --verbose",
            "verify --only a --bless",
            "bench --bless",
            "verify --claim 1e-9",
            "verify --list --command a",
            "bench --instructions --to 1e-6",
            "contest --quick --bless",
            "contest --check --quick",
            "contest --draw --bless",
            "fuzz --input FILE",
            "fuzz space --input FILE --seconds 9",
        ] {
            let arguments: Vec<&str> = line.split(' ').collect();
            let error = error_of(&arguments);
            let refused = [Some(ErrorKind::ArgumentConflict), Some(ErrorKind::MissingRequiredArgument)];
            assert!(refused.contains(&error), "{line}: {error:?}");
        }
    }

    #[test]
    fn refuses_unknown_tasks_and_flags() {
        assert_eq!(error_of(&["nonsense"]), Some(ErrorKind::InvalidSubcommand));
        for task in ["verify", "bench", "history", "figures", "fuzz", "contest", "web"] {
            assert_eq!(error_of(&[task, "--nonsense"]), Some(ErrorKind::UnknownArgument), "{task}");
        }
    }
}
