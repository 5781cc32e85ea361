//! The charts of the commands as SVG, one file for each chart or for each part of it. They draw and compute nothing else.

mod errors;
mod flight;
mod limit;
mod map;
mod people;
mod running;
mod solid;

pub(crate) use errors::errors;
pub(crate) use flight::{flight, named, points_to_draw};
pub(crate) use limit::limit;
pub(crate) use map::map;
pub(crate) use people::{MOST_PEOPLE, people};
pub(crate) use running::running;
