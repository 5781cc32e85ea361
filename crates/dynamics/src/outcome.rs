//! [`Outcome`], how a coin lands: heads for cos θ > 0 and tails for cos θ < 0, where θ is the angle between the coin's
//! normal and the vertical. A third value, undecided, is needed because the computed cos θ has an error.

use std::fmt;

/// How the coin lands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// cos θ > 0.
    Heads,
    /// cos θ < 0.
    Tails,
    /// Undecided: |cos θ| is at most the solver's error estimate, or the solver has no estimate. A proven outcome is
    /// undecided only for an exact tie, cos θ = 0.
    Undecided,
}

impl Outcome {
    /// All outcomes.
    pub const ALL: [Self; 3] = [Self::Heads, Self::Tails, Self::Undecided];

    /// Heads or tails by the sign of `cos_tilt` if |`cos_tilt`| exceeds `error`, else undecided.
    #[inline]
    pub fn of(cos_tilt: f64, error: f64) -> Self {
        if cos_tilt > error {
            Self::Heads
        } else if cos_tilt < -error {
            Self::Tails
        } else {
            Self::Undecided
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Heads => "heads",
            Self::Tails => "tails",
            Self::Undecided => "undecided",
        }
    }
}

/// Writes the [name](Outcome::name).
impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tie_is_undecided_whatever_the_error() {
        assert_eq!(Outcome::of(0.0, 0.0), Outcome::Undecided);
        assert_eq!(Outcome::of(-0.0, 1e-16), Outcome::Undecided);
        assert_eq!(Outcome::of(1e-300, 0.0), Outcome::Heads);
        assert_eq!(Outcome::of(-1e-9, 1e-8), Outcome::Undecided);
        assert_eq!(Outcome::of(-1e-7, 1e-8), Outcome::Tails);
        assert_eq!(Outcome::of(f64::NAN, 0.0), Outcome::Undecided);
    }

    #[test]
    fn outcomes_are_named() {
        assert_eq!(Outcome::ALL.map(Outcome::name), ["heads", "tails", "undecided"]);
        assert_eq!(format!("{:>6}", Outcome::Tails), " tails");
    }
}
