//! Rigid bodies, coins among them.

use ::toss::catalogue::{entries, named_body};
use ::toss::quantity::BodyRounding;
use ::toss::{Coin, InputError};
use dynamics::quantity::Given;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::errors::Failure;
use crate::given::{matrix, object, quantities, quantity, text, written};

/// A rigid body, by its inertia about the centre of mass.
///
/// The axes x, y, z are fixed in the body; z is the normal n of the side of heads. A body that is symmetric
/// about z, with equal moments about x and y, is a coin. Make one by ``named``, ``cylinder``,
/// ``from_moments`` or ``from_tensor``.
#[pyclass(frozen, eq, module = "unfair_toss")]
#[derive(Clone, PartialEq)]
pub(crate) struct Body {
    pub(crate) body: ::toss::Body,
    origin: Origin,
}

/// The constructor that made a body, with its arguments.
#[derive(Clone, PartialEq)]
enum Origin {
    Named(String),
    Cylinder([Given; 3]),
    Moments(Vec<Given>),
    Tensor([[f64; 3]; 3]),
}

#[pymethods]
impl Body {
    /// A coin or another body of the catalogue.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     Such as ``"us-quarter"`` or ``"racket"``; ``bodies()`` lists them.
    #[staticmethod]
    fn named(name: &Bound<'_, PyAny>) -> PyResult<Self> {
        Self::of_name(text("name", name, "the name of a body")?, "name")
    }

    /// A homogeneous cylinder.
    ///
    /// Parameters
    /// ----------
    /// mass : float or str
    ///     In kg or as in ``"5.67g"``, above 0.
    /// radius, thickness : float or str
    ///     In m or as in ``"24.26mm"``; the radius is above 0.
    #[staticmethod]
    fn cylinder(mass: &Bound<'_, PyAny>, radius: &Bound<'_, PyAny>, thickness: &Bound<'_, PyAny>) -> PyResult<Self> {
        let mass = quantity("mass", mass)?;
        let sizes = [mass, quantity("radius", radius)?, quantity("thickness", thickness)?];
        let [mass, radius, thickness] = sizes.map(Given::quantity);
        let coin = Coin::from_cylinder(mass, radius, thickness).map_err(Failure::from)?;
        Ok(Self { body: coin.into(), origin: Origin::Cylinder(sizes) })
    }

    /// A body whose principal axes are x, y and z.
    ///
    /// Parameters
    /// ----------
    /// moments : sequence of 2 or 3 floats
    ///     I1, I3 of a coin, or I1, I2, I3, in kg m². None may exceed the sum of the other two.
    #[staticmethod]
    fn from_moments(moments: &Bound<'_, PyAny>) -> PyResult<Self> {
        let moments = quantities("moments", moments, "a sequence of 2 or 3 real numbers")?;
        let in_si: Vec<f64> = moments.iter().map(|given| given.si()).collect();
        let body = ::toss::Body::from_listed_moments(&in_si).map_err(|error| Failure::from(error).of("moments"));
        Ok(Self { body: body?, origin: Origin::Moments(moments) })
    }

    /// A body with any inertia tensor.
    ///
    /// Parameters
    /// ----------
    /// tensor : array_like of shape (3, 3)
    ///     Symmetric, in kg m², about the centre of mass; the element xy is -∫ x y dm.
    #[staticmethod]
    fn from_tensor(tensor: &Bound<'_, PyAny>) -> PyResult<Self> {
        let tensor = matrix("tensor", tensor, "3 rows of 3 real numbers")?;
        let body = ::toss::Body::from_tensor(tensor).map_err(|error| Failure::from(error).of("tensor"))?;
        Ok(Self { body, origin: Origin::Tensor(tensor) })
    }

    /// The inertia tensor, as nested lists of shape (3, 3), in kg m².
    #[getter]
    fn tensor(&self) -> [[f64; 3]; 3] {
        self.body.tensor()
    }

    /// The moments I1, I2, I3 about x, y and z in kg m², if these are principal axes; else None.
    #[getter]
    fn moments(&self) -> Option<[f64; 3]> {
        self.body.moments()
    }

