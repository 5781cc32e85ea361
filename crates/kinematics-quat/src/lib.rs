//! The flight integrated as a quaternion: Q' = ½ Q ⊗ (0, ω).
//!
//! The quaternion P that leads from the launch attitude Q0 to the attitude Q = Q0 ⊗ P starts at 1 for every toss, so
//! neither error nor work depends on how the coin is held at launch. No attitude is singular.
//!
//! The state is (P, ωx, ωy): the body rate comes from Euler's equations (1), integrated along with the attitude, never
//! from their closed-form solution. Rates are dimensionless, as a [`Flight`] has them. `dynamics::integrate` steps it
//! by Runge and Kutta's methods; Taylor series, which need more of a system than its right-hand side, are here:
//! `taylor.rs` has a step, `lockstep.rs` the flights.

mod compensated;
mod lockstep;
mod taylor;

use dynamics::batch::{BatchError, Filtered, Tosses};
use dynamics::body_rate::{body_precession_rate, transverse_acceleration};
use dynamics::integrate::OdeSystem;
use dynamics::lanes::Path;
use dynamics::{
    Attitude, Flight, Formulation, Method, Propagation, Scheme, Settings, SolveError, Solver, SolverEntry, State,
    StepControl, Toss, Verdict, Work,
};
use lockstep::Plans;
use nalgebra::SVector;

/// The quaternion's solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuaternionSolver {
    method: Method,
    projects: bool,
    /// `None` for a Runge-Kutta method.
    taylor: Option<Plans>,
}

impl QuaternionSolver {
    /// The registry's line.
    pub const ENTRY: SolverEntry = SolverEntry {
        name: "quaternion",
        summary: "Q' = ½ Q ⊗ (0, ω): no singular attitude",
        formulations: &[Formulation::Momentum, Formulation::Raw],
        schemes: &Scheme::ALL,
        build: |settings: &Settings| Box::new(Self::new(settings.method, settings.formulation)),
    };

    /// A solver that steps by `method`. All formulations are the same but [`Formulation::Raw`], whose cos θ is that of
    /// the quaternion as it was integrated, without projection onto unit norm.
    pub fn new(method: Method, formulation: Formulation) -> Self {
        let taylor = match (method.scheme(), method.control()) {
            (Scheme::Taylor, StepControl::Tolerance(tolerance)) => Some(Plans::new(tolerance)),
            _ => None,
        };
        Self { method, projects: formulation != Formulation::Raw, taylor }
    }

    /// The landings of `tosses`, in their order, each with the same bits as by [`Solver::propagate`]. By
    /// [`Scheme::Taylor`] as many fly at once as a vector of `path` has lanes; by the others one after the other.
    pub fn propagate_all(&self, tosses: &[Toss], path: Path) -> Vec<Result<Propagation, SolveError>> {
        let Some(plans) = &self.taylor else {
            return tosses.iter().map(|toss| self.propagate(toss)).collect();
        };
        let mut landings = vec![Err(SolveError::NotFinite { time: 0.0 }); tosses.len()];
        self.fly(tosses, plans, path, |index, landing| landings[index] = landing);
        landings
    }

    /// Hands the number and the landing of each of `tosses` to `land`, by Taylor series.
    fn fly(
        &self,
        tosses: &[Toss],
        plans: &Plans,
        path: Path,
        mut land: impl FnMut(usize, Result<Propagation, SolveError>),
    ) {
        plans.fly(tosses, path, |index, landed| {
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
        Ok(Propagation { state, cos_tilt, defect: (norm - 1.0).abs(), work })
    }
}

impl Solver for QuaternionSolver {
    fn name(&self) -> &'static str {
        Self::ENTRY.name
    }

    fn method(&self) -> Option<Method> {
        Some(self.method)
    }

    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
        if let Some(plans) = &self.taylor {
            let mut landing = Err(SolveError::NotFinite { time: 0.0 });
            self.fly(std::slice::from_ref(toss), plans, Path::for_one_lane(), |_, found| landing = found);
            return landing;
        }
        let flight = Flight::new(toss)?;
        let system = QuaternionSystem::new(toss.coin.inertia_ratio(), flight.rate.z);
        let start = SVector::from([1.0, 0.0, 0.0, 0.0, flight.rate.x, flight.rate.y]);
        let (end, work) = flight.integrate(&system, start, &self.method)?;
        let &[w, x, y, z, rate_x, rate_y] = &end.data.0[0];
        self.landing(toss, &Landed { flight, turn: [w, x, y, z], rate: [rate_x, rate_y], work })
    }

