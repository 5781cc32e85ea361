//! The search for flips along one input of a toss, by Taylor models that contain whole intervals of it: balls alone would forget how cos θ
//! depends on the input.
//!
//! An interval that is not decided is halved. If that does not help, the toss at its middle tells why: where the same
//! digits decide it, the interval is too wide. Else digits are what is missing, as next to the separatrix, and the next
//! stage has more.
//! The search passes no toss that it cannot decide: it ends there, and says how far it came.

use std::cell::OnceCell;

use dynamics::{Outcome, Toss};
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{Ball, DoubleDouble, Elementary, TaylorModel, WideBall};

use super::cos_tilt;
use super::given::Given;
use super::special::Special;
use crate::given::rounded;

/// Width of the interval that a flip is known to lie in, in parts of its distance; also the shortest step.
pub(super) const RESOLUTION: f64 = 2.5e-13;

/// Digits of the stages after f64 and double-double.
const DIGITS: [usize; 3] = [256, 448, 960];

/// The work of evaluating a toss in each stage, roughly in units of 2 µs, and that of an interval of tosses.
const WORK: [u32; 2 + DIGITS.len()] = [2, 8, 700, 1000, 2000];
const WORK_OF_INTERVAL: [u32; 2] = [20, 160];

/// The work that a search for the next flip may take, less than a second.
pub(super) const MOST_WORK: u32 = 400_000;

/// How many times as long a step is as one that was decided: after the first one that was not, and after a flip, from which steps begin
/// anew.
const GROWTH: f64 = 1.5;
const GROWTH_AFTER_FLIP: f64 = 8.0;

/// Part of the way to a flip that is known to be ahead by which a step goes.
const NEARLY: f64 = 0.99;

/// An input of a toss.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Input {
    /// A component of the rate (BF, rad/s).
    Rate(usize),
    /// The time of flight (s).
    Time,
}

/// The tosses that differ from one in a single input.
pub(super) struct Line<'a> {
    toss: &'a Toss,
    input: Input,
    /// The special motion that all these tosses have.
    special: Option<Special>,
    rough: Given<Ball<f64>>,
    fine: Given<Ball<DoubleDouble>>,
    /// Those of more digits, made when they are needed.
    many: [OnceCell<Given<WideBall>>; DIGITS.len()],
}

impl<'a> Line<'a> {
    pub(super) fn new(toss: &'a Toss, input: Input) -> Self {
        let fine = Given::in_double_double(toss, None);
        let special = special(toss, input);
        Self { toss, input, special, rough: fine.map(rounded), fine, many: Default::default() }
    }

    /// The sign of cos θ at all changes within `radius` of `change`, in a stage: 0 if it is not proven.
    fn sign_in(&self, stage: usize, change: f64, radius: f64) -> f64 {
        match stage {
            0 => self.sign(&self.rough, change, radius),
            1 => self.sign(&self.fine, change, radius),
            // More digits tell the outcome of a toss; over an interval of tosses, double-double has enough.
            _ if radius > 0.0 => 0.0,
            _ => {
                let digits = stage - 2;
                let given = self.many[digits].get_or_init(|| Given::in_digits(self.toss, None, DIGITS[digits]));
                self.sign(given, change, radius)
            }
        }
    }

    /// The same by what was given in one kind of number.
    fn sign<N: Elementary>(&self, given: &Given<N>, change: f64, radius: f64) -> f64 {
        let cos_tilt = if radius > 0.0 {
            let models = self.models(given, [change, radius]);
            models.turn_over_interval(self.special).map(|turn| cos_tilt(&turn, &models.vertical).range())
        } else {
            let toss = self.moved(given, change);
            toss.turn(self.special).map(|turn| cos_tilt(&turn, &toss.vertical))
        };
        cos_tilt.filter(N::has_known_sign).map_or(0.0, |cos_tilt| cos_tilt.sign())
    }

