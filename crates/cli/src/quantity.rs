//! Readers of options that are physical quantities. All units come from the table of [`dynamics::quantity`], and every
//! number that a person types with a unit is converted here and in the axes of spaces, nowhere else.

use dynamics::Dimension;
use dynamics::quantity::{Given, read_quantities};
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
    move |text| dimension.read("", text).map_err(|_| format!("expected {}", dimension.expected()))
}

/// As [`of`], but in the unit that was given, so that nothing is rounded.
pub(crate) fn given(dimension: Dimension) -> impl Fn(&str) -> Result<Given, String> + Clone + Send + Sync + 'static {
    move |text| dimension.given("", text).map_err(|_| format!("expected {}", dimension.expected()))
}

/// A probability or another part of a whole, such as `0.95` or `95%`.
pub(crate) fn part(text: &str) -> Result<f64, String> {
    let (number, whole) = text.trim().strip_suffix('%').map_or((text, 1.0), |percent| (percent, 100.0));
    let part = number.trim().parse::<f64>().map(|number| number / whole);
    part.map_err(|_| "expected a number, or a percentage such as 95%".to_owned())
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
    InputError::Malformed { field, value: text.to_owned(), expected }
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
