//! This kernel computes the phases at which the tosses of a batch show heads, as [`HeadsPhases`](crate::HeadsPhases) has
//! them for one toss. From these follows the share of heads over all speeds.
//!
//! cos θ = a + b cos φ + c sin φ at the phase φ = |L| t. With the amplitude r = √(b² + c²), the crest is the angle of
//! (b, c), and the half-width that of (-a, √(r² - a²)). The formulas, and the errors that follow from those of the terms,
//! are those of [`heads`](crate::heads). The terms are off by 15u at most, u = 2^-53: 12u as in
//! [`tilt_terms`](crate::tilt_terms), and three for the product with 1/(|Q|² |L|²) in place of a division. The error of the
//! angles themselves is added to both bounds.

use std::f64::consts::{FRAC_PI_2, PI};

use dynamics::{CoinToss, Error, SolveError};
use numerics::UNIT_ROUNDOFF;
use numerics::lanes::{ATAN2_ERROR, Real, Simd, atan2};

use super::Batch;
use super::kernel::{BatchRun, Kernel};
use super::momentum::{Constants, Extent, PlainMotion, TiltTerms};
use crate::tilt_terms::TERM_ERROR;

/// Error of a, b and c.
const ERROR: f64 = TERM_ERROR + 3.0 * UNIT_ROUNDOFF;

/// Smallest amplitude of the tosses that the kernel solves.
const SMALLEST_AMPLITUDE: f64 = 1e-6;

/// The error of the half-width of a toss that the kernel does not solve.
pub const UNSOLVED: f64 = -1.0;

/// Columns of [`HeadsPhases`](crate::HeadsPhases), with the rates at which the phases grow.
#[derive(Debug)]
pub struct HeadsColumns<'a> {
    /// Phase at which cos θ is greatest (rad).
    pub crest: &'a mut [f64],
    /// Half the width of the interval of heads (rad).
    pub half_width: &'a mut [f64],
    /// Error of the crest (rad).
    pub crest_error: &'a mut [f64],
    /// Error of the half-width (rad): 0 for a toss that shows heads always or never, and [`UNSOLVED`] for one that has to
    /// be solved by itself.
    pub half_width_error: &'a mut [f64],
    /// |L| = ωL, the rate of precession (rad/s).
    pub rate: &'a mut [f64],
}

impl Batch<'_> {
    /// Writes the phases at which each toss shows heads, and the rate of its phase. Tosses that are not ordinary (as the
    /// module's documentation defines it), that graze cos θ = 0, or whose cos θ hardly changes, are left as
    /// [`UNSOLVED`]. Fails for a toss with an invalid launch; the contents of `out` are then unspecified. Panics if a
    /// column does not have one entry per toss.
    pub fn heads(&self, out: HeadsColumns<'_>) -> Result<(), Error> {
        let HeadsColumns { crest, half_width, crest_error, half_width_error, rate } = out;
        let out = [crest, half_width, crest_error, half_width_error, rate];
        assert!(out.iter().all(|column| column.len() == self.tosses.len()), "a column must have one entry per toss");
        let kernel = &Heads(Constants::new(&self.tosses), TiltTerms::new(&self.tosses));
        self.level.run(BatchRun { kernel, tosses: self.tosses, out })
    }
}

struct Heads(Constants, TiltTerms);

impl Kernel<4, 5> for Heads {
    fn constants(&self) -> &Constants {
        &self.0
    }

    #[inline(always)]
    fn begin<S: Simd>(&self, rates: [Real<S>; 3], speed: Real<S>, extent: &mut Extent<S>) -> [Real<S>; 4] {
        let PlainMotion { along, across_squared, squared, size, .. } = self.0.plain_motion(rates, speed, extent);
        let inverse = size.constant(1.0) / squared;
        // Twice the half: squares down to twice the smallest only call for a look at each toss.
        extent.add(size.constant(0.0), inverse, size.constant(0.0), speed);
        let [mean, cosine, sine] = self.1.terms(rates, along, across_squared, size);
        let scale = inverse * size.constant(1.0 / self.1.norm);
        [mean * scale, cosine * scale, sine * scale, size]
    }

