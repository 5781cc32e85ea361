//! The command `unfair-toss`: toss a coin, trace its flight, estimate a probability, list what can be named.
//!
//! Exit codes: 0 answered; 1 the solver failed; 2 bad usage or input.

mod chart;
mod commands;
mod failure;
mod output;
mod solver_args;
mod space_args;
mod toss_args;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::commands::{convergence, errors, intervals, inverse, limit, list, map, plan, probability, toss, trace};
use crate::failure::Failure;
use crate::output::{DataFormat, Format};

#[derive(Debug, Parser)]
#[command(name = "unfair-toss", version, about = "Tosses of an unbiased coin, solved", propagate_version = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Toss a coin and say how it lands
    Toss(toss::Args),
    /// Follow the flight at equal steps of time
    Trace(trace::Args),
    /// Estimate the probability of heads over a space of launches
    Probability(probability::Args),
    /// Follow the probability of heads as launches are added, by a grid and at random
    Convergence(convergence::Args),
    /// Measure the error of every method of sampling against the number of launches
    Errors(errors::Args),
    /// Map the probability of heads over two coordinates of a space
    Map(map::Args),
    /// Find the speeds that land heads
    Intervals(intervals::Args),
    /// Find the launch that lands heads with a wanted probability
    Inverse(inverse::Args),
    /// Set the probability of heads in the limit of long flights beside the share of long flights that land heads
    Limit(limit::Args),
    /// Choose the cheapest model that serves a scene
    Plan(plan::Args),
    /// List the coins that can be named
    Coins(list::Args),
    /// List the solvers
    Solvers(list::Args),
    /// List the models that a plan chooses from, from the cheapest on
    Models(list::Args),
    /// List the spaces of launches that can be named
    Spaces(list::Args),
}

impl Command {
    fn run(&self) -> Result<String, Failure> {
        match self {
            Self::Toss(args) => args.run(),
            Self::Trace(args) => args.run(),
            Self::Probability(args) => args.run(),
            Self::Convergence(args) => args.run(),
            Self::Errors(args) => args.run(),
            Self::Map(args) => args.run(),
            Self::Intervals(args) => args.run(),
            Self::Inverse(args) => args.run(),
            Self::Limit(args) => args.run(),
            Self::Plan(args) => args.run(),
            Self::Coins(args) => list::coins(args),
            Self::Solvers(args) => list::solvers(args),
            Self::Models(args) => list::models(args),
            Self::Spaces(args) => list::spaces(args),
        }
    }

    fn wants_json(&self) -> bool {
        match self {
            Self::Toss(args) => args.format == Format::Json,
            Self::Trace(args) => args.series.format == DataFormat::Json,
            Self::Convergence(args) => args.series.format == DataFormat::Json,
            Self::Errors(args) => args.series.format == DataFormat::Json,
            Self::Map(args) => args.series.format == DataFormat::Json,
            Self::Limit(args) => args.series.format == DataFormat::Json,
            Self::Probability(args) => args.format == Format::Json,
            Self::Intervals(args) => args.format == Format::Json,
            Self::Inverse(args) => args.format == Format::Json,
            Self::Plan(args) => args.format == Format::Json,
            Self::Coins(args) | Self::Solvers(args) | Self::Models(args) | Self::Spaces(args) => {
                args.format == Format::Json
            }
        }
    }
}

fn main() -> ExitCode {
    let command = Cli::parse().command;
    match command.run().and_then(|text| output::print(&text)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("error: {failure}");
            if command.wants_json() {
                // Standard output may be closed; the message above and the exit code still tell.
                let _ = output::print(&failure.to_json());
            }
            ExitCode::from(failure.exit_code())
        }
    }
}