    /// What is given of all changes within `radius` of `change`, as Taylor models.
    fn models<N: Elementary>(&self, given: &Given<N>, [change, radius]: [f64; 2]) -> Given<TaylorModel<N>> {
        let moved = self.moved(given, change);
        let mut models = moved.map(|part| TaylorModel::constant(part.clone()));
        let width = moved.time.like(radius);
        match self.input {
            Input::Rate(axis) => {
                models.rate[axis] = TaylorModel::variable(moved.rate[axis].clone(), moved.in_unit(&width));
            }
            Input::Time => models.time = TaylorModel::variable(moved.time.clone(), moved.time_in_unit(&width)),
        }
        models
    }

    /// What is given of the toss with this change, in a unit near the largest rate.
    fn moved<N: Elementary>(&self, given: &Given<N>, change: f64) -> Given<N> {
        let mut moved = given.clone();
        let number = given.time.like(change);
        match self.input {
            Input::Rate(axis) => {
                let largest = self.toss.launch.rate().amax().max(change.abs());
                moved = moved.with_exponent(mantissa_and_exponent(power_of_two_scale(largest)).1);
                moved.rate[axis] = moved.rate[axis].clone() + moved.in_unit(&number);
            }
            Input::Time => moved.time = moved.time.clone() + moved.time_in_unit(&number),
        }
        moved
    }

    /// The sign of cos θ for this change, 0 if no stage decides it. `work` is added to.
    fn sign_at(&self, change: f64, work: &mut u32) -> f64 {
        let sign = |(stage, of_stage)| {
            *work += of_stage;
            self.sign_in(stage, change, 0.0)
        };
        WORK.into_iter().enumerate().map(sign).find(|sign| *sign != 0.0).unwrap_or(0.0)
    }

    /// The sign of cos θ at all changes within `radius` of `change`, and the stage that proves it: `None` if none does, for
    /// the interval is too wide or the digits have run out. Stages above `enough` are tried if `is_retry`, while the toss
    /// at the middle is not decided. `work` is added to.
    fn sign_around(
        &self,
        [change, radius]: [f64; 2],
        enough: usize,
        is_retry: bool,
        work: &mut u32,
    ) -> Option<(f64, usize)> {
        for (stage, of_toss) in WORK.into_iter().enumerate() {
            let of_interval = WORK_OF_INTERVAL.get(stage);
            *work += of_interval.unwrap_or(&0);
            let sign = self.sign_in(stage, change, radius);
            if sign != 0.0 {
                return Some((sign, stage));
            }
            if stage >= enough {
                // A model has more rounding errors than a toss, so that a model of nearly no width tells what the width does.
                let middle = if of_interval.is_some() { f64::MIN_POSITIVE } else { 0.0 };
                *work += of_interval.unwrap_or(&of_toss);
                if !is_retry || self.sign_in(stage, change, middle) != 0.0 {
                    return None;
                }
            }
        }
        None
    }

    /// The outcome of the toss with this change.
    pub(super) fn outcome_at(&self, change: f64) -> Outcome {
        Outcome::of(self.sign_at(change, &mut 0), 0.0)
    }
}

/// The special motion of a toss that is kept when the input changes.
fn special(toss: &Toss, input: Input) -> Option<Special> {
    let Input::Rate(axis) = input else { return Special::at_sight(toss).or_else(|| Special::of(toss)) };
    let (rate, _) = toss.launch.given_rate();
    let spins_about = |axis: usize| (0..3).all(|other| other == axis || rate[other] == 0.0);
    Special::at_sight(toss).filter(|special| match special {
        Special::Symmetric(_) => true,
        Special::Spin => toss.body.moments().is_some() && spins_about(axis),
        Special::Separatrix => false,
    })
}

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum End {
    /// At a flip, at this distance.
    Flip(f64),
    /// At the limit.
    Limit,
    /// For want of work or digits, at this distance.
    Spent(f64),
}

