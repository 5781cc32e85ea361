//! This library is what the page in this folder computes with. It runs as WebAssembly in the browser and answers
//! questions that are asked in JSON, by the crates [`toss`] and [`sampling`]: nothing of the mechanics is written a
//! second time in JavaScript.
//!
//! ```text
//! scene (texts with units) ─► Thrown ─┬─► toss: outcome, proof, margins
//!                                     ├─► fly: a trace, then one frame at a time
//!                                     ├─► aim: the launch whose S points elsewhere
//!                                     ├─► map, line: outcomes or P(heads) over two inputs
//!                                     ├─► hand: P(heads) for a spread, or where inputs are not known exactly
//!                                     └─► compare, growth, repeat: integrators beside the exact motion
//! ```
//!
//! [`Page::ask`] takes a question and gives its answer, or `{"error":{"kind","message","field"?}}` in the
//! words of the library. What is needed at every frame of an animation, and the cells of a map, are read from memory
//! instead ([`Page::frame`], [`Page::numbers`], [`Page::cells`]). `border` exports all of it to JavaScript.
//!
//! All numbers are in SI units and radians; BF is the body frame, LF the laboratory frame with z up.

mod aim;
mod ask;
mod border;
mod failure;
mod flight;
mod hand;
mod integrators;
mod known;
mod line;
mod map;
mod outcome;
mod page;
mod people;
mod thrown;

pub use page::Page;
