//! The survey solves the same random launches once with every subject and once with the 256-bit reference. Several
//! checks read these landings (errors, conserved quantities, differences between solvers), so that they are computed
//! only once.

use std::f64::consts::PI;

use rayon::prelude::*;
use sampling::Coordinate::{RateX, RateY, RateZ, Speed};
use sampling::{Space, random_tosses};
use toss::{Coin, InputError, Propagation, SolveError, Toss};

use crate::measure::case::Case;
use crate::measure::reference::Reference;
use crate::measure::subject::Subject;

/// Seed of the launches; its value has no meaning.
const SEED: u64 = 20_260_101;

/// The random launches with their landings.
pub struct Survey {
    /// The launches.
    pub cases: Vec<Case>,
    /// Their landings in 256 bits.
    pub references: Vec<Reference>,
    /// The landing of each launch, by subject in the order of the subjects.
    pub landings: Vec<Vec<Result<Propagation, SolveError>>>,
}

impl Survey {
    /// Solves `launches` random launches with every subject.
    ///
    /// # Errors
    /// Never: the space of launches is fixed and valid.
    pub fn new(subjects: &[Subject], launches: u64) -> Result<Self, InputError> {
        let cases = launches_of_the_survey(launches)?;
        let references = cases.par_iter().map(|case| Reference::new(&case.toss)).collect();
        let fly = |subject: &Subject| cases.par_iter().map(|case| subject.solver.propagate(&case.toss)).collect();
        let landings = subjects.iter().map(fly).collect();
        Ok(Self { cases, references, landings })
    }
}

/// The launches: rates of up to 60 rad/s on each axis, speeds of 3 to 5 m/s, and inertia ratios k of 0.5 and 1.98 in
/// turn. Of each four launches two start horizontal and two are tilted by an angle between 0 and π; multiples of the
/// golden section spread these angles evenly.
fn launches_of_the_survey(launches: u64) -> Result<Vec<Case>, InputError> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let axes = [(RateX, "-60:60"), (RateY, "-60:60"), (RateZ, "-60:60"), (Speed, "3:5")];
    let space = Space::parse(Coin::PAPER, &axes)?;
    let coins = [Coin::from_moments(5e-7, 2.5e-7)?, Coin::from_moments(5e-7, 9.9e-7)?];
    random_tosses(&space, SEED, 0..launches)
        .into_iter()
        .enumerate()
        .map(|(index, toss)| {
            let tilted = index % 4 >= 2;
            #[expect(clippy::cast_precision_loss, reason = "indices stay far below 2^53")]
            let tilt = if tilted { PI * (index as f64 * GOLDEN).fract() } else { 0.0 };
            let toss = Toss { coin: coins[index % 2], launch: toss.launch.with_tilt(tilt)? };
            Ok(Case { toss, tilt })
        })
        .collect()
}
