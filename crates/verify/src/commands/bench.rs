//! The command `bench` measures what a toss costs, in time or in instructions. Times are only printed; instructions are
//! compared with a baseline, because they are the same in every run. The command `work` is what valgrind runs to count
//! them.

use clap::Args;

use crate::bench::Table;
use crate::bench::instructions::{Instructions, work};
use crate::bench::to_accuracy::ToAccuracy;
use crate::files;
use crate::suite::Suite;

/// Print what a toss costs, in ns and relative to a reference in C
///
/// Exit code 3 if a kernel takes more instructions than the baseline allows.
#[derive(Debug, Args)]
pub(super) struct Bench {
    /// Count instructions by valgrind instead, and compare them with the baseline
    #[arg(long)]
    instructions: bool,
    /// Take fewer instructions into the baseline
    #[arg(long, requires = "instructions")]
    bless: bool,
    /// Print instead how long each method takes to this accuracy of P(heads), such as 1e-6
    #[arg(long, value_name = "EPS", conflicts_with = "instructions")]
    to: Option<f64>,
}

impl Bench {
    /// Returns the exit code: 3 if a work takes more instructions than the baseline allows, otherwise 0.
    pub(super) fn run(&self, suite: &Suite) -> anyhow::Result<u8> {
        if let Some(accuracy) = self.to {
            files::print(&ToAccuracy::measure(accuracy)?.to_string())?;
            return Ok(0);
        }
        if !self.instructions {
            files::print(&Table::measure()?.to_string())?;
            return Ok(0);
        }
        let path = suite.data().join("baseline").join(std::env::consts::ARCH).join("instructions.csv");
        let (baseline, found) = (Instructions::read(&path)?, Instructions::count()?);
        let (text, is_worse) = found.compared(&baseline);
        files::print(&text)?;
        if self.bless {
            found.bless(&baseline, &path)?;
        }
        Ok(if is_worse { 3 } else { 0 })
    }
}

/// Do one work of `bench --instructions` a number of times
#[derive(Debug, Args)]
#[command(hide = true)]
pub(super) struct Work {
    /// The name of the work, such as count/avx2
    name: String,
    /// How many times
    #[arg(long, default_value_t = 1)]
    times: u32,
}

impl Work {
    pub(super) fn run(&self) -> anyhow::Result<u8> {
        work(&self.name, self.times)?;
        Ok(0)
    }
}
