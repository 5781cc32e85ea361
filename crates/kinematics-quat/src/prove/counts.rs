//! [`Proving`], a solver whose every outcome is proven by integration, with the counts of its proofs. Their fields are
//! private, so that only proven outcomes are counted.

use std::sync::{Mutex, MutexGuard, PoisonError};

use dynamics::{Error, Outcome, Propagation, RigidToss, SolveError, Solver, Stepping, Toss, Tosses};
use numerics::lanes::SimdLevel;

use crate::QuaternionSolver;
use crate::prove::certificate::Integration;
use crate::prove::outcomes::Decided;

/// Numbers of outcomes that were proven by integration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct IntegratedCounts {
    heads: u64,
    tails: u64,
    undecided: u64,
    by: [u64; Integration::ALL.len()],
}

impl IntegratedCounts {
    /// Number of tosses that are proven to land heads.
    pub fn heads(&self) -> u64 {
        self.heads
    }

    /// Number of tosses that are proven to land tails.
    pub fn tails(&self) -> u64 {
        self.tails
    }

    /// Number of tosses that the most digits left undecided, such as ties.
    pub fn undecided(&self) -> u64 {
        self.undecided
    }

    /// Number of tosses that an integration of this kind decided, or left undecided as the last one.
    pub fn by(&self, integration: Integration) -> u64 {
        self.by[integration as usize]
    }

    fn add(&mut self, found: &Decided) {
        match found.outcome {
            Outcome::Heads => self.heads += 1,
            Outcome::Tails => self.tails += 1,
            Outcome::Undecided => self.undecided += 1,
        }
        self.by[found.integration as usize] += 1;
    }

    fn merge(&mut self, more: &Self) {
        self.heads += more.heads;
        self.tails += more.tails;
        self.undecided += more.undecided;
        self.by.iter_mut().zip(more.by).for_each(|(all, more)| *all += more);
    }
}

/// A solver whose outcomes are those of [`QuaternionSolver::prove_outcomes`] and, of bodies, of
/// [`QuaternionSolver::certify_all_rigid`]. Counting code decides an outcome by the sign of cos θ, which is proven here: it
/// is that of the flight that decided, which may be a coarse one, and an undecided toss has cos θ = 0.
#[derive(Debug)]
pub struct Proving {
    solver: QuaternionSolver,
    counts: Mutex<IntegratedCounts>,
}

impl Proving {
    /// Proves the outcomes by `solver`.
    ///
    /// # Errors
    /// [`SolveError::NotProven`] for a solver that proves nothing.
    pub fn new(solver: QuaternionSolver) -> Result<Self, SolveError> {
        solver.require_proofs()?;
        Ok(Self { solver, counts: Mutex::default() })
    }

    /// The numbers of tosses that were solved so far.
    pub fn counts(&self) -> IntegratedCounts {
        *self.lock()
    }

    fn lock(&self) -> MutexGuard<'_, IntegratedCounts> {
        self.counts.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Writes the cos θ of tosses that have been `found` into `out` and counts them, if all have an answer. `failed` says
    /// which toss has none.
    fn counted(
        &self,
        found: Vec<Result<Decided, SolveError>>,
        out: &mut [f64],
        failed: impl Fn(usize, SolveError) -> Error,
    ) -> Result<(), Error> {
        assert_eq!(out.len(), found.len(), "one result a toss");
        let mut counts = IntegratedCounts::default();
        for (index, (found, out)) in found.into_iter().zip(out).enumerate() {
            let found = found.map_err(|source| failed(index, source))?;
            counts.add(&found);
            *out = found.cos_tilt;
        }
        self.lock().merge(&counts);
        Ok(())
    }

    /// cos θ of the only toss that has been `found`, which is counted.
    fn one(&self, found: Vec<Result<Decided, SolveError>>) -> Result<f64, SolveError> {
        let found = found.into_iter().next().unwrap_or(Err(SolveError::NotFinite { time: 0.0 }))?;
        self.lock().add(&found);
        Ok(found.cos_tilt)
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
    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
        self.solver.certify(toss).map(|certificate| *certificate.landing())
    }

    /// `None`: outcomes are proven, not estimated.
    fn error_estimate(&self, _: &Toss) -> Result<Option<f64>, SolveError> {
        Ok(None)
    }

    fn cos_tilt(&self, toss: &Toss) -> Result<f64, SolveError> {
        self.one(self.solver.decide(std::slice::from_ref(toss), SimdLevel::for_one_lane()))
    }

    fn cos_tilts(&self, tosses: &Tosses<'_>, out: &mut [f64]) -> Result<(), Error> {
        let each = tosses.each()?;
        let failed = |index, source| Error::of_launch(index, &each[index].into(), source);
        self.counted(self.solver.decide(&each, SimdLevel::widest()), out, failed)
    }

    fn outcome_at(&self, _: &Toss, cos_tilt: f64) -> Result<Outcome, SolveError> {
        Ok(Outcome::of(cos_tilt, 0.0))
    }

    fn propagate_rigid(&self, toss: &RigidToss) -> Result<Propagation, SolveError> {
        self.solver.certify_rigid(toss).map(|certificate| *certificate.landing())
    }

