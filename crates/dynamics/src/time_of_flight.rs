//! [`TimeOfFlight`], how long a toss lasts. It is available in f64 and in twice that precision, because the phase of
//! the exact motion is a rate times this time, and an error of the time would become an error of the phase.
//!
//! ```text
//! T = 2 v0/g                         caught at the height of the launch
//! T = (v0 + √(v0² + 2 g h))/g        caught at h below the launch
//! ```

use numerics::big::{Big, exactly};
use numerics::double_double::DoubleDouble;
use numerics::scale::mantissa_and_exponent;

use crate::error::{InputError, require};

/// Gravity used where none is given (m/s²). The paper gives no value.
pub const DEFAULT_GRAVITY: f64 = 9.81;

/// Smallest product of a time and a gravity (m/s) whose rounding error has all its digits in the range of f64.
const SMALLEST_PRODUCT: f64 = 1e-250;

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
    /// The time of flight itself (s), ≥ 0.
    Given(f64),
}

impl TimeOfFlight {
    /// Thrown up at `speed` (m/s) under `gravity` (m/s²) and caught `drop` (m) below the launch, or at the same height
    /// if `drop` is `None`.
    pub fn thrown(speed: f64, gravity: f64, drop: Option<f64>) -> Self {
        match drop {
            None => Self::Ballistic { speed, gravity },
            Some(drop) => Self::BallisticTo { speed, gravity, drop },
        }
    }

    /// The speed v0 (m/s) and gravity g (m/s²) of the throw; `None` for a time that was given itself.
    pub fn throw(self) -> Option<[f64; 2]> {
        match self {
            Self::Ballistic { speed, gravity } | Self::BallisticTo { speed, gravity, .. } => Some([speed, gravity]),
            Self::Given(_) => None,
        }
    }

    /// How far below the launch the throw lands (m), if that was given.
    pub fn drop(self) -> Option<f64> {
        if let Self::BallisticTo { drop, .. } = self { Some(drop) } else { None }
    }

    /// That of the same throw with another speed (m/s); `None` for a time that was given itself.
    pub fn with_speed(self, speed: f64) -> Option<Self> {
        self.throw().map(|[_, gravity]| Self::thrown(speed, gravity, self.drop()))
    }

    /// The speed (m/s) with which the same throw takes the time T > 0 (s), g T/2 - h/T; `None` as in
    /// [`TimeOfFlight::with_speed`].
    pub fn speed_of(self, time: f64) -> Option<f64> {
        self.throw().map(|[_, gravity]| 0.5 * gravity * time - self.drop().unwrap_or(0.0) / time)
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

    /// T in twice the precision of f64, also where T itself leaves the range of f64.
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

    /// T (s) in so many binary digits.
    pub fn in_digits(&self, digits: usize) -> Big {
        let round = |value: Big| value.with_precision(digits).value();
        let big = |value: f64| round(exactly(value));
        match *self {
            Self::Given(time) => big(time),
            Self::Ballistic { speed, gravity } => big(2.0) * big(speed) / big(gravity),
            Self::BallisticTo { speed, gravity, drop } => {
                let (speed, gravity) = (exactly(speed), exactly(gravity));
                let discriminant = &speed * &speed + exactly(2.0) * &gravity * exactly(drop);
                (round(speed) + round(discriminant).sqrt()) / round(gravity)
            }
        }
    }

    /// T (s) rounded to f64, and the rest of T to first order.
    #[inline]
    pub fn compensated(&self) -> [f64; 2] {
        match *self {
            Self::Ballistic { speed, gravity } => {
                let time = 2.0 * speed / gravity;
                let product = DoubleDouble::product(time, gravity);
                let rest = ((2.0 * speed - product.hi()) - product.lo()) / gravity;
                // Where the product or its rounding error leaves the range of f64, the rest is wrong.
                let is_in_range = product.hi() >= SMALLEST_PRODUCT && rest.abs() <= f64::EPSILON * time;
                if is_in_range { [time, rest] } else { self.exact().compensated() }
            }
            Self::BallisticTo { .. } => self.exact().compensated(),
            Self::Given(time) => [time, 0.0],
        }
    }

    /// Whether T > 0. The answer is right also where T underflows to 0.
    pub fn is_positive(&self) -> bool {
        match *self {
            Self::Ballistic { speed, .. } => speed > 0.0,
            Self::BallisticTo { speed, drop, .. } => speed > 0.0 || drop > 0.0,
            Self::Given(time) => time > 0.0,
        }
    }

    /// T (s), or an error if a number is outside its valid range or T is not finite.
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

/// v0² + 2 g h (m²/s²) as a number times 2^(2e), with the exponent e, with an error of 3 u². The power of two is that
/// of the larger term, so that a term that underflows is too small to matter.
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
    /// The time `value` × 2^`exponent` (s).
    fn new(value: DoubleDouble, exponent: i32) -> Self {
        let (_, own) = mantissa_and_exponent(value.hi());
        Self { mantissa: value.times_power_of_two(-own), exponent: exponent + own }
    }

    /// The mantissa: a number between ½ and 2, or 0.
    #[inline]
    pub fn mantissa(self) -> DoubleDouble {
        self.mantissa
    }

    /// The exponent e of the power of two 2^e (s) that multiplies the mantissa.
    #[inline]
    pub fn exponent(self) -> i32 {
        self.exponent
    }

    /// The nearest f64 (s), and the rest.
    fn compensated(self) -> [f64; 2] {
        let time = self.mantissa.times_power_of_two(self.exponent);
        [time.hi(), time.lo()]
    }

    /// The nearest f64 (s).
    fn rounded(self) -> f64 {
        self.compensated()[0]
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
