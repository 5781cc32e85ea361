//! A case of any rigid body: a toss of a coin, or of a body that has other methods. What the atlas and the comparison
//! of speed with accuracy fly is one of these.

use std::collections::BTreeMap;

use anyhow::{Context, ensure};
use dynamics::{Body, Toss};
use toss::{Attitude, ExactSolver, Landing, Launch, Outcome, SolveError, Solver, State, TimeOfFlight};

use crate::measure::case::{Case, fields, hex_float};
use crate::measure::reference::Reference;
use crate::measure::reference::rigid::RigidReference;

/// A toss of a body that was given by its moments, with a given time of flight, from an attitude that is a turn about
/// the laboratory's x axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidCase {
    /// The toss.
    pub toss: Toss,
    /// The tilt at launch (rad): the angle of that turn.
    pub tilt: f64,
}

impl RigidCase {
    /// The toss of a body with these `moments` (kg m²) at a `rate` (BF, rad/s) from a `tilt` (rad), for a `time` (s).
    ///
    /// # Errors
    /// [`InputError`](toss::InputError) for numbers that describe no toss.
    pub fn new(moments: [f64; 3], rate: [f64; 3], tilt: f64, time: f64) -> Result<Self, toss::InputError> {
        let launch = Launch::new(rate, TimeOfFlight::Given(time))?.with_tilt(tilt)?;
        Ok(Self { toss: Toss { body: Body::from_moments(moments)?, launch }, tilt })
    }

    /// All inputs as `NAME=HEX` fields, separated by spaces.
    pub fn hex(&self) -> String {
        let [x, y, z] = self.toss.body.moments().unwrap_or([f64::NAN; 3]);
        let rate = self.toss.launch.rate();
        let fields = [
            ("moment_x", x),
            ("moment_y", y),
            ("moment_z", z),
            ("rate_x", rate.x),
            ("rate_y", rate.y),
            ("rate_z", rate.z),
            ("tilt", self.tilt),
            ("time", self.toss.launch.flight_time()),
        ];
        fields.iter().map(|(name, value)| format!("{name}={}", hex_float(*value))).collect::<Vec<_>>().join(" ")
    }

    fn from_fields(mut fields: BTreeMap<&str, f64>) -> anyhow::Result<Self> {
        let mut take = |name: &str| fields.remove(name).with_context(|| format!("{name} is missing"));
        let moments = [take("moment_x")?, take("moment_y")?, take("moment_z")?];
        let rate = [take("rate_x")?, take("rate_y")?, take("rate_z")?];
        let case = Self::new(moments, rate, take("tilt")?, take("time")?)?;
        ensure!(fields.is_empty(), "unknown fields: {}", fields.into_keys().collect::<Vec<_>>().join(", "));
        Ok(case)
    }
}

/// A toss of a coin or of another body.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there are some hundreds, and a toss is copied")]
pub enum AnyCase {
    /// Of a coin.
    Coin(Case),
    /// Of any rigid body.
    Rigid(RigidCase),
}

impl AnyCase {
    /// All inputs as `NAME=HEX` fields, separated by spaces.
    pub fn hex(&self) -> String {
        match self {
            Self::Coin(case) => case.hex(),
            Self::Rigid(case) => case.hex(),
        }
    }

    /// Reads a case from a line that [`AnyCase::hex`] wrote.
    ///
    /// # Errors
    /// As [`Case::from_hex`].
    pub fn from_hex(line: &str) -> anyhow::Result<Self> {
        let fields = fields(line)?;
        if fields.contains_key("moment_x") {
            return RigidCase::from_fields(fields).map(Self::Rigid);
        }
        Case::from_hex(line).map(Self::Coin)
    }

    /// The toss.
    pub fn toss(&self) -> Toss {
        match self {
            Self::Coin(case) => case.toss.into(),
            Self::Rigid(case) => case.toss,
        }
    }

    /// The launch.
    pub fn launch(&self) -> &Launch {
        match self {
            Self::Coin(case) => &case.toss.launch,
            Self::Rigid(case) => &case.toss.launch,
        }
    }

