//! This file turns counts or shares of heads into an estimate: a probability with an interval. What the interval means
//! depends on how the launches were chosen, so each of the methods has its own:
//!
//! | plan | launches | interval |
//! |---|---|---|
//! | [`Plan::Grid`] (A) | a grid | none: a grid has a discretisation error |
//! | [`Plan::Random`] (B) | independent | Clopper and Pearson's |
//! | [`Plan::Sobol`] | scrambled Sobol points | from the spread of independent scrambles, and their resolution |
//! | [`Plan::ExactSpeed`] | all speeds in closed form | from the scrambles, and what is too rare for their points; a rounding error if only the speed varies |
//! | [`Plan::Enclosure`] | all of them | proven: both ends are bounds |
//!
//! A and B are the paper's names of the methods.

use std::fmt;

use crate::counts::Counts;
use crate::enclosure::Enclosure;
use crate::exact_speed::Share;
use crate::interval::{Interval, clopper_pearson, from_scrambled_points};
use crate::plan::Plan;

/// Confidence level of the intervals.
pub const LEVEL: f64 = 0.95;

/// The meaning of an interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IntervalKind {
    /// There is no interval, because the points are a grid.
    Grid,
    /// There is no interval, because the points are from a single scramble.
    OneScramble,
    /// Clopper and Pearson's interval for independent launches.
    ClopperPearson,
    /// Student's interval from the means of this many independent scrambles, extended by what is
    /// [too rare](crate::unresolved) for their points.
    Scrambles(u64),
    /// Student's interval from the means of this many independent scrambles, extended as far as their points
    /// [resolve](crate::interval#scrambles-that-agree): the scrambles agree too well for their spread to tell the error, or most of
    /// it is what is [too rare](crate::unresolved) for them.
    Resolution(u64),
    /// Clopper and Pearson's interval, as if the points were independent. All points of all scrambles have the same outcome,
    /// so the spread of the scrambles is 0 and gives no error.
    Unanimous,
    /// A bound on the rounding error, because nothing was sampled.
    Rounding,
    /// A proof: the probability lies between both ends.
    Proven,
    /// From 0 to 1, because no launch is decided.
    NoneDecided,
}

impl fmt::Display for IntervalKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Grid => f.write_str("none: a grid has a discretisation error, not a confidence interval"),
            Self::OneScramble => f.write_str("none: one scramble gives no error estimate"),
            Self::ClopperPearson => f.write_str("clopper-pearson 95 %"),
            Self::Scrambles(number) => write!(f, "student 95 % of {number} scrambles"),
            Self::Resolution(number) => write!(f, "95 % of {number} scrambles, as far as their points resolve"),
            Self::Unanimous => f.write_str("clopper-pearson 95 %, all points agree"),
            Self::Rounding => f.write_str("rounding error"),
            Self::Proven => f.write_str("proven"),
            Self::NoneDecided => f.write_str("no launch is decided"),
        }
    }
}

/// An estimate of the probability of heads.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Estimated probability of heads, from 0 to 1: of counts, the share of heads among the decided launches. If no launch is
    /// decided it is ½, the middle of the interval; see [`Estimate::is_known`].
    pub probability: f64,
    /// Interval in which the probability lies, at the confidence [`LEVEL`]. It allows for either outcome of the
    /// undecided launches.
    pub interval: Option<Interval>,
    /// Meaning of the interval.
    pub interval_kind: IntervalKind,
    /// Number of launches; if the speed was integrated in closed form, each of them stands for all speeds. Of an enclosure, the number
    /// of its cells.
    pub points: u64,
    /// The result that the estimate is made from.
    pub found: Found,
    /// The plan of the launches.
    pub plan: Plan,
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
    /// The sum over the cells of an enclosure.
    Enclosed {
        /// Whether its cells are all that were allowed, so that more of them might have made it narrower.
        is_spent: bool,
    },
}

impl Estimate {
    /// Distance from the probability to the farther end of the interval; `None` without an interval.
    pub fn half_width(&self) -> Option<f64> {
        let Interval { lo, hi } = self.interval?;
        Some((self.probability - lo).max(hi - self.probability))
    }

    /// Whether this is an enclosure that did not reach its accuracy with its number of cells. Its interval is proven all the
    /// same.
    pub fn is_wider_than_asked(&self) -> bool {
        matches!(self.plan, Plan::Enclosure { accuracy } if self.half_width().is_some_and(|reached| reached > accuracy))
    }

    /// What the interval means, and whether it is wider than was asked for.
    pub fn interval_in_words(&self) -> String {
        let wider = if self.is_wider_than_asked() { ", but wider than was asked for" } else { "" };
        format!("{}{wider}", self.interval_kind)
    }

    /// Whether any launch is decided. If none is, nothing is known of the probability.
    pub fn is_known(&self) -> bool {
        self.interval_kind != IntervalKind::NoneDecided
    }

