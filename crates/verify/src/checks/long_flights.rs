//! Flights of up to 10⁴ s: the error keeps within what a solver answers for, and S stays where it is.

use crate::check::{Basis, Check};
use crate::context::Context;
use crate::long_flights::Drift;
use crate::measurement::Measurement;

pub(super) const ERROR: Check = Check {
    id: "long-flight-error",
    claim: "up to 10⁴ s the attitude is within what the solver answers for, or there is an error (measured: largest part)",
    basis: Basis::ClosedForm,
    unit: "1",
    measure: |context| largest(context, ERROR.id, |drift| drift.err_attitude / drift.allowed),
};

pub(super) const DRIFT: Check = Check {
    id: "long-flight-drift",
    claim: "up to 10⁴ s S in the transport frame is what it was at launch, relative",
    basis: Basis::Invariant,
    unit: "1",
    measure: |context| largest(context, DRIFT.id, |drift| drift.momentum_vector),
};

/// The largest `part` of each subject, over the flights that were solved.
fn largest(context: &Context, check: &str, part: fn(&Drift) -> f64) -> anyhow::Result<Vec<Measurement>> {
    let flights = context.long_flights()?;
    let row = |subject: &str| {
        let solved: Vec<(f64, f64)> = flights
            .of(subject)
            .filter_map(|(time, found)| found.as_ref().ok().map(|drift| (part(drift), time)))
            .collect();
        let refused = flights.of(subject).count() - solved.len();
        let (worst, time) = solved.iter().copied().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::NAN, 0.0));
        let input = format!("ω = (1, 1, 2.5) rad/s for {time} s; {refused} longer flights refused");
        Measurement::figure(check, subject, worst, solved.len() as u64, input)
    };
    Ok(flights.subjects().map(row).collect())
}
