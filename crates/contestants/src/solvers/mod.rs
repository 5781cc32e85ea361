//! The contestants, one file for each.

pub mod differential_equations;
pub mod diffsol;
pub mod ivp;
pub mod rapier;
pub mod rkmk4;
pub mod scipy;
