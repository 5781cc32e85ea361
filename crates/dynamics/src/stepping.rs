//! [`Stepping`], the settings of an integrator: a scheme and what controls the size of its steps. The error estimate of
//! integrators follows from these settings alone, and is computed here for all of them.
//!
//! Steps either keep the local error below a tolerance, or have a given length. See
//! [`error_estimate`](Stepping::error_estimate) for the error of cos θ at landing that follows from either.

use crate::error::{InputError, SolveError, require};
use crate::launch::Toss;
use crate::phase::RoughPhases;
use crate::scheme::Scheme;

/// What sets the size of the steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepControl {
    /// Each step keeps its local error below `tolerance × (1 + |y|)` in every component y of the dimensionless state.
    /// For flights that turn by more than 100 rad the tolerance is [tightened](crate::Flight::tightened).
    Tolerance(f64),
    /// Equal steps of at most this length (s).
    Step(f64),
}

/// A scheme and its step control. No constructor combines a scheme with a control that it does not have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepping {
    scheme: Scheme,
    control: StepControl,
}

impl Stepping {
    /// The tolerance used if none is given.
    pub const DEFAULT_TOLERANCE: f64 = 1e-10;

    /// The stepping used if none is given.
    pub const DEFAULT: Self = Self { scheme: Scheme::DOP853, control: StepControl::Tolerance(Self::DEFAULT_TOLERANCE) };

    /// The step used for RK4 if none is given (s).
    pub const DEFAULT_STEP: f64 = 1e-3;

    /// `scheme` with steps that keep the local error below `tolerance`, absolute and relative.
    ///
    /// # Errors
    /// [`InputError`] if the scheme does not estimate its local error, or the tolerance is below ε = 2^-52 or not below
    /// 1.
    pub fn adaptive(scheme: Scheme, tolerance: f64) -> Result<Self, InputError> {
        if !scheme.is_adaptive() {
            return Err(InputError::Malformed {
                field: "scheme with a tolerance",
                value: scheme.name().to_owned(),
                expected: "a scheme with an error estimate, such as dop853, dopri5 or taylor; rk4 takes a step",
            });
        }
        let valid = (f64::EPSILON..1.0).contains(&tolerance);
        require("tolerance", tolerance, "2.220446049250313e-16 <= tolerance < 1", valid)?;
        Ok(Self { scheme, control: StepControl::Tolerance(tolerance) })
    }

    /// `scheme` with equal steps of at most `step` (s), which every Runge-Kutta scheme can take. The local error is
    /// then not measured.
    ///
    /// # Errors
    /// [`InputError`] if the scheme chooses its steps itself, or the step is not positive and finite.
    pub fn fixed(scheme: Scheme, step: f64) -> Result<Self, InputError> {
        if !scheme.takes_steps() {
            return Err(InputError::Malformed {
                field: "scheme with a step",
                value: scheme.name().to_owned(),
                expected: "a scheme with equal steps, such as dop853, dopri5 or rk4; taylor takes a tolerance",
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

    /// The same stepping with its tolerance [divided](tightened) by `factor`. Fixed steps are left unchanged.
    #[must_use]
    pub(crate) fn tightened(self, factor: f64) -> Self {
        let control = match self.control {
            StepControl::Tolerance(tolerance) => StepControl::Tolerance(tightened(tolerance, factor)),
            fixed @ StepControl::Step(_) => fixed,
        };
        Self { control, ..self }
    }

    /// Estimate of the error of cos θ at the landing of `toss`. For a flight with the [phase](RoughPhases::largest) φ
    /// (rad) it is
    ///
    /// - 100 × tolerance × (1 + φ) with a tolerance;
    /// - (|ω| h)^order × (1 + φ) + 4 ε (1 + φ + n) with n fixed steps of h (s). The first term is the truncation error
    ///   of a regular motion, the second one allows for rounding. Nothing is measured, so that the error near a
    ///   singular point may be larger.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`] if φ exceeds 2^53.
    pub fn error_estimate(&self, toss: &Toss) -> Result<f64, SolveError> {
        let turned = 1.0 + RoughPhases::new(toss).largest()?;
        Ok(match self.control {
            StepControl::Tolerance(tolerance) => 100.0 * tolerance * turned,
            StepControl::Step(step) => {
                // Schemes without an order take no fixed steps, so that the default is never used.
                let order = self.scheme.order().unwrap_or(0);
                let truncation = (toss.launch.turn_rate() * step).powf(f64::from(order));
                truncation * turned + 4.0 * f64::EPSILON * (turned + toss.launch.flight_time() / step)
            }
        })
    }
}

/// `tolerance` divided by `factor`, but at least ε. A `factor` below 1 leaves it unchanged.
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
    fn the_error_estimate_follows_from_the_tolerance_or_from_the_order_and_the_step() {
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
    fn tightening_stops_at_epsilon_and_does_not_change_fixed_steps() {
        let adaptive = Stepping::adaptive(Scheme::DOP853, 1e-10).unwrap();
        assert_eq!(adaptive.tightened(0.5), adaptive);
        assert_eq!(adaptive.tightened(100.0), Stepping::adaptive(Scheme::DOP853, 1e-12).unwrap());
        assert_eq!(adaptive.tightened(1e9), Stepping::adaptive(Scheme::DOP853, f64::EPSILON).unwrap());
        let fixed = Stepping::fixed(Scheme::RK4, 0.01).unwrap();
        assert_eq!(fixed.tightened(100.0), fixed);
    }

    #[test]
    fn takes_tolerances_from_epsilon_to_below_1_and_steps_above_0() {
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
