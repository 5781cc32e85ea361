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

use crate::landed::Landed;
use crate::prove::certificate::IntegratedCertificate;
use crate::prove::coin_step::bounds;
use crate::prove::digits::{self, height, in_digits, in_double_double};
use crate::prove::flight::{attitude_bound, attitude_bound_of_body, steps};
use crate::prove::rigid_lanes::{Bound, Enclosed};
use crate::solver::QuaternionSolver;
use crate::taylor::coin::{Coins, Record};
use crate::taylor::lockstep::{Motion, fly};
use crate::taylor::plan::{StepPlans, Taylor};

/// Roundings, in units of u, between the proven turn and cos θ: the vertical (4.2), the normal (4), their product (3) and
/// its division by the norm (4).
const OF_COS_TILT: f64 = 20.0 * UNIT_ROUNDOFF;

/// Roundings of the attitude at landing: the launch (8), a division by the norm (2), the product (8) and another division
/// (2).
const OF_ATTITUDE: f64 = 24.0 * UNIT_ROUNDOFF;

/// The tolerance of the coarse flights.
const COARSE: f64 = 1e-3;

/// The digits of the last stage. Bounds end at 2^-1022, below which they do not count underflow.
const DIGITS: [usize; 3] = [192, 384, 768];

/// Why a flight without a bound proves nothing.
const NO_BOUND: &str = "next to a turn about the middle axis, the errors of this flight have no bound";

type Certified = Result<IntegratedCertificate, SolveError>;

/// Flights that bound their error.
trait Bounded: Motion {
    /// The plans of the flights of this kind, if a solver with these plans takes such flights.
    fn plans(taylor: &Taylor, by: Stage) -> Option<StepPlans>;

    /// Bounds of the attitudes of flights by these `plans`, which are those of the `tosses` with these numbers; infinite for
    /// a flight without one.
    fn bounds(
        tosses: &[Toss],
        landed: &[(usize, Landed<Self::Bound>)],
        plans: &StepPlans,
        level: SimdLevel,
    ) -> Vec<f64>;

    /// What flights in more digits find of a toss that the finest tolerance leaves undecided, as `found`.
    fn in_digits(_: &Toss, found: IntegratedCertificate) -> Certified {
        Ok(found)
    }
}

impl Bounded for Coins {
    fn plans(taylor: &Taylor, by: Stage) -> Option<StepPlans> {
        match by {
            Stage::Coarse if taylor.tolerance < COARSE => Some(StepPlans::of_coarse_coins(COARSE)),
            Stage::F64 => Some(taylor.coins),
            Stage::Finest if !taylor.is_finest() => Some(StepPlans::of_coins(f64::EPSILON)),
            _ => None,
        }
    }

    fn bounds(tosses: &[Toss], landed: &[(usize, Landed<Record>)], plans: &StepPlans, level: SimdLevel) -> Vec<f64> {
        let mut found = vec![f64::INFINITY; landed.len()];
        for long in [false, true] {
            let places = landed.iter().zip(&mut found).filter(|((_, landed), _)| landed.flight.is_long() == long);
            let flown = places.filter_map(|((index, landed), bound)| Some((tosses[*index].coin()?, landed, bound)));
            let flown: Vec<_> = flown.collect();
            let steps: Vec<_> =
                flown.iter().map(|(toss, landed, _)| steps(toss, &landed.flight, &landed.bound)).collect();
            for ((toss, landed, bound), step) in flown.into_iter().zip(bounds(plans.of(long), level, &steps)) {
                *bound = attitude_bound(&toss, &landed.flight, &landed.bound, &step);
            }
        }
        found
    }

    fn in_digits(toss: &Toss, mut found: IntegratedCertificate) -> Certified {
        let Some(toss) = toss.coin() else { return Ok(found) };
        let double_double = || by_digits(&toss, in_double_double(&toss)?, Stage::DoubleDouble);
        let more = |digits| by_digits(&toss, in_digits(&toss, digits)?, Stage::MoreDigits);
        for stage in [None].into_iter().chain(DIGITS.map(Some)) {
            if found.outcome == Outcome::Undecided {
                found = stage.map_or_else(double_double, more)?.after(&found);
            }
        }
        Ok(found)
    }
}

impl Bounded for Enclosed {
    /// There are no coarse flights: next to a turn about the middle axis, where flights take longest, those have no bound.
    fn plans(taylor: &Taylor, by: Stage) -> Option<StepPlans> {
        match by {
            Stage::F64 => Some(taylor.bodies),
            Stage::Finest if !taylor.is_finest() => Some(StepPlans::of_bodies(f64::EPSILON)),
            _ => None,
        }
    }

    fn bounds(tosses: &[Toss], landed: &[(usize, Landed<Option<Bound>>)], _: &StepPlans, _: SimdLevel) -> Vec<f64> {
        let bound = |(index, landed): &(usize, Landed<Option<Bound>>)| {
            let bound = landed.bound.as_ref();
            bound.map_or(f64::INFINITY, |bound| attitude_bound_of_body(&tosses[*index].launch, &landed.flight, bound))
        };
        landed.iter().map(bound).collect()
    }
}

