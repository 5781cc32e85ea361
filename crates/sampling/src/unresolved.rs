//! This file bounds what the points of a mean share cannot resolve, in the size that its interval has to allow for.
//!
//! # Rare launches
//! Scrambles of n points agree on a smooth share, and then their spread is tiny. But if the share has a kink or a jump that only
//! one launch in 10 n passes, most samples do not meet it, and the agreement of their scrambles proves nothing about it. So
//! the launches that are too rare for the points are sampled on their own, by probes with weights.
//!
//! Each coordinate is a function of a normal number z, so that a launch is a point of d normal numbers. A half-space that the
//! points do not resolve, because fewer than `RESOLVED` of them are expected in it, begins farther from the origin than
//! R = -Φ⁻¹(8/n), in whichever direction it lies. So the probes are beyond the sphere of radius R:
//!
//! ```text
//! direction    uniform on the sphere, by a scramble of Sobol's sequence of their own
//! radius r     R + t, where t has the density exp(-t); the weight is the χ density of d numbers at r, divided by exp(-t)
//! departure    |f(X) - (2 f(Y) - f(2Y - X))|, where X is the probe and Y the point at R in the same direction
//! ```
//!
//! The share f is compared with its linear continuation from within the sphere, in the coordinates of the launch. A smooth
//! share departs from it by its second derivative, which is little over so short a way. A share that jumps on the way departs
//! by the jump. The mean departure E|D| is the error of a sample that met none of these launches. One that met some has scrambles
//! that differ, and Student's interval tells.
//!
//! If the launches that depart are not so rare, some of the n points are among them, and their error is one of chance, whose standard
//! deviation is at most √(E(D²)/n) for independent points. Three times as much is below E|D| only if at least 9 points are
//! expected among them, since E|D|² ≤ P(D ≠ 0) E(D²). So the smaller one of both is taken.
//!
//! Probes do not find a thin region within the space, such as a slab through its middle, if the share is smooth on both
//! sides of it.
//!
//! # Values between two f64
//! The values of a range that is a few units of the last place wide are rounded to the ends and to what is between them, for
//! all points alike. Rounding moves a value by ρ = 2^-53 (|lo| + |hi|)/(hi - lo) of the range at most, up to a factor of 2, and the share by about
//! as much of its difference between both ends.

use dynamics::Coin;
use numerics::UNIT_ROUNDOFF;
use statrs::distribution::{ContinuousCDF, Normal};
use statrs::function::gamma::gamma;

use crate::axis::{Axis, Distribution, NORMAL_REACH};
use crate::exact_speed::share;
use crate::plan::{Scrambled, cube_of_the_rest};
use crate::sobol::ScrambledSobol;
use crate::space::{Cube, Space};

/// A region in which this many of the points are expected shows in the spread of the scrambles: one for each of the usual eight.
const RESOLVED: f64 = 8.0;

/// Half-spaces of a larger probability are met by any sample.
const LARGEST: f64 = 0.125;

/// The fewest and the most probes. Their number follows that of the points.
const PROBES: [u64; 2] = [256, 1024];

/// Bounds are so many standard deviations from what they bound.
const CERTAINTY: f64 = 3.0;

/// The number of pairs of launches that tell how a share differs between the ends of a range.
const PAIRS: usize = 16;

/// What the points of `scrambled` do not resolve of the mean share over the launches of `space`, from 0 to 1: launches that are too
/// rare for them, and values between two f64.
pub(crate) fn unresolved(space: &Space, scrambled: Scrambled) -> f64 {
    let Some(probes) = Probes::new(space, scrambled) else { return 0.0 };
    let number = usize::try_from(scrambled.points.clamp(PROBES[0], PROBES[1])).unwrap_or(1);
    (probes.rare(number, scrambled.points) + probes.roundings()).min(1.0)
}

struct Probes<'a> {
    space: &'a Space,
    coin: Coin,
    cube: Cube,
    /// Directions and radii.
    sequence: ScrambledSobol,
    normal: Normal,
    /// R.
    reach: f64,
}

impl<'a> Probes<'a> {
    /// `None` for a body without shares, and where nothing but the speed varies.
    fn new(space: &'a Space, scrambled: Scrambled) -> Option<Self> {
        let coin = space.coin()?;
        let (cube, normal) = (cube_of_the_rest(space), Normal::standard());
        #[expect(clippy::cast_precision_loss, reason = "a number of points")]
        let part = (RESOLVED / scrambled.points as f64).min(LARGEST);
        // The scrambles of the points have the numbers below.
        let sequence = ScrambledSobol::new(cube.dimensions() + 1, scrambled.seed, scrambled.scrambles)?;
        let reach = -normal.inverse_cdf(part);
        (cube.dimensions() > 0).then_some(Self { space, coin, cube, sequence, normal, reach })
    }

