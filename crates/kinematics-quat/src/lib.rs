//! The integrator of the flight as a quaternion, Q' = ½ Q ⊗ (0, ω), where Q is the attitude and ω the body rate. Unlike
//! the Euler angles, the quaternion has no singular attitude, so that no launch needs a special case.
//!
//! What is integrated is the quaternion P that leads from the attitude Q0 at launch to the attitude Q = Q0 ⊗ P. It
//! starts at 1 for every toss, so that neither the error nor the work depends on how the coin is held at launch.
//!
//! The state is (P, ωx, ωy). The body rate is integrated along with the attitude, by Euler's equations (1) of the
//! paper; their closed-form solution is never used. Rates are dimensionless, as in a [`Flight`].
//!
//! The Runge-Kutta schemes are those of `dynamics::integrate`. Taylor series are in this crate, because they need the
//! recurrences of the coefficients in addition to the right-hand side: `taylor/coin.rs` computes one step, `plan.rs` chooses
//! its length, and `lockstep.rs` runs the flights. Flights by them bound their own error: see `prove`.
//!
//! Any other rigid body has three rates that change, about its principal axes (`taylor/rigid.rs`). The formulations mean the
//! same for it: in [`Formulation::RAW`] the quaternion is not projected.

mod prove;
mod system;
mod taylor;

use dynamics::{
    Attitude, Body, Error, Flight, Formulation, Landing, RigidFlight, RigidPhase, Scheme, Settings, SolveError, Solver,
    SolverEntry, State, StepControl, Stepping, Tilt, Toss, Vector3, Work,
};
use nalgebra::SVector;
use numerics::lanes::SimdLevel;

pub use crate::prove::certificate::IntegratedCertificate;
pub use crate::prove::counts::{IntegratedCounts, Proving};
use crate::prove::rigid_lanes::Bound;
pub use crate::system::QuaternionSystem;
use crate::system::half_product;
use crate::taylor::coin::{Coins, Record};
use crate::taylor::lockstep::fly;
use crate::taylor::plan::StepPlans;
use crate::taylor::rigid::Bodies;
pub use crate::taylor::rigid::RigidSystem;

/// The scheme by Taylor series, [`Scheme::TAYLOR`].
pub const TAYLOR: Scheme = Scheme::TAYLOR;

/// The solver that integrates the quaternion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuaternionSolver {
    stepping: Stepping,
    /// Whether cos θ is that of the quaternion projected onto unit norm.
    projects: bool,
    /// The plans of the steps by Taylor series; `None` for a Runge-Kutta scheme.
    taylor: Option<Taylor>,
}

/// The plans of the steps by Taylor series.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Taylor {
    tolerance: f64,
    coins: StepPlans,
    bodies: StepPlans,
}

impl QuaternionSolver {
    /// The solver's name in the registry.
    pub const NAME: &'static str = "quaternion";

    /// The solver's entry for the registry.
    pub fn entry() -> SolverEntry {
        let build =
            |settings: &Settings| -> Box<dyn Solver> { Box::new(Self::new(settings.stepping, settings.formulation)) };
        SolverEntry::new(Self::NAME, "Q' = ½ Q ⊗ (0, ω): no singular attitude", build)
            .with_schemes(&Scheme::ALL)
            .with_formulations(&[Formulation::MOMENTUM, Formulation::RAW])
            .with_color([0, 158, 115])
    }

    /// A solver that integrates with `stepping`. In a formulation without [guards](Formulation::is_guarded), cos θ is
    /// computed from the quaternion as it was integrated, without projection onto unit norm.
    pub fn new(stepping: Stepping, formulation: Formulation) -> Self {
        let taylor = match (stepping.scheme(), stepping.control()) {
            (TAYLOR, StepControl::Tolerance(tolerance)) => {
                let (coins, bodies) = (StepPlans::of_coins(tolerance), StepPlans::of_bodies(tolerance));
                Some(Taylor { tolerance, coins, bodies })
            }
            _ => None,
        };
        Self { stepping, projects: formulation.is_guarded(), taylor }
    }

    /// The landings of `tosses`, in their order, each with the same bits as from [`Solver::land`]. With [`TAYLOR`] as many
    /// flights are computed at once as a register at the SIMD `level` has lanes; with the other schemes, one after the
    /// other.
    pub fn land_all(&self, tosses: &[Toss], level: SimdLevel) -> Vec<Result<Landing, SolveError>> {
        let Some(taylor) = &self.taylor else { return tosses.iter().map(|toss| self.land(toss)).collect() };
        let mut landings = vec![Err(SolveError::NotFinite { time: 0.0 }); tosses.len()];
        self.fly(taylor, tosses, level, |index, landing| landings[index] = landing);
        landings
    }

    /// Flies `tosses` by Taylor series, and calls `land` with the index and the landing of each. Memory is allocated by `land`
    /// alone.
    fn fly(
        &self,
        taylor: &Taylor,
        tosses: &[Toss],
        level: SimdLevel,
        mut land: impl FnMut(usize, Result<Landing, SolveError>),
    ) {
        let mut landed = |index: usize, landed: Result<Landed, SolveError>| {
            let toss: &Toss = &tosses[index];
            let landing = landed.and_then(|landed| {
                let landing = self.landing(toss.launch.attitude(), &landed)?;
                Ok(landing.with_error(of_series(taylor.tolerance, toss, &landed.flight)?))
            });
            land(index, landing);
        };
        fly::<Coins>(&taylor.coins, (tosses.len(), |index: usize| tosses[index].coin()), level, &mut landed);
        let body = |index: usize| Some(tosses[index]).filter(|toss| matches!(toss.body, Body::Rigid(_)));
        fly::<Bodies>(&taylor.bodies, (tosses.len(), body), level, &mut landed);
    }

