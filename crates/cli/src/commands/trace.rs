//! `unfair-toss trace` prints the flight of a coin at equally spaced times, and draws it on request. LF below is the
//! laboratory frame, whose z axis points up.

use serde::Serialize;
use toss::{
    Dimension, EnclosedPoint, MOST_POINTS, Registry, Solver, Toss, TracePoint, trace, trace_enclosed,
    trace_enclosed_every, trace_every,
};

use crate::chart;
use crate::failure::Failure;
use crate::output::{self, DataFormat, Input, SeriesArgs, without_sign_of_zero};
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

/// One line: time (s), attitude quaternion, Euler angles (rad), the coin's normal and a vector fixed in its face (both
/// in LF), and cos θ, where θ is the angle between the normal and the vertical.
#[derive(Serialize)]
struct Line {
    time: f64,
    w: f64,
    x: f64,
    y: f64,
    z: f64,
    alpha: f64,
    beta: f64,
    gamma: f64,
    normal_x: f64,
    normal_y: f64,
    normal_z: f64,
    face_x: f64,
    face_y: f64,
    face_z: f64,
    cos_tilt: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    error_bound: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    attitude_error_bound: Option<f64>,
}

#[derive(Serialize)]
struct Point {
    time: f64,
    attitude: [f64; 4],
    alpha: f64,
    beta: f64,
    gamma: f64,
    normal: [f64; 3],
    face: [f64; 3],
    cos_tilt: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    error_bound: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    attitude_error_bound: Option<f64>,
}

/// A point, and the bounds of the errors of its cos θ and of its quaternion.
type Bounded = (TracePoint, Option<[f64; 2]>);

#[derive(Serialize)]
struct Answer<'a> {
    solver: &'a str,
    points: Vec<Point>,
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, input: &Input) -> Result<String, Failure> {
        self.series.validate()?;
        let (toss, backend) = self.flight.parts(registry)?;
        let flight = self.flight(registry, &toss, backend.solver())?;
        let data = |format| match format {
            DataFormat::Csv => output::csv(flight.iter().map(Line::from)),
            DataFormat::Json => {
                let points = flight.iter().map(Point::from).collect();
                output::json(input, &Answer { solver: backend.solver().name(), points })
            }
        };
        self.series.answer(data, || {
            // As many points as the motion needs, whatever number is printed.
            let drawn = trace(backend.solver(), &toss, chart::points_to_draw(&toss))?;
            Ok(chart::flight(&drawn, &toss, backend.solver().tilt(&toss)?.outcome())?)
        })
    }
}

impl Args {
    /// The points, with their bounds if they are asked for.
    fn flight(&self, registry: &Registry, toss: &Toss, solver: &dyn Solver) -> Result<Vec<Bounded>, Failure> {
        let missing = || Failure::usage("points", "one of --points N and --dt H is needed");
        if self.prove {
            let solver = self.flight.prover(registry)?;
            let enclosed = match (self.points, self.dt) {
                (_, Some(step)) => trace_enclosed_every(&solver, toss, step)?,
                (points, None) => trace_enclosed(&solver, toss, points.ok_or_else(missing)?)?,
            };
            let bounds = |EnclosedPoint { point, certificate }| {
                (point, Some([certificate.error_bound(), certificate.attitude_error_bound()]))
            };
            return Ok(enclosed.into_iter().map(bounds).collect());
        }
        let flight = match (self.points, self.dt) {
            (_, Some(step)) => trace_every(solver, toss, step)?,
            (points, None) => trace(solver, toss, points.ok_or_else(missing)?)?,
        };
        Ok(flight.into_iter().map(|point| (point, None)).collect())
    }
}

impl From<&Bounded> for Line {
    fn from((point, bounds): &Bounded) -> Self {
        let [w, x, y, z] = point.attitude.components().map(without_sign_of_zero);
        let [normal_x, normal_y, normal_z] = <[f64; 3]>::from(point.normal).map(without_sign_of_zero);
        let [face_x, face_y, face_z] = <[f64; 3]>::from(point.face).map(without_sign_of_zero);
        let angles = [point.angles.alpha, point.angles.beta, point.angles.gamma];
        let [alpha, beta, gamma] = angles.map(without_sign_of_zero);
        let [time, cos_tilt] = [point.time, point.cos_tilt].map(without_sign_of_zero);
        let (error_bound, attitude_error_bound) = (bounds.map(|[bound, _]| bound), bounds.map(|[_, bound]| bound));
        Self {
            time,
            w,
            x,
            y,
            z,
            alpha,
            beta,
            gamma,
            normal_x,
            normal_y,
            normal_z,
            face_x,
            face_y,
            face_z,
            cos_tilt,
            error_bound,
            attitude_error_bound,
        }
    }
}

impl From<&Bounded> for Point {
    fn from((point, bounds): &Bounded) -> Self {
        Self {
            time: point.time,
            attitude: point.attitude.components(),
            alpha: point.angles.alpha,
            beta: point.angles.beta,
            gamma: point.angles.gamma,
            normal: point.normal.into(),
            face: point.face.into(),
            cos_tilt: point.cos_tilt,
            error_bound: bounds.map(|[bound, _]| bound),
            attitude_error_bound: bounds.map(|[_, bound]| bound),
        }
    }
}