    /// What `number` probes tell of launches that are too rare for so many points.
    #[expect(clippy::cast_precision_loss, reason = "numbers of probes and of points")]
    fn rare(&self, number: usize, points: u64) -> f64 {
        let [mut departure, mut squares, mut of_weighted] = [0.0; 3];
        for point in self.points(number) {
            let [weight, by] = self.departure(&point);
            departure += weight * by;
            of_weighted += (weight * by).powi(2);
            squares += weight * by * by;
        }
        let n = number as f64;
        let mean = departure / n;
        let variance = (of_weighted / n - mean * mean).max(0.0) / n;
        let if_none_is_met = mean + CERTAINTY * variance.sqrt();
        let if_all_are_met_by_chance = CERTAINTY * (squares / n / points as f64).sqrt();
        if_none_is_met.min(if_all_are_met_by_chance)
    }

    /// The first points of the sequence.
    fn points(&self, number: usize) -> impl Iterator<Item = Vec<f64>> {
        let column = |dimension| {
            let mut column = vec![0.0; number];
            self.sequence.write(dimension, 0, &mut column);
            column
        };
        let columns: Vec<Vec<f64>> = (0..self.sequence.dimensions()).map(column).collect();
        (0..number).map(move |index| columns.iter().map(|column| column[index]).collect())
    }

    /// How far the roundings of the values move the mean share.
    #[expect(clippy::cast_precision_loss, reason = "a few pairs")]
    fn roundings(&self) -> f64 {
        let mut sum = 0.0;
        for point in self.points(PAIRS) {
            let place: Vec<f64> =
                self.cube.axes().iter().zip(&point).map(|((_, axis), part)| axis.quantile(*part)).collect();
            for (index, (_, axis)) in self.cube.axes().iter().enumerate() {
                let ends = match axis.distribution() {
                    Distribution::Uniform { lo, hi } => [lo, hi],
                    Distribution::Normal { mean, sd } => [mean - sd, mean + sd],
                };
                let shares = ends.map(|end| {
                    let mut place = place.clone();
                    place[index] = end;
                    self.share(&place)
                });
                let size = UNIT_ROUNDOFF * (ends[0].abs() + ends[1].abs());
                let part = if ends[1] > ends[0] { (2.0 * size / (ends[1] - ends[0])).min(1.0) } else { 1.0 };
                sum += part * (shares[1] - shares[0]).abs();
            }
        }
        sum / PAIRS as f64
    }

    /// Weight and departure of the probe that belongs to a point of the unit cube; its last coordinate gives the radius.
    fn departure(&self, point: &[f64]) -> [f64; 2] {
        let (last, rest) = point.split_last().expect("the radius is the last");
        let direction: Vec<f64> = rest.iter().map(|part| self.normal.inverse_cdf(*part)).collect();
        let length = direction.iter().map(|z| z * z).sum::<f64>().sqrt();
        let beyond = -last.ln();
        let radius = self.reach + beyond;
        let scaled = |radius: f64| direction.iter().map(move |z| z / length * radius);
        let [far, edge] = [radius, self.reach].map(|radius| self.place(scaled(radius)));
        let inner: Vec<f64> = far.iter().zip(&edge).map(|(far, edge)| 2.0 * edge - far).collect();
        let [far, edge, inner] = [far, edge, inner].map(|place| self.share(&place));
        [self.weight(radius) * beyond.exp(), (far - (2.0 * edge - inner)).abs()]
    }

    /// The values of the coordinates at normal numbers.
    fn place(&self, numbers: impl Iterator<Item = f64>) -> Vec<f64> {
        let value = |((_, axis), z): (&(_, Axis), f64)| match axis.distribution() {
            Distribution::Uniform { lo, hi } => lo + self.normal.cdf(z) * (hi - lo),
            Distribution::Normal { mean, sd } => mean + sd * z.clamp(-NORMAL_REACH, NORMAL_REACH),
        };
        self.cube.axes().iter().zip(numbers).map(value).collect()
    }

    /// The share at a place, a half where it is not known.
    fn share(&self, place: &[f64]) -> f64 {
        let mut values = self.space.fixed_values();
        for ((of, _), value) in self.cube.axes().iter().zip(place) {
            values[*of as usize] = *value;
        }
        share(self.space, self.coin, &values).map_or(0.5, |share| share.probability)
    }

