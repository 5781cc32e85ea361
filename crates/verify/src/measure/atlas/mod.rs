//! The atlas of failures records what every contestant does at every distance from every [hazard](hazards), a place
//! where some method fails. It shows which methods fail where, and that the default ones are right or return an error
//! there.
//!
//! A contestant is a solver with a scheme and a formulation, at the library's default tolerance or step. The raw
//! formulations are the paper's equations as printed and are expected to fail.

pub mod expected;
pub mod hazards;

use dynamics::Toss;
use rayon::prelude::*;
use serde::Serialize;
use toss::{Formulation, InputError, Scheme, SolverEntry, StepControl, Stepping};

use crate::measure::effort::Effort;
use crate::measure::reference::{self, Reference};
use crate::measure::run::{Answer, Run};
use crate::measure::subject::{Subject, by_scheme, usual};
use hazards::{HAZARDS, Hazard, SLOW};

/// One contestant at one distance from one hazard.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Spot {
    /// The hazard's id.
    pub hazard: &'static str,
    /// The distance from it.
    pub distance: f64,
    /// The contestant's answer with its errors.
    #[serde(flatten)]
    pub run: Run,
}

/// The whole atlas.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Atlas {
    /// All spots, ordered by hazard, then distance, then contestant.
    pub spots: Vec<Spot>,
}

impl Atlas {
    /// Solves every hazard at every distance with every contestant of `registry`; with few cases, not at those that take longest.
    pub fn new(registry: &[SolverEntry], effort: Effort) -> anyhow::Result<Self> {
        let contestants = contestants_at(registry, None)?;
        let places = HAZARDS.iter().flat_map(|hazard| hazard.distances.iter().map(move |distance| (hazard, *distance)));
        let places =
            places.filter(|(hazard, distance)| effort.of([!SLOW.contains(&(hazard.id, *distance)), true, true]));
        let places: Vec<Place> =
            places.map(|(hazard, distance)| Place::new(hazard, distance)).collect::<Result<_, _>>()?;
        let flights: Vec<(&Place, &Subject)> =
            places.iter().flat_map(|place| contestants.iter().map(move |by| (place, by))).collect();
        // Each flight is a task of its own for the threads, because a few take a second and would delay those after them.
        Ok(Self { spots: flights.into_par_iter().with_max_len(1).map(|(place, by)| place.flown(by)).collect() })
    }

    /// The spots of one contestant at one hazard, from far to near.
    pub fn series<'a>(&'a self, hazard: &'a str, subject: &'a str) -> impl Iterator<Item = &'a Spot> {
        self.spots.iter().filter(move |spot| spot.hazard == hazard && spot.run.subject == subject)
    }

    /// The worst answer of one contestant at one hazard, over all distances.
    pub fn worst(&self, hazard: &str, subject: &str) -> Option<Answer> {
        self.series(hazard, subject).map(|spot| spot.run.answer).max()
    }

    /// Whether a contestant refused every toss near a hazard because it solves coins alone.
    pub fn is_for_coins_alone(&self, hazard: &str, subject: &str) -> bool {
        self.series(hazard, subject).all(|spot| spot.run.is_for_coins)
    }

    /// The names of the contestants, in their order.
    pub fn subjects(&self) -> Vec<&str> {
        let Some(first) = self.spots.first() else { return Vec::new() };
        let same = |spot: &&Spot| spot.hazard == first.hazard && spot.distance == first.distance;
        self.spots.iter().take_while(same).map(|spot| spot.run.subject.as_str()).collect()
    }
}

/// Every solver of `registry`, each integrator with every scheme in every formulation that it offers. A scheme takes
/// `control` if it can, and otherwise the library's default tolerance or step.
pub fn contestants_at(registry: &[SolverEntry], control: Option<StepControl>) -> Result<Vec<Subject>, InputError> {
    let stepping = |scheme: Scheme| match control {
        Some(StepControl::Tolerance(tolerance)) if scheme.is_adaptive() => Stepping::adaptive(scheme, tolerance),
        Some(StepControl::Step(step)) if scheme.takes_steps() => Stepping::fixed(scheme, step),
        _ => usual(scheme),
    };
    let mut contestants = Vec::new();
    for entry in registry {
        let one = [Formulation::default()];
        let formulations = if entry.formulations().is_empty() { &one } else { entry.formulations() };
        for &formulation in formulations {
            for (entry, scheme) in by_scheme(entry) {
                contestants.push(Subject::new(entry, scheme.map(stepping).transpose()?, formulation));
            }
        }
    }
    Ok(contestants)
}

struct Place {
    hazard: &'static str,
    distance: f64,
    toss: Toss,
    exact: Reference,
}

impl Place {
    fn new(hazard: &Hazard, distance: f64) -> anyhow::Result<Self> {
        let toss = (hazard.toss)(distance)?;
        Ok(Self { hazard: hazard.id, distance, toss, exact: reference::of(&toss)? })
    }

    fn flown(&self, subject: &Subject) -> Spot {
        let Self { hazard, distance, .. } = *self;
        Spot { hazard, distance, run: Run::new(subject, &self.toss, &self.exact) }
    }
}
