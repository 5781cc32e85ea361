//! The flight integrated as a quaternion: Q' = ½ Q ⊗ (0, ω).
//!
//! The quaternion P that leads from the launch attitude Q0 to the attitude Q = Q0 ⊗ P starts at 1 for every toss, so
//! neither error nor work depends on how the coin is held at launch. No attitude is singular.
//!
//! The state is (P, ωx, ωy): the body rate comes from Euler's equations (1), integrated along with the attitude, never
//! from their closed-form solution. Rates are dimensionless, as a [`Flight`] has them. `dynamics::integrate` steps it
//! by Runge and Kutta's methods; Taylor series, which need more of a system than its right-hand side, are here:
//! `taylor.rs` has a step, `lockstep.rs` the flights.

mod lockstep;
mod product;
mod taylor;

use dynamics::body_rate::{body_precession_rate, transverse_acceleration};
use dynamics::integrate::OdeSystem;
use dynamics::{
    Attitude, Error, Flight, Formulation, Propagation, Scheme, Settings, SolveError, Solver, SolverEntry, State,
    StepControl, Stepping, Toss, Tosses, Work,
};
use nalgebra::SVector;
use numerics::lanes::SimdLevel;

use crate::lockstep::Plans;

/// Taylor series of an order that follows from the tolerance (Jorba & Zou, Exp. Math. 14 (2005), 99).
pub const TAYLOR: Scheme = Scheme::new("taylor", None).adaptive();

/// The quaternion's solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuaternionSolver {
    stepping: Stepping,
    projects: bool,
    /// `None` for a Runge-Kutta scheme.
    taylor: Option<Plans>,
}

impl QuaternionSolver {
    /// Its name in the registry.
    pub const NAME: &'static str = "quaternion";

    /// Its entry in the registry.
    pub fn entry() -> SolverEntry {
        let [dop853, dopri5, rk4] = Scheme::RUNGE_KUTTA;
        let build =
            |settings: &Settings| -> Box<dyn Solver> { Box::new(Self::new(settings.stepping, settings.formulation)) };
        SolverEntry::new(Self::NAME, "Q' = ½ Q ⊗ (0, ω): no singular attitude", build)
            .with_schemes(&[dop853, dopri5, rk4, TAYLOR])
            .with_formulations(&[Formulation::MOMENTUM, Formulation::RAW])
            .with_color([0, 158, 115])
    }

    /// A solver that steps as `stepping` says. Without [guards](Formulation::is_guarded) its cos θ is that of the quaternion
    /// as it was integrated, without projection onto unit norm.
    pub fn new(stepping: Stepping, formulation: Formulation) -> Self {
        let taylor = match (stepping.scheme(), stepping.control()) {
            (TAYLOR, StepControl::Tolerance(tolerance)) => Some(Plans::new(tolerance)),
            _ => None,
        };
        Self { stepping, projects: formulation.is_guarded(), taylor }
    }

    /// The landings of `tosses`, in their order, each with the same bits as by [`Solver::propagate`]. By
    /// [`TAYLOR`] as many fly at once as a register at the SIMD `level` has lanes; by the others one after the other.
    pub fn propagate_all(&self, tosses: &[Toss], level: SimdLevel) -> Vec<Result<Propagation, SolveError>> {
        let Some(plans) = &self.taylor else {
            return tosses.iter().map(|toss| self.propagate(toss)).collect();
        };
        let mut landings = vec![Err(SolveError::NotFinite { time: 0.0 }); tosses.len()];
        self.fly(tosses, plans, level, |index, landing| landings[index] = landing);
        landings
    }

    /// Hands the number and the landing of each of `tosses` to `land`, by Taylor series.
    fn fly(
        &self,
        tosses: &[Toss],
        plans: &Plans,
        level: SimdLevel,
        mut land: impl FnMut(usize, Result<Propagation, SolveError>),
    ) {
        plans.fly(tosses, level, |index, landed| {
            land(index, landed.and_then(|landed| self.landing(&tosses[index], &landed)));
        });
    }

