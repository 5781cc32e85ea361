//! This file makes launches that an adversary would choose to break a solver: random ones of all sizes, and ones at and
//! next to every special case. Launches of ordinary size hardly ever come near enough to a singular point to provoke a
//! wrong answer. A search flies them by every solver and scheme in its default formulation, for answers that are wrong
//! without an error: the worst fault of a solver, because you cannot see it.
//!
//! n is the coin's normal, S its angular momentum, k = I3/I1 its inertia ratio, ψ the cone angle between n and S, β the
//! angle of n to the vertical.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

use anyhow::Context as _;
use dynamics::Toss;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use rayon::prelude::*;
use toss::{
    Coin, CoinMotion, CoinToss, Formulation, InputError, Launch, Scheme, SolverEntry, Stepping, TimeOfFlight, Vector3,
};

use super::case;
use super::context::Context;
use super::reference::Reference;
use super::replay::Replay;
use super::run::{Answer, Run};
use super::subject::{Subject, by_scheme};
use super::tosses::{decades, one, stream, throw, tossed};
use super::trial::{Measurement, Worst};

const SEED: u64 = 20_261_121;

/// Tolerances; launches take them in turn.
const TOLERANCES: [f64; 5] = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12];

/// Steps of schemes without a tolerance, in units of 1/|ω|; launches take them in turn.
const STEPS: [f64; 2] = [0.1, 0.03];

/// Steps of slow launches, in units of 1/|ω|; the slow launches take them in turn, with every scheme that takes steps. The
/// smallest ones are so many that rounding is all there is.
const SLOW_STEPS: [f64; 4] = [0.1, 0.03, 0.01, 0.003];

/// What one solver with its scheme answered to launches that were chosen to break it.
pub(crate) struct Answers {
    subject: String,
    launches: u64,
    /// How many answers are of each kind, and the first of them.
    kinds: BTreeMap<Answer, (u64, Worst)>,
}

/// Tries adversarial launches with every solver of the registry, each integrator by every scheme.
pub(super) fn search(context: &Context) -> anyhow::Result<Vec<Answers>> {
    let launches = context.effort.of([400, 10_000, 200_000]);
    search_among(context, &(0..launches).map(|index| launch(SEED, index)).collect::<Vec<_>>())
}

/// The same with `tosses`, each of which has a reference.
pub(super) fn search_among(context: &Context, tosses: &[Toss]) -> anyhow::Result<Vec<Answers>> {
    let contestants: Vec<_> = context.registry.iter().flat_map(by_scheme).collect();
    let exact: Vec<_> = tosses.par_iter().map(|toss| context.exact.of(toss)).collect();
    let by = |by: &(&SolverEntry, Option<Scheme>)| {
        let fly = |(index, (toss, exact)): (usize, (&Toss, &Option<Arc<Reference>>))| {
            let exact = exact.as_ref().context("a launch to break solvers has no reference")?;
            Ok(Run::new(&subject(*by, toss, index)?, toss, exact))
        };
        let runs: Vec<Run> = tosses.par_iter().zip(&exact).enumerate().map(fly).collect::<anyhow::Result<_>>()?;
        let subject_of_first = runs.first().map(|run| run.subject.clone()).unwrap_or_default();
        let mut answers = Answers { subject: subject_of_first, launches: runs.len() as u64, kinds: BTreeMap::new() };
        for (index, run) in runs.into_iter().enumerate() {
            match answers.kinds.entry(run.answer) {
                Entry::Occupied(mut known) => known.get_mut().0 += 1,
                Entry::Vacant(first) => {
                    let settings = case::settings(&subject(*by, &tosses[index], index)?);
                    let replay = Some(Replay { input: run.inputs.clone(), settings, row: None });
                    let failure = Some(run.failure.clone().unwrap_or_else(|| run.words()));
                    first.insert((1, Worst { input: run.inputs, failure, replay }));
                }
            }
        }
        Ok(answers)
    };
    contestants.par_iter().map(by).collect()
}

impl Answers {
    /// The number of answers of a kind, with the first of them as the worst case.
    pub(crate) fn number_of(&self, answer: Answer) -> Measurement {
        let (measured, worst) = self.kinds.get(&answer).cloned().unzip();
        let none = Measurement::figure(&self.subject, measured.unwrap_or(0) as f64, self.launches, String::new());
        Measurement { worst, ..none }
    }
}

/// A solver with its scheme, if it is an integrator, with its settings for launch number `index`.
fn subject((entry, scheme): (&SolverEntry, Option<Scheme>), toss: &Toss, index: usize) -> Result<Subject, InputError> {
    let stepping = |scheme: Scheme| {
        let step = match is_slow(index) && scheme.takes_steps() {
            true => SLOW_STEPS[index / SLOW_EVERY % SLOW_STEPS.len()],
            false if scheme.is_adaptive() => return Stepping::adaptive(scheme, TOLERANCES[index % TOLERANCES.len()]),
            false => STEPS[index % STEPS.len()],
        };
        // For a coin at rest 1/|ω| is infinite, and the longest step will do.
        let rate = toss.launch.turn_rate().max(f64::MIN_POSITIVE);
        Stepping::fixed(scheme, (step / rate).min(f64::MAX))
    };
    Ok(Subject::new(entry, scheme.map(stepping).transpose()?, Formulation::default()))
}