    /// The number of launches whose outcome is undecided.
    pub fn undecided(&self) -> u64 {
        match self.found {
            Found::Counts(counts) => counts.undecided(),
            Found::Shares { .. } if !self.is_known() => self.points,
            Found::Shares { .. } | Found::Enclosed { .. } => 0,
        }
    }

    fn of_counts(plan: Plan, counts: Counts, interval: Option<Interval>, interval_kind: IntervalKind) -> Self {
        let (found, points) = (Found::Counts(counts), counts.points());
        match counts.probability() {
            Some(probability) => Self { probability, interval, interval_kind, points, found, plan },
            None => Self::of_nothing(plan, found, points),
        }
    }

    /// The estimate from `points` launches of which none is decided.
    fn of_nothing(plan: Plan, found: Found, points: u64) -> Self {
        let interval = Some(Interval { lo: 0.0, hi: 1.0 });
        Self { probability: 0.5, interval, interval_kind: IntervalKind::NoneDecided, points, found, plan }
    }

    pub(crate) fn of_grid_counts(plan: Plan, counts: Counts) -> Self {
        Self::of_counts(plan, counts, None, IntervalKind::Grid)
    }

    pub(crate) fn of_independent_counts(plan: Plan, counts: Counts) -> Self {
        Self::of_counts(plan, counts, Some(of_independent(counts)), IntervalKind::ClopperPearson)
    }

    pub(crate) fn of_scrambled_counts(plan: Plan, scrambles: &[Counts]) -> Self {
        let counts: Counts = scrambles.iter().copied().sum();
        if counts.heads() == counts.points() || counts.tails() == counts.points() {
            return Self::of_counts(plan, counts, Some(of_independent(counts)), IntervalKind::Unanimous);
        }
        // The undecided launches may all land tails, or all heads.
        let from = |probability: fn(&Counts) -> f64| {
            let means: Vec<f64> = scrambles.iter().map(probability).collect();
            from_scrambled_points(&means, 0.0, counts.points(), LEVEL)
        };
        match (from(Counts::smallest_probability), from(Counts::largest_probability)) {
            (Some((low, low_is_wider)), Some((high, high_is_wider))) => {
                let kind = of_scrambles(scrambles.len(), low_is_wider || high_is_wider);
                Self::of_counts(plan, counts, Some(Interval { lo: low.lo, hi: high.hi }), kind)
            }
            _ => Self::of_counts(plan, counts, None, IntervalKind::OneScramble),
        }
    }

    fn of_share(
        plan: Plan,
        share: Share,
        points: u64,
        interval: Option<Interval>,
        interval_kind: IntervalKind,
    ) -> Self {
        let found = Found::Shares { rounding_error: share.error };
        if share.error >= 0.5 {
            return Self::of_nothing(plan, found, points);
        }
        Self { probability: share.probability, interval, interval_kind, points, found, plan }
    }

    /// The estimate from the mean share over a grid. It is `exact` if only the speed varies, so that the grid has one
    /// point.
    pub(crate) fn of_grid_share(plan: Plan, share: Share, points: u64, exact: bool) -> Self {
        if !exact {
            return Self::of_share(plan, share, points, None, IntervalKind::Grid);
        }
        let interval = Interval { lo: share.probability, hi: share.probability }.widened(share.error);
        Self::of_share(plan, share, points, Some(interval), IntervalKind::Rounding)
    }

    /// The estimate from an enclosure.
    pub(crate) fn of_enclosure(accuracy: f64, Enclosure { interval, cells, is_spent }: Enclosure) -> Self {
        Self {
            probability: 0.5 * (interval.lo + interval.hi),
            interval: Some(interval),
            interval_kind: IntervalKind::Proven,
            points: cells,
            found: Found::Enclosed { is_spent },
            plan: Plan::Enclosure { accuracy },
        }
    }

    /// The estimate from the mean shares of scrambles with this many points in all. `unresolved` tells what the points do not
    /// [resolve](crate::unresolved).
    pub(crate) fn of_scrambled_shares(
        plan: Plan,
        scrambles: &[Share],
        points: u64,
        unresolved: impl FnOnce() -> f64,
    ) -> Self {
        #[expect(clippy::cast_precision_loss, reason = "a handful of scrambles")]
        let mean = |part: fn(&Share) -> f64| scrambles.iter().map(part).sum::<f64>() / scrambles.len() as f64;
        let share = Share { probability: mean(|share| share.probability), error: mean(|share| share.error) };
        let means: Vec<f64> = scrambles.iter().map(|share| share.probability).collect();
        if means.iter().all(|mean| *mean == 0.0) || means.iter().all(|mean| *mean == 1.0) {
            let heads = if share.probability == 0.0 { 0 } else { points };
            let interval = clopper_pearson(heads, points, LEVEL).widened(share.error);
            return Self::of_share(plan, share, points, Some(interval), IntervalKind::Unanimous);
        }
        let largest_error = scrambles.iter().map(|share| share.error).fold(0.0, f64::max);
        match from_scrambled_points(&means, largest_error, points, LEVEL) {
            None => Self::of_share(plan, share, points, None, IntervalKind::OneScramble),
            Some((interval, is_wider)) => {
                let unresolved = unresolved();
                let kind = of_scrambles(means.len(), is_wider || unresolved > 0.5 * interval.width());
                Self::of_share(plan, share, points, Some(interval.widened(share.error + unresolved)), kind)
            }
        }
    }
}

