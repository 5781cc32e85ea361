//! The commands of `unfair-toss`, with one file for each. A command parses its options, calls the libraries and formats
//! their answer.

pub(crate) mod compare;
pub(crate) mod convergence;
pub(crate) mod errors;
pub(crate) mod intervals;
pub(crate) mod inverse;
pub(crate) mod limit;
pub(crate) mod list;
pub(crate) mod map;
pub(crate) mod parts;
pub(crate) mod plan;
pub(crate) mod power;
pub(crate) mod probability;
pub(crate) mod sample;
pub(crate) mod shell;
pub(crate) mod spread;
pub(crate) mod toss;
pub(crate) mod trace;
