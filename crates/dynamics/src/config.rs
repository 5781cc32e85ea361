//! [`SolverConfig`], the choice of a solver by its name with the settings that it is to have. A configuration file holds it;
//! what it leaves out, the solver's entry decides.

use crate::entry::{Settings, SolverEntry};
use crate::error::{InputError, find_named};
use crate::formulation::Formulation;
use crate::scheme::Scheme;
use crate::stepping::{StepControl, Stepping};

/// A solver's name, and those of its settings that are not left to their defaults.
///
/// The numbers are within their ranges. Whether there is such a solver, and whether it has such a scheme, is known to the
/// registry that it is looked up in.
///
/// ```
/// use dynamics::SolverConfig;
///
/// let config = SolverConfig::new("quaternion").with_scheme("dop853").with_tolerance(1e-9)?;
/// assert_eq!((config.name(), config.scheme()), ("quaternion", Some("dop853")));
/// assert_eq!(config.with_tolerance(2.0).unwrap_err().field(), "tolerance");
/// # Ok::<(), dynamics::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "crate::data::settings::ConfigData", into = "crate::data::settings::ConfigData")
)]
pub struct SolverConfig {
    name: String,
    scheme: Option<String>,
    control: Option<StepControl>,
    formulation: Option<Formulation>,
}

impl SolverConfig {
    /// The solver called `name`, with default settings.
    pub fn new(name: impl Into<String>) -> Self {
        Self { name: name.into(), scheme: None, control: None, formulation: None }
    }

    /// The same solver with the scheme called `scheme`.
    #[must_use]
    pub fn with_scheme(self, scheme: impl Into<String>) -> Self {
        Self { scheme: Some(scheme.into()), ..self }
    }

    /// The same solver with steps that keep the local error below `tolerance`, instead of any step. Fails with
    /// [`InputError::OutOfRange`] for a tolerance below ε = 2^-52 or not below 1.
    pub fn with_tolerance(self, tolerance: f64) -> Result<Self, InputError> {
        self.with_control(StepControl::Tolerance(tolerance))
    }

    /// The same solver with equal steps of at most `step` (s), instead of any tolerance. Fails with
    /// [`InputError::OutOfRange`] for a step that is not positive and finite.
    pub fn with_step(self, step: f64) -> Result<Self, InputError> {
        self.with_control(StepControl::Step(step))
    }

    fn with_control(self, control: StepControl) -> Result<Self, InputError> {
        // Every scheme has the ranges of this one.
        Stepping::new(Stepping::DEFAULT.scheme(), Some(control))?;
        Ok(Self { control: Some(control), ..self })
    }

    /// The same solver in this formulation.
    #[must_use]
    pub fn with_formulation(self, formulation: Formulation) -> Self {
        Self { formulation: Some(formulation), ..self }
    }

    /// The solver's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The name of the scheme, if one is chosen.
    pub fn scheme(&self) -> Option<&str> {
        self.scheme.as_deref()
    }

    /// The tolerance or the step, if one is chosen.
    pub fn control(&self) -> Option<StepControl> {
        self.control
    }

    /// The formulation, if one is chosen.
    pub fn formulation(&self) -> Option<Formulation> {
        self.formulation
    }

    /// The settings for the solver of this name among `entries`: what is left out is the solver's default. Fails for a
    /// solver that is not among them, for a scheme that it does not offer, for a tolerance or a step that the scheme
    /// does not take, and for any setting that would have no effect, with the solvers that it is for.
    pub fn settings(&self, entries: &[SolverEntry]) -> Result<Settings, InputError> {
        let entry = find_named("solver", &self.name, entries, |entry| entry.name())?;
        let scheme = match &self.scheme {
            None => entry.default_scheme(),
            Some(name) if entry.integrates() => Some(entry.scheme(name)?),
            // A closed form takes no scheme, but a name that is none is the clearer complaint.
            Some(name) => Some(known_scheme(name, entries)?),
        };
        let control = self.control.map(|control| match control {
            StepControl::Tolerance(tolerance) => ("tolerance", format!("{tolerance:?}")),
            StepControl::Step(step) => ("step [s]", format!("{step:?}")),
        });
        let stepped = self.scheme.clone().map(|scheme| ("scheme", scheme)).or(control);
        if let Some((field, value)) = stepped.filter(|_| !entry.integrates()) {
            return Err(self.no_effect(field, value, entries, SolverEntry::integrates));
        }
        let offers = |entry: &SolverEntry| self.formulation.is_none_or(|wanted| entry.formulations().contains(&wanted));
        if let Some(formulation) = self.formulation.filter(|_| !offers(entry)) {
            return Err(self.no_effect("formulation", formulation.to_string(), entries, offers));
        }
        let formulation = self.formulation.unwrap_or_default();
        let default = Settings { formulation, ..Settings::default() };
        scheme
            .map_or(Ok(default), |scheme| Ok(Settings { stepping: Stepping::new(scheme, self.control)?, formulation }))
    }

