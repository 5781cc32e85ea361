//! The reasons for which a plan passes a model over. They are typed, so that programs can tell them apart, and print as
//! text for people.

use std::fmt;

use dynamics::Error;

/// The reason why a model is passed over.
#[derive(Debug, Clone, PartialEq)]
pub enum Reason {
    /// The model computes only this, and something else is wanted.
    GivesOnly(&'static str),
    /// The expected error is larger than the accuracy wanted.
    TooRough {
        /// The expected error, of what is wanted. Of an integrator, the smallest one that it reached.
        expected_error: f64,
    },
    /// The integrator does not solve this toss.
    Fails(Error),
    /// The scene asks for an integrator, and the model is none.
    NotAskedFor,
    /// The model serves, but a cheaper one serves too.
    Dearer {
        /// The expected cost (ns).
        expected_cost_ns: f64,
    },
    /// The speed is fixed, and the model integrates over a range of speeds.
    SpeedIsFixed,
    /// Other coordinates than the speed are free, and the model handles the speed only.
    MoreIsFree,
    /// The model has no error estimate.
    TellsNoError,
    /// The coins land below or above their launch.
    HasDrop,
    /// The body has I1 ≠ I2.
    OnlyCoins,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::GivesOnly(what) => write!(f, "gives only {what}"),
            Self::Fails(error) => write!(f, "fails: {error}"),
            Self::TooRough { expected_error } => write!(f, "its expected error is {expected_error:.1e}"),
            Self::NotAskedFor => f.write_str("an integrator was asked for"),
            Self::Dearer { expected_cost_ns } => write!(f, "serves, but takes {}", Nanoseconds(*expected_cost_ns)),
            Self::SpeedIsFixed => f.write_str("needs a range of speeds"),
            Self::MoreIsFree => f.write_str("more than the speed is free"),
            Self::TellsNoError => f.write_str("has no error estimate"),
            Self::OnlyCoins => f.write_str("is for coins, with I1 = I2"),
            Self::HasDrop => f.write_str("needs a landing at the height of the launch"),
        }
    }
}

/// A time in ns, which prints in the unit that suits it, from ns to s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nanoseconds(pub f64);

impl fmt::Display for Nanoseconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            ns if ns < 1e3 => write!(f, "{ns:.0} ns"),
            ns if ns < 1e6 => write!(f, "{:.1} µs", ns / 1e3),
            ns if ns < 1e9 => write!(f, "{:.1} ms", ns / 1e6),
            ns => write!(f, "{:.1} s", ns / 1e9),
        }
    }
}
