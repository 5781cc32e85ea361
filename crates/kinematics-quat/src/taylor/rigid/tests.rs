//! Tests of one step and of its bounds, against the same series in double-double.

use dynamics::Body;
use numerics::lanes::{SimdLevel, WithSimd};
use numerics::{DoubleDouble, UNIT_ROUNDOFF};

use super::*;

/// The turn and half the rates after a step of this order and length.
struct Step([f64; 3], [f64; 3], usize, f64);

impl WithSimd for Step {
    type Output = [f64; 7];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [f64; 7] {
        let Self(rates, couplings, order, h) = self;
        let mut series = Bodies::series(simd);
        let splat = |value: f64| Real::splat(simd, value);
        series.expand(order, rates.map(|rate| splat(0.5 * rate)), couplings.map(|coupling| splat(2.0 * coupling)));
        series.after(order, splat(h)).map(Real::first)
    }
}

/// The coefficients of a step at any order, in double-double.
fn coefficients(rates: [f64; 3], couplings: [f64; 3], order: usize) -> Vec<[DoubleDouble; 7]> {
    let like = |value: f64| DoubleDouble::from(value);
    let [p, q, r] = couplings.map(|coupling| like(2.0 * coupling));
    let mut terms = vec![[1.0, 0.0, 0.0, 0.0, 0.5 * rates[0], 0.5 * rates[1], 0.5 * rates[2]].map(like)];
    for k in 0..order {
        let mut sum = [DoubleDouble::ZERO; 7];
        for (left, right) in terms.iter().zip(terms.iter().rev()) {
            let [w, x, y, z, a, b, _] = *left;
            let [_, _, _, _, d, e, f] = *right;
            let each = [-(x * d + y * e + z * f), w * d + y * f - z * e, w * e + z * d - x * f, w * f + x * e - y * d];
            let each = [each[0], each[1], each[2], each[3], b * f * p, a * f * q, a * e * r];
            sum.iter_mut().zip(each).for_each(|(sum, part)| *sum = *sum + part);
        }
        terms.push(sum.map(|part| part / like((k + 1) as f64)));
    }
    terms
}

/// [`coefficients`], evaluated at the end of the step.
fn in_double_double(rates: [f64; 3], couplings: [f64; 3], order: usize, h: f64) -> [DoubleDouble; 7] {
    let mut sum = [DoubleDouble::ZERO; 7];
    for term in coefficients(rates, couplings, order).iter().rev() {
        sum.iter_mut().zip(term).for_each(|(sum, part)| *sum = *sum * DoubleDouble::from(h) + *part);
    }
    sum
}

/// The bounds of the turn without its product, of the rates, and of their rounding.
struct Bounds([f64; 3], [f64; 3], usize, f64);

impl WithSimd for Bounds {
    type Output = [f64; 3];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [f64; 3] {
        let Self(rates, couplings, order, h) = self;
        let (mut series, splat) = (Bodies::series(simd), |value: f64| Real::splat(simd, value));
        let twice = couplings.map(|coupling| splat(2.0 * coupling));
        series.expand(order, rates.map(|rate| splat(0.5 * rate)), twice);
        let defect = series.defect(order, splat(h), twice);
        let [turn, rates, rounding] = [defect.turn, defect.rates, defect.rounding].map(Real::first);
        [turn - 8.0 * UNIT_ROUNDOFF, rates, rounding]
    }
}

/// Errors of a step of this order against one of the largest order in double-double: of the turn and of the rates.
fn errors_of_step(rates: [f64; 3], couplings: [f64; 3], order: usize, h: f64) -> [f64; 2] {
    let found = SimdLevel::widest().run(Step(rates, couplings, order, h));
    let exact = in_double_double(rates, couplings, 40, h);
    let off = |part: usize| (DoubleDouble::from(found[part]) - exact[part]).hi();
    let norm = |parts: &[usize]| parts.iter().map(|part| off(*part) * off(*part)).sum::<f64>().sqrt();
    [norm(&[0, 1, 2, 3]), 2.0 * norm(&[4, 5, 6])]
}

/// The largest errors of steps, divided by their bounds, and the means over all steps.
fn shares_of_steps(order: usize, h: f64) -> [f64; 2] {
    let mut largest = [0.0_f64; 2];
    for index in 0..2000 {
        let part = |square: f64| 2.0 * (f64::from(index) * square.sqrt()).fract() - 1.0;
        let rates = [part(2.0), part(3.0), part(5.0)];
        let moments = [0.1 + (1.0 + part(7.0)), 2.2 + part(11.0) * 0.1, 2.3 + part(13.0) * 0.01];
        let Ok(body) = Body::from_moments(moments) else { continue };
        let couplings = body.rigid().couplings();
        let [turn, of_rates, rounding] = SimdLevel::widest().run(Bounds(rates, couplings, order, h));
        let [off_turn, off_rates] = errors_of_step(rates, couplings, order, h);
        // No disturbance grows faster than with 2 |ω|.
        let grown = (of_rates * (3.5 * h).exp() + rounding, turn + 0.5 * h * of_rates * (3.5 * h).exp());
        largest = [largest[0].max(off_turn / grown.1), largest[1].max(off_rates / grown.0)];
    }
    largest
}