/// A search in one direction.
pub(super) struct Walk<'a> {
    line: &'a Line<'a>,
    sign: f64,
    sense: f64,
    /// Where the walk begins, as a change of the input.
    origin: f64,
    distance: f64,
    step: f64,
    limit: f64,
    /// What is added to the distance before the resolution is taken of it.
    offset: f64,
    /// The stage that decided the last interval, and whether none decided the one after it.
    stage: usize,
    is_retry: bool,
    /// A flip that is known to be ahead, though not that it is the first.
    ahead: Option<f64>,
    /// How many times as long a step is as the one before it that was decided.
    growth: f64,
    work: u32,
}

impl<'a> Walk<'a> {
    /// From the toss of the line, which lands with `outcome`, up to `limit`.
    pub(super) fn new(line: &'a Line<'a>, outcome: Outcome, sense: f64, limit: f64, offset: f64) -> Self {
        let sign = match outcome {
            Outcome::Heads => 1.0,
            Outcome::Tails => -1.0,
            Outcome::Undecided => 0.0,
        };
        Self {
            line,
            sign,
            sense,
            origin: 0.0,
            distance: 0.0,
            step: limit / 64.0,
            limit,
            offset,
            stage: 0,
            is_retry: false,
            ahead: None,
            growth: GROWTH,
            work: 0,
        }
    }

    /// The same walk from another change of the input.
    pub(super) fn starting_at(self, origin: f64) -> Self {
        Self { origin, ..self }
    }

    /// How far the walk has come, from the toss of the line.
    fn reached(&self) -> f64 {
        self.origin + self.distance
    }

    /// Goes on to the next flip. The distances that it returns are from the toss of the line.
    pub(super) fn next_flip(&mut self) -> End {
        while self.distance < self.limit {
            if self.work > MOST_WORK || self.sign == 0.0 || self.step < f64::MIN_POSITIVE {
                return End::Spent(self.reached());
            }
            let shortest = RESOLUTION * (self.offset + self.distance);
            self.ahead = self.ahead.filter(|ahead| *ahead > self.distance);
            let to_flip = self.ahead.map_or(f64::INFINITY, |ahead| NEARLY * (ahead - self.distance));
            let step = self.step.min(self.limit - self.distance).min(to_flip.max(shortest));
            let interval = self.next(step);
            match self.line.sign_around(interval, self.stage, self.is_retry, &mut self.work) {
                Some((sign, stage)) if sign == self.sign => {
                    self.distance += step;
                    (self.step, self.stage, self.is_retry) = (self.growth * step, stage, false);
                    continue;
                }
                _ => (self.step, self.is_retry, self.growth) = (0.5 * step, true, GROWTH),
            }
            if self.ahead.is_none() {
                self.ahead = self.flip_within(step);
            }
            if step <= shortest {
                let Some((passed, sign)) = self.decided_after(step) else {
                    return End::Spent(self.reached());
                };
                let flip = if sign == -self.sign { self.flip_within(passed) } else { None };
                self.distance += passed;
                self.step = step;
                if let Some(flip) = flip {
                    (self.sign, self.work, self.ahead, self.growth) = (sign, 0, None, GROWTH_AFTER_FLIP);
                    return End::Flip(self.origin + flip);
                }
            }
        }
        End::Limit
    }

    /// The middle and the radius of an interval of changes that contains the next `step`.
    fn next(&self, step: f64) -> [f64; 2] {
        let middle = self.origin + self.sense * (self.distance + 0.5 * step);
        // The middle is rounded, and so are both ends. From another origin a rounding of it may be left out, which is some
        // thousandth of the resolution.
        [middle, 0.5 * step + 2.0 * f64::EPSILON * (middle.abs() + step)]
    }

