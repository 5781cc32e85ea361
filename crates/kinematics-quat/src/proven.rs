//! Outcomes proven by integration. A flight bounds its own error, by the theorem of `docs/proofs/enclosure.md`; an
//! outcome is proven where |cos θ| exceeds the bound. The closed form of the motion is not used, so that these proofs and
//! those of the crate `exact` check each other.
//!
//! An [`IntegratedCertificate`] has private fields and no public constructor, so that no other code can pass off an
//! estimate as a proof.

use dynamics::{Attitude, Outcome, Propagation, SolveError, State, Toss, Work};
use numerics::UNIT_ROUNDOFF;
use numerics::lanes::SimdLevel;

use crate::coins::Coins;
use crate::defect::{StepBound, bounds};
use crate::digits::{self, in_digits, in_double_double};
use crate::enclosure::{attitude_bound, steps};
use crate::integration::Integration;
use crate::lockstep::fly;
use crate::plan::Plans;
use crate::{Landed, QuaternionSolver};

/// A landing by integration with proven bounds of its errors, for exactly the numbers that the toss was made from.
///
/// Nothing but [`QuaternionSolver::certify`] and its like make one:
///
/// ```compile_fail,E0451
/// fn forged(one: kinematics_quat::IntegratedCertificate) -> kinematics_quat::IntegratedCertificate {
///     kinematics_quat::IntegratedCertificate { error_bound: 0.0, ..one }
/// }
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntegratedCertificate {
    outcome: Outcome,
    landing: Propagation,
    error_bound: f64,
    attitude_error_bound: f64,
    integration: Integration,
}

impl IntegratedCertificate {
    /// The face that the toss lands on, which is proven; [`Outcome::Undecided`] if cos θ is within its bound even with the
    /// most digits, as it is for a tie.
    pub fn outcome(&self) -> Outcome {
        self.outcome
    }

    /// cos θ at landing, to within [`Self::error_bound`].
    pub fn cos_tilt(&self) -> f64 {
        self.landing.cos_tilt
    }

    /// An upper bound of the error of cos θ, which is proven; at most 2.
    pub fn error_bound(&self) -> f64 {
        self.error_bound
    }

    /// State and cos θ at landing, with the work of all flights that it took.
    pub fn landing(&self) -> &Propagation {
        &self.landing
    }

    /// An upper bound of the distance |Q - Q̂| between the quaternion of the landing and that of the ideal flight, of
    /// either sign, which is proven; at most 2. The angle between the two attitudes is at most 4 asin of half of it.
    pub fn attitude_error_bound(&self) -> f64 {
        self.attitude_error_bound
    }

    /// An upper bound of the angle between the attitude of the landing and that of the ideal flight (rad), which is
    /// proven; π where nothing is proven.
    pub fn angle_bound(&self) -> f64 {
        // The division, the arcsine and the product round by less than 8 u.
        let angle = 4.0 * (0.5 * self.attitude_error_bound).min(1.0).asin() * (1.0 + 8.0 * UNIT_ROUNDOFF);
        angle.min(std::f64::consts::PI)
    }

    /// The arithmetic of the flight that decided the outcome.
    pub fn integration(&self) -> Integration {
        self.integration
    }

    /// The cost of all flights that it took.
    pub fn work(&self) -> Work {
        self.landing.work
    }
}

/// Roundings, in units of u, between the proven turn and cos θ: the vertical (4.2), the normal (4), their product (3) and
/// its division by the norm (4).
pub(crate) const OF_COS_TILT: f64 = 20.0 * UNIT_ROUNDOFF;

/// Roundings of the attitude at landing: the launch (8), a division by the norm (2), the product (8) and another division
/// (2).
const OF_ATTITUDE: f64 = 24.0 * UNIT_ROUNDOFF;

/// The digits of the last stage. Bounds end at 2^-1022, below which they do not count underflow.
const DIGITS: [usize; 3] = [192, 384, 768];

impl QuaternionSolver {
    /// Proves the outcome of `toss` by integration, first with the solver's own steps, then by Taylor series with the finest
    /// tolerance, then with more digits.
    ///
    /// # Errors
    /// [`SolveError::NotProven`] for a formulation that proves nothing; else as
    /// [`Solver::propagate`](dynamics::Solver::propagate).
    pub fn certify(&self, toss: &Toss) -> Result<IntegratedCertificate, SolveError> {
        let mut found = self.certify_all(std::slice::from_ref(toss), SimdLevel::for_one_lane());
        found.pop().unwrap_or(Err(SolveError::NotFinite { time: 0.0 }))
    }

