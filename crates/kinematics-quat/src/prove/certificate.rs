//! What a proof by integration states: an [`IntegratedCertificate`] with the [`Stage`] that decided. Only the proofs of
//! this crate can make a certificate, so that no other code can pass off an estimate as a proof.

use dynamics::{Counts, Landing, Outcome, Stage, Tilt, Work};
use numerics::UNIT_ROUNDOFF;

/// A landing by integration with proven bounds of its errors, for exactly the numbers that the toss was made from.
///
/// Nothing but [`QuaternionSolver`](crate::QuaternionSolver) makes one:
///
/// ```compile_fail,E0451
/// fn forged(one: kinematics_quat::IntegratedCertificate) -> kinematics_quat::IntegratedCertificate {
///     kinematics_quat::IntegratedCertificate { error_bound: 0.0, ..one }
/// }
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntegratedCertificate {
    pub(super) outcome: Outcome,
    pub(super) landing: Landing,
    pub(super) error_bound: f64,
    pub(super) attitude_error_bound: f64,
    pub(super) stage: Stage,
}

impl IntegratedCertificate {
    /// The face that the toss lands on, which is proven; [`Outcome::Undecided`] if cos θ is within its bound even with the
    /// most digits, as it is for a tie.
    pub fn outcome(&self) -> Outcome {
        self.outcome
    }

    /// cos θ at landing, to within [`Self::error_bound`].
    pub fn cos_tilt(&self) -> f64 {
        self.landing.cos_tilt
    }

    /// An upper bound of the error of cos θ, which is proven; at most 2.
    pub fn error_bound(&self) -> f64 {
        self.error_bound
    }

    /// State and cos θ at landing, with the work of all flights that it took.
    pub fn landing(&self) -> &Landing {
        &self.landing
    }

    /// An upper bound of the distance |Q - Q̂| between the quaternion of the landing and that of the ideal flight, of
    /// either sign, which is proven; at most 2. The angle between the two attitudes is at most 4 asin of half of it.
    pub fn attitude_error_bound(&self) -> f64 {
        self.attitude_error_bound
    }

    /// An upper bound of the angle between the attitude of the landing and that of the ideal flight (rad), which is
    /// proven; π where nothing is proven.
    pub fn angle_bound(&self) -> f64 {
        // The division, the arcsine and the product round by less than 8 u.
        let angle = 4.0 * (0.5 * self.attitude_error_bound).min(1.0).asin() * (1.0 + 8.0 * UNIT_ROUNDOFF);
        angle.min(std::f64::consts::PI)
    }

    /// The arithmetic of the flight that decided the outcome.
    pub fn stage(&self) -> Stage {
        self.stage
    }

    /// The cost of all flights that it took.
    pub fn work(&self) -> Work {
        self.landing.work
    }

    /// cos θ with the bound of its error, from which counting code decides; 0 if the outcome is undecided.
    pub(super) fn tilt(&self) -> Tilt {
        let (cos_tilt, error) = match self.outcome {
            Outcome::Undecided => (0.0, 2.0),
            _ => (self.cos_tilt(), self.error_bound),
        };
        Tilt { cos_tilt, error: Some(error) }
    }

    /// The outcome as counts.
    pub(super) fn counts(&self) -> Counts {
        let mut counts = Counts::default();
        counts.add(self.outcome);
        counts.add_by(self.stage, 1);
        counts
    }

    /// The same landing, with the work of the flight `before` it, too.
    pub(super) fn after(mut self, before: &Self) -> Self {
        self.landing.work = before.landing.work + self.landing.work;
        self
    }
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Formulation, Launch, Scheme, Solver, Stepping, TimeOfFlight, Toss};
    use numerics::big::{Big, exactly};

    use super::*;
    use crate::QuaternionSolver;

    /// 4 asin(bound/2), as arctangent of half the bound over √(1 - bound²/4).
    fn angle(bound: f64) -> Big {
        let half = exactly(0.5 * bound).with_precision(200).value();
        let along = (exactly(1.0).with_precision(200).value() - &half * &half).sqrt();
        numerics::Elementary::atan2(&half, &along) << 2
    }

    #[test]
    fn the_angle_is_bounded_by_four_arcsines_of_half_the_distance() {
        let launch = Launch::new([1.0, 1.0, 2.5], TimeOfFlight::Given(0.5)).unwrap();
        let landing = exact::ExactSolver.land(&Toss::new(Coin::PAPER, launch)).unwrap();
        let solver = QuaternionSolver::new(Stepping::adaptive(Scheme::TAYLOR, 1e-9).unwrap(), Formulation::default());
        let found = solver.certify(&Toss::new(Coin::PAPER, launch)).unwrap();
        assert!(
            found.angle_bound() < 1e-6
                && found.landing().state.attitude.angle_to(&landing.state.attitude) <= found.angle_bound()
        );
        for bound in [0.0, 1e-300, 3e-17, 1e-9, 0.01, 0.3, 1.0, 1.4] {
            let of = IntegratedCertificate { attitude_error_bound: bound, ..found }.angle_bound();
            let [exact, of_big] = [angle(bound), exactly(of).with_precision(200).value()];
            assert!(of_big >= exact && of <= exact.to_f64().value() * (1.0 + 1e-14), "{bound}: {of}");
        }
        for bound in [1.5, 2.0, f64::INFINITY] {
            let all = IntegratedCertificate { attitude_error_bound: bound, ..found };
            assert_eq!(all.angle_bound(), std::f64::consts::PI, "{bound}");
        }
    }
}
