//! Means over a box of the positive part of a linear function, to the power 0 or ½, and of a nearly linear one.
//!
//! Let ℓ(t) = c + Σ s_i t_i over the box -1 ≤ t_i ≤ 1 in n variables, with s_i > 0. Integrating a power of max(0, ℓ) by one
//! variable raises the power by one, so that the mean is a sum over the 2^n corners v:
//!
//! ```text
//! mean of max(0, ℓ)^p = Σ_v ± max(0, ℓ(v))^(p + n) / ((p + 1) … (p + n) Π 2 s_i)      + where an even number of v_i is -1
//! ```
//!
//! The sum cancels where a slope is small compared with the others. Such a variable is left out, and c moves by its slope.
//!
//! Let Q be a function that is small beside ℓ, and θ be 1 where ℓ > 0 and 0 elsewhere. As
//! `0 ≤ max(0, ℓ + Q) - (ℓ + Q) θ ≤ max(0, |Q| - |ℓ|)`, the mean of max(0, ℓ + Q) is that of max(0, ℓ) and of Q where ℓ is positive, and at most the mean of |Q| more, or with M = max |Q| and the largest slope s, at most
//! M²/(2 s), because ℓ has no density above 1/(2 s). Of the terms t_i t_j of Q the means where ℓ is positive follow from parts: with
//! H_p = max(0, ℓ)^p/p! each integration by t_i raises p by one, and
//!
//! ```text
//! ∫ t f(ℓ) dt = t F1/s - F2/s²,   ∫ t² f(ℓ) dt = t² F1/s - 2 t F2/s² + 2 F3/s³      where F1, F2, F3 are integrals of f
//! ```

use crate::ball::Ball;
use crate::double_double::DoubleDouble;
use crate::elementary::Elementary;
use crate::jet::MOST_VARIABLES;

/// A slope below this part of the largest is left out: n of them cancel 40 of the 98 digits that are right.
const SMALL_SLOPE: f64 = 9.536_743_164_062_5e-7; // 2^-20

/// The power of a positive part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Power {
    /// 1 where the function is positive, 0 elsewhere.
    Zero,
    /// The square root.
    Half,
}

/// A slope below this part of the largest counts as a small part of a function that is nearly linear.
const SMALL_PART: f64 = 9.765_625e-4; // 2^-10

/// A polynomial of the second degree over the box -1 ≤ t_i ≤ 1.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Curved {
    /// The constant term.
    pub constant: f64,
    /// The coefficients of the variables.
    pub slopes: [f64; MOST_VARIABLES],
    /// The coefficients of t_i t_j, i ≤ j.
    pub curvature: [[f64; MOST_VARIABLES]; MOST_VARIABLES],
}

/// The means of a linear function and of the products of two variables where it is positive, with bounds of what each is off.
struct Positive {
    mean: [f64; 2],
    products: [[[f64; 2]; MOST_VARIABLES]; MOST_VARIABLES],
}

impl Curved {
    /// Whether all coefficients are finite.
    pub fn is_finite(&self) -> bool {
        self.constant.is_finite()
            && self.slopes.iter().chain(self.curvature.as_flattened()).all(|part| part.is_finite())
    }

    /// A bound of the part of the second degree, but for roundings: the sum of the sizes of its coefficients.
    pub fn bend(&self) -> f64 {
        self.curvature.as_flattened().iter().map(|part| part.abs()).sum()
    }
}

/// The smallest and the largest mean, over the box, of the positive part of a function whose distance from this polynomial has at
/// most the mean `off`; and how much of their distance is due to the curvature.
pub fn mean_of_curved(of: &Curved, off: f64) -> ([f64; 2], f64) {
    let largest = of.slopes.iter().fold(0.0_f64, |largest, slope| largest.max(slope.abs()));
    let mut is_kept = [false; MOST_VARIABLES];
    let (mut most, mut mean_size) = (0.0, 0.0);
    for (i, slope) in of.slopes.iter().enumerate() {
        is_kept[i] = slope.abs() > SMALL_PART * largest;
        if !is_kept[i] {
            most += slope.abs();
            mean_size += 0.5 * slope.abs();
        }
    }
    let positive = of.where_positive(&is_kept);
    let ([mut middle, mut error], mut sizes) = (positive.mean, 0.0);
    for (i, row) in of.curvature.iter().enumerate() {
        for (j, coefficient) in row.iter().enumerate().skip(i) {
            let [product, off] = positive.products[i][j];
            middle += coefficient * product;
            error += coefficient.abs() * off;
            sizes += coefficient.abs();
            mean_size += coefficient.abs() * if i == j { 1.0 / 3.0 } else { 0.25 };
        }
    }
    most += sizes;
    let rounding = 16.0 * f64::EPSILON;
    let bent = (if largest > 0.0 { mean_size.min(0.5 * most * most / largest) } else { mean_size }) * (1.0 + rounding);
    let error = (error + off + rounding * (of.constant.abs() + 3.0 * largest + sizes)) * (1.0 + rounding);
    let [lo, hi] = [middle - error, middle + error + bent];
    // Nothing is known if a part left the range of f64.
    let ends =
        if lo.is_finite() && hi.is_finite() { [lo.next_down().max(0.0), hi.next_up()] } else { [0.0, f64::INFINITY] };
    (ends, bent)
}

