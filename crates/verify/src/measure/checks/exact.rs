//! The checks of the exact motion (the closed form in double-double arithmetic), of the outcomes that it proves, of batches
//! and of what is derived from it, by the 256-bit reference. Last bits and proofs depend on rounding, so the tosses include
//! those where rounding is hardest. The kernels of batches are written separately from the solver of one toss, so checks of
//! that solver say nothing about them.
//!
//! An ulp is the distance from an f64 to the next; the phase (rad) is the angle by which a motion turns, and ψ the cone
//! angle between the coin's normal n and its angular momentum S.

use std::f64::consts::TAU;

use dynamics::Toss;
use exact::certified::{cos_tilt_in_double_double, f64_bound};
use exact::{ExactMotion, TiltTerms, certify, compensated_cos_tilt};
use nalgebra::{Matrix3x4, Matrix4, Vector4};
use toss::{
    Attitude, Batch, CoinMotion, CoinToss, Error, Launch, Outcome, Sensitivity, SimdLevel, SolveError, TimeOfFlight,
    Tosses, Vector3, level_speeds_of_heads, margin, speeds_of_heads,
};

use crate::measure::case::is_horizontal;
use crate::measure::check::{Basis, Check, Fold, Measure, Set};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::families::{FAMILIES, Family, LONG, launches};
use crate::measure::measurement::Deviation;
use crate::measure::reference::Reference;
use crate::measure::tosses::{adversarial, corners, few_turns, random, tries};

pub(super) const COS_TILT: Check = Check {
    id: "last-bit-cos-tilt",
    claim: "cos θ at landing from the exact motion differs from the 256-bit reference by at most the limit, about an \
            ulp of 1, for phases up to 1e9 rad and at the corners of the model.",
    ceiling: 1e-15,
    measure: Measure::Tosses(|| last_bits(cos_tilt_error), Fold::Largest),
    ..Check::OF_LIBRARY
};

pub(super) const ATTITUDE: Check = Check {
    id: "last-bit-attitude",
    claim: "The attitude at landing from the exact motion differs from the 256-bit reference by at most the limit, a \
            few ulp, for phases up to 1e9 rad and at the corners of the model.",
    ceiling: 1e-14,
    unit: "rad",
    measure: Measure::Tosses(|| last_bits(attitude_error), Fold::Largest),
    ..Check::OF_LIBRARY
};

pub(super) const EULER_ANGLES: Check = Check {
    id: "last-bit-euler-angles",
    claim: "The attitude that the exact motion's Euler angles at landing give differs from the 256-bit reference by \
            at most the limit, in ulp of 1 plus the largest angle.",
    ceiling: 10.0,
    unit: "ulp",
    measure: Measure::Tosses(|| last_bits(euler_angles_error), Fold::Largest),
    ..Check::OF_LIBRARY
};

pub(super) const OUTCOMES: Check = Check {
    id: "certified-outcomes",
    claim: "Certified outcomes are those of the 256-bit reference, also within 3 ulp of the speed at which the \
            outcome changes. Measured: the number of tosses that differ, also by being undecided; one is enough to \
            fail.",
    unit: "tosses",
    measure: Measure::Tosses(outcomes, Fold::Count),
    ..Check::OF_LIBRARY
};

fn outcomes() -> Vec<Set> {
    let differs = |toss: &CoinToss, reference: &Reference| {
        Ok(f64::from(certify(&(*toss).into())?.outcome() != reference.outcome()))
    };
    vec![
        Set::of_tries("random", |tries| random(3 * tries, 6e4, 4), differs),
        Set::of_tries("adversarial", |tries| adversarial(tries, few_turns), differs),
    ]
}

pub(super) const BOUNDS: Check = Check {
    id: "certified-bounds",
    claim: "The error of cos θ in the proof stages f64 and double-double is within the error bound by which the stage \
            proves an outcome. Measured: the largest error divided by that error bound; it fails above the limit of \
            this check.",
    ceiling: 1.0,
    measure: Measure::Tosses(bounds, Fold::Largest),
    ..Check::OF_LIBRARY
};

