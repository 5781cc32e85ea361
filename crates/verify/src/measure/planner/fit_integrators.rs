//! This file measures the errors and costs of integrators by bins of spin, phase and tolerance. The error of an
//! integrator depends on how far the coin turns and spins, so one number for each tolerance would be far too large
//! for most tosses.
//!
//! The phase (rad) is the angle by which a motion turns, the larger of precession (about the angular momentum) and spin
//! (about the coin's normal).

use rayon::prelude::*;
use toss::fitted::IntegratorFit;
use toss::{ExactMotion, Launch, Scheme, Settings, Solver, SolverEntry, Stepping, TimeOfFlight, Toss};

use super::clock::nanoseconds;
use super::figures::{SAFETY, SEED, rounded};
use super::scenes;
use crate::measure::reference::Reference;

/// Upper ends of the bins of spin divided by precession.
pub(super) const SPINS: [f64; 9] = [0.0, 0.03, 0.1, 0.2, 0.3, 0.4, 0.5, 0.7, f64::MAX];
/// Upper ends of the bins of phases (rad).
pub(super) const PHASES: [f64; 11] = [0.1, 0.3, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 100.0, 300.0, 1000.0];

/// The error that stands for an unknown one: above every accuracy, and small enough to be multiplied without overflow.
const UNKNOWN: f64 = 1e200;

/// A toss, its phase at landing (rad) and its exact landing.
pub(super) type Flight = (Toss, f64, Reference);

/// Random tosses for each bin of spins and, within it, for each bin of phases.
pub(super) fn tosses_by_turn() -> anyhow::Result<Vec<Vec<Vec<Flight>>>> {
    let mut bins: Vec<Vec<Vec<Flight>>> = Vec::new();
    let mut tosses = Vec::new();
    for index in 0..60_000 {
        let toss = scenes::toss(SEED, index)?.toss;
        let (precession, spin) = ExactMotion::new(&toss).phases(1.0)?;
        let (precession, spin) = (precession.hi(), spin.hi().abs());
        tosses.push((toss, precession.max(spin), if spin == 0.0 { 0.0 } else { spin / precession }));
    }
    let mut slowest = -1.0;
    for spin in SPINS {
        let like: Vec<_> = tosses.iter().filter(|(.., ratio)| slowest < *ratio && *ratio <= spin).collect();
        bins.push(PHASES.iter().enumerate().map(|(bin, _)| flights(bin, &like)).collect::<anyhow::Result<_>>()?);
        slowest = spin;
    }
    Ok(bins)
}

/// Flights for one bin of phases. Each takes one of `tosses`, which come with their phase in a second, and a time of
/// flight that puts its phase into the bin; the phases are spread evenly on a logarithmic scale up to the bin's end.
fn flights(bin: usize, tosses: &[&(Toss, f64, f64)]) -> anyhow::Result<Vec<Flight>> {
    let number = if PHASES[bin] > 100.0 { 96 } else { 640 };
    let [from, to] = [if bin == 0 { 0.01 } else { PHASES[bin - 1] }, PHASES[bin]];
    let flight = |index: usize| {
        let (toss, turn, _) = tosses[index % tosses.len()];
        #[expect(clippy::cast_precision_loss, reason = "a few hundred")]
        let phase = from * (to / from).powf((index + 1) as f64 / number as f64);
        let launch = Launch::new(toss.launch.rate(), TimeOfFlight::Given(phase / turn))?;
        let toss = Toss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss };
        Ok((toss, phase, Reference::new(&toss)))
    };
    (0..number).into_par_iter().map(flight).collect()
}

