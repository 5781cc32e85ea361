//! What is found of launches in columns: by the kernels of [`::toss::Batch`] and [`Varying`] for coins, in the widest registers
//! of the machine, and for the outcomes of other bodies; launch by launch for what else is asked of these, and by a solver.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use ::toss::{
    Attitude, Backend, Body, Error, ExactSolver, Launch, Outcome, SolveError, Solver, TimeOfFlight, Toss, Tosses,
    Verdict, certify,
};
use dynamics::Thrown;
use dynamics::coin::NO_COIN;
use dynamics::error::require;
use dynamics::precession::rates_of_precession;
use dynamics::thrown::Field;
use exact::STAGES;
use exact::batch::varying::{Attitudes, Coins, Column, Flights, PROVEN_ABOVE, Varying};
use pyo3::PyResult;

use crate::errors::{Failure, malformed};
use crate::threads::{A_PROOF, Stop};

/// Launches whose attitudes are interleaved, or whose rates are found, at a time, so that what is between stays in the cache.
pub(crate) const BLOCK: usize = 512;

/// Launches whose conditions are compared at a time.
const COMPARED: usize = 64;

/// Counts of outcomes: heads, tails, undecided, of these all without a proof, and by the stage of the proof.
pub(crate) type Counts = [u64; 4 + STAGES.len()];

/// The sum of counts.
pub(crate) fn added(one: Counts, two: Counts) -> Counts {
    std::array::from_fn(|part| one[part] + two[part])
}

/// The places in [`Common::varying`].
const GRAVITY: usize = 0;
const DROP: usize = 1;
const TILT: usize = 2;
const ATTITUDE: usize = 3;
const BODY: usize = 4;

/// What the launches of some columns have in common.
pub(crate) struct Common {
    /// One for all, or those that a column has the numbers of; none if columns have the moments.
    pub(crate) bodies: Vec<Body>,
    pub(crate) attitude: Attitude,
    pub(crate) gravity: f64,
    pub(crate) drop: Option<f64>,
    /// The number of columns of gravity, the drop, the tilt, the attitude and the body, where they vary instead. A body has one
    /// of its number among `bodies`, or those of its moments: I1 and I3 of coins, or I1, I2 and I3.
    pub(crate) varying: [usize; 5],
    /// Whether the last of the first columns has times of flight instead of speeds.
    pub(crate) timed: bool,
    /// `None` for the kernels.
    pub(crate) solver: Option<Backend>,
}

impl Common {
    /// Whether all that is asked of the launches is solved by the kernels.
    pub(crate) fn is_vectorised(&self) -> bool {
        let are_coins = if self.bodies.is_empty() { self.varying[BODY] == 2 } else { self.bodies.iter().all(is_coin) };
        self.solver.is_none() && are_coins
    }

    /// Whether the launches are of coins that differ in more than rates and speeds, or land elsewhere than at the height of
    /// their launch.
    fn varies(&self) -> bool {
        self.is_vectorised() && (self.has_drop() || self.varying != [0; 5])
    }

    /// Whether outcomes of several bodies are proven, which takes as long as for one if those of each follow each other.
    pub(crate) fn has_bodies_in_turn(&self) -> bool {
        self.varying[BODY] > 0 && self.solver.is_none() && !self.is_vectorised()
    }

