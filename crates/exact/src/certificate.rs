//! This file holds the types of proven results: [`Certificate`] for one outcome, [`ProvenCounts`] for many. Their
//! fields are private and only this crate can construct them, so that no other code can pass off an estimated outcome
//! as a proven one.

use std::ops::Deref;

use dynamics::{Counts, Outcome, Stage};

/// The stages of a proof by the exact motion, from the cheapest to the most accurate; see [`certified`](crate::certified).
pub const STAGES: [Stage; 3] = [Stage::F64, Stage::DoubleDouble, Stage::MoreDigits];

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
        Self { outcome: Outcome::Undecided, stage: Stage::MoreDigits, is_proven: false }
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

/// Numbers of proven outcomes, with those of bodies with I1 ≠ I2 that are undecided without a proof. Outside this crate such
/// counts can be read and added to each other, but not changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ProvenCounts(Counts);

impl ProvenCounts {
    /// Counts one more outcome.
    #[inline]
    pub(crate) fn add(&mut self, certificate: Certificate) {
        self.0.add(certificate.outcome);
        self.0.add_by(certificate.stage, 1);
        self.0.without_proof += u64::from(!certificate.is_proven);
    }

    /// Counts more outcomes that `stage` decided.
    #[inline]
    pub(crate) fn add_many(&mut self, heads: u64, tails: u64, stage: Stage) {
        self.0.heads += heads;
        self.0.tails += tails;
        self.0.add_by(stage, heads + tails);
    }
}

impl Deref for ProvenCounts {
    type Target = Counts;

    fn deref(&self) -> &Counts {
        &self.0
    }
}

impl std::ops::Add for ProvenCounts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
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
            (Outcome::Undecided, Stage::MoreDigits),
        ] {
            counts.add(Certificate::new(outcome, stage));
        }
        assert_eq!((counts.heads, counts.tails, counts.undecided, counts.total()), (4, 5, 1, 10));
        assert_eq!(STAGES.map(|stage| counts.by(stage)), [8, 1, 1]);
        counts.add(Certificate::without_proof());
        assert_eq!((counts.undecided, counts.without_proof), (2, 1));
        let thrice = counts + counts + counts;
        assert_eq!((thrice.undecided, thrice.without_proof, thrice.heads, thrice.tails), (6, 3, 12, 15));
    }
}
