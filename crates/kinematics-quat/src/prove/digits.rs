//! The flight of a coin by Taylor series in numbers with error bounds, for outcomes that f64 leaves undecided. The theorem
//! is that of `docs/proofs/enclosure.md`, section 6. Symbols are those of the file `taylor/coin.rs`.
//!
//! Time is in units of the flight, and all steps have the same length. As |η| never changes and the axes turn with η, all
//! steps have the same turn, whose series is computed once, in balls. The attitude and the direction of η are stepped on
//! as the midpoints of balls, because balls would grow with each step; what that leaves out is added up.

use dynamics::attitude::vertical_in_body;
use dynamics::integrate::STEP_LIMIT;
use dynamics::{CoinToss, Outcome, SolveError};
use numerics::big::exactly;
use numerics::{Ball, Big, DoubleDouble, Elementary, UNIT_ROUNDOFF};

use crate::prove::flight::whole;

/// Digits of the inputs beyond those of the flight.
const GUARD: usize = 64;

/// The landing of a flight with its bounds.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Landing {
    pub(crate) outcome: Outcome,
    /// The quaternion P from the attitude at launch to that at landing.
    pub(crate) turn: [f64; 4],
    /// The bound of its error, before P is rounded to f64.
    pub(crate) attitude_bound: f64,
    pub(crate) cos_tilt: f64,
    pub(crate) cos_bound: f64,
    pub(crate) steps: u32,
    pub(crate) order: usize,
}

/// Flies `toss` in double-double.
pub(crate) fn in_double_double(toss: &CoinToss) -> Result<Landing, SolveError> {
    fly(toss, &Ball::new(DoubleDouble::ZERO, 0.0))
}

/// Flies `toss` in so many binary digits.
pub(crate) fn in_digits(toss: &CoinToss, digits: usize) -> Result<Landing, SolveError> {
    fly(toss, &Ball::new(Big::ZERO.with_precision(digits).value(), 0.0))
}

/// A complex number.
type Pair<T> = [T; 2];

/// Flies `toss` in numbers like `like`, in at most a million steps.
fn fly<N: Elementary>(toss: &CoinToss, like: &Ball<N>) -> Result<Landing, SolveError> {
    let given = Given::new(toss, like);
    let steps = steps(given.eta.to_f64() + given.half_z.to_f64().abs() + given.q.to_f64().abs())?;
    let parts = like.like(f64::from(steps));
    let [eta, half_z, q] = [&given.eta, &given.half_z, &given.q].map(|turn| turn.clone() / parts.clone());
    let order = order(like.digits());
    let series = Series::new(&eta, &half_z, &q, order);
    let flown = Flown::new(&series, &given.direction, steps);
    let turn = flown.turn.map(|part| Ball::new(part, 0.0));
    let (height, norm) = height(&given.vertical, &turn);
    let cos_tilt = (height / norm).widened(2.0 * flown.bound);
    let rounded = cos_tilt.midpoint().to_f64();
    let outcome = match (cos_tilt.has_sign(), rounded > 0.0) {
        (false, _) => Outcome::Undecided,
        (true, true) => Outcome::Heads,
        (true, false) => Outcome::Tails,
    };
    let cos_bound = (cos_tilt.radius() + 1.01 * UNIT_ROUNDOFF * rounded.abs()).min(2.0);
    let turn = turn.map(|part| part.to_f64());
    Ok(Landing { outcome, turn, attitude_bound: flown.bound, cos_tilt: rounded, cos_bound, steps, order })
}

/// The number of steps for this sum of turns (rad), in which the terms of the series fall like those of e^½.
fn steps(turns: f64) -> Result<u32, SolveError> {
    let steps = (2.0 * turns * (1.0 + 1e-9)).ceil().max(1.0);
    if steps > f64::from(STEP_LIMIT) {
        return Err(SolveError::StepLimit { time: 0.0, limit: STEP_LIMIT });
    }
    Ok(steps as u32)
}

/// The smallest order with 4/(order + 1)! ≤ 2^-(digits + 8).
fn order(digits: i32) -> usize {
    let mut left = f64::from(digits) + 10.0;
    let mut order = 0;
    while left > 0.0 {
        order += 1;
        let factor = (order + 1) as f64;
        left -= factor.log2() * (1.0 - 1e-12);
    }
    order
}

