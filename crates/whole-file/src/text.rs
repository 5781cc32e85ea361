//! Texts in UTF-8.

use std::fmt;

/// The mark that some editors put before a text in UTF-8.
pub(crate) const MARK: &str = "\u{feff}";

/// Bytes that are no text in UTF-8.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NotText {
    /// What stands before the first byte at fault.
    pub before: String,
    looks_like_utf_16: bool,
}

impl NotText {
    /// `bytes`, of which the first `valid` are UTF-8.
    pub(crate) fn new(bytes: &[u8], valid: usize) -> Self {
        let looks_like_utf_16 = looks_like_utf_16(bytes);
        let valid = if looks_like_utf_16 { 0 } else { valid };
        Self { before: String::from_utf8_lossy(&bytes[..valid]).into_owned(), looks_like_utf_16 }
    }
}

impl fmt::Display for NotText {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the text is not UTF-8")?;
        if self.looks_like_utf_16 { f.write_str(" but looks like UTF-16; save it as UTF-8") } else { Ok(()) }
    }
}

impl std::error::Error for NotText {}

/// Whether bytes begin with the mark of UTF-16, or every other one of the first is 0, as in UTF-16 of Latin letters.
pub(crate) fn looks_like_utf_16(bytes: &[u8]) -> bool {
    let first = &bytes[..bytes.len().min(64)];
    let zeros = first.iter().filter(|byte| **byte == 0).count();
    first.starts_with(b"\xff\xfe") || first.starts_with(b"\xfe\xff") || (first.len() > 2 && 3 * zeros >= first.len())
}

/// The text that `bytes` are in UTF-8, without the mark before it.
///
/// # Errors
/// [`NotText`] for other bytes.
pub fn text(bytes: Vec<u8>) -> Result<String, NotText> {
    if looks_like_utf_16(&bytes) {
        return Err(NotText::new(&bytes, 0));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        NotText::new(error.as_bytes(), valid)
    })?;
    Ok(text.strip_prefix(MARK).map(str::to_owned).unwrap_or(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mark_is_passed_over_and_other_encodings_are_named() {
        for text_of in ["", "a", "é\r\n\u{feff}"] {
            assert_eq!(text(format!("\u{feff}{text_of}").into()), Ok(text_of.to_owned()));
            assert_eq!(text(text_of.into()), Ok(text_of.to_owned()));
        }
        for bytes in [&b"\xff\xfea\0"[..], b"\xfe\xff\0a", b"a\0b\0c\0"] {
            let message = text(bytes.to_vec()).unwrap_err().to_string();
            assert_eq!(message, "the text is not UTF-8 but looks like UTF-16; save it as UTF-8");
        }
        let latin = text(b"ab\nc\xe9d".to_vec()).unwrap_err();
        assert_eq!((latin.to_string().as_str(), latin.before.as_str()), ("the text is not UTF-8", "ab\nc"));
    }
}