    /// [`QuaternionSolver::certify`] of each of `tosses`, in their order and with the same bits. As many flights are
    /// computed at once as a register at the SIMD `level` has lanes.
    pub fn certify_all(&self, tosses: &[Toss], level: SimdLevel) -> Vec<Result<IntegratedCertificate, SolveError>> {
        if let Err(error) = self.require_proofs() {
            return vec![Err(error); tosses.len()];
        }
        let mut found = self.enclosed_all(tosses, level);
        for (toss, found) in tosses.iter().zip(&mut found) {
            if let Ok(certificate) = found
                && certificate.outcome == Outcome::Undecided
            {
                *found = self.escalated(toss, certificate.work());
            }
        }
        found
    }

    /// The landing of `toss` with the bounds of its error by the solver's own steps, whether or not they decide the
    /// outcome.
    ///
    /// # Errors
    /// As [`QuaternionSolver::certify`].
    pub fn enclose(&self, toss: &Toss) -> Result<IntegratedCertificate, SolveError> {
        self.require_proofs()?;
        let mut found = self.enclosed_all(std::slice::from_ref(toss), SimdLevel::for_one_lane());
        found.pop().unwrap_or(Err(SolveError::NotFinite { time: 0.0 }))
    }

    /// Refuses what proves nothing.
    pub(crate) fn require_proofs(&self) -> Result<(), SolveError> {
        let why = "without a division by the norm, its cos θ is not that of an attitude";
        let refused = || SolveError::NotProven { solver: Self::NAME.to_owned(), why };
        self.projects.then_some(()).ok_or_else(refused)
    }

    /// Whether the solver's own tolerance is the finest one of Taylor series, so that another flight by them is no finer.
    pub(crate) fn is_finest(&self) -> bool {
        self.taylor.is_some_and(|taylor| taylor.tolerance == f64::EPSILON)
    }

    /// The landings by the solver's own steps with their bounds.
    fn enclosed_all(&self, tosses: &[Toss], level: SimdLevel) -> Vec<Result<IntegratedCertificate, SolveError>> {
        match &self.taylor {
            Some(taylor) => self.enclosed(tosses, &taylor.coins, level, Integration::AsConfigured),
            None => tosses.iter().map(|toss| self.enclosed_by_steps(toss, level)).collect(),
        }
    }

    /// The landings by these `plans` with their bounds.
    fn enclosed(
        &self,
        tosses: &[Toss],
        plans: &Plans,
        level: SimdLevel,
        integration: Integration,
    ) -> Vec<Result<IntegratedCertificate, SolveError>> {
        let mut landings = vec![Err(SolveError::NotFinite { time: 0.0 }); tosses.len()];
        fly::<Coins>(plans, tosses, level, |index, landed| landings[index] = landed);
        let bounds = step_bounds(tosses, plans, level, &landings);
        let all = tosses.iter().zip(landings).zip(bounds);
        all.map(|((toss, landed), bound)| self.enclosed_landing(toss, &landed?, &bound, integration)).collect()
    }

    /// The landing from the end state of a flight whose steps have this `bound`.
    fn enclosed_landing(
        &self,
        toss: &Toss,
        landed: &Landed,
        bound: &StepBound,
        integration: Integration,
    ) -> Result<IntegratedCertificate, SolveError> {
        let record = landed.record.as_ref().ok_or_else(|| landed.flight.not_finite())?;
        let bound = attitude_bound(toss, &landed.flight, record, bound);
        self.stated(toss.launch.attitude(), landed, bound, integration)
    }

    /// The landing of a launch with the attitude `launched`, whose turn is off by at most `bound`.
    pub(crate) fn stated(
        &self,
        launched: Attitude,
        landed: &Landed,
        bound: f64,
        integration: Integration,
    ) -> Result<IntegratedCertificate, SolveError> {
        let cos_tilt = cos_tilt(launched, landed.turn);
        let error_bound = (2.0 * bound + OF_COS_TILT).min(2.0);
        Ok(IntegratedCertificate {
            outcome: Outcome::of(cos_tilt, error_bound),
            landing: self.landing(launched, landed)?.with_cos_tilt(cos_tilt),
            error_bound,
            attitude_error_bound: (bound + of_attitude(launched)).min(2.0),
            integration,
        })
    }