/// The toss, as turns in the time of flight (rad).
struct Given<N> {
    /// |η| T.
    eta: Ball<N>,
    /// η/|η|, or 1.
    direction: Pair<Ball<N>>,
    half_z: Ball<N>,
    q: Ball<N>,
    /// The vertical seen from the body at launch.
    vertical: [Ball<N>; 3],
}

impl<N: Elementary> Given<N> {
    fn new(toss: &CoinToss, like: &Ball<N>) -> Self {
        let digits = usize::try_from(like.digits()).unwrap_or(106) + GUARD;
        let round = |value: Big| value.with_precision(digits).value();
        // Each number is right to some thirty roundings in the digits of the inputs.
        let ball = |value: Big| {
            let size = value.to_f64().value().abs();
            like.like_big(&value).widened(size * 2f64.powi(-like.digits() - 40))
        };
        let (rate, unit) = toss.launch.given_rate();
        let [x, y, z] = [rate.x, rate.y, rate.z].map(|part| round(exactly(part)));
        let transverse = round(&x * &x + &y * &y).sqrt();
        let one = round(exactly(1.0));
        let direction = if transverse == Big::ZERO {
            [one.clone(), Big::ZERO]
        } else {
            [round(x) / &transverse, round(y) / &transverse]
        };
        let time = round(unit.in_digits(digits)) * toss.launch.time_of_flight().in_digits(digits);
        let half = round(exactly(0.5));
        let ratio = round(toss.coin.inertia_ratio_in_digits(digits));
        let (vertical, norm) = toss.launch.attitude().vertical_in_digits(digits);
        let norm = round(norm);
        Self {
            eta: ball(transverse * &half * &time),
            direction: direction.map(&ball),
            half_z: ball(&z * &half * &time),
            q: ball((ratio - one) * z * time),
            vertical: vertical.map(|part| ball(round(part) / &norm)),
        }
    }
}

/// The turn of a step and that of η, in the axes in which η is real at the start of the step.
struct Series<N> {
    u: Pair<Ball<N>>,
    v: Pair<Ball<N>>,
    eta: Pair<Ball<N>>,
}

impl<N: Elementary> Series<N> {
    fn new(eta: &Ball<N>, half_z: &Ball<N>, q: &Ball<N>, order: usize) -> Self {
        let (one, zero) = (q.like(1.0), q.like(0.0));
        let (mut u, mut w, mut r) = (vec![one.clone()], vec![zero.clone()], vec![one]);
        for k in 0..order {
            let place = q.like((k + 1) as f64);
            let products = |a: &[Ball<N>]| {
                let terms = a.iter().zip(r.iter().rev());
                terms.fold(zero.clone(), |sum, (a, r)| sum + a.clone() * r.clone()) * eta.clone()
            };
            let [of_w, of_u] = [products(&w), products(&u)].map(|sum| if k % 2 == 0 { sum } else { -sum });
            let next = [of_w + u[k].clone() * half_z.clone(), w[k].clone() * half_z.clone() - of_u];
            let next_r = r[k].clone() * q.clone() / place.clone();
            let [next_u, next_w] = next.map(|sum| sum / place.clone());
            u.push(next_u);
            w.push(next_w);
            r.push(next_r);
        }
        // With terms that fall at least like 1/k!, all that are left out are below 4/(order + 1)!.
        let rest = 2f64.powi(-8 - q.digits());
        let sums = |terms: &[Ball<N>]| alternating(terms, &zero).map(|sum| sum.widened(rest));
        let [even, odd] = sums(&w);
        Self { u: sums(&u), v: [-odd, -even], eta: sums(&r) }
    }
}

/// The sums of the even terms and of the odd ones, each with alternating signs.
fn alternating<N: Elementary>(terms: &[Ball<N>], zero: &Ball<N>) -> Pair<Ball<N>> {
    [0, 1].map(|first| {
        let terms = terms.iter().skip(first).step_by(2).enumerate();
        terms.fold(zero.clone(), |sum, (j, term)| if j % 2 == 0 { sum + term.clone() } else { sum - term.clone() })
    })
}

/// A flight in midpoints.
struct Flown<N> {
    /// P.
    turn: [N; 4],
    /// The bound of its error.
    bound: f64,
}

