//! Texts of others, which may hold what moves the cursor of a terminal or begins a line of its own.

use std::borrow::Cow;

/// `text` on one line: control characters, ends of lines and marks that turn the direction of writing stand as in a string of
/// Rust, such as `\n` and `\u{1b}`.
///
/// ```
/// assert_eq!(whole_file::printable("a\u{1b}[31m\nb"), r"a\u{1b}[31m\nb");
/// ```
pub fn printable(text: &str) -> Cow<'_, str> {
    escaped(text, is_hidden)
}

/// As [`printable`], of a text of several lines, whose ends and tabs are left.
pub fn printable_lines(text: &str) -> Cow<'_, str> {
    escaped(text, |letter| is_hidden(letter) && !matches!(letter, '\n' | '\t'))
}

/// Whether a character does something to a terminal, an editor or a reader of XML instead of being seen.
pub fn is_hidden(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{2028}' | '\u{2029}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
        || matches!(letter, '\u{feff}' | '\u{fffe}' | '\u{ffff}')
}

fn escaped(text: &str, is_escaped: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_escaped) {
        return text.into();
    }
    let mut out = String::with_capacity(text.len() + 8);
    for letter in text.chars() {
        if is_escaped(letter) { out.extend(letter.escape_default()) } else { out.push(letter) }
    }
    out.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_hidden_is_shown_and_the_rest_is_left() {
        assert_eq!(printable("ψ = 15° 'a\\b'"), "ψ = 15° 'a\\b'");
        let hidden = "\u{7}\r\t\0\u{9b}\u{202e}\u{2028}\u{fffe}";
        assert_eq!(printable(hidden), r"\u{7}\r\t\u{0}\u{9b}\u{202e}\u{2028}\u{fffe}");
        assert_eq!(printable_lines("a\n\tb\u{7}"), "a\n\tb\\u{7}");
    }
}
