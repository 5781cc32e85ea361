//! This file makes the exact motion a [`Solver`], so that it can be named, compared and used like the integrators. It
//! takes no steps, and its outcomes are proven.

use dynamics::{Landing, Settings, SolveError, Solver, SolverEntry, Tilt, Toss, Work};

use crate::motion::CoinMotion;
use crate::rigid::{cos_tilt_with_error, landed};

/// The solver that evaluates the [exact motion](crate::ExactMotion). It takes no steps, and its outcomes are those of
/// [`certify`](crate::certify).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ExactSolver;

impl ExactSolver {
    /// Name of the solver in the registry.
    pub const NAME: &'static str = "exact";

    /// Entry of the solver in the registry.
    pub fn entry() -> SolverEntry {
        let summary = "closed form of the motion: precession about S, spin about n";
        SolverEntry::new(Self::NAME, summary, |_: &Settings| Box::new(Self)).with_color([0, 0, 0])
    }
}

impl Solver for ExactSolver {
    fn name(&self) -> &str {
        Self::NAME
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let (state, (cos_tilt, error)) = match toss.coin() {
            Some(coin) => (CoinMotion::new(&coin).state(toss.launch.time_of_flight())?, cos_tilt_with_error(toss)?),
            None => landed(toss)?,
        };
        Ok(Landing::new(state, Work::default()).with_cos_tilt(cos_tilt).with_error(Some(error)))
    }

    fn tilt(&self, toss: &Toss) -> Result<Tilt, SolveError> {
        let (cos_tilt, error) = cos_tilt_with_error(toss)?;
        Ok(Tilt { cos_tilt, error: Some(error) })
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Attitude, Body, Coin, Launch, Outcome, TimeOfFlight, Vector3};

    use super::*;
    use crate::motion::COS_TILT_ERROR;
    use crate::{certify, margin};

    fn launch() -> Launch {
        Launch::new(Vector3::new(20.0, 3.0, 1.0), TimeOfFlight::Given(0.6)).unwrap()
    }

    #[test]
    fn coins_and_other_bodies_land_with_proven_outcomes() {
        for body in [Body::from(Coin::PAPER), Body::from_moments([1.0, 1.5, 2.0]).unwrap()] {
            let toss = Toss::new(body, launch());
            let landing = ExactSolver.land(&toss).unwrap();
            let rounded = f64::EPSILON * landing.cos_tilt.abs();
            let expected = if toss.coin().is_some() { COS_TILT_ERROR } else { rounded };
            assert_eq!((landing.error, ExactSolver.name()), (Some(expected), "exact"));
            assert_eq!(ExactSolver.tilt(&toss), Ok(landing.tilt()));
            assert_eq!(landing.outcome(), certify(&toss).unwrap().outcome());
            assert!((landing.state.attitude.cos_tilt() - landing.cos_tilt).abs() < 1e-15);
        }
    }

    /// The time of the flip and its neighbours in f64, where |cos θ| is smaller than its error in f64.
    #[test]
    fn next_to_an_edge_the_outcome_is_that_of_the_certificate_and_the_bound_holds() {
        for body in [Body::from(Coin::PAPER), Body::from_moments([1.0, 1.5, 2.0]).unwrap()] {
            let at = |time| Toss::new(body, Launch::new([9.0, 3.0, 1.0], TimeOfFlight::Given(time)).unwrap());
            let next_flip = |time: f64| time + margin(&at(time)).unwrap().time.unwrap();
            // The margin of a toss next to a flip has more digits of it.
            let flip = next_flip(next_flip(0.3));
            let mut near = 0;
            for ulp in -20..20 {
                let toss = at(f64::from_bits(flip.to_bits().saturating_add_signed(ulp)));
                let tilt = ExactSolver.tilt(&toss).unwrap();
                assert_eq!(tilt.outcome(), certify(&toss).unwrap().outcome(), "{ulp}");
                near += u32::from(tilt.cos_tilt.abs() < COS_TILT_ERROR);
            }
            assert!(near > 0, "{body:?}");
        }
        let edge = Launch::new([0.0; 3], TimeOfFlight::Given(1.0)).unwrap();
        let edge = edge.with_attitude(Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap());
        let tilt = ExactSolver.tilt(&Toss::new(Coin::PAPER, edge)).unwrap();
        assert_eq!((tilt.cos_tilt, tilt.outcome()), (0.0, Outcome::Undecided));
    }
}
