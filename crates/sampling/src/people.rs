//! What the counts of several people say about people like them: the mean probability over people, how much people differ,
//! and where the probability of a further person lies. Flips of one person say nothing about another hand, so the people
//! are the sample, and each counts once.
//!
//! The model is the beta-binomial distribution: the probability of a person is Beta(μφ, (1 - μ)φ) with the mean μ over
//! people and the standard deviation √(μ(1 - μ)/(1 + φ)), and φ = ∞ means that all are alike. With person i having x_i of
//! n_i landings on the same side, and G(z, m) = ln Γ(z + m) - ln Γ(z) - m ln z, the logarithm of the likelihood is, but for
//! a constant,
//!
//! ```text
//! ℓ(μ, φ) = Σ [ x_i ln μ + (n_i - x_i) ln(1 - μ) + G(μφ, x_i) + G((1 - μ)φ, n_i - x_i) - G(φ, n_i) ].
//! ```
//!
//! # Mean over people
//! The estimate is the μ of the largest ℓ. The interval ends where 2 (max ℓ - max over φ of ℓ) = c. For k normal numbers
//! of unknown variance this is Student's interval if c = k ln(1 + t²/(k - 1)), where t is Student's quantile with k - 1
//! degrees of freedom. People are more skewed than normal numbers, and the quantile for 97 % makes an interval that holds
//! 95 %.
//!
//! One person with far more flips than the others would be taken for the mean, as φ is not known. So a second interval counts
//! nobody for more than twice the median number of flips, with k replaced by the mean of k and (Σ n)²/Σ n². The result
//! spans both intervals and that of Clopper and Pearson, which covers people who are all alike.
//!
//! In a table of 1176 kinds of files (2 to 60 people, six ways to share the flips among them, μ from 0.5 to 0.999,
//! standard deviations of 0 to 0.1) with 3000 random files each, it held in at least 95.9 % of the files of each kind. It is a
//! measured level, not a theorem: three people of two kinds can't be seen to be of two kinds, and such files held in 74 %.
//!
//! Sources: J. G. Skellam, J. R. Stat. Soc. B 10 (1948), 257, for the distribution; R. B. Dawson, Biometrika 41 (1954), for
//! the moments of X².

use std::iter::once;

use libm::{exp, lgamma, log, log1p, sqrt};
use statrs::distribution::{Beta, ChiSquared, ContinuousCDF, Normal, StudentsT};

use crate::estimate::LEVEL;
use crate::interval::Interval;

/// Level of Student's quantile at which the interval of people as skewed as those of arXiv 2310.04153 holds [`LEVEL`].
pub(crate) const STUDENT: f64 = 0.97;
/// The smallest ln φ, a standard deviation of 0.998 of the largest that a mean allows.
const LOWEST: f64 = -5.0;
/// The largest ln φ, a standard deviation of at most 1.7e-4. People who differ by less count as alike.
const HIGHEST: f64 = 16.0;
/// Beyond this distance of ln(μ/(1 - μ)) from 0 rounding hides the difference from 0 or 1.
const FARTHEST: f64 = 36.5;
/// A log-likelihood that is larger by less is not larger: this is above its rounding error for real counts.
const NOISE: f64 = 1e-9;
/// The width at which the search of a place ends; of ln φ where only the value counts, which is flat there.
const FINE: f64 = 1e-8;
const COARSE: f64 = 1e-5;

/// How much people differ.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Spread {
    /// Standard deviation of the probability over people.
    pub sd: f64,
    /// Interval of the standard deviation, at the confidence [`LEVEL`]. Its upper end says what the counts can't rule out.
    pub interval: Interval,
    /// Pearson's X² of the hypothesis that all people are alike.
    pub chi2: f64,
    /// Probability of an X² this large or larger if all people are alike.
    pub p_value: f64,
}

/// The counts of at least two people, each with at least one flip.
pub(crate) struct People {
    /// Landings on the same side and flips, which are not whole where a person counts for fewer.
    counts: Vec<[f64; 2]>,
    same: f64,
    tosses: f64,
    /// How many people these are.
    number: f64,
}

/// A mean μ over people, with 1 - μ to full precision.
#[derive(Clone, Copy)]
struct Mean {
    same: f64,
    other: f64,
}

impl Mean {
    fn of_logit(logit: f64) -> Self {
        Self { same: 1.0 / (1.0 + exp(-logit)), other: 1.0 / (1.0 + exp(logit)) }
    }

    /// μ (1 - μ).
    fn variance(self) -> f64 {
        self.same * self.other
    }
}

