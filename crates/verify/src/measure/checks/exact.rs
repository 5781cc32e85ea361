//! The checks of the exact motion (the closed form in double-double arithmetic), of the outcomes that it proves, of batches
//! and of what is derived from it, by the 256-bit reference. Last bits and proofs depend on rounding, so the tosses include
//! those where rounding is hardest. The kernels of batches are written separately from the solver of one toss, so checks of
//! that solver say nothing about them.
//!
//! An ulp is the distance from an f64 to the next; the phase (rad) is the angle by which a motion turns, and ψ the cone
//! angle between the coin's normal n and its angular momentum S.

use dynamics::Toss;
use exact::batch::varying::{Attitudes, Column, Flights, Varying};
use exact::certified::{cos_tilt_in_double_double, f64_bound};
use exact::{ExactMotion, TiltTerms, certify};
use nalgebra::{Matrix3x4, Matrix4, Vector4};
use rayon::prelude::*;
use toss::{
    Attitude, Batch, CoinMotion, CoinToss, Error, Launch, Outcome, Sensitivity, SimdLevel, SolveError, TimeOfFlight,
};

use crate::measure::check::Basis::CrossMethod;
use crate::measure::check::Fold::{Count, Largest};
use crate::measure::check::Measure::Tosses;
use crate::measure::check::{Check, Set, coin};
use crate::measure::context::Context;
use crate::measure::families::{FAMILIES, Family, LONG, launches};
use crate::measure::reference::{self, Reference};
use crate::measure::tosses::{adversarial, corners, few_turns, random, tries};
use crate::measure::trial::Deviation;

pub(super) const CHECKS: &[Check] = &[
    Check::of_library("last-bit-cos-tilt", Tosses(|| last_bits(cos_tilt_error), Largest)).up_to(1e-15, "1").claims(
        "cos θ at landing from the exact motion differs from the 256-bit reference by at most the limit, about an ulp \
         of 1, for phases up to 1e9 rad and at the corners of the model.",
    ),
    Check::of_library("last-bit-attitude", Tosses(|| last_bits(attitude_error), Largest)).up_to(1e-14, "rad").claims(
        "The attitude at landing from the exact motion differs from the 256-bit reference by at most the limit, a few \
         ulp, for phases up to 1e9 rad and at the corners of the model.",
    ),
    Check::of_library("last-bit-euler-angles", Tosses(|| last_bits(euler_angles_error), Largest))
        .up_to(10.0, "ulp")
        .claims(
            "The attitude that the exact motion's Euler angles at landing give differs from the 256-bit reference by \
             at most the limit, in ulp of 1 plus the largest angle.",
        ),
    Check::of_library("certified-outcomes", Tosses(outcomes, Count)).up_to(0.0, "tosses").claims(
        "Certified outcomes are those of the 256-bit reference, also within 3 ulp of the speed at which the outcome \
         changes. Measured: the number of tosses that differ, also by being undecided; one is enough to fail.",
    ),
    Check::of_library("certified-bounds", Tosses(bounds, Largest)).up_to(1.0, "1").claims(
        "The error of cos θ in the proof stages f64 and double-double is within the error bound by which the stage \
         proves an outcome. Measured: the largest error divided by that error bound; it fails above the limit of this \
         check.",
    ),
    Check::of_library("batch-cos-tilt", Tosses(|| of_batches(batched_cos_tilt_error), Largest))
        .up_to(1e-14, "1")
        .claims(
            "cos θ at landing from a batch differs from the 256-bit reference by at most the limit, for phases up to \
             1e9 rad, near changes of the outcome and at the corners of the model.",
        ),
    Check::of_library("varying-cos-tilt", Tosses(|| of_varying(varied_cos_tilt_error), Largest)).up_to(1e-14, "1").claims(
        "cos θ at landing, from the kernel whose launches each have a gravity, drop and attitude of their own, differs from \
         the 256-bit reference by at most the limit, for phases up to 4e12 rad and landings up to the highest point. Of \
         launches that the kernel leaves out nothing is measured.",
    ),
    Check::of_library("varying-attitude", Tosses(|| of_varying(varied_attitude_error), Largest))
        .up_to(1e-14, "rad")
        .claims(
            "The attitude at landing, from the same kernel, differs from the 256-bit reference by at most the limit, for phases \
             up to 4e12 rad and landings up to the highest point. Of launches that the kernel leaves out nothing is measured.",
        ),
    Check::of_library("batch-attitude", Tosses(|| of_batches(batched_attitude_error), Largest))
        .up_to(1e-14, "rad")
        .claims(
            "The attitude at landing from a batch differs from the 256-bit reference by at most the limit, for phases \
             up to 1e9 rad, near changes of the outcome and at the corners of the model.",
        ),
    Check::of_library("batch-outcomes", Tosses(outcomes_of_batches, Count)).up_to(0.0, "tosses").claims(
        "The outcomes of a batch are those of the 256-bit reference, also within 3 ulp of the speed at which the \
         outcome changes. Measured: the number of tosses that differ; one is enough to fail.",
    ),
    Check::of_library("batch-paths", Tosses(simd_levels, Count)).up_to(0.0, "tosses").by(CrossMethod).claims(
        "Every SIMD level of the machine gives the same bits of cos θ, attitude and outcome as plain code. Measured: \
         the number of tosses with a difference; one is enough to fail.",
    ),
    Check::of_library("cos-tilt-terms", Tosses(terms, Largest)).up_to(1e-18, "1").claims(
        "The terms of cos θ of the exact motion have more digits than f64: at launch, where they add up to cos θ \
         without a sine or cosine of f64, their sum differs from the 256-bit reference by at most the limit.",
    ),
    Check::of_library("rigid-cos-tilt", Tosses(|| on_long_flights(cos_tilt_error), Largest))
        .up_to(1e-15, "1")
        .claims(
            "cos θ at landing of any rigid body differs from the 256-bit reference by at most the limit, for phases \
             from 1 to 1e9 rad.",
        ),
    Check::of_library("rigid-attitude", Tosses(|| on_long_flights(attitude_error), Largest))
        .up_to(1e-14, "rad")
        .claims(
            "The attitude at landing of any rigid body differs from the 256-bit reference by at most the limit, for \
             phases from 1 to 1e9 rad.",
        ),
    Check::of_library("rigid-outcomes", Tosses(at_edges, Count)).up_to(0.0, "tosses").claims(
        "The proven outcomes of any rigid body are those of the 256-bit reference within 3 ulp of a time at which the \
         outcome changes. Measured: the number of tosses that differ or are undecided; one is enough to fail.",
    ),
    Check::of_library("sensitivity", Tosses(derivatives, Largest)).up_to(1e-10, "1").claims(
        "The derivatives of attitude and cos θ at landing by relative changes of ω and of the time of flight differ \
         from central differences in 256 bits by at most the limit, relative to the norm of the attitude's derivative.",
    ),
];

