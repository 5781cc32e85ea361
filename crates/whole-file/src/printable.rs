//! Texts of others, which may hold what moves the cursor of a terminal or begins a line of its own.

/// `text` on one line: control characters, ends of lines and marks that turn the direction of writing stand as in a string of
/// Rust, such as `\n` and `\u{1b}`.
///
/// ```
/// assert_eq!(whole_file::printable("a\u{1b}[31m\nb"), r"a\u{1b}[31m\nb");
/// ```
pub fn printable(text: &str) -> String {
    escaped(text, is_hidden)
}

/// As [`printable`], of a text of several lines, whose ends and tabs are left.
pub fn printable_lines(text: &str) -> String {
    escaped(text, |letter| is_hidden(letter) && !matches!(letter, '\n' | '\t'))
}

/// Whether a character is a control, ends a line, turns the direction of writing, has no width, or is none at all (the
/// noncharacters of Unicode, of which XML refuses two).
pub fn is_hidden(letter: char) -> bool {
    let is_none = u32::from(letter) & 0xfffe == 0xfffe;
    is_none
        || letter.is_control()
        || matches!(letter, '\u{61c}' | '\u{200b}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(letter, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}')
        || matches!(letter, '\u{fdd0}'..='\u{fdef}' | '\u{e0000}'..='\u{e007f}')
}

fn escaped(text: &str, is_escaped: impl Fn(char) -> bool) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        if is_escaped(letter) { out.extend(letter.escape_default()) } else { out.push(letter) }
    }
    out
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
        let none = "\u{fffe}\u{ffff}\u{1fffe}\u{10ffff}\u{fdd0}\u{2066}\u{200f}\u{feff}";
        assert_eq!(printable(none), r"\u{fffe}\u{ffff}\u{1fffe}\u{10ffff}\u{fdd0}\u{2066}\u{200f}\u{feff}");
        for text in ["e\u{301}, עברית, नि, 👩\u{200d}💻, \u{fffd}", hidden, none] {
            let once = printable(text);
            assert_eq!(printable(&once), once);
            assert!(!once.contains(is_hidden));
        }
    }
}
