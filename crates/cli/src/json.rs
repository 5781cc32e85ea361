//! Answers and errors as JSON, in the format that `docs/json.md` describes.

use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter};

/// The number of the format that `docs/json.md` describes. It grows when a field changes its meaning or goes away.
pub(crate) const SCHEMA: u32 = 1;

/// The input of a command; see [`input`](crate::input).
pub(crate) type Input = serde_json::Map<String, serde_json::Value>;

/// An answer with what every answer has.
#[derive(Serialize)]
struct Answered<'a, T> {
    schema: u32,
    input: &'a Input,
    #[serde(flatten)]
    answer: &'a T,
}

/// An answer, which has fields, as JSON.
pub(crate) fn json(input: &Input, answer: &impl Serialize) -> String {
    plain_json(&Answered { schema: SCHEMA, input, answer })
}

/// A whole number as JSON: its digits as a text above 2^53, because readers that take numbers for f64, as JavaScript does,
/// would round it.
pub(crate) fn whole(number: u64) -> serde_json::Value {
    if number <= 1 << 53 { number.into() } else { number.to_string().into() }
}

/// Plain data as JSON: numbers with the fewest digits that read back as the same number, and no -0.
pub(crate) fn plain_json(value: &impl Serialize) -> String {
    let mut text = Vec::new();
    let written = value.serialize(&mut serde_json::Serializer::with_formatter(&mut text, NoNegativeZero));
    written.expect("plain data with string keys is always JSON");
    String::from_utf8(text).expect("JSON is UTF-8")
}

/// Compact JSON in which -0, which equals 0 and surprises programs, is 0.
struct NoNegativeZero;

impl Formatter for NoNegativeZero {
    fn write_f64<W: ?Sized + std::io::Write>(&mut self, to: &mut W, value: f64) -> std::io::Result<()> {
        CompactFormatter.write_f64(to, without_sign_of_zero(value))
    }
}

/// -0 as 0; any other number as it is.
pub(crate) fn without_sign_of_zero(value: f64) -> f64 {
    value + 0.0
}
