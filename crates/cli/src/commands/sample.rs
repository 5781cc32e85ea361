//! `unfair-toss sample` prints single launches of a space and how each lands, as CSV or as lines of JSON, so that other
//! programs can work with them. With `-` it reads the launches from standard input instead.
//!
//! Rows are printed as they are solved, as many at a time as take a moment, so that their number is not limited by the memory. A launch
//! that was read is answered before the next one is waited for, so that another program can ask one after the other. Every
//! mistake of a row that was read is reported with its line and column, since such files have many lines.

use std::io::{Read, Write};
use std::time::{Duration, Instant};

use dynamics::Thrown;
use dynamics::thrown::Field;
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use rayon::prelude::*;
use sampling::{Drawn, Method, Plan, Scrambled};
use serde::Serialize;
use toss::defaults::SEED;
use toss::{Backend, Body, Error, InputError, Registry, Toss};
use whole_file::{Row as Cells, Table, TableError};

use crate::Streams;
use crate::failure::Failure;
use crate::json::{plain_json, without_sign_of_zero};
use crate::output::{Asked, DataFormat};
use crate::quantity;
use crate::solver_args::SolverArgs;
use crate::space_args::{SpaceArgs, ThreadArgs, require_few};
use crate::watch::{BudgetArgs, Watch};

/// The largest number of launches that are solved together, and the first.
const CHUNK: usize = 1 << 14;
const FIRST_CHUNK: usize = 16;

/// More launches are solved together as long as they take less time than this.
const SOON: Duration = Duration::from_millis(50);

/// Options that describe launches, which `-` reads instead.
const OF_A_SPACE: [&str; 14] = [
    "space", "rate_x", "rate_y", "rate_z", "turn", "psi", "speed", "gravity", "tilt", "drop", "spread", "points",
    "method", "seed",
];

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// With - the launches are read from standard input: CSV with a heading, whose columns are wx, wy, wz or turn and
    /// psi, speed or time, and if wanted gravity, drop and tilt
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
    #[command(flatten)]
    budget: BudgetArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t = DataFormat::Csv)]
    format: DataFormat,
}

impl Args {
    /// Prints the rows as they come.
    pub(crate) fn run(&self, registry: &Registry, asked: &Asked, streams: &mut Streams<'_>) -> Result<String, Failure> {
        let backend = self.solver.backend(registry)?;
        let Streams { input, out, .. } = streams;
        let mut writer = Writer::new(&mut **out, self.format);
        let written = self.threads.run(|| match self.from {
            Some(_) => self.answer_input(&backend, &mut **input, &mut writer, &asked.watch),
            None => self.answer_space(&backend, &mut writer, &asked.watch),
        })?;
        if written.is_ok() {
            writer.head()?;
        }
        // What was solved before an error is printed before it.
        writer.finish()?;
        written?;
        Ok(String::new())
    }

    fn answer_input(
        &self,
        backend: &Backend,
        input: &mut dyn Read,
        writer: &mut Writer<'_>,
        watch: &Watch,
    ) -> Result<(), Failure> {
        let body = self.space.coin.body()?;
        let mut table = Table::new(input).map_err(wrong)?;
        let columns = columns(table.heading())?;
        while !writer.is_closed && !watch.is_over() {
            let mut chunk = Vec::new();
            // Up to the last launch that has arrived.
            let end = loop {
                match table.row().map_err(wrong).and_then(|row| row.map(|row| launch(row, &columns, body)).transpose())
                {
                    Ok(Some(launch)) => chunk.push(launch),
                    Ok(None) => break Some(Ok(())),
                    Err(failure) => break Some(Err(failure)),
                }
                if chunk.len() == CHUNK || !table.has_row() {
                    break None;
                }
            };
            answer(backend, &chunk, writer)?;
            if let Some(end) = end {
                return end;
            }
            writer.finish()?;
        }
        Ok(())
    }

