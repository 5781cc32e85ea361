//! The mean share of heads over one cell is enclosed, as `docs/proofs/probability.md` derives it.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use numerics::positive_part::Power;
use numerics::{Ball, Elementary};

use super::cell::{Cell, MOST_DIRECTIONS};
use super::directions::as_given;
use super::function::{Bounds, Function, exactly, lower, magnitude, upper};
use super::roots::squared_angle_of_root;
use super::series::Series;
use crate::coordinate::Coordinate;
use crate::space::Space;

/// What the cells of a space have in common.
pub(super) struct Problem<'a> {
    space: &'a Space,
    ratio: Ball<f64>,
    /// Exponent of the unit of rates (rad/s), a power of two.
    exponent: i32,
    is_across: bool,
}
/// The launches of a cell, as functions of it: rates in their unit, and the times of flight in its inverse.
struct Launches<J> {
    momentum: [J; 3],
    /// The squares of its parts.
    squares: [J; 3],
    /// Sine and cosine of the tilt.
    tilt: [J; 2],
    times: [J; 2],
    weight: Option<J>,
}

/// Where a landing is among the phases of heads, over a whole cell.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Place {
    /// Between both edges of an interval of heads.
    Inside,
    /// Beyond the edge of this sign.
    Outside(f64),
    /// About the edge of this sign.
    Edge(f64),
}

/// What the numerator of the share is over a cell: α a + `landings` less what is beyond the edges.
#[derive(Clone, Copy)]
struct Numerator {
    /// α.
    half_widths: f64,
    /// Which landings are inside, the first with the sign -1.
    inside: [bool; 2],
}

/// The means over one cell, by series of `T` terms about its middle and of `F` terms over the whole of it.
struct Means<'a, 'b, const T: usize, const F: usize> {
    problem: &'b Problem<'a>,
    cell: &'b Cell<'a>,
    weight: Option<Function<T, F>>,
    motion: Motion<Function<T, F>>,
}

/// The motion of the launches.
#[derive(Clone, Copy)]
struct Motion<J> {
    /// |L|².
    squared: J,
    /// The phases of the first and of the last landing.
    phases: [J; 2],
    /// Their difference.
    span: J,
    /// P - s², which is positive where cos θ changes its sign.
    room: J,
    /// A |L|² = s q.
    mean: J,
    /// B |L|² and C |L|².
    cosine: J,
    sine: J,
    /// cos θ at launch.
    cos_tilt: J,
}

impl<'a> Problem<'a> {
    pub(super) fn new(space: &'a Space, coin: dynamics::Coin, is_across: bool) -> Self {
        let ratio = coin.exact_inertia_ratio();
        let ratio = Ball::new(ratio.hi(), 2.0 * ratio.lo().abs() + 1e-30);
        let rates = [Coordinate::RateX, Coordinate::RateY, Coordinate::RateZ].map(|of| space.axis(of).bounds());
        let largest = rates.iter().flatten().fold(0.0_f64, |largest, end| largest.max(end.abs()));
        let exponent = numerics::scale::mantissa_and_exponent(numerics::scale::power_of_two_scale(largest)).1;
        Self { space, ratio, exponent, is_across }
    }

    /// Each coordinate depends on one direction alone, so that its functions are computed in series in one variable.
    fn launches<const T: usize>(&self, cell: &Cell<'_>, whole: bool) -> Launches<Series<T>> {
        let mut values =
            Coordinate::ALL.map(|of| (Series::<5>::constant(as_given(self.space.axis(of).bounds()[0])), 0));
        if self.is_across {
            values[Coordinate::RateY as usize].0 = Series::constant(exactly(0.0));
        }
        let mut weight: Option<Series<T>> = None;
        for (index, direction) in cell.directions.iter().flatten().enumerate() {
            let (value, density) = direction.at(&cell.parameter(index, whole));
            values[direction.of as usize] = (value, index);
            let density = density.map(|density| Series::in_variable(&density, index));
            weight = match (weight, density) {
                (Some(weight), Some(density)) => Some(weight.times(&density)),
                (one, other) => one.or(other),
            };
        }
        let value = |of: Coordinate| &values[self.space.place(of) as usize];
        let in_place = |of: Coordinate, apply: &dyn Fn(&Series<5>) -> Series<5>| {
            let (value, index) = value(of);
            Series::in_variable(&apply(value), *index)
        };
        let both_in_place = |of: Coordinate| {
            let (value, index) = value(of);
            value.sine_and_cosine().map(|part| Series::in_variable(&part, *index))
        };
        let rate = |value: &Series<5>| times_power_of_two(value, -self.exponent);
        let (momentum, squares) = if self.space.is_of_precession() {
            let (turn, [sin, cos]) = (in_place(Coordinate::Turn, &rate), both_in_place(Coordinate::Psi));
            let momentum = [turn.times(&sin), Series::constant(exactly(0.0)), turn.times(&cos)];
            (momentum, momentum.map(|part| part.times(&part)))
        } else {
            let spin = |value: &Series<5>| rate(value).scaled(&self.ratio);
            let of = |apply: &dyn Fn(Series<5>) -> Series<5>| {
                [
                    in_place(Coordinate::RateX, &|value| apply(rate(value))),
                    in_place(Coordinate::RateY, &|value| apply(rate(value))),
                    in_place(Coordinate::RateZ, &|value| apply(spin(value))),
                ]
            };
            (of(&|part| part), of(&|part| part.times(&part)))
        };
        let time = |speed: f64| {
            let per_speed = |gravity: &Series<5>| times_power_of_two(&gravity.reciprocal(), 1 + self.exponent);
            in_place(Coordinate::Gravity, &|gravity| per_speed(gravity).scaled(&as_given(speed)))
        };
        let times = self.space.axis(Coordinate::Speed).bounds().map(time);
        let tilt = if self.is_horizontal() {
            [0.0, 1.0].map(|value| Series::constant(exactly(value)))
        } else {
            both_in_place(Coordinate::Tilt)
        };
        Launches { momentum, squares, tilt, times, weight }
    }

