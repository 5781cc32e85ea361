//! This file adds up shares of heads: P(heads) is their mean, and each share is that over all speeds of a launch. The
//! sums are integers, so that the result does not depend on the order in which threads add to them.

use std::ops::Range;

use dynamics::Error;

use crate::exact_speed::lanes::ShareLanes;
use crate::exact_speed::{Share, share};
use crate::fold::{Sum, Watch, fold};
use crate::launches::Launches;
use crate::plan::ONLY_COINS;
use crate::space::Space;

/// Sums of shares and of their error bounds, as integers in units of 2^-53.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Shares {
    pub(crate) launches: u64,
    pub(crate) probability: u128,
    pub(crate) error: u128,
}

/// 2^-53.
const UNIT: f64 = 1.0 / 9_007_199_254_740_992.0;

impl Shares {
    /// Adds a share. Its error is rounded up, plus one unit for the rounding of the share itself.
    fn add(&mut self, share: Share) {
        self.launches += 1;
        let ((whole, rest), (whole_error, rest_of_error)) = (in_units(share.probability), in_units(share.error));
        self.probability += u128::from(whole) + u128::from(rest >= 0.5);
        self.error += u128::from(whole_error) + u128::from(rest_of_error > 0.0) + 1;
    }

    /// The mean share, with the mean of the error bounds.
    #[expect(clippy::cast_precision_loss, reason = "rounded once")]
    pub(crate) fn mean(&self) -> Share {
        let mean = |sum: u128| sum as f64 * UNIT / self.launches as f64;
        Share::new(mean(self.probability), mean(self.error))
    }
}

/// The whole number of units in a number from 0 to 1, and the rest.
#[inline]
#[expect(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "at most 2^53")]
fn in_units(number: f64) -> (u64, f64) {
    let units = number / UNIT;
    let whole = units as i64;
    (whole.unsigned_abs(), units - whole as f64)
}

impl Sum for Shares {
    fn merge(self, other: Self) -> Self {
        Self {
            launches: self.launches + other.launches,
            probability: self.probability + other.probability,
            error: self.error + other.error,
        }
    }
}

/// Adds up the shares of the launches with the numbers `range`. Their speeds are not used.
pub(crate) fn add_shares(
    space: &Space,
    launches: &Launches,
    range: Range<u64>,
    watch: Watch<'_>,
) -> Result<Shares, Error> {
    let coin = space.coin().ok_or(ONLY_COINS)?;
    let lanes = ShareLanes::new(space);
    fold(space, launches, range, watch, |block| {
        let mut shares = Shares::default();
        let one = |index: usize| {
            let found = share(space, coin, &block.values(index));
            found.map_err(|(toss, source)| Error::Launch {
                index: index as u64,
                toss: Box::new((*toss).into()),
                source,
            })
        };
        match &lanes {
            Some(lanes) => {
                let found = lanes.shares(space, coin, block)?;
                for (index, found) in found.each().enumerate() {
                    shares.add(found.map_or_else(|| one(index), Ok)?);
                }
            }
            None => (0..block.len()).try_for_each(|index| one(index).map(|share| shares.add(share)))?,
        }
        Ok(shares)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_does_not_depend_on_its_order() {
        let shares: Vec<Share> =
            (0..1000).map(|i| Share::new(f64::from(i * 7919 % 1000) / 999.0, 1e-16 * f64::from(i))).collect();
        let sum = |order: &mut dyn Iterator<Item = &Share>| {
            let mut sum = Shares::default();
            order.for_each(|share| sum.add(*share));
            sum
        };
        assert_eq!(sum(&mut shares.iter()), sum(&mut shares.iter().rev()));
        let (first, rest) = shares.split_at(300);
        assert_eq!(sum(&mut first.iter()).merge(sum(&mut rest.iter())), sum(&mut shares.iter()));
        let mean = sum(&mut shares.iter()).mean();
        assert!((mean.probability - 0.5).abs() < 1e-15);
        // The mean of the given errors is 499.5e-16; rounding to units adds 1 to 3 units.
        assert!((499.5e-16 + UNIT..499.5e-16 + 3.0 * UNIT).contains(&mean.error), "{:e}", mean.error);
    }
}
