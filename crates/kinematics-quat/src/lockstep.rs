//! Integrates flights by Taylor series, as many at once as a SIMD vector has lanes. Each instruction then
//! works on a different flight in each lane, which makes large batches fast.
//!
//! A lane whose flight has landed takes the next flight, so that no lane waits for the others. The result of a lane
//! depends on its flight alone, neither on the other lanes nor on the width of the vector. A landing therefore has the
//! same bits whichever flights are solved with it, and on every machine.
//!
//! Symbols are those of the file `taylor.rs`: η = ½ (ωx + i ωy) is half the transverse rate, and q the rate at which it
//! turns.

use dynamics::integrate::STEP_LIMIT;
use dynamics::{Flight, SolveError, Toss, Work};
use numerics::lanes::{Real, Simd, SimdLevel, WithSimd, compensated_product, complex_product, polar};

use crate::product::turned;
use crate::taylor::{LARGEST_ORDER, Series};
use crate::{Landed, QuaternionSystem};

/// The number of lanes of the widest vectors.
const MOST_LANES: usize = 8;

/// Exponents of two by which the shortest step is multiplied, tried one after the other from the largest on. A factor
/// is kept if the last terms of the series allow it.
const OCTAVES: [f64; 6] = [2.0, 1.0, 0.5, 0.25, 0.125, 0.0625];

/// An upper bound of the rates at which terms of the series turn, ½ (ωL + |q|) with I3 ≤ 2 I1, in the unit of
/// [`Flight`], in which no component of ω reaches 2.
const FASTEST: f64 = 4.0;

/// Tolerances below this one need compensated rates, that is, η with twice as many digits. Without them the rounding
/// error of ε |ω| in each step adds up to 1e-13 in a flight of 100 rad.
const ROUNDING: f64 = 5e-13;

/// The constants of a step that follow from the tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Plan {
    tolerance: f64,
    /// The order of the series, which is even.
    order: usize,
    /// Whether η is carried with twice as many digits.
    compensates: bool,
    /// The shortest step, with which the last term is within the tolerance at the fastest rates.
    shortest: f64,
    /// The powers of the shortest step in the last two terms of the series.
    powers: [f64; 2],
    /// For each of [`OCTAVES`], the factors by which it multiplies the step and the last term.
    growth: [[f64; 2]; OCTAVES.len()],
}

impl Plan {
    /// The constants for local errors of `tolerance`.
    fn new(tolerance: f64) -> Self {
        let order = order(tolerance);
        let degree = order as f64;
        // The last term of the series of exp(i λ t) is (λ t)^order/order!, which is the tolerance at this time:
        let factorial: f64 = (1..=order).map(|k| k as f64).product();
        let shortest = (tolerance * factorial).powf(1.0 / degree) / FASTEST;
        let power = std::iter::repeat_n(shortest, order - 1).product::<f64>();
        Self {
            tolerance,
            order,
            compensates: tolerance < ROUNDING,
            shortest,
            powers: [power, power * shortest],
            growth: OCTAVES.map(|octaves| [octaves, octaves * degree].map(f64::exp2)),
        }
    }
}

/// The even order that was measured to take the least time for a given error: 18 for a tolerance of 1e-3, and 26 from
/// 1e-7 on. Four orders more or less change the time by less than a tenth.
fn order(tolerance: f64) -> usize {
    let decades = -tolerance.log10();
    let half = (6.5 + 0.83 * decades).ceil();
    (2 * half as usize).min(LARGEST_ORDER)
}

/// The plans of a solver with a given tolerance, for short and for long flights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plans {
    short: Plan,
    /// The plan of [long](Flight::is_long) flights. Each of them has a tolerance of its own, so that all take the order
    /// of the finest tolerance, and compensated rates.
    long: Plan,
}

impl Plans {
    /// The plans for local errors of `tolerance`.
    pub(crate) fn new(tolerance: f64) -> Self {
        Self { short: Plan::new(tolerance), long: Plan { tolerance, ..Plan::new(f64::EPSILON) } }
    }

