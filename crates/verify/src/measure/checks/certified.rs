//! These checks compare the exact motion (the closed form in double-double arithmetic) and the outcomes that it proves
//! with the 256-bit reference. Its last bits and its proofs depend on rounding, so the launches include those where
//! rounding is hardest: large phases, corners of the model, and tosses that land within a few ulp of a change of the
//! outcome.
//!
//! An ulp is the distance from an f64 to the next; the phase (rad) is the angle by which a motion turns, and ψ the cone
//! angle between the coin's normal n and its angular momentum S.

use std::f64::consts::{FRAC_PI_2, PI};

use exact::TiltTerms;
use exact::certified::{double_double_bound, f64_bound};
use rayon::prelude::*;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
use sampling::Space;
use toss::{Coin, ExactMotion, Launch, SolveError, Stage, TimeOfFlight, Toss, Vector3, certify};

use crate::measure::case::Case;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::measurement::{Deviation, Measurement};
use crate::measure::random_flights::random_flights;
use crate::measure::reference::Reference;
use crate::measure::throws::throw;

pub(super) const COS_TILT: Check = Check {
    id: "last-bit-cos-tilt",
    claim: "cos θ at landing from the exact motion differs from the 256-bit reference by at most the bound, about an \
            ulp of 1, for phases up to 1e9 rad and at the corners of the model.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-15,
    unit: "1",
    measure: |context| last_bit(context, cos_tilt_error),
};

pub(super) const ATTITUDE: Check = Check {
    id: "last-bit-attitude",
    claim: "The attitude at landing from the exact motion differs from the 256-bit reference by at most the bound, a \
            few ulp, for phases up to 1e9 rad and at the corners of the model.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-14,
    unit: "rad",
    measure: |context| last_bit(context, attitude_error),
};

pub(super) const EULER_ANGLES: Check = Check {
    id: "last-bit-euler-angles",
    claim: "The attitude that the exact motion's Euler angles at landing give differs from the 256-bit reference by \
            at most the bound, in ulp of 1 plus the largest angle.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 10.0,
    unit: "ulp",
    measure: |context| last_bit(context, euler_angles_error),
};

pub(super) const OUTCOMES: Check = Check {
    id: "certified-outcomes",
    claim: "Certified outcomes are those of the 256-bit reference, also within 3 ulp of the speed at which the \
            outcome changes. Measured: the number of tosses that differ, also by being undecided; one is enough to \
            fail.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 0.0,
    unit: "tosses",
    measure: outcomes,
};

pub(super) const BOUNDS: Check = Check {
    id: "certified-bounds",
    claim: "The error of cos θ in the proof stages f64 and double-double is within the error bound by which the stage \
            proves an outcome. Measured: the largest error divided by that error bound; it fails above the bound of \
            this check.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1.0,
    unit: "1",
    measure: bounds,
};

/// Error of cos θ.
pub(super) fn cos_tilt_error(toss: &Toss, reference: &Reference) -> Deviation {
    Ok(reference.cos_tilt_error(ExactMotion::new(toss).cos_tilt(toss.launch.time_of_flight())?))
}

/// Angle to the exact attitude (rad).
pub(super) fn attitude_error(toss: &Toss, reference: &Reference) -> Deviation {
    Ok(reference.attitude_error(&ExactMotion::new(toss).state(toss.launch.time_of_flight())?.attitude))
}

/// Angle of the attitude of the Euler angles to the exact one, in ulp of 1 plus the largest angle.
pub(super) fn euler_angles_error(toss: &Toss, reference: &Reference) -> Deviation {
    let angles = ExactMotion::new(toss).euler_angles(toss.launch.time_of_flight())?;
    let largest = angles.alpha.abs().max(angles.beta.abs()).max(angles.gamma.abs());
    Ok(reference.attitude_error(&angles.attitude()) / (f64::EPSILON * (1.0 + largest)))
}

/// 1 if the proven outcome is another one than that of `reference`, else 0.
pub(super) fn outcome_differs(toss: &Toss, reference: &Reference) -> Deviation {
    Ok(f64::from(certify(toss)?.outcome() != reference.outcome()))
}

/// The number of tosses from which a check derives the sizes of its sets.
pub(super) fn tries(context: &Context) -> u64 {
    match context.effort {
        Effort::Quick => 1000,
        Effort::Standard => 8000,
        Effort::Deep => 350_000,
    }
}

