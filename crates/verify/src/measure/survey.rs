//! A survey flies the same tosses once with every subject, beside their exact landings. Several checks read these landings
//! (errors, conserved quantities, differences between solvers), so that they are computed only once. One survey is of random
//! launches of coins, one of bodies in families each of which is hard for a method of its own.

use std::f64::consts::{PI, SQRT_2};
use std::sync::Arc;

use dynamics::Toss;
use rayon::prelude::*;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed};
use sampling::Space;
use toss::{Coin, Landing, SolveError};

use crate::measure::context::Context;
use crate::measure::exact_landings::ExactLandings;
use crate::measure::families::{FAMILIES, Family, TOSSED, launches};
use crate::measure::reference::Reference;
use crate::measure::subject::Subject;
use crate::measure::tosses::{GOLDEN, evenly, random_flights, throw, tossed};

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

/// What a solver answered to each toss of a survey.
pub type Landings = Vec<Result<Landing, SolveError>>;

impl Survey {
    /// Solves `launches` random launches with every subject.
    pub fn random(subjects: &[Subject], launches: u64) -> anyhow::Result<Self> {
        Ok(Self::of(subjects, random_launches(launches)?, Vec::new(), &ExactLandings::default()))
    }

    /// Solves tosses of bodies of every family with every subject.
    pub(crate) fn of_bodies(context: &Context) -> Self {
        let number = context.effort.launches([20, 100, 15_000]);
        let of_family =
            |family: &'static Family| launches(family, number, TOSSED).into_iter().map(move |toss| (toss, family.name));
        let (tosses, families) = FAMILIES.iter().flat_map(of_family).unzip();
        Self::of(&context.subjects, tosses, families, &context.exact)
    }

    /// Solves `toss` with those of the subjects that `is_asked` for by their names.
    pub(crate) fn of_one(context: &Context, toss: &Toss, is_asked: &dyn Fn(&str) -> bool) -> Self {
        let one = Self::of(&[], vec![*toss], Vec::new(), &context.exact);
        let fly = |by: &Subject| if is_asked(&by.name) { vec![by.solver.land(toss)] } else { Vec::new() };
        Self { landings: context.subjects.iter().map(fly).collect(), ..one }
    }

    /// Solves `tosses`, of these families, with every subject. A solver that refuses bodies has no landings of them.
    pub fn of(subjects: &[Subject], tosses: Vec<Toss>, families: Vec<&'static str>, exact: &ExactLandings) -> Self {
        let is_of_bodies = tosses.iter().any(|toss| toss.coin().is_none());
        let fly = |subject: &Subject| {
            let landings: Landings = tosses.par_iter().with_max_len(1).map(|toss| subject.solver.land(toss)).collect();
            let is_refused = |landing: &Result<_, _>| matches!(landing, Err(SolveError::NotSymmetric { .. }));
            if is_of_bodies && landings.iter().any(is_refused) { Vec::new() } else { landings }
        };
        let landings: Vec<Landings> = subjects.par_iter().map(fly).collect();
        // Where all refuse bodies, nothing is compared.
        let is_flown = !is_of_bodies || subjects.is_empty() || landings.iter().any(|of_one| !of_one.is_empty());
        let exact = tosses.par_iter().map(|toss| if is_flown { exact.of(toss) } else { None }).collect();
        Self { tosses, families, exact, landings }
    }
}

/// The random launches: rates of up to 60 rad/s on each axis, and times of flight as of speeds of 3 to 5 m/s at 9.81 m/s², but
/// [given in every form](throw). One in 25 is slow: all its rates are below 1e-3 rad/s. Of each four launches two start
/// horizontal and two are tilted by an angle between 0 and π.
pub(super) fn random_launches(launches: u64) -> anyhow::Result<Vec<Toss>> {
    let axes = [(RateX, "-60:60"), (RateY, "-60:60"), (RateZ, "-60:60"), (Speed, "3:5")];
    let space = Space::parse(Coin::PAPER, &axes)?;
    let vary = |(turn, drawn): (u64, Toss)| {
        let tilt = if turn % 4 >= 2 { PI * evenly(turn, GOLDEN) } else { 0.0 };
        let slower = if turn % 25 == 24 { 10f64.powf(-10.0 + 5.0 * evenly(turn, SQRT_3)) } else { 1.0 };
        let flight = throw(drawn.launch.time_of_flight(), turn);
        Ok(tossed(coin(turn)?, drawn.launch.rate() * slower, flight, tilt)?)
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
