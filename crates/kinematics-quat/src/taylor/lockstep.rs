//! Integrates flights by Taylor series, as many at once as a SIMD vector has lanes. Each instruction then
//! works on a different flight in each lane, which makes large batches fast.
//!
//! A lane whose flight has landed takes the next flight, so that no lane waits for the others. The result of a lane
//! depends on its flight alone, neither on the other lanes nor on the width of the vector. A landing therefore has the
//! same bits whichever flights are solved with it, and on every machine.
//!
//! Coins and other bodies fly in the same way: what their steps compute is a [`Motion`].

use dynamics::integrate::STEP_LIMIT;
use dynamics::{Body, Flight, SolveError, Toss, Work};
use numerics::lanes::{Real, Simd, SimdLevel, WithSimd};

use crate::landed::Landed;
use crate::taylor::plan::{StepPlan, StepPlans};

/// The number of lanes of the widest vectors.
pub(crate) const MOST_LANES: usize = 8;

/// One number for each lane.
pub(crate) type PerLane = [f64; MOST_LANES];

/// The states of the flights of one kind of body, one in each lane, in the unit of their [`Flight`].
pub(crate) trait Motion: Default {
    /// The kind of body.
    type Body: 'static;
    /// What a bound of the error has to know of the steps of a flight.
    type Bound;
    /// The coefficients of a step.
    type Series<S: Simd>;

    /// The body, if it is of this kind.
    fn body(body: &Body) -> Option<&Self::Body>;

    /// A series whose coefficients have not been computed yet.
    fn series<S: Simd>(simd: S) -> Self::Series<S>;

    /// Sets `lane` to the launch of `toss`, whose body this is.
    fn launch(&mut self, lane: usize, body: &Self::Body, toss: &Toss, flight: &Flight);

    /// Takes one step in each lane, of the length that `clock` chooses.
    fn advance<S: Simd>(&mut self, simd: S, plan: &StepPlan, series: &mut Self::Series<S>, clock: &mut Clock);

    /// The turn P and the rates of the `flight` in `lane`, along its axes and in its unit.
    fn state(&self, lane: usize, flight: &Flight) -> ([f64; 4], [f64; 3]);

    /// What a bound has to know of the flight in `lane`, which took so many `steps`.
    fn bound(&self, lane: usize, steps: u64) -> Self::Bound;
}

/// The end of a flight.
type End<M> = Result<Landed<<M as Motion>::Bound>, SolveError>;

/// The time that is left in each lane.
#[derive(Default)]
pub(crate) struct Clock {
    /// Remaining dimensionless time.
    left: PerLane,
    inverse_tolerance: PerLane,
}

impl Clock {
    /// The length of the next step in each lane, from the sizes of the last two coefficients. It is subtracted from the
    /// remaining time.
    #[inline(always)]
    pub(crate) fn step<S: Simd>(&mut self, simd: S, plan: &StepPlan, sizes: [Real<S>; 2]) -> Real<S> {
        let left = Real::load(simd, &self.left);
        let h = plan.step(left, Real::load(simd, &self.inverse_tolerance), sizes);
        (left - h).store(&mut self.left);
        h
    }
}

/// Solves those of the numbered `tosses` whose bodies are of this kind, first the short flights and then the long ones, and
/// calls `land` with the number and the landing of each. Lanes without a toss cost time, too, so that nothing is done if
/// there is none.
pub(crate) fn fly<'a, M: Motion>(
    plans: &StepPlans,
    tosses: impl Iterator<Item = (usize, &'a Toss)> + Clone,
    level: SimdLevel,
    mut land: impl FnMut(usize, End<M>),
) {
    let tosses = tosses.filter_map(|(index, toss)| Some((index, M::body(&toss.body)?, toss)));
    if tosses.clone().next().is_none() {
        return;
    }
    let mut run =
        |plan, long| level.run(Queue::<M> { plan, long, tosses: &mut tosses.clone(), skipped: false, land: &mut land });
    let skipped = run(&plans.short, false);
    if skipped {
        run(&plans.long, true);
    }
}

/// One pass through the tosses, for either the long flights or the short ones.
struct Queue<'a, 'toss, M: Motion> {
    plan: &'a StepPlan,
    /// Whether this pass solves the long flights, and skips the short ones, or the other way round.
    long: bool,
    /// Whether a toss was skipped.
    skipped: bool,
    /// The tosses to come, each with its number and its body.
    tosses: &'a mut dyn Iterator<Item = (usize, &'toss M::Body, &'toss Toss)>,
    land: &'a mut dyn FnMut(usize, End<M>),
}

