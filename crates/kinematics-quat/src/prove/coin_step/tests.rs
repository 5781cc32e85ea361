//! Tests of the roundings of one step of a coin, against the same series in double-double numbers: each bound holds, and is
//! not far above what random steps show.

use numerics::{DoubleDouble, UNIT_ROUNDOFF};

use super::*;
use crate::taylor::plan::StepPlans;

/// |η|, c, q and the length of a step.
type Inputs = [f64; 4];

/// The coefficients U, W and r of a step, in this order.
type Coefficients<T> = [Vec<T>; 3];

/// Rates and steps as in flights, spread evenly.
fn inputs(number: u32, longest: f64) -> impl Iterator<Item = Inputs> {
    (1..=number).map(move |index| {
        let part = |square: f64| (f64::from(index) * square.sqrt()).fract();
        [part(2.0), 2.0 * part(3.0) - 1.0, 2.0 * part(5.0) - 1.0, longest * (0.5 + 0.5 * part(7.0))]
    })
}

/// The coefficients in double-double.
fn exactly([modulus, half_z, q, _]: Inputs, order: usize) -> Coefficients<DoubleDouble> {
    let like = |value: f64| DoubleDouble::from(value);
    let (mut u, mut w, mut r) = (vec![like(1.0)], vec![like(0.0)], vec![like(1.0)]);
    for k in 0..order {
        let products = |a: &[DoubleDouble]| {
            let sum = a.iter().zip(r.iter().rev()).fold(DoubleDouble::ZERO, |sum, (a, r)| sum + *a * *r);
            sum * if k % 2 == 0 { modulus } else { -modulus }
        };
        let next = [products(&w) + u[k] * half_z, w[k] * half_z - products(&u), r[k] * q]
            .map(|sum| sum * DoubleDouble::quotient(1.0, (k + 1) as f64));
        u.push(next[0]);
        w.push(next[1]);
        r.push(next[2]);
    }
    [u, w, r]
}

/// u, v and η/|η| after the step, as six numbers.
fn summed([u, w, r]: &Coefficients<DoubleDouble>, h: f64) -> [DoubleDouble; 6] {
    let power = |order: usize| (0..order).fold(DoubleDouble::from(1.0), |power, _| power * h);
    let alternating = |terms: &[DoubleDouble], first: usize| {
        (first..terms.len()).step_by(2).fold(DoubleDouble::ZERO, |sum, n| {
            let term = terms[n] * power(n);
            if (n - first).is_multiple_of(4) { sum + term } else { sum - term }
        })
    };
    let [of_u, of_w, of_r] = [u, w, r].map(|terms| [0, 1].map(|first| alternating(terms, first)));
    [of_u[0], of_u[1], -of_w[1], -of_w[0], of_r[0], of_r[1]]
}

/// One step in f64.
struct Step(Inputs, usize);

impl WithSimd for Step {
    type Output = (Coefficients<f64>, [f64; 6]);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> (Coefficients<f64>, [f64; 6]) {
        let Self(inputs, order) = self;
        let [modulus, half_z, q, h] = inputs.map(|value| Real::splat(simd, value));
        let mut series = Series::new(simd);
        series.expand_eta(order, q);
        series.expand(order, modulus, half_z);
        let [[a, b], [c, d]] = series.turn(order, h);
        let [e, f] = series.turn_of_eta(order, h);
        let each = |terms: &[Real<S>]| terms[..=order].iter().copied().map(Real::first).collect();
        ([each(&series.u), each(&series.w), each(&series.r)], [a, b, c, d, e, f].map(Real::first))
    }
}

