//! From the rates at launch to the regime, the modulus, the amplitudes and the rates of both phases. No sum cancels but
//! that of E, whose condition is told.

use numerics::lanes::{Real, Simd};

use super::constants::{Axes, Constants};

/// Smallest k'² for which the filter decides: that of a nome of 0.44.
const SMALLEST_COMPLEMENT: f64 = 1e-4;

/// Largest G², in the units of the moments and of rad/s, for which the filter decides; the smallest is its inverse.
const LARGEST_SQUARE: f64 = 1e60;

/// Smallest e^(-2ψ) for which the filter decides: its 16th power is in the range of f64.
const SMALLEST_DECAY: f64 = 1e-18;

/// Smallest share, squared, of a rate along a principal axis that is not an axis of BF.
const SMALLEST_SHARE: f64 = 1e-14;

/// The angular momentum m at launch in relabelled axes, before the reversal that makes m3 > 0.
struct Labelled<S: Simd> {
    m: [Real<S>; 3],
    /// α12, α23 and α13, without their common sign.
    alpha: [Real<S>; 3],
    root_23: Real<S>,
    /// P1 and P3, without their sign.
    p1: Real<S>,
    p3: Real<S>,
    /// |m|².
    squared: Real<S>,
    /// |E|/I2, and the sum of its two terms.
    excess: Real<S>,
    terms: Real<S>,
    /// 1 around the axis of the largest moment, -1 around that of the smallest.
    side: Real<S>,
    /// e^(-2ψ) that leads to c.
    decay: Real<S>,
}

/// What a launch leaves to the means.
pub(super) struct Start<S: Simd> {
    /// k', and k² with digits of its own.
    pub(super) complementary: Real<S>,
    pub(super) modulus_squared: Real<S>,
    /// √p and the first weight of the integral of the third kind.
    pub(super) root: Real<S>,
    pub(super) weight: Real<S>,
    /// e^(-2ψ) that leads to the smaller one of c and v, and 1 if that is c, 0 if it is v.
    pub(super) decay: Real<S>,
    pub(super) is_c: Real<S>,
    /// The direction of (cn u0, sn u0).
    pub(super) point: [Real<S>; 2],
    /// The turns of x during the flight for a mean of 1, those at the rate G/I3, and those for an integral of 1.
    pub(super) turns: [Real<S>; 3],
    pub(super) side: Real<S>,
    /// The sign of m3.
    pub(super) upright: Real<S>,
    /// Σ|terms|/|E|, which rounding errors of E are multiplied by; infinite where the filter is not to decide.
    pub(super) condition: Real<S>,
}

impl Constants {
    /// The launch at a rate (BF, rad/s) and speed (m/s).
    #[inline(always)]
    pub(super) fn start<S: Simd>(&self, rate: [Real<S>; 3], speed: Real<S>) -> Start<S> {
        let number = |value: f64| speed.constant(value);
        let (zero, one) = (number(0.0), number(1.0));
        let launch = self.labelled(rate);
        let ([_, _, m3], [a12, a23, a13], side) = (launch.m, launch.alpha, launch.side);
        let (p1, p3) = (launch.p1, launch.p3);
        let around_largest = zero.less_than(side);
        let inverse = one / (a23 * p1);
        let complementary_squared = (a13 * launch.excess) * inverse;
        let (momentum, root_13, root_p1) = (launch.squared.sqrt(), number(self.roots[2]), p1.sqrt());
        // c and v have the amplitudes √(α23/α12) and √(P1/P3). The smaller one has the larger decay.
        let size = (p1 + p3).sqrt() + root_p1;
        let decay_of_v = p3 / (size * size);
        let is_c = decay_of_v.less_than(launch.decay);
        let decay = is_c.choose(launch.decay, decay_of_v);
        let flown = speed * number(self.turns);
        let turned = momentum * flown;
        let share = around_largest.choose(p3 / p1, one);
        Start {
            complementary: complementary_squared.min(one).sqrt(),
            modulus_squared: (a12 * p3) * inverse,
            root: (root_13 * momentum) / root_p1,
            weight: around_largest.choose(zero, one),
            decay,
            is_c: is_c.choose(one, zero),
            point: launch.point(root_13),
            turns: [(side * launch.root_23) * (root_p1 * flown), turned * number(self.inverse), (turned * share) * a13],
            side,
            upright: one.times_sign_of(m3),
            condition: launch.condition(complementary_squared, decay, speed),
        }
    }