fn bounds() -> Vec<Set> {
    let tosses = |tries: u64| {
        let mut tosses = Vec::new();
        for (seed, phase) in [(5, 1.0), (6, 1e2), (7, 6e4), (8, 1e9)] {
            tosses.extend(random(tries / 4, phase, seed)?);
        }
        tosses.extend(adversarial(tries / 4, few_turns)?);
        Ok(tosses)
    };
    vec![
        Set::of_tries("f64", tosses, part_of_f64_bound),
        Set::of_tries("double-double", tosses, part_of_double_double_bound),
    ]
}

/// A deviation of the toss of a coin.
type OfCoin = fn(&CoinToss, &Reference) -> Deviation;

fn last_bits(error: OfCoin) -> Vec<Set> {
    vec![
        Set::of_tries("phases to 1e2", |tries| random(tries, 1e2, 1), error),
        Set::of_tries("phases to 6e4", |tries| random(tries, 6e4, 2), error),
        Set::of_tries("phases to 1e9", |tries| random(tries, 1e9, 3), error),
        Set::of_tries("corners", |_| corners(), error),
    ]
}

fn cos_tilt_of_exact_motion(toss: &CoinToss) -> Deviation {
    CoinMotion::new(toss).cos_tilt(toss.launch.time_of_flight())
}

/// Error of cos θ.
fn cos_tilt_error(toss: &CoinToss, reference: &Reference) -> Deviation {
    Ok(reference.cos_tilt_error(cos_tilt_of_exact_motion(toss)?))
}

/// Angle to the exact attitude (rad).
fn attitude_error(toss: &CoinToss, reference: &Reference) -> Deviation {
    Ok(reference.attitude_error(&CoinMotion::new(toss).state(toss.launch.time_of_flight())?.attitude))
}

/// Angle of the attitude of the Euler angles to the exact one, in ulp of 1 plus the largest angle.
fn euler_angles_error(toss: &CoinToss, reference: &Reference) -> Deviation {
    let angles = CoinMotion::new(toss).euler_angles(toss.launch.time_of_flight())?;
    let largest = angles.alpha.abs().max(angles.beta.abs()).max(angles.gamma.abs());
    Ok(reference.attitude_error(&angles.attitude()) / (f64::EPSILON * (1.0 + largest)))
}

/// Error of cos θ in the f64 stage, divided by the stage's error bound.
fn part_of_f64_bound(toss: &CoinToss, reference: &Reference) -> Deviation {
    let terms = TiltTerms::new(toss);
    let [phase, _] = terms.phases(toss.launch.flight_time());
    let error = reference.cos_tilt_error(terms.height(phase) / terms.size);
    Ok(error / f64_bound(phase))
}

/// Error of cos θ in the double-double stage, divided by the radius of its ball; 0 of a toss that has none.
fn part_of_double_double_bound(toss: &CoinToss, reference: &Reference) -> Deviation {
    let Some(ball) = cos_tilt_in_double_double(toss) else { return Ok(0.0) };
    Ok(reference.unrounded_cos_tilt_error(*ball.midpoint()) / ball.radius())
}

pub(super) const BATCH_COS_TILT: Check = Check {
    id: "batch-cos-tilt",
    claim: "cos θ at landing from a batch differs from the 256-bit reference by at most the limit, for phases up to \
            1e9 rad, near changes of the outcome and at the corners of the model.",
    ceiling: 1e-14,
    measure: Measure::Tosses(
        || of_batches(|toss, reference| Ok(reference.cos_tilt_error(batched(toss, cos_tilt)?))),
        Fold::Largest,
    ),
    ..Check::OF_LIBRARY
};

pub(super) const BATCH_ATTITUDE: Check = Check {
    id: "batch-attitude",
    claim: "The attitude at landing from a batch differs from the 256-bit reference by at most the limit, for phases \
            up to 1e9 rad, near changes of the outcome and at the corners of the model.",
    ceiling: 1e-14,
    unit: "rad",
    measure: Measure::Tosses(
        || of_batches(|toss, reference| Ok(reference.attitude_error(&batched(toss, attitude)?))),
        Fold::Largest,
    ),
    ..Check::OF_LIBRARY
};

