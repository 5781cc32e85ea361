//! Outcomes, counted: P(heads) = heads/(heads + tails + undecided).

use std::ops::Range;

use dynamics::batch::{BatchError, Filtered, TossError, Tosses};
use dynamics::{Outcome, Solver, Stage, Verdict};
use serde::Serialize;

use crate::fold::{Failure, Progress, SampleError, Tally, fold};
use crate::launches::Launches;
use crate::space::Space;

/// Outcomes, counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Launches that land heads.
    pub heads: u64,
    /// Launches that land tails.
    pub tails: u64,
    /// Launches nearer to the edge than the solver answers for; if outcomes are proven, exact ties.
    pub undecided: u64,
    /// Launches whose outcome is proven.
    pub proven: Proven,
}

/// How many outcomes each stage of the proof decided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Proven {
    /// By the cosine of Keller's coin.
    pub keller: u64,
    /// Without evaluating the motion.
    pub certain: u64,
    /// By f64.
    pub f64: u64,
    /// By double-double.
    pub double_double: u64,
    /// By more digits than that.
    pub multiprecision: u64,
}

impl Counts {
    /// Number of launches.
    pub fn points(&self) -> u64 {
        self.heads + self.tails + self.undecided
    }

    /// Share of heads among all launches, from 0 to 1.
    #[expect(clippy::cast_precision_loss, reason = "a ratio of counts")]
    pub fn probability(&self) -> f64 {
        self.heads as f64 / self.points() as f64
    }

    /// Whether every outcome is proven.
    pub fn are_certified(&self) -> bool {
        let Proven { certain, keller, f64, double_double, multiprecision } = self.proven;
        certain + keller + f64 + double_double + multiprecision == self.points()
    }

    /// Adds the outcomes of a batch.
    fn add_batch(&mut self, solver: &dyn Solver, tosses: &Tosses<'_>) -> Result<(), BatchError> {
        let Filtered { heads, tails } = solver.count(tosses, &mut |verdict| self.add(verdict))?;
        self.heads += heads;
        self.tails += tails;
        self.proven.f64 += heads + tails;
        Ok(())
    }

    #[inline]
    fn add(&mut self, verdict: Verdict) {
        match verdict.outcome {
            Outcome::Heads => self.heads += 1,
            Outcome::Tails => self.tails += 1,
            Outcome::Undecided => self.undecided += 1,
        }
        match verdict.proof {
            Some(Stage::Certain) => self.proven.certain += 1,
            Some(Stage::Keller) => self.proven.keller += 1,
            Some(Stage::F64) => self.proven.f64 += 1,
            Some(Stage::DoubleDouble) => self.proven.double_double += 1,
            Some(Stage::Multiprecision) => self.proven.multiprecision += 1,
            None => {}
        }
    }
}

impl Tally for Counts {
    fn merge(self, other: Self) -> Self {
        Self {
            heads: self.heads + other.heads,
            tails: self.tails + other.tails,
            undecided: self.undecided + other.undecided,
            proven: Proven {
                certain: self.proven.certain + other.proven.certain,
                keller: self.proven.keller + other.proven.keller,
                f64: self.proven.f64 + other.proven.f64,
                double_double: self.proven.double_double + other.proven.double_double,
                multiprecision: self.proven.multiprecision + other.proven.multiprecision,
            },
        }
    }
}

impl std::iter::Sum for Counts {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        counts.fold(Self::default(), Self::merge)
    }
}

/// Counts the outcomes of the launches `range`, by `solver`.
pub(crate) fn count(
    space: &Space,
    launches: &Launches,
    range: Range<u64>,
    solver: &dyn Solver,
    progress: Progress<'_>,
) -> Result<Counts, SampleError> {
    fold(space, launches, range, progress, |first, block| {
        let mut counts = Counts::default();
        match space.tosses(block) {
            Some(tosses) => counts.add_batch(solver, &tosses).map_err(|error| failure(first, &tosses, error))?,
            None => {
                for (index, values) in (first..).zip(block.all_values()) {
                    let toss = space.toss(&values);
                    counts.add(solver.verdict(&toss).map_err(|error| (index, Box::new(toss), error))?);
                }
            }
        }
        Ok(counts)
    })
}

/// What stands for an error in a batch whose first launch has the number `first`.
fn failure(first: u64, tosses: &Tosses<'_>, BatchError { index, source }: BatchError) -> Failure {
    let toss = tosses.toss(index).expect("every axis was checked when the space was made");
    match source {
        TossError::Solve(error) => (first + index as u64, Box::new(toss), error),
        TossError::Input(_) => unreachable!("every axis was checked when the space was made"),
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, ExactSolver};

    use super::*;
    use crate::coordinate::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
    use crate::grid::Grid;

    /// As many verdicts of each kind as its place in the list, from 1 on.
    fn counts(times: u64) -> Counts {
        let mut counts = Counts::default();
        let proofs = [None].into_iter().chain(Stage::ALL.map(Some));
        for (place, proof) in (1..).zip(proofs) {
            for _ in 0..times * place {
                counts.add(Verdict { outcome: Outcome::Heads, proof });
            }
        }
        for _ in 0..times * 10 {
            counts.add(Verdict { outcome: Outcome::Tails, proof: None });
            counts.add(Verdict { outcome: Outcome::Tails, proof: None });
            counts.add(Verdict { outcome: Outcome::Undecided, proof: None });
        }
        counts
    }

    #[test]
    fn every_verdict_is_counted_once_by_its_outcome_and_once_by_its_proof() {
        let proven = Proven { keller: 2, certain: 3, f64: 4, double_double: 5, multiprecision: 6 };
        let once = Counts { heads: 21, tails: 20, undecided: 10, proven };
        assert_eq!(counts(1), once);
        assert_eq!((once.points(), once.probability()), (51, 21.0 / 51.0));
        let proven = Proven { keller: 6, certain: 9, f64: 12, double_double: 15, multiprecision: 18 };
        let thrice = Counts { heads: 63, tails: 60, undecided: 30, proven };
        assert_eq!((counts(1).merge(counts(2)), [counts(2), counts(1)].into_iter().sum()), (thrice, thrice));
    }

    #[test]
    fn counts_are_certified_if_every_launch_is_proven() {
        let proven = Proven { keller: 1, certain: 2, f64: 4, double_double: 8, multiprecision: 16 };
        let counts = Counts { heads: 11, tails: 13, undecided: 7, proven };
        assert!(counts.are_certified());
        assert!(!Counts { heads: 12, ..counts }.are_certified());
    }

    /// A batch knows neither Keller's cosine nor outcomes that need no motion.
    #[test]
    fn launches_that_differ_in_rates_and_speed_are_a_batch() {
        let counted = |tilt| {
            let texts = [(RateX, "1:20:20"), (RateY, "0"), (RateZ, "0"), (Speed, "3:5:20"), (Tilt, tilt)];
            let space = Space::parse(Coin::PAPER, &texts).unwrap();
            let launches = Launches::Grid(Grid::new(&space).unwrap());
            count(&space, &launches, 0..space.grid_points().unwrap(), &ExactSolver, &|_| {}).unwrap()
        };
        let batch = counted("0");
        assert!(batch.are_certified() && batch.points() == 400, "{batch:?}");
        assert_eq!((batch.proven.f64, batch.proven.keller), (400, 0));
        let one_by_one = counted("0:1e-9:2");
        assert!(one_by_one.are_certified() && one_by_one.proven.f64 < 800, "{one_by_one:?}");
    }
}
