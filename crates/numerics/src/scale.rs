//! Powers of two as units. Dividing a vector by one is exact, and leaves components of the order of 1, whose squares do
//! not overflow.

/// The power of two at or below `largest` ≥ 0, the largest absolute component of a vector; 1 for 0.
///
/// Dividing the vector by it is exact and leaves components of the order of 1.
#[inline]
pub fn power_of_two_scale(largest: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    if largest == 0.0 { 1.0 } else { f64::from_bits(largest.to_bits() & EXPONENT).max(f64::MIN_POSITIVE) }
}

/// The mantissa m, 1 ≤ |m| < 2, and the exponent e of a finite `value` = m 2^e; (0, 0) for 0.
#[inline]
pub fn mantissa_and_exponent(value: f64) -> (f64, i32) {
    const FRACTION: u64 = 0x800f_ffff_ffff_ffff;
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    if value == 0.0 {
        return (0.0, 0);
    }
    let subnormal = value.abs() < f64::MIN_POSITIVE;
    let bits = if subnormal { value * 2f64.powi(54) } else { value }.to_bits();
    let biased = i32::try_from(bits >> 52 & 0x7ff).unwrap_or(0);
    (f64::from_bits(bits & FRACTION | ONE), biased - 1023 - if subnormal { 54 } else { 0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_the_leading_power_of_two() {
        for (largest, scale) in [(1.0, 1.0), (60.0, 32.0), (0.3, 0.25), (1e300, 2f64.powi(996)), (0.0, 1.0)] {
            assert_eq!(power_of_two_scale(largest), scale);
        }
        assert_eq!(power_of_two_scale(5e-324), f64::MIN_POSITIVE);
    }

    #[test]
    fn mantissa_and_exponent_give_the_number_back() {
        for value in [1.0, -1.5, 9.81, 1e-300, 1.7e308, 5e-324, -2.2e-308, f64::MIN_POSITIVE] {
            let (mantissa, exponent) = mantissa_and_exponent(value);
            assert!((1.0..2.0).contains(&mantissa.abs()), "{value}: {mantissa}");
            let halves = [exponent / 2, exponent - exponent / 2].map(|half| 2f64.powi(half));
            assert_eq!(mantissa * halves[0] * halves[1], value);
        }
        assert_eq!(mantissa_and_exponent(0.0), (0.0, 0));
    }
}