impl QuaternionSolver {
    /// Proves the outcome of `toss` by integration, first with the solver's own tolerance, then with the finest one, then
    /// with more digits; a body with three different moments is not flown in more digits. Fails with
    /// [`SolveError::NotProven`] for a scheme other than [`TAYLOR`](crate::TAYLOR), whose steps have no bound, for a
    /// formulation that proves nothing, and for a flight whose errors have no bound; else as
    /// [`Solver::land`](dynamics::Solver::land).
    pub fn certify(&self, toss: &Toss) -> Result<IntegratedCertificate, SolveError> {
        let found = self.proven(std::slice::from_ref(toss), SimdLevel::for_one_lane(), &Stage::ALL[1..]).remove(0)?;
        (found.error_bound < 2.0).then_some(found).ok_or_else(|| Self::not_proven(NO_BOUND))
    }

    /// The certificates of the flights that decide the outcomes of `tosses`, in their order and with the same bits at every
    /// SIMD `level`. Coins are first flown with a coarse tolerance, whose bounds decide nearly all; the others are flown
    /// again. It takes about as long as the landings without a proof. A flight without a bound is undecided.
    pub(crate) fn decide(&self, tosses: &[Toss], level: SimdLevel) -> Vec<Certified> {
        self.proven(tosses, level, &Stage::ALL)
    }

    /// The landing of `toss` with the bounds of its error at the solver's own tolerance, whether or not they decide the
    /// outcome. Without a bound it is 2.
    pub fn enclose(&self, toss: &Toss) -> Result<IntegratedCertificate, SolveError> {
        let stage = [Stage::F64];
        self.proven(std::slice::from_ref(toss), SimdLevel::for_one_lane(), &stage).remove(0)
    }

    /// The plans of a solver that proves, which is one by Taylor series with guards.
    pub(crate) fn require_proofs(&self) -> Result<&Taylor, SolveError> {
        if !self.projects {
            return Err(Self::not_proven("without a division by the norm, its cos θ is not that of an attitude"));
        }
        self.taylor.as_ref().ok_or_else(|| Self::not_proven("only the scheme taylor bounds the error of its steps"))
    }

    fn not_proven(why: &'static str) -> SolveError {
        SolveError::NotProven { solver: Self::NAME.to_owned(), why }
    }

    /// What flights at these `stages` state of `tosses`, in their order. Each stage flies what the one before it leaves
    /// undecided.
    fn proven(&self, tosses: &[Toss], level: SimdLevel, stages: &[Stage]) -> Vec<Certified> {
        let taylor = match self.require_proofs() {
            Ok(taylor) => taylor,
            Err(error) => return vec![Err(error); tosses.len()],
        };
        let mut found = vec![Err(SolveError::NotFinite { time: 0.0 }); tosses.len()];
        self.prove::<Coins>(taylor, tosses, level, stages, &mut found);
        self.prove::<Enclosed>(taylor, tosses, level, stages, &mut found);
        found
    }

    /// [`proven`](Self::proven) of the tosses of one kind of body, into their places in `found`.
    fn prove<B: Bounded>(
        &self,
        taylor: &Taylor,
        tosses: &[Toss],
        level: SimdLevel,
        stages: &[Stage],
        found: &mut [Certified],
    ) {
        let of_kind = |index: &usize| B::body(&tosses[*index].body).is_some();
        let mut open: Vec<usize> = (0..tosses.len()).filter(of_kind).collect();
        for by in stages {
            let Some(plans) = B::plans(taylor, *by) else { continue };
            let mut landed = Vec::with_capacity(open.len());
            fly::<B>(&plans, open.iter().map(|index| (*index, &tosses[*index])), level, |index, end| match end {
                Ok(end) => landed.push((index, end)),
                Err(error) => found[index] = Err(error),
            });
            for ((index, landed), bound) in landed.iter().zip(B::bounds(tosses, &landed, &plans, level)) {
                let stated = self.stated(tosses[*index].launch.attitude(), landed, bound, *by);
                found[*index] = stated.map(|stated| found[*index].iter().fold(stated, IntegratedCertificate::after));
            }
            open.retain(|index| found[*index].as_ref().is_ok_and(|found| found.outcome == Outcome::Undecided));
        }
        if stages.contains(&Stage::MoreDigits) {
            for index in open {
                found[index] = found[index].clone().and_then(|found| B::in_digits(&tosses[index], found));
            }
        }
    }

    /// The landing of a launch with the attitude `launched`, whose turn is off by at most `bound`.
    fn stated<B>(&self, launched: Attitude, landed: &Landed<B>, bound: f64, stage: Stage) -> Certified {
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

/// A landing in more digits than f64.
fn by_digits(toss: &CoinToss, landing: digits::Landing, stage: Stage) -> Certified {
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
fn cos_tilt(launched: Attitude, turn: [f64; 4]) -> f64 {
    let (vertical, size) = launched.vertical();
    let (height, norm) = height(&vertical, &turn);
    (height / (norm * size)).clamp(-1.0, 1.0)
}

/// Roundings of the attitude at landing. Half of a tilt in degrees is rounded to radians.
fn of_attitude(launched: Attitude) -> f64 {
    let tilt = launched.tilt().map_or(0.0, |angle| angle.to_f64().abs());
    OF_ATTITUDE + UNIT_ROUNDOFF * tilt
}

#[cfg(test)]
mod outcomes_tests;
#[cfg(test)]
mod rigid_tests;
#[cfg(test)]
mod tests;
