//! The atlas of failures: every contestant at every distance from every [hazard](hazards).
//!
//! A contestant is a solver × scheme × formulation at the settings a user gets without asking. The raw formulations are
//! there to fail.

pub mod conditioning;
pub mod expected;
pub mod hazards;

use rayon::prelude::*;
use serde::Serialize;
use toss::{Formulation, InputError, SolverEntry};

use crate::measure::case::Case;
use crate::measure::reference::Reference;
use crate::measure::run::{Answer, Run};
use crate::measure::subject::{Subject, by_every_scheme, usual};
use conditioning::Conditioning;
use hazards::{HAZARDS, Hazard};

/// One contestant at one distance from one hazard.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Spot {
    /// The hazard's id.
    pub hazard: &'static str,
    /// The distance from it.
    pub distance: f64,
    /// What a relative change of the launch does to the landing; null where the phase is too large.
    pub conditioning: Option<Conditioning>,
    /// What the contestant made of it.
    #[serde(flatten)]
    pub run: Run,
}

/// All spots.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(transparent)]
pub struct Atlas {
    /// By hazard, distance and contestant, in this order.
    pub spots: Vec<Spot>,
}

impl Atlas {
    /// Flies every contestant of `registry`.
    ///
    /// # Errors
    /// Never for the library's own solvers and hazards.
    pub fn new(registry: &[SolverEntry]) -> anyhow::Result<Self> {
        let contestants = contestants(registry)?;
        let mut spots = Vec::new();
        for hazard in HAZARDS {
            for distance in hazard.distances {
                spots.extend(fly(hazard, *distance, &contestants)?);
            }
        }
        Ok(Self { spots })
    }

    /// The spots of one contestant under one hazard, from far to near.
    pub fn series<'a>(&'a self, hazard: &'a str, subject: &'a str) -> impl Iterator<Item = &'a Spot> {
        self.spots.iter().filter(move |spot| spot.hazard == hazard && spot.run.subject == subject)
    }

    /// The worst answer of one contestant under one hazard.
    pub fn worst(&self, hazard: &str, subject: &str) -> Option<Answer> {
        self.series(hazard, subject).map(|spot| spot.run.answer).max()
    }

    /// The contestants, in their order.
    pub fn subjects(&self) -> Vec<&str> {
        let Some(first) = self.spots.first() else { return Vec::new() };
        let same = |spot: &&Spot| spot.hazard == first.hazard && spot.distance == first.distance;
        self.spots.iter().take_while(same).map(|spot| spot.run.subject.as_str()).collect()
    }
}

/// One toss by every contestant.
///
/// # Errors
/// Never for the library's own solvers.
pub fn replay(registry: &[SolverEntry], case: &Case) -> Result<Vec<Run>, InputError> {
    let reference = Reference::new(&case.toss);
    Ok(contestants(registry)?.iter().map(|subject| Run::new(subject, case, &reference)).collect())
}

/// The names of the contestants, in their order; none is flown.
///
/// # Errors
/// Never for the library's own solvers.
pub fn names(registry: &[SolverEntry]) -> Result<Vec<String>, InputError> {
    Ok(contestants(registry)?.into_iter().map(|subject| subject.name).collect())
}

/// Every solver of `registry`, each integrator by every scheme in every formulation that differs for it.
fn contestants(registry: &[SolverEntry]) -> Result<Vec<Subject>, InputError> {
    let mut contestants = Vec::new();
    for entry in registry {
        let one = [Formulation::default()];
        let formulations = if entry.formulations().is_empty() { &one } else { entry.formulations() };
        for &formulation in formulations {
            contestants.extend(by_every_scheme(entry, formulation, usual)?);
        }
    }
    Ok(contestants)
}

fn fly(hazard: &Hazard, distance: f64, contestants: &[Subject]) -> anyhow::Result<Vec<Spot>> {
    let case: Case = (hazard.case)(distance)?;
    let reference = Reference::new(&case.toss);
    let conditioning = Conditioning::new(&case.toss)?;
    let spot = |subject: &Subject| Spot {
        hazard: hazard.id,
        distance,
        conditioning,
        run: Run::new(subject, &case, &reference),
    };
    // One at a time: some stall, and would hold up their neighbours.
    Ok(contestants.par_iter().with_max_len(1).map(spot).collect())
}
