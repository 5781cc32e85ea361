//! Whether the planner keeps its word: its table, measured; and random scenes, solved as planned and by every other rung.

pub mod clock;
pub mod delivered;
mod figures;
pub mod fit;
mod fit_integrators;
mod fit_sampling;
pub mod scenes;
pub mod thrift;
pub mod trial;

pub use trial::Trial;
