//! This file finds how precise a hand must be: the largest relative spread of a launch with which heads is still as
//! probable as wanted. A relative spread s means that each input is normal around its value x with the standard
//! deviation s |x|, independent of the others; an input that is 0 stays 0.
//!
//! P(heads) as a function of s is 1 near s = 0 for a toss that lands heads, and in general falls, but it need not fall
//! all the way. The answer is the largest s such that P(heads) suffices at every smaller spread, too. It is found by
//! looking at spreads that grow by a factor of √2, and by bisection where P(heads) first fails to suffice. All of these
//! estimates use the same points, so that they differ by the spread and not by chance.

use dynamics::error::require;
use dynamics::{Error, InputError, Outcome};
use exact::certify_rigid;

use crate::axis::Axis;
use crate::coordinate::Coordinate;
use crate::estimate::Estimate;
use crate::plan::{Plan, Rest, Scrambled};
use crate::sampler::Sampler;
use crate::space::Space;

/// The inputs of a hand: the three rates and the speed.
pub const HAND: [Coordinate; 4] = [Coordinate::RateX, Coordinate::RateY, Coordinate::RateZ, Coordinate::Speed];

/// Largest relative spread. The speeds of a larger one could be negative, 8.3 standard deviations below their mean.
pub const LARGEST_SPREAD: f64 = 0.12;

/// Smallest relative spread that is looked at.
pub const SMALLEST_SPREAD: f64 = 1e-9;

/// How large a relative spread may be for a wanted probability of heads.
#[derive(Debug, Clone, PartialEq)]
pub enum LargestSpread {
    /// Up to this spread, at which heads has this probability.
    UpTo(f64, Estimate),
    /// Up to [`LARGEST_SPREAD`] at least, at which heads has this probability. No larger one was looked at.
    Any(Estimate),
    /// No spread is small enough, because the toss itself does not land heads.
    TossIsNotHeads(Outcome),
    /// Not even [`SMALLEST_SPREAD`], at which heads has this probability: the toss lands heads, next to tails.
    BelowSmallest(Estimate),
}

impl Space {
    /// The same space, in which each coordinate of `inputs` that has a single value x ≠ 0 is normal with the mean x and
    /// the standard deviation `spread` |x|.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for a spread that is not from 0 to [`LARGEST_SPREAD`].
    pub fn with_spread(self, spread: f64, inputs: &[Coordinate]) -> Result<Self, InputError> {
        require("spread", spread, "from 0 to 0.12", (0.0..=LARGEST_SPREAD).contains(&spread))?;
        let is_tied = |of| self.place(of) != of;
        inputs.iter().filter(|of| !is_tied(**of)).try_fold(self, |space, of| match space.axis(*of).value() {
            Some(value) if spread * value != 0.0 => space.with_axis(*of, Axis::normal(value, spread * value.abs())),
            _ => Ok(space),
        })
    }
}

impl Sampler<'_> {
    /// The largest relative spread of the coordinates `inputs` of `space`, which have single values, with which heads has
    /// at least the probability `heads`. It is found with `points` Sobol points for each estimate.
    ///
    /// # Errors
    /// As [`Sampler::estimate`], and [`InputError`] for a probability `heads` that is not between 0 and 1, and for a
    /// coordinate of `space` that varies.
    pub fn largest_spread(
        &self,
        space: &Space,
        inputs: &[Coordinate],
        heads: f64,
        scrambled: Scrambled,
    ) -> Result<LargestSpread, Error> {
        require("heads", heads, "above 0 and below 1", heads > 0.0 && heads < 1.0)?;
        if let Some(of) = space.free().next() {
            let (field, value) = (of.field(), space.axis(of).to_string());
            return Err(
                InputError::Malformed { field, value, expected: "a single value, around which it spreads" }.into()
            );
        }
        let landing = certify_rigid(&space.toss(&space.fixed_values()))?.outcome();
        if landing != Outcome::Heads {
            return Ok(LargestSpread::TossIsNotHeads(landing));
        }
        let estimate = |spread: f64| {
            let spread = space.with_spread(spread, inputs)?;
            self.silent().estimate(&spread, plan(&spread, scrambled))
        };
        let suffices = |found: &Estimate| found.probability >= heads;
        let mut largest = (SMALLEST_SPREAD, estimate(SMALLEST_SPREAD)?);
        if !suffices(&largest.1) {
            return Ok(LargestSpread::BelowSmallest(largest.1));
        }
        while largest.0 < LARGEST_SPREAD {
            let next = (largest.0 * std::f64::consts::SQRT_2).min(LARGEST_SPREAD);
            let found = estimate(next)?;
            if !suffices(&found) {
                let (spread, found) = bisect(largest, next, estimate, suffices)?;
                return Ok(LargestSpread::UpTo(spread, found));
            }
            largest = (next, found);
        }
        Ok(LargestSpread::Any(largest.1))
    }
}

/// The largest spread that suffices, to 1e-5 of itself, between `from`, which does, and `to`, which does not.
fn bisect(
    mut from: (f64, Estimate),
    mut to: f64,
    estimate: impl Fn(f64) -> Result<Estimate, Error>,
    suffices: impl Fn(&Estimate) -> bool,
) -> Result<(f64, Estimate), Error> {
    while to > from.0 * (1.0 + 1e-5) {
        let middle = 0.5 * (from.0 + to);
        let found = estimate(middle)?;
        if suffices(&found) { from = (middle, found) } else { to = middle }
    }
    Ok(from)
}