    fn motion<const T: usize>(&self, launches: &Launches<Series<T>>) -> Motion<Series<T>> {
        let ([x, y, q], [sin, cos]) = (&launches.momentum, &launches.tilt);
        let across = launches.squares[0].plus(&launches.squares[1]);
        let squared = across.plus(&launches.squares[2]);
        let size = squared.sqrt();
        let level = y.times(sin);
        let vertical = level.plus(&q.times(cos));
        let [first, last] = &launches.times;
        Motion {
            squared,
            phases: [size.times(first), size.times(last)],
            span: size.times(&last.minus(first)),
            room: across.minus(&vertical.times(&vertical)),
            mean: vertical.times(q),
            cosine: across.times(cos).minus(&level.times(q)),
            sine: -x.times(sin).times(&size),
            cos_tilt: *cos,
        }
    }

    /// Whether all launches are from horizontal.
    fn is_horizontal(&self) -> bool {
        self.space.axis(Coordinate::Tilt).value() == Some(0.0)
    }

    fn has_one_speed(&self) -> bool {
        self.space.axis(Coordinate::Speed).value().is_some()
    }

    /// Bounds of the mean share over `cell`, times the density, by series of `T` and `F` terms. More is tried if they are wider than
    /// `enough`.
    pub(super) fn bounds<const T: usize, const F: usize>(&self, cell: &Cell<'a>, enough: f64) -> Bounds {
        self.means::<T, F>(cell).bounds(enough)
    }

    fn means<'b, const T: usize, const F: usize>(&'b self, cell: &'b Cell<'a>) -> Means<'a, 'b, T, F> {
        let (middle, whole) = (self.launches::<T>(cell, false), self.launches::<F>(cell, true));
        let weight = middle.weight.zip(whole.weight).map(|(middle, whole)| Function { middle, whole }.narrowed());
        let motion = both(&self.motion(&middle), &self.motion(&whole));
        Means { problem: self, cell, weight, motion }
    }
}

/// A motion about the middle, and one over the whole of a cell.
fn both<const T: usize, const F: usize>(
    middle: &Motion<Series<T>>,
    whole: &Motion<Series<F>>,
) -> Motion<Function<T, F>> {
    let pair = |middle: Series<T>, whole: Series<F>| Function { middle, whole }.narrowed();
    Motion {
        squared: pair(middle.squared, whole.squared),
        phases: std::array::from_fn(|end| pair(middle.phases[end], whole.phases[end])),
        span: pair(middle.span, whole.span),
        room: pair(middle.room, whole.room),
        mean: pair(middle.mean, whole.mean),
        cosine: pair(middle.cosine, whole.cosine),
        sine: pair(middle.sine, whole.sine),
        cos_tilt: pair(middle.cos_tilt, whole.cos_tilt),
    }
}

impl<const T: usize, const F: usize> Means<'_, '_, T, F> {
    fn bounds(&self, enough: f64) -> Bounds {
        let found = self.of_any_launches(enough);
        // Also where nothing is known, a share is from 0 to 1.
        Bounds { lo: found.lo.max(0.0), hi: found.hi.min(self.weight().hi), ..found }
    }

    fn of_any_launches(&self, enough: f64) -> Bounds {
        if let Some(face) = self.face_of_all() {
            return self.of_one_face(face);
        }
        if self.problem.has_one_speed() {
            return self.of_one_landing(&self.motion.phases[1]);
        }
        let found = self.of_many_speeds(enough);
        let narrower = (found.width() > enough && self.is_speed_nearly_single()).then(|| self.of_any_speed());
        narrower.filter(|other| other.width() < found.width()).unwrap_or(found)
    }

    /// The mean of the share of the speeds.
    fn of_many_speeds(&self, enough: f64) -> Bounds {
        match self.motion.room.sign() {
            Some(-1.0) => match self.motion.mean.sign() {
                Some(face) => self.of_one_face(face),
                None => self.of_any_half_width(),
            },
            Some(1.0) => {
                let found = self.with_edges();
                let narrower = (found.width() > enough).then(|| self.grazing());
                narrower.flatten().filter(|other| other.width() < found.width()).unwrap_or(found)
            }
            _ => self.grazing().unwrap_or_else(|| self.of_any_half_width()),
        }
    }

    /// The face that all launches show at every landing because the coin has hardly turned: its normal turns by no more than the
    /// phase.
    fn face_of_all(&self) -> Option<f64> {
        let most = upper(&self.motion.phases[1].values());
        if most >= FRAC_PI_2 {
            return None;
        }
        let cos_tilt = self.motion.cos_tilt.values();
        let needed = exactly(most).sine_and_cosine()[0];
        (lower(&(cos_tilt.magnitude() - needed)) > 0.0).then(|| cos_tilt.sign())
    }

    /// The mean of the density.
    fn weight(&self) -> Bounds {
        self.weight.map_or(Bounds { lo: 1.0, hi: 1.0, by: [0.0; MOST_DIRECTIONS] }, |weight| {
            let found = weight.mean();
            Bounds { lo: found.lo.max(0.0), ..found }
        })
    }

    fn of_one_face(&self, face: f64) -> Bounds {
        if face > 0.0 { self.weight() } else { Bounds { lo: 0.0, hi: 0.0, by: [0.0; MOST_DIRECTIONS] } }
    }

    /// Bounds from those of the share everywhere in the cell.
    fn of_shares(&self, [lo, hi]: [f64; 2], by: [f64; MOST_DIRECTIONS]) -> Bounds {
        let weight = self.weight();
        let lo = if lo > 0.0 { (lo.min(1.0) * weight.lo).next_down() } else { 0.0 };
        let hi = if hi < 1.0 { (hi.max(0.0) * weight.hi).next_up() } else { weight.hi };
        Bounds { lo, hi, by: self.finite_or_sizes(by) }
    }

