//! [`Proving`], a solver whose every outcome is proven by integration, with the counts of its proofs. Their fields are
//! private, so that only proven outcomes are counted.

use std::ops::Deref;
use std::sync::{Mutex, PoisonError};

use dynamics::{Counts, Error, Landing, SolveError, Solver, Stepping, Tilt, Toss};
use numerics::lanes::SimdLevel;

use crate::solver::QuaternionSolver;

/// Numbers of outcomes that were proven by integration. The most digits left those undecided that are, such as ties.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct IntegratedCounts(Counts);

impl Deref for IntegratedCounts {
    type Target = Counts;

    fn deref(&self) -> &Counts {
        &self.0
    }
}

/// A solver whose outcomes are those that [`QuaternionSolver::certify`] proves. Counting code decides an outcome by cos θ and
/// its error, which is proven here: both are those of the flight that decided, which may be a coarse one, and an undecided
/// toss has cos θ = 0.
#[derive(Debug)]
pub struct Proving {
    solver: QuaternionSolver,
    counts: Mutex<Counts>,
}

impl Proving {
    /// Proves the outcomes by `solver`.
    pub fn new(solver: QuaternionSolver) -> Result<Self, SolveError> {
        solver.require_proofs()?;
        Ok(Self { solver, counts: Mutex::default() })
    }

