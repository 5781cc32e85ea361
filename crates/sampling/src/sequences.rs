//! This file turns a plan into numbered launches. A plan is one sequence of launches, or one for each scramble; all have
//! the same length, so that the launches of a plan are numbered through, and any part of a plan is a range of numbers.

use std::ops::Range;

use dynamics::InputError;

use crate::grid::Grid;
use crate::launches::Launches;
use crate::plan::{Plan, Rest, Scrambled, cube_of_the_rest};
use crate::space::{Cube, Space};

/// The launches of a plan, as sequences of the same length. Those of [`Plan::ExactSpeed`] have no speed of their own.
pub(crate) struct Sequences {
    kind: Kind,
    each: u64,
}

enum Kind {
    One(Launches),
    Scrambles { cube: Cube, scrambled: Scrambled },
}

impl Sequences {
    /// The sequences of `plan` over `space`.
    ///
    /// # Errors
    /// [`InputError`] if the plan does not fit the space.
    pub(crate) fn new(space: &Space, plan: Plan) -> Result<Self, InputError> {
        let points = plan.points(space)?;
        let cube = || Cube::new(space, space.free());
        let kind = match plan {
            Plan::Grid => Kind::One(Launches::Grid(Grid::new(space)?)),
            Plan::Random { seed, .. } => Kind::One(Launches::Random { cube: cube(), seed }),
            Plan::Sobol(scrambled) => Kind::Scrambles { cube: cube(), scrambled },
            Plan::ExactSpeed(Rest::Sobol(scrambled)) if cube_of_the_rest(space).dimensions() > 0 => {
                Kind::Scrambles { cube: cube_of_the_rest(space), scrambled }
            }
            // A plan by enclosure has no number of points, and was refused above.
            Plan::ExactSpeed(_) | Plan::Enclosure { .. } => Kind::One(Launches::Grid(Grid::without_speed(space)?)),
        };
        let each = match &kind {
            Kind::One(_) => points,
            Kind::Scrambles { scrambled, .. } => scrambled.points_each()?,
        };
        Ok(Self { kind, each })
    }

    /// Number of sequences.
    pub(crate) fn number(&self) -> u64 {
        match &self.kind {
            Kind::One(_) => 1,
            Kind::Scrambles { scrambled, .. } => scrambled.scrambles,
        }
    }

    /// The part of sequence number `index` that belongs to the `range` of the plan's launches, numbered from the start of
    /// the sequence.
    pub(crate) fn part(&self, index: u64, range: &Range<u64>) -> Range<u64> {
        let from_start = |number: u64| number.saturating_sub(index * self.each).min(self.each);
        from_start(range.start)..from_start(range.end)
    }

    /// Calls `tally` with the launches of each sequence and its part of `range`, and collects the results.
    ///
    /// # Errors
    /// Those of `tally`, with the launch numbered from the start of the plan.
    pub(crate) fn each_part<T>(
        &self,
        range: &Range<u64>,
        tally: impl Fn(&Launches, Range<u64>) -> Result<T, dynamics::Error>,
    ) -> Result<Vec<T>, dynamics::Error> {
        let one = |index| {
            let part = self.part(index, range);
            let done = self.with_launches(index, part.end - part.start, |launches| tally(launches, part));
            done.map_err(|error| error.after(index * self.each))
        };
        (0..self.number()).map(one).collect()
    }

    /// The launches of each sequence, and their number.
    pub(crate) fn into_launches(self) -> impl Iterator<Item = (Launches, u64)> {
        let number = self.number();
        (0..number).map(move |index| (self.with_launches(index, self.each, Launches::clone), self.each))
    }

    /// Calls `with` with the launches of sequence number `index`, which are prepared for about `points` of them.
    fn with_launches<T>(&self, index: u64, points: u64, with: impl FnOnce(&Launches) -> T) -> T {
        match &self.kind {
            Kind::One(launches) => with(launches),
            Kind::Scrambles { cube, scrambled } => with(&Launches::sobol(cube.clone(), scrambled.seed, index, points)),
        }
    }
}