    /// What each direction adds to a width. If that is not known, how much each changes the motion or, where that is not
    /// known either, the size of the cell in each direction.
    fn finite_or_sizes(&self, by: [f64; MOST_DIRECTIONS]) -> [f64; MOST_DIRECTIONS] {
        let is_known = |by: &[f64; MOST_DIRECTIONS]| by.iter().all(|by| by.is_finite());
        if is_known(&by) {
            return by;
        }
        let Motion { squared, room, mean, cosine, sine, .. } = &self.motion;
        let scale = magnitude(&squared.middle.value());
        let of_cosine = [room, mean, cosine, sine].map(Function::variation);
        let changes = std::array::from_fn(|index| of_cosine.iter().map(|by| by[index]).sum::<f64>() / scale);
        if is_known(&changes) {
            return changes;
        }
        std::array::from_fn(|index| {
            if self.cell.directions[index].is_some() { (-f64::from(self.cell.level[index])).exp2() } else { 0.0 }
        })
    }

    /// Whether the phase differs more among the launches of the cell than among the speeds of one.
    fn is_speed_nearly_single(&self) -> bool {
        let among_launches: f64 = self.motion.phases[1].variation().iter().sum();
        upper(&self.motion.span.values()) < among_launches
    }

    /// Bounds for each speed alone, and so for their mean, which divides by no small difference of phases.
    fn of_any_speed(&self) -> Bounds {
        let Motion { phases: [_, last], span, .. } = &self.motion;
        self.of_one_landing(&last.minus(&span.scaled(&Ball::new(0.5, 0.5))).narrowed())
    }

    /// A single landing: the outcome is the sign of cos θ.
    fn of_one_landing(&self, phase: &Function<T, F>) -> Bounds {
        let Motion { mean, cosine, sine, .. } = &self.motion;
        let height = Function {
            middle: height(&phase.middle, [&mean.middle, &cosine.middle, &sine.middle]),
            whole: height(&phase.whole, [&mean.whole, &cosine.whole, &sine.whole]),
        }
        .narrowed();
        if let Some(face) = height.sign() {
            return self.of_one_face(face);
        }
        let found = height.mean_of_power(Power::Zero);
        match &self.weight {
            None => self.of_shares([found.lo, found.hi], found.by),
            // The density times a share is between the smallest and the largest density times it.
            Some(weight) => {
                let all = weight.values();
                // What adds to the width of the share, in units of it.
                let (parts, most) = (self.finite_or_sizes(found.by), found.hi.min(1.0));
                let total = parts.iter().sum::<f64>().max(f64::MIN_POSITIVE);
                let by = std::array::from_fn(|index| {
                    parts[index] / total * (most - found.lo) * magnitude(&all) + weight.variation()[index] * most
                });
                Bounds {
                    lo: (lower(&all).max(0.0) * found.lo).next_down(),
                    hi: (magnitude(&all) * found.hi.min(1.0)).next_up(),
                    by,
                }
            }
        }
    }

    /// |L|² (P - s²), and 1 over B² + C² = |L|² (P - s²) + A².
    fn edge(&self) -> [Function<T, F>; 2] {
        let Motion { squared, room, mean, .. } = &self.motion;
        let squared_room = squared.times(room).narrowed();
        let inverse = squared_room.plus(&mean.times(mean)).narrowed().reciprocal();
        [squared_room, inverse]
    }

    fn crest(&self, inverse: &Function<T, F>) -> Function<T, F> {
        if self.problem.is_horizontal() {
            return Function::constant(exactly(0.0));
        }
        self.motion.sine.angle(&self.motion.cosine, inverse)
    }

    /// a, the half-width of the intervals of heads: the angle of (-A, y) with y² = |L|² (P - s²). Along rays y' = (y²)'/(2 y), so that
    /// a' = (y² A' - ½ A (y²)')/(y (A² + y²)).
    fn half_width(&self, [squared_room, inverse]: &[Function<T, F>; 2]) -> Function<T, F> {
        fn turned<const T: usize>(room: &Series<T>, mean: &Series<T>) -> Series<T> {
            let half = mean.scaled(&exactly(0.5));
            room.times(&mean.along_rays()).minus(&half.times(&room.along_rays()))
        }
        let mean = &self.motion.mean;
        let turned = Function {
            middle: turned(&squared_room.middle, &mean.middle),
            whole: turned(&squared_room.whole, &mean.whole),
        };
        let slope = turned.times(&squared_room.inverse_root()).times(inverse);
        let value = |room: Ball<f64>, mean: Ball<f64>| room.sqrt().atan2(&-mean);
        Function {
            middle: slope.middle.integrated_along_rays(value(squared_room.middle.value(), mean.middle.value())),
            whole: slope.whole.integrated_along_rays(value(squared_room.values(), mean.values())),
        }
        .narrowed()
    }

    /// Both landings as phases from the crest.
    fn phases_from_crest(&self, crest: &Function<T, F>) -> [Function<T, F>; 2] {
        self.motion.phases.each_ref().map(|phase| phase.minus(crest).narrowed())
    }

    /// The cell has edges of heads, and each landing is near one of them at most.
    fn with_edges(&self) -> Bounds {
        let edge = self.edge();
        let half_width = self.half_width(&edge);
        let from_crest = self.phases_from_crest(&self.crest(&edge[1]));
        let turns = from_crest.each_ref().map(turns);
        let landings: [_; 2] = std::array::from_fn(|end| from_crest[end].shifted(-turned(turns[end])));
        let places = landings.each_ref().map(|landing| place(landing, &half_width));
        let [Some(first), Some(last)] = places else {
            return self.of_half_width(&half_width, &from_crest);
        };
        let side = |place: Place| match place {
            Place::Inside => 0.0,
            Place::Outside(sign) | Place::Edge(sign) => sign,
        };
        let apart = turns[1] - turns[0];
        let numerator = Numerator {
            half_widths: 2.0 * apart + side(last) - side(first),
            inside: [first, last].map(|place| place == Place::Inside),
        };
        let inverse = self.motion.span.reciprocal();
        let per_phase = self.weight.map_or(inverse, |weight| inverse.times(&weight));
        let mut found = self.smooth(numerator, apart, [&half_width, &landings[0], &landings[1]], &per_phase);
        for (sign, place, landing) in [(1.0, first, &landings[0]), (-1.0, last, &landings[1])] {
            let Place::Edge(side) = place else { continue };
            let beyond = half_width.minus(&landing.scaled(&exactly(side))).times(&per_phase).narrowed();
            found = found.plus(sign * side, beyond.mean_of_positive_part());
        }
        found
    }

