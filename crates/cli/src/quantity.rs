//! Readers of options that are numbers: quantities, counts, fractions and tolerances, one reader for each kind, so that all
//! options have one grammar. What a text may be is decided in [`dynamics::quantity`], for the axes of spaces too.
//!
//! A reader says what is valid; clap puts the option and the value before it.

use std::ops::RangeInclusive;

use dynamics::Dimension;
use dynamics::quantity::{Given, look_alike, read_count, read_fraction, read_quantities};
use toss::InputError;

/// What is expected of three rates.
const RATES: &str = "WX,WY,WZ [rad/s], or each with a unit: rad/s, deg/s, °/s, rev/s or rpm";

/// What is expected of a cylinder.
const CYLINDER: &str = "MASS,RADIUS,THICKNESS [kg, m, m], or each with a unit: kg, g or mg, and m, cm, mm, in or ft";

/// What is expected of moments of inertia.
const MOMENTS: &str = "I1,I3 or I1,I2,I3 [kg m²], or each with a unit: kg·m², g·cm² or g·mm²";

/// What is expected of an inertia tensor.
const INERTIA: &str = "JXX,JYY,JZZ,JXY,JXZ,JYZ [kg m²], or each with a unit: kg·m², g·cm² or g·mm²";

/// A reader of an option that is a quantity of this kind, in the SI unit.
pub(crate) fn of(dimension: Dimension) -> impl Fn(&str) -> Result<f64, String> + Clone + Send + Sync + 'static {
    move |text| dimension.read("", text).map_err(|_| expected(text, dimension.expected()))
}

/// As [`of`], but in the unit that was given, so that nothing is rounded.
pub(crate) fn given(dimension: Dimension) -> impl Fn(&str) -> Result<Given, String> + Clone + Send + Sync + 'static {
    move |text| dimension.given("", text).map_err(|_| expected(text, dimension.expected()))
}

/// A reader of a whole number in a range, such as `1000` or `1e6`.
pub(crate) fn count<T: TryFrom<u64>>(
    range: RangeInclusive<u64>,
) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static {
    move |text| {
        let valid = || {
            let (least, most) = (range.start(), range.end());
            let to = if *most == u64::MAX { " to 2^64 - 1".to_owned() } else { format!(" to {most}") };
            expected(text, &format!("a whole number from {least}{to}, such as 1000 or 1e3"))
        };
        let number = read_count(text).filter(|number| range.contains(number));
        number.and_then(|number| T::try_from(number).ok()).ok_or_else(valid)
    }
}

/// A reader of a seed.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    count(0..=u64::MAX)(text)
}

/// A reader of a probability or another part of a whole, such as `0.95` or `95%`.
pub(crate) fn fraction(text: &str) -> Result<f64, String> {
    read_fraction(text).ok_or_else(|| expected(text, "a part of a whole, such as 0.95 or 95%"))
}

/// A reader of an accuracy or a tolerance.
pub(crate) fn tolerance(text: &str) -> Result<f64, String> {
    text.trim().parse().map_err(|_| expected(text, "a number > 0, such as 1e-9"))
}

/// What is wrong with a text that is not what was `expected`.
fn expected(text: &str, expected: &str) -> String {
    let look_alike = look_alike(text)
        .map(|(found, meant)| format!("'{found}' (U+{:04X}) only looks like '{meant}'; ", u32::from(found)));
    format!("{}expected {expected}", look_alike.unwrap_or_default())
}

/// An option that is a list of quantities, in SI units; `None` for any other option.
pub(crate) fn list(option: &str, text: &str) -> Option<Result<Vec<f64>, InputError>> {
    let list = match option {
        "rate" => rates(text).map(Vec::from),
        "cylinder" => cylinder(text).map(Vec::from),
        "moments" => moments(text),
        "inertia" => inertia(text).map(Vec::from),
        _ => return None,
    };
    Some(list.map(|numbers| numbers.into_iter().map(Given::si).collect()))
}

/// Three rates.
pub(crate) fn rates(text: &str) -> Result<[Given; 3], InputError> {
    each("rate", text, RATES, &[Dimension::TurnRate; 3])?.try_into().map_err(|_| malformed("rate", text, RATES))
}

/// Mass, radius and thickness of a cylinder.
pub(crate) fn cylinder(text: &str) -> Result<[Given; 3], InputError> {
    let of = [Dimension::Mass, Dimension::Length, Dimension::Length];
    each("cylinder", text, CYLINDER, &of)?.try_into().map_err(|_| malformed("cylinder", text, CYLINDER))
}

/// Moments of inertia, two or three.
pub(crate) fn moments(text: &str) -> Result<Vec<Given>, InputError> {
    let number = text.split(',').count();
    each("moments", text, MOMENTS, &vec![Dimension::Inertia; number])
}

/// Elements of an inertia tensor.
pub(crate) fn inertia(text: &str) -> Result<[Given; 6], InputError> {
    each("inertia", text, INERTIA, &[Dimension::Inertia; 6])?
        .try_into()
        .map_err(|_| malformed("inertia", text, INERTIA))
}

/// Quantities of these kinds, separated by commas.
fn each(
    field: &'static str,
    text: &str,
    expected: &'static str,
    dimensions: &[Dimension],
) -> Result<Vec<Given>, InputError> {
    let parts: Vec<(Dimension, &str)> = dimensions.iter().copied().zip(text.split(',')).collect();
    if text.split(',').count() != dimensions.len() {
        return Err(malformed(field, text, expected));
    }
    read_quantities(field, text, expected, &parts)
}

fn malformed(field: &'static str, text: &str, expected: &'static str) -> InputError {
    InputError::unreadable(field, text, expected)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_expected_of_lists_names_every_unit() {
        for (expected, dimension) in [
            (RATES, Dimension::TurnRate),
            (CYLINDER, Dimension::Mass),
            (CYLINDER, Dimension::Length),
            (MOMENTS, Dimension::Inertia),
            (INERTIA, Dimension::Inertia),
        ] {
            assert!(dimension.units().iter().all(|unit| expected.contains(unit.name())), "{expected}");
        }
    }
}
