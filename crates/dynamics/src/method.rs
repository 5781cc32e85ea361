//! Methods of integration and their step control, as settings.
//!
//! An adaptive step keeps its local error below tolerance × (1 + |y|), a fixed one has its length. What a method
//! answers for at landing is the [resolution](Method::resolution) of cos θ, 100 × tolerance × (1 + phase) of an
//! adaptive one.

use serde::{Deserialize, Serialize};

use crate::error::{InputError, SolveError, find_named, require};
use crate::exact::ExactMotion;
use crate::launch::Toss;

/// A way to integrate: a Runge-Kutta scheme of `ode_solvers`, or Taylor series, which only the quaternion offers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scheme {
    /// Dormand and Prince's method of order 8(5,3) (Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I).
    Dop853,
    /// Dormand and Prince's method of order 5(4) (J. Comput. Appl. Math. 6, 1980).
    Dopri5,
    /// The classical method of order 4, without an error estimate.
    Rk4,
    /// Taylor series of an order that follows from the tolerance (Jorba & Zou, Exp. Math. 14 (2005), 99).
    Taylor,
}

impl Scheme {
    /// All schemes.
    pub const ALL: [Self; 4] = [Self::Dop853, Self::Dopri5, Self::Rk4, Self::Taylor];

    /// The Runge-Kutta schemes, which need no more of a system than its right-hand side.
    pub const RUNGE_KUTTA: [Self; 3] = [Self::Dop853, Self::Dopri5, Self::Rk4];

    /// The scheme called `name`.
    ///
    /// # Errors
    /// [`InputError::UnknownName`].
    pub fn named(name: &str) -> Result<Self, InputError> {
        find_named("method", name, &Self::ALL, |scheme| scheme.name()).copied()
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Dop853 => "dop853",
            Self::Dopri5 => "dopri5",
            Self::Rk4 => "rk4",
            Self::Taylor => "taylor",
        }
    }

    /// Order of the global error; `None` where it is chosen by the tolerance.
    pub fn order(self) -> Option<u32> {
        match self {
            Self::Dop853 => Some(8),
            Self::Dopri5 => Some(5),
            Self::Rk4 => Some(4),
            Self::Taylor => None,
        }
    }

    /// Whether it estimates its local error, so that a tolerance can steer its steps.
    pub fn is_adaptive(self) -> bool {
        self != Self::Rk4
    }

    /// Which Runge-Kutta scheme it is.
    pub(crate) fn runge_kutta(self) -> Result<RungeKutta, SolveError> {
        match self {
            Self::Dop853 => Ok(RungeKutta::Dop853),
            Self::Dopri5 => Ok(RungeKutta::Dopri5),
            Self::Rk4 => Ok(RungeKutta::Rk4),
            Self::Taylor => Err(SolveError::NotOffered { method: self.name() }),
        }
    }

    /// Whether it can keep to equal steps of a given length.
    pub fn takes_steps(self) -> bool {
        self != Self::Taylor
    }
}

/// The schemes of `ode_solvers`.
#[derive(Debug, Clone, Copy)]
pub(crate) enum RungeKutta {
    Dop853,
    Dopri5,
    Rk4,
}

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
pub struct Method {
    scheme: Scheme,
    control: StepControl,
}

impl Method {
    /// The tolerance used where none is asked for.
    pub const DEFAULT_TOLERANCE: f64 = 1e-10;

    /// The method used where none is asked for.
    pub const DEFAULT: Self = Self { scheme: Scheme::Dop853, control: StepControl::Tolerance(Self::DEFAULT_TOLERANCE) };

    /// The step used for RK4 where none is asked for (s).
    pub const DEFAULT_STEP: f64 = 1e-3;