    /// The mean of what is smooth.
    fn smooth(
        &self,
        numerator: Numerator,
        apart: f64,
        [half_width, first, last]: [&Function<T, F>; 3],
        per_phase: &Function<T, F>,
    ) -> Bounds {
        let Numerator { half_widths, inside } = numerator;
        let widths = |half_width: &Function<T, F>| half_width.scaled(&exactly(half_widths));
        let share = match inside {
            [false, false] if half_widths == 0.0 => return Bounds { lo: 0.0, hi: 0.0, by: [0.0; MOST_DIRECTIONS] },
            [true, true] if apart == 0.0 => return self.weight(),
            // All phases but the tails between.
            [true, true] => {
                let tails = widths(&half_width.shifted(-exactly(0.0).pi())).times(per_phase);
                self.weight.map_or_else(|| tails.shifted(exactly(1.0)), |weight| tails.plus(&weight))
            }
            [is_first, is_last] => {
                let mut sum = widths(half_width);
                if is_first {
                    sum = sum.minus(first);
                }
                if is_last {
                    sum = sum.plus(last);
                }
                sum.times(per_phase)
            }
        };
        share.mean()
    }

    /// Bounds of any cell with a half-width: that of heads between two phases grows with it.
    fn of_half_width(&self, half_width: &Function<T, F>, from_crest: &[Function<T, F>; 2]) -> Bounds {
        let widths = [lower(&half_width.values()).max(0.0), upper(&half_width.values()).min(PI.next_up())];
        let [first, last] = from_crest.each_ref().map(|phase| [lower(&phase.values()), upper(&phase.values())]);
        let smallest = heads_between(first[1], last[0], widths[0])[0];
        let largest = heads_between(first[0], last[1], widths[1])[1];
        let span = self.motion.span.values();
        let variations = [&from_crest[0], &from_crest[1], half_width].map(Function::variation);
        let by = std::array::from_fn(|index| variations.iter().map(|by| by[index]).sum());
        if !(span.has_sign() && smallest.is_finite() && largest.is_finite()) {
            return self.of_shares([0.0, 1.0], by);
        }
        self.of_shares([(smallest / upper(&span)).next_down(), (largest / lower(&span)).next_up()], by)
    }

    /// The same where no more is known of the half-width than its range.
    fn of_unknown_half_width(&self, [lo, hi]: [f64; 2], from_crest: &[Function<T, F>; 2]) -> Bounds {
        let range = Ball::new(0.5 * (lo + hi), (0.5 * (hi - lo)).next_up());
        let mut found = self.of_half_width(&Function::constant(range), from_crest);
        // The half-width is that of (-A |L|, √(P - s²)): each direction adds to it what it adds to P - s², in parts of both squares.
        let Motion { squared, room, mean, .. } = &self.motion;
        let of_mean = magnitude(&mean.values()).powi(2) / magnitude(&squared.middle.value());
        let per_room = (hi - lo) / (magnitude(&room.values()) + of_mean);
        for (by, room) in found.by.iter_mut().zip(room.variation()) {
            *by += per_room * room;
        }
        if found.by.iter().any(|by| !by.is_finite()) {
            self.of_shares([found.lo, found.hi], [f64::INFINITY; 3])
        } else {
            found
        }
    }

    /// The same where nothing is known of the half-width.
    fn of_any_half_width(&self) -> Bounds {
        let [_, inverse] = self.edge();
        self.of_unknown_half_width([0.0, PI], &self.phases_from_crest(&self.crest(&inverse)))
    }

    /// The motion may graze cos θ = 0 in the cell: the intervals of one face, tails or heads, are narrow and vanish. `None` if
    /// they are not narrow.
    fn grazing(&self) -> Option<Bounds> {
        let Motion { squared, room, mean, span, .. } = &self.motion;
        let face = mean.sign()?;
        // The narrow intervals are those of the face that the mean has not.
        let is_heads = face == 1.0;
        if lower(&(room.values() * squared.values())) > 0.5 * magnitude(&mean.values()).powi(2) {
            return None;
        }
        let [squared_room, inverse] = self.edge();
        let (numerator, divisor) = (squared_room.of_order_2(), mean.times(mean).of_order_2());
        let ratio = numerator.times(&divisor.reciprocal()).narrowed();
        let ratios = [lower(&ratio.values()), upper(&ratio.values())];
        if !ratios.iter().all(|ratio| ratio.abs() <= 0.25) {
            return None;
        }
        let [narrowest, widest] = narrow_half_widths(ratios);
        let from_crest = self.phases_from_crest(&self.crest(&inverse));
        let crude = || {
            let heads =
                if is_heads { [(PI - widest).next_down(), PI.next_up() - narrowest] } else { [narrowest, widest] };
            self.of_unknown_half_width(heads, &from_crest)
        };
        // Phases from the nearest middle of a narrow interval.
        let to_middle = if is_heads { exactly(0.0).pi() } else { exactly(0.0) };
        let mut passed = [0.0; 2];
        for (passed, phase) in passed.iter_mut().zip(&from_crest) {
            let phase = phase.shifted(-to_middle);
            let turns = turns(&phase);
            let distance = phase.shifted(-turned(turns)).narrowed();
            let size = distance.values().magnitude();
            let is_clear = lower(&size) > widest && upper(&size) < (TAU - widest).next_down();
            if !is_clear {
                return Some(crude());
            }
            *passed = turns + f64::from(distance.sign() == Some(1.0));
        }
        let number = passed[1] - passed[0];
        if number == 0.0 {
            return Some(self.of_one_face(face));
        }
        let factor = span.of_order_2().reciprocal().scaled(&exactly(2.0 * number));
        let factor = self.weight.map_or(factor, |weight| factor.times(&weight.of_order_2()));
        let squared =
            Function { middle: squared_angle_of_root(&ratio.middle), whole: squared_angle_of_root(&ratio.whole) };
        let narrow = squared.times(&factor.times(&factor)).mean_of_power(Power::Half);
        Some(if is_heads { self.weight().plus(-1.0, narrow) } else { narrow })
    }
}

