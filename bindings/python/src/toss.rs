//! A body and its launch.

use ::toss::{Attitude, InputError, Launch, TimeOfFlight};
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::body::{Body, body_of};
use crate::errors::{Failure, malformed};
use crate::given::{no_others, object, optional_number, refused_value, vector};

/// A body and its launch: all that a flight depends on.
///
/// Parameters
/// ----------
/// rate : sequence of 3 floats
///     Angular velocity at launch in rad/s, along the axes of the body.
/// speed : float, optional
///     Upward speed at launch in m/s; this or ``time`` is needed.
/// time : float, optional
///     Time of flight in s, instead of a speed.
/// gravity : float, optional
///     In m/s²; 9.81 by default.
/// drop : float, optional
///     How far below its launch the body lands, in m; at the same height by default.
/// tilt : float, optional
///     Turn about the lab's x axis before the launch in rad; a positive one leans the normal towards -y.
/// attitude : sequence of 4 floats or scipy Rotation, optional
///     Attitude at launch instead of a tilt, as the quaternion (w, x, y, z) from the body to the laboratory.
/// body : str or Body
///     A name of the catalogue, or a body; the paper's coin by default.
#[pyclass(frozen, eq, module = "unfair_toss")]
pub(crate) struct Toss {
    pub(crate) toss: ::toss::Toss,
    body: Py<Body>,
    given: Given,
}

/// The arguments of a launch, as they were given.
#[derive(Clone, Debug, PartialEq)]
struct Given {
    rate: [f64; 3],
    speed: Option<f64>,
    time: Option<f64>,
    gravity: Option<f64>,
    drop: Option<f64>,
    tilt: Option<f64>,
    attitude: Option<[f64; 4]>,
}

impl PartialEq for Toss {
    fn eq(&self, other: &Self) -> bool {
        self.toss == other.toss
    }
}

#[pymethods]
impl Toss {
    #[new]
    #[pyo3(signature = (rate, *, speed=None, time=None, gravity=None, drop=None, tilt=None, attitude=None, body=None, **others), text_signature = "(rate, *, speed=None, time=None, gravity=None, drop=None, tilt=None, attitude=None, body=None)")]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        py: Python<'_>,
        rate: &Bound<'_, PyAny>,
        speed: Option<&Bound<'_, PyAny>>,
        time: Option<&Bound<'_, PyAny>>,
        gravity: Option<&Bound<'_, PyAny>>,
        drop: Option<&Bound<'_, PyAny>>,
        tilt: Option<&Bound<'_, PyAny>>,
        attitude: Option<&Bound<'_, PyAny>>,
        body: Option<&Bound<'_, PyAny>>,
        others: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        no_others::<Self>(py, others)?;
        let given = Given {
            rate: vector("rate", rate, "a sequence of 3 real numbers")?,
            speed: optional_number("speed", speed)?,
            time: optional_number("time", time)?,
            gravity: optional_number("gravity", gravity)?,
            drop: optional_number("drop", drop)?,
            tilt: optional_number("tilt", tilt)?,
            attitude: attitude.map(components_of).transpose()?,
        };
        let body = match body {
            Some(body) => body_of(body)?,
            None => Py::new(py, Body::of_name("paper".to_owned(), "body")?)?,
        };
        let toss = ::toss::Toss::new(body.get().body, given.launch()?);
        Ok(Self { toss, body, given })
    }

    /// The body.
    #[getter]
    fn body(&self, py: Python<'_>) -> Py<Body> {
        self.body.clone_ref(py)
    }

    /// Angular velocity at launch, x, y, z in rad/s along the axes of the body.
    #[getter]
    fn rate(&self) -> [f64; 3] {
        self.given.rate
    }

    /// Upward speed at launch in m/s; None if the time of flight was given.
    #[getter]
    fn speed(&self) -> Option<f64> {
        self.given.speed
    }

    /// Time of flight in s.
    #[getter]
    fn flight_time(&self) -> f64 {
        self.toss.launch.flight_time()
    }

    /// Attitude at launch, as the unit quaternion w, x, y, z from the body to the laboratory.
    #[getter]
    fn attitude(&self) -> [f64; 4] {
        self.toss.launch.attitude().components()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let Given { rate, .. } = self.given;
        let mut text = format!("Toss({rate:?}");
        for (name, value) in self.keywords(py)?.iter() {
            if !value.is_none() {
                text += &format!(", {name}={}", value.repr()?);
            }
        }
        Ok(text + ")")
    }

    fn __hash__(&self) -> u64 {
        // A rate of -0 is one of 0.
        let bits = |number: f64| (number + 0.0).to_bits();
        let time = bits(self.toss.launch.flight_time());
        self.given.rate.iter().fold(time, |hash, rate| hash.rotate_left(9) ^ bits(*rate))
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<(([f64; 3],), Bound<'py, PyDict>)> {
        Ok(((self.given.rate,), self.keywords(py)?))
    }
}

