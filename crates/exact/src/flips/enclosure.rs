//! A polynomial with a bound that encloses a function on an interval, and what it says of the sign of the function.

use numerics::{Elementary, TaylorModel};

/// Covers the roundings of a few f64 operations, relative to the sizes of what they add up.
const ROUNDINGS: f64 = 16.0 * f64::EPSILON;

/// The most steps of a search for a zero: it ends at the latest where it has come by then.
const MOST_STEPS: u32 = 64;

/// A function of x, |x| ≤ 1, that is within `error` of the polynomial Σ cₖ xᵏ; nothing is known of it if `error` is infinite
/// or NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Enclosure {
    coefficients: [f64; 5],
    error: f64,
}

impl Enclosure {
    /// Of a function of which nothing is known.
    pub(crate) const OF_ANYTHING: Self = Self { coefficients: [0.0; 5], error: f64::INFINITY };

    /// The sign alone, 1 or -1, of a function that has no zero.
    pub(crate) fn of_sign(sign: f64) -> Self {
        Self { coefficients: [sign, 0.0, 0.0, 0.0, 0.0], error: 0.5 }
    }

    /// Of a function whose values are all in a ball.
    pub(crate) fn of_ball<N: Elementary>(ball: &N) -> Self {
        Self::of_model(&TaylorModel::constant(ball.clone()))
    }

    pub(crate) fn of_model<N: Elementary>(model: &TaylorModel<N>) -> Self {
        let (coefficients, error) = model.polynomial();
        let sizes: f64 = coefficients.iter().map(|coefficient| coefficient.abs()).sum();
        let error = error + ROUNDINGS * sizes;
        Self { coefficients, error: if error.is_nan() { f64::INFINITY } else { error } }
    }

    /// How far the function can be from the polynomial.
    pub(crate) fn error(&self) -> f64 {
        self.error
    }

    /// The polynomial at x = 0.
    pub(crate) fn middle(&self) -> f64 {
        self.coefficients[0]
    }

    /// The sign at x = 0, and 0 if it is not known.
    pub(crate) fn sign(&self) -> f64 {
        self.sign_at(0.0)
    }

    /// `sign` times the function, of `sense` times x: both 1 or -1.
    pub(crate) fn facing(self, sign: f64, sense: f64) -> Self {
        let [a, b, c, d, e] = self.coefficients.map(|coefficient| sign * coefficient);
        Self { coefficients: [a, sense * b, c, sense * d, e], ..self }
    }

    /// An x, or 1, up to which the function is positive, and next to where the polynomial is no longer above its error: -1
    /// if it is not from the start.
    ///
    /// With |p''| ≤ M and a step h, p(x + h) ≥ p + p' h - ½ M h². Its root is Newton's near a zero, from this side of it.
    pub(crate) fn positive_up_to(&self) -> f64 {
        let [.., c, d, e] = self.coefficients.map(f64::abs);
        let bend = (2.0 * c + 6.0 * d + 12.0 * e) * (1.0 + ROUNDINGS);
        let mut x = -1.0;
        for _ in 0..MOST_STEPS {
            let [value, slope] = self.value_and_slope(x);
            let step = length_above_0(value - self.error, slope, bend);
            if x + step >= 1.0 {
                return 1.0;
            }
            if step <= 1e-17 {
                break;
            }
            x += step;
        }
        x
    }

    /// The first of some x beyond `from`, at a distance of `nearest` or of some times as much, at which the sign is known, and
    /// the sign.
    pub(crate) fn known_beyond(&self, from: f64, nearest: f64) -> Option<[f64; 2]> {
        const FURTHER: f64 = 4.0;
        let distances =
            std::iter::successors(Some(nearest.max(4.0 * f64::EPSILON)), |distance| Some(FURTHER * distance));
        let places = distances.map(|distance| from + distance).take_while(|x| *x <= 1.0);
        places.map(|x| [x, self.sign_at(x)]).find(|[_, sign]| *sign != 0.0)
    }

    fn sign_at(&self, x: f64) -> f64 {
        let [value, _] = self.value_and_slope(x);
        if value.abs() > self.error { value.signum() } else { 0.0 }
    }

    fn value_and_slope(&self, x: f64) -> [f64; 2] {
        let horner = |[value, slope]: [f64; 2], coefficient: &f64| [value * x + coefficient, slope * x + value];
        self.coefficients.iter().rev().fold([0.0; 2], horner)
    }
}

/// The length over which a function stays positive that has this value and slope, and whose second derivative is at least
/// -`bend`; 0 if the value is not positive.
fn length_above_0(value: f64, slope: f64, bend: f64) -> f64 {
    if value <= 0.0 || value.is_nan() {
        return 0.0;
    }
    // Squares of values next to the smallest f64 would be 0.
    let root = slope.hypot((2.0 * bend).sqrt() * value.sqrt());
    // The factor is for the roundings of this length.
    (1.0 - ROUNDINGS) * if slope > 0.0 { (slope + root) / bend } else { 2.0 * value / (root - slope) }
}