impl<N: Elementary> Flown<N> {
    /// Takes so many steps from P = 1 with η in `direction`.
    fn new(series: &Series<N>, direction: &Pair<Ball<N>>, steps: u32) -> Self {
        let middle = |pair: &Pair<Ball<N>>| pair.each_ref().map(|part| part.midpoint().clone());
        let radius = |pair: &Pair<Ball<N>>| pair[0].radius() + pair[1].radius();
        let [u, v, eta] = [&series.u, &series.v, &series.eta].map(middle);
        let one = u[0].like(1.0);
        let mut turn = [one.clone(), one.like(0.0), one.like(0.0), one.like(0.0)];
        let mut towards = middle(direction);
        for _ in 0..steps {
            turn = turned(&turn, &u, &product(&towards, &v));
            towards = product(&towards, &eta);
        }
        // Of one step: the radii, and the roundings of two products of complex numbers and of one of quaternions.
        let rounding = 64.0 * 2f64.powi(8 - one.digits());
        let [of_turn, of_eta] = [radius(&series.u) + radius(&series.v) + rounding, radius(&series.eta) + rounding];
        let steps = f64::from(steps);
        // The error of η is one of its direction, which counts once, and one of its size, which counts in each later step.
        let sum = steps * (of_turn + of_eta) + (steps + 1.0) * (steps * of_eta + radius(direction));
        Self { turn, bound: whole(sum) }
    }
}

/// a × b of complex numbers.
fn product<N: Elementary>([a, b]: &Pair<N>, [c, d]: &Pair<N>) -> Pair<N> {
    [a.clone() * c.clone() - b.clone() * d.clone(), a.clone() * d.clone() + b.clone() * c.clone()]
}

/// P ⊗ R, with R as u = w + i z and v = x + i y.
fn turned<N: Elementary>([w, x, y, z]: &[N; 4], [r_w, r_z]: &Pair<N>, [r_x, r_y]: &Pair<N>) -> [N; 4] {
    let times = |a: &N, b: &N| a.clone() * b.clone();
    [
        times(w, r_w) - times(x, r_x) - times(y, r_y) - times(z, r_z),
        times(w, r_x) + times(x, r_w) + times(y, r_z) - times(z, r_y),
        times(w, r_y) + times(y, r_w) + times(z, r_x) - times(x, r_z),
        times(w, r_z) + times(z, r_w) + times(x, r_y) - times(y, r_x),
    ]
}

