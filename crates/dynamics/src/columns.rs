//! [`Tosses`], many tosses given as columns of rates and speeds. A batch solves columns with SIMD registers, for which
//! each input has to be contiguous in memory.
//!
//! They are of a coin, or of any rigid body: `Tosses<'_, Body>`.

use std::ops::Range;

use nalgebra::Vector3;

use crate::attitude::Attitude;
use crate::body::Body;
use crate::coin::Coin;
use crate::error::{InputError, SolveError, require};
use crate::failure::Error;
use crate::launch::Launch;
use crate::time_of_flight::TimeOfFlight;
use crate::toss::{CoinToss, Toss};

/// Tosses that differ in their body rates and speeds only: the coin or [`Body`], the attitude at launch and the gravity
/// are the same.
#[derive(Debug, Clone, Copy)]
pub struct Tosses<'a, B = Coin> {
    body: B,
    attitude: Attitude,
    gravity: f64,
    rates: [&'a [f64]; 3],
    speeds: &'a [f64],
}

impl<'a, B: Copy + Into<Body>> Tosses<'a, B> {
    /// Tosses of a coin or a body with the body rates `rates` (body frame, rad/s: all ωx, all ωy, all ωz), thrown up at `speeds` (m/s)
    /// under `gravity` (m/s²) and caught at the same height. With a gravity of 2 m/s² the speed is the time of flight
    /// in seconds. Fails if the columns differ in length, or for a gravity that is not positive and finite. Each toss
    /// is checked only when it is solved.
    pub fn new(
        body: B,
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
        Ok(Self { body, attitude, gravity, rates, speeds })
    }

    /// Number of tosses.
    pub fn len(&self) -> usize {
        self.speeds.len()
    }

    /// Whether there are no tosses.
    pub fn is_empty(&self) -> bool {
        self.speeds.is_empty()
    }

    /// The attitude at launch of all tosses.
    pub fn attitude(&self) -> Attitude {
        self.attitude
    }

    /// The gravity of all tosses (m/s²).
    pub fn gravity(&self) -> f64 {
        self.gravity
    }

    /// The columns of the tosses in `range`: ωx, ωy, ωz (body frame, rad/s) and v0 (m/s).
    #[inline(always)]
    pub fn columns(&self, range: Range<usize>) -> [&'a [f64]; 4] {
        let [x, y, z] = self.rates;
        [&x[range.clone()], &y[range.clone()], &z[range.clone()], &self.speeds[range]]
    }

    /// The tosses in `range`.
    #[must_use]
    pub fn part(&self, range: Range<usize>) -> Self {
        let [x, y, z, speeds] = self.columns(range);
        Self { rates: [x, y, z], speeds, ..*self }
    }

    /// Launch number `index`, which is below [`Tosses::len`].
    pub fn launch(&self, index: usize) -> Result<Launch, InputError> {
        let [x, y, z] = self.rates.map(|column| column[index]);
        let time = TimeOfFlight::Ballistic { speed: self.speeds[index], gravity: self.gravity };
        Ok(Launch::new(Vector3::new(x, y, z), time)?.with_attitude(self.attitude))
    }

    /// Toss number `index`, which is below [`Tosses::len`].
    pub fn toss(&self, index: usize) -> Result<Toss, InputError> {
        Ok(Toss::new(self.body, self.launch(index)?))
    }

    /// The result of `solve` for toss `index`. Fails with [`Error::BadLaunch`] if the toss is invalid,
    /// [`Error::Launch`] if `solve` fails, each with the index.
    pub fn solve<T>(&self, index: usize, solve: impl Fn(&Toss) -> Result<T, SolveError>) -> Result<T, Error> {
        let toss = self.toss(index).map_err(|source| Error::BadLaunch { index: index as u64, source })?;
        solve(&toss).map_err(|source| Error::of_launch(index, &toss, source))
    }

    /// All tosses, one after the other. Fails with [`Error::BadLaunch`] for the first that is invalid.
    pub fn each(&self) -> Result<Vec<Toss>, Error> {
        (0..self.len()).map(|index| self.solve(index, |toss| Ok(*toss))).collect()
    }

    /// The coin or body of all tosses.
    pub fn body(&self) -> &B {
        &self.body
    }
}

impl Tosses<'_, Coin> {
    /// The result of `solve` for toss `index`, as [`Tosses::solve`] returns it, by a formula for coins alone.
    pub fn solve_coin<T>(&self, index: usize, solve: impl Fn(&CoinToss) -> Result<T, SolveError>) -> Result<T, Error> {
        self.solve(index, |toss| solve(&CoinToss { coin: self.body, launch: toss.launch }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_has_the_launches_of_its_range() {
        let (rates, speeds) = ([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, 9.0]], [0.1, 0.2, 0.3]);
        let rates = rates.each_ref().map(<[f64; 3]>::as_slice);
        let all = Tosses::new(Coin::PAPER, Attitude::about_x(0.5), 9.81, rates, &speeds).unwrap();
        let part = all.part(1..3);
        assert_eq!((part.len(), part.is_empty(), all.part(2..2).is_empty()), (2, false, true));
        assert_eq!(part.launch(0), all.launch(1));
        assert_eq!(part.launch(1), all.launch(2));
        assert_ne!(all.launch(1), all.launch(2));
        assert_eq!(part.gravity(), 9.81);
        assert_eq!(part.columns(1..2), [&[3.0][..], &[6.0], &[9.0], &[0.3]]);
    }
}