    /// Decides by the finest tolerance, then by more digits; `work` has been done before.
    fn escalated(&self, toss: &Toss, work: Work) -> Result<IntegratedCertificate, SolveError> {
        let mut total = work;
        if !self.is_finest() {
            let plans = Plans::of_coins(f64::EPSILON);
            let one = std::slice::from_ref(toss);
            let found = self.enclosed(one, &plans, SimdLevel::for_one_lane(), Integration::Finest).pop();
            if let Some(found) = found.transpose()? {
                total = total + found.work();
                if found.outcome != Outcome::Undecided {
                    return Ok(found.with_work(total));
                }
            }
        }
        let mut found = by_digits(toss, in_double_double(toss)?, Integration::DoubleDouble)?;
        total = total + found.work();
        for digits in DIGITS {
            if found.outcome != Outcome::Undecided {
                break;
            }
            found = by_digits(toss, in_digits(toss, digits)?, Integration::MoreDigits)?;
            total = total + found.work();
        }
        Ok(found.with_work(total))
    }
}

impl IntegratedCertificate {
    pub(crate) fn with_work(mut self, work: Work) -> Self {
        self.landing.work = work;
        self
    }
}

/// The bounds of the steps of each flight that has landed.
fn step_bounds(
    tosses: &[Toss],
    plans: &Plans,
    level: SimdLevel,
    landings: &[Result<Landed, SolveError>],
) -> Vec<StepBound> {
    let mut found = vec![StepBound::default(); tosses.len()];
    for long in [false, true] {
        let of_plan = |index: &usize| landings[*index].as_ref().is_ok_and(|landed| landed.flight.is_long() == long);
        let indices: Vec<usize> = (0..tosses.len()).filter(of_plan).collect();
        let flown = |index: &usize| {
            let landed = landings[*index].as_ref().ok()?;
            Some(steps(&tosses[*index], &landed.flight, landed.record.as_ref()?))
        };
        let steps: Vec<_> = indices.iter().filter_map(flown).collect();
        let bounds = bounds(plans.of(long), level, &steps);
        indices.into_iter().zip(bounds).for_each(|(index, bound)| found[index] = bound);
    }
    found
}

/// A landing in more digits than f64.
fn by_digits(
    toss: &Toss,
    landing: digits::Landing,
    integration: Integration,
) -> Result<IntegratedCertificate, SolveError> {
    let not_finite = |_| SolveError::NotFinite { time: toss.launch.flight_time() };
    let turn = Attitude::from_components(landing.turn).map_err(not_finite)?;
    let attitude = toss.launch.attitude() * turn;
    let rate = dynamics::body_rate::rate_by_momentum(toss, &attitude);
    let steps = u64::from(landing.steps);
    let work = Work { rhs_calls: steps * landing.order as u64, accepted_steps: steps, rejected_steps: 0 };
    let state = State { attitude, rate };
    Ok(IntegratedCertificate {
        outcome: landing.outcome,
        landing: Propagation::new(state, work).with_cos_tilt(landing.cos_tilt),
        error_bound: landing.cos_bound,
        attitude_error_bound: (landing.attitude_bound + of_attitude(toss.launch.attitude())).min(2.0),
        integration,
    })
}

/// cos θ after the turn P of any norm.
pub(crate) fn cos_tilt(launched: Attitude, [w, x, y, z]: [f64; 4]) -> f64 {
    let ([a, b, c], size) = launched.vertical();
    let (upright, inverted) = (w * w + z * z, x * x + y * y);
    let across = [2.0 * (x * z + w * y), 2.0 * (y * z - w * x)];
    (a * across[0] + b * across[1] + c * (upright - inverted)) / ((upright + inverted) * size)
}

/// Roundings of the attitude at landing. Half of a tilt in degrees is rounded to radians.
fn of_attitude(launched: Attitude) -> f64 {
    let tilt = launched.tilt().map_or(0.0, |angle| angle.radians().abs());
    OF_ATTITUDE + UNIT_ROUNDOFF * tilt
}

#[cfg(test)]
pub(crate) mod tests;
