//! What is found of launches in columns: by the kernels of [`::toss::Batch`] and [`Varying`] for coins, in the widest registers
//! of the machine, and for the outcomes of other bodies; launch by launch for what else is asked of these, for attitudes at
//! landing of coins with a drop, and by a solver.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use ::toss::{
    Attitude, Backend, Body, Coin, Error, ExactSolver, InputError, Launch, Outcome, SolveError, Solver, Stage,
    TimeOfFlight, Toss, Tosses, Verdict, certify,
};
use dynamics::error::require;
use exact::STAGES;
use exact::batch::varying::{Attitudes, Column, Flights, Varying, proven};
use pyo3::PyResult;

use crate::errors::{Failure, malformed};
use crate::threads::{A_PROOF, Stop};

/// Launches whose attitudes are interleaved at a time, so that what is between stays in the cache.
const BLOCK: usize = 512;

/// Launches whose conditions are compared at a time.
const COMPARED: usize = 64;

/// Counts of outcomes: heads, tails, undecided, of these all without a proof, and by the stage of the proof.
pub(crate) type Counts = [u64; 4 + STAGES.len()];

/// The sum of counts.
pub(crate) fn added(one: Counts, two: Counts) -> Counts {
    std::array::from_fn(|part| one[part] + two[part])
}

/// What the launches of some columns have in common.
pub(crate) struct Common {
    pub(crate) body: Body,
    pub(crate) attitude: Attitude,
    pub(crate) gravity: f64,
    pub(crate) drop: Option<f64>,
    /// Which of gravity, the drop, the tilt and the attitude vary instead.
    pub(crate) varying: [bool; 4],
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

    /// The coin of launches that differ in more than rates and speeds, or land elsewhere than at the height of their launch.
    fn varying_coin(&self) -> Option<Coin> {
        let is_plain = !self.has_drop() && self.varying == [false; 4];
        self.body.coin().filter(|_| self.is_vectorised() && !is_plain)
    }

    fn has_drop(&self) -> bool {
        self.drop.is_some() || self.varying[1]
    }

    /// Whether outcomes are decided toss by toss, not by the kernels.
    fn decides_one_by_one(&self) -> bool {
        (self.has_drop() && !self.is_vectorised()) || matches!(self.solver, Some(Backend::Solver(_)))
    }

    /// How a toss lands: proven, or estimated by a solver.
    fn verdict(&self, toss: &Toss) -> Result<Verdict, SolveError> {
        match &self.solver {
            Some(Backend::Solver(solver)) => Ok(Verdict::Estimated(solver.tilt(toss)?.outcome())),
            _ => certify(toss).map(Verdict::Proven),
        }
    }
}

/// Launches in columns, borrowed or copied.
pub(crate) struct Launches<'a> {
    pub(crate) of: Arc<Common>,
    /// The rates about x, y and z (rad/s), the speeds (m/s) or times (s), and what varies, in the order of [`Common::varying`]:
    /// gravity (m/s²), the drop (m), the tilt (rad), and w, x, y, z of the attitude.
    pub(crate) columns: Vec<Cow<'a, [f64]>>,
    /// The index of the first one.
    pub(crate) first: u64,
    /// What ends the work on them between two launches that are solved one by one.
    pub(crate) stop: Option<Stop>,
}

