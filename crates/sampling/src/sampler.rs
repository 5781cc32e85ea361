//! This file holds the sampler, which estimates probabilities of heads. It keeps the settings that all such
//! computations share: what decides the outcomes of launches, and where progress is reported.

use dynamics::{Checked, Error, InputError, Solver};

use crate::counts::Decider;
use crate::enclosure::{self, MOST_CELLS};
use crate::estimate::Estimate;
use crate::fold::{Narrowed, Progress, Stop, Watch};
use crate::plan::Plan;
use crate::space::Space;

/// Estimates probabilities of heads over many launches, on the threads of the current pool of rayon; without the feature
/// `rayon`, on one thread.
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
    pub(crate) narrowed: Narrowed<'a>,
    pub(crate) stop: Stop<'a>,
    most_cells: u64,
}

impl Sampler<'static> {
    /// A sampler that decides outcomes by the exact motion. Every outcome is proven.
    pub fn exact() -> Self {
        Self::with(Decider::Exact)
    }
}

impl<'a> Sampler<'a> {
    /// A sampler that decides outcomes by `solver`. Outcomes within its error estimate are undecided, and none is
    /// proven.
    pub fn by(solver: &'a dyn Solver) -> Self {
        Self::with(Decider::Solver(Checked::new(solver)))
    }

    fn with(decider: Decider<'a>) -> Self {
        Self { decider, progress: &|_| {}, narrowed: &|_| {}, stop: &|| false, most_cells: MOST_CELLS }
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
        Sampler { progress, ..self }
    }

    /// Sets a function that is called with each interval of an enclosure that is narrower than those before.
    #[must_use]
    pub fn on_narrowing<'b>(self, narrowed: Narrowed<'b>) -> Sampler<'b>
    where
        'a: 'b,
    {
        Sampler { narrowed, ..self }
    }

    /// Sets a function that says whether to come to an end. Then the answer is what is known: of an enclosure the interval that is
    /// proven, of independent launches the estimate from those that were done, of a search for a spread how far it came, of a
    /// series, a map or a list what is complete of it. What has no answer before its end is [`Error::Ended`].
    #[must_use]
    pub fn until<'b>(self, stop: Stop<'b>) -> Sampler<'b>
    where
        'a: 'b,
    {
        Sampler { stop, ..self }
    }

    /// Lets an enclosure take at most so many cells, where 2^24 are the most of all.
    #[must_use]
    pub fn within(self, most_cells: u64) -> Self {
        Self { most_cells: self.most_cells.min(most_cells), ..self }
    }

    /// The same sampler without progress reports.
    pub(crate) fn silent(&self) -> Sampler<'a> {
        Sampler { progress: &|_| {}, narrowed: &|_| {}, ..self.clone() }
    }

    /// Estimates the probability of heads in `space` by `plan`.
    ///
    /// # Errors
    /// [`Error`] of a launch that fails; if several fail, always of the first. [`InputError`] if the plan does not fit
    /// the space, and for [`Plan::ExactSpeed`] and [`Plan::Enclosure`] with a solver, because they use the exact motion.
    ///
    /// An enclosure that takes too many cells is answered as far as it was proven; [`Estimate::is_wider_than_asked`] tells.
    pub fn estimate(&self, space: &Space, plan: Plan) -> Result<Estimate, Error> {
        let Plan::Enclosure { accuracy } = plan else { return self.sampled(space, plan) };
        self.require_exact()?;
        enclosure::estimate((self.progress, self.narrowed, self.stop), space, accuracy, self.most_cells)
    }

    /// Estimates the probability of heads from the launches of a plan. A program that calls this function and not
    /// [`Sampler::estimate`] does not contain the code of enclosures.
    ///
    /// # Errors
    /// As [`Sampler::estimate`]; [`InputError`] for [`Plan::Enclosure`], which has no launches.
    pub fn sampled(&self, space: &Space, plan: Plan) -> Result<Estimate, Error> {
        if let Plan::ExactSpeed(_) = plan {
            self.require_exact()?;
        }
        let points = plan.points(space)?;
        let sums = self.sums(space, plan, &(0..points))?;
        // Independent launches are a sample, however many were done.
        let plan = match (plan, sums.launches()) {
            (Plan::Random { seed, .. }, points @ 1..) => Plan::Random { points, seed },
            _ => plan,
        };
        sums.require(plan.points(space)?)?;
        Ok(sums.estimate(space, plan)?)
    }

    /// Whether it is time to end.
    pub fn is_over(&self) -> bool {
        (self.stop)()
    }

    pub(crate) fn watch(&self) -> Watch<'a> {
        (self.progress, self.stop)
    }

    fn require_exact(&self) -> Result<(), InputError> {
        let Decider::Solver(solver) = &self.decider else { return Ok(()) };
        let expected = "no solver for exact-speed and enclosure, which use the exact motion";
        Err(InputError::Malformed { field: "solver", value: solver.name().to_owned(), expected })
    }
}