/// In two steps, each of which is in the range of f64.
fn times_power_of_two<const T: usize>(series: &Series<T>, exponent: i32) -> Series<T> {
    let power = |exponent: i32| exactly(f64::from(exponent).exp2());
    series.scaled(&power(exponent / 2)).scaled(&power(exponent - exponent / 2))
}

/// The whole turns in a phase, about the middle.
fn turns<const T: usize, const F: usize>(phase: &Function<T, F>) -> f64 {
    (phase.middle.value().midpoint() / TAU).round()
}

/// 2π `turns`.
fn turned(turns: f64) -> Ball<f64> {
    let pi = exactly(0.0).pi();
    (pi + pi) * exactly(turns)
}

/// Bounds of atan √`ratio` between two ratios; 0 for a negative one.
fn narrow_half_widths(ratios: [f64; 2]) -> [f64; 2] {
    let [narrowest, widest] = ratios.map(|ratio| ratio.max(0.0).sqrt().atan());
    [narrowest * (1.0 - 4.0 * f64::EPSILON), widest * (1.0 + 4.0 * f64::EPSILON)]
}

/// |L|² cos θ at a phase.
fn height<const T: usize>(phase: &Series<T>, [mean, cosine, sine]: [&Series<T>; 3]) -> Series<T> {
    let [sin, cos] = phase.sine_and_cosine();
    mean.plus(&cosine.times(&cos)).plus(&sine.times(&sin))
}

/// Where a phase from the crest is, over the whole cell; `None` if it is near more than one edge.
fn place<const T: usize, const F: usize>(landing: &Function<T, F>, half_width: &Function<T, F>) -> Option<Place> {
    let is_positive = |ball: &Ball<f64>| ball.has_known_sign() && ball.sign() > 0.0;
    let whole_turn = exactly(0.0).pi() + exactly(0.0).pi();
    // To the upper and the lower edge, and to those of the intervals before and after.
    let [up, down] = [half_width.minus(landing), half_width.plus(landing)].map(|edge| edge.narrowed().values());
    let [after_last, before_next] = [up, down].map(|edge| whole_turn - edge);
    match (is_positive(&up), is_positive(&down)) {
        (true, true) => Some(Place::Inside),
        (false, true) if is_positive(&before_next) => {
            Some(if is_positive(&-up) { Place::Outside(1.0) } else { Place::Edge(1.0) })
        }
        (true, false) if is_positive(&after_last) => {
            Some(if is_positive(&-down) { Place::Outside(-1.0) } else { Place::Edge(-1.0) })
        }
        _ => None,
    }
}

/// Bounds of the measure of heads between two phases from a crest.
fn heads_between(from: f64, to: f64, half_width: f64) -> [f64; 2] {
    let before = |phase: f64| {
        let turns = (phase / TAU).round();
        2.0 * half_width * turns + (phase - TAU * turns).clamp(-half_width, half_width)
    };
    let (first, last) = (before(from), before(to));
    // Each of some ten operations, and 2π, is right to u of the largest number.
    let error = 16.0 * f64::EPSILON * (TAU + from.abs() + to.abs());
    let measure = last - first;
    [measure - error, measure + error]
}

#[cfg(test)]
mod tests {
    use super::*;

    type Plane = Function<6, 15>;

    #[test]
    fn the_measure_of_heads_has_room_for_its_roundings() {
        for (from, to, exact) in [(-1.0, 1.0, 1.0), (0.25, 0.5, 0.25), (-1.0, TAU + 1.0, 2.0), (-0.5, 20.0 * TAU, 20.5)]
        {
            let [least, most] = heads_between(from, to, 0.5);
            assert!(least < exact && exact < most && most - least < 1e-12, "{from} to {to}: {least} to {most}");
        }
        // Ten roundings of u, and no more than twice as many of the sum of all.
        for (from, to) in [(0.0, 0.25), (300.0, 300.5), (-300.5, -300.0), (-300.0, 300.0)] {
            let [least, most] = heads_between(from, to, 0.5);
            let room = 0.5 * (most - least) / f64::EPSILON;
            let (largest, all) = (from.abs().max(to.abs()).max(TAU), TAU + from.abs() + to.abs());
            assert!(room > 5.0 * largest && room < 20.0 * all, "{from} to {to}: {room}");
        }
    }

    /// The same of what a function is off its linear part, by its mean or by its largest value.
    fn constant(value: f64) -> Plane {
        linear(value, 0.0)
    }

    /// value + slope t in the first direction.
    fn linear(value: f64, slope: f64) -> Plane {
        about(value, Ball::new(value, slope.abs()), slope)
    }

    /// A function of this value and slope about the middle, with these values over the cell.
    fn about(value: f64, whole: Ball<f64>, slope: f64) -> Plane {
        let slope = exactly(slope);
        Function { middle: Series::variable(exactly(value), slope, 0), whole: Series::variable(whole, slope, 0) }
    }

    /// The motion of launches of |L| = 1 from horizontal, with a room P - s² and A, between two phases.
    fn motion(room: f64, mean: f64, [first, last]: [f64; 2]) -> Motion<Plane> {
        Motion {
            squared: constant(1.0),
            phases: [constant(first), constant(last)],
            span: constant(last - first),
            room: constant(room),
            mean: constant(mean),
            cosine: constant(1.0 - mean),
            sine: constant(0.0),
            cos_tilt: constant(1.0),
        }
    }

    /// Calls `of` with the means of a motion and of a density that are made by hand.
    fn by_hand<R>(motion: Motion<Plane>, weight: Option<Plane>, of: impl Fn(Means<'_, '_, 6, 15>) -> R) -> R {
        with_speeds(2.0..=3.0, motion, weight, of)
    }

    fn with_speeds<R>(
        speeds: std::ops::RangeInclusive<f64>,
        motion: Motion<Plane>,
        weight: Option<Plane>,
        of: impl Fn(Means<'_, '_, 6, 15>) -> R,
    ) -> R {
        let coin = dynamics::Coin::PAPER;
        let space = Space::builder(coin).rate_x(1.0..=2.0).rate_y(1.0).rate_z(1.0).speed(speeds).build().unwrap();
        let (directions, _) = crate::enclosure::directions::directions_of(&space);
        let whole = Cell::whole([Some(&directions[0][0]), None, None]);
        let (problem, cell) = (Problem::new(&space, coin, false), whole.halves(0).unwrap()[0].clone());
        of(Means { problem: &problem, cell: &cell, weight, motion })
    }

