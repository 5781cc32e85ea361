//! Why a plan passes a model over.

use std::fmt;

/// Why a model is passed over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reason {
    /// It answers another question.
    GivesOnly(&'static str),
    /// Its error is larger than what is wanted.
    TooRough {
        /// The error.
        expected_error: f64,
    },
    /// Nobody has measured its error and cost.
    NotMeasured,
    /// An integrator was asked for by name.
    NotAskedFor,
    /// It serves, but costs more.
    Dearer {
        /// Its cost (ns).
        expected_cost_ns: f64,
    },
    /// The speed is fixed.
    SpeedIsFixed,
    /// More than the speed is free.
    MoreIsFree,
    /// It tells no error.
    TellsNoError,
    /// The coins land below or above their launch.
    HasDrop,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::GivesOnly(what) => write!(f, "gives only {what}"),
            Self::NotMeasured => f.write_str("its error and cost are not in the table of what was measured"),
            Self::TooRough { expected_error } => write!(f, "its expected error is {expected_error:.1e}"),
            Self::NotAskedFor => f.write_str("an integrator was asked for"),
            Self::Dearer { expected_cost_ns } => write!(f, "serves, but takes {}", Nanoseconds(*expected_cost_ns)),
            Self::SpeedIsFixed => f.write_str("needs a range of speeds"),
            Self::MoreIsFree => f.write_str("more than the speed is free"),
            Self::TellsNoError => f.write_str("tells no error"),
            Self::HasDrop => f.write_str("needs a landing at the height of the launch"),
        }
    }
}

/// A time (ns), written with the unit that suits it.
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
