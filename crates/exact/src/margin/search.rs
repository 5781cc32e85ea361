//! The search for the nearest flip along a line of turns, which passes none over.
//!
//! From a launch that lands with f > 0 (its own outcome), the search walks away in steps that are proven free of flips. With
//! |f''| ≤ M ahead and h the distance from where f and f' are known,
//!
//! ```text
//! f + f' h - ½ M h² ≤ f(h) ≤ f + f' h + ½ M h²
//! ```
//!
//! so there is no flip before the root of the left side, and one before the root of the right side if it has one. The left
//! root is the step; it is Newton's near a flip, from this side of it. When both roots agree to [`RESOLUTION`], the flip lies
//! between them. Errors of f and f' are added to the side that they may harm, and where they matter f is found again in more
//! digits. Both directions advance in turn, the nearer one first, so that the first flip found is the nearest.

use super::height::Height;
use super::line::Line;

/// Width of the interval that a flip is known to lie in, in parts of its distance. Also the shortest step: where f dips
/// towards 0 and comes back within this, it touches and does not flip.
const RESOLUTION: f64 = 5e-13;

/// The walk in one direction.
pub(super) struct Walk<'a> {
    line: &'a Line<'a>,
    /// 1 for heads, -1 for tails.
    outcome: f64,
    /// 1 or -1.
    sense: f64,
    /// How far it has come (rad), and how far it has to go.
    distance: f64,
    limit: f64,
    state: State,
    /// What is left of the work that it may take.
    work: f64,
}

/// Work of a height in f64, in double-double and in many digits, roughly in units of 50 ns.
const WORK: [f64; 3] = [1.0, 20.0, 5000.0];

/// The work that a search may take: some hundred milliseconds. Ordinary tosses take less than a ten-thousandth of it. It ends
/// a search along hundreds of touches, as there are about a coin on edge.
pub(super) const MOST_WORK: f64 = 2e6;

#[derive(Debug, Clone, Copy, PartialEq)]
enum State {
    /// No flip up to the distance.
    Under,
    /// One flip, at the distance.
    Flip,
    /// No flip up to the limit.
    Over,
    /// No flip up to the distance, and no work is left.
    Spent,
}

impl<'a> Walk<'a> {
    /// From the launch, whose `outcome` is 1 for heads and -1 for tails, in the direction of `sense`.
    pub(super) fn new(line: &'a Line<'a>, outcome: f64, sense: f64, limit: f64, work: f64) -> Self {
        // A limit that is not positive leaves nothing to search.
        let state = if limit > 0.0 { State::Under } else { State::Over };
        Self { line, outcome, sense, distance: 0.0, limit, state, work }
    }

    /// The nearer flip of two directions; the distance up to which there is none if the work ended before the limits.
    pub(super) fn nearer(mut walks: [Self; 2]) -> Result<Option<f64>, f64> {
        loop {
            let distances =
                walks.each_ref().map(|walk| if walk.state == State::Over { f64::INFINITY } else { walk.distance });
            let walk = &mut walks[usize::from(distances[1] < distances[0])];
            match walk.state {
                State::Under => walk.advance(),
                State::Flip | State::Over => return Ok(walk.flip()),
                State::Spent => return Err(walk.distance),
            }
        }
    }

    fn flip(&self) -> Option<f64> {
        (self.state == State::Flip).then_some(self.change())
    }

    /// The change of the turn so far (rad).
    fn change(&self) -> f64 {
        self.sense * self.distance
    }

    /// One step.
    fn advance(&mut self) {
        let change = self.change();
        let mut here = self.oriented(self.line.height(0, change));
        let mut flip = self.enclosed(&here);
        self.work -= WORK[0];
        for (stage, work) in (1..).zip(&WORK[1..]) {
            if flip.is_none() && here.value < 4.0 * here.error {
                self.work -= work;
                here = self.oriented(self.line.height(stage, change));
                flip = self.enclosed(&here);
            }
        }
        if let Some(further) = flip {
            return self.arrive(further, State::Flip);
        }
        let step = self.free_length(&here).max(self.line.closed_length(change, self.sense));
        let shortest = RESOLUTION * self.distance;
        if step.max(shortest) > 0.0 {
            self.arrive(step.max(shortest), State::Under);
        } else {
            // The flip is nearer than the smallest f64.
            self.arrive(0.0, State::Flip);
        }
    }