    #[inline(always)]
    fn end<S: Simd>(&self, [mean, cosine, sine, rate]: [Real<S>; 4]) -> [Real<S>; 5] {
        let number = |value: f64| rate.constant(value);
        let (zero, one, least) = (number(0.0), number(1.0), number(SMALLEST_AMPLITUDE));
        let amplitude = cosine.mul_add(cosine, sine * sine).sqrt();
        let inverse = one / amplitude.max(least);
        let grazing = ((amplitude - mean) * (amplitude + mean)).max(zero).sqrt();
        // From the edge between motions that change their face and those that do not, and the error of this distance.
        let ratio = mean.abs() * inverse;
        let (from_edge, error) = (one - ratio, number(2.0 * ERROR) * inverse);
        let edge_error = error * number(4.0);
        let changes = edge_error.less_than(from_edge);
        let is_certain = edge_error.less_than(-from_edge);
        let always = zero.less_than(mean).choose(number(PI), zero);
        // 1 - x² is at least half of its value over the whole interval of the error.
        let slope = (number(2.0) / (from_edge.max(edge_error) * (one + ratio))).sqrt();
        let half_width_error = error.mul_add(slope, number(ATAN2_ERROR));
        let known = changes.choose(half_width_error, is_certain.choose(zero, number(UNSOLVED)));
        [
            atan2(sine, cosine),
            changes.choose(atan2(grazing, -mean), always),
            inverse.mul_add(number(FRAC_PI_2 * ERROR), number(ATAN2_ERROR)),
            amplitude.less_than(least).choose(number(UNSOLVED), known),
            rate,
        ]
    }

    fn solve_one(&self, _: &CoinToss) -> Result<[f64; 5], SolveError> {
        Ok([0.0, 0.0, 0.0, UNSOLVED, 0.0])
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Attitude, Coin, Tosses};
    use numerics::DoubleDouble;
    use numerics::lanes::SimdLevel;

    use super::*;
    use crate::tilt_terms::{TiltTerms as OneToss, terms};

    const NUMBER: usize = 4001;

    /// Rates from -60 to 60 rad/s, some of them 0, very small or very large.
    fn columns() -> [Vec<f64>; 4] {
        let column = |square: f64, every: usize, special: f64| {
            let spread = |index: usize| 120.0 * (index as f64 * square.sqrt()).fract() - 60.0;
            (0..NUMBER).map(|index| if index % every == 0 { special } else { spread(index) }).collect::<Vec<f64>>()
        };
        let speeds = (0..NUMBER).map(|index| 5.0 * (index as f64 * 7_f64.sqrt()).fract()).collect();
        let (mut x, y) = (column(2.0, 5, 0.0), column(3.0, 7, 0.0));
        (x[35], x[70], x[105]) = (1e-160, 1e60, 1e-3);
        [x, y, column(5.0, 3, 0.0), speeds]
    }

    type HeadsFound = [Vec<f64>; 5];

    fn found(tosses: Tosses<'_>, level: SimdLevel) -> HeadsFound {
        let mut columns: HeadsFound = std::array::from_fn(|_| vec![f64::NAN; tosses.len()]);
        let [crest, half_width, crest_error, half_width_error, rate] = columns.each_mut().map(Vec::as_mut_slice);
        let out = HeadsColumns { crest, half_width, crest_error, half_width_error, rate };
        Batch::new(tosses).on(level).heads(out).unwrap();
        columns
    }

    /// The phases of heads in double-double numbers, in which nothing is lost: the crest and the half-width.
    fn precise(toss: &CoinToss) -> [DoubleDouble; 2] {
        let rate = toss.launch.rate();
        let vertical = toss.launch.attitude().vertical().0.map(DoubleDouble::exactly);
        let [x, y, z] = [rate.x, rate.y, rate.z].map(DoubleDouble::exactly);
        let (z, across) = (toss.coin.exact_inertia_ratio() * z, x * x + y * y);
        let [mean, cosine, sine] = terms(vertical, [x, y, z], across);
        let sine = sine * (across + z * z).sqrt();
        let grazing = cosine * cosine + sine * sine - mean * mean;
        let half_width = if grazing.hi() > 0.0 {
            DoubleDouble::atan2(grazing.sqrt(), -mean)
        } else {
            DoubleDouble::exactly(if mean.hi() > 0.0 { PI } else { 0.0 })
        };
        [DoubleDouble::atan2(sine, cosine), half_width]
    }

