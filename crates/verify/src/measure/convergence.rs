//! This file measures the error of each scheme over a range of fixed steps, and fits the order of convergence to it.
//! The order shows mistakes in coefficients and equations that a single error would hide.
//!
//! The error is that of the whole state: attitude, body rate, and the norm error of an integrated quaternion. The
//! attitude alone would make DOPRI5 look better than it is: on a turn its leading error changes the length of the
//! quaternion, which disappears when the quaternion is normalised.

use std::f64::consts::PI;
use std::ops::Range;

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;
use rayon::prelude::*;
use sampling::Coordinate::{Gravity, RateX, RateY, RateZ, Speed, Tilt};
use sampling::Space;
use serde::Serialize;
use toss::{
    Coin, CoinMotion, Formulation, InputError, Landing, Scheme, SolveError, Solver, SolverEntry, State, Stepping, Toss,
};

use crate::measure::reference::{self, Reference};
use crate::measure::subject::Subject;
use crate::measure::tosses::random_flights;

/// Number of flights whose errors are added up, so that a cancellation in a single flight does not look like a higher
/// order.
const FLIGHTS: usize = 12;

/// Time of flight (s).
const TIME: f64 = 2.0;

/// The errors of one subject over its steps, and the order fitted to them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Convergence {
    /// `solver/scheme`.
    pub subject: String,
    /// Order of the scheme by theory.
    pub order: u32,
    /// Order fitted to the errors in the asymptotic window; null if too few are in it.
    pub observed: Option<f64>,
    /// Number of halvings of the step within that window.
    pub halvings: f64,
    /// Steps (s) with their errors, from large to small.
    pub points: Vec<(f64, f64)>,
}

/// Measures every integrator of `registry` with each scheme that takes fixed steps and has an order.
pub(crate) fn convergence(registry: &[SolverEntry]) -> anyhow::Result<Vec<Convergence>> {
    let tosses = regular_flights()?;
    let flights = tosses.into_iter().map(|toss| Ok((toss, reference::of(&toss)?)));
    let flights: Vec<(Toss, Reference)> = flights.collect::<anyhow::Result<_>>()?;
    let integrators = registry.iter().filter(|entry| entry.integrates());
    let subjects: Vec<(&SolverEntry, Scheme, u32)> = integrators
        .flat_map(|entry| {
            let stepped = entry.schemes().iter().filter(|scheme| scheme.takes_steps());
            stepped.filter_map(move |scheme| Some((entry, *scheme, scheme.order()?)))
        })
        .collect();
    let all = subjects.into_par_iter().map(|(entry, scheme, order)| Convergence::new(entry, scheme, order, &flights));
    Ok(all.collect::<Result<_, _>>()?)
}

/// Flights on which the cone of the normal encloses the vertical and keeps a distance from it. There the vertical frame
/// is regular, and all three Euler angles vary.
fn regular_flights() -> anyhow::Result<Vec<Toss>> {
    const CLEARANCE: f64 = 0.8;
    // With this gravity and a speed of 1 m/s, 2 v0/g is TIME.
    let gravity = (2.0 / TIME).to_string();
    let axes = [(RateX, "-3:3"), (RateY, "-3:3"), (RateZ, "0:3"), (Speed, "1"), (Gravity, &gravity), (Tilt, "1.2:1.4")];
    let space = Space::parse(Coin::DISC, &axes)?;
    let mut tosses = Vec::new();
    for toss in random_flights(&space, 1, 10_000)?.iter().filter_map(Toss::coin) {
        let motion = CoinMotion::new(&toss);
        let (cone, axis) = (motion.cone_angle(), motion.momentum_tilt());
        if cone - axis > CLEARANCE && cone + axis < PI - CLEARANCE {
            tosses.push(toss.into());
        }
    }
    tosses.truncate(FLIGHTS);
    anyhow::ensure!(tosses.len() == FLIGHTS, "only {} regular flights", tosses.len());
    Ok(tosses)
}

/// The range of errors to which the order is fitted. Smaller errors are rounding; larger ones are not asymptotic yet.
/// For order 8 the range covers only about one halving of the step, because four halvings would need a factor of 2^32
/// in the error, more than f64 leaves between the two limits.
fn window(scheme: Scheme) -> Range<f64> {
    if scheme == Scheme::DOP853 { 3e-12..1e-9 } else { 3e-12..1e-5 }
}

impl Convergence {
    fn new(entry: &SolverEntry, scheme: Scheme, order: u32, flights: &[(Toss, Reference)]) -> Result<Self, InputError> {
        let offered = entry.formulations().contains(&Formulation::VERTICAL);
        let formulation = if offered { Formulation::VERTICAL } else { Formulation::default() };
        let mut points = Vec::new();
        for eighth_octave in 0..120 {
            let step = TIME / (2.0 * 2f64.powf(0.125 * f64::from(eighth_octave))).round();
            let subject = Subject::new(entry, Some(Stepping::fixed(scheme, step)?), formulation);
            // Long steps may fail, which is no fault; if too few succeed, the order stays undefined.
            let Ok(error) = error(subject.solver.as_ref(), flights) else { continue };
            if error < window(scheme).start {
                break;
            }
            points.push((step, error));
        }
        let asymptotic: Vec<(f64, f64)> = points.iter().copied().filter(|point| point.1 < window(scheme).end).collect();
        let halvings = asymptotic.first().zip(asymptotic.last()).map_or(0.0, |(first, last)| (first.0 / last.0).log2());
        Ok(Self {
            subject: format!("{}/{}", entry.name(), scheme.name()),
            order,
            observed: observed_order(&asymptotic),
            halvings,
            points,
        })
    }
}

/// The sum over `flights` of the errors of the whole state: attitude (rad), body rate (relative) and quaternion norm.
pub(crate) fn error(solver: &dyn Solver, flights: &[(Toss, Reference)]) -> Result<f64, SolveError> {
    let of_one = |(toss, reference): &(Toss, Reference)| -> Result<f64, SolveError> {
        let Landing { state: State { attitude, rate }, norm_error, .. } = solver.land(toss)?;
        Ok(reference.attitude_error(&attitude) + reference.rate_error(&rate) / rate.norm() + norm_error)
    };
    flights.iter().map(of_one).sum()
}

/// The order p from a least-squares fit of `ln C + p ln h + c h²` to the logarithms of the errors, where h is the step.
/// The last term accounts for the next order of the error. `None` for fewer than 6 points.
fn observed_order(points: &[(f64, f64)]) -> Option<f64> {
    if points.len() < 6 {
        return None;
    }
    let design = Mat::from_fn(points.len(), 3, |row, column| {
        let step = points[row].0;
        [1.0, step.ln(), step * step][column]
    });
    let values = Mat::from_fn(points.len(), 1, |row, _| points[row].1.ln());
    Some(design.qr().solve_lstsq(&values)[(1, 0)]).filter(|order| order.is_finite())
}
