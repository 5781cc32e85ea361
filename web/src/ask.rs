//! The questions of the page and their answers.

use std::collections::BTreeMap;
use std::io;

use serde::{Deserialize, Serialize};
use serde_json::Serializer;
use serde_json::ser::Formatter;
use toss::{Error, InputError, report};

use crate::failure::{Refusal, not_understood};
use crate::flight::Flight;
use crate::integrators::Chosen;
use crate::map::Grid;
use crate::page::Page;
use crate::thrown::{Scene, malformed};
use crate::{aim, hand, integrators, known, line, map, outcome, people};

/// What can be asked.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Ask {
    /// What can be chosen: solvers, coins, units.
    Known,
    /// The `text` as a quantity of this `kind`: its number in SI units, and its unit.
    Quantity,
    /// How the toss lands, and by how much.
    Toss,
    /// The nearest flip in each input, which takes up to some seconds for a body with I1 ≠ I2.
    Margins,
    /// The flight: a trace of `points` points into [`Page::numbers`], and from then on [`Page::frame`].
    Fly,
    /// The body rate with which the angular momentum points in another `direction`.
    Aim,
    /// The cells of a map, into [`Page::cells`].
    Map,
    /// The lines of a map.
    Lines,
    /// P(heads) for a hand.
    Hand,
    /// P(heads) where the inputs in `around` are not known exactly.
    Around,
    /// How each of some random throws of a hand lands.
    Throws,
    /// How precise a hand must be.
    Precision,
    /// What the counts of people's flips in `text` say.
    People,
    /// Every solver with each of its schemes: their settings, to be asked for one by one.
    Candidates,
    /// Where a solver lands.
    Landing,
    /// How the error of a solver grows along the flight.
    Growth,
    /// The same flight again and again, for a clock outside.
    Repeat,
}

/// A question: its name and what it takes. One table of all that a question can take is read by less code than one for each.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Question {
    ask: Ask,
    /// The body and its launch.
    scene: Option<Scene>,
    /// Such as `rate`.
    kind: Option<String>,
    /// Such as `38rev/s`, or a table.
    text: Option<String>,
    /// Points of the trace or of the curve.
    points: Option<u32>,
    /// A direction (LF).
    direction: Option<[f64; 3]>,
    grid: Option<Grid>,
    /// The relative standard deviation of each rate and of the speed.
    spread: Option<String>,
    /// Of each input that is not known exactly its deviation, its range or its distribution.
    around: Option<BTreeMap<String, String>>,
    /// The number of throws, at most 10 000, and their seed.
    number: Option<u64>,
    seed: Option<u64>,
    /// The wanted P(heads).
    heads: Option<String>,
    /// The tolerance of the schemes that take one, the step of the others, and the formulation of the solvers that have a choice.
    tolerance: Option<String>,
    step: Option<String>,
    formulation: Option<String>,
    /// The solver.
    by: Option<Chosen>,
    /// How often a flight is flown.
    times: Option<u32>,
}

/// What the question has for this field.
fn given<T>(field: &'static str, value: Option<T>) -> Result<T, Error> {
    value.ok_or(Error::Input(InputError::Missing { field, expected: "a value for this question" }))
}

impl Page {
    /// Answers a question in JSON by JSON: with the answer, or with an error. It never panics on a question.
    pub fn ask(&mut self, question: &str) -> String {
        let asked = serde_json::from_str(question).map_err(|error| not_understood(&error));
        let answered = asked.and_then(|question| self.answer(question));
        answered.or_else(|failure| to_json(&Refusal::new(&failure))).unwrap_or_default()
    }

    fn answer(&mut self, question: Question) -> Result<String, Error> {
        let Question { ask, scene, kind, text, points, direction, grid, spread, around, number, seed, heads, .. } =
            question;
        let thrown = || given("scene", scene.as_ref())?.thrown();
        match ask {
            Ask::Known => to_json(&known::known()),
            Ask::Quantity => to_json(&known::quantity(&given("kind", kind)?, &given("text", text)?)?),
            Ask::Toss => to_json(&outcome::answer(&thrown()?)?),
            Ask::Margins => to_json(&outcome::margins(&thrown()?)?),
            Ask::Fly => {
                let flight = Flight::new(&thrown()?);
                self.numbers.clear();
                let course = flight.trace(given("points", points)?, &mut self.numbers)?;
                self.flight = Some(flight);
                to_json(&course)
            }
            Ask::Aim => to_json(&aim::aim(&thrown()?, given("direction", direction)?)?),
            Ask::Map => {
                self.cells.clear();
                to_json(&map::map(&thrown()?, &given("grid", grid)?, &mut self.cells)?)
            }
            Ask::Lines => to_json(&line::lines(&thrown()?, &given("grid", grid)?)?),
            Ask::Hand => to_json(&report::Estimate {
                found: &hand::probability(&thrown()?, &given("spread", spread)?)?,
                integrated: None,
            }),
            Ask::Around => {
                let space = given("scene", scene.as_ref())?.space(&given("around", around)?)?;
                to_json(&report::Estimate { found: &hand::over(&space)?, integrated: None })
            }
            Ask::Throws => {
                let (number, seed) = (given("number", number)?, given("seed", seed)?);
                to_json(&hand::throws(&thrown()?, &given("spread", spread)?, number, seed)?)
            }
            Ask::Precision => to_json(&hand::precision(&thrown()?, &given("heads", heads)?)?),
            Ask::People => to_json(&people::counted(&given("text", text)?)?),
            Ask::Candidates => {
                let [tolerance, step] = [given("tolerance", question.tolerance)?, given("step", question.step)?];
                let formulation = given("formulation", question.formulation)?;
                to_json(&integrators::candidates(&tolerance, &step, &formulation)?)
            }
            Ask::Landing => to_json(&integrators::landing(&thrown()?, &given("by", question.by)?)?),
            Ask::Growth => {
                to_json(&integrators::growth(&thrown()?, &given("by", question.by)?, given("points", points)?)?)
            }
            Ask::Repeat => {
                let by = given("by", question.by)?;
                to_json(&integrators::repeat(&thrown()?, &by, given("times", question.times)?)?)
            }
        }
    }
}

/// Writes each f64 as Rust prints it, by the code that error messages need as well.
struct Printed;

impl Formatter for Printed {
    fn write_f64<W: ?Sized + io::Write>(&mut self, to: &mut W, value: f64) -> io::Result<()> {
        write!(to, "{value:?}")
    }
}

fn to_json(answer: &impl Serialize) -> Result<String, Error> {
    let mut text = Vec::new();
    answer.serialize(&mut Serializer::with_formatter(&mut text, Printed)).map_err(|error| not_understood(&error))?;
    String::from_utf8(text).map_err(|error| malformed("answer", &error.to_string(), "a text").into())
}
