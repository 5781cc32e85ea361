//! The search for flips along one input of a toss, by balls that contain whole intervals of it.
//!
//! An interval that is not decided is halved. If that does not help, the toss at its middle tells why: where the same
//! digits decide it, the interval is too wide. Else digits are what is missing, as next to the separatrix, and the next
//! stage has more.
//! The search passes no toss that it cannot decide: it ends there, and says how far it came.

use std::cell::OnceCell;

use dynamics::{Outcome, Toss};
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{Ball, DoubleDouble, Elementary, TaylorModel, WideBall};

use super::curve::Curve;
use super::tensor_toss::tensor;
use super::{cos_tilt, doubling};
use crate::given::{right_to_25_u2, rounded, time_in_digits, vertical_in_digits, vertical_in_double_double};

/// Width of the interval that a flip is known to lie in, in parts of its distance; also the shortest step.
pub(super) const RESOLUTION: f64 = 2.5e-13;

/// Digits of the stages after f64 and double-double.
const DIGITS: [usize; 3] = [256, 448, 960];

/// The work of an evaluation in each stage, roughly in units of 2 µs.
const WORK: [u32; 2 + DIGITS.len()] = [1, 8, 200, 400, 1000];

/// How much more work a Taylor model by doubling is, of a body that was given by a tensor.
const WORK_OF_TENSOR: u32 = 30;

/// The work that a search may take, about half a second.
pub(super) const MOST_WORK: u32 = 250_000;

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
    rough: Stage<Ball<f64>>,
    fine: Stage<Ball<DoubleDouble>>,
    /// Those of more digits, made when they are needed.
    many: [OnceCell<Stage<WideBall>>; DIGITS.len()],
}

/// What a line is evaluated with in one kind of ball.
struct Stage<B> {
    /// The vertical seen from the body at launch.
    vertical: [B; 3],
    /// The time of flight is `mantissa` 2^`exponent` s.
    mantissa: B,
    exponent: i32,
    /// The motion, where the input does not change it.
    fixed: Option<Curve<B>>,
}

impl<'a> Line<'a> {
    pub(super) fn new(toss: &'a Toss, input: Input) -> Self {
        let vertical = vertical_in_double_double(&toss.launch);
        let time: dynamics::time_of_flight::ExactTime = toss.launch.time_of_flight().into();
        let mantissa = right_to_25_u2(time.mantissa());
        let rough_vertical = vertical.each_ref().map(rounded);
        let rough = Stage::new(toss, input, rough_vertical, rounded(&mantissa), time.exponent());
        let fine = Stage::new(toss, input, vertical, mantissa, time.exponent());
        Self { toss, input, rough, fine, many: Default::default() }
    }

    /// The work of an evaluation in each stage.
    fn work(&self) -> [u32; WORK.len()] {
        let times = if self.toss.body.moments().is_none() { WORK_OF_TENSOR } else { 1 };
        WORK.map(|work| times * work)
    }

    /// The sign of cos θ at all changes within `radius` of `change`, in a stage: 0 if it is not proven.
    fn sign_in(&self, stage: usize, change: f64, radius: f64) -> f64 {
        let (toss, input) = (self.toss, self.input);
        let is_tensor = toss.body.moments().is_none();
        match stage {
            0 if is_tensor => self.rough.sign_by_model(toss, input, change, radius),
            1 if is_tensor => self.fine.sign_by_model(toss, input, change, radius),
            // More digits tell the outcome of a toss; over an interval of tosses, double-double has enough.
            _ if is_tensor && radius > 0.0 => 0.0,
            0 => self.rough.sign(toss, input, change, radius),
            1 => self.fine.sign(toss, input, change, radius),
            _ => {
                let stage = stage - 2;
                let many = self.many[stage].get_or_init(|| Stage::in_digits(toss, input, DIGITS[stage]));
                if is_tensor { many.sign_of_toss(toss, input, change) } else { many.sign(toss, input, change, radius) }
            }
        }
    }

