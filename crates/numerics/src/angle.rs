//! Sine and cosine of angles as they were given, to 2^-68 and beyond.
//!
//! std's sine and cosine are right to some 2^-53. A proof that starts from an angle needs more of it: the vertical seen
//! from a tilted coin is made of the sine and cosine of the tilt.

use crate::big::{Big, exactly};
use crate::double_double::DoubleDouble;
use crate::quantity::{Quantity, Unit};
use crate::scale::mantissa_and_exponent;

/// π/2 in three parts, to 2^-163.
pub(crate) const QUARTER: [f64; 3] =
    [std::f64::consts::FRAC_PI_2, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33];

/// Largest angle that is reduced in double-double (rad).
const LARGEST: f64 = 1_048_576.0;

/// Sine and cosine of 0, 1/16, 2/16, ... up to the first above π/4.
#[rustfmt::skip]
const SIXTEENTHS: [[[f64; 2]; 2]; 14] = [
    [[0.0, 0.0], [1.0, 0.0]],
    [[0.062_459_317_842_380_2, -2.040_259_504_585_711e-18], [0.998_047_510_700_099_1, 3.323_229_167_414_134_6e-17]],
    [[0.124_674_733_385_227_69, -2.925_947_496_057_858e-18], [0.992_197_667_229_329, 4.754_870_575_189_364e-17]],
    [[0.186_403_296_762_269_88, 2.349_379_690_128_157_3e-18], [0.982_473_313_101_255_3, -3.919_920_375_420_088e-17]],
    [[0.247_403_959_254_522_94, -7.531_024_955_907_06e-18], [0.968_912_421_710_644_7, 5.071_436_662_403_936e-17]],
    [[0.307_438_514_580_380_85, 1.100_436_644_276_529_6e-19], [0.951_567_948_048_172_2, -3.861_483_467_567_412_3e-17]],
    [[0.366_272_529_086_047_57, -9.938_814_562_106_524e-18], [0.930_507_621_912_314_3, 4.488_760_003_328_074e-18]],
    [[0.423_676_257_203_938_03, -2.331_800_700_068_871e-17], [0.905_813_683_425_936_4, 4.286_466_649_080_521_4e-17]],
    [[0.479_425_538_604_203, -5.103_969_860_556_013e-18], [0.877_582_561_890_372_8, -4.262_314_986_427_999_7e-17]],
    [[0.533_302_673_536_020_1, 5.129_318_115_032_044e-17], [0.845_924_499_231_067_9, 1.549_506_647_350_329e-17]],
    [[0.585_097_272_940_462_2, -5.488_397_246_116_180_5e-17], [0.810_963_119_505_217_9, -3.091_333_486_122_179e-17]],
    [[0.634_607_080_015_269_3, -3.456_858_239_262_496_5e-17], [0.772_834_946_152_471_5, 4.231_014_921_891_023e-17]],
    [[0.681_638_760_023_334_1, 4.410_467_313_197_903e-17], [0.731_688_868_873_820_9, -1.047_582_430_651_276_8e-17]],
    [[0.726_008_655_260_712_6, -1.573_621_815_339_587e-17], [0.687_685_562_220_504_8, 3.543_069_675_282_392_3e-17]],
];

/// Of an angle.
impl Quantity {
    /// Sine and cosine to 2^-68, whatever the angle.
    #[inline]
    pub fn sin_cos(self) -> [DoubleDouble; 2] {
        let angle = self.double_double();
        if angle.hi().abs() <= LARGEST {
            return sin_cos(angle);
        }
        self.sin_cos_in_digits(256).map(|part| DoubleDouble::nearest(&part))
    }

