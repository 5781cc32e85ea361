//! Draws error and drift against the time of flight, so that one sees how both grow.

use chart::{Axis, ChartError, Series, log_log, svg};

use super::palette::Palette;
use super::{legend, legend_height};
use crate::measure::long_flights::{Drift, LongFlights};

/// The number that is drawn of each flight.
type Quantity = fn(&Drift) -> f64;

/// Title, label of the axis and quantity, by panel.
const PANELS: [(&str, &str, Quantity); 4] = [
    ("Attitude", "error [rad]", |drift| drift.err_attitude),
    ("S in the transport frame", "relative drift", |drift| drift.momentum_vector),
    ("Kinetic energy", "relative drift", |drift| drift.energy),
    ("Norm of the quaternion", "norm error", |drift| drift.norm_error),
];

/// The chart as SVG.
pub(super) fn long_flights(flights: &LongFlights, palette: &Palette<'_>) -> Result<String, ChartError> {
    let foot = legend_height(flights.subjects().count());
    let height = 1160 + foot;
    let x = Axis::logarithmic("time of flight [s]", 1.0..1e4);
    svg((2000, height), |root| {
        let (body, foot) = root.split_vertically(height - foot);
        for ((title, label, quantity), panel) in PANELS.into_iter().zip(body.split_evenly((2, 2))) {
            let y = Axis::logarithmic(label, 1e-17..1e-3);
            log_log(&panel, title, (&x, &y), &lines(flights, quantity, palette), 40)?;
        }
        legend(&foot, &lines(flights, PANELS[0].2, palette))
    })
}

/// The lines of a panel. A value of exactly 0 is not drawn, because the axis is logarithmic.
fn lines(flights: &LongFlights, quantity: Quantity, palette: &Palette<'_>) -> Vec<Series> {
    let of_subject = |subject: &str| {
        let (mut points, mut failures) = (Vec::new(), Vec::new());
        for (time, found) in flights.of(subject) {
            match found {
                Ok(drift) if quantity(drift) > 0.0 => points.push((time, quantity(drift))),
                Ok(_) => {}
                Err(_) => failures.push(time),
            }
        }
        palette.line(subject, subject.to_owned(), points, failures)
    };
    flights.subjects().map(of_subject).collect()
}
