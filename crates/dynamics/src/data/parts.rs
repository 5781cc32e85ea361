//! Tosses and their parts as plain data: bodies, attitudes and launches. Their fields are those of [`Thrown`], which refuses
//! what contradicts itself. A field is refused where it stands, so that the error has its place in the file.

use std::fmt;

use serde::de::{DeserializeSeed, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::number::Number;
use crate::attitude::Attitude;
use crate::body::Body;
use crate::coin::{Coin, NO_COIN};
use crate::error::InputError;
use crate::launch::Launch;
use crate::quantity::{Given, common_unit};
use crate::thrown::{Field, Holds, Thrown};
use crate::toss::Toss;

/// A part of a toss, as it may be written.
struct Part {
    /// What is called by a name, and what is a list.
    name: Option<Field>,
    list: Option<Field>,
    /// The names in its table.
    fields: &'static [&'static str],
    /// All of this in words.
    expected: &'static str,
    /// Refuses what is wrong with it, so that the error has the place of the part.
    check: fn(&Thrown) -> Result<(), InputError>,
}

static BODY: Part = Part {
    name: Some(Field::Coin),
    list: None,
    fields: &["moments", "cylinder", "inertia"],
    expected: "a name, { moments = [I1, I3] } or [I1, I2, I3], { cylinder = [mass, radius, thickness] } or { inertia = \
               [Jxx, Jyy, Jzz, Jxy, Jxz, Jyz] }",
    check: |thrown| thrown.body().map(drop),
};

static ATTITUDE: Part = Part {
    name: None,
    list: Some(Field::Attitude),
    fields: &["tilt", "unit_quaternion"],
    expected: "[w, x, y, z], { tilt = ANGLE } or { unit_quaternion = [w, x, y, z] }",
    check: |thrown| thrown.attitude().map(drop),
};

/// The names of a launch, those of a precession first.
const LAUNCH_FIELDS: &[&str] = &[
    "turn",
    "psi",
    "rate",
    "speed",
    "gravity",
    "drop",
    "time",
    "tilt",
    "attitude",
    "unit_quaternion",
    "drag",
    "bounce",
    "wobble",
];

/// The last of them, which are known only to be refused with the reason.
const REFUSED: [&str; 3] = ["drag", "bounce", "wobble"];

static LAUNCH_OF_BODY: Part = Part {
    name: None,
    list: None,
    fields: LAUNCH_FIELDS,
    expected: "the table of a launch",
    // Which body it is makes no difference but for a precession, and the toss sees to that.
    check: |thrown| thrown.launch(&Coin::PAPER.into(), thrown.time_of_flight()?).map(drop),
};

/// A launch without its body, from which the rate of a precession would follow.
static LAUNCH: Part = Part { fields: LAUNCH_FIELDS.split_at(2).1, ..LAUNCH_OF_BODY };

static TOSS: Part = Part {
    name: None,
    list: None,
    fields: &["coin", "body", "launch"],
    expected: "the table of a coin and a launch",
    check: |_| Ok(()),
};

/// Reads a part into the fields of a toss.
struct Reader<'a> {
    part: &'static Part,
    thrown: &'a mut Thrown,
}

impl<'de> DeserializeSeed<'de> for Reader<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        from.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Reader<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.part.expected)
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<(), E> {
        let refused = || E::invalid_type(serde::de::Unexpected::Str(text), &self.part.expected);
        self.thrown.set(self.part.name.ok_or_else(refused)?, text).map_err(E::custom)?;
        (self.part.check)(self.thrown).map_err(E::custom)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let refused = || A::Error::invalid_type(serde::de::Unexpected::Seq, &self.part.expected);
        let field = self.part.list.ok_or_else(refused)?;
        let mut numbers = Vec::new();
        while let Some(number) = list.next_element()? {
            numbers.push(number);
        }
        put(self.thrown, field, &numbers).map_err(A::Error::custom)?;
        (self.part.check)(self.thrown).map_err(A::Error::custom)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut table: A) -> Result<(), A::Error> {
        let Self { part, thrown } = self;
        let mut is_empty = true;
        while let Some(name) = table.next_key_seed(Name(part))? {
            is_empty = false;
            let inner = match name {
                "coin" | "body" => &BODY,
                "attitude" => &ATTITUDE,
                "launch" => &LAUNCH_OF_BODY,
                _ => {
                    let field = Field::named(name).map_err(A::Error::custom)?;
                    table.next_value_seed(Value { field, thrown })?;
                    continue;
                }
            };
            table.next_value_seed(Reader { part: inner, thrown })?;
        }
        let missing = part.name.or(part.list).filter(|_| is_empty);
        let missing = missing.map(|field| InputError::Missing { field: field.info().name, expected: part.expected });
        missing.map_or_else(|| (part.check)(thrown), Err).map_err(A::Error::custom)
    }
}

