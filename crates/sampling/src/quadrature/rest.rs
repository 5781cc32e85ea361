//! This file has the coordinates that quadrature integrates over: those that vary beside the speed, with their densities.
//!
//! The outcome of a launch from horizontal depends on ωx and ωy by Ω = √(ωx² + ωy²) alone. Where both are uniform, the density
//! of Ω is known in closed form, and one coordinate takes the place of two:
//!
//! ```text
//! density of Ω = Ω α(Ω)/area,   α(Ω) the angle of the circle of radius Ω inside the rectangle of (ωx, ωy)
//! ```

use std::f64::consts::{FRAC_PI_2, TAU};

use super::line::Parts;
use crate::axis::{Axis, Distribution, NORMAL_REACH};
use crate::coordinate::Coordinate::{self, RateX, RateY, Speed, Tilt};
use crate::space::Space;

/// A coordinate that is integrated over.
#[derive(Debug, Clone)]
pub(super) struct Rest {
    /// The coordinate that takes its values.
    pub(super) of: Coordinate,
    /// The parts of its range between which its density has no kink.
    pub(super) parts: Parts,
    density: Density,
}

#[derive(Debug, Clone)]
enum Density {
    Axis(Distribution),
    /// Of Ω, as the sum over rectangles in the first quadrant.
    Across(Vec<Rectangle>),
}

/// A part of the plane (|ωx|, |ωy|) with a probability density.
#[derive(Debug, Clone, Copy)]
struct Rectangle {
    x: [f64; 2],
    y: [f64; 2],
    /// The densities of |ωx| and of |ωy|, whose product could overflow.
    densities: [f64; 2],
}

/// The coordinates of `space` that vary beside the speed, as few as possible.
pub(super) fn rest_of(space: &Space) -> Vec<Rest> {
    let free: Vec<Coordinate> = space.free().filter(|of| *of != Speed).collect();
    let uniform = |of: Coordinate| match space.axis(of).distribution() {
        Distribution::Uniform { lo, hi } => Some([lo, hi]),
        Distribution::Normal { .. } => None,
    };
    let is_tied = |of: &Coordinate| space.place(*of) != *of;
    let is_horizontal = space.axis(Tilt).value() == Some(0.0) && !Coordinate::ALL.iter().any(is_tied);
    let alone = |of: &Coordinate| Rest::of_axis(*of, space.axis(*of));
    if is_horizontal
        && free.starts_with(&[RateX, RateY])
        && let (Some(x), Some(y)) = (uniform(RateX), uniform(RateY))
    {
        return std::iter::once(Rest::across(x, y)).chain(free[2..].iter().map(alone)).collect();
    }
    free.iter().map(alone).collect()
}

impl Rest {
    fn of_axis(of: Coordinate, axis: Axis) -> Self {
        let distribution = axis.distribution();
        let ends = match distribution {
            Distribution::Uniform { lo, hi } => vec![lo, hi],
            // A normal distribution has most of its weight in the middle.
            Distribution::Normal { mean, sd } => {
                [-NORMAL_REACH, -4.5, -2.0, 0.0, 2.0, 4.5, NORMAL_REACH].map(|part| mean + part * sd).to_vec()
            }
        };
        Self { of, parts: Parts { ends, are_roots: false }, density: Density::Axis(distribution) }
    }

    /// Ω, for ωx uniform over `x` and ωy over `y`.
    fn across(x: [f64; 2], y: [f64; 2]) -> Self {
        let mut rectangles = Vec::new();
        for (x, density_x) in folded(x) {
            for (y, density_y) in folded(y) {
                rectangles.push(Rectangle { x, y, densities: [density_x, density_y] });
            }
        }
        let least = rectangles.iter().map(|of| of.x[0].hypot(of.y[0])).fold(f64::INFINITY, f64::min);
        let most = rectangles.iter().map(|of| of.x[1].hypot(of.y[1])).fold(0.0, f64::max);
        // The angle has a kink where the circle meets a corner, and a square root where it touches a side.
        let mut ends: Vec<f64> =
            rectangles.iter().flat_map(Rectangle::radii).filter(|at| (least..=most).contains(at)).collect();
        ends.sort_unstable_by(f64::total_cmp);
        ends.dedup_by(|one, other| *one - *other <= 1e-9 * (most - least));
        Self { of: RateX, parts: Parts { ends, are_roots: true }, density: Density::Across(rectangles) }
    }

