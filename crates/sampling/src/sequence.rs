//! Counts of same-side landings from flips in order, written as letters.

use dynamics::InputError;

/// Which side is up before a flip, where only the first one was written down.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NextStart {
    /// The side on which the coin landed before, as in the published experiment (F. Bartoš and others, 2023).
    Last,
    /// The first side again.
    Fixed,
}

impl NextStart {
    /// The rule that a file calls `last` or `fixed`.
    ///
    /// # Errors
    /// [`InputError::Malformed`] for another word.
    pub fn read(text: &str) -> Result<Self, InputError> {
        match text {
            "last" => Ok(Self::Last),
            "fixed" => Ok(Self::Fixed),
            _ => Err(InputError::unreadable("rule", text, "last (each flip starts as the last one landed) or fixed")),
        }
    }
}

/// Whether each flip landed on the side that had been up. `lands` are letters H and T in order, from a `start` of one letter for
/// each flip, or of one for the first and a `rule` for the others. Blanks and commas between letters are passed over.
///
/// # Errors
/// [`InputError::Malformed`] for another letter, with its place, and for a `start` of another length; [`InputError::Missing`]
/// without a `rule` where one is needed.
pub fn landings(start: &str, lands: &str, rule: Option<NextStart>) -> Result<Vec<bool>, InputError> {
    let (start, lands) = (letters("start", start)?, letters("lands", lands)?);
    let starts: Vec<bool> = match (start.as_slice(), rule) {
        _ if start.len() == lands.len() => start,
        ([first], Some(NextStart::Fixed)) => vec![*first; lands.len()],
        ([first], Some(NextStart::Last)) => std::iter::once(*first).chain(lands.iter().copied()).collect(),
        ([_], None) => {
            let expected = "a column rule with last or fixed, because start has one letter for several flips";
            return Err(InputError::Missing { field: "rule", expected });
        }
        _ => {
            let value = format!("{} letters for {} flips", start.len(), lands.len());
            return Err(InputError::Malformed { field: "start", value, expected: "one letter, or one for each flip" });
        }
    };
    Ok(starts.iter().zip(&lands).map(|(start, land)| start == land).collect())
}

/// Whether each letter is an H.
fn letters(field: &'static str, text: &str) -> Result<Vec<bool>, InputError> {
    let is_heads = |(place, letter): (usize, char)| match letter {
        'H' | 'h' => Ok(true),
        'T' | 't' => Ok(false),
        _ => {
            let value = format!("{letter} at place {}", place + 1);
            Err(InputError::Malformed { field, value, expected: "the letters H and T" })
        }
    };
    let is_letter = |(_, letter): &(usize, char)| !letter.is_whitespace() && *letter != ',';
    text.chars().enumerate().filter(is_letter).map(is_heads).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::same_side::SameSide;

    /// By hand: the same letters by each rule.
    #[test]
    fn flips_are_counted_by_the_rule_that_was_said() {
        const LANDS: &str = "HHTHT TTHHT, HHHTTHTHHH";
        for (start, lands, rule, same, tosses) in [
            ("H", LANDS, Some(NextStart::Last), 10, 20),
            ("h", LANDS, Some(NextStart::Fixed), 12, 20),
            ("T", LANDS, Some(NextStart::Fixed), 8, 20),
            ("HTHTHTHTHT", "HHHTTTHHTT", None, 6, 10),
            ("HTHTHTHTHT", "HHHTTTHHTT", Some(NextStart::Last), 6, 10),
            ("T", "t", None, 1, 1),
            ("", "", None, 0, 0),
            ("H", "", Some(NextStart::Last), 0, 0),
        ] {
            let found = SameSide::of_landings(&landings(start, lands, rule).unwrap());
            assert_eq!((found.same(), found.tosses()), (same, tosses), "{start} {lands} {rule:?}");
        }
    }

    #[test]
    fn other_letters_lengths_and_rules_are_refused() {
        for (start, lands, rule, expected) in [
            ("H", "HTX", Some(NextStart::Last), "lands = 'X at place 3'"),
            ("K", "HT", Some(NextStart::Last), "start = 'K at place 1'"),
            ("HT", "HTH", Some(NextStart::Last), "start = '2 letters for 3 flips'"),
            ("", "HTH", Some(NextStart::Last), "start = '0 letters for 3 flips'"),
            ("H", "HTH", None, "rule is missing"),
        ] {
            let error = landings(start, lands, rule).unwrap_err().to_string();
            assert!(error.starts_with(expected), "{error}");
        }
        assert_eq!(NextStart::read("always").unwrap_err().field(), "rule");
        assert_eq!(["last", "fixed"].map(NextStart::read), [Ok(NextStart::Last), Ok(NextStart::Fixed)]);
    }
}
