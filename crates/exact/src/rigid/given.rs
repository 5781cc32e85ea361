//! The toss of a body in numbers of one kind, exact or balls that contain what was given, and its turn until the landing.

use dynamics::time_of_flight::ExactTime;
use dynamics::{Toss, Unit};
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{Ball, DoubleDouble, Elementary, WideBall};

use super::doubling::Curve;
use super::quaternion::{Quaternion, conjugate, norm_squared, product, turned};
use super::special::{Special, precession_and_spin, turned_at};
use super::tensor::Symmetric;
use crate::given::{in_digits, right_to_25_u2, right_to_roundings, scaled, vertical_in_double_double};

/// What was given, as numbers of one kind: exact, or balls that contain it.
#[derive(Debug, Clone)]
pub(super) struct Given<N> {
    /// J in a unit near its largest element.
    pub(super) tensor: Symmetric<N>,
    /// ω (BF) in `unit` 2^`exponent` rad/s, of which the largest component is near 1.
    pub(super) rate: [N; 3],
    pub(super) unit: N,
    pub(super) exponent: i32,
    /// The time of flight, in the inverse of that unit.
    pub(super) time: N,
    /// The vertical seen from the body at launch (BF), of length 1.
    pub(super) vertical: [N; 3],
}

/// The elements [xx, yy, zz, xy, xz, yz] of the tensor in a power of two near the largest, exactly.
fn elements(toss: &Toss) -> [f64; 6] {
    let elements = toss.body.inertia();
    let scale = power_of_two_scale(elements.into_iter().fold(0.0, |most: f64, element| most.max(element.abs())));
    elements.map(|element| element / scale)
}

/// The tensor of the body in numbers like `like`, in a power of two near its largest element. An element below 2^-1022 of that
/// is a ball about it.
pub(super) fn tensor<N: Elementary>(toss: &Toss, like: &N) -> Symmetric<N> {
    let given = toss.body.inertia();
    let scaled = elements(toss);
    let element = |index: usize| {
        let has_lost_digits = given[index] != 0.0 && scaled[index].abs() < f64::MIN_POSITIVE;
        let lost = if has_lost_digits { f64::MIN_POSITIVE } else { 0.0 };
        like.like(scaled[index]).widened(lost)
    };
    if toss.body.moments().is_some() {
        return Symmetric::diagonal([0, 1, 2].map(element));
    }
    Symmetric::new([0, 1, 2, 3, 4, 5].map(element))
}

impl Given<Ball<DoubleDouble>> {
    /// In double-double, for another `time` of flight than that of the launch if there is one.
    pub(super) fn in_double_double(toss: &Toss, time: Option<ExactTime>) -> Self {
        let (rate, unit) = toss.launch.given_rate();
        let exponent = mantissa_and_exponent(power_of_two_scale(toss.launch.rate().amax())).1;
        let launch = ExactTime::from(toss.launch.time_of_flight());
        let time = match time.filter(|time| *time != launch) {
            Some(time) => (Ball::new(time.mantissa(), 0.0), time.exponent()),
            None => (right_to_25_u2(launch.mantissa()), launch.exponent()),
        };
        let zero = Ball::new(DoubleDouble::ZERO, 0.0);
        let given = [0, 1, 2].map(|axis: usize| zero.like(rate[axis]).times_power_of_two(-exponent));
        let rate = match unit {
            Unit::ONE => given,
            unit => given.map(|part| part * zero.like_big(&unit.in_digits(160))),
        };
        Self {
            tensor: tensor(toss, &zero),
            rate,
            unit: zero.like(1.0),
            exponent,
            time: time.0.times_power_of_two(time.1 + exponent),
            vertical: vertical_in_double_double(&toss.launch),
        }
    }
}

