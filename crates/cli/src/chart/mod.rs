//! The charts of the commands as SVG, one file for each chart or for each part of it. They draw and compute nothing else.

mod certain_line;
mod coin;
mod errors;
mod flight;
mod layout;
mod legend;
mod limit;
mod map;
mod projection;
mod solid;
mod sphere;

pub(crate) use errors::{ErrorLine, Reference, errors};
pub(crate) use flight::flight;
pub(crate) use layout::points_to_draw;
pub(crate) use limit::limit;
pub(crate) use map::map;
