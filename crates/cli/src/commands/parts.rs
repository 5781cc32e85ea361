//! Parts of an estimate: the options of `unfair-toss probability` that compute one and write it to a file, and `unfair-toss
//! merge`, which adds them. Parts can be computed on many machines, or one after the other; a part that is there already is not
//! computed again, so that a run can be stopped and resumed. A merge refuses what would count a launch twice or leave one out,
//! and says which file is at fault; its launches are counted from 1.

use std::ops::Range;
use std::path::{Path, PathBuf};

use dynamics::quantity::read_count;
use sampling::{Plan, Sampler, Space, Tally};
use toss::Error;
use toss::report::Estimate;

use crate::estimate::text;
use crate::failure::Failure;
use crate::json::plain_json;
use crate::output::{self, Asked, FormatArgs};
use crate::space_args::ThreadArgs;
use crate::watch::Watch;

/// Options for a part of an estimate.
#[derive(Debug, clap::Args)]
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
    let read = |(index, number)| Some(Shard { index: read_count(index)?, number: read_count(number)? });
    let shard = text.split_once('/').and_then(read).filter(|shard| (1..=shard.number).contains(&shard.index));
    shard.ok_or_else(|| "expected I/N with whole numbers, I from 1 to N".to_owned())
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
        (threads, watch): (&ThreadArgs, &Watch),
    ) -> Result<String, Failure> {
        let (Some(shard), Some(path)) = (self.shard, &self.out) else {
            return Err(Failure::usage("out", "--out needs --shard"));
        };
        if !sampler.is_exact() {
            return Err(Failure::usage("solver", "--solver has no parts: --shard takes the exact motion"));
        }
        output::require_folder("out", path)?;
        let points = plan.points(space)?;
        let range = shard.range(points);
        let launches = range.end - range.start;
        let there = already_there(path, space, plan, &range)?;
        if !there {
            let tally = threads
                .ask(watch, sampler, (launches, "launches"), |sampler| sampler.tally(space, plan, range.clone()))?;
            let text = plain_json(&tally);
            if whole_file::leads_to(path) {
                return Ok(text);
            }
            output::write("out", path, &(text + "\n"))?;
        }
        let Shard { index, number } = shard;
        let shown = path.display().to_string();
        let (file, was) = (whole_file::printable(&shown), if there { ", which held it already" } else { "" });
        Ok(format!("part         {index} of {number}: {launches} of {points} launches\nfile         {file}{was}"))
    }
}

/// Whether the file at `path` holds this part. A file that holds anything else is not overwritten.
fn already_there(path: &Path, space: &Space, plan: Plan, range: &Range<u64>) -> Result<bool, Failure> {
    if whole_file::leads_to(path) || !path.is_file() {
        return Ok(false);
    }
    let shown = path.display().to_string();
    match output::from_json::<Tally>(&output::read("out", path)?) {
        Ok(tally) if (tally.space(), tally.plan(), tally.range()) == (space, plan, range.clone()) => Ok(true),
        Ok(_) => Err(Failure::part(&shown, "it holds another part; remove it to write this one".to_owned())),
        Err(Error::Text { line, column, message }) => {
            let message = format!("{message}; it holds no part, remove it to write one");
            Err(Failure::text(&shown, &Error::Text { line, column, message }))
        }
        Err(source) => Err(Failure::text(&shown, &source)),
    }
}

/// The options of `merge`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The files of all parts, in any order
    #[arg(value_name = "PART", required = true)]
    parts: Vec<PathBuf>,
    #[command(flatten)]
    format: FormatArgs,
}

/// A part and its file.
struct Part {
    path: String,
    tally: Tally,
}

impl Args {
    pub(crate) fn run(&self, asked: &Asked) -> Result<String, Failure> {
        let mut parts = self.parts.iter().map(|path| Part::read(path)).collect::<Result<Vec<_>, _>>()?;
        // Only the first and the last part say what is missing at the ends, so all of them have to be of one plan first.
        let first = parts.remove(0);
        if let Some(other) = parts.iter().find(|part| !part.tally.is_of_the_plan_of(&first.tally)) {
            return Err(other.refused(format!("it is a part of another plan or space than {}", first.path)));
        }
        parts.push(first);
        parts.sort_by_key(|part| (part.tally.range().start, part.tally.range().end));
        let mut parts = parts.into_iter();
        let first = parts.next().ok_or_else(|| Failure::usage("parts", "PART: a part is needed"))?;
        if first.tally.range().start > 0 {
            return Err(first.refused(format!("launches 1 to {} are missing before it", first.tally.range().start)));
        }
        let whole = parts.try_fold(first, Part::followed_by)?;
        let (done, points) = (whole.tally.range().end, whole.tally.plan().points(whole.tally.space())?);
        if done < points {
            return Err(whole.refused(format!("launches {} to {points} are missing after it", done + 1)));
        }
        let found = whole.tally.estimate()?;
        let answer = Estimate { found: &found, integrated: None };
        Ok(self.format.print(asked, &answer, || text(&found, "exact")))
    }
}

impl Part {
    fn read(path: &Path) -> Result<Self, Failure> {
        let (text, path) = (output::read("parts", path)?, path.display().to_string());
        let tally = output::from_json(&text).map_err(|source| Failure::text(&path, &source))?;
        Ok(Self { path, tally })
    }

    fn refused(&self, message: String) -> Failure {
        Failure::part(&self.path, message)
    }

    /// The sum of this part and the `next`; it has the name of the next one's file.
    fn followed_by(self, next: Self) -> Result<Self, Failure> {
        let (end, start) = (self.tally.range().end, next.tally.range().start);
        if start > end {
            return Err(next.refused(format!("launches {} to {start} are missing before it", end + 1)));
        }
        if start < end {
            let shared = end.min(next.tally.range().end).max(start + 1);
            return Err(next.refused(format!("launches {} to {shared} are in {} too", start + 1, self.path)));
        }
        Ok(Self { path: next.path, tally: self.tally.merge(next.tally)? })
    }
}
