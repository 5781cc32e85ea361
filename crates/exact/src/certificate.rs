//! This file holds the types of proven results: [`Certificate`] for one outcome, [`ProvenCounts`] for many. Their
//! fields are private and only this crate can construct them, so that no other code can pass off an estimated outcome
//! as a proven one.

use std::fmt;

use dynamics::Outcome;

/// The stage of the proof that decided an outcome, from the cheapest to the most accurate; see
/// [`certified`](crate::certified).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// The sign of cos θ in f64, with an error bound.
    F64,
    /// The sign of cos θ in balls of double-double arithmetic (about 106 bits).
    DoubleDouble,
    /// 192 binary digits or more, or exact arithmetic for a tie.
    Multiprecision,
}

impl Stage {
    /// All stages, from the cheapest to the most accurate.
    pub const ALL: [Self; 3] = [Self::F64, Self::DoubleDouble, Self::Multiprecision];

    /// Name of the stage, in words.
    pub fn name(self) -> &'static str {
        ["f64", "double-double", "more digits"][self as usize]
    }
}

/// Writes the [name](Stage::name).
impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A proven outcome and the stage that proved it. That of a coin is [`Outcome::Undecided`] only for an exact tie, which is
/// cos θ = 0 at landing; with rates in turns per second, |cos θ| < 2^-12000 counts as a tie. That of a body with I1 ≠ I2 is
/// undecided where the digits have run out, which proves nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Certificate {
    outcome: Outcome,
    stage: Stage,
    is_proven: bool,
}

impl Certificate {
    /// For the code that proves outcomes, and for no other.
    #[inline]
    pub(crate) fn new(outcome: Outcome, stage: Stage) -> Self {
        Self { outcome, stage, is_proven: true }
    }

    /// For a toss that no number of digits has decided.
    pub(crate) fn without_proof() -> Self {
        Self { outcome: Outcome::Undecided, stage: Stage::Multiprecision, is_proven: false }
    }

    /// Whether the outcome is proven. It is, but for a body with I1 ≠ I2 that is undecided.
    #[inline]
    pub fn is_proven(self) -> bool {
        self.is_proven
    }

    /// The face that the toss lands on.
    #[inline]
    pub fn outcome(self) -> Outcome {
        self.outcome
    }

    /// The stage that decided the outcome.
    #[inline]
    pub fn stage(self) -> Stage {
        self.stage
    }
}

/// Numbers of proven outcomes. Outside this crate such counts can be read and added to each other, but not changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ProvenCounts {
    heads: u64,
    tails: u64,
    ties: u64,
    /// Those ties that are not proven to be any.
    without_proof: u64,
    by: [u64; Stage::ALL.len()],
}

impl ProvenCounts {
    /// Counts one more outcome.
    #[inline]
    pub(crate) fn add(&mut self, certificate: Certificate) {
        match certificate.outcome {
            Outcome::Heads => self.heads += 1,
            Outcome::Tails => self.tails += 1,
            Outcome::Undecided => self.ties += 1,
        }
        self.without_proof += u64::from(!certificate.is_proven);
        self.by[certificate.stage as usize] += 1;
    }

    /// Counts more outcomes that `stage` decided.
    #[inline]
    pub(crate) fn add_many(&mut self, heads: u64, tails: u64, stage: Stage) {
        self.heads += heads;
        self.tails += tails;
        self.by[stage as usize] += heads + tails;
    }

    /// Number of tosses that land heads.
    pub fn heads(&self) -> u64 {
        self.heads
    }

    /// Number of tosses that land tails.
    pub fn tails(&self) -> u64 {
        self.tails
    }

    /// Number of exact ties, and of tosses without a proof.
    pub fn ties(&self) -> u64 {
        self.ties
    }

    /// Number of tosses that were tried and have no proof: bodies with I1 ≠ I2 that are undecided.
    pub fn without_proof(&self) -> u64 {
        self.without_proof
    }

    /// Number of outcomes that `stage` decided.
    pub fn by(&self, stage: Stage) -> u64 {
        self.by[stage as usize]
    }

    /// Number of all tosses.
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
            without_proof: self.without_proof + other.without_proof,
            by: std::array::from_fn(|stage| self.by[stage] + other.by[stage]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_outcomes_by_face_and_by_stage() {
        let mut counts = ProvenCounts::default();
        counts.add_many(3, 4, Stage::F64);
        for (outcome, stage) in [
            (Outcome::Heads, Stage::F64),
            (Outcome::Tails, Stage::DoubleDouble),
            (Outcome::Undecided, Stage::Multiprecision),
        ] {
            counts.add(Certificate::new(outcome, stage));
        }
        assert_eq!((counts.heads(), counts.tails(), counts.ties(), counts.total()), (4, 5, 1, 10));
        assert_eq!(Stage::ALL.map(|stage| counts.by(stage)), [8, 1, 1]);
        counts.add(Certificate::without_proof());
        assert_eq!((counts.ties(), counts.without_proof()), (2, 1));
        let thrice = counts + counts + counts;
        assert_eq!((thrice.ties(), thrice.without_proof()), (6, 3));
        assert_eq!((thrice.heads(), thrice.tails()), (12, 15));
        assert_eq!(Stage::ALL.map(|stage| thrice.by(stage)), [24, 3, 6]);
    }

    #[test]
    fn stages_are_written_by_names_of_their_own() {
        let names = Stage::ALL.map(Stage::name);
        assert!(names[0] != names[1] && names[1] != names[2] && names[2] != names[0], "{names:?}");
        assert_eq!(Stage::ALL.map(|stage| stage.to_string()), names);
    }
}
