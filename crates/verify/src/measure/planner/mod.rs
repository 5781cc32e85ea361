//! Planner accuracy and cost: the table that the planner reads, measured; and random scenes, solved as planned and by every
//! other model.

pub mod clock;
pub mod delivered;
mod figures;
pub mod fit;
mod fit_integrators;
mod fit_sampling;
pub mod scenes;
pub mod summary;
pub mod trial;

pub use trial::Trial;
