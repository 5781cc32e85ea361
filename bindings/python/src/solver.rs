//! Solvers by name, with their settings.

use ::toss::{Backend, Formulation, QuaternionSolver, Registry, SolverConfig, Stepping, TAYLOR};
use dynamics::StepControl;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::{Failure, malformed};
use crate::given::{no_others, object, optional_number, text};

/// A solver with its settings.
///
/// Parameters
/// ----------
/// name : str
///     ``"exact"``, or an integrator that ``solvers()`` lists.
/// scheme : str, optional
///     How an integrator steps, such as ``"dop853"`` or ``"taylor"``.
/// rtol : float, optional
///     Local error per step of an adaptive scheme, absolute and relative; 1e-10 by default.
/// step : float, optional
///     Equal steps of at most so many s, instead of a tolerance.
/// formulation : str, optional
///     From which axis an integrator measures its angles: ``"momentum"``, ``"vertical"`` or ``"raw"``.
///
/// A setting that the solver does not have is refused.
#[pyclass(frozen, eq, module = "unfair_toss")]
#[derive(Clone, PartialEq)]
pub(crate) struct Solver {
    config: SolverConfig,
}

#[pymethods]
impl Solver {
    #[new]
    #[pyo3(signature = (name, *, scheme=None, rtol=None, step=None, formulation=None, **others), text_signature = "(name, *, scheme=None, rtol=None, step=None, formulation=None)")]
    fn new(
        name: &Bound<'_, PyAny>,
        scheme: Option<&Bound<'_, PyAny>>,
        rtol: Option<&Bound<'_, PyAny>>,
        step: Option<&Bound<'_, PyAny>>,
        formulation: Option<&Bound<'_, PyAny>>,
        others: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        no_others::<Self>(name.py(), others)?;
        let mut config = SolverConfig::new(&text("name", name, "the name of a solver")?);
        if let Some(scheme) = scheme {
            config = config.with_scheme(&text("scheme", scheme, "the name of a scheme")?);
        }
        if let Some(formulation) = formulation {
            let formulation = text("formulation", formulation, "the name of a formulation")?;
            config = config.with_formulation(formulation.parse().map_err(Failure::from)?);
        }
        let (rtol, step) = (optional_number("rtol", rtol)?, optional_number("step", step)?);
        config = match (rtol, step) {
            (Some(_), Some(_)) => return Err(malformed("step", "given with rtol", "either rtol or step")),
            (Some(rtol), None) => config.with_tolerance(rtol).map_err(Failure::from)?,
            (None, Some(step)) => config.with_step(step).map_err(Failure::from)?,
            (None, None) => config,
        };
        // It is made now, so that what is wrong is said here, of the arguments that this has.
        let made = Registry::standard().configured(&config).map(drop);
        made.map_err(Failure::from).map_err(|failure| match failure.error.field() {
            Some("solver") => failure.of("name"),
            _ => failure,
        })?;
        Ok(Self { config })
    }

    /// The name.
    #[getter]
    fn name(&self) -> &str {
        self.config.name()
    }