    /// Sine and cosine to so many binary digits after the point, at least 80. They are 0 only where they are exactly 0.
    /// Panics for an angle that is not finite.
    pub fn sin_cos_in_digits(self, digits: usize) -> [Big; 2] {
        let (digits, unit) = (digits.max(80), self.unit());
        let (sin, cos) = if unit.is_of_turn() {
            let product = exactly(self.value()) * exactly(unit.numerator().into());
            product.with_precision(digits).value().sin_cos_unit(unit.denominator() as usize)
        } else {
            // Of a quotient, the digits before the point are needed besides.
            let (_, exponent) = mantissa_and_exponent(self.value());
            let whole_digits = usize::try_from(exponent).unwrap_or(0) + 64;
            self.in_digits(if unit == Unit::ONE { digits } else { digits + whole_digits }).sin_cos()
        };
        [sin, cos].map(|part| part.with_precision(digits).value())
    }
}

#[inline]
fn double_double([hi, lo]: [f64; 2]) -> DoubleDouble {
    DoubleDouble::exactly(hi) + lo.into()
}

/// Sine and cosine of an angle up to [`LARGEST`] (rad) to 2^-68.
///
/// Less the nearest multiple of π/2 and then of 1/16, an angle d of at most 1/32 is left, and
///
/// ```text
/// sin(a + d) = sin a + (sin a (cos d - 1) + cos a sin d)
/// cos(a + d) = cos a + (cos a (cos d - 1) - sin a sin d)
/// ```
///
/// The leading terms of sin d and cos d - 1 are taken in double-double, the others, of at most 5.1e-6, in f64.
#[inline]
fn sin_cos(angle: DoubleDouble) -> [DoubleDouble; 2] {
    let (rest, quarters) = angle.less_quarters();
    sin_cos_of_parts(rest, quarters, |d| {
        let square = d * d;
        let s = square.hi();
        let sin = d.hi() * s * (-1.0 / 6.0 + s * (1.0 / 120.0 + s * (-1.0 / 5040.0 + s * (1.0 / 362_880.0))));
        let cos = s * s * (1.0 / 24.0 + s * (-1.0 / 720.0 + s * (1.0 / 40_320.0 - s / 3_628_800.0)));
        [d + sin.into(), -square.half() + cos.into()]
    })
}

