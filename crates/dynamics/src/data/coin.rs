//! Coins and other bodies as plain data: a name, moments, a cylinder or an inertia tensor.

use std::fmt;
use std::marker::PhantomData;

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
struct BodyVisitor<T>(PhantomData<T>);

impl<'de, T: FromBody> Visitor<'de> for BodyVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(BODY)
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<T, E> {
        T::named(name).map_err(E::custom)
    }

    fn visit_map<A: MapAccess<'de>>(self, table: A) -> Result<T, A::Error> {
        let data = BodyData::deserialize(MapAccessDeserializer::new(table))?;
        Body::try_from(data).and_then(T::from_body).map_err(A::Error::custom)
    }
}

/// What is read from the data of a body.
trait FromBody: Sized {
    fn named(name: &str) -> Result<Self, InputError>;
    fn from_body(body: Body) -> Result<Self, InputError>;
}

impl FromBody for Body {
    fn named(name: &str) -> Result<Self, InputError> {
        name.parse()
    }

    fn from_body(body: Body) -> Result<Self, InputError> {
        Ok(body)
    }
}

impl FromBody for Coin {
    fn named(name: &str) -> Result<Self, InputError> {
        name.parse()
    }

    fn from_body(body: Body) -> Result<Self, InputError> {
        body.coin().ok_or(NO_COIN)
    }
}

impl<'de> Deserialize<'de> for Coin {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(BodyVisitor(PhantomData))
    }
}

impl<'de> Deserialize<'de> for Body {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(BodyVisitor(PhantomData))
    }
}

impl Serialize for Coin {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let number = |(quantity, dimension)| Number::of_quantity(quantity, dimension);
        let cylinder = self.cylinder().map(|given| given.into_iter().zip(OF_CYLINDER).map(number).collect());
        let moments = if cylinder.is_some() { None } else { Some([self.i1(), self.i3()].map(Number::Si).into()) };
        BodyData { moments, cylinder, inertia: None }.serialize(to)
    }
}

/// A body with I1 = I2 is written as the coin that it is.
impl Serialize for Body {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        if let Self::Coin(coin) = self {
            return coin.serialize(to);
        }
        let moments = self.moments().map(|moments| moments.map(Number::Si).into());
        let inertia = if moments.is_some() { None } else { Some(self.inertia().map(Number::Si).into()) };
        BodyData { moments, inertia, cylinder: None }.serialize(to)
    }
}
