//! Tallies as plain data, for files that different runs or machines write and one of them merges. Sums of shares are
//! texts, because many readers of JSON round integers above 2^53.
//!
//! What is read is checked. The digest has to be that of the contents, so that no digit was changed since the file was
//! written; the streams have to be those of this program, so that it would have counted the same launches; and the sums
//! have to be those of as many launches as the range has. All of this is against accidents: anybody can write a file with
//! a right digest. Counts are read as counts of outcomes that are not proven, whatever they were: a file proves nothing.

use std::fmt;

use dynamics::InputError;
use serde::{Deserialize, Serialize};

use crate::coordinate::Coordinate;
use crate::counts::Counts;
use crate::plan::{Plan, Rest, Scrambled};
use crate::shares::Shares;
use crate::space::Space;
use crate::tally::{Sums, Tally};

/// The number of the format. It grows when a field changes its meaning.
const SCHEMA: u32 = 2;

/// The number of what makes the sums: the launches of each plan with their numbers, and how shares are rounded to integers.
/// It grows whenever a count or a share of any plan changes, as a test over known sums holds. Parts of different streams
/// do not merge.
const STREAMS: u32 = 1;

/// The version of this crate, for the reader of a file.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A tally in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TallyData {
    schema: u32,
    /// None in files of before there was this number.
    #[serde(default)]
    streams: u32,
    version: String,
    space: Space,
    plan: Plan,
    range: [u64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    counts: Option<Vec<CountsData>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shares: Option<Vec<SharesData>>,
    /// [`TallyData::digest`], in 16 hexadecimal digits.
    #[serde(default)]
    digest: String,
}

impl TallyData {
    /// The FNV-1a hash of all other fields, as numbers that do not depend on how the file is laid out.
    fn digest(&self) -> String {
        let Self { schema, streams, version, space, plan, range: [start, end], counts, shares, digest: _ } = self;
        let mut text = format!("{schema} {streams} {version} {start} {end} {}", plan.method());
        let mut add = |part: &dyn fmt::Display| text.push_str(&format!(" {part}"));
        match plan {
            Plan::Random { points, seed } => [points, seed].into_iter().for_each(|number| add(number)),
            Plan::Sobol(Scrambled { points, scrambles, seed })
            | Plan::ExactSpeed(Rest::Sobol(Scrambled { points, scrambles, seed })) => {
                [points, scrambles, seed].into_iter().for_each(|number| add(number));
            }
            Plan::Grid | Plan::ExactSpeed(Rest::Grid) | Plan::Enclosure { .. } => {}
        }
        space.body().inertia().iter().for_each(|element| add(element));
        Coordinate::ALL.into_iter().filter_map(|of| space.axis_or_tie(of)).for_each(|axis| add(&axis));
        for CountsData { heads, tails, undecided } in counts.iter().flatten() {
            [heads, tails, undecided].into_iter().for_each(|number| add(number));
        }
        for SharesData { launches, probability, error } in shares.iter().flatten() {
            add(launches);
            [probability, error].into_iter().for_each(|sum| add(sum));
        }
        format!("{:016x}", fnv_1a(text.as_bytes()))
    }
}

/// The 64-bit hash FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo, D. Eastlake, RFC 9923). Each byte permutes the 2^64 states, so
/// that no change of a single byte leaves it as it was.
fn fnv_1a(bytes: &[u8]) -> u64 {
    const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    bytes.iter().fold(OFFSET_BASIS, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(PRIME))
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CountsData {
    heads: u64,
    tails: u64,
    undecided: u64,
}

/// Sums in units of 2^-53.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SharesData {
    launches: u64,
    probability: String,
    error: String,
}

impl TryFrom<CountsData> for Counts {
    type Error = InputError;

    fn try_from(CountsData { heads, tails, undecided }: CountsData) -> Result<Self, InputError> {
        if heads.checked_add(tails).and_then(|sum| sum.checked_add(undecided)).is_none() {
            let value = format!("{heads}, {tails}, {undecided}");
            return Err(InputError::Malformed { field: "counts", value, expected: "fewer than 2^64 launches" });
        }
        Ok(Self::estimated(heads, tails, undecided))
    }
}

impl TryFrom<SharesData> for Shares {
    type Error = InputError;

    fn try_from(SharesData { launches, probability, error }: SharesData) -> Result<Self, InputError> {
        let sum = |field, text: String, most: u128| match text.parse::<u128>() {
            Ok(sum) if sum <= most => Ok(sum),
            _ => {
                let expected = "a whole number in units of 2^-53, at most one share for each launch";
                Err(InputError::Malformed { field, value: text, expected })
            }
        };
        let whole = u128::from(launches) << 53;
        let probability = sum("probability", probability, whole)?;
        // Each error is at most 1, and a unit more for its rounding.
        Ok(Self { launches, probability, error: sum("error", error, whole + u128::from(launches))? })
    }
}

impl TryFrom<TallyData> for Tally {
    type Error = InputError;

    fn try_from(data: TallyData) -> Result<Self, InputError> {
        let refused = |field, value, expected| Err(InputError::Malformed { field, value, expected });
        if data.schema != SCHEMA {
            let expected = "2, the format of this program; others have no digest, or a meaning of their own";
            return refused("schema", data.schema.to_string(), expected);
        }
        let digest = data.digest();
        if data.digest != digest {
            let value = format!("{}, and {digest} of the contents", data.digest);
            return refused("digest", value, "that of the contents: they have changed since the file was written");
        }
        if data.streams != STREAMS {
            let value = format!("{} of version {}", data.streams, data.version);
            return refused("streams", value, "the streams of this program, which would have counted other launches");
        }
        let sums = match (data.counts, data.shares) {
            (Some(counts), None) => Sums::Counts(counts.into_iter().map(Counts::try_from).collect::<Result<_, _>>()?),
            (None, Some(shares)) => Sums::Shares(shares.into_iter().map(Shares::try_from).collect::<Result<_, _>>()?),
            _ => return refused("counts", "none, or shares too".to_owned(), "either counts or shares"),
        };
        Self::new(data.space, data.plan, data.range[0]..data.range[1], sums)
    }
}

impl From<Tally> for TallyData {
    fn from(tally: Tally) -> Self {
        let count = |counts: &Counts| CountsData {
            heads: counts.heads(),
            tails: counts.tails(),
            undecided: counts.undecided(),
        };
        let share = |shares: &Shares| SharesData {
            launches: shares.launches,
            probability: shares.probability.to_string(),
            error: shares.error.to_string(),
        };
        let (counts, shares) = match &tally.sums {
            Sums::Counts(counts) => (Some(counts.iter().map(count).collect()), None),
            Sums::Shares(shares) => (None, Some(shares.iter().map(share).collect())),
        };
        let range = [tally.range.start, tally.range.end];
        let (version, space, plan) = (VERSION.to_owned(), tally.space, tally.plan);
        let digest = String::new();
        let data = Self { schema: SCHEMA, streams: STREAMS, version, space, plan, range, counts, shares, digest };
        Self { digest: data.digest(), ..data }
    }
}

#[cfg(test)]
mod tests;
