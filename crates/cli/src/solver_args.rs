//! The options that choose a solver and its settings. Their help texts are made from the registry, so that a new solver
//! appears in them without a change here.

use clap::Args;
use dynamics::Frame;
use dynamics::error::find_named;
use toss::{
    Backend, Dimension, ExactSolver, Formulation, InputError, Proving, QuaternionSolver, Registry, Scheme, Settings,
    SolverEntry, Stepping,
};

use crate::failure::Failure;
use crate::quantity;

/// The solver and its settings.
#[derive(Debug, Args)]
pub(crate) struct SolverArgs {
    #[arg(long, value_name = "NAME", default_value = ExactSolver::NAME,
          help = solver_help(Registry::standard()))]
    solver: String,
    #[arg(long, value_name = "NAME", help = scheme_help(Registry::standard()))]
    scheme: Option<String>,
    #[arg(long, value_name = "TOL", allow_hyphen_values = true, value_parser = quantity::tolerance,
          help = tolerance_help(Registry::standard()))]
    tolerance: Option<f64>,
    #[arg(long, value_name = "H", allow_hyphen_values = true, value_parser = quantity::of(Dimension::Time),
          help = step_help(Registry::standard()))]
    step: Option<f64>,
    #[arg(long, value_name = "NAME", alias = "frame", help = formulation_help(Registry::standard()))]
    formulation: Option<String>,
}

impl SolverArgs {
    /// The solver with its settings.
    pub(crate) fn backend(&self, registry: &Registry) -> Result<Backend, Failure> {
        let entry = registry.named(&self.solver)?;
        let (scheme, formulation) = (self.scheme(registry, entry)?, self.formulation(registry, entry)?);
        self.require_steps(registry, entry)?;
        Ok(registry.backend(&self.solver, &Settings { stepping: self.stepping(registry, scheme)?, formulation })?)
    }

    /// The solver that proves by integration, as `--prove` asks for. Its scheme is taylor unless another one is given.
    pub(crate) fn prover(&self, registry: &Registry) -> Result<QuaternionSolver, Failure> {
        const PROVER: &str = QuaternionSolver::NAME;
        let entry = registry.named(&self.solver)?;
        match entry.name() {
            PROVER => {}
            ExactSolver::NAME => {
                let why =
                    format!("--prove has no effect with --solver exact, whose outcomes are proven; it is for {PROVER}");
                return Err(Failure::usage("prove", why));
            }
            name => {
                let why =
                    format!("--prove: {name} proves nothing, as it has no bound of its own error; {PROVER} has one");
                return Err(Failure::usage("prove", why));
            }
        }
        let scheme = self.scheme.as_deref().map_or(Ok(Scheme::TAYLOR), |name| entry.scheme(name))?;
        let solver = QuaternionSolver::new(self.stepping(registry, scheme)?, self.formulation(registry, entry)?);
        let proves = Proving::new(solver).map(|_| solver);
        proves.map_err(|error| Failure::usage("prove", format!("--prove: {error}")))
    }

    fn scheme(&self, registry: &Registry, entry: &SolverEntry) -> Result<Scheme, InputError> {
        match self.scheme.as_deref() {
            None => Ok(entry.default_scheme().unwrap_or(Stepping::DEFAULT.scheme())),
            Some(name) if entry.integrates() => entry.scheme(name),
            // A closed form is refused any scheme, but a name that is none is the clearer complaint.
            Some(name) => find_named("scheme", name, &all_schemes(registry), |scheme| scheme.name()).copied(),
        }
    }

    /// Refuses what would have no effect with a solver that takes no steps.
    fn require_steps(&self, registry: &Registry, entry: &SolverEntry) -> Result<(), Failure> {
        let given =
            [("scheme", self.scheme.is_some()), ("tolerance", self.tolerance.is_some()), ("step", self.step.is_some())];
        match given.into_iter().find(|(_, given)| *given) {
            Some((option, _)) if !entry.integrates() => {
                Err(no_effect(option, &format!("--{option}"), (registry, entry), SolverEntry::integrates))
            }
            _ => Ok(()),
        }
    }

    fn formulation(&self, registry: &Registry, entry: &SolverEntry) -> Result<Formulation, Failure> {
        let Some(name) = &self.formulation else { return Ok(Formulation::default()) };
        let formulation = Formulation::named(name)?;
        let differs = |entry: &SolverEntry| entry.formulations().contains(&formulation);
        if differs(entry) {
            return Ok(formulation);
        }
        Err(no_effect("formulation", &format!("--formulation {name}"), (registry, entry), differs))
    }