/// `number` random tosses, of five coins in turn, every second one tilted, and [thrown in every form](throw), whose
/// rates and times of up to 1 s give phases of up to about `phase` (rad).
pub(super) fn random(number: u64, phase: f64, seed: u64) -> anyhow::Result<Vec<Case>> {
    let fastest = format!("{0:?}:{1:?}", -phase / 2.0, phase / 2.0);
    let axes = [(RateX, &*fastest), (RateY, &fastest), (RateZ, &fastest), (Speed, "0:4.905"), (Tilt, "-3.2:3.2")];
    let space = Space::parse(Coin::PAPER, &axes)?;
    let coins = [0.5, 1.0, 1.98, 2.0, 0.0].map(|k| Coin::from_moments(5e-7, k * 5e-7));
    let case = |(index, toss): (usize, Toss)| {
        let tilt = if index % 2 == 0 { 0.0 } else { 2.0 * toss.launch.attitude().components()[1].asin() };
        let flight = throw(toss.launch.time_of_flight(), index as u64);
        let launch = Launch::new(toss.launch.rate(), flight)?.with_tilt(tilt)?;
        Ok(Case { toss: Toss { coin: coins[index / 5 % 5].clone()?, launch }, tilt })
    };
    random_flights(&space, seed, number)?.into_iter().enumerate().map(case).collect()
}

/// Tosses at the corners of the model: pure spin, no spin, spheres, rods, discs, slow and subnormal rates, each
/// combined with several tilts and with short and long times.
pub(super) fn corners() -> anyhow::Result<Vec<Case>> {
    let rates = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 7.0],
        [3.0, -4.0, 0.0],
        [1.0, 1.0, 2.5],
        [20.0, 0.0, 10.0],
        [1e-9, 0.0, 60.0],
        [5e-324, 0.0, 5e-324],
        [1e-160, 1e-170, 1.0],
        [1e5, -2e5, 3e5],
    ];
    let tilts = [0.0, 1e-300, 1e-16, 1e-8, 0.5, FRAC_PI_2, 2.0, PI, -1.0];
    let times = [0.0, 1e-300, 1e-3, 0.7, 1000.0];
    let mut cases = Vec::new();
    for k in [0.0, 1e-300, 0.5, 1.0, 2.0] {
        for rate in rates {
            for tilt in tilts {
                for time in times {
                    let launch = Launch::new(rate, TimeOfFlight::Given(time))?.with_tilt(tilt)?;
                    cases.push(Case { toss: Toss { coin: Coin::from_moments(1.0, k)?, launch }, tilt });
                }
            }
        }
    }
    Ok(cases)
}

/// Tosses that land within 3 ulp of the speed at which the outcome changes. Of each three, one is a random launch, one
/// is horizontal with ψ within 3 ulp of 45°, where cos θ touches 0 at half a turn, and one is tilted so that n only
/// touches the horizontal plane. `turns` says how many turns the phase of each has before the change.
pub(super) fn adversarial(number: u64, turns: fn(usize) -> f64) -> anyhow::Result<Vec<Case>> {
    const GRAVITIES: [f64; 4] = [9.81, 1.62, 9.80665, 24.79];
    let mut cases = Vec::new();
    for (index, case) in random(number, 100.0, 77)?.into_iter().enumerate() {
        let rate = case.toss.launch.rate();
        let (rate, tilt) = match index % 3 {
            // ψ = 45° where Ω = k ωz, with Ω = √(ωx² + ωy²).
            1 => (
                Vector3::new(rate.x, rate.y, ulps(rate.x.hypot(rate.y) / case.toss.coin.inertia_ratio(), index / 3)),
                0.0,
            ),
            2 => (rate, grazing_tilt(&case.toss, index / 3)),
            _ => (rate, case.tilt),
        };
        if !(rate.z.is_finite() && rate.z.abs() < 1e6) {
            continue;
        }
        let toss = |time| -> anyhow::Result<Toss> {
            Ok(Toss { launch: Launch::new(rate, time)?.with_tilt(tilt)?, ..case.toss })
        };
        let motion = ExactMotion::new(&toss(TimeOfFlight::Given(0.0))?);
        let heads = motion.heads();
        // Where cos θ never changes its sign the two edges coincide at its trough, where it comes nearest to 0.
        let before = std::f64::consts::TAU * turns(index);
        for edge in [heads.crest + heads.half_width, heads.crest - heads.half_width] {
            let phase = edge.rem_euclid(std::f64::consts::TAU) + before;
            let (time, gravity) = (phase / motion.precession_rate(), GRAVITIES[index % GRAVITIES.len()]);
            let speed = ulps(0.5 * gravity * time, index);
            if speed.is_finite() && speed >= 0.0 {
                cases.push(Case { toss: toss(caught(speed, gravity, time, index))?, tilt });
            }
        }
    }
    Ok(cases)
}

/// A throw that lasts about `time` (s): three of five at `speed`, one at half and caught below, one at 1.5 times and above.
fn caught(speed: f64, gravity: f64, time: f64, turn: usize) -> TimeOfFlight {
    let part = [1.0, 1.0, 1.0, 0.5, 1.5][turn % 5];
    let drop = (part != 1.0).then_some((1.0 - part) * 0.5 * gravity * time * time);
    TimeOfFlight::thrown(part * speed, gravity, drop)
}

/// Up to six turns, in turn.
pub(super) fn few_turns(index: usize) -> f64 {
    (index % 7) as f64
}

/// A number within 3 ulp of `value`; which of the seven is chosen by `turn` modulo 7.
fn ulps(value: f64, turn: usize) -> f64 {
    let offset = i64::try_from(turn % 7).unwrap_or(0) - 3;
    f64::from_bits(value.to_bits().wrapping_add_signed(offset))
}

