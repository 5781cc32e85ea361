//! The reference is the unit of the benchmark's times: the closed form of cos θ in plain f64, vectorised by a C
//! compiler. It stands for what you could reach without any care for accuracy, and makes times comparable across
//! machines.
//!
//! The program `reference.c` is compiled for this processor when the benchmark starts, and runs as a process of its
//! own. It measures once for each line that it reads, so that it can be timed in turn with the contestants. Without a C
//! compiler the same loop in Rust, one toss at a time, takes its place.

use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use anyhow::{Context, ensure};

use super::tosses::{Columns, TOSSES};

pub(super) struct Reference {
    process: Child,
    questions: ChildStdin,
    answers: BufReader<ChildStdout>,
    pub(super) flags: String,
    pub(super) cos_tilts: Vec<f64>,
}

impl Reference {
    pub(super) fn start() -> anyhow::Result<Self> {
        let folder = std::env::temp_dir().join(format!("unfair-toss-bench-{}", std::process::id()));
        std::fs::create_dir_all(&folder)?;
        let (source, program) = (folder.join("reference.c"), folder.join("reference"));
        std::fs::write(&source, include_str!("reference.c"))?;
        let compile = |flags: &[&str]| {
            let mut cc = Command::new("cc");
            let cc = cc.args(flags).arg("-o").arg(&program).arg(&source).args(["-lmvec", "-lm"]);
            cc.output().is_ok_and(|output| output.status.success())
        };
        let flags = ["-O3", "-march=native", "-ffast-math"];
        let started = compile(&flags).then(|| Self::run(&program, flags.join(" ")));
        // The running process no longer needs its file.
        std::fs::remove_dir_all(&folder)?;
        started.context("no C compiler with libmvec")?
    }

    fn run(program: &std::path::Path, flags: String) -> anyhow::Result<Self> {
        let mut process = Command::new(program).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
        let questions = process.stdin.take().context("the reference has no standard input")?;
        let mut answers = BufReader::new(process.stdout.take().context("the reference has no standard output")?);
        let cos_tilts = (0..TOSSES).map(|_| read(&mut answers)).collect::<anyhow::Result<_>>()?;
        Ok(Self { process, questions, answers, flags, cos_tilts })
    }

    /// The shortest time of a toss (ns) over some runs, measured now.
    pub(super) fn nanoseconds(&mut self) -> anyhow::Result<f64> {
        self.questions.write_all(b"\n")?;
        read(&mut self.answers)
    }
}

impl Drop for Reference {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

fn read(answers: &mut impl BufRead) -> anyhow::Result<f64> {
    let mut line = String::new();
    ensure!(answers.read_line(&mut line)? > 0, "the process of the reference has ended");
    Ok(line.trim().parse()?)
}

/// The loop of the reference in Rust: cos θ of all tosses, one after the other.
pub(super) fn scalar(tosses: &Columns, out: &mut [f64]) {
    let Columns { rates: [x, y, z], speeds } = tosses;
    for (index, out) in out.iter_mut().enumerate() {
        let along = 0.5 * z[index];
        let across = x[index] * x[index] + y[index] * y[index];
        let squared = across + along * along;
        let phase = squared.sqrt() * (speeds[index] * (2.0 / 9.81));
        *out = (along * along + across * phase.cos()) / squared;
    }
}
