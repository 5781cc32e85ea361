//! The contest flies all contestants from the same launches, beside solvers of this workspace: the random launches of
//! the verification suite, its atlas of hazards, and coins that are far slower and far faster than any hand throws.

use reference::Reference;
use serde::{Deserialize, Serialize};
use toss::{
    ExactSolver, InputError, Launch, QuaternionSolver, Scheme, Settings, Solver, SolverEntry, Stepping, TimeOfFlight,
    Toss,
};
use verify::Effort;
use verify::clock;
use verify::host::Host;
use verify::measure::atlas::Atlas;
use verify::measure::atlas::hazards::HAZARDS;
use verify::measure::run::{Answer, Run};
use verify::measure::subject::{Subject, subjects, tight, usual};
use verify::measure::survey::Survey;
use verify::measure::work_precision::problems::Problem;
use verify::measure::work_precision::{Sample, Sweep};

/// Name of the random launches in the record and on the chart.
pub const SURVEY: &str = "survey";

/// Factors on the body rate of ordinary launches. The time of flight is divided by them, so that the coin turns as far.
pub const SPEEDS: [f64; 4] = [1e-12, 1e-6, 1e6, 1e12];

/// Launches of the survey that are flown at each of these speeds.
const AT_EACH_SPEED: usize = 8;

/// Launches on which times are taken, and how often; the shortest counts.
const TIMED: usize = 32;
const TIMES: usize = 3;

/// How large a contest is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Size {
    /// Launches of the survey.
    pub launches: u64,
    /// Launches of the chart of work against error; 0 for no chart.
    pub swept: usize,
    /// Whether hazards and speeds are flown.
    pub hazards: bool,
}

impl Size {
    /// The size of a record.
    pub const FULL: Self = Self { launches: 1000, swept: 64, hazards: true };
    /// A size of seconds, whose launches are the first ones of a record.
    pub const QUICK: Self = Self { launches: 40, swept: 0, hazards: false };
}

/// What a contest found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Contest {
    /// The machine and the day.
    pub host: Host,
    /// Number of random launches.
    pub launches: u64,
    /// What was found of each contestant, solvers of this workspace first.
    pub contestants: Vec<Contestant>,
}

/// What was found of one contestant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Contestant {
    /// `solver` or `solver/scheme`.
    pub name: String,
    /// What it is, in one line.
    pub summary: String,
    /// At the default tolerance or step of this workspace.
    pub usual: Flown,
    /// At its tight tolerance or step.
    pub tight: Flown,
    /// The worst answer at each hazard, at the default setting, with its name.
    pub hazards: Vec<(String, Answer)>,
    /// The worst answer at each of [`SPEEDS`], at the default setting.
    pub speeds: Vec<Answer>,
    /// Error of the attitude after 1000 s (rad), at the default setting; null if it had no answer.
    pub long_flight: Option<f64>,
}

/// The random launches at one setting.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Flown {
    /// `tolerance 1e-10` or `step 0.001 s`; empty for a closed form.
    pub setting: String,
    /// Largest error of cos θ.
    pub err_cos_tilt: f64,
    /// Largest error of the attitude (rad).
    pub err_attitude_rad: f64,
    /// Launches without an answer, and why the first of them has none.
    pub failures: u64,
    /// The first error.
    pub failure: Option<String>,
    /// Launches whose answer is outside of what the error estimate allows.
    pub beyond_estimate: u64,
    /// The largest error of cos θ that the error estimate allows.
    pub estimate: f64,
    /// Calls of the right-hand side per launch; 0 where they can't be counted.
    pub calls: f64,
    /// Time per launch (ns), on one thread.
    pub ns: f64,
}

/// The solvers of this workspace that take part, for comparison.
pub fn ours() -> Vec<SolverEntry> {
    let [dop853, ..] = Scheme::RUNGE_KUTTA;
    vec![ExactSolver::entry(), QuaternionSolver::entry().with_schemes(&[dop853, toss::TAYLOR])]
}

impl Contest {
    /// Holds the contest of `entries` and the solvers of this workspace, and tells `show` what is going on.
    ///
    /// # Errors
    /// If a scheme takes neither a tolerance nor a step.
    pub fn hold(
        entries: &[SolverEntry],
        size: Size,
        mut show: impl FnMut(&str),
    ) -> anyhow::Result<(Self, Vec<Sample>)> {
        let registry = [ours(), entries.to_vec()].concat();
        let survey = Survey::random(&[], size.launches)?;
        let (at_usual, at_tight) = (subjects(&registry, usual)?, subjects(&registry, tight)?);
        let mut contestants = Vec::new();
        for (usual, tight) in at_usual.iter().zip(&at_tight) {
            show(&format!("{}: {} random launches at two settings", usual.name, size.launches));
            contestants.push(Contestant {
                name: usual.name.clone(),
                summary: usual.entry.summary().to_owned(),
                usual: Flown::new(usual, &survey),
                tight: Flown::new(tight, &survey),
                hazards: Vec::new(),
                speeds: Vec::new(),
                long_flight: None,
            });
        }
        if size.hazards {
            show("all: the atlas of hazards");
            let atlas = Atlas::new(&registry, Effort::Standard)?;
            for (contestant, subject) in contestants.iter_mut().zip(&at_usual) {
                show(&format!("{}: slow and fast coins", contestant.name));
                contestant.meet_hazards(&atlas, subject, &survey.tosses)?;
            }
        }
        let samples = if size.swept == 0 {
            Vec::new()
        } else {
            show("all: work against error");
            let tosses = survey.tosses.iter().take(size.swept).copied().collect();
            let problem = Problem { name: SURVEY.to_owned(), stresses: "ordinary launches".to_owned(), tosses };
            Sweep::new(&registry, &[problem], Effort::Quick)?.samples
        };
        Ok((Self { host: Host::here(), launches: size.launches, contestants }, samples))
    }

