//! This file turns counts or shares of heads into an estimate: a probability with an interval. What the interval means
//! depends on how the launches were chosen, so each of the methods has its own:
//!
//! | plan | launches | interval |
//! |---|---|---|
//! | [`Plan::Grid`](crate::Plan::Grid) (A) | a grid | none: a grid has a discretisation error |
//! | [`Plan::Random`](crate::Plan::Random) (B) | independent | Wilson's |
//! | [`Plan::Sobol`](crate::Plan::Sobol) | scrambled Sobol points | from the spread of independent scrambles |
//! | [`Plan::ExactSpeed`](crate::Plan::ExactSpeed) | all speeds in closed form | from the scrambles; a rounding error if only the speed varies |
//! | [`Plan::Quadrature`](crate::Plan::Quadrature) | shares at the nodes of a rule | the error estimate of the rule |
//!
//! A and B are the paper's names of the methods.

use std::fmt;

use crate::counts::Counts;
use crate::exact_speed::Share;
use crate::interval::{Interval, from_scrambles, wilson};

/// Confidence level of the intervals.
pub const LEVEL: f64 = 0.95;

/// The meaning of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IntervalKind {
    /// There is no interval, because the points are a grid.
    Grid,
    /// There is no interval, because the points are from a single scramble.
    OneScramble,
    /// Wilson's interval for independent launches.
    Wilson,
    /// Student's interval from the means of this many independent scrambles.
    Scrambles(u64),
    /// Wilson's interval, as if the points were independent. All points of all scrambles have the same outcome, so the
    /// spread of the scrambles is 0 and gives no error.
    Unanimous,
    /// A bound on the rounding error, because nothing was sampled.
    Rounding,
    /// The error estimate of the quadrature, which sampled nothing.
    Quadrature,
}

impl fmt::Display for IntervalKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Grid => f.write_str("none: a grid has a discretisation error, not a confidence interval"),
            Self::OneScramble => f.write_str("none: one scramble gives no error estimate"),
            Self::Wilson => f.write_str("wilson 95 %"),
            Self::Scrambles(number) => write!(f, "student 95 % of {number} scrambles"),
            Self::Unanimous => f.write_str("wilson 95 %, all points agree"),
            Self::Rounding => f.write_str("rounding error"),
            Self::Quadrature => f.write_str("error estimate of the quadrature"),
        }
    }
}

/// An estimate of the probability of heads.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Estimated probability of heads, from 0 to 1.
    pub probability: f64,
    /// Interval in which the probability lies, at the confidence [`LEVEL`]. It allows for either outcome of the
    /// undecided launches.
    pub interval: Option<Interval>,
    /// Meaning of the interval.
    pub interval_kind: IntervalKind,
    /// Number of launches; if the speed was integrated in closed form, each of them stands for all speeds.
    pub points: u64,
    /// The result that the estimate is made from.
    pub found: Found,
}

/// The result that an estimate is made from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Found {
    /// Counts of outcomes.
    Counts(Counts),
    /// Shares of heads over all speeds.
    Shares {
        /// Bound on the rounding error of the mean share.
        rounding_error: f64,
    },
}

impl Estimate {
    /// Distance from the probability to the farther end of the interval; `None` without an interval.
    pub fn half_width(&self) -> Option<f64> {
        let Interval { lo, hi } = self.interval?;
        Some((self.probability - lo).max(hi - self.probability))
    }

    fn of_counts(counts: Counts, interval: Option<Interval>, interval_kind: IntervalKind) -> Self {
        Self {
            probability: counts.probability(),
            interval,
            interval_kind,
            points: counts.points(),
            found: Found::Counts(counts),
        }
    }

    pub(crate) fn of_grid_counts(counts: Counts) -> Self {
        Self::of_counts(counts, None, IntervalKind::Grid)
    }

    pub(crate) fn of_independent_counts(counts: Counts) -> Self {
        Self::of_counts(counts, Some(wilson_of(counts)), IntervalKind::Wilson)
    }

    pub(crate) fn of_scrambled_counts(scrambles: &[Counts]) -> Self {
        let counts: Counts = scrambles.iter().copied().sum();
        if counts.heads() == counts.points() || counts.heads() == 0 {
            return Self::of_counts(counts, Some(wilson_of(counts)), IntervalKind::Unanimous);
        }
        let means: Vec<f64> = scrambles.iter().map(Counts::probability).collect();
        #[expect(clippy::cast_precision_loss, reason = "a ratio of counts")]
        let undecided = counts.undecided() as f64 / counts.points() as f64;
        match from_scrambles(&means, LEVEL) {
            None => Self::of_counts(counts, None, IntervalKind::OneScramble),
            Some(Interval { lo, hi }) => {
                let interval = Interval { lo, hi: (hi + undecided).min(1.0) };
                Self::of_counts(counts, Some(interval), IntervalKind::Scrambles(means.len() as u64))
            }
        }
    }