    fn error_estimate_rigid(&self, _: &RigidToss) -> Result<Option<f64>, SolveError> {
        Ok(None)
    }

    /// A flight without a bound counts as an undecided one.
    fn cos_tilt_rigid(&self, toss: &RigidToss) -> Result<f64, SolveError> {
        self.one(self.solver.decide_rigid(std::slice::from_ref(toss), SimdLevel::for_one_lane()))
    }

    fn cos_tilts_rigid(&self, tosses: &[RigidToss], out: &mut [f64]) -> Result<(), Error> {
        let failed = |index: usize, source| Error::of_launch(index, &tosses[index], source);
        self.counted(self.solver.decide_rigid(tosses, SimdLevel::widest()), out, failed)
    }

    fn outcome_at_rigid(&self, _: &RigidToss, cos_tilt: f64) -> Result<Outcome, SolveError> {
        Ok(Outcome::of(cos_tilt, 0.0))
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Attitude, Body, Coin, Formulation, Launch, Scheme, TimeOfFlight};

    use super::*;

    #[test]
    fn outcomes_are_those_of_the_certificates_and_are_counted() {
        let [x, y, z, speed] =
            [[9.0, 3.0, 0.0, 0.0], [-4.0, 2.0, 1.0, 0.0], [3.0, 0.5, 2.0, 0.0], [3.0, 4.0, 5.0, 1.0]];
        let edge = Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap();
        let taylor = Stepping::adaptive(Scheme::TAYLOR, 1e-9).unwrap();
        let solver = QuaternionSolver::new(taylor, Formulation::default());
        for attitude in [Attitude::IDENTITY, edge] {
            let (proving, mut found) = (Proving::new(solver).unwrap(), [f64::NAN; 4]);
            let tosses = Tosses::new(Coin::PAPER, attitude, 9.81, [&x, &y, &z], &speed).unwrap();
            proving.cos_tilts(&tosses, &mut found).unwrap();
            let each = [0, 1, 2, 3].map(|index| tosses.toss(index).unwrap());
            let certificates = each.map(|toss| solver.certify(&toss).unwrap());
            assert_eq!(each.map(|toss| proving.cos_tilt(&toss).unwrap()), found);
            for (index, certificate) in certificates.iter().enumerate() {
                assert_eq!(proving.outcome_at(&each[index], found[index]), Ok(certificate.outcome()));
                assert_eq!(proving.propagate(&each[index]).as_ref(), Ok(certificate.landing()));
                assert!((found[index] - certificate.cos_tilt()).abs() < 1e-2);
            }
            let rigid = each.map(RigidToss::from);
            let mut of_bodies = [f64::NAN; 4];
            proving.cos_tilts_rigid(&rigid, &mut of_bodies).unwrap();
            assert_eq!(of_bodies, found);
            let counts = proving.counts();
            let of = |outcome| 3 * certificates.iter().filter(|each| each.outcome() == outcome).count() as u64;
            let counted = [counts.heads(), counts.tails(), counts.undecided()];
            assert_eq!(counted, [Outcome::Heads, Outcome::Tails, Outcome::Undecided].map(of));
            assert_eq!(Integration::ALL.map(|kind| counts.by(kind)).iter().sum::<u64>(), 12);
            let coarse = certificates.iter().filter(|each| each.outcome() != Outcome::Undecided).count() as u64;
            assert_eq!(counts.by(Integration::Coarse), 3 * coarse, "none of these is near an edge");
            assert_eq!(counts.undecided() > 0, attitude == edge, "a coin that does not turn stays on its edge");
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
            RigidToss { body, launch: Launch::new(rate, TimeOfFlight::Given(time)).unwrap() }
        };
        // The last one starts next to a turn about the middle axis, and turns over often.
        let tosses = [(1, 0.1), (2, 0.7), (3, 1.0), (4, 0.0), (0, 400.0)].map(toss);
        let taylor = Stepping::adaptive(Scheme::TAYLOR, 1e-9).unwrap();
        let solver = QuaternionSolver::new(taylor, Formulation::default());
        let proving = Proving::new(solver).unwrap();
        let mut found = [f64::NAN; 5];
        proving.cos_tilts_rigid(&tosses, &mut found).unwrap();
        assert_eq!(tosses.map(|toss| proving.cos_tilt_rigid(&toss).unwrap()), found);
        let refused = solver.certify_rigid(&tosses[4]).unwrap_err();
        assert!(matches!(refused, SolveError::NotProven { .. }) && found[4] == 0.0, "{refused}");
        for (toss, found) in tosses[..4].iter().zip(found) {
            assert_eq!(proving.outcome_at_rigid(toss, found), Ok(exact::certify_rigid(toss).unwrap().outcome()));
        }
        let counts = proving.counts();
        let by = Integration::ALL.map(|kind| counts.by(kind));
        assert_eq!((by, counts.undecided()), ([2, 6, 2, 0, 0], 2));
        let plain: Vec<f64> = solver
            .propagate_all_rigid(&tosses, SimdLevel::widest())
            .into_iter()
            .map(|landing| landing.unwrap().cos_tilt)
            .collect();
        let mut in_lanes = [f64::NAN; 5];
        solver.cos_tilts_rigid(&tosses, &mut in_lanes).unwrap();
        assert_eq!(plain, in_lanes);
    }
}