    /// The sign of cos θ for this change, 0 if no stage decides it. `work` is added to.
    fn sign_at(&self, change: f64, work: &mut u32) -> f64 {
        let sign = |(stage, of_stage)| {
            *work += of_stage;
            self.sign_in(stage, change, 0.0)
        };
        self.work().into_iter().enumerate().map(sign).find(|sign| *sign != 0.0).unwrap_or(0.0)
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
        for (stage, of_stage) in self.work().into_iter().enumerate() {
            *work += of_stage;
            let sign = self.sign_in(stage, change, radius);
            if sign != 0.0 {
                return Some((sign, stage));
            }
            if stage >= enough {
                *work += of_stage;
                if !is_retry || self.sign_in(stage, change, 0.0) != 0.0 {
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

impl<B: Elementary> Stage<B> {
    fn new(toss: &Toss, input: Input, vertical: [B; 3], mantissa: B, exponent: i32) -> Self {
        let mut stage = Self { vertical, mantissa, exponent, fixed: None };
        if input == Input::Time && toss.body.moments().is_some() {
            stage.fixed = stage.curve(toss, input, 0.0, 0.0);
        }
        stage
    }

    /// The sign of cos θ at all changes within `radius` of `change`: 0 if it is not proven.
    fn sign(&self, toss: &Toss, input: Input, change: f64, radius: f64) -> f64 {
        sign_of(self.height(toss, input, [change, radius]))
    }

    /// The same of a body that was given by a tensor: by a Taylor model, because doubling forgets how a ball depends on the
    /// change.
    fn sign_by_model(&self, toss: &Toss, input: Input, change: f64, radius: f64) -> f64 {
        let model = self.doubled(toss, input, [change, radius], TaylorModel::variable);
        sign_of(model.map(|model| model.range()))
    }

    /// The motion for a ball of changes.
    fn curve(&self, toss: &Toss, input: Input, change: f64, radius: f64) -> Option<Curve<B>> {
        Curve::new(&toss.body, &self.rates(toss, input, change, radius))
    }

    /// The rates (BF) for a ball of changes, in a unit near the largest.
    fn rates(&self, toss: &Toss, input: Input, change: f64, radius: f64) -> [B; 3] {
        let exponent = unit_exponent(toss, input, change);
        let number = |value: f64| self.mantissa.like(value).times_power_of_two(-exponent);
        // A rate that was not given in rad/s has a second part, and an error of 16 u²; a tiny one has lost digits.
        let mut rates = toss.launch.exact_rate().map(|part| match [part.hi(), part.lo()] {
            [0.0, _] => self.mantissa.like(0.0),
            [leading, 0.0] => number(leading),
            [leading, rest] => {
                let relative = 2f64.powi(if leading.abs() < 1e-250 { -50 } else { -101 });
                let error = number(leading).to_f64().abs() * relative;
                (number(leading) + number(rest)).widened(error)
            }
        });
        if let Input::Rate(axis) = input {
            let width = radius * 2f64.powi(-exponent);
            rates[axis] = (rates[axis].clone() + number(change)).widened(width);
        }
        rates
    }

    /// The same of a single toss.
    fn sign_of_toss(&self, toss: &Toss, input: Input, change: f64) -> f64 {
        sign_of(self.doubled(toss, input, [change, 0.0], |part, _| part))
    }

    /// cos θ by doubling, in numbers that `number` makes of a value and of how far the change takes it.
    fn doubled<N: Elementary>(
        &self,
        toss: &Toss,
        input: Input,
        [change, radius]: [f64; 2],
        number: fn(B, B) -> N,
    ) -> Option<N> {
        let exponent = unit_exponent(toss, input, change);
        let part = |value: f64, exponent: i32| self.mantissa.like(value).times_power_of_two(exponent);
        let fixed = |value: B| number(value.clone(), value.like(0.0));
        let mut rates = self.rates(toss, input, change, 0.0).map(fixed);
        let mut time = self.mantissa.times_power_of_two(self.exponent + exponent);
        let mut width = part(0.0, 0);
        match input {
            Input::Rate(axis) => {
                let value = self.rates(toss, input, change, 0.0)[axis].clone();
                rates[axis] = number(value, part(radius, -exponent));
            }
            Input::Time => (time, width) = (time + part(change, exponent), part(radius, exponent)),
        }
        let (time, vertical) = (number(time, width), self.vertical.clone().map(fixed));
        let turn = doubling::Curve::new(tensor(toss, &time), rates).turn(&time)?;
        Some(cos_tilt(&turn, &vertical))
    }

    /// cos θ for all changes within `radius` of `change`.
    fn height(&self, toss: &Toss, input: Input, [change, radius]: [f64; 2]) -> Option<B> {
        let exponent = unit_exponent(toss, input, change);
        let time = self.mantissa.times_power_of_two(self.exponent + exponent);
        let turn = if input == Input::Time {
            let change = time.like(change).widened(radius).times_power_of_two(exponent);
            self.fixed.as_ref()?.turn(&(time + change))
        } else {
            self.curve(toss, input, change, radius)?.turn(&time)
        };
        Some(cos_tilt(&turn, &self.vertical))
    }
}

impl Stage<WideBall> {
    fn in_digits(toss: &Toss, input: Input, digits: usize) -> Self {
        Self::new(toss, input, vertical_in_digits(&toss.launch, digits), time_in_digits(&toss.launch, digits), 0)
    }
}

/// The sign of cos θ; 0 if it is not known.
fn sign_of<N: Elementary>(cos_tilt: Option<N>) -> f64 {
    cos_tilt.filter(N::has_known_sign).map_or(0.0, |cos_tilt| cos_tilt.sign())
}

/// Exponent of the unit of the rates, a power of two near the largest.
fn unit_exponent(toss: &Toss, input: Input, change: f64) -> i32 {
    let moved = if let Input::Rate(_) = input { change.abs() } else { 0.0 };
    mantissa_and_exponent(power_of_two_scale(toss.launch.rate().amax().max(moved))).1
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
            let step = self.step.min(self.limit - self.distance);
            let interval = self.next(step);
            match self.line.sign_around(interval, self.stage, self.is_retry, &mut self.work) {
                Some((sign, stage)) if sign == self.sign => {
                    self.distance += step;
                    (self.step, self.stage, self.is_retry) = (1.5 * step, stage, false);
                    continue;
                }
                _ => (self.step, self.is_retry) = (0.5 * step, true),
            }
            if step <= RESOLUTION * (self.offset + self.distance) {
                let Some((passed, sign)) = self.decided_after(step) else {
                    return End::Spent(self.reached());
                };
                self.distance += passed;
                self.step = step;
                if sign == -self.sign {
                    self.sign = sign;
                    return End::Flip(self.reached());
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
                    let most = MOST_WORK + 6 * WORK.iter().sum::<u32>();
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
    fn balls_of_rates_contain_the_rates_as_they_were_given_and_all_changes() {
        let (body, thirds) = (toss().body, dynamics::AngleUnit::Radians(dynamics::Unit::ratio(1, 3).unwrap()));
        for (scale, relative) in [(1.0, 2f64.powi(-100)), (1e200, 2f64.powi(-100)), (1e-300, 2f64.powi(-49))] {
            let rate = [3.1, -0.7, 4.9].map(|part| part * scale);
            let launch = Launch::in_unit(rate, thirds, TimeOfFlight::Given(0.8)).unwrap();
            let (toss, input) = (Toss { body, launch }, Input::Rate(1));
            let fine = Line::new(&toss, input).fine;
            for (change, radius) in [(0.0, 0.0), (0.3 * scale, 0.0), (-0.2 * scale, 0.01 * scale)] {
                let unit = -unit_exponent(&toss, input, change);
                let in_unit = |value: f64| exactly(value).times_power_of_two(unit);
                for (axis, ball) in fine.rates(&toss, input, change, radius).into_iter().enumerate() {
                    let [change, radius] =
                        if axis == 1 { [change, radius].map(in_unit) } else { [0.0; 2].map(exactly) };
                    let off = (exactly(3.0) * (ball.to_big() - change) - in_unit(rate[axis])).magnitude();
                    let (least, found) = (off + exactly(3.0) * &radius, exactly(3.0) * exactly(ball.radius()));
                    assert!(least <= found, "{scale} {axis}: {}", ball.radius());
                    let most = radius.to_f64().value() * (1.0 + 1e-15) + 10.0 * relative;
                    assert!(ball.radius() <= most, "{scale} {axis}: {} above {most}", ball.radius());
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
            let made = line.many.each_ref().map(|stage| stage.get().map(|stage| stage.mantissa.digits()));
            assert_eq!(made[index], i32::try_from(digits).ok());
            assert!(made[index + 1..].iter().all(Option::is_none), "{made:?}");
        }
    }

    /// No ball over 20 s has a sign, which takes an evaluation of the interval and one at its middle.
    #[test]
    fn an_interval_that_is_too_wide_is_given_up_after_its_middle_is_decided() {
        let (toss, mut work) = (toss(), 0);
        let line = Line::new(&toss, Input::Time);
        assert_eq!((line.sign_around([10.0, 10.0], 0, true, &mut work), work), (None, 2 * WORK[0]));
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
