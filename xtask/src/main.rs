//! `cargo xtask TASK`: the tasks of the workspace, from the verification to the figures.
//!
//! This program is small so that it builds in moments and can show the build of the larger programs that do the work.
//!
//! Exit codes are those of the task; 2 for bad usage, 4 if the task could not be built or started.

mod affected;
mod contest;
mod figures;
mod fuzz;
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
    /// Run the verification suite; --help lists its options
    #[command(disable_help_flag = true)]
    Verify(verify::Passed),
    /// Print what a toss costs; --help lists the options
    #[command(disable_help_flag = true)]
    Bench(verify::Passed),
    /// Draw the accuracy of the committed records over time
    #[command(disable_help_flag = true)]
    History(verify::Passed),
    Figures(figures::Figures),
    Fuzz(fuzz::Fuzz),
    Contest(contest::Contest),
    Web(web::Web),
    #[command(hide = true)]
    Affected(affected::Affected),
}

fn main() -> ExitCode {
    let ended = match Task::try_parse() {
        Ok(Task::Verify(task)) => task.run(&[]),
        Ok(Task::Bench(task)) => task.run(&["bench"]),
        Ok(Task::History(task)) => task.run(&["history"]),
        Ok(Task::Figures(task)) => task.run(),
        Ok(Task::Fuzz(task)) => task.run(),
        Ok(Task::Contest(task)) => task.run(),
        Ok(Task::Web(task)) => task.run(),
        Ok(Task::Affected(_)) => affected::Affected::run(),
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

    /// The tasks of the program `verify`, which knows their options.
    const PASSED_ON: [&str; 3] = ["verify", "bench", "history"];

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
            let (name, is_passed_on) = (task.get_name(), PASSED_ON.contains(&task.get_name()));
            assert_eq!(error_of(&[name, "--help"]), (!is_passed_on).then_some(ErrorKind::DisplayHelp), "{name}");
            assert!(task.get_about().is_some(), "{name}");
        }
    }

    #[test]
    fn passes_the_options_of_verify_on_as_they_are() {
        // A worst input is one argument with spaces, and may begin with a minus sign.
        for line in [["--quick", "--replay", "rate_x=-0x1p0 tilt=0x0p+0"], ["--list", "--help", "--nonsense"]] {
            let words = [&["cargo xtask", "verify"], &line[..]].concat();
            let Ok(Task::Verify(passed)) = Task::try_parse_from(words) else { panic!("{line:?}") };
            assert_eq!(passed.arguments, line);
        }
    }

    #[test]
    fn refuses_flags_that_would_have_no_effect_together() {
        for line in [
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
        for task in ["figures", "fuzz", "contest", "web"] {
            assert_eq!(error_of(&[task, "--nonsense"]), Some(ErrorKind::UnknownArgument), "{task}");
        }
    }
}
