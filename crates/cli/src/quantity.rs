//! Readers of options: quantities, counts, fractions, tolerances and names, one reader for each kind, so that all options have
//! one grammar. What a text may be is decided in [`dynamics::quantity`], for the axes of spaces too.
//!
//! A reader says what is valid; clap puts the option and the value before it.

use std::ops::RangeInclusive;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use dynamics::Dimension;
use dynamics::quantity::{Given, look_alike, read_count, read_fraction};
use sampling::{Interval, Method};
use toss::planner::WantKind;

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

/// A reader of one of these methods by its name.
pub(crate) fn method(listed: &'static [Method]) -> impl TypedValueParser<Value = Method> {
    named(listed, Method::name, Method::summary)
}

/// A reader of what is wanted of a plan by its name.
pub(crate) fn want() -> impl TypedValueParser<Value = WantKind> {
    named(&WantKind::ALL, WantKind::name, WantKind::summary)
}

fn named<T: Copy + Send + Sync + 'static>(
    listed: &'static [T],
    name: fn(T) -> &'static str,
    summary: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    let names = PossibleValuesParser::new(listed.iter().map(|one| PossibleValue::new(name(*one)).help(summary(*one))));
    names.map(move |text| *listed.iter().find(|one| name(**one) == text).expect("clap refuses any other name"))
}

/// The shortest digits that read back as the same number, with an exponent if it is tiny or huge.
pub(crate) fn shortest(number: f64) -> String {
    match number.abs() {
        0.0 | 1e-4..1e16 => number.to_string(),
        _ => format!("{number:e}"),
    }
}

/// A number to two decimal places, or three digits if it is below 1, without zeros at its end.
pub(crate) fn rounded(number: f64) -> String {
    let text = if number.abs() < 1.0 { format!("{number:.2e}") } else { format!("{number:.2}") };
    shortest(text.parse().unwrap_or(number))
}

/// A part of a whole in percent: its decimal with the point moved, which a product by 100 would round.
pub(crate) fn in_percent(part: f64) -> f64 {
    let moved = format!("{part:e}").split_once('e').and_then(|(digits, exponent)| {
        let exponent: i32 = exponent.parse().ok()?;
        format!("{digits}e{}", exponent + 2).parse().ok()
    });
    moved.unwrap_or(100.0 * part)
}

/// The same as text, by all digits that tell it from its neighbours.
pub(crate) fn percent(part: f64) -> String {
    format!("{} %", shortest(in_percent(part)))
}

/// A probability to so many decimal places, at least. It has more where it would be printed as 0 or 1 and is neither.
pub(crate) fn probability(value: f64, places: usize) -> String {
    let is_certain = value == 0.0 || value == 1.0;
    let shown = (places..=17).map(|places| format!("{value:.places$}"));
    let told = |text: &String| is_certain || text.parse().is_ok_and(|shown: f64| shown != 0.0 && shown != 1.0);
    shown.clone().find(told).unwrap_or_else(|| shortest(value))
}

/// A bound > 0 with two digits, of which the last is rounded up.
pub(crate) fn rounded_up(bound: f64) -> String {
    let shown = format!("{bound:.1e}");
    let is_below = shown.parse().is_ok_and(|shown: f64| shown < bound);
    if is_below { format!("{:.1e}", bound + 0.05 * 10f64.powf(bound.log10().floor())) } else { shown }
}

/// An interval of numbers ≥ 0 to so many decimal places, rounded outwards: what is printed contains it.
pub(crate) fn interval(Interval { lo, hi }: Interval, places: usize) -> String {
    format!("{} to {}", outwards(lo, places, false), outwards(hi, places, true))
}

/// A number rounded down or `up`, from all of its digits.
pub(crate) fn outwards(value: f64, places: usize, up: bool) -> String {
    if value < 0.0 {
        return format!("-{}", outwards(-value, places, !up));
    }
    let all = format!("{value:.1074}");
    let (kept, rest) = all.split_at(all.len() - 1074 + places);
    let units: u128 = kept.replace('.', "").parse().unwrap_or_default();
    let units = units + u128::from(up && rest.contains(|digit| digit != '0'));
    let one = 10_u128.pow(u32::try_from(places).unwrap_or_default());
    format!("{}.{:0places$}", units / one, units % one)
}

/// What is wrong with a text that is not what was `expected`.
fn expected(text: &str, expected: &str) -> String {
    let look_alike = look_alike(text)
        .map(|(found, meant)| format!("'{found}' (U+{:04X}) only looks like '{meant}'; ", u32::from(found)));
    format!("{}expected {expected}", look_alike.unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiny_and_huge_numbers_have_an_exponent() {
        let shown = [0.0, 1e-307, 1e-5, 1e-4, 0.1, 1e15, 1e300, -1e-9].map(shortest);
        assert_eq!(shown, ["0", "1e-307", "1e-5", "0.0001", "0.1", "1000000000000000", "1e300", "-1e-9"]);
        assert_eq!([38.0 / std::f64::consts::TAU, 38.0, 1e-300].map(rounded), ["6.05", "38", "1e-300"]);
    }

    #[test]
    fn a_percentage_is_the_decimal_with_its_point_moved() {
        let shown = [0.07, 0.29, 0.000_095, 1e-7, 1.0].map(percent);
        assert_eq!(shown, ["7 %", "29 %", "0.0095 %", "1e-5 %", "100 %"]);
    }

    #[test]
    fn an_interval_is_rounded_outwards() {
        let shown = |lo, hi, places| interval(Interval { lo, hi }, places);
        assert_eq!(shown(0.123_456_7, 0.765_432_1, 6), "0.123456 to 0.765433");
        assert_eq!(shown(0.5, 0.75, 2), "0.50 to 0.75");
        assert_eq!(shown(0.0, 1.0, 3), "0.000 to 1.000");
        // The f64 next to 0.1 is above it.
        assert_eq!(shown(0.1, 0.1, 16), "0.1000000000000000 to 0.1000000000000001");
        assert_eq!(shown(89.996, 179.9951, 2), "89.99 to 180.00");
        assert_eq!([1.04e-9, 1.05e-9].map(rounded_up), ["1.1e-9", "1.1e-9"]);
    }

    #[test]
    fn certainty_is_never_reached_by_rounding() {
        let shown = [0.0, 1.0, 0.5, 0.999_999_99, 1.0 - f64::EPSILON, 3e-9].map(|value| probability(value, 6));
        assert_eq!(shown, ["0.000000", "1.000000", "0.500000", "0.99999999", "0.9999999999999998", "0.000000003"]);
        assert_eq!(probability(1e-300, 6), "1e-300");
    }
}
