//! This check compares the observed order of convergence of every scheme with the order that theory gives it. A mistake
//! in a scheme's coefficients or in the equations often leaves the error small, but lowers the order.

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::convergence::Convergence;
use crate::measure::measurement::Measurement;

pub(super) const ORDER: Check = Check {
    id: "convergence-order",
    claim: "With a fixed step h the error falls as h to the power of the scheme's order by theory. Measured: the \
            distance of the fitted power from that order; it fails above the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: 0.5,
    unit: "1",
    measure,
};

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let row = |found: &Convergence| {
        let observed = found.observed.unwrap_or(f64::NAN);
        let input = format!("observed order {observed:.3} over {:.1} halvings of the step", found.halvings);
        let distance = (observed - f64::from(found.order)).abs();
        Measurement::figure(ORDER.id, &found.subject, distance, found.points.len() as u64, input).without_claim()
    };
    Ok(context.convergence()?.iter().map(row).collect())
}
