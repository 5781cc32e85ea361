//! Flights by Taylor series, as many at once as a vector has lanes.
//!
//! A lane whose flight has landed takes the next one, so that no lane waits for its neighbours. What a lane computes
//! depends on its flight alone, neither on its neighbours nor on the width of the vector, so that landings have the
//! same bits in any company and on any machine.

use dynamics::integrate::STEP_LIMIT;
use dynamics::{Flight, SolveError, Toss, Work};
use numerics::lanes::{Real, Simd, SimdLevel, WithSimd, compensated_product, complex_product, polar};

use crate::product::turned;
use crate::taylor::{LARGEST_ORDER, Series};
use crate::{Landed, QuaternionSystem};

/// As many lanes as the widest vectors have.
const MOST_LANES: usize = 8;

/// Octaves by which the shortest step is lengthened as far as its last terms allow, from the largest on.
const OCTAVES: [f64; 6] = [2.0, 1.0, 0.5, 0.25, 0.125, 0.0625];

/// Above the rate of any term of the series (in the unit of [`Flight`], in which no component of ω reaches 2): half the sum
/// of ωL and |q|, with I3 ≤ 2 I1.
const FASTEST: f64 = 4.0;

/// Tolerances below it ask for compensated rates: without them an error of ε |ω| a step comes to 1e-13 in a flight of 100 rad.
const ROUNDING: f64 = 5e-13;

/// How a step is taken.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Plan {
    tolerance: f64,
    /// Even.
    order: usize,
    /// Whether η is carried with twice as many digits.
    compensates: bool,
    /// The shortest step, and its powers that belong to the last two terms.
    shortest: f64,
    powers: [f64; 2],
    /// For each of [`OCTAVES`], by what it lengthens the step and the last term.
    growth: [[f64; 2]; OCTAVES.len()],
}

impl Plan {
    /// For local errors of `tolerance`.
    fn new(tolerance: f64) -> Self {
        let order = order(tolerance);
        let degree = order as f64;
        // exp(i λ t) has the last term tolerance at (tolerance order!)^(1/order)/λ.
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

/// The even order that takes the least time for an error, by measurement: 18 for 1e-3 and 26 from 1e-7 on. The time changes
/// by less than a tenth for four orders more or less.
fn order(tolerance: f64) -> usize {
    let decades = -tolerance.log10();
    let half = (6.5 + 0.83 * decades).ceil();
    (2 * half as usize).min(LARGEST_ORDER)
}

/// How flights of one tolerance are stepped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Plans {
    short: Plan,
    /// Long flights have a tighter tolerance each: they take the order of the finest one, and compensated rates.
    long: Plan,
}

impl Plans {
    /// For local errors of `tolerance`.
    pub(crate) fn new(tolerance: f64) -> Self {
        Self { short: Plan::new(tolerance), long: Plan { tolerance, ..Plan::new(f64::EPSILON) } }
    }

    /// Flies `tosses`, the long flights after all others, and gives `land` the number and the landing of each.
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

/// Flights to be made.
struct Queue<'a> {
    plan: &'a Plan,
    /// Whether the long flights are wanted, or all others; and whether such were skipped as are not.
    long: bool,
    skipped: bool,
    tosses: &'a [Toss],
    next: usize,
    land: &'a mut dyn FnMut(usize, Result<Landed, SolveError>),
}

/// A number for each lane.
type PerLane = [f64; MOST_LANES];

/// Where the flights are. Rates are halved.
#[derive(Default)]
#[repr(align(64))]
struct Lanes {
    attitude: [PerLane; 4],
    eta: [PerLane; 2],
    eta_low: [PerLane; 2],
    half_z: PerLane,
    q: PerLane,
    /// Dimensionless time that is left.
    left: PerLane,
    inverse_tolerance: PerLane,
    steps: [u32; MOST_LANES],
    /// Which toss flies, and its flight.
    flying: [Option<(usize, Flight)>; MOST_LANES],
}

impl WithSimd for Queue<'_> {
    /// Whether flights were skipped.
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
    /// Puts the next wanted flight into `lane`. One that ends where it starts lands at once.
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
    /// Puts the launch of a toss into `lane`.
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

    /// One step in each lane.
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
        // v in the body's own axes.
        let attitude = turned(self.attitude.each_ref().map(load), [u, complex_product(direction, v)]);
        store(attitude, &mut self.attitude);
        store(after, &mut self.eta);
        store(lost, &mut self.eta_low);
    }

    /// The longest step whose last two terms are within the tolerance, or all that is left, which it is taken from.
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
        // As a multiple of the last bit of what is left, so that the difference is exact.
        let h = (left + h) - left;
        let h = h.less_than(left).choose(h, left);
        (left - h).store(&mut self.left);
        h
    }

    /// The number and the end of the flight in `lane`, if the step was its last.
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

    /// Leaves `lane` to idle: a step of no length changes nothing.
    fn stop(&mut self, lane: usize) {
        (self.flying[lane], self.left[lane]) = (None, 0.0);
    }

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
