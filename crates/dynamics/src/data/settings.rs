//! The choice of a solver as plain data, and outcomes, which are written by their names.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::number::Number;
use crate::config::SolverConfig;
use crate::error::InputError;
use crate::formulation::Formulation;
use crate::outcome::Outcome;
use crate::quantity::Dimension;
use crate::stepping::StepControl;

impl<'de> Deserialize<'de> for Formulation {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        String::deserialize(from)?.parse().map_err(D::Error::custom)
    }
}

impl Serialize for Formulation {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(self)
    }
}

impl Serialize for Outcome {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(self)
    }
}

/// The choice of a solver as it stands in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ConfigData {
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

impl TryFrom<ConfigData> for SolverConfig {
    type Error = InputError;

    fn try_from(data: ConfigData) -> Result<Self, InputError> {
        let named = Self::new(data.name);
        let with_scheme = data.scheme.into_iter().fold(named, Self::with_scheme);
        let formulated = data.formulation.into_iter().fold(with_scheme, Self::with_formulation);
        match (data.tolerance, data.step) {
            (None, None) => Ok(formulated),
            (Some(tolerance), None) => formulated.with_tolerance(tolerance),
            (None, Some(Number::Si(step))) => formulated.with_step(step),
            (None, Some(Number::Text(step))) => formulated.with_step(Dimension::Time.read("step [s]", &step)?),
            (Some(_), Some(_)) => {
                let (value, expected) = ("given twice".to_owned(), "either a tolerance or a step");
                Err(InputError::Malformed { field: "step [s]", value, expected })
            }
        }
    }
}

impl From<SolverConfig> for ConfigData {
    fn from(config: SolverConfig) -> Self {
        let (tolerance, step) = match config.control() {
            None => (None, None),
            Some(StepControl::Tolerance(tolerance)) => (Some(tolerance), None),
            Some(StepControl::Step(step)) => (None, Some(Number::Si(step))),
        };
        let (name, scheme) = (config.name().to_owned(), config.scheme().map(str::to_owned));
        Self { name, scheme, tolerance, step, formulation: config.formulation() }
    }
}
