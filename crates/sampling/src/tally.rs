//! This file holds tallies, the partial results of an estimate. A tally says which launches of a plan it counts, and two
//! tallies of neighbouring launches merge by addition. All sums are integers, so that any partition of a plan, on any
//! number of machines, gives the estimate of the whole to the last bit.

use std::ops::Range;

use dynamics::{Error, InputError, Solver};

use crate::counts::{Counts, Decider};
use crate::estimate::Estimate;
use crate::fold::Sum;
use crate::plan::{Plan, Rest, cube_of_the_rest};
use crate::sampler::Sampler;
use crate::sequences::Sequences;
use crate::shares::{Shares, add_shares};
use crate::space::Space;
use crate::unresolved::unresolved;

/// The result of some launches of a plan.
///
/// ```
/// use dynamics::Coin;
/// use sampling::{Estimate, Plan, Sampler, Space};
///
/// let space = Space::builder(Coin::PAPER).rate_x(0.0..=50.0).tie_rate_y_to_x().rate_z(30.0).speed(3.0..=5.0).build()?;
/// let (plan, sampler) = (Plan::Random { points: 10_000, seed: 1 }, Sampler::exact());
/// let tallies = [sampler.tally(&space, plan, 0..3333)?, sampler.tally(&space, plan, 3333..10_000)?];
/// let [first, second] = tallies;
/// assert_eq!(first.merge(second)?.estimate()?, sampler.estimate(&space, plan)?);
/// # Ok::<(), dynamics::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::tally_data::TallyData", into = "crate::tally_data::TallyData")
)]
pub struct Tally {
    pub(crate) space: Space,
    pub(crate) plan: Plan,
    pub(crate) range: Range<u64>,
    pub(crate) sums: Sums,
}

/// The sums of a tally, one for each sequence of launches of its plan.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Sums {
    Counts(Vec<Counts>),
    Shares(Vec<Shares>),
}

impl Sampler<'_> {
    /// The result of the launches with the numbers `range` of `plan`. Launches are numbered from 0, through all scrambles.
    ///
    /// # Errors
    /// As [`Sampler::estimate`]; [`InputError`] for a range beyond the launches of the plan, and for a sampler that does
    /// not decide by the exact motion, because tallies do not say how a solver was set.
    pub fn tally(&self, space: &Space, plan: Plan, range: Range<u64>) -> Result<Tally, Error> {
        if let Decider::Solver(solver) = &self.decider {
            let (value, expected) =
                (solver.name().to_owned(), "the exact motion, which alone decides the parts of a plan");
            return Err(InputError::Malformed { field: "solver", value, expected }.into());
        }
        require_within(&range, plan.points(space)?)?;
        let sums = self.sums(space, plan, &range)?;
        sums.require(range.end - range.start)?;
        Ok(Tally { space: *space, plan, range, sums })
    }

    /// The sums of the launches with the numbers `range`, or of those that were done when it was time to end.
    pub(crate) fn sums(&self, space: &Space, plan: Plan, range: &Range<u64>) -> Result<Sums, Error> {
        let sequences = Sequences::new(space, plan)?;
        if matches!(plan, Plan::ExactSpeed(_)) {
            let add = |launches: &_, part| add_shares(space, launches, part, self.watch());
            return Ok(Sums::Shares(sequences.each_part(range, add)?));
        }
        let count = |launches: &_, part| self.decider.count(space, launches, part, self.watch());
        Ok(Sums::Counts(sequences.each_part(range, count)?))
    }
}

/// Requires a range of the launches of a plan that has `points` of them.
fn require_within(range: &Range<u64>, points: u64) -> Result<(), InputError> {
    if range.start <= range.end && range.end <= points {
        return Ok(());
    }
    let value = format!("{}..{} of {points}", range.start, range.end);
    Err(InputError::Malformed { field: "range", value, expected: "an ascending range of the launches of the plan" })
}

impl Sums {
    /// The number of launches.
    pub(crate) fn launches(&self) -> u64 {
        match self {
            Self::Counts(counts) => counts.iter().map(Counts::points).sum(),
            Self::Shares(shares) => shares.iter().map(|shares| shares.launches).sum(),
        }
    }

    /// Refuses sums of fewer launches than were wanted, because it was time to end.
    pub(crate) fn require(&self, launches: u64) -> Result<(), Error> {
        if self.launches() < launches { Err(Error::Ended) } else { Ok(()) }
    }

