//! How much a run tries.

use serde::Serialize;

/// How much is tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Effort {
    /// Within a minute on two cores.
    Quick,
    /// Within five minutes.
    Standard,
    /// As long as it takes.
    Deep,
}

impl Effort {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quick => "quick",
            Self::Standard => "standard",
            Self::Deep => "deep",
        }
    }

    /// Number of random launches.
    pub fn launches(self) -> u64 {
        match self {
            Self::Quick => 1000,
            Self::Standard => 5000,
            Self::Deep => 50_000,
        }
    }

    /// Number of adversarial launches.
    pub fn adversarial_launches(self) -> u64 {
        match self {
            Self::Quick => 2000,
            Self::Standard => 10_000,
            Self::Deep => 200_000,
        }
    }
}
