//! The list of all checks of the suite. A check is one claim about the solvers, the kernels or the sampling methods,
//! and how it is measured; each file of this folder holds the checks of one family, so a new check is a constant and
//! one line below.

mod counting;
mod coverage;
mod exact;
mod hard_places;
mod landings;
mod planner;
mod probability;
mod proofs;
mod reference;
mod work;

use crate::measure::check::Check;

/// All checks, in the order in which they run.
pub const CHECKS: &[Check] = &[
    reference::COS_TILT,
    reference::ATTITUDE,
    reference::DETEST,
    landings::COS_TILT,
    landings::ATTITUDE,
    landings::CROSS_METHOD,
    landings::CLAIMS,
    exact::COS_TILT,
    exact::ATTITUDE,
    exact::EULER_ANGLES,
    exact::OUTCOMES,
    exact::BOUNDS,
    proofs::BOUNDS,
    proofs::OUTCOMES,
    proofs::TIGHTNESS,
    exact::BATCH_COS_TILT,
    exact::BATCH_ATTITUDE,
    exact::BATCH_OUTCOMES,
    exact::SIMD_LEVELS,
    exact::RIGID_COS_TILT,
    exact::RIGID_ATTITUDE,
    exact::RIGID_COMPENSATED_COS_TILT,
    exact::RIGID_COMPENSATED_ATTITUDE,
    exact::RIGID_OUTCOMES,
    landings::BODIES_WITHIN_ESTIMATE,
    landings::BODIES_STATED,
    landings::BODIES_ATTITUDE,
    landings::BODIES_CONSERVED,
    reference::PUBLISHED,
    exact::MEAN_COS_TILT,
    exact::TERMS,
    exact::MARGINS,
    exact::SPEEDS,
    reference::MOMENTS,
    landings::FIRST_RETURN,
    landings::MOMENTUM,
    landings::ENERGY,
    landings::NORMAL_MOMENTUM_BODY,
    landings::NORMAL_MOMENTUM_TRANSPORT,
    landings::MOMENTUM_VECTOR,
    landings::PROJECTION,
    hard_places::ANSWERS,
    hard_places::TILT_WORK,
    hard_places::RETURN_WORK,
    hard_places::SILENTLY_WRONG,
    hard_places::REFUSED,
    hard_places::LONG_ERROR,
    hard_places::LONG_DRIFT,
    hard_places::HOSTILE,
    exact::DERIVATIVES,
    work::WITHIN_ESTIMATE,
    work::ORDER,
    work::PROPORTION,
    planner::DELIVERS,
    planner::EXPECTS,
    planner::PLANS,
    reference::CHEATED_IN_FLIGHT,
    reference::CHEATED_FOREVER,
    reference::TAILS_IN_FLIGHT,
    reference::FIRST_FLIP,
    probability::LONG_FLIGHT,
    probability::LONG_FLIGHT_SHARE,
    probability::TABLES,
    probability::FIG4_GRID_IN_RANDOM,
    probability::FIG4_SAME_COUNTS,
    counting::GRID_LAUNCHES,
    counting::GRID_COUNTS,
    counting::ONE_BY_ONE,
    probability::SHARES,
    probability::SHARE_BOUNDS,
    probability::ISOTROPIC,
    probability::FIGURES,
    probability::ENCLOSURES,
    probability::OVERLAP,
    probability::ERRORS,
    coverage::COVERAGE,
    probability::EXACT_COVERAGE,
];
