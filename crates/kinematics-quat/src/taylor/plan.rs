//! How long the steps by Taylor series are, and of which order: constants that follow from the tolerance, and the choice
//! of each step by the last two terms of its series.

use numerics::lanes::{Real, Simd};

/// The highest order of a step.
pub(crate) const LARGEST_ORDER: usize = 26;

/// Exponents of two by which the shortest step of a coin is multiplied, tried one after the other from the largest on.
/// A factor is kept if the last terms of the series allow it.
const OCTAVES_OF_COINS: [f64; 6] = [2.0, 1.0, 0.5, 0.25, 0.125, 0.0625];

/// Those of other bodies, whose steps differ more: their series converge up to the nearest pole alone.
const OCTAVES_OF_BODIES: [f64; 6] = [4.0, 2.0, 1.0, 0.5, 0.25, 0.125];

/// An upper bound of the rates at which terms of the series of a coin turn, ½ (ωL + |q|) with I3 ≤ 2 I1, in the unit of
/// [`Flight`](dynamics::Flight), in which no component of ω reaches 2.
const FASTEST: f64 = 4.0;

/// A lower bound of the distance from the time of a step to the nearest pole of a rigid body's rate, in the same unit,
/// with a factor of almost two to spare. The poles are at distances of at least K'/λ, where K' ≥ π/2 and λ ≤ |ω| < 2√3.
const NEAREST_POLE: f64 = 0.25;

/// Tolerances below this one need compensated rates, that is, η with twice as many digits. Without them the rounding
/// error of ε |ω| in each step adds up to 1e-13 in a flight of 100 rad.
const ROUNDING: f64 = 5e-13;

/// The constants of a step that follow from the tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StepPlan {
    pub(crate) tolerance: f64,
    /// The order of the series, which is even.
    pub(crate) order: usize,
    /// Whether the rates of a coin are carried with twice as many digits.
    pub(crate) compensates: bool,
    /// The shortest step, with which the last term is within the tolerance at the fastest rates.
    shortest: f64,
    /// The powers of the shortest step in the last two terms of the series.
    powers: [f64; 2],
    /// For each of the octaves, the factors by which it multiplies the step and the last term.
    growth: [[f64; 2]; OCTAVES_OF_COINS.len()],
}

impl StepPlan {
    /// The constants of coins, for local errors of `tolerance`.
    fn of_coins(tolerance: f64) -> Self {
        let order = order(tolerance);
        // The last term of the series of exp(i λ t) is (λ t)^order/order!, which is the tolerance at this time:
        let factorial: f64 = (1..=order).map(|k| k as f64).product();
        let shortest = (tolerance * factorial).powf(1.0 / order as f64) / FASTEST;
        Self::new(tolerance, order, shortest, OCTAVES_OF_COINS)
    }

    /// The constants of other bodies, for local errors of `tolerance`.
    fn of_bodies(tolerance: f64) -> Self {
        let order = order(tolerance);
        // Terms of a series with a pole at the distance ρ fall like (t/ρ)^order.
        let shortest = NEAREST_POLE * tolerance.powf(1.0 / order as f64);
        Self::new(tolerance, order, shortest, OCTAVES_OF_BODIES)
    }

    fn new(tolerance: f64, order: usize, shortest: f64, octaves: [f64; 6]) -> Self {
        let power = std::iter::repeat_n(shortest, order - 1).product::<f64>();
        Self {
            tolerance,
            order,
            compensates: tolerance < ROUNDING,
            shortest,
            powers: [power, power * shortest],
            growth: octaves.map(|octaves| [octaves, octaves * order as f64].map(f64::exp2)),
        }
    }