pub(super) const BATCH_OUTCOMES: Check = Check {
    id: "batch-outcomes",
    claim: "The outcomes of a batch are those of the 256-bit reference, also within 3 ulp of the speed at which the \
            outcome changes. Measured: the number of tosses that differ; one is enough to fail.",
    unit: "tosses",
    measure: Measure::Tosses(outcomes_of_batches, Fold::Count),
    ..Check::OF_LIBRARY
};

fn outcomes_of_batches() -> Vec<Set> {
    let differs =
        |toss: &CoinToss, reference: &Reference| Ok(f64::from(batched(toss, outcome)? != reference.outcome()));
    vec![
        Set::of_tries("random", |tries| level(random(tries, 6e4, 14)?), differs),
        Set::of_tries("adversarial", |tries| level(adversarial(tries / 2, few_turns)?), differs),
        Set::of_tries("adversarial, many turns", |tries| level(adversarial(tries / 4, many_turns)?), differs),
    ]
}

pub(super) const SIMD_LEVELS: Check = Check {
    id: "batch-paths",
    claim: "Every SIMD level of the machine gives the same bits of cos θ, attitude and outcome as plain code. \
            Measured: the number of tosses with a difference; one is enough to fail.",
    basis: Basis::CrossMethod,
    unit: "tosses",
    measure: Measure::Tosses(simd_levels, Fold::Count),
    ..Check::OF_LIBRARY
};

fn simd_levels() -> Vec<Set> {
    vec![
        Set::of_tries("random", |tries| level(random(2 * tries, 6e4, 15)?), levels_that_differ),
        Set::of_tries("adversarial", |tries| level(adversarial(tries, few_turns)?), levels_that_differ),
    ]
}

fn of_batches(error: OfCoin) -> Vec<Set> {
    vec![
        Set::of_tries("phases to 1e2", |tries| level(random(tries, 1e2, 11)?), error),
        Set::of_tries("phases to 1e9", |tries| level(random(tries, 1e9, 13)?), error),
        Set::of_tries("adversarial", |tries| level(adversarial(tries / 2, few_turns)?), error),
        Set::of_tries("corners", |_| corners(), error),
    ]
}

/// The tosses as a batch can take them: it knows no landing at another height, only how long such a flight lasts.
fn level(tosses: Vec<CoinToss>) -> anyhow::Result<Vec<CoinToss>> {
    let level = |toss: CoinToss| {
        let flight = toss.launch.time_of_flight();
        let TimeOfFlight::BallisticTo { .. } = flight else { return Ok(toss) };
        Ok(CoinToss { launch: toss.launch.with_time_of_flight(TimeOfFlight::Given(flight.seconds()))?, ..toss })
    };
    tosses.into_iter().map(level).collect()
}

/// From a thousand to 10^9 turns, where the rounding of the phase is far above that of cos θ.
fn many_turns(index: usize) -> f64 {
    10f64.powi(3 + i32::try_from(index % 7).unwrap_or(0))
}

/// The number of SIMD levels that give other bits than plain code.
fn levels_that_differ(toss: &CoinToss, _: &Reference) -> Deviation {
    let bits = |batch: &Batch<'_>| -> Result<_, Error> {
        let turned: Attitude = attitude(batch)?;
        Ok((cos_tilt(batch)?.to_bits(), turned.components().map(f64::to_bits), outcome(batch)?))
    };
    let plain = batched(toss, |batch| bits(&batch.on(SimdLevel::all()[0])))?;
    let differs =
        |level: SimdLevel| batched(toss, |batch| bits(&batch.on(level))).map(|found| f64::from(found != plain));
    SimdLevel::all().into_iter().map(differs).sum()
}

