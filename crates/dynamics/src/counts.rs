//! Outcomes by face, and by what decided them. These are plain numbers that state no proof: a crate that proves outcomes wraps
//! them in a type of its own, which no other crate can make.

use std::fmt;

use crate::outcome::Outcome;

/// The arithmetic that decided an outcome, from the cheapest to the most accurate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// f64, by Taylor series with a tolerance of 1e-3, which integrations of coins take first.
    Coarse,
    /// f64 with an error bound; of an integration, with the solver's own steps.
    F64,
    /// f64, by Taylor series with the finest tolerance.
    Finest,
    /// Double-double arithmetic (about 106 bits).
    DoubleDouble,
    /// 192 binary digits or more, or exact arithmetic for a tie.
    MoreDigits,
}

impl Stage {
    /// All stages, from the cheapest to the most accurate.
    pub const ALL: [Self; 5] = [Self::Coarse, Self::F64, Self::Finest, Self::DoubleDouble, Self::MoreDigits];

    /// Name of the stage, in words.
    pub fn name(self) -> &'static str {
        ["coarse", "f64", "finest tolerance", "double-double", "more digits"][self as usize]
    }
}

/// Writes the [name](Stage::name).
impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Numbers of tosses by their outcome.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counts {
    /// Those that land heads.
    pub heads: u64,
    /// Those that land tails.
    pub tails: u64,
    /// Those that are undecided, such as ties.
    pub undecided: u64,
    /// Those of all that were tried and have no proof.
    pub without_proof: u64,
    /// Those that each stage decided, or left undecided as the last one, in the order of [`Stage::ALL`].
    pub by: [u64; Stage::ALL.len()],
}

impl Counts {
    /// Counts an outcome.
    #[inline]
    pub fn add(&mut self, outcome: Outcome) {
        match outcome {
            Outcome::Heads => self.heads += 1,
            Outcome::Tails => self.tails += 1,
            Outcome::Undecided => self.undecided += 1,
        }
    }

    /// Counts `number` of the outcomes as decided by `stage`, or left undecided by it as the last one.
    #[inline]
    pub fn add_by(&mut self, stage: Stage, number: u64) {
        self.by[stage as usize] += number;
    }

    /// Number of outcomes that `stage` decided, or left undecided as the last one.
    pub fn by(&self, stage: Stage) -> u64 {
        self.by[stage as usize]
    }

    /// Number of all tosses.
    pub fn total(&self) -> u64 {
        self.heads + self.tails + self.undecided
    }
}

impl std::ops::Add for Counts {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            heads: self.heads + other.heads,
            tails: self.tails + other.tails,
            undecided: self.undecided + other.undecided,
            without_proof: self.without_proof + other.without_proof,
            by: std::array::from_fn(|stage| self.by[stage] + other.by[stage]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_add_up_by_face_and_by_stage() {
        let mut once = Counts { heads: 3, tails: 4, without_proof: 1, ..Counts::default() };
        [Outcome::Heads, Outcome::Tails, Outcome::Undecided].into_iter().for_each(|outcome| once.add(outcome));
        (1..).zip(Stage::ALL).for_each(|(number, stage)| once.add_by(stage, number));
        let thrice = once + once + once;
        assert_eq!((thrice.heads, thrice.tails, thrice.undecided, thrice.without_proof), (12, 15, 3, 3));
        assert_eq!((thrice.total(), Stage::ALL.map(|stage| thrice.by(stage))), (30, [3, 6, 9, 12, 15]));
    }

    #[test]
    fn stages_are_named_as_they_are_printed() {
        let names = Stage::ALL.map(|stage| stage.to_string());
        assert_eq!(names, ["coarse", "f64", "finest tolerance", "double-double", "more digits"]);
        assert_eq!(format!("{:>8}|{:<7}|", Stage::F64, Stage::Coarse), "     f64|coarse |");
    }
}
