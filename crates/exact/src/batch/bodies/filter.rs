//! The filter of a body's outcomes, which batches share whose tosses have the same body, attitude at launch and gravity.

use dynamics::{Attitude, Body, Tosses};

use super::constants::Constants;

/// The constants by which a batch filters the outcomes of a body. Making them takes as long as some hundred tosses, so
/// that many short batches should share them: see [`Batch::count_by`](super::Batch::count_by).
#[derive(Debug, Clone, Copy)]
pub struct BodyFilter {
    body: Body,
    attitude: Attitude,
    gravity: f64,
    constants: Option<Constants>,
}

impl BodyFilter {
    /// The filter of `tosses`, whose rates and speeds do not matter.
    pub fn new(tosses: &Tosses<'_, Body>) -> Self {
        let constants = Constants::new(tosses);
        Self { body: *tosses.body(), attitude: tosses.attitude(), gravity: tosses.gravity(), constants }
    }

    /// The constants of `tosses`: those of the filter if it was made for such tosses.
    pub(super) fn constants_of(&self, tosses: &Tosses<'_, Body>) -> Option<Constants> {
        let is_theirs =
            self.body == *tosses.body() && self.attitude == tosses.attitude() && self.gravity == tosses.gravity();
        if is_theirs { self.constants } else { Constants::new(tosses) }
    }
}
