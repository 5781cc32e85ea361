//! Integrates flights by Taylor series, as many at once as a SIMD vector has lanes. Each instruction then
//! works on a different flight in each lane, which makes large batches fast.
//!
//! A lane whose flight has landed takes the next flight, so that no lane waits for the others. The result of a lane
//! depends on its flight alone, neither on the other lanes nor on the width of the vector. A landing therefore has the
//! same bits whichever flights are solved with it, and on every machine.
//!
//! Coins and other bodies fly in the same way: what their steps compute is a [`Motion`].

use dynamics::integrate::STEP_LIMIT;
use dynamics::{Body, CoinToss, Flight, SolveError, Toss, Work};
use numerics::lanes::{Real, Simd, SimdLevel, WithSimd};

use crate::Landed;
use crate::taylor::plan::{StepPlan, StepPlans};

/// The number of lanes of the widest vectors.
pub(crate) const MOST_LANES: usize = 8;

/// One number for each lane.
pub(crate) type PerLane = [f64; MOST_LANES];

/// The states of the flights of one kind of body, one in each lane, in the unit of their [`Flight`].
pub(crate) trait Motion: Default {
    /// What is solved.
    type Toss: Copy;
    /// Its dimensionless form.
    type Flight: Copy;
    /// The coefficients of a step.
    type Series<S: Simd>;

    /// The dimensionless form of `toss`.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    fn flight(toss: &Self::Toss) -> Result<Self::Flight, SolveError>;

    /// Times and tolerances of a flight.
    fn timing(flight: &Self::Flight) -> &Flight;

    /// A series whose coefficients have not been computed yet.
    fn series<S: Simd>(simd: S) -> Self::Series<S>;

    /// Sets `lane` to the launch of `toss`.
    fn launch(&mut self, lane: usize, toss: &Self::Toss, flight: &Self::Flight);

    /// Takes one step in each lane, of the length that `clock` chooses.
    fn advance<S: Simd>(&mut self, simd: S, plan: &StepPlan, series: &mut Self::Series<S>, clock: &mut Clock);

    /// The end state of the flight in `lane`.
    fn landing(&self, lane: usize, flight: &Self::Flight, work: Work) -> Landed;
}

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

/// Solves the tosses that `toss` has for the indices below `len`, first the short flights and then the long ones, and calls
/// `land` with the index and the landing of each. Lanes without a toss cost time, too, so that nothing is done if there is
/// none.
pub(crate) fn fly<M: Motion>(
    plans: &StepPlans,
    (len, toss): (usize, impl Fn(usize) -> Option<M::Toss>),
    level: SimdLevel,
    mut land: impl FnMut(usize, Result<Landed, SolveError>),
) {
    if !(0..len).any(|index| toss(index).is_some()) {
        return;
    }
    let mut run =
        |plan, long| level.run(Queue::<M> { plan, long, toss: &toss, len, next: 0, skipped: false, land: &mut land });
    let skipped = run(&plans.short, false);
    if skipped {
        run(&plans.long, true);
    }
}

/// As [`fly`], all `tosses` of a slice.
pub(crate) fn fly_all<M: Motion>(
    plans: &StepPlans,
    tosses: &[M::Toss],
    level: SimdLevel,
    land: impl FnMut(usize, Result<Landed, SolveError>),
) {
    fly::<M>(plans, (tosses.len(), |index: usize| Some(tosses[index])), level, land);
}

/// One pass through the tosses, for either the long flights or the short ones.
struct Queue<'a, M: Motion> {
    plan: &'a StepPlan,
    /// Whether this pass solves the long flights, and skips the short ones, or the other way round.
    long: bool,
    /// Whether a toss was skipped.
    skipped: bool,
    /// The toss of an index below `len`, if there is one.
    toss: &'a dyn Fn(usize) -> Option<M::Toss>,
    len: usize,
    /// The index of the next toss.
    next: usize,
    land: &'a mut dyn FnMut(usize, Result<Landed, SolveError>),
}