    /// The landing by a Runge-Kutta scheme, without its error estimate.
    fn stepped(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let launched = toss.launch.attitude();
        if let Some(toss) = toss.coin() {
            let flight = Flight::new(&toss)?;
            let (system, start) = QuaternionSystem::launching(&toss, &flight);
            let (end, work) = flight.integrate(&system, start, &self.stepping)?;
            return self.landing(launched, &Landed::at(&flight, &end, work));
        }
        let flight = RigidFlight::new(toss)?;
        let (end, work) = RigidSystem::integrated(&flight, &self.stepping)?;
        self.landing(launched, &Landed::at_rigid(&flight, &end, work))
    }

    /// The landing of a launch with the attitude `launched` from the integrated end state.
    fn landing(&self, launched: Attitude, landed: &Landed) -> Result<Landing, SolveError> {
        let &Landed { flight, turn, rate, work, .. } = landed;
        // Rounding and truncation change the norm, but the attitude is the direction of the quaternion alone. One
        // projection at the end is enough: the equation is linear in the quaternion, and so each step keeps a wrong
        // norm as a factor.
        let norm = SVector::from(turn).norm();
        let turn = Attitude::from_components(turn).map_err(|_| flight.not_finite())?;
        let state = State { attitude: launched * turn, rate };
        let cos_tilt = state.attitude.cos_tilt() * if self.projects { 1.0 } else { norm * norm };
        Ok(Landing::new(state, work).with_cos_tilt(cos_tilt).with_norm_error((norm - 1.0).abs()))
    }
}

impl Solver for QuaternionSolver {
    fn name(&self) -> &str {
        Self::NAME
    }

    fn stepping(&self) -> Option<Stepping> {
        Some(self.stepping)
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        if let Some(taylor) = &self.taylor {
            let mut only = Err(SolveError::NotFinite { time: 0.0 });
            self.fly(taylor, std::slice::from_ref(toss), SimdLevel::for_one_lane(), |_, landing| only = landing);
            return only;
        }
        Ok(self.stepped(toss)?.with_error(self.stepping.error_estimate(toss)?))
    }

    /// With Taylor series, computes as many flights at once as a register has lanes.
    fn tilts(&self, tosses: &[Toss], out: &mut [Tilt]) -> Result<(), Error> {
        assert_eq!(out.len(), tosses.len(), "one result a toss");
        for (index, landing) in self.land_all(tosses, SimdLevel::widest()).into_iter().enumerate() {
            out[index] = landing.map_err(|source| Error::of_launch(index, &tosses[index], source))?.tilt();
        }
        Ok(())
    }
}

/// The estimate of the error of cos θ after a `flight` by Taylor series: (tolerance + ε (1 + φ)) × (1 + φ), with the phase φ
/// (rad), for a body that is not a coin times the [growth](RigidPhase::growth) of a disturbance. Series keep all omitted terms
/// together below the tolerance, and take less than a step in a radian, so that rounding is less than that of Runge-Kutta
/// schemes. `None` from 1 on for a body that is not a coin: such an estimate says nothing about a cosine.
fn of_series(tolerance: f64, toss: &Toss, flight: &Flight) -> Result<Option<f64>, SolveError> {
    let estimate = (tolerance + f64::EPSILON * (1.0 + flight.phase())) * (1.0 + flight.phase());
    Ok(match toss.body {
        Body::Coin(_) => Some(estimate),
        Body::Rigid(_) => Some(RigidPhase::new(toss)?.growth * estimate).filter(|estimate| *estimate < 1.0),
    })
}

/// The end state of an integrated flight.
#[derive(Debug, Clone, Copy)]
struct Landed {
    flight: Flight,
    /// P, before it is normalised.
    turn: [f64; 4],
    /// ω (BF, rad/s).
    rate: Vector3<f64>,
    work: Work,
    /// What a bound of the error has to know of the steps of a coin; `None` of flights that have no bound.
    record: Option<Record>,
    /// The bound of a body's flight that was asked for one.
    enclosed: Option<Bound>,
}

impl Landed {
    /// The end of a coin's flight in this state of a [`QuaternionSystem`].
    fn at(flight: &Flight, end: &SVector<f64, 6>, work: Work) -> Self {
        let &[w, x, y, z, rate_x, rate_y] = &end.data.0[0];
        let rate = flight.rate_at(rate_x, rate_y);
        Self { flight: *flight, turn: [w, x, y, z], rate, work, record: None, enclosed: None }
    }

    /// The end of a body's flight in this state of a [`RigidSystem`].
    fn at_rigid(flight: &RigidFlight, end: &SVector<f64, 7>, work: Work) -> Self {
        let &[w, x, y, z, first, second, third] = &end.data.0[0];
        let (turn, rate) = (flight.turn_in_body([w, x, y, z]), flight.rate_at([first, second, third]));
        Self { flight: *flight.timing(), turn, rate, work, record: None, enclosed: None }
    }
}

#[cfg(test)]
mod tests;
