//! The proofs by integration. A flight bounds its own error, by the theorem of `docs/proofs/enclosure.md`; an outcome is
//! proven where |cos θ| exceeds the bound. What a flight leaves undecided is flown at the finest tolerance, and a coin then
//! in more digits. The closed form of the motion is not used, so that these proofs and those of the crate `exact` check
//! each other.
//!
//! A body with three different moments that passes next to a turn about the middle axis multiplies its errors; if the bound
//! then decides nothing even at the finest tolerance, the outcome stays undecided, or nothing is stated.

use dynamics::{Attitude, CoinToss, Landing, Outcome, SolveError, Stage, State, Toss, Work};
use numerics::UNIT_ROUNDOFF;
use numerics::lanes::SimdLevel;

use crate::prove::certificate::IntegratedCertificate;
use crate::prove::coin_step::{StepBound, bounds};
use crate::prove::digits::{self, in_digits, in_double_double};
use crate::prove::flight::{attitude_bound, attitude_bound_of_body, steps};
use crate::prove::rigid_lanes::Enclosed;
use crate::taylor::coin::Coins;
use crate::taylor::lockstep::{Motion, by_kind, fly_all};
use crate::taylor::plan::StepPlans;
use crate::{Landed, QuaternionSolver, Taylor};

/// Roundings, in units of u, between the proven turn and cos θ: the vertical (4.2), the normal (4), their product (3) and
/// its division by the norm (4).
pub(crate) const OF_COS_TILT: f64 = 20.0 * UNIT_ROUNDOFF;

/// Roundings of the attitude at landing: the launch (8), a division by the norm (2), the product (8) and another division
/// (2).
const OF_ATTITUDE: f64 = 24.0 * UNIT_ROUNDOFF;

/// The digits of the last stage. Bounds end at 2^-1022, below which they do not count underflow.
const DIGITS: [usize; 3] = [192, 384, 768];

/// Why a flight without a bound proves nothing.
const NO_BOUND: &str = "next to a turn about the middle axis, the errors of this flight have no bound";

type Certified = Result<IntegratedCertificate, SolveError>;

/// Flights that bound their error.
trait Bounded: Motion {
    /// The plans of a solver for such flights.
    fn plans(taylor: &Taylor) -> &StepPlans;

    /// The plans of the finest tolerance.
    fn finest() -> StepPlans;

    /// The landings by these `plans` with their bounds.
    fn enclosed(
        solver: &QuaternionSolver,
        flown: (&[Self::Toss], &StepPlans),
        level: SimdLevel,
        by: Stage,
    ) -> Vec<Certified>;

    /// What is stated of a toss that the finest tolerance leaves undecided, as `found`.
    ///
    /// # Errors
    /// [`SolveError`] if nothing is.
    fn undecided(toss: &Self::Toss, found: IntegratedCertificate) -> Certified;
}

impl Bounded for Coins {
    fn plans(taylor: &Taylor) -> &StepPlans {
        &taylor.coins
    }

    fn finest() -> StepPlans {
        StepPlans::of_coins(f64::EPSILON)
    }

    fn enclosed(
        solver: &QuaternionSolver,
        (tosses, plans): (&[CoinToss], &StepPlans),
        level: SimdLevel,
        by: Stage,
    ) -> Vec<Certified> {
        let mut landings = vec![Err(SolveError::NotFinite { time: 0.0 }); tosses.len()];
        fly_all::<Self>(plans, tosses, level, |index, landed| landings[index] = landed);
        let bounds = step_bounds(tosses, plans, level, &landings);
        let stated = |((toss, landed), step): ((&CoinToss, Result<Landed, SolveError>), StepBound)| {
            let landed = landed?;
            let record = landed.record.as_ref().ok_or_else(|| landed.flight.not_finite())?;
            solver.stated(toss.launch.attitude(), &landed, attitude_bound(toss, &landed.flight, record, &step), by)
        };
        tosses.iter().zip(landings).zip(bounds).map(stated).collect()
    }

    /// Decides by more and more digits.
    fn undecided(toss: &CoinToss, mut found: IntegratedCertificate) -> Certified {
        let double_double = || by_digits(toss, in_double_double(toss)?, Stage::DoubleDouble);
        let more = |digits| by_digits(toss, in_digits(toss, digits)?, Stage::MoreDigits);
        for stage in [None].into_iter().chain(DIGITS.map(Some)) {
            if found.outcome == Outcome::Undecided {
                let finer = stage.map_or_else(double_double, more)?;
                found = finer.with_work(found.work() + finer.work());
            }
        }
        Ok(found)
    }
}

