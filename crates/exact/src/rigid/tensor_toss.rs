//! The toss of a body that was given by a tensor, in numbers of one kind, and the ladder of these kinds: balls of f64, of
//! double-double, and of 192, 384, 768, … binary digits. A question climbs it until the numbers have digits enough for
//! an answer.

use dynamics::time_of_flight::ExactTime;
use dynamics::{AngleUnit, Stage, Toss};
use numerics::big::exactly;
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{Ball, Big, DoubleDouble, Elementary, WideBall};

use super::Regime;
use super::doubling::Curve;
use super::quaternion::Quaternion;
use super::tensor::{Symmetric, cross, dot};
use crate::given::{in_digits, right_to_25_u2, right_to_roundings, rounded, scaled, vertical_in_double_double};

/// Digits of the first stage after double-double, and of the last. A flight of 10^6 rad next to a spin about the middle axis,
/// 1e-60 of the rate off it, takes the last.
const DIGITS: [usize; 2] = [192, 12_288];

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

/// A motion that is known exactly to be a special one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Special {
    /// About a fixed axis for ever: J ω and ω are parallel.
    Spin,
    /// On the separatrix, towards the axis of the middle moment for ever.
    Separatrix,
}

/// What can be asked of the landing, with an answer if the numbers have digits enough.
pub(super) trait Question {
    type Answer;
    fn answer<N: Elementary>(&self, landed: &Landed<N>) -> Option<Self::Answer>;
}

/// A body that has turned since its launch.
pub(super) struct Landed<N> {
    pub(super) given: Given<N>,
    /// Of any norm.
    pub(super) turn: Quaternion<N>,
    /// The motion; none of a body that does not move, or spins about a fixed axis for ever.
    curve: Option<Curve<N>>,
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
    Symmetric(std::array::from_fn(element))
}

impl Given<Ball<DoubleDouble>> {
    /// In double-double, for another `time` of flight than that of the launch if there is one.
    pub(super) fn in_double_double(toss: &Toss, time: Option<ExactTime>) -> Self {
        let rate = toss.launch.rate();
        let exponent = mantissa_and_exponent(power_of_two_scale(rate.amax())).1;
        let launch = ExactTime::from(toss.launch.time_of_flight());
        let time = match time.filter(|time| *time != launch) {
            Some(time) => (Ball::new(time.mantissa(), 0.0), time.exponent()),
            None => (right_to_25_u2(launch.mantissa()), launch.exponent()),
        };
        let number = |value: DoubleDouble| Ball::new(value, 0.0);
        let zero = number(DoubleDouble::ZERO);
        // A rate that was not given in rad/s has an error of 16 u²; a tiny one has lost digits.
        let is_exact = toss.launch.given_rate().1 == AngleUnit::RADIAN;
        let rate = toss.launch.exact_rate().map(|part| {
            let own = number(part).times_power_of_two(-exponent);
            let relative = if part.hi().abs() < 1e-250 { 2f64.powi(-50) } else { 2f64.powi(-101) };
            if is_exact || part.hi() == 0.0 { own } else { own.widened(own.to_f64().abs() * relative) }
        });
        Self {
            tensor: tensor(toss, &zero),
            rate,
            unit: zero.like(1.0),
            exponent,
            time: time.0.times_power_of_two(time.1 + exponent),
            vertical: vertical_in_double_double(&toss.launch),
        }
    }