    fn assert_near(found: Bounds, [lo, hi]: [f64; 2], case: impl std::fmt::Debug) {
        let is_near = found.lo <= lo && hi <= found.hi && found.width() < hi - lo + 1e-12;
        assert!(is_near, "{case:?}: {found:?}, not {lo} to {hi}");
    }

    /// Tails (of A > 0) are within b = atan √(room/A²) of π + 2π n, and heads (of A < 0) of 2π n.
    #[test]
    fn narrow_intervals_are_counted() {
        let b = 0.1_f64.atan();
        for (mean, phases, number) in [
            (1.0, [0.0, 10.0], 2.0),
            (1.0, [3.5, 9.0], 0.0),
            (1.0, [-3.5, 3.5], 2.0),
            (1.0, [3.0, 16.0], 3.0),
            (-1.0, [1.0, 13.0], 2.0),
            (-1.0, [-0.5, 6.5], 2.0),
            (-1.0, [6.5, 12.0], 0.0),
        ] {
            let narrow = 2.0 * b * number / (phases[1] - phases[0]);
            let share = if mean > 0.0 { 1.0 - narrow } else { narrow };
            let case = (mean, phases);
            let found =
                |room: f64, weight| by_hand(motion(room, mean, phases), weight, |means| means.grazing().unwrap());
            assert_near(found(0.01, None), [share, share], case);
            assert_near(found(0.01, Some(constant(2.0))), [2.0 * share, 2.0 * share], case);
            let none = if mean > 0.0 { 1.0 } else { 0.0 };
            assert_near(found(-0.01, None), [none, none], case);
        }
    }

    /// A landing in a narrow interval, or nearly in the next one.
    #[test]
    fn a_landing_within_a_narrow_interval_is_bounded_by_the_half_widths() {
        let b = 0.1_f64.atan();
        for (mean, phases, heads) in [
            (1.0, [PI + 0.05, PI + 2.0], 2.0 - b),
            (1.0, [1.0, PI + 0.05], PI - b - 1.0),
            (1.0, [PI - 0.05, 3.0 * PI + 0.05], TAU - 2.0 * b),
            (-1.0, [0.05, 2.0], b - 0.05),
            (-1.0, [-0.05, TAU - 0.05], 2.0 * b),
        ] {
            let share = heads / (phases[1] - phases[0]);
            let found = by_hand(motion(0.01, mean, phases), None, |means| means.grazing().unwrap());
            assert_near(found, [share, share], (mean, phases));
        }
        // Somewhere from 1.75 to 6.25, and so perhaps at the heads about 2π.
        let wide = about(3.0, Ball::new(4.0, 2.25), 3.0);
        let motion = Motion { phases: [constant(1.0), wide], ..motion(0.01, -1.0, [1.0, 5.0]) };
        let found = by_hand(motion, None, |means| means.grazing().unwrap());
        assert!(found.lo <= 0.0 && found.hi > 0.25 * (6.25 - TAU + b), "{found:?}");
    }

    /// The mean of atan √(Y t) over t from 0 to 1 is (1 + 1/Y) atan √Y - 1/√Y.
    #[test]
    fn narrow_intervals_that_vanish_have_a_mean_width() {
        let y = 0.04_f64;
        let b = 0.5 * ((1.0 + 1.0 / y) * y.sqrt().atan() - 1.0 / y.sqrt());
        for (mean, share) in [(1.0, 1.0 - 0.4 * b), (-1.0, 0.4 * b)] {
            let phases = if mean > 0.0 { [0.0, 10.0] } else { [3.0, 13.0] };
            let motion = Motion { room: linear(0.0, y), ..motion(0.0, mean, phases) };
            let found = by_hand(motion, None, |means| means.grazing().unwrap());
            assert!(found.lo <= share && share <= found.hi && found.width() < 0.004, "{mean}: {found:?}, not {share}");
        }
    }

    /// Where they are known to be narrow.
    #[test]
    fn intervals_graze_up_to_a_ratio_of_a_quarter() {
        for (room, radius, expected) in [
            (0.24, 0.0, true),
            (-0.24, 0.0, true),
            (0.26, 0.0, false),
            (-0.26, 0.0, false),
            (0.0, 0.24, true),
            (0.1, 0.2, false),
            (-0.1, 0.2, false),
        ] {
            let motion = Motion { room: linear(room, radius), ..motion(room, 1.0, [0.5, 8.0]) };
            assert_eq!(by_hand(motion, None, |means| means.grazing().is_some()), expected, "{room} ± {radius}");
        }
        let unknown = Motion { mean: linear(0.5, 0.6), ..motion(0.01, 0.5, [0.5, 8.0]) };
        assert!(by_hand(unknown, None, |means| means.grazing().is_none()));
    }

    #[test]
    fn narrow_half_widths_have_room_for_their_roundings() {
        use numerics::DoubleDouble;
        for part in 1..=100 {
            let ratio = 0.0025 * f64::from(part);
            let root = DoubleDouble::from(ratio).sqrt();
            let exact = Elementary::atan2(&root, &DoubleDouble::from(1.0));
            let [narrowest, widest] = narrow_half_widths([ratio, ratio]).map(DoubleDouble::from);
            let room = |difference: DoubleDouble| difference.to_f64() / exact.to_f64() / f64::EPSILON;
            assert!(
                (2.0..6.0).contains(&room(exact - narrowest)) && (2.0..6.0).contains(&room(widest - exact)),
                "{ratio}"
            );
        }
        assert_eq!(narrow_half_widths([-0.25, 0.0]), [0.0, 0.0]);
    }