    fn has_drop(&self) -> bool {
        self.drop.is_some() || self.varying[DROP] > 0
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

fn is_coin(body: &Body) -> bool {
    body.coin().is_some()
}

/// Launches in columns, borrowed or copied.
pub(crate) struct Launches<'a> {
    pub(crate) of: Arc<Common>,
    /// The rates about x, y and z (rad/s), the speeds (m/s) or times (s), and what varies, in the order of [`Common::varying`]:
    /// gravity (m/s²), the drop (m), the tilt (rad), w, x, y, z of the attitude, and the number or the moments of the body.
    pub(crate) columns: Vec<Cow<'a, [f64]>>,
    /// Whether the first columns are the turn (rad/s) and ψ (rad) of coins instead, and 0.
    pub(crate) precesses: bool,
    /// The index of the first one.
    pub(crate) first: u64,
    /// What ends the work on them between two launches that are solved one by one.
    pub(crate) stop: Option<Stop>,
}

impl Launches<'_> {
    /// A copy of the launches with these places, in this order, that borrows nothing.
    pub(crate) fn taken(&self, places: &[usize]) -> Launches<'static> {
        let taken = |column: &Cow<'_, [f64]>| Cow::Owned(places.iter().map(|place| column[*place]).collect());
        let columns = self.columns.iter().map(taken).collect();
        Launches { of: self.of.clone(), columns, precesses: self.precesses, first: 0, stop: self.stop.clone() }
    }

    /// The places of the launches, in an order in which those of a body follow each other if that helps.
    pub(crate) fn in_order(&self) -> Vec<usize> {
        let mut places: Vec<usize> = (0..self.len()).collect();
        if self.of.has_bodies_in_turn() {
            let bodies = &self.columns[self.columns.len() - self.of.varying[BODY]..];
            places.sort_by(|one, two| {
                let bits = |place: usize| bodies.iter().map(move |column| column[place].to_bits());
                bits(*one).cmp(bits(*two))
            });
        }
        places
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

    /// Calls `solve` with launches that have rates, and the places among these of some of those in `range`, one part after the
    /// other. It solves each part at once: the kernels of coins take any launches, else they differ in rates and speeds only.
    pub(crate) fn by_runs(
        &self,
        range: Range<usize>,
        mut solve: impl FnMut(&Launches<'_>, Range<usize>) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        if !self.precesses {
            return self.runs(range).try_for_each(|run| solve(self, run));
        }
        for start in range.clone().step_by(BLOCK) {
            let part = start..range.end.min(start + BLOCK);
            let (launches, known, failure) = self.with_rates(part);
            launches.runs(0..known).try_for_each(|run| solve(&launches, run))?;
            failure.map_or(Ok(()), Err)?;
        }
        Ok(())
    }

    /// The parts of `range` in which nothing varies but rates and speeds; all of it for the kernels.
    fn runs(&self, range: Range<usize>) -> impl Iterator<Item = Range<usize>> {
        let others: &[Cow<'_, [f64]>] = if self.of.is_vectorised() { &[] } else { &self.columns[4..] };
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

    /// Column `part` of what varies, by its place in [`Common::varying`]; `None` if it does not.
    fn other(&self, kind: usize, part: usize) -> Option<&[f64]> {
        let before: usize = self.of.varying[..kind].iter().sum();
        (part < self.of.varying[kind]).then(|| &*self.columns[4 + before + part])
    }

    /// Gravity, the drop, the attitude and the body of launch `index`.
    fn conditions(&self, index: usize) -> Result<(f64, Option<f64>, Attitude, Body), Failure> {
        let number = |kind: usize, part: usize| self.other(kind, part).map(|column| column[index]);
        let attitude = match (number(TILT, 0), number(ATTITUDE, 0)) {
            (Some(tilt), _) => Attitude::about_x(require("tilt [rad]", tilt, "finite", true)?),
            (_, Some(_)) => {
                let components = std::array::from_fn(|part| number(ATTITUDE, part).unwrap_or(f64::NAN));
                Attitude::from_components(components)?
            }
            _ => self.of.attitude,
        };
        let (gravity, drop) = (number(GRAVITY, 0).unwrap_or(self.of.gravity), number(DROP, 0).or(self.of.drop));
        Ok((gravity, drop, attitude, self.body(index)?))
    }

    /// The body of launch `index`.
    fn body(&self, index: usize) -> Result<Body, Failure> {
        let number = |part: usize| self.other(BODY, part).map_or(0.0, |column| column[index]);
        if let Some(body) = self.of.bodies.get(number(0) as usize) {
            return Ok(*body);
        }
        let moments = [number(0), number(1), number(2)];
        Body::from_listed_moments(&moments[..self.of.varying[BODY]]).map_err(|error| Failure::from(error).of("moments"))
    }

    /// The launches up to the last one of `part` with rates in place of the turn and ψ, how many of that part have one, and what
    /// the next one fails by. What is before `part` is left out.
    fn with_rates(&self, part: Range<usize>) -> (Launches<'_>, usize, Option<Failure>) {
        let ratios = self.ratios(part.clone());
        let [turns, psis, _] = self.rates().map(|column| &column[part.clone()][..ratios.len()]);
        let mut rates = [(); 3].map(|()| vec![0.0; ratios.len()]);
        let [x, _, z] = &mut rates;
        let known = rates_of_precession(&ratios, turns, psis, [x, z]).unwrap_or(ratios.len());
        rates.iter_mut().for_each(|column| column.truncate(known));
        let failure = (known < part.len()).then(|| self.no_rate(part.start + known));
        let others = self.columns[3..].iter().map(|column| Cow::Borrowed(&column[part.start..part.start + known]));
        let columns = rates.into_iter().map(Cow::Owned).chain(others).collect();
        let first = self.first + part.start as u64;
        let stop = self.stop.clone();
        (Launches { of: self.of.clone(), columns, precesses: false, first, stop }, known, failure)
    }

    /// The inertia ratios of the launches in `part`, up to the first one that is no coin, or a rod, whose spin does not follow
    /// from ψ.
    fn ratios(&self, part: Range<usize>) -> Vec<f64> {
        let of = |body: Body| body.coin().filter(|coin| coin.i3() > 0.0).map(|coin| coin.inertia_ratio());
        if let [body] = self.of.bodies[..] {
            return of(body).map_or_else(Vec::new, |ratio| vec![ratio; part.len()]);
        }
        let moments = self.other(BODY, 0).zip(self.other(BODY, 1)).filter(|_| self.of.varying[BODY] == 2);
        let ratio = |index: usize| {
            let quotient = moments.and_then(|(i1, i3)| quotient(i1[index], i3[index]));
            quotient.or_else(|| of(self.body(index).ok()?))
        };
        part.map_while(ratio).collect()
    }

    /// Why the turn and ψ of launch `index` give no rate.
    fn no_rate(&self, index: usize) -> Failure {
        let [turn, psi, _] = self.rates().map(|column| column[index]);
        let rate = || -> Result<_, Failure> {
            let body = if let [body] = self.of.bodies[..] { body } else { self.body(index)? };
            let mut given = Thrown::default();
            given.put_si(Field::Turn, &[turn])?;
            given.put_si(Field::Psi, &[psi])?;
            Ok(given.precession(&body)?)
        };
        rate().err().unwrap_or(NO_COIN.into()).at(self.first + index as u64)
    }

    /// The launches in `range`, which is part of a run, as tosses of `body`.
    fn tosses<B: Copy + Into<Body>>(&self, body: B, range: Range<usize>) -> Result<Tosses<'_, B>, Failure> {
        let (start, rates) = (range.start, self.rates().map(|column| &column[range.clone()]));
        let tosses = self.conditions(start).and_then(|(gravity, _, attitude, _)| {
            Ok(Tosses::new(body, attitude, gravity, rates, &self.columns[3][range])?)
        });
        tosses.map_err(|failure| failure.at(self.first + start as u64))
    }

    /// The launches in `range`, as those of coins that may differ in all. `ratios` has room for their inertia ratios.
    fn varying<'b>(&'b self, range: Range<usize>, ratios: &'b mut [[f64; BLOCK]; 2]) -> Varying<'b> {
        let column = |kind: usize, part: usize| Some(Column::Each(&self.other(kind, part)?[range.clone()]));
        let gravity = column(GRAVITY, 0).unwrap_or(Column::All(self.of.gravity));
        let speeds = Column::Each(&self.columns[3][range.clone()]);
        let flights = match column(DROP, 0).or(self.of.drop.map(Column::All)) {
            _ if self.of.timed => Flights::Times(speeds),
            None => Flights::Level(speeds, gravity),
            Some(drop) => Flights::Below(speeds, gravity, drop),
        };
        let components = self.of.attitude.components();
        let attitudes = match (column(TILT, 0), column(ATTITUDE, 0)) {
            (Some(tilt), _) => Attitudes::Tilts(tilt),
            (None, None) if self.of.attitude == Attitude::IDENTITY => Attitudes::Tilts(Column::All(0.0)),
            _ => Attitudes::Quaternions(std::array::from_fn(|part| {
                column(ATTITUDE, part).unwrap_or(Column::All(components[part]))
            })),
        };
        let ratio = |body: &Body| body.coin().map(|coin| coin.exact_inertia_ratio());
        let coins = match (column(BODY, 0), column(BODY, 1)) {
            (Some(i1), Some(i3)) => Coins::Moments([i1, i3]),
            (Some(Column::Each(numbers)), None) => {
                let [ratio_of, rest_of] = ratios;
                for (place, number) in numbers.iter().enumerate() {
                    let ratio = self.of.bodies.get(*number as usize).and_then(ratio);
                    (ratio_of[place], rest_of[place]) = ratio.map_or((f64::NAN, 0.0), |ratio| (ratio.hi(), ratio.lo()));
                }
                Coins::Ratios([ratio_of, rest_of].map(|column| Column::Each(&column[..numbers.len()])))
            }
            _ => {
                let ratio = self.of.bodies.first().and_then(ratio);
                let [ratio, rest] = ratio.map_or([f64::NAN, 0.0], |ratio| [ratio.hi(), ratio.lo()]);
                Coins::Ratios([Column::All(ratio), Column::All(rest)])
            }
        };
        let rates = self.rates().map(|column| &column[range.clone()]);
        Varying { coins, rates, flights, attitudes }
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
        let (gravity, drop, attitude, body) = self.conditions(index)?;
        let speed = self.columns[3][index];
        let time = if self.of.timed { TimeOfFlight::Given(speed) } else { TimeOfFlight::thrown(speed, gravity, drop) };
        let launch = Launch::new(self.rates().map(|column| column[index]), time)?.with_attitude(attitude);
        Ok(Toss::new(body, launch))
    }

    /// The result of `solve` for each launch of `places`, with its place.
    fn each(
        &self,
        places: impl Iterator<Item = usize>,
        mut solve: impl FnMut(usize, &dyn Solver, &Toss) -> Result<(), Error>,
    ) -> Result<(), Failure> {
        let solver = self.of.solver.as_ref().map_or(&ExactSolver as &dyn Solver, Backend::solver);
        for index in places {
            self.stop.iter().for_each(Stop::here);
            let at = |failure: Failure| failure.at(self.first + index as u64);
            let toss = self.toss(index).map_err(at)?;
            solve(index, solver, &toss).map_err(|error| at(error.into()))?;
        }
        Ok(())
    }

    /// Writes cos θ at landing.
    pub(crate) fn cos_tilts(&self, range: Range<usize>, out: &mut [f64]) -> Result<(), Failure> {
        let start = range.start;
        if self.of.varies() {
            let mut ratios = [[0.0; BLOCK]; 2];
            for (number, out) in out.chunks_mut(BLOCK).enumerate() {
                let from = start + number * BLOCK;
                self.varying(from..from + out.len(), &mut ratios).cos_tilts(out);
            }
        } else if let Some(batch) = self.batch(range)? {
            return batch.cos_tilts(out).map_err(|error| self.failed(start, error));
        } else {
            out.fill(f64::NAN);
        }
        let open: Vec<usize> = (0..out.len()).filter(|place| out[*place].is_nan()).map(|place| start + place).collect();
        self.each(open.into_iter(), |index, solver, toss| {
            out[index - start] = solver.tilt(toss)?.cos_tilt;
            Ok(())
        })
    }

    /// Calls `found` with the numbers cos θ of at most [`BLOCK`] launches, of coins that may vary in all, and the place of the
    /// first one.
    fn blocks_of_varying(
        &self,
        range: Range<usize>,
        mut found: impl FnMut(usize, &[f64]) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let (mut ratios, mut block) = ([[0.0; BLOCK]; 2], [0.0; BLOCK]);
        for start in range.clone().step_by(BLOCK) {
            let cos_tilts = &mut block[..BLOCK.min(range.end - start)];
            self.varying(start..start + cos_tilts.len(), &mut ratios).cos_tilts(cos_tilts);
            found(start, cos_tilts)?;
        }
        Ok(())
    }

    /// Writes 1 for heads, -1 for tails and 0 for undecided launches.
    pub(crate) fn outcomes(&self, range: Range<usize>, out: &mut [i8]) -> Result<(), Failure> {
        let first = range.start;
        let decided = |index: usize, toss: &Toss, out: &mut [i8]| {
            out[index - first] = sign(self.of.verdict(toss)?.outcome());
            Ok(())
        };
        if self.of.decides_one_by_one() {
            return self.each(range, |index, _, toss| decided(index, toss, out));
        }
        if self.of.varies() {
            return self.blocks_of_varying(range, |start, cos_tilts| {
                for (cos_tilt, out) in cos_tilts.iter().zip(&mut out[start - first..]) {
                    *out = i8::from(*cos_tilt > PROVEN_ABOVE) - i8::from(*cos_tilt < -PROVEN_ABOVE);
                }
                self.each(open(start, cos_tilts), |index, _, toss| decided(index, toss, out))
            });
        }
        let mut block = [Outcome::Undecided; A_PROOF];
        for (number, out) in out.chunks_mut(A_PROOF).enumerate() {
            let from = first + number * A_PROOF;
            let outcomes = &mut block[..out.len()];
            self.prove(from..from + out.len(), outcomes)?;
            out.iter_mut().zip(outcomes).for_each(|(out, outcome)| *out = sign(*outcome));
        }
        Ok(())
    }

    /// Writes w, x, y, z of the attitude at landing of each launch, one after the other.
    pub(crate) fn attitudes(&self, range: Range<usize>, out: &mut [f64]) -> Result<(), Failure> {
        let start = range.start;
        let (mut block, mut ratios) = ([[0.0; BLOCK]; 4], [[0.0; BLOCK]; 2]);
        for (number, out) in out.chunks_mut(4 * BLOCK).enumerate() {
            let (from, length) = (start + number * BLOCK, out.len() / 4);
            let columns = block.each_mut().map(|column| &mut column[..length]);
            if self.of.varies() {
                self.varying(from..from + length, &mut ratios).attitudes(columns);
            } else if let Some(batch) = self.batch(from..from + length)? {
                batch.attitudes(columns).map_err(|error| self.failed(from, error))?;
            } else {
                columns.into_iter().for_each(|column| column.fill(f64::NAN));
            }
            for (index, out) in out.chunks_exact_mut(4).enumerate() {
                out.copy_from_slice(&block.each_ref().map(|column| column[index]));
            }
            let open = (0..length).filter(|place| block[0][*place].is_nan()).map(|place| from + place);
            self.each(open, |index, solver, toss| {
                let place = 4 * (index - from);
                out[place..place + 4].copy_from_slice(&solver.land(toss)?.state.attitude.components());
                Ok(())
            })?;
        }
        Ok(())
    }

    /// Counts the outcomes; they are proven unless a solver estimates them.
    pub(crate) fn count(&self, range: Range<usize>) -> Result<Counts, Failure> {
        let (mut sum, start) = (Counts::default(), range.start);
        if self.of.decides_one_by_one() {
            self.each(range, |_, _, toss| {
                sum = added(sum, counted(self.of.verdict(toss)?));
                Ok(())
            })?;
            return Ok(sum);
        }
        if self.of.varies() {
            self.blocks_of_varying(range, |start, cos_tilts| {
                let heads = cos_tilts.iter().map(|cos| u64::from(*cos > PROVEN_ABOVE)).sum::<u64>();
                let tails = cos_tilts.iter().map(|cos| u64::from(*cos < -PROVEN_ABOVE)).sum::<u64>();
                sum = added(sum, [heads, tails, 0, 0, heads + tails, 0, 0]);
                self.each(open(start, cos_tilts), |_, _, toss| {
                    sum = added(sum, counted(self.of.verdict(toss)?));
                    Ok(())
                })
            })?;
            return Ok(sum);
        }
        let body = self.body(start).map_err(|failure| failure.at(self.first + start as u64))?;
        let counts = match body.coin() {
            Some(coin) => ::toss::Batch::new(self.tosses(coin, range)?).count(),
            None => ::toss::Batch::new(self.tosses(body, range)?).count(),
        };
        let counts = counts.map_err(|error| self.failed(start, error))?;
        let [f64, double_double, more] = STAGES.map(|stage| counts.by(stage));
        Ok([counts.heads, counts.tails, counts.undecided, counts.without_proof, f64, double_double, more])
    }

    /// The launches in `range`, which is part of a run, for the kernels; `None` if they are solved one by one.
    fn batch(&self, range: Range<usize>) -> Result<Option<::toss::Batch<'_>>, Failure> {
        let Some(start) = Some(range.start).filter(|start| *start < range.end) else { return Ok(None) };
        let at = |failure: Failure| failure.at(self.first + start as u64);
        let coin = self.body(start).map_err(at)?.coin().filter(|_| self.of.solver.is_none() && !self.of.has_drop());
        coin.map(|coin| self.tosses(coin, range).map(::toss::Batch::new)).transpose()
    }

    /// Writes the proven outcomes of the launches in `range`, which is part of a run, of any body.
    fn prove(&self, range: Range<usize>, outcomes: &mut [Outcome]) -> Result<(), Failure> {
        let start = range.start;
        let body = self.body(start).map_err(|failure| failure.at(self.first + start as u64))?;
        let done = match body.coin() {
            Some(coin) => ::toss::Batch::new(self.tosses(coin, range)?).outcomes(outcomes),
            None => ::toss::Batch::new(self.tosses(body, range)?).outcomes(outcomes),
        };
        done.map_err(|error| self.failed(start, error))
    }
}