/// Measures one solver with one scheme at all `tolerances`, over all bins.
pub(super) fn integrator(
    entry: &SolverEntry,
    scheme: Scheme,
    tolerances: &[f64],
    bins: &[Vec<Vec<Flight>>],
) -> anyhow::Result<IntegratorFit> {
    let solvers = tolerances
        .iter()
        .map(|tolerance| {
            Ok(entry.solver(&Settings { stepping: Stepping::adaptive(scheme, *tolerance)?, ..Settings::default() })?)
        })
        .collect::<anyhow::Result<Vec<_>>>()?;
    let row = |flights: &Vec<Flight>| solvers.iter().map(|solver| cell(solver.as_ref(), flights)).collect();
    let cells: Vec<Vec<Vec<[f64; 3]>>> = bins.iter().map(|bins| bins.iter().map(row).collect()).collect();
    let part = |part: usize, row: &Vec<[f64; 3]>| row.iter().map(|cell| rounded(cell[part])).collect();
    let table = |which| cells.iter().map(|rows| rows.iter().map(|row| part(which, row)).collect()).collect();
    let [cost_ns, call_ns] = cost(solvers[6].as_ref(), [&bins[3][0], &bins[3][6]]);
    Ok(IntegratorFit {
        solver: entry.name().to_owned(),
        scheme: scheme.name().to_owned(),
        cost_ns,
        call_ns,
        tilt_errors: table(0),
        errors: table(1),
        calls: table(2),
    })
}

/// The largest errors of cos θ and of the attitude (rad) with a safety factor, and the mean of the calls divided by 1 +
/// phase. Refused flights are left out, because a user gets a typed error for them and not a wrong answer.
fn cell(solver: &dyn Solver, flights: &[Flight]) -> [f64; 3] {
    let flown: Vec<[f64; 3]> = flights
        .par_iter()
        .filter_map(|(toss, phase, reference)| {
            let landing = solver.propagate(toss).ok()?;
            #[expect(clippy::cast_precision_loss, reason = "at most some millions")]
            let calls = landing.work.rhs_calls as f64 / (1.0 + phase);
            let of_tilt = reference.cos_tilt_error(landing.cos_tilt);
            Some([of_tilt, reference.attitude_error(&landing.state.attitude), calls])
        })
        .collect();
    let largest = |part: usize| safely(flown.iter().map(|flight| flight[part].max(f64::EPSILON)).collect());
    #[expect(clippy::cast_precision_loss, reason = "a few hundred")]
    let mean = flown.iter().map(|flight| flight[2]).sum::<f64>() / flown.len().max(1) as f64;
    [largest(0), largest(1), mean]
}

/// The largest of `errors` times a safety factor. The factor grows with the ratio of the largest error to the one that
/// nine tenths stay below, because where errors scatter widely another toss may exceed the largest one.
fn safely(mut errors: Vec<f64>) -> f64 {
    errors.sort_unstable_by(f64::total_cmp);
    // Where every flight was refused nothing is known, and the planner must not choose this tolerance.
    let (Some(largest), Some(ninth)) = (errors.last(), errors.get(errors.len() * 9 / 10)) else { return UNKNOWN };
    1.5 * SAFETY * largest * (largest / ninth).sqrt().min(100.0)
}

/// The fixed cost of a flight and the cost of each call of the right-hand side (ns of one core), from the times of
/// short and long flights.
fn cost(solver: &dyn Solver, bins: [&[Flight]; 2]) -> [f64; 2] {
    let [short, long] = bins.map(|flights| {
        let flown = flights.iter().take(32).filter_map(|(toss, ..)| {
            let calls = solver.propagate(toss).ok()?.work.rhs_calls;
            #[expect(clippy::cast_precision_loss, reason = "at most some millions")]
            Some((calls as f64, nanoseconds(|| solver.propagate(toss))))
        });
        let (calls, costs): (Vec<f64>, Vec<f64>) = flown.unzip();
        (calls.iter().sum::<f64>(), costs.iter().sum::<f64>(), calls.len())
    });
    #[expect(clippy::cast_precision_loss, reason = "dozens")]
    let means = [short, long].map(|(calls, cost, number)| [calls, cost].map(|sum| sum / number.max(1) as f64));
    let call_ns = (means[1][1] - means[0][1]) / (means[1][0] - means[0][0]);
    [rounded((means[0][1] - means[0][0] * call_ns).max(0.0)), rounded(call_ns)]
}
