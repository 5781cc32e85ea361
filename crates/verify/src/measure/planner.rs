//! A trial of the planner on random scenes: questions about tosses as hands and machines make them, and about spaces of such
//! tosses. It shows whether the planned answers are accurate enough, and whether their errors were expected.
//!
//! A scene is a question (outcome, cos θ, attitude, trace or probability) with an accuracy; a model is a way to answer
//! it. Errors are against the 256-bit reference or, of a probability, against another method. Each scene follows from a seed
//! and an index alone, so a failing one can be made again.

use std::f64::consts::PI;

use anyhow::bail;
use dynamics::coin::NO_COIN;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use rayon::prelude::*;
use sampling::{Coordinate, Estimate, Plan, Rest, Sampler, Scrambled, Space};
use toss::catalogue::CATALOGUE;
use toss::planner::Integrator;
use toss::{
    Answer, Choice, Coin, CoinToss, Error, InputError, Launch, Outcome, Registry, Scene, TimeOfFlight, Toss,
    TracePoint, Vector3, Want, level_speeds_of_heads,
};

use crate::measure::case;
use crate::measure::context::Context;
use crate::measure::reference;
use crate::measure::tosses::{decades, level_or_tilted, stream, tossed};

const SEED: u64 = 12;

/// Actual and expected errors below this count as this one, because a result near 1 is rounded by as much in f64.
const ROUNDING: f64 = 0.5 * f64::EPSILON;