    /// A distance within the next `step` at which the outcome changes, if it has changed at the end of it: by halving, with tosses
    /// alone.
    fn flip_within(&mut self, step: f64) -> Option<f64> {
        let [mut before, mut after] = [self.distance, self.distance + step];
        let sign_at = |distance: f64, work: &mut u32| self.line.sign_at(self.origin + self.sense * distance, work);
        if sign_at(after, &mut self.work) != -self.sign {
            return None;
        }
        while after - before > f64::EPSILON * (self.offset + after) && self.work <= MOST_WORK {
            let middle = 0.5 * (before + after);
            match sign_at(middle, &mut self.work) {
                sign if sign == self.sign => before = middle,
                sign if sign == -self.sign => after = middle,
                _ => break,
            }
        }
        Some(after)
    }

    /// A step or two after which the outcome is decided, and its sign. One step may end on a tie. The limit needs no
    /// outcome: a flip there is none before it.
    fn decided_after(&mut self, step: f64) -> Option<(f64, f64)> {
        for passed in [step, 2.0 * step] {
            let distance = self.distance + passed;
            let sign = self.line.sign_at(self.origin + self.sense * distance, &mut self.work);
            if sign != 0.0 || distance >= self.limit {
                return Some((passed, sign));
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Body, Launch, TimeOfFlight};
    use numerics::big::exactly;

    use super::*;

    /// Of all inputs, in both directions, at and next to the separatrix, at rest, upright and on edge; with little of its
    /// work left, which ends most of them.
    #[test]
    fn a_search_ends_within_its_work() {
        const LEFT: u32 = 2000;
        let mut spent = 0;
        let rates = [
            [5.276_195_533_573_627, 3.0, 3.046_212_911_605_835],
            [0.75, 1.0, 1.0],
            [1e-30, 5.0, 0.0],
            [0.0, 0.0, 300.0],
            [1e-300, 2.0, 1e200],
        ];
        for (rate, tilt) in
            rates.into_iter().flat_map(|rate| [0.0, 1.0, std::f64::consts::FRAC_PI_2].map(|tilt| (rate, tilt)))
        {
            let launch = Launch::new(rate, TimeOfFlight::Given(0.8)).unwrap().with_tilt(tilt).unwrap();
            let toss = Toss { body: Body::from_moments([1.0, 2.0, 2.25]).unwrap(), launch };
            for (input, limit) in [(Input::Time, 20.0), (Input::Rate(0), 1000.0), (Input::Rate(2), 1000.0)] {
                let line = Line::new(&toss, input);
                let outcome = line.outcome_at(0.0);
                for sense in [-1.0, 1.0] {
                    let walk = Walk::new(&line, outcome, sense, if sense < 0.0 { 0.8 } else { limit }, 0.0);
                    let mut walk = Walk { work: MOST_WORK - LEFT, ..walk };
                    let end = walk.next_flip();
                    let most = MOST_WORK + 6 * WORK.iter().chain(&WORK_OF_INTERVAL).sum::<u32>();
                    assert!(walk.work <= most, "{rate:?} {tilt} {input:?}: {end:?} by {}", walk.work);
                    spent += u32::from(walk.work > MOST_WORK);
                }
            }
        }
        assert!(spent > 20, "{spent}");
    }

    fn toss() -> Toss {
        let launch = Launch::new([3.0, 2.0, 5.0], TimeOfFlight::Given(0.8)).unwrap();
        Toss { body: Body::from_moments([1.0, 2.0, 2.25]).unwrap(), launch }
    }

    /// By exact arithmetic, and no wider than some roundings. The end of a step is rounded before the next one begins there.
    #[test]
    fn intervals_contain_their_steps() {
        let (toss, exact) = (toss(), exactly);
        let line = Line::new(&toss, Input::Time);
        let numbers = [0.0, 1e-20, 0.1, 0.7, 1.0, 3.3, 1e5];
        let origins = numbers.iter().flat_map(|origin| [-origin, *origin]);
        let cases = origins.flat_map(|origin| numbers.map(|distance| (origin, distance)));
        for ((origin, distance), step) in cases.flat_map(|case| [1e-13, 3e-9, 0.1, 7.0].map(|step| (case, step))) {
            for sense in [1.0, -1.0] {
                let start = Walk { distance, ..Walk::new(&line, Outcome::Heads, sense, 1e9, 0.0) }.starting_at(origin);
                let [middle, radius] = start.next(step);
                for further in [exact(distance), exact(distance) + exact(step), exact(distance + step)] {
                    let from_middle = exact(origin) + exact(sense) * further - exact(middle);
                    let radius = exact(radius) + exact(f64::EPSILON * origin.abs());
                    assert!(from_middle.magnitude() <= radius, "{origin} {distance} {step}");
                }
                let size = middle.abs() + step;
                assert!(radius <= 0.5 * step + 3.0 * f64::EPSILON * size, "{origin} {distance} {step}: {radius}");
            }
        }
    }

    #[test]
    fn a_search_goes_on_while_it_has_work_a_sign_and_a_step() {
        let toss = toss();
        let line = Line::new(&toss, Input::Time);
        let sign = line.sign_at(0.0, &mut 0);
        for (limit, step, sign, work, goes_on) in [
            (1e-6, 1.0, sign, 0, true),
            (1e-6, 1.0, sign, MOST_WORK, true),
            (1e-6, 1.0, sign, MOST_WORK + 1, false),
            (1e-6, 1.0, sign, MOST_WORK + 2, false),
            (1e-6, 1.0, 0.0, 0, false),
            (f64::MIN_POSITIVE, f64::MIN_POSITIVE, sign, 0, true),
            (f64::MIN_POSITIVE, 0.5 * f64::MIN_POSITIVE, sign, 0, false),
        ] {
            let mut walk = Walk { step, sign, work, ..Walk::new(&line, Outcome::Heads, 1.0, limit, 0.0) };
            assert_eq!(walk.next_flip(), if goes_on { End::Limit } else { End::Spent(0.0) }, "{limit} {sign} {work}");
        }
    }

    /// A rate below 10^-250 in another unit has fewer digits of its own, which are enough for a motion of such rates alone.
    #[test]
    fn tiny_rates_in_another_unit_have_the_outcome_of_the_scaled_motion() {
        let thirds = dynamics::AngleUnit::Radians(dynamics::Unit::ratio(1, 3).unwrap());
        let body = Body::from_moments([1.0, 2.0, 2.5]).unwrap();
        for time in [0.3, 1.0, 1.7] {
            let [found, expected] = [1e-260, 1.0].map(|scale: f64| {
                let rate = [18.0, 9.0, 12.0].map(|part: f64| part * scale);
                let launch = Launch::in_unit(rate, thirds, TimeOfFlight::Given(time / scale)).unwrap();
                Line::new(&Toss { body, launch }, Input::Time).outcome_at(0.0)
            });
            assert!(found == expected && found != Outcome::Undecided, "{time}: {found:?} {expected:?}");
        }
    }

    /// By exact arithmetic, and a ball is as small as the digits of the rate allow: those of a tiny one are few.
    #[test]
    fn balls_of_rates_contain_the_rates_as_they_were_given_and_the_change() {
        let (body, thirds) = (toss().body, dynamics::AngleUnit::Radians(dynamics::Unit::ratio(1, 3).unwrap()));
        for (scale, relative) in [(1.0, 2f64.powi(-98)), (1e200, 2f64.powi(-98)), (1e-300, 2f64.powi(-49))] {
            let rate = [3.1, -0.7, 4.9].map(|part| part * scale);
            let launch = Launch::in_unit(rate, thirds, TimeOfFlight::Given(0.8)).unwrap();
            let (toss, input) = (Toss { body, launch }, Input::Rate(1));
            let line = Line::new(&toss, input);
            for change in [0.0, 0.3 * scale, -0.2 * scale, 40.0 * scale] {
                let moved = line.moved(&line.fine, change);
                let in_unit = |value: f64| exactly(value).times_power_of_two(-moved.exponent);
                for (axis, ball) in moved.rate.iter().enumerate() {
                    let change = in_unit(if axis == 1 { change } else { 0.0 });
                    let off = (exactly(3.0) * (ball.to_big() - change) - in_unit(rate[axis])).magnitude();
                    assert!(off <= exactly(3.0) * exactly(ball.radius()), "{scale} {axis}: {}", ball.radius());
                    assert!(ball.radius() <= 10.0 * relative, "{scale} {axis}: {}", ball.radius());
                    assert!(ball.to_f64().abs() < 4.0, "{scale} {axis}: {ball:?}");
                }
            }
        }
    }

    /// In a unit near the largest, squares of rates stay in the range of f64.
    #[test]
    fn rates_of_any_size_are_decided_in_f64() {
        for scale in [1e-200, 1e-100, 1e100, 1e200] {
            let launch =
                Launch::new([3.0, 2.0, 5.0].map(|part| part * scale), TimeOfFlight::Given(0.8 / scale)).unwrap();
            let scaled = Toss { launch, ..toss() };
            let sign = |toss: &Toss| Line::new(toss, Input::Rate(0)).sign_in(0, 0.0, 0.0);
            assert!(sign(&scaled) == sign(&toss()) && sign(&scaled) != 0.0, "{scale:e}");
        }
    }

    #[test]
    fn each_stage_has_its_own_digits() {
        let toss = toss();
        let line = Line::new(&toss, Input::Time);
        for (index, digits) in DIGITS.into_iter().enumerate() {
            assert_ne!(line.sign_in(2 + index, 0.0, 0.0), 0.0);
            let made = line.many.each_ref().map(|given| given.get().map(|given| given.time.digits()));
            assert_eq!(made[index], i32::try_from(digits).ok());
            assert!(made[index + 1..].iter().all(Option::is_none), "{made:?}");
        }
    }

    /// No ball over 20 s has a sign, which takes an evaluation of the interval and one at its middle.
    #[test]
    fn an_interval_that_is_too_wide_is_given_up_after_its_middle_is_decided() {
        let (toss, mut work) = (toss(), 0);
        let line = Line::new(&toss, Input::Time);
        assert_eq!((line.sign_around([10.0, 10.0], 0, true, &mut work), work), (None, 2 * WORK_OF_INTERVAL[0]));
    }

    /// As after a start that was rounded across it.
    #[test]
    fn a_flip_at_the_start_of_a_walk_is_found_there() {
        let toss = toss();
        let line = Line::new(&toss, Input::Time);
        let other = if line.outcome_at(0.0) == Outcome::Heads { Outcome::Tails } else { Outcome::Heads };
        let found = Walk::new(&line, other, 1.0, 1e-3, 1.0).next_flip();
        assert!(matches!(found, End::Flip(distance) if distance <= RESOLUTION), "{found:?}");
    }

    /// A body on edge with a rate of ½ rad/s about the horizontal axis: without the rate it stays there, and with the opposite
    /// one it shows the other face.
    #[test]
    fn a_tie_is_passed_by_another_step() {
        let quarter = dynamics::AngleUnit::Turns(dynamics::Unit::ONE).times(0.25);
        let launch = Launch::new([0.5, 0.0, 0.0], TimeOfFlight::Given(0.8)).unwrap().with_tilt(quarter).unwrap();
        let toss = Toss { launch, ..toss() };
        let line = Line::new(&toss, Input::Rate(0));
        let sign = line.sign_at(0.0, &mut 0);
        let mut walk = Walk::new(&line, line.outcome_at(0.0), -1.0, 1000.0, 0.0);
        assert_eq!((sign, walk.decided_after(0.5)), (-1.0, Some((1.0, 1.0))));
    }
}
