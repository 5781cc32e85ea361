//! This module measures the table from which the planner expects errors and costs, and then tests the planner on random
//! scenes. The planner cannot derive what a model costs or how accurate it is, so both must be measured, and its
//! choices be compared with all others.
//!
//! A scene is a question (outcome, cos θ, attitude, trace or probability) with an accuracy; a model is a way to answer
//! it. A model serves a scene if it is accurate enough for it.

pub mod clock;
pub mod delivered;
mod figures;
pub mod fit;
mod fit_bodies;
mod fit_closed;
mod fit_integrators;
mod fit_sampling;
pub mod scenes;
pub mod summary;
pub mod trial;

pub use trial::Trial;
