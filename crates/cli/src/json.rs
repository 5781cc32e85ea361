//! JSON as all commands write it, answers and errors alike.

use std::io::Write;

use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter};

/// The number of the format that `docs/json.md` describes. It grows when a field changes its meaning or goes away.
pub(crate) const SCHEMA: u32 = 1;

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
    fn write_f64<W: ?Sized + Write>(&mut self, to: &mut W, value: f64) -> std::io::Result<()> {
        CompactFormatter.write_f64(to, without_sign_of_zero(value))
    }
}

/// -0 as 0; any other number as it is.
pub(crate) fn without_sign_of_zero(value: f64) -> f64 {
    value + 0.0
}