/// The result of `kernel` for a batch that holds only `toss`.
fn batched<T>(toss: &CoinToss, kernel: impl Fn(&Batch<'_>) -> Result<T, Error>) -> Result<T, SolveError> {
    let rate = toss.launch.rate();
    // A batch takes speeds, not times: with a gravity of 2 m/s² the time 2 v0/g has the number of the speed.
    let (speed, gravity) = match toss.launch.time_of_flight() {
        TimeOfFlight::Ballistic { speed, gravity } => (speed, gravity),
        other => (other.seconds(), 2.0),
    };
    let rates: [&[f64]; 3] = [&[rate.x], &[rate.y], &[rate.z]];
    let attitude = toss.launch.attitude();
    let tosses = Tosses::new(toss.coin, attitude, gravity, rates, std::slice::from_ref(&speed)).expect("a valid toss");
    kernel(&Batch::new(tosses)).map_err(|error| match error {
        Error::Launch { source, .. } => source,
        other => unreachable!("a valid toss: {other}"),
    })
}

fn cos_tilt(batch: &Batch<'_>) -> Result<f64, Error> {
    let mut out = [f64::NAN];
    batch.cos_tilts(&mut out)?;
    Ok(out[0])
}

fn attitude(batch: &Batch<'_>) -> Result<Attitude, Error> {
    let mut out = [[f64::NAN]; 4];
    batch.attitudes(out.each_mut().map(<[f64; 1]>::as_mut_slice))?;
    Ok(Attitude::from_components(out.map(|column| column[0])).expect("a unit quaternion"))
}

fn outcome(batch: &Batch<'_>) -> Result<Outcome, Error> {
    let mut out = [Outcome::Undecided];
    batch.outcomes(&mut out)?;
    Ok(out[0])
}

pub(super) const MEAN_COS_TILT: Check = Check {
    id: "mean-cos-tilt-error",
    claim: "The mean of |error| of cos θ at landing by the exact motion, by compensated phases and by a batch, against \
            the 256-bit reference, is at most the limit, for phases up to 100 rad.",
    ceiling: 1e-15,
    measure: Measure::Tosses(mean_errors, Fold::Mean),
    ..Check::OF_LIBRARY
};

pub(super) const TERMS: Check = Check {
    id: "cos-tilt-terms",
    claim: "The terms of cos θ of the exact motion have more digits than f64: at launch, where they add up to cos θ \
            without a sine or cosine of f64, their sum differs from the 256-bit reference by at most the limit.",
    ceiling: 1e-18,
    measure: Measure::Tosses(terms, Fold::Largest),
    ..Check::OF_LIBRARY
};

fn terms() -> Vec<Set> {
    vec![
        Set::of_tries("phases to 1e2", |tries| random(tries / 4, 1e2, 9), terms_error),
        Set::of_tries("corners", |_| corners(), terms_error),
    ]
}

/// Error of cos θ at launch before it is rounded to f64. There the terms of cos θ add up to it without a sine or cosine
/// of f64, whose rounding hides theirs.
fn terms_error(toss: &CoinToss, _: &Reference) -> Deviation {
    let launch = toss.launch.with_time_of_flight(TimeOfFlight::Given(0.0)).expect("a valid time");
    let toss = CoinToss { launch, ..*toss };
    let (cos_tilt, _) = CoinMotion::new(&toss).cos_tilt_parts(0.0)?;
    Ok(Reference::new(&toss).unrounded_cos_tilt_error(cos_tilt))
}

/// The mean shows whether a rounding error that is carried along was lost: the largest error grows by no more than a fifth
/// then, because the rounding of the result hides it, and the mean is steadier.
fn mean_errors() -> Vec<Set> {
    type CosTilt = fn(&CoinToss) -> Deviation;
    let methods: [(&str, CosTilt); 3] = [
        ("exact", cos_tilt_of_exact_motion),
        ("compensated", compensated_cos_tilt),
        ("batch", |toss| batched(toss, cos_tilt)),
    ];
    let set = |launches: &str, flat: bool, (method, of): (&str, CosTilt)| {
        let tosses = move |tries: u64| {
            let all = level(random(tries.min(100_000), 1e2, 16)?)?;
            Ok(all.into_iter().filter(|toss| is_horizontal(&toss.launch) == flat).collect())
        };
        let error = move |toss: &CoinToss, reference: &Reference| Ok(reference.cos_tilt_error(of(toss)?));
        Set::of_tries(&format!("{method}, {launches}"), tosses, error)
    };
    [("horizontal", true), ("tilted", false)]
        .into_iter()
        .flat_map(|(launches, flat)| methods.map(|method| set(launches, flat, method)))
        .collect()
}

pub(super) const RIGID_COS_TILT: Check = Check {
    id: "rigid-cos-tilt",
    claim: "cos θ at landing of any rigid body differs from the 256-bit reference by at most the limit, for phases \
            from 1 to 1e9 rad.",
    ceiling: 1e-15,
    measure: Measure::Tosses(rigid_cos_tilts, Fold::Largest),
    ..Check::OF_LIBRARY
};

pub(super) const RIGID_ATTITUDE: Check = Check {
    id: "rigid-attitude",
    claim: "The attitude at landing of any rigid body differs from the 256-bit reference by at most the limit, for \
            phases from 1 to 1e9 rad.",
    unit: "rad",
    ceiling: 1e-14,
    measure: Measure::Tosses(rigid_attitudes, Fold::Largest),
    ..Check::OF_LIBRARY
};

pub(super) const RIGID_OUTCOMES: Check = Check {
    id: "rigid-outcomes",
    claim: "The proven outcomes of any rigid body are those of the 256-bit reference within 3 ulp of a time at which \
            the outcome changes. Measured: the number of tosses that differ or are undecided; one is enough to fail.",
    unit: "tosses",
    measure: Measure::Tosses(at_edges, Fold::Count),
    ..Check::OF_LIBRARY
};

/// A set of long flights for each family of bodies, with references that all checks of them take.
fn on_long_flights(deviation: impl Fn(&Toss, &Reference) -> Deviation + Copy + Sync + 'static) -> Vec<Set> {
    let set = |(index, family): (usize, &Family)| {
        Set::of_cases(family.name, move |context| Ok(context.long_bodies.get(context)?[index].clone()), deviation)
    };
    FAMILIES.iter().enumerate().map(set).collect()
}

/// Errors of cos θ.
fn rigid_cos_tilts() -> Vec<Set> {
    on_long_flights(|toss, reference| {
        Ok(reference.cos_tilt_error(ExactMotion::new(toss).cos_tilt(toss.launch.time_of_flight())?))
    })
}

/// Angles to the exact attitude (rad).
fn rigid_attitudes() -> Vec<Set> {
    on_long_flights(|toss, reference| {
        Ok(reference.attitude_error(&ExactMotion::new(toss).state(toss.launch.time_of_flight())?.attitude))
    })
}

fn at_edges() -> Vec<Set> {
    let set = |family: &'static Family| {
        let tosses = move |context: &Context| {
            Ok(launches(family, tries(context.effort) / 20, LONG).filter_map(|toss| at_an_edge(&toss)).collect())
        };
        // A toss without a proof is undecided.
        Set::new(family.name, tosses, |toss, reference| {
            Ok(f64::from(!certify(toss).is_ok_and(|found| found.outcome() == reference.outcome())))
        })
    };
    FAMILIES.iter().map(set).collect()
}

