//! The mean share of heads over one cell is enclosed, as `docs/proofs/probability.md` derives it.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use numerics::positive_part::Power;
use numerics::{Ball, Elementary, Jet};

use super::cell::{Cell, MOST_DIRECTIONS};
use super::directions::as_given;
use super::function::{Bounds, Function, exactly, lower, magnitude, mean, meet, upper};
use super::roots::squared_angle_of_root;
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

/// The means over one cell.
struct Means<'a, 'b, const T: usize> {
    problem: &'b Problem<'a>,
    cell: &'b Cell<'a>,
    weight: Option<Function<T>>,
    motion: Motion<Function<T>>,
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

    fn launches<const T: usize>(&self, cell: &Cell<'_>, whole: bool) -> Launches<Jet<Ball<f64>, T>> {
        if Jet::<Ball<f64>, T>::ORDER > 2 {
            self.launches_by::<T, 5>(cell, whole)
        } else {
            self.launches_by::<T, 3>(cell, whole)
        }
    }

    /// Each coordinate depends on one direction alone, so that its functions are computed in series of `U` terms in one variable.
    fn launches_by<const T: usize, const U: usize>(&self, cell: &Cell<'_>, whole: bool) -> Launches<Jet<Ball<f64>, T>> {
        let mut values =
            Coordinate::ALL.map(|of| (Jet::<_, U>::constant(as_given(self.space.axis(of).bounds()[0])), 0));
        if self.is_across {
            values[Coordinate::RateY as usize].0 = Jet::constant(exactly(0.0));
        }
        let mut weight: Option<Jet<Ball<f64>, T>> = None;
        for (index, direction) in cell.directions.iter().flatten().enumerate() {
            let (value, density) = direction.at(cell.parameter(index, whole));
            values[direction.of as usize] = (value, index);
            let density = density.map(|density| Jet::in_variable(&density, index));
            weight = match (weight, density) {
                (Some(weight), Some(density)) => Some(weight * density),
                (one, other) => one.or(other),
            };
        }
        let value = |of: Coordinate| values[self.space.place(of) as usize];
        let in_place = |of: Coordinate, apply: &dyn Fn(Jet<Ball<f64>, U>) -> Jet<Ball<f64>, U>| {
            let (value, index) = value(of);
            Jet::in_variable(&apply(value), index)
        };
        let rate = |value: Jet<Ball<f64>, U>| value.times_power_of_two(-self.exponent);
        let momentum = if self.space.is_of_precession() {
            let turn = in_place(Coordinate::Turn, &rate);
            let parts = value(Coordinate::Psi).0.sine_and_cosine();
            let [sin, cos] = parts.map(|part| in_place(Coordinate::Psi, &|_| part));
            [turn * sin, Jet::constant(exactly(0.0)), turn * cos]
        } else {
            [
                in_place(Coordinate::RateX, &rate),
                in_place(Coordinate::RateY, &rate),
                in_place(Coordinate::RateZ, &|value| rate(value).scaled(&self.ratio)),
            ]
        };
        let twice = value(Coordinate::Gravity).0.reciprocal().times_power_of_two(1 + self.exponent);
        let time = |speed: f64| in_place(Coordinate::Gravity, &|_| twice.scaled(&as_given(speed)));
        let times = self.space.axis(Coordinate::Speed).bounds().map(time);
        let tilt = if self.is_horizontal() {
            [0.0, 1.0].map(|value| Jet::constant(exactly(value)))
        } else {
            let parts = value(Coordinate::Tilt).0.sine_and_cosine();
            parts.map(|part| in_place(Coordinate::Tilt, &|_| part))
        };
        Launches { momentum, tilt, times, weight }
    }

