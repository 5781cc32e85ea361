//! Follows a flight at equally spaced times, for charts and for comparisons of solvers along the way. Point i of n is
//! at the time t = i T/(n - 1), where T is the time of flight and i goes from 0 to n - 1.
//!
//! BF is the body frame, whose z axis is the coin's normal n. LF is the laboratory frame, whose z axis ẑ points up; θ
//! is the angle between n and ẑ.

use dynamics::error::require;
use dynamics::{
    Attitude, Checked, Error, EulerAngles, InputError, Launch, SolveError, Solver, State, TimeOfFlight, Toss, Vector3,
};
pub use exact::RigidAngles;
use kinematics_quat::{IntegratedCertificate, QuaternionSolver};

/// The largest number of points of a trace. A chart needs some hundreds.
pub const MOST_POINTS: usize = 1_000_000;

/// The coin at one time of its flight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TracePoint {
    /// Time after launch (s).
    pub time: f64,
    /// Attitude (BF to LF).
    pub attitude: Attitude,
    /// Euler angles (rad), continuous over the flight. After some hundred thousand radians of a body with I1 ≠ I2 they are
    /// those nearest to the point before.
    pub angles: EulerAngles,
    /// The coin's normal n (unit vector in LF).
    pub normal: Vector3<f64>,
    /// The body's x axis, which is fixed in the coin's face (unit vector in LF).
    pub face: Vector3<f64>,
    /// cos θ = n · ẑ.
    pub cos_tilt: f64,
}

impl TracePoint {
    /// All numbers in the order of the fields, the attitude as w, x, y, z and the angles as α, β, γ, without signs of 0.
    pub fn numbers(&self) -> [f64; 15] {
        let ([w, x, y, z], EulerAngles { alpha, beta, gamma }) = (self.attitude.components(), self.angles);
        let ([nx, ny, nz], [fx, fy, fz]) = (self.normal.into(), self.face.into());
        [self.time, w, x, y, z, alpha, beta, gamma, nx, ny, nz, fx, fy, fz, self.cos_tilt].map(|number| number + 0.0)
    }
}

/// With the fields `alpha`, `beta` and `gamma` for the angles.
#[cfg(feature = "serde")]
impl serde::Serialize for TracePoint {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let mut fields = to.serialize_struct("TracePoint", 8)?;
        fields.serialize_field("time", &self.time)?;
        fields.serialize_field("attitude", &self.attitude.components())?;
        fields.serialize_field("alpha", &self.angles.alpha)?;
        fields.serialize_field("beta", &self.angles.beta)?;
        fields.serialize_field("gamma", &self.angles.gamma)?;
        fields.serialize_field("normal", &<[f64; 3]>::from(self.normal))?;
        fields.serialize_field("face", &<[f64; 3]>::from(self.face))?;
        fields.serialize_field("cos_tilt", &self.cos_tilt)?;
        fields.end()
    }
}

/// The times at which a flight is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Times {
    /// So many, equally spaced, launch and landing included.
    Number(usize),
    /// Every so many seconds from launch on, and the landing. Where a step ends at the landing to rounding, the landing takes
    /// its place.
    Every(f64),
}

/// So many points.
impl From<usize> for Times {
    fn from(points: usize) -> Self {
        Self::Number(points)
    }
}

impl Times {
    /// The times (s), which ascend from 0.
    fn of(self, launch: &Launch) -> Result<Vec<f64>, InputError> {
        match self {
            Self::Number(points) => spaced(launch, points),
            Self::Every(step) => stepped(launch, step),
        }
    }
}

/// The flight of `toss`, of a coin or any rigid body, by `solver` at these times, such as a number of points.
///
/// An integrator starts from the previous point, a closed form from the launch. The attitude leaves the
/// branch of the Euler angles open; the one nearest to the exact motion is taken.
///
/// # Errors
/// [`Error::Input`] for fewer than 2 or more than [`MOST_POINTS`] points, and for a step that is not positive; else the error
/// of the solver.
pub fn trace(solver: &dyn Solver, toss: &Toss, times: impl Into<Times>) -> Result<Vec<TracePoint>, Error> {
    trace_points(solver, toss, times.into())?.collect()
}