    /// Goes on by `further` (rad).
    fn arrive(&mut self, further: f64, state: State) {
        self.distance += further;
        self.state = match state {
            _ if self.distance >= self.limit => State::Over,
            State::Under if self.work < 0.0 => State::Spent,
            state => state,
        };
    }

    /// The height above the edge as seen by this walk.
    fn oriented(&self, height: Height) -> Height {
        Height { value: self.outcome * height.value, slope: self.outcome * self.sense * height.slope, ..height }
    }

    /// How much further the first flip is, if it is known to the resolution.
    fn enclosed(&self, here: &Height) -> Option<f64> {
        let [value, fall] = [here.value + here.error, -(here.slope + here.slope_error)];
        // Only a shortest step can have passed a flip.
        if value < 0.0 {
            return Some(0.0);
        }
        if fall <= 0.0 {
            return None;
        }
        // It cannot be further than at twice Newton's distance.
        let curvature = self.line.curvature(self.change(), self.sense, 2.0 * value / fall);
        let discriminant = fall * fall - 2.0 * curvature * value;
        if discriminant <= 0.0 {
            return None;
        }
        let most = 2.0 * value / (fall + discriminant.sqrt());
        let least = free(here, curvature);
        (most - least <= RESOLUTION * (self.distance + least)).then_some(0.5 * (least + most))
    }

    /// A length without a flip.
    fn free_length(&self, here: &Height) -> f64 {
        let curvature = |length| self.line.curvature(self.change(), self.sense, length);
        let far = free(here, curvature(0.0));
        free(here, 1.0).max(far.min(free(here, curvature(far))))
    }
}

/// The length over which f stays positive if its second derivative is at least -`curvature`.
fn free(here: &Height, curvature: f64) -> f64 {
    let [value, slope] = [here.value - here.error, here.slope - here.slope_error];
    if value <= 0.0 {
        return 0.0;
    }
    // The factor below is for the roundings of this length.
    let root = (slope * slope + 2.0 * curvature * value).sqrt();
    (1.0 - 1e-15) * if slope > 0.0 { (slope + root) / curvature } else { 2.0 * value / (root - slope) }
}

#[cfg(test)]
mod tests {
    use dynamics::{Attitude, Coin, CoinToss, Launch, TimeOfFlight};
    use numerics::DoubleDouble;

    use super::*;

    #[test]
    fn a_length_without_a_flip_ends_at_the_root_of_the_parabola_before_it() {
        let exactly = DoubleDouble::from;
        for slope in [0.0, 1e-9, 0.3, 1e9, -1e-9, -0.3, -1e9] {
            for (value, curvature) in [(0.5, 1.0), (1e-20, 1.0), (0.7, 1e-3), (1e-9, 0.3)] {
                let free = |error: f64, slope_error: f64| free(&Height { value, slope, error, slope_error }, curvature);
                let length = free(0.0, 0.0);
                let left = |length: f64| {
                    exactly(value) + exactly(slope) * exactly(length)
                        - (exactly(curvature) * exactly(length) * exactly(length)).half()
                };
                let [before, after] = [left(length).hi(), left(length * (1.0 + 2e-15)).hi()];
                assert!(before > 0.0 && after < 0.0, "{value} {slope} {curvature}: {length:e} {before:e} {after:e}");
                assert!(free(0.5 * value, 0.0) <= length && free(0.0, 0.1) <= length && free(value, 0.0) == 0.0);
            }
        }
    }

    #[test]
    fn a_walk_ends_at_its_limit_at_a_flip_or_when_no_work_is_left() {
        let launch = Launch::new([1.0, 0.0, 0.0], TimeOfFlight::Given(1.0)).unwrap();
        let toss = CoinToss { coin: Coin::from_moments(1.0, 1.0).unwrap(), launch };
        let line = Line::of_rate(&toss, 0, [1.0, 0.0, 0.0].map(Into::into));
        let cases = [
            (1.0, 2.0, State::Under, State::Under),
            (0.0, 2.0, State::Under, State::Under),
            (-1.0, 2.0, State::Under, State::Spent),
            (-1.0, 2.0, State::Flip, State::Flip),
            (-1.0, 3.0, State::Flip, State::Over),
            (1.0, 3.0, State::Under, State::Over),
        ];
        for (work, further, state, expected) in cases {
            let mut walk = Walk { distance: 1.0, ..Walk::new(&line, 1.0, 1.0, 4.0, work) };
            walk.arrive(further, state);
            assert_eq!((walk.state, walk.distance), (expected, 1.0 + further), "{work} {further}");
        }
    }