    /// The numbers of tosses that were solved so far.
    pub fn counts(&self) -> IntegratedCounts {
        IntegratedCounts(*self.counts.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Counts outcomes that were proven.
    fn count(&self, counts: Counts) {
        let mut all = self.counts.lock().unwrap_or_else(PoisonError::into_inner);
        *all = *all + counts;
    }
}

impl Solver for Proving {
    fn name(&self) -> &str {
        self.solver.name()
    }

    fn stepping(&self) -> Option<Stepping> {
        self.solver.stepping()
    }

    /// The landing, which is not counted.
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        self.solver.certify(toss).map(|certificate| certificate.landing().with_error(certificate.error_bound()))
    }

    fn tilt(&self, toss: &Toss) -> Result<Tilt, SolveError> {
        let found = self.solver.decide(std::slice::from_ref(toss), SimdLevel::for_one_lane()).remove(0)?;
        self.count(found.counts());
        Ok(found.tilt())
    }

    fn tilts(&self, tosses: &[Toss], out: &mut [Tilt]) -> Result<(), Error> {
        assert_eq!(out.len(), tosses.len(), "one result a toss");
        let mut counts = Counts::default();
        let mut each = self.solver.decide(tosses, SimdLevel::widest()).into_iter().enumerate();
        let done = each.try_for_each(|(index, found)| {
            let found = found.map_err(|source| Error::of_launch(index, &tosses[index], source))?;
            counts = counts + found.counts();
            out[index] = found.tilt();
            Ok(())
        });
        self.count(counts);
        done
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Attitude, Body, Coin, Formulation, Launch, Outcome, Scheme, Stage, TimeOfFlight, Tosses};

    use super::*;

    /// What no solver answers.
    const UNSET: Tilt = Tilt { cos_tilt: f64::NAN, error: None };

    #[test]
    fn outcomes_are_those_of_the_certificates_and_are_counted() {
        let [x, y, z, speed] =
            [[9.0, 3.0, 0.0, 0.0], [-4.0, 2.0, 1.0, 0.0], [3.0, 0.5, 2.0, 0.0], [3.0, 4.0, 5.0, 1.0]];
        let edge = Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap();
        let taylor = Stepping::adaptive(Scheme::TAYLOR, 1e-9).unwrap();
        let solver = QuaternionSolver::new(taylor, Formulation::default());
        for attitude in [Attitude::IDENTITY, edge] {
            let (proving, mut found) = (Proving::new(solver).unwrap(), [UNSET; 4]);
            assert_eq!((proving.name(), proving.stepping()), (solver.name(), solver.stepping()));
            let tosses = Tosses::new(Coin::PAPER, attitude, 9.81, [&x, &y, &z], &speed).unwrap();
            let each = tosses.each().unwrap();
            proving.tilts(&each, &mut found).unwrap();
            let certificates: Vec<_> = each.iter().map(|toss| solver.certify(toss).unwrap()).collect();
            let alone: Vec<Tilt> = each.iter().map(|toss| proving.tilt(toss).unwrap()).collect();
            assert_eq!(found[..], alone);
            for (index, certificate) in certificates.iter().enumerate() {
                assert_eq!(found[index].outcome(), certificate.outcome());
                let landing = proving.land(&each[index]).unwrap();
                assert_eq!(landing, certificate.landing().with_error(certificate.error_bound()));
                assert_eq!(landing.outcome(), certificate.outcome());
                assert!((found[index].cos_tilt - certificate.cos_tilt()).abs() < 1e-2);
            }
            let counts = proving.counts();
            let of = |outcome| 2 * certificates.iter().filter(|each| each.outcome() == outcome).count() as u64;
            let counted = [counts.heads, counts.tails, counts.undecided];
            assert_eq!(counted, [Outcome::Heads, Outcome::Tails, Outcome::Undecided].map(of));
            assert_eq!(Stage::ALL.map(|kind| counts.by(kind)).iter().sum::<u64>(), 8);
            let coarse = certificates.iter().filter(|each| each.outcome() != Outcome::Undecided).count() as u64;
            assert_eq!(counts.by(Stage::Coarse), 2 * coarse, "none of these is near an edge");
            assert_eq!(counts.undecided > 0, attitude == edge, "a coin that does not turn stays on its edge");
        }
        assert!(Proving::new(QuaternionSolver::new(taylor, Formulation::RAW)).is_err());
    }

    #[test]
    fn bodies_in_lanes_are_those_one_by_one_and_without_a_bound_undecided() {
        let racket = Body::from_moments([0.0012, 0.0176, 0.0164]).unwrap();
        let toss = |(index, time): (u32, f64)| {
            let off = if index == 0 { 1e-9 } else { 0.3 };
            let rate = [1e-9, off, 9.0 + f64::from(index)];
            let (body, time) = if index == 4 { (Coin::PAPER.into(), 1.0) } else { (racket, time) };
            Toss { body, launch: Launch::new(rate, TimeOfFlight::Given(time)).unwrap() }
        };
        // The last one starts next to a turn about the middle axis, and turns over often.
        let tosses = [(1, 0.1), (2, 0.7), (3, 1.0), (4, 0.0), (0, 400.0)].map(toss);
        let taylor = Stepping::adaptive(Scheme::TAYLOR, 1e-9).unwrap();
        let solver = QuaternionSolver::new(taylor, Formulation::default());
        let proving = Proving::new(solver).unwrap();
        let mut found = [UNSET; 5];
        proving.tilts(&tosses, &mut found).unwrap();
        assert_eq!(tosses.map(|toss| proving.tilt(&toss).unwrap()), found);
        let refused = solver.certify(&tosses[4]).unwrap_err();
        assert!(matches!(refused, SolveError::NotProven { .. }) && found[4].cos_tilt == 0.0, "{refused}");
        for (toss, found) in tosses[..4].iter().zip(found) {
            assert_eq!(found.outcome(), exact::certify(toss).unwrap().outcome());
        }
        let counts = proving.counts();
        let by = Stage::ALL.map(|kind| counts.by(kind));
        assert_eq!((by, counts.undecided), ([2, 6, 2, 0, 0], 2));
        // Of a solver with the finest tolerance no other flight is finer.
        let finest = Stepping::adaptive(Scheme::TAYLOR, f64::EPSILON).unwrap();
        let proving = Proving::new(QuaternionSolver::new(finest, Formulation::default())).unwrap();
        proving.tilts(&tosses, &mut found).unwrap();
        let by = Stage::ALL.map(|kind| proving.counts().by(kind));
        assert_eq!((by, proving.counts().undecided), ([1, 4, 0, 0, 0], 1));
    }
}
