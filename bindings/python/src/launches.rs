//! What is found of launches in columns: by the kernels of [`::toss::Batch`] for coins, in the widest registers of the
//! machine, and for the outcomes of other bodies; launch by launch for what else is asked of these, and by a solver.

use std::ops::Range;

use ::toss::{
    Attitude, Backend, Body, Error, ExactSolver, InputError, Launch, Outcome, Solver, Stage, TimeOfFlight, Toss, Tosses,
};
use dynamics::error::require;
use pyo3::PyResult;

use crate::errors::{Failure, malformed};
use crate::threads::{A_PROOF, Stop};

/// Launches whose attitudes are interleaved at a time, so that what is between stays in the cache.
const BLOCK: usize = 512;

/// The same for outcomes: as many as a call proves.
const OUTCOMES_BLOCK: usize = A_PROOF;

/// Counts of outcomes: heads, tails, undecided, and by stage of the proof where they are proven.
pub(crate) type Counts = (u64, u64, u64, Option<[u64; Stage::ALL.len()]>);

/// What the launches of some columns have in common.
pub(crate) struct Common {
    pub(crate) body: Body,
    pub(crate) attitude: Attitude,
    pub(crate) gravity: f64,
    /// Whether the last column has times of flight instead of speeds.
    pub(crate) timed: bool,
    /// `None` for the kernels.
    pub(crate) solver: Option<Backend>,
}

impl Common {
    /// Whether all that is asked of the launches is solved by the kernels.
    pub(crate) fn is_vectorised(&self) -> bool {
        self.solver.is_none() && self.body.coin().is_some()
    }

    /// The solver that estimates outcomes; `None` where the exact motion proves them, which the kernels do.
    fn estimating(&self) -> Option<&dyn Solver> {
        match self.solver.as_ref()? {
            Backend::Exact(_) => None,
            Backend::Solver(solver) => Some(&**solver),
        }
    }
}

/// Launches whose columns are borrowed.
pub(crate) struct Launches<'a> {
    pub(crate) of: &'a Common,
    pub(crate) rates: [&'a [f64]; 3],
    pub(crate) speeds: &'a [f64],
    /// Gravity (m/s²) and tilt (rad) of each launch, where they are not the same for all.
    pub(crate) gravities: Option<&'a [f64]>,
    pub(crate) tilts: Option<&'a [f64]>,
    /// The index of the first one.
    pub(crate) first: u64,
    /// What ends the work on them between two launches that are solved one by one.
    pub(crate) stop: Option<&'a Stop>,
}

