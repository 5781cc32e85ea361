//! This module solves a toss in 256-bit arithmetic; every error in the suite is measured against it. It shares no code
//! with the solvers. Its formula is that of the exact motion, which numbers from outside and integrators check.
//!
//! It takes the numbers that coin and launch were made from as exact, cylinder and tilt included, and evaluates
//! `Q(t) = Q0 ⊗ exp(½ ωL t ŝ) ⊗ exp(-½ q t ẑ)` with correctly rounded arithmetic, so its own error is about 2^-250 for the phases of a toss. Here q = (k - 1) ωz with
//! k the inertia ratio, ωL is |S|/I1, ŝ the direction of the angular momentum S in the body frame (BF), ẑ the coin's normal and Q
//! the attitude. Other bodies take elliptic functions, which `rigid` has. Tests compare it with numbers from outside
//! the workspace.

pub(crate) mod outside;
mod rigid;

use std::cmp::Ordering;
use std::sync::LazyLock;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use dynamics::Toss;
use numerics::DoubleDouble;
use toss::quantity::{Angle, AngleUnit, Quantity};
use toss::{
    Attitude, Coin, CoinToss, ExactSolver, Landing, Launch, Outcome, SolveError, Solver, TimeOfFlight, Vector3,
};

/// Precision of the arithmetic in binary digits.
const PRECISION: usize = 256;

type Big = FBig<HalfEven>;

fn big(value: f64) -> Big {
    Big::try_from(value).expect("a validated toss is finite").with_precision(PRECISION).value()
}

/// The exact landing of a toss of any body.
pub enum ExactLanding {
    /// In 256 bits.
    InDigits(Reference),
    /// By the exact motion in double-double: of a body on the separatrix, about a principal axis, or with two equal moments.
    ByMotion(Landing),
}

impl ExactLanding {
    /// Solves `toss`.
    ///
    /// # Errors
    /// [`SolveError`] for a phase above 2^53 rad.
    pub fn new(toss: &Toss) -> Result<Self, SolveError> {
        match Reference::of(toss) {
            Some(reference) => Ok(Self::InDigits(reference)),
            None => ExactSolver.land(toss).map(Self::ByMotion),
        }
    }

    /// Absolute error of a computed cos θ.
    pub fn cos_tilt_error(&self, found: f64) -> f64 {
        match self {
            Self::InDigits(reference) => reference.cos_tilt_error(found),
            Self::ByMotion(landing) => (found - landing.cos_tilt).abs(),
        }
    }

    /// Angle between a computed attitude and the exact one (rad).
    pub fn attitude_error(&self, attitude: &Attitude) -> f64 {
        match self {
            Self::InDigits(reference) => reference.attitude_error(attitude),
            Self::ByMotion(landing) => landing.state.attitude.angle_to(attitude),
        }
    }

    /// The outcome.
    pub fn outcome(&self) -> Outcome {
        match self {
            Self::InDigits(reference) => reference.outcome(),
            Self::ByMotion(landing) => landing.outcome(),
        }
    }
}

/// The landing of a toss in 256 bits.
pub struct Reference {
    attitude: [Big; 4],
    /// Of a coin.
    rate: Option<[Big; 3]>,
}

impl Reference {
    /// Solves the toss of a coin.
    pub fn new(toss: &CoinToss) -> Self {
        let [x, y, z] = rates(&toss.launch);
        let k = inertia_ratio(&toss.coin);
        let momentum_z = &k * &z;
        let precession = (&x * &x + &y * &y + &momentum_z * &momentum_z).sqrt();
        let time = match toss.launch.time_of_flight() {
            TimeOfFlight::Given(time) => big(time),
            TimeOfFlight::Ballistic { speed, gravity } => big(2.0) * big(speed) / big(gravity),
            TimeOfFlight::BallisticTo { speed, gravity, drop } => {
                let (speed, gravity) = (big(speed), big(gravity));
                let fall = big(2.0) * &gravity * big(drop);
                (&speed + (&speed * &speed + fall).sqrt()) / gravity
            }
        };
        let half_time = time / big(2.0);
        let (sin, cos) = sin_cos(&(&precession * &half_time));
        // Without angular momentum there is no direction to turn about, and no turn.
        let still = precession == big(0.0);
        let along = |part: Big| if still { big(0.0) } else { part / &precession * &sin };
        let turn = [cos, along(x.clone()), along(y.clone()), along(momentum_z)];
        let half_spin = (k - big(1.0)) * &z * half_time;
        let (sin_half, cos_half) = sin_cos(&half_spin);
        let (sin_spin, cos_spin) = (&sin_half * &cos_half * big(2.0), &cos_half * &cos_half - &sin_half * &sin_half);
        let spin = [cos_half, big(0.0), big(0.0), -sin_half];
        let launch = quaternion(&toss.launch.attitude());
        let rate = [&x * &cos_spin - &y * &sin_spin, x * sin_spin + y * cos_spin, z];
        Self { attitude: product(&product(&launch, &turn), &spin), rate: Some(rate) }
    }

