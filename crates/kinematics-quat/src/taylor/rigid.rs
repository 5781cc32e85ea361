//! The flights of rigid bodies that are no coins by Taylor series, one in each lane of a SIMD vector, in principal axes
//! (see [`Flight`]), with three rates.
//!
//! Let (w, x, y, z) be the quaternion, (a, b, c) = ½ ω and p, q, r the couplings of Euler's equations, with which
//! ω1' = p ω2 ω3. The system is
//!
//! ```text
//! w' = -x a - y b - z c,   x' = w a + y c - z b,   y' = w b + z a - x c,   z' = w c + x b - y a,
//! a' = 2 p b c,   b' = 2 q c a,   c' = 2 r a b.
//! ```
//!
//! All right-hand sides are sums of products, so that the coefficient of tᵏ⁺¹ of each is a sum of products of those
//! before it. A step computes the turn that leads from the attitude at its start to that at its end, as for coins.

use dynamics::{Body, Flight, RigidBody, Toss};
use numerics::lanes::{Real, Simd};

use crate::taylor::coin::INVERSES;
use crate::taylor::lockstep::{Clock, Motion, PerLane, store};
use crate::taylor::plan::{LARGEST_ORDER, StepPlan};
use crate::taylor::product::turned;

/// The coefficients of w, x, y, z, a, b, c at one power of the time.
pub(crate) type Term<S> = [Real<S>; 7];

/// The coefficients of a step.
#[repr(align(64))]
pub(crate) struct RigidSeries<S: Simd>(pub(crate) [Term<S>; LARGEST_ORDER + 1]);

impl<S: Simd> RigidSeries<S> {
    /// Computes the coefficients up to `order`, of the turn that starts at 1 with half the rates `half`. `twice` are
    /// twice the couplings.
    #[inline(always)]
    fn expand(&mut self, order: usize, half: [Real<S>; 3], twice: [Real<S>; 3]) {
        let zero = half[0].constant(0.0);
        self.0[0] = [half[0].constant(1.0), zero, zero, zero, half[0], half[1], half[2]];
        for (k, [inverse, _]) in INVERSES[..order].iter().enumerate() {
            let [w, x, y, z, a, b, c] = products(&self.0[..=k]);
            let inverse = zero.constant(*inverse);
            let [p, q, r] = [twice[0] * inverse, twice[1] * inverse, twice[2] * inverse];
            self.0[k + 1] = [w * inverse, x * inverse, y * inverse, z * inverse, a * p, b * q, c * r];
        }
    }

    /// The sum of the sizes of the coefficients of tᵏ.
    #[inline(always)]
    fn size(&self, k: usize) -> Real<S> {
        let [w, x, y, z, a, b, c] = self.0[k];
        ((w.abs() + x.abs()) + (y.abs() + z.abs())) + ((a.abs() + b.abs()) + c.abs())
    }

    /// The turn, and half the rates, after the time `h`.
    #[inline(always)]
    fn after(&self, order: usize, h: Real<S>) -> Term<S> {
        let mut sum = self.0[order];
        for term in self.0[..order].iter().rev() {
            for part in 0..7 {
                sum[part] = sum[part].mul_add(h, term[part]);
            }
        }
        sum
    }
}

/// The coefficient of tᵏ of the right-hand sides, without the couplings, from the terms up to k.
#[inline(always)]
pub(crate) fn products<S: Simd>(terms: &[Term<S>]) -> Term<S> {
    let zero = terms[0][0].constant(0.0);
    let mut sum = [zero; 7];
    for (left, right) in terms.iter().zip(terms.iter().rev()) {
        let [w, x, y, z, a, b, _] = *left;
        let [_, _, _, _, d, e, f] = *right;
        sum[0] = sum[0] - x.mul_add(d, y.mul_add(e, z * f));
        sum[1] = w.mul_add(d, y.mul_add(f, sum[1] - z * e));
        sum[2] = w.mul_add(e, z.mul_add(d, sum[2] - x * f));
        sum[3] = w.mul_add(f, x.mul_add(e, sum[3] - y * d));
        sum[4] = b.mul_add(f, sum[4]);
        sum[5] = a.mul_add(f, sum[5]);
        sum[6] = a.mul_add(e, sum[6]);
    }
    sum
}

/// The state of the body in each lane, in the unit of its [`Flight`].
#[derive(Default)]
#[repr(align(64))]
pub(crate) struct Bodies {
    /// The turn since launch, in principal axes.
    attitude: [PerLane; 4],
    /// Half the rates about the principal axes.
    half: [PerLane; 3],
    /// Twice the couplings.
    pub(crate) twice: [PerLane; 3],
}

impl Motion for Bodies {
    type Body = RigidBody;
    type Bound = ();
    type Series<S: Simd> = RigidSeries<S>;

    fn body(body: &Body) -> Option<&RigidBody> {
        if let Body::Rigid(body) = body { Some(body) } else { None }
    }

    #[inline(always)]
    fn series<S: Simd>(simd: S) -> RigidSeries<S> {
        RigidSeries([[Real::splat(simd, 0.0); 7]; LARGEST_ORDER + 1])
    }

    fn launch(&mut self, lane: usize, body: &RigidBody, _: &Toss, flight: &Flight) {
        for (part, value) in self.attitude.iter_mut().zip([1.0, 0.0, 0.0, 0.0]) {
            part[lane] = value;
        }
        for (axis, coupling) in body.couplings().into_iter().enumerate() {
            self.half[axis][lane] = 0.5 * flight.rate[axis];
            self.twice[axis][lane] = 2.0 * coupling;
        }
    }

    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, plan: &StepPlan, series: &mut RigidSeries<S>, clock: &mut Clock) {
        self.step(simd, plan, series, clock);
    }

    fn state(&self, lane: usize, _: &Flight) -> ([f64; 4], [f64; 3]) {
        (self.attitude.each_ref().map(|part| part[lane]), self.rates(lane))
    }

    fn bound(&self, _: usize, _: u64) {}
}

impl Bodies {
    /// The rates of the body in `lane`.
    pub(crate) fn rates(&self, lane: usize) -> [f64; 3] {
        self.half.each_ref().map(|part| 2.0 * part[lane])
    }

    /// Takes one step in each lane, and returns its length.
    #[inline(always)]
    pub(crate) fn step<S: Simd>(
        &mut self,
        simd: S,
        plan: &StepPlan,
        series: &mut RigidSeries<S>,
        clock: &mut Clock,
    ) -> Real<S> {
        let load = |numbers: &PerLane| Real::load(simd, numbers);
        series.expand(plan.order, self.half.each_ref().map(load), self.twice.each_ref().map(load));
        let h = clock.step(simd, plan, [series.size(plan.order - 1), series.size(plan.order)]);
        let [w, x, y, z, a, b, c] = series.after(plan.order, h);
        let attitude = turned(self.attitude.each_ref().map(load), [[w, z], [x, y]]);
        store(attitude, &mut self.attitude);
        store([a, b, c], &mut self.half);
        h
    }
}

#[cfg(test)]
mod tests;
