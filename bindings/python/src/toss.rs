//! A body and its launch.

use ::toss::quantity::Rounding;
use ::toss::{InputError, Launch};
use dynamics::Thrown;
use dynamics::quantity::Given;
use dynamics::thrown::Field;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use crate::body::{Body, body_of};
use crate::errors::Failure;
use crate::given::{no_others, object, quantities, quantity, refused_value, vector, written};

/// A body and its launch: all that a flight depends on.
///
/// Parameters
/// ----------
/// rate : sequence of 3 floats, optional
///     Angular velocity at launch in rad/s, along the axes of the body; this or ``turn`` with ``psi`` is needed. It and all
///     other quantities may also be texts with a unit, such as ``"38rev/s"``, or values with a unit of pint, astropy or unyt.
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
/// turn, psi : float, optional
///     Of a coin, instead of a rate: the rate in rad/s at which its normal turns about the angular momentum, and the angle in
///     rad between both.
/// body : str or Body
///     A name of the catalogue, or a body; the paper's coin by default.
#[pyclass(frozen, eq, module = "unfair_toss")]
pub(crate) struct Toss {
    pub(crate) toss: ::toss::Toss,
    body: Py<Body>,
    /// The arguments of the launch.
    given: Thrown,
}

/// The argument `rate`, if it was given.
type Rate<'py> = Option<Bound<'py, PyList>>;

impl PartialEq for Toss {
    fn eq(&self, other: &Self) -> bool {
        self.toss == other.toss
    }
}

#[pymethods]
impl Toss {
    #[new]
    #[pyo3(signature = (rate=None, *, speed=None, time=None, gravity=None, drop=None, tilt=None, attitude=None, turn=None, psi=None, body=None, **others), text_signature = "(rate=None, *, speed=None, time=None, gravity=None, drop=None, tilt=None, attitude=None, turn=None, psi=None, body=None)")]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn new(
        py: Python<'_>,
        rate: Option<&Bound<'_, PyAny>>,
        speed: Option<&Bound<'_, PyAny>>,
        time: Option<&Bound<'_, PyAny>>,
        gravity: Option<&Bound<'_, PyAny>>,
        drop: Option<&Bound<'_, PyAny>>,
        tilt: Option<&Bound<'_, PyAny>>,
        attitude: Option<&Bound<'_, PyAny>>,
        turn: Option<&Bound<'_, PyAny>>,
        psi: Option<&Bound<'_, PyAny>>,
        body: Option<&Bound<'_, PyAny>>,
        others: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        no_others::<Self>(py, others)?;
        let mut given = Thrown::default();
        rate.map(|rate| put_rate(&mut given, rate)).transpose()?;
        put_number(&mut given, Field::Turn, turn)?;
        put_number(&mut given, Field::Psi, psi)?;
        put_number(&mut given, Field::Speed, speed)?;
        put_number(&mut given, Field::Time, time)?;
        put_number(&mut given, Field::Gravity, gravity)?;
        put_number(&mut given, Field::Drop, drop)?;
        put_attitude(&mut given, tilt, attitude)?;
        let body = match body {
            Some(body) => body_of(body)?,
            None => Py::new(py, Body::of_name("paper".to_owned(), "body")?)?,
        };
        let toss = ::toss::Toss::new(body.get().body, launch(&given, &body.get().body)?);
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
        self.toss.launch.rate().into()
    }

    /// Upward speed at launch in m/s; None if the time of flight was given.
    #[getter]
    fn speed(&self) -> Option<f64> {
        self.given.one(Field::Speed).map(Given::si)
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
        let rate = self.given_rate(py)?.map(|rate| Ok::<_, PyErr>(rate.repr()?.to_string())).transpose()?;
        let keywords = self.keywords(py)?;
        let keywords = keywords.iter().map(|(name, value)| Ok(format!("{name}={}", value.repr()?)));
        let arguments = rate.into_iter().map(Ok).chain(keywords).collect::<PyResult<Vec<_>>>()?;
        Ok(format!("Toss({})", arguments.join(", ")))
    }

    fn __hash__(&self) -> u64 {
        // A rate of -0 is one of 0.
        let bits = |number: f64| (number + 0.0).to_bits();
        let time = bits(self.toss.launch.flight_time());
        self.rate().iter().fold(time, |hash, rate| hash.rotate_left(9) ^ bits(*rate))
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<((Rate<'py>,), Bound<'py, PyDict>)> {
        Ok(((self.given_rate(py)?,), self.keywords(py)?))
    }
}

impl Toss {
    fn given_rate<'py>(&self, py: Python<'py>) -> PyResult<Rate<'py>> {
        let parts = self.given.numbers(Field::Rate).iter().map(|part| written(py, *part));
        let parts = parts.collect::<PyResult<Vec<_>>>()?;
        Some(parts).filter(|parts| !parts.is_empty()).map(|parts| PyList::new(py, parts)).transpose()
    }

    /// What the units of its numbers rounded.
    pub(crate) fn rounding(&self) -> Rounding {
        let body = self.body.get().rounding();
        Rounding { flight: self.given.rounds_flight(), rate: self.given.rounds_rate(), body }
    }

    fn keywords<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let keywords = PyDict::new(py);
        for (field, numbers) in self.given.given().filter(|(field, _)| *field != Field::Rate) {
            let name = field.info().name;
            match numbers {
                [number] => keywords.set_item(name, written(py, *number)?)?,
                numbers => keywords.set_item(name, numbers.iter().map(|number| number.si()).collect::<Vec<f64>>())?,
            }
        }
        keywords.set_item("body", &self.body)?;
        Ok(keywords)
    }
}

/// The launch of `body`.
fn launch(given: &Thrown, body: &::toss::Body) -> PyResult<Launch> {
    // Each component of the rate has a field of its own.
    if let Some(axis) = given.numbers(Field::Rate).iter().position(|rate| !rate.si().is_finite()) {
        let value = given.numbers(Field::Rate)[axis].si();
        let fault = InputError::OutOfRange { field: "rate", value, valid: "finite" };
        return Err(Failure::from(fault).element(axis as u64).into());
    }
    let launch = given.time_of_flight().and_then(|time| given.launch(body, time));
    Ok(launch.map_err(Failure::from)?)
}

/// Gives the body rate.
fn put_rate(given: &mut Thrown, rate: &Bound<'_, PyAny>) -> PyResult<()> {
    const RATE: &str = "a sequence of 3 real numbers";
    let parts = quantities("rate", rate, RATE)?;
    if parts.len() != 3 {
        return Err(refused_value("rate", rate, RATE));
    }
    Ok(given.put(Field::Rate, parts).map_err(Failure::from)?)
}

/// Gives `field` by the argument of its name.
fn put_number(given: &mut Thrown, field: Field, value: Option<&Bound<'_, PyAny>>) -> PyResult<()> {
    let Some(value) = value else { return Ok(()) };
    Ok(given.put(field, vec![quantity(field.info().name, value)?]).map_err(Failure::from)?)
}

/// Gives the attitude at launch by the arguments `tilt` and `attitude`.
pub(crate) fn put_attitude(
    given: &mut Thrown,
    tilt: Option<&Bound<'_, PyAny>>,
    attitude: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    put_number(given, Field::Tilt, tilt)?;
    let Some(components) = attitude.map(components_of).transpose()? else { return Ok(()) };
    Ok(given.put_si(Field::Attitude, &components).map_err(Failure::from)?)
}

/// The components (w, x, y, z) of four numbers, or of one of SciPy's rotations.
fn components_of(attitude: &Bound<'_, PyAny>) -> PyResult<[f64; 4]> {
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
