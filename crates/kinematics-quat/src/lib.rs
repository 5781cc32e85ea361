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

use dynamics::phase::RoughPhases;
use dynamics::{
    Attitude, Error, Flight, Formulation, Propagation, RigidFlight, RigidPhase, RigidToss, Scheme, Settings,
    SolveError, Solver, SolverEntry, State, StepControl, Stepping, Toss, Tosses, Vector3, Work,
};
use nalgebra::SVector;
use numerics::lanes::SimdLevel;

pub use crate::prove::certificate::IntegratedCertificate;
pub use crate::prove::certificate::Integration;
pub use crate::prove::counts::{IntegratedCounts, Proving};
use crate::prove::flight::Record;
use crate::prove::rigid_lanes::Bound;
pub use crate::system::QuaternionSystem;
use crate::system::half_product;
use crate::taylor::coin::Coins;
use crate::taylor::lockstep::{by_kind, fly};
use crate::taylor::plan::Plans;
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
    coins: Plans,
    bodies: Plans,
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
                let (coins, bodies) = (Plans::of_coins(tolerance), Plans::of_bodies(tolerance));
                Some(Taylor { tolerance, coins, bodies })
            }
            _ => None,
        };
        Self { stepping, projects: formulation.is_guarded(), taylor }
    }

    /// The landings of `tosses`, in their order, each with the same bits as from [`Solver::propagate`]. With [`TAYLOR`]
    /// as many flights are computed at once as a register at the SIMD `level` has lanes; with the other schemes, one
    /// after the other.
    pub fn propagate_all(&self, tosses: &[Toss], level: SimdLevel) -> Vec<Result<Propagation, SolveError>> {
        let Some(taylor) = &self.taylor else {
            return tosses.iter().map(|toss| self.propagate(toss)).collect();
        };
        let mut landings = vec![Err(SolveError::NotFinite { time: 0.0 }); tosses.len()];
        fly::<Coins>(&taylor.coins, tosses, level, |index, landed| {
            landings[index] = landed.and_then(|landed| self.landing(tosses[index].launch.attitude(), &landed));
        });
        landings
    }

    /// The landings of any rigid bodies, as [`QuaternionSolver::propagate_all`] returns those of coins.
    pub fn propagate_all_rigid(&self, tosses: &[RigidToss], level: SimdLevel) -> Vec<Result<Propagation, SolveError>> {
        let Some(taylor) = &self.taylor else {
            return tosses.iter().map(|toss| self.propagate_rigid(toss)).collect();
        };
        let bodies = |flown: &[RigidToss]| {
            let mut landings = vec![Err(SolveError::NotFinite { time: 0.0 }); flown.len()];
            fly::<Bodies>(&taylor.bodies, flown, level, |index, landed| {
                landings[index] = landed.and_then(|landed| self.landing(flown[index].launch.attitude(), &landed));
            });
            landings
        };
        by_kind(tosses, |coins| self.propagate_all(coins, level), bodies)
    }

    /// The landing of a launch with the attitude `launched` from the integrated end state.
    fn landing(&self, launched: Attitude, landed: &Landed) -> Result<Propagation, SolveError> {
        let &Landed { flight, turn, rate, work, .. } = landed;
        // Rounding and truncation change the norm, but the attitude is the direction of the quaternion alone. One
        // projection at the end is enough: the equation is linear in the quaternion, and so each step keeps a wrong
        // norm as a factor.
        let norm = SVector::from(turn).norm();
        let turn = Attitude::from_components(turn).map_err(|_| flight.not_finite())?;
        let state = State { attitude: launched * turn, rate };
        let cos_tilt = state.attitude.cos_tilt() * if self.projects { 1.0 } else { norm * norm };
        Ok(Propagation::new(state, work).with_cos_tilt(cos_tilt).with_norm_error((norm - 1.0).abs()))
    }
}

impl Solver for QuaternionSolver {
    fn name(&self) -> &str {
        Self::NAME
    }

    fn stepping(&self) -> Option<Stepping> {
        Some(self.stepping)
    }