/// The best of a search: where a function is largest, and how large.
#[derive(Clone, Copy)]
struct Best {
    value: f64,
    at: f64,
}

impl Best {
    fn or(self, other: Self) -> Self {
        if other.value > self.value { other } else { self }
    }
}

impl People {
    /// People of whom each has `[same, tosses]`. In whichever order they come, the result has the same bits.
    pub(crate) fn new(mut counts: Vec<[f64; 2]>) -> Self {
        counts.sort_unstable_by(|[same, tosses], [x, n]| tosses.total_cmp(n).then(same.total_cmp(x)));
        #[expect(clippy::cast_precision_loss, reason = "fewer people than 2^53")]
        let number = counts.len() as f64;
        let [same, tosses] = [0, 1].map(|part| counts.iter().map(|count| count[part]).sum());
        Self { counts, same, tosses, number }
    }

    /// The same people with nobody counted for more than twice the median number of flips, and how many people they are worth.
    fn capped(&self) -> (Self, f64) {
        let middle = |rounded: usize| self.counts[rounded / 2][1];
        let cap = middle(self.counts.len() - 1) + middle(self.counts.len());
        let capped = Self::new(self.counts.iter().map(|[x, n]| [x * n.min(cap) / n, n.min(cap)]).collect());
        let squares: f64 = capped.counts.iter().map(|[_, n]| n * n).sum();
        let effective = (capped.tosses * capped.tosses / squares).max(2.0);
        (capped, 0.5 * (self.number + effective))
    }

    fn mean_share(&self) -> f64 {
        self.counts.iter().map(|[x, n]| x / n).sum::<f64>() / self.number
    }

    /// Whether all landings are the same.
    fn is_unanimous(&self) -> bool {
        self.same <= 0.0 || self.same >= self.tosses
    }

    /// ℓ at `mean` and ln φ; `None` if all people are alike.
    fn log_likelihood(&self, mean: Mean, ln_phi: Option<f64>) -> f64 {
        let product = |count: f64, probability: f64| if count > 0.0 { count * log(probability) } else { 0.0 };
        let alike = product(self.same, mean.same) + product(self.tosses - self.same, mean.other);
        let Some(phi) = ln_phi.map(exp) else { return alike };
        let [same, other, all] = [mean.same * phi, mean.other * phi, phi].map(Rising::new);
        alike + self.counts.iter().map(|[x, n]| same.of(*x) + other.of(n - x) - all.of(*n)).sum::<f64>()
    }

    /// The largest ℓ at `mean`.
    fn over_phi(&self, mean: Mean) -> f64 {
        let apart = highest(|l| self.log_likelihood(mean, Some(l)), [LOWEST, HIGHEST], 21, COARSE);
        apart.value.max(self.log_likelihood(mean, None))
    }

    /// The mean over people with its interval, which contains `pooled`, the interval of all tosses together.
    pub(crate) fn mean(&self, pooled: Interval) -> (f64, Interval) {
        let (mean, all) = self.profile(self.number);
        let (capped, worth) = self.capped();
        (mean, hull([pooled, all, capped.profile(worth).1]))
    }

    /// The mean over people, and where the largest ℓ at a mean is by the cut of `number` people below the largest of all.
    fn profile(&self, number: f64) -> (f64, Interval) {
        let f = |logit: f64| self.over_phi(Mean::of_logit(logit));
        let (top, mean) = match self.is_unanimous() {
            // ℓ is 0 at a mean of 0 or 1, which no other exceeds.
            true if self.same > 0.0 => (Best { value: 0.0, at: FARTHEST - 0.5 }, 1.0),
            true => (Best { value: 0.0, at: 0.5 - FARTHEST }, 0.0),
            false => self.top(f),
        };
        let student = StudentsT::new(0.0, 1.0, number - 1.0);
        let t = student.map_or(f64::INFINITY, |student| student.inverse_cdf(0.5 * (1.0 + STUDENT)));
        let cut = number * log1p(t * t / (number - 1.0));
        let is_inside = |logit: f64| 2.0 * (top.value - f(logit)) <= cut;
        let end = |side: f64| {
            let (mut inner, mut step) = (top.at, 0.01);
            loop {
                let outer = inner + side * step;
                if outer.abs() > FARTHEST {
                    return if side < 0.0 { 0.0 } else { 1.0 };
                }
                if !is_inside(outer) {
                    return Mean::of_logit(border(is_inside, inner, outer)).same;
                }
                (inner, step) = (outer, 2.0 * step);
            }
        };
        (mean, Interval { lo: end(-1.0), hi: end(1.0) })
    }

