//! Builds a program of the workspace and runs it, so that someone who waits sees the build.
//!
//! On a terminal cargo shows its own progress; elsewhere, in CI's log, there is a line a minute.

use std::env;
use std::io::IsTerminal;
use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

use crate::{COULD_NOT_RUN, output, root};

/// Builds `program` with optimisation and returns the command that runs it in the root of the workspace; the program's
/// arguments are to be added.
pub(crate) fn built(program: &str) -> Command {
    built_of(None, program)
}

/// As [`built`], of the package with this `manifest` instead of the workspace.
fn built_of(manifest: Option<&str>, program: &str) -> Command {
    build(manifest, program);
    let mut command = cargo();
    command.args(["run", "--quiet", "--release", "--bin", program]).args(of(manifest)).arg("--");
    command
}

/// The arguments that choose a package outside the workspace.
fn of(manifest: Option<&str>) -> impl Iterator<Item = &str> {
    manifest.into_iter().flat_map(|manifest| ["--manifest-path", manifest])
}

/// Runs `program` with `arguments`; its exit code, or 4 if it could not be built, panicked or was killed.
///
/// # Errors
/// If cargo cannot be started.
pub(crate) fn run(program: &str, arguments: &[String]) -> Result<ExitCode, String> {
    run_of(None, program, arguments)
}

/// As [`run`], of the package with this `manifest` instead of the workspace.
pub(crate) fn run_of(manifest: Option<&str>, program: &str, arguments: &[String]) -> Result<ExitCode, String> {
    let status =
        built_of(manifest, program).args(arguments).status().map_err(|error| format!("cannot start cargo: {error}"))?;
    // The codes above 4 are cargo's for a failed build, and Rust's for a panic.
    let code = status.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(COULD_NOT_RUN);
    Ok(ExitCode::from(code.min(COULD_NOT_RUN)))
}

/// Cargo, in the root of the workspace.
pub(crate) fn cargo() -> Command {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or("cargo".into()));
    command.current_dir(root());
    command
}

/// Builds `program` with visible progress. The result is ignored: after a failed build the `cargo run` that follows fails
/// in the same way, and prints why.
fn build(manifest: Option<&str>, program: &str) {
    let on_terminal = std::io::stderr().is_terminal();
    let mut command = cargo();
    command.args(["build", "--release", "--bin", program]).args(of(manifest)).args((!on_terminal).then_some("--quiet"));
    let started = Instant::now();
    let Ok(mut child) = command.stderr(if on_terminal { Stdio::inherit() } else { Stdio::null() }).spawn() else {
        return;
    };
    let mut minutes = 0;
    while matches!(child.try_wait(), Ok(None)) {
        std::thread::sleep(Duration::from_millis(50));
        if !on_terminal && started.elapsed().as_secs() / 60 > minutes {
            minutes += 1;
            output::say(format_args!("building {program}, for {minutes} min so far"));
        }
    }
}
