//! A search for answers that are wrong without an error: adversarial launches flown by every default solver.

use rayon::prelude::*;
use toss::{Formulation, InputError, Method, Scheme, SolverEntry};

use crate::adversary;
use crate::case::Case;
use crate::check::Worst;
use crate::reference::Reference;
use crate::run::{Answer, Run};
use crate::subject::Subject;

const SEED: u64 = 20_261_121;

/// Tolerances, of which each launch is flown at one.
const TOLERANCES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// What the search found of one solver and method.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Findings {
    /// The subject's name.
    pub subject: String,
    /// Launches flown.
    pub launches: u64,
    /// Launches that were refused with an error.
    pub refused: u64,
    /// Launches that were answered wrongly without an error.
    pub silently_wrong: u64,
    /// The first refused launch.
    pub first_refused: Option<Worst>,
    /// The first launch that was answered wrongly.
    pub first_wrong: Option<Worst>,
}

/// Searches `launches` launches for every solver of `registry`, each integrator by every method that has an error
/// estimate.
///
/// # Errors
/// Never: every launch is valid.
pub fn search(registry: &[SolverEntry], launches: u64) -> Result<Vec<Findings>, InputError> {
    let contestants = contestants(registry)?;
    let fly = |index: u64| -> Result<Vec<Run>, InputError> {
        let case = adversary::launch(SEED, index)?;
        let reference = Reference::new(&case.toss);
        Ok(contestants.iter().map(|by_tolerance| Run::new(at(by_tolerance, index), &case, &reference)).collect())
    };
    let runs: Vec<Vec<Run>> = (0..launches).into_par_iter().map(fly).collect::<Result<_, _>>()?;
    let findings = |(index, by_tolerance): (usize, &Vec<Subject>)| {
        let of = |answer: Answer| runs.iter().enumerate().filter(move |(_, runs)| runs[index].answer == answer);
        let first = |answer: Answer| {
            let (launch, runs) = of(answer).next()?;
            let launch = launch as u64;
            let case: Case = adversary::launch(SEED, launch).ok()?;
            let replay = case.replay(at(by_tolerance, launch));
            Some(Worst { input: case.hex(), failure: runs[index].failure.clone(), replay })
        };
        Findings {
            subject: by_tolerance[0].name.clone(),
            launches,
            refused: of(Answer::TypedError).count() as u64,
            silently_wrong: of(Answer::SilentlyWrong).count() as u64,
            first_refused: first(Answer::TypedError),
            first_wrong: first(Answer::SilentlyWrong),
        }
    };
    Ok(contestants.iter().enumerate().map(findings).collect())
}

/// By solver and method, the subject at each tolerance; a closed form has but one.
fn contestants(registry: &[SolverEntry]) -> Result<Vec<Vec<Subject>>, InputError> {
    let mut contestants = Vec::new();
    for &entry in registry {
        if !entry.integrates() {
            contestants.push(vec![Subject::new(entry, None, Formulation::default())]);
            continue;
        }
        for scheme in Scheme::ALL.into_iter().filter(|scheme| scheme.is_adaptive()) {
            let at =
                |tolerance| Ok(Subject::new(entry, Some(Method::adaptive(scheme, tolerance)?), Formulation::default()));
            contestants.push(TOLERANCES.into_iter().map(at).collect::<Result<_, InputError>>()?);
        }
    }
    Ok(contestants)
}

/// The subject that flies launch `index`.
fn at(by_tolerance: &[Subject], index: u64) -> &Subject {
    &by_tolerance[usize::try_from(index).unwrap_or(0) % by_tolerance.len()]
}
