//! This file computes the shares of heads of a block of launches in SIMD registers, where the speed is uniform and gravity
//! and tilt are fixed. It is the formula of [`uniform_share`](super::uniform_share), with its error bound, on the phases of
//! heads that the crate `exact` computes in registers.
//!
//! A launch that needs a closer look is left out, and its share is then computed by itself: one that is not ordinary, that
//! grazes cos θ = 0, or whose phase does not depend on the speed.

use std::f64::consts::{PI, TAU};

use dynamics::{Attitude, Coin, Error, TimeOfFlight, Tosses};
use exact::Batch;
use exact::batch::{HeadsColumns, UNSOLVED};
use numerics::lanes::{Real, Simd, SimdLevel, WithSimd};

use super::{ROUNDING, Share};
use crate::axis::Distribution;
use crate::block::{BLOCK, Block};
use crate::coordinate::Coordinate::{Gravity, RateX, RateY, RateZ, Speed, Tilt};
use crate::space::Space;

/// A column of numbers of a block.
type Column = [f64; BLOCK];

/// The probability of a launch whose share is left out.
const LEFT_OUT: f64 = -1.0;

/// What the shares of all launches of a space have in common.
pub(crate) struct ShareLanes {
    level: SimdLevel,
    attitude: Attitude,
    gravity: f64,
    /// Times of flight of the slowest and of the fastest launch (s).
    times: [f64; 2],
    fastest: Column,
}

impl ShareLanes {
    /// `None` if the speed is not uniform over a range, or if gravity or the tilt vary.
    pub(crate) fn new(space: &Space) -> Option<Self> {
        Self::at(SimdLevel::widest(), space)
    }

    /// As [`ShareLanes::new`], at a SIMD level.
    fn at(level: SimdLevel, space: &Space) -> Option<Self> {
        let (gravity, tilt) = (space.axis(Gravity).value()?, space.axis(Tilt).value()?);
        let Distribution::Uniform { lo, hi } = space.axis(Speed).distribution() else { return None };
        let time = |speed| TimeOfFlight::thrown(speed, gravity, None).seconds();
        let attitude = if tilt == 0.0 { Attitude::IDENTITY } else { Attitude::about_x(tilt) };
        let times = [time(lo), time(hi)];
        (lo < hi).then_some(Self { level, attitude, gravity, times, fastest: [hi; BLOCK] })
    }

    /// The shares of a block.
    ///
    /// # Errors
    /// None for launches of a space, which are valid.
    pub(crate) fn shares(&self, space: &Space, coin: Coin, block: &Block) -> Result<ShareColumns, Error> {
        let rates = [RateX, RateY, RateZ].map(|of| block.column(space.place(of)));
        let length = block.len();
        let tosses = Tosses::new(coin, self.attitude, self.gravity, rates, &self.fastest[..length])?;
        let mut columns = [[0.0; BLOCK]; 5];
        let [crest, half_width, crest_error, half_width_error, rate] = columns.each_mut().map(|all| &mut all[..length]);
        let heads = HeadsColumns { crest, half_width, crest_error, half_width_error, rate };
        Batch::new(tosses).on(self.level).heads(heads)?;
        let mut shares = ShareColumns { probability: [0.0; BLOCK], error: [0.0; BLOCK], length };
        self.level.run(Shares { heads: &columns, times: self.times, shares: &mut shares });
        Ok(shares)
    }
}

/// Shares of a block.
pub(crate) struct ShareColumns {
    probability: Column,
    error: Column,
    length: usize,
}

impl ShareColumns {
    /// The share of each launch; `None` for one that is left out.
    pub(crate) fn each(&self) -> impl Iterator<Item = Option<Share>> {
        let both = self.probability[..self.length].iter().zip(&self.error);
        both.map(|(&probability, &error)| (probability >= 0.0).then_some(Share { probability, error }))
    }
}

/// The kernel, over all lanes of the columns: those beyond the block are left out.
struct Shares<'a> {
    /// Crest, half-width, their errors, and the rate of the phase.
    heads: &'a [Column; 5],
    times: [f64; 2],
    shares: &'a mut ShareColumns,
}