    fn landing(&self, toss: &Toss, landed: &Landed) -> Result<Propagation, SolveError> {
        let &Landed { flight, turn, rate: [rate_x, rate_y], work } = landed;
        // Rounding and truncation change the norm; only the direction is the attitude. To project after each step would
        // give the same: the equation, and so each step, is linear in the quaternion, and a factor stays a factor.
        let norm = SVector::from(turn).norm();
        let turn = Attitude::from_components(turn).map_err(|_| flight.not_finite())?;
        let state = State { attitude: toss.launch.attitude() * turn, rate: flight.rate_at(rate_x, rate_y) };
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

    fn error_estimate(&self, toss: &Toss) -> Result<Option<f64>, SolveError> {
        self.stepping.error_estimate(toss).map(Some)
    }

    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
        if let Some(plans) = &self.taylor {
            let mut landing = Err(SolveError::NotFinite { time: 0.0 });
            self.fly(std::slice::from_ref(toss), plans, SimdLevel::for_one_lane(), |_, found| landing = found);
            return landing;
        }
        let flight = Flight::new(toss)?;
        let system = QuaternionSystem::new(toss.coin.inertia_ratio(), flight.rate.z);
        let start = SVector::from([1.0, 0.0, 0.0, 0.0, flight.rate.x, flight.rate.y]);
        let (end, work) = flight.integrate(&system, start, &self.stepping)?;
        let &[w, x, y, z, rate_x, rate_y] = &end.data.0[0];
        self.landing(toss, &Landed { flight, turn: [w, x, y, z], rate: [rate_x, rate_y], work })
    }

    /// By Taylor series as many fly at once as a register has lanes.
    fn cos_tilts(&self, tosses: &Tosses<'_>, out: &mut [f64]) -> Result<(), Error> {
        assert_eq!(out.len(), tosses.len(), "one result a toss");
        let each = (0..tosses.len()).map(|index| tosses.solve(index, |toss| Ok(*toss)));
        let each = each.collect::<Result<Vec<Toss>, _>>()?;
        for (index, landing) in self.propagate_all(&each, SimdLevel::widest()).into_iter().enumerate() {
            out[index] = tosses.solve(index, |_| landing.clone())?.cos_tilt;
        }
        Ok(())
    }
}

/// A flight at its end.
#[derive(Debug, Clone, Copy)]
struct Landed {
    flight: Flight,
    /// P, as integrated.
    turn: [f64; 4],
    /// ωx and ωy in the flight's unit.
    rate: [f64; 2],
    work: Work,
}

/// The right-hand side over (w, x, y, z, ωx, ωy); all rates in one unit, whose inverse is the unit of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuaternionSystem {
    rate_z: f64,
    q: f64,
}

impl QuaternionSystem {
    /// The system of a coin of inertia ratio `inertia_ratio` = I3/I1 that spins at `rate_z` = ωz.
    pub fn new(inertia_ratio: f64, rate_z: f64) -> Self {
        Self { rate_z, q: body_precession_rate(inertia_ratio, rate_z) }
    }
}

impl OdeSystem<6> for QuaternionSystem {
    fn derivative(&self, y: &SVector<f64, 6>) -> SVector<f64, 6> {
        let &[w, x, y, z, rate_x, rate_y] = &y.data.0[0];
        let (half_x, half_y, half_z) = (0.5 * rate_x, 0.5 * rate_y, 0.5 * self.rate_z);
        let (rate_x_dot, rate_y_dot) = transverse_acceleration(self.q, rate_x, rate_y);
        SVector::from([
            -(x * half_x + y * half_y + z * half_z),
            w * half_x + y * half_z - z * half_y,
            w * half_y + z * half_x - x * half_z,
            w * half_z + x * half_y - y * half_x,
            rate_x_dot,
            rate_y_dot,
        ])
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, Scheme, TimeOfFlight, Vector3};
    use exact::ExactMotion;

    use super::*;

    fn toss(tilt: f64) -> Toss {
        let launch = Launch::new(Vector3::new(9.0, -4.0, 3.0), TimeOfFlight::Given(0.8)).unwrap();
        Toss { coin: Coin::PAPER, launch: launch.with_tilt(tilt).unwrap() }
    }