    fn motion<const T: usize>(&self, launches: &Launches<Jet<Ball<f64>, T>>) -> Motion<Jet<Ball<f64>, T>> {
        let ([x, y, q], [sin, cos]) = (launches.momentum, launches.tilt);
        let across = x * x + y * y;
        let squared = across + q * q;
        let size = squared.sqrt();
        let level = y * sin;
        let vertical = level + q * cos;
        let [first, last] = launches.times;
        Motion {
            squared,
            phases: [size * first, size * last],
            span: size * (last - first),
            room: across - vertical * vertical,
            mean: vertical * q,
            cosine: across * cos - level * q,
            sine: -(x * sin * size),
            cos_tilt: cos,
        }
    }

    /// Whether all launches are from horizontal.
    fn is_horizontal(&self) -> bool {
        self.space.axis(Coordinate::Tilt).value() == Some(0.0)
    }

    fn has_one_speed(&self) -> bool {
        self.space.axis(Coordinate::Speed).value().is_some()
    }

    /// Bounds of the mean share over `cell`, times the density. If they are wider than `enough`, series of `F` terms are tried
    /// where the share is smooth.
    pub(super) fn bounds<const T: usize, const F: usize>(&self, cell: &Cell<'a>, enough: f64) -> Bounds {
        self.means::<T>(cell).bounds::<F>(enough)
    }

    fn means<'b, const T: usize>(&'b self, cell: &'b Cell<'a>) -> Means<'a, 'b, T> {
        let (middle, whole) = (self.launches::<T>(cell, false), self.launches::<T>(cell, true));
        let weight = middle.weight.zip(whole.weight).map(|(middle, whole)| Function { middle, whole }.narrowed());
        let motion = both(self.motion(&middle), self.motion(&whole));
        Means { problem: self, cell, weight, motion }
    }
}

/// A motion about the middle, and one over the whole of a cell.
fn both<const T: usize>(middle: Motion<Jet<Ball<f64>, T>>, whole: Motion<Jet<Ball<f64>, T>>) -> Motion<Function<T>> {
    let pair = |middle, whole| Function { middle, whole }.narrowed();
    Motion {
        squared: pair(middle.squared, whole.squared),
        phases: [pair(middle.phases[0], whole.phases[0]), pair(middle.phases[1], whole.phases[1])],
        span: pair(middle.span, whole.span),
        room: pair(middle.room, whole.room),
        mean: pair(middle.mean, whole.mean),
        cosine: pair(middle.cosine, whole.cosine),
        sine: pair(middle.sine, whole.sine),
        cos_tilt: pair(middle.cos_tilt, whole.cos_tilt),
    }
}

impl<const T: usize> Means<'_, '_, T> {
    fn bounds<const F: usize>(&self, enough: f64) -> Bounds {
        let found = self.of_any_launches::<F>(enough);
        // Also where nothing is known, a share is from 0 to 1.
        Bounds { lo: found.lo.max(0.0), hi: found.hi.min(self.weight().hi), ..found }
    }

    fn of_any_launches<const F: usize>(&self, enough: f64) -> Bounds {
        if let Some(face) = self.face_of_all() {
            return self.of_one_face(face);
        }
        if self.problem.has_one_speed() {
            return self.of_one_landing(self.motion.phases[1]);
        }
        let found = self.of_many_speeds::<F>(enough);
        let narrower = (found.width() > enough && self.is_speed_nearly_single()).then(|| self.of_any_speed());
        narrower.filter(|other| other.width() < found.width()).unwrap_or(found)
    }

    /// The mean of the share of the speeds.
    fn of_many_speeds<const F: usize>(&self, enough: f64) -> Bounds {
        match self.motion.room.sign() {
            Some(-1.0) => match self.motion.mean.sign() {
                Some(face) => self.of_one_face(face),
                None => self.of_unknown_half_width([0.0, PI]),
            },
            Some(1.0) => {
                let found = self.with_edges::<F>(enough);
                let narrower = (found.width() > enough).then(|| self.grazing());
                narrower.flatten().filter(|other| other.width() < found.width()).unwrap_or(found)
            }
            _ => self.grazing().unwrap_or_else(|| self.of_unknown_half_width([0.0, PI])),
        }
    }

