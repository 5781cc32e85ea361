//! This module compares speed with accuracy: it solves every problem with every solver and scheme over a range of
//! tolerances or steps. A single setting would not show which method is cheapest at the accuracy that you need.
//!
//! Errors are against the 256-bit reference. Work is counted in calls of the right-hand side, which are the same in
//! every run; times are recorded beside them but never judged, because they depend on the machine.

pub mod problems;
pub mod proofs;
mod yardstick;

use std::time::Duration;

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand::seq::SliceRandom;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use toss::{Error, Formulation, InputError, Scheme, SolveError, SolverEntry, StepControl, Stepping, Toss};

use crate::clock;
use crate::measure::effort::Effort;
use crate::measure::reference::{self, Reference};
use crate::measure::run::{Allowance, Answer, Run};
use crate::measure::subject::Subject;
use problems::Problem;
pub use yardstick::YARDSTICK;

/// One subject at one setting on one problem. Errors are the largest over the problem's launches, counts and times
/// their sums.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sample {
    /// The problem's name.
    pub problem: String,
    /// The solver's name.
    pub solver: String,
    /// The scheme's name; null for a closed form. The field is called `method` in records.
    #[serde(rename = "method")]
    pub scheme: Option<String>,
    /// The scheme's order; null if it is variable.
    pub order: Option<u32>,
    /// The tolerance of an adaptive scheme.
    pub tol: Option<f64>,
    /// The step (s) of a scheme with fixed steps.
    pub step: Option<f64>,
    /// The toss as text, or the number of launches.
    pub inputs: String,
    /// The worst answer over the launches.
    pub status: Answer,
    /// The first error that the solver returned.
    pub failure: Option<String>,
    /// Error of cos θ at landing; null if a launch failed, like the next four fields.
    pub err_cos_theta: Option<f64>,
    /// Angle to the exact attitude at landing (rad).
    pub err_attitude_rad: Option<f64>,
    /// Relative drift of the angular momentum S in the transport frame (TF).
    pub err_invariants: Option<f64>,
    /// The attitude's error, divided by what the solver's error estimate allows.
    pub err_by_allowance: Option<f64>,
    /// Whether no stated outcome is wrong.
    pub outcome_ok: Option<bool>,
    /// The name of the reference.
    pub ref_kind: String,
    /// A bound on the reference's own error.
    pub ref_err_bound: f64,
    /// Calls of the right-hand side.
    pub n_rhs: u64,
    /// Steps that the step control accepted.
    pub n_accepted: u64,
    /// Steps that the step control rejected.
    pub n_rejected: u64,
    /// The shortest time (ns).
    pub t_min_ns: u64,
    /// The median time (ns).
    pub t_median_ns: u64,
    /// Number of times that it was timed.
    pub n_runs: u32,
}

/// All samples of a run, in the order of problems, subjects and settings.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sweep {
    /// Of each problem: its name, what it stresses, and its number of launches.
    pub problems: Vec<(String, String, usize)>,
    /// The samples.
    pub samples: Vec<Sample>,
}

impl Sweep {
    /// Samples every solver of `registry` on every problem, and the library's quaternion as [`YARDSTICK`] if it is not among
    /// them. A body that is no coin is flown at the settings at which the solver states an error for it: solvers for coins
    /// refuse it, and next to the separatrix rough settings say nothing.
    pub fn new(registry: &[SolverEntry], problems: &[Problem], effort: Effort) -> Result<Self, Error> {
        let jobs = jobs(&yardstick::beside(registry), problems, effort)?;
        let references: Vec<Vec<Reference>> = problems
            .iter()
            .map(|problem| problem.tosses.par_iter().map(reference::of).collect::<Result<_, _>>())
            .collect::<Result<_, _>>()
            .map_err(SolveError::from)?;
        let mut samples: Vec<Sample> =
            jobs.par_iter().map(|job| job.sample(&problems[job.problem], &references[job.problem])).collect();
        for (index, times) in times(&jobs, problems, effort) {
            let sample = &mut samples[index];
            (sample.t_min_ns, sample.t_median_ns, sample.n_runs) = times;
        }
        Ok(Self::of(problems, samples))
    }