/// The same toss with a time within 3 ulp of one at which the outcome changes, near the time of the toss. `None` if
/// none is found.
pub(super) fn at_an_edge(toss: &Toss) -> Option<Toss> {
    let motion = ExactMotion::new(toss);
    let edge = edge_near(toss, |time| motion.cos_tilt(time).ok())?;
    // By turns 3 ulp before and behind the edge.
    let ulps = (toss.launch.flight_time().to_bits() % 7) as i64 - 3;
    let time = f64::from_bits(edge.to_bits().wrapping_add_signed(ulps));
    let launch = Launch::new(toss.launch.rate(), TimeOfFlight::Given(time)).ok()?;
    Some(Toss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss })
}

/// The first time near that of the toss, from there on, at which `cos_tilt` has changed its sign. It only looks for a
/// toss that is hard; the reference judges it.
pub(super) fn edge_near(toss: &Toss, cos_tilt: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let rate = toss.launch.turn_rate();
    let heads = |time: f64| cos_tilt(time).map(|cos_tilt| cos_tilt > 0.0);
    let start = toss.launch.flight_time();
    let first = heads(start)?;
    let end = (1..100).map(|step| start + f64::from(step) * 0.3 / rate).find(|time| heads(*time) == Some(!first))?;
    let (mut before, mut after) = (start.max(end - 0.3 / rate), end);
    if heads(before)? != first {
        return None;
    }
    while before.next_up() < after {
        let middle = before + 0.5 * (after - before);
        if heads(middle)? == first { before = middle } else { after = middle }
    }
    Some(after)
}

