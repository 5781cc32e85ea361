//! The flights of bodies in the lanes of a vector, each with a bound of its error: the same steps with the same bits, and
//! what they add to the bound.

use dynamics::{Body, Flight, ModelBody, RigidBody, Toss};
use numerics::lanes::{Real, Simd};

use crate::prove::polhode::{Errors, Polhode, Step};
use crate::taylor::lockstep::{Clock, MOST_LANES, Motion, PerLane, store};
use crate::taylor::plan::StepPlan;
use crate::taylor::rigid::{Bodies, RigidSeries};

/// The state of the body in each lane.
#[derive(Default)]
#[repr(align(64))]
pub(crate) struct Enclosed {
    bodies: Bodies,
    /// `None` for a flight without a bound.
    errors: [Option<Errors>; MOST_LANES],
    /// The body that was launched last, and its model, which takes longer than a flight where moments are nearly equal.
    model: Option<(RigidBody, ModelBody)>,
}

/// What a landing by [`Enclosed`] states.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bound {
    /// Of the turn since launch, for a time of flight that is right; infinite or NaN where there is none.
    pub(crate) turn: f64,
    /// An upper bound of the rate, in the unit of the flight.
    pub(crate) fastest: f64,
}

impl Motion for Enclosed {
    type Body = RigidBody;
    /// `None` for a flight without a bound.
    type Bound = Option<Bound>;
    type Series<S: Simd> = RigidSeries<S>;

    fn body(body: &Body) -> Option<&RigidBody> {
        Bodies::body(body)
    }

    #[inline(always)]
    fn series<S: Simd>(simd: S) -> RigidSeries<S> {
        Bodies::series(simd)
    }

    fn launch(&mut self, lane: usize, body: &RigidBody, toss: &Toss, flight: &Flight) {
        self.bodies.launch(lane, body, toss, flight);
        let model = match self.model {
            Some((known, model)) if known == *body => model,
            _ => body.model(),
        };
        self.model = Some((*body, model));
        let polhode = Polhode::new(toss, &model, flight);
        self.errors[lane] = polhode.map(|polhode| Errors::at_launch(polhode, flight.rate.into()));
    }

    #[inline(always)]
    fn advance<S: Simd>(&mut self, simd: S, plan: &StepPlan, series: &mut RigidSeries<S>, clock: &mut Clock) {
        let h = self.bodies.step(simd, plan, series, clock);
        let twice = self.bodies.twice.each_ref().map(|numbers| Real::load(simd, numbers));
        let defect = series.defect(plan.order, h, twice);
        let mut stored: [PerLane; 4] = [[0.0; MOST_LANES]; 4];
        store([h, defect.turn, defect.rates, defect.rounding], &mut stored);
        for lane in 0..S::F64_LANES {
            self.add(lane, stored.each_ref().map(|lanes| lanes[lane]));
        }
    }

    fn state(&self, lane: usize, flight: &Flight) -> ([f64; 4], [f64; 3]) {
        self.bodies.state(lane, flight)
    }

    fn bound(&self, lane: usize, _: u64) -> Option<Bound> {
        self.errors[lane].as_ref().map(|errors| Bound { turn: errors.bound(), fastest: errors.fastest() })
    }
}

impl Enclosed {
    /// Adds a step of `lane`. The errors of an idle lane, which has steps of no length, are read no more.
    fn add(&mut self, lane: usize, [h, turn, rates, rounding]: [f64; 4]) {
        if let Some(errors) = self.errors[lane].as_mut() {
            let after = self.bodies.rates(lane);
            errors.add(&Step { h, turn, rates, rounding, after });
        }
    }
}
