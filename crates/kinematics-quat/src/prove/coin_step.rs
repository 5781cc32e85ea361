//! Bounds of the error of one step by Taylor series, from the defect of its polynomials. The theorem and its proof are in
//! `docs/proofs/enclosure.md`, whose numbers of formulas stand here in brackets. Symbols are those of the file `taylor/coin.rs`.
//!
//! The coefficients of a step depend on |η|, c and q alone, of which c and q never change, and |η| changes in its last
//! bits. One bound therefore holds for all steps of a flight: it is computed once, for the largest |η| and the longest
//! step, with room for the smaller ones.

use numerics::UNIT_ROUNDOFF;
use numerics::lanes::{Real, Simd, SimdLevel, WithSimd};

use crate::taylor::coin::{COMPENSATED, Series};
use crate::taylor::lockstep::{MOST_LANES, PerLane};
use crate::taylor::plan::{LARGEST_ORDER, StepPlan};

/// What the bound of a step depends on.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Steps {
    /// The largest |η|.
    pub(crate) modulus: f64,
    /// By how much of itself |η| is less in other steps.
    pub(crate) spread: f64,
    /// c.
    pub(crate) half_z: f64,
    /// q.
    pub(crate) q: f64,
    /// The longest step.
    pub(crate) longest: f64,
}

/// Bounds of what one step adds to the error.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct StepBound {
    /// Of the turn, for its own η: the integral of the defect, with all rounding.
    pub(crate) turn: f64,
    /// Of the turn, because its η is a polynomial too: the integral of half the error of the rates.
    pub(crate) rates: f64,
    /// Of η, divided by |η|.
    pub(crate) eta: f64,
}

/// Roundings that the bounds do not count because they are of second order, or roundings of the bound itself.
const SLACK: f64 = 1.0 + 1e-9;

/// The bounds of many flights with the same `plan`, each with the same bits at every SIMD `level`.
pub(crate) fn bounds(plan: &StepPlan, level: SimdLevel, steps: &[Steps]) -> Vec<StepBound> {
    level.run(Kernel { plan, steps })
}

struct Kernel<'a> {
    plan: &'a StepPlan,
    steps: &'a [Steps],
}

impl WithSimd for Kernel<'_> {
    type Output = Vec<StepBound>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<StepBound> {
        let mut found = Vec::with_capacity(self.steps.len());
        let mut series = Series::new(simd);
        for chunk in self.steps.chunks(S::F64_LANES) {
            let mut lanes = Lanes::default();
            for (lane, steps) in chunk.iter().enumerate() {
                let parts = [steps.modulus, steps.spread, steps.half_z, steps.q, steps.longest];
                parts.into_iter().zip(&mut lanes.0).for_each(|(part, lanes)| lanes[lane] = part);
            }
            let [turn, rates, eta] = lanes.bounds(simd, self.plan, &mut series);
            let of = |lane: usize| StepBound { turn: turn[lane], rates: rates[lane], eta: eta[lane] };
            found.extend((0..chunk.len()).map(of));
        }
        found
    }
}

/// The fields of [`Steps`], in their order.
#[derive(Default)]
#[repr(align(64))]
struct Lanes([PerLane; 5]);

impl Lanes {
    #[inline(always)]
    fn bounds<S: Simd>(&self, simd: S, plan: &StepPlan, series: &mut Series<S>) -> [PerLane; 3] {
        let [modulus, spread, half_z, q, longest] = self.0.each_ref().map(|part| Real::load(simd, part));
        series.expand_eta(plan.order, q);
        series.expand(plan.order, modulus, half_z);
        let terms = Terms::new(series, plan.order, [modulus, half_z, q, longest], spread);
        let mut stored = [[0.0; MOST_LANES]; 3];
        let found = [terms.turn(spread), terms.rates(), terms.eta(plan.compensates)];
        found.into_iter().zip(&mut stored).for_each(|(bound, lanes)| (bound * bound.constant(SLACK)).store(lanes));
        stored
    }
}

