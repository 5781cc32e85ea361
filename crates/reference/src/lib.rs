//! The judge: the landing of a toss of any body, by the numbers that it was given by. Every error in the suite is measured
//! against it. It shares no code with the solvers, the proofs or the principal axes of a body: of this workspace the crate
//! needs only the toss as it was given and plain types of results, and a test reads its files for other names.
//!
//! - `taylor` is the ground truth. It integrates the equations of motion of any body in `fixed` point, for up to
//!   1000 rad, and bounds its own error.
//! - Closed forms in 256 bits are faster, and stand longer flights: that of a coin, which is here, and that of a body
//!   which is given by its moments, in `rigid`, away from equal moments, principal axes and the separatrix. The check
//!   `reference-closed-forms` compares them with the ground truth in every run.
//! - What neither of them solves is [not judged](NoReference), and rows say how many tosses that are.
//!
//! A coin's motion is `Q(t) = Q0 ⊗ exp(½ ωL t ŝ) ⊗ exp(-½ q t ẑ)`, with q = (k - 1) ωz, the inertia ratio k, ωL = |S|/I1,
//! and ŝ the direction of the angular momentum S in the body frame (BF); ẑ is the coin's normal and Q the attitude.
//! Tilts, cylinders and units are taken as they were given. The crate `verify` compares all of it with numbers from
//! elsewhere.

mod fixed;
mod rigid;
mod taylor;

use std::cmp::Ordering;
use std::fmt;
use std::sync::LazyLock;

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;
use dynamics::{Attitude, Coin, CoinToss, Launch, Outcome, Quantity, SolveError, TimeOfFlight, Toss, Vector3};
use numerics::DoubleDouble;

/// Precision of the arithmetic in binary digits.
const PRECISION: usize = 256;

type Big = FBig<HalfEven>;

/// Bound of the error of the closed form of a coin, for a phase of 1 rad: 2^-240.
const ERROR_OF_A_COIN: f64 = 5.659_799_424_266_695e-73;

/// The number with as many digits as it has; sums and products of such numbers are exact.
fn exactly(value: f64) -> Big {
    Big::try_from(value).expect("a validated toss is finite").with_precision(0).value()
}

fn big(value: f64) -> Big {
    Big::try_from(value).expect("a validated toss is finite").with_precision(PRECISION).value()
}

/// The landing of a toss.
#[derive(Debug)]
pub struct Reference {
    attitude: [Big; 4],
    /// ω (rad/s).
    rate: [Big; 3],
    /// Bound of the error of each component of the attitude.
    error: f64,
}

/// Why there is no reference of a toss, so that it isn't judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoReference;

impl fmt::Display for NoReference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "not judged: no closed form of the reference holds for this flight, and it is too long to be integrated"
        )
    }
}

impl std::error::Error for NoReference {}

impl From<NoReference> for SolveError {
    fn from(why: NoReference) -> Self {
        Self::failed("the reference", why)
    }
}

impl Reference {
    /// The toss of any body: in closed form where that holds, else by the ground truth.
    ///
    /// # Errors
    /// [`NoReference`] where neither holds.
    pub fn of(toss: &Toss) -> Result<Self, NoReference> {
        match Self::in_closed_form(toss) {
            Some(reference) => Ok(reference),
            None => Self::flown(toss),
        }
    }

    /// The toss of a coin in closed form.
    pub fn new(toss: &CoinToss) -> Self {
        let flight = time(toss.launch.time_of_flight());
        Self::of_coin(inertia_ratio(&toss.coin), rates(&toss.launch), &flight, &quaternion(&toss.launch.attitude()))
    }

