//! [`Thrown`]: a body and its launch as somebody gives them, each number in the unit that it was given in. Nothing is rounded
//! before [`Thrown::toss`].
//!
//! Options of the command line, CSV, files, the page, Python and the texts of `--replay` fill one in by the names of
//! [`FIELDS`]. So a name means the same everywhere, and what contradicts itself is refused in the same words.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use numerics::{Quantity, Unit};

use crate::attitude::Attitude;
use crate::body::Body;
use crate::coin::Coin;
use crate::data::{NO_BOUNCE, NO_DRAG, NO_WOBBLE};
use crate::error::{InputError, find_named, require};
use crate::launch::Launch;
use crate::precession::rate_of_precession;
use crate::quantity::{Dimension, Given, common_unit, read_quantities};
use crate::time_of_flight::{DEFAULT_GRAVITY, TimeOfFlight};
use crate::toss::Toss;

/// A field of a toss: what somebody may give.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Field {
    /// The name of a body of the catalogue.
    Coin,
    /// Mass, radius and thickness of a cylinder.
    Cylinder,
    /// Two or three moments of inertia.
    Moments,
    /// The six elements of an inertia tensor.
    Inertia,
    /// The body rate ω.
    Rate,
    /// ωx, in place of the whole rate.
    RateX,
    /// ωy, likewise.
    RateY,
    /// ωz, likewise.
    RateZ,
    /// The rate of the precession, in place of the body rate.
    Turn,
    /// The angle ψ of the precession.
    Psi,
    /// The speed v0.
    Speed,
    /// The time of flight T, in place of a speed.
    Time,
    /// Gravity g.
    Gravity,
    /// The drop h.
    Drop,
    /// The tilt at launch.
    Tilt,
    /// The quaternion at launch, of any norm, in place of a tilt.
    Attitude,
    /// The quaternion at launch as it is, of norm 1 to rounding.
    UnitQuaternion,
    /// Air drag, which is refused.
    Drag,
    /// Bouncing, which is refused.
    Bounce,
    /// An old name of ψ, which is refused.
    Wobble,
}

/// What the text of a field holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holds {
    /// The name of a body.
    Name,
    /// A quantity.
    One(Dimension),
    /// Quantities of these kinds, separated by commas.
    List(&'static [Dimension]),
    /// Quantities of this kind, separated by commas; the body says how many of them it takes.
    Several(Dimension),
    /// Nothing that the model knows.
    Refused,
}

/// What there is to know about a field.
#[derive(Debug, Clone, Copy)]
pub struct FieldInfo {
    /// The field.
    pub field: Field,
    /// Its name, for options, files, columns and keywords.
    pub name: &'static str,
    /// Its name in errors about its number, with the SI unit.
    pub label: &'static str,
    /// What it holds.
    pub holds: Holds,
    /// What stands for its value in a usage line; empty for what is no option.
    pub value: &'static str,
    /// What is expected of a list, with every unit.
    pub expected: &'static str,
    /// What the option is.
    pub help: &'static str,
}

const RATES: &[Dimension] = &[Dimension::TurnRate; 3];
const CYLINDER: &[Dimension] = &[Dimension::Mass, Dimension::Length, Dimension::Length];
const TENSOR: &[Dimension] = &[Dimension::Inertia; 6];
const QUATERNION: &[Dimension] = &[Dimension::Number; 4];

/// A field that is no option.
const fn field(field: Field, name: &'static str, label: &'static str, holds: Holds) -> FieldInfo {
    FieldInfo { field, name, label, holds, value: "", expected: "", help: "" }
}

/// A field of one quantity.
const fn one(of: Field, name: &'static str, label: &'static str, kind: Dimension) -> FieldInfo {
    field(of, name, label, Holds::One(kind))
}

/// A field of several quantities.
const fn list(of: Field, name: &'static str, holds: Holds, expected: &'static str) -> FieldInfo {
    FieldInfo { expected, ..field(of, name, name, holds) }
}

impl FieldInfo {
    const fn option(self, value: &'static str, help: &'static str) -> Self {
        Self { value, help, ..self }
    }
}

