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
mod tally;
mod threads;
mod toss;

use pyo3::prelude::*;

/// The Rust side of the package `unfair_toss`.
#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<body::Body>()?;
    module.add_class::<toss::Toss>()?;
    module.add_class::<solver::Solver>()?;
    module.add_class::<batch::Batch>()?;
    module.add_class::<space::Space>()?;
    module.add_class::<plans::Plan>()?;
    module.add_class::<tally::Tally>()?;
    module.add_function(wrap_pyfunction!(given::array_of_numbers, module)?)?;
    module.add_function(wrap_pyfunction!(given::whole_number, module)?)?;
    module.add_function(wrap_pyfunction!(body::bodies, module)?)?;
    module.add_function(wrap_pyfunction!(solver::solvers, module)?)?;
    module.add_function(wrap_pyfunction!(space::spaces, module)?)?;
    module.add_function(wrap_pyfunction!(single::land, module)?)?;
    module.add_function(wrap_pyfunction!(single::margins, module)?)?;
    module.add_function(wrap_pyfunction!(single::intervals, module)?)?;
    module.add_function(wrap_pyfunction!(single::trace, module)?)?;
    module.add_function(wrap_pyfunction!(single::solve, module)?)?;
    module.add_function(wrap_pyfunction!(single::inverse, module)?)?;
    module.add_function(wrap_pyfunction!(single::wobble, module)?)?;
    module.add_function(wrap_pyfunction!(planner::plan, module)?)?;
    module.add_function(wrap_pyfunction!(tally::tally, module)?)?;
    module.add_function(wrap_pyfunction!(estimate::estimate_by_solver, module)?)?;
    module.add_function(wrap_pyfunction!(estimate::estimate_by_accuracy, module)?)?;
    Ok(())
}