    fn of_coin(k: Big, [x, y, z]: [Big; 3], time: &Big, launch: &[Big; 4]) -> Self {
        let momentum_z = &k * &z;
        let precession = (&x * &x + &y * &y + &momentum_z * &momentum_z).sqrt();
        let half_time = time / big(2.0);
        let half_phase = &precession * &half_time;
        let (sin, cos) = sin_cos(&half_phase);
        // Without angular momentum there is no direction to turn about, and no turn.
        let still = precession == big(0.0);
        let along = |part: Big| if still { big(0.0) } else { part / &precession * &sin };
        let turn = [cos, along(x.clone()), along(y.clone()), along(momentum_z)];
        let half_spin = (k - big(1.0)) * &z * half_time;
        let (sin_half, cos_half) = sin_cos(&half_spin);
        let (sin_spin, cos_spin) = (&sin_half * &cos_half * big(2.0), &cos_half * &cos_half - &sin_half * &sin_half);
        let error = ERROR_OF_A_COIN * (1.0 + to_f64(&half_phase) + to_f64(&half_spin).abs());
        let spin = [cos_half, big(0.0), big(0.0), -sin_half];
        let rate = [&x * &cos_spin - &y * &sin_spin, x * sin_spin + y * cos_spin, z];
        Self { attitude: product(&product(launch, &turn), &spin), rate, error }
    }

    /// The toss of a coin, or of another body that is given by its moments, in closed form; none where that loses digits.
    pub fn in_closed_form(toss: &Toss) -> Option<Self> {
        match toss.coin() {
            Some(toss) => Some(Self::new(&toss)),
            None => {
                let (turn, rate) = rigid::landed(toss)?;
                Some(Self { attitude: product(&quaternion(&toss.launch.attitude()), &turn), rate, error: rigid::ERROR })
            }
        }
    }

    /// The toss of any body by the ground truth, the integration in fixed point.
    ///
    /// # Errors
    /// [`NoReference`] for a flight of more than 1000 rad, and for one on which the roundings of the reference grow so
    /// much that it can't vouch for 33 digits, as next to a turn about the middle axis.
    pub fn flown(toss: &Toss) -> Result<Self, NoReference> {
        let (rate, time) = (rates(&toss.launch), time(toss.launch.time_of_flight()));
        let taylor::Flown { turn, rate, error } =
            taylor::fly(&taylor::tensor(toss), &rate, &time).ok_or(NoReference)?;
        Ok(Self { attitude: product(&quaternion(&toss.launch.attitude()), &turn), rate, error })
    }

    /// Whether the toss is one of a body that needs elliptic functions.
    pub fn is_elliptic(toss: &Toss) -> bool {
        rigid::is_elliptic(toss)
    }

    /// The angle between this attitude and that of `other` (rad).
    pub fn distance(&self, other: &Self) -> f64 {
        angle(&self.attitude, &other.attitude)
    }

    /// Absolute error of a computed cos θ.
    pub fn cos_tilt_error(&self, cos_tilt: f64) -> f64 {
        to_f64(&(self.cos_tilt() - big(cos_tilt))).abs()
    }

    /// Absolute error of a computed cos θ that was not rounded to f64.
    pub fn unrounded_cos_tilt_error(&self, cos_tilt: DoubleDouble) -> f64 {
        to_f64(&(self.cos_tilt() - big(cos_tilt.hi()) - big(cos_tilt.lo()))).abs()
    }

    /// The outcome; undecided if cos θ is 0 within the error of the reference.
    pub fn outcome(&self) -> Outcome {
        let cos_tilt = self.cos_tilt();
        match cos_tilt.partial_cmp(&big(0.0)) {
            _ if to_f64(&cos_tilt).abs() <= 4.0 * self.error => Outcome::Undecided,
            Some(Ordering::Greater) => Outcome::Heads,
            _ => Outcome::Tails,
        }
    }

    /// Angle between a computed attitude and the exact one (rad).
    pub fn attitude_error(&self, attitude: &Attitude) -> f64 {
        angle(&attitude.components().map(big), &self.attitude)
    }

    /// The quaternion of the attitude, w first, each component rounded.
    pub fn components(&self) -> [f64; 4] {
        [0, 1, 2, 3].map(|part| to_f64(&self.attitude[part]))
    }