#[derive(Debug, Clone)]
pub(crate) struct Planned {
    /// The scene's kind.
    pub kind: &'static str,
    /// `None` if the scene was refused because no setting is accurate enough, or the integrator does not solve its toss.
    pub errors: Option<Errors>,
    /// The scene in words, its toss as text.
    pub input: String,
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Errors {
    /// Divided by the accuracy that was asked for.
    pub by_accuracy: f64,
    /// The largest on the scene's toss and, if the error there is far below the expected one, on some similar tosses,
    /// because the error on a single toss may be small by luck. It is divided by the error that the plan expected, which
    /// counts as at least [`ROUNDING`].
    pub by_expected: f64,
}

/// Solves a number of random scenes that depends on the effort.
pub(super) fn random_scenes(context: &Context) -> anyhow::Result<Vec<Planned>> {
    let (tosses, spaces) = context.effort.of([(1000, 6), (10_000, 24), (10_000, 100)]);
    let tosses = (0..tosses).into_par_iter().map(|index| {
        let (kind, scene) = toss_scene(SEED, index)?;
        solve(kind, &scene, true)
    });
    let mut planned: Vec<Planned> = tosses.collect::<anyhow::Result<_>>()?;
    for index in 0..spaces {
        planned.push(solve_space(index)?);
    }
    Ok(planned)
}

/// Solves a scene about a toss. If its error is far below the expected one, it may be small by luck: then similar tosses are
/// solved, too, if `tries_similar`.
pub(super) fn solve(kind: &'static str, scene: &Scene, tries_similar: bool) -> anyhow::Result<Planned> {
    let toss = toss_of(scene);
    let wanted = scene.want.kind().name();
    let by = |by: &Integrator| format!(" by {} {}", by.solver, by.scheme.as_deref().unwrap_or("any"));
    let by = scene.by.as_ref().map(by).unwrap_or_default();
    let input = format!("{} # {wanted} to {:e}{by}", case::text(toss), scene.accuracy);
    let choice = match scene.plan() {
        Ok(plan) => plan.choice,
        Err(Error::Input(InputError::OutOfRange { field: "accuracy", .. }) | Error::Solve(_)) => {
            return Ok(Planned { kind, errors: None, input });
        }
        Err(error) => return Err(error.into()),
    };
    let error = error(scene, &choice.run(scene)?)?;
    let expected = choice.expected_error;
    let is_far_below = tries_similar && expected > 30.0 * error.max(ROUNDING);
    let error_of_family =
        if is_far_below { error.max(largest_of_neighbours(&choice, scene)?.unwrap_or(0.0)) } else { error };
    let by_expected = error_of_family / expected.max(ROUNDING);
    Ok(Planned { kind, errors: Some(Errors { by_accuracy: error / scene.accuracy, by_expected }), input })
}

/// The toss of a scene that has one.
fn toss_of(scene: &Scene) -> &Toss {
    scene.want.toss().expect("a scene about a toss")
}

fn solve_space(index: u64) -> anyhow::Result<Planned> {
    const POINTS: u64 = 1 << 20;
    let space = space(SEED, index)?;
    let scene = Scene::new(Want::Probability(space), decades(&mut stream(SEED, index), -3.0, -1.0));
    let choice = scene.plan()?.choice;
    let Answer::Probability(estimate) = choice.run(&scene)? else { bail!("a probability was planned") };
    let error = (estimate.probability - true_probability(&space, POINTS)?).abs();
    let by_expected = error / choice.expected_error.max(ROUNDING);
    let errors = Some(Errors { by_accuracy: error / scene.accuracy, by_expected });
    let input = format!("space {index} of seed {SEED} # probability to {:e}", scene.accuracy);
    Ok(Planned { kind: "probability", errors, input })
}

/// The largest error of a choice on tosses that are similar to the scene's; `None` if it fails on one.
fn largest_of_neighbours(choice: &Choice, scene: &Scene) -> anyhow::Result<Option<f64>> {
    const NEIGHBOURS: u64 = 8;
    let mut largest = 0.0_f64;
    for index in 0..NEIGHBOURS {
        let near = Scene { want: scene.want.of(neighbour(toss_of(scene), SEED, index)?), ..scene.clone() };
        let Ok(answer) = choice.run(&near) else { return Ok(None) };
        largest = largest.max(error(&near, &answer)?);
    }
    Ok(Some(largest))
}

/// A random toss. The coin is from the catalogue or any other; the rates are up to 60 rad/s or, in a third of the
/// tosses, up to a limit between 0.1 and 1000 rad/s, some without spin and some with little wobble. Half of the
/// launches start horizontal. One in six lands at another height, one in six has a given time of flight.
fn random_toss(rng: &mut ChaCha8Rng) -> Result<Toss, InputError> {
    let coin = match rng.random_range(0..3) {
        0 => CATALOGUE[rng.random_range(0..CATALOGUE.len())].coin()?,
        1 => Coin::from_moments(1.0, rng.random_range(1.9..2.0))?,
        _ => Coin::from_moments(1.0, rng.random_range(0.0..2.0))?,
    };
    let largest = if rng.random_range(0..3) == 0 { decades(rng, -1.0, 3.0) } else { 60.0 };
    let any = Vector3::from_fn(|_, _| rng.random_range(-largest..largest));
    let rate = match rng.random_range(0..6) {
        0 => Vector3::new(any.x, any.y, 0.0),
        1 => Vector3::new(0.1 * any.x, 0.1 * any.y, any.z),
        _ => any,
    };
    let tilt = level_or_tilted(rng, PI);
    let (speed, gravity) = (rng.random_range(1.0..6.0), 9.81);
    let time = match rng.random_range(0..6) {
        0 => TimeOfFlight::thrown(speed, gravity, Some(rng.random_range(-0.9..1.5) * speed * speed / (2.0 * gravity))),
        1 => TimeOfFlight::Given(decades(rng, -2.0, 1.0)),
        _ => TimeOfFlight::thrown(speed, gravity, None),
    };
    tossed(coin, rate, time, tilt)
}

/// A toss that differs from `toss` by up to 1 % in each rate and in time. Its errors are of the same size on average,
/// but not the same.
fn neighbour(toss: &Toss, seed: u64, index: u64) -> Result<Toss, InputError> {
    let mut rng = stream(seed, index);
    let launch = toss.launch;
    let rate = launch.rate().map(|part| part * rng.random_range(0.99..1.01));
    let time = TimeOfFlight::Given(launch.flight_time() * rng.random_range(0.99..1.01));
    Ok(Toss { launch: Launch::new(rate, time)?.with_attitude(launch.attitude()), ..*toss })
}

/// Scene number `index` of the sequence that `seed` starts, with its kind: what is wanted, or `integrator` if it asks for one.
/// Of ten scenes three want an outcome, three cos θ, two an attitude and one a trace, with accuracies from 1e-2 to 2e-15; the
/// tenth asks for an integrator, with accuracies from 1e-2 to 1e-11.
fn toss_scene(seed: u64, index: u64) -> Result<(&'static str, Scene), InputError> {
    let mut rng = stream(seed, index);
    let toss = random_toss(&mut rng)?;
    let kinds =
        ["outcome", "outcome", "outcome", "tilt", "tilt", "tilt", "attitude", "attitude", "trace", "integrator"];
    let kind = kinds[rng.random_range(0..kinds.len())];
    let wanted = if kind == "integrator" { kinds[rng.random_range(0..9)] } else { kind };
    let want = match wanted {
        "outcome" => Want::Outcome(toss),
        "tilt" => Want::Tilt(toss),
        "attitude" => Want::Attitude(toss),
        _ => Want::Trace { toss, points: rng.random_range(2..8) },
    };
    let scene = if kind == "integrator" {
        let entries: Vec<_> = Registry::standard().entries().iter().filter(|entry| entry.integrates()).collect();
        let scheme = [None, Some("dop853"), Some("dopri5")][rng.random_range(0..3)];
        let solver = entries[rng.random_range(0..entries.len())].name();
        Scene::new(want, decades(&mut rng, -11.0, -2.0)).by(solver, scheme)
    } else {
        Scene::new(want, decades(&mut rng, -14.7, -2.0))
    };
    Ok((kind, scene))
}

/// Space number `index` of the sequence that `seed` starts. Each rate and the tilt is a value or a range; four spaces
/// of five have a range of speeds.
pub(super) fn space(seed: u64, index: u64) -> Result<Space, InputError> {
    let mut rng = stream(seed, index);
    let mut range = |free: f64, from: f64, to: f64, width: f64| {
        let lo = rng.random_range(from..to);
        if rng.random_range(0.0..1.0) < free {
            format!("{lo}:{}", lo + rng.random_range(0.1..1.0) * width)
        } else {
            lo.to_string()
        }
    };
    let texts = [
        (Coordinate::RateX, range(0.6, 0.0, 40.0, 30.0)),
        (Coordinate::RateY, range(0.3, 0.0, 40.0, 30.0)),
        (Coordinate::RateZ, range(0.3, 0.0, 40.0, 30.0)),
        (Coordinate::Speed, range(0.8, 2.0, 4.0, 3.0)),
        (Coordinate::Tilt, range(0.2, 0.0, 0.5, 1.0)),
    ];
    let texts = texts.each_ref().map(|(of, text)| (*of, text.as_str()));
    let coin = if index.is_multiple_of(2) { Coin::PAPER } else { Coin::from_moments(1.0, 1.95)? };
    Space::parse(coin, &texts)
}

/// The error of an answer to a scene about a toss: that of cos θ, or the angle between attitudes (rad). The error of an outcome
/// is 0 or infinite. If the scene asks for an integrator, an undecided outcome has no error where |cos θ| is at most twice
/// the scene's accuracy.
fn error(scene: &Scene, answer: &Answer) -> anyhow::Result<f64> {
    let wrong = |is_wrong: bool| if is_wrong { f64::INFINITY } else { 0.0 };
    let toss = toss_of(scene);
    let landing = reference::of(toss)?;
    Ok(match answer {
        Answer::Outcome(verdict) if verdict.outcome() == Outcome::Undecided && scene.by.is_some() => {
            wrong(landing.cos_tilt_error(0.0) > 2.0 * scene.accuracy)
        }
        Answer::Outcome(verdict) => wrong(verdict.outcome() != landing.outcome()),
        Answer::Tilt(cos_tilt) => landing.cos_tilt_error(*cos_tilt),
        Answer::Attitude(state) => landing.attitude_error(&state.attitude),
        Answer::Trace(points) => {
            let mut largest = 0.0_f64;
            for TracePoint { time, attitude, .. } in points {
                // The last point is the landing, whose time is not rounded to f64.
                let is_landing = *time == toss.launch.flight_time();
                let time = if is_landing { toss.launch.time_of_flight() } else { TimeOfFlight::Given(*time) };
                let until = toss.launch.with_time_of_flight(time)?;
                largest = largest.max(reference::of(&Toss { launch: until, ..*toss })?.attitude_error(attitude));
            }
            largest
        }
        // No scene of these is about a space or asks for a proof.
        Answer::Enclosed(_) | Answer::Probability(_) => f64::INFINITY,
    })
}

/// The probability of heads in `space`, computed in another way than by the models under test: from the lengths of the
/// intervals of speeds that land heads if only the speed is free, otherwise by `points` launches with another seed,
/// many more than the models use.
fn true_probability(space: &Space, points: u64) -> Result<f64, Error> {
    const OTHER_SEED: u64 = 987_654_321;
    let free: Vec<Coordinate> = space.free().collect();
    let scrambled = Scrambled::new(points, OTHER_SEED);
    let is_of_coins = space.coin().is_some();
    if free == [Coordinate::Speed] && is_of_coins {
        return share_by_intervals(space);
    }
    let plan = if free.contains(&Coordinate::Speed) && is_of_coins {
        Plan::ExactSpeed(Rest::Sobol(scrambled))
    } else {
        Plan::Sobol(scrambled)
    };
    let Estimate { probability, .. } = Sampler::exact().estimate(space, plan)?;
    Ok(probability)
}

fn share_by_intervals(space: &Space) -> Result<f64, Error> {
    let value = |of| space.axis(of).bounds()[0];
    let [slowest, fastest] = space.axis(Coordinate::Speed).bounds();
    let rate = Vector3::new(value(Coordinate::RateX), value(Coordinate::RateY), value(Coordinate::RateZ));
    let time = TimeOfFlight::thrown(fastest, value(Coordinate::Gravity), None);
    let coin = space.coin().ok_or(NO_COIN)?;
    let toss = CoinToss { coin, launch: Launch::new(rate, time)?.with_tilt(value(Coordinate::Tilt))? };
    let intervals = level_speeds_of_heads(&toss, slowest)?;
    let length: f64 = intervals.into_iter().flatten().map(|[slow, fast]| fast - slow).sum();
    Ok(length / (fastest - slowest))
}