/// The height of the normal after the turn P, times |P|², with the `vertical` seen before it; and |P|².
pub(super) fn height<N: Elementary>(vertical: &[N; 3], [w, x, y, z]: &[N; 4]) -> (N, N) {
    // The normal is the third axis of the frame that is turned back.
    let ([x, y, z], square) = vertical_in_body([w.clone(), -x.clone(), -y.clone(), -z.clone()]);
    let [a, b, c] = vertical.clone();
    (a * x + b * y + c * z, square)
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, TimeOfFlight, Unit};

    use super::*;

    #[test]
    fn the_order_is_the_smallest_whose_remainder_is_below_the_digits() {
        for digits in [53, 106, 192, 384, 768] {
            let order = order(digits);
            // log2 of 4/(n + 1)!
            let remainder = |order: usize| 2.0 - (1..=order + 1).map(|factor| (factor as f64).log2()).sum::<f64>();
            let wanted = -f64::from(digits) - 8.0;
            assert!(remainder(order) <= wanted && remainder(order - 1) > wanted, "{digits}: {order}");
        }
    }

    /// In a step the series are those of angles of at most ½ rad, on which the error of their order rests.
    #[test]
    fn steps_are_as_many_as_half_radians() {
        for (k, rate, time) in
            [(0.5, [3.0, -4.0, 7.0], 2.1), (1.7, [0.3, 0.1, -9.0], 11.0), (1.0, [40.0, 9.0, 0.0], 3.3)]
        {
            let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
            let coin = CoinToss { coin: Coin::from_moments(1.0, k).unwrap(), launch };
            let [x, y, z] = rate.map(|rate: f64| 0.5 * rate * time);
            let turns = x.hypot(y) + z.abs() + 2.0 * (k - 1.0).abs() * z.abs();
            for found in [in_double_double(&coin).unwrap(), in_digits(&coin, 192).unwrap()] {
                assert_eq!(f64::from(found.steps), (2.0 * turns).ceil(), "{rate:?}");
            }
        }
        let still = Launch::new([0.0; 3], TimeOfFlight::Given(1.0)).unwrap();
        let found = in_double_double(&CoinToss { coin: Coin::DISC, launch: still }).unwrap();
        assert_eq!((found.steps, found.outcome), (1, Outcome::Heads));
    }

    fn of_given<N>(given: &Given<N>) -> Vec<&Ball<N>> {
        let turns = [&given.eta, &given.half_z, &given.q];
        turns.into_iter().chain(&given.direction).chain(&given.vertical).collect()
    }

    fn of_series<N>(series: &Series<N>) -> Vec<&Ball<N>> {
        series.u.iter().chain(&series.v).chain(&series.eta).collect()
    }

    /// The numbers in more digits are within the radii, which are those of few roundings.
    fn assert_encloses(balls: Vec<&Ball<DoubleDouble>>, exact: Vec<&Ball<Big>>, bits: i32) {
        for (ball, exact) in balls.into_iter().zip(exact) {
            let off = (ball.to_big().with_precision(400).value() - exact.to_big()).to_f64().value().abs();
            let most = 2f64.powi(-bits) * (exact.to_f64().abs() + 1e-200);
            assert!(off <= ball.radius() && ball.radius() <= most, "{off:e} {ball:?}, {most:e}");
        }
    }

    #[test]
    fn balls_of_a_toss_and_of_its_step_hold_what_more_digits_find() {
        let (double, more) =
            (Ball::new(DoubleDouble::ZERO, 0.0), Ball::new(Big::ZERO.with_precision(384).value(), 0.0));
        let degree = Unit::DEGREE;
        let time = TimeOfFlight::Ballistic { speed: 3.3, gravity: 9.81 };
        let launch = Launch::in_unit([100.0, 30.0, 77.0], degree, time).unwrap().with_tilt(0.3).unwrap();
        let toss = CoinToss { coin: Coin::from_moments(3.0, 1.0).unwrap(), launch };
        assert_encloses(of_given(&Given::new(&toss, &double)), of_given(&Given::new(&toss, &more)), 97);
        let turns = [0.3, -0.1, 0.07];
        let ([a, b, c], [d, e, f]) = (turns.map(|turn| double.like(turn)), turns.map(|turn| more.like(turn)));
        let (series, exact) = (Series::new(&a, &b, &c, order(106)), Series::new(&d, &e, &f, order(384)));
        assert_encloses(of_series(&series), of_series(&exact), 88);
        assert_eq!(height(&[0.6, 0.0, 0.8], &[2.0, 0.0, 0.0, 0.0]), (3.2, 4.0));
        // Without a turn there is nothing but the remainder.
        let zero = double.like(0.0);
        let still = Series::new(&zero, &zero, &zero, order(106));
        for part in [&still.u[1], &still.v[0], &still.v[1], &still.eta[1]] {
            assert!((1.0..1.001).contains(&(part.radius() * 2f64.powi(114))), "{part:?}");
        }
    }

    /// What one step adds counts in each, that of η in each later one too, and the direction at launch in all.
    #[test]
    fn errors_of_steps_add_up() {
        let flown = |size: f64| {
            let ball = |value: f64, radius: f64| Ball::new(DoubleDouble::from(value), size * radius);
            let pair = |value: f64, [a, b]: [f64; 2]| [ball(value, a), ball(0.0, b)];
            let series = Series { u: pair(1.0, [1.0, 2.0]), v: pair(0.0, [3.0, 4.0]), eta: pair(1.0, [5.0, 7.0]) };
            Flown::new(&series, &pair(1.0, [10.0, 30.0]), 3).bound
        };
        let expected = whole(1e-9 * (3.0 * (10.0 + 12.0) + 4.0 * (3.0 * 12.0 + 40.0)));
        approx::assert_relative_eq!(flown(1e-9), expected, epsilon = 0.0, max_relative = 1e-12);
        let rounding = 64.0 * 2f64.powi(8 - 106);
        approx::assert_relative_eq!(flown(0.0), whole(18.0 * rounding), epsilon = 0.0, max_relative = 1e-12);
        assert_eq!(flown(1.0), f64::INFINITY);
    }

    #[test]
    fn a_flight_takes_up_to_a_million_steps() {
        let half = 0.5 * f64::from(STEP_LIMIT);
        assert_eq!(steps(half - 0.1), Ok(STEP_LIMIT));
        assert_eq!(steps(half), Err(SolveError::StepLimit { time: 0.0, limit: STEP_LIMIT }), "with its margin");
    }
}