    /// Solves the toss of a coin, or of another body that was given by its moments, with a rate in rad/s and a given time.
    /// `None` for others, and for a body with two equal moments or a launch about a principal axis, which need no elliptic
    /// function.
    pub fn of(toss: &Toss) -> Option<Self> {
        match toss.coin() {
            Some(toss) => Some(Self::new(&toss)),
            None => rigid::attitude(toss).map(|attitude| Self { attitude, rate: None }),
        }
    }

    /// Whether the toss is one of a body that needs elliptic functions, and [`Reference::of`] solves it.
    pub(crate) fn is_elliptic(toss: &Toss) -> bool {
        rigid::solves(toss)
    }

    /// Absolute error of a computed cos θ.
    pub fn cos_tilt_error(&self, cos_tilt: f64) -> f64 {
        to_f64(&(self.cos_tilt() - big(cos_tilt))).abs()
    }

    /// Absolute error of a computed cos θ that was not rounded to f64.
    pub fn unrounded_cos_tilt_error(&self, cos_tilt: DoubleDouble) -> f64 {
        to_f64(&(self.cos_tilt() - big(cos_tilt.hi()) - big(cos_tilt.lo()))).abs()
    }

    /// The outcome; undecided only if cos θ is 0 in all digits.
    pub fn outcome(&self) -> Outcome {
        match self.cos_tilt().partial_cmp(&big(0.0)) {
            Some(Ordering::Greater) => Outcome::Heads,
            Some(Ordering::Less) => Outcome::Tails,
            _ => Outcome::Undecided,
        }
    }

    /// Angle between a computed attitude and the exact one (rad).
    pub fn attitude_error(&self, attitude: &Attitude) -> f64 {
        let [w, x, y, z] = turn(&attitude.components().map(big), &self.attitude);
        let sine = to_f64(&(&x * &x + &y * &y + &z * &z).sqrt());
        2.0 * sine.atan2(to_f64(&w).abs())
    }

    /// The small turn from this landing to `other`, as its axis in BF times its angle (rad). Correct up to the third
    /// power of the angle.
    pub fn turn_to(&self, other: &Self) -> Vector3<f64> {
        let [w, x, y, z] = turn(&self.attitude, &other.attitude);
        Vector3::from([x, y, z].map(|part| 2.0 * to_f64(&(part / &w))))
    }

    /// cos θ of `other` minus that of this landing.
    pub fn cos_tilt_to(&self, other: &Self) -> f64 {
        to_f64(&(other.cos_tilt() - self.cos_tilt()))
    }

    /// Largest absolute error of a component of a computed body rate (rad/s) of a coin; 0 for other bodies.
    pub fn rate_error(&self, rate: &Vector3<f64>) -> f64 {
        self.rate
            .iter()
            .flatten()
            .zip(rate)
            .map(|(exact, found)| to_f64(&(exact - big(*found))).abs())
            .fold(0.0, f64::max)
    }

    fn cos_tilt(&self) -> Big {
        let [w, x, y, z] = &self.attitude;
        w * w + z * z - x * x - y * y
    }
}

/// ω (rad/s).
fn rates(launch: &Launch) -> [Big; 3] {
    let (rate, unit) = launch.given_rate();
    [rate.x, rate.y, rate.z].map(|part| match unit {
        AngleUnit::Radians(unit) => quantity(Quantity::new(part, unit)),
        AngleUnit::Turns(unit) => quantity(Quantity::new(part, unit)) * big(2.0) * Big::pi(PRECISION),
    })
}

/// k of the moments, or 6 r²/(3 r² + h²) of the cylinder.
fn inertia_ratio(coin: &Coin) -> Big {
    let Some([_, radius, thickness]) = coin.cylinder() else { return big(coin.i3()) / big(coin.i1()) };
    let squared = |length| quantity(length) * quantity(length);
    big(6.0) * squared(radius) / (big(3.0) * squared(radius) + squared(thickness))
}

/// Q0 of the given components, or the half-angle's cosine and sine of the tilt.
fn quaternion(attitude: &Attitude) -> [Big; 4] {
    let half = match attitude.tilt() {
        None => return normalised(attitude.given_components().map(big)),
        Some(Angle::Radians(radians)) => quantity(radians) / big(2.0),
        Some(Angle::Turns(turns)) => quantity(turns) * Big::pi(PRECISION),
    };
    let (sin, cos) = sin_cos(&half);
    [cos, sin, big(0.0), big(0.0)]
}

fn quantity(given: Quantity) -> Big {
    big(given.value()) * big(given.unit().numerator().into()) / big(given.unit().denominator().into())
}

fn to_f64(value: &Big) -> f64 {
    value.to_f64().value()
}