/// Sine and cosine of `rest` and so many quarters of a turn, where `small` has sin d and cos d - 1 of an angle up to 1/32.
#[inline]
pub(crate) fn sin_cos_of_parts(
    rest: DoubleDouble,
    quarters: f64,
    small: impl Fn(DoubleDouble) -> [DoubleDouble; 2],
) -> [DoubleDouble; 2] {
    let sixteenths = (16.0 * rest.hi()).round_ties_even();
    let [sin_d, cos_d_less_1] = small(rest - (0.0625 * sixteenths).into());
    let [sin_a, cos_a] = SIXTEENTHS[sixteenths.abs().min(13.0) as usize].map(double_double);
    let sin_a = if sixteenths < 0.0 { -sin_a } else { sin_a };
    let sin = sin_a + (sin_a * cos_d_less_1 + cos_a * sin_d);
    let cos = cos_a + (cos_a * cos_d_less_1 - sin_a * sin_d);
    match quarters.rem_euclid(4.0) {
        0.0 => [sin, cos],
        1.0 => [cos, -sin],
        2.0 => [-sin, -cos],
        _ => [-cos, sin],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(value: f64) -> Quantity {
        Unit::DEGREE.times(value)
    }

    /// Against sine and cosine in 300 bits, of the angle as it was given.
    #[track_caller]
    fn assert_right(angle: Quantity) {
        let exact = angle.sin_cos_in_digits(300);
        for (found, exact) in angle.sin_cos().into_iter().zip(exact) {
            let error = (exactly(found.hi()) + exactly(found.lo()) - exact).to_f64().value().abs();
            assert!(error <= 2f64.powi(-68), "{angle:?} is off by 2^{}", error.log2());
        }
    }

    #[test]
    fn sines_and_cosines_are_right_to_68_digits() {
        for index in 0..2000 {
            let part = 2.0 * (f64::from(index) * 2f64.sqrt()).fract() - 1.0;
            assert_right((4.0 * part).into());
            assert_right((part * 10f64.powi(index % 24 - 17)).into());
            assert_right(degrees(400.0 * part));
        }
        for multiple in -40..=40 {
            let (quarters, sixteenths) = (f64::from(multiple) * QUARTER[0], f64::from(multiple) / 16.0);
            for angle in [quarters, sixteenths, sixteenths + 0.03125, quarters / 2.0] {
                [angle.next_down(), angle, angle.next_up()].into_iter().for_each(|angle| assert_right(angle.into()));
            }
            assert_right(degrees(15.0 * f64::from(multiple)));
        }
        for angle in [0.0, 5e-324, LARGEST, LARGEST.next_up(), 1e22, 1e300, f64::MAX, -1e17] {
            assert_right(angle.into());
            assert_right(degrees(angle));
            assert_right(Unit::ratio(7, 1000).unwrap().times(angle));
        }
    }

    /// Of 60 000/7 rad the digits before the point are 14, of which the value has none.
    #[test]
    fn sines_of_a_quotient_have_the_digits_that_were_asked_for() {
        for (value, digits) in [0.9, -1e-3, 5e4, 1e300].into_iter().flat_map(|value| [(value, 80_u16), (value, 200)]) {
            let angle = Unit::ratio(60_000, 7).unwrap().times(value);
            let exact = angle.sin_cos_in_digits(1500);
            for (found, exact) in angle.sin_cos_in_digits(digits.into()).into_iter().zip(exact) {
                let error = (found.with_precision(1600).value() - exact).to_f64().value().abs();
                assert!(error <= 2f64.powi(2 - i32::from(digits)), "{angle:?} is off by 2^{}", error.log2());
            }
        }
    }

    /// There the series of cos d counts alone, to its last term, which is 2^-71.8 at an angle of 1/32.
    #[test]
    fn cosines_of_small_angles_are_right_to_74_digits() {
        for index in -64..=64 {
            let angle = Quantity::from(f64::from(index) / 2048.0);
            let ([_, cos], [_, exact]) = (angle.sin_cos(), angle.sin_cos_in_digits(300));
            let error = (exactly(cos.hi()) + exactly(cos.lo()) - exact).to_f64().value().abs();
            assert!(error <= 2f64.powi(-74), "{angle:?} is off by 2^{}", error.log2());
        }
    }

    #[test]
    fn only_quarters_of_a_turn_have_a_sine_or_cosine_of_0() {
        let zero = exactly(0.0);
        assert_eq!(degrees(90.0).sin_cos_in_digits(80), [exactly(1.0), zero.clone()]);
        assert_eq!(degrees(-450.0).sin_cos_in_digits(80), [exactly(-1.0), zero.clone()]);
        assert_eq!(degrees(180.0).sin_cos_in_digits(80), [zero.clone(), exactly(-1.0)]);
        for angle in [degrees(90f64.next_up()), QUARTER[0].into(), 1e300.into(), 5e-324.into()] {
            assert!(angle.sin_cos_in_digits(80).iter().all(|part| *part != zero), "{angle:?}");
        }
        assert!(degrees(0.0).sin_cos_in_digits(80)[0] == zero);
    }

    #[test]
    fn radians_are_the_nearest_f64() {
        assert_eq!(degrees(180.0).to_f64(), std::f64::consts::PI);
        assert_eq!(Quantity::from(0.1).to_f64(), 0.1);
        assert_eq!(Unit::TURN.times(1e300).to_f64(), 1e300 * std::f64::consts::TAU);
        // Up to this size the second part is kept.
        assert_ne!(Unit::TURN.times(1e290).double_double().lo(), 0.0);
        assert_eq!(Unit::TURN.times(f64::MAX).to_f64(), f64::INFINITY);
    }
}