    /// By no more than the phase: sin 0.5 = 0.4794.
    #[test]
    fn a_coin_that_turns_by_less_than_to_its_edge_shows_one_face() {
        for (most, cos_tilt, radius, expected) in [
            (0.5, 0.5, 0.0, Some(1.0)),
            (0.5, -0.5, 0.0, Some(-1.0)),
            (0.5, 0.47, 0.0, None),
            (0.5, -0.47, 0.0, None),
            (0.5, 0.49, 0.02, None),
            (0.1, 0.2, 0.3, None),
            (1.0, 0.85, 0.0, Some(1.0)),
            (3.0, 0.5, 0.0, None),
            (f64::NAN, 0.5, 0.0, None),
        ] {
            let motion = Motion { cos_tilt: linear(cos_tilt, radius), ..motion(1.0, 0.0, [0.0, most]) };
            assert_eq!(by_hand(motion, None, |means| means.face_of_all()), expected, "{most} {cos_tilt} ± {radius}");
        }
    }

    #[test]
    fn shares_are_from_0_to_1_and_times_the_density() {
        for (shares, [lo, hi]) in [([0.25, 0.5], [0.25, 0.5]), ([-0.5, 1.5], [0.0, 1.0]), ([2.0, 3.0], [1.0, 1.0])] {
            for factor in [1.0, 2.0] {
                let weight = (factor > 1.0).then(|| constant(factor));
                let found = by_hand(motion(1.0, 0.0, [0.0, 2.0]), weight, |means| means.of_shares(shares, [0.5; 3]));
                assert_near(found, [factor * lo, factor * hi], shares);
                assert_eq!(found.by, [0.5; 3]);
            }
        }
        // Nothing that is known exactly is widened.
        let found = by_hand(motion(1.0, 0.0, [0.0, 2.0]), None, |means| means.of_shares([0.0, 1.0], [0.0; 3]));
        assert_eq!((found.lo, found.hi), (0.0, 1.0));
    }

    /// cos θ = cos φ, where φ = π/2 + 0.2 + 0.4 t is below π/2 for a quarter of the cell.
    #[test]
    fn a_share_times_a_density_is_between_the_smallest_and_the_largest() {
        let phase = linear(FRAC_PI_2 + 0.2, 0.4);
        let of = |weight| by_hand(motion(1.0, 0.0, [0.0, 2.0]), weight, |means| means.of_one_landing(&phase));
        let share = of(None);
        assert!(share.lo < 0.25 && 0.25 < share.hi && share.width() < 0.15, "{share:?}");
        let found = of(Some(linear(2.5, -0.5)));
        assert_near(found, [2.0 * share.lo, 3.0 * share.hi], share);
        // The direction of the phase adds the width of the share, the density's its slope.
        let expected = 3.0 * share.width() + 0.5 * share.hi;
        assert!(
            (found.by[0] - expected).abs() < 1e-9 && found.by[1] + found.by[2] < 1e-300,
            "{found:?}, not {expected}"
        );
    }

    #[test]
    fn a_phase_is_placed_among_the_edges_next_to_it() {
        use Place::{Edge, Inside, Outside};
        for (half_width, phase, radius, expected) in [
            (1.0, 0.0, 0.9, Some(Inside)),
            (1.0, 0.0, 1.1, None),
            (1.0, 1.5, 0.4, Some(Outside(1.0))),
            (1.0, -1.5, 0.4, Some(Outside(-1.0))),
            (1.0, 1.5, 0.6, Some(Edge(1.0))),
            (1.0, -1.5, 0.6, Some(Edge(-1.0))),
            // Tails are from 3 to 2π - 3 = 3.283.
            (3.0, 3.1, 0.05, Some(Outside(1.0))),
            (3.0, -3.1, 0.05, Some(Outside(-1.0))),
            (3.0, 3.1, 0.15, Some(Edge(1.0))),
            (3.0, -3.1, 0.15, Some(Edge(-1.0))),
            (3.0, 3.1, 0.2, None),
            (3.0, -3.1, 0.2, None),
            (3.0, 3.25, 0.05, None),
            (3.0, -3.25, 0.05, None),
        ] {
            let found = place(&linear(phase, radius), &constant(half_width));
            assert_eq!(found, expected, "{half_width}: {phase} ± {radius}");
        }
    }

    /// Heads are within 1 of 2π n, as A = -cos 1 and √room = sin 1. The share is counted by hand.
    #[test]
    fn heads_between_two_landings_are_counted() {
        let (room, mean) = (1.0_f64.sin().powi(2), -1.0_f64.cos());
        for (phases, heads) in [
            ([-0.5, 0.75], 1.25),
            ([0.25, 2.0], 0.75),
            ([-2.0, 0.25], 1.25),
            ([-2.0, 2.0], 2.0),
            ([2.0, 3.0], 0.0),
            ([2.0, 4.0], 0.0),
            ([0.5, TAU + 0.25], 0.5 + 1.25),
            ([-0.5, TAU - 0.25], 1.5 + 0.75),
            ([2.0, TAU + 0.25], 1.25),
            ([-2.0, 2.0 * TAU + 2.0], 6.0),
        ] {
            let share = heads / (phases[1] - phases[0]);
            for factor in [1.0, 2.0] {
                let weight = (factor > 1.0).then(|| constant(factor));
                let expected = [factor * share; 2];
                let found = by_hand(motion(room, mean, phases), weight, |means| means.with_edges());
                assert_near(found, expected, phases);
                let found = by_hand(motion(room, mean, phases), weight, |means| {
                    means.of_half_width(&means.half_width(&means.edge()), &means.motion.phases)
                });
                assert_near(found, expected, phases);
            }
        }
        // About an edge at ±1, max(0, ±0.125 t) has the mean 1/32.
        for (first, last, heads) in [
            (constant(0.0), linear(1.0, 0.125), 1.0 - 1.0 / 32.0),
            (constant(-2.0), linear(-1.0, 0.125), 1.0 / 32.0),
            (linear(-1.0, 0.125), constant(0.0), 1.0 - 1.0 / 32.0),
            (linear(1.0, 0.125), constant(2.0), 1.0 / 32.0),
        ] {
            let motion = Motion { phases: [first, last], ..motion(room, mean, [0.0, 2.0]) };
            let found = by_hand(motion, None, |means| means.with_edges());
            assert_near(found, [0.5 * heads; 2], heads);
        }
    }

