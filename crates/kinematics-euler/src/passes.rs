//! [`Passes`], how a flight passes the singular points of its angles, by which its error estimate grows in the vertical frame.
//!
//! Where n comes near the vertical, at sin β = s, the angle α turns by about π in a time s/β'. Its Taylor series converge
//! for as long as that, and so the error that a scheme estimates in a step is that of the step only if the step is shorter:
//! if α turns by less than about a radian. In a longer step it may be anything. The γ-ODE also recovers β from D and u, whose
//! errors it divides by |α'| = √(D² + u²).
//!
//! Measured over 240 000 flights of random coins at tolerances from 1e-12 to 1e-3: where no step turns α by more than 0.8
//! rad, errors of the Euler angles are at most a twelfth of the [estimate](dynamics::Stepping::error_estimate), and those of
//! the γ-ODE a third of it times the rates by |α'|. Of other flights they were up to 4.4 of it, and the more flights, the
//! more.

use std::cell::Cell;

use dynamics::{Formulation, Frame};

/// The largest turn of α in a step (rad) with which errors are those of a regular motion.
const LARGEST_TURN: f64 = 0.5;

/// How many times as large the estimate is for other flights.
const UNRESOLVED: f64 = 100.0;

/// What the steps of a flight met.
#[derive(Debug)]
pub(crate) struct Passes {
    /// The largest change of α in a step (rad).
    turned: Cell<f64>,
    /// The largest factor by which a difference of the rates counts in an angle, at least 1.
    magnified: Cell<f64>,
}

impl Passes {
    /// Before the first step.
    pub(crate) fn none() -> Self {
        Self { turned: Cell::new(0.0), magnified: Cell::new(1.0) }
    }

    /// Notes a step in which α turns by this angle (rad).
    pub(crate) fn turned(&self, turn: f64) {
        self.turned.set(self.turned.get().max(turn.abs()));
    }

    /// Notes that an error of the rates counts so many times in an angle.
    pub(crate) fn magnified(&self, factor: f64) {
        self.magnified.set(self.magnified.get().max(factor));
    }

    /// By how much the error estimate of a flight in this formulation is above that of a regular motion.
    pub(crate) fn growth(&self, formulation: Formulation) -> f64 {
        let unresolved = if self.turned.get() > LARGEST_TURN { UNRESOLVED } else { 1.0 };
        match formulation.frame() {
            Frame::Momentum => 1.0,
            Frame::Vertical => unresolved * self.magnified.get(),
        }
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Body, Coin, Launch, Scheme, Solver, Stepping, TimeOfFlight, Toss};
    use exact::ExactSolver;

    use super::*;
    use crate::{EulerAnglesSolver, GammaSolver};

    /// Flights of all kinds, from rough ones on. Without the growth the errors of the Euler angles are up to half of the
    /// estimate and those of the γ-ODE above it.
    #[test]
    fn errors_next_to_singular_points_are_below_a_quarter_of_the_estimate() {
        let mut state = 88_172_645_463_325_252_u64;
        let mut between = |from: f64, to: f64| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            from + (to - from) * ((state >> 11) as f64 / (1_u64 << 53) as f64)
        };
        let mut flown = 0;
        for index in 0..24_000 {
            let scheme = [Scheme::DOPRI5, Scheme::DOP853][index % 2];
            let stepping = Stepping::adaptive(scheme, 10f64.powf(between(-7.0, -2.5))).unwrap();
            let rate = [0; 3].map(|_| between(-1.0, 1.0) * 10f64.powf(between(-1.0, 1.0)));
            let time = 10f64.powf(between(-1.0, 1.5)) / dynamics::Vector3::from(rate).norm();
            let tilt = if between(0.0, 1.0) < 0.3 { 0.0 } else { between(-3.0, 3.0) };
            let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap().with_tilt(tilt).unwrap();
            let [a, b, c] = [0; 3].map(|_| between(0.1, 1.0));
            let body = match index % 8 {
                0 => Body::from_moments([b + c, a + c, a + b]).unwrap(),
                1..5 => Coin::from_moments(1.0, 0.1 * between(0.0, 1.0)).unwrap().into(),
                _ => Coin::from_moments(1.0, between(0.0, 2.0)).unwrap().into(),
            };
            let toss = Toss { body, launch };
            let euler = EulerAnglesSolver::new(stepping, Formulation::VERTICAL).land(&toss);
            let gamma = GammaSolver::new(stepping, Formulation::VERTICAL).land(&toss);
            let exact = ExactSolver.land(&toss).unwrap();
            for landing in [euler, gamma].into_iter().flatten() {
                let Some(estimate) = landing.error else { continue };
                let error = (landing.cos_tilt - exact.cos_tilt).abs();
                assert!(error <= 0.25 * estimate, "{error:e} of {estimate:e}, {stepping:?}, {toss:?}");
                flown += 1;
            }
        }
        assert!(flown > 30_000, "{flown}");
    }

    #[test]
    fn growth_is_that_of_the_worst_step_in_the_vertical_frame() {
        let passes = Passes::none();
        assert_eq!(passes.growth(Formulation::VERTICAL), 1.0);
        passes.turned(-LARGEST_TURN);
        passes.magnified(0.5);
        assert_eq!(passes.growth(Formulation::VERTICAL), 1.0);
        passes.magnified(8.0);
        passes.magnified(2.0);
        assert_eq!(passes.growth(Formulation::VERTICAL), 8.0);
        passes.turned(-LARGEST_TURN.next_up());
        passes.turned(0.1);
        assert_eq!([Formulation::VERTICAL, Formulation::MOMENTUM].map(|by| passes.growth(by)), [800.0, 1.0]);
    }
}
