//! This file computes confidence intervals for a probability, from counts of independent random launches or from the
//! means of independent scrambles. Without an interval an estimate cannot be judged.
//!
//! ```text
//! Wilson              |h/n - p| ≤ z √(p (1 - p)/n), solved for p
//! Clopper, Pearson    P(at least h of n; lo) = α/2,   P(at most h of n; hi) = α/2
//! Student             mean ± t s/√m of m scrambles
//! ```
//!
//! Here h of n launches land heads, p is the probability, z and t are quantiles of the normal and of Student's
//! distribution, 1 - α is the confidence level, and s the standard deviation of m means. None of the intervals applies
//! to a grid, whose error is one of discretisation. Wilson's interval is displayed with results. Clopper and Pearson's
//! never covers less than its level, so tests and checks use it.

use statrs::distribution::{Beta, ContinuousCDF, Normal, StudentsT};

/// An interval of probabilities within [0, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

impl Interval {
    /// The interval, extended by `error` at both ends but not beyond [0, 1].
    #[must_use]
    pub fn widened(self, error: f64) -> Self {
        Self { lo: (self.lo - error).max(0.0), hi: (self.hi + error).min(1.0) }
    }

    /// Whether `probability` lies in the interval, ends included.
    pub fn contains(&self, probability: f64) -> bool {
        (self.lo..=self.hi).contains(&probability)
    }
}

/// Student's interval at the confidence `level` for the expectation of `means`, which are independent and have the same
/// distribution. `None` for fewer than two.
#[expect(clippy::cast_precision_loss, reason = "a handful of means")]
pub fn from_scrambles(means: &[f64], level: f64) -> Option<Interval> {
    let number = means.len() as f64;
    let student = StudentsT::new(0.0, 1.0, number - 1.0).ok()?;
    let mean = means.iter().sum::<f64>() / number;
    let variance = means.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (number - 1.0);
    let half_width = student.inverse_cdf(0.5 * (1.0 + level)) * (variance / number).sqrt();
    Some(Interval { lo: mean, hi: mean }.widened(half_width))
}

/// Wilson's score interval for `heads` of `points` ≥ 1 at the confidence `level` (0.95 for 95 %).
///
/// Source: E. B. Wilson, J. Am. Stat. Assoc. 22 (1927), 209.
#[expect(clippy::cast_precision_loss, reason = "counts stay far below 2^53")]
pub fn wilson(heads: u64, points: u64, level: f64) -> Interval {
    let (n, p) = (points as f64, heads as f64 / points as f64);
    let z = Normal::standard().inverse_cdf(0.5 * (1.0 + level));
    let centre = (p + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let half_width = z / (1.0 + z * z / n) * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    // At the ends of [0, 1] the formula is exact, and its rounding would leave out the share of the launches.
    Interval {
        lo: if heads == 0 { 0.0 } else { (centre - half_width).max(0.0) },
        hi: if heads == points { 1.0 } else { (centre + half_width).min(1.0) },
    }
}

/// Clopper and Pearson's exact interval for `heads` of `points` ≥ 1 at the confidence `level`.
///
/// Source: C. J. Clopper and E. S. Pearson, Biometrika 26 (1934), 404; ends as quantiles of Beta distributions.
#[expect(clippy::cast_precision_loss, reason = "counts stay far below 2^53")]
pub fn clopper_pearson(heads: u64, points: u64, level: f64) -> Interval {
    let tail = 0.5 * (1.0 - level);
    let (h, n) = (heads as f64, points as f64);
    // Both shape parameters are at least 1 in the two calls below.
    let quantile = |a: f64, b: f64, p: f64| Beta::new(a, b).map_or(f64::NAN, |beta| beta.inverse_cdf(p));
    Interval {
        lo: if heads == 0 { 0.0 } else { quantile(h, n - h + 1.0, tail) },
        hi: if heads == points { 1.0 } else { quantile(h + 1.0, n - h, 1.0 - tail) },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_interval(found: Interval, lo: f64, hi: f64, within: f64) {
        assert!((found.lo - lo).abs() < within && (found.hi - hi).abs() < within, "{found:?}, not [{lo}, {hi}]");
    }

    #[test]
    fn wilson_matches_newcombe() {
        // R. G. Newcombe, Stat. Med. 17 (1998), 857, Table I, method 3.
        assert_interval(wilson(81, 263, 0.95), 0.2553, 0.3662, 5e-5);
        assert_interval(wilson(15, 148, 0.95), 0.0624, 0.1605, 5e-5);
        assert_interval(wilson(0, 20, 0.95), 0.0, 0.1611, 5e-5);
        assert_interval(wilson(1, 29, 0.95), 0.0061, 0.1718, 5e-5);
    }

    #[test]
    fn clopper_pearson_matches_newcombe() {
        // The same table, method 5.
        assert_interval(clopper_pearson(81, 263, 0.95), 0.2527, 0.3676, 5e-5);
        assert_interval(clopper_pearson(15, 148, 0.95), 0.0578, 0.1617, 5e-5);
        assert_interval(clopper_pearson(0, 20, 0.95), 0.0, 0.1684, 5e-5);
        assert_interval(clopper_pearson(1, 29, 0.95), 0.0009, 0.1776, 5e-5);
    }

    #[test]
    fn students_interval_matches_the_tabulated_quantile() {
        // t(0.975) with 7 degrees of freedom is 2.3646; the deviation of these means is 0.01 √(8/7).
        let means: Vec<f64> = (0..8).map(|i| if i % 2 == 0 { 0.49 } else { 0.51 }).collect();
        let half_width = 2.364_624 * 0.01 / 7.0_f64.sqrt();
        assert_interval(from_scrambles(&means, 0.95).unwrap(), 0.5 - half_width, 0.5 + half_width, 1e-8);
        assert_eq!(from_scrambles(&[0.5], 0.95), None);
        assert_eq!(from_scrambles(&[], 0.95), None);
    }

    #[test]
    fn intervals_of_all_heads_or_all_tails_end_at_1_or_0() {
        // (tail)^(1/n) is the exact lower end for n of n.
        assert_interval(clopper_pearson(50, 50, 0.95), 0.025_f64.powf(1.0 / 50.0), 1.0, 1e-12);
        for points in 1..1000 {
            assert_eq!((wilson(points, points, 0.95).hi, wilson(0, points, 0.95).lo), (1.0, 0.0), "{points}");
        }
    }

    #[test]
    fn an_interval_contains_its_ends_and_nothing_outside() {
        let interval = Interval { lo: 0.25, hi: 0.5 };
        assert!([0.25, 0.3, 0.5].iter().all(|inside| interval.contains(*inside)));
        assert!([0.25_f64.next_down(), 0.5_f64.next_up(), f64::NAN].iter().all(|outside| !interval.contains(*outside)));
    }
}