    /// With A = 0 and C = 0 heads are where cos φ > 0: at any of the phases between both landings.
    #[test]
    fn any_speed_lands_between_both_landings() {
        for (phases, expected) in [([-0.4, 0.4], [1.0, 1.0]), ([2.8, 3.4], [0.0, 0.0]), ([-1.6, -1.5], [0.0, 1.0])] {
            let found = by_hand(motion(1.0, 0.0, phases), None, |means| means.of_any_speed());
            assert_near(found, expected, phases);
        }
        for (slope, expected) in [(0.125, false), (0.5, true)] {
            let motion = Motion { phases: [constant(1.0), linear(1.25, slope)], ..motion(1.0, 0.0, [1.0, 1.25]) };
            assert_eq!(by_hand(motion, None, |means| means.is_speed_nearly_single()), expected, "{slope}");
        }
    }

    /// Where the motion never passes its edge it has the face of A, which may be unknown.
    #[test]
    fn a_motion_without_edges_has_the_face_of_its_mean() {
        for (mean, radius, expected) in [(0.5, 0.0, [1.0, 1.0]), (-0.5, 0.0, [0.0, 0.0]), (0.5, 0.6, [0.0, 1.0])] {
            let motion = Motion { mean: linear(mean, radius), ..motion(-9.0, mean, [1.0, 8.0]) };
            let found = by_hand(motion, None, |means| means.of_many_speeds(0.0));
            assert_near(found, expected, (mean, radius));
        }
    }

    /// cos θ = cos φ, where φ = π/2 + 0.2 + 0.4 t.
    #[test]
    fn a_single_speed_has_a_single_landing() {
        let phase = linear(FRAC_PI_2 + 0.2, 0.4);
        let motion = Motion { phases: [phase; 2], ..motion(1.0, 0.0, [1.0, 1.0]) };
        let found = with_speeds(2.0..=2.0, motion, None, |means| means.bounds(f64::INFINITY));
        assert!(found.lo > 0.15 && 0.25 < found.hi && found.hi < 0.35, "{found:?}");
    }

    /// Launched from horizontal, also where the cosine of its series is negative.
    #[test]
    fn a_crest_is_at_the_launch_from_horizontal() {
        let motion = Motion { cosine: linear(-1.0, 3.0), sine: linear(0.0, 1.0), ..motion(1.0, 0.0, [1.0, 2.0]) };
        let crest = by_hand(motion, None, |means| means.crest(&constant(1.0)));
        assert_eq!([crest.middle.value(), crest.values()], [exactly(0.0); 2]);
    }

    #[test]
    fn where_no_interval_of_heads_is_passed_there_are_none_at_any_speed() {
        let unknown =
            Function { middle: Series::constant(Ball::new(1.0, f64::INFINITY)), ..about(1.0, exactly(1.0), 0.0) };
        let numerator = Numerator { half_widths: 0.0, inside: [false; 2] };
        let found = by_hand(motion(1.0, 0.0, [2.0, 3.0]), None, |means| {
            means.smooth(numerator, 0.0, [&constant(1.0); 3], &unknown)
        });
        assert_eq!((found.lo, found.hi, found.by), (0.0, 0.0, [0.0; MOST_DIRECTIONS]));
    }

    /// What each direction adds to a width: |L|² is 2, and the cell is a half of its range.
    #[test]
    fn the_direction_that_changes_most_is_told() {
        let with = |room: f64, mean: f64| {
            let still = motion(0.0, 0.0, [1.0, 2.0]);
            Motion { squared: constant(2.0), room: linear(0.0, room), mean: linear(0.0, mean), ..still }
        };
        let unknown = [f64::INFINITY, 0.0, 0.0];
        for (by, room, mean, expected) in [
            // As it is known, from the change of the motion, or from the size of the cell.
            ([0.25, 0.125, 0.0], 3.0, 4.0, [0.25, 0.125, 0.0]),
            (unknown, 3.0, 4.0, [3.5, 0.0, 0.0]),
            (unknown, f64::INFINITY, 0.0, [0.5, 0.0, 0.0]),
        ] {
            let found = by_hand(with(room, mean), None, |means| means.finite_or_sizes(by));
            let is_near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12);
            assert!(is_near, "{by:?} {room} {mean}: {found:?}, not {expected:?}");
        }
        // Of an unknown half-width, the change of the room counts in parts of 3 + 4²/2, and that of each phase.
        for (room, phases, expected) in
            [(3.0, [0.0, 0.0], PI * 3.0 / 11.0), (0.0, [0.25, 0.5], 0.75), (f64::INFINITY, [0.0; 2], 0.5)]
        {
            let [first, last] = phases;
            let motion = Motion { phases: [linear(1.0, first), linear(2.0, last)], ..with(room, 4.0) };
            let found = by_hand(motion, None, |means| means.of_unknown_half_width([0.0, PI], &means.motion.phases));
            assert!((found.by[0] - expected).abs() < 1e-12, "{room} {phases:?}: {found:?}, not {expected}");
        }
        let found =
            by_hand(with(3.0, 4.0), None, |means| means.of_half_width(&linear(1.0, 0.125), &[linear(1.0, 0.25); 2]));
        assert!((found.by[0] - 0.625).abs() < 1e-12, "{found:?}");
    }

    /// In the middle of a normal distribution of the length 16.6 σ.
    #[test]
    fn a_density_of_two_coordinates_is_a_product() {
        let coin = dynamics::Coin::PAPER;
        let normal = || crate::Axis::normal(9.0, 0.5);
        let space = Space::builder(coin).rate_x(2.0).rate_y(normal()).rate_z(normal()).speed(2.0..=3.0);
        let space = space.build().unwrap();
        let (directions, _) = crate::enclosure::directions::directions_of(&space);
        let cell = Cell::whole([Some(&directions[0][0]), Some(&directions[1][0]), None]);
        let weight = Problem::new(&space, coin, false).launches::<6>(&cell, false).weight.unwrap();
        let expected = 16.6_f64.powi(2) / TAU;
        assert!((weight.value().midpoint() - expected).abs() < 1e-12 * expected, "{weight:?}, not {expected}");
    }
}