    /// The principal moments in kg m², the smallest first.
    #[getter]
    fn principal_moments(&self) -> [f64; 3] {
        self.body.principal_moments()
    }

    /// Whether the moments about x and y are equal, so that the body is a coin.
    #[getter]
    fn is_symmetric(&self) -> bool {
        self.body.coin().is_some()
    }

    /// k = I3/I1 of a coin, from 0 (rod) to 2 (flat disc); None for other bodies.
    #[getter]
    fn inertia_ratio(&self) -> Option<f64> {
        self.body.coin().map(|coin| coin.inertia_ratio())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let (constructor, arguments) = self.made_by(py)?;
        let texts = arguments.iter().map(|argument| Ok(argument.repr()?.to_string())).collect::<PyResult<Vec<_>>>()?;
        Ok(format!("Body.{constructor}({})", texts.join(", ")))
    }

    fn __hash__(&self) -> u64 {
        // A moment of -0 is one of 0.
        self.body.principal_moments().iter().fold(0, |hash, moment| hash ^ (moment + 0.0).to_bits().rotate_left(7))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let (constructor, arguments) = self.made_by(py)?;
        Ok((py.get_type::<Self>().getattr(constructor)?, arguments))
    }
}

/// The body that an argument means: a name of the catalogue, or a [`Body`].
pub(crate) fn body_of(argument: &Bound<'_, PyAny>) -> PyResult<Py<Body>> {
    body_at(argument, None)
}

/// The same of element `index` of an argument that means several.
pub(crate) fn body_at(argument: &Bound<'_, PyAny>, index: Option<u64>) -> PyResult<Py<Body>> {
    let Ok(name) = argument.extract::<String>() else {
        return Ok(object::<Body>("body", argument, "the name of a body, or a Body")?.clone().unbind());
    };
    let body = named_body(&name).map_err(|error| {
        let failure = Failure::from(error).of("body");
        if let Some(index) = index { failure.element(index) } else { failure }
    });
    Py::new(argument.py(), Body { body: body?, origin: Origin::Named(name) })
}

impl Body {
    /// The constructor that made it, and its arguments.
    fn made_by<'py>(&self, py: Python<'py>) -> PyResult<(&'static str, Bound<'py, PyTuple>)> {
        let list = |given: &[Given]| given.iter().map(|given| written(py, *given)).collect::<PyResult<Vec<_>>>();
        Ok(match &self.origin {
            Origin::Named(name) => ("named", (name,).into_pyobject(py)?),
            Origin::Cylinder(sizes) => ("cylinder", PyTuple::new(py, list(sizes)?)?),
            Origin::Moments(moments) => ("from_moments", (list(moments)?,).into_pyobject(py)?),
            Origin::Tensor(tensor) => ("from_tensor", (*tensor,).into_pyobject(py)?),
        })
    }

    /// What the units of its moments rounded. Those of a cylinder round nothing.
    pub(crate) fn rounding(&self) -> BodyRounding {
        match &self.origin {
            Origin::Moments(moments) => {
                BodyRounding::of(moments, |moments| ::toss::Body::from_listed_moments(&moments))
            }
            _ => BodyRounding::Exact,
        }
    }

    /// The body of the catalogue that the argument `field` names.
    pub(crate) fn of_name(name: String, field: &'static str) -> PyResult<Self> {
        let body = named_body(&name).map_err(|error| Failure::from(error).of(field))?;
        Ok(Self { body, origin: Origin::Named(name) })
    }
}

/// The coin that a body is, for what is computed of coins alone.
pub(crate) fn coin_of(body: &::toss::Body, why: &'static str) -> PyResult<Coin> {
    let refused = InputError::OutsideModel { field: "body", why };
    body.coin().ok_or_else(|| Failure::from(refused).into())
}

/// The names of the coins and other bodies of the catalogue, each with a short description.
#[pyfunction]
pub(crate) fn bodies() -> Vec<(&'static str, &'static str)> {
    entries().map(|entry| (entry.name, entry.description)).collect()
}
