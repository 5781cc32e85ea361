//! The options that choose a solver and its settings. Their help texts are made from the registry, so that a new solver
//! appears in them without a change here.

use clap::Args;
use dynamics::Frame;
use dynamics::config::one_of;
use toss::quantity::Dimension;
use toss::solvers::Proving;
use toss::{
    Backend, ExactSolver, Formulation, QuaternionSolver, Registry, Scheme, SolverConfig, SolverEntry, Stepping, TAYLOR,
};

use crate::failure::Failure;
use crate::quantity;

/// The solver and its settings.
#[derive(Debug, Args)]
pub(crate) struct SolverArgs {
    #[arg(long, value_name = "NAME", default_value = ExactSolver::NAME)]
    solver: String,
    #[arg(long, value_name = "NAME")]
    scheme: Option<String>,
    #[arg(long, value_name = "TOL", allow_hyphen_values = true, value_parser = quantity::tolerance)]
    tolerance: Option<f64>,
    #[arg(long, value_name = "H", allow_hyphen_values = true, value_parser = quantity::of(Dimension::Time))]
    step: Option<f64>,
    #[arg(long, value_name = "NAME", alias = "frame")]
    formulation: Option<String>,
}

impl SolverArgs {
    /// The solver with its settings.
    pub(crate) fn backend(&self, registry: &Registry) -> Result<Backend, Failure> {
        let entry = registry.named(&self.solver)?;
        let scheme =
            self.scheme.as_deref().filter(|_| entry.integrates()).map(|name| entry.scheme(name)).transpose()?;
        self.require_control(registry, scheme.or(entry.default_scheme()))?;
        Ok(registry.configured(&self.config()?)?)
    }

    /// The solver that proves by integration, as `--prove` asks for. Its scheme is taylor unless another one is given.
    pub(crate) fn prover(&self, registry: &Registry) -> Result<QuaternionSolver, Failure> {
        const PROVER: &str = QuaternionSolver::NAME;
        let why = match registry.named(&self.solver)?.name() {
            PROVER => None,
            ExactSolver::NAME => Some(format!(
                "--prove has no effect with --solver exact, whose outcomes are proven; it is for {PROVER}"
            )),
            name => {
                Some(format!("--prove: {name} proves nothing, as it has no bound of its own error; {PROVER} has one"))
            }
        };
        if let Some(why) = why {
            return Err(Failure::usage("prove", why));
        }
        let config = self.config()?;
        let config = if self.scheme.is_none() { config.with_scheme(TAYLOR.name()) } else { config };
        let scheme = registry.named(PROVER)?.scheme(config.scheme().unwrap_or_default())?;
        self.require_control(registry, Some(scheme))?;
        let settings = config.settings(registry.entries())?;
        let solver = QuaternionSolver::new(settings.stepping, settings.formulation);
        let proves = Proving::new(solver).map(|_| solver);
        proves.map_err(|error| Failure::usage("prove", format!("--prove: {error}")))
    }

    /// The solver with its settings, for an answer that does not have cos θ of landings. The quaternion as printed is refused:
    /// it leaves that cos θ without projection, and the attitudes and outcomes are the same.
    pub(crate) fn backend_of_outcomes(&self, registry: &Registry) -> Result<Backend, Failure> {
        let (raw, name) = (Formulation::RAW.name(), QuaternionSolver::NAME);
        if self.solver == name && self.formulation.as_deref() == Some(raw) {
            let message = format!(
                "--formulation {raw} has no effect here by {name}: it leaves cos θ of a landing without projection, which \
                 turns no attitude and no outcome"
            );
            return Err(Failure::usage("formulation", message));
        }
        self.backend(registry)
    }

    fn config(&self) -> Result<SolverConfig, Failure> {
        let mut config = SolverConfig::new(self.solver.as_str());
        if let Some(scheme) = &self.scheme {
            config = config.with_scheme(scheme.as_str());
        }
        if let Some(tolerance) = self.tolerance {
            config = config.with_tolerance(tolerance)?;
        }
        if let Some(step) = self.step {
            config = config.with_step(step)?;
        }
        if let Some(name) = &self.formulation {
            config = config.with_formulation(Formulation::named(name)?);
        }
        Ok(config)
    }