impl Curved {
    /// Of the linear part in the variables that are kept, where it is positive.
    fn where_positive(&self, is_kept: &[bool; MOST_VARIABLES]) -> Positive {
        let mut slopes = [0.0; MOST_VARIABLES];
        let mut kept = [0; MOST_VARIABLES];
        let mut n = 0;
        for index in (0..MOST_VARIABLES).filter(|index| is_kept[*index]) {
            (slopes[n], kept[n]) = (self.slopes[index], index);
            n += 1;
        }
        let (slopes, kept) = (&slopes[..n], &kept[..n]);
        let reach = slopes.iter().map(|slope| slope.abs()).sum::<f64>();
        let alone = |share: f64, value: f64| {
            let mut products = [[[0.0; 2]; MOST_VARIABLES]; MOST_VARIABLES];
            for (i, row) in products.iter_mut().enumerate() {
                row[i] = [share / 3.0, f64::EPSILON];
            }
            Positive { mean: [value, 0.0], products }
        };
        if self.constant.abs() > reach * (1.0 + 4.0 * f64::EPSILON) || n == 0 {
            return if self.constant > 0.0 { alone(1.0, self.constant) } else { alone(0.0, 0.0) };
        }
        // Sums over the corners of H_n, H_(n+1) and H_(n+2), also times the place of the corner.
        let [mut all, mut first, mut second] = [0.0; 3];
        let (mut at_one, mut at_two) = ([0.0; MOST_VARIABLES], [[0.0; MOST_VARIABLES]; MOST_VARIABLES]);
        for corner in 0..1_u32 << n {
            let at: [f64; MOST_VARIABLES] =
                std::array::from_fn(|index| if corner >> index & 1 == 1 { -1.0 } else { 1.0 });
            let value = slopes.iter().zip(at).fold(self.constant, |value, (slope, at)| value + at * slope).max(0.0);
            let sign = if corner.count_ones() % 2 == 0 { 1.0 } else { -1.0 };
            let powers = (1..=n).fold(sign, |power, index| power * value / index as f64);
            let next = powers * value / (n + 1) as f64;
            all += powers;
            first += next;
            second += next * value / (n + 2) as f64;
            for i in 0..n {
                at_one[i] += at[i] * next;
                for j in i + 1..n {
                    at_two[i][j] += at[i] * at[j] * powers;
                }
            }
        }
        let divisor = slopes.iter().map(|slope| 2.0 * slope).product::<f64>();
        // Each sum of 2^n powers of at most so much is right to 64 u of all of them.
        let size = self.constant.abs() + reach;
        let corners = f64::from(1_u32 << n) * 32.0 * f64::EPSILON / divisor.abs();
        let all_off = (1..=n).fold(corners, |power, index| power * size / index as f64);
        let first_off = all_off * size / (n + 1) as f64;
        let second_off = first_off * size / (n + 2) as f64;
        // The mean of a product is from 0 to a third, or from -¼ to ¼.
        let within = |value: f64, off: f64, [lo, hi]: [f64; 2]| [(value / divisor).clamp(lo, hi), off.min(hi - lo)];
        let mut found = alone(0.0, 0.0);
        let [share, share_off] = within(all, all_off, [0.0, 1.0]);
        for (index, row) in found.products.iter_mut().enumerate() {
            row[index] = [share / 3.0, share_off / 3.0 + f64::EPSILON];
        }
        found.mean = [first / divisor, first_off];
        for i in 0..n {
            let slope = slopes[i];
            let square = all - 2.0 * at_one[i] / slope + 2.0 * second / (slope * slope);
            let off = all_off + 2.0 * first_off / slope.abs() + 2.0 * second_off / (slope * slope);
            found.products[kept[i]][kept[i]] = within(square, off, [0.0, 1.0 / 3.0]);
            for j in i + 1..n {
                let other = slopes[j];
                let product = at_two[i][j] - at_one[i] / other - at_one[j] / slope + second / (slope * other);
                let off =
                    all_off + first_off / other.abs() + first_off / slope.abs() + second_off / (slope * other).abs();
                found.products[kept[i]][kept[j]] = within(product, off, [-0.25, 0.25]);
            }
        }
        found
    }
}

