//! Quantities with units, as they are typed on the command line: a line each for rate, speed or time, gravity, tilt, drop
//! and cylinder.

use dynamics::Dimension;
use serde_json::Value;

use crate::program::{Ran, assert_finite, name_by_sign, run};

/// The options that the lines are given to.
const OPTIONS: [&str; 6] = ["--rate", "--speed", "--gravity", "--tilt", "--drop", "--cylinder"];

/// A quantity reads back as itself from its number and unit, and is converted without an error of more than an ulp. A toss
/// of them is refused with the name of the field, or lands as the sign of its cos θ says.
///
/// # Panics
/// If this does not hold for `data`.
pub fn check(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let lines: Vec<&str> = text.lines().collect();
    for line in &lines {
        Dimension::ALL.into_iter().for_each(|dimension| check_quantity(dimension, line));
    }
    let given: Vec<String> = OPTIONS
        .iter()
        .zip(&lines)
        .filter(|(_, line)| !line.is_empty())
        .map(|(of, line)| format!("{of}={line}"))
        .collect();
    let mut arguments = vec!["toss", "--format", "json"];
    arguments.extend(given.iter().map(String::as_str));
    check_toss(&run(&arguments, &[]));
}

fn check_quantity(dimension: Dimension, text: &str) {
    let Ok(given) = dimension.given("field", text).map_err(|error| crate::assert_said(&error)) else { return };
    let value = given.value();
    let again = dimension.given("field", &given.to_string()).expect("a number and a unit");
    let is_same = again.value().to_bits() == value.to_bits() || again.value().is_nan() && value.is_nan();
    assert!(is_same && again.unit() == given.unit(), "{text}: {again:?}, not {given:?}");
    let si = given.si();
    assert_eq!(si.is_nan(), value.is_nan(), "{text}: {si}");
    let product = value * given.unit().to_si(1.0);
    if product.is_normal() {
        assert!((si - product).abs() <= 2.0 * f64::EPSILON * product.abs(), "{text}: {si}, not {product}");
    }
    if given.unit() == dimension.units()[0] {
        assert!(given.is_exact_in_si() && (si == value || value.is_nan()), "{text}: {si}");
    }
}

fn check_toss(ran: &Ran) {
    let answer: Value = serde_json::from_str(&ran.out).unwrap_or_else(|error| panic!("{}: {error}", ran.out));
    assert_finite(&answer);
    if ran.code != 0 {
        assert!(answer["error"]["kind"].is_string(), "{}", ran.out);
        return;
    }
    let cos_tilt = answer["cos_tilt"].as_f64().expect("a number");
    assert_eq!(answer["outcome"].as_str(), Some(name_by_sign(cos_tilt)), "{}", ran.out);
    assert!(answer["flight_time"].as_f64().is_some_and(|time| time >= 0.0), "{}", ran.out);
}
