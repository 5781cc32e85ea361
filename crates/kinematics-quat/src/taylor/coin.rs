//! The flights of coins by Taylor series, one in each lane of a SIMD vector. The right-hand sides are polynomials, so
//! that their Taylor coefficients follow from recurrences, and a high order allows long steps.
//!
//! Let (w, x, y, z) be the quaternion, ω the body rate, k = I3/I1 and q = (k - 1) ωz. With u = w + i z, v = x + i y,
//! η = ½ (ωx + i ωy) and c = ½ ωz, the system Q' = ½ Q ⊗ (0, ω) with Euler's equations is
//!
//! ```text
//! u' = -v η̄ + i c u,   v' = u η - i c v,   η' = i q η.
//! ```
//!
//! A step computes the turn R that leads from the attitude P at its start to P ⊗ R at its end. R starts at u = 1 and v
//! = 0, in body axes that are turned about z so that η is real at the start. In these axes the equations are the same,
//! because the coin is symmetric, and the coefficients are real up to powers of i. From here on, k counts them, and |η|
//! is that of the start:
//!
//! ```text
//! u = Σ iᵏ Uₖ tᵏ,   v = -i Σ (-i)ᵏ Wₖ tᵏ,   η = |η| Σ iᵏ rₖ tᵏ.
//! ```
//!
//! Inserted into the equations above, they give the recurrences
//!
//! ```text
//! (k + 1) Uₖ₊₁ = (-1)ᵏ |η| Σ Wₘ rₖ₋ₘ + c Uₖ,   (k + 1) Wₖ₊₁ = -(-1)ᵏ |η| Σ Uₘ rₖ₋ₘ + c Wₖ,   (k + 1) rₖ₊₁ = q rₖ.
//! ```
//!
//! Two convolutions replace the eight products of quaternion components. The closed form of the motion is not used:
//! each step starts from the attitude and the rates that the step before it computed.

use dynamics::body_rate::body_precession_rate;
use dynamics::{Body, Coin, Flight, Toss};
use numerics::lanes::{Complex, Double, Real, Simd, compensated_product, complex_product, inverse, polar, sum, times};

use crate::taylor::lockstep::{Clock, Motion, PerLane, store};
use crate::taylor::plan::{LARGEST_ORDER, StepPlan};
use crate::taylor::product::turned;

/// Number of coefficients of η, from the first on, that have twice as many digits if η is compensated. Later terms are
/// so small that their rounding does not matter.
pub(crate) const COMPENSATED: usize = 10;

/// 1/(k + 1) for each k.
pub(crate) const INVERSES: [Double<f64>; LARGEST_ORDER] = {
    let mut inverses = [[1.0, 0.0]; LARGEST_ORDER];
    let mut k = 0;
    while k < LARGEST_ORDER {
        inverses[k] = inverse(k + 1);
        k += 1;
    }
    inverses
};

/// What a bound of the error has to know of the steps of a flight.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Record {
    /// The number of steps by series.
    pub(crate) steps: u64,
    /// The least and the largest |η|, in the unit of the flight.
    pub(crate) moduli: [f64; 2],
    /// The longest step, in the unit of the flight.
    pub(crate) longest: f64,
}

/// The coefficients Uₖ, Wₖ and rₖ of a step. They are aligned, because a vector that crosses a cache line takes two
/// loads.
#[repr(align(64))]
pub(crate) struct Series<S: Simd> {
    pub(crate) u: [Real<S>; LARGEST_ORDER + 1],
    pub(crate) w: [Real<S>; LARGEST_ORDER + 1],
    pub(crate) r: [Real<S>; LARGEST_ORDER + 1],
    /// The rounding errors of the first coefficients in `r`.
    r_low: [Real<S>; COMPENSATED],
}

impl<S: Simd> Series<S> {
    /// A series whose coefficients have not been computed yet.
    #[inline(always)]
    pub(crate) fn new(simd: S) -> Self {
        let zero = Real::splat(simd, 0.0);
        let none = [zero; LARGEST_ORDER + 1];
        Self { u: none, w: none, r: none, r_low: [zero; COMPENSATED] }
    }

    /// Computes Uₖ and Wₖ up to the even `order`, for |η| = `modulus` and c = `half_z`. The coefficients of η must have
    /// been computed before.
    #[inline(always)]
    pub(crate) fn expand(&mut self, order: usize, modulus: Real<S>, half_z: Real<S>) {
        let Self { u, w, r, .. } = self;
        (u[0], w[0]) = (modulus.constant(1.0), modulus.constant(0.0));
        for k in (0..order).step_by(2) {
            let [[u_even, w_even], [u_odd, w_odd]] = products(&u[..k], &w[..k], &r[..k + 2]);
            // Products with the newest coefficients are added last, so that as much as possible is done before they are
            // known.
            let inverse = modulus.constant(INVERSES[k][0]);
            let (a, c) = (modulus * inverse, half_z * inverse);
            u[k + 1] = u[k].mul_add(c, w[k].mul_add(a, w_even * a));
            w[k + 1] = w[k].mul_add(c, -u[k].mul_add(a, u_even * a));
            let inverse = modulus.constant(INVERSES[k + 1][0]);
            let (a, c) = (modulus * inverse, half_z * inverse);
            let (u_odd, w_odd) = (u[k].mul_add(r[1], u_odd) * a, w[k].mul_add(r[1], w_odd) * a);
            u[k + 2] = u[k + 1].mul_add(c, -w[k + 1].mul_add(a, w_odd));
            w[k + 2] = w[k + 1].mul_add(c, u[k + 1].mul_add(a, u_odd));
        }
    }

