//! [`FreeRotation`], the free rotation of a coin as a first-order system in plain arrays, for steppers from elsewhere.
//! Any package that integrates y' = f(y) can fly a toss by it, without a type of this workspace in its own code.
//!
//! The state is y = (w, x, y, z, ωx, ωy, ωz). (w, x, y, z) is the quaternion P that leads from the attitude Q0 at
//! launch to the attitude Q = Q0 ⊗ P, both from BF (body frame) to LF (laboratory frame), and ω is the body rate (BF):
//!
//! ```text
//! P' = ½ P ⊗ (0, ω),   ωx' = -(k - 1) ωz ωy,   ωy' = (k - 1) ωz ωx,   ωz' = 0.
//! ```
//!
//! The system does not depend on the time. It is dimensionless, as in a [`Flight`]: σ is the power of two at or below
//! the largest component of ω at launch, rates are in units of σ and times in units of 1/σ. A tolerance then means the
//! same for slow and for fast coins, and P starts at 1 however the coin is held.

use std::sync::atomic::{AtomicU64, Ordering};

use nalgebra::Vector4;

use crate::attitude::Attitude;
use crate::body_rate::{body_precession_rate, transverse_acceleration};
use crate::error::SolveError;
use crate::flight::Flight;
use crate::solver::{Landing, Work};
use crate::state::State;
use crate::stepping::{StepControl, Stepping, step_count};
use crate::toss::{CoinToss, Toss};

/// The rotation of a toss from launch to landing. See [this module](self) for its state and its units.
///
/// A classical Runge-Kutta step of it, by hand:
///
/// ```
/// # use dynamics::{Coin, FreeRotation, Launch, TimeOfFlight, CoinToss, Vector3};
/// # let launch = Launch::new(Vector3::new(2.0, 1.0, 2.5), TimeOfFlight::Given(0.6))?;
/// let system = FreeRotation::new(&CoinToss { coin: Coin::PAPER, launch })?;
/// let (mut y, steps) = (system.start(), 1000_u32);
/// let h = system.duration() / f64::from(steps);
/// for _ in 0..steps {
///     let along = |slope: &[f64; 7], h: f64| std::array::from_fn(|part| y[part] + h * slope[part]);
///     let a = system.derivative(&y);
///     let b = system.derivative(&along(&a, h / 2.0));
///     let c = system.derivative(&along(&b, h / 2.0));
///     let d = system.derivative(&along(&c, h));
///     y = std::array::from_fn(|part| y[part] + h / 6.0 * (a[part] + 2.0 * (b[part] + c[part]) + d[part]));
/// }
/// let landing = system.landing(&y, system.work(steps.into(), 0))?;
/// assert_eq!((landing.work.rhs_calls, landing.work.accepted_steps), (4000, 1000));
/// assert!(landing.norm_error < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FreeRotation {
    flight: Flight,
    launched: Attitude,
    /// k = I3/I1.
    inertia_ratio: f64,
    /// T (s).
    seconds: f64,
    /// Calls of the derivative so far.
    calls: AtomicU64,
}

impl FreeRotation {
    /// The rotation of `toss`.
    pub fn new(toss: &CoinToss) -> Result<Self, SolveError> {
        Ok(Self {
            flight: Flight::new(&Toss::from(*toss))?,
            launched: toss.launch.attitude(),
            inertia_ratio: toss.coin.inertia_ratio(),
            seconds: toss.launch.flight_time(),
            calls: AtomicU64::new(0),
        })
    }

    /// The state at launch.
    pub fn start(&self) -> [f64; 7] {
        let rate = &self.flight.rate;
        [1.0, 0.0, 0.0, 0.0, rate.x, rate.y, rate.z]
    }

    /// The time from launch to landing, in units of 1/σ.
    pub fn duration(&self) -> f64 {
        self.flight.span()
    }

    /// y' at `y`. Each call is counted.
    pub fn derivative(&self, y: &[f64; 7]) -> [f64; 7] {
        // A plain addition would do: no two threads step one flight. An atomic number keeps the system `Sync`, which
        // some steppers ask for.
        self.calls.store(self.calls.load(Ordering::Relaxed) + 1, Ordering::Relaxed);
        let &[w, x, y, z, rate_x, rate_y, rate_z] = y;
        let [half_x, half_y, half_z] = [rate_x, rate_y, rate_z].map(|rate| 0.5 * rate);
        let q = body_precession_rate(self.inertia_ratio, rate_z);
        let (rate_x_dot, rate_y_dot) = transverse_acceleration(q, rate_x, rate_y);
        [
            -(x * half_x + y * half_y + z * half_z),
            w * half_x + y * half_z - z * half_y,
            w * half_y + z * half_x - x * half_z,
            w * half_z + x * half_y - y * half_x,
            rate_x_dot,
            rate_y_dot,
            0.0,
        ]
    }

    /// The work so far: the calls of the derivative as they were counted, and the steps as the stepper reports them.
    pub fn work(&self, accepted_steps: u64, rejected_steps: u64) -> Work {
        Work { rhs_calls: self.calls.load(Ordering::Relaxed), accepted_steps, rejected_steps }
    }