pub(super) const DERIVATIVES: Check = Check {
    id: "sensitivity",
    claim: "The derivatives of attitude and cos θ at landing by relative changes of ω and of the time of flight \
            differ from central differences in 256 bits by at most the limit, relative to the norm of the attitude's \
            derivative.",
    ceiling: 1e-10,
    measure: Measure::Tosses(derivatives, Fold::Largest),
    ..Check::OF_LIBRARY
};

fn derivatives() -> Vec<Set> {
    const LAUNCHES: usize = 500;
    let set = |(part, name)| {
        let tosses =
            |context: &Context| Ok(context.survey.get(context)?.tosses.iter().take(LAUNCHES).copied().collect());
        Set::of_coins(name, tosses, move |toss, _| Ok(errors_of_derivatives(toss)?[part]))
    };
    [(0, "attitude"), (1, "cos θ")].map(set).into()
}

/// The relative errors of the derivatives of the attitude and of cos θ.
fn errors_of_derivatives(toss: &CoinToss) -> Result<[f64; 2], SolveError> {
    let found = Sensitivity::new(&(*toss).into())?;
    let (attitude, cos_tilt) = differences(toss);
    let (rate, time) = (toss.launch.rate().norm(), toss.launch.flight_time());
    let relative = Matrix4::from_diagonal(&Vector4::new(rate, rate, rate, time));
    let size = (found.attitude * relative).norm();
    let attitude = ((found.attitude - attitude) * relative).norm();
    Ok([attitude / size, (relative * (found.cos_tilt - cos_tilt)).norm() / size])
}

/// Central differences of attitude and cos θ by ω and time, in 256 bits over relative steps of 2^-37. Their truncation
/// error is below 1e-18.
fn differences(toss: &CoinToss) -> (Matrix3x4<f64>, Vector4<f64>) {
    let (mut attitude, mut cos_tilt) = (Matrix3x4::zeros(), Vector4::zeros());
    let (rate, time) = (toss.launch.rate(), toss.launch.flight_time());
    let inputs = Vector4::new(rate.x, rate.y, rate.z, time);
    let landing = |inputs: &Vector4<f64>| {
        let launch = Launch::new(inputs.xyz(), TimeOfFlight::Given(inputs.w)).expect("next to a valid launch");
        Reference::new(&CoinToss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss })
    };
    for input in 0..4 {
        let size = if input == 3 { time } else { rate.norm() };
        let step = Vector4::ith(input, size * 2f64.powi(-37));
        let (before, after) = (inputs - step, inputs + step);
        let change = after[input] - before[input];
        let (from, to) = (landing(&before), landing(&after));
        attitude.set_column(input, &(from.turn_to(&to) / change));
        cos_tilt[input] = from.cos_tilt_to(&to) / change;
    }
    (attitude, cos_tilt)
}

pub(super) const MARGINS: Check = Check {
    id: "margins",
    claim: "Where a margin says that the outcome changes with one input, the 256-bit reference changes, to a relative \
            1e-9. None of twelve tosses on each side in between, nor of those for an input without a margin, has another \
            outcome: that is a sample, and a flip between two of them would not be seen. Measured: the number of inputs of \
            a toss with a wrong margin; one is enough to fail.",
    unit: "inputs",
    measure: Measure::Tosses(|| searched(61, wrong_margins), Fold::Largest),
    ..Check::OF_LIBRARY
};

pub(super) const SPEEDS: Check = Check {
    id: "speeds-of-heads",
    claim: "The outcome in 256 bits changes at both ends of each interval of speeds that land heads, to a relative \
            1e-9, and is heads within and tails between them, also for a landing at another height. Measured: the \
            number of speeds of a toss with another outcome; one is enough to fail.",
    unit: "speeds",
    measure: Measure::Tosses(|| searched(62, wrong_speeds), Fold::Largest),
    ..Check::OF_LIBRARY
};

/// Relative distance from a flip at which the outcome is asked for.
const CLOSE: f64 = 1e-9;

/// Largest number of tosses that are looked at between the launch and a flip, in each direction.
const MOST_LOOKS: u32 = 12;

