//! Order of convergence: the error of each method falls with the power of the step that theory gives it.
//!
//! The error is that of the whole state: attitude, body rate and loss of norm. The attitude alone would flatter DOPRI5:
//! for a turn its leading error is one of length, which a normalised attitude does not see.

use std::f64::consts::PI;

use faer::Mat;
use faer::linalg::solvers::SolveLstsq;
use sampling::Coordinate::{Gravity, RateX, RateY, RateZ, Speed, Tilt};
use sampling::{Space, random_tosses};
use toss::{
    Coin, ExactMotion, Formulation, Method, Propagation, Scheme, Settings, SolveError, SolverEntry, State, Toss,
};

use crate::check::{Basis, Check, Context, Measurement};
use crate::reference::Reference;

pub(super) const ORDER: Check = Check {
    id: "convergence-order",
    claim: "the error falls with the power of a fixed step that theory gives the method (measured: distance from it)",
    basis: Basis::ClosedForm,
    unit: "1",
    measure,
};

/// Errors outside this window are not asymptotic, or drown in rounding.
const ASYMPTOTIC: std::ops::Range<f64> = 3e-12..1e-9;

/// Flights whose errors are added up, so that no cancellation in a single one passes for a higher order.
const FLIGHTS: usize = 12;

/// Time of flight (s).
const TIME: f64 = 2.0;

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let tosses = regular_flights()?;
    let references: Vec<Reference> = tosses.iter().map(Reference::new).collect();
    let mut measurements = Vec::new();
    for entry in context.registry.iter().filter(|entry| entry.integrates()) {
        for scheme in Scheme::ALL {
            let errors = errors_by_step(entry, scheme, &tosses, &references)?;
            let order = slope(&errors);
            let subject = format!("{}/{}", entry.name, scheme.name());
            let input = format!("observed order {order:.3} over {} steps of {FLIGHTS} flights", errors.len());
            let distance = (order - f64::from(scheme.order())).abs();
            measurements.push(Measurement::figure(ORDER.id, &subject, distance, errors.len() as u64, input));
        }
    }
    Ok(measurements)
}

/// Flights whose cone encloses the vertical at a distance, so that the vertical frame, where all three angles are at
/// work, is regular.
fn regular_flights() -> anyhow::Result<Vec<Toss>> {
    const CLEARANCE: f64 = 0.8;
    // Flights of TIME s.
    let gravity = (2.0 / TIME).to_string();
    let axes = [(RateX, "-3:3"), (RateY, "-3:3"), (RateZ, "0:3"), (Speed, "1"), (Gravity, &gravity), (Tilt, "1.2:1.4")];
    let space = Space::parse(Coin::DISC, &axes)?;
    let mut tosses = Vec::new();
    for toss in random_tosses(&space, 1, 0..10_000) {
        let motion = ExactMotion::new(&toss);
        let (cone, axis) = (motion.cone_angle(), motion.momentum_tilt());
        if cone - axis > CLEARANCE && cone + axis < PI - CLEARANCE {
            tosses.push(toss);
        }
    }
    tosses.truncate(FLIGHTS);
    anyhow::ensure!(tosses.len() == FLIGHTS, "only {} regular flights", tosses.len());
    Ok(tosses)
}

/// (ln step, ln error) in the asymptotic window, from large steps to small.
fn errors_by_step(
    entry: &SolverEntry,
    scheme: Scheme,
    tosses: &[Toss],
    references: &[Reference],
) -> anyhow::Result<Vec<(f64, f64)>> {
    let mut points = Vec::new();
    for eighth_octave in 0..120 {
        let step = TIME / (2.0 * 2f64.powf(0.125 * f64::from(eighth_octave))).round();
        let solver =
            (entry.build)(&Settings { method: Method::fixed(scheme, step)?, formulation: Formulation::Vertical });
        let error = |(toss, reference): (&Toss, &Reference)| -> Result<f64, SolveError> {
            let Propagation { state: State { attitude, rate }, defect, .. } = solver.propagate(toss)?;
            Ok(reference.attitude_error(&attitude) + reference.rate_error(&rate) / rate.norm() + defect)
        };
        // Steps of half a flight may well fail; too few that succeed make the slope undefined, and the check fail.
        let Ok(sum) = tosses.iter().zip(references).map(error).sum::<Result<f64, SolveError>>() else { continue };
        if sum < ASYMPTOTIC.start {
            break;
        }
        if sum < ASYMPTOTIC.end {
            points.push((step.ln(), sum.ln()));
        }
    }
    Ok(points)
}

/// Slope of the least-squares line.
fn slope(points: &[(f64, f64)]) -> f64 {
    if points.len() < 4 {
        return f64::NAN;
    }
    let design = Mat::from_fn(points.len(), 2, |row, column| if column == 0 { 1.0 } else { points[row].0 });
    let values = Mat::from_fn(points.len(), 1, |row, _| points[row].1);
    design.qr().solve_lstsq(&values)[(1, 0)]
}
