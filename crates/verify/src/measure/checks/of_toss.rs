//! What the checks of the library measure on a single toss. A check takes these functions over sets of tosses; the replay
//! of a worst input calls each of them on that toss, so that it runs what failed.

use toss::CoinToss;

use super::{batch, certified, integrated, margins, mean_error, sensitivity};
use crate::measure::case::Case;
use crate::measure::measurement::Deviation;
use crate::measure::reference::Reference;

/// What a check measures on a toss.
pub struct OfToss {
    /// The check.
    pub check: &'static str,
    /// Which of the check's quantities; empty if it has one.
    pub part: &'static str,
    measure: fn(&CoinToss, &Reference) -> Deviation,
}

const fn of(check: &'static str, part: &'static str, measure: fn(&CoinToss, &Reference) -> Deviation) -> OfToss {
    OfToss { check, part, measure }
}

/// All of them, in the order of the checks.
pub const OF_TOSS: &[OfToss] = &[
    of(certified::COS_TILT.id, "", certified::cos_tilt_error),
    of(certified::ATTITUDE.id, "", certified::attitude_error),
    of(certified::EULER_ANGLES.id, "", certified::euler_angles_error),
    of(certified::OUTCOMES.id, "", certified::outcome_differs),
    of(certified::BOUNDS.id, "f64", certified::of_f64),
    of(certified::BOUNDS.id, "double-double", certified::of_double_double),
    of(batch::COS_TILT.id, "", batch::cos_tilt_error),
    of(batch::ATTITUDE.id, "", batch::attitude_error),
    of(batch::OUTCOMES.id, "", batch::outcome_differs),
    of(batch::SIMD_LEVELS.id, "", |toss, _| batch::levels_that_differ(toss)),
    of(sensitivity::DERIVATIVES.id, "attitude", |toss, _| sensitivity::errors(toss).map(|[attitude, _]| attitude)),
    of(sensitivity::DERIVATIVES.id, "cos θ", |toss, _| sensitivity::errors(toss).map(|[_, cos_tilt]| cos_tilt)),
    of(mean_error::TERMS.id, "", mean_error::terms_error),
    of(margins::MARGINS.id, "", margins::wrong_margins),
    of(margins::SPEEDS.id, "", margins::wrong_speeds),
    of(integrated::BOUNDS.id, integrated::SETS[0].0, integrated::share_of_set::<0>),
    of(integrated::BOUNDS.id, integrated::SETS[1].0, integrated::share_of_set::<1>),
    of(integrated::BOUNDS.id, integrated::SETS[2].0, integrated::share_of_set::<2>),
    of(integrated::BOUNDS.id, integrated::SETS[3].0, integrated::share_of_set::<3>),
    of(integrated::BOUNDS.id, integrated::SETS[4].0, integrated::share_of_set::<4>),
    of(integrated::BOUNDS.id, integrated::SETS[5].0, integrated::share_of_set::<5>),
    of(integrated::OUTCOMES.id, "", integrated::outcome_differs),
];

/// Measures all of them on the toss of `case`.
pub fn replay(case: &Case) -> Vec<(&'static OfToss, Deviation)> {
    let reference = Reference::new(&case.toss);
    OF_TOSS.iter().map(|one| (one, (one.measure)(&case.toss, &reference))).collect()
}
