//! Proven outcomes of many tosses and nothing else. A coarse flight of a coin takes less time than a fine one, and has a
//! bound, too. An outcome is undecided by it only where cos θ is as small as that bound.

use dynamics::{CoinToss, Counts, Outcome, SolveError, Stage, Tilt, Toss};
use numerics::lanes::SimdLevel;

use crate::prove::certificate::IntegratedCertificate;
use crate::prove::coin_step::bounds;
use crate::prove::driver::{OF_COS_TILT, cos_tilt};
use crate::prove::flight::{attitude_bound, steps};
use crate::taylor::coin::Coins;
use crate::taylor::lockstep::{by_kind, fly_all};
use crate::taylor::plan::StepPlans;
use crate::{Landed, QuaternionSolver};

/// The tolerance of the coarse flights.
const COARSE: f64 = 1e-3;

/// A proven outcome, with cos θ of the flight that decided it. That of an undecided one is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Decided {
    pub(crate) outcome: Outcome,
    pub(crate) cos_tilt: f64,
    /// The bound of its error, which is proven.
    pub(crate) bound: f64,
    pub(crate) stage: Stage,
}

impl Decided {
    fn undecided(stage: Stage) -> Self {
        Self { outcome: Outcome::Undecided, cos_tilt: 0.0, bound: 2.0, stage }
    }

    fn by(certificate: &IntegratedCertificate) -> Self {
        let (outcome, stage) = (certificate.outcome(), certificate.stage());
        match outcome {
            Outcome::Undecided => Self::undecided(stage),
            _ => {
                let (cos_tilt, bound) = (certificate.cos_tilt(), certificate.error_bound());
                Self { outcome, cos_tilt, bound, stage }
            }
        }
    }

    /// The outcome as counts.
    pub(crate) fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        counts.add(self.outcome);
        counts.add_by(self.stage, 1);
        counts
    }

    /// cos θ with the bound of its error.
    pub(crate) fn tilt(&self) -> Tilt {
        Tilt { cos_tilt: self.cos_tilt, error: Some(self.bound) }
    }
}

impl QuaternionSolver {
    /// The outcomes that [`QuaternionSolver::certify_all`] proves, without their landings. Coins are first flown with a coarse
    /// tolerance, whose bounds decide nearly all; the others are flown again. It takes about as long as the landings without
    /// a proof. A flight without a bound is undecided.
    pub fn prove_outcomes(&self, tosses: &[Toss], level: SimdLevel) -> Vec<Result<Outcome, SolveError>> {
        self.decide(tosses, level).into_iter().map(|found| found.map(|found| found.outcome)).collect()
    }

    /// [`QuaternionSolver::prove_outcomes`], with what decided each. Other bodies than coins have no coarse flight: next to
    /// a turn about the middle axis, where flights take longest, those have no bound.
    pub(crate) fn decide(&self, tosses: &[Toss], level: SimdLevel) -> Vec<Result<Decided, SolveError>> {
        by_kind(tosses, |coins| self.decide_coins(coins, level), |bodies| self.decide_bodies(bodies, level))
    }

    fn decide_coins(&self, tosses: &[CoinToss], level: SimdLevel) -> Vec<Result<Decided, SolveError>> {
        let is_finer = self.require_proofs().is_ok() && self.taylor.is_some_and(|taylor| taylor.tolerance < COARSE);
        let undecided = || vec![Ok(Decided::undecided(Stage::Coarse)); tosses.len()];
        let mut found = if is_finer { coarse(tosses, level) } else { undecided() };
        let is_open = |index: &usize| matches!(&found[*index], Ok(found) if found.outcome == Outcome::Undecided);
        let open: Vec<usize> = (0..found.len()).filter(is_open).collect();
        let again: Vec<CoinToss> = open.iter().map(|index| tosses[*index]).collect();
        for (index, certificate) in open.into_iter().zip(self.certify_coins(&again, level)) {
            found[index] = certificate.map(|certificate| Decided::by(&certificate));
        }
        found
    }

    fn decide_bodies(&self, tosses: &[Toss], level: SimdLevel) -> Vec<Result<Decided, SolveError>> {
        if let Err(refused) = self.require_proofs() {
            return vec![Err(refused); tosses.len()];
        }
        let last = if self.is_finest() { Stage::F64 } else { Stage::Finest };
        let decided = |found: Result<IntegratedCertificate, SolveError>| match found {
            Err(SolveError::NotProven { .. }) => Ok(Decided::undecided(last)),
            found => found.map(|certificate| Decided::by(&certificate)),
        };
        self.certify_bodies(tosses, level).into_iter().map(decided).collect()
    }
}