    /// `scheme` with steps that keep the local error below `tolerance`, absolute and relative.
    ///
    /// # Errors
    /// [`InputError`] if the scheme has no error estimate, or the tolerance is below ε = 2^-52 or not below 1.
    pub fn adaptive(scheme: Scheme, tolerance: f64) -> Result<Self, InputError> {
        if !scheme.is_adaptive() {
            return Err(InputError::Malformed {
                field: "method with a tolerance",
                value: scheme.name().to_owned(),
                expected: "dop853, dopri5 or taylor; rk4 takes a step",
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
                field: "method with a step",
                value: scheme.name().to_owned(),
                expected: "dop853, dopri5 or rk4; taylor chooses its order and steps by a tolerance",
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

    /// The method with its tolerance, if it has one, divided by `factor`, down to ε; unchanged for a factor below 1.
    #[must_use]
    pub(crate) fn tightened(self, factor: f64) -> Self {
        let control = match self.control {
            StepControl::Tolerance(tolerance) => StepControl::Tolerance(tightened(tolerance, factor)),
            fixed @ StepControl::Step(_) => fixed,
        };
        Self { control, ..self }
    }

    /// Error of cos θ at the landing of `toss` that a solver with this method answers for, after a
    /// [`phase`](ExactMotion::phase) φ (rad):
    ///
    /// - with a tolerance, 100 × tolerance × (1 + φ);
    /// - with n fixed steps h, which come without an estimate, what their order promises of a regular motion and what
    ///   rounding may do: (|ω| h)^order × (1 + φ) + 4 ε (1 + φ + n).
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    pub fn resolution(&self, toss: &Toss) -> Result<f64, SolveError> {
        let turned = 1.0 + ExactMotion::new(toss).phase(toss.launch.time_of_flight())?;
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
    fn a_solver_answers_for_a_hundred_tolerances_a_radian_or_for_the_order_of_its_steps() {
        // A sphere at 2 rad/s for 3 s: a phase of 6 rad.
        let launch = Launch::new(Vector3::new(0.0, 2.0, 0.0), TimeOfFlight::Given(3.0)).unwrap();
        let toss = Toss { coin: Coin::from_moments(1.0, 1.0).unwrap(), launch };
        let near =
            |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found}, not {expected}");
        let adaptive = Method::adaptive(Scheme::Dopri5, 1e-8).unwrap();
        near(adaptive.resolution(&toss).unwrap(), 100.0 * 1e-8 * 7.0);
        let fixed = Method::fixed(Scheme::Rk4, 0.01).unwrap();
        near(fixed.resolution(&toss).unwrap(), 0.02_f64.powi(4) * 7.0 + 4.0 * f64::EPSILON * (7.0 + 300.0));
    }

    #[test]
    fn a_tighter_tolerance_stops_at_rounding_and_leaves_steps_alone() {
        let adaptive = Method::adaptive(Scheme::Dop853, 1e-10).unwrap();
        assert_eq!(adaptive.tightened(0.5), adaptive);
        assert_eq!(adaptive.tightened(100.0), Method::adaptive(Scheme::Dop853, 1e-12).unwrap());
        assert_eq!(adaptive.tightened(1e9), Method::adaptive(Scheme::Dop853, f64::EPSILON).unwrap());
        let fixed = Method::fixed(Scheme::Rk4, 0.01).unwrap();
        assert_eq!(fixed.tightened(100.0), fixed);
    }

    #[test]
    fn a_scheme_is_named_and_has_the_order_and_the_steps_that_it_can_take() {
        let table = [("dop853", Some(8), true, true), ("dopri5", Some(5), true, true), ("rk4", Some(4), false, true)];
        for (scheme, (name, order, adapts, steps)) in
            Scheme::ALL.into_iter().zip(table.into_iter().chain([("taylor", None, true, false)]))
        {
            assert_eq!((scheme.name(), Scheme::named(name)), (name, Ok(scheme)));
            assert_eq!((scheme.order(), scheme.is_adaptive(), scheme.takes_steps()), (order, adapts, steps));
            assert_eq!(Method::adaptive(scheme, 1e-9).is_ok(), adapts);
            assert_eq!(Method::fixed(scheme, 1e-3).is_ok(), steps);
            assert_eq!(scheme.runge_kutta().is_ok(), Scheme::RUNGE_KUTTA.contains(&scheme));
        }
    }

    #[test]
    fn tolerances_are_from_rounding_to_below_1_and_steps_above_0() {
        for (tolerance, taken) in [(f64::EPSILON, true), (0.999, true), (1.0, false), (0.99 * f64::EPSILON, false)] {
            assert_eq!(Method::adaptive(Scheme::Taylor, tolerance).is_ok(), taken, "{tolerance}");
        }
        for (step, taken) in [(5e-324, true), (1e9, true), (0.0, false), (-1.0, false), (f64::NAN, false)] {
            assert_eq!(Method::fixed(Scheme::Rk4, step).is_ok(), taken, "{step}");
        }
        let method = Method::fixed(Scheme::Rk4, 0.25).unwrap();
        assert_eq!((method.scheme(), method.control()), (Scheme::Rk4, StepControl::Step(0.25)));
    }
}
