//! [`QuaternionSolver`], which integrates the quaternion of a flight by Taylor series or by Runge-Kutta schemes.

use dynamics::{
    Attitude, Body, Error, Flight, Formulation, Landing, Phases, Scheme, Settings, SolveError, Solver, SolverEntry,
    State, StepControl, Stepping, Tilt, Toss,
};
use nalgebra::SVector;
use numerics::lanes::SimdLevel;

use crate::landed::Landed;
use crate::system::{QuaternionSystem, RigidSystem};
use crate::taylor::coin::Coins;
use crate::taylor::lockstep::fly;
use crate::taylor::plan::Taylor;
use crate::taylor::rigid::Bodies;

/// The scheme by Taylor series, [`Scheme::TAYLOR`].
pub const TAYLOR: Scheme = Scheme::TAYLOR;

/// The solver that integrates the quaternion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuaternionSolver {
    stepping: Stepping,
    /// Whether cos θ is that of the quaternion projected onto unit norm.
    pub(crate) projects: bool,
    /// The plans of the steps by Taylor series; `None` for a Runge-Kutta scheme.
    pub(crate) taylor: Option<Taylor>,
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
            (TAYLOR, StepControl::Tolerance(tolerance)) => Some(Taylor::new(tolerance)),
            _ => None,
        };
        Self { stepping, projects: formulation.is_guarded(), taylor }
    }

    /// The landings of `tosses`, in their order, each with the same bits as from [`Solver::land`]. With [`TAYLOR`] as many
    /// flights are computed at once as a register at the SIMD `level` has lanes; with the other schemes, one after the
    /// other.
    pub fn land_all(&self, tosses: &[Toss], level: SimdLevel) -> Vec<Result<Landing, SolveError>> {
        let Some(taylor) = &self.taylor else { return tosses.iter().map(|toss| self.land(toss)).collect() };
        // A clone of an error for each would take longer.
        let mut landings: Vec<_> = tosses.iter().map(|_| Err(SolveError::NotFinite { time: 0.0 })).collect();
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
        fly::<Coins>(&taylor.coins, tosses.iter().enumerate(), level, |index, landed| {
            land(index, landed.and_then(|landed| self.by_series(taylor.tolerance, &tosses[index], &landed)));
        });
        fly::<Bodies>(&taylor.bodies, tosses.iter().enumerate(), level, |index, landed| {
            land(index, landed.and_then(|landed| self.by_series(taylor.tolerance, &tosses[index], &landed)));
        });
    }

    /// The landing of `toss` by Taylor series of this tolerance, with its error estimate.
    fn by_series<B>(&self, tolerance: f64, toss: &Toss, landed: &Landed<B>) -> Result<Landing, SolveError> {
        let estimate = of_series(tolerance, toss, &landed.flight)?;
        self.landing(toss.launch.attitude(), landed).map(|landing| landing.with_error(estimate))
    }

    /// The landing by a Runge-Kutta scheme, without its error estimate.
    fn stepped(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let flight = Flight::new(toss)?;
        let [x, y, z] = flight.rate.into();
        let landed = match &toss.body {
            Body::Coin(coin) => {
                let (system, start) = (QuaternionSystem::new(coin.inertia_ratio(), z), [1.0, 0.0, 0.0, 0.0, x, y]);
                let (end, work) = flight.integrate(&system, start.into(), &self.stepping)?;
                let [w, i, j, k, x, y] = end.into();
                Landed::new(&flight, ([w, i, j, k], [x, y, z]), work, ())
            }
            Body::Rigid(body) => {
                let (system, start) = (RigidSystem::new(body.couplings()), [1.0, 0.0, 0.0, 0.0, x, y, z]);
                let (end, work) = flight.integrate(&system, start.into(), &self.stepping)?;
                let [w, i, j, k, x, y, z] = end.into();
                Landed::new(&flight, ([w, i, j, k], [x, y, z]), work, ())
            }
        };
        self.landing(toss.launch.attitude(), &landed)
    }

    /// The landing of a launch with the attitude `launched` from the integrated end state.
    pub(crate) fn landing<B>(&self, launched: Attitude, landed: &Landed<B>) -> Result<Landing, SolveError> {
        let &Landed { ref flight, turn, rate, work, .. } = landed;
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
/// (rad), for a body that is not a coin times the [growth](Phases::growth) of a disturbance. Series keep all omitted terms
/// together below the tolerance, and take less than a step in a radian, so that rounding is less than that of Runge-Kutta
/// schemes. `None` from 1 on for a body that is not a coin: such an estimate says nothing about a cosine.
fn of_series(tolerance: f64, toss: &Toss, flight: &Flight) -> Result<Option<f64>, SolveError> {
    let estimate = (tolerance + f64::EPSILON * (1.0 + flight.phase())) * (1.0 + flight.phase());
    Ok(match toss.body {
        Body::Coin(_) => Some(estimate),
        Body::Rigid(_) => Some(Phases::new(toss)?.growth * estimate).filter(|estimate| *estimate < 1.0),
    })
}

#[cfg(test)]
mod tests;
