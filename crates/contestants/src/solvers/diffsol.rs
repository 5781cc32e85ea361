//! Tsitouras's method of order 5(4) of the crate `diffsol`.

use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason, Vector};
use toss::{Scheme, SolverEntry, StepControl};

/// The crate's entry.
pub fn entry() -> SolverEntry {
    let scheme = Scheme::new("tsit45", Some(5)).adaptive();
    SolverEntry::from_stepper("diffsol", "the crate diffsol 0.18", &[scheme], |system, by| {
        let StepControl::Tolerance(tolerance) = by.control() else { return Err("it takes a tolerance".into()) };
        let problem = OdeBuilder::<NalgebraMat<f64>>::new()
            .rtol(tolerance)
            .atol([tolerance])
            .rhs(|y, _, _, slope| slope.copy_from_slice(&system.derivative(y.try_into().unwrap_or(&[f64::NAN; 7]))))
            .init(|_, _, y| y.copy_from_slice(&system.start()), 7)
            .build()?;
        let mut solver = problem.tsit45()?;
        solver.set_stop_time(system.duration())?;
        while solver.step()? != OdeSolverStopReason::TstopReached {}
        let found = solver.get_statistics();
        let work = system.work(found.number_of_steps as u64, found.number_of_error_test_failures as u64);
        let end = solver.state().y.clone_as_vec().try_into().map_err(|_| "the state has 7 components")?;
        Ok((end, work))
    })
    .with_color([204, 121, 167])
}
