//! This file holds the sampler, which estimates probabilities of heads. It keeps the settings that all such
//! computations share: what decides the outcomes of launches, and where progress is reported.

use dynamics::{Checked, Error, InputError, Solver};

use crate::counts::{Counts, Decider};
use crate::estimate::Estimate;
use crate::fold::Progress;
use crate::grid::Grid;
use crate::launches::Launches;
use crate::plan::{Plan, Rest, Scrambled, cube_of_the_rest};
use crate::shares::{Shares, add_shares};
use crate::space::{Cube, Space};

/// Estimates probabilities of heads over many launches, on the threads of the current pool.
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
    /// A sampler that decides outcomes by the exact motion. Every outcome is proven.
    pub fn exact() -> Self {
        Self { decider: Decider::Exact, progress: &|_| {} }
    }
}

impl<'a> Sampler<'a> {
    /// A sampler that decides outcomes by `solver`. Outcomes within its error estimate are undecided, and none is
    /// proven.
    pub fn by(solver: &'a dyn Solver) -> Self {
        Self { decider: Decider::Solver(Checked::new(solver)), progress: &|_| {} }
    }

    /// Whether the exact motion decides.
    pub fn is_exact(&self) -> bool {
        matches!(self.decider, Decider::Exact)
    }

    /// Sets a function that is called with the number of launches (or nodes of a map) done since it was last called.
    #[must_use]
    pub fn on_progress<'b>(self, progress: Progress<'b>) -> Sampler<'b>
    where
        'a: 'b,
    {
        Sampler { decider: self.decider, progress }
    }

    /// The same sampler without progress reports.
    pub(crate) fn silent(&self) -> Sampler<'a> {
        Sampler { decider: self.decider.clone(), progress: &|_| {} }
    }

    /// Estimates the probability of heads in `space` by `plan`.
    ///
    /// # Errors
    /// [`Error`] of a launch that fails; if several fail, always of the first. [`InputError`] if the plan does not fit
    /// the space, and for [`Plan::ExactSpeed`] with a solver, because it uses the exact motion.
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

    /// Counts the outcomes of the first `points` launches.
    fn count(&self, space: &Space, launches: &Launches, points: u64) -> Result<Counts, Error> {
        self.decider.count(space, launches, 0..points, self.progress)
    }

    fn integrate_speed(&self, space: &Space, rest: Rest, points: u64) -> Result<Estimate, Error> {
        if let Decider::Solver(solver) = &self.decider {
            let expected = "no solver for exact-speed, which uses the exact motion";
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

/// Calls `tally` for each scramble, with its launches and their number, and collects the results.
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