/// As many numbers as a series has coefficients.
type Numbers<S> = [Real<S>; LARGEST_ORDER + 1];

/// The terms of the series at the end of the longest step h: each coefficient of tᵏ times hᵏ.
struct Terms<S: Simd> {
    order: usize,
    u: Numbers<S>,
    w: Numbers<S>,
    r: Numbers<S>,
    /// |r|.
    size_of_r: Numbers<S>,
    /// A bound of |u| + |w| in every step.
    size: Numbers<S>,
    /// A bound of how much u and w differ from those of another step.
    change: Numbers<S>,
    /// The rounding of the coefficients of all steps, in units of u (6).
    rounding: Real<S>,
    /// |η| h, c h, |q| h.
    turns: [Real<S>; 3],
}

impl<S: Simd> Terms<S> {
    #[inline(always)]
    fn new(series: &Series<S>, order: usize, [modulus, half_z, q, h]: [Real<S>; 4], spread: Real<S>) -> Self {
        let zero = h.constant(0.0);
        let none = [zero; LARGEST_ORDER + 1];
        let turns = [modulus * h, half_z * h, q.abs() * h];
        let mut terms =
            Self { order, u: none, w: none, r: none, size_of_r: none, size: none, change: none, rounding: zero, turns };
        let mut power = h.constant(1.0);
        for k in 0..=order {
            (terms.u[k], terms.w[k], terms.r[k]) = (series.u[k] * power, series.w[k] * power, series.r[k] * power);
            terms.size_of_r[k] = terms.r[k].abs();
            power = power * h;
        }
        let level = half_z.mul_add(h, q * h * h.constant(0.5));
        terms.compare(level.mul_add(level, turns[0] * turns[0]).sqrt(), spread);
        terms
    }

    /// Computes `size`, `change` and `rounding` by the recurrence (9), with Λ h = `fastest`. The rounding of a coefficient
    /// changes the later ones at most by the terms of e^(ν t), and |η| by those of e^(μ t).
    #[inline(always)]
    fn compare(&mut self, fastest: Real<S>, spread: Real<S>) {
        let ([eta, c, q], constant) = (self.turns, |value: f64| spread.constant(value));
        let [nu, mu] = [fastest + q, q.mul_add(constant(0.5), fastest)];
        let zero = constant(0.0);
        let (mut lost, mut of_nu) = ([zero; LARGEST_ORDER + 1], [zero; LARGEST_ORDER + 1]);
        (of_nu[0], self.size[0]) = (constant(1.0), constant(1.0));
        let mut of_mu = constant(1.0);
        for n in 0..self.order {
            let (products, place) = (eta * convolution(&self.size, &self.size_of_r, 0, n), over(eta, n + 1));
            let of_c = self.size[n] * c.abs() * constant(3.0);
            lost[n] = products.mul_add(constant(3.5 * n as f64 + 6.5), of_c) * place;
            let shares = products.mul_add(constant(0.5 * n as f64 + 6.5), of_c) * place;
            self.rounding = self.rounding + shares;
            let of_rounding = convolution(&lost, &of_nu, 0, n) * constant(2.0 * UNIT_ROUNDOFF);
            // √2, because the sum of two sizes is no more than that times the size of the pair.
            self.change[n + 1] = (spread * eta).mul_add(of_mu, of_rounding) * constant(1.4143);
            self.size[n + 1] = self.u[n + 1].abs() + self.w[n + 1].abs() + self.change[n + 1];
            of_mu = of_mu * mu * place;
            of_nu[n + 1] = of_nu[n] * nu * place;
        }
    }