/// Number of turns over which speeds of heads are compared.
const MOST_TURNS: f64 = 20.0;

/// Flips of the outcome are searched for in 256 bits, in many tosses one by one: the library walks along the motion in proven
/// steps.
fn searched(seed: u64, wrong: OfCoin) -> Vec<Set> {
    let tosses = move |context: &Context| {
        let number = match context.effort {
            Effort::Quick => 15,
            Effort::Standard => 150,
            Effort::Deep => 3000,
        };
        Ok(random(number, 1e2, seed)?.into_iter().map(Toss::from).collect())
    };
    vec![Set::of_coins("random", tosses, wrong)]
}

/// The value of an input.
type Value = fn(&CoinToss) -> f64;

/// A toss with `change` added to one of its inputs; `None` if there is no such toss.
type Changed = fn(&CoinToss, f64) -> Option<CoinToss>;

/// The inputs whose margins are compared: speed, gravity, tilt, ωx, ωy, ωz.
const INPUTS: [(Value, Changed); 6] = [
    (|toss| thrown(toss)[0], |toss, change| toss_thrown(toss, [change, 0.0])),
    (|toss| thrown(toss)[1], |toss, change| toss_thrown(toss, [0.0, change])),
    (tilt, |toss, change| Some(CoinToss { launch: toss.launch.with_tilt(tilt(toss) + change).ok()?, ..*toss })),
    (|toss| toss.launch.rate().x, |toss, change| toss_with_rate(toss, Vector3::new(change, 0.0, 0.0))),
    (|toss| toss.launch.rate().y, |toss, change| toss_with_rate(toss, Vector3::new(0.0, change, 0.0))),
    (|toss| toss.launch.rate().z, |toss, change| toss_with_rate(toss, Vector3::new(0.0, 0.0, change))),
];

/// Speed and gravity.
fn thrown(toss: &CoinToss) -> [f64; 2] {
    match toss.launch.time_of_flight() {
        TimeOfFlight::Ballistic { speed, gravity } | TimeOfFlight::BallisticTo { speed, gravity, .. } => {
            [speed, gravity]
        }
        TimeOfFlight::Given(_) => [f64::NAN; 2],
    }
}

/// The angle of the turn about the laboratory's x axis (rad).
fn tilt(toss: &CoinToss) -> f64 {
    let [w, x, ..] = toss.launch.attitude().components();
    2.0 * x.atan2(w)
}

fn relaunched(toss: &CoinToss, rate: Vector3<f64>, time_of_flight: TimeOfFlight) -> Option<CoinToss> {
    let launch = Launch::new(rate, time_of_flight).ok()?;
    Some(CoinToss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss })
}

fn toss_with_rate(toss: &CoinToss, change: Vector3<f64>) -> Option<CoinToss> {
    relaunched(toss, toss.launch.rate() + change, toss.launch.time_of_flight())
}

fn toss_thrown(toss: &CoinToss, [by_speed, by_gravity]: [f64; 2]) -> Option<CoinToss> {
    let [speed, gravity] = thrown(toss);
    let (speed, gravity) = (speed + by_speed, gravity + by_gravity);
    let time_of_flight = match toss.launch.time_of_flight() {
        TimeOfFlight::BallisticTo { drop, .. } => TimeOfFlight::BallisticTo { speed, gravity, drop },
        _ => TimeOfFlight::Ballistic { speed, gravity },
    };
    relaunched(toss, toss.launch.rate(), time_of_flight)
}

/// The number of inputs whose margin is wrong.
fn wrong_margins(toss: &CoinToss, reference: &Reference) -> Deviation {
    let (found, outcome) = (margin(&(*toss).into())?, reference.outcome());
    let [rate_x, rate_y, rate_z] = found.rate;
    let margins = [found.speed, found.gravity, found.tilt, rate_x, rate_y, rate_z];
    // Beyond these changes no flip was searched for, or all values are tried.
    let [speed, gravity] = thrown(toss);
    let turn = TAU / toss.launch.flight_time().max(1e-3);
    let near = found.rate_range.map(|range| range.min(4.0 * turn));
    let ranges = [speed, 0.99 * gravity, 1.5, near[0], near[1], near[2]];
    let wrong = INPUTS.iter().zip(margins).zip(ranges).filter(|(((value, changed), margin), range)| {
        let outcome_after = |change: f64| changed(toss, change).map(|toss| Reference::new(&toss).outcome());
        !is_right(value(toss), *margin, *range, outcome, MOST_LOOKS, outcome_after)
    });
    Ok(wrong.count() as f64)
}

