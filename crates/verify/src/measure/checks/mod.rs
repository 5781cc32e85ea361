//! The list of all checks of the suite. A check is one claim about the solvers, the kernels or the sampling methods,
//! and how it is measured; each file of this folder holds the checks of one kind, so a new check is a constant and
//! one line below.

mod adversarial;
mod atlas;
mod batch;
mod bodies;
mod certified;
mod claims;
mod coins;
mod counting;
mod coverage;
mod detest;
mod enclosed;
mod enclosure;
mod figures;
mod first_return;
mod hostile;
mod integrated;
mod integrated_bodies;
mod invariants;
mod judged;
mod long_flights;
mod margins;
mod mean_error;
mod methods;
mod numbers;
pub mod of_toss;
mod order;
mod paper;
mod planner;
mod probability;
mod random;
mod rigid;
mod sensitivity;
mod tolerance;
mod work_precision;

use crate::measure::check::Check;

/// All checks, in the order in which they run.
pub const CHECKS: &[Check] = &[
    numbers::COS_TILT,
    numbers::ATTITUDE,
    detest::STATE,
    random::COS_TILT,
    random::ATTITUDE,
    random::CROSS_METHOD,
    claims::MEASURED,
    certified::COS_TILT,
    certified::ATTITUDE,
    certified::EULER_ANGLES,
    certified::OUTCOMES,
    certified::BOUNDS,
    integrated::BOUNDS,
    integrated::OUTCOMES,
    integrated::TIGHTNESS,
    batch::COS_TILT,
    batch::ATTITUDE,
    batch::OUTCOMES,
    batch::SIMD_LEVELS,
    rigid::COS_TILT,
    rigid::ATTITUDE,
    rigid::COMPENSATED_COS_TILT,
    rigid::COMPENSATED_ATTITUDE,
    rigid::OUTCOMES,
    bodies::WITHIN_ESTIMATE,
    bodies::STATED,
    bodies::ATTITUDE,
    bodies::CONSERVED,
    bodies::PUBLISHED,
    mean_error::COS_TILT,
    mean_error::TERMS,
    margins::MARGINS,
    margins::SPEEDS,
    coins::MOMENTS,
    first_return::ATTITUDE,
    invariants::MOMENTUM,
    invariants::ENERGY,
    invariants::NORMAL_MOMENTUM_BODY,
    invariants::NORMAL_MOMENTUM_TRANSPORT,
    invariants::MOMENTUM_VECTOR,
    invariants::PROJECTION,
    atlas::ANSWERS,
    atlas::TILT_WORK,
    atlas::RETURN_WORK,
    adversarial::SILENTLY_WRONG,
    adversarial::REFUSED,
    long_flights::ERROR,
    long_flights::DRIFT,
    hostile::WITHIN_ESTIMATE,
    sensitivity::DERIVATIVES,
    work_precision::WITHIN_ESTIMATE,
    order::ORDER,
    tolerance::PROPORTION,
    planner::DELIVERS,
    planner::EXPECTS,
    hostile::PLANS,
    paper::CHEATED_IN_FLIGHT,
    paper::CHEATED_FOREVER,
    paper::TAILS_IN_FLIGHT,
    paper::FIRST_FLIP,
    probability::LONG_FLIGHT,
    probability::LONG_FLIGHT_SHARE,
    probability::TABLES,
    probability::FIG4_GRID_IN_RANDOM,
    probability::FIG4_SAME_COUNTS,
    counting::GRID_LAUNCHES,
    counting::GRID_COUNTS,
    counting::ONE_BY_ONE,
    figures::SHARES,
    figures::SHARE_BOUNDS,
    figures::ISOTROPIC,
    figures::FIGURES,
    enclosure::FIGURES,
    enclosure::OVERLAP,
    methods::ERRORS,
    coverage::COVERAGE,
    methods::EXACT_COVERAGE,
];