    /// Computes the coefficients rₖ of η up to `order`.
    #[inline(always)]
    pub(crate) fn expand_eta(&mut self, order: usize, q: Real<S>) {
        self.r[0] = q.constant(1.0);
        for (k, [inverse, _]) in INVERSES[..order].iter().enumerate() {
            self.r[k + 1] = self.r[k] * (q * q.constant(*inverse));
        }
    }

    /// Computes the coefficients rₖ of η up to `order`, the first ones with their rounding errors.
    #[inline(always)]
    pub(crate) fn expand_eta_compensated(&mut self, order: usize, q: Real<S>) {
        let (r, low) = (&mut self.r, &mut self.r_low);
        r[0] = q.constant(1.0);
        for (k, [inverse, inverse_low]) in INVERSES[..order].iter().enumerate() {
            let (inverse, inverse_low) = (q.constant(*inverse), q.constant(*inverse_low));
            if k + 1 < COMPENSATED {
                let [factor, error] = q.product(inverse);
                let factor = [factor, q.mul_add(inverse_low, error)];
                [r[k + 1], low[k + 1]] = times([r[k], low[k]], factor);
            } else {
                r[k + 1] = r[k] * (q * inverse);
            }
        }
    }

    /// The size of the coefficients of tᵏ, |Uₖ| + |Wₖ| + |rₖ|.
    #[inline(always)]
    pub(crate) fn size(&self, k: usize) -> Real<S> {
        self.u[k].abs() + self.w[k].abs() + self.r[k].abs()
    }

    /// u and v of the turn R after the time `h`, by the terms up to `order`.
    #[inline(always)]
    pub(crate) fn turn(&self, order: usize, h: Real<S>) -> [Complex<Real<S>>; 2] {
        let y = -(h * h);
        let [even_u, odd_u] = horner(&self.u[..=order], y);
        let [even_w, odd_w] = horner(&self.w[..=order], y);
        [[even_u, odd_u * h], [-(odd_w * h), -even_w]]
    }

    /// η after the time `h`, divided by |η|, by the terms up to `order`.
    #[inline(always)]
    pub(crate) fn turn_of_eta(&self, order: usize, h: Real<S>) -> Complex<Real<S>> {
        let [even, odd] = horner(&self.r[..=order], -(h * h));
        [even, odd * h]
    }

    /// [`Series::turn_of_eta`] with twice as many digits.
    #[inline(always)]
    pub(crate) fn turn_of_eta_compensated(&self, order: usize, h: Real<S>) -> Complex<Double<Real<S>>> {
        let zero = h.constant(0.0);
        let [square, error] = h.product(h);
        let y = [-square, -error];
        let both = COMPENSATED.min(order);
        let [even, odd] = horner(&self.r[both..=order], y[0]);
        let (mut even, mut odd) = ([even, zero], [odd, zero]);
        for (r, low) in self.r[..both].rchunks_exact(2).zip(self.r_low[..both].rchunks_exact(2)) {
            odd = sum([r[1], low[1]], times(odd, y));
            even = sum([r[0], low[0]], times(even, y));
        }
        [even, times(odd, [h, zero])]
    }
}

/// The sums over m of uₘ rₙ₋ₘ and of wₘ rₙ₋ₘ, first with n the index of the last but one of r, then with that of the
/// last. The number of terms is even. Even and odd terms are added up separately, so that fewer additions wait for each
/// other.
#[inline(always)]
fn products<S: Simd>(u: &[Real<S>], w: &[Real<S>], r: &[Real<S>]) -> [[Real<S>; 2]; 2] {
    let zero = r[0].constant(0.0);
    let [mut u_even, mut w_even, mut u_odd, mut w_odd] = [[zero; 2]; 4];
    let (mut upper, rest) = (r[r.len() - 1], &r[..r.len() - 1]);
    for ((u, w), r) in u.chunks_exact(2).zip(w.chunks_exact(2)).zip(rest.rchunks_exact(2)) {
        let (middle, lower) = (r[1], r[0]);
        u_even = [u[0].mul_add(middle, u_even[0]), u[1].mul_add(lower, u_even[1])];
        w_even = [w[0].mul_add(middle, w_even[0]), w[1].mul_add(lower, w_even[1])];
        u_odd = [u[0].mul_add(upper, u_odd[0]), u[1].mul_add(middle, u_odd[1])];
        w_odd = [w[0].mul_add(upper, w_odd[0]), w[1].mul_add(middle, w_odd[1])];
        upper = lower;
    }
    [[u_even[0] + u_even[1], w_even[0] + w_even[1]], [u_odd[0] + u_odd[1], w_odd[0] + w_odd[1]]]
}

