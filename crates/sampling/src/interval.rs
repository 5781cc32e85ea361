//! This file computes confidence intervals for a probability, from counts of independent random launches or from the
//! means of independent scrambles. Without an interval an estimate cannot be judged.
//!
//! ```text
//! Clopper, Pearson    P(at least h of n; lo) = α/2,   P(at most h of n; hi) = α/2
//! Student             mean ± t s/√m of m scrambles
//! resolution          least mean + hi(h of n),   greatest mean - hi(h' of n)
//! ```
//!
//! Here h of n launches land heads, t is a quantile of Student's distribution, 1 - α is the confidence level, and s the
//! standard deviation of m means. None of the intervals applies to a grid, whose error is one of discretisation. Clopper
//! and Pearson's never covers less than its level.
//!
//! Student's interval assumes normal means, and the errors of scrambles are not normal: where one kink decides, the error is a
//! parabola of a uniform number. Intervals at 95 % contained 93.4 % of the probabilities of such spaces. So it is taken at 97 %.
//!
//! # Scrambles that agree
//! Each scramble counts a whole number of heads. Where few points decide, most scrambles count K of them and some K + 1,
//! and all m agree far too often for Student's interval: their deviation is then 0, and proves nothing. So the interval
//! reaches as far as the resolution of the counts allows, too. Of the n points of all scrambles, let h be those beyond the
//! least count of a scramble, Σ (h_i - min h_i). Every scramble has the least count for sure, and the h points are what
//! is left to chance. For one coordinate, chance means that each cell of 1/n_i of the axis has one point at an independent
//! place of it, so that h is a sum of independent numbers that are 0 or 1. By Hoeffding its tails are no heavier than those of a
//! binomial distribution with the same mean, for which Clopper and Pearson's interval holds. The lower end follows in the
//! same way from the greatest count. With h = 0 the ends are 3.7 points away: this is what agreement proves, as it does for 0
//! of n launches.
//!
//! For shares, which are not whole numbers, the resolution counts where two scrambles agree but for rounding, because such
//! shares are 0 or 1 nearly everywhere, and where heads or tails are fewer than eight points for each scramble. Elsewhere the
//! shares of all scrambles differ, and Student's interval serves, with what is [too rare](crate::unresolved) for their points.
//!
//! Sources: W. Hoeffding, Ann. Math. Stat. 27 (1956), 713 (theorem 5). The check `interval-coverage` measures how often the
//! intervals contain the probability.

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// An interval of probabilities within [0, 1]. With serde it is the array of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(into = "[f64; 2]"))]
pub struct Interval {
    /// Lower end.
    pub lo: f64,
    /// Upper end.
    pub hi: f64,
}

impl From<Interval> for [f64; 2] {
    fn from(Interval { lo, hi }: Interval) -> Self {
        [lo, hi]
    }
}

impl Interval {
    /// The interval, extended by `error` at both ends but not beyond [0, 1].
    #[must_use]
    pub fn widened(self, error: f64) -> Self {
        Self { lo: (self.lo - error).max(0.0), hi: (self.hi + error).min(1.0) }
    }