    /// The scheme by which it steps, also where it was not given; None for a closed form.
    #[getter]
    fn scheme(&self) -> PyResult<Option<&'static str>> {
        Ok(self.stepping()?.map(|stepping| stepping.scheme().name()))
    }

    /// The tolerance of an adaptive scheme, also where it was not given; else None.
    #[getter]
    fn rtol(&self) -> PyResult<Option<f64>> {
        Ok(self.stepping()?.and_then(tolerance_of))
    }

    /// The largest step of a scheme with equal steps in s, also where it was not given; else None.
    #[getter]
    fn step(&self) -> PyResult<Option<f64>> {
        Ok(self.stepping()?.and_then(|stepping| match stepping.control() {
            StepControl::Step(step) => Some(step),
            StepControl::Tolerance(_) => None,
        }))
    }

    /// The formulation, if one was given.
    #[getter]
    fn formulation(&self) -> Option<&'static str> {
        self.config.formulation().map(Formulation::name)
    }

    fn __repr__(&self) -> String {
        let mut settings = format!("Solver('{}'", self.config.name());
        if let Some(scheme) = self.config.scheme() {
            settings += &format!(", scheme='{scheme}'");
        }
        match self.config.control() {
            Some(StepControl::Tolerance(tolerance)) => settings += &format!(", rtol={tolerance:?}"),
            Some(StepControl::Step(step)) => settings += &format!(", step={step:?}"),
            None => {}
        }
        if let Some(formulation) = self.config.formulation() {
            settings += &format!(", formulation='{}'", formulation.name());
        }
        settings + ")"
    }

    fn __hash__(&self) -> u64 {
        self.config.name().bytes().fold(0, |hash: u64, byte| hash.wrapping_mul(31).wrapping_add(u64::from(byte)))
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<((&str,), Bound<'py, PyDict>)> {
        let keywords = PyDict::new(py);
        keywords.set_item("scheme", self.config.scheme())?;
        match self.config.control() {
            Some(StepControl::Tolerance(tolerance)) => keywords.set_item("rtol", tolerance)?,
            Some(StepControl::Step(step)) => keywords.set_item("step", step)?,
            None => {}
        }
        keywords.set_item("formulation", self.formulation())?;
        Ok(((self.config.name(),), keywords))
    }
}

impl Solver {
    fn stepping(&self) -> PyResult<Option<Stepping>> {
        Ok(self.backend()?.solver().stepping())
    }

    pub(crate) fn backend(&self) -> PyResult<Backend> {
        Ok(Registry::standard().configured(&self.config).map_err(Failure::from)?)
    }
}

/// The tolerance of an adaptive scheme.
fn tolerance_of(stepping: Stepping) -> Option<f64> {
    match stepping.control() {
        StepControl::Tolerance(tolerance) => Some(tolerance),
        StepControl::Step(_) => None,
    }
}

/// The settings of the solver that an argument means: a name, or a [`Solver`].
pub(crate) fn config_of(argument: &Bound<'_, PyAny>) -> PyResult<SolverConfig> {
    match argument.extract::<String>() {
        Ok(name) => Ok(SolverConfig::new(&name)),
        Err(_) => Ok(object::<Solver>("solver", argument, "the name of a solver, or a Solver")?.get().config.clone()),
    }
}

/// The solver that an argument means.
pub(crate) fn backend_of(argument: &Bound<'_, PyAny>) -> PyResult<Backend> {
    Solver { config: config_of(argument)? }.backend()
}

/// The solvers, each with what it solves and the names of its schemes and formulations.
#[pyfunction]
pub(crate) fn solvers() -> Vec<(String, String, Vec<&'static str>, Vec<&'static str>)> {
    let row = |entry: &::toss::SolverEntry| {
        let schemes = entry.schemes().iter().map(|scheme| scheme.name()).collect();
        let formulations = entry.formulations().iter().map(|formulation| formulation.name()).collect();
        (entry.name().to_owned(), entry.summary().to_owned(), schemes, formulations)
    };
    Registry::standard().entries().iter().map(row).collect()
}

/// The solver that proves by integration, as an argument asks for. Its scheme is taylor unless it has another.
pub(crate) fn prover_of(value: &Bound<'_, PyAny>) -> PyResult<QuaternionSolver> {
    let config = config_of(value)?;
    if config.name() != QuaternionSolver::NAME {
        return Err(malformed("solver", config.name(), "quaternion, which alone proves by integration"));
    }
    let config = if config.scheme().is_none() { config.with_scheme(TAYLOR.name()) } else { config };
    let settings = config.settings(Registry::standard().entries()).map_err(Failure::from)?;
    Ok(QuaternionSolver::new(settings.stepping, settings.formulation))
}