fn outcomes() -> Vec<Set> {
    let differs = |toss: &Toss, reference: &Reference| Ok(f64::from(certify(toss)?.outcome() != reference.outcome()));
    vec![
        Set::of_tries("random", |tries| random(3 * tries, 6e4, 4), differs),
        Set::of_tries("adversarial", |tries| adversarial(tries, few_turns), differs),
    ]
}

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

type OfToss = fn(&Toss, &Reference) -> Deviation;

fn last_bits(error: OfToss) -> Vec<Set> {
    vec![
        Set::of_tries("phases to 1e2", |tries| random(tries, 1e2, 1), error),
        Set::of_tries("phases to 6e4", |tries| random(tries, 6e4, 2), error),
        Set::of_tries("phases to 1e9", |tries| random(tries, 1e9, 3), error),
        Set::of_tries("corners", |_| corners(), error),
    ]
}

/// Error of cos θ.
pub(super) fn cos_tilt_error(toss: &Toss, reference: &Reference) -> Deviation {
    Ok(reference.cos_tilt_error(ExactMotion::new(toss).cos_tilt(toss.launch.time_of_flight())?))
}

/// Angle to the exact attitude (rad).
pub(super) fn attitude_error(toss: &Toss, reference: &Reference) -> Deviation {
    Ok(reference.attitude_error(&ExactMotion::new(toss).state(toss.launch.time_of_flight())?.attitude))
}

/// Angle of the attitude of the Euler angles to the exact one, in ulp of 1 plus the largest angle.
fn euler_angles_error(toss: &Toss, reference: &Reference) -> Deviation {
    let angles = CoinMotion::new(&coin(toss)?).euler_angles(toss.launch.time_of_flight())?;
    let largest = angles.alpha.abs().max(angles.beta.abs()).max(angles.gamma.abs());
    Ok(reference.attitude_error(&angles.attitude()) / (f64::EPSILON * (1.0 + largest)))
}

