//! Runs each command as a user does, and checks its answers, exit codes and standard output. The libraries have tests of their
//! own; these show that options reach them and that answers come back unchanged.

mod common;
#[path = "../common/fields.rs"]
mod fields;
#[path = "../common/lines.rs"]
mod lines;

mod charts;
mod flips;
mod grammar;
mod help;
mod json;
mod options;
#[cfg(unix)]
mod outputs;
mod refusals;
mod registry;
mod sample;
mod sampling;
mod shards;
