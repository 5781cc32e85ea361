//! Error and drift against the time of flight.

use chart::{Axis, ChartError, Series, legend, log_log, svg};

use crate::long_flights::{Drift, LongFlights};
use crate::report::charts::line;

const LEGEND: u32 = 170;

/// What is drawn of each flight.
type Quantity = fn(&Drift) -> f64;

/// Title, label of the axis and quantity, by panel.
const PANELS: [(&str, &str, Quantity); 4] = [
    ("attitude", "error [rad]", |drift| drift.err_attitude),
    ("S in the transport frame", "relative drift", |drift| drift.momentum_vector),
    ("kinetic energy", "relative drift", |drift| drift.energy),
    ("norm of the quaternion", "defect", |drift| drift.defect),
];

/// The chart as SVG.
pub(super) fn long_flights(flights: &LongFlights) -> Result<String, ChartError> {
    let height = 1160 + LEGEND;
    let x = Axis::positive("time of flight [s]", 1.0..1e4);
    svg((2000, height), |root| {
        let (body, foot) = root.split_vertically(height - LEGEND);
        for ((title, label, quantity), panel) in PANELS.into_iter().zip(body.split_evenly((2, 2))) {
            let y = Axis::positive(label, 1e-17..1e-3);
            log_log(&panel, title, (&x, &y), &lines(flights, quantity), 40)?;
        }
        legend(&foot, &lines(flights, PANELS[0].2), 4, 480)
    })
}

/// What is exactly 0 is not drawn.
fn lines(flights: &LongFlights, quantity: Quantity) -> Vec<Series> {
    let of_subject = |subject: &str| {
        let (mut points, mut failures) = (Vec::new(), Vec::new());
        for (time, found) in flights.of(subject) {
            match found {
                Ok(drift) if quantity(drift) > 0.0 => points.push((time, quantity(drift))),
                Ok(_) => {}
                Err(_) => failures.push(time),
            }
        }
        line(subject, subject.to_owned(), points, failures)
    };
    flights.subjects().map(of_subject).collect()
}
