//! Sine and cosine of SIMD vectors of angles, for angles given in turns, halves or quarters of a turn. In these units
//! whole turns are subtracted without an error, whereas an angle in radians needs a long multiple of π subtracted.
//!
//! An angle may come with a rest, the part that rounding took from it. What remains after whole turns goes into the
//! polynomial with the least maximum error on its interval (found by the Remez algorithm). Its coefficients are rounded
//! to f64. The first one counts most, so that its rounding error is a coefficient too.

use pulp::Simd;

use super::real::Real;

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

#[cfg(test)]
mod tests {
    use pulp::Scalar;

    use super::*;
    use crate::UNIT_ROUNDOFF;
    use crate::double_double::DoubleDouble;

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
