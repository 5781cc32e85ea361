//! The tests of the verification suite as its users meet it. They are one program, because each one more takes seconds to
//! link. Only `process.rs` is apart: it counts the children of its own process.

mod as_given;
mod baseline;
mod cli;
mod judge_alone;
#[cfg(target_os = "linux")]
mod pages;
mod paper_audit;
#[cfg(target_os = "linux")]
mod process_suite;
mod programs;
mod readme;
mod schema;
mod seeded;
mod suite;
mod tables;
mod watch;