/// The outcomes that coarse flights prove; the others are undecided.
fn coarse(tosses: &[CoinToss], level: SimdLevel) -> Vec<Result<Decided, SolveError>> {
    let plans = StepPlans::of_coarse_coins(COARSE);
    let mut found = vec![Ok(Decided::undecided(Stage::Coarse)); tosses.len()];
    let mut flown = Vec::with_capacity(tosses.len());
    fly_all::<Coins>(&plans, tosses, level, |index, landed| match landed {
        Ok(Landed { flight, turn, record: Some(record), .. }) => {
            flown.push((index, cos_tilt(tosses[index].launch.attitude(), turn), flight, record));
        }
        Ok(_) => {}
        Err(error) => found[index] = Err(error),
    });
    let each: Vec<_> = flown.iter().map(|(index, _, flight, record)| steps(&tosses[*index], flight, record)).collect();
    for ((index, cos_tilt, flight, record), bound) in flown.into_iter().zip(bounds(&plans.short, level, &each)) {
        let bound = attitude_bound(&tosses[index], &flight, &record, &bound);
        let bound = 2.0 * bound + OF_COS_TILT;
        let outcome = Outcome::of(cos_tilt, bound);
        if outcome != Outcome::Undecided {
            found[index] = Ok(Decided { outcome, cos_tilt, bound, stage: Stage::Coarse });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use dynamics::{Attitude, Body, Coin, Formulation, Launch, Scheme, Stepping, TimeOfFlight};

    use super::*;

    fn solver(tolerance: f64) -> QuaternionSolver {
        QuaternionSolver::new(Stepping::adaptive(Scheme::TAYLOR, tolerance).unwrap(), Formulation::default())
    }

    /// Tosses of about this phase; every second one lands about as near to the edge as coarse flights are off.
    fn tosses(phase: f64) -> Vec<Toss> {
        let toss = |index: u32| {
            let part = |square: f64| (f64::from(index) * square.sqrt()).fract();
            let coin = Coin::from_moments(1.0, 2.0 * part(2.0)).unwrap();
            let at = |time| {
                let launch = Launch::new([part(3.0) + 0.1, part(5.0), part(7.0)], TimeOfFlight::Given(time)).unwrap();
                CoinToss { coin, launch: launch.with_tilt(3.0 * part(11.0)).unwrap() }
            };
            let cos_tilt = |time| exact::certified::cos_tilt(&at(time)).unwrap();
            let (mut before, mut after) = (phase * (0.5 + 0.5 * part(13.0)), phase * 1.5);
            let first = cos_tilt(before) > 0.0;
            if index.is_multiple_of(2) || (cos_tilt(after) > 0.0) == first {
                return at(before).into();
            }
            while after - before > 10f64.powf(-9.0 * part(17.0)) {
                let middle = f64::midpoint(before, after);
                if (cos_tilt(middle) > 0.0) == first { before = middle } else { after = middle }
            }
            at(before).into()
        };
        (0..400).map(toss).collect()
    }

    #[test]
    fn outcomes_are_those_of_the_certificates_at_every_simd_level() {
        let solver = solver(1e-10);
        for phase in [30.0, 300.0, 3000.0] {
            let tosses = tosses(phase);
            let certified = solver.certify_all(&tosses, SimdLevel::widest());
            let expected: Vec<_> = certified.into_iter().map(|found| found.map(|found| found.outcome())).collect();
            for level in SimdLevel::all() {
                assert_eq!(solver.prove_outcomes(&tosses, level), expected, "{}", level.name());
            }
            let coins: Vec<CoinToss> = tosses.iter().filter_map(Toss::coin).collect();
            let decided = coarse(&coins, SimdLevel::widest());
            let is_open = |found: &&Result<Decided, SolveError>| found.as_ref().unwrap().outcome == Outcome::Undecided;
            let open = decided.iter().filter(is_open).count();
            assert!((5..200).contains(&open), "phase {phase}: coarse flights leave {open} of 400 open");
        }
    }

    /// A body that is as near to its edge as the last digit tells, whose certificate has a cos θ within its bound.
    #[test]
    fn an_undecided_body_has_no_cos_tilt() {
        let nearly = Attitude::from_components([1.0, 1.0 + f64::EPSILON, 0.0, 0.0]).unwrap();
        let launch = Launch::new([0.0, 7.0, 0.0], TimeOfFlight::Given(0.3)).unwrap().with_attitude(nearly);
        let toss = Toss { body: Body::from_moments([1.0, 2.0, 2.5]).unwrap(), launch };
        let certificate = solver(1e-9).certify(&toss).unwrap();
        assert!(certificate.outcome() == Outcome::Undecided && certificate.cos_tilt() != 0.0, "{certificate:?}");
        let decided = solver(1e-9).decide(&[toss], SimdLevel::for_one_lane()).remove(0).unwrap();
        assert_eq!((decided.outcome, decided.cos_tilt, decided.bound), (Outcome::Undecided, 0.0, 2.0));
    }

    #[test]
    fn ties_stay_undecided_and_errors_are_those_of_the_certificates() {
        let edge = Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap();
        let launch = |time| Launch::new([0.0, 7.0, 0.0], TimeOfFlight::Given(time)).unwrap().with_attitude(edge);
        let tosses = [1.0, 0.0, 1e17].map(|time| Toss::new(Coin::DISC, launch(time)));
        let found = solver(1e-9).prove_outcomes(&tosses, SimdLevel::widest());
        assert_eq!(found[..2], [Ok(Outcome::Undecided), Ok(Outcome::Undecided)]);
        assert!(matches!(found[2], Err(SolveError::PhaseTooLarge { .. })));
        let heads = Toss::new(Coin::DISC, Launch::new([0.5, 0.25, 9.0], TimeOfFlight::Given(1.0)).unwrap());
        // A solver that is as coarse as a coarse flight needs no other one.
        let decided = solver(COARSE).decide(&[heads], SimdLevel::widest()).remove(0).unwrap();
        assert_eq!((decided.outcome, decided.stage), (Outcome::Heads, Stage::F64));
        // A solver that proves nothing has no outcome of a coarse flight either.
        let taylor = Stepping::adaptive(Scheme::TAYLOR, 1e-9).unwrap();
        assert_eq!(solver(1e-9).prove_outcomes(&[heads], SimdLevel::widest()), [Ok(Outcome::Heads)]);
        for stepping in [Stepping::DEFAULT, taylor] {
            let raw = QuaternionSolver::new(stepping, Formulation::RAW);
            for refused in raw.prove_outcomes(&[tosses[0], heads], SimdLevel::widest()) {
                assert!(matches!(refused, Err(SolveError::NotProven { .. })), "{refused:?}");
            }
        }
        assert_eq!(solver(1e-2).prove_outcomes(&tosses[..1], SimdLevel::widest()), [Ok(Outcome::Undecided)]);
    }
}
