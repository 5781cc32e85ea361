//! Charts as SVG, a file each.

mod errors;
mod flight;
mod map;

pub(crate) use errors::{ErrorLine, Reference, errors};
pub(crate) use flight::flight;
pub(crate) use map::map;
