//! The coordinates that an enclosure divides into cells: each is a function of a parameter s from 0 to 1, with a density.
//!
//! ```text
//! uniform      x = lo + s (hi - lo)          density of s: 1
//! normal       x = lo + s (hi - lo)          (hi - lo) exp(-½((x - mean)/sd)²)/(sd √(2π))
//! ωx and ωy    Ω = p + s² (q - p)            2 s (q - p) Ω α(Ω)/area
//! ```
//!
//! The outcome of a launch from horizontal depends on ωx and ωy by Ω = √(ωx² + ωy²) alone. Where both are uniform, one
//! coordinate takes the place of two: α(Ω) is the angle of the circle of radius Ω inside the rectangle of (ωx, ωy). Between the
//! radii of the corners and of the sides, p and q, α is a difference of two arcs. Each begins like a root at the circle that
//! touches its side, which s² undoes.

use numerics::{Ball, Big, Elementary};

use crate::axis::{Axis, Distribution, NORMAL_REACH};
use crate::coordinate::Coordinate::{self, RateX, RateY, Tilt};
use crate::space::Space;

use super::series::Series;

/// A number as it was typed, in whatever unit: its nearest f64 in the SI unit is right to u, and 0 is 0.
pub(super) fn as_given(value: f64) -> Ball<f64> {
    Ball::new(value, value.abs() * f64::EPSILON)
}

/// A part of a coordinate's range, on which its value and its density are smooth functions of s.
#[derive(Debug, Clone)]
pub(super) struct Direction {
    /// The coordinate that takes its values.
    pub(super) of: Coordinate,
    ends: [Ball<f64>; 2],
    kind: Kind,
}

#[derive(Debug, Clone)]
enum Kind {
    Uniform,
    Normal { mean: Ball<f64>, sd: Ball<f64> },
    Across(Vec<Arc>),
}

/// The part of the circle of radius Ω in the first quadrant that lies inside a rectangle: between two angles, of which each
/// is that of the side x = `side` (its arc cosine) or y = `side` (its arc sine).
#[derive(Debug, Clone, Copy)]
struct Arc {
    from: Side,
    to: Side,
    /// The product of the densities of |ωx| and |ωy|.
    density: Ball<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Side {
    at: f64,
    is_x: bool,
}

/// A rectangle of the plane (|ωx|, |ωy|) with its density.
#[derive(Debug, Clone, Copy)]
struct Rectangle {
    x: [f64; 2],
    y: [f64; 2],
    density: Ball<f64>,
}

/// The coordinates that vary besides the speed, as few as possible: for each of them the parts of its range. With a bound of what
/// the roundings of the ends of ωx and ωy change in a probability, where one coordinate takes the place of both.
pub(super) fn directions_of(space: &Space) -> (Vec<Vec<Direction>>, f64) {
    let free: Vec<Coordinate> = space.free().filter(|of| *of != Coordinate::Speed).collect();
    let alone = |of: &Coordinate| vec![Direction::of_axis(*of, space.axis(*of))];
    let is_tied = |of: &Coordinate| space.place(*of) != *of;
    let is_horizontal = space.axis(Tilt).value() == Some(0.0) && !Coordinate::ALL.iter().any(is_tied);
    let is_wide = |of: &Coordinate| relative_rounding(space.axis(*of)) < 1e-14;
    if is_horizontal
        && free.starts_with(&[RateX, RateY])
        && free[..2].iter().all(is_wide)
        && let Some(across) = Direction::across(space.axis(RateX), space.axis(RateY))
    {
        let roundings = 2.0 * (relative_rounding(space.axis(RateX)) + relative_rounding(space.axis(RateY)));
        return (std::iter::once(across).chain(free[2..].iter().map(alone)).collect(), roundings);
    }
    (free.iter().map(alone).collect(), 0.0)
}

/// The rounding of the ends of a range in parts of its length. A probability changes by no more if an end moves by as much.
fn relative_rounding(axis: Axis) -> f64 {
    let [lo, hi] = axis.bounds();
    (lo.abs() + hi.abs()) * f64::EPSILON / (hi - lo)
}

impl Direction {
    fn of_axis(of: Coordinate, axis: Axis) -> Self {
        match axis.distribution() {
            Distribution::Uniform { lo, hi } => Self { of, ends: [lo, hi].map(as_given), kind: Kind::Uniform },
            Distribution::Normal { mean, sd } => {
                let (mean, sd) = (as_given(mean), as_given(sd));
                let reach = sd * Ball::new(NORMAL_REACH, 0.0);
                Self { of, ends: [mean - reach, mean + reach], kind: Kind::Normal { mean, sd } }
            }
        }
    }