/// The smallest and the largest mean, over the box -1 ≤ t_i ≤ 1, of the positive part to `power` of a function that is nowhere
/// further than `off` ≥ 0 from the linear one with these coefficients.
///
/// At most [`MOST_VARIABLES`] slopes are allowed.
pub fn mean(constant: f64, slopes: &[f64], off: f64, power: Power) -> [f64; 2] {
    let largest = slopes.iter().fold(0.0_f64, |largest, slope| largest.max(slope.abs()));
    let (mut kept, mut number, mut off) = ([0.0; MOST_VARIABLES], 0, off);
    for slope in slopes.iter().map(|slope| slope.abs()) {
        if slope > SMALL_SLOPE * largest {
            kept[number] = slope;
            number += 1;
        } else {
            off = (off + slope) * (1.0 + f64::EPSILON);
        }
    }
    let shifted = |shift: f64| of_linear(exactly(constant) + exactly(shift), &kept[..number], power);
    // The positive part does not fall as the function rises.
    let [lo, hi] = [lower_end(&shifted(-off)), upper_end(&shifted(off))];
    // Nothing is known if a part left the range of f64.
    if lo.is_finite() && hi.is_finite() { [lo.next_down().max(0.0), hi.next_up()] } else { [0.0, f64::INFINITY] }
}

fn lower_end(number: &Ball<DoubleDouble>) -> f64 {
    (number.midpoint().hi() - number.midpoint().lo().abs() - number.radius()).next_down().next_down()
}

fn upper_end(number: &Ball<DoubleDouble>) -> f64 {
    (number.midpoint().hi() + number.midpoint().lo().abs() + number.radius()).next_up().next_up()
}

fn exactly(value: f64) -> Ball<DoubleDouble> {
    Ball::new(value.into(), 0.0)
}

fn of_linear(constant: Ball<DoubleDouble>, slopes: &[f64], power: Power) -> Ball<DoubleDouble> {
    let first = match power {
        Power::Zero => 0.0,
        Power::Half => 0.5,
    };
    let (mut sum, mut divisor) = (exactly(0.0), exactly(1.0));
    for (index, slope) in (1..).zip(slopes) {
        divisor = divisor * exactly(first + f64::from(index)) * exactly(2.0 * slope);
    }
    for corner in 0..1_u32 << slopes.len() {
        let sign = |index: usize| if corner >> index & 1 == 1 { -1.0 } else { 1.0 };
        let at = slopes.iter().enumerate().fold(constant, |at, (index, slope)| at + exactly(sign(index) * slope));
        let part = positive(at, slopes.len(), power);
        sum = if corner.count_ones() % 2 == 0 { sum + part } else { sum - part };
    }
    sum / divisor
}

