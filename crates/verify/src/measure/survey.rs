//! The survey solves the same random launches once with every subject and once with the 256-bit reference. Several
//! checks read these landings (errors, conserved quantities, differences between solvers), so that they are computed
//! only once.

use std::f64::consts::{PI, SQRT_2};

use rayon::prelude::*;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed};
use sampling::Space;
use toss::{Coin, CoinToss, InputError, Landing, Launch, SolveError};

use crate::measure::case::Case;
use crate::measure::measurement::{Deviation, Measurement};
use crate::measure::random_flights::random_flights;
use crate::measure::reference::Reference;
use crate::measure::run::Allowance;
use crate::measure::subject::Subject;
use crate::measure::throws::{evenly, throw};

/// Seed of the launches; its value has no meaning.
const SEED: u64 = 20_260_101;

/// The golden section and √3, whose multiples are [spread evenly](evenly).
const GOLDEN: f64 = 0.618_033_988_749_894_9;
const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// The random launches with their landings.
pub struct Survey {
    /// The launches.
    pub cases: Vec<Case>,
    /// Their landings in 256 bits.
    pub references: Vec<Reference>,
    /// The landing of each launch, by subject in the order of the subjects.
    pub landings: Vec<Vec<Result<Landing, SolveError>>>,
}

impl Survey {
    /// Solves `launches` random launches with every subject.
    ///
    /// # Errors
    /// Never: the space of launches is fixed and valid.
    pub fn new(subjects: &[Subject], launches: u64) -> Result<Self, InputError> {
        let cases = launches_of_the_survey(launches)?;
        let references = cases.par_iter().map(|case| Reference::new(&case.toss)).collect();
        let fly = |subject: &Subject| cases.par_iter().map(|case| subject.solver.land(&case.toss.into())).collect();
        let landings = subjects.iter().map(fly).collect();
        Ok(Self { cases, references, landings })
    }

    /// The errors that are allowed `subject`, which has these `landings`, on launch number `index`.
    ///
    /// # Errors
    /// That of the landing.
    pub fn allowance(
        &self,
        subject: &Subject,
        landings: &[Result<Landing, SolveError>],
        index: usize,
    ) -> Result<Option<Allowance>, SolveError> {
        let landing = landings[index].as_ref().map_err(Clone::clone)?;
        Ok(Allowance::new(subject, &self.cases[index].toss.into(), landing.error))
    }

    /// The largest of the `deviations` of `subject`, one for each of its `landings`; see [`Measurement::largest`].
    pub fn largest(
        &self,
        subject: &Subject,
        landings: &[Result<Landing, SolveError>],
        deviations: impl IntoIterator<Item = Deviation>,
        allowed: fn(&Allowance) -> f64,
    ) -> Measurement {
        let allowed = |index: usize| Ok(self.allowance(subject, landings, index)?.as_ref().map(allowed));
        Measurement::largest_within(subject, deviations, |index| self.cases[index], allowed)
    }
}

/// The launches: rates of up to 60 rad/s on each axis, and times of flight as of speeds of 3 to 5 m/s at 9.81 m/s², but
/// [given in every form](throw). One in 25 is slow: all its rates are below 1e-3 rad/s. Of each four launches two start
/// horizontal and two are tilted by an angle between 0 and π.
fn launches_of_the_survey(launches: u64) -> Result<Vec<Case>, InputError> {
    let axes = [(RateX, "-60:60"), (RateY, "-60:60"), (RateZ, "-60:60"), (Speed, "3:5")];
    let space = Space::parse(Coin::PAPER, &axes)?;
    let vary = |(turn, drawn): (u64, CoinToss)| {
        let tilt = if turn % 4 >= 2 { PI * evenly(turn, GOLDEN) } else { 0.0 };
        let slower = if turn % 25 == 24 { 10f64.powf(-10.0 + 5.0 * evenly(turn, SQRT_3)) } else { 1.0 };
        let flight = throw(drawn.launch.time_of_flight(), turn);
        let launch = Launch::new(drawn.launch.rate() * slower, flight)?.with_tilt(tilt)?;
        Ok(Case { toss: CoinToss { coin: coin(turn)?, launch }, tilt })
    };
    (0..).zip(random_flights(&space, SEED, launches)?).map(vary).collect()
}

/// The coin of launch number `turn`. Of each three, one has the inertia ratio k = 0.5, one has 1.98 and one has any
/// from 0.5 to that of a flat disc (2), at times exactly that of a sphere or a disc. Rods fly in the reference numbers
/// and in the search, because the tolerance of an integrator buys less accuracy there. The moments I1 are between 1e-12
/// and 1e3 kg m².
fn coin(turn: u64) -> Result<Coin, InputError> {
    let k = match (turn % 3, turn % 30) {
        (0, _) => 0.5,
        (1, _) => 1.98,
        (_, 14) => 1.0,
        (_, 23) => 2.0,
        _ => 0.5 + 1.5 * evenly(turn, SQRT_3),
    };
    let i1 = 10f64.powf(-12.0 + 15.0 * evenly(turn, SQRT_2));
    Coin::from_moments(i1, (k * i1).min(2.0 * i1))
}