impl Launches<'_> {
    /// `out` if it has `width` numbers for each launch.
    pub(crate) fn fitting<'b, T>(&self, out: &'b mut [T], width: usize) -> PyResult<&'b mut [T]> {
        if out.len() == width * self.speeds.len() {
            return Ok(out);
        }
        Err(malformed("out", out.len(), "as many results as launches"))
    }

    /// The parts of `range` with the same gravity and tilt.
    pub(crate) fn runs(&self, range: Range<usize>) -> impl Iterator<Item = Range<usize>> {
        let varying = [self.gravities, self.tilts];
        let differ = move |one: usize, two: usize| {
            varying.iter().flatten().any(|column| column[one].to_bits() != column[two].to_bits())
        };
        let mut start = range.start;
        std::iter::from_fn(move || {
            let first = start;
            let next = if varying == [None; 2] { None } else { (first..range.end).find(|index| differ(first, *index)) };
            start = next.unwrap_or(range.end);
            (first < start).then_some(first..start)
        })
    }

    /// Gravity and the attitude of launch `index`.
    fn conditions(&self, index: usize) -> Result<(f64, Attitude), InputError> {
        let gravity = self.gravities.map_or(self.of.gravity, |column| column[index]);
        let tilted = |column: &[f64]| Ok(Attitude::about_x(require("tilt [rad]", column[index], "finite", true)?));
        Ok((gravity, self.tilts.map_or(Ok(self.of.attitude), tilted)?))
    }

    /// The launches in `range`, which is part of a run, as tosses of `body`.
    fn tosses<B: Copy + Into<Body>>(&self, body: B, range: Range<usize>) -> Result<Tosses<'_, B>, Failure> {
        let (start, rates) = (range.start, self.rates.map(|column| &column[range.clone()]));
        let tosses = self
            .conditions(start)
            .and_then(|(gravity, attitude)| Tosses::new(body, attitude, gravity, rates, &self.speeds[range]));
        tosses.map_err(|error| Failure::from(error).at(self.first + start as u64))
    }

    /// The launches in `range` for the kernels; `None` if they are solved one by one.
    fn batch(&self, range: Range<usize>) -> Result<Option<::toss::Batch<'_>>, Failure> {
        let coin = self.of.body.coin().filter(|_| self.of.solver.is_none());
        coin.map(|coin| self.tosses(coin, range).map(::toss::Batch::new)).transpose()
    }

    /// Writes the proven outcomes of the launches in `range`, of any body.
    fn prove(&self, range: Range<usize>, outcomes: &mut [Outcome]) -> Result<(), Failure> {
        let start = range.start;
        let done = match self.of.body.coin() {
            Some(coin) => ::toss::Batch::new(self.tosses(coin, range)?).outcomes(outcomes),
            None => ::toss::Batch::new(self.tosses(self.of.body, range)?).outcomes(outcomes),
        };
        done.map_err(|error| self.failed(start, error))
    }

    /// Counts the proven outcomes of the launches in `range`, of any body.
    fn count_proven(&self, range: Range<usize>) -> Result<Counts, Failure> {
        let start = range.start;
        let counts = match self.of.body.coin() {
            Some(coin) => ::toss::Batch::new(self.tosses(coin, range)?).count(),
            None => ::toss::Batch::new(self.tosses(self.of.body, range)?).count(),
        };
        let counts = counts.map_err(|error| self.failed(start, error))?;
        let stages = (counts.without_proof() == 0).then(|| Stage::ALL.map(|stage| counts.by(stage)));
        Ok((counts.heads(), counts.tails(), counts.ties(), stages))
    }

    /// The failure of the kernels in the part that starts at `start`, in the words of a single launch.
    fn failed(&self, start: usize, error: Error) -> Failure {
        let error = error.after(start as u64);
        if let Error::BadLaunch { index, .. } = error
            && self.of.timed
            && let Err(failure) = self.toss(usize::try_from(index).unwrap_or(usize::MAX))
        {
            return failure.at(self.first + index);
        }
        error.after(self.first).into()
    }

    fn toss(&self, index: usize) -> Result<Toss, Failure> {
        let (gravity, attitude) = self.conditions(index)?;
        let speed = self.speeds[index];
        let time = if self.of.timed { TimeOfFlight::Given(speed) } else { TimeOfFlight::Ballistic { speed, gravity } };
        let launch = Launch::new(self.rates.map(|column| column[index]), time)?.with_attitude(attitude);
        Ok(Toss::new(self.of.body, launch))
    }

    /// The result of `solve` for each launch in `range`, with its place.
    fn each(
        &self,
        range: Range<usize>,
        mut solve: impl FnMut(usize, &dyn Solver, &Toss) -> Result<(), Error>,
    ) -> Result<(), Failure> {
        let solver = self.of.solver.as_ref().map_or(&ExactSolver as &dyn Solver, Backend::solver);
        for (place, index) in range.enumerate() {
            self.stop.inspect(|stop| stop.here());
            let at = |failure: Failure| failure.at(self.first + index as u64);
            let toss = self.toss(index).map_err(at)?;
            solve(place, solver, &toss).map_err(|error| at(error.into()))?;
        }
        Ok(())
    }

    /// Writes cos θ at landing.
    pub(crate) fn cos_tilts(&self, range: Range<usize>, out: &mut [f64]) -> Result<(), Failure> {
        let start = range.start;
        match self.batch(range.clone())? {
            Some(batch) => batch.cos_tilts(out).map_err(|error| self.failed(start, error)),
            None => self.each(range, |place, solver, toss| {
                out[place] = solver.tilt(toss)?.cos_tilt;
                Ok(())
            }),
        }
    }

    /// Writes 1 for heads, -1 for tails and 0 for undecided launches.
    pub(crate) fn outcomes(&self, range: Range<usize>, out: &mut [i8]) -> Result<(), Failure> {
        if self.of.estimating().is_some() {
            return self.each(range, |place, solver, toss| {
                out[place] = sign(solver.tilt(toss)?.outcome());
                Ok(())
            });
        }
        let mut block = [Outcome::Undecided; OUTCOMES_BLOCK];
        for (number, out) in out.chunks_mut(OUTCOMES_BLOCK).enumerate() {
            let from = range.start + number * OUTCOMES_BLOCK;
            let outcomes = &mut block[..out.len()];
            self.prove(from..from + out.len(), outcomes)?;
            out.iter_mut().zip(outcomes).for_each(|(out, outcome)| *out = sign(*outcome));
        }
        Ok(())
    }

    /// Writes w, x, y, z of the attitude at landing of each launch, one after the other.
    pub(crate) fn attitudes(&self, range: Range<usize>, out: &mut [f64]) -> Result<(), Failure> {
        let start = range.start;
        if !self.of.is_vectorised() {
            return self.each(range, |place, solver, toss| {
                let landing = solver.land(toss)?.state.attitude;
                out[4 * place..4 * place + 4].copy_from_slice(&landing.components());
                Ok(())
            });
        }
        let mut block = [[0.0; BLOCK]; 4];
        for (number, out) in out.chunks_mut(4 * BLOCK).enumerate() {
            let (from, length) = (start + number * BLOCK, out.len() / 4);
            let [w, x, y, z] = block.each_mut().map(|column| &mut column[..length]);
            if let Some(batch) = self.batch(from..from + length)? {
                batch.attitudes([w, x, y, z]).map_err(|error| self.failed(from, error))?;
            }
            for (index, out) in out.chunks_exact_mut(4).enumerate() {
                out.copy_from_slice(&block.each_ref().map(|column| column[index]));
            }
        }
        Ok(())
    }

    /// Counts the outcomes; they are proven unless a solver estimates them.
    pub(crate) fn count(&self, range: Range<usize>) -> Result<Counts, Failure> {
        if self.of.estimating().is_none() {
            return self.count_proven(range);
        }
        let mut faces = [0; 3];
        self.each(range, |_, solver, toss| {
            faces[solver.tilt(toss)?.outcome() as usize] += 1;
            Ok(())
        })?;
        Ok((faces[0], faces[1], faces[2], None))
    }
}

/// The sign of cos θ.
fn sign(outcome: Outcome) -> i8 {
    // Not a match, which would not be vectorised.
    i8::from(outcome == Outcome::Heads) - i8::from(outcome == Outcome::Tails)
}
