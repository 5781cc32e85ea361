//! Continuous Euler angles of any rigid body. An attitude leaves open how often α, β and γ have turned since launch.
//! For a coin the closed form tells it. A body with three moments turns with two frequencies, and the turns of the
//! angles are not a sum of two phases; they are found by steps that are too short for an angle to turn unseen.
//!
//! The halves p = w + iz and r = x + iy of the attitude have the arguments (α + γ)/2 and (α - γ)/2. With
//! ω⊥ = ωx + iωy, Q' = ½ Q ω is
//!
//! ```text
//! p' = ½ (iωz p - r ω⊥*),    r' = ½ (p ω⊥ - iωz r)
//! ```
//!
//! so that an argument turns by ½ωz, and by what the distance ½ ∫|ω⊥| dt takes p or r around the origin. Now
//! |ω| ≤ g |ω(0)|, with g = √2 or a little more for a plate as thin as rounding
//! ([`RigidBody::largest_growth_of_rate`](dynamics::RigidBody::largest_growth_of_rate)), and where n is a principal axis |ω⊥|' ≤ |ωz| |ω⊥|, because no ratio
//! |I_i - I_j|/I_k is above 1 by more than rounding. In a step h with g |ω(0)| h ≤ 1 and ½ e |ω⊥| h ≤ 0.8 |r| the argument of r turns by less
//! than ½ + asin 0.8 < π/2, so that the nearest branch is the continuous one; likewise for p. The spin about an upright
//! normal, where r and ω⊥ are 0, needs no short steps. Of another tensor, the whole path ½ g |ω(0)| h is below 0.8 |r|.
//!
//! Where |p| or |r| is below 1e-13, as after every horizontal launch, the attitude tells no argument. The angles are
//! continued straight through such a point, as those of a coin are, and β goes on past 0 or π.

use std::f64::consts::E;

use dynamics::{Attitude, EulerAngles, SolveError, Stage, State, Toss};

use numerics::scale::power_of_two_scale;

use super::{TO_F64, state, turned_at_launch};
use crate::motion::CoinMotion;

/// Size of p or r below which it has no argument: some hundred roundings of an attitude.
const NO_ARGUMENT: f64 = 1e-13;

/// Part of |p| and |r| that a step may take them across.
const STEP: f64 = 0.8;

/// Error of an attitude that only has to tell its arguments, and the size of p and r from which on it does, to 0.01 rad.
const ROUGH: f64 = 1e-9;
const CLEAR: f64 = 1e-7;

/// Steps of a walk from the launch on, which take some seconds. Between close passages of the vertical a step turns the
/// body by up to a radian.
const MOST_STEPS: u32 = 400_000;

/// The Euler angles of a rigid body from its launch on.
#[derive(Debug, Clone)]
pub struct RigidAngles {
    kind: Kind,
}

#[derive(Debug, Clone)]
enum Kind {
    Coin(Box<CoinMotion>),
    Rigid(Box<Walk>),
}

impl RigidAngles {
    /// The angles of a toss at its launch. From horizontal α(0) = -γ(0) = atan2(ωy, ωx), the limit for t → 0.
    pub fn new(toss: &Toss) -> Self {
        let kind = match toss.coin() {
            Some(toss) => Kind::Coin(Box::new(CoinMotion::new(&toss))),
            None => Kind::Rigid(Box::new(Walk::new(toss))),
        };
        Self { kind }
    }

    /// The angles `time` (s) after launch, continuous from launch on. Times that ascend take one walk between them; a
    /// time before the last one starts again from the launch. Fails with [`SolveError::PhaseTooLarge`]; for bodies with
    /// I1 ≠ I2 also [`SolveError::StepLimit`] after some hundred thousand radians, here and at every later time.
    pub fn at(&mut self, time: f64) -> Result<EulerAngles, SolveError> {
        match &mut self.kind {
            Kind::Coin(motion) => motion.euler_angles(time),
            Kind::Rigid(walk) => walk.to(time),
        }
    }
}

/// A walk along the motion.
#[derive(Debug, Clone)]
struct Walk {
    toss: Toss,
    launch: Point,
    /// An upper bound of |ω| (rad/s).
    speed: f64,
    /// Whether n is a principal axis.
    is_principal: bool,
    last: Point,
    /// Steps since launch.
    steps: u32,
}

#[derive(Debug, Clone, Copy)]
struct Point {
    time: f64,
    attitude: Attitude,
    /// |ω⊥| (rad/s).
    across: f64,
    angles: EulerAngles,
}