    /// Where `f`, the largest ℓ at a logit, is largest, and the mean there. A person with most of the flips makes two hills,
    /// one at the share of all flips and one near the mean share of people.
    fn top(&self, f: impl Fn(f64) -> f64) -> (Best, f64) {
        let logit = |share: f64| log(share / (1.0 - share));
        let (pooled, people) = (logit(self.same / self.tosses), logit(self.mean_share()));
        let range = [pooled.min(people) - 0.5, pooled.max(people) + 0.5];
        let near = |at: f64| golden(&f, [at - 0.05, at + 0.05], FINE);
        let top = highest(&f, range, 24, FINE).or(near(pooled)).or(near(people));
        // The search finds a place to the root of the precision only. The share of all flips is often the exact one.
        let exact = Best { value: f(pooled), at: pooled };
        if exact.value >= top.value - NOISE.min(8.0 * f64::EPSILON * top.value.abs()) {
            return (exact, self.same / self.tosses);
        }
        (top, Mean::of_logit(top.at).same)
    }

    /// How much the people differ; `None` if all landings are the same, which says nothing about it.
    pub(crate) fn spread(&self) -> Option<Spread> {
        if self.is_unanimous() {
            return None;
        }
        let (sd, all) = self.deviation()?;
        let interval = hull([all, self.capped().0.deviation()?.1]);
        let (chi2, p_value) = self.homogeneity();
        Some(Spread { sd: sd.clamp(interval.lo, interval.hi), interval, chi2, p_value })
    }

    /// The largest ℓ at ln φ, and its mean.
    fn over_mean(&self, ln_phi: Option<f64>) -> (f64, Mean) {
        let Some(_) = ln_phi else {
            let mean = Mean { same: self.same / self.tosses, other: (self.tosses - self.same) / self.tosses };
            return (self.log_likelihood(mean, None), mean);
        };
        let odds = |same: f64, other: f64, more: f64| log((same + more) / (other + more));
        let share = self.mean_share();
        let [pooled, people] = [odds(self.same, self.tosses - self.same, 0.25), odds(share, 1.0 - share, 1e-3)];
        let range = [pooled.min(people) - 1.5, pooled.max(people) + 1.5];
        let best = golden(|logit| self.log_likelihood(Mean::of_logit(logit), ln_phi), range, FINE);
        (best.value, Mean::of_logit(best.at))
    }

    /// The standard deviation between people, and its interval: where 2 (max ℓ - max over μ of ℓ) reaches
    /// k (z - 1 - ln z) with z the quantile of χ² over k, which for k normal numbers is the usual interval of a variance.
    fn deviation(&self) -> Option<(f64, Interval)> {
        let of = |l: f64| sqrt(self.over_mean(Some(l)).1.variance() / (1.0 + exp(l)));
        let k = self.number;
        let chi2 = ChiSquared::new(k - 1.0).ok()?;
        let cut = |part: f64| {
            let z = chi2.inverse_cdf(part) / k;
            k * (z - 1.0 - log(z))
        };
        let tail = 0.5 * (1.0 - LEVEL);
        let f = |l: f64| self.over_mean(Some(l)).0;
        let (best, alike) = (highest(f, [LOWEST, HIGHEST], 42, COARSE), self.over_mean(None).0);
        let (top, at) = if alike >= best.value - NOISE { (alike, None) } else { (best.value, Some(best.at)) };
        let end = |side: f64, cut: f64| {
            let is_inside = |l: f64| 2.0 * (top - f(l)) <= cut;
            let mut inner = at.unwrap_or(HIGHEST);
            loop {
                let outer = (inner + side * 0.25).clamp(LOWEST, HIGHEST);
                if !is_inside(outer) {
                    return Some(border(is_inside, inner, outer));
                }
                if outer <= LOWEST || outer >= HIGHEST && side > 0.0 {
                    return None;
                }
                inner = outer;
            }
        };
        let below = cut(1.0 - tail);
        let lo = if 2.0 * (top - alike) <= below { 0.0 } else { of(end(1.0, below).unwrap_or(HIGHEST)) };
        // No probability deviates by more than 1/2.
        let hi = end(-1.0, cut(tail)).map_or(0.5, of);
        let sd = at.map_or(0.0, |l| of(l) * sqrt(k / (k - 1.0)));
        Some((sd.clamp(lo, hi), Interval { lo, hi }))
    }

