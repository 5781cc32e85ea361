//! The list of all checks of the suite. A check is one claim about the solvers, the kernels or the sampling methods,
//! and how it is measured; each file of this folder has a table of the checks of one family, one row each.

mod counting;
mod coverage;
mod exact;
pub(super) mod hard;
mod hard_places;
mod landings;
mod margins;
mod planner;
mod probability;
mod proofs;
mod reference;
mod work;

use std::sync::LazyLock;

use crate::measure::check::Check;

/// All checks, in the order in which they run.
pub static CHECKS: LazyLock<Vec<Check>> = LazyLock::new(|| {
    [
        reference::CHECKS,
        landings::CHECKS,
        exact::CHECKS,
        proofs::CHECKS,
        hard_places::CHECKS,
        hard::CHECKS,
        margins::CHECKS,
        work::CHECKS,
        planner::CHECKS,
        probability::CHECKS,
        counting::CHECKS,
        coverage::CHECKS,
    ]
    .concat()
});
