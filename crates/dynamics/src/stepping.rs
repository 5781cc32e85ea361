//! [`Stepping`], the settings of an integrator: a scheme and what controls the size of its steps. The error estimate of
//! integrators follows from these settings alone, and is computed here for all of them.
//!
//! Steps either keep the local error below a tolerance, or have a given length. See
//! [`error_estimate`](Stepping::error_estimate) for the error of cos θ at landing that follows from either.

use std::f64::consts::SQRT_2;
use std::fmt;
use std::str::FromStr;

use crate::body::Body;
use crate::error::{InputError, SolveError, require};
use crate::phase::Phases;
use crate::quantity::Dimension;
use crate::scheme::Scheme;
use crate::toss::Toss;

/// The largest number of steps of a flight. It is limited because integrators hold all steps in memory.
pub const STEP_LIMIT: u32 = 1_000_000;

/// The steps of an adaptive scheme in a turn of 1 rad, times tolerance^(1/order), which makes them alike for all schemes.
/// Measured: up to 0.15 for DOP853 and 0.24 for DOPRI5, at tolerances from 1e-6 to ε; more in moments near a singular
/// point. Series have no order: their steps are about as long at any tolerance.
const STEPS_IN_A_RADIAN: f64 = 0.25;

/// Phase (rad) above which the tolerance of the steps is divided by phase/`LONG_FLIGHT`.
///
/// The errors of the steps add up in |ω|, and the errors of |ω| add up in the phase. The error at landing therefore
/// grows like tolerance × phase²; the largest factor that was measured is 0.14. With the tightened tolerance the error
/// at landing stays below the [error estimate](Stepping::error_estimate), 100 × tolerance × (1 + phase) and rounding. A
/// tolerance is not tightened below ε, where rounding is larger than what steps leave out.
pub(crate) const LONG_FLIGHT: f64 = 100.0;

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

    /// `scheme` with steps that keep the local error below `tolerance`, absolute and relative. Fails if the scheme does
    /// not estimate its local error, or the tolerance is below ε = 2^-52 or not below 1.
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
    /// then not measured. Fails if the scheme chooses its steps itself, or the step is not positive and finite.
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

    /// `scheme` with the step control that it takes by default: [`DEFAULT_TOLERANCE`](Self::DEFAULT_TOLERANCE), or
    /// [`DEFAULT_STEP`](Self::DEFAULT_STEP) for a scheme without an error estimate. Fails for a scheme that takes
    /// neither a tolerance nor a step.
    pub fn of(scheme: Scheme) -> Result<Self, InputError> {
        if scheme.is_adaptive() {
            Self::adaptive(scheme, Self::DEFAULT_TOLERANCE)
        } else {
            Self::fixed(scheme, Self::DEFAULT_STEP)
        }
    }

    /// `scheme` with this control, or with the one of [`Stepping::of`] if there is none.
    pub fn new(scheme: Scheme, control: Option<StepControl>) -> Result<Self, InputError> {
        match control {
            None => Self::of(scheme),
            Some(StepControl::Tolerance(tolerance)) => Self::adaptive(scheme, tolerance),
            Some(StepControl::Step(step)) => Self::fixed(scheme, step),
        }
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
    #[cfg(feature = "integrators")]
    #[must_use]
    pub(crate) fn tightened(self, factor: f64) -> Self {
        let control = match self.control {
            StepControl::Tolerance(tolerance) => StepControl::Tolerance(tightened(tolerance, factor)),
            fixed @ StepControl::Step(_) => fixed,
        };
        self.controlled_by(control)
    }

    /// The same scheme with another value of its step control.
    #[must_use]
    pub(crate) fn controlled_by(self, control: StepControl) -> Self {
        Self { control, ..self }
    }

    /// Estimate of the error of cos θ at the landing of `toss`, (τ + 4 ε (1 + n)) × (1 + φ) for a flight with the
    /// [phase](Phases::largest) φ (rad) in n steps.
    ///
    /// The first term is truncation. With a tolerance τ is 100 × tolerance. With fixed steps of h (s) it is
    /// (|ω| h)^order × (1 + |ω| h φ/100), that of a regular motion; nothing is measured during such a flight, so that the
    /// error near a singular point may be larger. Its second part is for rates whose amplitude falls in every step, by
    /// (|ω| h)^5/144 a radian with RK4, so that an angle is off by the square of the phase. Where DOPRI5 loses more than
    /// that, a flight would take more steps than are allowed.
    ///
    /// The second term is rounding: each step rounds angles of up to φ, and body rates whose error grows with the phase.
    /// If all steps round alike the error is ¾ ε n φ: a third each from a rate and from two angles that grow by φ and
    /// are rounded by ½ ε φ on average. The largest factor that was measured is 1, where 4 stands. The number of fixed
    /// steps is known. With a tolerance it is taken as ¼ (1 + φ) × tolerance^(-1/order), with the
    /// [tightened](crate::Flight::tightened) tolerance and the root rounded up to a power of two.
    ///
    /// For a body that is not a coin, the estimate is multiplied by the [growth](Phases::growth) of a disturbance. It is `None` from 1 on: it then says nothing about a cosine.
    pub fn error_estimate(&self, toss: &Toss) -> Result<Option<f64>, SolveError> {
        let Phases { largest, growth } = Phases::new(toss)?;
        let estimate = |turn_rate| growth * self.estimate(largest, turn_rate, toss.launch.flight_time());
        Ok(match toss.body {
            Body::Coin(_) => Some(estimate(toss.launch.turn_rate())),
            Body::Rigid(_) => Some(estimate(SQRT_2 * toss.launch.turn_rate())).filter(|estimate| *estimate < 1.0),
        })
    }

    /// The estimate for a flight of `time` (s) that turns by `phase` (rad), at most at the rate `turn_rate` (rad/s).
    fn estimate(&self, phase: f64, turn_rate: f64, time: f64) -> f64 {
        let turned = 1.0 + phase;
        let (truncation, steps) = match self.control {
            StepControl::Tolerance(tolerance) => {
                let shorter = self
                    .scheme
                    .order()
                    .map_or(1.0, |order| inverse_root(tightened(tolerance, phase / LONG_FLIGHT), order));
                (100.0 * tolerance, STEPS_IN_A_RADIAN * shorter * turned)
            }
            StepControl::Step(step) => {
                // Schemes without an order take no fixed steps, so that the default is never used.
                let order = self.scheme.order().unwrap_or(0);
                let in_a_step = turn_rate * step;
                (in_a_step.powf(f64::from(order)) * (1.0 + 0.01 * in_a_step * phase), time / step)
            }
        };
        (truncation + 4.0 * f64::EPSILON * (1.0 + steps)) * turned
    }
}

