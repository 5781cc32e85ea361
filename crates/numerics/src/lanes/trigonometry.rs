//! Sine and cosine of SIMD vectors of angles, for angles given in turns, halves or quarters of a turn. In these units
//! whole turns are subtracted without an error, whereas an angle in radians needs a long multiple of π subtracted.
//!
//! An angle may come with a rest, the part that rounding took from it. What remains after whole turns goes into the
//! polynomial with the least maximum error on its interval (found by the Remez algorithm). Its coefficients are rounded
//! to f64. The first one counts most, so that its rounding error is a coefficient too.

use pulp::Simd;

use super::real::Real;
use crate::angle::QUARTER;

/// Largest number of turns, 2^40, whose fractional part has all digits of an f64 if the number comes with a rest.
pub const MOST_TURNS: f64 = 1_099_511_627_776.0;

/// sin(2πx)/x as a polynomial in x², for |x| ≤ ¼, with an error of 2e-19: the f64 nearest to 2π, the rest of 2π, and
/// the further coefficients.
const SINE_OF_TURNS: (f64, [f64; 9]) = (
    std::f64::consts::TAU,
    [
        2.449_293_598_294_706_4e-16,
        -41.341_702_240_399_755,
        81.605_249_276_072_91,
        -76.705_859_752_737_11,
        42.058_693_920_174_77,
        -15.094_641_505_051_456,
        3.819_924_992_114_734_7,
        -0.717_704_341_697_515_5,
        0.100_782_829_076_743_62,
    ],
);

/// sin(½πx)/x as a polynomial in x², for |x| ≤ ½, with an error of 2e-18: the f64 nearest to ½π, the rest of ½π, and
/// the further coefficients.
const SINE_OF_QUARTERS: (f64, [f64; 7]) = (
    std::f64::consts::FRAC_PI_2,
    [
        6.123_233_995_736_766e-17,
        -0.645_964_097_506_243_7,
        0.079_692_626_246_005_88,
        -0.004_681_754_131_700_079,
        0.000_160_441_145_900_492_82,
        -3.598_626_583_771_556_5e-6,
        5.631_753_687_450_119e-8,
    ],
);

/// cos(½πx) as a polynomial in x², for |x| ≤ ½, with an error of 3e-20: 1, and the further coefficients.
const COSINE_OF_QUARTERS: (f64, [f64; 7]) = (
    1.0,
    [
        -1.233_700_550_136_169_7,
        0.253_669_507_901_046_9,
        -0.020_863_480_763_315_442,
        0.000_919_260_274_225_033_1,
        -2.520_203_699_153_615_4e-5,
        4.710_615_657_719_824e-7,
        -6.321_892_451_309_084e-9,
    ],
);

/// sin(πx)/x as a polynomial in x², for |x| ≤ ½, with an error of [`ROUGH_ERROR`] in sin πx.
const ROUGH_SINE_OF_HALVES: [f64; 6] = [
    3.141_592_653_243_753_5,
    -5.167_712_741_221_601,
    2.550_162_794_721_307_2,
    -0.599_247_404_902_618_3,
    0.082_031_230_119_102_22,
    -0.007_000_500_303_568_821,
];

/// cos πx as a polynomial in x², for |x| ≤ ½, with the same error.
const ROUGH_COSINE_OF_HALVES: [f64; 7] = [
    0.999_999_999_999_251_8,
    -4.934_802_200_250_965,
    4.058_712_107_589_434,
    -1.335_262_316_148_792_9,
    0.235_325_443_431_098_32,
    -0.025_776_340_756_994_05,
    0.001_840_021_874_339_118_3,
];

/// 1/5!, -1/7!, … and -1/6!, 1/8!, …: the further terms of sine and cosine, for angles up to π/4.
const SINE: [f64; 7] = [
    1.0 / 120.0,
    -1.0 / 5_040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
    1.0 / 6_227_020_800.0,
    -1.0 / 1_307_674_368_000.0,
    1.0 / 355_687_428_096_000.0,
];
const COSINE: [f64; 7] = [
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
    -1.0 / 87_178_291_200.0,
    1.0 / 20_922_789_888_000.0,
    -1.0 / 6_402_373_705_728_000.0,
];