/// All fields.
pub static FIELDS: [FieldInfo; 20] = [
    field(Field::Coin, "coin", "coin", Holds::Name)
        .option("NAME", "A coin or another body of the catalogue, which `coins` lists [default: paper]"),
    list(
        Field::Cylinder,
        "cylinder",
        Holds::List(CYLINDER),
        "MASS,RADIUS,THICKNESS [kg, m, m], or each with a unit: kg, g or mg, and m, cm, mm, in or ft",
    )
    .option("MASS,RADIUS,THICKNESS", "A homogeneous cylinder as a coin: kg, m and m, or each with a unit"),
    list(
        Field::Moments,
        "moments",
        Holds::Several(Dimension::Inertia),
        "I1,I3 or I1,I2,I3 [kg m²], or each with a unit: kg·m², g·cm² or g·mm²",
    )
    .option(
        "I1,I3",
        "Moments of inertia about a diameter and about the normal, or I1,I2,I3 about the axes x, y and z = n of any \
         body: kg m², or each with a unit such as g·cm²",
    ),
    list(
        Field::Inertia,
        "inertia",
        Holds::List(TENSOR),
        "JXX,JYY,JZZ,JXY,JXZ,JYZ [kg m²], or each with a unit: kg·m², g·cm² or g·mm²",
    )
    .option(
        "JXX,JYY,JZZ,JXY,JXZ,JYZ",
        "Inertia tensor of any body about its centre of mass, in axes of which z is the normal n: kg m², or each with \
         a unit; Jxy is -∫ x y dm",
    ),
    list(
        Field::Rate,
        "rate",
        Holds::List(RATES),
        "WX,WY,WZ [rad/s], or each with a unit: rad/s, deg/s, °/s, rev/s or rpm",
    )
    .option("WX,WY,WZ", "Body rate at launch, in the body frame, with z along the normal of the heads side"),
    one(Field::RateX, "wx", "rate x [rad/s]", Dimension::TurnRate),
    one(Field::RateY, "wy", "rate y [rad/s]", Dimension::TurnRate),
    one(Field::RateZ, "wz", "rate z [rad/s]", Dimension::TurnRate),
    one(Field::Turn, "turn", "turn [rad/s]", Dimension::TurnRate).option(
        "RATE",
        "Rate |S|/I1 at which the normal n turns about the angular momentum S; with --psi in place of the body \
         rate. It stands for ωx = RATE sin ψ, ωy = 0 and ωz = RATE cos ψ I1/I3",
    ),
    one(Field::Psi, "psi", "psi [rad]", Dimension::Angle)
        .option("PSI", "Angle ψ between n and S, from 0 to 180deg, with --turn. At 90deg the coin turns end over end; below 45deg a coin \
         that is thrown flat never turns its face over"),
    one(Field::Speed, "speed", "speed [m/s]", Dimension::Speed).option("V0", "Upward speed v0 at launch"),
    one(Field::Time, "time", "time [s]", Dimension::Time).option("T", "Time of flight, instead of a speed"),
    one(Field::Gravity, "gravity", "gravity [m/s²]", Dimension::Acceleration).option("G", "Gravity [default: 9.81]"),
    one(Field::Drop, "drop", "drop [m]", Dimension::Length)
        .option("H", "Height of the launch above the landing, negative if the coin lands higher [default: 0]"),
    one(Field::Tilt, "tilt", "tilt [rad]", Dimension::Angle).option(
        "B",
        "Tilt at launch, from horizontal with heads up: a turn about the lab's x axis. A positive one leans the normal \
         towards -y [default: 0]",
    ),
    list(Field::Attitude, "attitude", Holds::List(QUATERNION), "W,X,Y,Z, four numbers").option(
        "W,X,Y,Z",
        "Attitude at launch in place of a tilt: a quaternion from the body to the laboratory, of any norm but 0",
    ),
    list(Field::UnitQuaternion, "unit_quaternion", Holds::List(QUATERNION), "W,X,Y,Z, four numbers"),
    field(Field::Drag, "drag", "drag", Holds::Refused)
        .option("C", "Air drag is outside the model; the option is refused with the reason"),
    field(Field::Bounce, "bounce", "bounce", Holds::Refused)
        .option("E", "Bouncing is outside the model; the option is refused with the reason"),
    field(Field::Wobble, "wobble", "wobble", Holds::Refused),
];