impl Walk {
    fn new(toss: &Toss) -> Self {
        let rate = toss.launch.rate();
        let across = rate.x.hypot(rate.y);
        let launch = Point { time: 0.0, attitude: toss.launch.attitude(), across, angles: departure(toss) };
        let scale = power_of_two_scale(rate.amax());
        let speed = toss.body.rigid().largest_growth_of_rate() * (rate / scale).norm() * scale * (1.0 + 1e-9);
        let is_principal = toss.body.moments().is_some();
        Self { toss: *toss, launch, speed, is_principal, last: launch, steps: 0 }
    }

    /// Goes on to `time` (s).
    fn to(&mut self, time: f64) -> Result<EulerAngles, SolveError> {
        turned_at_launch(&self.toss, time.into())?;
        if time < self.last.time {
            (self.last, self.steps) = (self.launch, 0);
        }
        while self.last.time < time {
            if self.steps == MOST_STEPS {
                return Err(SolveError::StepLimit { time: self.last.time, limit: MOST_STEPS });
            }
            self.steps += 1;
            let next = (self.last.time + self.step()).min(time);
            let State { attitude, rate } = self.state(next, next == time)?;
            let (across, angles) = (rate.x.hypot(rate.y), EulerAngles::nearest(&attitude, &self.last.angles));
            self.last = Point { time: next, attitude, across, angles };
        }
        Ok(self.last.angles)
    }

    /// Attitude and rate at a time. Between the times that are asked for, an attitude only has to tell its arguments.
    fn state(&self, time: f64, is_asked_for: bool) -> Result<State, SolveError> {
        let by = |first: Stage, within: f64| state(&self.toss, time.into(), first, within);
        if !is_asked_for {
            let rough = by(Stage::F64, ROUGH)?;
            if from_vertical(&rough.attitude) > CLEAR {
                return Ok(rough);
            }
        }
        by(Stage::DoubleDouble, TO_F64)
    }

    /// The length of the next step (s): infinite at rest.
    fn step(&self) -> f64 {
        let distance = STEP * from_vertical(&self.last.attitude).max(NO_ARGUMENT);
        let turned = 1.0 / self.speed;
        // The largest |ω⊥| in a step that is no longer.
        let across = if self.is_principal { (E * self.last.across).min(self.speed) } else { self.speed };
        let moved = if across == 0.0 { f64::INFINITY } else { 2.0 * distance / across };
        // A shorter step would not change the time.
        turned.min(moved).max(self.last.time * f64::EPSILON)
    }
}

/// The smaller one of |p| and |r|.
fn from_vertical(attitude: &Attitude) -> f64 {
    let [w, x, y, z] = attitude.components();
    w.hypot(z).min(x.hypot(y))
}

