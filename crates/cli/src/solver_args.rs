//! The options that choose a solver and its settings. Their help texts are made from the registry, so that a new solver
//! appears in them without a change here.

use clap::Args;
use dynamics::Frame;
use dynamics::error::find_named;
use toss::{
    Backend, Dimension, ExactSolver, Formulation, InputError, Registry, Scheme, Settings, SolverEntry, Stepping,
};

use crate::failure::Failure;
use crate::quantity;

/// The solver and its settings.
#[derive(Debug, Args)]
pub(crate) struct SolverArgs {
    #[arg(long, value_name = "NAME", default_value = ExactSolver::NAME,
          help = format!("The solver: {}", solvers(|_| true)))]
    solver: String,
    #[arg(long, value_name = "NAME", help = scheme_help())]
    scheme: Option<String>,
    #[arg(long, value_name = "TOL", allow_hyphen_values = true, help = tolerance_help())]
    tolerance: Option<f64>,
    #[arg(long, value_name = "H", allow_hyphen_values = true, value_parser = quantity::of(Dimension::Time),
          help = format!("Step of {} (s) [default: {}]", schemes_with_a_step(), Stepping::DEFAULT_STEP))]
    step: Option<f64>,
    #[arg(long, value_name = "NAME", alias = "frame", help = formulation_help())]
    formulation: Option<String>,
}

impl SolverArgs {
    /// The solver with its settings.
    pub(crate) fn backend(&self) -> Result<Backend, Failure> {
        let registry = Registry::standard();
        let entry = registry.named(&self.solver)?;
        let (scheme, formulation) = (self.scheme(entry)?, self.formulation(entry)?);
        self.require_steps(entry)?;
        Ok(registry.backend(&self.solver, &Settings { stepping: self.stepping(scheme)?, formulation })?)
    }

    fn scheme(&self, entry: &SolverEntry) -> Result<Scheme, InputError> {
        match self.scheme.as_deref() {
            None => Ok(default_scheme(entry)),
            Some(name) if entry.integrates() => entry.scheme(name),
            // A closed form is refused any scheme, but a name that is none is the clearer complaint.
            Some(name) => find_named("scheme", name, &all_schemes(), |scheme| scheme.name()).copied(),
        }
    }

    /// Refuses what would have no effect with a solver that takes no steps.
    fn require_steps(&self, entry: &SolverEntry) -> Result<(), Failure> {
        let given =
            [("scheme", self.scheme.is_some()), ("tolerance", self.tolerance.is_some()), ("step", self.step.is_some())];
        match given.into_iter().find(|(_, given)| *given) {
            Some((option, _)) if !entry.integrates() => {
                Err(no_effect(option, &format!("--{option}"), entry, SolverEntry::integrates))
            }
            _ => Ok(()),
        }
    }

    fn formulation(&self, entry: &SolverEntry) -> Result<Formulation, Failure> {
        let Some(name) = &self.formulation else { return Ok(Formulation::default()) };
        let formulation = Formulation::named(name)?;
        let differs = |entry: &SolverEntry| entry.formulations().contains(&formulation);
        if differs(entry) {
            return Ok(formulation);
        }
        Err(no_effect("formulation", &format!("--formulation {name}"), entry, differs))
    }

    fn stepping(&self, scheme: Scheme) -> Result<Stepping, Failure> {
        let name = scheme.name();
        match (scheme.is_adaptive(), self.tolerance, self.step) {
            (true, tolerance, None) => {
                Ok(Stepping::adaptive(scheme, tolerance.unwrap_or(Stepping::DEFAULT_TOLERANCE))?)
            }
            (false, None, step) => Ok(Stepping::fixed(scheme, step.unwrap_or(Stepping::DEFAULT_STEP))?),
            (true, _, Some(_)) => {
                let message = format!("--step is for {}; {name} takes --tolerance", schemes_with_a_step());
                Err(Failure::usage("step", message))
            }
            (false, Some(_), _) => Err(Failure::usage("tolerance", format!("--tolerance: {name} takes --step"))),
        }
    }
}

/// The error of an option, `given` so, that has an effect with other solvers than `entry`.
fn no_effect(
    option: &'static str,
    given: &str,
    entry: &SolverEntry,
    has_effect: impl Fn(&SolverEntry) -> bool,
) -> Failure {
    let (name, others) = (entry.name(), solvers(has_effect));
    Failure::usage(option, format!("{given} has no effect with --solver {name}; it is for {others}"))
}

/// The scheme that is used if no `--scheme` is given.
fn default_scheme(entry: &SolverEntry) -> Scheme {
    let default = Stepping::DEFAULT.scheme();
    if entry.schemes().contains(&default) { default } else { entry.schemes().first().copied().unwrap_or(default) }
}

fn scheme_help() -> String {
    let (schemes, default) = (schemes(|_| true), Stepping::DEFAULT.scheme().name());
    format!(
        "Scheme by which the integrator steps: {schemes}; `unfair-toss solvers` lists those of each solver \
         [default: {default}, or the first one of the solver]"
    )
}

fn tolerance_help() -> String {
    let schemes = schemes(Scheme::is_adaptive);
    format!("Local error per step of {schemes}, absolute and relative [default: {:e}]", Stepping::DEFAULT_TOLERANCE)
}

fn formulation_help() -> String {
    format!(
        "Formulation of the kinematics of an integrator: {} [default: {}]",
        formulations(),
        Formulation::default().name()
    )
}

/// The names of the schemes that take a fixed step.
fn schemes_with_a_step() -> String {
    schemes(|scheme| !scheme.is_adaptive())
}

/// The names of the solvers for which `meant` is true, such as `gamma, euler or quaternion`.
pub(crate) fn solvers(meant: impl Fn(&SolverEntry) -> bool) -> String {
    one_of(entries().filter(|entry| meant(entry)).map(|entry| entry.name().to_owned()))
}

/// The names of the schemes for which `meant` is true, such as `dop853, dopri5 or taylor`.
pub(crate) fn schemes(meant: impl Fn(Scheme) -> bool) -> String {
    one_of(all_schemes().into_iter().filter(|scheme| meant(*scheme)).map(|scheme| scheme.name().to_owned()))
}

/// The names of the formulations, each with its behaviour at singular points.
fn formulations() -> String {
    one_of(each_once(entries().flat_map(SolverEntry::formulations)).into_iter().map(|formulation: Formulation| {
        let words = match (formulation.frame(), formulation.is_guarded()) {
            (_, false) => "as the paper prints it: an answer may be wrong without an error",
            (Frame::Momentum, true) => "no flight is singular",
            (Frame::Vertical, true) => "the paper's frame: a typed error where it is singular",
        };
        format!("{} ({words})", formulation.name())
    }))
}

/// Every scheme that any solver offers, once.
fn all_schemes() -> Vec<Scheme> {
    each_once(entries().flat_map(SolverEntry::schemes))
}

fn entries() -> impl Iterator<Item = &'static SolverEntry> {
    Registry::standard().entries().iter()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solver_without_the_default_scheme_uses_its_first_scheme() {
        let offers = |schemes: &[Scheme]| SolverEntry::new("own", "", |_| Box::new(ExactSolver)).with_schemes(schemes);
        assert_eq!(default_scheme(&offers(&[Scheme::RK4, Scheme::DOP853])), Scheme::DOP853);
        assert_eq!(default_scheme(&offers(&[Scheme::RK4, Scheme::DOPRI5])), Scheme::RK4);
        assert_eq!(default_scheme(&offers(&[])), Scheme::DOP853);
    }
}
