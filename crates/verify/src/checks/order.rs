//! Order of convergence: the error of each method falls with the power of the step that theory gives it.

use faer::linalg::solvers::SolveLstsq;
use toss::{Coin, Frame, Launch, Method, Scheme, Settings, SolverEntry, TimeOfFlight, Toss, Vector3};

use crate::check::{Basis, Case, Check, Context, Measurement};
use crate::reference::Reference;

pub(super) const ORDER: Check = Check {
    id: "convergence-order",
    claim: "the error falls with the power of a fixed step that theory gives the method (measured: distance from it)",
    basis: Basis::ClosedForm,
    unit: "1",
    measure,
};

/// Errors outside this window are not asymptotic, or drown in rounding.
const ASYMPTOTIC: std::ops::Range<f64> = 3e-12..1e-3;

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let case = tilted_flight()?;
    let mut measurements = Vec::new();
    for entry in context.registry.iter().filter(|entry| entry.integrates) {
        for scheme in Scheme::ALL {
            let errors = errors_by_step(entry, scheme, &case)?;
            let order = slope(&errors);
            let subject = format!("{}/{}", entry.name, scheme.name());
            let input = format!("{}; observed order {order:.3} over {} steps", case.hex(), errors.len());
            let distance = (order - f64::from(scheme.order())).abs();
            measurements.push(Measurement::figure(ORDER.id, &subject, distance, errors.len() as u64, input));
        }
    }
    Ok(measurements)
}

/// A tilted flight whose cone encloses the vertical at a distance, so that the vertical frame, where all three angles
/// are at work, is regular.
fn tilted_flight() -> anyhow::Result<Case> {
    let tilt = 0.7;
    let launch = Launch::new(Vector3::new(2.0, 5.0, 1.5), TimeOfFlight::Given(1.0))?.with_tilt(tilt)?;
    Ok(Case { toss: Toss { coin: Coin::PAPER, launch }, tilt })
}

/// (ln step, ln error) in the asymptotic window.
fn errors_by_step(entry: &SolverEntry, scheme: Scheme, case: &Case) -> anyhow::Result<Vec<(f64, f64)>> {
    let reference = Reference::new(&case.toss);
    let mut points = Vec::new();
    for quarter_octave in 0..60 {
        let step = 0.5 * 2f64.powf(-0.25 * f64::from(quarter_octave));
        let method = Method::fixed(scheme, case.toss.launch.flight_time() / (1.0 / step).round())?;
        let solver = (entry.build)(&Settings { method, frame: Frame::Vertical });
        // Steps of half a flight may well fail; too few that succeed make the slope undefined, and the check fail.
        if let Ok(landing) = solver.propagate(&case.toss) {
            let error = reference.attitude_error(&landing.state.attitude);
            if ASYMPTOTIC.contains(&error) {
                points.push(((1.0 / step).round().recip().ln(), error.ln()));
            }
        }
    }
    Ok(points)
}

/// Slope of the least-squares line.
fn slope(points: &[(f64, f64)]) -> f64 {
    if points.len() < 4 {
        return f64::NAN;
    }
    let design = faer::Mat::from_fn(points.len(), 2, |row, column| if column == 0 { 1.0 } else { points[row].0 });
    let values = faer::Mat::from_fn(points.len(), 1, |row, _| points[row].1);
    design.qr().solve_lstsq(&values)[(1, 0)]
}
