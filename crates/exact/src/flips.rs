//! The search for flips: the changes of one input of a toss at which its outcome changes, one after another or the nearest.
//!
//! The search walks along the input. Of each step a [`Line`] gives cos θ as a polynomial with a bound of its error, which
//! holds for every change within the step. Up to where the polynomial is above its bound there is no flip, and none is
//! passed over. Where it is below the negative bound shortly beyond, a flip lies in between: when that is known to
//! [`RESOLUTION`], it has been found. Else the next step is some times as long as what is not known. The bound falls with the
//! fifth power of the length, and so two or three steps do. Where the bound is that of rounding, the next stage has more
//! digits.
//!
//! The search passes no toss that it cannot decide: it ends there, and says how far it came.

mod enclosure;

use dynamics::Outcome;

pub(crate) use self::enclosure::Enclosure;
use crate::rigid::line::Line;

/// Width of the interval that a flip is known to lie in, in parts of its distance; also the shortest step.
pub(crate) const RESOLUTION: f64 = 2.5e-13;

/// The work that a search may take, about half a second: see [`Line::work`].
pub(crate) const MOST_WORK: u32 = 250_000;

/// How a search ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum End {
    /// At a flip, at this distance.
    Flip(f64),
    /// At the limit.
    Limit,
    /// For want of work or digits, at this distance.
    Spent(f64),
}

/// The flips in one direction.
pub(crate) struct Flips<'a> {
    line: &'a Line<'a>,
    sign: f64,
    sense: f64,
    /// Where the search begins, as a change of the input.
    origin: f64,
    distance: f64,
    step: f64,
    /// The length of the last step without a zero.
    stride: f64,
    limit: f64,
    /// What is added to the distance before the resolution is taken of it.
    offset: f64,
    work: u32,
}

/// What is known of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Step {
    /// It holds no flip.
    Free,
    /// There is a zero between two distances from its start, and this sign beyond.
    Zero([f64; 2], f64),
    /// It holds no flip up to this distance from its start, and the next step should be so long.
    Open(f64, f64),
}

impl<'a> Flips<'a> {
    /// From the toss of the line, which lands with `outcome`, up to `limit`.
    pub(crate) fn new(line: &'a Line<'a>, outcome: Outcome, sense: f64, limit: f64, offset: f64) -> Self {
        let sign = match outcome {
            Outcome::Heads => 1.0,
            Outcome::Tails => -1.0,
            Outcome::Undecided => 0.0,
        };
        let step = limit / 64.0;
        Self { line, sign, sense, origin: 0.0, distance: 0.0, step, stride: step, limit, offset, work: 0 }
    }

    /// The same search from another change of the input.
    pub(crate) fn starting_at(self, origin: f64) -> Self {
        Self { origin, ..self }
    }

    /// Goes on to the next flip. The distances that it returns are from the toss of the line.
    pub(crate) fn next(&mut self) -> End {
        loop {
            if let Some(end) = self.advance() {
                return end;
            }
        }
    }

    /// The nearer flip of the searches upwards and downwards, as a change of the input, if there is one; the distance up to
    /// which there is none if one of them ended before it could have found one as near.
    ///
    /// Both go on in turn, the one that is behind first. Of two flips that are as near it is the upper one.
    pub(crate) fn nearer(mut both: [Self; 2]) -> Result<Option<f64>, f64> {
        let mut found = [None; 2];
        loop {
            let [up, down] =
                both.each_ref().map(|search| if search.is_over() { f64::INFINITY } else { search.distance });
            let index = usize::from(down < up);
            if both[index].is_over() {
                break;
            }
            match both[index].advance() {
                None | Some(End::Limit) => {}
                Some(End::Spent(distance)) => return Err(distance),
                Some(End::Flip(distance)) => {
                    found[index] = Some(distance);
                    both[index].limit = 0.0;
                    let other = &mut both[1 - index];
                    other.limit = other.limit.min(distance * (1.0 + 4.0 * RESOLUTION));
                }
            }
        }
        Ok(match found {
            [Some(up), Some(down)] if down < up * (1.0 - 4.0 * RESOLUTION) => Some(-down),
            [None, Some(down)] => Some(-down),
            [up, _] => up,
        })
    }

