//! These checks fly what is hostile to integrators: long flights at the finest tolerances, in which rounding adds up, and
//! plans of such flights.

use anyhow::Context as _;
use exact::motion::COS_TILT_ERROR;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use rayon::prelude::*;
use toss::{Answer, Error, InputError, Scene, Scheme, SolveError, SolverEntry, Want};

use crate::measure::any_case::AnyReference;
use crate::measure::bodies::FAMILIES;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::effort::Effort;
use crate::measure::hostile::{self, Flight};
use crate::measure::measurement::Measurement;
use crate::measure::planner::delivered::Truth;

pub(super) const WITHIN_ESTIMATE: Check = Check {
    id: "hostile-within-estimate",
    claim: "On flights of up to 1e6 rad at tolerances down to 2.3e-16, of coins and bodies whose rounding errors add up, the \
            errors of cos θ and of the attitude are at most what the solver's estimate allows, or the solver returns an \
            error. Measured: the largest error divided by that; it fails above the bound, or at 1 without one. Where a \
            solver states no estimate, it decides nothing and is not judged.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: 1.0,
    unit: "1",
    measure: |context| {
        let schemes = |entry: &SolverEntry| entry.schemes().to_vec();
        let contestants = context.registry.iter().filter(|entry| entry.integrates());
        let each = contestants.flat_map(|entry| schemes(entry).into_iter().map(move |scheme| (entry, scheme)));
        each.map(|(entry, scheme)| of_contestant(context.effort, entry, scheme)).collect()
    },
};

/// One landing: its error divided by what the estimate allows, `None` without an estimate; or why there is none.
type Landing = (String, Result<Option<f64>, SolveError>);

fn of_contestant(effort: Effort, entry: &SolverEntry, scheme: Scheme) -> anyhow::Result<Measurement> {
    let ([coins, bodies], most_steps) = hostile::numbers(effort);
    let coin = |index: u64| Ok(Some(hostile::of_coin(entry, scheme, index, most_steps)?.1));
    let body = |index: u64| {
        let family = index % FAMILIES.len() as u64;
        hostile::of_body(entry, scheme, [family, index / FAMILIES.len() as u64], most_steps)
    };
    let bodies = bodies * FAMILIES.len() as u64;
    let landed =
        |flight: Result<Option<Flight>, InputError>| flight.map(|flight| flight.and_then(|flight| land(&flight)));
    let flown = (0..coins).into_par_iter().map(coin).chain((0..bodies).into_par_iter().map(body)).map(landed);
    let landings: Vec<Landing> = flown.collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect();
    let (name, _) = hostile::of_coin(entry, scheme, 0, most_steps).map(|(_, flight)| (flight.by.name, ()))?;
    let refused = landings.iter().filter(|(_, part)| part.is_err()).count();
    let silent = landings.iter().filter(|(_, part)| matches!(part, Ok(None))).count();
    let judged = landings.iter().filter_map(|(input, part)| Some((input, (*part.as_ref().ok()?)?)));
    let over = judged.clone().filter(|(_, part)| *part > 1.0).count();
    let worst = judged.max_by(|a, b| a.1.total_cmp(&b.1)).context("every flight was refused")?;
    let input = format!("{over} above; {refused} refused, {silent} without an estimate; worst {}", worst.0);
    let cases = landings.len() as u64;
    Ok(Measurement::figure(WITHIN_ESTIMATE.id, &name, worst.1, cases, input).claiming(Some(1.0)))
}

/// `None` for a body that the solver does not solve.
fn land(Flight { toss, input, by }: &Flight) -> Option<Landing> {
    let part = || -> Result<Option<f64>, SolveError> {
        let landing = by.solver.land(toss)?;
        let Some(estimate) = landing.error else { return Ok(None) };
        let (exact, allowed) = (AnyReference::of_rigid(toss)?, estimate.max(COS_TILT_ERROR));
        let attitude = exact.attitude_error(&landing.state.attitude);
        Ok(Some((exact.cos_tilt_error(landing.cos_tilt) / allowed).max(attitude / (10.0 * allowed))))
    };
    match part() {
        Err(SolveError::NotSymmetric { .. }) => None,
        part => Some((format!("{input} {}", by.options()), part)),
    }
}