    fn stepping(&self, registry: &Registry, scheme: Scheme) -> Result<Stepping, Failure> {
        let name = scheme.name();
        match (scheme.is_adaptive(), self.tolerance, self.step) {
            (true, tolerance, None) => {
                Ok(Stepping::adaptive(scheme, tolerance.unwrap_or(Stepping::DEFAULT_TOLERANCE))?)
            }
            (false, None, step) => Ok(Stepping::fixed(scheme, step.unwrap_or(Stepping::DEFAULT_STEP))?),
            (true, _, Some(_)) => {
                let message = format!("--step is for {}; {name} takes --tolerance", schemes_with_a_step(registry));
                Err(Failure::usage("step", message))
            }
            (false, Some(_), _) => Err(Failure::usage("tolerance", format!("--tolerance: {name} takes --step"))),
        }
    }
}

/// The error of an option, `given` so, that has an effect with other solvers of the registry than this one.
fn no_effect(
    option: &'static str,
    given: &str,
    (registry, entry): (&Registry, &SolverEntry),
    has_effect: impl Fn(&SolverEntry) -> bool,
) -> Failure {
    let (name, others) = (entry.name(), solvers(registry, has_effect));
    Failure::usage(option, format!("{given} has no effect with --solver {name}; it is for {others}"))
}

/// What `--help` says of the option called `name`, if it is one of these options.
pub(crate) fn help(registry: &Registry, name: &str) -> Option<String> {
    let help = match name {
        "solver" => solver_help,
        "scheme" => scheme_help,
        "tolerance" => tolerance_help,
        "step" => step_help,
        "formulation" => formulation_help,
        _ => return None,
    };
    Some(help(registry))
}

fn solver_help(registry: &Registry) -> String {
    format!("The solver: {}", solvers(registry, |_| true))
}

fn step_help(registry: &Registry) -> String {
    format!("Step of {} (s) [default: {}]", schemes_with_a_step(registry), Stepping::DEFAULT_STEP)
}

fn scheme_help(registry: &Registry) -> String {
    let (schemes, default) = (schemes(registry, |_| true), Stepping::DEFAULT.scheme().name());
    format!(
        "Scheme by which the integrator steps: {schemes}; `unfair-toss solvers` lists those of each solver \
         [default: {default}, or the first one of the solver]"
    )
}

fn tolerance_help(registry: &Registry) -> String {
    let schemes = schemes(registry, Scheme::is_adaptive);
    format!("Local error per step of {schemes}, absolute and relative [default: {:e}]", Stepping::DEFAULT_TOLERANCE)
}

fn formulation_help(registry: &Registry) -> String {
    format!(
        "Formulation of the kinematics of an integrator: {} [default: {}]",
        formulations(registry),
        Formulation::default().name()
    )
}

/// The names of the schemes that take a fixed step.
fn schemes_with_a_step(registry: &Registry) -> String {
    schemes(registry, |scheme| !scheme.is_adaptive())
}

/// The names of the solvers for which `meant` is true, such as `gamma, euler or quaternion`.
pub(crate) fn solvers(registry: &Registry, meant: impl Fn(&SolverEntry) -> bool) -> String {
    one_of(registry.entries().iter().filter(|entry| meant(entry)).map(|entry| entry.name().to_owned()))
}

/// The names of the schemes for which `meant` is true, such as `dop853, dopri5 or taylor`.
pub(crate) fn schemes(registry: &Registry, meant: impl Fn(Scheme) -> bool) -> String {
    one_of(all_schemes(registry).into_iter().filter(|scheme| meant(*scheme)).map(|scheme| scheme.name().to_owned()))
}

/// The names of the formulations, each with its behaviour at singular points.
fn formulations(registry: &Registry) -> String {
    one_of(each_once(registry.entries().iter().flat_map(SolverEntry::formulations)).into_iter().map(
        |formulation: Formulation| {
            let words = match (formulation.frame(), formulation.is_guarded()) {
                (_, false) => "as the paper prints it: an answer may be wrong without an error",
                (Frame::Momentum, true) => "no flight is singular",
                (Frame::Vertical, true) => "the paper's frame: a typed error where it is singular",
            };
            format!("{} ({words})", formulation.name())
        },
    ))
}

/// Every scheme that any solver offers, once.
fn all_schemes(registry: &Registry) -> Vec<Scheme> {
    each_once(registry.entries().iter().flat_map(SolverEntry::schemes))
}

fn each_once<'a, T: Copy + PartialEq + 'a>(items: impl Iterator<Item = &'a T>) -> Vec<T> {
    items.fold(Vec::new(), |mut all, item| {
        if !all.contains(item) {
            all.push(*item);
        }
        all
    })
}

/// Joins the items as in `a, b or c`.
fn one_of(items: impl Iterator<Item = String>) -> String {
    let mut items: Vec<String> = items.collect();
    match (items.pop(), items.is_empty()) {
        (Some(last), false) => format!("{} or {last}", items.join(", ")),
        (last, _) => last.unwrap_or_default(),
    }
}
