//! DOP853 of the crate `ivp`.

use ivp::prelude::{FirstOrderSystem, Ivp, Method};
use toss::{FreeRotation, Scheme, SolverEntry, StepControl};

/// The crate's entry.
pub fn entry() -> SolverEntry {
    let scheme = Scheme::new("dop853", Some(8)).adaptive();
    SolverEntry::from_stepper("ivp", "the crate ivp 0.6", &[scheme], |system, by| {
        let StepControl::Tolerance(tolerance) = by.control() else { return Err("it takes a tolerance".into()) };
        let solution = Ivp::first_order(&Rotation(system), 0.0, system.duration(), &system.start())
            .method(Method::DOP853)
            .rtol(tolerance)
            .atol(tolerance)
            .max_steps(1_000_000)
            .solve()?;
        if !solution.status.is_success() {
            return Err(format!("{:?}", solution.status).into());
        }
        let end = solution.y.last().and_then(|end| end.as_slice().try_into().ok()).ok_or("no last state")?;
        Ok((end, system.work(solution.naccpt as u64, solution.nrejct as u64)))
    })
    .with_color([86, 180, 233])
}

struct Rotation<'a>(&'a FreeRotation);

impl FirstOrderSystem for Rotation<'_> {
    fn derivative(&self, _time: f64, y: &[f64], slope: &mut [f64]) {
        let y = y.try_into().unwrap_or(&[f64::NAN; 7]);
        slope.copy_from_slice(&self.0.derivative(y));
    }
}