impl Bounded for Enclosed {
    fn plans(taylor: &Taylor) -> &StepPlans {
        &taylor.bodies
    }

    fn finest() -> StepPlans {
        StepPlans::of_bodies(f64::EPSILON)
    }

    fn enclosed(
        solver: &QuaternionSolver,
        (tosses, plans): (&[Toss], &StepPlans),
        level: SimdLevel,
        by: Stage,
    ) -> Vec<Certified> {
        let mut found = vec![Err(SolveError::NotFinite { time: 0.0 }); tosses.len()];
        fly_all::<Self>(plans, tosses, level, |index, landed| {
            found[index] = landed.and_then(|landed| {
                let (launch, enclosed) = (&tosses[index].launch, landed.enclosed.as_ref());
                let of = |bound| attitude_bound_of_body(launch, &landed.flight, bound);
                solver.stated(launch.attitude(), &landed, enclosed.map_or(f64::INFINITY, of), by)
            });
        });
        found
    }

    fn undecided(_: &Toss, found: IntegratedCertificate) -> Certified {
        let refused = SolveError::NotProven { solver: QuaternionSolver::NAME.to_owned(), why: NO_BOUND };
        if found.error_bound < 2.0 { Ok(found) } else { Err(refused) }
    }
}

impl QuaternionSolver {
    /// Proves the outcome of `toss` by integration, first with the solver's own tolerance, then with the finest one, then
    /// with more digits; a body with three different moments is not flown in more digits.
    ///
    /// # Errors
    /// [`SolveError::NotProven`] for a scheme other than [`TAYLOR`](crate::TAYLOR), whose steps have no bound, for a
    /// formulation that proves nothing, and for a flight whose errors have no bound; else as
    /// [`Solver::land`](dynamics::Solver::land).
    pub fn certify(&self, toss: &Toss) -> Result<IntegratedCertificate, SolveError> {
        only(self.certify_all(std::slice::from_ref(toss), SimdLevel::for_one_lane()))
    }

    /// [`QuaternionSolver::certify`] of each of `tosses`, in their order and with the same bits. As many flights are
    /// computed at once as a register at the SIMD `level` has lanes.
    pub fn certify_all(&self, tosses: &[Toss], level: SimdLevel) -> Vec<Result<IntegratedCertificate, SolveError>> {
        by_kind(tosses, |coins| self.certify_coins(coins, level), |bodies| self.certify_bodies(bodies, level))
    }

    /// [`QuaternionSolver::certify_all`] of coins.
    pub(crate) fn certify_coins(&self, coins: &[CoinToss], level: SimdLevel) -> Vec<Certified> {
        self.decided_all::<Coins>(coins, level)
    }

    /// [`QuaternionSolver::certify_all`] of other bodies.
    pub(crate) fn certify_bodies(&self, bodies: &[Toss], level: SimdLevel) -> Vec<Certified> {
        self.decided_all::<Enclosed>(bodies, level)
    }

    /// The landing of `toss` with the bounds of its error at the solver's own tolerance, whether or not they decide the
    /// outcome. Without a bound it is 2.
    ///
    /// # Errors
    /// As [`QuaternionSolver::certify`].
    pub fn enclose(&self, toss: &Toss) -> Result<IntegratedCertificate, SolveError> {
        toss.coin().map_or_else(|| self.enclosed::<Enclosed>(toss), |toss| self.enclosed::<Coins>(&toss))
    }

    /// The plans of a solver that proves, which is one by Taylor series with guards.
    pub(crate) fn require_proofs(&self) -> Result<&Taylor, SolveError> {
        let refused = |why| SolveError::NotProven { solver: Self::NAME.to_owned(), why };
        if !self.projects {
            return Err(refused("without a division by the norm, its cos θ is not that of an attitude"));
        }
        self.taylor.as_ref().ok_or_else(|| refused("only the scheme taylor bounds the error of its steps"))
    }

    /// Whether the solver's own tolerance is the finest one, so that another flight is no finer.
    pub(crate) fn is_finest(&self) -> bool {
        self.taylor.is_some_and(|taylor| taylor.tolerance == f64::EPSILON)
    }

