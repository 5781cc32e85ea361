//! The command `unfair-toss` tosses coins, traces their flights and estimates probabilities of heads. It parses
//! options, calls the libraries and prints their answers, so that each computation can also be made from Rust.
//!
//! The exit code is 0 for an answer, 1 if the solver failed or standard output can't be written, and 2 for bad usage or
//! input.

mod chart;
mod commands;
mod estimate;
mod failure;
mod help;
mod json;
mod output;
mod quantity;
mod solver_args;
mod space_args;
mod toss_args;
mod watch;

use std::ffi::OsString;
use std::io::{Read, Write};
use std::process::ExitCode;

use ::toss::Registry;
use clap::error::{ContextKind, ContextValue};
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};
use dynamics::data::NO_WOBBLE;
use serde_json::Map;

use crate::commands::{
    compare, convergence, errors, intervals, inverse, limit, list, map, parts, plan, power, probability, sample, shell,
    spread, toss, trace,
};
use crate::failure::Failure;
use crate::output::Asked;
use crate::watch::Watch;

#[derive(Debug, Parser)]
#[command(name = "unfair-toss", version, about = "Computes how a tossed coin lands, and how probable heads is")]
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
    /// Print single launches of a space, or of standard input, and how each lands
    Sample(sample::Args),
    /// Solve one toss by every solver and scheme
    Compare(compare::Args),
    /// Find how precise a hand must be for a wanted probability of heads
    Spread(spread::Args),
    /// Show how the probability of heads converges as launches are added, by a grid and at random
    Convergence(convergence::Args),
    /// Measure how the error of each sampling method falls with the number of launches
    Errors(errors::Args),
    /// Map the probability of heads over two coordinates of a space
    Map(map::Args),
    /// Add the parts of a probability that `probability --shard` has written
    Merge(parts::Args),
    /// Find the ranges of speed that land heads
    Intervals(intervals::Args),
    /// Find the angle ψ behind a probability of heads, or behind people's counts
    Inverse(inverse::Args),
    /// Say how many flips it takes to see that coins land on the side that had been up
    Power(power::Args),
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
    /// Print a script that completes the options in a shell
    Completions(shell::CompletionsArgs),
    /// Print a manual page
    Man(shell::ManArgs),
}

impl Command {
    fn run(&self, registry: &Registry, asked: &Asked, streams: &mut Streams<'_>) -> Result<String, Failure> {
        match self {
            Self::Toss(args) => args.run(registry, asked),
            Self::Trace(args) => args.run(registry, asked, streams),
            Self::Probability(args) => args.run(registry, asked),
            Self::Sample(args) => args.run(registry, asked, streams),
            Self::Compare(args) => args.run(registry, asked),
            Self::Spread(args) => args.run(asked),
            Self::Convergence(args) => args.run(registry, asked),
            Self::Errors(args) => args.run(asked),
            Self::Map(args) => args.run(registry, asked),
            Self::Merge(args) => args.run(asked),
            Self::Intervals(args) => args.run(asked),
            Self::Inverse(args) => args.run(asked),
            Self::Power(args) => args.run(asked),
            Self::Limit(args) => args.run(registry, asked),
            Self::Plan(args) => args.run(registry, asked),
            Self::Coins(args) => list::coins(args, asked),
            Self::Solvers(args) => Ok(list::solvers(args, registry, asked)),
            Self::Models(args) => Ok(list::models(args, asked)),
            Self::Spaces(args) => list::spaces(args, asked),
            Self::Completions(args) => Ok(args.run(registry, program_with(registry))),
            Self::Man(args) => args.run(program_with(registry)),
        }
    }
}

/// The streams that the program reads and prints to.
pub struct Streams<'a> {
    /// Standard input.
    pub input: &'a mut (dyn Read + Send),
    /// Standard output, in colours, which may be stripped.
    pub out: &'a mut (dyn Write + Send),
    /// Standard error, likewise.
    pub err: &'a mut dyn Write,
}