    #[test]
    fn phases_of_heads_are_right_within_their_errors_which_are_not_much_larger_than_those_of_single_tosses() {
        let [x, y, z, speeds] = columns();
        let (mut unsolved, mut certain) = (0, 0);
        let longer = Attitude::from_components([1.2, 0.7, -0.4, 0.3]).unwrap();
        let about = Attitude::about_x;
        for (coin, attitude) in [
            (Coin::PAPER, about(0.0)),
            (Coin::DISC, about(0.4)),
            (Coin::PAPER, about(2.9)),
            (Coin::PAPER, about(1.57)),
            (Coin::DISC, longer),
        ] {
            let tosses = Tosses::new(coin, attitude, 9.81, [&x, &y, &z], &speeds).unwrap();
            let [crest, half_width, crest_error, half_width_error, rate] = found(tosses, SimdLevel::widest());
            for index in 0..NUMBER {
                if half_width_error[index] == UNSOLVED {
                    unsolved += 1;
                    continue;
                }
                let toss = tosses.toss(index).unwrap();
                let coin_toss = toss.coin().unwrap();
                let [expected_crest, expected] = precise(&coin_toss);
                let apart = (DoubleDouble::exactly(crest[index]) - expected_crest).hi().abs();
                let apart = apart.min((apart - 2.0 * PI).abs());
                assert!(apart <= crest_error[index], "{toss:?}: {apart:e} > {:e}", crest_error[index]);
                let apart = (DoubleDouble::exactly(half_width[index]) - expected).hi().abs();
                assert!(apart <= half_width_error[index], "{toss:?}: {apart:e} > {:e}", half_width_error[index]);
                let terms = OneToss::new(&coin_toss);
                let single = terms.heads();
                certain += usize::from(half_width_error[index] == 0.0);
                assert_eq!(half_width_error[index] == 0.0, single.half_width_error == 0.0, "{toss:?}");
                for (error, single) in
                    [(crest_error[index], single.crest_error), (half_width_error[index], single.half_width_error)]
                {
                    let limits = single..=1.2 * single + 2.0 * ATAN2_ERROR;
                    assert!(limits.contains(&error), "{toss:?}: {error:e}, {limits:?}");
                }
                let time = toss.launch.flight_time();
                let (phase, expected) = (rate[index] * time, terms.phases(time)[0]);
                assert!((phase - expected).abs() <= 8.0 * UNIT_ROUNDOFF * expected, "{index}: {phase}, {expected}");
            }
        }
        // Tosses that do not turn, that are not ordinary, and turns end over end about a diameter.
        assert!((100..2000).contains(&unsolved) && certain > 1000, "{unsolved}, {certain}");
    }

    /// The paper's coin from horizontal touches cos θ = 0 if ωz is twice the rate across.
    #[test]
    fn tosses_that_graze_the_edge_are_left_unsolved() {
        let near = [-1e-3, -1e-12, -3e-15, -1e-15, -4e-16, 0.0, 4e-16, 1e-15, 3e-15, 1e-12, 1e-3];
        let [x, y, z] = [near.map(|_| 3.0), near.map(|_| 4.0), near.map(|part| 10.0 * (1.0 + part))];
        let speeds = near.map(|_| 4.0);
        let tosses = Tosses::new(Coin::PAPER, Attitude::IDENTITY, 9.81, [&x, &y, &z], &speeds).unwrap();
        let [_, half_width, _, error, _] = found(tosses, SimdLevel::widest());
        assert!(error[0] > 0.0 && error[0] < 1e-12 && half_width[0] < PI, "{error:?}");
        assert!(error[2..9].iter().all(|error| *error == UNSOLVED), "{error:?}");
        assert!(error[9..] == [0.0, 0.0] && half_width[9..] == [PI, PI], "{error:?} {half_width:?}");
    }

    #[test]
    fn phases_of_heads_have_the_same_bits_at_every_level_and_length() {
        let [x, y, z, speeds] = columns();
        let tosses = Tosses::new(Coin::PAPER, Attitude::about_x(0.4), 9.81, [&x, &y, &z], &speeds).unwrap();
        let plain = found(tosses, SimdLevel::all()[0]);
        for level in SimdLevel::all() {
            for length in [0, 1, 7, 130, NUMBER] {
                let found = found(tosses.part(0..length), level);
                for (found, plain) in found.iter().zip(&plain) {
                    let bits = |column: &[f64]| column.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
                    assert_eq!(bits(found), bits(&plain[..length]), "{length} at {}", level.name());
                }
            }
        }
    }
}
