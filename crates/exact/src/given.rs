//! The numbers of a launch as they were given: exact, or balls that contain them. Proofs are evaluated in these, so that
//! they hold for the toss before any rounding.

use dynamics::time_of_flight::ExactTime;
use dynamics::{Attitude, Coin, Launch, Quantity, Unit, Vector3};
use numerics::big::exactly;
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{Ball, Big, DoubleDouble, Elementary, WideBall};

/// Whether squares and fourth powers of the components, relative to the largest, are in the range of f64.
pub(crate) fn components_are_close(rate: &Vector3<f64>) -> bool {
    let scale = power_of_two_scale(rate.amax());
    rate.iter().all(|part| *part == 0.0 || (part / scale).abs() > 2f64.powi(-200))
}

/// The rate (BF) in a unit near its largest component, exactly.
pub(crate) fn scaled<N: Elementary>(rate: &Vector3<f64>, like: &N) -> [N; 3] {
    let scale = power_of_two_scale(rate.amax());
    if components_are_close(rate) {
        return [rate.x, rate.y, rate.z].map(|part| like.like(part / scale));
    }
    let (_, exponent) = mantissa_and_exponent(scale);
    [rate.x, rate.y, rate.z].map(|part| like.like_big(&exactly(part).times_power_of_two(-exponent)))
}

/// The time in the unit of [`scaled`] rates, and the vertical (BF) at launch; `None` for rates that are not in rad/s or
/// differ too much.
pub(crate) fn in_double_double(launch: &Launch) -> Option<(Ball<DoubleDouble>, [Ball<DoubleDouble>; 3])> {
    let (rate, unit) = launch.given_rate();
    if !components_are_close(&rate) || unit != Unit::ONE {
        return None;
    }
    let time = ExactTime::from(launch.time_of_flight());
    let scale = mantissa_and_exponent(power_of_two_scale(rate.amax())).1;
    let time = time.mantissa().times_power_of_two(time.exponent() + scale);
    Some((right_to_25_u2(time), vertical_in_double_double(launch)))
}

/// A ball around a time, which is right to 25 u² of itself.
pub(crate) fn right_to_25_u2(time: DoubleDouble) -> Ball<DoubleDouble> {
    const ERROR: f64 = 6.310_887_241_768_095e-30; // 2^-97
    Ball::new(time, ERROR * time.hi())
}

/// Balls with the vertical seen from the body at launch, which is right to 2^-67.
pub(crate) fn vertical_in_double_double(launch: &Launch) -> [Ball<DoubleDouble>; 3] {
    const ERROR: f64 = 6.776_263_578_034_403e-21; // 2^-67
    launch.attitude().exact_vertical().map(|part| Ball::new(part, ERROR))
}

/// A ball around I3/I1, which is right to 25 u² of itself; its last digits may be below the range of f64.
pub(crate) fn inertia_ratio(coin: &Coin) -> Ball<DoubleDouble> {
    let ratio = coin.exact_inertia_ratio();
    Ball::new(ratio, (2f64.powi(-97) * ratio.hi()).max(f64::MIN_POSITIVE))
}

/// A ball of f64 that contains a ball of double-double.
pub(crate) fn rounded(number: &Ball<DoubleDouble>) -> Ball<f64> {
    let midpoint = number.midpoint();
    Ball::new(midpoint.hi(), (midpoint.lo().abs() + number.radius()) * (1.0 + f64::EPSILON))
}

/// Balls with the time, in the unit of [`scaled`] rates, and with the vertical seen from the body at launch.
pub(crate) fn in_digits(launch: &Launch, digits: usize) -> (WideBall, [WideBall; 3]) {
    let (rate, unit) = launch.given_rate();
    let scale = mantissa_and_exponent(power_of_two_scale(rate.amax())).1;
    let time = time_in_digits(launch, digits) * right_to_roundings(unit.in_digits(digits), digits);
    (time.times_power_of_two(scale), Vertical::Own.in_digits(&launch.attitude(), digits))
}

/// A ball with the time of flight (s).
pub(crate) fn time_in_digits(launch: &Launch, digits: usize) -> WideBall {
    right_to_roundings(launch.time_of_flight().in_digits(digits), digits)
}

/// Balls with a vertical, from a multiple of it, of which what is 0 is so exactly. The other radii are of its length: a part
/// near 0 has lost digits.
fn of_length_1((vertical, norm): ([Big; 3], Big), digits: usize) -> [WideBall; 3] {
    let round = |value: Big| value.with_precision(digits).value();
    let (norm, roundings) = (round(norm), round(exactly(1.0)) >> (digits - 16).cast_signed());
    let radius = |part: &Big| if *part == Big::ZERO { Big::ZERO } else { roundings.clone() };
    vertical.map(|part| WideBall::new(round(part.clone()) / &norm, &radius(&part)))
}

/// The direction along which cos θ is the height of the normal, seen from the body at launch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Vertical {
    Own,
    /// That after a quarter of a turn of the launch about the lab's x axis.
    QuarterTurned,
}

impl Vertical {
    pub(crate) fn in_double_double(self, attitude: &Attitude) -> [Ball<DoubleDouble>; 3] {
        // Up to here an angle has digits enough.
        const LARGEST_TILT: f64 = 1e6;
        if let Some(tilt) = attitude.tilt().map(Quantity::double_double)
            && tilt.hi().abs() < LARGEST_TILT
        {
            // The angle is right to 16 u².
            let angle = Ball::new(tilt, 2f64.powi(-102) * tilt.hi().abs());
            let [sin, cos] = angle.sine_and_cosine();
            let zero = angle.like(0.0);
            return if self == Self::Own { [zero, sin, cos] } else { [zero, cos, -sin] };
        }
        let vertical = match self {
            Self::Own => attitude.exact_vertical(),
            Self::QuarterTurned => attitude.exact_quarter_turned_vertical(),
        };
        // Of a quaternion, it is right to the roundings of some ten operations with 10 u² each.
        let error = 2f64.powi(if attitude.tilt().is_some() { -67 } else { -99 });
        vertical.map(|part| Ball::new(part, error))
    }

    pub(crate) fn in_digits(self, attitude: &Attitude, digits: usize) -> [WideBall; 3] {
        let vertical = match self {
            Self::Own => attitude.vertical_in_digits(digits),
            Self::QuarterTurned => attitude.quarter_turned_vertical_in_digits(digits),
        };
        of_length_1(vertical, digits)
    }
}

/// A ball around a number that is right to some roundings of itself.
pub(crate) fn right_to_roundings(value: Big, digits: usize) -> WideBall {
    let value = value.with_precision(digits).value();
    WideBall::new(value.clone(), &(value >> (digits - 16).cast_signed()))
}
