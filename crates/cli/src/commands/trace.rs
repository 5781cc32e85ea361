//! `unfair-toss trace` prints the flight of a coin at equally spaced times, and draws it on request. LF below is the
//! laboratory frame, whose z axis points up.

use std::io::Write;

use serde::Serialize;
use toss::defaults::TRACE_POINTS;
use toss::quantity::Dimension;
use toss::trace::{EnclosedPoint, MOST_POINTS, Times, enclosed_points, trace_points};
use toss::{Error, QuaternionSolver, Registry, Solver, Toss, TracePoint, trace};

use crate::Streams;
use crate::chart;
use crate::failure::Failure;
use crate::output::{self, DataFormat, Input, SeriesArgs};
use crate::quantity;
use crate::toss_args::FlightArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    flight: FlightArgs,
    /// Number of times, equally spaced, launch and landing included
    #[arg(long, value_name = "N", conflicts_with = "dt", allow_hyphen_values = true,
          value_parser = quantity::count::<usize>(2..=MOST_POINTS as u64))]
    points: Option<usize>,
    /// Step of time from launch on; the last time is the landing
    #[arg(long, value_name = "H", allow_hyphen_values = true, value_parser = quantity::of(Dimension::Time))]
    dt: Option<f64>,
    /// Bound the errors of cos θ and of the attitude at each time by integration: for the solver quaternion, whose scheme is
    /// then taylor by default
    #[arg(long)]
    prove: bool,
    #[command(flatten)]
    pub(crate) series: SeriesArgs,
}

/// A point, with `--prove` with the bounds of the errors of its cos θ and of its quaternion. As CSV its numbers stand in a line,
/// in the columns of [`COLUMNS`].
#[derive(Serialize)]
struct Point {
    #[serde(flatten)]
    at: TracePoint,
    #[serde(skip_serializing_if = "Option::is_none")]
    error_bound: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    attitude_error_bound: Option<f64>,
}

#[derive(Serialize)]
struct Points<'a> {
    solver: &'a str,
    points: &'a [Point],
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, input: &Input, streams: &mut Streams<'_>) -> Result<String, Failure> {
        self.series.validate()?;
        let toss = self.flight.toss.toss()?;
        let prover = self.prove.then(|| self.flight.solver.prover(registry)).transpose()?;
        let backend = self.flight.solver.backend_of_outcomes(registry)?;
        let solver = backend.solver();
        let mut points = self.points(&toss, solver, prover.as_ref())?;
        if self.series.is_csv_alone() {
            return print_csv(points, streams.out);
        }
        let points = points.by_ref().collect::<Result<Vec<_>, _>>()?;
        let data = |format| match format {
            DataFormat::Csv => csv(&points),
            DataFormat::Json => output::json(input, &Points { solver: solver.name(), points: &points }),
        };
        self.series.answer(data, || {
            // As many points as the motion needs, whatever number is printed.
            let drawn = trace(solver, &toss, chart::points_to_draw(&toss))?;
            let scheme = solver.stepping().map(|stepping| format!(", {}", stepping.scheme())).unwrap_or_default();
            let by = format!("solver {}{scheme}", solver.name());
            Ok(chart::flight(&drawn, &toss, solver.tilt(&toss)?.outcome(), (&self.flight.toss.words(), &by))?)
        })
    }

    /// The points, with their bounds if there is a `prover`. Each is computed when it is asked for.
    fn points<'a>(
        &self,
        toss: &'a Toss,
        solver: &'a dyn Solver,
        prover: Option<&'a QuaternionSolver>,
    ) -> Result<Box<dyn Iterator<Item = Result<Point, Error>> + 'a>, Failure> {
        // Who asks for a chart alone may not care for the number of points.
        let number = self.points.or(self.series.has_chart().then_some(TRACE_POINTS)).map(Times::Number);
        let missing = || Failure::usage("points", "one of --points N and --dt H is needed, or --svg FILE");
        let times = self.dt.map(Times::Every).or(number).ok_or_else(missing)?;
        let Some(prover) = prover else {
            let point = |at| Point { at, error_bound: None, attitude_error_bound: None };
            return Ok(Box::new(trace_points(solver, toss, times)?.map(move |at| at.map(point))));
        };
        let bounded = |EnclosedPoint { point, certificate }| Point {
            at: point,
            error_bound: Some(certificate.error_bound()),
            attitude_error_bound: Some(certificate.attitude_error_bound()),
        };
        Ok(Box::new(enclosed_points(prover, toss, times)?.map(move |point| point.map(bounded))))
    }
}

/// Prints the points as they are computed. What was computed before an error is printed before it, and a reader who has gone
/// wants no more.
fn print_csv(
    points: impl Iterator<Item = Result<Point, Error>>,
    out: &mut (dyn Write + Send),
) -> Result<String, Failure> {
    match write_csv(points.map(|point| point.map(|point| point.numbers())), out) {
        Ok(None) => Ok(String::new()),
        Ok(Some(error)) => Err(error.into()),
        Err(closed) if closed.kind() == std::io::ErrorKind::BrokenPipe => Ok(String::new()),
        Err(error) => Err(Failure::Print(error)),
    }
}

/// Writes rows of numbers below their heading, up to the first that could not be computed, whose error is returned.
fn write_csv(rows: impl Iterator<Item = Result<Vec<f64>, Error>>, out: impl Write) -> std::io::Result<Option<Error>> {
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(out);
    let mut failed = None;
    for (index, row) in rows.enumerate() {
        let row = match row {
            Ok(row) => row,
            Err(error) => {
                failed = Some(error);
                break;
            }
        };
        if index == 0 {
            writer.write_record(COLUMNS.split(',').take(row.len())).map_err(of_output)?;
        }
        writer.serialize(row).map_err(of_output)?;
    }
    writer.flush()?;
    Ok(failed)
}

/// The error of the output, which alone can fail: numbers are always CSV.
fn of_output(error: csv::Error) -> std::io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => std::io::Error::other(format!("{other:?}")),
    }
}

impl Point {
    /// The numbers of a line of CSV.
    fn numbers(&self) -> Vec<f64> {
        self.at.numbers().into_iter().chain(self.error_bound).chain(self.attitude_error_bound).collect()
    }
}

/// The columns of CSV: time (s), attitude quaternion, Euler angles (rad), the coin's normal and a vector fixed in its face (both
/// in LF), and cos θ, where θ is the angle between the normal and the vertical; with `--prove` also the bounds.
const COLUMNS: &str = "time,w,x,y,z,alpha,beta,gamma,normal_x,normal_y,normal_z,face_x,face_y,face_z,cos_tilt,error_bound,attitude_error_bound";

fn csv(points: &[Point]) -> String {
    let mut text = Vec::new();
    write_csv(points.iter().map(|point| Ok(point.numbers())), &mut text).expect("memory takes every byte");
    String::from_utf8(text).expect("numbers are UTF-8")
}