    /// The landing at the solver's own tolerance with its bounds.
    fn enclosed<B: Bounded>(&self, toss: &B::Toss) -> Certified {
        let flown = (std::slice::from_ref(toss), B::plans(self.require_proofs()?));
        only(B::enclosed(self, flown, SimdLevel::for_one_lane(), Stage::F64))
    }

    /// The certificates of `tosses`.
    fn decided_all<B: Bounded>(&self, tosses: &[B::Toss], level: SimdLevel) -> Vec<Certified> {
        let plans = match self.require_proofs() {
            Ok(taylor) => B::plans(taylor),
            Err(error) => return vec![Err(error); tosses.len()],
        };
        let first = B::enclosed(self, (tosses, plans), level, Stage::F64);
        tosses.iter().zip(first).map(|(toss, first)| self.decided::<B>(toss, first?)).collect()
    }

    /// The certificate of the finest tolerance or of what follows it, if `found` does not decide.
    fn decided<B: Bounded>(&self, toss: &B::Toss, mut found: IntegratedCertificate) -> Certified {
        if found.outcome == Outcome::Undecided && !self.is_finest() {
            let flown = (std::slice::from_ref(toss), &B::finest());
            let finer = only(B::enclosed(self, flown, SimdLevel::for_one_lane(), Stage::Finest))?;
            found = finer.with_work(found.work() + finer.work());
        }
        if found.outcome == Outcome::Undecided { B::undecided(toss, found) } else { Ok(found) }
    }

    /// The landing of a launch with the attitude `launched`, whose turn is off by at most `bound`.
    fn stated(
        &self,
        launched: Attitude,
        landed: &Landed,
        bound: f64,
        stage: Stage,
    ) -> Result<IntegratedCertificate, SolveError> {
        let cos_tilt = cos_tilt(launched, landed.turn);
        let error_bound = (2.0 * bound + OF_COS_TILT).min(2.0);
        Ok(IntegratedCertificate {
            outcome: Outcome::of(cos_tilt, error_bound),
            landing: self.landing(launched, landed)?.with_cos_tilt(cos_tilt),
            error_bound,
            attitude_error_bound: (bound + of_attitude(launched)).min(2.0),
            stage,
        })
    }
}

/// The only one of these.
fn only(found: Vec<Certified>) -> Certified {
    found.into_iter().next().unwrap_or(Err(SolveError::NotFinite { time: 0.0 }))
}

/// The bounds of the steps of each flight that has landed.
fn step_bounds(
    tosses: &[CoinToss],
    plans: &StepPlans,
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
fn by_digits(toss: &CoinToss, landing: digits::Landing, stage: Stage) -> Result<IntegratedCertificate, SolveError> {
    let not_finite = |_| SolveError::NotFinite { time: toss.launch.flight_time() };
    let turn = Attitude::from_components(landing.turn).map_err(not_finite)?;
    let attitude = toss.launch.attitude() * turn;
    let rate = dynamics::body_rate::rate_by_momentum(toss, &attitude);
    let steps = u64::from(landing.steps);
    let work = Work { rhs_calls: steps * landing.order as u64, accepted_steps: steps, rejected_steps: 0 };
    let state = State { attitude, rate };
    Ok(IntegratedCertificate {
        outcome: landing.outcome,
        landing: Landing::new(state, work).with_cos_tilt(landing.cos_tilt),
        error_bound: landing.cos_bound,
        attitude_error_bound: (landing.attitude_bound + of_attitude(toss.launch.attitude())).min(2.0),
        stage,
    })
}

/// cos θ after the turn P of any norm.
pub(crate) fn cos_tilt(launched: Attitude, [w, x, y, z]: [f64; 4]) -> f64 {
    let ([a, b, c], size) = launched.vertical();
    let (upright, inverted) = (w * w + z * z, x * x + y * y);
    let across = [2.0 * (x * z + w * y), 2.0 * (y * z - w * x)];
    let cosine = (a * across[0] + b * across[1] + c * (upright - inverted)) / ((upright + inverted) * size);
    cosine.clamp(-1.0, 1.0)
}

/// Roundings of the attitude at landing. Half of a tilt in degrees is rounded to radians.
fn of_attitude(launched: Attitude) -> f64 {
    let tilt = launched.tilt().map_or(0.0, |angle| angle.radians().abs());
    OF_ATTITUDE + UNIT_ROUNDOFF * tilt
}

#[cfg(test)]
mod close_moments_tests;
#[cfg(test)]
mod rigid_tests;
#[cfg(test)]
mod tests;
