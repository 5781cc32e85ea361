//! JSON as all commands write it, answers and errors alike.

use std::io::Write;

use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter};
use whole_file::is_hidden;

/// The number of the format that `docs/json.md` describes. It grows when a field changes its meaning or goes away.
pub(crate) const SCHEMA: u32 = 1;

/// Plain data as JSON: numbers with the fewest digits that read back as the same number, and no -0.
pub(crate) fn plain_json(value: &impl Serialize) -> String {
    let mut text = Vec::new();
    let written = value.serialize(&mut serde_json::Serializer::with_formatter(&mut text, Plain));
    written.expect("plain data with string keys is always JSON");
    String::from_utf8(text).expect("JSON is UTF-8")
}

/// Compact JSON in which -0, which equals 0 and surprises programs, is 0, and in which no letter of a text is hidden.
struct Plain;

impl Formatter for Plain {
    fn write_string_fragment<W: ?Sized + Write>(&mut self, to: &mut W, fragment: &str) -> std::io::Result<()> {
        for part in fragment.split_inclusive(is_hidden) {
            let hidden = part.chars().next_back().filter(|letter| is_hidden(*letter));
            let seen = &part[..part.len() - hidden.map_or(0, char::len_utf8)];
            to.write_all(seen.as_bytes())?;
            // Beyond 16 bits a letter has two units.
            for unit in hidden.map(String::from).unwrap_or_default().encode_utf16() {
                write!(to, "\\u{unit:04x}")?;
            }
        }
        Ok(())
    }

    fn write_f64<W: ?Sized + Write>(&mut self, to: &mut W, value: f64) -> std::io::Result<()> {
        CompactFormatter.write_f64(to, without_sign_of_zero(value))
    }
}

/// -0 as 0; any other number as it is.
pub(crate) fn without_sign_of_zero(value: f64) -> f64 {
    value + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_letter_of_a_text_is_hidden_and_each_is_read_back() {
        let text = "a\u{7f}\u{202e}\u{feff}\u{1fffe}\u{e0041}é👩";
        let json = plain_json(&text);
        assert!(!json.contains(is_hidden), "{json}");
        assert_eq!(serde_json::from_str::<String>(&json).unwrap(), text);
    }
}