    /// A sweep of `problems` from samples that were already taken.
    pub fn of(problems: &[Problem], samples: Vec<Sample>) -> Self {
        let problem = |problem: &Problem| (problem.name.clone(), problem.stresses.clone(), problem.tosses.len());
        Self { problems: problems.iter().map(problem).collect(), samples }
    }

    /// The samples of one subject (`solver` or `solver/scheme`) on one problem, from rough to fine.
    pub fn series<'a>(&'a self, problem: &'a str, subject: &'a str) -> impl Iterator<Item = &'a Sample> {
        self.samples.iter().filter(move |sample| sample.problem == problem && sample.subject() == subject)
    }

    /// The names of the subjects, in their order.
    pub fn subjects(&self) -> Vec<String> {
        let mut subjects: Vec<String> = Vec::new();
        for sample in &self.samples {
            let subject = sample.subject();
            if !subjects.contains(&subject) {
                subjects.push(subject);
            }
        }
        subjects
    }

    /// The names of the subjects that are judged: all but the [`YARDSTICK`].
    pub fn judged(&self) -> Vec<String> {
        let is_yardstick = |subject: &str| subject.split('/').next() == Some(YARDSTICK);
        self.subjects().into_iter().filter(|subject| !is_yardstick(subject)).collect()
    }
}

impl Sample {
    /// The name of the subject: `solver` or `solver/scheme`.
    pub fn subject(&self) -> String {
        self.scheme.as_ref().map_or_else(|| self.solver.clone(), |scheme| format!("{}/{scheme}", self.solver))
    }

    /// The first number that is negative and cannot be, with its field.
    pub(crate) fn first_negative(&self) -> Option<(&'static str, f64)> {
        let numbers = [
            ("tol", self.tol),
            ("step", self.step),
            ("err_cos_theta", self.err_cos_theta),
            ("err_attitude_rad", self.err_attitude_rad),
            ("err_invariants", self.err_invariants),
            ("err_by_allowance", self.err_by_allowance),
            ("ref_err_bound", Some(self.ref_err_bound)),
        ];
        numbers.into_iter().find_map(|(field, value)| Some((field, value.filter(|value| *value < 0.0)?)))
    }
}

struct Job {
    problem: usize,
    subject: Subject,
}

/// All samples that are to be taken. Tolerances go from 1e-3 down by factors of 10, steps from 1/|ω| by factors of 2. A
/// quick sweep takes every third of them, down to 1e-12 and 1/64.
fn jobs(registry: &[SolverEntry], problems: &[Problem], effort: Effort) -> Result<Vec<Job>, InputError> {
    let (stride, decades, octaves) = if effort == Effort::Quick { (3, 12, 7) } else { (1, 12, 10) };
    let mut jobs = Vec::new();
    for (index, problem) in problems.iter().enumerate() {
        for entry in registry {
            let mut push = |stepping| {
                let subject = Subject::new(entry, stepping, Formulation::default());
                if problem.tosses.iter().all(|toss| states_an_error(&subject, toss)) {
                    jobs.push(Job { problem: index, subject });
                }
            };
            if !entry.integrates() {
                push(None);
                continue;
            }
            for &scheme in entry.schemes() {
                let settings = if scheme.is_adaptive() { decades } else { octaves };
                for setting in (0..settings).step_by(stride) {
                    push(Some(if scheme.is_adaptive() {
                        Stepping::adaptive(scheme, 10f64.powi(-3 - setting))?
                    } else {
                        Stepping::fixed(scheme, 0.5f64.powi(setting) / problem.fastest())?
                    }));
                }
            }
        }
    }
    Ok(jobs)
}