/// The program with the solvers of `registry`, the arguments and the standard streams of the process. A program of yours
/// offers its own solver by calling this: `unfair_toss::main(&Registry::standard().with(entry)?)`.
#[must_use]
pub fn main(registry: &Registry) -> ExitCode {
    let arguments: Vec<OsString> = std::env::args_os().collect();
    // The two of anstream leave the colours out where there is no terminal.
    let (mut input, mut out, mut err) = (std::io::stdin(), anstream::stdout(), anstream::stderr());
    ExitCode::from(run_with(registry, &arguments, Streams { input: &mut input, out: &mut out, err: &mut err }))
}

/// As [`run_with`], with the solvers of this workspace.
pub fn run(arguments: &[OsString], streams: Streams<'_>) -> u8 {
    run_with(Registry::standard(), arguments, streams)
}

/// Runs the program with the solvers of `registry` and with `arguments`, the first of which is its own name, and returns
/// its exit code.
pub fn run_with(registry: &Registry, arguments: &[OsString], mut streams: Streams<'_>) -> u8 {
    let printed = match program_with(registry).try_get_matches_from(arguments) {
        Ok(given) => answer(registry, &given, &mut streams).and_then(|text| output::print(&text, streams.out)),
        Err(asked) if !asked.use_stderr() => output::print(&asked.render().ansi().to_string(), streams.out),
        Err(raw) if is_of_wobble(&raw) => Err(NO_WOBBLE.into()),
        Err(raw) => Err(Failure::arguments(&refusal(registry, arguments, raw))),
    };
    let Err(failure) = printed else { return 0 };
    failure.report(streams.err);
    if wants_json(arguments) && !failure.is_said {
        // If this can't be printed, the message above and the exit code still tell.
        let _ = output::print(&failure.to_json(), streams.out);
    }
    failure.exit_code
}

/// The program with its commands, options and help texts. Tests make command lines from it.
#[doc(hidden)]
pub fn program() -> clap::Command {
    program_with(Registry::standard())
}

/// The same, with help texts that name the solvers of `registry`.
fn program_with(registry: &Registry) -> clap::Command {
    help::described(Cli::command()).mut_subcommands(|command| {
        let name = command.get_name().to_owned();
        command.mut_args(|argument| match solver_args::help(registry, &name, argument.get_id().as_str()) {
            Some(help) => argument.help(help),
            None => argument,
        })
    })
}

/// What is wrong with `arguments` that are not understood. They are read again as they are printed, so that no message holds a
/// character that does something to a terminal; `raw` is what is wrong if they are understood then.
fn refusal(registry: &Registry, arguments: &[OsString], raw: clap::Error) -> clap::Error {
    let printed = |argument: &OsString| {
        argument.to_str().map_or_else(|| argument.clone(), |text| whole_file::printable(text).into())
    };
    program_with(registry).try_get_matches_from(arguments.iter().map(printed)).err().unwrap_or(raw)
}

/// Whether an option was given that has another name now.
fn is_of_wobble(error: &clap::Error) -> bool {
    matches!(error.get(ContextKind::InvalidArg), Some(ContextValue::String(option)) if option == "--wobble")
}

/// The answer of the command that the arguments ask for.
fn answer(registry: &Registry, given: &ArgMatches, streams: &mut Streams<'_>) -> Result<String, Failure> {
    let command = Cli::from_arg_matches(given).map_err(|error| Failure::arguments(&error))?.command;
    let program = program_with(registry);
    let described = given.subcommand().and_then(|(name, given)| Some((program.find_subcommand(name)?, given)));
    let input = described.map_or_else(Map::new, |(described, given)| output::input(described, given));
    let asked = Asked { input, watch: Watch::over(described)? };
    let answer = command.run(registry, &asked, streams);
    asked.watch.finish();
    match (answer, asked.watch.ended()) {
        (Err(failure), Some(ended)) if failure.is_of_ended_work() => Err(ended.into()),
        (Ok(answer), Some(ended)) => {
            // The data of a series have no place for it.
            let _ = writeln!(streams.err, "note: {}; the answer is what was known by then", ended.in_words());
            Ok(answer)
        }
        (answer, _) => answer,
    }
}

/// Whether `arguments`, which may be none that the program understands, ask for JSON.
fn wants_json(arguments: &[OsString]) -> bool {
    arguments.iter().any(|argument| argument == "--format=json")
        || arguments.windows(2).any(|pair| pair[0] == "--format" && pair[1] == "json")
}
