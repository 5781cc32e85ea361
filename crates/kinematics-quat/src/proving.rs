//! [`Proving`], a solver whose every outcome is proven by integration, with the counts of its proofs. Their fields are
//! private, so that only proven outcomes are counted.

use std::sync::{Mutex, MutexGuard, PoisonError};

use dynamics::{Error, Outcome, Propagation, RigidToss, SolveError, Solver, Stepping, Toss, Tosses};
use numerics::lanes::SimdLevel;

use crate::QuaternionSolver;
use crate::integration::Integration;
use crate::proven::IntegratedCertificate;

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

    fn add(&mut self, certificate: &IntegratedCertificate) {
        match certificate.outcome() {
            Outcome::Heads => self.heads += 1,
            Outcome::Tails => self.tails += 1,
            Outcome::Undecided => self.undecided += 1,
        }
        self.by[certificate.integration() as usize] += 1;
    }
}

/// A solver whose outcomes are those of [`QuaternionSolver::certify`]. Counting code decides an outcome by the sign of cos
/// θ, which is proven here: an undecided toss has cos θ = 0.
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
}

/// cos θ of a proven outcome, 0 of an undecided one.
fn decided_cos_tilt(certificate: &IntegratedCertificate) -> f64 {
    if certificate.outcome() == Outcome::Undecided { 0.0 } else { certificate.cos_tilt() }
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
        let certificate = self.solver.certify(toss)?;
        self.lock().add(&certificate);
        Ok(decided_cos_tilt(&certificate))
    }

    fn propagate_rigid(&self, toss: &RigidToss) -> Result<Propagation, SolveError> {
        self.solver.certify_rigid(toss).map(|certificate| *certificate.landing())
    }

    fn error_estimate_rigid(&self, _: &RigidToss) -> Result<Option<f64>, SolveError> {
        Ok(None)
    }

    /// A flight without a bound counts as an undecided one.
    fn cos_tilt_rigid(&self, toss: &RigidToss) -> Result<f64, SolveError> {
        let certificate = match self.solver.certify_rigid(toss) {
            Err(SolveError::NotProven { .. }) => self.solver.enclose_rigid(toss)?,
            certificate => certificate?,
        };
        self.lock().add(&certificate);
        Ok(decided_cos_tilt(&certificate))
    }

    fn outcome_at_rigid(&self, _: &RigidToss, cos_tilt: f64) -> Result<Outcome, SolveError> {
        Ok(Outcome::of(cos_tilt, 0.0))
    }

    fn cos_tilts(&self, tosses: &Tosses<'_>, out: &mut [f64]) -> Result<(), Error> {
        assert_eq!(out.len(), tosses.len(), "one result a toss");
        let each = (0..tosses.len()).map(|index| tosses.solve(index, |toss| Ok(*toss)));
        let each = each.collect::<Result<Vec<Toss>, _>>()?;
        let mut counts = IntegratedCounts::default();
        for (index, certificate) in self.solver.certify_all(&each, SimdLevel::widest()).into_iter().enumerate() {
            let certificate = tosses.solve(index, |_| certificate.clone())?;
            counts.add(&certificate);
            out[index] = decided_cos_tilt(&certificate);
        }
        self.merge(&counts);
        Ok(())
    }

    fn outcome_at(&self, _: &Toss, cos_tilt: f64) -> Result<Outcome, SolveError> {
        Ok(Outcome::of(cos_tilt, 0.0))
    }
}

impl Proving {
    fn merge(&self, more: &IntegratedCounts) {
        let mut counts = self.lock();
        counts.heads += more.heads;
        counts.tails += more.tails;
        counts.undecided += more.undecided;
        counts.by.iter_mut().zip(more.by).for_each(|(all, more)| *all += more);
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Attitude, Coin, Formulation, Scheme};

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
            }
            let counts = proving.counts();
            let of = |outcome| 2 * certificates.iter().filter(|each| each.outcome() == outcome).count() as u64;
            let counted = [counts.heads(), counts.tails(), counts.undecided()];
            assert_eq!(counted, [Outcome::Heads, Outcome::Tails, Outcome::Undecided].map(of));
            assert_eq!(Integration::ALL.map(|kind| counts.by(kind)).iter().sum::<u64>(), 8);
            assert_eq!(counts.undecided() > 0, attitude == edge, "a coin that does not turn stays on its edge");
        }
        assert!(Proving::new(QuaternionSolver::new(taylor, Formulation::RAW)).is_err());
    }
}