    /// Solves `tosses`, first the short flights and then the long ones, and calls `land` with the index and the landing
    /// of each.
    pub(crate) fn fly(
        &self,
        tosses: &[Toss],
        level: SimdLevel,
        mut land: impl FnMut(usize, Result<Landed, SolveError>),
    ) {
        let mut run = |plan, long| level.run(Queue { plan, long, tosses, next: 0, skipped: false, land: &mut land });
        let skipped = run(&self.short, false);
        if skipped {
            run(&self.long, true);
        }
    }
}

/// One pass through the tosses, for either the long flights or the short ones.
struct Queue<'a> {
    plan: &'a Plan,
    /// Whether this pass solves the long flights, and skips the short ones, or the other way round.
    long: bool,
    /// Whether a toss was skipped.
    skipped: bool,
    tosses: &'a [Toss],
    /// The index of the next toss.
    next: usize,
    land: &'a mut dyn FnMut(usize, Result<Landed, SolveError>),
}

/// One number for each lane.
type PerLane = [f64; MOST_LANES];

/// The state of the flight in each lane, in the unit of its [`Flight`].
#[derive(Default)]
#[repr(align(64))]
struct Lanes {
    /// P = (w, x, y, z), as in [`Landed`].
    attitude: [PerLane; 4],
    /// η = ½ (ωx + i ωy).
    eta: [PerLane; 2],
    /// The rounding error of η, if it is compensated.
    eta_low: [PerLane; 2],
    /// ½ ωz.
    half_z: PerLane,
    q: PerLane,
    /// Remaining dimensionless time.
    left: PerLane,
    inverse_tolerance: PerLane,
    /// The number of steps so far.
    steps: [u32; MOST_LANES],
    /// The index of the toss in this lane and its flight; `None` for an idle lane.
    flying: [Option<(usize, Flight)>; MOST_LANES],
}

impl WithSimd for Queue<'_> {
    /// Whether a toss was skipped.
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> bool {
        let (mut lanes, mut series) = (Lanes::default(), Series::new(simd));
        for lane in 0..S::F64_LANES {
            self.start(&mut lanes, lane);
        }
        while lanes.flying.iter().any(Option::is_some) {
            lanes.advance(simd, self.plan, &mut series);
            for lane in 0..S::F64_LANES {
                if let Some((index, landed)) = lanes.landed(lane, self.plan) {
                    (self.land)(index, landed);
                    self.start(&mut lanes, lane);
                }
            }
        }
        self.skipped
    }
}

impl Queue<'_> {
    /// Puts the next flight of this pass into `lane`. A flight of no duration or without rotation lands at once.
    fn start(&mut self, lanes: &mut Lanes, lane: usize) {
        while let Some(toss) = self.tosses.get(self.next) {
            let index = self.next;
            self.next += 1;
            match Flight::new(toss) {
                Ok(flight) if flight.is_long() == self.long => {
                    lanes.launch(lane, self.plan, toss, flight);
                    if lanes.left[lane] > 0.0 && flight.rate.amax() > 0.0 {
                        lanes.flying[lane] = Some((index, flight));
                        return;
                    }
                    (self.land)(index, Ok(lanes.landing(lane, flight, self.plan)));
                }
                Err(error) if self.long => (self.land)(index, Err(error)),
                _ => self.skipped = true,
            }
        }
    }
}

impl Lanes {
    /// Sets `lane` to the launch of `toss`.
    fn launch(&mut self, lane: usize, plan: &Plan, toss: &Toss, flight: Flight) {
        let QuaternionSystem { rate_z, q } = QuaternionSystem::new(toss.coin.inertia_ratio(), flight.rate.z);
        for (part, value) in self.attitude.iter_mut().zip([1.0, 0.0, 0.0, 0.0]) {
            part[lane] = value;
        }
        let [x, y, z] = [flight.rate.x, flight.rate.y, rate_z].map(|rate| 0.5 * rate);
        (self.eta[0][lane], self.eta[1][lane], self.half_z[lane], self.q[lane]) = (x, y, z, q);
        (self.eta_low[0][lane], self.eta_low[1][lane]) = (0.0, 0.0);
        (self.left[lane], self.steps[lane]) = (flight.span(), 0);
        self.inverse_tolerance[lane] = 1.0 / flight.tightened(plan.tolerance);
    }