    /// The density of the distance of normal numbers from the origin.
    #[expect(clippy::cast_precision_loss, reason = "five dimensions at most")]
    fn weight(&self, radius: f64) -> f64 {
        let dimensions = self.cube.dimensions() as f64;
        let half = 0.5 * dimensions;
        radius.powf(dimensions - 1.0) * (-0.5 * radius * radius).exp() / (2_f64.powf(half - 1.0) * gamma(half))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coordinate::Coordinate::{self, RateX, RateY, RateZ, Speed, Tilt};
    use crate::plan::{Plan, Rest};
    use crate::sampler::Sampler;

    fn space(texts: [&str; 5]) -> Space {
        let texts: Vec<(Coordinate, &str)> = [RateX, RateY, RateZ, Speed, Tilt].into_iter().zip(texts).collect();
        Space::parse(Coin::PAPER, &texts).unwrap()
    }

    /// From a tilt beyond 90°, 4.62 deviations from its mean, heads becomes tails: P is off by 3.8e-6 of 1 - 2 (0.8483) if no point
    /// is there.
    const JUMP: [&str; 5] = ["0", "2.7:2.71", "0", "2:3", "normal:0:0.34"];

    #[test]
    fn a_jump_that_no_point_meets_is_bounded_by_what_it_adds() {
        let of_jump = 2.0 * (1.0 - Normal::standard().cdf(std::f64::consts::FRAC_PI_2 / 0.34)) * 0.6967;
        for points in [1 << 12, 1 << 16, 1 << 20] {
            for seed in 1..=8 {
                let found = unresolved(&space(JUMP), Scrambled::new(points, seed));
                assert!(
                    (of_jump..3.0 * of_jump).contains(&found),
                    "{points} points, seed {seed}: {found:e}, {of_jump:e}"
                );
            }
        }
    }

    /// The probabilities are from quadratures outside of this program, which `validation/reference` has.
    #[test]
    fn intervals_hold_where_few_points_meet_a_jump() {
        for (texts, probability) in [
            (JUMP, 0.848_339_196_23),
            (["0", "normal:10:0.5", "0", "normal:2.4:0.12", "normal:0:20deg"], 0.694_507_310_48),
        ] {
            let space = space(texts);
            let holds = |seed: &u64| {
                let plan = Plan::ExactSpeed(Rest::Sobol(Scrambled::new(4096, *seed)));
                Sampler::exact().estimate(&space, plan).unwrap().interval.unwrap().contains(probability)
            };
            let held = (1..=60).filter(holds).count();
            assert!(held >= 54, "{texts:?}: {held} of 60");
        }
    }

    /// Smooth shares, and shares with kinks everywhere, have scrambles that tell the error.
    #[test]
    fn little_is_left_where_the_scrambles_tell() {
        for (texts, most) in [
            (["20:20.3", "1:2", "30:30.3", "3:5", "0.1:0.15"], 3e-9),
            (["normal:20:0.05", "0", "normal:30:0.05", "3:5", "0.1"], 1e-7),
            (["0", "1:20", "1:20", "3:5", "0"], 2e-5),
        ] {
            let found = unresolved(&space(texts), Scrambled::new(1 << 16, 1));
            assert!(found < most, "{texts:?}: {found:e}");
        }
    }

    /// Five f64 share a range with an edge of heads among them. They all count alike, but the edge may be anywhere between two.
    #[test]
    fn a_range_of_few_numbers_has_their_distance_as_its_error() {
        let edge = std::f64::consts::FRAC_PI_2 * 9.81 / 6.0;
        let numbers: Vec<f64> = (0..5_i64).map(|at| f64::from_bits((edge.to_bits() as i64 + at - 2) as u64)).collect();
        let space =
            |rate: Axis| Space::builder(Coin::PAPER).rate_x(0.0).rate_y(rate).rate_z(0.0).speed(3.0).build().unwrap();
        let is_heads = |rate: &&f64| {
            share(&space(Axis::fixed(**rate)), Coin::PAPER, &space(Axis::fixed(**rate)).fixed_values())
                .is_ok_and(|share| share.probability == 1.0)
        };
        let heads = numbers.iter().filter(is_heads).count() as f64;
        assert!(0.0 < heads && heads < 5.0);
        let plan = Plan::ExactSpeed(Rest::Sobol(Scrambled::new(1 << 12, 1)));
        let found = Sampler::exact().estimate(&space(Axis::range(numbers[0]..=numbers[4])), plan).unwrap();
        let interval = found.interval.unwrap();
        assert!(interval.contains((heads - 1.0) / 4.0) && interval.contains(heads / 4.0), "{heads}: {interval:?}");
    }
}