impl WithSimd for Shares<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let [slowest, fastest] = self.times.map(|time| Real::splat(simd, time));
        let ShareColumns { probability, error, length } = self.shares;
        let [crest, half_width, crest_error, half_width_error, rate] = self.heads;
        for at in (0..*length).step_by(Real::<S>::LANES) {
            let rate = Real::load(simd, &rate[at..]);
            let heads = Heads {
                crest: Real::load(simd, &crest[at..]),
                half_width: Real::load(simd, &half_width[at..]),
                crest_error: Real::load(simd, &crest_error[at..]),
                half_width_error: Real::load(simd, &half_width_error[at..]),
            };
            let share = heads.share(rate * slowest, rate * fastest);
            share[0].store(&mut probability[at..]);
            share[1].store(&mut error[at..]);
        }
    }
}

/// [`HeadsPhases`](exact::HeadsPhases) of as many launches as a register holds.
struct Heads<S: Simd> {
    crest: Real<S>,
    half_width: Real<S>,
    crest_error: Real<S>,
    half_width_error: Real<S>,
}

/// The position of a phase, as [`Place`](super::Place).
struct Place<S: Simd> {
    turn: Real<S>,
    within: Real<S>,
    /// -1, 0 or 1: before, within or after the interval of heads about the nearest crest.
    beyond: Real<S>,
    to_edge: Real<S>,
}

impl<S: Simd> Heads<S> {
    #[inline(always)]
    fn place(&self, phase: Real<S>) -> Place<S> {
        let (zero, one) = (phase.constant(0.0), phase.constant(1.0));
        let from_start = phase - self.crest;
        let turn = (from_start * phase.constant(1.0 / TAU)).round();
        let from_crest = turn.mul_add(phase.constant(-TAU), from_start);
        let within = from_crest.min(self.half_width).max(-self.half_width);
        let beyond = from_crest - within;
        Place {
            turn,
            within,
            beyond: zero.less_than(beyond).choose(one, beyond.less_than(zero).choose(-one, zero)),
            to_edge: (from_crest.abs() - self.half_width).abs(),
        }
    }

    /// The fraction of the phases from `from` to `to` (rad) that show heads, and its error.
    #[inline(always)]
    fn share(&self, from: Real<S>, to: Real<S>) -> [Real<S>; 2] {
        let number = |value: f64| to.constant(value);
        let (zero, one, two) = (number(0.0), number(1.0), number(2.0));
        let (begin, end) = (self.place(from), self.place(to));
        let turns = end.turn - begin.turn;
        let end_error = number(ROUNDING) * (two + to);
        let edge_error = self.half_width_error + self.crest_error + end_error;
        let range = to - from;
        let inverse = one / zero.less_than(range).choose(range, one);
        let measure = (two * self.half_width).mul_add(turns, end.within - begin.within);
        let edges = two * (turns + one) * self.half_width_error + two * self.crest_error.min(number(PI));
        let probability = (measure * inverse).max(zero).min(one);
        let error = ((edges + number(3.0) * end_error) * inverse + number(ROUNDING)).min(one);
        // The whole range lies in one interval of heads or of tails, farther from its ends than their errors.
        let intervals = two.mul_add(turns, end.beyond - begin.beyond).abs();
        let distance = begin.to_edge.min(end.to_edge);
        let same = intervals.less_than(number(0.5)).choose(distance, zero);
        let is_one_interval = edge_error.less_than(same);
        let face = begin.beyond.abs().less_than(number(0.5)).choose(one, zero);
        let probability = is_one_interval.choose(face, probability);
        let error = is_one_interval.choose(zero, error);
        // The motion shows heads always or never.
        let is_certain = self.half_width_error.abs().at_most(zero);
        let always = zero.less_than(self.half_width).choose(one, zero);
        let probability = is_certain.choose(always, probability);
        let error = is_certain.choose(zero, error);
        let is_solved = number(UNSOLVED).less_than(self.half_width_error);
        let is_known = zero.less_than(range).choose(is_solved.choose(one, zero), zero);
        [zero.less_than(is_known).choose(probability, number(LEFT_OUT)), error]
    }
}

#[cfg(test)]
mod tests {
    use dynamics::Coin;

    use super::*;
    use crate::exact_speed::share;
    use crate::launches::Launches;
    use crate::space::Cube;