impl Field {
    /// The fields that give the body; one of them is enough.
    pub const BODY: [Self; 4] = [Self::Coin, Self::Cylinder, Self::Moments, Self::Inertia];

    /// The fields from which the time of flight follows.
    pub const FLIGHT: [Self; 4] = [Self::Speed, Self::Time, Self::Gravity, Self::Drop];

    /// What there is to know about it.
    pub fn info(self) -> &'static FieldInfo {
        &FIELDS[self as usize]
    }

    /// The field with this name. A component of the rate may also be called as in a space.
    pub fn named(name: &str) -> Result<Self, InputError> {
        match name {
            "rate_x" | "rate-x" => Ok(Self::RateX),
            "rate_y" | "rate-y" => Ok(Self::RateY),
            "rate_z" | "rate-z" => Ok(Self::RateZ),
            _ => find_named("field", name, &FIELDS, |info| info.name).map(|info| info.field),
        }
    }

    /// Numbers in the SI units of the field; none if it holds another number of them.
    fn in_si(self, numbers: &[f64]) -> Vec<Given> {
        let kinds = self.info().holds.kinds(numbers.len()).into_iter().flatten();
        kinds.zip(numbers).map(|(kind, number)| kind.in_si(*number)).collect()
    }

    fn missing(self, expected: &'static str) -> InputError {
        InputError::Missing { field: self.info().name, expected }
    }

    fn twice(self, expected: &'static str) -> InputError {
        InputError::Malformed { field: self.info().name, value: "given twice".to_owned(), expected }
    }
}

impl Holds {
    /// The kinds of so many quantities; `None` if it holds another number of them.
    pub(crate) fn kinds(self, count: usize) -> Option<Vec<Dimension>> {
        match self {
            Self::One(kind) => (count == 1).then(|| vec![kind]),
            Self::List(kinds) => (count == kinds.len()).then(|| kinds.to_vec()),
            Self::Several(kind) => Some(vec![kind; count]),
            Self::Name | Self::Refused => None,
        }
    }
}

/// A body and its launch as they were given.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Thrown {
    /// The name of the body.
    coin: Option<String>,
    numbers: BTreeMap<Field, Vec<Given>>,
}

impl Thrown {
    /// Gives `field` by its text. Fails, naming the field, for a text that it can't be, if it was given before, and for
    /// what is outside the model.
    pub fn set(&mut self, field: Field, text: &str) -> Result<(), InputError> {
        let info = field.info();
        match info.holds {
            Holds::Refused => Err(match field {
                Field::Drag => NO_DRAG,
                Field::Bounce => NO_BOUNCE,
                _ => NO_WOBBLE,
            }),
            Holds::Name => match self.coin.replace(text.to_owned()) {
                None => Ok(()),
                Some(_) => Err(field.twice("one value")),
            },
            Holds::One(dimension) => self.put(field, vec![dimension.given(info.label, text)?]),
            Holds::List(_) | Holds::Several(_) => {
                let parts: Vec<&str> = text.split(',').collect();
                let unreadable = || InputError::unreadable(info.name, text, info.expected);
                let kinds = info.holds.kinds(parts.len()).ok_or_else(unreadable)?;
                let parts: Vec<(Dimension, &str)> = kinds.into_iter().zip(parts).collect();
                self.put(field, read_quantities(info.name, text, info.expected, &parts)?)
            }
        }
    }

    /// Gives `field` by its numbers, in the order of its parts. Fails with [`InputError::Malformed`] that names the
    /// field, for another number of them, and if it was given before.
    pub fn put(&mut self, field: Field, numbers: Vec<Given>) -> Result<(), InputError> {
        let info = field.info();
        if info.holds.kinds(numbers.len()).is_none() {
            return Err(InputError::Malformed { field: info.name, value: listed(&numbers), expected: info.expected });
        }
        match self.numbers.insert(field, numbers) {
            None => Ok(()),
            Some(_) => Err(field.twice("one value")),
        }
    }

