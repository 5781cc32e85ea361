//! Who decides the outcomes of launches, and who hears of the progress: what all questions about many launches share.

use dynamics::{Checked, Error, InputError, Solver};

use crate::counts::{Counts, Decider};
use crate::estimate::Estimate;
use crate::fold::Progress;
use crate::grid::Grid;
use crate::launches::Launches;
use crate::plan::{Plan, Rest, Scrambled, cube_of_the_rest};
use crate::shares::{Shares, add_shares};
use crate::space::{Cube, Space};

/// Answers questions about many launches, on the threads of the current pool.
///
/// ```
/// use dynamics::Coin;
/// use sampling::{Plan, Sampler, Space};
///
/// let space = Space::builder(Coin::PAPER).rate_x(0.0..=50.0).tie_rate_y_to_x().rate_z(30.0).speed(3.0..=5.0).build()?;
/// let found = Sampler::exact().estimate(&space, Plan::Random { points: 10_000, seed: 1 })?;
/// assert_eq!(format!("{:.2}", found.probability), "0.66");
/// # Ok::<(), dynamics::Error>(())
/// ```
#[derive(Clone)]
pub struct Sampler<'a> {
    pub(crate) decider: Decider<'a>,
    pub(crate) progress: Progress<'a>,
}

impl Sampler<'static> {
    /// The exact motion decides: every outcome is proven.
    pub fn exact() -> Self {
        Self { decider: Decider::Exact, progress: &|_| {} }
    }
}

impl<'a> Sampler<'a> {
    /// `solver` decides, as far as its error estimate goes. Nothing that it answers is a proof.
    pub fn by(solver: &'a dyn Solver) -> Self {
        Self { decider: Decider::Solver(Checked::new(solver)), progress: &|_| {} }
    }

    /// Whether the exact motion decides.
    pub fn is_exact(&self) -> bool {
        matches!(self.decider, Decider::Exact)
    }

    /// The same, with `progress` called with the number of launches (or nodes of a map) done since it was last called.
    #[must_use]
    pub fn on_progress<'b>(self, progress: Progress<'b>) -> Sampler<'b>
    where
        'a: 'b,
    {
        Sampler { decider: self.decider, progress }
    }

    /// Without a word about the progress.
    pub(crate) fn silent(&self) -> Sampler<'a> {
        Sampler { decider: self.decider.clone(), progress: &|_| {} }
    }

    /// Estimates the probability of heads in `space` by `plan`.
    ///
    /// # Errors
    /// [`Error`]: of several failing launches always the first; [`InputError`] if the plan does not fit the space, or for
    /// [`Plan::ExactSpeed`], which integrates the exact motion, with a solver.
    pub fn estimate(&self, space: &Space, plan: Plan) -> Result<Estimate, Error> {
        let points = plan.points(space)?;
        match plan {
            Plan::Grid => {
                Ok(Estimate::of_grid_counts(self.count(space, &Launches::Grid(Grid::new(space)?), points)?))
            }
            Plan::Random { seed, .. } => {
                let launches = Launches::Random { cube: Cube::new(space, space.free()), seed };
                Ok(Estimate::of_independent_counts(self.count(space, &launches, points)?))
            }
            Plan::Sobol(scrambled) => {
                let cube = Cube::new(space, space.free());
                let counts = each_scramble(&cube, scrambled, |launches, each| self.count(space, launches, each))?;
                Ok(Estimate::of_scrambled_counts(&counts))
            }
            Plan::ExactSpeed(rest) => self.integrate_speed(space, rest, points),
        }
    }

    /// Counts the first `points` launches.
    fn count(&self, space: &Space, launches: &Launches, points: u64) -> Result<Counts, Error> {
        self.decider.count(space, launches, 0..points, self.progress)
    }

    fn integrate_speed(&self, space: &Space, rest: Rest, points: u64) -> Result<Estimate, Error> {
        if let Decider::Solver(solver) = &self.decider {
            let expected = "the exact motion, which exact-speed integrates over the speeds: no solver";
            let value = solver.name().to_owned();
            return Err(InputError::Malformed { field: "solver", value, expected }.into());
        }
        let add = |launches: &Launches, each| add_shares(space, launches, 0..each, self.progress);
        let cube = cube_of_the_rest(space);
        match rest {
            Rest::Sobol(scrambled) if cube.dimensions() > 0 => {
                let shares = each_scramble(&cube, scrambled, add)?;
                Ok(Estimate::of_scrambled_shares(&shares.iter().map(Shares::mean).collect::<Vec<_>>(), points))
            }
            _ => {
                let share = add(&Launches::Grid(Grid::without_speed(space)?), points)?.mean();
                Ok(Estimate::of_grid_share(share, points, cube.dimensions() == 0))
            }
        }
    }
}

/// The `tally` of each scramble.
fn each_scramble<T>(
    cube: &Cube,
    scrambled: Scrambled,
    tally: impl Fn(&Launches, u64) -> Result<T, Error>,
) -> Result<Vec<T>, Error> {
    let each = scrambled.points_each()?;
    let one = |scramble| {
        let launches = Launches::sobol(cube.clone(), scrambled.seed, scramble);
        tally(&launches, each).map_err(|error| error.after(scramble * each))
    };
    (0..scrambled.scrambles).map(one).collect()
}
