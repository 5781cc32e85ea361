//! Readers of options: quantities, counts, fractions, tolerances and names, one reader for each kind, so that all options have
//! one grammar. What a text may be is decided in [`dynamics::quantity`], for the axes of spaces too.
//!
//! A reader says what is valid; clap puts the option and the value before it.

use std::ops::RangeInclusive;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use dynamics::Dimension;
use dynamics::quantity::{Given, look_alike, read_count, read_fraction};
use sampling::Method;
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

/// What is wrong with a text that is not what was `expected`.
fn expected(text: &str, expected: &str) -> String {
    let look_alike = look_alike(text)
        .map(|(found, meant)| format!("'{found}' (U+{:04X}) only looks like '{meant}'; ", u32::from(found)));
    format!("{}expected {expected}", look_alike.unwrap_or_default())
}
