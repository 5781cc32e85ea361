//! This module tests the planner on random scenes.
//!
//! A scene is a question (outcome, cos θ, attitude, trace or probability) with an accuracy; a model is a way to answer
//! it. A model serves a scene if it is accurate enough for it.

pub mod delivered;
pub mod scenes;
pub mod summary;
pub mod trial;

pub use trial::Trial;