/// The flight in each lane.
struct Lanes<M: Motion> {
    motion: M,
    clock: Clock,
    /// The number of steps so far.
    steps: [u32; MOST_LANES],
    /// The index of the toss in this lane and its flight; `None` for an idle lane.
    flying: [Option<(usize, M::Flight)>; MOST_LANES],
}

impl<M: Motion> WithSimd for Queue<'_, M> {
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

impl<M: Motion> Queue<'_, M> {
    /// Puts the next flight of this pass into `lane`. A flight of no duration or without rotation lands at once.
    fn start(&mut self, lanes: &mut Lanes<M>, lane: usize) {
        while self.next < self.len {
            let index = self.next;
            self.next += 1;
            let Some(toss) = (self.toss)(index) else { continue };
            match M::flight(&toss) {
                Ok(flight) if M::timing(&flight).is_long() == self.long => {
                    lanes.launch(lane, self.plan, &toss, &flight);
                    if lanes.clock.left[lane] > 0.0 && M::timing(&flight).rate.amax() > 0.0 {
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
    fn launch(&mut self, lane: usize, plan: &StepPlan, toss: &M::Toss, flight: &M::Flight) {
        self.motion.launch(lane, toss, flight);
        let timing = M::timing(flight);
        (self.clock.left[lane], self.steps[lane]) = (timing.span(), 0);
        self.clock.inverse_tolerance[lane] = 1.0 / timing.tightened(plan.tolerance);
    }

    /// Counts the step of `lane`. If the flight has landed or has reached the limit of steps, returns the index of its
    /// toss and its end, and leaves the lane idle.
    #[inline(always)]
    fn landed(&mut self, lane: usize, plan: &StepPlan) -> Option<(usize, Result<Landed, SolveError>)> {
        let (index, flight) = self.flying[lane]?;
        self.steps[lane] += 1;
        if self.clock.left[lane] > 0.0 {
            let timing = M::timing(&flight);
            let time = timing.in_seconds(timing.span() - self.clock.left[lane]);
            let too_many = self.steps[lane] >= STEP_LIMIT;
            return too_many.then(|| {
                self.stop(lane);
                (index, Err(SolveError::StepLimit { time, limit: STEP_LIMIT }))
            });
        }
        self.stop(lane);
        Some((index, Ok(self.landing(lane, &flight, plan))))
    }

    /// Makes `lane` idle. Its steps have length 0 from now on, and change nothing.
    fn stop(&mut self, lane: usize) {
        (self.flying[lane], self.clock.left[lane]) = (None, 0.0);
    }

    /// The end state of the flight in `lane`.
    fn landing(&self, lane: usize, flight: &M::Flight, plan: &StepPlan) -> Landed {
        let steps = u64::from(self.steps[lane]);
        let work = Work { rhs_calls: steps * plan.order as u64, accepted_steps: steps, rejected_steps: 0 };
        self.motion.landing(lane, flight, work)
    }
}

/// The results of `coins` for the tosses of coins and of `bodies` for the others, in the order of `tosses`.
pub(crate) fn by_kind<T>(
    tosses: &[Toss],
    coins: impl FnOnce(&[CoinToss]) -> Vec<T>,
    bodies: impl FnOnce(&[Toss]) -> Vec<T>,
) -> Vec<T> {
    let of_coins: Vec<CoinToss> = tosses.iter().filter_map(Toss::coin).collect();
    if of_coins.len() == tosses.len() {
        return coins(&of_coins);
    }
    if of_coins.is_empty() {
        return bodies(tosses);
    }
    let is_coin = |toss: &&Toss| matches!(toss.body, Body::Coin(_));
    let others: Vec<Toss> = tosses.iter().filter(|toss| !is_coin(toss)).copied().collect();
    let (mut coins, mut bodies) = (coins(&of_coins).into_iter(), bodies(&others).into_iter());
    tosses.iter().filter_map(|toss| if is_coin(&toss) { coins.next() } else { bodies.next() }).collect()
}

#[inline(always)]
pub(crate) fn store<S: Simd, const N: usize>(values: [Real<S>; N], parts: &mut [PerLane; N]) {
    for (value, part) in values.into_iter().zip(parts) {
        value.store(part);
    }
}
