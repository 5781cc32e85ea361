//! Counts and fractions, as people type them: the one grammar for the command line and for files.

/// Reads a whole number from 0 to 2^64 - 1, such as `1000`, `1e6` or `2.5e3`, without a rounding; `None` if it is none.
pub fn read_count(text: &str) -> Option<u64> {
    let text = text.trim();
    let text = text.strip_prefix('+').unwrap_or(text);
    let (mantissa, exponent) = match text.split_once(['e', 'E']) {
        Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: String = [whole, part].concat();
    if digits.is_empty() || !digits.bytes().all(|digit| digit.is_ascii_digit()) {
        return None;
    }
    // The number is digits × 10^places, and has no other factor of 10.
    let significant = digits.trim_end_matches('0');
    if significant.is_empty() {
        return Some(0);
    }
    let dropped = i64::try_from(digits.len() - significant.len()).ok()?;
    let places = i64::from(exponent) - i64::try_from(part.len()).ok()? + dropped;
    let factor = 10_u64.checked_pow(u32::try_from(places).ok()?)?;
    significant.parse::<u64>().ok()?.checked_mul(factor)
}

/// Reads a part of a whole, such as `0.7` or `70%`; `None` if it is none. Its range is not checked.
pub fn read_fraction(text: &str) -> Option<f64> {
    let text = text.trim();
    match text.strip_suffix('%') {
        Some(percent) => percent.trim().parse::<f64>().ok().map(|number| number / 100.0),
        None => text.parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_whole_numbers_however_they_are_written() {
        for (text, count) in [
            ("0", 0),
            ("250000", 250_000),
            ("1e6", 1_000_000),
            ("2.5e3", 2500),
            ("2500e-2", 25),
            ("+7", 7),
            ("007", 7),
            ("5.", 5),
            ("3.000", 3),
            ("0e99", 0),
            (" 8 ", 8),
            ("1.8446744073709551615e19", u64::MAX),
            ("18446744073709551615", u64::MAX),
            ("9007199254740993", 9_007_199_254_740_993),
        ] {
            assert_eq!(read_count(text), Some(count), "{text}");
        }
        let refused =
            "|.|-5|\u{2212}5|1.5|1e-1|15e-1|1e20|18446744073709551616|1e|e3|0x10|1_000|abc|nan|inf|1e99999999999|2,000";
        for text in refused.split('|').chain(["30±1"]) {
            assert_eq!(read_count(text), None, "{text}");
        }
    }

    #[test]
    fn fractions_are_numbers_or_percentages() {
        assert_eq!(["0.7", "70%", " 70 % ", "1e-3"].map(read_fraction), [Some(0.7), Some(0.7), Some(0.7), Some(0.001)]);
        assert_eq!(["", "%", "abc", "70%%", "7\u{ff05}", "70 percent"].map(read_fraction), [None; 6]);
    }
}