    /// Q' = ½ Q ⊗ (0, ω) against central differences of the exact attitude.
    #[test]
    fn the_derivative_is_that_of_the_exact_motion() {
        let motion = ExactMotion::new(&toss(0.4));
        let h = 1e-5;
        for step in 1..8 {
            let time = 0.1 * f64::from(step);
            let [before, now, after] = [time - h, time, time + h].map(|time| motion.state(time).unwrap());
            let [w, x, y, z] = now.attitude.components();
            let state = SVector::from([w, x, y, z, now.rate.x, now.rate.y]);
            let found = QuaternionSystem::new(0.5, now.rate.z).derivative(&state);
            let ends = after.attitude.components().into_iter().zip(before.attitude.components());
            for (part, (a, b)) in ends.enumerate() {
                assert!((found[part] - (a - b) / (2.0 * h)).abs() < 1e-7, "component {part} at {time}");
            }
            assert!((found[4] - (after.rate.x - before.rate.x) / (2.0 * h)).abs() < 1e-7);
            assert!((found[5] - (after.rate.y - before.rate.y) / (2.0 * h)).abs() < 1e-7);
        }
    }

    #[test]
    fn neither_work_nor_error_depends_on_the_tilt() {
        let solver = QuaternionSolver::new(Stepping::DEFAULT, Formulation::default());
        let horizontal = solver.propagate(&toss(0.0)).unwrap();
        for tilt in [1e-300, 1e-16, 1e-4, 1.0, 3.0] {
            let tilted = solver.propagate(&toss(tilt)).unwrap();
            assert_eq!(tilted.work, horizontal.work);
            assert_eq!(tilted.norm_error, horizontal.norm_error);
        }
    }

    #[test]
    fn the_norm_error_is_the_loss_of_norm_of_the_steps() {
        // A turn by RK4 loses (ωh/2)⁶/144 of its norm in each step.
        let launch = Launch::new(Vector3::new(4.0, 0.0, 0.0), TimeOfFlight::Given(1.0)).unwrap();
        let solver = QuaternionSolver::new(Stepping::fixed(Scheme::RK4, 0.05).unwrap(), Formulation::default());
        let landing = solver.propagate(&Toss { coin: Coin::DISC, launch }).unwrap();
        let lost = 20.0 * (4.0 * 0.05 / 2.0_f64).powi(6) / 144.0;
        assert!((landing.norm_error / lost - 1.0).abs() < 0.01, "{:e}, not {lost:e}", landing.norm_error);
    }

    #[test]
    fn raw_leaves_the_norm_in_cos_theta() {
        let launch = Launch::new(Vector3::new(4.0, 0.0, 0.0), TimeOfFlight::Given(1.0)).unwrap();
        let toss = Toss { coin: Coin::DISC, launch };
        let method = Stepping::fixed(Scheme::RK4, 0.05).unwrap();
        let landing = |formulation| QuaternionSolver::new(method, formulation).propagate(&toss).unwrap();
        let (projected, raw) = (landing(Formulation::MOMENTUM), landing(Formulation::RAW));
        assert_eq!(projected.cos_tilt, projected.state.attitude.cos_tilt());
        let norm = 1.0 - raw.norm_error;
        assert!(raw.norm_error > 1e-9 && (raw.cos_tilt - norm * norm * projected.cos_tilt).abs() < 1e-15);
    }

    #[test]
    fn a_batch_has_the_landings_of_its_tosses_in_their_order_by_any_scheme() {
        let [x, y, z, speed] = [[9.0, 3.0, 0.0], [-4.0, 2.0, 1.0], [3.0, 0.5, 2.0], [3.0, 4.0, 5.0]];
        let tosses = Tosses::new(Coin::PAPER, Attitude::IDENTITY, 9.81, [&x, &y, &z], &speed).unwrap();
        for scheme in [TAYLOR, Scheme::DOP853] {
            let solver = QuaternionSolver::new(Stepping::adaptive(scheme, 1e-9).unwrap(), Formulation::default());
            let mut found = [f64::NAN; 3];
            solver.cos_tilts(&tosses, &mut found).unwrap();
            let alone = [0, 1, 2].map(|index| solver.cos_tilt(&tosses.toss(index).unwrap()).unwrap());
            assert_eq!(found, alone);
            assert_eq!((solver.name(), solver.stepping().map(|by| by.scheme())), ("quaternion", Some(scheme)));
        }
    }
}
