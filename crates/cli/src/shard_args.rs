//! The options that compute a part of an estimate and write it to a file. Parts can be computed on many machines, or one
//! after the other; a part that is there already is not computed again, so that a run can be stopped and resumed.

use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::Args;
use dynamics::quantity::read_count;
use sampling::{Plan, Sampler, Space, Tally};

use crate::failure::Failure;
use crate::output;
use crate::space_args::ThreadArgs;

/// Options for a part of an estimate.
#[derive(Debug, Args)]
pub(crate) struct ShardArgs {
    /// Compute part I of N equal parts, from 1 to N, and write it to --out; `merge` adds the parts
    #[arg(long, value_name = "I/N", requires_all = ["out", "method"], allow_hyphen_values = true,
          value_parser = shard)]
    shard: Option<Shard>,
    /// File for the part; if it holds this part already, nothing is computed; - is standard output
    #[arg(long, value_name = "FILE", requires = "shard")]
    out: Option<PathBuf>,
}

/// Part number `index` of `number`, from 1.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shard {
    index: u64,
    number: u64,
}

/// Reads `I/N`.
fn shard(text: &str) -> Result<Shard, String> {
    let expected = || "expected I/N with whole numbers, I from 1 to N".to_owned();
    let (index, number) = text.split_once('/').ok_or_else(expected)?;
    match (read_count(index), read_count(number)) {
        (Some(index), Some(number)) if (1..=number).contains(&index) => Ok(Shard { index, number }),
        _ => Err(expected()),
    }
}

impl Shard {
    /// The launches of the part among `points`. The parts differ by one launch at most.
    #[expect(clippy::cast_possible_truncation, reason = "a fraction of a u64")]
    fn range(self, points: u64) -> Range<u64> {
        let end = |parts: u64| (u128::from(points) * u128::from(parts) / u128::from(self.number)) as u64;
        end(self.index - 1)..end(self.index)
    }
}

impl ShardArgs {
    /// Whether a part is asked for.
    pub(crate) fn is_given(&self) -> bool {
        self.shard.is_some()
    }

    /// Computes the part of `plan` and writes it, unless its file holds it already. The answer says where it is.
    pub(crate) fn write(
        &self,
        (space, plan): (&Space, Plan),
        sampler: Sampler<'_>,
        threads: &ThreadArgs,
    ) -> Result<String, Failure> {
        let (Some(shard), Some(path)) = (self.shard, &self.out) else {
            return Err(Failure::usage("out", "--out needs --shard"));
        };
        if !sampler.is_exact() {
            return Err(Failure::usage("solver", "--solver has no parts: --shard takes the exact motion"));
        }
        output::require_folder("out", path)?;
        let range = shard.range(plan.points(space)?);
        let there = already_there(path, space, plan, &range)?;
        if !there {
            let launches = (range.end - range.start, "launches");
            let tally = threads.ask(sampler, launches, |sampler| sampler.tally(space, plan, range.clone()))?;
            let text = output::plain_json(&tally);
            if whole_file::leads_to(path) {
                return Ok(text);
            }
            let target = || path.display().to_string();
            whole_file::write(path, &(text + "\n")).map_err(|source| Failure::Write {
                option: "out",
                target: target(),
                source,
            })?;
        }
        let Shard { index, number } = shard;
        let (file, was) = (path.display(), if there { ", which held it already" } else { "" });
        let of = plan.points(space)?;
        Ok(format!(
            "part         {index} of {number}: {} of {of} launches\nfile         {file}{was}",
            range.end - range.start
        ))
    }
}

/// Whether the file at `path` holds this part. A file that holds anything else is not overwritten.
fn already_there(path: &Path, space: &Space, plan: Plan, range: &Range<u64>) -> Result<bool, Failure> {
    if whole_file::leads_to(path) || !path.is_file() {
        return Ok(false);
    }
    let shown = path.display().to_string();
    let text =
        std::fs::read_to_string(path).map_err(|source| Failure::Read { option: "out", path: shown.clone(), source })?;
    match serde_json::from_str::<Tally>(&text) {
        Ok(tally) if (tally.space(), tally.plan(), tally.range()) == (space, plan, range.clone()) => Ok(true),
        Ok(_) => Err(Failure::part(&shown, "it holds another part; remove it to write this one".to_owned())),
        Err(error) => Err(Failure::part(&shown, format!("it holds no part ({error}); remove it to write one"))),
    }
}
