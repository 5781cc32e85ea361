//! The time of flight: how long a toss lasts, to f64 and beyond.
//!
//! ```text
//! T = 2 v0/g                         caught at the height of the launch
//! T = (v0 + √(v0² + 2 g h))/g        caught h below it
//! ```

use numerics::double_double::DoubleDouble;
use numerics::scale::mantissa_and_exponent;

use crate::error::{InputError, require};

/// Gravity used where none is given (m/s²). The paper gives no value.
pub const DEFAULT_GRAVITY: f64 = 9.81;

/// How long the coin flies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TimeOfFlight {
    /// Thrown up at `speed` (m/s) under `gravity` (m/s²) and caught at the height of the launch: T = 2 v0/g.
    Ballistic {
        /// v0 (m/s), ≥ 0.
        speed: f64,
        /// g (m/s²), > 0.
        gravity: f64,
    },
    /// Thrown up at `speed` (m/s) under `gravity` (m/s²) and caught, on its way down, `drop` (m) below the launch:
    /// T = (v0 + √(v0² + 2 g h))/g.
    BallisticTo {
        /// v0 (m/s), ≥ 0.
        speed: f64,
        /// g (m/s²), > 0.
        gravity: f64,
        /// h (m); negative for a landing above the launch, down to -v0²/(2 g), the apex.
        drop: f64,
    },
    /// Given directly (s), ≥ 0.
    Given(f64),
}

impl TimeOfFlight {
    /// Thrown up at `speed` (m/s) under `gravity` (m/s²) and caught `drop` (m) below, or at the same height.
    pub fn thrown(speed: f64, gravity: f64, drop: Option<f64>) -> Self {
        match drop {
            None => Self::Ballistic { speed, gravity },
            Some(drop) => Self::BallisticTo { speed, gravity, drop },
        }
    }

    /// T (s).
    #[inline]
    pub fn seconds(&self) -> f64 {
        match *self {
            Self::Ballistic { speed, gravity } => 2.0 * speed / gravity,
            Self::BallisticTo { .. } => self.exact().rounded(),
            Self::Given(time) => time,
        }
    }

    /// T as the quotient that it is, not rounded to f64.
    pub fn exact(&self) -> ExactTime {
        match *self {
            Self::Ballistic { speed, gravity } => {
                let ((speed, e_speed), (gravity, e_gravity)) =
                    (mantissa_and_exponent(speed), mantissa_and_exponent(gravity));
                ExactTime { mantissa: DoubleDouble::quotient(speed, gravity), exponent: 1 + e_speed - e_gravity }
            }
            Self::BallisticTo { speed, gravity, drop } => {
                // (v0 + √d)/g, with d = v0² + 2 g h.
                let (discriminant, exponent) = discriminant(speed, gravity, drop);
                let ((speed, e_speed), (gravity, e_gravity)) =
                    (mantissa_and_exponent(speed), mantissa_and_exponent(gravity));
                let speed = DoubleDouble::from(speed).times_power_of_two(e_speed - exponent);
                ExactTime::new((speed + discriminant.sqrt()) / gravity.into(), exponent - e_gravity)
            }
            Self::Given(time) => time.into(),
        }
    }

    /// T (s) as f64, and what that leaves of it, to first order.
    #[inline]
    pub fn compensated(&self) -> [f64; 2] {
        match *self {
            Self::Ballistic { speed, gravity } => {
                let time = 2.0 * speed / gravity;
                let product = DoubleDouble::product(time, gravity);
                let rest = ((2.0 * speed - product.hi()) - product.lo()) / gravity;
                // Where a product leaves the range of f64, its rest means nothing.
                [time, if rest.abs() <= f64::EPSILON * time { rest } else { 0.0 }]
            }
            Self::BallisticTo { .. } => {
                let ExactTime { mantissa, exponent } = self.exact();
                let time = mantissa.times_power_of_two(exponent);
                [time.hi(), time.lo()]
            }
            Self::Given(time) => [time, 0.0],
        }
    }