/// The points of [`trace`], each computed when it is asked for. After an error there is none.
///
/// # Errors
/// [`InputError`] for times that [`trace`] refuses.
pub fn trace_points<'a>(
    solver: &'a dyn Solver,
    toss: &'a Toss,
    times: Times,
) -> Result<impl Iterator<Item = Result<TracePoint, Error>> + 'a, InputError> {
    let mut flown = Flown::new(solver, toss);
    Ok(until_error(times.of(&toss.launch)?.into_iter().map(move |time| flown.at(time))))
}

/// The attitudes (BF to LF) of [`trace`], each computed when it is asked for. Without Euler angles they take little more than half the time.
pub(crate) fn attitudes<'a>(
    solver: &'a dyn Solver,
    toss: &'a Toss,
    points: usize,
) -> Result<impl Iterator<Item = Result<Attitude, Error>> + 'a, InputError> {
    let mut flown = Flown::new(solver, toss);
    Ok(until_error(spaced(&toss.launch, points)?.into_iter().map(move |time| flown.attitude(time))))
}

/// The items up to the first error, and that error.
fn until_error<T>(items: impl Iterator<Item = Result<T, Error>>) -> impl Iterator<Item = Result<T, Error>> {
    let mut has_failed = false;
    items.take_while(move |item| !std::mem::replace(&mut has_failed, item.is_err()))
}

/// So many equally spaced times (s) from launch to landing.
fn spaced(launch: &Launch, points: usize) -> Result<Vec<f64>, InputError> {
    require_points(points)?;
    #[expect(clippy::cast_precision_loss, reason = "at most a million points")]
    let time = |index: usize| launch.flight_time() * (index as f64 / (points - 1) as f64);
    Ok((0..points).map(time).collect())
}

/// The times (s) from launch on with this `step`, and that of the landing.
fn stepped(launch: &Launch, step: f64) -> Result<Vec<f64>, InputError> {
    let landing = launch.flight_time();
    let valid = "> 0 s, and at least a millionth of the time of flight";
    require("dt [s]", step, valid, step > 0.0 && landing / step < (MOST_POINTS - 2) as f64)?;
    // A step that ends at the landing to rounding is the landing: 0.9 is three steps of 0.3, though 3 × 0.3 is below it in
    // f64. The step, the product, and up to three factors of the time are rounded, each by at most u = 2^-53 of the time.
    let last = landing * (1.0 - 4.0 * f64::EPSILON);
    let steps = (0_u32..).map(|index| f64::from(index) * step).take_while(|time| *time < last);
    Ok(steps.chain([landing]).collect())
}

/// A point of a trace with the certificate that bounds its errors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnclosedPoint {
    /// The point. Its cos θ is that of the certificate.
    pub point: TracePoint,
    /// The proven bounds.
    pub certificate: IntegratedCertificate,
}

/// As [`trace_points`], with proven bounds of the errors at each point. Each point is a flight from the launch.
///
/// # Errors
/// As [`trace_points`]; each point has the errors of [`QuaternionSolver::enclose`].
pub fn trace_enclosed<'a>(
    solver: &'a QuaternionSolver,
    toss: &'a Toss,
    times: Times,
) -> Result<impl Iterator<Item = Result<EnclosedPoint, Error>> + 'a, InputError> {
    let mut branch = Branch::new(toss);
    let at = move |time: f64| -> Result<EnclosedPoint, Error> {
        let flown = Toss { launch: toss.launch.with_time_of_flight(TimeOfFlight::Given(time))?, ..*toss };
        let certificate = solver.enclose(&flown)?;
        let point = TracePoint::new(time, certificate.landing().state.attitude, &branch.at(time)?);
        branch.before = point.angles;
        Ok(EnclosedPoint { point: TracePoint { cos_tilt: certificate.cos_tilt(), ..point }, certificate })
    };
    Ok(until_error(times.of(&toss.launch)?.into_iter().map(at)))
}

