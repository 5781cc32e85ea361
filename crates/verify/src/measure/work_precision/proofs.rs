//! Beside the errors of Taylor series the bounds that they prove for them, over a range of tolerances: how much more a
//! proof states than was wrong.

use dynamics::Toss;
use toss::SolveError;

use super::problems::Problem;
use crate::measure::reference::{self, Reference};
use crate::measure::subject::taylor;

/// The flights of a problem at one tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Proof {
    /// The tolerance.
    pub tolerance: f64,
    /// Calls of the right-hand side by launch.
    pub calls: f64,
    /// The largest error of the attitude, against the reference (rad).
    pub error: f64,
    /// The largest bound that is proven for it (rad); π where nothing is proven, which no error exceeds.
    pub bound: f64,
}

/// The proofs of `problem` at two tolerances a decade, from 1e-3 to 1e-15.
///
/// # Errors
/// [`SolveError`] if a problem has no reference; each has one.
pub fn proofs(problem: &Problem) -> Result<Vec<Proof>, SolveError> {
    let exact: Vec<Reference> = problem.tosses.iter().map(reference::of).collect::<Result<_, _>>()?;
    (0..=24).map(|step| proof(&problem.tosses, &exact, 10f64.powf(-3.0 - 0.5 * f64::from(step)))).collect()
}

fn proof(tosses: &[Toss], references: &[Reference], tolerance: f64) -> Result<Proof, SolveError> {
    let solver = taylor(tolerance)?;
    let mut largest = Proof { tolerance, calls: 0.0, error: 0.0, bound: 0.0 };
    for (toss, reference) in tosses.iter().zip(references) {
        let found = solver.enclose(toss)?;
        largest.calls += found.work().rhs_calls as f64 / tosses.len() as f64;
        largest.error = largest.error.max(reference.attitude_error(&found.landing().state.attitude));
        // The angle of two quaternions at this distance.
        let angle = 4.0 * (0.5 * found.attitude_error_bound()).min(1.0).asin();
        largest.bound = largest.bound.max(angle.min(std::f64::consts::PI));
    }
    Ok(largest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::work_precision::problems;

    #[test]
    fn finer_tolerances_prove_more_of_each_kind_of_body_and_no_error_exceeds_its_bound() {
        for (name, finest) in [("ensemble", 2e-12), ("racket", 1e-8)] {
            let problem = problems::all().unwrap().into_iter().find(|problem| problem.name == name).unwrap();
            let proofs = proofs(&problem).unwrap();
            assert!(proofs.iter().all(|proof| proof.error <= proof.bound), "{name}: {proofs:?}");
            let [first, .., last] = proofs[..] else { panic!("{name}: {proofs:?}") };
            assert!(last.bound < finest && last.bound < 1e-6 * first.bound, "{name}: {proofs:?}");
            assert!(last.calls > first.calls, "{name}: {proofs:?}");
        }
    }
}