    /// The distance of the ends.
    pub fn width(&self) -> f64 {
        self.hi - self.lo
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

/// The interval at the confidence `level` for the probability of heads, from the shares of heads of scrambles. Each of
/// `means` is that of as many of the `points`, and `error` is the rounding error of a mean, 0 for counts. The flag says whether
/// the interval is wider than Student's. `None` for fewer than two scrambles.
#[expect(clippy::cast_precision_loss, reason = "counts stay far below 2^53")]
pub(crate) fn from_scrambled_points(means: &[f64], error: f64, points: u64, level: f64) -> Option<(Interval, bool)> {
    /// Fewer points than these for each scramble decide too little for Student's interval.
    const FEW: f64 = 8.0;
    /// The part of the chance of a miss that Student's interval is taken at.
    const OF_MISSES: f64 = 0.6;
    let student = from_scrambles(means, 1.0 - OF_MISSES * (1.0 - level))?;
    let (n, number) = (points as f64, means.len() as f64);
    let mut sorted = means.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let (least, greatest) = (sorted[0], sorted[means.len() - 1]);
    let mean = means.iter().sum::<f64>() / number;
    let agree = sorted.windows(2).any(|pair| pair[1] - pair[0] <= 2.0 * error);
    let are_few = n * mean.min(1.0 - mean) < FEW * number;
    if !agree && !are_few {
        return Some((student, false));
    }
    // The whole number of points above a number that rounding may have raised above a whole one.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the number of points")]
    let reach = |h: f64| clopper_pearson((h - 1e-3).ceil().max(0.0) as u64, points, level).hi;
    let lo = greatest - reach(n * (greatest - mean));
    let hi = least + reach(n * (mean - least));
    let interval = Interval { lo: student.lo.min(lo).max(0.0), hi: student.hi.max(hi).min(1.0) };
    Some((interval, interval != student))
}

/// Clopper and Pearson's exact interval for `heads` of `points` ≥ 1 at the confidence `level` (0.95 for 95 %).
///
/// Source: C. J. Clopper and E. S. Pearson, Biometrika 26 (1934), 404. With fewer than 100 heads, or tails, the ends solve
/// the definition. With more they are A. H. Carter's quantiles of Beta distributions (Biometrika 34 (1947), 352), with
/// 0.2 % added to their distance from the share of heads, which is above Carter's error.
pub fn clopper_pearson(heads: u64, points: u64, level: f64) -> Interval {
    let tail = 0.5 * (1.0 - level);
    if heads <= points - heads {
        return Interval { lo: lower_end(heads, points, tail), hi: upper_end(heads, points, tail) };
    }
    let tails = points - heads;
    Interval { lo: 1.0 - upper_end(tails, points, tail), hi: 1.0 - lower_end(tails, points, tail) }
}

/// Fewer heads than these are summed up.
const FEW_HEADS: u64 = 100;

/// The probability at which at least `heads` of `points`, at most half of them, have the probability `tail`.
fn lower_end(heads: u64, points: u64, tail: f64) -> f64 {
    match heads {
        0 => 0.0,
        1..FEW_HEADS => probability_of_at_most(heads - 1, points, 1.0 - tail)[0],
        _ => end_of_many(heads, points, tail, -1.0),
    }
}

/// The probability at which at most `heads` of `points`, at most half of them, have the probability `tail`.
fn upper_end(heads: u64, points: u64, tail: f64) -> f64 {
    match heads {
        0..FEW_HEADS => probability_of_at_most(heads, points, tail)[1],
        _ => end_of_many(heads, points, tail, 1.0),
    }
}

/// Numbers below and above the probability of heads at which at most `heads` of `points` launches land heads with the
/// probability `part`.
#[expect(clippy::cast_precision_loss, reason = "counts stay far below 2^53")]
fn probability_of_at_most(heads: u64, points: u64, part: f64) -> [f64; 2] {
    let at_most = |p: f64| {
        let mut term = (points as f64 * (-p).ln_1p()).exp();
        let mut sum = term;
        for h in 0..heads {
            term *= (points - h) as f64 / (h + 1) as f64 * (p / (1.0 - p));
            sum += term;
        }
        sum
    };
    let [mut lo, mut hi] = [0.0, 1.0];
    for _ in 0..64 {
        let middle = 0.5 * (lo + hi);
        if at_most(middle) > part { lo = middle } else { hi = middle }
    }
    [lo, hi]
}

/// The end on this `side`, 1 or -1, of the share of heads, for at least [`FEW_HEADS`] heads and tails: Carter's quantile,
/// farther out by its error.
#[expect(clippy::cast_precision_loss, reason = "counts stay far below 2^53")]
fn end_of_many(heads: u64, points: u64, tail: f64, side: f64) -> f64 {
    const WIDENED: f64 = 1.002;
    let (h, n) = (heads as f64, points as f64);
    // The shape parameters of the Beta distribution.
    let [a, b] = if side > 0.0 { [h + 1.0, n - h] } else { [h, n - h + 1.0] };
    let y = side * Normal::standard().inverse_cdf(tail);
    let [s, t] = [1.0 / (2.0 * a - 1.0), 1.0 / (2.0 * b - 1.0)];
    let (r, harmonic) = ((y * y - 3.0) / 6.0, 2.0 / (s + t));
    let w = y * (harmonic + r).sqrt() / harmonic - (t - s) * (r + 5.0 / 6.0 - 2.0 / (3.0 * harmonic));
    let quantile = a / (a + b * (2.0 * w).exp());
    h / n + WIDENED * (quantile - h / n)
}

#[cfg(test)]
mod tests {
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    use super::*;

    fn assert_interval(found: Interval, lo: f64, hi: f64, within: f64) {
        assert!((found.lo - lo).abs() < within && (found.hi - hi).abs() < within, "{found:?}, not [{lo}, {hi}]");
    }

    #[test]
    fn clopper_pearson_matches_newcombe() {
        // R. G. Newcombe, Stat. Med. 17 (1998), 857, Table I, method 5.
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
    fn scrambles_that_agree_have_an_interval_as_wide_as_their_points_resolve() {
        let of = |counts: [f64; 8], points: f64| {
            from_scrambled_points(&counts.map(|heads| heads / points), 0.0, 8 * points as u64, 0.95).unwrap()
        };
        // 1 - 0.025^(1/N) is the end for 0 of N.
        let reach = 1.0 - 0.025_f64.powf(1.0 / 8192.0);
        let (found, is_wider) = of([700.0; 8], 1024.0);
        assert_interval(found, 700.0 / 1024.0 - reach, 700.0 / 1024.0 + reach, 1e-12);
        assert!(is_wider);
        // One scramble has one more: 1 of 8192 is above the others, and 7 of 8192 are missing below it.
        let (found, _) = of([7.0, 7.0, 7.0, 8.0, 7.0, 7.0, 7.0, 7.0], 1024.0);
        let [lo, hi] = [clopper_pearson(7, 8192, 0.95).hi, clopper_pearson(1, 8192, 0.95).hi];
        assert_interval(found, 8.0 / 1024.0 - lo, 7.0 / 1024.0 + hi, 1e-12);
        // Rare heads are as independent ones.
        let (found, _) = of([0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1.0, 0.0], 1024.0);
        assert_eq!((found.lo, found.hi), (0.0, clopper_pearson(3, 8192, 0.95).hi));
        // Counts that differ by much have Student's interval.
        let counts = [400.0, 410.0, 420.0, 430.0, 440.0, 450.0, 460.0, 470.0];
        assert_eq!(of(counts, 1024.0), (from_scrambles(&counts.map(|heads| heads / 1024.0), 0.97).unwrap(), false));
        // So have shares that are not whole numbers, however close, unless rounding alone tells them apart.
        let shares = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| 0.3 + 1e-9 * f64::from(i));
        let student = from_scrambles(&shares, 0.97).unwrap();
        assert_eq!(from_scrambled_points(&shares, 1e-10, 1 << 16, 0.95), Some((student, false)));
        let (wide, _) = from_scrambled_points(&shares, 1e-9, 1 << 16, 0.95).unwrap();
        assert!(wide.hi - wide.lo > 2.0 * 3.6 / 65_536.0, "{wide:?}");
        assert_eq!(from_scrambled_points(&shares[..1], 0.0, 8, 0.95), None);
    }

    /// Every kind of whole numbers with which a few cells decide: how often the interval holds the mean, exactly, for numbers
    /// that are 0 or 1, and for a Poisson distribution in many tries.
    #[test]
    fn intervals_of_few_points_cover() {
        const POINTS: u64 = 1 << 13;
        let covers = |counts: &[f64; 8], mean: f64| {
            let each = POINTS as f64;
            let found = from_scrambled_points(&counts.map(|heads| (100.0 + heads) / each), 0.0, 8 * POINTS, 0.95);
            found.unwrap().0.contains((100.0 + mean) / each)
        };
        for part in 1..100 {
            let one = f64::from(part) / 100.0;
            let mut covered = 0.0;
            let mut ways = 1.0;
            for ones in 0..=8 {
                let counts = std::array::from_fn(|index| f64::from(u8::from(index < ones)));
                if covers(&counts, one) {
                    covered += ways * one.powi(ones as i32) * (1.0 - one).powi(8 - ones as i32);
                }
                ways *= (8 - ones) as f64 / (ones + 1) as f64;
            }
            assert!(covered >= 0.95, "{one}: {covered}");
        }
        let mut rng = ChaCha8Rng::seed_from_u64(15);
        for mean in [0.05_f64, 0.2, 0.5, 1.0, 2.0, 4.0, 8.0] {
            // Knuth's draw: how many uniform numbers it takes to multiply to less than exp(-mean).
            let mut drawn = || {
                let (mut product, mut number) = (rng.random_range(0.0..1.0), 0.0);
                while product > (-mean).exp() {
                    product *= rng.random_range(0.0..1.0);
                    number += 1.0;
                }
                number
            };
            let covered = (0..4000).filter(|_| covers(&std::array::from_fn(|_| drawn()), mean)).count();
            // With 94 %, fewer than 3680 of 4000 have a probability of 1e-7.
            assert!(covered >= 3680, "{mean}: {covered} of 4000");
        }
    }

    #[test]
    fn intervals_of_all_heads_or_all_tails_end_at_1_or_0() {
        // (tail)^(1/n) is the exact lower end for n of n.
        assert_interval(clopper_pearson(50, 50, 0.95), 0.025_f64.powf(1.0 / 50.0), 1.0, 1e-12);
        for points in 1..1000 {
            let [all, none] = [points, 0].map(|heads| clopper_pearson(heads, points, 0.95));
            assert_eq!((all.hi, none.lo), (1.0, 0.0), "{points}");
        }
    }

    #[test]
    fn ends_are_those_of_beta_distributions_for_any_number_of_launches() {
        // Quantiles of Beta distributions at 0.025 and 0.975, by mpmath with 30 digits.
        for (heads, points, lo, hi) in [
            (1, 1_000_000_000, 2.531_780_798_39e-11, 5.571_643_378_20e-9),
            (3, 262_144, 2.360_053_073_510_48e-6, 3.344_412_471_177_97e-5),
            (99, 1_000_000, 8.046_302_043_763_65e-5, 0.000_120_527_650_300_639),
            (100, 1_000_000, 8.136_470_874_160_14e-5, 0.000_121_625_478_571_245),
            (100, 200, 0.428_658_430_906_832, 0.571_341_569_093_168),
            (150, 1000, 0.128_424_811_116_173, 0.173_658_128_567_036),
            (163_840, 262_144, 0.623_143_469_942_042, 0.626_853_766_079_516),
            (999_750, 1_000_000, 0.999_717_016_962_75, 0.999_780_028_811_079),
            (1 << 35, 1 << 36, 0.499_996_261_658_098, 0.500_003_738_341_902),
        ] {
            let found = clopper_pearson(heads, points, 0.95);
            let share = heads as f64 / points as f64;
            for [found, exact] in [[found.lo, lo], [found.hi, hi]] {
                let ratio = (found - share) / (exact - share);
                let most = if heads.min(points - heads) < FEW_HEADS { 1.0 + 1e-6 } else { 1.003 };
                assert!((1.0 - 1e-6..most).contains(&ratio), "{heads} of {points}: {found}, not {exact}");
            }
        }
    }

    #[test]
    fn an_interval_contains_its_ends_and_nothing_outside() {
        let interval = Interval { lo: 0.25, hi: 0.5 };
        assert!([0.25, 0.3, 0.5].iter().all(|inside| interval.contains(*inside)));
        assert!([0.25_f64.next_down(), 0.5_f64.next_up(), f64::NAN].iter().all(|outside| !interval.contains(*outside)));
    }
}
