//! DOP853 of the crate `differential-equations`.

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};
use toss::{FreeRotation, Scheme, SolverEntry, StepControl};

/// The crate's entry.
pub fn entry() -> SolverEntry {
    let scheme = Scheme::new("dop853", Some(8)).adaptive();
    SolverEntry::from_stepper("diffeq", "the crate differential-equations 0.7", &[scheme], |system, by| {
        let StepControl::Tolerance(tolerance) = by.control() else { return Err("it takes a tolerance".into()) };
        let method = ExplicitRungeKutta::dop853().rtol(tolerance).atol(tolerance).max_steps(1_000_000);
        let solution = IVP::ode(&Rotation(system), 0.0, system.duration(), system.start()).method(method).solve();
        let solution = solution.map_err(|error| format!("{error:?}"))?;
        let end = *solution.y.last().ok_or("no last state")?;
        Ok((end, system.work(solution.steps.accepted as u64, solution.steps.rejected as u64)))
    })
    .with_color([230, 159, 0])
}

struct Rotation<'a>(&'a FreeRotation);

impl ODE<f64, [f64; 7]> for Rotation<'_> {
    fn diff(&self, _time: f64, y: &[f64; 7], slope: &mut [f64; 7]) {
        *slope = self.0.derivative(y);
    }
}