    #[inline(always)]
    fn labelled<S: Simd>(&self, rate: [Real<S>; 3]) -> Labelled<S> {
        let number = |value: f64| rate[0].constant(value);
        let one = number(1.0);
        let [first, second, third] = self.along_principal_axes(rate);
        let [m1, m2, m3] =
            [first * number(self.moments[0]), second * number(self.moments[1]), third * number(self.moments[2])];
        let squares = [m1 * m1, m2 * m2, m3 * m3];
        let [a12, a23, a13] = [number(self.alpha[0]), number(self.alpha[1]), number(self.alpha[2])];
        let p1 = a12.mul_add(squares[1], a13 * squares[2]);
        let p3 = a23.mul_add(squares[1], a13 * squares[0]);
        let (outer, inner) = (a23 * squares[2], a12 * squares[0]);
        // Around the axis of the smallest moment, 1 and 3 change places.
        let around_largest = inner.less_than(outer);
        let either = |a: Real<S>, b: Real<S>| [around_largest.choose(a, b), around_largest.choose(b, a)];
        let ([m1, m3], [p1, p3], [a12, a23]) = (either(m1, m3), either(p1, p3), either(a12, a23));
        let either = |[a, b]: [f64; 2]| around_largest.choose(number(a), number(b));
        Labelled {
            m: [m1, m2, m3],
            alpha: [a12, a23, a13],
            root_23: either([self.roots[1], self.roots[0]]),
            p1,
            p3,
            squared: (squares[0] + squares[1]) + squares[2],
            excess: (outer - inner).abs(),
            terms: outer + inner,
            side: around_largest.choose(one, -one),
            decay: either(self.decays),
        }
    }

    /// The rate along principal axes, with a relative error of a rounding.
    #[inline(always)]
    pub(super) fn along_principal_axes<S: Simd>(&self, rate: [Real<S>; 3]) -> [Real<S>; 3] {
        let number = |value: f64| rate[0].constant(value);
        match &self.axes {
            Axes::Along([first, second, third]) => {
                [first, second, third].map(|(part, sign)| rate[*part].times_sign_of(number(*sign)))
            }
            Axes::Turned([first, second, third]) => {
                let [x, y, z] = [along(first, rate), along(second, rate), along(third, rate)];
                let (xx, yy, zz) = (x * x, y * y, z * z);
                let least = number(SMALLEST_SHARE) * ((xx + yy) + zz);
                // A smaller component has lost digits.
                [least.at_most(xx.min(yy).min(zz)).choose(x, number(f64::NAN)), y, z]
            }
        }
    }
}

impl<S: Simd> Labelled<S> {
    /// The direction of (cn u0, sn u0); (1, 0) on the axis that m circles.
    #[inline(always)]
    fn point(&self, root_13: Real<S>) -> [Real<S>; 2] {
        let (zero, one) = (root_13.constant(0.0), root_13.constant(1.0));
        let [m1, m2, m3] = self.m;
        let [x, y] = [m1 * root_13, (m2 * self.root_23) * self.side.times_sign_of(m3)];
        let size = x.abs() + y.abs();
        let is_off = zero.less_than(size);
        let inverse = one / is_off.choose(size, one);
        [is_off.choose(x * inverse, one), y * inverse]
    }

    /// The condition of E; infinite for launches outside what the bound of the error is derived for.
    #[inline(always)]
    fn condition(&self, complementary_squared: Real<S>, decay: Real<S>, speed: Real<S>) -> Real<S> {
        let number = |value: f64| speed.constant(value);
        let infinite = number(f64::INFINITY);
        let condition = self.terms / self.excess;
        let condition = number(SMALLEST_COMPLEMENT).less_than(complementary_squared).choose(condition, infinite);
        let condition = number(SMALLEST_DECAY).less_than(decay).choose(condition, infinite);
        let condition = self.squared.less_than(number(LARGEST_SQUARE)).choose(condition, infinite);
        let condition = number(1.0 / LARGEST_SQUARE).less_than(self.squared).choose(condition, infinite);
        number(0.0).at_most(speed).choose(condition, infinite)
    }
}

/// The component of a rate along an axis.
#[inline(always)]
fn along<S: Simd>(axis: &[[f64; 2]; 3], [x, y, z]: [Real<S>; 3]) -> Real<S> {
    let number = |value: f64| x.constant(value);
    let [[x_high, x_low], [y_high, y_low], [z_high, z_low]] = *axis;
    let ([a, a_rest], [b, b_rest]) = (x.product(number(x_high)), y.product(number(y_high)));
    let [c, c_rest] = z.product(number(z_high));
    let [sum, rest] = a.sum(b);
    let [sum, last] = sum.sum(c);
    let rest = (rest + last) + ((a_rest + b_rest) + c_rest);
    sum + x.mul_add(number(x_low), y.mul_add(number(y_low), z.mul_add(number(z_low), rest)))
}