/// The flight in each lane.
struct Lanes<M: Motion> {
    motion: M,
    clock: Clock,
    /// The number of steps so far.
    steps: [u32; MOST_LANES],
    /// The number of the toss in this lane and its flight; `None` for an idle lane.
    flying: [Option<(usize, Flight)>; MOST_LANES],
}

impl<M: Motion> WithSimd for Queue<'_, '_, M> {
    /// Whether a toss was skipped.
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> bool {
        let mut lanes = Lanes::<M>::default();
        let mut series = M::series(simd);
        for lane in 0..S::F64_LANES {
            self.start(&mut lanes, lane);
        }
        while lanes.flying.iter().any(Option::is_some) {
            lanes.motion.advance(simd, self.plan, &mut series, &mut lanes.clock);
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

impl<M: Motion> Queue<'_, '_, M> {
    /// Puts the next flight of this pass into `lane`. A flight of no duration or without rotation lands at once.
    fn start(&mut self, lanes: &mut Lanes<M>, lane: usize) {
        for (index, body, toss) in &mut *self.tosses {
            match Flight::new(toss) {
                Ok(flight) if flight.is_long() == self.long => {
                    lanes.launch(lane, self.plan, (body, toss), &flight);
                    if lanes.clock.left[lane] > 0.0 && flight.rate.amax() > 0.0 {
                        lanes.flying[lane] = Some((index, flight));
                        return;
                    }
                    (self.land)(index, Ok(lanes.landing(lane, &flight, self.plan)));
                }
                Err(error) if self.long => (self.land)(index, Err(error)),
                _ => self.skipped = true,
            }
        }
    }
}

impl<M: Motion> Default for Lanes<M> {
    fn default() -> Self {
        let flying = [None; MOST_LANES];
        Self { motion: M::default(), clock: Clock::default(), steps: [0; MOST_LANES], flying }
    }
}

impl<M: Motion> Lanes<M> {
    /// Sets `lane` to the launch of `toss`.
    fn launch(&mut self, lane: usize, plan: &StepPlan, (body, toss): (&M::Body, &Toss), flight: &Flight) {
        self.motion.launch(lane, body, toss, flight);
        (self.clock.left[lane], self.steps[lane]) = (flight.span(), 0);
        self.clock.inverse_tolerance[lane] = 1.0 / flight.tightened(plan.tolerance);
    }

    /// Counts the step of `lane`. If the flight has landed or has reached the limit of steps, returns the number of its
    /// toss and its end, and leaves the lane idle.
    #[inline(always)]
    fn landed(&mut self, lane: usize, plan: &StepPlan) -> Option<(usize, End<M>)> {
        let (index, flight) = self.flying[lane].as_ref()?;
        let index = *index;
        self.steps[lane] += 1;
        let landed = if self.clock.left[lane] > 0.0 {
            if self.steps[lane] < STEP_LIMIT {
                return None;
            }
            let time = flight.in_seconds(flight.span() - self.clock.left[lane]);
            Err(SolveError::StepLimit { time, limit: STEP_LIMIT })
        } else {
            Ok(self.landing(lane, flight, plan))
        };
        self.stop(lane);
        Some((index, landed))
    }

    /// Makes `lane` idle. Its steps have length 0 from now on, and change nothing.
    fn stop(&mut self, lane: usize) {
        (self.flying[lane], self.clock.left[lane]) = (None, 0.0);
    }

    /// The end of the flight in `lane`.
    fn landing(&self, lane: usize, flight: &Flight, plan: &StepPlan) -> Landed<M::Bound> {
        let steps = u64::from(self.steps[lane]);
        let work = Work { rhs_calls: steps * plan.order as u64, accepted_steps: steps, rejected_steps: 0 };
        Landed::new(flight, self.motion.state(lane, flight), work, self.motion.bound(lane, steps))
    }
}

#[inline(always)]
pub(crate) fn store<S: Simd, const N: usize>(values: [Real<S>; N], parts: &mut [PerLane; N]) {
    for (value, part) in values.into_iter().zip(parts) {
        value.store(part);
    }
}