/// Σ a₂ⱼ yʲ and Σ a₂ⱼ₊₁ yʲ of an odd number of coefficients a.
#[inline(always)]
fn horner<S: Simd>(coefficients: &[Real<S>], y: Real<S>) -> [Real<S>; 2] {
    let last = coefficients.len() - 1;
    let (mut even, mut odd) = (coefficients[last], y.constant(0.0));
    for pair in coefficients[..last].rchunks_exact(2) {
        odd = odd.mul_add(y, pair[1]);
        even = even.mul_add(y, pair[0]);
    }
    [even, odd]
}

/// The state of the coin in each lane, in the unit of its [`Flight`].
#[derive(Default)]
#[repr(align(64))]
pub(crate) struct Coins {
    /// P = (w, x, y, z).
    attitude: [PerLane; 4],
    /// η = ½ (ωx + i ωy).
    eta: [PerLane; 2],
    /// The rounding error of η, if it is compensated.
    eta_low: [PerLane; 2],
    /// ½ ωz.
    half_z: PerLane,
    q: PerLane,
    /// The least and the largest |η| of the steps so far.
    moduli: [PerLane; 2],
    /// The longest step so far.
    longest: PerLane,
}

impl Motion for Coins {
    type Body = Coin;
    type Bound = Record;
    type Series<S: Simd> = Series<S>;

    fn body(body: &Body) -> Option<&Coin> {
        if let Body::Coin(coin) = body { Some(coin) } else { None }
    }

    #[inline(always)]
    fn series<S: Simd>(simd: S) -> Series<S> {
        Series::new(simd)
    }

    fn launch(&mut self, lane: usize, coin: &Coin, _: &Toss, flight: &Flight) {
        for (part, value) in self.attitude.iter_mut().zip([1.0, 0.0, 0.0, 0.0]) {
            part[lane] = value;
        }
        let [x, y, z] = <[f64; 3]>::from(flight.rate).map(|rate| 0.5 * rate);
        let q = body_precession_rate(coin.inertia_ratio(), flight.rate.z);
        (self.eta[0][lane], self.eta[1][lane], self.half_z[lane], self.q[lane]) = (x, y, z, q);
        (self.eta_low[0][lane], self.eta_low[1][lane]) = (0.0, 0.0);
        (self.moduli[0][lane], self.moduli[1][lane], self.longest[lane]) = (f64::INFINITY, 0.0, 0.0);
    }

    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, plan: &StepPlan, series: &mut Series<S>, clock: &mut Clock) {
        let load = |numbers: &PerLane| Real::load(simd, numbers);
        let (eta, q, order) = (self.eta.each_ref().map(load), load(&self.q), plan.order);
        let (modulus, direction) = polar(eta);
        if plan.compensates {
            series.expand_eta_compensated(order, q);
        } else {
            series.expand_eta(order, q);
        }
        series.expand(order, modulus, load(&self.half_z));
        let h = clock.step(simd, plan, [series.size(order - 1), series.size(order)]);
        load(&self.moduli[0]).min(modulus).store(&mut self.moduli[0]);
        load(&self.moduli[1]).max(modulus).store(&mut self.moduli[1]);
        load(&self.longest).max(h).store(&mut self.longest);
        let (after, lost) = if plan.compensates {
            let [x, y] = self.eta_low.each_ref().map(load);
            let [x, y] = compensated_product([[eta[0], x], [eta[1], y]], series.turn_of_eta_compensated(order, h));
            ([x[0], y[0]], [x[1], y[1]])
        } else {
            (complex_product(eta, series.turn_of_eta(order, h)), [h.constant(0.0); 2])
        };
        let [u, v] = series.turn(order, h);
        // The direction of η turns v back into the axes of the body.
        let attitude = turned(self.attitude.each_ref().map(load), [u, complex_product(direction, v)]);
        store(attitude, &mut self.attitude);
        store(after, &mut self.eta);
        store(lost, &mut self.eta_low);
    }

    fn state(&self, lane: usize, flight: &Flight) -> ([f64; 4], [f64; 3]) {
        let [x, y] = self.eta.each_ref().map(|part| 2.0 * part[lane]);
        (self.attitude.each_ref().map(|part| part[lane]), [x, y, flight.rate.z])
    }

    fn bound(&self, lane: usize, steps: u64) -> Record {
        Record { steps, moduli: self.moduli.each_ref().map(|part| part[lane]), longest: self.longest[lane] }
    }
}