    /// Ω, for ωx and ωy uniform over ranges; `None` for other distributions, and where f64 cannot tell two radii apart.
    fn across(x: Axis, y: Axis) -> Option<Vec<Self>> {
        let [Distribution::Uniform { lo: x_lo, hi: x_hi }, Distribution::Uniform { lo: y_lo, hi: y_hi }] =
            [x, y].map(|axis| axis.distribution())
        else {
            return None;
        };
        let mut rectangles = Vec::new();
        for (x, x_density) in folded([x_lo, x_hi]) {
            for (y, y_density) in folded([y_lo, y_hi]) {
                rectangles.push(Rectangle { x, y, density: x_density * y_density });
            }
        }
        // By the exact squares of the radii, so that none is taken for another.
        let squared = |[x, y]: [f64; 2]| {
            let [x, y] = [x, y].map(numerics::big::exactly);
            x.clone() * x + y.clone() * y
        };
        let mut radii: Vec<([f64; 2], Big)> =
            rectangles.iter().flat_map(Rectangle::points).map(|point| (point, squared(point))).collect();
        radii.sort_by(|one, other| one.1.cmp(&other.1));
        radii.dedup_by(|one, other| one.1 == other.1);
        let radii: Vec<Ball<f64>> = radii.into_iter().map(|(point, _)| radius(point)).collect();
        let pieces = radii.windows(2).map(|ends| {
            let [from, to] = [ends[0], ends[1]];
            let middle = (from + to).halved();
            let arcs: Option<Vec<Option<Arc>>> = rectangles.iter().map(|of| of.arc(&middle)).collect();
            let arcs: Vec<Arc> = arcs?.into_iter().flatten().collect();
            Some(Self { of: RateX, ends: [from, to], kind: Kind::Across(arcs) })
        });
        let pieces: Option<Vec<Self>> = pieces.collect();
        Some(
            pieces?.into_iter().filter(|piece| !matches!(&piece.kind, Kind::Across(arcs) if arcs.is_empty())).collect(),
        )
    }

    /// Whether ωy is 0, because this coordinate takes the place of both.
    pub(super) fn is_across(&self) -> bool {
        matches!(self.kind, Kind::Across(_))
    }

    /// The value, and the density of s where it is not 1.
    pub(super) fn at(&self, s: &Series<5>) -> (Series<5>, Option<Series<5>>) {
        let [lo, hi] = self.ends;
        let length = hi - lo;
        let along = |s: &Series<5>| s.scaled(&length) + Series::constant(lo);
        match &self.kind {
            Kind::Uniform => (along(s), None),
            Kind::Normal { mean, sd } => {
                let value = along(s);
                let reduced = (value - Series::constant(*mean)).scaled(&(Ball::new(1.0, 0.0) / *sd));
                let root = (sd.pi() + sd.pi()).sqrt();
                let height = length / (*sd * root);
                (value, Some((reduced * reduced).scaled(&Ball::new(-0.5, 0.0)).exp().scaled(&height)))
            }
            Kind::Across(arcs) => {
                let radius = along(&s.times(s));
                let angle = |side: &Side| {
                    if side.at == 0.0 {
                        let angle = if side.is_x { lo.pi().halved() } else { lo.like(0.0) };
                        return Series::constant(angle);
                    }
                    // √(Ω² - side²), which has no root at the circle that touches the side.
                    let at = Series::constant(Ball::new(side.at, 0.0));
                    let other = if lo == Ball::new(side.at, 0.0) {
                        s.times(&(radius + at).scaled(&length).sqrt())
                    } else {
                        ((radius - at) * (radius + at)).sqrt()
                    };
                    if side.is_x { other.atan2(&at) } else { at.atan2(&other) }
                };
                let zero = Series::constant(Ball::new(0.0, 0.0));
                let sum =
                    arcs.iter().fold(zero, |sum, arc| sum + (angle(&arc.to) - angle(&arc.from)).scaled(&arc.density));
                (radius, Some((radius.times(s) * sum).scaled(&(length + length))))
            }
        }
    }
}

/// The ranges of the absolute value of a number that is uniform over a range, with their densities.
fn folded([lo, hi]: [f64; 2]) -> Vec<([f64; 2], Ball<f64>)> {
    let density = Ball::new(1.0, 0.0) / (Ball::new(hi, 0.0) - Ball::new(lo, 0.0));
    let (near, far) = (lo.abs().min(hi.abs()), lo.abs().max(hi.abs()));
    if lo >= 0.0 || hi <= 0.0 {
        return vec![([near, far], density)];
    }
    [([0.0, near], density + density), ([near, far], density)].into_iter().filter(|([lo, hi], _)| lo < hi).collect()
}

fn radius([x, y]: [f64; 2]) -> Ball<f64> {
    if x == 0.0 || y == 0.0 {
        return Ball::new(x.max(y), 0.0);
    }
    let [x, y] = [x, y].map(|part| Ball::new(part, 0.0));
    (x * x + y * y).sqrt()
}

impl Rectangle {
    /// The corners, and where circles touch the sides.
    fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        let Self { x, y, .. } = *self;
        let corners = [[x[0], y[0]], [x[0], y[1]], [x[1], y[0]], [x[1], y[1]]];
        let touching = [[x[0], 0.0], [x[1], 0.0], [0.0, y[0]], [0.0, y[1]]];
        let least = radius(corners[0]).to_f64();
        corners.into_iter().chain(touching.into_iter().filter(move |point| point[0].max(point[1]) > least))
    }