/// What rounding took from -1/6.
const REST_OF_SIXTH: f64 = -9.251_858_538_542_97e-18;

/// What no error of [`sin_cos_of_half_turn`] exceeded at some ten thousand angles, as a part of the distance between neighbouring
/// f64 at the result. It is measured, and not derived.
pub const HALF_TURN_ERROR: f64 = 0.55;

/// Largest absolute error of [`rough_sin_of_half`] and [`rough_cos_of_half`].
pub const ROUGH_ERROR: f64 = 1.4e-11;

/// The polynomial with these coefficients, the lowest power first, by Horner's scheme, which needs the fewest
/// operations.
#[inline(always)]
fn polynomial<S: Simd, const N: usize>(at: Real<S>, coefficients: [f64; N]) -> Real<S> {
    let mut sum = at.constant(coefficients[N - 1]);
    for coefficient in coefficients[..N - 1].iter().rev() {
        sum = sum.mul_add(at, at.constant(*coefficient));
    }
    sum
}

/// sin 2πx of x = `turns`, for |x| ≤ ¼, with an error of at most 2u, u = 2^-53.
#[inline(always)]
pub fn sin_of_turns<S: Simd>(turns: Real<S>) -> Real<S> {
    let (first, others) = SINE_OF_TURNS;
    turns.mul_add(turns.constant(first), turns * polynomial(turns * turns, others))
}

/// Turns a cosine into a sine: the number of turns x, |x| ≤ ¼ up to the rest, with sin 2πx = cos 2π(`turns` + `rest`).
/// It holds for |`turns`| ≤ [`MOST_TURNS`] and a `rest` that rounding took from `turns`.
#[inline(always)]
pub fn cosine_as_sine<S: Simd>(turns: Real<S>, rest: Real<S>) -> Real<S> {
    let part = turns - turns.round();
    // cos x = sin(π/2 - |x|)
    (turns.constant(0.25) - part.abs()) - rest.times_sign_of(part)
}

/// sin πx for |x| ≤ ½, to [`ROUGH_ERROR`].
#[inline(always)]
pub fn rough_sin_of_half<S: Simd>(x: Real<S>) -> Real<S> {
    x * polynomial(x * x, ROUGH_SINE_OF_HALVES)
}

/// cos πx for |x| ≤ ½, to [`ROUGH_ERROR`].
#[inline(always)]
pub fn rough_cos_of_half<S: Simd>(x: Real<S>) -> Real<S> {
    polynomial(x * x, ROUGH_COSINE_OF_HALVES)
}

/// Sine and cosine of `quarters` + `rest` quarters of a turn, up to a common sign, and n, the whole number nearest to
/// `quarters`. Both signs are right if ⌊n/2⌋ is even, and both are wrong otherwise. Quaternions need
/// no more, since Q and -Q are the same attitude.
#[inline(always)]
pub fn sin_cos_to_sign<S: Simd>(quarters: Real<S>, rest: Real<S>) -> ([Real<S>; 2], Real<S>) {
    let whole = quarters.round();
    let part = (quarters - whole) + rest;
    let square = part * part;
    let (first, others) = SINE_OF_QUARTERS;
    let sin = part.mul_add(part.constant(first), part * polynomial(square, others));
    let (first, others) = COSINE_OF_QUARTERS;
    let cos = square.mul_add(polynomial(square, others), part.constant(first));
    let pairs = (whole * whole.constant(0.5)).round();
    // An odd number of quarters leaves 1 or -1 when pairs are subtracted.
    let is_even = (whole - (pairs + pairs)).abs().at_most(whole.constant(0.0));
    ([is_even.choose(sin, cos), is_even.choose(cos, -sin)], whole)
}

/// Sine and cosine of `quarters` + `rest` quarters of a turn, with an error of at most 2u, for |`quarters`| at most
/// four times [`MOST_TURNS`].
#[inline(always)]
pub fn sin_cos<S: Simd>(quarters: Real<S>, rest: Real<S>) -> [Real<S>; 2] {
    let ([sin, cos], whole) = sin_cos_to_sign(quarters, rest);
    let (half, quarter) = (whole.constant(0.5), whole.constant(0.25));
    // The number of whole pairs of quarters (half turns), and whether it is odd: then both signs change.
    let pairs = (whole.mul_add(half, -quarter)).round();
    let even = (pairs.mul_add(half, -quarter)).round();
    let is_odd = pairs - (even + even);
    let sign = whole.constant(1.0) - (is_odd + is_odd);
    [sign * sin, sign * cos]
}