/// The kind of an interval from this many scrambles, which may be wider than Student's.
fn of_scrambles(number: usize, is_wider: bool) -> IntervalKind {
    if is_wider { IntervalKind::Resolution(number as u64) } else { IntervalKind::Scrambles(number as u64) }
}

/// Clopper and Pearson's interval, widened so that it holds whatever the outcome of the undecided launches is.
pub(crate) fn of_independent(counts: Counts) -> Interval {
    let points = counts.points();
    Interval {
        lo: clopper_pearson(counts.heads(), points, LEVEL).lo,
        hi: clopper_pearson(counts.heads() + counts.undecided(), points, LEVEL).hi,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of any launches.
    const PLAN: Plan = Plan::Grid;

    #[test]
    fn undecided_launches_widen_the_interval() {
        let counts = Counts::estimated(500, 300, 200);
        let interval = Estimate::of_independent_counts(PLAN, counts).interval.unwrap();
        assert!(interval.lo < 0.5 && interval.hi > 0.7);
        let scrambles = [Counts::estimated(5, 3, 2); 8];
        let interval = Estimate::of_scrambled_counts(PLAN, &scrambles).interval.unwrap();
        // The scrambles agree, on 0.5 and on 0.7 if the undecided launches are heads, as 0 of 80 do on 0.
        let reach = clopper_pearson(0, 80, LEVEL).hi;
        let [lo, hi] = [interval.lo - (0.5 - reach), interval.hi - (0.7 + reach)];
        assert!(lo.abs() < 1e-12 && hi.abs() < 1e-12, "{interval:?}");
        assert_eq!(Estimate::of_scrambled_counts(PLAN, &scrambles[..1]).interval_kind, IntervalKind::OneScramble);
    }

    /// An undecided launch counts neither as heads nor as tails, whichever the plan.
    #[test]
    fn undecided_launches_are_in_no_share_and_if_none_is_decided_nothing_is_known() {
        let of = |counts: Counts| {
            [
                Estimate::of_grid_counts(PLAN, counts),
                Estimate::of_independent_counts(PLAN, counts),
                Estimate::of_scrambled_counts(PLAN, &[counts; 8]),
            ]
        };
        for found in of(Counts::estimated(3, 1, 60)) {
            assert_eq!((found.probability, found.is_known()), (0.75, true));
            assert!(found.interval.is_none_or(|interval| interval.lo < 3.0 / 64.0 && interval.hi > 63.0 / 64.0));
        }
        for found in of(Counts::estimated(0, 40, 24)) {
            assert!(found.interval.is_none_or(|interval| interval.hi > 24.0 / 64.0), "{found:?}");
            assert_ne!(found.interval_kind, IntervalKind::Unanimous);
        }
        let tie = Estimate::of_grid_share(PLAN, Share::new(0.5, 0.5), 1, true);
        for found in of(Counts::estimated(0, 0, 64)).into_iter().chain([tie]) {
            let interval = Some(Interval { lo: 0.0, hi: 1.0 });
            assert_eq!((found.probability, found.interval, found.is_known()), (0.5, interval, false));
            assert_eq!(
                (found.undecided(), found.interval_kind.to_string()),
                (found.points, "no launch is decided".to_owned())
            );
        }
    }

    #[test]
    fn half_width_is_the_distance_to_the_farther_end_and_kinds_have_names() {
        let estimate = |lo, hi| Estimate {
            interval: Some(Interval { lo, hi }),
            ..Estimate::of_independent_counts(PLAN, Counts::estimated(1, 1, 0))
        };
        assert_eq!((estimate(0.25, 0.625).half_width(), estimate(0.375, 0.75).half_width()), (Some(0.25), Some(0.25)));
        let none = Estimate::of_grid_counts(PLAN, Counts::estimated(1, 0, 0));
        assert_eq!(none.half_width(), None);
        assert_eq!(IntervalKind::Scrambles(8).to_string(), "student 95 % of 8 scrambles");
        assert!(
            [IntervalKind::Grid, IntervalKind::OneScramble].iter().all(|kind| kind.to_string().starts_with("none"))
        );
    }
}
