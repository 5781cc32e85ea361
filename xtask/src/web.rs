//! `cargo xtask web`: builds the page that throws a coin in the browser. The library becomes WebAssembly, and npm brings
//! what draws; both are outside the workspace.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use clap::Args;

use crate::program::cargo;
use crate::{output, root};

/// Build the page that throws a coin in the browser, in target/web
///
/// Open target/web/index.html, or put the folder on any static server. It needs the target wasm32-unknown-unknown, which it
/// adds by rustup, and Node.js 20 with npm.
#[derive(Debug, Args)]
pub(crate) struct Web {
    /// Open the page in the browser
    #[arg(long)]
    open: bool,
}

const TARGET: &str = "wasm32-unknown-unknown";

impl Web {
    pub(crate) fn run(&self) -> Result<ExitCode, String> {
        let web = root().join("web");
        let page = root().join("target/web");
        require_target()?;
        let library = build_library()?;
        install(&web)?;
        succeed(Command::new("node").current_dir(&web).arg("build.mjs").arg(library).arg(&page), NODE)?;
        let index = page.join("index.html");
        output::say(format_args!("open {}", index.display()));
        if self.open {
            open(&index)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

const NODE: &str = "the page needs Node.js 20 or later with npm (https://nodejs.org)";

/// Adds the standard library of Rust for the browser, if it is not there.
fn require_target() -> Result<(), String> {
    let printed = Command::new("rustc").args(["--print", "target-libdir", "--target", TARGET]).output();
    let folder = printed.map(|printed| PathBuf::from(String::from_utf8_lossy(&printed.stdout).trim()));
    let is_there =
        folder.ok().and_then(|folder| folder.read_dir().ok()).is_some_and(|mut files| files.next().is_some());
    let needed = format!("the page needs Rust's standard library for {TARGET}: `rustup target add {TARGET}`");
    if is_there { Ok(()) } else { succeed(Command::new("rustup").args(["target", "add", TARGET]), &needed) }
}

/// Builds the library, and gives its file.
fn build_library() -> Result<PathBuf, String> {
    let folder = root().join("target/web-build");
    let mut command = cargo();
    command.args(["build", "--locked", "--package", "web", "--profile", "page", "--target", TARGET]);
    succeed(command.arg("--target-dir").arg(&folder), "the library was not built")?;
    Ok(folder.join(TARGET).join("page/web.wasm"))
}

/// Installs what npm's lock file names, unless that was done since it changed.
fn install(web: &Path) -> Result<(), String> {
    let changed = |file: &str| web.join(file).metadata().and_then(|file| file.modified()).ok();
    if changed("node_modules/.package-lock.json") > changed("package-lock.json") {
        return Ok(());
    }
    let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
    succeed(Command::new(npm).current_dir(web).args(["ci", "--no-audit", "--no-fund"]), NODE)
}

fn open(page: &Path) -> Result<(), String> {
    let (program, arguments): (&str, &[&str]) = match std::env::consts::OS {
        "macos" => ("open", &[]),
        "windows" => ("cmd", &["/c", "start", ""]),
        _ => ("xdg-open", &[]),
    };
    succeed(Command::new(program).args(arguments).arg(page), "the page is built, but no browser could be started")
}

/// Runs a command; if it fails or can't be started, the error says what was `needed`.
fn succeed(command: &mut Command, needed: &str) -> Result<(), String> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => Err(needed.to_owned()),
        Err(error) => Err(format!("{needed}; {} can't be started: {error}", command.get_program().display())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_that_is_missing_or_fails_is_reported_with_what_was_needed() {
        let missing = succeed(&mut Command::new("no-such-program"), NODE).unwrap_err();
        assert!(missing.starts_with(NODE) && missing.contains("no-such-program"), "{missing}");
        let failed = succeed(Command::new("rustc").arg("--no-such-flag"), "a flag that rustc knows");
        assert_eq!(failed, Err("a flag that rustc knows".to_owned()));
        assert_eq!(succeed(Command::new("rustc").arg("--version"), ""), Ok(()));
    }
}