/// The default stepping, [`Stepping::DEFAULT`].
impl Default for Stepping {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Writes the stepping as it is read: `dop853 tolerance=1e-10`, or `rk4 step=1e-3s`.
impl fmt::Display for Stepping {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.control {
            StepControl::Tolerance(tolerance) => write!(f, "{} tolerance={tolerance:e}", self.scheme),
            StepControl::Step(step) => write!(f, "{} step={step:e}s", self.scheme),
        }
    }
}

/// Reads the name of one of [`Scheme::ALL`], alone or with `tolerance=NUMBER` or `step=TIME` after it. A time without a
/// unit is in seconds.
impl FromStr for Stepping {
    type Err = InputError;

    fn from_str(text: &str) -> Result<Self, InputError> {
        let text = text.trim();
        let Some((scheme, control)) = text.split_once(char::is_whitespace) else { return Self::of(text.parse()?) };
        let expected = "a scheme, alone or with tolerance=NUMBER or step=TIME, such as dop853 tolerance=1e-9";
        let malformed = || InputError::Malformed { field: "stepping", value: text.to_owned(), expected };
        let control = match control.trim().split_once('=').ok_or_else(malformed)? {
            ("tolerance", number) => StepControl::Tolerance(number.trim().parse().map_err(|_| malformed())?),
            ("step", time) => StepControl::Step(Dimension::Time.read("step [s]", time)?),
            _ => return Err(malformed()),
        };
        Self::new(scheme.parse()?, Some(control))
    }
}

/// The least power of two that is at least tolerance^(-1/order): how many times as short steps at this tolerance are as at
/// a tolerance of 1. It is a power of two, so that it has the same bits on every machine.
fn inverse_root(tolerance: f64, order: u32) -> f64 {
    let mut root = 1.0_f64;
    while (0..order).fold(tolerance, |power, _| power * root) < 1.0 {
        root *= 2.0;
    }
    root
}

/// The number of equal steps of at most `step` that make up `duration`, at least 1.
pub(crate) fn step_count(duration: f64, step: f64) -> Result<f64, SolveError> {
    // A step that divides the duration up to rounding must not become one step more.
    let count = (duration / step * (1.0 - 4.0 * f64::EPSILON)).ceil().max(1.0);
    if count > f64::from(STEP_LIMIT) {
        return Err(SolveError::StepLimit { time: 0.0, limit: STEP_LIMIT });
    }
    Ok(count)
}

/// `tolerance` divided by `factor`, but at least ε. A `factor` below 1 leaves it unchanged.
pub(crate) fn tightened(tolerance: f64, factor: f64) -> f64 {
    (tolerance / factor.max(1.0)).max(f64::EPSILON)
}

#[cfg(test)]
mod tests;
