//! `unfair-toss merge` adds the parts of an estimate that `probability --shard` wrote, on one machine or on many. It refuses
//! what would count a launch twice or leave one out, and says which file is at fault.

use std::path::{Path, PathBuf};

use sampling::Tally;

use crate::estimate_answer::{Answer, text};
use crate::failure::Failure;
use crate::output::{self, Format, Input};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The files of all parts, in any order
    #[arg(value_name = "PART", required = true)]
    parts: Vec<PathBuf>,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// A part and its file.
struct Part {
    path: String,
    tally: Tally,
}

impl Args {
    pub(crate) fn run(&self, input: &Input) -> Result<String, Failure> {
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
            return Err(first.refused(format!("launches 0 to {} are missing before it", first.tally.range().start - 1)));
        }
        let whole = parts.try_fold(first, Part::followed_by)?;
        let (done, points) = (whole.tally.range().end, whole.tally.plan().points(whole.tally.space())?);
        if done < points {
            return Err(whole.refused(format!("launches {done} to {} are missing after it", points - 1)));
        }
        let found = whole.tally.estimate()?;
        Ok(match self.format {
            Format::Json => output::json(input, &Answer::new(&found, whole.tally.plan())),
            Format::Text => text(&found, "exact"),
        })
    }
}

impl Part {
    fn read(path: &Path) -> Result<Self, Failure> {
        let shown = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|source| Failure::Read {
            option: "parts",
            path: shown.clone(),
            source,
        })?;
        let tally = serde_json::from_str(&text).map_err(|error| Failure::part(&shown, error.to_string()))?;
        Ok(Self { path: shown, tally })
    }

    fn refused(&self, message: String) -> Failure {
        Failure::part(&self.path, message)
    }

    /// The sum of this part and the `next`; it has the name of the next one's file.
    fn followed_by(self, next: Self) -> Result<Self, Failure> {
        let (end, start) = (self.tally.range().end, next.tally.range().start);
        if start > end {
            return Err(next.refused(format!("launches {end} to {} are missing before it", start - 1)));
        }
        if start < end {
            let shared = end.min(next.tally.range().end).max(start + 1) - 1;
            return Err(next.refused(format!("launches {start} to {shared} are in {} too", self.path)));
        }
        Ok(Self { path: next.path, tally: self.tally.merge(next.tally)? })
    }
}