    fn of_share(share: Share, points: u64, interval: Option<Interval>, interval_kind: IntervalKind) -> Self {
        let found = Found::Shares { rounding_error: share.error };
        Self { probability: share.probability, interval, interval_kind, points, found }
    }

    /// The estimate from the mean share over a grid. It is `exact` if only the speed varies, so that the grid has one
    /// point.
    pub(crate) fn of_grid_share(share: Share, points: u64, exact: bool) -> Self {
        if !exact {
            return Self::of_share(share, points, None, IntervalKind::Grid);
        }
        let interval = Interval { lo: share.probability, hi: share.probability }.widened(share.error);
        Self::of_share(share, points, Some(interval), IntervalKind::Rounding)
    }

    /// The estimate from the mean of `points` shares by quadrature, with the errors of the rule and of rounding.
    pub(crate) fn of_quadrature(mean: f64, [rule, rounding]: [f64; 2], points: u64) -> Self {
        let share = Share::new(mean, rounding);
        let interval = Interval { lo: share.probability, hi: share.probability }.widened(rule + rounding);
        Self::of_share(share, points, Some(interval), IntervalKind::Quadrature)
    }

    pub(crate) fn of_scrambled_shares(scrambles: &[Share], points: u64) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "a handful of scrambles")]
        let mean = |part: fn(&Share) -> f64| scrambles.iter().map(part).sum::<f64>() / scrambles.len() as f64;
        let share = Share { probability: mean(|share| share.probability), error: mean(|share| share.error) };
        let means: Vec<f64> = scrambles.iter().map(|share| share.probability).collect();
        if means.iter().all(|mean| *mean == 0.0) || means.iter().all(|mean| *mean == 1.0) {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 or 1")]
            let interval = wilson(share.probability as u64 * points, points, LEVEL).widened(share.error);
            return Self::of_share(share, points, Some(interval), IntervalKind::Unanimous);
        }
        match from_scrambles(&means, LEVEL) {
            None => Self::of_share(share, points, None, IntervalKind::OneScramble),
            Some(interval) => {
                let kind = IntervalKind::Scrambles(means.len() as u64);
                Self::of_share(share, points, Some(interval.widened(share.error)), kind)
            }
        }
    }
}

/// Wilson's interval, widened so that it holds whatever the outcome of the undecided launches is.
fn wilson_of(counts: Counts) -> Interval {
    let points = counts.points();
    Interval {
        lo: wilson(counts.heads(), points, LEVEL).lo,
        hi: wilson(counts.heads() + counts.undecided(), points, LEVEL).hi,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn undecided_launches_widen_the_interval() {
        let counts = Counts::estimated(500, 300, 200);
        let interval = Estimate::of_independent_counts(counts).interval.unwrap();
        assert!(interval.lo < 0.5 && interval.hi > 0.7);
        let scrambles = [Counts::estimated(5, 3, 2); 8];
        let interval = Estimate::of_scrambled_counts(&scrambles).interval.unwrap();
        assert!((interval.lo - 0.5).abs() < 1e-15 && (interval.hi - 0.7).abs() < 1e-15, "{interval:?}");
        assert_eq!(Estimate::of_scrambled_counts(&scrambles[..1]).interval_kind, IntervalKind::OneScramble);
    }

    #[test]
    fn half_width_is_the_distance_to_the_farther_end_and_kinds_have_names() {
        let estimate = |lo, hi| Estimate {
            interval: Some(Interval { lo, hi }),
            ..Estimate::of_independent_counts(Counts::estimated(1, 1, 0))
        };
        assert_eq!((estimate(0.25, 0.625).half_width(), estimate(0.375, 0.75).half_width()), (Some(0.25), Some(0.25)));
        let none = Estimate::of_grid_counts(Counts::estimated(1, 0, 0));
        assert_eq!(none.half_width(), None);
        assert_eq!(IntervalKind::Scrambles(8).to_string(), "student 95 % of 8 scrambles");
        assert!(
            [IntervalKind::Grid, IntervalKind::OneScramble].iter().all(|kind| kind.to_string().starts_with("none"))
        );
    }
}
