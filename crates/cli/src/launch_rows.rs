//! Reads launches from CSV, one a row, by the names in its heading. Every mistake is reported with its line and column,
//! since such files have many lines.

use std::io::Read;

use csv::StringRecord;
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use toss::{Body, Dimension, Error, InputError, Launch, TimeOfFlight, Toss};

use crate::commands::sample_rows::Given;
use crate::failure::Failure;

/// The columns that describe a launch: heading, field of an error, and kind of quantity.
const COLUMNS: [(&str, &str, Dimension); 8] = [
    ("wx", "rate x [rad/s]", Dimension::TurnRate),
    ("wy", "rate y [rad/s]", Dimension::TurnRate),
    ("wz", "rate z [rad/s]", Dimension::TurnRate),
    ("speed", "speed [m/s]", Dimension::Speed),
    ("time", "time [s]", Dimension::Time),
    ("gravity", "gravity [m/s²]", Dimension::Acceleration),
    ("drop", "drop [m]", Dimension::Length),
    ("tilt", "tilt [rad]", Dimension::Angle),
];

/// The columns of an answer, which may be there and are passed over, so that an output can be read again.
const ANSWERS: [&str; 4] = ["flight_time", "cos_tilt", "outcome", "certified"];

/// The launches of `body` in a text of CSV.
///
/// # Errors
/// [`Failure::Text`] for a heading that is unknown, missing or there twice. Each launch has its own errors.
pub(crate) fn read<R: Read>(text: R, body: Body) -> Result<impl Iterator<Item = Result<Given, Failure>>, Failure> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text);
    let headings = reader.headers().map_err(|error| unreadable(&error))?.clone();
    let places = places(&headings)?;
    let width = headings.len();
    Ok(reader.into_records().map(move |record| {
        let record = record.map_err(|error| unreadable(&error))?;
        let line = record.position().map_or(0, csv::Position::line);
        launch(&record, &places, body).map_err(|error| {
            let column = COLUMNS.iter().position(|(_, field, _)| *field == error.field()).and_then(|of| places[of]);
            at(line, column.unwrap_or(width - 1), error.to_string())
        })
    }))
}

/// The name of a column that may also be called as in spaces or as its option.
fn column_name(heading: &str) -> &str {
    match heading {
        "rate_x" | "rate-x" => "wx",
        "rate_y" | "rate-y" => "wy",
        "rate_z" | "rate-z" => "wz",
        other => other,
    }
}

/// The place of each of [`COLUMNS`] among the headings.
fn places(headings: &StringRecord) -> Result<[Option<usize>; 8], Failure> {
    let known = COLUMNS.map(|(name, ..)| name);
    let headings: Vec<&str> = headings.iter().map(column_name).collect();
    for (column, heading) in headings.iter().copied().enumerate() {
        if !known.contains(&heading) && !ANSWERS.contains(&heading) {
            return Err(at(1, column, format!("column '{heading}' is unknown; known: {}", known.join(", "))));
        }
        if headings.iter().take(column).any(|other| *other == heading) {
            return Err(at(1, column, format!("column '{heading}' is there twice")));
        }
    }
    let places = known.map(|name| headings.iter().position(|heading| *heading == name));
    let [x, y, z, speed, time, ..] = places;
    let missing = known.into_iter().zip([x, y, z]).find(|(_, place)| place.is_none()).map(|(name, _)| name);
    let missing = missing.or_else(|| speed.or(time).is_none().then_some("speed or time"));
    missing.map_or(Ok(places), |name| Err(at(1, headings.len(), format!("column {name} is missing"))))
}

/// The launch in a record.
fn launch(record: &StringRecord, places: &[Option<usize>; 8], body: Body) -> Result<Given, InputError> {
    let mut values = [None; 8];
    for (value, ((_, field, dimension), place)) in values.iter_mut().zip(COLUMNS.iter().zip(places)) {
        let cell = place.and_then(|place| record.get(place)).filter(|cell| !cell.is_empty());
        *value = cell.map(|cell| dimension.read(field, cell)).transpose()?;
    }
    let [x, y, z, speed, time, gravity, drop, tilt] = values;
    let missing = |field| InputError::Missing { field, expected: "a number" };
    let rate = [
        x.ok_or_else(|| missing("rate x [rad/s]"))?,
        y.ok_or_else(|| missing("rate y [rad/s]"))?,
        z.ok_or_else(|| missing("rate z [rad/s]"))?,
    ];
    let thrown = gravity.or(drop);
    let time_of_flight = match (speed, time) {
        (Some(speed), None) => TimeOfFlight::thrown(speed, gravity.unwrap_or(DEFAULT_GRAVITY), drop),
        (None, Some(time)) if thrown.is_none() => TimeOfFlight::Given(time),
        (None, None) => {
            return Err(InputError::Missing { field: "speed [m/s]", expected: "a speed, or a time of flight" });
        }
        _ => {
            let (value, expected) = ("given twice".to_owned(), "a time alone, without speed, gravity and drop");
            return Err(InputError::Malformed { field: "time [s]", value, expected });
        }
    };
    let launch = Launch::new(rate, time_of_flight)?.with_tilt(tilt.unwrap_or(0.0))?;
    let gravity = speed.map(|_| gravity.unwrap_or(DEFAULT_GRAVITY));
    Ok(Given { rate, speed, time, gravity, drop, tilt: tilt.unwrap_or(0.0), toss: Toss { body, launch } })
}

/// The error of a place in the text: a line from 1, and a column of the table from 0.
fn at(line: u64, column: usize, message: String) -> Failure {
    let line = usize::try_from(line).unwrap_or(usize::MAX);
    Failure::Text { path: "standard input".to_owned(), source: Error::Text { line, column: column + 1, message } }
}

/// The error of a text that is no table.
fn unreadable(error: &csv::Error) -> Failure {
    let line = error.position().map_or(1, csv::Position::line);
    let message = match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} cells, but the heading has {expected_len}")
        }
        _ => error.to_string(),
    };
    at(line, 0, message)
}