/// max(0, `number`) to `power` + `more`.
fn positive(number: Ball<DoubleDouble>, more: usize, power: Power) -> Ball<DoubleDouble> {
    if number.has_known_sign() && number.sign() <= 0.0 {
        return exactly(0.0);
    }
    // Around 0 it is at least 0 and at most its upper end.
    let half = 0.5 * upper_end(&number);
    let part = if number.has_sign() { number } else { Ball::new(half.into(), half) };
    let first = match power {
        Power::Zero if !number.has_sign() && more == 0 => return Ball::new(DoubleDouble::from(0.5), 0.5),
        Power::Zero => exactly(1.0),
        Power::Half => part.sqrt(),
    };
    (0..more).fold(first, |product, _| product * part)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the midpoint rule.
    fn counted(constant: f64, slopes: [f64; 3], power: Power) -> f64 {
        const POINTS: i32 = 100;
        let at = |index: i32| (2.0 * f64::from(index) + 1.0) / f64::from(POINTS) - 1.0;
        let mut sum = 0.0;
        for number in 0..POINTS.pow(3) {
            let point = [number % POINTS, number / POINTS % POINTS, number / POINTS / POINTS].map(at);
            let value = constant + slopes.iter().zip(point).map(|(slope, t)| slope * t).sum::<f64>();
            sum += match power {
                Power::Zero => f64::from(value > 0.0),
                Power::Half => value.max(0.0).sqrt(),
            };
        }
        sum / f64::from(POINTS.pow(3))
    }

    #[test]
    fn means_are_those_over_many_points() {
        for (constant, slopes) in [
            (0.1, [1.0, 0.5, -0.25]),
            (-0.7, [0.3, -0.9, 0.2]),
            (5.0, [1.0, 1.0, 1.0]),
            (-5.0, [1.0, 1.0, 1.0]),
            (0.0, [2.0, 0.0, 0.0]),
            (0.3, [0.0, 1e-9, -1.0]),
            (-0.2, [0.0, 0.0, 0.0]),
            (0.2, [0.0, 0.0, 0.0]),
        ] {
            for (power, error) in [(Power::Zero, 0.011), (Power::Half, 1e-3)] {
                let [lo, hi] = mean(constant, &slopes, 0.0, power);
                let expected = counted(constant, slopes, power);
                assert!(lo <= hi && hi - lo < 1e-8 * (1.0 + hi), "{constant} {slopes:?} {power:?}: {lo} {hi}");
                assert!((lo - expected).abs() < error, "{constant} {slopes:?} {power:?}: {lo}, not {expected}");
            }
        }
    }

    /// In closed form: of t over -1 to 1, and of a sum of two.
    #[test]
    fn means_are_exact() {
        for (constant, slopes, power, expected) in [
            (0.0, &[1.0][..], Power::Half, 1.0 / 3.0),
            (0.5, &[-1.0], Power::Zero, 0.75),
            (2.0, &[1.0, 0.5], Power::Zero, 1.0),
        ] {
            let [lo, hi] = mean(constant, slopes, 0.0, power);
            assert!(lo <= expected && expected <= hi && hi - lo < 1e-14, "{constant} {slopes:?} {power:?}: {lo} {hi}");
        }
    }

    /// A function that is off by so much everywhere is within.
    #[test]
    fn what_is_off_the_linear_function_widens_the_mean() {
        let slopes = [0.4, 0.3, 0.2];
        for power in [Power::Zero, Power::Half] {
            let [lo, hi] = mean(0.1, &slopes, 0.05, power);
            for shift in [-0.05, 0.0, 0.05] {
                let [least, most] = mean(0.1 + shift, &slopes, 0.0, power);
                assert!(lo <= most && least <= hi, "{power:?} {shift}");
            }
            assert!(hi - lo < 0.3);
        }
        let [lo, hi] = mean(0.0, &[], 0.0, Power::Zero);
        assert!(lo == 0.0 && hi < 1e-300);
        assert_eq!(mean(f64::MAX, &[f64::MAX], 0.0, Power::Half), [0.0, f64::INFINITY]);
        // A slope that is left out moves the function.
        let [lo, hi] = mean(0.0, &[1.0, 1e-8], 0.0, Power::Zero);
        assert!(hi - lo >= 1e-8 && hi - lo < 4e-8);
    }

    fn curved(constant: f64, slopes: [f64; 3], [xx, xy, yy, yz]: [f64; 4]) -> Curved {
        Curved { constant, slopes, curvature: [[xx, xy, 0.0], [0.0, yy, yz], [0.0; 3]] }
    }

    /// By the midpoint rule: of the positive part, of its square root's place, and of the products where it is positive.
    fn counted_mean(of: &Curved) -> f64 {
        const POINTS: i32 = 120;
        let at = |index: i32| (2.0 * f64::from(index) + 1.0) / f64::from(POINTS) - 1.0;
        let mut sum = 0.0;
        for number in 0..POINTS.pow(3) {
            let t = [number % POINTS, number / POINTS % POINTS, number / POINTS / POINTS].map(at);
            let mut value = of.constant;
            for i in 0..3 {
                value += of.slopes[i] * t[i];
                for j in i..3 {
                    value += of.curvature[i][j] * t[i] * t[j];
                }
            }
            sum += value.max(0.0);
        }
        sum / f64::from(POINTS.pow(3))
    }

    /// The bounds contain the mean, and are as narrow as the curvature tells: M²/(2 s).
    #[test]
    fn the_mean_of_a_nearly_linear_function_is_within_what_its_curvature_tells() {
        for (slopes, bend) in [
            ([1.0, 0.5, -0.25], [0.05, -0.02, 0.03, 0.01]),
            ([-0.3, 0.9, 0.2], [-0.1, 0.06, 0.0, -0.04]),
            ([1.0, 1.0, 1.0], [0.0, 0.2, 0.0, 0.0]),
            ([0.0, 1.0, 0.0], [0.1, 0.0, -0.1, 0.1]),
            ([0.0003, -1.0, 0.5], [0.02, 0.1, 0.0, 0.0]),
            ([0.0; 3], [0.4, 0.1, -0.2, 0.3]),
        ] {
            for constant in [-3.0, -0.7, -0.1, 0.0, 0.2, 0.8, 4.0] {
                let of = curved(constant, slopes, bend);
                let ([lo, hi], bent) = mean_of_curved(&of, 0.0);
                let expected = counted_mean(&of);
                assert!(lo <= expected + 2e-5 && expected <= hi + 2e-5, "{of:?}: {lo} {hi}, not {expected}");
                assert!((hi - lo - bent).abs() < 1e-8 * (1.0 + hi), "{of:?}: {lo} {hi} {bent}");
                let largest = slopes.iter().fold(0.0_f64, |largest, slope| largest.max(slope.abs()));
                let size = of.bend() + 0.001;
                assert!(bent <= if largest > 0.0 { 0.51 * size * size / largest } else { size }, "{of:?}: {bent}");
                // What it is off besides widens it on both sides.
                let ([least, most], _) = mean_of_curved(&of, 0.5);
                assert!(least <= (lo - 0.5).max(0.0) && most >= hi + 0.5 && most < hi + 0.5 + 1e-9);
            }
        }
        let unknown = mean_of_curved(&curved(f64::MAX, [f64::MAX; 3], [0.0; 4]), 0.0).0;
        assert_eq!(unknown, [0.0, f64::INFINITY]);
    }

    /// In closed form: max(0, t) has the mean ¼, and t² and the third of any other square are halved where t > 0; over two variables
    /// t + u is positive in a triangle.
    #[test]
    fn the_means_where_a_linear_function_is_positive_are_exact() {
        for (constant, slopes, bend, expected) in [
            (0.0, [1.0, 0.0, 0.0], [0.0; 4], 0.25),
            (0.5, [-2.0, 0.0, 0.0], [0.0; 4], 2.5 * 2.5 / 8.0),
            (0.0, [1.0, 1.0, 0.0], [0.0; 4], 1.0 / 3.0),
            (0.0, [0.0, 1.0, 0.0], [1e-3, 0.0, 0.0, 0.0], 0.25 + 1e-3 / 6.0),
            (0.0, [0.0, 1.0, 0.0], [0.0, 0.0, 1e-3, 0.0], 0.25 + 1e-3 / 6.0),
            (0.5, [0.0, -1.0, 0.0], [0.0, 0.0, 1e-3, 0.0], 0.5625 + 1e-3 * (1.0 + 0.125) / 6.0),
            // Of t u over t + u > 0 there is no mean.
            (0.0, [1.0, 1.0, 0.0], [0.0, 1e-3, 0.0, 0.0], 1.0 / 3.0),
            (2.0, [0.5, 0.5, 0.5], [1e-3, 1e-3, 0.0, 1e-3], 2.0 + 1e-3 / 3.0),
        ] {
            let of = curved(constant, slopes, bend);
            let ([lo, hi], bent) = mean_of_curved(&of, 0.0);
            assert!(lo <= expected && expected <= hi && hi - lo - bent < 2e-12, "{of:?}: {lo} {hi} {expected}");
            assert!(expected - lo < 2e-12 || bend != [0.0; 4], "{of:?}: {lo} {expected}");
            assert!((lo - expected).abs() < 1e-12, "{of:?}: {lo} {expected}");
        }
    }

    /// Of slopes that are unlike, the products cancel in the sum over the corners, and the bounds of what they are off say so.
    #[test]
    fn means_where_slopes_are_unlike_have_bounds_of_their_roundings() {
        for small in [0.5, 0.1, 0.01, 0.0015] {
            let of = curved(0.1, [1.0, small, 1.7 * small], [0.0; 4]);
            let [all, first, both] =
                [[true; 3], [true, false, false], [true, true, false]].map(|kept| of.where_positive(&kept));
            // Without the small slopes the plane moves by them at most.
            for (other, moved) in [(&first, 2.7 * small), (&both, 1.7 * small)] {
                for i in 0..3 {
                    for j in i..3 {
                        let [[one, off], [other, other_off]] = [all.products[i][j], other.products[i][j]];
                        assert!((one - other).abs() <= off + other_off + moved, "{small} {i} {j}: {one} {other}");
                    }
                }
                assert!((all.mean[0] - other.mean[0]).abs() <= all.mean[1] + other.mean[1] + moved * moved);
            }
            assert!(all.mean[1] < 1e-12 / (small * small));
        }
    }
}
