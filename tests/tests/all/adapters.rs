//! A stepper from elsewhere: compared with the exact motion, and used through a registry as any solver.

use toss::{
    ExactSolver, FreeRotation, Registry, Scheme, Settings, Solver, SolverEntry, StepControl, Stepping, Toss, Work,
};

use blackbox::toss;

/// One step of the classical method of order 4.
fn rk4_step(system: &FreeRotation, y: &[f64; 7], h: f64) -> [f64; 7] {
    let along = |slope: &[f64; 7], h: f64| std::array::from_fn(|part| y[part] + h * slope[part]);
    let a = system.derivative(y);
    let b = system.derivative(&along(&a, 0.5 * h));
    let c = system.derivative(&along(&b, 0.5 * h));
    let d = system.derivative(&along(&c, h));
    std::array::from_fn(|part| y[part] + h / 6.0 * (a[part] + 2.0 * (b[part] + c[part]) + d[part]))
}

fn rk4(system: &FreeRotation, stepping: &Stepping) -> Result<([f64; 7], Work), toss::solvers::ForeignError> {
    let StepControl::Step(h) = stepping.control() else { return Err("it takes steps of a given length".into()) };
    let steps = (system.duration() / h).round() as u64;
    let end = (0..steps).fold(system.start(), |y, _| rk4_step(system, &y, h));
    Ok((end, system.work(steps, 0)))
}

fn tosses() -> Vec<Toss> {
    [[9.0, -4.0, 3.0], [1e-9, 2e-9, -5e-9], [0.0, 0.0, 7.0], [3e7, 1e7, 2e7]]
        .into_iter()
        .map(|rate: [f64; 3]| toss(0.5, rate, 0.9, 7.0 / rate.iter().fold(0.0_f64, |most, part| most.max(part.abs()))))
        .collect()
}

#[test]
fn a_stepper_from_elsewhere_lands_within_its_error_estimate_at_any_speed() {
    let entry = SolverEntry::from_stepper("mine", "the classical method once more", &[Scheme::RK4], rk4);
    for toss in tosses() {
        let stepping = Stepping::fixed(Scheme::RK4, toss.launch.flight_time() / 700.0).unwrap();
        let settings = Settings { stepping, ..Settings::default() };
        let backend = Registry::standard().with(entry.clone()).unwrap().backend("mine", &settings).unwrap();
        let (found, exact) = (backend.solver().land(&toss).unwrap(), ExactSolver.land(&toss).unwrap());
        let claim = found.error.unwrap();
        assert!(claim < 1e-6 && (found.cos_tilt - exact.cos_tilt).abs() <= claim, "{found:?}, not {exact:?}");
        assert!(found.state.attitude.angle_to(&exact.state.attitude) <= claim);
        assert!((found.state.rate - exact.state.rate).norm() <= claim * exact.state.rate.norm());
        assert_eq!((found.work.rhs_calls, found.work.accepted_steps), (2800, 700));
        assert!(found.norm_error < 1e-9);
    }
}