    /// The bound of the turn: (6) + (7) + (8).
    #[inline(always)]
    fn turn(&self, spread: Real<S>) -> Real<S> {
        let (constant, mut sum) = (|value: f64| spread.constant(value), self.rounding + spread.constant(16.0));
        for (k, size) in self.size[..=self.order].iter().enumerate() {
            sum = size.mul_add(constant((k + 1) as f64), sum);
        }
        sum.mul_add(constant(UNIT_ROUNDOFF), self.dropped(spread))
    }

    /// A bound (7) of the integral of the products that the truncated series leave out, in every step.
    #[inline(always)]
    fn dropped(&self, spread: Real<S>) -> Real<S> {
        let ([eta, c, _], p) = (self.turns, self.order);
        let off = spread + spread.constant(40.0 * UNIT_ROUNDOFF);
        let mut change = self.change;
        for (change, size) in change[..=p].iter_mut().zip(&self.size) {
            *change = size.mul_add(off, *change);
        }
        let mut sum = eta.constant(0.0);
        for n in p..=2 * p {
            let first = n - p;
            let mut of_u = eta * convolution(&self.w, &self.r, first, n);
            let mut of_w = -(eta * convolution(&self.u, &self.r, first, n));
            let mut differs = eta * convolution(&change, &self.size_of_r, first, n);
            if n == p {
                (of_u, of_w) = (self.u[p].mul_add(c, of_u), self.w[p].mul_add(c, of_w));
                differs = change[p].mul_add(c.abs(), differs);
            }
            sum = (of_u.abs() + of_w.abs() + differs).mul_add(over(eta, n + 1), sum);
        }
        sum
    }

    /// The bound (5) of what the error of η does to the turn within the step.
    #[inline(always)]
    fn rates(&self) -> Real<S> {
        let ([eta, _, q], p) = (self.turns, self.order);
        let mut sum = eta.constant(0.0);
        for k in 1..=p {
            sum = self.size_of_r[k].mul_add(over(eta, k + 1), sum);
        }
        let truncated = q * self.size_of_r[p] * over(eta, p + 1) * over(eta, p + 2);
        eta * sum.mul_add(eta.constant(3.0 * UNIT_ROUNDOFF), truncated)
    }

    /// The bound (10) of the error of η/|η|.
    #[inline(always)]
    fn eta(&self, compensates: bool) -> Real<S> {
        let ([eta, _, q], p) = (self.turns, self.order);
        let constant = |value: f64| eta.constant(value);
        let (mut sum, mut all) = (constant(0.0), constant(0.0));
        let from = if compensates { COMPENSATED } else { 0 };
        for k in 0..=p {
            all = all + self.size_of_r[k];
            if k >= from {
                sum = self.size_of_r[k].mul_add(constant((k + 5 - from) as f64), sum);
            }
        }
        let rest = if compensates { all * constant(1e5 * UNIT_ROUNDOFF) } else { constant(3.0) };
        (sum + rest).mul_add(constant(UNIT_ROUNDOFF), q * self.size_of_r[p] * over(eta, p + 1))
    }
}

/// Σ aᵢ bₙ₋ᵢ for i from `first` to n - `first`.
#[inline(always)]
fn convolution<S: Simd>(a: &Numbers<S>, b: &Numbers<S>, first: usize, n: usize) -> Real<S> {
    let (a, b) = (&a[first..=n - first], &b[first..=n - first]);
    let zero = a[0].constant(0.0);
    let mut sums = [zero; 2];
    let pairs = a.len() / 2;
    for (a, b) in a[..2 * pairs].chunks_exact(2).zip(b.rchunks_exact(2)) {
        sums = [a[0].mul_add(b[1], sums[0]), a[1].mul_add(b[0], sums[1])];
    }
    if a.len() % 2 == 1 {
        sums[0] = a[a.len() - 1].mul_add(b[0], sums[0]);
    }
    sums[0] + sums[1]
}

/// 1/n.
#[inline(always)]
fn over<S: Simd>(like: Real<S>, n: usize) -> Real<S> {
    like.constant(1.0 / n as f64)
}

#[cfg(test)]
mod tests;