    /// Refuses a tolerance of equal steps. A scheme that has an error estimate is given no equal steps here either: an option
    /// that is meant for another scheme is more likely a mistake.
    fn require_control(&self, registry: &Registry, scheme: Option<Scheme>) -> Result<(), Failure> {
        let Some(scheme) = scheme else { return Ok(()) };
        let name = scheme.name();
        match (scheme.is_adaptive(), self.tolerance, self.step) {
            (true, _, Some(_)) => {
                let message = format!("--step is for {}; {name} takes --tolerance", schemes_with_a_step(registry));
                Err(Failure::usage("step", message))
            }
            (false, Some(_), _) => Err(Failure::usage("tolerance", format!("--tolerance: {name} takes --step"))),
            _ => Ok(()),
        }
    }
}

/// What `--help` says of the option called `name` of `command`, if it is one of these options.
pub(crate) fn help(registry: &Registry, command: &str, name: &str) -> Option<String> {
    let solvers = |meant: fn(&SolverEntry) -> bool| {
        one_of(registry.entries().iter().filter(|entry| meant(entry)).map(SolverEntry::name))
    };
    let adaptive = || schemes(registry, Scheme::is_adaptive);
    Some(match (command, name) {
        ("plan", "solver") => {
            format!("An integrator that is used as a cross-check: {}", solvers(SolverEntry::integrates))
        }
        ("plan", "scheme") => format!("Scheme of the integrator: {} [default: the cheapest one]", adaptive()),
        ("compare", _) => return None,
        (_, "solver") => format!("The solver: {}", solvers(|_| true)),
        (_, "step") => {
            format!("Step of {} (s) [default: {}]", schemes_with_a_step(registry), Stepping::DEFAULT_STEP)
        }
        (_, "scheme") => format!(
            "Scheme by which the integrator steps: {}; `unfair-toss solvers` lists those of each solver [default: {}, or \
             the first one of the solver]",
            schemes(registry, |_| true),
            Stepping::DEFAULT.scheme()
        ),
        (_, "tolerance") => format!(
            "Local error per step of {}, absolute and relative [default: {:e}]",
            adaptive(),
            Stepping::DEFAULT_TOLERANCE
        ),
        (_, "formulation") => format!(
            "Formulation of the kinematics of an integrator: {} [default: {}]",
            formulations(registry),
            Formulation::default()
        ),
        _ => return None,
    })
}

/// The names of the schemes that take a fixed step.
fn schemes_with_a_step(registry: &Registry) -> String {
    schemes(registry, |scheme| !scheme.is_adaptive())
}

/// The names of the schemes for which `meant` is true, such as `dop853, dopri5 or taylor`.
fn schemes(registry: &Registry, meant: impl Fn(Scheme) -> bool) -> String {
    let all = each_once(registry.entries().iter().flat_map(SolverEntry::schemes));
    one_of(all.into_iter().filter(|scheme| meant(*scheme)).map(Scheme::name))
}

/// The names of the formulations, each with its behaviour at singular points.
fn formulations(registry: &Registry) -> String {
    let all = each_once(registry.entries().iter().flat_map(SolverEntry::formulations));
    let described = all.into_iter().map(|formulation: Formulation| {
        let words = match (formulation.frame(), formulation.is_guarded()) {
            (_, false) => "as the paper prints it: an answer may be wrong without an error",
            (Frame::Momentum, true) => "no flight is singular",
            (Frame::Vertical, true) => "the paper's frame: a typed error where it is singular",
        };
        format!("{} ({words})", formulation.name())
    });
    one_of(described.collect::<Vec<_>>().iter().map(String::as_str))
}

/// Each item the first time that it stands there.
pub(crate) fn each_once<'a, T: Copy + PartialEq + 'a>(items: impl Iterator<Item = &'a T>) -> Vec<T> {
    items.fold(Vec::new(), |mut all, item| {
        if !all.contains(item) {
            all.push(*item);
        }
        all
    })
}