    /// The face that all launches show at every landing because the coin has hardly turned: its normal turns by no more than the
    /// phase.
    fn face_of_all(&self) -> Option<f64> {
        let most = upper(self.motion.phases[1].values());
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
        let Motion { squared, room, mean, cosine, sine, .. } = self.motion;
        let scale = magnitude(squared.middle.value());
        let of_cosine = [room, mean, cosine, sine].map(|part| part.variation());
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
        upper(self.motion.span.values()) < among_launches
    }

    /// Bounds for each speed alone, and so for their mean, which divides by no small difference of phases.
    fn of_any_speed(&self) -> Bounds {
        let Motion { phases: [_, last], span, .. } = self.motion;
        let before = span.map(|span| span.scaled(&Ball::new(0.5, 0.5)));
        self.of_one_landing(last.minus(before).narrowed())
    }

    /// A single landing: the outcome is the sign of cos θ.
    fn of_one_landing(&self, phase: Function<T>) -> Bounds {
        let Motion { mean, cosine, sine, .. } = self.motion;
        let height = Function {
            middle: height(phase.middle, [mean.middle, cosine.middle, sine.middle]),
            whole: height(phase.whole, [mean.whole, cosine.whole, sine.whole]),
        }
        .narrowed();
        if let Some(face) = height.sign() {
            return self.of_one_face(face);
        }
        let found = height.mean_of_positive_part(Power::Zero);
        match &self.weight {
            None => self.of_shares([found.lo, found.hi], found.by),
            // The density times a share is between the smallest and the largest density times it.
            Some(weight) => {
                let all = weight.values();
                // What adds to the width of the share, in units of it.
                let (parts, most) = (self.finite_or_sizes(found.by), found.hi.min(1.0));
                let total = parts.iter().sum::<f64>().max(f64::MIN_POSITIVE);
                let by = std::array::from_fn(|index| {
                    parts[index] / total * (most - found.lo) * magnitude(all) + weight.variation()[index] * most
                });
                Bounds {
                    lo: (lower(all).max(0.0) * found.lo).next_down(),
                    hi: (magnitude(all) * found.hi.min(1.0)).next_up(),
                    by,
                }
            }
        }
    }

    fn crest(&self) -> Function<T> {
        if self.problem.is_horizontal() {
            return Function { middle: Jet::constant(exactly(0.0)), whole: Jet::constant(exactly(0.0)) };
        }
        self.motion.sine.with(self.motion.cosine, |sine, cosine| sine.atan2(&cosine)).narrowed()
    }

    /// a, the half-width of the intervals of heads.
    fn half_width(&self) -> Function<T> {
        let Motion { squared, room, mean, .. } = self.motion;
        squared.times(room).map(|product| product.sqrt()).with(mean, |sine, mean| sine.atan2(&-mean)).narrowed()
    }

