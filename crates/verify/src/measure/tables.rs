//! This file estimates P(heads) of every named space by every sampling method, and the running shares of heads in Fig.
//! 4's space. Counts, and shares rounded to 12 digits, are the same on every platform, so a test can hold them fixed.

use sampling::{Estimate, Found, Plan, Rest, RunningStep, Sampler, Scrambled, named_space, named_spaces};
use serde::Serialize;

/// Number of independent random launches, the paper's method B.
const RANDOM_LAUNCHES: u64 = 250_000;
/// Seed of the random launches and of the scrambles.
const SEED: u64 = 1;

/// One line of the probability tables.
#[derive(Debug, Clone, Serialize)]
pub struct TableLine {
    /// Name of the space.
    pub space: &'static str,
    /// The sampling method.
    pub method: &'static str,
    /// What the method found.
    #[serde(flatten)]
    pub found: TableEntry,
}

/// What a method found in a space.
#[derive(Debug, Clone, Serialize)]
#[serde(untagged)]
pub enum TableEntry {
    /// Numbers of outcomes.
    Counts {
        /// Launches that land heads.
        heads: u64,
        /// Launches that land tails.
        tails: u64,
        /// Launches whose outcome was left undecided.
        undecided: u64,
    },
    /// A probability in 12 digits, few enough that rounding gives the same ones on every platform.
    Share {
        /// P(heads).
        probability: String,
    },
}

const METHODS: [(&str, Plan); 4] = [
    ("grid", Plan::Grid),
    ("random", Plan::Random { points: RANDOM_LAUNCHES, seed: SEED }),
    ("sobol", Plan::Sobol(Scrambled { points: 1 << 18, scrambles: 8, seed: SEED })),
    ("exact-speed", Plan::ExactSpeed(Rest::Grid)),
];

/// Estimates every named space by every method with the exact motion, and returns each line of the table with its
/// estimate.
///
/// # Errors
/// Never for the named spaces.
pub fn tables() -> anyhow::Result<Vec<(TableLine, Estimate)>> {
    let mut lines = Vec::new();
    for (space, named) in named_spaces() {
        for (method, plan) in METHODS {
            let estimate = Sampler::exact().estimate(&named.space, plan)?;
            let found = match estimate.found {
                Found::Counts(counts) => {
                    TableEntry::Counts { heads: counts.heads(), tails: counts.tails(), undecided: counts.undecided() }
                }
                Found::Shares { .. } => TableEntry::Share { probability: format!("{:.12}", estimate.probability) },
            };
            lines.push((TableLine { space, method, found }, estimate));
        }
    }
    Ok(lines)
}

/// P(heads) of a space by a method, with its interval.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Probability {
    /// Name of the space.
    pub space: &'static str,
    /// The sampling method.
    pub method: &'static str,
    /// Number of launches.
    pub points: u64,
    /// P(heads).
    pub probability: f64,
    /// Ends of the interval, if the method has one.
    pub interval: Option<[f64; 2]>,
    /// The kind of interval, in words.
    pub interval_kind: String,
}

/// The estimates of [`tables`] in the form that the reports use.
///
/// # Errors
/// As [`tables`].
pub fn probabilities() -> anyhow::Result<Vec<Probability>> {
    let line = |(line, found): (TableLine, Estimate)| Probability {
        space: line.space,
        method: line.method,
        points: found.points,
        probability: found.probability,
        interval: found.interval.map(|interval| [interval.lo, interval.hi]),
        interval_kind: found.interval_kind.to_string(),
    };
    Ok(tables()?.into_iter().map(line).collect())
}

/// The running shares of heads in Fig. 4's space, for a check and a chart.
///
/// # Errors
/// Never for the named space.
pub fn fig4() -> anyhow::Result<Vec<RunningStep>> {
    const STEPS: u64 = 250;
    Ok(Sampler::exact().running_shares(&named_space("paper-fig4")?, STEPS, SEED)?)
}