    /// Pearson's X² and its p-value. Given the sums, the mean e of X² and its variance are exact (Dawson), and 2e/variance
    /// times X² is taken as χ² of the same two moments.
    fn homogeneity(&self) -> (f64, f64) {
        let Self { same, tosses: n, number: k, .. } = *self;
        let share = same / n;
        let squares = self.counts.iter().map(|[x, n]| (x - n * share).powi(2) / n);
        let x2 = squares.sum::<f64>() / (share * (1.0 - share));
        if same.min(n - same) < 2.0 {
            // A single landing shows no difference.
            return (x2, 1.0);
        }
        let e = (k - 1.0) * n / (n - 1.0);
        let [v, w] = [(n - 2.0) / (n - 1.0), (n * (1.0 / same + 1.0 / (n - same)) - 4.0) / (n - 2.0)];
        let inverses: f64 = self.counts.iter().map(|[_, n]| 1.0 / n).sum();
        let [v2, w2] = [(k - 1.0) * (n - k) / (n - 1.0), (n * inverses - k * k) / (n - 2.0)];
        let variance = 2.0 * n / (n - 3.0) * (v - w) * (v2 - w2) + n * n / (n - 1.0) * w * w2;
        // The sums of few flips leave a single X², whose variance is 0 but for rounding.
        let chi2 = if variance > 1e-9 * e * e { ChiSquared::new(2.0 * e * e / variance).ok() } else { None };
        (x2, chi2.map_or(1.0, |chi2| chi2.sf(x2 * 2.0 * e / variance).clamp(0.0, 1.0)))
    }

    /// The interval that contains the probability of a further person at the confidence [`LEVEL`]; `None` for two people,
    /// who say nothing of a third.
    pub(crate) fn next_person(&self) -> Option<Interval> {
        if self.counts.len() < 3 {
            return None;
        }
        let tail = 0.5 * (1.0 - LEVEL);
        let parts = self.parts();
        let all: f64 = parts.iter().map(|part| part.weight).sum();
        let below = |x: f64| parts.iter().map(|part| part.weight / all * part.below(x)).sum::<f64>();
        let [lo, hi] = [tail, 1.0 - tail].map(|part| border(|x| below(x) < part, 0.0, 1.0));
        let has = |all: bool| self.counts.iter().any(|[x, n]| if all { x == n } else { *x == 0.0 });
        let lo = if lo < 0.01 && has(false) { 0.0 } else { lo };
        let hi = if hi > 0.99 && has(true) { 1.0 } else { hi };
        Some(Interval { lo, hi })
    }

    /// The distribution of a further person's probability, as a mixture over ln φ with a flat prior for the standard deviation in
    /// relation to the largest that the mean allows.
    fn parts(&self) -> Vec<Part> {
        const STEP: f64 = 0.5;
        const FIRST: f64 = -3.0;
        // Half a landing on the other side, so that the mean is within 0 and 1.
        let nudge = match self.is_unanimous() {
            true if self.same > 0.0 => -0.5 / self.number,
            true => 0.5 / self.number,
            false => 0.0,
        };
        let nudged = Self::new(self.counts.iter().map(|[x, n]| [x + nudge, *n]).collect());
        let relative = |l: f64| 1.0 / sqrt(1.0 + exp(l.clamp(FIRST, HIGHEST)));
        let part = |l: f64| {
            let (value, mean) = nudged.over_mean(Some(l));
            let between = mean.variance() / (1.0 + exp(l));
            let within = (mean.variance() - between).max(1e-12);
            let information: f64 = nudged.counts.iter().map(|[_, n]| 1.0 / (between + within / n)).sum();
            let prior = relative(l - STEP) - relative(l + STEP);
            let variance = (between + 1.0 / information).min(0.98 * mean.variance());
            (value, Part::new(prior / sqrt(information), mean, variance))
        };
        let parts: Vec<(f64, Part)> = (0..=38).map(|step| part(FIRST + STEP * f64::from(step))).collect();
        let top = parts.iter().map(|(value, _)| *value).fold(f64::NEG_INFINITY, f64::max);
        parts.into_iter().map(|(value, part)| Part { weight: part.weight * exp(value - top), ..part }).collect()
    }
}

/// A part of a mixture of distributions of a probability.
struct Part {
    weight: f64,
    distribution: Distribution,
}

enum Distribution {
    Beta(Beta),
    Normal(Normal),
    Certain(f64),
}