/// Error of cos θ in the f64 stage, divided by the stage's error bound.
fn part_of_f64_bound(toss: &Toss, reference: &Reference) -> Deviation {
    let terms = TiltTerms::new(&coin(toss)?);
    let [phase, _] = terms.phases(toss.launch.flight_time());
    let error = reference.cos_tilt_error(terms.height(phase) / terms.size);
    Ok(error / f64_bound(phase))
}

/// Error of cos θ in the double-double stage, divided by the radius of its ball; 0 of a toss that has none.
fn part_of_double_double_bound(toss: &Toss, reference: &Reference) -> Deviation {
    let Some(ball) = cos_tilt_in_double_double(&coin(toss)?) else { return Ok(0.0) };
    Ok(reference.unrounded_cos_tilt_error(*ball.midpoint()) / ball.radius())
}

fn outcomes_of_batches() -> Vec<Set> {
    let differs = |toss: &Toss, reference: &Reference| Ok(f64::from(batched(toss, outcome)? != reference.outcome()));
    vec![
        Set::of_tries("random", |tries| level(random(tries, 6e4, 14)?), differs),
        Set::of_tries("adversarial", |tries| level(adversarial(tries / 2, few_turns)?), differs),
        Set::of_tries("adversarial, many turns", |tries| level(adversarial(tries / 4, many_turns)?), differs),
    ]
}

fn simd_levels() -> Vec<Set> {
    vec![
        Set::of_tries("random", |tries| level(random(2 * tries, 6e4, 15)?), levels_that_differ),
        Set::of_tries("adversarial", |tries| level(adversarial(tries, few_turns)?), levels_that_differ),
    ]
}

fn batched_cos_tilt_error(toss: &Toss, reference: &Reference) -> Deviation {
    Ok(reference.cos_tilt_error(batched(toss, cos_tilt)?))
}

fn batched_attitude_error(toss: &Toss, reference: &Reference) -> Deviation {
    Ok(reference.attitude_error(&batched(toss, attitude)?))
}

fn of_batches(error: OfToss) -> Vec<Set> {
    vec![
        Set::of_tries("phases to 1e2", |tries| level(random(tries, 1e2, 11)?), error),
        Set::of_tries("phases to 1e9", |tries| level(random(tries, 1e9, 13)?), error),
        Set::of_tries("adversarial", |tries| level(adversarial(tries / 2, few_turns)?), error),
        Set::of_tries("corners", |_| corners(), error),
    ]
}

fn of_varying(error: OfToss) -> Vec<Set> {
    vec![
        Set::of_tries("phases to 1e2", |tries| random(tries, 1e2, 11), error),
        Set::of_tries("phases to 1e9", |tries| random(tries, 1e9, 13), error),
        Set::of_tries("near the highest point", |tries| caught_high(random(tries, 4e12, 17)?), error),
    ]
}

/// The tosses, caught above the hand: below the highest point by all that they rise, down to 1e-6 of it.
fn caught_high(tosses: Vec<Toss>) -> anyhow::Result<Vec<Toss>> {
    let caught = |(index, toss): (usize, Toss)| {
        let (speed, gravity) = (1.0 + (index % 7) as f64, 9.81);
        let left = 10f64.powf(-0.0595 * (index % 101) as f64);
        let drop = -0.5 * speed * speed / gravity * (1.0 - left);
        let flight = TimeOfFlight::BallisticTo { speed, gravity, drop };
        Ok(Toss { launch: toss.launch.with_time_of_flight(flight)?, ..toss })
    };
    tosses.into_iter().enumerate().map(caught).collect()
}

/// The error of cos θ by the kernel of launches that vary in all; 0 of one that it leaves out.
fn varied_cos_tilt_error(toss: &Toss, reference: &Reference) -> Deviation {
    let mut found = [0.0];
    varied(toss, |tosses| tosses.cos_tilts(&mut found))?;
    Ok(if found[0].is_nan() { 0.0 } else { reference.cos_tilt_error(found[0]) })
}

/// The angle (rad) to the exact attitude, by the same kernel; 0 of one that it leaves out.
fn varied_attitude_error(toss: &Toss, reference: &Reference) -> Deviation {
    let mut found = [[0.0]; 4];
    varied(toss, |tosses| tosses.attitudes(found.each_mut().map(<[f64; 1]>::as_mut_slice)))?;
    let found = found.map(|[part]| part);
    if found[0].is_nan() {
        return Ok(0.0);
    }
    Ok(Attitude::from_components(found).map_or(f64::INFINITY, |attitude| reference.attitude_error(&attitude)))
}

