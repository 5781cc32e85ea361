//! The exact landings of tosses by the [reference](Reference), each computed once, because several checks ask for that of the
//! same toss.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use dynamics::Toss;

use super::case;
use super::reference::{self, Reference};

/// So many landings are kept, of about a kilobyte each; further ones are computed again.
const KEPT: usize = 200_000;

/// The exact landings that were asked for, by the text of their tosses, which says everything that a toss is given by.
#[derive(Default)]
pub struct ExactLandings(Mutex<HashMap<String, Option<Arc<Reference>>>>);

impl ExactLandings {
    /// The exact landing of `toss`; `None` if it has none, so that it is not judged.
    pub fn of(&self, toss: &Toss) -> Option<Arc<Reference>> {
        let text = case::text(toss);
        if let Some(known) = self.known().get(&text) {
            return known.clone();
        }
        let landing = reference::of(toss).ok().map(Arc::new);
        let mut known = self.known();
        if known.len() < KEPT {
            known.insert(text, landing.clone());
        }
        landing
    }

    fn known(&self) -> MutexGuard<'_, HashMap<String, Option<Arc<Reference>>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