    /// The estimate of `plan` over `space` from the sums of all its launches.
    pub(crate) fn estimate(&self, space: &Space, plan: Plan) -> Result<Estimate, InputError> {
        let points = plan.points(space)?;
        Ok(match self {
            Self::Counts(counts) => match plan {
                Plan::Sobol(_) => Estimate::of_scrambled_counts(plan, counts),
                Plan::Random { .. } => Estimate::of_independent_counts(plan, counts.iter().copied().sum()),
                _ => Estimate::of_grid_counts(plan, counts.iter().copied().sum()),
            },
            Self::Shares(shares) => {
                let means: Vec<_> = shares.iter().map(Shares::mean).collect();
                let only_the_speed_varies = cube_of_the_rest(space).dimensions() == 0;
                match (plan, &means[..]) {
                    (Plan::ExactSpeed(Rest::Sobol(scrambled)), means) if !only_the_speed_varies => {
                        Estimate::of_scrambled_shares(plan, means, points, || unresolved(space, scrambled))
                    }
                    (_, means) => Estimate::of_grid_share(plan, means[0], points, only_the_speed_varies),
                }
            }
        })
    }
}

impl Tally {
    /// Makes a tally of sums from elsewhere.
    ///
    /// # Errors
    /// [`InputError`] if they are not the sums of as many launches as `range` has of each sequence of the plan.
    #[cfg(feature = "serde")]
    pub(crate) fn new(space: Space, plan: Plan, range: Range<u64>, sums: Sums) -> Result<Self, InputError> {
        require_within(&range, plan.points(&space)?)?;
        let sequences = Sequences::new(&space, plan)?;
        let are_shares = matches!(sums, Sums::Shares(_));
        let part = |index| {
            let part = sequences.part(index, &range);
            part.end - part.start
        };
        let points: Vec<u64> = match &sums {
            Sums::Counts(counts) => counts.iter().map(Counts::points).collect(),
            Sums::Shares(shares) => shares.iter().map(|shares| shares.launches).collect(),
        };
        let fits =
            points.len() as u64 == sequences.number() && (0..).map(part).zip(&points).all(|(one, two)| one == *two);
        if are_shares == matches!(plan, Plan::ExactSpeed(_)) && fits {
            return Ok(Self { space, plan, range, sums });
        }
        let expected = "the sums of all launches of the range, for each scramble";
        Err(InputError::Malformed { field: "sums", value: format!("{points:?} launches"), expected })
    }

    /// The space of the launches.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// The plan that chooses the launches.
    pub fn plan(&self) -> Plan {
        self.plan
    }

    /// The numbers of the launches that are in this tally.
    pub fn range(&self) -> Range<u64> {
        self.range.clone()
    }

    /// Whether this tally and `other` are parts of the same plan over the same space.
    pub fn is_of_the_plan_of(&self, other: &Self) -> bool {
        self.space == other.space && self.plan == other.plan
    }

    /// The tally of the launches of both, which have to be neighbours.
    ///
    /// # Errors
    /// [`InputError`] if the tallies are of different plans or spaces, if there are launches between them, or if they share
    /// launches.
    pub fn merge(self, other: Self) -> Result<Self, InputError> {
        let refused = |expected| {
            let (one, two) = (&self.range, &other.range);
            let value = format!("{}..{} and {}..{}", one.start, one.end, two.start, two.end);
            Err(InputError::Malformed { field: "range", value, expected })
        };
        if !self.is_of_the_plan_of(&other) {
            return refused("parts of the same plan over the same space");
        }
        // Of two that start with the same launch, one without any launch comes first.
        let is_first = (self.range.start, self.range.end) <= (other.range.start, other.range.end);
        let (first, second) = if is_first { (&self, &other) } else { (&other, &self) };
        if first.range.end < second.range.start {
            return refused("neighbouring parts; between these launches are missing");
        }
        if first.range.end > second.range.start {
            return refused("parts that share no launch");
        }
        let range = first.range.start..second.range.end;
        let sums = match (self.sums, other.sums) {
            (Sums::Counts(one), Sums::Counts(two)) => Sums::Counts(merged(one, two)),
            (Sums::Shares(one), Sums::Shares(two)) => Sums::Shares(merged(one, two)),
            _ => unreachable!("the plan decides between counts and shares"),
        };
        Ok(Self { range, sums, ..self })
    }

    /// The estimate from a tally of all launches of its plan.
    ///
    /// # Errors
    /// [`InputError`] if launches are missing.
    pub fn estimate(&self) -> Result<Estimate, InputError> {
        let points = self.plan.points(&self.space)?;
        if self.range == (0..points) {
            return self.sums.estimate(&self.space, self.plan);
        }
        let value = format!("{}..{} of {points}", self.range.start, self.range.end);
        Err(InputError::Malformed { field: "range", value, expected: "all launches of the plan" })
    }
}

/// The sums of two tallies, sequence by sequence.
fn merged<T: Sum>(one: Vec<T>, two: Vec<T>) -> Vec<T> {
    one.into_iter().zip(two).map(|(one, two)| one.merge(two)).collect()
}

#[cfg(test)]
mod tests;