/// Sine and cosine of an angle from 0 to π (rad), with errors up to [`HALF_TURN_ERROR`] of the distance between neighbouring
/// f64 at the result.
///
/// Less the nearest multiple of π/2, which is subtracted exactly and then with its rest, an angle d + e of at most π/4 is left:
///
/// ```text
/// sin(d + e) = d - d³/6 + (d⁵ (1/5! - d²/7! + …) + e cos d)
/// cos(d + e) = 1 - d²/2 + d⁴/4! - (d⁶ (1/6! - d²/8! + …) + e d)
/// ```
///
/// Of all but the last terms, which are at most 0.003, what their roundings lose is kept.
#[inline(always)]
pub fn sin_cos_of_half_turn<S: Simd>(angle: Real<S>) -> [Real<S>; 2] {
    let (one, half) = (angle.constant(1.0), angle.constant(0.5));
    let quarters = (angle * angle.constant(std::f64::consts::FRAC_2_PI)).round();
    let [first, second, third] = QUARTER;
    let [d, e] = (angle - quarters * angle.constant(first)).sum(-(quarters * angle.constant(second)));
    let e = e - quarters * angle.constant(third);
    let [square, square_rest] = d.product(d);
    let [cube, cube_rest] = square.product(d);
    let cube_rest = square_rest.mul_add(d, cube_rest);
    let [sixth, sixth_rest] = cube.product(angle.constant(-1.0 / 6.0));
    let sixth_rest =
        cube.mul_add(angle.constant(REST_OF_SIXTH), cube_rest.mul_add(angle.constant(-1.0 / 6.0), sixth_rest));
    let [sin, sin_rest] = d.sum(sixth);
    let others = (cube * square).mul_add(polynomial(square, SINE), e * (one - half * square));
    let sin = sin + (sin_rest + (sixth_rest + others));
    let [cos, cos_rest] = one.sum(-(half * square));
    let [fourth, fourth_rest] = square.product(square);
    let fourth_rest = (square + square).mul_add(square_rest, fourth_rest);
    let others = (fourth * square).mul_add(polynomial(square, COSINE), -(e * d));
    let part = angle.constant(1.0 / 24.0);
    let others = fourth.mul_add(part, fourth_rest.mul_add(part, others));
    let cos = cos + (cos_rest + half.mul_add(-square_rest, others));
    let is_one = (quarters - one).abs().less_than(half);
    let is_two = one.less_than(quarters);
    [is_one.choose(cos, is_two.choose(-sin, sin)), is_one.choose(-sin, is_two.choose(-cos, cos))]
}

#[cfg(test)]
mod tests {
    use pulp::Scalar;

    use super::*;
    use crate::UNIT_ROUNDOFF;
    use crate::big::exactly;
    use crate::double_double::DoubleDouble;
    use crate::quantity::Unit;

    const PI: [f64; 2] = [std::f64::consts::PI, 1.224_646_799_147_353_2e-16];

    fn real(value: f64) -> Real<Scalar> {
        Real::splat(Scalar, value)
    }

    fn value(real: Real<Scalar>) -> f64 {
        let mut out = [0.0];
        real.store(&mut out);
        out[0]
    }

    /// Sine and cosine of `x` times `factor` π.
    fn expected(x: f64, factor: f64) -> [f64; 2] {
        let (sin, cos) = ((DoubleDouble::exactly(PI[0]) + PI[1].into()) * (factor * x)).rounded_sin_cos();
        [sin, cos]
    }

    /// Evenly spaced numbers from -`to` to `to`.
    fn interval(to: f64) -> impl Iterator<Item = f64> {
        (-20_000..=20_000).map(move |part| to * f64::from(part) / 20_000.0)
    }