    /// The contestant called `name`.
    pub fn named(&self, name: &str) -> Option<&Contestant> {
        self.contestants.iter().find(|contestant| contestant.name == name)
    }

    /// What is worse here than in `record`, which has at least the same launches: a failure or an error that it has
    /// not.
    pub fn worse_than(&self, record: &Self) -> Vec<String> {
        let mut worse = Vec::new();
        for contestant in &self.contestants {
            let Some(recorded) = record.named(&contestant.name) else {
                worse.push(format!("{}: the record does not have it", contestant.name));
                continue;
            };
            for (now, before) in [(&contestant.usual, &recorded.usual), (&contestant.tight, &recorded.tight)] {
                let name = format!("{} {}", contestant.name, now.setting);
                // Other machines round some functions of the C library otherwise.
                let allowed = 1.25 * before.err_attitude_rad + 1e-15;
                if now.err_attitude_rad > allowed {
                    worse.push(format!(
                        "{name}: off by {:e} rad, {:e} rad in the record",
                        now.err_attitude_rad, before.err_attitude_rad
                    ));
                }
                if now.failures > before.failures {
                    worse.push(format!("{name}: {}", now.failure.as_deref().unwrap_or("no answer")));
                }
            }
        }
        worse
    }
}

impl Flown {
    fn new(subject: &Subject, survey: &Survey) -> Self {
        let launches = survey.tosses.iter().zip(&survey.exact);
        let runs: Vec<Run> =
            launches.filter_map(|(toss, exact)| Some(Run::new(subject, toss, exact.as_ref()?))).collect();
        let largest = |of: fn(&Run) -> Option<f64>| runs.iter().filter_map(of).fold(0.0, f64::max);
        let count = |of: fn(&Run) -> bool| runs.iter().filter(|run| of(run)).count() as u64;
        let estimate = |toss: &Toss| subject.solver.tilt(toss).ok()?.error;
        let answered = runs.iter().filter_map(|run| run.rhs_calls);
        Self {
            setting: setting(subject.stepping),
            err_cos_tilt: largest(|run| run.err_cos_tilt),
            err_attitude_rad: largest(|run| run.err_attitude),
            failures: count(|run| run.failure.is_some()),
            failure: runs.iter().find_map(|run| run.failure.clone()),
            beyond_estimate: count(|run| run.answer == Answer::SilentlyWrong),
            estimate: survey.tosses.iter().filter_map(estimate).fold(0.0, f64::max),
            calls: answered.sum::<u64>() as f64 / runs.len().max(1) as f64,
            ns: nanoseconds(&*subject.solver, &survey.tosses[..TIMED.min(survey.tosses.len())]),
        }
    }
}

impl Contestant {
    fn meet_hazards(&mut self, atlas: &Atlas, subject: &Subject, ordinary: &[Toss]) -> anyhow::Result<()> {
        let worst = |id: &str| atlas.worst(id, &self.name).unwrap_or(Answer::TypedError);
        let of_coins = HAZARDS.iter().filter(|hazard| hazard.is_of_coins());
        self.hazards = of_coins.map(|hazard| (hazard.id.to_owned(), worst(hazard.id))).collect();
        let long = atlas.series("F8", &self.name).find(|spot| spot.distance == 1e-3);
        self.long_flight = long.and_then(|spot| spot.run.err_attitude);
        for factor in SPEEDS {
            let mut worst = Answer::Right;
            for toss in ordinary.iter().take(AT_EACH_SPEED) {
                let toss = at_speed(toss, factor)?;
                let run = Run::new(&with_step_over(subject, factor)?, &toss, &Reference::of(&toss)?);
                worst = worst.max(run.answer);
            }
            self.speeds.push(worst);
        }
        Ok(())
    }
}

/// The toss with its body rate times `factor`, and with its time of flight divided by it.
fn at_speed(toss: &Toss, factor: f64) -> Result<Toss, InputError> {
    let launch = toss.launch;
    let time = TimeOfFlight::Given(launch.flight_time() / factor);
    Ok(Toss { launch: Launch::new(launch.rate() * factor, time)?.with_attitude(launch.attitude()), ..*toss })
}

/// `subject` with its step, if it has one, divided by `factor`.
fn with_step_over(subject: &Subject, factor: f64) -> Result<Subject, InputError> {
    let stepping = match subject.stepping {
        Some(stepping) => Some(match stepping.control() {
            toss::StepControl::Step(step) => Stepping::fixed(stepping.scheme(), step / factor)?,
            toss::StepControl::Tolerance(_) => stepping,
        }),
        None => None,
    };
    Ok(Subject::new(&subject.entry, stepping, Settings::default().formulation))
}

fn setting(stepping: Option<Stepping>) -> String {
    match stepping.map(|stepping| stepping.control()) {
        Some(toss::StepControl::Tolerance(tolerance)) => format!("tolerance {tolerance:e}"),
        Some(toss::StepControl::Step(step)) => format!("step {step:e} s"),
        None => String::new(),
    }
}

/// The shortest time per launch (ns) of some passes over `tosses`.
fn nanoseconds(solver: &dyn Solver, tosses: &[Toss]) -> f64 {
    let pass = || {
        for toss in tosses {
            // Failed flights take time, too.
            let _ = std::hint::black_box(solver.land(std::hint::black_box(toss)));
        }
    };
    clock::nanoseconds(clock::times(pass, |runs, _| runs < TIMES)[0]) / tosses.len().max(1) as f64
}

#[cfg(test)]
mod tests;
