//! This file counts the outcomes of launches. An undecided launch may land either way, so that it counts for neither: the
//! share of heads is heads/(heads + tails), and there is none if no launch is decided. The share of all launches lies between
//! that with all undecided ones tails and that with all heads, and so does the share of the decided ones. Proven and
//! estimated outcomes are counted in different types, so that an estimated one cannot pass as proven: only the crate
//! `exact` can make proven counts.

use std::ops::Range;

use dynamics::{Body, Checked, Error, Solver, Tilt, Toss};
use exact::{Batch, BodyFilter, ProvenCounts};

use crate::block::Block;
use crate::fold::{Sum, Watch, fold};
use crate::launches::Launches;
use crate::space::Space;

/// Numbers of launches by their outcome.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Outcomes that a solver decided; they are as reliable as its error estimate.
    estimated: dynamics::Counts,
    proven: ProvenCounts,
}

impl Counts {
    /// Number of launches that land heads.
    pub fn heads(&self) -> u64 {
        self.estimated.heads + self.proven.heads
    }

    /// Number of launches that land tails.
    pub fn tails(&self) -> u64 {
        self.estimated.tails + self.proven.tails
    }

    /// Number of launches that land with |cos θ| below the solver's error estimate, and of exact ties.
    pub fn undecided(&self) -> u64 {
        self.estimated.undecided + self.proven.undecided
    }

    /// The proven outcomes among them.
    pub fn proven(&self) -> ProvenCounts {
        self.proven
    }

    /// Number of all launches.
    pub fn points(&self) -> u64 {
        self.heads() + self.tails() + self.undecided()
    }

    /// Fraction of heads among the decided launches, from 0 to 1; `None` if none is decided.
    #[expect(clippy::cast_precision_loss, reason = "a ratio of counts")]
    pub fn probability(&self) -> Option<f64> {
        let decided = self.heads() + self.tails();
        (decided > 0).then(|| self.heads() as f64 / decided as f64)
    }

    /// Fraction of heads among all launches if all undecided ones land tails.
    #[expect(clippy::cast_precision_loss, reason = "a ratio of counts")]
    pub(crate) fn smallest_probability(&self) -> f64 {
        self.heads() as f64 / self.points() as f64
    }

    /// The same fraction if all undecided launches land heads.
    #[expect(clippy::cast_precision_loss, reason = "a ratio of counts")]
    pub(crate) fn largest_probability(&self) -> f64 {
        (self.heads() + self.undecided()) as f64 / self.points() as f64
    }

    /// Whether every outcome is proven, and there is at least one.
    pub fn are_certified(&self) -> bool {
        self.proven.total() > 0 && self.proven.without_proof == 0 && self.estimated.total() == 0
    }

    /// Counts of outcomes none of which is proven.
    #[cfg(any(test, feature = "serde"))]
    pub(crate) fn estimated(heads: u64, tails: u64, undecided: u64) -> Self {
        let estimated = dynamics::Counts { heads, tails, undecided, ..dynamics::Counts::default() };
        Self { estimated, ..Self::default() }
    }
}

impl Sum for Counts {
    fn merge(self, other: Self) -> Self {
        Self { estimated: self.estimated + other.estimated, proven: self.proven + other.proven }
    }
}

impl std::iter::Sum for Counts {
    fn sum<I: Iterator<Item = Self>>(counts: I) -> Self {
        counts.fold(Self::default(), Self::merge)
    }
}

/// The method that decides the outcomes of launches.
#[derive(Clone)]
pub(crate) enum Decider<'a> {
    /// By the exact motion, with a proof.
    Exact,
    /// By a solver; an outcome within its error estimate is undecided.
    Solver(Checked<&'a dyn Solver>),
}

impl Decider<'_> {
    /// Counts the outcomes of the launches with the numbers `range`.
    pub(crate) fn count(
        &self,
        space: &Space,
        launches: &Launches,
        range: Range<u64>,
        watch: Watch<'_>,
    ) -> Result<Counts, Error> {
        match self {
            Self::Exact => {
                let filter = filter_of(space);
                let counts = |proven| Counts { proven, ..Counts::default() };
                fold(space, launches, range, watch, |block| proven(space, block, filter.as_ref()).map(counts))
            }
            Self::Solver(solver) => fold(space, launches, range, watch, |block| estimated(space, block, solver)),
        }
    }
}

/// What the batches of all blocks share if they are of a body that is not a coin.
fn filter_of(space: &Space) -> Option<BodyFilter> {
    let none = Block::new(space);
    let tosses = space.tosses_of(*space.body(), &none).filter(|_| space.coin().is_none());
    tosses.map(|tosses| BodyFilter::new(&tosses))
}

