//! `unfair-toss errors` measures the error of every sampling method for a range of numbers of launches. It shows which
//! method reaches a wanted accuracy with the fewest launches.

use sampling::{ESTIMATORS, Estimator, Plan, Rest, Sampler, Scrambled, Space, rms_error};
use toss::Error;

use crate::chart::{self, ErrorLine, Reference};
use crate::failure::Failure;
use crate::output::{Asked, SeriesArgs};
use crate::quantity;
use crate::space_args::{SpaceArgs, ThreadArgs};
use crate::watch::BudgetArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    space: SpaceArgs,
    /// Number of seeds over which the root mean square error is taken
    #[arg(long, value_name = "N", default_value_t = 16, allow_hyphen_values = true,
          value_parser = quantity::count::<u64>(1..=10_000))]
    replicates: u64,
    /// The largest number of launches is 2^EXPONENT
    #[arg(long, value_name = "EXPONENT", default_value_t = 18, allow_hyphen_values = true,
          value_parser = quantity::count::<u32>(8..=24))]
    up_to: u32,
    /// The probability that is taken as true [default: exact-speed with 64 times the largest number of launches]
    #[arg(long, value_name = "P", allow_hyphen_values = true, value_parser = probability)]
    reference: Option<f64>,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    budget: BudgetArgs,
    #[command(flatten)]
    pub(crate) series: SeriesArgs,
}

fn probability(text: &str) -> Result<f64, String> {
    let number = quantity::fraction(text)?;
    let is_valid = (0.0..=1.0).contains(&number);
    is_valid.then_some(number).ok_or_else(|| "expected a probability from 0 to 1, or from 0% to 100%".to_owned())
}

impl Args {
    pub(crate) fn run(&self, asked: &Asked) -> Result<String, Failure> {
        self.series.validate()?;
        let space = self.space.space()?;
        if space.coin().is_none() {
            let why = "errors compares all methods, and exact-speed is for coins; this body has I1 ≠ I2";
            return Err(Failure::usage("coin", why));
        }
        // Every number of launches has a grid of its own.
        self.space.require_grid_where_points_are(&space, |_| false)?;
        let ask = |sampler: &Sampler<'_>| self.lines(sampler, &space);
        let (lines, reference) =
            self.threads.ask(&asked.watch, Sampler::exact(), (self.launches(), "launches"), ask)?;
        self.series.answer_lines(asked, &lines, || Ok(chart::errors(&lines, &reference, &self.space.words(&space))?))
    }

    /// The numbers of launches with which each method is run.
    fn sizes(&self) -> impl Iterator<Item = u64> {
        (8..=self.up_to).map(|exponent| 1 << exponent)
    }

    /// The number of launches of the reference.
    fn reference_launches(&self) -> u64 {
        64 << self.up_to
    }

    /// The number of all launches together, for the progress bar.
    fn launches(&self) -> u64 {
        let seeds = |estimator: &Estimator| if estimator.is_random { self.replicates } else { 1 };
        let all = ESTIMATORS.iter().map(seeds).sum::<u64>() * self.sizes().sum::<u64>();
        all + if self.reference.is_some() { 0 } else { self.reference_launches() }
    }

    fn lines(&self, sampler: &Sampler<'_>, space: &Space) -> Result<(Vec<ErrorLine>, Reference), Error> {
        let reference = self.reference(sampler, space)?;
        let mut lines = Vec::new();
        for estimator in ESTIMATORS {
            for launches in self.sizes() {
                let estimates = match estimator.estimates(sampler, space, launches, self.replicates) {
                    Err(Error::Ended) if !lines.is_empty() => return Ok((lines, reference)),
                    estimates => estimates?,
                };
                lines.push(ErrorLine {
                    method: estimator.name,
                    launches,
                    rms_error: rms_error(&estimates, reference.probability),
                    replicates: estimates.len(),
                    reference: reference.probability,
                    reference_error: reference.error,
                });
            }
        }
        Ok((lines, reference))
    }

    fn reference(&self, sampler: &Sampler<'_>, space: &Space) -> Result<Reference, Error> {
        if let Some(probability) = self.reference {
            return Ok(Reference { probability, error: 0.0 });
        }
        // Seed 0 is the reference's own: the replicates have other seeds.
        let plan = Plan::ExactSpeed(Rest::Sobol(Scrambled::new(self.reference_launches(), 0)));
        let found = sampler.estimate(space, plan)?;
        Ok(Reference { probability: found.probability, error: found.half_width().unwrap_or(0.0) })
    }
}
