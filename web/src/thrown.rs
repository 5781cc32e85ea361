//! A scene: the body and its launch as texts, with or without units, which is how a person types them and how the address
//! of the page holds them. Its keys are the options of the command line.

use std::collections::BTreeMap;

use dynamics::thrown::Field;
use sampling::Space;
use serde::Deserialize;
use toss::quantity::Rounding;
use toss::{CoinToss, Error, InputError, Toss};

/// A body and its launch as texts. Numbers without a unit are in SI units and radians.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(transparent)]
pub struct Scene(BTreeMap<String, Option<Text>>);

/// The text of a field; a rate has one for each component.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Text {
    One(String),
    Rates([String; 3]),
}

/// The toss that a scene describes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Thrown {
    pub(crate) toss: Toss,
    /// A turn of the launch about the x axis of LF (rad).
    pub(crate) tilt: f64,
    /// What the conversion of units has rounded.
    pub(crate) rounding: Rounding,
}

impl Scene {
    /// Reads the texts.
    pub(crate) fn thrown(&self) -> Result<Thrown, Error> {
        let mut thrown = dynamics::Thrown::default();
        for (name, text) in &self.0 {
            match (Field::named(name)?, text) {
                (_, None) => {}
                (Field::Rate, Some(Text::Rates(texts))) => {
                    let axes = [Field::RateX, Field::RateY, Field::RateZ].into_iter().zip(texts);
                    axes.into_iter().try_for_each(|(axis, text)| thrown.set(axis, text))?;
                }
                (field, Some(Text::One(text))) => thrown.set(field, text)?,
                (field, Some(Text::Rates(texts))) => thrown.set(field, &texts.join(","))?,
            }
        }
        let toss = thrown.toss()?;
        let components = || format!("{:?}", toss.launch.attitude().components());
        let tilt = toss.launch.tilt().ok_or_else(|| malformed("attitude", &components(), "a tilt"))?;
        Ok(Thrown { toss, tilt, rounding: Rounding::of(&thrown) })
    }
}

impl Thrown {
    /// The toss of a coin; `None` of a body with I1 ≠ I2.
    pub(crate) fn coin(&self) -> Option<CoinToss> {
        self.toss.coin()
    }

    /// The space that consists of this toss alone.
    ///
    /// # Errors
    /// As [`Space::of`].
    pub(crate) fn space(&self) -> Result<Space, InputError> {
        Space::of(&self.toss)
    }
}

pub(crate) fn malformed(field: &'static str, text: &str, expected: &'static str) -> InputError {
    InputError::Malformed { field, value: text.to_owned(), expected }
}