    /// The same in f64.
    fn rounded(&self) -> Given<Ball<f64>> {
        Given {
            tensor: Symmetric(self.tensor.0.each_ref().map(rounded)),
            rate: self.rate.each_ref().map(rounded),
            unit: rounded(&self.unit),
            exponent: self.exponent,
            time: rounded(&self.time),
            vertical: self.vertical.each_ref().map(rounded),
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
    /// The body after its flight; `None` if the numbers have too few digits.
    fn landed(self) -> Option<Landed<N>> {
        let is_exactly_0 = |part: &N| part.sign() == 0.0 && part.error() == 0.0;
        if self.rate.iter().all(is_exactly_0) {
            let turn = [1.0, 0.0, 0.0, 0.0].map(|part| self.time.like(part));
            return Some(Landed { given: self, turn, curve: None });
        }
        let curve = Curve::new(self.tensor.clone(), self.rate.clone());
        let turn = curve.turn(&self.time)?;
        Some(Landed { given: self, turn, curve: Some(curve) })
    }
}

impl Given<WideBall> {
    /// The body after a flight of a `special` motion.
    fn landed_specially(self, special: Special) -> Landed<WideBall> {
        match special {
            Special::Spin => {
                let turn = turned(&self.rate, &self.time);
                Landed { given: self, turn, curve: None }
            }
            Special::Separatrix => {
                let curve = Curve::new(self.tensor.clone(), self.rate.clone());
                let turn = curve.turn_on_separatrix(&self.time);
                Landed { given: self, turn, curve: Some(curve) }
            }
        }
    }
}

impl<N: Elementary> Landed<N> {
    /// The body rate (BF) in the unit of the given one.
    pub(super) fn rate(&self) -> [N; 3] {
        self.curve.as_ref().map_or_else(|| self.given.rate.clone(), |curve| curve.rate_after(&self.turn))
    }
}

/// The turn at a fixed `rate`, which is not 0.
fn turned<N: Elementary>(rate: &[N; 3], time: &N) -> Quaternion<N> {
    let size = dot(rate, rate).sqrt();
    let [sin, cos] = (size.clone() * time.halved()).sine_and_cosine();
    let [x, y, z] = rate.clone().map(|part| part * sin.clone() / size.clone());
    [cos, x, y, z]
}

/// The answer to a question about the landing of a toss of a body that was given by a tensor; `None` if the last stage has
/// too few digits.
pub(super) fn climb<Q: Question>(toss: &Toss, question: &Q) -> Option<(Q::Answer, Stage)> {
    let rough = Given::in_double_double(toss, None).rounded().landed();
    match rough.and_then(|landed| question.answer(&landed)) {
        Some(answer) => Some((answer, Stage::F64)),
        None => climb_from_double_double(toss, None, question),
    }
}

/// The same from double-double on, after `time` or else at the landing.
pub(super) fn climb_from_double_double<Q: Question>(
    toss: &Toss,
    time: Option<ExactTime>,
    question: &Q,
) -> Option<(Q::Answer, Stage)> {
    let fine = Given::in_double_double(toss, time).landed();
    if let Some(answer) = fine.and_then(|landed| question.answer(&landed)) {
        return Some((answer, Stage::DoubleDouble));
    }
    let special = special(toss);
    let digits = std::iter::successors(Some(DIGITS[0]), |digits| Some(2 * digits));
    let found = digits.take_while(|digits| *digits <= DIGITS[1]).find_map(|digits| {
        let given = Given::in_digits(toss, time, digits);
        let landed = match special {
            Some(special) => given.landed_specially(special),
            None => given.landed()?,
        };
        question.answer(&landed)
    });
    found.map(|answer| (answer, Stage::MoreDigits))
}

/// J, ω and m = Jω exactly, but for a common factor of each.
struct Exact {
    tensor: Symmetric<Big>,
    rate: [Big; 3],
    momentum: [Big; 3],
}

impl Exact {
    fn new(toss: &Toss) -> Self {
        let tensor = Symmetric(toss.body.inertia().map(exactly));
        let rate = <[f64; 3]>::from(toss.launch.given_rate().0).map(exactly);
        let momentum = tensor.apply(&rate);
        Self { tensor, rate, momentum }
    }

    fn spins(&self) -> bool {
        cross(&self.momentum, &self.rate).iter().all(|part| *part == Big::ZERO)
    }

    /// det(2T J - G²), which has the sign of G² - 2T I₂ with the middle moment I₂.
    fn determinant(&self) -> Big {
        let excess = self.tensor.excess(&self.rate);
        excess.determinant(&excess.cofactors())
    }

    /// Whether two moments are equal: with A = 3J - tr J, whether (tr A²)³ = 54 (det A)².
    fn is_symmetric(&self) -> bool {
        let three = self.tensor.scaled(&exactly(3.0)).less(&self.tensor.trace());
        let (square, determinant) = (three.times(&three).trace(), three.determinant(&three.cofactors()));
        &square * &square * square == exactly(54.0) * &determinant * determinant
    }
}

/// The special motion of a toss, if it has one.
fn special(toss: &Toss) -> Option<Special> {
    let exact = Exact::new(toss);
    if exact.spins() {
        return Some(Special::Spin);
    }
    (!exact.is_symmetric() && exact.determinant() == Big::ZERO).then_some(Special::Separatrix)
}

/// The kind of motion, by exact arithmetic.
pub(super) fn regime(toss: &Toss) -> Regime {
    let exact = Exact::new(toss);
    if exact.spins() || exact.is_symmetric() {
        return Regime::Uniform;
    }
    match exact.determinant().partial_cmp(&Big::ZERO) {
        Some(std::cmp::Ordering::Greater) => Regime::AroundLargest,
        Some(std::cmp::Ordering::Less) => Regime::AroundSmallest,
        _ => Regime::Separatrix,
    }
}
