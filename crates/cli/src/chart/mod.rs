//! Charts as SVG, a file each.

mod coin;
mod errors;
mod flight;
mod layout;
mod limit;
mod map;
mod projection;
mod sphere;

pub(crate) use errors::{ErrorLine, Reference, errors};
pub(crate) use flight::flight;
pub(crate) use limit::limit;
pub(crate) use map::map;