    /// Takes one step in each lane.
    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, plan: &Plan, series: &mut Series<S>) {
        let load = |numbers: &PerLane| Real::load(simd, numbers);
        let (eta, q, order) = (self.eta.each_ref().map(load), load(&self.q), plan.order);
        let (modulus, direction) = polar(eta);
        if plan.compensates {
            series.expand_eta_compensated(order, q);
        } else {
            series.expand_eta(order, q);
        }
        series.expand(order, modulus, load(&self.half_z));
        let h = self.step(simd, plan, series);
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

    /// The length of the next step in each lane: the shortest step times all of [`OCTAVES`] with which the last two
    /// terms stay within the tolerance, but no more than the remaining time. It is subtracted from the remaining time.
    #[inline(always)]
    fn step<S: Simd>(&mut self, simd: S, plan: &Plan, series: &Series<S>) -> Real<S> {
        let left = Real::load(simd, &self.left);
        let constant = |value: f64| left.constant(value);
        let last_but_one = series.size(plan.order - 1) * constant(plan.powers[0]);
        let last = series.size(plan.order) * constant(plan.powers[1]);
        let larger = last.less_than(last_but_one).choose(last_but_one, last);
        let mut term = larger * Real::load(simd, &self.inverse_tolerance);
        let mut h = constant(plan.shortest);
        for [longer, larger] in plan.growth {
            let (longer_h, larger_term) = (h * constant(longer), term * constant(larger));
            let within = larger_term.at_most(constant(1.0));
            (h, term) = (within.choose(longer_h, h), within.choose(larger_term, term));
        }
        // The step is rounded to a multiple of the last bit of the remaining time, so that the subtraction is exact.
        let h = (left + h) - left;
        let h = h.less_than(left).choose(h, left);
        (left - h).store(&mut self.left);
        h
    }

    /// Counts the step of `lane`. If the flight has landed or has reached the limit of steps, returns the index of its
    /// toss and its end, and leaves the lane idle.
    #[inline(always)]
    fn landed(&mut self, lane: usize, plan: &Plan) -> Option<(usize, Result<Landed, SolveError>)> {
        let (index, flight) = self.flying[lane]?;
        self.steps[lane] += 1;
        if self.left[lane] > 0.0 {
            let time = flight.in_seconds(flight.span() - self.left[lane]);
            let too_many = self.steps[lane] >= STEP_LIMIT;
            return too_many.then(|| {
                self.stop(lane);
                (index, Err(SolveError::StepLimit { time, limit: STEP_LIMIT }))
            });
        }
        self.stop(lane);
        Some((index, Ok(self.landing(lane, flight, plan))))
    }

    /// Makes `lane` idle. Its steps have length 0 from now on, and change nothing.
    fn stop(&mut self, lane: usize) {
        (self.flying[lane], self.left[lane]) = (None, 0.0);
    }

    /// The end state of the flight in `lane`.
    fn landing(&self, lane: usize, flight: Flight, plan: &Plan) -> Landed {
        let steps = u64::from(self.steps[lane]);
        let work = Work { rhs_calls: steps * plan.order as u64, accepted_steps: steps, rejected_steps: 0 };
        let [x, y] = self.eta.each_ref().map(|part| 2.0 * part[lane]);
        Landed { flight, turn: self.attitude.each_ref().map(|part| part[lane]), rate: [x, y], work }
    }
}

#[inline(always)]
fn store<S: Simd, const N: usize>(values: [Real<S>; N], parts: &mut [PerLane; N]) {
    for (value, part) in values.into_iter().zip(parts) {
        value.store(part);
    }
}
