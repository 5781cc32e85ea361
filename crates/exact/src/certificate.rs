//! What is proven: one outcome, or how many of each.
//!
//! Only this crate can make them. A solver, a default or a sum cannot turn an outcome that is estimated into one that is
//! proven.

use dynamics::Outcome;

/// Which stage of a proof decided, from the cheapest on: see [`certified`](crate::certified).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The one cosine of Keller's coin.
    Keller,
    /// No sine or cosine was evaluated: the face never changes, or the flight is too short for it.
    TrigFree,
    /// f64.
    F64,
    /// Double-double.
    DoubleDouble,
    /// 192 binary digits or more, or exact arithmetic for a tie.
    Multiprecision,
}

impl Stage {
    /// All stages, in their order.
    pub const ALL: [Self; 5] = [Self::Keller, Self::TrigFree, Self::F64, Self::DoubleDouble, Self::Multiprecision];

    /// Its name, in words.
    pub fn name(self) -> &'static str {
        ["Keller's cosine", "no motion", "f64", "double-double", "more digits"][self as usize]
    }
}

/// A proven outcome and the stage that proved it. It is undecided only for an exact tie: cos θ = 0 at landing. With rates in
/// turns, |cos θ| < 2^-12000 counts as a tie.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Certificate {
    outcome: Outcome,
    stage: Stage,
}

impl Certificate {
    /// By the proving code alone.
    #[inline]
    pub(crate) fn new(outcome: Outcome, stage: Stage) -> Self {
        Self { outcome, stage }
    }

    /// How the toss lands.
    #[inline]
    pub fn outcome(self) -> Outcome {
        self.outcome
    }

    /// The stage that decided.
    #[inline]
    pub fn stage(self) -> Stage {
        self.stage
    }
}

/// Proven outcomes, counted. They add up; nothing else can be done to them outside this crate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ProvenCounts {
    heads: u64,
    tails: u64,
    ties: u64,
    by: [u64; Stage::ALL.len()],
}

impl ProvenCounts {
    /// Adds an outcome.
    #[inline]
    pub(crate) fn add(&mut self, certificate: Certificate) {
        match certificate.outcome {
            Outcome::Heads => self.heads += 1,
            Outcome::Tails => self.tails += 1,
            Outcome::Undecided => self.ties += 1,
        }
        self.by[certificate.stage as usize] += 1;
    }

    /// Adds outcomes that a stage decided.
    #[inline]
    pub(crate) fn add_many(&mut self, heads: u64, tails: u64, stage: Stage) {
        self.heads += heads;
        self.tails += tails;
        self.by[stage as usize] += heads + tails;
    }

    /// Tosses that land heads.
    pub fn heads(&self) -> u64 {
        self.heads
    }

    /// Tosses that land tails.
    pub fn tails(&self) -> u64 {
        self.tails
    }

    /// Exact ties.
    pub fn ties(&self) -> u64 {
        self.ties
    }

    /// Outcomes that `stage` decided.
    pub fn by(&self, stage: Stage) -> u64 {
        self.by[stage as usize]
    }

    /// All tosses.
    pub fn total(&self) -> u64 {
        self.heads + self.tails + self.ties
    }
}

impl std::ops::Add for ProvenCounts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            heads: self.heads + other.heads,
            tails: self.tails + other.tails,
            ties: self.ties + other.ties,
            by: std::array::from_fn(|stage| self.by[stage] + other.by[stage]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_say_what_was_proven_and_by_which_stage() {
        let mut counts = ProvenCounts::default();
        counts.add_many(3, 4, Stage::F64);
        for (outcome, stage) in [
            (Outcome::Heads, Stage::Keller),
            (Outcome::Tails, Stage::DoubleDouble),
            (Outcome::Undecided, Stage::Multiprecision),
        ] {
            counts.add(Certificate::new(outcome, stage));
        }
        assert_eq!((counts.heads(), counts.tails(), counts.ties(), counts.total()), (4, 5, 1, 10));
        assert_eq!(Stage::ALL.map(|stage| counts.by(stage)), [1, 0, 7, 1, 1]);
        let twice = counts + counts;
        assert_eq!((twice.heads(), twice.tails(), twice.ties()), (8, 10, 2));
        assert_eq!(Stage::ALL.map(|stage| twice.by(stage)), [2, 0, 14, 2, 2]);
    }
}