pub(super) const PLANS: Check = Check {
    id: "plan-hostile",
    claim: "A plan that asks for an integrator keeps its accuracy on rods, discs and nearly equal moments at any rates, \
            and on bodies of any moments. Measured: the largest error divided by that accuracy; it fails above the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1.0,
    unit: "1",
    measure: |context| {
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
            let input = format!("{over} above; {} refused; worst {}", of_kind.len() - cases, worst.1);
            Ok(Measurement::figure(PLANS.id, kind, worst.0, cases as u64, input))
        };
        KINDS.into_iter().chain([BODIES]).map(row).collect()
    },
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
    let (mut rng, case) = hostile::planned(index)?;
    let kind = KINDS[rng.random_range(0..KINDS.len())];
    let toss = case.toss.into();
    let want = match kind {
        "outcome" => Want::Outcome(toss),
        "tilt" => Want::Tilt(toss),
        "attitude" => Want::Attitude(toss),
        _ => Want::Trace { toss, points: rng.random_range(2..8) },
    };
    let (by, scene) = asked(want, ["gamma", "euler", "quaternion"][rng.random_range(0..3)], &mut rng);
    let input = format!("{kind} {by}: {}", case.hex());
    planned(kind, &scene, input, |answer| Ok(Truth::new(&case.toss).error(&scene, answer)?))
}

/// Plan number `index` of a body, and its answer; `None` where there is no such body.
fn plan_body(index: u64) -> anyhow::Result<Option<Planned>> {
    let (mut rng, toss) = hostile::planned_body(index);
    let Some(toss) = toss.filter(|toss| toss.coin().is_none()) else { return Ok(None) };
    let want = if rng.random() { Want::Tilt(toss) } else { Want::Attitude(toss) };
    let (by, scene) = asked(want, ["euler", "quaternion"][rng.random_range(0..2)], &mut rng);
    let input = format!("{} {by}: {:?}, {:?}", scene.want.kind().name(), toss.body.tensor(), toss.launch);
    let error = |answer: &Answer| {
        let exact = AnyReference::of_rigid(&toss)?;
        Ok(match answer {
            Answer::Tilt(cos_tilt) => exact.cos_tilt_error(*cos_tilt),
            Answer::Attitude(state) => exact.attitude_error(&state.attitude),
            _ => f64::INFINITY,
        })
    };
    planned(BODIES, &scene, input, error).map(Some)
}

/// A scene that wants this by the solver, with any scheme and accuracy, and these in words.
fn asked(want: Want, solver: &str, rng: &mut ChaCha8Rng) -> (String, Scene) {
    let scheme = [None, Some("dop853"), Some("dopri5")][rng.random_range(0..3)];
    let accuracy = 10f64.powf(rng.random_range(-11.0..-2.0));
    let by = format!("to {accuracy:e} by {solver} {}", scheme.unwrap_or("any"));
    (by, Scene::new(want, accuracy).by(solver, scheme))
}

/// What comes of the plan of a scene.
fn planned(
    kind: &'static str,
    scene: &Scene,
    input: String,
    error: impl FnOnce(&Answer) -> anyhow::Result<f64>,
) -> anyhow::Result<Planned> {
    let answer = match scene.plan().and_then(|decision| decision.choice.run(scene)) {
        Ok(answer) => answer,
        Err(Error::Solve(_) | Error::Input(InputError::OutOfRange { field: "accuracy", .. })) => {
            return Ok(Planned { kind, error_by_accuracy: None, input });
        }
        Err(error) => return Err(error.into()),
    };
    Ok(Planned { kind, error_by_accuracy: Some(error(&answer)? / scene.accuracy), input })
}
