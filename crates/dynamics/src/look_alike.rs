//! Characters that look like one of those that numbers and units are written with.

/// Characters that are typed or pasted in place of one that quantities are written with.
const LOOK_ALIKES: [(char, &str); 8] = [
    ('-', "\u{2010}\u{2011}\u{2012}\u{2013}\u{2014}\u{2212}\u{fe63}\u{ff0d}"),
    ('°', "\u{ba}\u{2da}\u{1d52}\u{2070}\u{2218}"),
    (':', "\u{2236}\u{a789}\u{ff1a}"),
    ('.', "\u{2024}\u{ff0e}"),
    (',', "\u{201a}\u{ff0c}"),
    ('/', "\u{2044}\u{2215}\u{ff0f}"),
    ('%', "\u{66a}\u{ff05}"),
    ('+', "\u{ff0b}"),
];

/// The first character of a text that only looks like one of those that numbers and units are written with, and that one. It
/// is meant for texts that can't be read: `·` is a part of `kg·m²`.
pub fn look_alike(text: &str) -> Option<(char, char)> {
    let meant = |found: char| LOOK_ALIKES.iter().find(|(_, similar)| similar.contains(found));
    text.chars().find_map(|found| meant(found).map(|(meant, _)| (found, *meant)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn look_alikes_are_told_from_the_characters_that_they_look_like() {
        for (text, found) in [
            ("\u{2212}3", Some(('\u{2212}', '-'))),
            ("3e\u{2013}4", Some(('\u{2013}', '-'))),
            ("15º", Some(('º', '°'))),
            ("15˚", Some(('˚', '°'))),
            ("70\u{ff05}", Some(('\u{ff05}', '%'))),
            ("-15.5°,3/4:2%+1", None),
        ] {
            assert_eq!(look_alike(text), found, "{text}");
        }
        let meant: Vec<char> = LOOK_ALIKES.iter().map(|(meant, _)| *meant).collect();
        assert!(LOOK_ALIKES.iter().all(|(_, similar)| !similar.contains(&meant[..])));
    }
}
