//! `cargo xtask TASK`: tasks of the workspace.
//!
//! Exit codes are those of the task; 2 for an unknown task, 4 if it could not be built or started.

mod figures;
mod mutants;

use std::env;
use std::io::IsTerminal;
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use std::time::{Duration, Instant};

const USAGE: &str = "\
usage: cargo xtask TASK

tasks:
  verify [--quick | --deep] [--only ID] [--verbose] [--list] [--replay INPUT] [--bless] [--fit] [--format text|json|junit]
      run the verification suite, with one line per check and what fails in full; writes report.html, report.json, junit.xml and
      charts to target/verify
  bench [--instructions [--bless]]
      print what a toss costs, in ns and beside a reference in C; or count its instructions by valgrind and compare them with
      the baseline
  mutants [ARGUMENTS OF cargo mutants]
      change the numerical crates in some 4000 ways; each change has to fail a test or be explained in validation/mutants.md
  history
      draw the accuracy of the committed records over time
  figures [--check]
      draw the figures of docs/figures; or end with 1 if one of them is not current";

const COULD_NOT_RUN: u8 = 4;

fn main() -> ExitCode {
    let mut args = env::args().skip(1);
    match args.next().as_deref() {
        Some("verify") => verify("run", args),
        Some("bench") => verify("bench", args),
        Some("mutants") => mutants::run(args).unwrap_or_else(|message| could_not_run(&message)),
        Some("history") => verify("history", args),
        Some("figures") => figures::figures(args).unwrap_or_else(|message| could_not_run(&message)),
        Some("help" | "--help" | "-h") => {
            println!("{USAGE}");
            ExitCode::SUCCESS
        }
        Some(task) => usage_error(&format!("unknown task '{task}'")),
        None => usage_error("no task"),
    }
}

fn usage_error(message: &str) -> ExitCode {
    eprintln!("error: {message}\n\n{USAGE}");
    ExitCode::from(2)
}

fn could_not_run(message: &str) -> ExitCode {
    eprintln!("error: {message}");
    ExitCode::from(COULD_NOT_RUN)
}

/// The root of the workspace.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or(Path::new("."))
}

/// Builds `program` with optimisation and runs it in the root of the workspace; its arguments follow.
fn cargo(program: &str) -> Command {
    build(program);
    let mut command = Command::new(env::var_os("CARGO").unwrap_or("cargo".into()));
    command.args(["run", "--quiet", "--release", "--bin", program, "--"]).current_dir(root());
    command
}

/// Builds `program` so that whoever waits sees it: on a terminal cargo shows its progress, elsewhere there is a line a minute.
/// A build that fails is left to the `cargo run` that follows, which says why.
fn build(program: &str) {
    let on_terminal = std::io::stderr().is_terminal();
    let mut command = Command::new(env::var_os("CARGO").unwrap_or("cargo".into()));
    command
        .args(["build", "--release", "--bin", program])
        .args((!on_terminal).then_some("--quiet"))
        .current_dir(root());
    let started = Instant::now();
    let Ok(mut child) = command.stderr(if on_terminal { Stdio::inherit() } else { Stdio::null() }).spawn() else {
        return;
    };
    let mut minutes = 0;
    while matches!(child.try_wait(), Ok(None)) {
        std::thread::sleep(Duration::from_millis(50));
        if !on_terminal && started.elapsed().as_secs() / 60 > minutes {
            minutes += 1;
            eprintln!("building {program}, for {minutes} min so far");
        }
    }
}

/// Runs a command of the program `verify`.
fn verify(command: &str, args: impl Iterator<Item = String>) -> ExitCode {
    let status = cargo("verify").arg(command).args(args).status();
    match status.map(|status| status.code().and_then(|code| u8::try_from(code).ok())) {
        // The program's own codes; anything else is cargo failing to build it, a panic or a signal.
        Ok(Some(code @ 0..=COULD_NOT_RUN)) => ExitCode::from(code),
        Ok(_) => ExitCode::from(COULD_NOT_RUN),
        Err(error) => could_not_run(&format!("cannot start cargo: {error}")),
    }
}