    /// cos θ, rounded.
    pub fn rounded_cos_tilt(&self) -> f64 {
        to_f64(&self.cos_tilt())
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

    /// Largest absolute error of a component of a computed body rate (rad/s).
    pub fn rate_error(&self, rate: &Vector3<f64>) -> f64 {
        let off = |(exact, found): (&Big, &f64)| to_f64(&(exact - big(*found))).abs();
        self.rate.iter().zip(rate).map(off).fold(0.0, f64::max)
    }

    /// How long after the landing cos θ would be 0, to first order (s).
    pub fn time_to_an_edge(&self) -> f64 {
        // cos θ is the third component of n, whose rate of change is that of ω × n.
        let across = [self.rate[1].clone(), -self.rate[0].clone(), big(0.0)];
        to_f64(&(-self.cos_tilt() / &rotated(&self.attitude, &across)[2]))
    }

    fn cos_tilt(&self) -> Big {
        let [w, x, y, z] = &self.attitude;
        w * w + z * z - x * x - y * y
    }
}

/// The angle between two attitudes (rad).
fn angle(from: &[Big; 4], to: &[Big; 4]) -> f64 {
    let [w, x, y, z] = turn(from, to);
    let sine = to_f64(&(&x * &x + &y * &y + &z * &z).sqrt());
    2.0 * sine.atan2(to_f64(&w).abs())
}

/// The time of flight (s).
fn time(flight: TimeOfFlight) -> Big {
    match flight {
        TimeOfFlight::Given(time) => big(time),
        TimeOfFlight::Ballistic { speed, gravity } => big(2.0) * big(speed) / big(gravity),
        TimeOfFlight::BallisticTo { speed, gravity, drop } => {
            // Next to the apex v0² + 2 g h nearly vanishes.
            let exact = exactly(speed) * exactly(speed) + exactly(2.0) * exactly(gravity) * exactly(drop);
            let square = if exact > Big::ZERO { exact.with_precision(PRECISION).value() } else { big(0.0) };
            (big(speed) + square.sqrt()) / big(gravity)
        }
    }
}

/// ω (rad/s).
fn rates(launch: &Launch) -> [Big; 3] {
    let (rate, unit) = launch.given_rate();
    [rate.x, rate.y, rate.z].map(|part| quantity(unit.times(part)))
}

/// k of the moments, or 6 r²/(3 r² + h²) of the cylinder.
fn inertia_ratio(coin: &Coin) -> Big {
    let Some([_, radius, thickness]) = coin.cylinder() else { return big(coin.i3()) / big(coin.i1()) };
    let squared = |length| quantity(length) * quantity(length);
    big(6.0) * squared(radius) / (big(3.0) * squared(radius) + squared(thickness))
}

/// Q0 of the given components, or the half-angle's cosine and sine of the tilt.
fn quaternion(attitude: &Attitude) -> [Big; 4] {
    let Some(tilt) = attitude.tilt() else { return normalised(attitude.given_components().map(big)) };
    let (sin, cos) = sin_cos(&(quantity(tilt) / big(2.0)));
    [cos, sin, big(0.0), big(0.0)]
}

fn quantity(given: Quantity) -> Big {
    let unit = given.unit();
    let ratio = big(given.value()) * big(unit.numerator().into()) / big(unit.denominator().into());
    if unit.is_of_turn() { ratio * big(2.0) * Big::pi(PRECISION) } else { ratio }
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

fn rotated(q: &[Big; 4], vector: &[Big; 3]) -> [Big; 3] {
    let [w, x, y, z] = q;
    let [a, b, c] = vector.clone();
    let [_, x, y, z] = product(&product(q, &[big(0.0), a, b, c]), &[w.clone(), -x, -y, -z]);
    [x, y, z]
}

fn normalised(q: [Big; 4]) -> [Big; 4] {
    let norm = q.iter().fold(big(0.0), |sum, part| sum + part * part).sqrt();
    q.map(|part| part / &norm)
}

/// A number in decimal digits.
#[cfg(test)]
fn decimal(text: &str) -> Big {
    use std::str::FromStr;
    let value = dashu_float::DBig::from_str(text).expect("a number").with_precision(40).value();
    value.with_base_and_precision::<2>(PRECISION).value().with_rounding()
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
