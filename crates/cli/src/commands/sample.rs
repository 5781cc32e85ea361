//! `unfair-toss sample` prints single launches of a space and how each lands, as CSV or as lines of JSON, so that other
//! programs can work with them. With `-` it reads the launches from standard input instead.
//!
//! Rows are printed as they are solved, some thousands at a time, so that their number is not limited by the memory. Every
//! mistake of a row that was read is reported with its line and column, since such files have many lines.

use std::io::{Read, Write};

use csv::StringRecord;
use dynamics::Thrown;
use dynamics::thrown::Field;
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use rayon::prelude::*;
use sampling::{Drawn, Method, Plan, Scrambled, Space};
use serde::Serialize;
use toss::defaults::SEED;
use toss::{Backend, Body, Error, InputError, Registry, Toss, Verdict};

use crate::Streams;
use crate::failure::Failure;
use crate::json::{plain_json, without_sign_of_zero};
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
    /// With - the launches are read from standard input: CSV with a heading, whose columns are wx, wy, wz or turn and
    /// wobble, speed or time, and if wanted gravity, drop and tilt
    #[arg(value_name = "-", value_parser = ["-"], conflicts_with_all = OF_A_SPACE)]
    from: Option<String>,
    #[command(flatten)]
    space: SpaceArgs,
    /// Number of launches
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = quantity::count::<u64>(1..=u64::MAX))]
    points: Option<u64>,
    /// How launches are chosen, sobol with one scramble [default: random]
    #[arg(long, value_parser = quantity::method(&[Method::Grid, Method::Random, Method::Sobol]))]
    method: Option<Method>,
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = quantity::seed,
          help = format!("Seed of the random launches or of the scramble [default: {SEED}]"))]
    seed: Option<u64>,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    solver: SolverArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t = DataFormat::Csv)]
    format: DataFormat,
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
        let mut launches = read(input, self.space.coin.body()?)?;
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
        let seed = self.seed.unwrap_or(SEED);
        let points =
            || self.points.ok_or_else(|| Failure::usage("points", "--points N is needed, the number of launches"));
        match self.method.unwrap_or(Method::Random) {
            Method::Random => Ok(Plan::Random { points: points()?, seed }),
            Method::Sobol => Ok(Plan::Sobol(Scrambled { points: points()?, scrambles: 1, seed })),
            Method::Grid if self.points.is_some() => {
                Err(Failure::usage("points", "--points: a grid takes its points from the axes, LO:HI:POINTS"))
            }
            Method::Grid if self.seed.is_some() => {
                Err(Failure::usage("seed", "--seed: no launch of a grid is drawn at random"))
            }
            _ => Ok(Plan::Grid),
        }
    }
}

/// A launch of `space`.
fn given(space: &Space, drawn: &Drawn) -> Given {
    let [wx, wy, wz, speed, gravity, tilt] = drawn.values;
    let (speed, gravity, drop) = (Some(speed), Some(gravity), space.drop());
    Given { row: Row { wx, wy, wz, speed, gravity, drop, tilt, ..Row::default() }, toss: drawn.toss }
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
    Ok(given.row.landed(toss, tilt.cos_tilt, verdict))
}

/// A launch with its row, in which what belongs to its landing is not filled in yet.
#[derive(Debug, Clone, Copy)]
struct Given {
    row: Row,
    toss: Toss,
}

/// A row: body rate (rad/s), speed (m/s) or time of flight (s), gravity (m/s²), drop (m) and tilt (rad), all as they were
/// given; time of flight (s), cos θ at landing, outcome, and whether it is proven.
#[derive(Debug, Clone, Copy, Default, Serialize)]
struct Row {
    wx: f64,
    wy: f64,
    wz: f64,
    speed: Option<f64>,
    time: Option<f64>,
    gravity: Option<f64>,
    drop: Option<f64>,
    tilt: f64,
    flight_time: f64,
    cos_tilt: f64,
    outcome: &'static str,
    certified: bool,
}

impl Row {
    fn landed(self, toss: &Toss, cos_tilt: f64, verdict: Verdict) -> Self {
        let plain = |value: Option<f64>| value.map(without_sign_of_zero);
        Self {
            wx: without_sign_of_zero(self.wx),
            wy: without_sign_of_zero(self.wy),
            wz: without_sign_of_zero(self.wz),
            speed: plain(self.speed),
            time: plain(self.time),
            drop: plain(self.drop),
            tilt: without_sign_of_zero(self.tilt),
            flight_time: without_sign_of_zero(toss.launch.flight_time()),
            cos_tilt: without_sign_of_zero(cos_tilt),
            outcome: verdict.outcome().name(),
            certified: verdict.is_proven(),
            ..self
        }
    }
}

/// Writes rows to standard output as they come.
struct Writer<'a> {
    out: &'a mut (dyn Write + Send),
    format: DataFormat,
    rows: u64,
    is_closed: bool,
}

impl<'a> Writer<'a> {
    fn new(out: &'a mut (dyn Write + Send), format: DataFormat) -> Self {
        Self { out, format, rows: 0, is_closed: false }
    }

    /// Number of rows that were written.
    fn rows(&self) -> u64 {
        self.rows
    }

    /// Whether the reader of standard output has gone, so that no more rows are wanted.
    fn is_closed(&self) -> bool {
        self.is_closed
    }

    fn write(&mut self, rows: &[Row]) -> Result<(), Failure> {
        let text = match self.format {
            DataFormat::Csv => self.csv(rows),
            DataFormat::Json => rows.iter().map(|row| plain_json(row) + "\n").collect::<String>().into_bytes(),
        };
        self.rows += rows.len() as u64;
        self.print(&text)
    }