    /// The part inside of the circles of about this `radius`: `Some(None)` if there is none, `None` if that is not known.
    fn arc(&self, radius: &Ball<f64>) -> Option<Option<Arc>> {
        let Self { x: [left, right], y: [bottom, top], density } = *self;
        // Whether the circle passes beyond a corner.
        let is_beyond = |x: f64, y: f64| {
            let [x, y] = [x, y].map(|part| Ball::new(part, 0.0));
            let difference = *radius * *radius - (x * x + y * y);
            difference.has_sign().then(|| difference.sign() > 0.0)
        };
        if !is_beyond(left, bottom)? || is_beyond(right, top)? {
            return Some(None);
        }
        let from =
            if is_beyond(right, bottom)? { Side { at: right, is_x: true } } else { Side { at: bottom, is_x: false } };
        let to = if is_beyond(left, top)? { Side { at: top, is_x: false } } else { Side { at: left, is_x: true } };
        Some(Some(Arc { from, to, density }))
    }
}

#[cfg(test)]
mod tests {
    use dynamics::Coin;

    use super::*;

    const POINTS: u32 = 200;

    /// The sums of the density, and of the density times the square of the value, over all parts of a coordinate.
    fn sums(parts: &[Direction]) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for part in parts {
            for point in 0..POINTS {
                let s = (f64::from(point) + 0.5) / f64::from(POINTS);
                let (value, density) = part.at(&Series::constant(Ball::new(s, 0.0)));
                let density = density.map_or(1.0, |density| *density.value().midpoint()) / f64::from(POINTS);
                sums[0] += density;
                sums[1] += density * value.value().midpoint().powi(2);
            }
        }
        sums
    }

    /// The mean of the square is that of the distribution.
    fn mean_square(axis: Axis) -> f64 {
        match axis.distribution() {
            Distribution::Uniform { lo, hi } => (lo * lo + lo * hi + hi * hi) / 3.0,
            Distribution::Normal { mean, sd } => mean * mean + sd * sd,
        }
    }

    #[test]
    fn densities_have_the_sum_1_and_the_mean_square_of_their_axes() {
        let ranges = [1.0..=3.0, -3.0..=-1.0, -1.0..=2.0, -2.0..=2.0, 0.0..=1.5].map(Axis::from);
        for x in ranges.into_iter().chain([Axis::normal(3.0, 0.25), Axis::normal(-1.0, 4.0)]) {
            let [all, square] = sums(&[Direction::of_axis(RateX, x)]);
            assert!((all - 1.0).abs() < 1e-9 && (square - mean_square(x)).abs() < 1e-4, "{x:?}: {all} {square}");
            for y in ranges {
                let Some(across) = Direction::across(x, y) else { continue };
                let ([all, square], expected) = (sums(&across), mean_square(x) + mean_square(y));
                assert!((all - 1.0).abs() < 1e-4 && (square - expected).abs() < 1e-3, "{x:?} {y:?}: {all} {square}");
            }
        }
        assert!(Direction::across(ranges[0], Axis::normal(3.0, 0.25)).is_none());
    }

    /// Two ranges count as one coordinate unless their ends are rounded too roughly.
    #[test]
    fn one_coordinate_takes_the_place_of_two_wide_ranges() {
        let found = |y: std::ops::RangeInclusive<f64>| {
            let space = Space::builder(Coin::PAPER).rate_x(3.0..=4.0).rate_y(y).rate_z(2.0).speed(2.0..=3.0);
            let (directions, roundings) = directions_of(&space.build().unwrap());
            let is_across = directions.iter().flatten().any(Direction::is_across);
            (directions.len(), is_across, roundings / f64::EPSILON)
        };
        // An end of (lo, hi) is off by u of its size, which is so many parts of the length: 7 of x, and 17 of y.
        // Twice that is allowed.
        assert_eq!(found(1.0..=1.125), (1, true, 2.0 * (7.0 + 17.0)));
        assert_eq!(found(1.0..=1.000_001), (2, false, 0.0));
    }

    /// The radii of corners, and of circles that touch a side; squared.
    #[test]
    fn parts_end_at_corners_and_where_circles_touch() {
        let ends = |x: std::ops::RangeInclusive<f64>, y: std::ops::RangeInclusive<f64>| {
            let parts = Direction::across(Axis::from(x), Axis::from(y))?;
            let ends: Vec<[f64; 2]> = parts.iter().map(|part| part.ends.map(|end| end.midpoint().powi(2))).collect();
            assert!(ends.windows(2).all(|pair| pair[0][1] == pair[1][0]));
            Some(ends.iter().map(|ends| ends[0].round()).chain(ends.last().map(|ends| ends[1].round())).collect())
        };
        assert_eq!(ends(1.0..=3.0, 2.0..=4.0), Some(vec![5.0, 9.0, 13.0, 16.0, 17.0, 25.0]));
        assert_eq!(ends(0.0..=3.0, 2.0..=4.0), Some(vec![4.0, 9.0, 13.0, 16.0, 25.0]));
        // The radii of two corners differ by less than an f64 tells.
        assert_eq!(ends(3.0..=4.0, 3.0_f64.next_up()..=4.0), None);
    }
}
