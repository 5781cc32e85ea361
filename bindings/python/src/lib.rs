//! The native module of the Python package `unfair_toss`. It converts arguments and results and computes nothing itself;
//! what users see, with its documentation, are the Python modules beside it.
//!
//! No array of NumPy is read or written through a raw pointer: columns come as contiguous, borrowed arrays, which the
//! Python layer prepares, and a borrow that is refused becomes an exception. Python's lock is released while something
//! is computed.

#![expect(clippy::needless_pass_by_value, reason = "PyO3 extracts the arguments of a function by value")]

mod batch;
mod body;
mod errors;
mod estimate;
mod given;
mod launches;
mod planner;
mod plans;
mod single;
mod solver;
mod space;
mod studies;
mod tally;
mod threads;
mod toss;

/// The Rust side of the package `unfair_toss`.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "a name of Python")]
    const __version__: &str = env!("CARGO_PKG_VERSION");

    #[pymodule_export]
    use crate::{
        batch::Batch,
        body::{Body, bodies},
        estimate::{estimate_by_accuracy, estimate_by_solver},
        given::{array_of_numbers, count, in_si, number, unit_of},
        planner::plan,
        plans::Plan,
        single::{intervals, inverse, land, margins, power, rate_of_precession, same_side_bias, solve, trace},
        solver::{Solver, solvers},
        space::{Space, spaces},
        studies::{compare, convergence, limit, map_of, models, prove, sample, sampling_errors, sensitivity, spread},
        tally::{Tally, tally},
        toss::Toss,
    };
}
