//! What commands print of an estimate of P(heads), as JSON and as text: `probability`, which makes one, and `merge`, which
//! adds its parts.

use crate::output::whole;
use exact::{ProvenCounts, Stage};
use sampling::{Counts, Estimate, Found, Interval, IntervalKind, Plan, Rest, Scrambled};
use serde::Serialize;
use toss::{IntegratedCounts, Integration};

/// An estimate as JSON.
#[derive(Serialize)]
pub(crate) struct Answer {
    #[serde(flatten)]
    counts: Option<CountsAnswer>,
    points: u64,
    probability: f64,
    /// For exact-speed and enclosure: half the width of the interval.
    #[serde(skip_serializing_if = "Option::is_none")]
    error_bound: Option<f64>,
    interval: Option<[f64; 2]>,
    interval_kind: String,
    /// Whether both ends of the interval are proven.
    proven: bool,
    pub(crate) certified: bool,
    /// The number of outcomes that each stage of the proof decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    proven_by: Option<ProvenBy>,
    /// The number of outcomes that each kind of integration decided.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) integrated_by: Option<IntegratedBy>,
    seed: Option<serde_json::Value>,
    /// The method by which launches were chosen.
    method: &'static str,
}

#[derive(Serialize)]
struct CountsAnswer {
    heads: u64,
    tails: u64,
    undecided: u64,
}

/// The number of outcomes by stage of the proof.
#[derive(Serialize)]
struct ProvenBy {
    f64: u64,
    double_double: u64,
    multiprecision: u64,
}

/// The number of outcomes by kind of integration.
#[derive(Serialize)]
pub(crate) struct IntegratedBy {
    coarse: u64,
    f64: u64,
    finest_tolerance: u64,
    double_double: u64,
    more_digits: u64,
}

impl From<IntegratedCounts> for IntegratedBy {
    fn from(counts: IntegratedCounts) -> Self {
        Self {
            coarse: counts.by(Integration::Coarse),
            f64: counts.by(Integration::AsConfigured),
            finest_tolerance: counts.by(Integration::Finest),
            double_double: counts.by(Integration::DoubleDouble),
            more_digits: counts.by(Integration::MoreDigits),
        }
    }
}

impl Answer {
    pub(crate) fn new(found: &Estimate, plan: Plan) -> Self {
        let (counts, error_bound) = match found.found {
            Found::Counts(counts) => (Some(counts), None),
            Found::Shares { .. } => (None, found.half_width()),
        };
        let proven = counts.filter(Counts::are_certified).map(|counts| counts.proven());
        Self {
            counts: counts.map(CountsAnswer::from),
            points: found.points,
            probability: found.probability,
            error_bound,
            interval: found.interval.map(|interval| [interval.lo, interval.hi]),
            interval_kind: found.interval_kind.to_string(),
            proven: found.interval_kind == IntervalKind::Proven,
            certified: proven.is_some(),
            proven_by: proven.map(ProvenBy::from),
            integrated_by: None,
            seed: seed_of(plan).map(whole),
            method: name_of(plan),
        }
    }
}

impl From<Counts> for CountsAnswer {
    fn from(counts: Counts) -> Self {
        Self { heads: counts.heads(), tails: counts.tails(), undecided: counts.undecided() }
    }
}

impl From<ProvenCounts> for ProvenBy {
    fn from(proven: ProvenCounts) -> Self {
        Self {
            f64: proven.by(Stage::F64),
            double_double: proven.by(Stage::DoubleDouble),
            multiprecision: proven.by(Stage::Multiprecision),
        }
    }
}

/// An estimate as text.
pub(crate) fn text(found: &Estimate, solver: &str) -> String {
    let (probability, kind) = (found.probability, &found.interval_kind);
    let (probability, interval) = match (found.interval, found.half_width()) {
        (Some(_), Some(error)) if *kind == IntervalKind::Rounding => {
            (probability.to_string(), format!("± {error:.1e} ({kind})"))
        }
        (Some(Interval { lo, hi }), Some(error)) if *kind == IntervalKind::Proven => {
            (format!("{probability:.0$}", digits_for(error)), format!("{lo} to {hi} ({kind})"))
        }
        (Some(Interval { lo, hi }), Some(error)) => {
            let digits = digits_for(error);
            (format!("{probability:.digits$}"), format!("{lo:.digits$} to {hi:.digits$} ({kind})"))
        }
        _ => (format!("{probability:.6}"), kind.to_string()),
    };
    let launches = match found.found {
        Found::Counts(counts) => {
            format!("{} heads, {} tails, {} undecided", counts.heads(), counts.tails(), counts.undecided())
        }
        Found::Shares { .. } if *kind == IntervalKind::Proven => format!("all, in {} cells", found.points),
        Found::Shares { .. } => format!("{}, each at all its speeds", found.points),
    };
    let mut lines = vec![
        format!("P(heads)     {probability}"),
        format!("interval     {interval}"),
        format!("launches     {launches}"),
        format!("solver       {solver}"),
    ];
    if let Found::Counts(counts) = found.found
        && counts.are_certified()
    {
        let stages = Stage::ALL.map(|stage| format!("{} {}", stage.name(), counts.proven().by(stage)));
        lines.push(format!("proven by    {}", stages.join(", ")));
    }
    lines.join("\n")
}

/// The number of decimal places that show two digits of `error`, at least six.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 6 and 17")]
fn digits_for(error: f64) -> usize {
    (1.0 - error.log10().floor()).clamp(6.0, 17.0) as usize
}

/// The name of the method of `plan`, as `--method` takes it.
pub(crate) fn name_of(plan: Plan) -> &'static str {
    match plan {
        Plan::Grid => "grid",
        Plan::Random { .. } => "random",
        Plan::Sobol(_) => "sobol",
        Plan::ExactSpeed(_) => "exact-speed",
        Plan::Enclosure { .. } => "enclosure",
    }
}

/// The seed of `plan`; `None` if nothing in it is random.
fn seed_of(plan: Plan) -> Option<u64> {
    match plan {
        Plan::Grid | Plan::ExactSpeed(Rest::Grid) | Plan::Enclosure { .. } => None,
        Plan::Random { seed, .. } => Some(seed),
        Plan::Sobol(Scrambled { seed, .. }) | Plan::ExactSpeed(Rest::Sobol(Scrambled { seed, .. })) => Some(seed),
    }
}