/// The state at launch.
fn launched(toss: &Toss) -> State {
    State { attitude: toss.launch.attitude(), rate: toss.launch.rate() }
}

/// A flight that is followed from point to point.
struct Flown<'a> {
    solver: Checked<&'a dyn Solver>,
    toss: &'a Toss,
    branch: Branch,
    /// The time and the state of the last point.
    last: (f64, State),
}

impl<'a> Flown<'a> {
    fn new(solver: &'a dyn Solver, toss: &'a Toss) -> Self {
        Self { solver: Checked::new(solver), toss, branch: Branch::new(toss), last: (0.0, launched(toss)) }
    }

    /// The point at `time` (s), which is not before the last one.
    fn at(&mut self, time: f64) -> Result<TracePoint, Error> {
        let attitude = self.attitude(time)?;
        let point = TracePoint::new(time, attitude, &self.branch.at(time)?);
        self.branch.before = point.angles;
        Ok(point)
    }

    fn attitude(&mut self, time: f64) -> Result<Attitude, Error> {
        let (toss, last) = (self.toss, self.last);
        // A closed form starts from the launch as it was given, whose rate may have a unit.
        let (since, leg) = match self.solver.stepping() {
            Some(_) => (last.0, Launch::from_state(&last.1, TimeOfFlight::Given(time - last.0))?),
            // So does the time of the landing, which is not the rounded one.
            None if time == toss.launch.flight_time() => (0.0, toss.launch),
            None => (0.0, toss.launch.with_time_of_flight(TimeOfFlight::Given(time))?),
        };
        let leg = Toss { launch: leg, ..*toss };
        let state = self.solver.land(&leg).map_err(|error| error.later(since))?.state;
        self.last = (time, state);
        // A closed form leaves a turn of 1e-33 at launch, which would say where n goes.
        Ok(if time == 0.0 { self.branch.launched(&state) } else { state.attitude })
    }
}

/// The Euler angles whose branch a point takes: those of the exact motion, or where a body has turned too often for
/// these, those of the point before.
struct Branch {
    exact: RigidAngles,
    before: EulerAngles,
    launched: Option<Attitude>,
}

impl Branch {
    fn new(toss: &Toss) -> Self {
        let launched = toss.coin().is_none().then(|| toss.launch.attitude());
        Self { exact: RigidAngles::new(toss), before: EulerAngles::principal(&toss.launch.attitude()), launched }
    }

    /// The angles of reference at `time` (s).
    fn at(&mut self, time: f64) -> Result<EulerAngles, SolveError> {
        match self.exact.at(time) {
            Err(SolveError::StepLimit { .. }) => Ok(self.before),
            angles => angles,
        }
    }

    /// The attitude at launch, without the rounding of a solver of bodies.
    fn launched(&self, solved: &State) -> Attitude {
        self.launched.unwrap_or(solved.attitude)
    }
}

/// Checks the number of points.
///
/// # Errors
/// [`InputError`] for fewer than 2 or more than [`MOST_POINTS`] points.
pub(crate) fn require_points(points: usize) -> Result<(), InputError> {
    let malformed = || InputError::Malformed { field: "points", value: points.to_string(), expected: "2 to 1000000" };
    (2..=MOST_POINTS).contains(&points).then_some(()).ok_or_else(malformed)
}

impl TracePoint {
    pub(crate) fn new(time: f64, attitude: Attitude, branch: &EulerAngles) -> Self {
        Self {
            time,
            attitude,
            angles: EulerAngles::nearest(&attitude, branch),
            normal: attitude.normal(),
            face: attitude.body_to_lab(&Vector3::x()),
            cos_tilt: attitude.cos_tilt(),
        }
    }
}

#[cfg(test)]
mod tests;
