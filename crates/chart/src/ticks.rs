//! Marks of an axis and their labels. Marks lie on round numbers, no two labels are alike, and no label is "-0".

/// A mark: where it lies on the axis, and its label.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Tick {
    pub(crate) value: f64,
    pub(crate) label: String,
}

/// The fewest marks of a logarithmic axis.
const FEWEST: usize = 3;

/// Marks at the multiples of 1, 2 or 5 times a power of ten from `lo` to `hi`: as many as there can be up to `most`.
/// An axis that is too narrow for its distance from 0 has none.
pub(crate) fn linear(lo: f64, hi: f64, most: usize) -> Vec<Tick> {
    let finest = (hi - lo) / most.max(1) as f64;
    if !(1e-300..=1e300).contains(&finest) || lo.abs().max(hi.abs()) / finest > 1e12 {
        return Vec::new();
    }
    let exponent = exponent_of(finest);
    let steps = [(1, exponent), (2, exponent), (5, exponent), (1, exponent + 1), (2, exponent + 1)];
    let marks = steps.map(|(digit, exponent)| multiples(lo, hi, (digit, exponent)));
    let fitting = marks.into_iter().find(|marks| marks.len() <= most);
    fitting.unwrap_or_default().into_iter().map(|(digits, exponent)| tick(digits, exponent)).collect()
}

/// The power of ten at or just below `value`.
#[expect(clippy::cast_possible_truncation, reason = "the exponent of an f64")]
fn exponent_of(value: f64) -> i32 {
    value.log10().floor() as i32
}

/// The multiples of `digit` · 10^`exponent` from `lo` to `hi`, as digits and exponent.
#[expect(clippy::cast_possible_truncation, reason = "below 1e13")]
fn multiples(lo: f64, hi: f64, (digit, exponent): (i64, i32)) -> Vec<(i64, i32)> {
    let step = digit as f64 * 10f64.powi(exponent);
    // A bound that is a multiple itself counts, whatever the rounding of the division.
    let (first, last) = ((lo / step - 1e-6).ceil() as i64, (hi / step + 1e-6).floor() as i64);
    (first..=last).map(|multiple| (multiple * digit, exponent)).collect()
}

/// The mark at `digits` · 10^`exponent`.
fn tick(digits: i64, exponent: i32) -> Tick {
    let label = match exponent {
        _ if digits == 0 && exponent > -5 => format!("{:.*}", exponent.min(0).unsigned_abs() as usize, 0.0),
        _ if digits == 0 => "0".to_owned(),
        0..=5 => format!("{}", digits * 10_i64.pow(exponent.unsigned_abs())),
        -4..0 => format!("{:.*}", exponent.unsigned_abs() as usize, digits as f64 / 10f64.powi(-exponent)),
        _ => format!("{digits}e{exponent}"),
    };
    // Read back, the label is the number nearest to the mark.
    Tick { value: label.parse().unwrap_or(0.0), label }
}

/// Marks of a logarithmic axis from `lo` to `hi`, both positive: every power of ten if no more than `most` result, or else
/// every second, third and so on. They are at least three: an axis with fewer powers of ten has marks between them.
pub(crate) fn logarithmic(lo: f64, hi: f64, most: usize) -> Vec<Tick> {
    let powers = |stride: i32| between(lo, hi, &[1], stride);
    let mut stride = 1;
    while powers(stride).len() > most && powers(stride + 1).len() >= FEWEST {
        stride += 1;
    }
    let choices = [powers(stride), between(lo, hi, &[1, 2, 5], 1), between(lo, hi, &[1, 2, 3, 4, 5, 6, 7, 8, 9], 1)];
    let found = choices.into_iter().find(|marks| marks.len() >= FEWEST);
    found.unwrap_or_else(|| linear(lo, hi, most.max(2 * FEWEST)))
}

/// The marks `digits` · 10^n from `lo` to `hi`, with n a multiple of `stride`.
fn between(lo: f64, hi: f64, digits: &[i32], stride: i32) -> Vec<Tick> {
    let powers = exponent_of(lo)..=exponent_of(hi) + 1;
    let marks = powers
        .filter(|power| power % stride == 0)
        .flat_map(|power| digits.iter().map(move |digit| format!("{digit}e{power}")));
    let tick = |label: String| Tick { value: label.parse().unwrap_or(0.0), label };
    // A bound that is a mark itself counts, whatever the rounding.
    marks.map(tick).filter(|tick| (lo * (1.0 - 1e-9)..=hi * (1.0 + 1e-9)).contains(&tick.value)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().map(|tick| tick.label.as_str()).collect()
    }

    #[test]
    fn marks_are_round_numbers_with_the_digits_they_need() {
        assert_eq!(labels(&linear(0.0, 30.0, 7)), ["0", "5", "10", "15", "20", "25", "30"]);
        assert_eq!(labels(&linear(-1.1, 1.1, 5)), ["-1.0", "-0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(labels(&linear(0.0, 250_000.0, 6)), ["0", "50000", "100000", "150000", "200000", "250000"]);
        assert_eq!(labels(&linear(0.0, 3e-301, 3)), Vec::<&str>::new());
        assert_eq!(labels(&linear(0.0, 3e-9, 4)), ["0", "1e-9", "2e-9", "3e-9"]);
    }

    #[test]
    fn every_power_of_ten_has_a_mark_if_there_is_room_or_every_second_and_so_on() {
        assert_eq!(labels(&logarithmic(1e-2, 1e2, 9)), ["1e-2", "1e-1", "1e0", "1e1", "1e2"]);
        assert_eq!(labels(&logarithmic(1e-17, 1e-3, 8)), ["1e-16", "1e-14", "1e-12", "1e-10", "1e-8", "1e-6", "1e-4"]);
        assert_eq!(labels(&logarithmic(1e-16, 1e1, 4)), ["1e-15", "1e-10", "1e-5", "1e0"]);
    }

    #[test]
    fn an_axis_of_few_powers_of_ten_has_marks_between_them() {
        assert_eq!(labels(&logarithmic(256.0, 18_000.0, 6)), ["5e2", "1e3", "2e3", "5e3", "1e4"]);
        assert_eq!(labels(&logarithmic(2.5, 6.0, 6)), ["3e0", "4e0", "5e0", "6e0"]);
        assert!(logarithmic(1.0, 1.05, 6).len() >= 3);
    }

    #[test]
    fn labels_are_never_doubled_nor_minus_zero() {
        for most in 1..14 {
            for (lo, width) in [(-1.0, 2.0), (-0.04, 0.13), (0.66, 1e-3), (-30.0, 60.0), (1e5, 3.0), (-2e-7, 1e-6)] {
                let ticks = linear(lo, lo + width, most);
                assert!(ticks.len() <= most, "{ticks:?}");
                assert!(ticks.windows(2).all(|pair| pair[0].label != pair[1].label), "{ticks:?}");
                let is_minus_zero = |tick: &Tick| tick.label.starts_with('-') && tick.value == 0.0;
                assert!(!ticks.iter().any(is_minus_zero), "{ticks:?}");
            }
            for (lo, hi) in [(1e-18, 1e1), (256.0, 18_022.0), (3.0, 40.0), (1.0, 1.2), (1e-7, 1e-2)] {
                let ticks = logarithmic(lo, hi, most);
                assert!(ticks.windows(2).all(|pair| pair[0].label != pair[1].label), "{ticks:?}");
                let fitting = FEWEST..=most.max(2 * FEWEST);
                assert!(fitting.contains(&ticks.len()), "{lo} to {hi}, {most}: {ticks:?}");
            }
        }
    }
}
