//! The command `work` does one piece of work a number of times and prints nothing. `bench --instructions` runs it
//! under valgrind to count its instructions.

use clap::Args;

use crate::bench::instructions::work;

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
