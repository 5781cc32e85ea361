//! The flight integrated as a quaternion: Q' = ½ Q ⊗ (0, ω).
//!
//! The quaternion P that leads from the launch attitude Q0 to the attitude Q = Q0 ⊗ P starts at 1 for every toss, so
//! neither error nor work depends on how the coin is held at launch. No attitude is singular.
//!
//! The state is (P, ωx, ωy): the body rate comes from Euler's equations (1), integrated along with the attitude, never
//! from their closed-form solution. Rates are divided by a power of two, as [`dynamics::integrate`] wants them.

use dynamics::body_rate::{body_precession_rate, transverse_acceleration};
use dynamics::integrate::{OdeSystem, integrate};
use dynamics::solver::power_of_two_scale;
use dynamics::{
    Attitude, ExactMotion, Method, Propagation, Settings, SolveError, Solver, SolverEntry, State, Toss, Vector3,
};
use nalgebra::SVector;

/// The quaternion's solver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct QuaternionSolver {
    method: Method,
}

impl QuaternionSolver {
    /// The registry's line.
    pub const ENTRY: SolverEntry = SolverEntry {
        name: "quaternion",
        summary: "Q' = ½ Q ⊗ (0, ω): no singular attitude",
        integrates: true,
        build: |settings: &Settings| Box::new(Self::new(settings.method)),
    };

    /// A solver that steps by `method`.
    pub fn new(method: Method) -> Self {
        Self { method }
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
        let duration = toss.launch.flight_time();
        ExactMotion::new(toss).phase(duration)?;
        let rate = toss.launch.rate();
        let scale = power_of_two_scale(&rate);
        let system = QuaternionSystem::new(toss.coin.inertia_ratio(), rate.z / scale);
        let start = SVector::from([1.0, 0.0, 0.0, 0.0, rate.x / scale, rate.y / scale]);
        let (end, work) = integrate(&system, start, duration, scale, &self.method)?;
        // Rounding and truncation change the norm; only the direction is the attitude.
        let turn = Attitude::from_components([end[0], end[1], end[2], end[3]])
            .map_err(|_| SolveError::NotFinite { time: duration })?;
        let defect = (end.fixed_rows::<4>(0).norm() - 1.0).abs();
        let rate = Vector3::new(end[4] * scale, end[5] * scale, rate.z);
        Ok(Propagation { state: State { attitude: toss.launch.attitude() * turn, rate }, defect, work })
    }

    fn resolution(&self, phase: f64) -> f64 {
        self.method.resolution(phase)
    }
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
