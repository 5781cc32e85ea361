//! One file a command.

pub(crate) mod list;
pub(crate) mod probability;
pub(crate) mod toss;
pub(crate) mod trace;