/// The most accurate plan for a space that spreads.
fn plan(space: &Space, scrambled: Scrambled) -> Plan {
    let free: Vec<Coordinate> = space.free().collect();
    match free[..] {
        [] => Plan::Grid,
        _ if space.coin().is_none() || space.drop().is_some() || !free.contains(&Coordinate::Speed) => {
            Plan::Sobol(scrambled)
        }
        [_] => Plan::ExactSpeed(Rest::Grid),
        _ => Plan::ExactSpeed(Rest::Sobol(scrambled)),
    }
}

#[cfg(test)]
mod tests {
    use dynamics::Coin;

    use super::*;
    use crate::coordinate::Coordinate::{RateX, RateY, RateZ, Speed};

    const POINTS: Scrambled = Scrambled { points: 1 << 12, scrambles: 8, seed: 1 };

    fn space(rate: [&str; 3], speed: &str) -> Space {
        let [x, y, z] = rate;
        Space::parse(Coin::PAPER, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed)]).unwrap()
    }

    /// End over end, cos θ = cos(ωT). Heads has the phase of landing within a quarter of a turn of a whole turn. With ωT =
    /// 20 π and the speed alone normal, P(heads) = 0.95 where 1.96 standard deviations of the phase are π/2, so that
    /// s = π/2/1.959964/(20 π) = 0.0127553.
    #[test]
    fn the_spread_of_a_toss_end_over_end_is_that_of_the_normal_distribution() {
        let toss = space(["62.83185307179586", "0", "0"], "4.905");
        let found = Sampler::exact().largest_spread(&toss, &[Speed], 0.95, POINTS).unwrap();
        let LargestSpread::UpTo(spread, estimate) = found else { panic!("{found:?}") };
        assert!((spread / 0.012_755_3 - 1.0).abs() < 2e-5, "{spread}");
        assert!((0.95..0.950_01).contains(&estimate.probability));
        // The rate alone is the same by symmetry, and both together add in squares.
        for (inputs, factor) in [(vec![RateX], 1.0), (HAND.to_vec(), 0.5_f64.sqrt())] {
            let found = Sampler::exact().largest_spread(&toss, &inputs, 0.95, POINTS).unwrap();
            let LargestSpread::UpTo(spread, _) = found else { panic!("{found:?}") };
            assert!((spread / (0.012_755_3 * factor) - 1.0).abs() < 5e-3, "{inputs:?}: {spread}");
        }
        // Without an effect of the input, any spread will do.
        assert!(matches!(Sampler::exact().largest_spread(&toss, &[RateY], 0.95, POINTS), Ok(LargestSpread::Any(_))));
        // A drop changes the plan, and a drop of nearly nothing hardly the answer.
        let found =
            Sampler::exact().largest_spread(&toss.with_drop(Some(1e-9)).unwrap(), &[Speed], 0.95, POINTS).unwrap();
        let LargestSpread::UpTo(spread, _) = found else { panic!("{found:?}") };
        assert!((spread / 0.012_755_3 - 1.0).abs() < 2e-3, "{spread}");
    }

    #[test]
    fn tosses_that_are_always_or_never_or_hardly_heads_have_answers_of_their_own() {
        let largest = |toss: &Space| Sampler::exact().largest_spread(toss, &HAND, 0.9, POINTS).unwrap();
        let always = largest(&space(["1", "1", "9"], "3"));
        assert!(matches!(&always, LargestSpread::Any(found) if found.probability == 1.0), "{always:?}");
        let never = largest(&space(["2", "2", "0.5"], "4"));
        assert_eq!(never, LargestSpread::TossIsNotHeads(Outcome::Tails));
        // A quarter of a turn less 1e-12.
        let hardly = largest(&space(["1.5707963267933", "0", "0"], "4.905"));
        assert!(matches!(&hardly, LargestSpread::BelowSmallest(found) if found.probability < 0.51), "{hardly:?}");
    }

    #[test]
    fn spreads_and_probabilities_out_of_range_are_refused() {
        let toss = space(["1", "1", "9"], "3");
        for spread in [-0.01, 0.121, f64::NAN] {
            assert_eq!(toss.with_spread(spread, &HAND).unwrap_err().field(), "spread");
        }
        assert_eq!(toss.with_spread(0.0, &HAND), Ok(toss));
        for heads in [0.0, 1.0, f64::NAN] {
            let refused = Sampler::exact().largest_spread(&toss, &HAND, heads, POINTS).unwrap_err();
            assert_eq!(refused.field(), Some("heads"));
        }
        let varies = Sampler::exact().largest_spread(&space(["1", "1", "1:9"], "3"), &HAND, 0.9, POINTS).unwrap_err();
        assert_eq!(varies.field(), Some("rate z [rad/s]"));
    }

    #[test]
    fn the_answer_depends_on_the_seed_alone() {
        let toss = space(["20", "5", "7"], "3.2").with_body(Coin::DISC);
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Sampler::exact().largest_spread(&toss, &HAND, 0.9, POINTS).unwrap())
        };
        assert_eq!(on(1), on(3));
    }
}