#[cfg(test)]
mod tests {
    use numerics::DoubleDouble;

    use super::*;

    #[test]
    fn a_length_above_0_ends_at_the_root_of_the_parabola_before_it() {
        let exactly = DoubleDouble::from;
        for slope in [0.0, 1e-9, 0.3, 1e9, -1e-9, -0.3, -1e9] {
            for (value, bend) in [(0.5, 1.0), (1e-20, 1.0), (0.7, 1e-3), (1e-9, 0.3)] {
                let length = length_above_0(value, slope, bend);
                let left = |length: f64| {
                    exactly(value) + exactly(slope) * exactly(length)
                        - (exactly(bend) * exactly(length) * exactly(length)).half()
                };
                let [before, after] = [left(length).hi(), left(length * (1.0 + 1e-14)).hi()];
                assert!(before > 0.0 && after < 0.0, "{value} {slope} {bend}: {length:e} {before:e} {after:e}");
            }
        }
        // Of any size: the length is the same.
        let [large, tiny] = [1.0, 1e-300].map(|size| length_above_0(0.3 * size, -0.2 * size, 0.7 * size));
        assert!((large / tiny - 1.0).abs() < 1e-12, "{large} {tiny}");
        assert_eq!([0.0, -1.0, f64::NAN].map(|value| length_above_0(value, 1.0, 1.0)), [0.0; 3]);
        assert_eq!(length_above_0(1.0, 0.0, 0.0), f64::INFINITY);
    }

    /// (x - first)(x - second) and so on, which is 0 there alone.
    fn with_zeros(zeros: &[f64]) -> [f64; 5] {
        zeros.iter().fold([1.0, 0.0, 0.0, 0.0, 0.0], |[a, b, c, d, e], zero| {
            [-zero * a, a - zero * b, b - zero * c, c - zero * d, d - zero * e]
        })
    }

    #[test]
    fn a_function_is_positive_up_to_its_first_zero_and_known_beyond_it() {
        for (zeros, sign) in
            [(&[0.3][..], -1.0), (&[-0.5, 0.7], 1.0), (&[-0.9, -0.1, 0.2], -1.0), (&[0.2, 0.5, 0.6, 0.9], 1.0)]
        {
            for error in [1e-13, 1e-9, 1e-5] {
                let of_zeros = Enclosure { coefficients: with_zeros(zeros), error }.facing(sign, 1.0);
                let found = of_zeros.positive_up_to();
                let off = zeros[0] - found;
                assert!(off > 0.0 && off < 200.0 * error + 1e-12, "{zeros:?} {error}: {found}");
                let known = of_zeros.known_beyond(found, 1e-12).unwrap_or_else(|| panic!("{zeros:?} {error}"));
                assert!(known[0] > zeros[0] && known[0] < zeros[0] + 2e3 * error && known[1] == -1.0, "{known:?}");
                // From the other end the last zero is the first.
                let back = Enclosure { coefficients: with_zeros(zeros), error }.facing(1.0, -1.0).positive_up_to();
                assert!(-back > zeros[zeros.len() - 1] && -back < zeros[zeros.len() - 1] + 200.0 * error + 1e-12);
            }
        }
    }

    #[test]
    fn a_touch_is_passed_by_the_error_alone() {
        let touch = |error: f64| Enclosure { coefficients: [0.0, 0.0, 1.0, 0.0, 0.0], error };
        for error in [1e-6, 1e-16] {
            let found = touch(error).positive_up_to();
            assert!(found < -(1.0 - 1e-12) * error.sqrt() && found > -1.1 * error.sqrt(), "{found:e}");
            let [known, sign] = touch(error).known_beyond(found, 1e-12).unwrap();
            assert!(known > error.sqrt() && known < 8.0 * error.sqrt() && sign == 1.0, "{known:e}");
        }
        let above = Enclosure { coefficients: [1e-3, 0.0, 1.0, 0.0, 0.0], error: 0.99e-3 };
        assert_eq!(above.positive_up_to(), 1.0);
    }

    #[test]
    fn of_anything_nothing_is_known() {
        for nothing in [Enclosure::OF_ANYTHING, Enclosure { coefficients: [f64::NAN; 5], error: 0.0 }] {
            assert_eq!((nothing.positive_up_to(), nothing.sign(), nothing.known_beyond(-1.0, 0.1)), (-1.0, 0.0, None));
        }
        for sign in [1.0, -1.0] {
            let known = Enclosure::of_sign(sign);
            assert_eq!((known.sign(), known.facing(sign, 1.0).positive_up_to()), (sign, 1.0));
        }
    }
}