/// Half of a bound of a short step would be broken.
#[test]
fn the_defect_bounds_the_error_of_a_step_and_is_close() {
    for order in [2, 4] {
        for share in shares_of_steps(order, 0.03) {
            assert!((0.55..=1.0).contains(&share), "order {order}: {share} of the bound");
        }
    }
}

/// At the largest order all of the error is rounding.
#[test]
fn roundings_are_within_their_bounds() {
    for h in [0.03, 0.3, 1.0] {
        for share in shares_of_steps(LARGEST_ORDER, h) {
            assert!((0.15..=1.0).contains(&share), "{h}: {share} of the bound");
        }
    }
}

/// (13), (14) and (15), written out as in the proof.
fn written_out(rates: [f64; 3], couplings: [f64; 3], order: usize, h: f64) -> [f64; 3] {
    let mut terms: Vec<[f64; 7]> = Vec::new();
    for (n, term) in coefficients(rates, couplings, order).into_iter().enumerate() {
        terms.push(term.map(|part| part.hi() * h.powi(n as i32)));
    }
    let size = |n: usize| terms[n][..4].iter().map(|part| part.abs()).sum::<f64>();
    let of_turn = |weight: fn(f64) -> f64| (0..=order).map(|n| weight(n as f64 + 1.0) * size(n)).sum::<f64>();
    let later = |axis: usize, weight: fn(f64) -> f64| -> f64 {
        (1..=order).map(|n| weight(n as f64 + 1.0) * terms[n][4 + axis].abs()).sum()
    };
    let [a, b, c] = [0, 1, 2].map(|axis: usize| terms[0][4 + axis].abs() + later(axis, |_| 1.0));
    let (mut turn_dropped, mut rates_dropped) = (0.0, 0.0);
    for n in order..=2 * order {
        let product = |one: usize, other: usize| -> f64 {
            (n - order..=order).map(|i| terms[i][one] * terms[n - i][other]).sum::<f64>() * h / (n as f64 + 1.0)
        };
        let turn = [
            product(1, 4) + product(2, 5) + product(3, 6),
            product(0, 4) + product(2, 6) - product(3, 5),
            product(0, 5) + product(3, 4) - product(1, 6),
            product(0, 6) + product(1, 5) - product(2, 4),
        ];
        turn_dropped += turn.iter().map(|part| part * part).sum::<f64>().sqrt();
        let of_rates = [product(5, 6), product(6, 4), product(4, 5)].into_iter().zip(couplings);
        rates_dropped += of_rates.map(|(product, coupling)| (4.0 * coupling * product).abs()).sum::<f64>();
    }
    let coupling = couplings.into_iter().fold(0.0_f64, |most, one| most.max(one.abs()));
    let last = |axis: usize| terms[0][4 + axis].abs().min(later(axis, |_| 1.0) / UNIT_ROUNDOFF);
    [
        turn_dropped + UNIT_ROUNDOFF * (6.0 * h * of_turn(|_| 1.0) * (a + b + c) + of_turn(|n| n)),
        rates_dropped + 20.2 * UNIT_ROUNDOFF * coupling * h * (a * b + b * c + c * a),
        2.0 * UNIT_ROUNDOFF * (0..3).map(|axis| later(axis, |n| n) + last(axis)).sum::<f64>(),
    ]
}

/// Of low orders too, at which what the series leave out is the larger part, and of a rate that hardly changes.
#[test]
fn the_bounds_of_a_step_are_those_of_the_theorem() {
    for (order, h) in [(2, 0.1), (2, 1.3), (6, 0.7), (LARGEST_ORDER, 0.1), (LARGEST_ORDER, 1.3)] {
        for rates in [[0.9, -0.5, 0.7], [-0.2, 1.7, 0.4], [1.1, 1e-9, 1e-9]] {
            for couplings in [[-0.25, 0.75, -0.6], [-1.0, 0.5, 0.125]] {
                let found = SimdLevel::widest().run(Bounds(rates, couplings, order, h));
                for (found, exact) in found.into_iter().zip(written_out(rates, couplings, order, h)) {
                    assert!((found / exact - 1.0).abs() < 1e-9, "{order} {h} {rates:?}: {found:e}, not {exact:e}");
                }
            }
        }
    }
}