    /// As [`Thrown::put`], by numbers in SI units.
    pub fn put_si(&mut self, field: Field, numbers: &[f64]) -> Result<(), InputError> {
        self.put(field, field.in_si(numbers))
    }

    /// The numbers of `field` as they were given; none if it was not.
    pub fn numbers(&self, field: Field) -> &[Given] {
        self.numbers.get(&field).map_or(&[], Vec::as_slice)
    }

    /// The fields that were given by numbers, in the order of [`FIELDS`].
    pub fn given(&self) -> impl Iterator<Item = (Field, &[Given])> {
        self.numbers.iter().map(|(field, numbers)| (*field, numbers.as_slice()))
    }

    /// The quantity of `field` as it was given.
    pub fn one(&self, field: Field) -> Option<Given> {
        self.numbers(field).first().copied()
    }

    /// Whether `field` was given.
    pub fn has(&self, field: Field) -> bool {
        if field == Field::Coin { self.coin.is_some() } else { self.numbers.contains_key(&field) }
    }

    /// The numbers of `field` in SI units, of which there are `N`.
    fn si<const N: usize>(&self, field: Field) -> [f64; N] {
        std::array::from_fn(|index| self.numbers(field)[index].si())
    }

    /// The same with each number converted to SI units, and so rounded.
    #[must_use]
    pub fn in_si(mut self) -> Self {
        for (field, numbers) in &mut self.numbers {
            let kinds = field.info().holds.kinds(numbers.len()).into_iter().flatten();
            numbers.iter_mut().zip(kinds).for_each(|(number, kind)| *number = kind.in_si(number.si()));
        }
        self
    }

    /// The toss; the body is the paper's coin if none was given. Fails for what is missing, contradicts itself or is
    /// outside its range.
    pub fn toss(&self) -> Result<Toss, InputError> {
        let body = self.body()?.unwrap_or(Coin::PAPER.into());
        Ok(Toss { body, launch: self.launch(&body, self.time_of_flight()?)? })
    }

    /// The field that gives the body, if one does. Fails with [`InputError::Malformed`] if several do.
    pub fn body_field(&self) -> Result<Option<Field>, InputError> {
        let mut given = Field::BODY.into_iter().filter(|field| self.has(*field));
        match (given.next(), given.next()) {
            (Some(first), Some(_)) => Err(first.twice("one of coin, cylinder, moments and inertia")),
            (first, _) => Ok(first),
        }
    }

    /// The body, if one was given.
    pub fn body(&self) -> Result<Option<Body>, InputError> {
        let body = match self.body_field()? {
            None => return Ok(None),
            Some(Field::Cylinder) => {
                let part = |index: usize| self.numbers(Field::Cylinder)[index].quantity();
                Coin::from_cylinder(part(0), part(1), part(2)).map(Body::from)
            }
            Some(Field::Coin) => self.coin.as_deref().unwrap_or_default().parse(),
            Some(_) => self.body_of(&self.elements().iter().map(|given| given.si()).collect::<Vec<f64>>()),
        };
        body.map(Some)
    }

    /// The moments or the elements of the tensor as they were given; none of a body that was given otherwise.
    pub fn elements(&self) -> &[Given] {
        self.numbers(if self.has(Field::Inertia) { Field::Inertia } else { Field::Moments })
    }

    /// The body with these moments, or elements of the tensor if that is how it was given, in any unit: they decide its
    /// motion by their ratios.
    pub fn body_of(&self, elements: &[f64]) -> Result<Body, InputError> {
        match <[f64; 6]>::try_from(elements) {
            Ok(elements) if self.has(Field::Inertia) => Body::from_inertia(elements),
            _ => Body::from_listed_moments(elements),
        }
    }

    /// What the time of flight follows from.
    pub fn time_of_flight(&self) -> Result<TimeOfFlight, InputError> {
        let [speed, time, gravity, drop] = Field::FLIGHT.map(|field| self.one(field).map(Given::si));
        match (speed, time) {
            (None, None) => Err(Field::Speed.missing("a speed, or a time of flight")),
            (_, Some(_)) if speed.or(gravity).or(drop).is_some() => {
                Err(Field::Time.twice("a time alone, without speed, gravity and drop"))
            }
            (_, Some(time)) => Ok(TimeOfFlight::Given(time)),
            (Some(speed), None) => Ok(TimeOfFlight::thrown(speed, gravity.unwrap_or(DEFAULT_GRAVITY), drop)),
        }
    }

