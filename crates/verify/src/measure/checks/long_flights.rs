//! Flights of up to 10⁴ s: the error keeps within a solver's error estimate, and S stays where it is.

use crate::measure::check::{Basis, Check};
use crate::measure::context::Context;
use crate::measure::long_flights::Drift;
use crate::measure::measurement::Measurement;

pub(super) const ERROR: Check = Check {
    id: "long-flight-error",
    claim: "up to 10⁴ s the attitude is within the solver's error estimate, or there is an error (measured: largest error, divided by \
            what the estimate allows)",
    basis: Basis::ClosedForm,
    unit: "1",
    measure: |context| {
        let part = |drift: &Drift| drift.err_attitude / drift.allowed.unwrap_or(0.0);
        largest(context, ERROR.id, part, |drift| drift.allowed.map(|_| 1.0))
    },
};

pub(super) const DRIFT: Check = Check {
    id: "long-flight-drift",
    claim: "up to 10⁴ s S in the transport frame is what it was at launch, relative",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| largest(context, DRIFT.id, |drift| drift.momentum_vector, |drift| drift.allowed),
};

/// The largest `part` of each subject, over the flights that were solved, and what its error estimate allows of it.
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
