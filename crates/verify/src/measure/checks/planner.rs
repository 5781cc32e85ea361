//! The checks of the planner on random scenes (questions with an accuracy), about coins, other bodies and spaces of launches,
//! and on scenes that are hostile to integrators. Only solving scenes shows whether its choices are right.

use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use rayon::prelude::*;
use toss::{Scene, Want};

use crate::measure::check::Check;
use crate::measure::check::Measure::Own;
use crate::measure::context::Context;
use crate::measure::hostile;
use crate::measure::planner::{Errors, Planned, solve};
use crate::measure::tosses::one;
use crate::measure::trial::Measurement;

pub(super) const CHECKS: &[Check] = &[
    Check::of_library("plan-delivers", Own(|all| of_random_scenes(all, |errors| errors.by_accuracy)))
        .up_to(1.0, "1")
        .claims(
            "The error of every scene that is solved as planned is at most the accuracy asked for. Measured: the \
             largest error divided by that accuracy; it fails above the limit.",
        ),
    Check::of_library("plan-expects", Own(|all| of_random_scenes(all, |errors| errors.by_expected)))
        .up_to(1.0, "1")
        .claims(
            "The error of every scene that is solved as planned is at most the error that the plan expects. Measured: \
             the largest error on the scene's toss and, where a small error may be luck, on similar ones, divided by \
             the expected error; it fails above the limit.",
        ),
    Check::of_library("plan-hostile", Own(hostile_plans)).up_to(1.0, "1").claims(
        "A plan that asks for an integrator keeps its accuracy on rods, discs and nearly equal moments at any rates, \
         and on bodies of any moments. Measured: the largest error divided by that accuracy; it fails above the limit.",
    ),
];

type Part = fn(Errors) -> f64;

/// The largest `part` over the scenes of each kind, in the order in which the kinds first appear.
fn of_random_scenes(context: &Context, part: Part) -> anyhow::Result<Vec<Measurement>> {
    let scenes = context.scenes.get(context)?;
    let mut kinds: Vec<&str> = Vec::new();
    for scene in scenes {
        if !kinds.contains(&scene.kind) {
            kinds.push(scene.kind);
        }
    }
    Ok(kinds.into_iter().map(|kind| of_kind(scenes, kind, part, |_| String::new())).collect())
}

/// The largest `part` over the scenes of a kind, with a remark on all parts.
fn of_kind(scenes: &[Planned], kind: &str, part: Part, remark: fn(&[f64]) -> String) -> Measurement {
    let of_kind: Vec<&Planned> = scenes.iter().filter(|scene| scene.kind == kind).collect();
    let answered = of_kind.iter().filter_map(|scene| Some((part(scene.errors?), &scene.input)));
    let parts: Vec<f64> = answered.clone().map(|(part, _)| part).collect();
    let (remark, refused) = (remark(&parts), of_kind.len() - parts.len());
    let worst = answered.max_by(|a, b| a.0.total_cmp(&b.0));
    let (measured, input) = worst.map_or((f64::INFINITY, "every scene"), |(part, input)| (part, input));
    Measurement::figure(kind, measured, parts.len() as u64, format!("{input}; {remark}{refused} refused"))
}

fn hostile_plans(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let number: u64 = context.effort.of([200, 1000, 5000]);
    let coins = (0..number).into_par_iter().map(|index| plan(index).map(Some));
    let bodies = (0..number).into_par_iter().map(plan_body);
    let planned: Vec<Option<Planned>> = coins.chain(bodies).collect::<anyhow::Result<_>>()?;
    let planned: Vec<Planned> = planned.into_iter().flatten().collect();
    let above = |parts: &[f64]| format!("{} above; ", parts.iter().filter(|part| **part > 1.0).count());
    let row = |kind| of_kind(&planned, kind, |errors| errors.by_accuracy, above);
    Ok(KINDS.into_iter().chain([BODIES]).map(row).collect())
}

const KINDS: [&str; 4] = ["outcome", "tilt", "attitude", "trace"];

/// The kind of a plan of a body with I1 ≠ I2: half want cos θ, half an attitude.
const BODIES: &str = "bodies";

fn plan(index: u64) -> anyhow::Result<Planned> {
    let (mut rng, toss) = hostile::planned(index);
    let kind = one(&mut rng, KINDS);
    let want = match kind {
        "outcome" => Want::Outcome(toss),
        "tilt" => Want::Tilt(toss),
        "attitude" => Want::Attitude(toss),
        _ => Want::Trace { toss, points: rng.random_range(2..8) },
    };
    solve_asked(kind, want, &["gamma", "euler", "quaternion"], &mut rng)
}

/// Plan number `index` of a body, and its answer; `None` where there is no such body.
fn plan_body(index: u64) -> anyhow::Result<Option<Planned>> {
    let (mut rng, toss) = hostile::planned_body(index);
    let Some(toss) = toss.filter(|toss| toss.coin().is_none()) else { return Ok(None) };
    let want = if rng.random() { Want::Tilt(toss) } else { Want::Attitude(toss) };
    solve_asked(BODIES, want, &["euler", "quaternion"], &mut rng).map(Some)
}

/// Plans and answers what is wanted, by one of the solvers with any scheme and accuracy.
fn solve_asked(kind: &'static str, want: Want, solvers: &[&str], rng: &mut ChaCha8Rng) -> anyhow::Result<Planned> {
    let solver = solvers[rng.random_range(0..solvers.len())];
    let scheme = one(rng, [None, Some("dop853"), Some("dopri5")]);
    let accuracy = 10f64.powf(rng.random_range(-11.0..-2.0));
    solve(kind, &Scene::new(want, accuracy).by(solver, scheme), false)
}
