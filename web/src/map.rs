//! A map of outcomes or of P(heads) over ωx and a second input, ωz or the speed. Every other input is that of the scene.
//! The outcomes are proven, each for the f64 numbers of its cell.

use dynamics::Tosses;
use exact::{Batch, certify};
use sampling::{Axis, Coordinate, Plan, Rest, Sampler};
use serde::{Deserialize, Serialize};
use toss::{Body, CoinToss, Error, InputError, Launch, Outcome, TimeOfFlight, Toss, Vector3};

use crate::hand::part;
use crate::thrown::Thrown;

/// The second input of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Up {
    /// ωz (rad/s).
    RateZ,
    /// v0 (m/s).
    Speed,
}

/// The grid of a map: its cells are at equally spaced values, both ends included.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Grid {
    pub(crate) up: Up,
    /// The range of ωx (rad/s).
    pub(crate) across: [f64; 2],
    /// The range of ωz (rad/s) or v0 (m/s).
    pub(crate) over: [f64; 2],
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// The rows that are asked for: from the first to before the second.
    pub(crate) part: [usize; 2],
    /// The standard deviation of the speed, relative to itself. With it, cells are P(heads); without, outcomes.
    pub(crate) spread: Option<String>,
}

/// How many cells were written, and what they say.
#[derive(Debug, Serialize)]
pub(crate) struct Counted {
    cells: usize,
    heads: usize,
    tails: usize,
    undecided: usize,
}

/// The most columns and rows of a map.
const MOST: usize = 1000;

/// The cell of P = 1, or of proven heads; that of tails is 0.
pub(crate) const HEADS: u8 = 254;

/// The cell of a launch without an outcome.
pub(crate) const UNDECIDED: u8 = 255;

/// The value of the `index`th of `number` cells over a range.
fn value([lo, hi]: [f64; 2], index: usize, number: usize) -> f64 {
    lo + (hi - lo) * (index as f64 / (number - 1) as f64)
}

impl Grid {
    fn check(&self) -> Result<(), InputError> {
        let malformed = |field, value: String, expected| Err(InputError::Malformed { field, value, expected });
        let size = (2..=MOST).contains(&self.columns) && (2..=MOST).contains(&self.rows);
        if !size || self.part[0] > self.part[1] || self.part[1] > self.rows {
            let value = format!("{} × {}, rows {:?}", self.columns, self.rows, self.part);
            return malformed("map", value, "2 to 1000 columns and rows, and a part of these");
        }
        let is_range = |[lo, hi]: [f64; 2]| lo.is_finite() && hi.is_finite() && lo < hi;
        if !is_range(self.across) || !is_range(self.over) || (self.up == Up::Speed && self.over[0] < 0.0) {
            return malformed("map", format!("{:?}, {:?}", self.across, self.over), "two ranges of finite numbers");
        }
        Ok(())
    }

    /// ωx and the second input of each cell, row by row.
    fn places(&self) -> impl Iterator<Item = (f64, f64)> {
        let [first, end] = self.part;
        let row = move |row| {
            let up = value(self.over, row, self.rows);
            (0..self.columns).map(move |column| (value(self.across, column, self.columns), up))
        };
        (first..end).flat_map(row)
    }
}

/// Writes the cells of the part of `grid` that is asked for into `cells`.
pub(crate) fn map(thrown: &Thrown, grid: &Grid, cells: &mut Vec<u8>) -> Result<Counted, Error> {
    grid.check()?;
    match (&grid.spread, thrown.coin()) {
        (Some(spread), _) => probabilities(thrown, grid, part("spread", spread)?, cells)?,
        (None, Some(toss)) => outcomes(thrown, &toss, grid, cells)?,
        (None, None) => rigid_outcomes(thrown, grid, cells)?,
    }
    let count = |wanted: fn(u8) -> bool| cells.iter().filter(|cell| wanted(**cell)).count();
    Ok(Counted {
        cells: cells.len(),
        heads: count(|cell| cell == HEADS),
        tails: count(|cell| cell == 0),
        undecided: count(|cell| cell == UNDECIDED),
    })
}