/// Whether no toss that is looked at up to a margin, and the one beyond it, has another outcome than `outcome`.
pub(super) fn is_right(
    value: f64,
    margin: Option<f64>,
    range: f64,
    outcome: Outcome,
    number: u32,
    outcome_after: impl Fn(f64) -> Option<Outcome>,
) -> bool {
    let stays = |change: f64| outcome_after(change).is_none_or(|after| after == outcome);
    let Some(margin) = margin else { return looks(range, number).all(|change| stays(change) && stays(-change)) };
    // The change is rounded when it is added to the value.
    let close = CLOSE.max(4.0 * f64::EPSILON * value.abs() / margin.abs());
    let beyond = outcome_after(margin * (1.0 + close));
    beyond.is_some_and(|beyond| beyond != outcome)
        && stays(margin * (1.0 - close))
        && looks(margin.abs() * (1.0 - close), number).all(|change| stays(change) && stays(-change))
}

/// So many changes from 0 up to `range`, evenly spread.
fn looks(range: f64, number: u32) -> impl Iterator<Item = f64> {
    (1..=number).map(move |look| range * f64::from(look) / f64::from(number))
}

/// The number of speeds, at the ends of the intervals of heads and in between, whose outcome is another one: for a
/// landing at the height of the launch, below and above it.
fn wrong_speeds(toss: &CoinToss, _: &Reference) -> Deviation {
    let [speed, gravity] = thrown(toss);
    // Of a toss of many turns only the last ones, because each has an interval.
    let turns = CoinMotion::new(toss).phase(toss.launch.flight_time())? / TAU;
    let slowest = speed * (1.0 - MOST_TURNS / turns).max(0.4);
    let mut wrong = 0;
    for drop in [None, Some(0.3), Some(-0.01 * speed * speed / gravity)] {
        let time_of_flight = drop.map_or(TimeOfFlight::Ballistic { speed, gravity }, |drop| {
            TimeOfFlight::BallisticTo { speed, gravity, drop }
        });
        let Some(toss) = relaunched(toss, toss.launch.rate(), time_of_flight) else { continue };
        let heads = speeds_of_heads(&toss.into(), slowest)?.unwrap_or_default();
        if drop.is_none() {
            // Both functions answer the same question here.
            let level = level_speeds_of_heads(&toss, slowest)?.map(Iterator::collect::<Vec<_>>);
            wrong += usize::from(level.as_ref() != Some(&heads));
        }
        wrong += wrong_among(&toss, [slowest, speed], &heads)?;
    }
    Ok(wrong as f64)
}

fn wrong_among(toss: &CoinToss, [slowest, fastest]: [f64; 2], heads: &[[f64; 2]]) -> Result<usize, SolveError> {
    let ends = heads.iter().flatten().flat_map(|end| [end * (1.0 - CLOSE), end * (1.0 + CLOSE)]);
    let between = looks(1.0, MOST_LOOKS).map(|part| slowest + part * (fastest - slowest));
    // Next to an end of the range an interval may touch it within rounding.
    let inside = |speed: &f64| *speed > slowest * (1.0 + CLOSE) && *speed < fastest * (1.0 - CLOSE);
    let away = |speed: &f64| heads.iter().flatten().all(|end| (speed / end - 1.0).abs() > 0.5 * CLOSE);
    let speeds: Vec<f64> = ends.chain(between).filter(inside).filter(away).collect();
    let is_wrong = |speed: &&f64| {
        let expected = heads.iter().any(|[slow, fast]| (*slow..=*fast).contains(*speed));
        let there = toss_thrown(toss, [**speed - thrown(toss)[0], 0.0]);
        there.is_some_and(|there| (Reference::new(&there).outcome() == Outcome::Heads) != expected)
    };
    Ok(speeds.iter().filter(is_wrong).count())
}