    /// That of the [stepping](Stepping::error_estimate); by Taylor series (tolerance + ε (1 + φ)) × (1 + φ), with the
    /// phase φ (rad). Series keep all omitted terms together below the tolerance, and take less than a step in a radian, so
    /// that rounding is less, too.
    fn error_estimate(&self, toss: &Toss) -> Result<Option<f64>, SolveError> {
        let Some(Taylor { tolerance, .. }) = self.taylor else { return self.stepping.error_estimate(toss).map(Some) };
        Ok(Some(of_series(tolerance, RoughPhases::new(toss).largest()?)))
    }

    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
        if let Some(taylor) = &self.taylor {
            let mut landing = Err(SolveError::NotFinite { time: 0.0 });
            fly::<Coins>(&taylor.coins, std::slice::from_ref(toss), SimdLevel::for_one_lane(), |_, landed| {
                landing = landed.and_then(|landed| self.landing(toss.launch.attitude(), &landed));
            });
            return landing;
        }
        let flight = Flight::new(toss)?;
        let (system, start) = QuaternionSystem::launching(toss, &flight);
        let (end, work) = flight.integrate(&system, start, &self.stepping)?;
        self.landing(toss.launch.attitude(), &Landed::at(&flight, &end, work))
    }

    fn propagate_rigid(&self, toss: &RigidToss) -> Result<Propagation, SolveError> {
        if let Some(toss) = toss.symmetric() {
            return self.propagate(&toss);
        }
        if let Some(taylor) = &self.taylor {
            let mut landing = Err(SolveError::NotFinite { time: 0.0 });
            fly::<Bodies>(&taylor.bodies, std::slice::from_ref(toss), SimdLevel::for_one_lane(), |_, landed| {
                landing = landed.and_then(|landed| self.landing(toss.launch.attitude(), &landed));
            });
            return landing;
        }
        let flight = RigidFlight::new(toss)?;
        let (end, work) = RigidSystem::integrated(&flight, &self.stepping)?;
        self.landing(toss.launch.attitude(), &Landed::at_rigid(&flight, &end, work))
    }

    /// That of the [stepping](Stepping::error_estimate_rigid), or by Taylor series as for coins, times the
    /// [growth](RigidPhase::growth) of a disturbance.
    fn error_estimate_rigid(&self, toss: &RigidToss) -> Result<Option<f64>, SolveError> {
        if let Some(toss) = toss.symmetric() {
            return self.error_estimate(&toss);
        }
        let Some(Taylor { tolerance, .. }) = self.taylor else { return self.stepping.error_estimate_rigid(toss) };
        let RigidPhase { angle, growth } = RigidPhase::new(toss)?;
        // From 1 on an estimate says nothing about a cosine.
        Ok(Some(growth * of_series(tolerance, angle)).filter(|estimate| *estimate < 1.0))
    }

    /// With Taylor series, computes as many flights at once as a register has lanes.
    fn cos_tilts(&self, tosses: &Tosses<'_>, out: &mut [f64]) -> Result<(), Error> {
        assert_eq!(out.len(), tosses.len(), "one result a toss");
        for (index, landing) in self.propagate_all(&tosses.each()?, SimdLevel::widest()).into_iter().enumerate() {
            out[index] = tosses.solve(index, |_| landing.clone())?.cos_tilt;
        }
        Ok(())
    }

    /// As [`Solver::cos_tilts`].
    fn cos_tilts_rigid(&self, tosses: &[RigidToss], out: &mut [f64]) -> Result<(), Error> {
        assert_eq!(out.len(), tosses.len(), "one result a toss");
        for (index, landing) in self.propagate_all_rigid(tosses, SimdLevel::widest()).into_iter().enumerate() {
            out[index] = landing.map_err(|source| Error::of_launch(index, &tosses[index], source))?.cos_tilt;
        }
        Ok(())
    }
}

/// The error estimate of a flight by Taylor series that turns by `phase` (rad).
fn of_series(tolerance: f64, phase: f64) -> f64 {
    (tolerance + f64::EPSILON * (1.0 + phase)) * (1.0 + phase)
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