    /// By Taylor series as many fly at once as a vector has lanes.
    fn count(&self, tosses: &Tosses<'_>, rest: &mut dyn FnMut(Verdict)) -> Result<Filtered, BatchError> {
        let each = (0..tosses.len()).map(|index| tosses.solve(index, |toss| Ok(*toss)));
        let each = each.collect::<Result<Vec<Toss>, _>>()?;
        for (index, (toss, landing)) in each.iter().zip(self.propagate_all(&each, Path::widest())).enumerate() {
            let verdict = landing.and_then(|landing| self.verdict_at(toss, landing.cos_tilt));
            rest(verdict.map_err(|error| BatchError { index, source: error.into() })?);
        }
        Ok(Filtered::default())
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
    use dynamics::{Coin, ExactMotion, Launch, Scheme, TimeOfFlight, Vector3};

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
        let solver = QuaternionSolver::new(Method::DEFAULT, Formulation::default());
        let horizontal = solver.propagate(&toss(0.0)).unwrap();
        for tilt in [1e-300, 1e-16, 1e-4, 1.0, 3.0] {
            let tilted = solver.propagate(&toss(tilt)).unwrap();
            assert_eq!(tilted.work, horizontal.work);
            assert_eq!(tilted.defect, horizontal.defect);
        }
    }

    #[test]
    fn the_defect_is_the_loss_of_norm_of_the_steps() {
        // A turn by RK4 loses (ωh/2)⁶/144 of its norm in each step.
        let launch = Launch::new(Vector3::new(4.0, 0.0, 0.0), TimeOfFlight::Given(1.0)).unwrap();
        let solver = QuaternionSolver::new(Method::fixed(Scheme::Rk4, 0.05).unwrap(), Formulation::default());
        let landing = solver.propagate(&Toss { coin: Coin::DISC, launch }).unwrap();
        let lost = 20.0 * (4.0 * 0.05 / 2.0_f64).powi(6) / 144.0;
        assert!((landing.defect / lost - 1.0).abs() < 0.01, "{:e}, not {lost:e}", landing.defect);
    }

    #[test]
    fn raw_leaves_the_norm_in_cos_theta() {
        let launch = Launch::new(Vector3::new(4.0, 0.0, 0.0), TimeOfFlight::Given(1.0)).unwrap();
        let toss = Toss { coin: Coin::DISC, launch };
        let method = Method::fixed(Scheme::Rk4, 0.05).unwrap();
        let landing = |formulation| QuaternionSolver::new(method, formulation).propagate(&toss).unwrap();
        let (projected, raw) = (landing(Formulation::Momentum), landing(Formulation::Raw));
        assert_eq!(projected.cos_tilt, projected.state.attitude.cos_tilt());
        let norm = 1.0 - raw.defect;
        assert!(raw.defect > 1e-9 && (raw.cos_tilt - norm * norm * projected.cos_tilt).abs() < 1e-15);
    }

    #[test]
    fn it_counts_a_batch_in_its_order_by_any_scheme() {
        let [x, y, z, speed] = [[9.0, 3.0, 0.0], [-4.0, 2.0, 1.0], [3.0, 0.5, 2.0], [3.0, 4.0, 5.0]];
        let tosses = Tosses::new(Coin::PAPER, Attitude::IDENTITY, 9.81, [&x, &y, &z], &speed).unwrap();
        for scheme in [Scheme::Taylor, Scheme::Dop853] {
            let solver = QuaternionSolver::new(Method::adaptive(scheme, 1e-9).unwrap(), Formulation::default());
            let mut verdicts = Vec::new();
            assert_eq!(solver.count(&tosses, &mut |verdict| verdicts.push(verdict)), Ok(Filtered::default()));
            let alone = (0..3).map(|index| solver.verdict(&tosses.toss(index).unwrap()).unwrap());
            assert_eq!(verdicts, alone.collect::<Vec<_>>());
            assert_eq!((solver.name(), solver.method().map(|method| method.scheme())), ("quaternion", Some(scheme)));
        }
    }
}