/// The largest rounding of the turn and of η in steps of at most this length, divided by their bounds without what belongs
/// to products with other numbers.
fn shares(longest: f64) -> [f64; 2] {
    let (level, mut largest) = (SimdLevel::widest(), [0.0_f64; 2]);
    for inputs in inputs(1000, longest) {
        let [modulus, half_z, q, h] = inputs;
        let (_, found) = level.run(Step(inputs, LARGEST_ORDER));
        let exact = summed(&exactly(inputs, 40), h);
        let off: Vec<f64> = exact.iter().zip(found).map(|(exact, found)| (*exact - found.into()).hi()).collect();
        let size = |parts: &[f64]| parts.iter().map(|part| part * part).sum::<f64>().sqrt();
        let plans = StepPlans::fixed(LARGEST_ORDER, h);
        let steps = Steps { modulus, spread: 0.0, half_z, q, longest: h };
        let bound = bounds(plans.of(false), level, &[steps])[0];
        let turn = bound.turn + bound.rates - 16.0 * UNIT_ROUNDOFF;
        largest[0] = largest[0].max(size(&off[..4]) / turn);
        largest[1] = largest[1].max(size(&off[4..]) / (bound.eta - 7.0 * UNIT_ROUNDOFF));
    }
    largest
}

#[test]
fn roundings_are_within_their_bounds_and_not_far_below() {
    for longest in [0.05, 0.5, 2.0, 4.0] {
        let shares = shares(longest);

        assert!(shares.iter().all(|share| (0.25..=1.0).contains(share)), "{longest}: {shares:?}");
    }
}

/// (6) in units of u, each Δₙ of (9), (6) + (7) + (8), and what (7) has of differences alone, of steps whose |η| differs by
/// this part of itself.
struct Bounds(Inputs, usize, f64);

impl WithSimd for Bounds {
    type Output = (f64, Vec<f64>, [f64; 2]);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> (f64, Vec<f64>, [f64; 2]) {
        let Self(inputs, order, spread) = self;
        let [modulus, half_z, q, h] = inputs.map(|value| Real::splat(simd, value));
        let spread = modulus.constant(spread);
        let mut series = Series::new(simd);
        series.expand_eta(order, q);
        series.expand(order, modulus, half_z);
        let mut terms = Terms::new(&series, order, [modulus, half_z, q, h], spread);
        let change = terms.change[..=order].iter().copied().map(Real::first).collect();
        let turn = terms.turn(spread).first();
        (terms.u, terms.w) = ([spread.constant(0.0); LARGEST_ORDER + 1], [spread.constant(0.0); LARGEST_ORDER + 1]);
        (terms.rounding.first(), change, [turn, terms.dropped(spread).first()])
    }
}

/// Of low orders too, at which what the series leave out is the larger part.
#[test]
fn the_bounds_of_eta_are_those_of_the_theorem() {
    let plain = [2, 6, 12, LARGEST_ORDER].map(|order| (order, false));
    for (order, compensates) in plain.into_iter().chain([(12, true), (LARGEST_ORDER, true)]) {
        for inputs in inputs(20, 2.0) {
            let [modulus, half_z, q, h] = inputs;
            let steps = Steps { modulus, spread: 0.0, half_z, q, longest: h };
            let mut plan = *StepPlans::fixed(order, h).of(false);
            plan.compensates = compensates;
            let bound = bounds(&plan, SimdLevel::widest(), &[steps])[0];
            let turn = q.abs() * h;
            let mut terms = vec![1.0];
            (1..=order).for_each(|n| terms.push(terms[n - 1] * turn / n as f64));
            let [left_out, p] = [turn * terms[order], order as f64];
            let sum = |weight: fn(f64) -> f64| (1..=order).map(|n| terms[n] * weight(n as f64)).sum::<f64>();
            let of_turn = 3.0 * UNIT_ROUNDOFF * sum(|n| 1.0 / (n + 1.0)) + left_out / ((p + 1.0) * (p + 2.0));
            let of_later = |n: f64| if n < 10.0 { 0.0 } else { n - 5.0 };
            let roundings = match compensates {
                false => 8.0 + sum(|n| n + 5.0),
                true => sum(of_later) + 1e5 * UNIT_ROUNDOFF * (1.0 + sum(|_| 1.0)),
            };
            let of_eta = UNIT_ROUNDOFF * roundings + left_out / (p + 1.0);
            for (found, exact) in [(bound.rates, modulus * h * of_turn), (bound.eta, of_eta)] {
                assert!(
                    (1.0..1.0 + 3e-9).contains(&(found / exact)),
                    "{order} {compensates} {inputs:?}: {found:e} {exact:e}"
                );
            }
        }
    }
}

