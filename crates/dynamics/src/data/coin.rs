//! Coins and other bodies as plain data: a name, moments, a cylinder or an inertia tensor.

use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::number::{Number, exactly, twice};
use crate::body::Body;
use crate::coin::{Coin, NO_COIN};
use crate::error::InputError;
use crate::quantity::Dimension;

/// A body as it stands in a file, unless it is given by its name.
#[derive(Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct BodyData {
    #[serde(skip_serializing_if = "Option::is_none")]
    moments: Option<Vec<Number>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cylinder: Option<Vec<Number>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    inertia: Option<Vec<Number>>,
}

/// The field of a cylinder, and what its three numbers are.
const CYLINDER: &str = "cylinder [kg, m, m]";
const OF_CYLINDER: [Dimension; 3] = [Dimension::Mass, Dimension::Length, Dimension::Length];

impl TryFrom<BodyData> for Body {
    type Error = InputError;

    fn try_from(data: BodyData) -> Result<Self, InputError> {
        match (data.moments, data.cylinder, data.inertia) {
            (Some(moments), None, None) => {
                let si = |number: &Number| number.si("moments [kg m²]", Dimension::Inertia);
                Self::from_listed_moments(&moments.iter().map(si).collect::<Result<Vec<f64>, _>>()?)
            }
            (None, Some(cylinder), None) => {
                let numbers: [Number; 3] = exactly(CYLINDER, cylinder, "[mass, radius, thickness]")?;
                let quantity = |index: usize| Ok(numbers[index].given(CYLINDER, OF_CYLINDER[index])?.quantity());
                Coin::from_cylinder(quantity(0)?, quantity(1)?, quantity(2)?).map(Self::from)
            }
            (None, None, Some(inertia)) => {
                let field = "inertia [kg m²]";
                let numbers: [Number; 6] = exactly(field, inertia, "[Jxx, Jyy, Jzz, Jxy, Jxz, Jyz]")?;
                let mut elements = [0.0; 6];
                for (element, number) in elements.iter_mut().zip(&numbers) {
                    *element = number.si(field, Dimension::Inertia)?;
                }
                Self::from_inertia(elements)
            }
            (None, None, None) => Err(InputError::Missing { field: "coin", expected: BODY }),
            _ => Err(twice("coin", "one of moments, cylinder and inertia")),
        }
    }
}

/// What a body may be written as.
const BODY: &str = "a name, { moments = [I1, I3] } or [I1, I2, I3], { cylinder = [mass, radius, thickness] } or \
                    { inertia = [Jxx, Jyy, Jzz, Jxy, Jxz, Jyz] }";

/// Reads a body by its name or from its table.
struct BodyVisitor;

impl<'de> Visitor<'de> for BodyVisitor {
    type Value = Body;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(BODY)
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Body, E> {
        name.parse().map_err(E::custom)
    }

    fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<Body, A::Error> {
        BodyData::deserialize(MapAccessDeserializer::new(table))?.try_into().map_err(A::Error::custom)
    }
}

impl<'de> Deserialize<'de> for Body {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(BodyVisitor)
    }
}

/// A cylinder is written as it was given.
impl Serialize for Body {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let si = |numbers: &[f64]| Some(numbers.iter().copied().map(Number::Si).collect());
        let number = |(quantity, dimension)| Number::of_quantity(quantity, dimension);
        let data = match (self, self.moments()) {
            (Self::Coin(coin), _) => match coin.cylinder() {
                Some(given) => {
                    let cylinder = Some(given.into_iter().zip(OF_CYLINDER).map(number).collect());
                    BodyData { cylinder, ..BodyData::default() }
                }
                None => BodyData { moments: si(&[coin.i1(), coin.i3()]), ..BodyData::default() },
            },
            (_, Some(moments)) => BodyData { moments: si(&moments), ..BodyData::default() },
            (_, None) => BodyData { inertia: si(&self.inertia()), ..BodyData::default() },
        };
        data.serialize(to)
    }
}

/// The coin that a body in a file is, if it is one.
impl TryFrom<Body> for Coin {
    type Error = InputError;

    fn try_from(body: Body) -> Result<Self, InputError> {
        body.coin().ok_or(NO_COIN)
    }
}
