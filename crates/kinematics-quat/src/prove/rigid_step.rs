//! Bounds of the error of one step of a body, from the defect of its polynomials. The theorem and its proof are in
//! `docs/proofs/enclosure.md`, section 7, whose numbers of formulas stand here in brackets.

use numerics::UNIT_ROUNDOFF;
use numerics::lanes::{Real, Simd};

use crate::taylor::rigid::{RigidSeries, products};

/// Bounds of what one step adds to the error, in the unit of the flight.
pub(crate) struct Defect<S: Simd> {
    /// Of the turn, for its own rates (13).
    pub(crate) turn: Real<S>,
    /// Of the rates: the integral of the defect of their polynomials (14).
    pub(crate) rates: Real<S>,
    /// Of the rates: the rounding at the end of the step (15).
    pub(crate) rounding: Real<S>,
}

/// Sums over the coefficients of a step, each times its power of the step.
struct Sizes<S: Simd> {
    /// Σ |Pₙ| hⁿ, where |Pₙ| is the sum of the sizes of the four components.
    turn: Real<S>,
    /// Σ (n + 1) |Pₙ| hⁿ.
    turn_evaluated: Real<S>,
    /// Σ |cₙ| hⁿ for each of the rates.
    rates: [Real<S>; 3],
    /// What the evaluation of the rates loses, in units of u.
    rates_evaluated: Real<S>,
}

impl<S: Simd> RigidSeries<S> {
    /// The bounds of a step `h` of this `order`. `twice` are twice the couplings.
    #[inline(always)]
    pub(crate) fn defect(&self, order: usize, h: Real<S>, twice: [Real<S>; 3]) -> Defect<S> {
        let constant = |value: f64| h.constant(value);
        let Sizes { turn, turn_evaluated, rates: [a, b, c], rates_evaluated } = self.sizes(order, h);
        let [turn_dropped, rates_dropped] = self.dropped(order, h, twice);
        let unit = constant(UNIT_ROUNDOFF);
        let rounded = turn * ((a + b) + c) * h * constant(6.0) + turn_evaluated + constant(8.0);
        let coupling = twice[0].abs().max(twice[1].abs()).max(twice[2].abs());
        let products = a.mul_add(b, b.mul_add(c, c * a));
        Defect {
            turn: rounded.mul_add(unit, turn_dropped),
            rates: (products * coupling * h * constant(10.1)).mul_add(unit, rates_dropped + rates_dropped),
            rounding: rates_evaluated * constant(2.0) * unit,
        }
    }

    #[inline(always)]
    fn sizes(&self, order: usize, h: Real<S>) -> Sizes<S> {
        let zero = h.constant(0.0);
        let [mut turn, mut turn_evaluated, mut power] = [zero, zero, h.constant(1.0)];
        let [mut later, mut evaluated] = [[zero; 3]; 2];
        for n in 0..=order {
            let [w, x, y, z, a, b, c] = self.0[n];
            let (count, size) = (h.constant((n + 1) as f64), ((w.abs() + x.abs()) + (y.abs() + z.abs())) * power);
            turn = turn + size;
            turn_evaluated = size.mul_add(count, turn_evaluated);
            if n > 0 {
                let sizes = [a.abs() * power, b.abs() * power, c.abs() * power];
                for axis in 0..3 {
                    later[axis] = later[axis] + sizes[axis];
                    evaluated[axis] = sizes[axis].mul_add(count, evaluated[axis]);
                }
            }
            power = power * h;
        }
        let (mut rates, mut rates_evaluated) = ([zero; 3], zero);
        for axis in 0..3 {
            let start = self.0[0][4 + axis].abs();
            rates[axis] = start + later[axis];
            // The last sum is off by no more than what is added to the f64 at the start.
            let last = start.min(later[axis] * h.constant(1.0 / UNIT_ROUNDOFF));
            rates_evaluated = rates_evaluated + evaluated[axis] + last;
        }
        Sizes { turn, turn_evaluated, rates, rates_evaluated }
    }

    /// The integrals of the products that the truncated series leave out, of the turn and of half the rates.
    #[inline(always)]
    fn dropped(&self, order: usize, h: Real<S>, [p, q, r]: [Real<S>; 3]) -> [Real<S>; 2] {
        let [mut turn, mut rates] = [h.constant(0.0); 2];
        let mut power = h;
        for _ in 0..order {
            power = power * h;
        }
        for n in order..=2 * order {
            let [w, x, y, z, a, b, c] = products(&self.0[n - order..=order]);
            let share = power * h.constant(1.0 / (n + 1) as f64);
            let size = w.mul_add(w, x.mul_add(x, y.mul_add(y, z * z))).sqrt();
            turn = size.mul_add(share, turn);
            rates = ((a * p).abs() + (b * q).abs() + (c * r).abs()).mul_add(share, rates);
            power = power * h;
        }
        [turn, rates]
    }
}
