//! A run tries few, many or very many cases, as you ask. The baseline is kept for each effort, because the largest
//! error depends on how many cases are tried.

use serde::Serialize;

/// How many cases a run tries.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Effort {
    /// `--quick`: takes a minute on two cores.
    Quick,
    /// The default: takes three minutes on two cores.
    Standard,
    /// `--deep`: about ten times as many cases as the default, with no limit on time.
    Deep,
}

impl Effort {
    /// Its name, as in the baseline's file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quick => "quick",
            Self::Standard => "standard",
            Self::Deep => "deep",
        }
    }

    /// The flag that asks for it, after a space; empty for the default.
    pub fn flag(self) -> &'static str {
        match self {
            Self::Quick => " --quick",
            Self::Standard => "",
            Self::Deep => " --deep",
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