/// Hands `toss` to `solve`, as launches that vary in all.
fn varied(toss: &Toss, solve: impl FnOnce(&Varying<'_>)) -> Result<(), SolveError> {
    let one = Column::All;
    let flights = match toss.launch.time_of_flight() {
        TimeOfFlight::Ballistic { speed, gravity } => Flights::Level(one(speed), one(gravity)),
        TimeOfFlight::BallisticTo { speed, gravity, drop } => Flights::Below(one(speed), one(gravity), one(drop)),
        time => Flights::Times(one(time.seconds())),
    };
    let attitudes = match toss.launch.tilt() {
        Some(tilt) => Attitudes::Tilts(one(tilt)),
        None => Attitudes::Quaternions(toss.launch.attitude().components().map(one)),
    };
    let rate = toss.launch.rate();
    let rates: [&[f64]; 3] = [&[rate.x], &[rate.y], &[rate.z]];
    solve(&Varying { coins: coin(toss)?.coin.into(), rates, flights, attitudes });
    Ok(())
}

/// The tosses as a batch can take them: it knows no landing at another height, only how long such a flight lasts.
fn level(tosses: Vec<Toss>) -> anyhow::Result<Vec<Toss>> {
    let level = |toss: Toss| {
        let flight = toss.launch.time_of_flight();
        let TimeOfFlight::BallisticTo { .. } = flight else { return Ok(toss) };
        Ok(Toss { launch: toss.launch.with_time_of_flight(TimeOfFlight::Given(flight.seconds()))?, ..toss })
    };
    tosses.into_iter().map(level).collect()
}

/// From a thousand to 10^9 turns, where the rounding of the phase is far above that of cos θ.
fn many_turns(index: usize) -> f64 {
    10f64.powi(3 + i32::try_from(index % 7).unwrap_or(0))
}

/// The number of SIMD levels that give other bits than plain code.
fn levels_that_differ(toss: &Toss, _: &Reference) -> Deviation {
    let bits = |batch: &Batch<'_>| -> Result<_, Error> {
        let turned: Attitude = attitude(batch)?;
        Ok((cos_tilt(batch)?.to_bits(), turned.components().map(f64::to_bits), outcome(batch)?))
    };
    let plain = batched(toss, |batch| bits(&batch.on(SimdLevel::all()[0])))?;
    let differs =
        |level: SimdLevel| batched(toss, |batch| bits(&batch.on(level))).map(|found| f64::from(found != plain));
    SimdLevel::all().into_iter().map(differs).sum()
}

