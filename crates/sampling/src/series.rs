//! This file follows how estimates converge as launches are added. It gives the running probability p(n) after n
//! launches, as in the paper's Fig. 4, and the root-mean-square error √⟨(p(n) - P)²⟩ of independent estimates p(n) of
//! each method.

use dynamics::error::require;
use dynamics::{Error, InputError};

use crate::counts::Counts;
use crate::estimate::of_independent;
use crate::grid::Grid;
use crate::launches::Launches;
use crate::plan::{Plan, Rest, Scrambled};
use crate::sampler::Sampler;
use crate::space::{Cube, Space};

/// The shares of heads among the first launches of method A and method B.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RunningStep {
    /// Number of launches so far.
    pub launches: u64,
    /// Share of heads among the decided ones of the first launches of the grid (A); `None` if none is decided.
    pub grid: Option<f64>,
    /// Share of heads among the decided ones of the first random launches (B); likewise.
    pub random: Option<f64>,
    /// Lower end of the 95 % interval of the random launches.
    pub random_lo: f64,
    /// Upper end of that interval, which holds whatever the outcomes of the undecided launches are.
    pub random_hi: f64,
    /// Number of undecided launches of the grid; `None` if no launch of the series is undecided.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub grid_undecided: Option<u64>,
    /// Likewise of the random launches.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub random_undecided: Option<u64>,
}

/// More steps than this are refused; a chart shows hundreds.
const MOST_STEPS: u64 = 1_000_000;

impl RunningStep {
    /// The number of launches, the shares and the interval, in the order of the fields; `None` if a share is not known.
    pub fn columns(&self) -> Option<[f64; 5]> {
        #[expect(clippy::cast_precision_loss, reason = "shown, not computed with")]
        let launches = self.launches as f64;
        Some([launches, self.grid?, self.random?, self.random_lo, self.random_hi])
    }
}

impl Sampler<'_> {
    /// The running probability over the whole grid of `space` (A), beside that over as many random launches (B), in
    /// `steps` equal steps.
    ///
    /// # Errors
    /// As [`Sampler::estimate`].
    pub fn running_shares(&self, space: &Space, steps: u64, seed: u64) -> Result<Vec<RunningStep>, Error> {
        let points = space.grid_points()?;
        let random = Launches::Random { cube: Cube::new(space, space.free()), seed };
        // The launches come in the order of the grid, in which the speed varies fastest.
        let series = [Launches::Grid(Grid::new(space)?), random];
        let [grid, random] = self.running(space, &series, points, steps)?;
        let is_undecided = grid.iter().chain(&random).any(|counts| counts.undecided() > 0);
        let undecided = |counts: &Counts| is_undecided.then(|| counts.undecided());
        let step = |(grid, random): (&Counts, &Counts)| {
            let interval = of_independent(*random);
            RunningStep {
                launches: grid.points(),
                grid: grid.probability(),
                random: random.probability(),
                random_lo: interval.lo,
                random_hi: interval.hi,
                grid_undecided: undecided(grid),
                random_undecided: undecided(random),
            }
        };
        Ok(grid.iter().zip(&random).map(step).collect())
    }

    /// The running counts over the first `points` of each of the `series`, in `steps` equal steps. When it is time to end, the
    /// steps that are complete.
    fn running(
        &self,
        space: &Space,
        series: &[Launches; 2],
        points: u64,
        steps: u64,
    ) -> Result<[Vec<Counts>; 2], Error> {
        #[expect(clippy::cast_precision_loss, reason = "shown, not computed with")]
        require(
            "steps",
            steps as f64,
            "at least 1, at most the number of launches and 1000000",
            (1..=points.min(MOST_STEPS)).contains(&steps),
        )?;
        // Number of launches at the end of a step, computed without overflow.
        let end =
            |step: u64| u64::try_from(u128::from(points) * u128::from(step) / u128::from(steps)).unwrap_or(points);
        let (mut found, mut counts) = ([Vec::new(), Vec::new()], [Counts::default(); 2]);
        for step in 0..steps {
            for (counts, launches) in counts.iter_mut().zip(series) {
                let more = self.decider.count(space, launches, end(step)..end(step + 1), self.watch())?;
                *counts = [*counts, more].into_iter().sum();
            }
            if counts.iter().any(|counts| counts.points() < end(step + 1)) {
                break;
            }
            for (found, counts) in found.iter_mut().zip(counts) {
                found.push(counts);
            }
        }
        Ok(found)
    }
}

/// A way to estimate a probability from a given number of launches.
#[derive(Debug, Clone, Copy)]
pub struct Estimator {
    /// Name of the method.
    pub name: &'static str,
    /// Whether it uses random numbers.
    pub is_random: bool,
    plan: fn(points: u64, seed: u64) -> Plan,
}