/// The angles at launch. Where sin β = 0, the argument that the attitude does not tell is that with which p or r departs
/// from 0: by Q' = ½ Q ω.
fn departure(toss: &Toss) -> EulerAngles {
    let attitude = toss.launch.attitude();
    let [w, x, y, z] = attitude.components();
    let rate = toss.launch.rate();
    // A body at rest does not depart, and what its attitude does not tell is 0.
    let is_at_rest = rate.amax() == 0.0;
    let about =
        if is_at_rest { Attitude::IDENTITY } else { Attitude::half_turn(&(rate / power_of_two_scale(rate.amax()))) };
    let [w1, x1, y1, z1] = (attitude * about).components();
    let argument = |[re, im]: [f64; 2], [re1, im1]: [f64; 2]| {
        if re == 0.0 && im == 0.0 { im1.atan2(re1) } else { im.atan2(re) }
    };
    let [half_sum, half_difference] = [argument([w, z], [w1, z1]), argument([x, y], [x1, y1])];
    EulerAngles {
        alpha: half_sum + half_difference,
        beta: 2.0 * x.hypot(y).atan2(w.hypot(z)),
        gamma: half_sum - half_difference,
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Body, Coin, CoinToss, Launch, TimeOfFlight};

    use crate::rigid::ExactMotion;

    use super::*;

    fn toss(moments: [f64; 3], rate: [f64; 3], tilt: f64) -> Toss {
        let launch = Launch::new(rate, TimeOfFlight::Given(1.0)).unwrap().with_tilt(tilt).unwrap();
        Toss { body: Body::from_moments(moments).unwrap(), launch }
    }

    fn assert_near(found: EulerAngles, expected: EulerAngles, allowed: f64) {
        let pairs = [(found.alpha, expected.alpha), (found.beta, expected.beta), (found.gamma, expected.gamma)];
        assert!(pairs.iter().all(|(one, two)| (one - two).abs() < allowed), "{found:?} {expected:?}");
    }

    /// The closed form of a coin counts the turns otherwise: by phases.
    #[test]
    fn a_body_that_is_nearly_a_coin_turns_as_often_as_the_coin() {
        for (rate, tilt) in [
            ([9.0, 4.0, 3.0], 0.0),
            ([9.0, 4.0, 3.0], 0.4),
            ([0.0, 30.0, 0.5], 0.0),
            ([1.0, -2.0, -40.0], 2.8),
            ([0.0; 3], 0.0),
            ([0.0; 3], 0.4),
            ([0.0; 3], std::f64::consts::PI),
        ] {
            let coin = Coin::PAPER;
            let launch = toss([1.0, 2.0, 2.5], rate, tilt).launch;
            let motion = CoinMotion::new(&CoinToss { coin, launch });
            let body = Body::from_moments([coin.i1(), coin.i1() * (1.0 - f64::EPSILON), coin.i3()]).unwrap();
            let mut angles = RigidAngles::new(&Toss { body, launch });
            for time in [0.0, 0.01, 1.0, 10.0] {
                assert_near(angles.at(time).unwrap(), motion.euler_angles(time).unwrap(), 1e-10);
            }
        }
    }

    /// Dense points leave no choice of the branch; one step to the end has to count the same turns.
    #[test]
    fn one_walk_to_the_end_counts_the_turns_of_ten_thousand_short_ones() {
        for (moments, rate, tilt) in [
            ([1.0, 2.0, 2.5], [9.0, 4.0, 3.0], 0.7),
            ([1.0, 2.0, 2.5], [0.1, 30.0, 0.1], 1.2),
            ([2.5, 1.0, 2.0], [3.0, 1.0, -20.0], 2.0),
        ] {
            let toss = toss(moments, rate, tilt);
            let (motion, mut dense) = (ExactMotion::new(&toss), EulerAngles::principal(&toss.launch.attitude()));
            for step in 1..=10_000 {
                dense = EulerAngles::nearest(&motion.state(f64::from(step) * 1e-3).unwrap().attitude, &dense);
            }
            let found = RigidAngles::new(&toss).at(10.0).unwrap();
            assert_near(found, dense, 1e-9);
            assert!(found.alpha.abs().max(found.gamma.abs()) > 10.0, "{found:?} has not turned");
        }
    }

    #[test]
    fn a_body_that_passes_the_vertical_goes_on_beyond_it() {
        let spinning = toss([1.0, 2.0, 2.5], [3.0, 0.0, 0.0], 0.0);
        assert_near(
            RigidAngles::new(&spinning).at(10.0).unwrap(),
            EulerAngles { alpha: 0.0, beta: 30.0, gamma: 0.0 },
            1e-12,
        );
    }

    /// Spins about an upright normal, to the last bit and nearly, took steps of 1e-13 rad. Of the exact one α + γ (or, upside
    /// down, γ - α) is the whole turn, in one step a radian.
    #[test]
    fn a_body_that_spins_upright_takes_a_step_a_radian() {
        for (tilt, sign) in [(0.0, 1.0), (std::f64::consts::PI, -1.0)] {
            for (across, most) in [(0.0, 300), (1e-300, 300), (1e-30, 300), (1e-14, 300), (1e-12, 9000), (1e-3, 9000)] {
                let mut walk = Walk::new(&toss([1.0, 2.0, 2.5], [across, 0.0, 5.0], tilt));
                let EulerAngles { alpha, beta, gamma } = walk.to(20.0).unwrap();
                let (turned, steps) = (gamma + sign * alpha, walk.steps);
                let off = (turned - 100.0).abs() + beta.sin().abs();
                assert!(off < 1e-12 + across, "{tilt} {across:e}: {alpha} {beta} {gamma}");
                assert!(steps <= most, "{tilt} {across:e}: {steps}");
            }
        }
    }

    #[test]
    fn earlier_times_start_again_and_flights_without_end_are_refused() {
        let toss = toss([1.0, 2.0, 2.5], [9.0, 4.0, 3.0], 0.3);
        let mut angles = RigidAngles::new(&toss);
        let early = angles.at(0.5).unwrap();
        angles.at(3.0).unwrap();
        assert_eq!(angles.at(0.5).unwrap(), early);
        assert_eq!(angles.at(1e16).unwrap_err().kind(), "phase_too_large");
        // A trace of many points spends the steps once, of which few are left here.
        fn walk(angles: &mut RigidAngles) -> &mut Walk {
            let Kind::Rigid(walk) = &mut angles.kind else { panic!("a body that is no coin") };
            walk
        }
        walk(&mut angles).steps = MOST_STEPS - 1000;
        for time in [1e9, 1.5e9, 2e9] {
            assert_eq!(angles.at(time).unwrap_err().kind(), "step_limit");
            assert_eq!(walk(&mut angles).steps, MOST_STEPS);
        }
    }
}