    fn answer_space(&self, backend: &Backend, writer: &mut Writer<'_>, watch: &Watch) -> Result<(), Failure> {
        let space = self.space.space()?;
        let plan = self.plan()?;
        let points = plan.points(&space)?;
        require_few(&backend.sampler(), points)?;
        self.space.require_grid_where_points_are(&space, |_| plan == Plan::Grid)?;
        watch.show_beside_rows(Some(points), "launches");
        let (mut launches, mut size) = (space.drawn(plan)?.flatten(), FIRST_CHUNK);
        while !writer.is_closed && !watch.is_over() {
            let began = Instant::now();
            let chunk: Vec<Given> = launches.by_ref().take(size).map(|drawn| given(&drawn)).collect();
            if chunk.is_empty() {
                return Ok(());
            }
            answer(backend, &chunk, writer)?;
            watch.count(chunk.len() as u64);
            if began.elapsed() < SOON {
                size = CHUNK.min(2 * size);
            }
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

/// A launch of a space.
fn given(drawn: &Drawn) -> Given {
    let [wx, wy, wz, speed, gravity, tilt] = drawn.values.map(without_sign_of_zero);
    let (speed, gravity) = (Some(speed), Some(gravity));
    let drop = drawn.toss.launch.time_of_flight().drop().map(without_sign_of_zero);
    Given { row: Row { wx, wy, wz, speed, gravity, drop, tilt, ..Row::default() }, toss: drawn.toss }
}

/// Solves the launches, and writes them with their landings in their order.
///
/// # Errors
/// That of the first launch that fails, with its number. Those before it are written.
fn answer(backend: &Backend, launches: &[Given], writer: &mut Writer) -> Result<(), Failure> {
    let first = writer.rows;
    let one = |(given, index): (&Given, u64)| landed(backend, given, first + index);
    let numbered: Vec<(&Given, u64)> = launches.iter().zip(0..).collect();
    let rows: Vec<Result<Row, Error>> =
        numbered.into_par_iter().with_min_len(launches.len().div_ceil(256)).map(one).collect();
    let failed = rows.iter().position(Result::is_err).unwrap_or(rows.len());
    let mut rows = rows.into_iter();
    writer.write(&rows.by_ref().take(failed).filter_map(Result::ok).collect::<Vec<Row>>())?;
    rows.next().map_or(Ok(()), |row| row.map(drop).map_err(Failure::from))
}

/// A launch with its landing. Launches are solved one by one: cos θ of a batch is not right to the last bit, so that near
/// 0 its sign could contradict the outcome.
fn landed(backend: &Backend, given: &Given, index: u64) -> Result<Row, Error> {
    let toss: &Toss = &given.toss;
    let failed = |source| Error::Launch { index, toss: Box::new(*toss), source };
    let (tilt, verdict) = backend.landed(toss).map_err(failed)?;
    Ok(Row {
        flight_time: without_sign_of_zero(toss.launch.flight_time()),
        cos_tilt: without_sign_of_zero(tilt.cos_tilt),
        outcome: verdict.outcome().name(),
        certified: verdict.is_proven(),
        ..given.row
    })
}

/// A launch with its row, in which what belongs to its landing is not filled in yet.
#[derive(Debug, Clone, Copy)]
struct Given {
    row: Row,
    toss: Toss,
}

/// A row: body rate (rad/s), speed (m/s) or time of flight (s), gravity (m/s²), drop (m) and tilt (rad), all as they were
/// given, without signs of 0; time of flight (s), cos θ at landing, outcome, and whether it is proven.
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

/// Writes rows to standard output as they come.
struct Writer<'a> {
    out: &'a mut (dyn Write + Send),
    format: DataFormat,
    /// Number of rows that were written.
    rows: u64,
    /// Whether the reader of standard output has gone, so that no more rows are wanted.
    is_closed: bool,
}

impl<'a> Writer<'a> {
    fn new(out: &'a mut (dyn Write + Send), format: DataFormat) -> Self {
        Self { out, format, rows: 0, is_closed: false }
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

    /// Lets the reader of standard output have all that was written.
    fn finish(&mut self) -> Result<(), Failure> {
        whole_file::unless_closed(self.out.flush()).map_err(Failure::print)
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
            written => written.map_err(Failure::print)?,
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
    Field::Psi,
    Field::Speed,
    Field::Time,
    Field::Gravity,
    Field::Drop,
    Field::Tilt,
];

/// The columns of an answer, which may be there and are passed over, so that an output can be read again.
const ANSWERS: [&str; 4] = ["flight_time", "cos_tilt", "outcome", "certified"];

/// The field of each heading; `None` for what is passed over.
fn columns(heading: &Cells) -> Result<Vec<Option<Field>>, Failure> {
    let at = |column, message| wrong(TableError { line: heading.line(), column: column + 1, message });
    let mut columns = Vec::new();
    let names: Vec<String> = heading.cells().map(str::to_lowercase).collect();
    for (column, (name, written)) in names.iter().zip(heading.cells()).enumerate() {
        let known = Field::named(name).ok().filter(|field| COLUMNS.contains(field));
        if known.is_none() && !ANSWERS.contains(&name.as_str()) {
            let known = COLUMNS.map(|field| field.info().name).join(", ");
            return Err(at(column, format!("column '{written}' is unknown; known: {known}")));
        }
        let is_twice = if known.is_some() { columns.contains(&known) } else { names[..column].contains(name) };
        if is_twice {
            let name = known.map_or(name.as_str(), |field| field.info().name);
            return Err(at(column, format!("column '{name}' is there twice")));
        }
        columns.push(known);
    }
    let lacks = |field: &Field| !columns.contains(&Some(*field));
    let of_precession = [Field::Turn, Field::Psi];
    let axes = [Field::RateX, Field::RateY, Field::RateZ];
    let rate = if of_precession.iter().all(lacks) { &axes[..] } else { &of_precession };
    let missing = rate.iter().find(|field| lacks(field)).map(|field| field.info().name);
    let has_no_time = [Field::Speed, Field::Time].iter().all(lacks);
    match missing.or(has_no_time.then_some("speed or time")) {
        Some(name) => Err(at(columns.len(), format!("column {name} is missing"))),
        None => Ok(columns),
    }
}

/// The launch in a row.
fn launch(row: &Cells, columns: &[Option<Field>], body: Body) -> Result<Given, Failure> {
    thrown(row, columns, body).map_err(|error| {
        let is_at_fault = |column: &Option<Field>| {
            column.is_some_and(|of| [of.info().name, of.info().label].contains(&error.field()))
        };
        let column = 1 + columns.iter().position(is_at_fault).unwrap_or(columns.len() - 1);
        wrong(TableError { line: row.line(), column, message: error.to_string() })
    })
}

/// The same. Its numbers are converted to SI units, in which they are printed, so that an output that is read again has the
/// same answers.
fn thrown(row: &Cells, columns: &[Option<Field>], body: Body) -> Result<Given, InputError> {
    let mut thrown = Thrown::default();
    for (column, cell) in columns.iter().zip(row.cells()).filter(|(_, cell)| !cell.is_empty()) {
        column.map_or(Ok(()), |field| thrown.set(field, cell))?;
    }
    let thrown = thrown.in_si();
    let launch = thrown.launch(&body, thrown.time_of_flight()?)?;
    let si = |field| thrown.one(field).map(|given| without_sign_of_zero(given.si()));
    let [wx, wy, wz] = <[f64; 3]>::from(launch.rate()).map(without_sign_of_zero);
    let speed = si(Field::Speed);
    let gravity = speed.map(|_| si(Field::Gravity).unwrap_or(DEFAULT_GRAVITY));
    let (time, drop, tilt) = (si(Field::Time), si(Field::Drop), si(Field::Tilt).unwrap_or(0.0));
    let row = Row { wx, wy, wz, speed, time, gravity, drop, tilt, ..Row::default() };
    Ok(Given { row, toss: Toss { body, launch } })
}

fn wrong(error: TableError) -> Failure {
    Failure::table("standard input", error)
}
