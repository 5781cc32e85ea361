//! P(heads) for a hand whose launches vary around the given one, and how precise a hand must be.

use sampling::{Coordinate, Drawn, Estimate, HAND, LargestSpread, Plan, Rest, Sampler, Scrambled, Space};
use serde::Serialize;
use toss::{Error, InputError, Outcome, certify};

use crate::thrown::{Thrown, malformed};

/// Launches of an estimate, each at all its speeds.
const POINTS: u64 = 4096;

/// Launches of each of the estimates that the search for a spread makes.
const POINTS_OF_SEARCH: u64 = 1024;

const SEED: u64 = 1;

/// How throws land, one after the other.
#[derive(Debug, Serialize)]
pub(crate) struct Throws {
    /// A letter for each: `H`, `T`, or `-` for an edge.
    outcomes: String,
}

/// P(heads) if each rate and the speed are normal, with the standard deviation `spread` of themselves.
pub(crate) fn probability(thrown: &Thrown, spread: &str) -> Result<Estimate, Error> {
    over(&thrown.space()?.with_spread(part("spread", spread)?, &HAND)?)
}

/// P(heads) over the launches of `space`.
pub(crate) fn over(space: &Space) -> Result<Estimate, Error> {
    Sampler::exact().sampled(space, plan(space))
}

/// How `number` random throws land, with the spread of [`probability`].
pub(crate) fn throws(thrown: &Thrown, spread: &str, number: u64, seed: u64) -> Result<Throws, Error> {
    const MOST: u64 = 10_000;
    if number > MOST {
        return Err(malformed("number", &number.to_string(), "at most 10000 throws").into());
    }
    let space = thrown.space()?.with_spread(part("spread", spread)?, &HAND)?;
    let letter = |drawn: &Drawn| {
        Ok(match certify(&drawn.toss)?.outcome() {
            Outcome::Heads => 'H',
            Outcome::Tails => 'T',
            Outcome::Undecided => '-',
        })
    };
    let throws: Vec<Drawn> = space.drawn(Plan::Random { points: number, seed })?.flatten().collect();
    Ok(Throws { outcomes: throws.iter().map(letter).collect::<Result<_, Error>>()? })
}

/// The largest spread with which P(heads) is at least `heads`.
pub(crate) fn precision(thrown: &Thrown, heads: &str) -> Result<LargestSpread, Error> {
    let scrambled = Scrambled::new(POINTS_OF_SEARCH, SEED);
    Sampler::exact().largest_spread(&thrown.space()?, &HAND, part("heads", heads)?, scrambled)
}

/// The most accurate plan for a space that spreads.
fn plan(space: &Space) -> Plan {
    let free: Vec<Coordinate> = space.free().collect();
    match free[..] {
        [] => Plan::Grid,
        _ if space.coin().is_none() || space.drop().is_some() || !free.contains(&Coordinate::Speed) => {
            Plan::Sobol(Scrambled::new(POINTS, SEED))
        }
        [_] => Plan::ExactSpeed(Rest::Grid),
        _ => Plan::ExactSpeed(Rest::Sobol(Scrambled::new(POINTS, SEED))),
    }
}

/// A part of a whole, such as `0.05` or `5%`.
pub(crate) fn part(field: &'static str, text: &str) -> Result<f64, InputError> {
    let (number, whole) = text.trim().strip_suffix('%').map_or((text, 1.0), |percent| (percent, 100.0));
    let part = number.trim().parse::<f64>().map(|number| number / whole);
    part.map_err(|_| malformed(field, text, "a number, or a percentage such as 5%"))
}
