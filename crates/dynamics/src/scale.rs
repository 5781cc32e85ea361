//! The unit of rate in which a motion is computed: a power of two, so that no bit is lost.

use nalgebra::Vector3;

/// The power of two at or below the largest component of `rate` (rad/s); 1 for a rate of zero.
///
/// Dividing by it is exact and leaves a dimensionless rate of the order of 1.
#[inline]
pub fn power_of_two_scale(rate: &Vector3<f64>) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    let largest = rate.amax();
    if largest == 0.0 { 1.0 } else { f64::from_bits(largest.to_bits() & EXPONENT).max(f64::MIN_POSITIVE) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_is_the_leading_power_of_two() {
        for (largest, scale) in [(1.0, 1.0), (60.0, 32.0), (-0.3, 0.25), (1e300, 2f64.powi(996)), (0.0, 1.0)] {
            assert_eq!(power_of_two_scale(&Vector3::new(0.0, largest, 0.0)), scale);
        }
        assert_eq!(power_of_two_scale(&Vector3::new(0.0, 5e-324, 0.0)), f64::MIN_POSITIVE);
    }
}
