//! Makes one line for people of a text that others wrote: a program's words, a panic's message, a name in a file, a path.
//! Printed as it is, such a text could move the cursor, hide what stands beside it, begin a line that looks like one of
//! ours, or break a file of XML.

/// `text` in one line: characters that no one can see are written by their code, as in `\n`, `\u{1b}` and `\u{202e}`.
/// Quotes and backslashes stay, so that a command can be copied, and a text that was made so before stays what it is.
pub(crate) fn shown(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for character in text.chars() {
        if is_unseen(character) { out.extend(character.escape_debug()) } else { out.push(character) }
    }
    out
}

/// Whether a character is a control, ends a line, turns the direction of writing, has no width, or is none at all (the
/// noncharacters of Unicode, of which XML refuses two).
pub(crate) fn is_unseen(character: char) -> bool {
    let is_none = u32::from(character) & 0xfffe == 0xfffe;
    is_none
        || character.is_control()
        || matches!(character, '\u{61c}' | '\u{200b}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(character, '\u{2060}'..='\u{206f}' | '\u{feff}' | '\u{fff9}'..='\u{fffb}')
        || matches!(character, '\u{fdd0}'..='\u{fdef}' | '\u{e0000}'..='\u{e007f}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_of_others_becomes_one_line_without_unseen_characters_and_stays_so() {
        for (text, line) in [
            ("too \u{1b}[31mfar\u{1b}[0m\u{7}\0\u{9b}", "too \\u{1b}[31mfar\\u{1b}[0m\\u{7}\\0\\u{9b}"),
            ("a\nerror: b\r\n\tc\u{2028}d\u{85}", "a\\nerror: b\\r\\n\\tc\\u{2028}d\\u{85}"),
            ("\u{fffe}\u{ffff}\u{1fffe}\u{10ffff}\u{fdd0}", "\\u{fffe}\\u{ffff}\\u{1fffe}\\u{10ffff}\\u{fdd0}"),
            ("\u{202e}evil\u{2066}\u{200f}\u{feff}", "\\u{202e}evil\\u{2066}\\u{200f}\\u{feff}"),
            ("\u{fffd}", "\u{fffd}"),
        ] {
            assert_eq!(shown(text), line);
            assert_eq!(shown(line), line);
        }
        for text in ["'C:\\mine' \"θ\" ]]> <b>&amp;", "e\u{301}, עברית, नि, 👩\u{200d}💻"] {
            assert_eq!(shown(text), text);
        }
        for code in (0..=0x9f).filter(|code| !(0x20..0x7f).contains(code)) {
            assert!(is_unseen(char::from(code as u8)), "{code:x}");
        }
    }
}
