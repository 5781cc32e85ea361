//! A flight to look at: a trace along it, then one frame at a time. Both are numbers in memory, without JSON, because an
//! animation reads them sixty times a second.

use serde::Serialize;
use toss::{Error, ExactMotion, InputError, SolveError, Toss, Vector3};

use crate::thrown::Thrown;

/// The numbers of a frame: attitude w, x, y, z (BF to LF); n, a vector in the face (the body's x axis) and the angular
/// velocity (LF, rad/s), of three each; cos θ; height above the launch (m).
pub(crate) const FRAME: usize = 15;

/// The numbers of a point of the trace: time (s), cos θ, height (m), n and the vector in the face (LF), ωx, ωy, ωz (BF,
/// rad/s).
pub(crate) const POINT: usize = 12;

/// The most points of a trace.
const MOST_POINTS: u32 = 20_000;

/// A flight whose motion is prepared.
#[derive(Debug)]
pub(crate) struct Flight {
    toss: Toss,
    motion: ExactMotion,
}

/// What stays the same during the flight.
#[derive(Debug, Serialize)]
pub(crate) struct Course {
    flight_time: f64,
    points: u32,
    /// The direction of the angular momentum S (LF); `None` for a body at rest.
    momentum: Option<[f64; 3]>,
    /// The largest height above the launch (m).
    apex: f64,
    /// How far below the launch the flight ends (m).
    drop: f64,
    /// The larger phase of the motion at the landing, in turns.
    turns: f64,
    /// I1, I2, I3 about x, y, z (kg m²).
    moments: [f64; 3],
}

impl Flight {
    pub(crate) fn new(thrown: &Thrown) -> Self {
        Self { toss: thrown.toss, motion: ExactMotion::new(&thrown.toss) }
    }

    /// The trace at `points` equally spaced times, appended to `numbers`.
    ///
    /// # Errors
    /// [`InputError`] for fewer than 2 or more than [`MOST_POINTS`] points, and a phase that is too large.
    pub(crate) fn trace(&self, points: u32, numbers: &mut Vec<f64>) -> Result<Course, Error> {
        if !(2..=MOST_POINTS).contains(&points) {
            let expected = "2 to 20000";
            return Err(InputError::Malformed { field: "points", value: points.to_string(), expected }.into());
        }
        let phase = self.motion.phase(self.toss.launch.time_of_flight())?;
        let flight_time = self.toss.launch.flight_time();
        for index in 0..points {
            let time = flight_time * (f64::from(index) / f64::from(points - 1));
            numbers.extend(self.point(time)?);
        }
        let flight = self.toss.launch.time_of_flight();
        let apex = flight.throw().map_or(0.0, |[speed, gravity]| speed * speed / (2.0 * gravity));
        let drop = flight.drop().unwrap_or(0.0);
        let momentum = self.momentum().map(<[f64; 3]>::from);
        let moments = self.toss.body.moments().unwrap_or_else(|| self.toss.body.principal_moments());
        Ok(Course { flight_time, points, momentum, apex, drop, turns: phase / std::f64::consts::TAU, moments })
    }

    /// The frame at `time` (s).
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    pub(crate) fn frame(&self, time: f64) -> Result<[f64; FRAME], SolveError> {
        let state = self.motion.state(time)?;
        let [w, x, y, z] = state.attitude.components();
        let (normal, face) = (state.attitude.normal(), state.attitude.body_to_lab(&Vector3::x()));
        let rate = state.attitude.body_to_lab(&state.rate);
        let (cos_tilt, height) = (self.motion.cos_tilt(time)?, self.height(time));
        Ok([w, x, y, z, normal.x, normal.y, normal.z, face.x, face.y, face.z, rate.x, rate.y, rate.z, cos_tilt, height])
    }

    fn point(&self, time: f64) -> Result<[f64; POINT], SolveError> {
        let state = self.motion.state(time)?;
        let (normal, face) = (state.attitude.normal(), state.attitude.body_to_lab(&Vector3::x()));
        let (cos_tilt, rate) = (self.motion.cos_tilt(time)?, state.rate);
        Ok([
            time,
            cos_tilt,
            self.height(time),
            normal.x,
            normal.y,
            normal.z,
            face.x,
            face.y,
            face.z,
            rate.x,
            rate.y,
            rate.z,
        ])
    }

    /// The height above the launch (m); 0 if the time of flight was given, which says nothing of it.
    fn height(&self, time: f64) -> f64 {
        let throw = self.toss.launch.time_of_flight().throw();
        throw.map_or(0.0, |[speed, gravity]| (speed - 0.5 * gravity * time) * time)
    }

    /// The direction of the angular momentum (unit vector in LF).
    fn momentum(&self) -> Option<Vector3<f64>> {
        let momentum = self.toss.body.angular_momentum(&self.toss.launch.rate());
        let largest = momentum.amax();
        let scaled = (largest > 0.0 && largest.is_finite()).then(|| (momentum / largest).normalize())?;
        Some(self.toss.launch.attitude().body_to_lab(&scaled))
    }
}
