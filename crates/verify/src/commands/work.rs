//! `verify work`: what valgrind runs for `verify bench --instructions`.

use clap::Args;
use verify::bench::instructions::work;

/// Do a work of `bench --instructions` so many times
#[derive(Debug, Args)]
#[command(hide = true)]
pub(super) struct Work {
    /// Its name, as count/avx2
    name: String,
    /// How often
    #[arg(long, default_value_t = 1)]
    times: u32,
}

impl Work {
    pub(super) fn run(&self) -> anyhow::Result<u8> {
        work(&self.name, self.times)?;
        Ok(0)
    }
}
