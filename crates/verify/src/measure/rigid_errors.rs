//! The errors of the exact motion of any rigid body against the 256-bit reference, in families of bodies and launches
//! each of which is hard for a method of its own, with phases up to 1e9 rad. Several checks read them, so that each
//! reference, which takes longer than the motion, is computed only once.

use dynamics::Toss;
use exact::ExactMotion;
use rayon::prelude::*;

use crate::measure::bodies::{FAMILIES, Family, LONG, launches};
use crate::measure::effort::Effort;
use crate::measure::hard_cases::tries;
use crate::measure::reference::rigid::RigidReference;

/// The errors of one motion at landing; infinite where it gives no answer.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Errors {
    /// Of cos θ.
    pub(crate) cos_tilt: f64,
    /// The angle to the exact attitude (rad).
    pub(crate) attitude: f64,
}

impl Errors {
    const NO_ANSWER: Self = Self { cos_tilt: f64::INFINITY, attitude: f64::INFINITY };

    fn new(motion: &ExactMotion, toss: &Toss, reference: &RigidReference) -> Self {
        let time = toss.launch.time_of_flight();
        let (cos_tilt, state) = (motion.cos_tilt(time), motion.state(time));
        Self {
            cos_tilt: cos_tilt.map_or(f64::INFINITY, |found| reference.cos_tilt_error(found)),
            attitude: state.map_or(f64::INFINITY, |state| reference.attitude_error(&state.attitude)),
        }
    }
}

/// A toss of a family with the errors of both motions.
#[derive(Debug)]
pub(crate) struct Judged {
    pub(crate) toss: Toss,
    /// Of the motion in double-double.
    pub(crate) motion: Errors,
    /// Of the compensated motion, whose sums are in f64.
    pub(crate) compensated: Errors,
}

impl Judged {
    fn new(toss: Toss) -> Self {
        let both = RigidReference::new(&toss).map(|reference| {
            [ExactMotion::new(&toss), ExactMotion::compensated(&toss)]
                .map(|motion| Errors::new(&motion, &toss, &reference))
        });
        let [motion, compensated] = both.unwrap_or([Errors::NO_ANSWER; 2]);
        Self { toss, motion, compensated }
    }
}

/// The number of tosses in a family.
pub(crate) fn tosses_of_a_family(effort: Effort) -> u64 {
    tries(effort) / 20
}

/// The tosses of each family.
pub(crate) fn of_families(effort: Effort) -> Vec<(&'static Family, Vec<Judged>)> {
    let of_family = |family: &'static Family| {
        let tosses: Vec<Toss> = launches(family, tosses_of_a_family(effort), LONG).collect();
        (family, tosses.into_par_iter().map(Judged::new).collect())
    };
    FAMILIES.iter().map(of_family).collect()
}