/// Proves the outcomes of a block: as a batch if its launches differ in rates and speed alone, else one by one.
fn proven(space: &Space, block: &Block, filter: Option<&BodyFilter>) -> Result<ProvenCounts, Error> {
    let batch = match space.body() {
        Body::Coin(coin) => space.tosses_of(*coin, block).map(|tosses| Batch::new(tosses).count()),
        body @ Body::Rigid(_) => {
            let tosses = space.tosses_of(*body, block).zip(filter);
            tosses.map(|(tosses, filter)| Batch::new(tosses).count_by(filter))
        }
    };
    batch.unwrap_or_else(|| ProvenCounts::of(block.all_values().map(|values| space.toss(&values))))
}

/// Decides the outcomes of a block by `solver`.
fn estimated(space: &Space, block: &Block, solver: &dyn Solver) -> Result<Counts, Error> {
    let tosses: Vec<Toss> = block.all_values().map(|values| space.toss(&values)).collect();
    let mut tilts = vec![Tilt { cos_tilt: 0.0, error: None }; tosses.len()];
    solver.tilts(&tosses, &mut tilts)?;
    let mut estimated = dynamics::Counts::default();
    tilts.into_iter().for_each(|tilt| estimated.add(tilt.outcome()));
    Ok(Counts { estimated, ..Counts::default() })
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Stage};
    use exact::ExactSolver;

    use super::*;
    use crate::coordinate::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
    use crate::grid::Grid;

    fn counted(tilt: &str, decider: &Decider<'_>) -> Counts {
        let texts = [(RateX, "1:20:20"), (RateY, "0"), (RateZ, "0"), (Speed, "3:5:20"), (Tilt, tilt)];
        let space = Space::parse(Coin::PAPER, &texts).unwrap();
        let launches = Launches::Grid(Grid::new(&space).unwrap());
        decider.count(&space, &launches, 0..space.grid_points().unwrap(), (&|_| {}, &|| false)).unwrap()
    }

    #[test]
    fn merged_counts_are_sums() {
        let [once, twice] = [Counts::estimated(3, 4, 5), Counts::estimated(6, 8, 10)];
        assert_eq!((once.merge(once), [once, once].into_iter().sum()), (twice, twice));
        assert_eq!((once.heads(), once.tails(), once.undecided(), once.points()), (3, 4, 5, 12));
        assert_eq!((once.probability(), Counts::estimated(0, 0, 9).probability()), (Some(3.0 / 7.0), None));
        assert_eq!([once.smallest_probability(), once.largest_probability()], [0.25, 8.0 / 12.0]);
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

    #[test]
    fn launches_are_proven_in_f64_in_a_batch_and_one_by_one() {
        for (tilt, points) in [("0", 400), ("0:1e-9:2", 800)] {
            let counts = counted(tilt, &Decider::Exact);
            assert!(counts.are_certified(), "{counts:?}");
            assert_eq!((counts.points(), counts.proven().by(Stage::F64)), (points, points));
        }
    }

    #[test]
    fn outcomes_of_a_body_are_proven_and_a_solver_for_coins_refuses_them() {
        struct ForCoins;
        impl Solver for ForCoins {
            fn name(&self) -> &str {
                "for coins"
            }
            fn land(&self, toss: &Toss) -> Result<dynamics::Landing, dynamics::SolveError> {
                ExactSolver.land(&toss.of_coin(self.name(), "it has no method for other rigid bodies")?.into())
            }
        }
        let texts = [(RateX, "1:20:7"), (RateY, "2"), (RateZ, "3"), (Speed, "3:5:5")];
        let racket = dynamics::catalogue::named_body("racket").unwrap();
        let space = Space::parse(racket, &texts).unwrap();
        let launches = Launches::Grid(Grid::new(&space).unwrap());
        let count = |decider: &Decider<'_>| decider.count(&space, &launches, 0..35, (&|_| {}, &|| false));
        let (proven, solved) =
            (count(&Decider::Exact).unwrap(), count(&Decider::Solver(Checked::new(&ExactSolver))).unwrap());
        assert!(proven.are_certified() && !solved.are_certified());
        assert_eq!((proven.points(), proven.heads(), proven.tails()), (35, solved.heads(), solved.tails()));
        let as_coin = Decider::Exact
            .count(&space.with_body(Coin::PAPER).unwrap(), &launches, 0..35, (&|_| {}, &|| false))
            .unwrap();
        assert_ne!(as_coin.heads(), proven.heads());
        let refused = count(&Decider::Solver(Checked::new(&ForCoins))).unwrap_err();
        assert!(matches!(refused, Error::Launch { index: 0, source: dynamics::SolveError::NotSymmetric { .. }, .. }));
    }

    /// This holds even for the exact solver: its outcomes are right, but only as reliable as those of any other solver.
    #[test]
    fn outcomes_of_a_solver_are_never_counted_as_proven() {
        for tilt in ["0", "0:1e-9:2"] {
            let by_solver = counted(tilt, &Decider::Solver(Checked::new(&ExactSolver)));
            let proven = counted(tilt, &Decider::Exact);
            assert_eq!((by_solver.heads(), by_solver.tails()), (proven.heads(), proven.tails()));
            assert_eq!((by_solver.are_certified(), by_solver.proven()), (false, ProvenCounts::default()));
        }
    }
}
