//! The checks of the planner on random scenes (questions with an accuracy), about coins, other bodies and spaces of launches,
//! and on scenes that are hostile to integrators. Only solving scenes shows whether its choices are right.

use std::cmp::Ordering;

use anyhow::Context as _;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use rayon::prelude::*;
use toss::{Error, InputError, Scene, Toss, Want};

use crate::measure::case;
use crate::measure::check::{Check, Measure};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::hostile;
use crate::measure::measurement::Measurement;
use crate::measure::planner::{Solved, Truth};

pub(super) const DELIVERS: Check = Check {
    id: "plan-delivers",
    claim: "The error of every scene that is solved as planned is at most the accuracy asked for. Measured: the \
            largest error divided by that accuracy; it fails above the limit.",
    ceiling: 1.0,
    measure: Measure::Own(|context| largest(context, Solved::error_by_accuracy)),
    ..Check::OF_LIBRARY
};

pub(super) const EXPECTS: Check = Check {
    id: "plan-expects",
    claim: "The error of every scene that is solved as planned is at most the error that the plan expects. Measured: \
            the largest error on the scene's toss and, where a small error may be luck, on similar ones, divided by \
            the expected error; it fails above the limit.",
    ceiling: 1.0,
    measure: Measure::Own(|context| largest(context, Solved::error_by_expected)),
    ..Check::OF_LIBRARY
};

/// The largest `part` over the solved scenes of each kind.
fn largest(context: &Context, part: fn(&Solved) -> f64) -> anyhow::Result<Vec<Measurement>> {
    let trial = context.trial.get(context)?;
    let row = |kind: &'static str| {
        let of_kind = trial.outcomes.iter().filter(|outcome| outcome.kind == kind);
        let outcomes = of_kind.clone().filter(|outcome| outcome.model.is_some());
        let larger = |a: &&Solved, b: &&Solved| part(a).partial_cmp(&part(b)).unwrap_or(Ordering::Greater);
        let number = outcomes.clone().count() as u64;
        let worst = outcomes.max_by(larger);
        let refused = of_kind.count() as u64 - number;
        let input = worst.map_or_else(String::new, |outcome| format!("{}; {refused} refused", outcome.input));
        Measurement::figure(kind, worst.map_or(f64::INFINITY, part), number, input)
    };
    Ok(trial.kinds().into_iter().map(row).collect())
}

pub(super) const PLANS: Check = Check {
    id: "plan-hostile",
    claim: "A plan that asks for an integrator keeps its accuracy on rods, discs and nearly equal moments at any rates, \
            and on bodies of any moments. Measured: the largest error divided by that accuracy; it fails above the limit.",
    ceiling: 1.0,
    measure: Measure::Own(|context| {
        let number: u64 = match context.effort {
            Effort::Quick => 200,
            Effort::Standard => 1000,
            Effort::Deep => 5000,
        };
        let coins = (0..number).into_par_iter().map(|index| plan(index).map(Some));
        let bodies = (0..number).into_par_iter().map(plan_body);
        let planned: Vec<Option<Planned>> = coins.chain(bodies).collect::<anyhow::Result<_>>()?;
        let row = |kind: &'static str| {
            let of_kind: Vec<&Planned> = planned.iter().flatten().filter(|one| one.kind == kind).collect();
            let answered = of_kind.iter().filter_map(|one| Some((one.error_by_accuracy?, &one.input)));
            let (over, cases) = (answered.clone().filter(|(part, _)| *part > 1.0).count(), answered.clone().count());
            let worst = answered.max_by(|a, b| a.0.total_cmp(&b.0)).context("every plan was refused")?;
            let input = format!("{}; {over} above; {} refused", worst.1, of_kind.len() - cases);
            Ok(Measurement::figure(kind, worst.0, cases as u64, input))
        };
        KINDS.into_iter().chain([BODIES]).map(row).collect()
    }),
    ..Check::OF_LIBRARY
};

/// What is planned.
const KINDS: [&str; 4] = ["outcome", "tilt", "attitude", "trace"];

/// The kind of a plan of a body with I1 ≠ I2: half want cos θ, half an attitude.
const BODIES: &str = "bodies";

/// What came of a plan.
struct Planned {
    kind: &'static str,
    /// `None` where the plan or the integrator was refused with an error.
    error_by_accuracy: Option<f64>,
    input: String,
}

/// Plan number `index`, and its answer.
fn plan(index: u64) -> anyhow::Result<Planned> {
    let (mut rng, coin) = hostile::planned(index);
    let kind = KINDS[rng.random_range(0..KINDS.len())];
    let toss = coin.into();
    let want = match kind {
        "outcome" => Want::Outcome(toss),
        "tilt" => Want::Tilt(toss),
        "attitude" => Want::Attitude(toss),
        _ => Want::Trace { toss, points: rng.random_range(2..8) },
    };
    let (by, scene) = asked(want, ["gamma", "euler", "quaternion"][rng.random_range(0..3)], &mut rng);
    let input = format!("{} # {kind} {by}", case::text(&toss));
    planned(kind, &scene, &toss, input)
}

/// Plan number `index` of a body, and its answer; `None` where there is no such body.
fn plan_body(index: u64) -> anyhow::Result<Option<Planned>> {
    let (mut rng, toss) = hostile::planned_body(index);
    let Some(toss) = toss.filter(|toss| toss.coin().is_none()) else { return Ok(None) };
    let want = if rng.random() { Want::Tilt(toss) } else { Want::Attitude(toss) };
    let (by, scene) = asked(want, ["euler", "quaternion"][rng.random_range(0..2)], &mut rng);
    let input = format!("{} # {} {by}", case::text(&toss), scene.want.kind().name());
    planned(BODIES, &scene, &toss, input).map(Some)
}

/// A scene that wants this by the solver, with any scheme and accuracy, and these in words.
fn asked(want: Want, solver: &str, rng: &mut ChaCha8Rng) -> (String, Scene) {
    let scheme = [None, Some("dop853"), Some("dopri5")][rng.random_range(0..3)];
    let accuracy = 10f64.powf(rng.random_range(-11.0..-2.0));
    let by = format!("to {accuracy:e} by {solver} {}", scheme.unwrap_or("any"));
    (by, Scene::new(want, accuracy).by(solver, scheme))
}

/// What comes of the plan of a scene about `toss`.
fn planned(kind: &'static str, scene: &Scene, toss: &Toss, input: String) -> anyhow::Result<Planned> {
    let answer = match scene.plan().and_then(|decision| decision.choice.run(scene)) {
        Ok(answer) => answer,
        Err(Error::Solve(_) | Error::Input(InputError::OutOfRange { field: "accuracy", .. })) => {
            return Ok(Planned { kind, error_by_accuracy: None, input });
        }
        Err(error) => return Err(error.into()),
    };
    Ok(Planned { kind, error_by_accuracy: Some(Truth::new(toss)?.error(scene, &answer)? / scene.accuracy), input })
}
