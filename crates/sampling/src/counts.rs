//! Outcomes, counted: P(heads) = heads/(heads + tails + undecided).
//!
//! Proven and estimated outcomes are counted apart, and by type: proven ones come from the crate `exact` alone.

use std::ops::Range;

use dynamics::{Checked, Error, Outcome, Solver};
use exact::{Batch, ProvenCounts};

use crate::block::Block;
use crate::fold::{Progress, Tally, fold};
use crate::launches::Launches;
use crate::space::Space;

/// Outcomes, counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    estimated: Estimated,
    proven: ProvenCounts,
}

/// Outcomes that are as good as a solver's error estimate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct Estimated {
    heads: u64,
    tails: u64,
    undecided: u64,
}

impl Counts {
    /// Launches that land heads.
    pub fn heads(&self) -> u64 {
        self.estimated.heads + self.proven.heads()
    }

    /// Launches that land tails.
    pub fn tails(&self) -> u64 {
        self.estimated.tails + self.proven.tails()
    }

    /// Launches nearer to the edge than the solver's error estimate, and exact ties.
    pub fn undecided(&self) -> u64 {
        self.estimated.undecided + self.proven.ties()
    }

    /// The proven ones among them.
    pub fn proven(&self) -> ProvenCounts {
        self.proven
    }

    /// Number of launches.
    pub fn points(&self) -> u64 {
        self.heads() + self.tails() + self.undecided()
    }

    /// Share of heads among all launches, from 0 to 1.
    #[expect(clippy::cast_precision_loss, reason = "a ratio of counts")]
    pub fn probability(&self) -> f64 {
        self.heads() as f64 / self.points() as f64
    }

    /// Whether there are outcomes, and every one is proven.
    pub fn are_certified(&self) -> bool {
        self.proven.total() > 0 && self.estimated == Estimated::default()
    }

    /// Adds an estimated outcome.
    fn add(&mut self, outcome: Outcome) {
        match outcome {
            Outcome::Heads => self.estimated.heads += 1,
            Outcome::Tails => self.estimated.tails += 1,
            Outcome::Undecided => self.estimated.undecided += 1,
        }
    }

    #[cfg(test)]
    pub(crate) fn estimated(heads: u64, tails: u64, undecided: u64) -> Self {
        Self { estimated: Estimated { heads, tails, undecided }, proven: ProvenCounts::default() }
    }
}

impl Tally for Counts {
    fn merge(self, other: Self) -> Self {
        let (one, two) = (self.estimated, other.estimated);
        let estimated = Estimated {
            heads: one.heads + two.heads,
            tails: one.tails + two.tails,
            undecided: one.undecided + two.undecided,
        };
        Self { estimated, proven: self.proven + other.proven }
    }
}

impl std::iter::Sum for Counts {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        counts.fold(Self::default(), Self::merge)
    }
}

/// What decides the outcomes of launches.
#[derive(Clone)]
pub(crate) enum Decider<'a> {
    /// The exact motion, with a proof.
    Exact,
    /// A solver, as far as its error estimate goes.
    Solver(Checked<&'a dyn Solver>),
}

impl Decider<'_> {
    /// Counts the outcomes of the launches `range`.
    ///
    /// # Errors
    /// As [`fold`].
    pub(crate) fn count(
        &self,
        space: &Space,
        launches: &Launches,
        range: Range<u64>,
        progress: Progress<'_>,
    ) -> Result<Counts, Error> {
        fold(space, launches, range, progress, |block| match self {
            Self::Exact => proven(space, block).map(|proven| Counts { proven, ..Counts::default() }),
            Self::Solver(solver) => estimated(space, block, solver),
        })
    }
}

/// The proven outcomes of a block: in registers where its launches differ in rates and speed alone.
fn proven(space: &Space, block: &Block) -> Result<ProvenCounts, Error> {
    match space.tosses(block) {
        Some(tosses) => Batch::new(tosses).count(),
        None => ProvenCounts::of(block.all_values().map(|values| space.toss(&values))),
    }
}

/// The outcomes of a block by `solver`.
fn estimated(space: &Space, block: &Block, solver: &dyn Solver) -> Result<Counts, Error> {
    let mut counts = Counts::default();
    if let Some(tosses) = space.tosses(block) {
        let mut cos_tilts = vec![0.0; tosses.len()];
        solver.cos_tilts(&tosses, &mut cos_tilts)?;
        for (index, cos_tilt) in cos_tilts.into_iter().enumerate() {
            counts.add(tosses.solve(index, |toss| solver.outcome_at(toss, cos_tilt))?);
        }
        return Ok(counts);
    }
    for (index, values) in (0..).zip(block.all_values()) {
        let toss = space.toss(&values);
        let outcome = solver.outcome(&toss);
        counts.add(outcome.map_err(|source| Error::Launch { index, toss: Box::new(toss), source })?);
    }
    Ok(counts)
}

#[cfg(test)]
mod tests {
    use dynamics::Coin;
    use exact::{ExactSolver, Stage};

    use super::*;
    use crate::coordinate::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
    use crate::grid::Grid;

    fn counted(tilt: &str, decider: &Decider<'_>) -> Counts {
        let texts = [(RateX, "1:20:20"), (RateY, "0"), (RateZ, "0"), (Speed, "3:5:20"), (Tilt, tilt)];
        let space = Space::parse(Coin::PAPER, &texts).unwrap();
        let launches = Launches::Grid(Grid::new(&space).unwrap());
        decider.count(&space, &launches, 0..space.grid_points().unwrap(), &|_| {}).unwrap()
    }

    #[test]
    fn counts_add_up() {
        let [once, twice] = [Counts::estimated(3, 4, 5), Counts::estimated(6, 8, 10)];
        assert_eq!((once.merge(once), [once, once].into_iter().sum()), (twice, twice));
        assert_eq!((once.heads(), once.tails(), once.undecided(), once.points()), (3, 4, 5, 12));
        assert_eq!(once.probability(), 0.25);
    }

    #[test]
    fn counts_are_certified_if_there_are_any_and_every_launch_is_proven() {
        let proven = counted("0", &Decider::Exact);
        assert!(proven.are_certified());
        assert!(!Counts::default().are_certified());
        assert!(!Counts::estimated(0, 1, 0).are_certified());
        assert!(!proven.merge(Counts::estimated(1, 0, 0)).are_certified());
        assert!(!proven.merge(Counts::estimated(0, 0, 1)).are_certified());
    }

    /// A batch knows neither Keller's cosine nor outcomes that need no motion.
    #[test]
    fn launches_that_differ_in_rates_and_speed_are_a_batch() {
        let batch = counted("0", &Decider::Exact);
        assert_eq!((batch.points(), batch.proven().by(Stage::F64), batch.proven().by(Stage::Keller)), (400, 400, 0));
        let one_by_one = counted("0:1e-9:2", &Decider::Exact);
        assert!(one_by_one.are_certified() && one_by_one.proven().by(Stage::F64) < 800, "{one_by_one:?}");
    }

    /// The exact solver's outcomes are right, but as those of any solver that is handed in they are no proof.
    #[test]
    fn no_outcome_of_a_solver_is_proven() {
        for tilt in ["0", "0:1e-9:2"] {
            let by_solver = counted(tilt, &Decider::Solver(Checked::new(&ExactSolver)));
            let proven = counted(tilt, &Decider::Exact);
            assert_eq!((by_solver.heads(), by_solver.tails()), (proven.heads(), proven.tails()));
            assert_eq!((by_solver.are_certified(), by_solver.proven()), (false, ProvenCounts::default()));
        }
    }
}