/// A tilt within 3 ulp of the one for which φ + ψ = 90°, where φ is the angle of S to the vertical: there cos θ only
/// touches 0.
fn grazing_tilt(toss: &Toss, turn: usize) -> f64 {
    // A turn by β about the laboratory's x axis gives S the height sin β Sy + cos β Sz. For φ + ψ = 90° this must be
    // |S| cos φ = |S| sin ψ = I1 Ω, with Ω = √(ωx² + ωy²). No tilt reaches it if Sy and Sz are too small.
    let rate = toss.launch.rate();
    let spin = toss.coin.inertia_ratio() * rate.z;
    let reach = rate.y.hypot(spin);
    let height = rate.x.hypot(rate.y) / reach;
    if height > 1.0 { 0.3 } else { ulps(rate.y.atan2(spin) + height.acos(), turn) }
}

fn last_bit(
    context: &Context,
    error: fn(&Toss, &Reference) -> Result<f64, SolveError>,
) -> anyhow::Result<Vec<Measurement>> {
    let sets = [
        ("phases to 1e2", random(tries(context), 1e2, 1)?),
        ("phases to 6e4", random(tries(context), 6e4, 2)?),
        ("phases to 1e9", random(tries(context), 1e9, 3)?),
        ("corners", corners()?),
    ];
    Ok(largest_errors(&sets, error))
}

/// The largest error in each set, against the 256-bit reference.
pub(super) fn largest_errors(
    sets: &[(&str, Vec<Case>)],
    error: fn(&Toss, &Reference) -> Result<f64, SolveError>,
) -> Vec<Measurement> {
    let measure = |(name, cases): &(&str, Vec<Case>)| {
        let one = |case: &Case| (*case, error(&case.toss, &Reference::new(&case.toss)));
        let solved = cases.par_iter().map(one).filter(|(_, error)| is_in_range(error));
        let (cases, errors): (Vec<Case>, Vec<Deviation>) = solved.unzip();
        Measurement::of_set(name, &errors, |index| cases[index])
    };
    sets.iter().map(measure).collect()
}

/// Whether the toss was solved: phases above 2^53 rad are refused, which the check `atlas-answers` tests (F6).
fn is_in_range(result: &Deviation) -> bool {
    !matches!(result, Err(SolveError::PhaseTooLarge { .. }))
}

fn outcomes(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let sets =
        [("random", random(3 * tries(context), 6e4, 4)?), ("adversarial", adversarial(tries(context), few_turns)?)];
    sets.into_iter()
        .map(|(name, cases)| {
            let judged: Vec<_> = cases
                .par_iter()
                .map(|case| certify(&case.toss).map(|found| (found, Reference::new(&case.toss).outcome())))
                .collect();
            let stages = Stage::ALL.map(|stage| {
                judged.iter().filter(|found| found.as_ref().is_ok_and(|(found, _)| found.stage() == stage)).count()
            });
            let differs = judged.into_iter().map(|judged| judged.map(|(found, right)| found.outcome() != right));
            let mut counted = Measurement::count_of_set(name, &differs.collect::<Vec<_>>(), |index| cases[index]);
            if let Some(worst) = &mut counted.worst {
                worst.input = format!(
                    "decided by Keller's cosine, without the motion, by f64, double-double, more digits: \
                     {stages:?}; {}",
                    worst.input
                );
            }
            Ok(counted)
        })
        .collect()
}

fn bounds(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let mut cases = Vec::new();
    for (seed, phase) in [(5, 1.0), (6, 1e2), (7, 6e4), (8, 1e9)] {
        cases.extend(random(tries(context) / 4, phase, seed)?);
    }
    cases.extend(adversarial(tries(context) / 4, few_turns)?);
    let largest = |name: &str, ratio: fn(&Toss, &Reference) -> Deviation| {
        let ratios: Vec<_> = cases.par_iter().map(|case| ratio(&case.toss, &Reference::new(&case.toss))).collect();
        Measurement::of_set(name, &ratios, |index| cases[index])
    };
    Ok(vec![largest("f64", of_f64), largest("double-double", of_double_double)])
}

/// Error of cos θ in the f64 stage, divided by the stage's error bound.
pub(super) fn of_f64(toss: &Toss, reference: &Reference) -> Deviation {
    let terms = TiltTerms::new(toss);
    let [phase, _] = terms.phases(toss.launch.flight_time());
    let error = reference.cos_tilt_error(terms.height(phase) / terms.size);
    Ok(error / f64_bound(phase))
}

/// Error of cos θ in the double-double stage, divided by the stage's error bound.
pub(super) fn of_double_double(toss: &Toss, reference: &Reference) -> Deviation {
    let (cos_tilt, phase) = ExactMotion::new(toss).cos_tilt_parts(toss.launch.time_of_flight())?;
    Ok(reference.cos_tilt_error(cos_tilt.hi()) / double_double_bound(phase))
}