impl Toss {
    fn keywords<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let Given { speed, time, gravity, drop, tilt, attitude, .. } = self.given;
        let keywords = PyDict::new(py);
        for (name, value) in [("speed", speed), ("time", time), ("gravity", gravity), ("drop", drop), ("tilt", tilt)] {
            keywords.set_item(name, value)?;
        }
        keywords.set_item("attitude", attitude)?;
        keywords.set_item("body", &self.body)?;
        Ok(keywords)
    }
}

impl Given {
    fn launch(&self) -> PyResult<Launch> {
        let &Self { rate, speed, time, gravity, drop, tilt, attitude } = self;
        let unused = [("gravity", gravity), ("drop", drop)].into_iter().find(|(_, value)| value.is_some());
        let time_of_flight = match (speed, time, unused) {
            (Some(_), Some(_), _) => return Err(malformed("time", "given with a speed", "either speed or time")),
            (None, None, _) => {
                return Err(Failure::from(InputError::Missing { field: "speed", expected: "a speed or a time" }).into());
            }
            (None, Some(_), Some((field, _))) => return Err(malformed(field, "given with a time", "None, or a speed")),
            (None, Some(time), None) => TimeOfFlight::Given(time),
            (Some(speed), None, _) => TimeOfFlight::thrown(speed, gravity.unwrap_or(DEFAULT_GRAVITY), drop),
        };
        // Each component of the rate has a field of its own.
        if let Some(axis) = rate.iter().position(|rate| !rate.is_finite()) {
            let fault = InputError::OutOfRange { field: "rate", value: rate[axis], valid: "finite" };
            return Err(Failure::from(fault).element(axis as u64).into());
        }
        let launch = Launch::new(rate, time_of_flight).map_err(Failure::from)?;
        Ok(match attitude_of(tilt, attitude)? {
            Some(attitude) => launch.with_attitude(attitude),
            None => launch,
        })
    }
}

/// The attitude at launch that is given by a tilt (rad) or by components (w, x, y, z).
pub(crate) fn attitude_of(tilt: Option<f64>, components: Option<[f64; 4]>) -> PyResult<Option<Attitude>> {
    match (tilt, components) {
        (Some(_), Some(_)) => Err(malformed("attitude", "given with a tilt", "either tilt or attitude")),
        (None, None) => Ok(None),
        (None, Some(components)) => Ok(Some(Attitude::from_components(components).map_err(Failure::from)?)),
        (Some(tilt), None) => {
            dynamics::error::require("tilt [rad]", tilt, "finite", true).map_err(Failure::from)?;
            Ok(Some(Attitude::about_x(tilt)))
        }
    }
}

/// The components (w, x, y, z) of four numbers, or of one of SciPy's rotations.
pub(crate) fn components_of(attitude: &Bound<'_, PyAny>) -> PyResult<[f64; 4]> {
    const EXPECTED: &str = "4 real numbers (w, x, y, z), or a single rotation of SciPy";
    if !attitude.hasattr("as_quat").unwrap_or(false) {
        return vector("attitude", attitude, EXPECTED);
    }
    let scalar_first = PyDict::new(attitude.py());
    scalar_first.set_item("scalar_first", true)?;
    let components = attitude.call_method("as_quat", (), Some(&scalar_first));
    let components = components.ok().and_then(|components| vector("attitude", &components, EXPECTED).ok());
    components.ok_or_else(|| refused_value("attitude", attitude, EXPECTED))
}

/// The toss that an argument is.
pub(crate) fn toss_of(value: &Bound<'_, PyAny>) -> PyResult<::toss::Toss> {
    Ok(object::<Toss>("toss", value, "a Toss")?.get().toss)
}