    fn no_effect(
        &self,
        field: &'static str,
        value: String,
        entries: &[SolverEntry],
        has_effect: impl Fn(&SolverEntry) -> bool,
    ) -> InputError {
        let others = one_of(entries.iter().filter(|entry| has_effect(entry)).map(SolverEntry::name));
        let with = format!("solver '{}'; it is for {others}", self.name);
        InputError::NoEffect { field, value, with }
    }
}

/// The scheme called `name`, if any of the solvers offers it.
fn known_scheme(name: &str, entries: &[SolverEntry]) -> Result<Scheme, InputError> {
    let all = entries.iter().flat_map(SolverEntry::schemes).fold(Vec::new(), |mut all, scheme| {
        if !all.contains(scheme) {
            all.push(*scheme);
        }
        all
    });
    find_named("scheme", name, &all, |scheme| scheme.name()).copied()
}

/// Joins names as in `a, b or c`.
pub fn one_of<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let mut names: Vec<&str> = names.into_iter().collect();
    match (names.pop(), names.is_empty()) {
        (Some(last), false) => format!("{} or {last}", names.join(", ")),
        (last, _) => last.unwrap_or_default().to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An entry with these schemes, whose solver is never made.
    fn entry(schemes: &[Scheme]) -> SolverEntry {
        let formulations: &[Formulation] = if schemes.is_empty() { &[] } else { &[Formulation::MOMENTUM] };
        let never = SolverEntry::new("own", "", |_| unreachable!("no solver is made here"));
        never.with_schemes(schemes).with_formulations(formulations)
    }

    #[test]
    fn what_is_left_out_is_the_default_of_the_solver() {
        let own = SolverConfig::new("own");
        let stepping = |config: &SolverConfig, schemes: &[Scheme]| Ok(config.settings(&[entry(schemes)])?.stepping);
        assert_eq!(own.settings(&[entry(&Scheme::ALL)]), Ok(Settings::default()));
        assert_eq!(own.settings(&[entry(&[])]), Ok(Settings::default()));
        assert_eq!(stepping(&own, &[Scheme::RK4]), Stepping::fixed(Scheme::RK4, Stepping::DEFAULT_STEP));
        let fine = own.clone().with_tolerance(1e-6).unwrap();
        assert_eq!(stepping(&fine, &Scheme::ALL), Stepping::adaptive(Scheme::DOP853, 1e-6));
        let stepped = own.with_scheme("dopri5").with_step(0.25).unwrap();
        assert_eq!(stepping(&stepped, &Scheme::ALL), Stepping::fixed(Scheme::DOPRI5, 0.25));
    }

    #[test]
    fn a_formulation_is_passed_on_with_and_without_schemes() {
        let own = SolverConfig::new("own").with_formulation(Formulation::RAW);
        for schemes in [&Scheme::ALL[..], &[]] {
            let entry = entry(schemes).with_formulations(&[Formulation::MOMENTUM, Formulation::RAW]);
            assert_eq!(own.settings(&[entry]).unwrap().formulation, Formulation::RAW);
        }
    }

    #[test]
    fn what_would_have_no_effect_or_is_not_offered_is_refused() {
        let own = || SolverConfig::new("own");
        let fields = |config: SolverConfig| {
            [&Scheme::ALL[..], &[]].map(|schemes| config.settings(&[entry(schemes)]).err().map(|error| error.field()))
        };
        assert_eq!(fields(own().with_scheme("heun")), [Some("scheme of this solver"), Some("scheme")]);
        assert_eq!(fields(own().with_tolerance(1e-9).unwrap()), [None, Some("tolerance")]);
        assert_eq!(fields(own().with_step(0.1).unwrap()), [None, Some("step [s]")]);
        let without = [entry(&[]), entry(&[Scheme::RK4]), entry(&Scheme::ALL)];
        let Err(InputError::UnknownName { known, .. }) = own().with_scheme("heun").settings(&without) else { panic!() };
        assert_eq!(known.matches("rk4").count(), 1, "{known}");
        let raw = own().with_formulation(Formulation::RAW);
        assert_eq!(fields(raw), [Some("formulation"), Some("formulation")]);
        let rk4_by_tolerance = own().with_scheme("rk4").with_tolerance(1e-9).unwrap();
        assert_eq!(fields(rk4_by_tolerance), [Some("scheme with a tolerance"), Some("scheme")]);
        for step in [0.0, -1.0, f64::NAN] {
            assert_eq!(own().with_step(step).unwrap_err().field(), "step [s]");
        }
        assert_eq!(own().with_tolerance(f64::NAN).unwrap_err().field(), "tolerance");
    }
}
