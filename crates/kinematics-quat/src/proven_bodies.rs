//! Outcomes of any rigid body, proven by integration as those of coins are. A flight that passes next to a turn about the
//! middle axis multiplies its errors; if the bound then decides nothing even at the finest tolerance, the outcome stays
//! undecided, or nothing is stated.

use dynamics::{Outcome, RigidFlight, RigidToss, SolveError};
use numerics::lanes::SimdLevel;

use crate::bodies::{Enclosed, compared};
use crate::enclosure::attitude_bound_of_body;
use crate::integration::Integration;
use crate::lockstep::{by_kind, fly};
use crate::plan::Plans;
use crate::proven::IntegratedCertificate;
use crate::{Landed, QuaternionSolver, RigidSystem};

/// Why a flight without a bound proves nothing.
const NO_BOUND: &str =
    "next to a turn about the middle axis, or next to equal moments, the errors of this flight have no bound";

impl QuaternionSolver {
    /// [`QuaternionSolver::certify`] of any rigid body, first with the solver's own steps, then by Taylor series with
    /// the finest tolerance.
    ///
    /// # Errors
    /// As [`QuaternionSolver::certify`], and [`SolveError::NotProven`] for a flight whose errors have no bound.
    pub fn certify_rigid(&self, toss: &RigidToss) -> Result<IntegratedCertificate, SolveError> {
        let mut found = self.certify_all_rigid(std::slice::from_ref(toss), SimdLevel::for_one_lane());
        found.pop().unwrap_or(Err(SolveError::NotFinite { time: 0.0 }))
    }

    /// [`QuaternionSolver::certify_rigid`] of each of `tosses`, in their order and with the same bits. As many flights are
    /// computed at once as a register at the SIMD `level` has lanes.
    pub fn certify_all_rigid(
        &self,
        tosses: &[RigidToss],
        level: SimdLevel,
    ) -> Vec<Result<IntegratedCertificate, SolveError>> {
        if let Err(error) = self.require_proofs() {
            return vec![Err(error); tosses.len()];
        }
        let bodies = |flown: &[RigidToss]| {
            let first = self.enclosed_all_bodies(flown, level);
            flown.iter().zip(first).map(|(toss, first)| first.and_then(|first| self.decided(toss, first))).collect()
        };
        by_kind(tosses, |coins| self.certify_all(coins, level), bodies)
    }

    /// [`QuaternionSolver::enclose`] of any rigid body. Without a bound it is 2.
    ///
    /// # Errors
    /// As [`QuaternionSolver::certify`].
    pub fn enclose_rigid(&self, toss: &RigidToss) -> Result<IntegratedCertificate, SolveError> {
        if let Some(toss) = toss.symmetric() {
            return self.enclose(&toss);
        }
        self.require_proofs()?;
        let mut found = self.enclosed_all_bodies(std::slice::from_ref(toss), SimdLevel::for_one_lane());
        found.pop().unwrap_or(Err(SolveError::NotFinite { time: 0.0 }))
    }

    /// The landings by the solver's own steps with their bounds.
    fn enclosed_all_bodies(
        &self,
        tosses: &[RigidToss],
        level: SimdLevel,
    ) -> Vec<Result<IntegratedCertificate, SolveError>> {
        match &self.taylor {
            Some(taylor) => self.enclosed_bodies(tosses, &taylor.bodies, level, Integration::AsConfigured),
            None => tosses.iter().map(|toss| self.enclosed_by_rigid_steps(toss, level)).collect(),
        }
    }

    /// The landing of `toss` by the solver's Runge-Kutta scheme with its bound.
    fn enclosed_by_rigid_steps(&self, toss: &RigidToss, level: SimdLevel) -> Result<IntegratedCertificate, SolveError> {
        let flight = RigidFlight::new(toss)?;
        let accepted = RigidSystem::integrated(&flight, &self.stepping)?;
        let (bound, coefficients) = compared(toss, &flight, &self.stepping, &accepted, level);
        let mut landed = Landed { enclosed: bound, ..Landed::at_rigid(&flight, &accepted)? };
        landed.work.rhs_calls += coefficients;
        self.stated_rigid(toss, &landed, Integration::AsConfigured)
    }

    /// The landing of `toss` in this end state.
    fn stated_rigid(
        &self,
        toss: &RigidToss,
        landed: &Landed,
        integration: Integration,
    ) -> Result<IntegratedCertificate, SolveError> {
        let bound = landed.enclosed.as_ref();
        let bound = bound.map_or(f64::INFINITY, |bound| attitude_bound_of_body(&toss.launch, &landed.flight, bound));
        self.stated(toss.launch.attitude(), landed, bound, integration)
    }

    /// The landings by these `plans` with their bounds.
    fn enclosed_bodies(
        &self,
        tosses: &[RigidToss],
        plans: &Plans,
        level: SimdLevel,
        integration: Integration,
    ) -> Vec<Result<IntegratedCertificate, SolveError>> {
        let mut found = vec![Err(SolveError::NotFinite { time: 0.0 }); tosses.len()];
        fly::<Enclosed>(plans, tosses, level, |index, landed| {
            found[index] = landed.and_then(|landed| self.stated_rigid(&tosses[index], &landed, integration));
        });
        found
    }

    /// The certificate of the finest tolerance, if this one does not decide.
    fn decided(&self, toss: &RigidToss, first: IntegratedCertificate) -> Result<IntegratedCertificate, SolveError> {
        let mut last = first;
        if first.outcome() == Outcome::Undecided && !self.is_finest() {
            let (plans, one) = (Plans::of_bodies(f64::EPSILON), std::slice::from_ref(toss));
            let found = self.enclosed_bodies(one, &plans, SimdLevel::for_one_lane(), Integration::Finest).pop();
            if let Some(found) = found.transpose()? {
                last = found.with_work(first.work() + found.work());
            }
        }
        if last.error_bound() < 2.0 {
            return Ok(last);
        }
        Err(SolveError::NotProven { solver: Self::NAME.to_owned(), why: NO_BOUND })
    }
}

#[cfg(test)]
pub(crate) mod tests;