impl Launches<'_> {
    /// A copy that borrows nothing.
    pub(crate) fn owned(&self) -> Launches<'static> {
        let columns = self.columns.iter().map(|column| Cow::Owned(column.to_vec())).collect();
        Launches { of: self.of.clone(), columns, first: self.first, stop: None }
    }

    pub(crate) fn len(&self) -> usize {
        self.columns[0].len()
    }

    /// The columns of rates.
    fn rates(&self) -> [&[f64]; 3] {
        [&self.columns[0], &self.columns[1], &self.columns[2]]
    }

    /// `out` if it has `width` numbers for each launch.
    pub(crate) fn fitting<'b, T>(&self, out: &'b mut [T], width: usize) -> PyResult<&'b mut [T]> {
        if out.len() == width * self.len() {
            return Ok(out);
        }
        Err(malformed("out", out.len(), "as many results as launches"))
    }

    /// The parts of `range` in which nothing varies but rates and speeds; all of it for a kernel in which more may vary.
    pub(crate) fn runs(&self, range: Range<usize>, varies: bool) -> impl Iterator<Item = Range<usize>> {
        let others: &[Cow<'_, [f64]>] = if varies { &[] } else { &self.columns[4..] };
        let others: Vec<&[f64]> = others.iter().map(|column| &**column).collect();
        let mut start = range.start;
        std::iter::from_fn(move || {
            let first = start;
            // Many are compared at a time, in vector registers, then few, then one.
            let many = if others.is_empty() { range.end - first } else { COMPARED };
            for step in [many, COMPARED / 8, 1] {
                while start < range.end && start + step <= range.end && are_like(&others, first, start..start + step) {
                    start += step;
                }
            }
            (first < start).then_some(first..start)
        })
    }

    /// Gravity, the drop and the attitude of launch `index`.
    fn conditions(&self, index: usize) -> Result<(f64, Option<f64>, Attitude), InputError> {
        let mut others = self.columns[4..].iter().map(|column| column[index]);
        let [gravity, drop, tilt, w] = self.of.varying.map(|varies| if varies { others.next() } else { None });
        let attitude = match (tilt, w) {
            (Some(tilt), _) => Attitude::about_x(require("tilt [rad]", tilt, "finite", true)?),
            (None, Some(w)) => {
                let [x, y, z] = std::array::from_fn(|_| others.next().unwrap_or(f64::NAN));
                Attitude::from_components([w, x, y, z])?
            }
            (None, None) => self.of.attitude,
        };
        Ok((gravity.unwrap_or(self.of.gravity), drop.or(self.of.drop), attitude))
    }

    /// The launches in `range`, which is part of a run, as tosses of `body`.
    fn tosses<B: Copy + Into<Body>>(&self, body: B, range: Range<usize>) -> Result<Tosses<'_, B>, Failure> {
        let (start, rates) = (range.start, self.rates().map(|column| &column[range.clone()]));
        let tosses = self
            .conditions(start)
            .and_then(|(gravity, _, attitude)| Tosses::new(body, attitude, gravity, rates, &self.columns[3][range]));
        tosses.map_err(|error| Failure::from(error).at(self.first + start as u64))
    }

    /// The launches in `range` for the kernels; `None` if they are solved one by one.
    fn batch(&self, range: Range<usize>) -> Result<Option<::toss::Batch<'_>>, Failure> {
        let coin = self.of.body.coin().filter(|_| self.of.is_vectorised());
        coin.map(|coin| self.tosses(coin, range).map(::toss::Batch::new)).transpose()
    }

    /// Writes cos θ of the launches of a coin in `range` that may differ in all else; NaN for what is solved one by one.
    fn cos_tilts_of_varying(&self, coin: Coin, range: Range<usize>, out: &mut [f64]) -> Result<(), Failure> {
        let mut others = self.columns[4..].iter().map(|column| Column::Each(&column[range.clone()]));
        let [gravity, drop, tilt, w] = self.of.varying.map(|varies| if varies { others.next() } else { None });
        let gravity = gravity.unwrap_or(Column::All(self.of.gravity));
        let speeds = Column::Each(&self.columns[3][range.clone()]);
        let flights = match drop.or(self.of.drop.map(Column::All)) {
            _ if self.of.timed => Flights::Times(speeds),
            None => Flights::Level(speeds, gravity),
            Some(drop) => Flights::Below(speeds, gravity, drop),
        };
        let components = self.of.attitude.components().map(Column::All);
        let attitudes = match (tilt, w) {
            (Some(tilt), _) => Attitudes::Tilts(tilt),
            (None, Some(w)) => Attitudes::Quaternions(
                [Some(w), others.next(), others.next(), others.next()].map(|part| part.unwrap_or(w)),
            ),
            (None, None) if self.of.attitude == Attitude::IDENTITY => Attitudes::Tilts(Column::All(0.0)),
            (None, None) => Attitudes::Quaternions(components),
        };
        let rates = self.rates().map(|column| &column[range.clone()]);
        Ok(Varying { coin, rates, flights, attitudes }.cos_tilts(out)?)
    }

    /// As [`Launches::prove`], of a coin of which all else may vary. It calls `found` with each outcome and the stage of its proof.
    fn prove_varying(
        &self,
        coin: Coin,
        range: Range<usize>,
        mut found: impl FnMut(usize, Outcome, Option<Stage>),
    ) -> Result<(), Failure> {
        let mut block = [0.0; A_PROOF];
        for start in range.clone().step_by(A_PROOF) {
            let part = start..range.end.min(start + A_PROOF);
            let cos_tilts = &mut block[..part.len()];
            self.cos_tilts_of_varying(coin, part.clone(), cos_tilts)?;
            for (index, cos_tilt) in part.zip(cos_tilts) {
                let place = index - range.start;
                if let Some(outcome) = proven(*cos_tilt) {
                    found(place, outcome, Some(Stage::F64));
                    continue;
                }
                let at = |failure: Failure| failure.at(self.first + index as u64);
                let verdict = self.of.verdict(&self.toss(index).map_err(at)?);
                let verdict = verdict.map_err(|error| at(error.into()))?;
                found(place, verdict.outcome(), verdict.stage().filter(|_| verdict.is_proven()));
            }
        }
        Ok(())
    }

    /// Writes the proven outcomes of the launches in `range`, of any body.
    fn prove(&self, range: Range<usize>, outcomes: &mut [Outcome]) -> Result<(), Failure> {
        if let Some(coin) = self.of.varying_coin() {
            return self.prove_varying(coin, range, |place, outcome, _| outcomes[place] = outcome);
        }
        let start = range.start;
        let done = match self.of.body.coin() {
            Some(coin) => ::toss::Batch::new(self.tosses(coin, range)?).outcomes(outcomes),
            None => ::toss::Batch::new(self.tosses(self.of.body, range)?).outcomes(outcomes),
        };
        done.map_err(|error| self.failed(start, error))
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
        let (gravity, drop, attitude) = self.conditions(index)?;
        let speed = self.columns[3][index];
        let time = if self.of.timed { TimeOfFlight::Given(speed) } else { TimeOfFlight::thrown(speed, gravity, drop) };
        let launch = Launch::new(self.rates().map(|column| column[index]), time)?.with_attitude(attitude);
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
            self.stop.iter().for_each(Stop::here);
            let at = |failure: Failure| failure.at(self.first + index as u64);
            let toss = self.toss(index).map_err(at)?;
            solve(place, solver, &toss).map_err(|error| at(error.into()))?;
        }
        Ok(())
    }

    /// Writes cos θ at landing.
    pub(crate) fn cos_tilts(&self, range: Range<usize>, out: &mut [f64]) -> Result<(), Failure> {
        let start = range.start;
        if let Some(coin) = self.of.varying_coin() {
            self.cos_tilts_of_varying(coin, range, out)?;
            let unsolved = (0..out.len()).filter(|place| out[*place].is_nan()).collect::<Vec<_>>();
            return unsolved.into_iter().try_for_each(|place| {
                let index = start + place;
                self.each(index..index + 1, |_, solver, toss| {
                    out[place] = solver.tilt(toss)?.cos_tilt;
                    Ok(())
                })
            });
        }
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
        if self.of.decides_one_by_one() {
            return self.each(range, |place, _, toss| {
                out[place] = sign(self.of.verdict(toss)?.outcome());
                Ok(())
            });
        }
        let mut block = [Outcome::Undecided; A_PROOF];
        for (number, out) in out.chunks_mut(A_PROOF).enumerate() {
            let from = range.start + number * A_PROOF;
            let outcomes = &mut block[..out.len()];
            self.prove(from..from + out.len(), outcomes)?;
            out.iter_mut().zip(outcomes).for_each(|(out, outcome)| *out = sign(*outcome));
        }
        Ok(())
    }

    /// Writes w, x, y, z of the attitude at landing of each launch, one after the other.
    pub(crate) fn attitudes(&self, range: Range<usize>, out: &mut [f64]) -> Result<(), Failure> {
        let start = range.start;
        if !self.of.is_vectorised() || self.of.has_drop() {
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
        if self.of.decides_one_by_one() {
            let mut sum = Counts::default();
            self.each(range, |_, _, toss| {
                let verdict = self.of.verdict(toss)?;
                let is = |face| u64::from(verdict.outcome() == face);
                let by = |stage| u64::from(verdict.stage() == Some(stage));
                let [f64, double_double, more] = STAGES.map(by);
                let [heads, tails, undecided] = [Outcome::Heads, Outcome::Tails, Outcome::Undecided].map(is);
                let without_proof = u64::from(!verdict.is_proven());
                sum = added(sum, [heads, tails, undecided, without_proof, f64, double_double, more]);
                Ok(())
            })?;
            return Ok(sum);
        }
        if let Some(coin) = self.of.varying_coin() {
            let mut sum = Counts::default();
            self.prove_varying(coin, range, |_, outcome, stage| {
                sum[[Outcome::Heads, Outcome::Tails, Outcome::Undecided]
                    .iter()
                    .position(|of| *of == outcome)
                    .unwrap_or(2)] += 1;
                sum[stage.and_then(|by| STAGES.iter().position(|of| *of == by)).map_or(3, |place| 4 + place)] += 1;
            })?;
            return Ok(sum);
        }
        let start = range.start;
        let counts = match self.of.body.coin() {
            Some(coin) => ::toss::Batch::new(self.tosses(coin, range)?).count(),
            None => ::toss::Batch::new(self.tosses(self.of.body, range)?).count(),
        };
        let counts = counts.map_err(|error| self.failed(start, error))?;
        let [f64, double_double, more] = STAGES.map(|stage| counts.by(stage));
        Ok([counts.heads, counts.tails, counts.undecided, counts.without_proof, f64, double_double, more])
    }
}

/// Whether all values of `range` in each column are the one at `first`, to the bit.
fn are_like(columns: &[&[f64]], first: usize, range: Range<usize>) -> bool {
    columns.iter().all(|column| {
        let bits = column[first].to_bits();
        column[range.clone()].iter().fold(0, |differing, value| differing | (value.to_bits() ^ bits)) == 0
    })
}

/// The sign of cos θ.
pub(crate) fn sign(outcome: Outcome) -> i8 {
    // Not a match, which would not be vectorised.
    i8::from(outcome == Outcome::Heads) - i8::from(outcome == Outcome::Tails)
}