    /// Spaces with launches of all kinds: that turn once or many times, hardly, or not at all, that show one face alone,
    /// and that start from several tilts.
    fn spaces() -> Vec<Space> {
        let rates = [
            ["1:60", "1:60", "1:60"],
            ["-60:60", "x", "30"],
            ["0:0.1", "-0.1:0.1", "0:0.1"],
            ["0:1e-150", "0", "0:1"],
            ["0:1e-7", "0", "1:9"],
            ["29.9999999999999:30.0000000000001", "0", "60"],
            ["-1e52:1e52", "0", "0:1"],
            ["0:40", "0", "0"],
        ];
        let mut spaces = Vec::new();
        for coin in [Coin::PAPER, Coin::DISC] {
            for [x, y, z] in rates {
                for tilt in ["0", "0.4", "1.5707963", "2.9", "-0.7"] {
                    for speed in ["3:5", "0:0.2", "0:300", "4:4.0001", "1e-3:1e9"] {
                        let texts = [(RateX, x), (RateY, y), (RateZ, z), (Speed, speed), (Tilt, tilt)];
                        spaces.push(Space::parse(coin, &texts).unwrap());
                    }
                }
            }
        }
        spaces
    }

    fn block(space: &Space, length: usize) -> Block {
        let mut block = Block::new(space);
        let cube = Cube::new(space, space.free().filter(|of| *of != Speed));
        Launches::Random { cube, seed: 5 }.write(0..length as u64, &mut block);
        block
    }

    #[test]
    fn shares_in_lanes_are_those_of_single_launches_within_both_errors() {
        let (mut left_out, mut certain, mut all) = (0, 0, 0);
        for space in spaces() {
            let block = block(&space, BLOCK);
            let found = ShareLanes::new(&space).unwrap().shares(&space, space.coin().unwrap(), &block).unwrap();
            for (index, found) in found.each().enumerate() {
                all += 1;
                let Some(found) = found else {
                    left_out += 1;
                    continue;
                };
                let expected = share(&space, space.coin().unwrap(), &block.values(index)).unwrap();
                let apart = (found.probability - expected.probability).abs();
                assert!((0.0..=1.0).contains(&found.probability) && (0.0..=1.0).contains(&found.error));
                assert!(apart <= found.error + expected.error, "{index} of {space:?}: {found:?}, {expected:?}");
                // The bound is not much larger than that of a single launch.
                assert!(found.error <= 2.0 * expected.error + 1e-14, "{index} of {space:?}: {found:?}, {expected:?}");
                certain += usize::from(found.error == 0.0);
            }
        }
        assert!(left_out > all / 10 && left_out < all / 2 && certain > all / 5, "{left_out}, {certain} of {all}");
    }

    #[test]
    fn shares_have_the_same_bits_at_every_level_and_length() {
        for space in spaces().into_iter().step_by(7) {
            let bits = |level, length| {
                let found = ShareLanes::at(level, &space)
                    .unwrap()
                    .shares(&space, space.coin().unwrap(), &block(&space, length))
                    .unwrap();
                let bits = |share: Share| [share.probability.to_bits(), share.error.to_bits()];
                found.each().map(|share| share.map(bits)).collect::<Vec<_>>()
            };
            let plain = bits(SimdLevel::all()[0], BLOCK);
            for level in SimdLevel::all() {
                for length in [0, 1, 9, BLOCK] {
                    assert_eq!(bits(level, length), plain[..length], "{length} at {}", level.name());
                }
            }
        }
    }

    #[test]
    fn spaces_without_a_range_of_speeds_or_with_other_variables_have_no_lanes() {
        let texts = |speed, gravity, tilt| {
            [(RateX, "0:9"), (RateY, "x"), (RateZ, "1"), (Speed, speed), (Gravity, gravity), (Tilt, tilt)]
        };
        for (speed, gravity, tilt, has_lanes) in [
            ("3:5", "9", "1", true),
            ("3", "9", "1", false),
            ("normal:3:0.1", "9", "1", false),
            ("3:5", "9:10", "1", false),
            ("3:5", "9", "0:1", false),
        ] {
            let space = Space::parse(Coin::PAPER, &texts(speed, gravity, tilt)).unwrap();
            assert_eq!(ShareLanes::new(&space).is_some(), has_lanes, "{speed} {gravity} {tilt}");
        }
    }
}