/// The four methods, the last of them twice. Those that use Sobol's sequence give all points to one scramble, which is
/// most accurate but has no error estimate. The last entry has 8 scrambles, as in an estimate with an interval.
pub const ESTIMATORS: [Estimator; 5] = [
    Estimator { name: "grid", is_random: false, plan: |_, _| Plan::Grid },
    Estimator { name: "random", is_random: true, plan: |points, seed| Plan::Random { points, seed } },
    Estimator {
        name: "sobol",
        is_random: true,
        plan: |points, seed| Plan::Sobol(Scrambled { points, scrambles: 1, seed }),
    },
    Estimator {
        name: "exact-speed",
        is_random: true,
        plan: |points, seed| Plan::ExactSpeed(Rest::Sobol(Scrambled { points, scrambles: 1, seed })),
    },
    Estimator {
        name: "exact-speed, 8 scrambles",
        is_random: true,
        plan: |points, seed| Plan::ExactSpeed(Rest::Sobol(Scrambled::new(points, seed))),
    },
];

impl Estimator {
    /// Estimates the probability from `points` launches, for each of the seeds 1 to `replicates`. A method without
    /// random numbers gives a single estimate, from the largest even grid of at most `points` launches.
    ///
    /// # Errors
    /// As [`Sampler::estimate`]; [`InputError::OutsideModel`] if no launch of an estimate is decided.
    pub fn estimates(
        &self,
        sampler: &Sampler<'_>,
        space: &Space,
        points: u64,
        replicates: u64,
    ) -> Result<Vec<f64>, Error> {
        let space = if self.is_random { *space } else { space.with_grid_of(points)? };
        let seeds = if self.is_random { 1..=replicates } else { 1..=1 };
        let share = |seed| {
            let found = sampler.estimate(&space, (self.plan)(points, seed))?;
            let why = "no launch is decided, so that there is no share of heads";
            let unknown = InputError::OutsideModel { field: "launches", why };
            found.is_known().then_some(found.probability).ok_or(unknown.into())
        };
        seeds.map(share).collect()
    }
}

/// The error of a method with a number of launches.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ErrorLine {
    /// The name of the method.
    pub method: &'static str,
    /// The number of launches.
    pub launches: u64,
    /// The root mean square of the errors.
    pub rms_error: f64,
    /// The number of seeds.
    pub replicates: usize,
    /// The probability from which errors are measured.
    pub reference: f64,
    /// A bound of its own error.
    pub reference_error: f64,
}

/// How the errors of all [`ESTIMATORS`] are measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MethodErrors {
    /// The number of seeds.
    pub replicates: u64,
    /// The largest number of launches is 2 to this power.
    pub up_to: u32,
    /// The probability from which errors are measured; that of exact-speed with 64 times as many launches if none is given.
    pub reference: Option<f64>,
}

/// The errors of all methods, with the probability from which they are measured and a bound of its own error.
#[derive(Debug, Clone, PartialEq)]
pub struct Errors {
    /// The errors, by method and number of launches.
    pub lines: Vec<ErrorLine>,
    /// The probability.
    pub reference: f64,
    /// A bound of its error.
    pub reference_error: f64,
}

impl MethodErrors {
    /// The numbers of launches with which each method is run.
    fn sizes(&self) -> impl Iterator<Item = u64> + use<> {
        (8..=self.up_to).map(|exponent| 1 << exponent)
    }

    /// The number of launches of the reference.
    fn reference_launches(&self) -> u64 {
        64 << self.up_to
    }

    /// The number of all launches together.
    pub fn launches(&self) -> u64 {
        let seeds = |estimator: &Estimator| if estimator.is_random { self.replicates } else { 1 };
        let all = ESTIMATORS.iter().map(seeds).sum::<u64>() * self.sizes().sum::<u64>();
        all + if self.reference.is_some() { 0 } else { self.reference_launches() }
    }

    /// The errors over `space`; those that are complete when it is time to end.
    ///
    /// # Errors
    /// [`InputError::OutsideModel`] for a body with I1 ≠ I2; as [`Sampler::estimate`].
    pub fn measure(&self, sampler: &Sampler<'_>, space: &Space) -> Result<Errors, Error> {
        if space.coin().is_none() {
            let why = "errors compares all methods, and exact-speed is for coins; this body has I1 ≠ I2";
            return Err(InputError::OutsideModel { field: "coin", why }.into());
        }
        let (reference, reference_error) = self.reference(sampler, space)?;
        let mut lines = Vec::new();
        for estimator in ESTIMATORS {
            for launches in self.sizes() {
                let estimates = match estimator.estimates(sampler, space, launches, self.replicates) {
                    Err(Error::Ended) if !lines.is_empty() => return Ok(Errors { lines, reference, reference_error }),
                    estimates => estimates?,
                };
                let (rms_error, replicates) = (rms_error(&estimates, reference), estimates.len());
                let method = estimator.name;
                lines.push(ErrorLine { method, launches, rms_error, replicates, reference, reference_error });
            }
        }
        Ok(Errors { lines, reference, reference_error })
    }

    fn reference(&self, sampler: &Sampler<'_>, space: &Space) -> Result<(f64, f64), Error> {
        if let Some(probability) = self.reference {
            return Ok((probability, 0.0));
        }
        // Seed 0 is the reference's own: the replicates have other seeds.
        let plan = Plan::ExactSpeed(Rest::Sobol(Scrambled::new(self.reference_launches(), 0)));
        let found = sampler.estimate(space, plan)?;
        Ok((found.probability, found.half_width().unwrap_or(0.0)))
    }
}