/// (6), each Δₙ of (9), (6) + (7) + (8) and the differences in (7), written out as in the proof.
fn written_out(inputs: Inputs, order: usize, spread: f64) -> (f64, Vec<f64>, [f64; 2]) {
    let [modulus, half_z, q, h] = inputs;
    let [eta, c, q_h] = [modulus * h, half_z * h, q.abs() * h];
    let [u, w, r] = exactly(inputs, order).map(|terms| {
        let in_time = |(n, term): (usize, &DoubleDouble)| term.hi() * h.powi(n as i32);
        terms.iter().enumerate().map(in_time).collect::<Vec<f64>>()
    });
    let b: Vec<f64> = r.iter().map(|term| term.abs()).collect();
    let products = |a: &[f64], b: &[f64], n: usize| -> f64 {
        (n.saturating_sub(order)..=n.min(order)).map(|i| a[i] * b[n - i]).sum()
    };
    let exponential = |x: f64, n: usize| (1..=n).fold(1.0, |term, k| term * x / k as f64);
    let lambda = (c + 0.5 * q * h).hypot(eta);
    let (mut a, mut rounding, mut lost, mut change) = (vec![1.0], 0.0, Vec::new(), vec![0.0]);
    for n in 0..order {
        let roundings =
            |of_products: f64| (of_products * eta * products(&a, &b, n) + 3.0 * c.abs() * a[n]) / (n + 1) as f64;
        rounding += roundings(0.5 * n as f64 + 6.5);
        lost.push(UNIT_ROUNDOFF * roundings(3.5 * n as f64 + 6.5));
        let of_rounding: f64 = (0..=n).map(|j| lost[j] * exponential(lambda + q_h, n - j)).sum();
        change.push(1.4143 * (spread * eta * exponential(lambda + 0.5 * q_h, n) + 2.0 * of_rounding));
        a.push(u[n + 1].abs() + w[n + 1].abs() + change[n + 1]);
    }
    let with_roundings: Vec<f64> =
        change.iter().zip(&a).map(|(change, a)| change + (spread + 40.0 * UNIT_ROUNDOFF) * a).collect();
    let dropped = (order..=2 * order).map(|n| {
        let of_c = if n == order { c } else { 0.0 };
        let of_u = eta * products(&w, &r, n) + of_c * u[order];
        let of_w = -eta * products(&u, &r, n) + of_c * w[order];
        let differs = eta * products(&with_roundings, &b, n) + of_c.abs() * with_roundings[order];
        [of_u.abs() + of_w.abs() + differs, differs].map(|sum| sum / (n + 1) as f64)
    });
    let [dropped, differences] = dropped.fold([0.0; 2], |[a, b], [c, d]| [a + c, b + d]);
    let evaluated: f64 = a.iter().enumerate().map(|(n, a)| (n + 1) as f64 * a).sum();
    (rounding, change, [dropped + UNIT_ROUNDOFF * (rounding + evaluated + 16.0), differences])
}

#[test]
fn the_bounds_of_turns_are_those_of_the_theorem() {
    for (order, spread) in [(2, 0.0), (6, 1e-3), (12, 0.0), (12, 1e-14), (LARGEST_ORDER, 0.0), (LARGEST_ORDER, 0.5)] {
        for inputs in inputs(20, 2.0) {
            let (rounding, change, turn) = SimdLevel::widest().run(Bounds(inputs, order, spread));
            let exact = written_out(inputs, order, spread);
            let close = |found: f64, exact: f64| (found - exact).abs() <= 1e-10 * exact;
            assert!(close(rounding, exact.0), "(6), {order} {spread} {inputs:?}: {rounding:e} {:e}", exact.0);
            for (turn, exact) in turn.into_iter().zip(exact.2) {
                assert!(close(turn, exact), "(6) + (7) + (8), {order} {spread} {inputs:?}: {turn:e} {exact:e}");
            }
            for (n, (found, exact)) in change.into_iter().zip(exact.1).enumerate() {
                assert!(close(found, exact), "(9), {n} of {order} {spread} {inputs:?}: {found:e} {exact:e}");
            }
        }
    }
}
