//! The questions of the page and their answers.

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use toss::{Error, report};

use crate::failure::{not_understood, to_json};
use crate::flight::Flight;
use crate::integrators::Chosen;
use crate::map::Grid;
use crate::page::Page;
use crate::thrown::Scene;
use crate::{aim, hand, integrators, known, line, map, outcome, people};

/// A question, as `{NAME: {...}}`, or its name alone if there is no more to it.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Question {
    /// What can be chosen: solvers, coins, units.
    Known,
    /// A text as a quantity of this kind: its number in SI units, and its unit.
    Quantity {
        /// Such as `rate`.
        kind: String,
        /// Such as `38rev/s`.
        text: String,
    },
    /// How the toss lands, and by how much.
    Toss {
        /// The body and its launch.
        scene: Scene,
    },
    /// The nearest flip in each input, which takes up to some seconds for a body with I1 ≠ I2.
    Margins {
        /// The body and its launch.
        scene: Scene,
    },
    /// The flight: a trace into [`Page::numbers`], and from then on [`Page::frame`].
    Fly {
        /// The body and its launch.
        scene: Scene,
        /// Points of the trace.
        points: usize,
    },
    /// The body rate with which the angular momentum points elsewhere.
    Aim {
        /// The body and its launch.
        scene: Scene,
        /// The direction (LF).
        direction: [f64; 3],
    },
    /// The cells of a map, into [`Page::cells`].
    Map {
        /// The body and its launch.
        scene: Scene,
        /// The grid.
        grid: Grid,
    },
    /// The lines of a map.
    Lines {
        /// The body and its launch.
        scene: Scene,
        /// The grid.
        grid: Grid,
    },
    /// P(heads) for a hand.
    Hand {
        /// The body and its launch.
        scene: Scene,
        /// The relative standard deviation of each rate and of the speed.
        spread: String,
    },
    /// How each of some random throws of a hand lands.
    Throws {
        /// The body and its launch.
        scene: Scene,
        /// As of [`Question::Hand`].
        spread: String,
        /// How many, at most 10 000.
        number: u64,
        /// The seed of the throws.
        seed: u64,
    },
    /// How precise a hand must be.
    Precision {
        /// The body and its launch.
        scene: Scene,
        /// The wanted P(heads).
        heads: String,
    },
    /// What the counts of people's flips say.
    People {
        /// Of each person the landings on the side that had been up, and the flips.
        counts: Vec<[u64; 2]>,
    },
    /// Every solver with each of its schemes: their settings, to be asked for one by one.
    Candidates {
        /// The tolerance of the schemes that take one.
        tolerance: String,
        /// The step of the others.
        step: String,
        /// The formulation of the solvers that have a choice.
        formulation: String,
    },
    /// Where a solver lands.
    Landing {
        /// The body and its launch.
        scene: Scene,
        /// The solver.
        by: Chosen,
    },
    /// How the error of a solver grows along the flight.
    Growth {
        /// The body and its launch.
        scene: Scene,
        /// The solver.
        by: Chosen,
        /// Points of the curve.
        points: u32,
    },
    /// The same flight again and again, for a clock outside.
    Repeat {
        /// The body and its launch.
        scene: Scene,
        /// The solver.
        by: Chosen,
        /// How often.
        times: u32,
    },
}

impl Page {
    /// Answers a question in JSON by JSON: with the answer, or with an error. It never panics on a question.
    pub fn ask(&mut self, question: &str) -> String {
        let asked = serde_json::from_str(question).map_err(|error| not_understood(&error));
        asked.and_then(|question| self.answer(question)).unwrap_or_else(|failure| to_json(&failure)).to_string()
    }

    fn answer(&mut self, question: Question) -> Result<Value, Error> {
        match question {
            Question::Known => Ok(known::known()),
            Question::Quantity { kind, text } => known::quantity(&kind, &text),
            Question::Toss { scene } => to_value(&outcome::answer(&scene.thrown()?)?),
            Question::Margins { scene } => to_value(&outcome::margins(&scene.thrown()?)?),
            Question::Fly { scene, points } => self.fly(&scene, points),
            Question::Aim { scene, direction } => to_value(&aim::aim(&scene.thrown()?, direction)?),
            Question::Map { scene, grid } => {
                self.cells.clear();
                to_value(&map::map(&scene.thrown()?, &grid, &mut self.cells)?)
            }
            Question::Lines { scene, grid } => to_value(&line::lines(&scene.thrown()?, &grid)?),
            Question::Hand { scene, spread } => {
                let found = hand::probability(&scene.thrown()?, &spread)?;
                to_value(&report::Estimate { found: &found, integrated: None })
            }
            Question::Throws { scene, spread, number, seed } => {
                to_value(&hand::throws(&scene.thrown()?, &spread, number, seed)?)
            }
            Question::Precision { scene, heads } => to_value(&hand::precision(&scene.thrown()?, &heads)?),
            Question::People { counts } => to_value(&people::counted(&counts)?),
            Question::Candidates { tolerance, step, formulation } => {
                to_value(&integrators::candidates(&tolerance, &step, &formulation)?)
            }
            Question::Landing { scene, by } => to_value(&integrators::landing(&scene.thrown()?, &by)?),
            Question::Growth { scene, by, points } => to_value(&integrators::growth(&scene.thrown()?, &by, points)?),
            Question::Repeat { scene, by, times } => {
                Ok(json!({ "answered": integrators::repeat(&scene.thrown()?, &by, times)? }))
            }
        }
    }

    fn fly(&mut self, scene: &Scene, points: usize) -> Result<Value, Error> {
        let flight = Flight::new(&scene.thrown()?);
        self.numbers.clear();
        let answer = flight.trace(points, &mut self.numbers)?;
        self.flight = Some(flight);
        to_value(&answer)
    }
}

fn to_value(answer: &impl Serialize) -> Result<Value, Error> {
    serde_json::to_value(answer).map_err(|error| not_understood(&error))
}