/// One launch in so many is slow: all its rates are below 1e-3 rad/s, and it turns by up to 300 rad in hours to years.
const SLOW_EVERY: usize = 40;

/// Launch number `index` of the sequence that `seed` starts. It depends on these two numbers alone.
pub(super) fn launch(seed: u64, index: usize) -> Toss {
    drawn(&mut stream(seed, index as u64), index).expect("every launch is valid")
}

fn drawn(rng: &mut ChaCha8Rng, index: usize) -> Result<Toss, InputError> {
    let k = inertia_ratio(rng);
    let coin = Coin::from_moments(1.0, k)?;
    let mut rate = rate(rng, k);
    if is_slow(index) && rate.amax() > 0.0 {
        rate = rate / rate.amax() * decades(rng, -9.0, -3.0);
    }
    let motion = CoinMotion::new(&CoinToss { coin, launch: Launch::new(rate, TimeOfFlight::Given(0.0))? });
    let tilt = tilt(rng, motion.cone_angle());
    let time = time(rng, &motion, &rate);
    // The motion depends on the ratio of the moments alone, whatever their size (kg m²).
    let i1 = decades(rng, -12.0, 3.0);
    let coin = Coin::from_moments(i1, (k * i1).min(2.0 * i1))?;
    tossed(coin, rate, throw(TimeOfFlight::Given(time), index as u64), tilt)
}

/// Whether launch number `index` is a slow one.
fn is_slow(index: usize) -> bool {
    index % SLOW_EVERY == SLOW_EVERY - 1
}

/// A number of either sign and of a size from 1e-17 to 1, equally likely in each decade.
fn near(rng: &mut ChaCha8Rng) -> f64 {
    decades(rng, -17.0, 0.0) * one(rng, [-1.0, 1.0])
}

/// An inertia ratio k from a rod (0) to a flat disc (2), often at or next to that of a sphere (1).
fn inertia_ratio(rng: &mut ChaCha8Rng) -> f64 {
    match rng.random_range(0..3) {
        0 => one(rng, [0.0, 5e-324, 1e-300, 1e-9, 0.5, 1.0 - f64::EPSILON, 1.0, 1.0 + f64::EPSILON, 1.98, 2.0]),
        1 => (1.0 + near(rng)).clamp(0.0, 2.0),
        _ => rng.random_range(0.0..2.0),
    }
}

/// The body rate ω (rad/s) of a coin of inertia ratio `k`: as of a hand; near pure spin, no spin or ψ = 45°; with
/// components of very different sizes; or of any size.
fn rate(rng: &mut ChaCha8Rng, k: f64) -> Vector3<f64> {
    let hand = Vector3::from_fn(|_, _| rng.random_range(-60.0..60.0));
    match rng.random_range(0..6) {
        0 | 1 => hand,
        2 => {
            let part = near(rng);
            let [across, along] = if rng.random() { [part, 1.0] } else { [1.0, part] };
            Vector3::new(hand.x * across, hand.y * across, hand.z * along)
        }
        3 => {
            let diagonal = hand.x.hypot(hand.y) / k.max(1e-3) * (1.0 + near(rng));
            Vector3::new(hand.x, hand.y, diagonal)
        }
        4 => hand.map(|part| part * one(rng, [0.0, 1.0, 1e-8, 1e-16, 1e-160, 1e-320])),
        _ => hand * decades(rng, -320.0, 300.0),
    }
}

/// The tilt β at launch (rad), from 0 to π: level, on edge, upside down or with S along the vertical (`cone` is the
/// angle between n and S); next to one of these; or any.
fn tilt(rng: &mut ChaCha8Rng, cone: f64) -> f64 {
    let special = one(rng, [0.0, FRAC_PI_2, PI, cone, PI - cone]);
    match rng.random_range(0..4) {
        0 => special,
        1 => (special + near(rng)).clamp(0.0, PI),
        2 => one(rng, [0.0, 1e-300, 1e-16, 1e-8]),
        _ => rng.random_range(0.0..PI),
    }
}

/// The time of flight (s). Most coins, slow or fast, get a time in which they turn by up to 300 rad. One in fifty flies
/// for up to 100 s, if it is of ordinary speed, and one in a hundred turns by more than 10^16 rad, where every solver
/// must refuse. Phases in between are left out: there integrators only reach their largest number of steps, which takes
/// a second a flight.
fn time(rng: &mut ChaCha8Rng, motion: &CoinMotion, rate: &Vector3<f64>) -> f64 {
    let turns_in_a_second = motion.phase(1.0).unwrap_or(f64::INFINITY).max(rate.amax()).max(f64::MIN_POSITIVE);
    let ordinary = (1e-3..200.0).contains(&turns_in_a_second);
    let time = match rng.random_range(0..100) {
        0 => decades(rng, 16.0, 300.0) / turns_in_a_second,
        1 | 2 if ordinary => rng.random_range(0.0..100.0),
        3 => 0.0,
        _ => decades(rng, -3.0, 2.5) / turns_in_a_second,
    };
    // A time beyond the range of f64 becomes the largest one.
    if time.is_finite() { time } else { f64::MAX }
}
