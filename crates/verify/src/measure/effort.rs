//! A run tries few, many or very many cases, as you ask. The baseline is kept for each effort, because the largest
//! error depends on how many cases are tried.

use serde::Serialize;

/// How many cases a run tries.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Effort {
    /// A fifth of the launches of `--quick`, for tests that every check does its work. It has no baseline.
    Sample,
    /// `--quick`: takes half a minute on two cores.
    Quick,
    /// The default: takes two and a half minutes on two cores.
    Standard,
    /// `--deep`: about ten times as many cases as the default, with no limit on time.
    Deep,
}

impl Effort {
    /// Its name, as in the baseline's file.
    pub fn name(self) -> &'static str {
        if self == Self::Sample { "sample" } else { self.of(["quick", "standard", "deep"]) }
    }

    /// The flag that asks for it, after a space; empty for the default.
    pub fn flag(self) -> &'static str {
        self.of([" --quick", "", " --deep"])
    }

    /// That of three sizes which this effort takes: quick, standard, deep.
    pub fn of<T: Copy>(self, [quick, standard, deep]: [T; 3]) -> T {
        match self {
            Self::Sample | Self::Quick => quick,
            Self::Standard => standard,
            Self::Deep => deep,
        }
    }

    /// The number of launches of a set: quick, standard, deep.
    pub(crate) fn launches(self, numbers: [u64; 3]) -> u64 {
        self.of(numbers) / if self == Self::Sample { 5 } else { 1 }
    }
}
