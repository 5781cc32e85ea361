//! A scene: the body and its launch as texts, with or without units, which is how a person types them and how the address
//! of the page holds them. Its keys are the options of the command line.

use std::collections::BTreeMap;
use std::fmt;

use dynamics::thrown::Field;
use sampling::{Coordinate, Space};
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use toss::quantity::Rounding;
use toss::{CoinToss, Error, InputError, Toss};

/// A body and its launch as texts. Numbers without a unit are in SI units and radians.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(transparent)]
pub(crate) struct Scene(BTreeMap<String, Text>);

/// The text of a field; a rate may have one for each component.
#[derive(Debug, Clone)]
struct Text(Vec<String>);

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
        for (field, text) in self.texts()? {
            thrown.set(field, &text)?;
        }
        let toss = thrown.toss()?;
        let components = || format!("{:?}", toss.launch.attitude().components());
        let tilt = toss.launch.tilt().ok_or_else(|| malformed("attitude", &components(), "a tilt"))?;
        Ok(Thrown { toss, tilt, rounding: Rounding::of(&thrown) })
    }

    /// The launches whose inputs in `around` are not known exactly: each by a deviation, which makes its value the mean of
    /// a normal distribution, by a range or by a distribution.
    pub(crate) fn space(&self, around: &BTreeMap<String, String>) -> Result<Space, Error> {
        let toss = self.thrown()?.toss;
        let mut builder = Space::builder(toss.body);
        let mut left: Vec<Coordinate> = around.keys().map(|name| Coordinate::named(name)).collect::<Result<_, _>>()?;
        for (field, text) in self.texts()? {
            let Ok(of) = Coordinate::named(field.info().name) else { continue };
            left.retain(|other| *other != of);
            let spread =
                around.iter().find(|(name, _)| Coordinate::named(name) == Ok(of)).map(|(_, spread)| spread.trim());
            builder = match spread {
                None => builder.parse(of, &text)?,
                Some(axis) if axis.contains(':') => builder.parse(of, axis)?,
                Some(deviation) => builder.parse(of, &format!("normal:{}:{deviation}", text.trim()))?,
            };
        }
        if let Some(of) = left.first() {
            return Err(InputError::Missing { field: of.field(), expected: "a value, around which it may lie" }.into());
        }
        Ok(builder.build()?.with_drop(toss.launch.time_of_flight().drop().filter(|drop| *drop != 0.0))?)
    }

    /// Each field with its text; the components of a rate apart.
    fn texts(&self) -> Result<Vec<(Field, String)>, InputError> {
        let mut found = Vec::new();
        for (name, Text(parts)) in &self.0 {
            match (Field::named(name)?, &parts[..]) {
                (Field::Rate, [_, _, _]) => {
                    found.extend([Field::RateX, Field::RateY, Field::RateZ].into_iter().zip(parts.iter().cloned()));
                }
                (field, _) => found.push((field, parts.join(","))),
            }
        }
        Ok(found)
    }
}

/// A text, or a list of texts, without a copy of the question for each way to read it.
impl<'de> Deserialize<'de> for Text {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Texts;
        impl<'de> Visitor<'de> for Texts {
            type Value = Text;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a text or a list of texts")
            }

            fn visit_str<E>(self, text: &str) -> Result<Text, E> {
                Ok(Text(vec![text.to_owned()]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut parts: A) -> Result<Text, A::Error> {
                let mut texts = Vec::new();
                while let Some(text) = parts.next_element()? {
                    texts.push(text);
                }
                Ok(Text(texts))
            }
        }
        from.deserialize_any(Texts)
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
