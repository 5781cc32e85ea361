//! Settings of solvers as plain data, and all values that are written as a text.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::number::{Number, twice};
use crate::config::SolverConfig;
use crate::entry::Settings;
use crate::error::InputError;
use crate::formulation::Formulation;
use crate::outcome::Outcome;
use crate::quantity::{Dimension, Given};
use crate::scheme::Scheme;
use crate::stepping::{StepControl, Stepping};

/// Reads and writes values as the text of their `FromStr` and `Display`.
macro_rules! as_text {
    ($($text:ty),*) => {$(
        impl<'de> Deserialize<'de> for $text {
            fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
                String::deserialize(from)?.parse().map_err(D::Error::custom)
            }
        }

        impl Serialize for $text {
            fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                to.collect_str(self)
            }
        }
    )*};
}

as_text!(Scheme, Formulation, Outcome, Given);

/// A scheme and its step control as they stand in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SteppingData {
    #[serde(skip_serializing_if = "Option::is_none")]
    scheme: Option<Scheme>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<Number>,
}

/// Settings as they stand in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SettingsData {
    #[serde(skip_serializing_if = "Option::is_none")]
    scheme: Option<Scheme>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    formulation: Option<Formulation>,
}

/// The choice of a solver as it stands in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ConfigData {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    scheme: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<Number>,
    #[serde(skip_serializing_if = "Option::is_none")]
    formulation: Option<Formulation>,
}

/// The step control that a tolerance or a step asks for.
fn control(tolerance: Option<f64>, step: Option<Number>) -> Result<Option<StepControl>, InputError> {
    match (tolerance, step) {
        (None, None) => Ok(None),
        (Some(tolerance), None) => Ok(Some(StepControl::Tolerance(tolerance))),
        (None, Some(step)) => Ok(Some(StepControl::Step(step.si("step [s]", Dimension::Time)?))),
        (Some(_), Some(_)) => Err(twice("step [s]", "either a tolerance or a step")),
    }
}

/// The tolerance and the step of a step control, one of which is given.
fn parts(control: Option<StepControl>) -> (Option<f64>, Option<Number>) {
    match control {
        None => (None, None),
        Some(StepControl::Tolerance(tolerance)) => (Some(tolerance), None),
        Some(StepControl::Step(step)) => (None, Some(Number::Si(step))),
    }
}

impl SteppingData {
    fn stepping(self) -> Result<Stepping, InputError> {
        let scheme = self.scheme.unwrap_or(Stepping::DEFAULT.scheme());
        Stepping::new(scheme, control(self.tolerance, self.step)?)
    }
}

impl<'de> Deserialize<'de> for Stepping {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        SteppingData::deserialize(from)?.stepping().map_err(D::Error::custom)
    }
}

impl Serialize for Stepping {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let (tolerance, step) = parts(Some(self.control()));
        SteppingData { scheme: Some(self.scheme()), tolerance, step }.serialize(to)
    }
}

impl<'de> Deserialize<'de> for Settings {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let SettingsData { scheme, tolerance, step, formulation } = SettingsData::deserialize(from)?;
        let stepping = SteppingData { scheme, tolerance, step }.stepping().map_err(D::Error::custom)?;
        Ok(Self { stepping, formulation: formulation.unwrap_or_default() })
    }
}

impl Serialize for Settings {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let (tolerance, step) = parts(Some(self.stepping.control()));
        let scheme = Some(self.stepping.scheme());
        SettingsData { scheme, tolerance, step, formulation: Some(self.formulation) }.serialize(to)
    }
}

impl TryFrom<ConfigData> for SolverConfig {
    type Error = InputError;

    fn try_from(data: ConfigData) -> Result<Self, InputError> {
        let named = Self::new(data.name);
        let with_scheme = data.scheme.into_iter().fold(named, Self::with_scheme);
        let formulated = data.formulation.into_iter().fold(with_scheme, Self::with_formulation);
        control(data.tolerance, data.step)?.map_or(Ok(formulated.clone()), |control| formulated.with_control(control))
    }
}

impl<'de> Deserialize<'de> for SolverConfig {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        ConfigData::deserialize(from)?.try_into().map_err(D::Error::custom)
    }
}

impl Serialize for SolverConfig {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let (tolerance, step) = parts(self.control());
        let (name, scheme) = (self.name().to_owned(), self.scheme().map(str::to_owned));
        ConfigData { name, scheme, tolerance, step, formulation: self.formulation() }.serialize(to)
    }
}
