//! A survey flies the same tosses once with every subject, beside their exact landings. Several checks read these landings
//! (errors, conserved quantities, differences between solvers), so that they are computed only once. One survey is of random
//! launches of coins, one of bodies in families each of which is hard for a method of its own.

use std::f64::consts::{PI, SQRT_2};
use std::sync::Arc;

use dynamics::Toss;
use rayon::prelude::*;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed};
use sampling::Space;
use toss::{Coin, CoinToss, Landing, Launch, SolveError};

use crate::measure::cases::Case;
use crate::measure::effort::Effort;
use crate::measure::families::{FAMILIES, TOSSED, launches};
use crate::measure::reference::Reference;
use crate::measure::run::Allowance;
use crate::measure::subject::Subject;
use crate::measure::tosses::{GOLDEN, evenly, random_flights, throw};

/// Seed of the random launches; its value has no meaning.
const SEED: u64 = 20_260_101;

/// √3, whose multiples are [spread evenly](evenly).
const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// Tosses with their landings.
pub struct Survey {
    /// The tosses.
    pub tosses: Vec<Toss>,
    /// The family of each; empty if there are none.
    pub families: Vec<&'static str>,
    /// Their exact landings, where they have one.
    pub exact: Vec<Option<Arc<Reference>>>,
    /// The landing of each toss, by subject in the order of the subjects.
    pub landings: Vec<Landings>,
}

/// What a solver answered to a toss.
pub type Solved = Result<Landing, SolveError>;

/// What a solver answered to each toss of a survey.
pub type Landings = Vec<Solved>;

impl Survey {
    /// Solves `launches` random launches with every subject.
    ///
    /// # Errors
    /// Never: the space of launches is fixed and valid.
    pub fn random(subjects: &[Subject], launches: u64) -> anyhow::Result<Self> {
        Self::of(subjects, launches_of_the_survey(launches)?, Vec::new())
    }

    /// Solves tosses of bodies of every family with every subject.
    pub(crate) fn of_bodies(subjects: &[Subject], effort: Effort) -> anyhow::Result<Self> {
        let number = match effort {
            Effort::Quick => 20,
            Effort::Standard => 100,
            Effort::Deep => 15_000,
        };
        let of_family = |family| launches(family, number, TOSSED).map(move |toss| (toss, family.name));
        let (tosses, families) = FAMILIES.iter().flat_map(of_family).unzip();
        Self::of(subjects, tosses, families)
    }

    /// Solves `tosses`, of these families, with every subject.
    ///
    /// # Errors
    /// Never so far.
    pub fn of(subjects: &[Subject], tosses: Vec<Toss>, families: Vec<&'static str>) -> anyhow::Result<Self> {
        let exact = tosses.par_iter().map(|toss| Reference::of(toss).ok().map(Arc::new)).collect();
        Ok(Self::flown(subjects, tosses, families, exact))
    }

    /// Solves `cases` with every subject.
    pub(crate) fn of_cases<'a>(subjects: &[Subject], cases: impl Iterator<Item = &'a Case>) -> anyhow::Result<Self> {
        let (tosses, exact) = cases.map(|case| (case.toss, case.reference.clone())).unzip();
        Ok(Self::flown(subjects, tosses, Vec::new(), exact))
    }

    fn flown(
        subjects: &[Subject],
        tosses: Vec<Toss>,
        families: Vec<&'static str>,
        exact: Vec<Option<Arc<Reference>>>,
    ) -> Self {
        let is_of_bodies = tosses.iter().any(|toss| toss.coin().is_none());
        let fly = |subject: &Subject| {
            let landings: Landings = tosses.par_iter().with_max_len(1).map(|toss| subject.solver.land(toss)).collect();
            let is_refused = |landing: &Solved| matches!(landing, Err(SolveError::NotSymmetric { .. }));
            if is_of_bodies && landings.iter().any(is_refused) { Vec::new() } else { landings }
        };
        let landings = subjects.par_iter().map(fly).collect();
        Self { tosses, families, exact, landings }
    }

    /// The errors that are allowed `subject`, which has these `landings`, on toss number `index`.
    ///
    /// # Errors
    /// That of the landing.
    pub fn allowance(
        &self,
        subject: &Subject,
        landings: &Landings,
        index: usize,
    ) -> Result<Option<Allowance>, SolveError> {
        let landing = landings[index].as_ref().map_err(Clone::clone)?;
        Ok(Allowance::new(subject, &self.tosses[index], landing.error))
    }
}

/// The random launches: rates of up to 60 rad/s on each axis, and times of flight as of speeds of 3 to 5 m/s at 9.81 m/s², but
/// [given in every form](throw). One in 25 is slow: all its rates are below 1e-3 rad/s. Of each four launches two start
/// horizontal and two are tilted by an angle between 0 and π.
fn launches_of_the_survey(launches: u64) -> anyhow::Result<Vec<Toss>> {
    let axes = [(RateX, "-60:60"), (RateY, "-60:60"), (RateZ, "-60:60"), (Speed, "3:5")];
    let space = Space::parse(Coin::PAPER, &axes)?;
    let vary = |(turn, drawn): (u64, CoinToss)| {
        let tilt = if turn % 4 >= 2 { PI * evenly(turn, GOLDEN) } else { 0.0 };
        let slower = if turn % 25 == 24 { 10f64.powf(-10.0 + 5.0 * evenly(turn, SQRT_3)) } else { 1.0 };
        let flight = throw(drawn.launch.time_of_flight(), turn);
        let launch = Launch::new(drawn.launch.rate() * slower, flight)?.with_tilt(tilt)?;
        Ok(CoinToss { coin: coin(turn)?, launch }.into())
    };
    (0..).zip(random_flights(&space, SEED, launches)?).map(vary).collect()
}

/// The coin of launch number `turn`. Of each three, one has the inertia ratio k = 0.5, one has 1.98 and one has any
/// from 0.5 to that of a flat disc (2), at times exactly that of a sphere or a disc. Rods fly in the reference numbers
/// and in the search, because the tolerance of an integrator buys less accuracy there. The moments I1 are between 1e-12
/// and 1e3 kg m².
fn coin(turn: u64) -> anyhow::Result<Coin> {
    let k = match (turn % 3, turn % 30) {
        (0, _) => 0.5,
        (1, _) => 1.98,
        (_, 14) => 1.0,
        (_, 23) => 2.0,
        _ => 0.5 + 1.5 * evenly(turn, SQRT_3),
    };
    let i1 = 10f64.powf(-12.0 + 15.0 * evenly(turn, SQRT_2));
    Ok(Coin::from_moments(i1, (k * i1).min(2.0 * i1))?)
}