impl Given<WideBall> {
    /// In so many binary digits, for another `time` of flight than that of the launch if there is one.
    pub(super) fn in_digits(toss: &Toss, time: Option<ExactTime>, digits: usize) -> Self {
        let (rate, unit) = toss.launch.given_rate();
        let (launch, vertical) = in_digits(&toss.launch, digits);
        let exponent = mantissa_and_exponent(power_of_two_scale(rate.amax())).1;
        let unit = right_to_roundings(unit.in_digits(digits), digits);
        let own = ExactTime::from(toss.launch.time_of_flight());
        let time = match time.filter(|time| *time != own) {
            Some(time) => {
                let mantissa = unit.like_big(&Elementary::to_big(&time.mantissa()));
                (mantissa * unit.clone()).times_power_of_two(time.exponent() + exponent)
            }
            None => launch,
        };
        Self { tensor: tensor(toss, &unit), rate: scaled(&rate, &unit), unit, exponent, time, vertical }
    }
}

impl<N: Elementary> Given<N> {
    /// The same in numbers of another kind.
    pub(super) fn map<M>(&self, number: impl Fn(&N) -> M) -> Given<M> {
        Given {
            tensor: self.tensor.map(&number),
            rate: self.rate.each_ref().map(&number),
            unit: number(&self.unit),
            exponent: self.exponent,
            time: number(&self.time),
            vertical: self.vertical.each_ref().map(&number),
        }
    }

    /// The same in the unit of the rates with another `exponent`.
    pub(super) fn with_exponent(mut self, exponent: i32) -> Self {
        let by = self.exponent - exponent;
        self.rate = self.rate.map(|part| part.times_power_of_two(by));
        self.time = self.time.times_power_of_two(-by);
        Self { exponent, ..self }
    }

    /// The same with another vertical.
    pub(super) fn seen_along(self, vertical: [N; 3]) -> Self {
        Self { vertical, ..self }
    }

    /// A time (s) in the unit of that of flight.
    pub(super) fn time_in_unit(&self, time: &N) -> N {
        time.times_power_of_two(self.exponent) * self.unit.clone()
    }

    /// The turn from launch to landing of a motion that may be a `special` one, of any norm; `None` if the numbers have too
    /// few digits.
    pub(super) fn turn(&self, special: Option<Special>) -> Option<Quaternion<N>> {
        match special {
            None => self.curve().less_largest_root().turn(&self.time),
            Some(special) => Some(self.special_turn(special)),
        }
    }

    /// The same of numbers that contain an interval of tosses. 1/(℘ - e) would be infinite for some of them.
    pub(super) fn turn_over_interval(&self, special: Option<Special>) -> Option<Quaternion<N>> {
        match special {
            None => self.curve().turn(&self.time),
            Some(special) => Some(self.special_turn(special)),
        }
    }

    fn curve(&self) -> Curve<N> {
        Curve::new(self.tensor.clone(), self.rate.clone())
    }

    fn special_turn(&self, special: Special) -> Quaternion<N> {
        match special {
            Special::Separatrix => self.curve().turn_on_separatrix(&self.time),
            Special::Spin => turned_at(&self.rate, &self.time),
            Special::Symmetric(axis) => {
                let [precession, spin] = precession_and_spin(self, axis);
                product(&precession, &spin)
            }
        }
    }

    /// The body rate (BF) after a `turn`, in the unit of the given one: J⁻¹ of the angular momentum, which is fixed in space.
    pub(super) fn rate_after(&self, turn: &Quaternion<N>, special: Option<Special>) -> [N; 3] {
        let back = |turn: &Quaternion<N>, vector: &[N; 3], size: N| {
            turned(&conjugate(turn), vector).map(|part| part / size.clone())
        };
        match special {
            Some(Special::Spin) => self.rate.clone(),
            // The spin alone, because a rod has no J⁻¹.
            Some(Special::Symmetric(axis)) => {
                let [_, spin] = precession_and_spin(self, axis);
                back(&spin, &self.rate, norm_squared(&spin))
            }
            None | Some(Special::Separatrix) => {
                let cofactors = self.tensor.cofactors();
                let size = self.tensor.determinant(&cofactors) * norm_squared(turn);
                cofactors.apply(&back(turn, &self.tensor.apply(&self.rate), size))
            }
        }
    }
}