    #[test]
    fn sines_and_cosines_are_right_to_two_roundings() {
        for x in interval(0.25) {
            let error = value(sin_of_turns(real(x))) - expected(x, 2.0)[0];
            assert!(error.abs() <= 2.0 * UNIT_ROUNDOFF, "{x}: {error:e}");
        }
        for x in interval(9.0) {
            let [sin, cos] = sin_cos(real(x), real(0.0)).map(value);
            let errors = [sin - expected(x, 0.5)[0], cos - expected(x, 0.5)[1]];
            assert!(errors.iter().all(|error| error.abs() <= 2.0 * UNIT_ROUNDOFF), "{x}: {errors:?}");
            let ([other_sin, other_cos], _) = sin_cos_to_sign(real(x), real(0.0));
            assert_eq!([value(other_sin).abs(), value(other_cos).abs()], [sin.abs(), cos.abs()]);
            let flipped = [value(other_sin) * sin, value(other_cos) * cos].map(|product| product < 0.0);
            assert!(flipped[0] == flipped[1] || sin * cos == 0.0, "{x}");
        }
    }

    #[test]
    fn after_many_turns_the_rest_of_the_angle_is_taken_into_account() {
        for x in interval(0.5) {
            let (turns, rest) = (1e9 + x, x - ((1e9 + x) - 1e9));
            let cos = value(sin_of_turns(cosine_as_sine(real(turns), real(rest))));
            assert!((cos - expected(x, 2.0)[1]).abs() <= 2.5 * UNIT_ROUNDOFF, "{x}");
            let [sin, cos] = sin_cos(real(4.0 * turns), real(4.0 * rest)).map(value);
            let errors = [sin - expected(x, 2.0)[0], cos - expected(x, 2.0)[1]];
            assert!(errors.iter().all(|error| error.abs() <= 2.5 * UNIT_ROUNDOFF), "{x}: {errors:?}");
        }
    }

    /// The bound is that of the tests of proofs: from 256 digits, over angles of every size and next to each multiple of π/4.
    #[test]
    fn sine_and_cosine_of_half_a_turn_are_right_to_the_last_digit() {
        let pi = std::f64::consts::PI;
        let next_to =
            |angle: f64| (-300..300).map(move |steps: i64| f64::from_bits(angle.to_bits().wrapping_add_signed(steps)));
        let small = (0..1000).map(|power| 2f64.powf(-0.7 * f64::from(power)));
        let even = (0..=6000).map(|part| pi * f64::from(part) / 6000.0);
        let near = [0.25, 0.5, 0.75, 1.0].into_iter().flat_map(|part| next_to(part * pi));
        let angles: Vec<f64> = small.chain(even).chain(near).filter(|angle| *angle <= pi).collect();
        let (mut largest, mut other_than_std) = (0.0_f64, 0);
        for angle in &angles {
            let found = sin_cos_of_half_turn(real(*angle)).map(value);
            let exact = Unit::ONE.times(*angle).sin_cos_in_digits(256);
            for (found, exact) in found.into_iter().zip(exact) {
                let step = (found.abs().next_up() - found.abs()).max(f64::MIN_POSITIVE);
                let error = (exactly(found) - &exact).with_precision(60).value().to_f64().value().abs() / step;
                assert!(error <= HALF_TURN_ERROR, "{angle}: {found} is off by {error} steps");
                largest = largest.max(error);
            }
            other_than_std += usize::from(found != <[f64; 2]>::from(angle.sin_cos()));
        }
        assert!(largest > 0.53, "{largest}");
        println!("{largest}; {other_than_std} of {} are others than those of std", angles.len());
    }

    /// The filter of outcomes relies on the bound. A bound that is too large would make the filter weaker than need be.
    #[test]
    fn the_bound_of_rough_sines_and_cosines_holds_and_is_sharp() {
        let error = |x: f64| {
            let [sin, cos] = expected(x, 1.0);
            (value(rough_sin_of_half(real(x))) - sin).abs().max((value(rough_cos_of_half(real(x))) - cos).abs())
        };
        let largest = interval(0.5).map(error).fold(0.0, f64::max);
        assert!((0.5 * ROUGH_ERROR..=ROUGH_ERROR).contains(&largest), "{largest:e}");
    }
}