    /// Prints the heading of a table without rows.
    fn head(&mut self) -> Result<(), Failure> {
        if self.rows > 0 || self.format != DataFormat::Csv {
            return Ok(());
        }
        let table = self.csv(&[Row::default()]);
        let heading = table.split_inclusive(|byte| *byte == b'\n').next().unwrap_or_default();
        self.print(heading)
    }

    /// Ends the output.
    fn finish(&mut self) -> Result<(), Failure> {
        whole_file::unless_closed(self.out.flush()).map_err(Failure::Print)
    }

    fn csv(&self, rows: &[Row]) -> Vec<u8> {
        let mut writer = csv::WriterBuilder::new().has_headers(self.rows == 0).from_writer(Vec::new());
        for row in rows {
            writer.serialize(row).expect("a row of plain data always fits into memory");
        }
        writer.into_inner().expect("memory takes every byte")
    }

    fn print(&mut self, text: &[u8]) -> Result<(), Failure> {
        match self.out.write_all(text) {
            Err(closed) if closed.kind() == std::io::ErrorKind::BrokenPipe => self.is_closed = true,
            written => written.map_err(Failure::Print)?,
        }
        Ok(())
    }
}

/// The columns that describe a launch.
const COLUMNS: [Field; 10] = [
    Field::RateX,
    Field::RateY,
    Field::RateZ,
    Field::Turn,
    Field::Wobble,
    Field::Speed,
    Field::Time,
    Field::Gravity,
    Field::Drop,
    Field::Tilt,
];

/// The columns of an answer, which may be there and are passed over, so that an output can be read again.
const ANSWERS: [&str; 4] = ["flight_time", "cos_tilt", "outcome", "certified"];

/// The launches of `body` in a text of CSV.
///
/// # Errors
/// [`Failure::Text`] for a heading that is unknown, missing or there twice. Each launch has its own errors.
fn read<R: Read>(text: R, body: Body) -> Result<impl Iterator<Item = Result<Given, Failure>>, Failure> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text);
    let columns = columns(reader.headers().map_err(|error| unreadable(&error))?)?;
    Ok(reader.into_records().map(move |record| {
        let record = record.map_err(|error| unreadable(&error))?;
        let line = record.position().map_or(0, csv::Position::line);
        launch(&record, &columns, body).map_err(|error| {
            let is_at_fault = |column: &Option<Field>| {
                column.is_some_and(|of| [of.info().name, of.info().label].contains(&error.field()))
            };
            at(line, columns.iter().position(is_at_fault).unwrap_or(columns.len() - 1), error.to_string())
        })
    }))
}

/// The field of each heading; `None` for what is passed over.
fn columns(headings: &StringRecord) -> Result<Vec<Option<Field>>, Failure> {
    let mut columns = Vec::new();
    for (column, heading) in headings.iter().enumerate() {
        let known = Field::named(heading).ok().filter(|field| COLUMNS.contains(field));
        if known.is_none() && !ANSWERS.contains(&heading) {
            let known = COLUMNS.map(|field| field.info().name).join(", ");
            return Err(at(1, column, format!("column '{heading}' is unknown; known: {known}")));
        }
        let is_twice = if known.is_some() {
            columns.contains(&known)
        } else {
            headings.iter().take(column).any(|other| other == heading)
        };
        if is_twice {
            let heading = known.map_or(heading, |field| field.info().name);
            return Err(at(1, column, format!("column '{heading}' is there twice")));
        }
        columns.push(known);
    }
    let lacks = |field: &Field| !columns.contains(&Some(*field));
    let of_precession = [Field::Turn, Field::Wobble];
    let axes = [Field::RateX, Field::RateY, Field::RateZ];
    let rate = if of_precession.iter().all(lacks) { &axes[..] } else { &of_precession };
    let missing = rate.iter().find(|field| lacks(field)).map(|field| field.info().name);
    let has_no_time = [Field::Speed, Field::Time].iter().all(lacks);
    match missing.or(has_no_time.then_some("speed or time")) {
        Some(name) => Err(at(1, columns.len(), format!("column {name} is missing"))),
        None => Ok(columns),
    }
}

/// The launch in a record. Its numbers are converted to SI units, in which they are printed, so that an output that is read
/// again has the same answers.
fn launch(record: &StringRecord, columns: &[Option<Field>], body: Body) -> Result<Given, InputError> {
    let mut thrown = Thrown::default();
    for (column, cell) in columns.iter().zip(record).filter(|(_, cell)| !cell.is_empty()) {
        column.map_or(Ok(()), |field| thrown.set(field, cell))?;
    }
    let thrown = thrown.in_si();
    let launch = thrown.launch(&body, thrown.time_of_flight()?)?;
    let si = |field| thrown.one(field).map(dynamics::quantity::Given::si);
    let [wx, wy, wz] = launch.rate().into();
    let speed = si(Field::Speed);
    let gravity = speed.map(|_| si(Field::Gravity).unwrap_or(DEFAULT_GRAVITY));
    let (time, drop, tilt) = (si(Field::Time), si(Field::Drop), si(Field::Tilt).unwrap_or(0.0));
    let row = Row { wx, wy, wz, speed, time, gravity, drop, tilt, ..Row::default() };
    Ok(Given { row, toss: Toss { body, launch } })
}

/// The error of a place in the text: a line from 1, and a column of the table from 0.
fn at(line: u64, column: usize, message: String) -> Failure {
    let line = usize::try_from(line).unwrap_or(usize::MAX);
    Failure::Text { path: "standard input".to_owned(), source: Error::Text { line, column: column + 1, message } }
}

/// The error of a text that is no table.
fn unreadable(error: &csv::Error) -> Failure {
    let line = error.position().map_or(1, csv::Position::line);
    let message = match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("{len} cells, but the heading has {expected_len}")
        }
        _ => error.to_string(),
    };
    at(line, 0, message)
}