/// Root of the mean square of the differences between `estimates` and the true `probability`.
#[expect(clippy::cast_precision_loss, reason = "a handful of estimates")]
pub fn rms_error(estimates: &[f64], probability: f64) -> f64 {
    let sum: f64 = estimates.iter().map(|estimate| (estimate - probability).powi(2)).sum();
    (sum / estimates.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use dynamics::Coin;

    use super::*;
    use crate::axis::Axis;
    use crate::coordinate::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
    use crate::interval::Interval;
    use crate::space_file::named_space;

    #[test]
    fn running_shares_are_those_of_estimates_from_as_many_launches() {
        let space = named_space("tails").unwrap().with_axis(Speed, Axis::range(0.0..=5.0).with_points(90)).unwrap();
        let estimate = |plan| Sampler::exact().estimate(&space, plan).unwrap();
        let steps = Sampler::exact().running_shares(&space, 9, 5).unwrap();
        assert_eq!(steps.iter().map(|step| step.launches).collect::<Vec<_>>(), [10, 20, 30, 40, 50, 60, 70, 80, 90]);
        for step in &steps {
            let random = estimate(Plan::Random { points: step.launches, seed: 5 });
            let Interval { lo, hi } = random.interval.unwrap();
            let [launches, grid, ..] = step.columns().unwrap();
            assert_eq!(step.columns(), Some([launches, grid, random.probability, lo, hi]));
            assert_eq!((step.grid_undecided, step.random_undecided), (None, None));
        }
        assert_eq!(steps[8].grid, Some(estimate(Plan::Grid).probability));
        assert_ne!(steps[8].grid, steps[8].random);
        for steps in [0, 91] {
            let refused = Sampler::exact().running_shares(&space, steps, 5);
            assert!(matches!(refused, Err(Error::Input(error)) if error.field() == "steps"));
        }
    }

    /// A solver that can't tell the outcome of a launch below a speed.
    struct Unsure(f64);

    impl dynamics::Solver for Unsure {
        fn name(&self) -> &str {
            "unsure"
        }
        fn land(&self, toss: &dynamics::Toss) -> Result<dynamics::Landing, dynamics::SolveError> {
            let mut landing = exact::ExactSolver.land(toss)?;
            if toss.launch.flight_time() < 2.0 * self.0 / 9.81 {
                landing.error = Some(1.0);
            }
            Ok(landing)
        }
    }

    #[test]
    fn undecided_launches_are_in_no_running_share_and_widen_the_interval() {
        let texts = [(RateX, "0"), (RateY, "0"), (RateZ, "1"), (Speed, "0:5:100")];
        let space = Space::parse(Coin::PAPER, &texts).unwrap();
        let steps = Sampler::by(&Unsure(4.0)).running_shares(&space, 10, 5).unwrap();
        // All launches that are decided land heads. The slowest come first.
        assert_eq!((steps[0].grid, steps[0].columns(), steps[0].grid_undecided), (None, None, Some(10)));
        assert_eq!((steps[9].grid, steps[9].random, steps[9].grid_undecided), (Some(1.0), Some(1.0), Some(80)));
        assert!(steps[9].random_lo < 0.35 && steps[9].random_hi == 1.0, "{:?}", steps[9]);
        let tails =
            Space::parse(Coin::PAPER, &[(RateX, "0"), (RateY, "0"), (RateZ, "1"), (Tilt, "3"), (Speed, "0:5:100")]);
        let last = Sampler::by(&Unsure(4.0)).running_shares(&tails.unwrap(), 1, 5).unwrap()[0];
        assert!(last.random == Some(0.0) && last.random_lo == 0.0 && last.random_hi > 0.8, "{last:?}");
        for estimator in ESTIMATORS.iter().take(3) {
            assert!(estimator.estimates(&Sampler::by(&Unsure(9.0)), &space, 64, 2).is_err(), "{}", estimator.name);
        }
    }

    #[test]
    fn methods_with_sobol_points_and_exact_speed_have_smaller_errors() {
        let texts = [(RateX, "1:60"), (RateY, "1:60"), (RateZ, "1:60"), (Speed, "3:5")];
        let space = Space::parse(Coin::PAPER, &texts).unwrap();
        let probability = 0.580_665_055_2;
        let errors = ESTIMATORS.map(|estimator| {
            rms_error(&estimator.estimates(&Sampler::exact(), &space, 1 << 14, 16).unwrap(), probability)
        });
        let [_, random, sobol, exact_speed, scrambled] = errors;
        assert!(sobol < random && 10.0 * exact_speed < sobol && 5.0 * scrambled < sobol, "{errors:?}");
        // For independent launches √(p (1 - p)/n) = 3.9e-3; the mean of 16 squares scatters by 35 %.
        assert!((2e-3..6e-3).contains(&random), "{random}");
    }
}