/// Whether `subject` can be judged by its error estimate on `toss`; of coins, that is for the check to say.
fn states_an_error(subject: &Subject, toss: &Toss) -> bool {
    toss.coin().is_some() || Allowance::of(subject, toss).is_ok_and(|allowance| allowance.is_some())
}

impl Job {
    fn sample(&self, problem: &Problem, references: &[Reference]) -> Sample {
        let subject = &self.subject;
        let run = |(toss, exact)| Run::new(subject, toss, exact);
        let runs: Vec<Run> = problem.tosses.iter().zip(references).map(run).collect();
        let largest = |of: fn(&Run) -> Option<f64>| {
            runs.iter().map(of).try_fold(0.0, |largest: f64, value| Some(largest.max(value?)))
        };
        let sum = |of: fn(&Run) -> Option<u64>| runs.iter().filter_map(of).sum();
        let control = subject.stepping.map(|stepping| stepping.control());
        Sample {
            problem: problem.name.clone(),
            solver: subject.entry.name().to_owned(),
            scheme: subject.scheme().map(|scheme| scheme.name().to_owned()),
            order: subject.scheme().and_then(Scheme::order),
            tol: control.and_then(|control| if let StepControl::Tolerance(tol) = control { Some(tol) } else { None }),
            step: control.and_then(|control| if let StepControl::Step(step) = control { Some(step) } else { None }),
            inputs: problem.inputs(),
            status: runs.iter().map(|run| run.answer).max().unwrap_or(Answer::TypedError),
            failure: runs.iter().find_map(|run| run.failure.clone()),
            err_cos_theta: largest(|run| run.err_cos_tilt),
            err_attitude_rad: largest(|run| run.err_attitude),
            err_invariants: largest(|run| run.err_invariants),
            err_by_allowance: largest(|run| run.err_by_allowance),
            outcome_ok: runs
                .iter()
                .all(|run| run.failure.is_none())
                .then(|| runs.iter().all(|run| run.outcome_ok != Some(false))),
            ref_kind: "exact motion in 256 bits".to_owned(),
            ref_err_bound: 2f64.powi(-200),
            n_rhs: sum(|run| run.rhs_calls),
            n_accepted: sum(|run| run.accepted_steps),
            n_rejected: sum(|run| run.rejected_steps),
            t_min_ns: 0,
            t_median_ns: 0,
            n_runs: 0,
        }
    }
}

/// Shortest and median time (ns) and number of runs of each job. The jobs run on one thread in a shuffled order that is
/// always the same: if the machine slows down for a while, jobs of all kinds are affected, not those of one solver
/// alone.
fn times(jobs: &[Job], problems: &[Problem], effort: Effort) -> Vec<(usize, (u64, u64, u32))> {
    let budget = Duration::from_millis(if effort == Effort::Quick { 1 } else { 4 });
    let mut order: Vec<usize> = (0..jobs.len()).collect();
    order.shuffle(&mut ChaCha8Rng::seed_from_u64(1));
    let time = |index: usize| {
        let job = &jobs[index];
        let fly = || {
            for toss in &problems[job.problem].tosses {
                // Failed flights are timed too, because they also take time.
                let _ = std::hint::black_box(job.subject.solver.land(std::hint::black_box(toss)));
            }
        };
        (index, repeat(fly, budget))
    };
    order.into_iter().map(time).collect()
}

/// Times `work` up to 25 times while `budget` lasts, and at least three times unless that takes too long. Returns the
/// shortest and the median time (ns) and the number of runs.
fn repeat(work: impl Fn(), budget: Duration) -> (u64, u64, u32) {
    const LONG: Duration = Duration::from_millis(300);
    let times = clock::times(work, |runs, spent| match runs {
        1..3 => spent < LONG,
        _ => runs < 25 && spent < budget,
    });
    let nanoseconds = |time: Duration| u64::try_from(time.as_nanos()).unwrap_or(u64::MAX);
    (nanoseconds(times[0]), nanoseconds(times[times.len() / 2]), u32::try_from(times.len()).unwrap_or(u32::MAX))
}