/// Sine and cosine, by the Taylor series of a small part of the angle and by doubling that part again. It computes in
/// integers, with so many binary digits behind the point, and takes a sixth of the time that `dashu_float` takes.
fn sin_cos(angle: &Big) -> (Big, Big) {
    const DIGITS: usize = 384;
    const DOUBLINGS: usize = 8;
    const TERMS: u32 = 40;
    static TURN: LazyLock<Big> = LazyLock::new(|| Big::pi(512) * big(2.0));
    // A tiny sine would have too few of these digits.
    if to_f64(angle).abs() < 2f64.powi(-60) {
        return angle.sin_cos();
    }
    let rest = angle - (angle / &*TURN).round() * &*TURN;
    let fixed = |value: Big| (value << DIGITS as isize).to_int().value();
    let (one, part) = (fixed(big(1.0)), fixed(rest >> DOUBLINGS as isize));
    let (mut sin, mut cos, mut term) = (fixed(big(0.0)), one.clone(), one.clone());
    for index in 1..=TERMS {
        term = ((term * &part) >> DIGITS) / index;
        match index % 4 {
            0 => cos += &term,
            1 => sin += &term,
            2 => cos -= &term,
            _ => sin -= &term,
        }
    }
    for _ in 0..DOUBLINGS {
        (sin, cos) = ((&sin * cos) >> (DIGITS - 1), &one - ((&sin * &sin) >> (DIGITS - 1)));
    }
    let rounded = |part| Big::from_parts(part, -(DIGITS as isize)).with_precision(PRECISION).value();
    (rounded(sin), rounded(cos))
}

/// The turn from one attitude to another, with its axis in BF.
fn turn(from: &[Big; 4], to: &[Big; 4]) -> [Big; 4] {
    let [w, x, y, z] = from.clone();
    product(&[w, -x, -y, -z], to)
}

fn product(a: &[Big; 4], b: &[Big; 4]) -> [Big; 4] {
    [
        &a[0] * &b[0] - &a[1] * &b[1] - &a[2] * &b[2] - &a[3] * &b[3],
        &a[0] * &b[1] + &a[1] * &b[0] + &a[2] * &b[3] - &a[3] * &b[2],
        &a[0] * &b[2] - &a[1] * &b[3] + &a[2] * &b[0] + &a[3] * &b[1],
        &a[0] * &b[3] + &a[1] * &b[2] - &a[2] * &b[1] + &a[3] * &b[0],
    ]
}

fn normalised(q: [Big; 4]) -> [Big; 4] {
    let norm = q.iter().fold(big(0.0), |sum, part| sum + part * part).sqrt();
    q.map(|part| part / &norm)
}

#[cfg(test)]
mod tests {
    use std::str::FromStr;

    use dashu_float::DBig;

    use super::outside::ReferenceData;
    use super::*;
    use crate::measure::case::{self, is_horizontal};

    fn decimal(text: &str) -> Big {
        let value = DBig::from_str(text).unwrap().with_precision(40).value();
        value.with_base_and_precision::<2>(PRECISION).value().with_rounding()
    }

    #[test]
    fn sines_and_cosines_are_those_of_dashu_float() {
        for angle in [0.0, 1e-300, -2e-18, 1e-17, 0.7, -3.0, 355.0, -1e5, 6e15] {
            for angle in [big(angle), big(angle) / big(3.0), big(angle) * Big::pi(PRECISION)] {
                let ([sin, cos], [s, c]) = (<[Big; 2]>::from(sin_cos(&angle)), <[Big; 2]>::from(angle.sin_cos()));
                let off = [sin - s, cos - c].map(|off| to_f64(&off).abs());
                assert!(off.iter().all(|off| *off < 2f64.powi(-200)), "{angle}: {off:?}");
            }
        }
    }

    /// Flights whose inputs are exact in f64 agree with the reference numbers in every printed digit, the others to
    /// within the rounding of their inputs.
    #[test]
    fn the_256_bit_motion_agrees_with_the_independent_numbers() {
        let mut exact_inputs = 0;
        for flight in ReferenceData::inside().unwrap().flights {
            let reference = Reference::of(&flight.toss).unwrap();
            let error = to_f64(&(reference.cos_tilt() - decimal(&flight.cos_tilt))).abs();
            let time = flight.toss.launch.time_of_flight();
            let exact = is_horizontal(&flight.toss.launch)
                && matches!(time, TimeOfFlight::Given(_) | TimeOfFlight::BallisticTo { gravity: 1.625, .. });
            exact_inputs += usize::from(exact);
            let within = if exact { 1e-31 } else { 3e-16 };
            assert!(error < within, "{}: {error:e}", case::text(&flight.toss));
            let attitude_error = reference.attitude_error(&flight.attitude);
            assert!(attitude_error < 3e-16, "{}: {attitude_error:e}", case::text(&flight.toss));
        }
        assert!(exact_inputs >= 5);
    }
}