    /// The launch of `body` with this time of flight. Components of the rate in one unit are not converted, so that proofs
    /// start from them.
    pub fn launch(&self, body: &Body, time_of_flight: TimeOfFlight) -> Result<Launch, InputError> {
        let launch = match self.components()? {
            Some(_) if self.has(Field::Turn) || self.has(Field::Psi) => {
                return Err(Field::Rate.twice("either a rate, or turn with psi"));
            }
            Some(given) => match common_unit(&given) {
                Some(unit) => Launch::in_unit(given.map(Given::value), unit.size(), time_of_flight)?,
                None => Launch::new(given.map(Given::si), time_of_flight)?,
            },
            None => {
                let missing = Field::Rate.missing("a rate, or turn with psi");
                Launch::new(self.precession(body)?.ok_or(missing)?, time_of_flight)?
            }
        };
        Ok(self.attitude()?.map_or(launch, |attitude| launch.with_attitude(attitude)))
    }

    /// The components of the rate, if they were given.
    pub fn components(&self) -> Result<Option<[Given; 3]>, InputError> {
        const AXES: [Field; 3] = [Field::RateX, Field::RateY, Field::RateZ];
        let of_axes = AXES.map(|axis| self.one(axis));
        match (self.numbers(Field::Rate), of_axes) {
            ([], [None, None, None]) => Ok(None),
            ([], [Some(x), Some(y), Some(z)]) => Ok(Some([x, y, z])),
            ([], [x, y, _]) => {
                let axis = AXES[if x.is_none() { 0 } else { 1 + usize::from(y.is_some()) }];
                Err(InputError::Missing { field: axis.info().label, expected: "a number" })
            }
            ([x, y, z], [None, None, None]) => Ok(Some([*x, *y, *z])),
            _ => Err(Field::Rate.twice("either a rate or its components")),
        }
    }

    /// The body rate (BF, rad/s) of a precession of `body`, if one was given.
    pub fn precession(&self, body: &Body) -> Result<Option<Vector3<f64>>, InputError> {
        const WHY: &str = "n of a body with I1 ≠ I2 turns unevenly; use the body rate instead";
        match (self.one(Field::Turn), self.one(Field::Psi)) {
            (None, None) => Ok(None),
            (Some(_), None) => Err(Field::Psi.missing("the angle between n and S, with turn")),
            (None, Some(_)) => Err(Field::Turn.missing("the rate at which n turns, with psi")),
            (Some(turn), Some(psi)) => {
                let coin = body.coin().ok_or(InputError::OutsideModel { field: "turn", why: WHY })?;
                rate_of_precession(&coin, turn.si(), psi.si()).map(Some)
            }
        }
    }

    /// The attitude at launch, if one was given.
    pub fn attitude(&self) -> Result<Option<Attitude>, InputError> {
        let given = [Field::Tilt, Field::Attitude, Field::UnitQuaternion].map(|field| self.has(field));
        match given {
            [false, false, false] => Ok(None),
            [true, false, false] => self.one(Field::Tilt).map(|tilt| tilted(tilt.quantity())).transpose(),
            [false, true, false] => Attitude::from_components(self.si(Field::Attitude)).map(Some),
            [false, false, true] => Attitude::from_unit_components(self.si(Field::UnitQuaternion)).map(Some),
            _ => Err(Field::Attitude.twice("either tilt or attitude")),
        }
    }

    /// Whether the body rate is rounded by [`Thrown::launch`].
    pub fn rounds_rate(&self) -> bool {
        let given = self.components().ok().flatten();
        given.is_none_or(|given| common_unit(&given).is_none() && !given.into_iter().all(Given::is_exact_in_si))
    }

