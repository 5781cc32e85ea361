//! How an integrator steps: a scheme and its step control, as settings.
//!
//! An adaptive step keeps its local error below tolerance × (1 + |y|), a fixed one has its length. The
//! [error estimate](Stepping::error_estimate) of cos θ at landing is 100 × tolerance × (1 + phase) for a tolerance.

use crate::error::{InputError, SolveError, require};
use crate::launch::Toss;
use crate::phase::RoughPhases;
use crate::scheme::Scheme;

/// What sets the size of the steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepControl {
    /// Local error per step below `tolerance × (1 + |y|)`, in every component of the dimensionless state. Flights that turn
    /// by more than 100 rad get a tighter one, see [`Flight`](crate::Flight).
    Tolerance(f64),
    /// Equal steps of at most this length (s).
    Step(f64),
}

/// A scheme and its step control. Only combinations that make sense can be made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepping {
    scheme: Scheme,
    control: StepControl,
}

impl Stepping {
    /// The tolerance used where none is asked for.
    pub const DEFAULT_TOLERANCE: f64 = 1e-10;

    /// The stepping used where none is asked for.
    pub const DEFAULT: Self = Self { scheme: Scheme::DOP853, control: StepControl::Tolerance(Self::DEFAULT_TOLERANCE) };

    /// The step used for RK4 where none is asked for (s).
    pub const DEFAULT_STEP: f64 = 1e-3;

    /// `scheme` with steps that keep the local error below `tolerance`, absolute and relative.
    ///
    /// # Errors
    /// [`InputError`] if the scheme has no error estimate, or the tolerance is below ε = 2^-52 or not below 1.
    pub fn adaptive(scheme: Scheme, tolerance: f64) -> Result<Self, InputError> {
        if !scheme.is_adaptive() {
            return Err(InputError::Malformed {
                field: "scheme with a tolerance",
                value: scheme.name().to_owned(),
                expected: "a scheme with an error estimate, as dop853, dopri5 or taylor; rk4 takes a step",
            });
        }
        let valid = (f64::EPSILON..1.0).contains(&tolerance);
        require("tolerance", tolerance, "2.220446049250313e-16 <= tolerance < 1", valid)?;
        Ok(Self { scheme, control: StepControl::Tolerance(tolerance) })
    }

    /// `scheme` with equal steps of at most `step` (s); every Runge-Kutta scheme can do this, and its error is not estimated.
    ///
    /// # Errors
    /// [`InputError`] if the scheme chooses its steps itself, or the step is not positive and finite.
    pub fn fixed(scheme: Scheme, step: f64) -> Result<Self, InputError> {
        if !scheme.takes_steps() {
            return Err(InputError::Malformed {
                field: "scheme with a step",
                value: scheme.name().to_owned(),
                expected: "a scheme with equal steps, as dop853, dopri5 or rk4; taylor chooses its order and steps by a tolerance",
            });
        }
        require("step [s]", step, "finite and > 0", step > 0.0)?;
        Ok(Self { scheme, control: StepControl::Step(step) })
    }

    /// The scheme.
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// Its step control.
    pub fn control(&self) -> StepControl {
        self.control
    }

    /// The stepping with its tolerance, if it has one, divided by `factor`, down to ε; unchanged for a factor below 1.
    #[must_use]
    pub(crate) fn tightened(self, factor: f64) -> Self {
        let control = match self.control {
            StepControl::Tolerance(tolerance) => StepControl::Tolerance(tightened(tolerance, factor)),
            fixed @ StepControl::Step(_) => fixed,
        };
        Self { control, ..self }
    }

    /// Estimate of the error of cos θ at the landing of `toss`, after a [phase](RoughPhases::largest) φ (rad):
    ///
    /// - with a tolerance, 100 × tolerance × (1 + φ);
    /// - with n fixed steps h, which come without an estimate, what their order promises of a regular motion and what
    ///   rounding may do: (|ω| h)^order × (1 + φ) + 4 ε (1 + φ + n).
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    pub fn error_estimate(&self, toss: &Toss) -> Result<f64, SolveError> {
        let turned = 1.0 + RoughPhases::new(toss).largest()?;
        Ok(match self.control {
            StepControl::Tolerance(tolerance) => 100.0 * tolerance * turned,
            StepControl::Step(step) => {
                // A scheme without an order takes no steps.
                let order = self.scheme.order().unwrap_or(0);
                let truncation = (toss.launch.turn_rate() * step).powf(f64::from(order));
                truncation * turned + 4.0 * f64::EPSILON * (turned + toss.launch.flight_time() / step)
            }
        })
    }
}

/// `tolerance` divided by `factor`, down to ε; unchanged for a factor below 1.
pub(crate) fn tightened(tolerance: f64, factor: f64) -> f64 {
    (tolerance / factor.max(1.0)).max(f64::EPSILON)
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::coin::Coin;
    use crate::launch::Launch;
    use crate::time_of_flight::TimeOfFlight;

    #[test]
    fn the_error_estimate_is_a_hundred_tolerances_a_radian_or_follows_from_the_order_of_the_steps() {
        // A sphere at 2 rad/s for 3 s: a phase of 6 rad.
        let launch = Launch::new(Vector3::new(0.0, 2.0, 0.0), TimeOfFlight::Given(3.0)).unwrap();
        let toss = Toss { coin: Coin::from_moments(1.0, 1.0).unwrap(), launch };
        let near =
            |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found}, not {expected}");
        let adaptive = Stepping::adaptive(Scheme::DOPRI5, 1e-8).unwrap();
        near(adaptive.error_estimate(&toss).unwrap(), 100.0 * 1e-8 * 7.0);
        let fixed = Stepping::fixed(Scheme::RK4, 0.01).unwrap();
        near(fixed.error_estimate(&toss).unwrap(), 0.02_f64.powi(4) * 7.0 + 4.0 * f64::EPSILON * (7.0 + 300.0));
    }

    #[test]
    fn a_tighter_tolerance_stops_at_rounding_and_leaves_steps_alone() {
        let adaptive = Stepping::adaptive(Scheme::DOP853, 1e-10).unwrap();
        assert_eq!(adaptive.tightened(0.5), adaptive);
        assert_eq!(adaptive.tightened(100.0), Stepping::adaptive(Scheme::DOP853, 1e-12).unwrap());
        assert_eq!(adaptive.tightened(1e9), Stepping::adaptive(Scheme::DOP853, f64::EPSILON).unwrap());
        let fixed = Stepping::fixed(Scheme::RK4, 0.01).unwrap();
        assert_eq!(fixed.tightened(100.0), fixed);
    }

    #[test]
    fn tolerances_are_from_rounding_to_below_1_and_steps_above_0() {
        for (tolerance, taken) in [(f64::EPSILON, true), (0.999, true), (1.0, false), (0.99 * f64::EPSILON, false)] {
            assert_eq!(Stepping::adaptive(Scheme::DOPRI5, tolerance).is_ok(), taken, "{tolerance}");
        }
        for (step, taken) in [(5e-324, true), (1e9, true), (0.0, false), (-1.0, false), (f64::NAN, false)] {
            assert_eq!(Stepping::fixed(Scheme::RK4, step).is_ok(), taken, "{step}");
        }
        let stepping = Stepping::fixed(Scheme::RK4, 0.25).unwrap();
        assert_eq!((stepping.scheme(), stepping.control()), (Scheme::RK4, StepControl::Step(0.25)));
    }
}
