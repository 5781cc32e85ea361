//! The command `unfair-toss` tosses coins, traces their flights and estimates probabilities of heads. It parses
//! options, calls the libraries and prints their answers, so that each computation can also be made from Rust.
//!
//! The exit code is 0 for an answer, 1 if the solver failed, and 2 for bad usage or input.

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
#[command(
    name = "unfair-toss",
    version,
    about = "Computes how a tossed coin lands, and how probable heads is",
    propagate_version = true
)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Toss a coin and print how it lands
    Toss(toss::Args),
    /// Follow the flight of a coin at equally spaced times
    Trace(trace::Args),
    /// Estimate the probability of heads over a space of launches
    Probability(probability::Args),
    /// Show how the probability of heads converges as launches are added, by a grid and at random
    Convergence(convergence::Args),
    /// Measure how the error of each sampling method falls with the number of launches
    Errors(errors::Args),
    /// Map the probability of heads over two coordinates of a space
    Map(map::Args),
    /// Find the ranges of speed that land heads
    Intervals(intervals::Args),
    /// Find the launch that lands heads with a wanted probability
    Inverse(inverse::Args),
    /// Compare the limit of the probability of heads for long flights with the share of long flights that land heads
    Limit(limit::Args),
    /// Choose the cheapest model that answers a question accurately enough
    Plan(plan::Args),
    /// List the coins of the catalogue
    Coins(list::Args),
    /// List the solvers with their schemes and formulations
    Solvers(list::Args),
    /// List the models from which `plan` chooses
    Models(list::Args),
    /// List the named spaces of launches
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
                // An error here means that standard output is closed; the message above and the exit code remain.
                let _ = output::print(&failure.to_json());
            }
            ExitCode::from(failure.exit_code())
        }
    }
}