    /// Whether the coin flies at all, also where T is below the range of f64.
    pub fn is_positive(&self) -> bool {
        match *self {
            Self::Ballistic { speed, .. } => speed > 0.0,
            Self::BallisticTo { speed, drop, .. } => speed > 0.0 || drop > 0.0,
            Self::Given(time) => time > 0.0,
        }
    }

    /// T (s) of what makes sense.
    #[inline]
    pub(crate) fn validated_seconds(self) -> Result<f64, InputError> {
        match self {
            Self::Ballistic { speed, gravity } => {
                require_throw(speed, gravity)?;
                require("time of flight 2 v0/g [s]", self.seconds(), "finite", true)
            }
            Self::BallisticTo { speed, gravity, drop } => {
                require_throw(speed, gravity)?;
                require("drop [m]", drop, "finite", true)?;
                let (discriminant, _) = discriminant(speed, gravity, drop);
                let valid = ">= -v0²/(2 g), the height that the toss reaches";
                require("drop [m]", drop, valid, discriminant.hi() >= 0.0)?;
                require("time of flight [s]", self.seconds(), "finite", true)
            }
            Self::Given(time) => require("time [s]", time, "finite and >= 0", time >= 0.0),
        }
    }
}

#[inline]
fn require_throw(speed: f64, gravity: f64) -> Result<(), InputError> {
    require("speed [m/s]", speed, "finite and >= 0", speed >= 0.0)?;
    require("gravity [m/s²]", gravity, "finite and > 0", gravity > 0.0)?;
    Ok(())
}

/// v0² + 2 g h (m²/s²) to 3 u² as a number and the exponent e of its unit, 2^(2e). The unit is that of the larger term,
/// so that only what does not count can underflow.
fn discriminant(speed: f64, gravity: f64, drop: f64) -> (DoubleDouble, i32) {
    let [(speed, e_speed), (gravity, e_gravity), (drop, e_drop)] = [speed, gravity, drop].map(mantissa_and_exponent);
    let (e_square, e_fall) = (2 * e_speed, 1 + e_gravity + e_drop);
    let larger = match (speed, drop) {
        (0.0, _) => e_fall,
        (_, 0.0) => e_square,
        _ => e_fall.max(e_square),
    };
    let exponent = larger.div_euclid(2);
    let square = DoubleDouble::product(speed, speed).times_power_of_two(e_square - 2 * exponent);
    let fall = DoubleDouble::product(gravity, drop).times_power_of_two(e_fall - 2 * exponent);
    (square + fall, exponent)
}

/// A time (s) in twice the precision of f64: `mantissa` times 2^`exponent`, with a mantissa between ½ and 2, or 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExactTime {
    mantissa: DoubleDouble,
    exponent: i32,
}

impl ExactTime {
    /// `value` times 2^`exponent`.
    fn new(value: DoubleDouble, exponent: i32) -> Self {
        let (_, own) = mantissa_and_exponent(value.hi());
        Self { mantissa: value.times_power_of_two(-own), exponent: exponent + own }
    }

    /// A number between ½ and 2, or 0.
    #[inline]
    pub fn mantissa(self) -> DoubleDouble {
        self.mantissa
    }

    /// The exponent of the power of two that the mantissa is multiplied by (s).
    #[inline]
    pub fn exponent(self) -> i32 {
        self.exponent
    }

    /// The nearest f64 (s).
    fn rounded(self) -> f64 {
        self.mantissa.times_power_of_two(self.exponent).hi()
    }
}

impl From<f64> for ExactTime {
    fn from(time: f64) -> Self {
        let (mantissa, exponent) = mantissa_and_exponent(time);
        Self { mantissa: mantissa.into(), exponent }
    }
}

impl From<TimeOfFlight> for ExactTime {
    fn from(time: TimeOfFlight) -> Self {
        time.exact()
    }
}

#[cfg(test)]
mod tests;
