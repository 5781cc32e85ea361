//! Many tosses at once by the exact motion, in vectors: structures of arrays in, arrays out, nothing allocated.
//!
//! | wanted | kernel | error |
//! |---|---|---|
//! | cos θ at landing | [`Tosses::cos_tilts`] | 4e-16 from horizontal, else 6e-16 |
//! | proven outcomes | [`Tosses::outcomes`] | none |
//! | attitude at landing | [`Tosses::attitudes`] | 1e-15 rad |
//!
//! A kernel serves ordinary tosses: |L|² between 1e-100 and 1e100 (rad/s)², gravity between 1e-50 and 1e50 m/s², ωL T
//! below 2^40 turns, or k times that for a coin with a ratio k below 1. Others are solved one by one, as accurately.
//! Neither the instruction set nor the neighbours of a toss change a bit of its results.

mod attitude;
mod cos_tilt;
mod kernel;
mod momentum;
mod outcome;

use std::ops::Range;

use nalgebra::Vector3;

pub use outcome::Filtered;

use crate::attitude::Attitude;
use crate::coin::Coin;
use crate::error::{InputError, SolveError, require};
use crate::lanes::Path;
use crate::launch::{Launch, Toss};
use crate::time_of_flight::TimeOfFlight;

/// Tosses of one coin from one attitude under one gravity, which differ in rates and speed.
#[derive(Debug, Clone, Copy)]
pub struct Tosses<'a> {
    coin: Coin,
    attitude: Attitude,
    gravity: f64,
    rates: [&'a [f64]; 3],
    speeds: &'a [f64],
    path: Path,
}

/// Why a batch has no answer: the first toss that is none, or that cannot be solved.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("toss {index}: {source}")]
pub struct BatchError {
    /// Its index.
    pub index: usize,
    /// What is wrong with it.
    pub source: TossError,
}

/// What is wrong with a toss.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TossError {
    /// It is none.
    #[error(transparent)]
    Input(#[from] InputError),
    /// It cannot be solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

impl<'a> Tosses<'a> {
    /// Tosses with the body rates `rates` (BF, rad/s: all ωx, all ωy, all ωz), thrown up at `speeds` (m/s) under `gravity`
    /// (m/s²). With a gravity of 2 m/s² a speed is a time of flight.
    ///
    /// # Errors
    /// [`InputError`] if the columns differ in length, or for a gravity that is not positive and finite. The tosses
    /// themselves are looked at when they are solved.
    pub fn new(
        coin: Coin,
        attitude: Attitude,
        gravity: f64,
        rates: [&'a [f64]; 3],
        speeds: &'a [f64],
    ) -> Result<Self, InputError> {
        require("gravity [m/s²]", gravity, "finite and > 0", gravity > 0.0)?;
        if rates.iter().any(|column| column.len() != speeds.len()) {
            let lengths = [rates[0].len(), rates[1].len(), rates[2].len(), speeds.len()];
            let expected = "as many rates of each kind as speeds";
            return Err(InputError::Malformed { field: "columns", value: format!("{lengths:?}"), expected });
        }
        Ok(Self { coin, attitude, gravity, rates, speeds, path: Path::widest() })
    }

    /// The same tosses, solved with the instructions of `path`.
    #[must_use]
    pub fn on(self, path: Path) -> Self {
        Self { path, ..self }
    }

    /// Number of tosses.
    pub fn len(&self) -> usize {
        self.speeds.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.speeds.is_empty()
    }

    /// Toss number `index`, which is below [`Tosses::len`].
    ///
    /// # Errors
    /// As [`Launch::new`].
    pub fn toss(&self, index: usize) -> Result<Toss, InputError> {
        let [x, y, z] = self.rates.map(|column| column[index]);
        let time = TimeOfFlight::Ballistic { speed: self.speeds[index], gravity: self.gravity };
        let launch = Launch::new(Vector3::new(x, y, z), time)?.with_attitude(self.attitude);
        Ok(Toss { coin: self.coin, launch })
    }

    /// What `solve` says of toss `index`.
    ///
    /// # Errors
    /// [`BatchError`] with that index.
    pub fn solve<T>(&self, index: usize, solve: impl Fn(&Toss) -> Result<T, SolveError>) -> Result<T, BatchError> {
        let solved = self.toss(index).map_err(TossError::from).and_then(|toss| Ok(solve(&toss)?));
        solved.map_err(|source| BatchError { index, source })
    }

    /// Some of the tosses.
    fn part(&self, range: Range<usize>) -> Tosses<'a> {
        let rates = self.rates.map(|column| &column[range.clone()]);
        Tosses { rates, speeds: &self.speeds[range], ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_has_its_own_tosses_and_each_path_is_the_one_that_was_asked_for() {
        let (rates, speeds) = ([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]], [3.0, 4.0, 5.0]);
        let columns = rates.each_ref().map(<[f64; 3]>::as_slice);
        let tosses = Tosses::new(Coin::PAPER, Attitude::IDENTITY, 9.81, columns, &speeds).unwrap();
        let part = tosses.part(1..3);
        assert_eq!((part.toss(0), part.toss(1)), (tosses.toss(1), tosses.toss(2)));
        assert_eq!((part.len(), part.is_empty(), tosses.part(1..1).is_empty()), (2, false, true));
        assert!(tosses.is_flat() && !Tosses { attitude: Attitude::about_x(1e-300), ..tosses }.is_flat());
        for path in Path::all() {
            assert_eq!(tosses.on(path).path.name(), path.name());
        }
    }
}