fn batched<T>(toss: &Toss, kernel: impl Fn(&Batch<'_>) -> Result<T, Error>) -> Result<T, SolveError> {
    let rate = toss.launch.rate();
    // A batch takes speeds, not times: with a gravity of 2 m/s² the time 2 v0/g has the number of the speed.
    let (speed, gravity) = match toss.launch.time_of_flight() {
        TimeOfFlight::Ballistic { speed, gravity } => (speed, gravity),
        other => (other.seconds(), 2.0),
    };
    let rates: [&[f64]; 3] = [&[rate.x], &[rate.y], &[rate.z]];
    let attitude = toss.launch.attitude();
    let tosses = toss::Tosses::new(coin(toss)?.coin, attitude, gravity, rates, std::slice::from_ref(&speed))
        .expect("a valid toss");
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

fn terms() -> Vec<Set> {
    vec![
        Set::of_tries("phases to 1e2", |tries| random(tries / 4, 1e2, 9), terms_error),
        Set::of_tries("corners", |_| corners(), terms_error),
    ]
}

/// Error of cos θ at launch before it is rounded to f64. There the terms of cos θ add up to it without a sine or cosine
/// of f64, whose rounding hides theirs.
fn terms_error(toss: &Toss, _: &Reference) -> Deviation {
    let launch = toss.launch.with_time_of_flight(TimeOfFlight::Given(0.0)).expect("a valid time");
    let toss = CoinToss { launch, ..coin(toss)? };
    let (cos_tilt, _) = CoinMotion::new(&toss).cos_tilt_parts(0.0)?;
    Ok(reference::of_coin(&toss).unrounded_cos_tilt_error(cos_tilt))
}

fn on_long_flights(deviation: impl Fn(&Toss, &Reference) -> Deviation + Copy + Sync + 'static) -> Vec<Set> {
    Set::of_families(&FAMILIES, |family, context| launches(family, tries(context.effort) / 20, LONG), deviation)
}

fn at_edges() -> Vec<Set> {
    let tosses = |family: &'static Family, context: &Context| {
        launches(family, tries(context.effort) / 20, LONG).par_iter().filter_map(moved_to_an_edge).collect()
    };
    // A toss without a proof is undecided.
    Set::of_families(&FAMILIES, tosses, |toss, reference| {
        Ok(f64::from(!certify(toss).is_ok_and(|found| found.outcome() == reference.outcome())))
    })
}

/// [`at_an_edge`], looked for by the exact motion from where it is at the end of the flight: from there its phases are short.
pub(super) fn moved_to_an_edge(toss: &Toss) -> Option<Toss> {
    let landing = ExactMotion::new(toss).state(toss.launch.time_of_flight()).ok()?;
    let launch = Launch::new(landing.rate, TimeOfFlight::Given(0.0)).ok()?.with_attitude(landing.attitude);
    let (motion, start) = (ExactMotion::new(&Toss { launch, ..*toss }), toss.launch.flight_time());
    at_an_edge(toss, |time| motion.cos_tilt(TimeOfFlight::Given(time - start)).ok())
}

/// The same toss with a time within 3 ulp of one at which the outcome changes, near the time of the toss: found roughly by
/// `cos_tilt`, and moved to the edge by the reference. `None` if none is found.
pub(super) fn at_an_edge(toss: &Toss, cos_tilt: impl Fn(f64) -> Option<f64>) -> Option<Toss> {
    let until = |time: f64| {
        let launch = toss.launch.with_time_of_flight(TimeOfFlight::Given(time)).ok()?;
        Some(Toss { launch, ..*toss })
    };
    let near = edge_near(toss, cos_tilt)?;
    let edge = near + reference::of(&until(near)?).ok()?.time_to_an_edge();
    // By turns 3 ulp before and behind the edge.
    let ulps = (edge.to_bits() % 7) as i64 - 3;
    (edge > 0.0).then(|| until(f64::from_bits(edge.to_bits().wrapping_add_signed(ulps)))).flatten()
}

/// A time next to the first one from that of the toss at which `cos_tilt` has changed its sign; the reference's step from
/// there, of first order, ends within an ulp of the edge.
fn edge_near(toss: &Toss, cos_tilt: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let rate = toss.launch.turn_rate();
    let (step, start) = (1.0 / rate, toss.launch.flight_time());
    let sign = cos_tilt(start)?.signum();
    let along = |time: f64| cos_tilt(time).map(|cos_tilt| sign * cos_tilt);
    let end = (1..8).map(|at| start + f64::from(at) * step).find(|time| along(*time).is_some_and(|at| at <= 0.0))?;
    let (mut before, mut after) = (start.max(end - step), end);
    let [mut ahead, mut behind] = [along(before)?, along(after)?];
    if ahead <= 0.0 {
        return None;
    }
    // Its square is far below the angle of an ulp of the time.
    let near = 0.1 * (f64::EPSILON * rate * end).sqrt();
    // False position, halving the value of an end that stays (Illinois), and bisection where that does not leave the ends.
    while before.next_up() < after {
        let secant = before + (after - before) * (ahead / (ahead - behind));
        let inside = before < secant && secant < after;
        let time = if inside { secant } else { before + 0.5 * (after - before) };
        let found = along(time)?;
        if found.abs() < near {
            return Some(time);
        }
        if found > 0.0 {
            (before, ahead, behind) = (time, found, 0.5 * behind);
        } else {
            (after, behind, ahead) = (time, found, 0.5 * ahead);
        }
    }
    Some(after)
}

fn derivatives() -> Vec<Set> {
    const LAUNCHES: usize = 500;
    let set = |(part, name)| {
        let tosses =
            |context: &Context| Ok(context.survey.get(context)?.tosses.iter().take(LAUNCHES).copied().collect());
        Set::new(name, tosses, move |toss, _| Ok(errors_of_derivatives(&coin(toss)?)?[part])).of_coins()
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
        reference::of_coin(&CoinToss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss })
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