/// The times of flight of each speed, as the speed and the gravity of a toss that is caught where it was thrown.
struct Flights {
    gravity: f64,
    /// The speed at which such a toss flies as long as that of the scene at `speed`.
    speed: Box<dyn Fn(f64) -> Result<f64, InputError>>,
    own: f64,
}

impl Flights {
    fn of(thrown: &Thrown) -> Result<Self, InputError> {
        let own = thrown.toss.launch.flight_time();
        let flight = thrown.toss.launch.time_of_flight();
        if let TimeOfFlight::Ballistic { speed, gravity } = flight {
            return Ok(Self { gravity, speed: Box::new(Ok), own: speed });
        }
        // With a gravity of 2 m/s² the speed is the time of flight.
        let time = move |speed| {
            let launch = Launch::new([0.0; 3], flight.with_speed(speed).ok_or(NO_SPEED)?)?;
            Ok(launch.flight_time())
        };
        Ok(Self { gravity: 2.0, speed: Box::new(time), own })
    }
}

const NO_SPEED: InputError =
    InputError::Missing { field: "speed [m/s]", expected: "a speed in place of the time of flight" };

fn outcomes(thrown: &Thrown, toss: &CoinToss, grid: &Grid, cells: &mut Vec<u8>) -> Result<(), Error> {
    let flights = Flights::of(thrown)?;
    let rate = toss.launch.rate();
    let mut columns: [Vec<f64>; 4] = Default::default();
    for (x, up) in grid.places() {
        let (z, speed) = match grid.up {
            Up::RateZ => (up, flights.own),
            Up::Speed => (rate.z, (flights.speed)(up)?),
        };
        for (column, number) in columns.iter_mut().zip([x, rate.y, z, speed]) {
            column.push(number);
        }
    }
    let [x, y, z, speeds] = &columns;
    let tosses = Tosses::new(toss.coin, toss.launch.attitude(), flights.gravity, [x, y, z], speeds)?;
    let mut found = vec![Outcome::Undecided; speeds.len()];
    Batch::new(tosses).outcomes(&mut found)?;
    cells.extend(found.into_iter().map(cell));
    Ok(())
}

fn rigid_outcomes(thrown: &Thrown, grid: &Grid, cells: &mut Vec<u8>) -> Result<(), Error> {
    let launch = &thrown.toss.launch;
    let rate = launch.rate();
    for (x, up) in grid.places() {
        let (z, time) = match grid.up {
            Up::RateZ => (up, launch.time_of_flight()),
            Up::Speed => (rate.z, launch.time_of_flight().with_speed(up).ok_or(NO_SPEED)?),
        };
        let here = Launch::new(Vector3::new(x, rate.y, z), time)?.with_attitude(launch.attitude());
        let body: Body = thrown.toss.body;
        cells.push(cell(certify(&Toss { body, launch: here })?.outcome()));
    }
    Ok(())
}

fn cell(outcome: Outcome) -> u8 {
    match outcome {
        Outcome::Heads => HEADS,
        Outcome::Tails => 0,
        Outcome::Undecided => UNDECIDED,
    }
}

/// P(heads) over a speed that is normal, in closed form.
fn probabilities(thrown: &Thrown, grid: &Grid, spread: f64, cells: &mut Vec<u8>) -> Result<(), Error> {
    let space = thrown.space()?;
    let sampler = Sampler::exact();
    let plan = if space.coin().is_none() || space.drop().is_some() {
        Plan::Sobol(sampling::Scrambled::new(64, 1))
    } else {
        Plan::ExactSpeed(Rest::Grid)
    };
    for (x, up) in grid.places() {
        let here = space.with_axis(Coordinate::RateX, Axis::fixed(x))?;
        let of = if grid.up == Up::RateZ { Coordinate::RateZ } else { Coordinate::Speed };
        let here = here.with_axis(of, Axis::fixed(up))?.with_spread(spread, &[Coordinate::Speed])?;
        let is_fixed = here.free().next().is_none();
        let found = sampler.sampled(&here, if is_fixed { Plan::Grid } else { plan })?;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 254")]
        let cell = (found.probability * f64::from(HEADS)).round() as u8;
        cells.push(if found.is_known() { cell } else { UNDECIDED });
    }
    Ok(())
}
