//! `unfair-toss trace` prints the flight of a coin at equally spaced times, and draws it on request. LF below is the
//! laboratory frame, whose z axis points up.

use std::io::Write;

use serde::Serialize;
use toss::defaults::TRACE_POINTS;
use toss::quantity::Dimension;
use toss::trace::{EnclosedPoint, MOST_POINTS, Times, trace_enclosed, trace_points};
use toss::{Error, QuaternionSolver, Registry, Solver, Toss, TracePoint, trace};

use crate::Streams;
use crate::chart;
use crate::failure::Failure;
use crate::json::plain_json;
use crate::output::{self, Asked, DataFormat, SeriesArgs};
use crate::quantity;
use crate::toss_args::FlightArgs;
use crate::watch::BudgetArgs;

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
    budget: BudgetArgs,
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
    points: [Point; 0],
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, asked: &Asked, streams: &mut Streams<'_>) -> Result<String, Failure> {
        self.series.validate()?;
        let toss = self.flight.toss.toss()?;
        let prover = self.prove.then(|| self.flight.solver.prover(registry)).transpose()?;
        let backend = self.flight.solver.backend_of_outcomes(registry)?;
        let solver = backend.solver();
        let points = self.points(&toss, solver, prover.as_ref())?;
        let chart = self.series.chart.drawn(|| {
            // As many points as the motion needs, whatever number is printed.
            let drawn = trace(solver, &toss, chart::points_to_draw(&toss))?;
            let scheme = solver.stepping().map(|stepping| format!(", {}", stepping.scheme())).unwrap_or_default();
            let by = format!("solver {}{scheme}", solver.name());
            Ok(chart::flight(&drawn, &toss, solver.tilt(&toss)?.outcome(), (&self.flight.toss.words(), &by))?)
        })?;
        if let Some(chart) = chart {
            return Ok(chart);
        }
        asked.watch.show_beside_rows(self.points.map(|points| points as u64), "points");
        let rows = Rows { format: self.series.format(), solver: solver.name(), asked };
        let closed_or = |printed: std::io::Result<()>| whole_file::unless_closed(printed).map_err(Failure::print);
        let mut failed = None;
        closed_or(rows.print(points, streams.out, &mut failed))?;
        failed.map_or_else(|| Ok(String::new()), Err)
    }

    /// The points, with their bounds if there is a `prover`. Each is computed when it is asked for.
    fn points<'a>(
        &self,
        toss: &'a Toss,
        solver: &'a dyn Solver,
        prover: Option<&'a QuaternionSolver>,
    ) -> Result<Box<dyn Iterator<Item = Result<Point, Error>> + 'a>, Failure> {
        // Who asks for a chart alone may not care for the number of points.
        let number = self.points.or(self.series.chart.is_some().then_some(TRACE_POINTS)).map(Times::Number);
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
        Ok(Box::new(trace_enclosed(prover, toss, times)?.map(move |point| point.map(bounded))))
    }
}

/// How the points are printed: each as soon as it is computed.
struct Rows<'a> {
    format: DataFormat,
    solver: &'a str,
    asked: &'a Asked,
}

impl Rows<'_> {
    /// Prints the points that are computed until one has `failed` or it is time to end.
    fn print(
        &self,
        points: impl Iterator<Item = Result<Point, Error>>,
        out: &mut (dyn Write + Send),
        failed: &mut Option<Failure>,
    ) -> std::io::Result<()> {
        let watch = &self.asked.watch;
        let goes_on = points.take_while(|_| !watch.is_over()).inspect(|_| watch.count(1));
        let mut known = goes_on.map_while(|point| point.map_err(|error| *failed = Some(error.into())).ok());
        let Some(first) = known.next() else {
            drop(known);
            failed.get_or_insert(Error::Ended.into());
            return Ok(());
        };
        let points = std::iter::once(first).chain(known);
        match self.format {
            DataFormat::Csv => write_csv(points, &mut *out)?,
            DataFormat::Json => {
                self.write_json(points, &mut *out)?;
                // Where the points end, the object says why.
                if let Some(failure) = failed.take() {
                    write!(out, ",\"error\":{}", plain_json(&failure.json()))?;
                    *failed = Some(failure.said());
                } else if let Some(ended) = watch.ended() {
                    write!(out, ",\"ended\":\"{}\"", ended.name())?;
                }
                writeln!(out, "}}")?;
            }
        }
        out.flush()
    }

    /// The object up to the end of its points.
    fn write_json(&self, points: impl Iterator<Item = Point>, out: &mut (dyn Write + Send)) -> std::io::Result<()> {
        let whole = output::json(self.asked, &Points { solver: self.solver, points: [] });
        let start = whole.split_inclusive("\"points\":[").next().unwrap_or_default();
        write!(out, "{start}")?;
        for (index, point) in points.enumerate() {
            write!(out, "{}{}", if index == 0 { "" } else { "," }, plain_json(&point))?;
        }
        write!(out, "]")
    }
}

/// Writes rows of numbers below their heading.
fn write_csv(points: impl Iterator<Item = Point>, out: impl Write) -> std::io::Result<()> {
    let mut writer = csv::WriterBuilder::new().has_headers(false).from_writer(out);
    for (index, row) in points.map(|point| point.numbers()).enumerate() {
        if index == 0 {
            writer.write_record(COLUMNS.split(',').take(row.len())).map_err(of_output)?;
        }
        writer.serialize(row).map_err(of_output)?;
    }
    writer.flush()
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