    /// With m along x and Φ = (0.001, 0, z), |f''| is at most (4 + |z|)/12 of 0.001. A height of 1/2 that falls with 0.1 has
    /// its flip within twice Newton's distance, where that is some 0.0012: between 4.86 and 5.16.
    #[test]
    fn a_flip_is_enclosed_if_the_curvature_up_to_it_and_both_errors_allow() {
        let start = Launch::new([1.0, 0.0, 0.0], TimeOfFlight::Given(1.0)).unwrap();
        let launch = start.with_attitude(Attitude::from_components([1.0, 0.0, -1.0, 0.0]).unwrap());
        let toss = CoinToss { coin: Coin::from_moments(1.0, 1.0).unwrap(), launch };
        let enclosed = |x: f64, distance: f64, sense: f64, here: &Height| {
            let line = Line::of_rate(&toss, 2, [x, 0.0, -sense * distance].map(Into::into));
            Walk { distance, ..Walk::new(&line, 1.0, sense, f64::INFINITY, MOST_WORK) }.enclosed(here)
        };
        let found = |width: f64, error: f64, slope_error: f64| {
            let here = Height { value: 0.5, slope: -0.1, error, slope_error };
            let [up, down] = [1.0, -1.0].map(|sense| enclosed(1e-3, width / RESOLUTION, sense, &here));
            assert_eq!(up, down);
            up
        };
        assert!(found(0.4, 0.0, 0.0).is_some_and(|further| (further - 5.0).abs() < 0.02));
        assert_eq!(found(0.2, 0.0, 0.0), None);
        assert_eq!([found(0.4, 0.01, 0.0), found(0.4, 0.0, 0.002)], [None; 2]);
        assert!(found(0.6, 0.01, 0.0).is_some() && found(0.6, 0.0, 0.002).is_some());
        // A flip at 3 seen from 1, on a line with next to no curvature: the error of the height makes the width.
        let flip = |width: f64| {
            enclosed(1e-30, 1.0, 1.0, &Height { value: 0.2, slope: -0.1, error: 0.05 * width, slope_error: 0.0 })
        };
        assert!(flip(2.9 * RESOLUTION).is_some_and(|further| (further - 2.0).abs() < 1e-12));
        assert_eq!(flip(3.1 * RESOLUTION), None);
        // Below the edge, one was passed.
        let passed =
            |value: f64| enclosed(1e-30, 1.0, 1.0, &Height { value, slope: 0.1, error: 0.1, slope_error: 0.0 });
        assert_eq!([-0.2, -0.1, 0.2].map(passed), [Some(0.0), None, None]);
    }

    /// With m along y and Φ along x, cos θ = -sin Φx.
    #[test]
    fn a_height_takes_the_work_of_its_digits_and_one_of_0_is_a_flip() {
        for (x, work) in [(-0.5, 1.0), (-1e-14, 21.0), (-1e-40, 5021.0), (0.0, 5021.0)] {
            let launch = Launch::new([x, 0.0, 0.0], TimeOfFlight::Given(1.0)).unwrap();
            let launch = launch.with_attitude(Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap());
            let toss = CoinToss { coin: Coin::from_moments(1.0, 1.0).unwrap(), launch };
            let line = Line::of_rate(&toss, 0, [x, 0.0, 0.0].map(Into::into));
            for sense in [1.0, -1.0] {
                let mut walk = Walk::new(&line, 1.0, sense, 1.0, MOST_WORK);
                walk.advance();
                assert_eq!(walk.work, MOST_WORK - work, "{x} {sense}");
                assert!(x != 0.0 || (walk.state, walk.distance) == (State::Flip, 0.0), "{sense}: {:?}", walk.state);
            }
        }
    }
}
