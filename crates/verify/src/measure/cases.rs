//! A case is a toss with its exact landing, which several checks share.

use std::sync::Arc;

use dynamics::Toss;
use rayon::prelude::*;

use crate::measure::effort::Effort;
use crate::measure::families::{FAMILIES, HARD, LONG, hard_tosses, launches};
use crate::measure::reference::Reference;
use crate::measure::tosses::tries;

/// A toss, with its exact landing where that was computed before.
#[derive(Clone)]
pub(crate) struct Case {
    /// The toss.
    pub(crate) toss: Toss,
    /// The landing.
    pub(crate) reference: Option<Arc<Reference>>,
}

impl Case {
    pub(super) fn solved(toss: Toss) -> Self {
        Self { toss, reference: Reference::of(&toss).ok().map(Arc::new) }
    }
}

/// The long flights of each family of bodies.
pub(super) fn long_bodies(effort: Effort) -> Vec<Vec<Case>> {
    let tosses = |family| launches(family, tries(effort) / 20, LONG).collect::<Vec<_>>();
    FAMILIES.iter().map(|family| tosses(family).into_par_iter().map(Case::solved).collect()).collect()
}

/// How many tosses of each hard family there are.
pub(super) fn hard_number(effort: Effort) -> u64 {
    match effort {
        Effort::Quick => 12,
        Effort::Standard => 60,
        Effort::Deep => 1500,
    }
}

/// The tosses of each hard family.
pub(super) fn hard_bodies(effort: Effort) -> Vec<Vec<Case>> {
    let tosses = |family| hard_tosses(family, hard_number(effort));
    HARD.iter().map(|family| tosses(family).into_par_iter().map(Case::solved).collect()).collect()
}
