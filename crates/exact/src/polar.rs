//! This file writes a complex curve a cos x + b sin x in polar form, with an argument that is continuous over any
//! number of turns. The Euler angles are such arguments, and plain atan2 would make them jump by 2π.

use std::f64::consts::PI;

use numerics::DoubleDouble;

/// A complex number in polar form. Its argument is stored as `base` + π `half_turns`, so that sums and differences of
/// arguments lose no digits to half turns that cancel.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Polar {
    /// Part of the argument that stays within about a turn (rad).
    pub(crate) base: f64,
    /// Number of half turns, a whole number.
    pub(crate) half_turns: f64,
    /// Radius with a sign: it may be negative.
    pub(crate) radius: f64,
}

impl Polar {
    /// The argument (rad), rounded.
    pub(crate) fn argument(&self) -> f64 {
        (half_turns(self.half_turns) + self.base.into()).hi()
    }
}

/// π times a whole number (rad).
pub(crate) fn half_turns(number: f64) -> DoubleDouble {
    /// π minus the nearest f64.
    const PI_REST: f64 = 1.224_646_799_147_353_2e-16;
    DoubleDouble::product(PI, number) + DoubleDouble::product(PI_REST, number)
}

/// The complex curve `a cos x + b sin x` in polar form, continuous in x.
///
/// The curve is an ellipse about the origin that is traced once as x grows by 2π, so its argument changes by ±π in each
/// half turn. If a and b are parallel, the ellipse is a line through the origin; then the argument is constant and the
/// radius changes its sign.
pub(crate) fn continuous_polar(a: [f64; 2], b: [f64; 2], x: DoubleDouble) -> Polar {
    let ((sin, cos), x) = (x.rounded_sin_cos(), x.hi());
    if let Some((argument, [along_a, along_b])) = flat(a, b) {
        return Polar { base: argument, half_turns: 0.0, radius: along_a * cos + along_b * sin };
    }
    let (re, im) = (a[0] * cos + b[0] * sin, a[1] * cos + b[1] * sin);
    let start = a[1].atan2(a[0]);
    let (sin_start, cos_start) = start.sin_cos();
    let sense = winding(a, b).signum();
    // In the half turn from x = mπ to (m + 1)π the argument runs from start ± mπ to start ± (m + 1)π.
    let half_turns = (x / PI).floor();
    let parity = if half_turns % 2.0 == 0.0 { 1.0 } else { -1.0 };
    let along = parity * (re * cos_start + im * sin_start);
    let across = parity * (sense * (im * cos_start - re * sin_start));
    Polar { base: start + sense * across.max(0.0).atan2(along), half_turns: sense * half_turns, radius: re.hypot(im) }
}

/// For a curve `a cos x + b sin x` that is a line: the argument of the line, and the components of a and b along it.
/// `None` if the curve is an ellipse.
pub(crate) fn flat(a: [f64; 2], b: [f64; 2]) -> Option<(f64, [f64; 2])> {
    if winding(a, b) != 0.0 {
        return None;
    }
    let direction = if a == [0.0; 2] { b } else { a };
    let argument = direction[1].atan2(direction[0]);
    let (sin, cos) = argument.sin_cos();
    Some((argument, [a, b].map(|end| end[0] * cos + end[1] * sin)))
}

/// Signed area of the parallelogram of a and b. Its sign is the sense in which the ellipse is traced.
fn winding(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_continuous_argument_never_jumps() {
        // Ellipses traced in both senses, thin and wide, from different starts.
        for (a, b) in [([1.0, 0.0], [0.2, 0.5]), ([0.3, -0.4], [0.1, -0.9]), ([0.5, 0.5], [-0.5, 1e-3])] {
            let step = 1e-4;
            let mut last = continuous_polar(a, b, 0.0.into()).argument();
            let mut largest = 0.0_f64;
            for i in 1..100_000 {
                let polar = continuous_polar(a, b, (f64::from(i) * step).into());
                let (argument, radius) = (polar.argument(), polar.radius);
                largest = largest.max((argument - last).abs());
                last = argument;
                let (sin, cos) = (f64::from(i) * step).sin_cos();
                assert!((radius * argument.cos() - (a[0] * cos + b[0] * sin)).abs() < 1e-12);
            }
            assert!(largest < 0.2, "jump of {largest} rad for {a:?}, {b:?}");
        }
    }

    #[test]
    fn half_turns_are_accurate_to_twice_the_digits_of_f64() {
        // sin(x) for x the f64 next to π is π - x.
        let rest = half_turns(1e9) - DoubleDouble::product(PI, 1e9);
        assert!((rest.hi() / (1e9 * PI.sin()) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_flat_curve_stays_on_its_line() {
        for (a, b) in [(0.5, -0.3), (0.0, 0.7), (0.4, 0.0)] {
            for x in [0.3, 2.0, 4.0] {
                let polar = continuous_polar([0.6 * a, 0.8 * a], [0.6 * b, 0.8 * b], x.into());
                let along = a * x.cos() + b * x.sin();
                assert!((polar.radius * polar.argument().cos() - 0.6 * along).abs() < 1e-15, "{a} {b} {x}");
                assert!((polar.radius * polar.argument().sin() - 0.8 * along).abs() < 1e-15, "{a} {b} {x}");
            }
        }
    }
}
