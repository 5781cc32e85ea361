//! `unfair-toss trace` prints the flight of a coin at equally spaced times, and draws it on request. LF below is the
//! laboratory frame, whose z axis points up.

use serde::Serialize;
use toss::defaults::TRACE_POINTS;
use toss::quantity::Dimension;
use toss::trace::{EnclosedPoint, MOST_POINTS, trace_enclosed, trace_enclosed_every, trace_every};
use toss::{Registry, Solver, Toss, TracePoint, trace};

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
    pub(crate) fn run(&self, registry: &Registry, input: &Input) -> Result<String, Failure> {
        self.series.validate()?;
        let (toss, backend) = self.flight.parts(registry)?;
        let points = self.flight(registry, &toss, backend.solver())?;
        let data = |format| match format {
            DataFormat::Csv => csv(&points),
            DataFormat::Json => output::json(input, &Points { solver: backend.solver().name(), points: &points }),
        };
        self.series.answer(data, || {
            // As many points as the motion needs, whatever number is printed.
            let drawn = trace(backend.solver(), &toss, chart::points_to_draw(&toss))?;
            let solver = backend.solver();
            let scheme = solver.stepping().map(|stepping| format!(", {}", stepping.scheme())).unwrap_or_default();
            let by = format!("solver {}{scheme}", solver.name());
            Ok(chart::flight(&drawn, &toss, solver.tilt(&toss)?.outcome(), (&self.flight.toss.words(), &by))?)
        })
    }

    /// The points, with their bounds if they are asked for.
    fn flight(&self, registry: &Registry, toss: &Toss, solver: &dyn Solver) -> Result<Vec<Point>, Failure> {
        // Who asks for a chart alone may not care for the number of points.
        let points = self.points.or(self.series.has_chart().then_some(TRACE_POINTS));
        let missing = || Failure::usage("points", "one of --points N and --dt H is needed, or --svg FILE");
        if self.prove {
            let solver = self.flight.solver.prover(registry)?;
            let enclosed = match (points, self.dt) {
                (_, Some(step)) => trace_enclosed_every(&solver, toss, step)?,
                (points, None) => trace_enclosed(&solver, toss, points.ok_or_else(missing)?)?,
            };
            let bounded = |EnclosedPoint { point, certificate }| Point {
                at: point,
                error_bound: Some(certificate.error_bound()),
                attitude_error_bound: Some(certificate.attitude_error_bound()),
            };
            return Ok(enclosed.into_iter().map(bounded).collect());
        }
        let flight = match (points, self.dt) {
            (_, Some(step)) => trace_every(solver, toss, step)?,
            (points, None) => trace(solver, toss, points.ok_or_else(missing)?)?,
        };
        let point = |at| Point { at, error_bound: None, attitude_error_bound: None };
        Ok(flight.into_iter().map(point).collect())
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
    let width = points[0].numbers().len();
    let heading = COLUMNS.split(',').take(width).collect::<Vec<_>>().join(",");
    output::csv_of_numbers(&heading, points.iter().map(Point::numbers))
}