    /// The landing by `solver`.
    ///
    /// # Errors
    /// As [`Solver::land`].
    pub fn land(&self, solver: &dyn Solver) -> Result<Landing, SolveError> {
        solver.land(&self.toss())
    }

    /// Whether `solver` is made for such a body: it refuses none with [`SolveError::NotSymmetric`].
    pub fn is_solved_by(&self, solver: &dyn Solver) -> bool {
        let Self::Rigid(case) = self else { return true };
        !matches!(solver.tilt(&case.toss), Err(SolveError::NotSymmetric { .. }))
    }
}

/// The exact landing of a case.
pub enum AnyReference {
    /// In 256 bits, by the closed form for coins.
    Coin(Reference),
    /// In 256 bits, by that for any body.
    Rigid(RigidReference),
    /// By the exact motion in double-double: on the separatrix, about a principal axis, and of two equal moments.
    Exact {
        /// The state.
        state: State,
        /// cos θ.
        cos_tilt: f64,
        /// The proven outcome.
        outcome: Outcome,
    },
}

impl AnyReference {
    /// Solves `case`.
    ///
    /// # Errors
    /// [`SolveError`] for a phase above 2^53 rad.
    pub fn new(case: &AnyCase) -> Result<Self, SolveError> {
        match case {
            AnyCase::Coin(case) => Ok(Self::Coin(Reference::new(&case.toss))),
            AnyCase::Rigid(case) => Self::of_rigid(&case.toss),
        }
    }

    /// Solves the toss of any body.
    ///
    /// # Errors
    /// As [`AnyReference::new`].
    pub fn of_rigid(toss: &Toss) -> Result<Self, SolveError> {
        if let Some(reference) = RigidReference::new(toss) {
            return Ok(Self::Rigid(reference));
        }
        let landing = ExactSolver.land(toss)?;
        Ok(Self::Exact { state: landing.state, cos_tilt: landing.cos_tilt, outcome: landing.outcome() })
    }

    /// Absolute error of a computed cos θ.
    pub fn cos_tilt_error(&self, found: f64) -> f64 {
        match self {
            Self::Coin(reference) => reference.cos_tilt_error(found),
            Self::Rigid(reference) => reference.cos_tilt_error(found),
            Self::Exact { cos_tilt, .. } => (found - cos_tilt).abs(),
        }
    }

    /// Angle between a computed attitude and the exact one (rad).
    pub fn attitude_error(&self, attitude: &Attitude) -> f64 {
        match self {
            Self::Coin(reference) => reference.attitude_error(attitude),
            Self::Rigid(reference) => reference.attitude_error(attitude),
            Self::Exact { state, .. } => state.attitude.angle_to(attitude),
        }
    }

    /// The outcome.
    pub fn outcome(&self) -> Outcome {
        match self {
            Self::Coin(reference) => reference.outcome(),
            Self::Rigid(reference) => reference.outcome(),
            Self::Exact { outcome, .. } => *outcome,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cases_of_coins_and_of_bodies_survive_a_round_trip_through_their_hex_lines() {
        let rigid = RigidCase::new([1.0, 2.0, 2.25], [0.75, -1e-300, 1.0], 0.1, 3.0).unwrap();
        let coin = crate::measure::adversary::launch(3, 1).unwrap();
        for case in [AnyCase::Rigid(rigid), AnyCase::Coin(coin)] {
            assert_eq!(AnyCase::from_hex(&case.hex()).unwrap(), case);
        }
        let line = rigid.hex();
        for (broken, message) in [
            (line.replace("moment_z", "moment"), "moment_z is missing"),
            (format!("{line} speed=0x0p+0"), "unknown fields: speed"),
            (line.replace("moment_x=0x1.0", "moment_x=0x1.f"), ""),
            (line.replace("moment_z=0x1.2000000000000p+1", "moment_z=0x1.0p+9"), "moment_z"),
        ] {
            let found = AnyCase::from_hex(&broken);
            assert!(message.is_empty() || found.unwrap_err().to_string().contains(message), "{broken}");
        }
    }
}
