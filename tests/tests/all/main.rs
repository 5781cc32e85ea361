//! The tests across crates, as one program. Only `allocations.rs` is apart: it measures the allocator of its process.

mod adapters;
mod bad_input;
mod foreign;
mod models;
mod packages;
mod paper;
mod relations;
mod replays;
