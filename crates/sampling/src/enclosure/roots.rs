//! The square of the arctangent of a root, which is an analytic function also where the root vanishes:
//!
//! ```text
//! atan(√x)² = x r(x)²,   r(x) = Σ (-x)^k/(2k + 1)     for |x| < 1
//! ```

use numerics::{Ball, Elementary};

use super::series::Series;

/// Terms of the series. For |x| ≤ ¼ the first one left out is below 2^-72 of the sum, also of the second derivative.
const TERMS: u32 = 40;

/// What is left out of r, r' and ½ r'' for |x| ≤ ¼: Σ_{k ≥ 40} ½ k² 4^(2-k)/(2k + 1) < 20 · 4^-38 · (4/3) < 2^-70.
const LEFT_OUT: f64 = 8.470_329_472_543_003e-22; // 2^-70

/// atan(√x)² for a series of order 2 whose constant term is a ball within |x| ≤ ¼, continued to x < 0.
pub(super) fn squared_angle_of_root<const T: usize>(x: &Series<T>) -> Series<T> {
    debug_assert!(Series::<T>::ORDER == 2);
    let at = x.value();
    let number = |value: f64| Ball::new(value, 0.0);
    // r, r' and ½ r'' by Horner's rule, from the last term on.
    let mut sums = [number(0.0); 3];
    for k in (0..TERMS).rev() {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let coefficient = number(sign) / number(f64::from(2 * k + 1));
        sums[2] = sums[2] * at + sums[1];
        sums[1] = sums[1] * at + sums[0];
        sums[0] = sums[0] * at + coefficient;
    }
    let [value, slope, curvature] = sums.map(|sum| sum.widened(LEFT_OUT));
    let nothing = number(0.0);
    let ratio = x.composed(&[value, slope, curvature, nothing, nothing]);
    x.times(&ratio).times(&ratio)
}

#[cfg(test)]
mod tests {
    use numerics::DoubleDouble;

    use super::*;

    #[test]
    fn it_is_the_square_of_the_arctangent_with_its_derivatives() {
        for part in 1..=50 {
            let x = f64::from(part) * 0.005;
            let found = squared_angle_of_root(&Series::<3>::variable(Ball::new(x, 0.0), Ball::new(1.0, 0.0), 0));
            let squared = |x: DoubleDouble| {
                let angle = Elementary::atan2(&x.sqrt(), &DoubleDouble::from(1.0));
                angle * angle
            };
            const STEP: f64 = 1.490_116_119_384_765_6e-8; // 2^-26
            let at = |steps: f64| squared(DoubleDouble::from(x) + DoubleDouble::from(steps * STEP));
            let step = DoubleDouble::from(STEP);
            let [before, here, after] = [at(-1.0), at(0.0), at(1.0)];
            let slope = (after - before) / (step + step);
            let curvature = (after - here - (here - before)) / (step * step);
            let expected = [here, slope, curvature.half()].map(DoubleDouble::hi);
            for ((term, expected), allowed) in
                (0..3).map(|index| found.term(index)).zip(expected).zip([1e-30, 1e-12, 1e-9])
            {
                let off = (term.midpoint() - expected).abs();
                assert!(off <= term.radius() + allowed, "{x}: {off:e} {term:?}");
                assert!(term.radius() < 1e-14, "{x}: {term:?}");
            }
        }
    }

    #[test]
    fn it_is_continued_to_negative_numbers() {
        // atan(i y)² = -artanh(y)²
        let y = 0.4_f64;
        let found = squared_angle_of_root(&Series::<3>::constant(Ball::new(-y * y, 1e-17)));
        assert!((found.value().midpoint() + y.atanh().powi(2)).abs() < 1e-15);
    }
}