    /// Whether the other rate across the normal is 0, because this coordinate takes the place of both.
    pub(super) fn is_across(&self) -> bool {
        matches!(self.density, Density::Across(_))
    }

    /// Whether f64 has enough numbers within the range to integrate over them.
    pub(super) fn is_resolved(&self) -> bool {
        const NARROWEST: f64 = 1e-9;
        let [lo, hi] = self.bounds();
        hi - lo > NARROWEST * lo.abs().max(hi.abs())
    }

    /// The smallest and the largest value.
    pub(super) fn bounds(&self) -> [f64; 2] {
        [self.parts.ends[0], self.parts.ends[self.parts.ends.len() - 1]]
    }

    /// The probability density at a value.
    pub(super) fn density(&self, value: f64) -> f64 {
        match &self.density {
            Density::Axis(Distribution::Uniform { lo, hi }) => 1.0 / (hi - lo),
            Density::Axis(Distribution::Normal { mean, sd }) => {
                let reduced = (value - mean) / sd;
                (-0.5 * reduced * reduced).exp() / (sd * TAU.sqrt())
            }
            Density::Across(rectangles) => rectangles.iter().map(|of| of.density(value)).sum(),
        }
    }
}

/// The ranges of the absolute value of a number that is uniform over a range, with their densities.
fn folded([lo, hi]: [f64; 2]) -> Vec<([f64; 2], f64)> {
    let density = 1.0 / (hi - lo);
    let (near, far) = (lo.abs().min(hi.abs()), lo.abs().max(hi.abs()));
    if lo >= 0.0 || hi <= 0.0 {
        return vec![([near, far], density)];
    }
    [([0.0, near], 2.0 * density), ([near, far], density)].into_iter().filter(|([lo, hi], _)| lo < hi).collect()
}

impl Rectangle {
    /// The radii of the circles through its corners and along its sides.
    fn radii(&self) -> impl Iterator<Item = f64> {
        let Self { x, y, .. } = *self;
        let corners = [x[0].hypot(y[0]), x[0].hypot(y[1]), x[1].hypot(y[0]), x[1].hypot(y[1])];
        corners.into_iter().chain(x).chain(y)
    }

    /// The density of the radius.
    fn density(&self, radius: f64) -> f64 {
        (self.densities[0] * radius) * (self.densities[1] * self.angle(radius))
    }

    /// The angle (rad) of the circle of this radius that lies inside.
    fn angle(&self, radius: f64) -> f64 {
        let [cos, sin] = [self.x, self.y].map(|side| side.map(|end| (end / radius).min(1.0)));
        let from = cos[1].acos().max(sin[0].asin());
        let to = cos[0].acos().min(sin[1].asin()).min(FRAC_PI_2);
        (to - from).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angle_of_a_circle_in_a_rectangle_matches_counted_directions() {
        for (x, y) in [
            ([1.0, 60.0], [1.0, 60.0]),
            ([-20.0, 30.0], [-5.0, 5.0]),
            ([-9.0, -1.0], [2.0, 3.0]),
            ([0.0, 1.0], [-4.0, 4.0]),
        ] {
            let rest = Rest::across(x, y);
            let [least, most] = rest.bounds();
            for part in 1..20 {
                let radius = least + (most - least) * f64::from(part) / 20.0;
                const DIRECTIONS: u32 = 100_000;
                let inside = (0..DIRECTIONS).filter(|direction| {
                    let (sin, cos) = (TAU * (f64::from(*direction) + 0.5) / f64::from(DIRECTIONS)).sin_cos();
                    (x[0]..=x[1]).contains(&(radius * cos)) && (y[0]..=y[1]).contains(&(radius * sin))
                });
                let angle = TAU * inside.count() as f64 / f64::from(DIRECTIONS);
                let expected = radius * angle / ((x[1] - x[0]) * (y[1] - y[0]));
                assert!(
                    (rest.density(radius) - expected).abs() < 1e-3 * radius / ((x[1] - x[0]) * (y[1] - y[0])),
                    "{x:?} {y:?} {radius}"
                );
            }
        }
    }
}
