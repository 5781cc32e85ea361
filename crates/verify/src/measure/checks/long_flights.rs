//! These checks follow flights of up to 10⁴ s, far longer than any toss. Errors of an integrator grow with the time of
//! flight, so an error estimate that holds for short flights may fail for long ones.

use crate::measure::check::{Basis, Check, Judges, ceiling};
use crate::measure::context::Context;
use crate::measure::long_flights::Drift;
use crate::measure::measurement::Measurement;

pub(super) const ERROR: Check = Check {
    id: "long-flight-error",
    claim: "On flights of up to 10⁴ s the error of the attitude is within the solver's error estimate, or the solver \
            returns an error. Measured: the largest error divided by what the estimate allows; it fails above the \
            bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: 1.0,
    unit: "1",
    measure: |context| {
        let part = |drift: &Drift| drift.err_attitude / drift.allowed.unwrap_or(0.0);
        largest(context, ERROR.id, part, |drift| drift.allowed.map(|_| 1.0))
    },
};

pub(super) const DRIFT: Check = Check {
    id: "long-flight-drift",
    claim: "On flights of up to 10⁴ s the angular momentum S in the transport frame differs at landing from its value \
            at launch by at most the bound, relative to |S|.",
    basis: Basis::Invariant,
    judges: Judges::Solver,
    ceiling: ceiling::COS_TILT,
    unit: "1",
    measure: |context| largest(context, DRIFT.id, |drift| drift.momentum_vector, |drift| drift.allowed),
};

/// The largest `part` of each subject over the flights that it solved, with what its error estimate allows for that
/// part.
fn largest(
    context: &Context,
    check: &str,
    part: fn(&Drift) -> f64,
    allowed: fn(&Drift) -> Option<f64>,
) -> anyhow::Result<Vec<Measurement>> {
    let flights = context.long_flights()?;
    let row = |subject: &str| {
        let solved: Vec<(f64, &Drift)> =
            flights.of(subject).filter_map(|(time, found)| Some((time, found.as_ref().ok()?))).collect();
        let refused = flights.of(subject).count() - solved.len();
        let figure = |time: f64, measured: f64| {
            let input = format!("ω = (1, 1, 2.5) rad/s for {time} s; {refused} longer flights refused");
            Measurement::figure(check, subject, measured, solved.len() as u64, input)
        };
        let all = solved.iter().map(|(time, drift)| figure(*time, part(drift)).claiming(allowed(drift))).collect();
        Measurement::worst_of(all).unwrap_or_else(|| figure(0.0, f64::NAN).claiming(Some(0.0)))
    };
    Ok(flights.subjects().map(row).collect())
}