    fn is_over(&self) -> bool {
        self.distance >= self.limit
    }

    /// How far the search has come, from the toss of the line.
    fn reached(&self) -> f64 {
        self.origin + self.distance
    }

    /// Takes one step; how the search ended, if it has.
    fn advance(&mut self) -> Option<End> {
        if self.is_over() {
            return Some(End::Limit);
        }
        if self.work > MOST_WORK || self.sign == 0.0 || self.step == 0.0 {
            return Some(End::Spent(self.reached()));
        }
        let step = self.step.min(self.limit - self.distance);
        match self.look(step) {
            Step::Free => {
                self.distance += step;
                self.step = 2.0 * step;
                self.stride = self.step;
                None
            }
            Step::Zero([from, to], sign) => {
                let at = self.reached() + 0.5 * (from + to);
                self.distance += to;
                self.step = self.stride;
                self.turned(sign, at)
            }
            Step::Open(free, next) if step > self.resolution() => {
                self.distance += free;
                self.step = next.min(0.5 * step);
                None
            }
            Step::Open(..) => {
                let Some((passed, sign)) = self.decided_after(step) else { return Some(End::Spent(self.reached())) };
                let at = self.reached() + 0.5 * passed;
                self.distance += passed;
                self.step = self.stride;
                self.turned(sign, at)
            }
        }
    }

    /// A flip at this distance if the `sign` is not that of before it.
    fn turned(&mut self, sign: f64, at: f64) -> Option<End> {
        (std::mem::replace(&mut self.sign, sign) == -sign).then_some(End::Flip(at))
    }

    /// Width to which a flip is to be known here.
    fn resolution(&self) -> f64 {
        RESOLUTION * (self.offset + self.distance)
    }

    /// What the stages say of the next `step`.
    fn look(&mut self, step: f64) -> Step {
        let [middle, radius] = self.next_interval(step);
        // Distances from the start of the step, from which the interval is some roundings off.
        let slack = 2.0 * (radius - 0.5 * step);
        let distance = |x: f64| 0.5 * step * (1.0 + x);
        let mut open = Step::Open(0.0, 0.5 * step);
        for (stage, work) in self.line.work().iter().take(self.line.interval_stages()).enumerate() {
            self.work += work;
            let seen = self.line.enclosure(stage, middle, radius).facing(self.sign, self.sense);
            let x = seen.positive_up_to();
            if x >= 1.0 {
                return Step::Free;
            }
            let free = (distance(x) - slack).max(0.0);
            let resolution = RESOLUTION * (self.offset + self.distance + free);
            let known = seen.known_beyond(x, resolution / radius / 64.0);
            let width = known.map_or(step, |[known, _]| distance(known) + slack - free);
            if let Some([_, sign]) = known
                && width <= resolution
            {
                return Step::Zero([free, free + width], self.sign * sign);
            }
            open = Step::Open(free, 3.0 * width);
            // A narrower step does not get below the error of the toss where this one is no longer known.
            const MOST_OF_ROUNDING: f64 = 1.0 / 16.0;
            self.work += work;
            let rounding = self.line.rounding(stage, middle + self.sense * radius * x);
            if rounding < MOST_OF_ROUNDING * seen.error() {
                break;
            }
        }
        open
    }

    /// The middle and the radius of an interval of changes that contains the next `step`.
    fn next_interval(&self, step: f64) -> [f64; 2] {
        let middle = self.origin + self.sense * (self.distance + 0.5 * step);
        // The middle is rounded, and so are both ends. From another origin a rounding of it may be left out, which is some
        // thousandth of the resolution. Below the normal numbers a rounding is one of the smallest.
        let roundings = 2.0 * f64::EPSILON * (middle.abs() + step) + 2.0 * f64::from_bits(1);
        [middle, 0.5 * step + roundings]
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
mod tests;
