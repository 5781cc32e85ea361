//! This file searches for answers that are wrong without an error, by solving adversarial launches with every solver
//! and scheme in its default formulation. Such an answer is the worst fault of a solver, because you cannot see it.

use rayon::prelude::*;
use toss::{Formulation, InputError, Scheme, SolverEntry, Stepping};

use super::adversary;
use super::case::Case;
use super::measurement::Worst;
use super::reference::Reference;
use super::replay::Replay;
use super::run::{Answer, Run};
use super::subject::Subject;

const SEED: u64 = 20_261_121;

/// Tolerances; launches take them in turn.
const TOLERANCES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// Steps of schemes without a tolerance, in units of 1/|ω|; launches take them in turn.
const STEPS: [f64; 2] = [0.1, 0.03];

/// Steps of slow launches, in units of 1/|ω|; the slow launches take them in turn, with every scheme that takes steps. The
/// smallest ones are so many that rounding is all there is.
const SLOW_STEPS: [f64; 4] = [0.1, 0.03, 0.01, 0.003];

/// What the search found for one solver and scheme.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Findings {
    /// The subject's name.
    pub subject: String,
    /// Launches that were tried.
    pub launches: u64,
    /// Launches that were refused with an error.
    pub refused: u64,
    /// Launches that were answered wrongly without an error.
    pub silently_wrong: u64,
    /// Launches that were answered by a solver without an error estimate.
    pub unclaimed: u64,
    /// The first refused launch.
    pub first_refused: Option<Worst>,
    /// The first launch that was answered wrongly.
    pub first_wrong: Option<Worst>,
}

/// Tries `launches` adversarial launches with every solver of `registry`, each integrator by every scheme.
///
/// # Errors
/// Never: every launch is valid.
pub fn search(registry: &[SolverEntry], launches: u64) -> Result<Vec<Findings>, InputError> {
    let contestants = contestants(registry);
    let fly = |index: u64| -> Result<Vec<Run>, InputError> {
        let case = adversary::launch(SEED, index)?;
        let reference = Reference::new(&case.toss);
        contestants.iter().map(|by| Ok(Run::new(&subject(*by, &case, index)?, &case, &reference))).collect()
    };
    let runs: Vec<Vec<Run>> = (0..launches).into_par_iter().map(fly).collect::<Result<_, _>>()?;
    let findings = |(column, by): (usize, &Contestant<'_>)| {
        let of = |answer: Answer| (0..).zip(&runs).filter(move |(_, runs)| runs[column].answer == answer);
        let first = |answer: Answer| -> Result<Option<Worst>, InputError> {
            let Some((index, runs)) = of(answer).next() else { return Ok(None) };
            let case = adversary::launch(SEED, index)?;
            let replay = Replay::toss(&case, &subject(*by, &case, index)?);
            Ok(Some(Worst { input: case.hex(), failure: runs[column].failure.clone(), replay }))
        };
        Ok(Findings {
            subject: runs.first().map(|runs| runs[column].subject.clone()).unwrap_or_default(),
            launches,
            refused: of(Answer::TypedError).count() as u64,
            silently_wrong: of(Answer::SilentlyWrong).count() as u64,
            unclaimed: of(Answer::Unclaimed).count() as u64,
            first_refused: first(Answer::TypedError)?,
            first_wrong: first(Answer::SilentlyWrong)?,
        })
    };
    contestants.iter().enumerate().map(findings).collect()
}

/// A solver, with its scheme if it is an integrator.
type Contestant<'a> = (&'a SolverEntry, Option<Scheme>);

fn contestants(registry: &[SolverEntry]) -> Vec<Contestant<'_>> {
    let schemes = |entry: &SolverEntry| {
        if entry.integrates() { entry.schemes().iter().copied().map(Some).collect() } else { vec![None] }
    };
    registry.iter().flat_map(|entry| schemes(entry).into_iter().map(move |scheme| (entry, scheme))).collect()
}

/// The contestant with its settings for launch number `index`, which is `case`.
fn subject((entry, scheme): Contestant<'_>, case: &Case, index: u64) -> Result<Subject, InputError> {
    let turn = usize::try_from(index).unwrap_or(0);
    let slow_turn = usize::try_from(index / adversary::SLOW_EVERY).unwrap_or(0);
    let stepping = |scheme: Scheme| {
        let step = match adversary::is_slow(index) && scheme.takes_steps() {
            true => SLOW_STEPS[slow_turn % SLOW_STEPS.len()],
            false if scheme.is_adaptive() => return Stepping::adaptive(scheme, TOLERANCES[turn % TOLERANCES.len()]),
            false => STEPS[turn % STEPS.len()],
        };
        // For a coin at rest 1/|ω| is infinite, and the longest step will do.
        let rate = case.toss.launch.turn_rate().max(f64::MIN_POSITIVE);
        Stepping::fixed(scheme, (step / rate).min(f64::MAX))
    };
    Ok(Subject::new(entry, scheme.map(stepping).transpose()?, Formulation::default()))
}
