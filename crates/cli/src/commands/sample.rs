//! `unfair-toss sample` prints single launches of a space and how each lands, as CSV or as lines of JSON, so that other
//! programs can work with them. With `-` it reads the launches from standard input instead.
//!
//! Rows are printed as they are solved, some thousands at a time, so that their number is not limited by the memory.

use std::io::Read;

use rayon::prelude::*;
use sampling::{Coordinate, Drawn, Plan, Scrambled, Space};
use toss::{Backend, Coin, Error, Registry, Toss};

use crate::Streams;
use crate::commands::sample_rows::{Given, Row, Writer};
use crate::failure::Failure;
use crate::launch_rows;
use crate::output::DataFormat;
use crate::quantity;
use crate::solver_args::SolverArgs;
use crate::space_args::{SpaceArgs, ThreadArgs, require_few};

/// Number of launches that are solved together.
const CHUNK: usize = 1 << 14;

/// Options that describe launches, which `-` reads instead.
const OF_A_SPACE: [&str; 14] = [
    "space", "rate_x", "rate_y", "rate_z", "turn", "wobble", "speed", "gravity", "tilt", "drop", "spread", "points",
    "method", "seed",
];

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// With - the launches are read from standard input: CSV with a heading, whose columns are wx, wy, wz, speed or time,
    /// and if wanted gravity, drop and tilt
    #[arg(value_name = "-", value_parser = ["-"], conflicts_with_all = OF_A_SPACE)]
    from: Option<String>,
    #[command(flatten)]
    space: SpaceArgs,
    /// Number of launches
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = quantity::count::<u64>(1..=u64::MAX))]
    points: Option<u64>,
    /// How launches are chosen [default: random]
    #[arg(long, value_enum)]
    method: Option<DrawArg>,
    /// Seed of the random launches or of the scramble [default: 1]
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = quantity::seed)]
    seed: Option<u64>,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    solver: SolverArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t = DataFormat::Csv)]
    format: DataFormat,
}

/// The method by which launches are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum DrawArg {
    /// A grid over the space, whose axes have their numbers of points
    Grid,
    /// Independent random launches
    Random,
    /// Sobol points with one scramble, which fill the space more evenly
    Sobol,
}

impl Args {
    /// Prints the rows as they come.
    pub(crate) fn run(&self, registry: &Registry, streams: &mut Streams<'_>) -> Result<String, Failure> {
        let backend = self.solver.backend(registry)?;
        let Streams { input, out, .. } = streams;
        let mut writer = Writer::new(&mut **out, self.format);
        let written = self.threads.run(|| match self.from {
            Some(_) => self.answer_input(&backend, &mut **input, &mut writer),
            None => self.answer_space(&backend, &mut writer),
        })?;
        if written.is_ok() {
            writer.head()?;
        }
        // What was solved before an error is printed before it.
        writer.finish()?;
        written?;
        Ok(String::new())
    }

    fn answer_input(&self, backend: &Backend, input: &mut dyn Read, writer: &mut Writer<'_>) -> Result<(), Failure> {
        let body = self.space.coin.given()?.unwrap_or(Coin::PAPER.into());
        let mut launches = launch_rows::read(input, body)?;
        loop {
            let chunk: Vec<Result<Given, Failure>> = launches.by_ref().take(CHUNK).collect();
            if chunk.is_empty() || writer.is_closed() {
                return Ok(());
            }
            let valid = chunk.iter().map_while(|row| row.as_ref().ok()).copied().collect::<Vec<Given>>();
            answer(backend, &valid, writer)?;
            chunk.into_iter().find_map(Result::err).map_or(Ok(()), Err)?;
        }
    }

    fn answer_space(&self, backend: &Backend, writer: &mut Writer<'_>) -> Result<(), Failure> {
        let space = self.space.space()?;
        let plan = self.plan()?;
        require_few(&backend.sampler(), plan.points(&space)?)?;
        self.space.require_grid_where_points_are(&space, |_| plan == Plan::Grid)?;
        let mut launches = space.drawn(plan)?;
        while !writer.is_closed() {
            let blocks = launches.by_ref().take(CHUNK.div_ceil(512));
            let chunk: Vec<Given> = blocks.flatten().map(|drawn| given(&space, &drawn)).collect();
            if chunk.is_empty() {
                return Ok(());
            }
            answer(backend, &chunk, writer)?;
        }
        Ok(())
    }

    fn plan(&self) -> Result<Plan, Failure> {
        let seed = self.seed.unwrap_or(1);
        let points =
            || self.points.ok_or_else(|| Failure::usage("points", "--points N is needed, the number of launches"));
        match self.method.unwrap_or(DrawArg::Random) {
            DrawArg::Random => Ok(Plan::Random { points: points()?, seed }),
            DrawArg::Sobol => Ok(Plan::Sobol(Scrambled { points: points()?, scrambles: 1, seed })),
            DrawArg::Grid if self.points.is_some() => {
                Err(Failure::usage("points", "--points: a grid takes its points from the axes, LO:HI:POINTS"))
            }
            DrawArg::Grid if self.seed.is_some() => {
                Err(Failure::usage("seed", "--seed: no launch of a grid is drawn at random"))
            }
            DrawArg::Grid => Ok(Plan::Grid),
        }
    }
}

/// A launch of `space` as a row.
fn given(space: &Space, drawn: &Drawn) -> Given {
    let value = |of: Coordinate| drawn.values[of as usize];
    Given {
        rate: [Coordinate::RateX, Coordinate::RateY, Coordinate::RateZ].map(value),
        speed: Some(value(Coordinate::Speed)),
        time: None,
        gravity: Some(value(Coordinate::Gravity)),
        drop: space.drop(),
        tilt: value(Coordinate::Tilt),
        toss: drawn.toss,
    }
}

/// Solves the launches, and writes them with their landings in their order.
///
/// # Errors
/// That of the first launch that fails, with its number. Those before it are written.
fn answer(backend: &Backend, launches: &[Given], writer: &mut Writer) -> Result<(), Failure> {
    let first = writer.rows();
    let one = |(given, index): (&Given, u64)| landed(backend, given, first + index);
    let numbered: Vec<(&Given, u64)> = launches.iter().zip(0..).collect();
    let rows: Vec<Result<Row, Error>> = numbered.into_par_iter().with_min_len(64).map(one).collect();
    let failed = rows.iter().position(Result::is_err).unwrap_or(rows.len());
    let mut rows = rows.into_iter();
    writer.write(&rows.by_ref().take(failed).filter_map(Result::ok).collect::<Vec<Row>>())?;
    rows.next().map_or(Ok(()), |row| row.map(drop).map_err(Failure::from))
}

/// A launch with its landing. Launches are solved one by one: cos θ of a batch is not right to the last bit, so that near
/// 0 its sign could contradict the outcome.
fn landed(backend: &Backend, given: &Given, index: u64) -> Result<Row, Error> {
    let toss: &Toss = &given.toss;
    let landed = backend.solver().tilt(toss).and_then(|tilt| Ok((tilt, backend.verdict(toss, tilt)?)));
    let failed = |source| Error::Launch { index, toss: Box::new(*toss), source };
    let (tilt, verdict) = landed.map_err(failed)?;
    Ok(Row::new(given, tilt.cos_tilt, verdict))
}