    /// Whether the numbers of the time of flight are rounded by [`Thrown::time_of_flight`].
    pub fn rounds_flight(&self) -> bool {
        !Field::FLIGHT.into_iter().filter_map(|field| self.one(field)).all(Given::is_exact_in_si)
    }

    /// The fields that give `toss`: they are those of the same toss, to the bit.
    pub fn of(toss: &Toss) -> Self {
        Self::default().with_body(&toss.body).with_launch(&toss.launch)
    }

    /// The same with `body`, where none was given.
    #[must_use]
    pub fn with_body(self, body: &Body) -> Self {
        match (body.coin(), body.moments()) {
            (Some(coin), _) => match coin.cylinder() {
                Some(sizes) => {
                    let size = |(kind, size): (&Dimension, Quantity)| kind.in_unit(size.value(), size.unit());
                    self.with(Field::Cylinder, CYLINDER.iter().zip(sizes).map(size).collect())
                }
                None => self.with_si(Field::Moments, &[coin.i1(), coin.i3()]),
            },
            (None, Some(moments)) => self.with_si(Field::Moments, &moments),
            (None, None) => self.with_si(Field::Inertia, &body.inertia()),
        }
    }

    /// The same with `launch`, where none was given.
    #[must_use]
    pub fn with_launch(self, launch: &Launch) -> Self {
        let (rate, unit) = launch.given_rate();
        let rate = rate.iter().map(|part| Dimension::TurnRate.in_unit(*part, unit)).collect();
        let flight = launch.time_of_flight();
        let given = if let TimeOfFlight::Given(time) = flight { Some(time) } else { None };
        let [speed, gravity] = flight.throw().map_or([None; 2], |throw| throw.map(Some));
        let flight = [speed, given, gravity, flight.drop()];
        let flight = Field::FLIGHT.into_iter().zip(flight).filter_map(|(field, number)| Some((field, number?)));
        let thrown =
            flight.fold(self.with(Field::Rate, rate), |thrown, (field, number)| thrown.with_si(field, &[number]));
        let attitude = launch.attitude();
        let is_level = attitude == Attitude::IDENTITY;
        if is_level { thrown.with_si(Field::Tilt, &[0.0]) } else { thrown.with_attitude(&attitude) }
    }

    /// The same with `attitude`, where none was given.
    #[must_use]
    pub fn with_attitude(self, attitude: &Attitude) -> Self {
        let given = attitude.given_components();
        match attitude.tilt() {
            Some(tilt) => self.with(Field::Tilt, vec![Dimension::Angle.in_unit(tilt.value(), tilt.unit())]),
            None if Attitude::from_components(given) == Ok(*attitude) => self.with_si(Field::Attitude, &given),
            // Dividing by a norm that is 1 to rounding can change the last bits.
            None => self.with_si(Field::UnitQuaternion, &attitude.components()),
        }
    }

    fn with_si(self, field: Field, numbers: &[f64]) -> Self {
        self.with(field, field.in_si(numbers))
    }

    fn with(mut self, field: Field, numbers: Vec<Given>) -> Self {
        self.numbers.insert(field, numbers);
        self
    }

    /// All fields as `NAME=VALUE`, in the order of [`FIELDS`], from which [`Thrown::set`] makes the same again.
    pub fn text(&self) -> String {
        let name = self.coin.iter().map(|name| format!("coin={name}"));
        let numbers = self.given().map(|(field, numbers)| format!("{}={}", field.info().name, listed(numbers)));
        name.chain(numbers).collect::<Vec<_>>().join(" ")
    }
}

/// Numbers separated by commas; each of them has its unit unless all are in SI units.
fn listed(numbers: &[Given]) -> String {
    let is_plain = numbers.iter().all(|given| given.unit().size() == Unit::ONE);
    let number = |given: &Given| if is_plain { format!("{:?}", given.value()) } else { given.to_string() };
    numbers.iter().map(number).collect::<Vec<_>>().join(",")
}

/// The attitude that is tilted by a finite `angle`.
fn tilted(angle: Quantity) -> Result<Attitude, InputError> {
    require("tilt [rad]", angle.to_f64(), "finite", true)?;
    Ok(Attitude::about_x(angle))
}

#[cfg(test)]
mod tests;
