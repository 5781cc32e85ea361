//! `cargo xtask fuzz`: runs the fuzz targets by libFuzzer. They are built with instrumentation by a stable compiler, which is
//! what cargo-fuzz does with a nightly one. Sanitizers are left out: no code of the targets is unsafe.

use std::path::PathBuf;
use std::process::{Command, ExitCode};

use clap::Args;

use crate::program::cargo;
use crate::{output, root};

/// Run the fuzz targets by libFuzzer
///
/// It needs a C++ compiler. An input that breaks a claim is kept in target/fuzz/found, with the command that repeats it.
/// Inputs that reach new code are kept in target/fuzz/corpus, and the next run begins with them.
///
/// Exit codes: 0; 1 a claim is broken; 2 bad usage; 4 could not run.
#[derive(Debug, Args)]
pub(crate) struct Fuzz {
    /// Run this target alone, or one input of it
    #[arg(value_parser = TARGETS)]
    target: Option<String>,
    /// How long each target runs
    #[arg(long, value_name = "N", default_value_t = 60)]
    seconds: u32,
    /// Check this file alone
    #[arg(long, value_name = "FILE", requires = "target", conflicts_with = "seconds")]
    input: Option<PathBuf>,
}

/// The targets, which are those of `fuzz/src/lib.rs`.
const TARGETS: [&str; 8] = ["bodies", "columns", "enclosure", "part", "quantity", "rows", "scene", "space"];

/// What libFuzzer needs to see: the edges of the control flow, how often each is taken, and what numbers are compared.
const INSTRUMENTATION: &str = "-Cpasses=sancov-module -Cllvm-args=-sanitizer-coverage-level=4 \
    -Cllvm-args=-sanitizer-coverage-inline-8bit-counters -Cllvm-args=-sanitizer-coverage-pc-table \
    -Cllvm-args=-sanitizer-coverage-trace-compares -Ccodegen-units=1 --cfg fuzzing";

impl Fuzz {
    pub(crate) fn run(&self) -> Result<ExitCode, String> {
        let host = host()?;
        let folder = root().join("target/fuzz");
        let targets: Vec<&str> = self.target.as_deref().map_or(TARGETS.to_vec(), |target| vec![target]);
        build(&host)?;
        let mut broken = Vec::new();
        for target in targets {
            let (corpus, found) = (folder.join("corpus").join(target), folder.join("found"));
            for folder in [&corpus, &found] {
                std::fs::create_dir_all(folder)
                    .map_err(|error| format!("cannot make {}: {error}", folder.display()))?;
            }
            let mut program = Command::new(folder.join(&host).join("fuzz/unfair-toss-fuzz"));
            program.env("TARGET", target);
            match &self.input {
                Some(file) => program.arg(file),
                None => program.arg(corpus).arg(root().join("fuzz/seeds").join(target)),
            };
            program.arg(format!("-max_total_time={}", self.seconds)).arg("-print_final_stats=1");
            program.arg(format!("-artifact_prefix={}/{target}-", found.display()));
            let status = program.status().map_err(|error| format!("cannot start {target}: {error}"))?;
            if !status.success() {
                broken.push(target);
            }
        }
        for target in &broken {
            output::say(format_args!("broken: cargo xtask fuzz {target} --input target/fuzz/found/{target}-FILE"));
        }
        Ok(ExitCode::from(u8::from(!broken.is_empty())))
    }
}

/// The platform of this compiler. It has to be named, so that build scripts are not instrumented.
fn host() -> Result<String, String> {
    let printed = Command::new("rustc").arg("-vV").output().map_err(|error| format!("cannot start rustc: {error}"))?;
    let text = String::from_utf8_lossy(&printed.stdout).into_owned();
    let host = text.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc does not name its platform".to_owned())
}

fn build(host: &str) -> Result<(), String> {
    let mut command = cargo();
    command.args(["build", "--locked", "--package", "unfair-toss-fuzz", "--features", "libfuzzer"]);
    command.args(["--profile", "fuzz", "--target", host]);
    command.arg("--target-dir").arg(root().join("target/fuzz")).env("RUSTFLAGS", INSTRUMENTATION);
    let status = command.status().map_err(|error| format!("cannot start cargo: {error}"))?;
    if status.success() {
        Ok(())
    } else {
        Err("the targets were not built (libFuzzer needs a C++ compiler)".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_targets_are_those_of_the_crate() {
        let library = std::fs::read_to_string(root().join("fuzz/src/lib.rs")).unwrap();
        let named: Vec<&str> = library.split("    (\"").skip(1).filter_map(|rest| rest.split('"').next()).collect();
        assert_eq!(named, TARGETS);
        for target in TARGETS {
            assert!(root().join("fuzz/seeds").join(target).is_dir(), "{target}");
        }
    }
}