impl Part {
    fn new(weight: f64, mean: Mean, variance: f64) -> Self {
        /// With larger parameters, the distribution function of Beta would need more terms than are summed up.
        const MANY: f64 = 1e6;
        /// With so large ones, a distribution of Beta is normal.
        const NORMAL: f64 = 1e3;
        let phi = mean.variance() / variance - 1.0;
        let (a, b) = (mean.same * phi, mean.other * phi);
        let beta = || Beta::new(a, b).map(Distribution::Beta);
        let normal = || Normal::new(mean.same, sqrt(variance)).map(Distribution::Normal);
        let distribution = if phi > MANY && a.min(b) > NORMAL { normal().ok() } else { beta().ok() };
        Self { weight, distribution: distribution.unwrap_or(Distribution::Certain(mean.same)) }
    }

    /// The probability of a value of at most `x`.
    fn below(&self, x: f64) -> f64 {
        match &self.distribution {
            Distribution::Beta(beta) => beta.cdf(x),
            Distribution::Normal(normal) => normal.cdf(x),
            Distribution::Certain(value) => f64::from(u8::from(x >= *value)),
        }
    }
}

/// G(z, m) = ln Γ(z + m) - ln Γ(z) - m ln z, the logarithm of (1 + 1/z)(1 + 2/z) … (1 + (m - 1)/z) for a whole m. For a large z
/// by Stirling's series, as the difference of the gamma functions would lose its digits.
struct Rising {
    z: f64,
    /// Of a small z, ln Γ(z) and ln z; of a large one, the rest of Stirling's series.
    known: Result<f64, [f64; 2]>,
}

impl Rising {
    fn new(z: f64) -> Self {
        /// From here on the first term that [`stirling_rest`] leaves out is below 1e-15.
        const LARGE: f64 = 10.0;
        Self { z, known: if z >= LARGE { Ok(stirling_rest(z)) } else { Err([lgamma(z), log(z)]) } }
    }

    fn of(&self, m: f64) -> f64 {
        if m == 0.0 {
            return 0.0;
        }
        let sum = self.z + m;
        match self.known {
            Ok(rest) => (sum - 0.5) * log1p(m / self.z) - m + (stirling_rest(sum) - rest),
            Err([gamma, ln]) => lgamma(sum) - gamma - m * ln,
        }
    }
}

/// ln Γ(z) - (z - ½) ln z + z - ½ ln 2π.
fn stirling_rest(z: f64) -> f64 {
    const TERMS: [f64; 6] = [1.0 / 12.0, -1.0 / 360.0, 1.0 / 1260.0, -1.0 / 1680.0, 1.0 / 1188.0, -691.0 / 360_360.0];
    let inverse = 1.0 / z;
    TERMS.iter().rev().fold(0.0, |sum, term| sum * inverse * inverse + term) * inverse
}

/// The interval that spans `intervals`.
fn hull(intervals: impl IntoIterator<Item = Interval>) -> Interval {
    let span = |one: Interval, other: Interval| Interval { lo: one.lo.min(other.lo), hi: one.hi.max(other.hi) };
    intervals.into_iter().reduce(span).unwrap_or(Interval { lo: 0.0, hi: 1.0 })
}

/// Where `f`, which has one hill in the range, is largest, by the golden section.
fn golden(f: impl Fn(f64) -> f64, [mut lo, mut hi]: [f64; 2], width: f64) -> Best {
    const SECTION: f64 = 0.618_033_988_749_894_9;
    let near = |end: f64, other: f64| {
        let at = end + (1.0 - SECTION) * (other - end);
        Best { value: f(at), at }
    };
    let (mut left, mut right) = (near(lo, hi), near(hi, lo));
    while hi - lo > width {
        if left.value > right.value {
            (hi, right) = (right.at, left);
            left = near(lo, hi);
        } else {
            (lo, left) = (left.at, right);
            right = near(hi, lo);
        }
    }
    right.or(left)
}

/// Where `f` is largest, with a grid of `cells` to tell several hills apart.
fn highest(f: impl Fn(f64) -> f64, [lo, hi]: [f64; 2], cells: u32, width: f64) -> Best {
    let step = (hi - lo) / f64::from(cells);
    let nodes = (0..=cells).map(|cell| lo + f64::from(cell) * step).map(|at| Best { value: f(at), at });
    let top = nodes.fold(Best { value: f64::NEG_INFINITY, at: lo }, Best::or);
    once(golden(&f, [(top.at - step).max(lo), (top.at + step).min(hi)], width)).fold(top, Best::or)
}

/// The border of what `is_inside`, between a place that is and one that is not.
fn border(is_inside: impl Fn(f64) -> bool, mut inside: f64, mut outside: f64) -> f64 {
    for _ in 0..48 {
        let middle = 0.5 * (inside + outside);
        if is_inside(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    0.5 * (inside + outside)
}