/// The inertia ratio of a coin with these moments, where a quotient is all that it takes: its f64 is that of the quotient in
/// double-double, whose rest never reaches half of its last digit.
fn quotient(i1: f64, i3: f64) -> Option<f64> {
    let ratio = i3 / i1;
    let is_plain = (f64::MIN_POSITIVE..=f64::MAX).contains(&i1) && i3 > 0.0 && i3 <= 2.0 * i1;
    (is_plain && ratio >= f64::MIN_POSITIVE).then_some(ratio)
}

/// The places of the launches from `start` on whose cos θ does not prove an outcome.
fn open(start: usize, cos_tilts: &[f64]) -> impl Iterator<Item = usize> {
    let is_open = |cos_tilt: &f64| cos_tilt.is_nan() || cos_tilt.abs() <= PROVEN_ABOVE;
    cos_tilts.iter().enumerate().filter(move |(_, cos_tilt)| is_open(cos_tilt)).map(move |(place, _)| start + place)
}

/// The counts of one outcome.
fn counted(verdict: Verdict) -> Counts {
    let is = |face| u64::from(verdict.outcome() == face);
    let [f64, double_double, more] = STAGES.map(|stage| u64::from(verdict.stage() == Some(stage)));
    let [heads, tails, undecided] = [Outcome::Heads, Outcome::Tails, Outcome::Undecided].map(is);
    [heads, tails, undecided, u64::from(!verdict.is_proven()), f64, double_double, more]
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