/// Reads one of the names in the table of a part.
struct Name(&'static Part);

impl<'de> DeserializeSeed<'de> for Name {
    type Value = &'static str;

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<&'static str, D::Error> {
        let name = String::deserialize(from)?;
        let known = self.0.fields.iter().find(|known| **known == name).copied();
        let taken = self.0.fields.strip_suffix(&REFUSED).unwrap_or(self.0.fields);
        known.ok_or_else(|| D::Error::unknown_field(&name, taken))
    }
}

/// Reads the value of a field: a number, a text or a list of them.
struct Value<'a> {
    field: Field,
    thrown: &'a mut Thrown,
}

#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a number in SI units, or a text with a unit like \"24mm\"")]
enum Written {
    One(Number),
    List(Vec<Number>),
}

impl<'de> DeserializeSeed<'de> for Value<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, from: D) -> Result<(), D::Error> {
        let Self { field, thrown } = self;
        let read = if field.info().holds == Holds::Refused {
            IgnoredAny::deserialize(from)?;
            thrown.set(field, "")
        } else {
            match Written::deserialize(from)? {
                Written::One(Number::Text(text)) => thrown.set(field, &text),
                Written::One(number) => put(thrown, field, &[number]),
                Written::List(numbers) => put(thrown, field, &numbers),
            }
        };
        read.and_then(|()| require_one_unit(thrown)).map_err(D::Error::custom)
    }
}

/// Gives `field` by its numbers.
fn put(thrown: &mut Thrown, field: Field, numbers: &[Number]) -> Result<(), InputError> {
    let info = field.info();
    let malformed =
        || InputError::Malformed { field: info.name, value: format!("{numbers:?}"), expected: info.expected };
    let kinds = info.holds.kinds(numbers.len()).ok_or_else(malformed)?;
    let given = kinds.iter().zip(numbers).map(|(kind, number)| match number {
        Number::Si(value) => Ok(kind.in_si(*value)),
        Number::Text(text) => kind.given(info.label, text),
    });
    thrown.put(field, given.collect::<Result<_, _>>()?)
}

/// Refuses a rate that [`Thrown::launch`] would round: a file has no place to say so.
fn require_one_unit(thrown: &Thrown) -> Result<(), InputError> {
    match thrown.numbers(Field::Rate) {
        rate if rate.is_empty() || common_unit(rate).is_some() => Ok(()),
        rate => {
            let value = rate.iter().map(ToString::to_string).collect::<Vec<_>>().join(",");
            Err(InputError::Malformed { field: "rate", value, expected: "three numbers in one unit" })
        }
    }
}

/// The fields of a part in a file.
fn thrown<'de, D: Deserializer<'de>>(part: &'static Part, from: D) -> Result<Thrown, D::Error> {
    let mut thrown = Thrown::default();
    Reader { part, thrown: &mut thrown }.deserialize(from)?;
    Ok(thrown)
}

impl<'de> Deserialize<'de> for Body {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let body = thrown(&BODY, from)?.body().map_err(D::Error::custom)?;
        body.ok_or_else(|| D::Error::custom("a body"))
    }
}

impl<'de> Deserialize<'de> for Attitude {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let attitude = thrown(&ATTITUDE, from)?.attitude().map_err(D::Error::custom)?;
        attitude.ok_or_else(|| D::Error::custom("an attitude"))
    }
}

impl<'de> Deserialize<'de> for Launch {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        thrown(&LAUNCH, from)?.toss().map(|toss| toss.launch).map_err(D::Error::custom)
    }
}

impl<'de> Deserialize<'de> for Toss {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        thrown(&TOSS, from)?.toss().map_err(D::Error::custom)
    }
}

/// Writes the fields as a table.
fn table<S: Serializer>(thrown: &Thrown, to: S) -> Result<S::Ok, S::Error> {
    let mut table = to.serialize_map(None)?;
    for (field, numbers) in thrown.given() {
        let name = field.info().name;
        match (field.info().holds, numbers) {
            (Holds::One(_), [number]) => table.serialize_entry(name, &Number::from(number))?,
            _ => table.serialize_entry(name, &list(numbers))?,
        }
    }
    table.end()
}

fn list(numbers: &[Given]) -> Vec<Number> {
    numbers.iter().map(Number::from).collect()
}

/// A cylinder is written as it was given.
impl Serialize for Body {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        table(&Thrown::default().with_body(self), to)
    }
}

impl Serialize for Attitude {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let thrown = Thrown::default().with_attitude(self);
        match thrown.numbers(Field::Attitude) {
            [] => table(&thrown, to),
            components => list(components).serialize(to),
        }
    }
}

impl Serialize for Launch {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        table(&Thrown::default().with_launch(self), to)
    }
}

/// The coin that a body in a file is, if it is one.
impl TryFrom<Body> for Coin {
    type Error = InputError;

    fn try_from(body: Body) -> Result<Self, InputError> {
        body.coin().ok_or(NO_COIN)
    }
}
