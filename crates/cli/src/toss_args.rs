//! The options that describe one toss: the body, its rate and its launch, and for a flight also the solver. They are the
//! fields of [`Thrown`], which refuses what contradicts itself. The commands about single tosses share them.

use std::f64::consts::TAU;

use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};
use dynamics::Thrown;
use dynamics::quantity::{Given, common_unit};
use dynamics::thrown::{FIELDS, Field, Holds};
use toss::quantity::Rounding;
use toss::{Backend, Body, Coin, InputError, Registry, Toss};

use crate::failure::Failure;
use crate::quantity;
use crate::solver_args::SolverArgs;

/// The fields that are options of each group: a body, a rate, and a body with its launch.
const GROUPS: [fn(Field) -> bool; 3] = [
    |field| Field::BODY.contains(&field),
    |field| [Field::Rate, Field::Turn, Field::Psi].contains(&field),
    |field| !field.info().value.is_empty(),
];

fn fields(group: usize) -> impl Iterator<Item = Field> {
    FIELDS.iter().map(|info| info.field).filter(move |field| GROUPS[group](*field))
}

/// What the options of a group gave, or what is wrong with one of them.
#[derive(Debug)]
pub(crate) struct Options<const GROUP: usize>(Result<Thrown, InputError>);

pub(crate) type CoinArgs = Options<0>;
pub(crate) type RateArgs = Options<1>;
pub(crate) type TossArgs = Options<2>;

impl<const GROUP: usize> Args for Options<GROUP> {
    fn augment_args(command: Command) -> Command {
        command.args(fields(GROUP).map(option))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// The option that gives a field.
fn option(field: Field) -> Arg {
    let info = field.info();
    let option = Arg::new(info.name).long(info.name).value_name(info.value).help(info.help);
    match info.holds {
        Holds::Name => option,
        Holds::One(kind) => option.allow_hyphen_values(true).value_parser(quantity::given(kind)),
        Holds::List(_) | Holds::Several(_) | Holds::Refused => option.allow_hyphen_values(true),
    }
}

impl<const GROUP: usize> FromArgMatches for Options<GROUP> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        Ok(Self(thrown(matches, fields(GROUP))))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

fn thrown(matches: &ArgMatches, fields: impl Iterator<Item = Field>) -> Result<Thrown, InputError> {
    let mut thrown = Thrown::default();
    for field in fields {
        let info = field.info();
        if let Holds::One(_) = info.holds {
            matches.get_one::<Given>(info.name).map_or(Ok(()), |given| thrown.put(field, vec![*given]))?;
        } else {
            matches.get_one::<String>(info.name).map_or(Ok(()), |text| thrown.set(field, text))?;
        }
    }
    Ok(thrown)
}

impl<const GROUP: usize> Options<GROUP> {
    /// The fields that were given.
    pub(crate) fn thrown(&self) -> Result<&Thrown, Failure> {
        self.0.as_ref().map_err(|error| error.clone().into())
    }

    /// The body; the paper's coin if no option gave one.
    pub(crate) fn body(&self) -> Result<Body, Failure> {
        Ok(self.given_body()?.unwrap_or(Coin::PAPER.into()))
    }

    /// The body, if an option gave one.
    pub(crate) fn given_body(&self) -> Result<Option<Body>, Failure> {
        self.thrown()?.body().map_err(|source| Failure::value(self.body_option(), source))
    }

    /// The option that gives the body.
    fn body_option(&self) -> &'static str {
        let field = self.0.as_ref().ok().and_then(|thrown| thrown.body_field().ok().flatten());
        field.unwrap_or(Field::Coin).info().name
    }

    /// The coin, for what is a formula of long flights. A body with I1 ≠ I2 is refused.
    pub(crate) fn coin(&self) -> Result<Coin, Failure> {
        let why = "the limit of long flights is a formula for coins; probability estimates P(heads)";
        let option = self.body_option();
        let refused = || Failure::usage(option, format!("--{option}: this body has I1 ≠ I2, and {why}"));
        self.body()?.coin().ok_or_else(refused)
    }

    /// The toss.
    pub(crate) fn toss(&self) -> Result<Toss, Failure> {
        let (thrown, body) = (self.thrown()?, self.body()?);
        Ok(Toss { body, launch: thrown.launch(&body, thrown.time_of_flight()?)? })
    }

    /// What the conversion of units has rounded.
    pub(crate) fn rounding(&self) -> Result<Rounding, Failure> {
        self.thrown().map(Rounding::of)
    }

    /// The rate at which n turns as it was understood, if it was given so.
    pub(crate) fn turn_in_words(&self) -> Option<String> {
        turn_in_words(self.0.as_ref().ok()?)
    }

    /// The launch in the units in which it was typed, for the title of a chart.
    pub(crate) fn words(&self) -> String {
        let thrown = self.0.as_ref().ok();
        let tilt = thrown.and_then(|thrown| thrown.one(Field::Tilt)).filter(|tilt| tilt.si() != 0.0);
        let has_attitude = thrown.is_some_and(|thrown| thrown.has(Field::Attitude));
        let tilt = match tilt {
            Some(tilt) => format!("at a tilt of {}", shown(tilt)),
            None if has_attitude => "at an attitude".to_owned(),
            None => "horizontally".to_owned(),
        };
        let drop = thrown.and_then(|thrown| thrown.one(Field::Drop)).map(|drop| format!(", drop {}", shown(drop)));
        format!("launched {tilt}, {}{}", thrown.and_then(words_of_rate).unwrap_or_default(), drop.unwrap_or_default())
    }
}

/// What was typed of the rate, for the title of a chart.
pub(crate) fn words_of_rate(thrown: &Thrown) -> Option<String> {
    if let (Some(turn), Some(psi)) = (thrown.one(Field::Turn), thrown.one(Field::Psi)) {
        return Some(format!("n turns at {}, ψ = {}", shown(turn), shown(psi)));
    }
    let components = thrown.components().ok()??;
    let list = |number: fn(Given) -> String| components.map(number).join(", ");
    Some(match common_unit(&components) {
        Some(unit) => format!("ω = ({}) {}", list(|given| quantity::shortest(given.value())), unit.name()),
        None => format!("ω = ({})", list(shown)),
    })
}

/// The rate at which n turns as it was understood, in turns and in radians, if it was given so: people who write 38 without
/// a unit often mean turns.
pub(crate) fn turn_in_words(thrown: &Thrown) -> Option<String> {
    let rate = thrown.one(Field::Turn)?.si();
    let [turns, radians] = [rate / TAU, rate].map(quantity::rounded);
    Some(format!("turn         {turns} rev/s = {radians} rad/s"))
}

/// A quantity in the unit in which it was typed.
fn shown(given: Given) -> String {
    format!("{} {}", quantity::shortest(given.value()), given.unit().name())
}

/// Options for one toss and the solver that flies it.
#[derive(Debug, Args)]
#[command(mut_arg("scheme", |scheme| scheme.alias("method")))]
pub(crate) struct FlightArgs {
    #[command(flatten)]
    pub(crate) toss: TossArgs,
    #[command(flatten)]
    pub(crate) solver: SolverArgs,
}

impl FlightArgs {
    pub(crate) fn parts(&self, registry: &Registry) -> Result<(Toss, Backend), Failure> {
        Ok((self.toss.toss()?, self.solver.backend(registry)?))
    }
}