    /// The length of the next step in each lane: the shortest step times all of the octaves with which the last two
    /// terms stay within the tolerance, but no more than the time that is `left`. `sizes` are the sizes of the last two
    /// coefficients.
    #[inline(always)]
    pub(crate) fn step<S: Simd>(
        &self,
        left: Real<S>,
        inverse_tolerance: Real<S>,
        [last_but_one, last]: [Real<S>; 2],
    ) -> Real<S> {
        let constant = |value: f64| left.constant(value);
        let last_but_one = last_but_one * constant(self.powers[0]);
        let last = last * constant(self.powers[1]);
        let larger = last.less_than(last_but_one).choose(last_but_one, last);
        let mut term = larger * inverse_tolerance;
        let mut h = constant(self.shortest);
        for [longer, larger] in self.growth {
            let (longer_h, larger_term) = (h * constant(longer), term * constant(larger));
            let within = larger_term.at_most(constant(1.0));
            (h, term) = (within.choose(longer_h, h), within.choose(larger_term, term));
        }
        // The step is rounded to a multiple of the last bit of the remaining time, so that the subtraction is exact.
        let h = (left + h) - left;
        h.less_than(left).choose(h, left)
    }
}

/// The even order that was measured to take the least time for a given error: 18 for a tolerance of 1e-3, and 26 from
/// 1e-7 on. Four orders more or less change the time by less than a tenth.
fn order(tolerance: f64) -> usize {
    let decades = -tolerance.log10();
    let half = (6.5 + 0.83 * decades).ceil();
    (2 * half as usize).min(LARGEST_ORDER)
}

/// The plans of a solver with a given tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Taylor {
    pub(crate) tolerance: f64,
    pub(crate) coins: StepPlans,
    /// Those of other bodies.
    pub(crate) bodies: StepPlans,
}

impl Taylor {
    /// Those for local errors of `tolerance`.
    pub(crate) fn new(tolerance: f64) -> Self {
        Self { tolerance, coins: StepPlans::of_coins(tolerance), bodies: StepPlans::of_bodies(tolerance) }
    }

    /// Whether the tolerance is the finest one, so that another flight is no finer.
    pub(crate) fn is_finest(&self) -> bool {
        self.tolerance == f64::EPSILON
    }
}

/// The plans of one kind of body with a given tolerance, for short and for long flights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct StepPlans {
    pub(crate) short: StepPlan,
    /// The plan of [long](dynamics::Flight::is_long) flights. Each of them has a tolerance of its own, so that all take
    /// the order of the finest tolerance, and compensated rates.
    pub(crate) long: StepPlan,
}

impl StepPlans {
    /// The plans of coins, for local errors of `tolerance`.
    pub(crate) fn of_coins(tolerance: f64) -> Self {
        Self::by(StepPlan::of_coins, tolerance)
    }

    /// The plans of other bodies, for local errors of `tolerance`.
    pub(crate) fn of_bodies(tolerance: f64) -> Self {
        Self::by(StepPlan::of_bodies, tolerance)
    }

    fn by(plan: fn(f64) -> StepPlan, tolerance: f64) -> Self {
        Self { short: plan(tolerance), long: StepPlan { tolerance, ..plan(f64::EPSILON) } }
    }

    /// The plans of coins for local errors of so large a `tolerance` that rounding does not matter in long flights either.
    pub(crate) fn of_coarse_coins(tolerance: f64) -> Self {
        let plan = StepPlan::of_coins(tolerance);
        Self { short: plan, long: plan }
    }

    /// The plan of long or of short flights.
    pub(crate) fn of(&self, long: bool) -> &StepPlan {
        if long { &self.long } else { &self.short }
    }

    /// Equal steps of coins, of this order and length in the unit of the flight.
    #[cfg(test)]
    pub(crate) fn fixed(order: usize, step: f64) -> Self {
        let finest = StepPlan::of_coins(f64::EPSILON);
        let plan = StepPlan { order, compensates: false, shortest: step, growth: [[1.0; 2]; 6], ..finest };
        Self { short: plan, long: plan }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_flights_have_the_tolerance_that_was_asked_for() {
        for plans in [StepPlans::of_coins(1e-7), StepPlans::of_bodies(1e-7)] {
            assert_eq!([plans.short.tolerance, plans.long.tolerance], [1e-7; 2]);
        }
    }
}