    /// The landing from the state at its end. The quaternion is divided by its norm. Fails with
    /// [`SolveError::NotFinite`] if the state is not finite, or its quaternion is 0.
    pub fn landing(&self, end: &[f64; 7], work: Work) -> Result<Landing, SolveError> {
        let &[w, x, y, z, rate_x, rate_y, rate_z] = end;
        if !end.iter().all(|part| part.is_finite()) {
            return Err(self.flight.not_finite());
        }
        let turn = Attitude::from_components([w, x, y, z]).map_err(|_| self.flight.not_finite())?;
        let rate = self.flight.rate_at([rate_x, rate_y, rate_z]);
        let norm = Vector4::new(w, x, y, z).norm();
        let state = State { attitude: self.launched * turn, rate };
        Ok(Landing::new(state, work).with_norm_error((norm - 1.0).abs()))
    }

    /// `stepping` in the units of the system. The tolerance is [tightened](Flight::tightened) for a flight of more than
    /// 100 rad; a step becomes the longest one, not above it, that divides the [`duration`](Self::duration) evenly.
    pub fn stepping(&self, stepping: &Stepping) -> Result<Stepping, SolveError> {
        let control = match stepping.control() {
            StepControl::Tolerance(tolerance) => StepControl::Tolerance(self.flight.tightened(tolerance)),
            StepControl::Step(step) => StepControl::Step(self.duration() / step_count(self.seconds, step)?),
        };
        Ok(stepping.controlled_by(control))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::coin::Coin;
    use crate::launch::Launch;
    use crate::scheme::Scheme;
    use crate::time_of_flight::TimeOfFlight;

    fn toss(rate: [f64; 3], time: f64) -> CoinToss {
        let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(time)).unwrap();
        CoinToss { coin: Coin::PAPER, launch: launch.with_tilt(0.7).unwrap() }
    }

    #[test]
    fn the_state_at_launch_lands_as_the_launch_with_rates_of_any_size() {
        for rate in [[9.0, -4.0, 3.0], [1e-300, 2e-310, 5e-324], [1e300, 1.0, -1e-300], [0.0; 3]] {
            let toss = toss(rate, 1e-301);
            let system = FreeRotation::new(&toss).unwrap();
            let landing = system.landing(&system.start(), system.work(0, 0)).unwrap();
            assert_eq!(landing.state.rate, toss.launch.rate());
            assert!(landing.state.attitude.angle_to(&toss.launch.attitude()) < 1e-15);
            assert_eq!((landing.norm_error, landing.work), (0.0, Work::default()));
        }
    }

    /// Compares the derivative with Hamilton's product and with Euler's equations I ω' = I ω × ω.
    #[test]
    fn the_derivative_is_half_the_product_with_the_rate_and_eulers_equations() {
        let system = FreeRotation::new(&toss([2.0, 1.0, 2.5], 1.0)).unwrap();
        let [w, x, y, z, a, b, c] = [0.1, -0.7, 0.5, 0.3, 1.5, -0.25, 2.5];
        let product = nalgebra::Quaternion::new(w, x, y, z) * nalgebra::Quaternion::new(0.0, a, b, c) * 0.5;
        let k = Coin::PAPER.inertia_ratio();
        let torque = Vector3::new(a, b, k * c).cross(&Vector3::new(a, b, c));
        let expected = [product.w, product.i, product.j, product.k, torque.x, torque.y, torque.z / k];
        let found = system.derivative(&[w, x, y, z, a, b, c]);
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15, "{found}, not {expected}");
        }
        assert_eq!(system.work(3, 1), Work { rhs_calls: 1, accepted_steps: 3, rejected_steps: 1 });
    }

    #[test]
    fn steps_are_in_units_of_the_system_and_divide_its_duration() {
        let system = FreeRotation::new(&toss([60.0, -8.0, 0.1], 0.5)).unwrap();
        assert_eq!((system.duration(), system.start()[4]), (16.0, 60.0 / 32.0));
        let stepping = system.stepping(&Stepping::fixed(Scheme::RK4, 0.2).unwrap()).unwrap();
        assert_eq!(stepping.control(), StepControl::Step(16.0 / 3.0));
        let error = system.stepping(&Stepping::fixed(Scheme::RK4, 1e-9).unwrap()).unwrap_err();
        assert_eq!(error.kind(), "step_limit");
        let long = FreeRotation::new(&toss([60.0, -8.0, 0.1], 50.0)).unwrap();
        let StepControl::Tolerance(tight) = long.stepping(&Stepping::DEFAULT).unwrap().control() else { panic!() };
        assert!(tight < 0.1 * Stepping::DEFAULT_TOLERANCE, "{tight}");
    }

    #[test]
    fn a_spin_that_the_stepper_changed_is_not_replaced_by_that_of_the_launch() {
        let system = FreeRotation::new(&toss([4.0, 0.0, 1.0], 0.5)).unwrap();
        let mut end = system.start();
        end[6] = 0.5;
        assert_eq!(system.landing(&end, Work::default()).unwrap().state.rate.z, 2.0);
    }

    #[test]
    fn states_that_are_no_attitude_are_errors() {
        let system = FreeRotation::new(&toss([4.0, 0.0, 1.0], 0.5)).unwrap();
        for (part, value) in [(0, f64::NAN), (4, f64::INFINITY), (6, f64::NAN), (0, 0.0)] {
            let mut end = system.start();
            end[part] = value;
            assert_eq!(system.landing(&end, Work::default()).unwrap_err().kind(), "not_finite", "{part}");
        }
    }
}
