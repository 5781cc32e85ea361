//! Tallies as plain data, for files that different runs or machines write and one of them merges. Sums of shares are
//! texts, because many readers of JSON round integers above 2^53.
//!
//! What is read is checked: the sums have to be those of as many launches as the range has. Counts are read as counts of
//! outcomes that are not proven, whatever they were: a file proves nothing.

use dynamics::InputError;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::counts::Counts;
use crate::plan::Plan;
use crate::shares::Shares;
use crate::space::Space;
use crate::tally::{Sums, Tally};

/// The number of the format. It grows when a field changes its meaning.
const SCHEMA: u32 = 1;

/// The version of this crate. Parts of different versions do not merge, because their launches may differ.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A tally in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct TallyData {
    schema: u32,
    version: String,
    space: Space,
    plan: Plan,
    range: [u64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    counts: Option<Vec<CountsData>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shares: Option<Vec<SharesData>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CountsData {
    heads: u64,
    tails: u64,
    undecided: u64,
}

/// Sums in units of 2^-53.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SharesData {
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
            return refused("schema", data.schema.to_string(), "1");
        }
        if data.version != VERSION {
            return refused(
                "version",
                data.version,
                concat!("the version of this program, ", env!("CARGO_PKG_VERSION")),
            );
        }
        let sums = match (data.counts, data.shares) {
            (Some(counts), None) => Sums::Counts(counts.into_iter().map(Counts::try_from).collect::<Result<_, _>>()?),
            (None, Some(shares)) => Sums::Shares(shares.into_iter().map(Shares::try_from).collect::<Result<_, _>>()?),
            _ => return refused("counts", "none, or shares too".to_owned(), "either counts or shares"),
        };
        Self::new(data.space, data.plan, data.range[0]..data.range[1], sums)
    }
}

impl<'de> Deserialize<'de> for Tally {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        TallyData::deserialize(from)?.try_into().map_err(D::Error::custom)
    }
}

impl Serialize for Tally {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
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
        let (counts, shares) = match &self.sums {
            Sums::Counts(counts) => (Some(counts.iter().map(count).collect()), None),
            Sums::Shares(shares) => (None, Some(shares.iter().map(share).collect())),
        };
        let range = [self.range.start, self.range.end];
        let (version, space, plan) = (VERSION.to_owned(), self.space, self.plan);
        TallyData { schema: SCHEMA, version, space, plan, range, counts, shares }.serialize(to)
    }
}