    /// The cell has edges of heads, and each landing is near one of them at most.
    fn with_edges<const F: usize>(&self, enough: f64) -> Bounds {
        let (crest, half_width) = (self.crest(), self.half_width());
        let from_crest = self.motion.phases.map(|phase| phase.minus(crest).narrowed());
        let turns = from_crest.each_ref().map(|phase| (phase.middle.to_f64() / TAU).round());
        let landings: [Function<T>; 2] = std::array::from_fn(|end| {
            let turned = self.turned(turns[end]);
            from_crest[end].map(|jet| jet - turned)
        });
        let places = landings.map(|landing| place(landing, half_width));
        let [Some(first), Some(last)] = places else {
            return self.of_half_width(half_width, from_crest);
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
        let inverse = self.motion.span.map(|span| span.reciprocal());
        let per_phase = self.weight.map_or(inverse, |weight| inverse.times(weight));
        let mut beyond_edges = Bounds { lo: 0.0, hi: 0.0, by: [0.0; MOST_DIRECTIONS] };
        for (sign, place, landing) in [(1.0, first, landings[0]), (-1.0, last, landings[1])] {
            let Place::Edge(side) = place else { continue };
            let beyond = half_width.minus(landing.scaled(side)).times(per_phase);
            beyond_edges = beyond_edges.plus(sign * side, beyond.mean_of_positive_part(Power::One));
        }
        // More terms serve if they can make the cell narrow enough.
        let enough = enough - beyond_edges.width();
        self.smooth::<F>(numerator, apart, [half_width, landings[0], landings[1]], inverse, enough)
            .plus(1.0, beyond_edges)
    }

    /// 2π `turns`, as a number.
    fn turned(&self, turns: f64) -> Jet<Ball<f64>, T> {
        let pi = exactly(0.0).pi();
        Jet::constant((pi + pi) * exactly(turns))
    }

    /// The mean of what is smooth.
    fn smooth<const F: usize>(
        &self,
        numerator: Numerator,
        apart: f64,
        [half_width, first, last]: [Function<T>; 3],
        inverse: Function<T>,
        enough: f64,
    ) -> Bounds {
        let Numerator { half_widths, inside } = numerator;
        let nothing = Bounds { lo: 0.0, hi: 0.0, by: [0.0; MOST_DIRECTIONS] };
        let share = match inside {
            [false, false] if half_widths == 0.0 => return nothing,
            [true, true] if apart == 0.0 => return self.weight(),
            // All phases but the tails between.
            [true, true] => {
                let tails = half_width.map(|jet| jet - Jet::constant(exactly(0.0).pi()));
                let share = tails.scaled(half_widths).times(inverse);
                share.map(|jet| jet + Jet::constant(exactly(1.0)))
            }
            [is_first, is_last] => {
                let mut sum = half_width.scaled(half_widths);
                if is_first {
                    sum = sum.minus(first);
                }
                if is_last {
                    sum = sum.plus(last);
                }
                sum.times(inverse)
            }
        };
        let share = self.weight.map_or(share, |weight| share.times(weight));
        let found = share.mean();
        // Two more orders win a factor of 1000 at most.
        if found.width() <= enough || found.width() > 500.0 * enough || F == T {
            return found;
        }
        let fine = self.fine_share::<F>(numerator, apart, &[half_width, first, last]);
        debug_assert!(
            share.middle.terms().zip(fine.terms()).all(|((_, term), (_, other))| meet(term, other)),
            "derivatives about the middle are among those over the whole cell"
        );
        let finer = mean(&share.middle, &fine);
        if finer.width() < found.width() { finer } else { found }
    }

    /// The same share over the whole cell, in a series of more terms.
    fn fine_share<const F: usize>(
        &self,
        numerator: Numerator,
        apart: f64,
        [half_width, first, last]: &[Function<T>; 3],
    ) -> Jet<Ball<f64>, F> {
        let launches = self.problem.launches::<F>(self.cell, true);
        let motion = self.problem.motion(&launches);
        // What was found to be narrower holds here, too. A multiple of 2π makes no difference to the terms but the first.
        let narrowed = |jet: Jet<Ball<f64>, F>, function: &Function<T>| jet.with_constant(*function.values());
        let root = (narrowed(motion.squared, &self.motion.squared) * narrowed(motion.room, &self.motion.room)).sqrt();
        let width = narrowed(root.atan2(&-narrowed(motion.mean, &self.motion.mean)), half_width);
        let inverse = narrowed(motion.span, &self.motion.span).reciprocal();
        let crest = if self.problem.is_horizontal() {
            Jet::constant(exactly(0.0))
        } else {
            narrowed(motion.sine, &self.motion.sine).atan2(&narrowed(motion.cosine, &self.motion.cosine))
        };
        let share = if numerator.inside == [true, true] {
            (width - Jet::constant(exactly(0.0).pi())).scaled(&exactly(2.0 * apart)) * inverse
                + Jet::constant(exactly(1.0))
        } else {
            let mut sum = width.scaled(&exactly(numerator.half_widths));
            if numerator.inside[0] {
                sum = sum - narrowed(motion.phases[0] - crest, first);
            }
            if numerator.inside[1] {
                sum = sum + narrowed(motion.phases[1] - crest, last);
            }
            sum * inverse
        };
        launches.weight.map_or(share, |weight| share * weight)
    }

    /// Bounds of any cell with a half-width: that of heads between two phases grows with it.
    fn of_half_width(&self, half_width: Function<T>, from_crest: [Function<T>; 2]) -> Bounds {
        let widths = [lower(half_width.values()).max(0.0), upper(half_width.values()).min(PI.next_up())];
        let [first, last] = from_crest.map(|phase| [lower(phase.values()), upper(phase.values())]);
        let smallest = heads_between(first[1], last[0], widths[0])[0];
        let largest = heads_between(first[0], last[1], widths[1])[1];
        let span = self.motion.span.values();
        let by = std::array::from_fn(|index| {
            from_crest[0].variation()[index] + from_crest[1].variation()[index] + half_width.variation()[index]
        });
        if !(span.has_sign() && smallest.is_finite() && largest.is_finite()) {
            return self.of_shares([0.0, 1.0], by);
        }
        self.of_shares([(smallest / upper(span)).next_down(), (largest / lower(span)).next_up()], by)
    }

    /// The same where no more is known of the half-width than its range.
    fn of_unknown_half_width(&self, [lo, hi]: [f64; 2]) -> Bounds {
        let middle = Jet::constant(Ball::new(0.5 * (lo + hi), (0.5 * (hi - lo)).next_up()));
        let crest = self.crest();
        let from_crest = self.motion.phases.map(|phase| phase.minus(crest).narrowed());
        let mut found = self.of_half_width(Function { middle, whole: middle }, from_crest);
        // The half-width is that of (-A |L|, √(P - s²)): each direction adds to it what it adds to P - s², in parts of both squares.
        let Motion { squared, room, mean, .. } = &self.motion;
        let of_mean = magnitude(mean.values()).powi(2) / magnitude(squared.middle.value());
        let per_room = (hi - lo) / (magnitude(room.values()) + of_mean);
        for (by, room) in found.by.iter_mut().zip(room.variation()) {
            *by += per_room * room;
        }
        if found.by.iter().any(|by| !by.is_finite()) {
            self.of_shares([found.lo, found.hi], [f64::INFINITY; 3])
        } else {
            found
        }
    }

    /// The motion may graze cos θ = 0 in the cell: the intervals of one face, tails or heads, are narrow and vanish. `None` if
    /// they are not narrow.
    fn grazing(&self) -> Option<Bounds> {
        let Motion { squared, room, mean, span, .. } = self.motion;
        let face = mean.sign()?;
        // The narrow intervals are those of the face that the mean has not.
        let is_heads = face == 1.0;
        let ratio = squared.times(room).with(mean, |product, mean| product / (mean * mean)).narrowed();
        let ratios = [lower(ratio.values()), upper(ratio.values())];
        if !ratios.iter().all(|ratio| ratio.abs() <= 0.25) {
            return None;
        }
        let [narrowest, widest] = narrow_half_widths(ratios);
        let crest = self.crest();
        let from_crest = self.motion.phases.map(|phase| phase.minus(crest).narrowed());
        let crude = || {
            let heads =
                if is_heads { [(PI - widest).next_down(), PI.next_up() - narrowest] } else { [narrowest, widest] };
            self.of_unknown_half_width(heads)
        };
        // Phases from the nearest middle of a narrow interval.
        let to_middle = if is_heads { exactly(0.0).pi() } else { exactly(0.0) };
        let mut passed = [0.0; 2];
        for (passed, phase) in passed.iter_mut().zip(&from_crest) {
            let phase = phase.map(|jet| jet - Jet::constant(to_middle));
            let turns = (phase.middle.to_f64() / TAU).round();
            let turned = self.turned(turns);
            let distance = phase.map(|jet| jet - turned).narrowed();
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
        let factor = span.map(|span| span.reciprocal()).scaled(2.0 * number);
        let factor = self.weight.map_or(factor, |weight| factor.times(weight));
        let squared = ratio.map(|ratio| squared_angle_of_root(&ratio)).times(factor.times(factor));
        let narrow = squared.mean_of_positive_part(Power::Half);
        Some(if is_heads { self.weight().plus(-1.0, narrow) } else { narrow })
    }
}

/// Bounds of atan √`ratio` between two ratios; 0 for a negative one.
fn narrow_half_widths(ratios: [f64; 2]) -> [f64; 2] {
    let [narrowest, widest] = ratios.map(|ratio| ratio.max(0.0).sqrt().atan());
    [narrowest * (1.0 - 4.0 * f64::EPSILON), widest * (1.0 + 4.0 * f64::EPSILON)]
}

/// |L|² cos θ at a phase.
fn height<const T: usize>(phase: Jet<Ball<f64>, T>, [mean, cosine, sine]: [Jet<Ball<f64>, T>; 3]) -> Jet<Ball<f64>, T> {
    let [sin, cos] = phase.sine_and_cosine();
    mean + cosine * cos + sine * sin
}

/// Where a phase from the crest is, over the whole cell; `None` if it is near more than one edge.
fn place<const T: usize>(landing: Function<T>, half_width: Function<T>) -> Option<Place> {
    let is_positive = |function: Function<T>| function.narrowed().sign() == Some(1.0);
    let whole_turn = Jet::constant(exactly(0.0).pi() + exactly(0.0).pi());
    // To the upper and the lower edge, and to those of the intervals before and after.
    let [up, down] = [half_width.minus(landing), half_width.plus(landing)];
    let [after_last, before_next] = [up, down].map(|edge| edge.map(|jet| whole_turn - jet));
    let (is_below_upper, is_above_lower) = (is_positive(up), is_positive(down));
    match (is_below_upper, is_above_lower) {
        (true, true) => Some(Place::Inside),
        (false, true) if is_positive(before_next) => {
            let is_beyond = up.narrowed().sign() == Some(-1.0);
            Some(if is_beyond { Place::Outside(1.0) } else { Place::Edge(1.0) })
        }
        (true, false) if is_positive(after_last) => {
            let is_beyond = down.narrowed().sign() == Some(-1.0);
            Some(if is_beyond { Place::Outside(-1.0) } else { Place::Edge(-1.0) })
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
    fn constant(value: f64) -> Function<6> {
        linear(value, 0.0)
    }

    /// value + slope t in the first direction.
    fn linear(value: f64, slope: f64) -> Function<6> {
        about(value, Ball::new(value, slope.abs()), slope)
    }

    /// A function of this value and slope about the middle, with these values over the cell.
    fn about(value: f64, whole: Ball<f64>, slope: f64) -> Function<6> {
        let jet = |value| Jet::variable(value, exactly(slope), 0);
        Function { middle: jet(exactly(value)), whole: jet(whole) }
    }

    /// The motion of launches of |L| = 1 from horizontal, with a room P - s² and A, between two phases.
    fn motion(room: f64, mean: f64, [first, last]: [f64; 2]) -> Motion<Function<6>> {
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
    fn by_hand<R>(motion: Motion<Function<6>>, weight: Option<Function<6>>, of: impl Fn(Means<'_, '_, 6>) -> R) -> R {
        with_speeds(2.0..=3.0, motion, weight, of)
    }

    fn with_speeds<R>(
        speeds: std::ops::RangeInclusive<f64>,
        motion: Motion<Function<6>>,
        weight: Option<Function<6>>,
        of: impl Fn(Means<'_, '_, 6>) -> R,
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
        let of = |weight| by_hand(motion(1.0, 0.0, [0.0, 2.0]), weight, |means| means.of_one_landing(phase));
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
            let found = place(linear(phase, radius), constant(half_width));
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
                let found = by_hand(motion(room, mean, phases), weight, |means| means.with_edges::<6>(0.0));
                assert_near(found, expected, phases);
                let found = by_hand(motion(room, mean, phases), weight, |means| {
                    means.of_half_width(means.half_width(), means.motion.phases)
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
            let found = by_hand(motion, None, |means| means.with_edges::<6>(0.0));
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
            let found = by_hand(motion, None, |means| means.of_many_speeds::<6>(0.0));
            assert_near(found, expected, (mean, radius));
        }
    }

    /// cos θ = cos φ, where φ = π/2 + 0.2 + 0.4 t.
    #[test]
    fn a_single_speed_has_a_single_landing() {
        let phase = linear(FRAC_PI_2 + 0.2, 0.4);
        let motion = Motion { phases: [phase; 2], ..motion(1.0, 0.0, [1.0, 1.0]) };
        let found = with_speeds(2.0..=2.0, motion, None, |means| means.bounds::<6>(f64::INFINITY));
        assert!(found.lo > 0.15 && 0.25 < found.hi && found.hi < 0.35, "{found:?}");
    }

    /// Launched from horizontal, also where the cosine of its series is negative.
    #[test]
    fn a_crest_is_at_the_launch_from_horizontal() {
        let motion = Motion { cosine: linear(-1.0, 3.0), sine: linear(0.0, 1.0), ..motion(1.0, 0.0, [1.0, 2.0]) };
        let crest = by_hand(motion, None, |means| means.crest());
        assert_eq!([*crest.middle.value(), *crest.values()], [exactly(0.0); 2]);
    }

    #[test]
    fn where_no_interval_of_heads_is_passed_there_are_none_at_any_speed() {
        let unknown =
            Function { middle: Jet::constant(Ball::new(1.0, f64::INFINITY)), ..about(1.0, exactly(1.0), 0.0) };
        let numerator = Numerator { half_widths: 0.0, inside: [false; 2] };
        let found = by_hand(motion(1.0, 0.0, [2.0, 3.0]), None, |means| {
            means.smooth::<6>(numerator, 0.0, [constant(1.0); 3], unknown, 0.0)
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
            let found = by_hand(motion, None, |means| means.of_unknown_half_width([0.0, PI]));
            assert!((found.by[0] - expected).abs() < 1e-12, "{room} {phases:?}: {found:?}, not {expected}");
        }
        let found =
            by_hand(with(3.0, 4.0), None, |means| means.of_half_width(linear(1.0, 0.125), [linear(1.0, 0.25); 2]));
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

    /// Series of more terms are tried for what is smooth as soon as a cell is a little too wide, also where it has an edge.
    #[test]
    fn a_cell_that_more_terms_make_narrower_becomes_narrower() {
        let coin = dynamics::Coin::PAPER;
        let space = Space::builder(coin).rate_x(1.0).rate_y(9.0..=12.0).rate_z(5.0).speed(2.0..=2.5);
        for (x, tilt, least) in [(1.0, 0.0, 41), (12.0, 2.0, 1)] {
            let number =
                number_of_cells_that_more_terms_make_narrower(&space.clone().rate_x(x).tilt(tilt).build().unwrap());
            assert!(number >= least, "{tilt}: {number}");
        }
    }

    fn number_of_cells_that_more_terms_make_narrower(space: &Space) -> usize {
        let (directions, _) = crate::enclosure::directions::directions_of(space);
        let problem = Problem::new(space, dynamics::Coin::PAPER, false);
        let mut cells = vec![Cell::whole([Some(&directions[0][0]), None, None])];
        for _ in 0..6 {
            cells = cells.iter().flat_map(|cell| cell.halves(0).unwrap()).collect();
        }
        let narrower = cells.iter().filter(|cell| {
            let means = problem.means::<3>(cell);
            let width = |enough: f64| means.with_edges::<5>(enough).width();
            let rough = width(f64::MAX);
            let least = (1..6).map(|halvings| width(rough * 0.5_f64.powi(halvings))).fold(f64::INFINITY, f64::min);
            let found = width(0.999 * rough);
            assert!(found <= least, "{found} {least} {rough}");
            found < rough
        });
        narrower.count()
    }
}
