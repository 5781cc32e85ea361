//! How a coin lands, heads for cos θ > 0 and tails for cos θ < 0, and what that rests on.

/// How the coin lands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// cos θ > 0.
    Heads,
    /// cos θ < 0.
    Tails,
    /// cos θ is nearer to 0 than the solver answers for; for a proven outcome only an exact tie, cos θ = 0.
    Undecided,
}

impl Outcome {
    /// The rule: heads or tails by the sign of `cos_tilt` where its size exceeds `resolution`, else undecided.
    #[inline]
    pub fn of(cos_tilt: f64, resolution: f64) -> Self {
        if cos_tilt > resolution {
            Self::Heads
        } else if cos_tilt < -resolution {
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

/// Which stage of a proof decided, from the cheapest on: see [`certified`](crate::certified).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The one cosine of Keller's coin.
    Keller,
    /// No motion was evaluated: the face never changes, or the flight is too short for it.
    Certain,
    /// f64.
    F64,
    /// Double-double.
    DoubleDouble,
    /// 192 binary digits or more, or exact arithmetic for a tie.
    Multiprecision,
}

impl Stage {
    /// All stages, in their order.
    pub const ALL: [Self; 5] = [Self::Keller, Self::Certain, Self::F64, Self::DoubleDouble, Self::Multiprecision];
}

/// An outcome, and what it rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Verdict {
    /// How the toss lands.
    pub outcome: Outcome,
    /// The stage that proved it; `None` for an outcome that is only as good as the solver's error estimate.
    pub proof: Option<Stage>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tie_is_undecided_whatever_the_resolution() {
        assert_eq!(Outcome::of(0.0, 0.0), Outcome::Undecided);
        assert_eq!(Outcome::of(-0.0, 1e-16), Outcome::Undecided);
        assert_eq!(Outcome::of(1e-300, 0.0), Outcome::Heads);
        assert_eq!(Outcome::of(-1e-9, 1e-8), Outcome::Undecided);
        assert_eq!(Outcome::of(-1e-7, 1e-8), Outcome::Tails);
        assert_eq!(Outcome::of(f64::NAN, 0.0), Outcome::Undecided);
    }

    #[test]
    fn outcomes_are_named() {
        let names = [Outcome::Heads, Outcome::Tails, Outcome::Undecided].map(Outcome::name);
        assert_eq!(names, ["heads", "tails", "undecided"]);
    }
}
