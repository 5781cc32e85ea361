//! Gives extreme input to every solver. The answer has to be right, or a typed error; it must never be a panic or a NaN.

use blackbox::{integrators, name, solvers, toss};
use toss::{
    CoinMotion, ExactSolver, Formulation, Outcome, Registry, Scheme, Settings, SolveError, Solver, Stepping, Tilt,
};

#[test]
fn a_coin_that_has_not_turned_lands_heads_by_every_solver() {
    for (rate, time) in [([1.0, 2.0, 3.0], 0.0), ([0.0; 3], 1.0), ([0.0; 3], 1e308), ([-0.0; 3], 0.0)] {
        for k in [0.0, 0.5, 1.0, 2.0] {
            for solver in solvers() {
                let outcome = solver.tilt(&toss(k, rate, 0.0, time)).map(Tilt::outcome);
                assert_eq!(outcome, Ok(Outcome::Heads), "{} at {rate:?}, {time}", name(solver.as_ref()));
            }
        }
    }
}

#[test]
fn errors_of_the_vertical_frame_name_the_singular_point_and_the_time() {
    let build = |solver: &str| {
        let settings = Settings { stepping: Stepping::DEFAULT, formulation: Formulation::VERTICAL };
        Registry::standard().named(solver).unwrap().solver(&settings).unwrap()
    };
    // F1 of the atlas of failures: launched from horizontal, the normal n is vertical again at 2π/ωL.
    let returning = toss(0.5, [9.0, 4.0, 3.0], 0.0, 1.0);
    let first_return = std::f64::consts::TAU / CoinMotion::new(&returning.coin().unwrap()).precession_rate();
    match build("gamma").land(&returning) {
        Err(SolveError::Singular { time, .. } | SolveError::StepSizeUnderflow { time }) => {
            assert!((time - first_return).abs() < 1e-3 * first_return, "{time}, not {first_return}");
        }
        other => panic!("{other:?}"),
    }
    // F2: a tilted launch whose cone does not enclose the vertical, so that α' (the rate of precession) changes its
    // sign.
    let message = build("gamma").land(&toss(0.5, [0.3, 0.3, 5.0], 1.0, 5.0)).unwrap_err().to_string();
    assert!(message.contains("α' = 0") && message.contains("at t = "), "{message}");
    // F4: Keller's coin (no spin) has no precession in this frame.
    let keller = build("gamma").land(&toss(1.98, [9.0, 0.0, 0.0], 0.0, 1.0));
    assert!(matches!(keller, Err(SolveError::Singular { time: 0.0, .. })), "{keller:?}");
}

#[test]
fn huge_and_subnormal_rates_are_solved_and_huge_phases_refused() {
    let paper = ExactSolver.tilt(&toss(0.5, [1.0, 1.0, 2.5], 0.0, 1.0)).unwrap().cos_tilt;
    for solver in solvers() {
        let solver = solver.as_ref();
        let fast = solver.tilt(&toss(0.5, [1e300, 1e300, 2.5e300], 0.0, 1e-300)).unwrap().cos_tilt;
        assert!((fast - paper).abs() < 1e-8, "{}: {fast}", name(solver));
        let slow = solver.tilt(&toss(0.5, [5e-324, 0.0, 1e-310], 0.0, 1e3)).unwrap().cos_tilt;
        assert!((slow - 1.0).abs() < 1e-15, "{}: {slow}", name(solver));
        for (rate, time) in [([1e300, 1e300, 1e300], 1.0), ([f64::MAX; 3], 1.0), ([1.0, 1.0, 1e10], 1e10)] {
            let refused = solver.tilt(&toss(0.5, rate, 0.0, time));
            assert!(matches!(refused, Err(SolveError::PhaseTooLarge { .. })), "{}: {refused:?}", name(solver));
            assert!(refused.unwrap_err().to_string().starts_with("outcome not determined"));
        }
    }
}

#[test]
fn reaching_the_step_limit_is_an_error() {
    let long = toss(1.98, [50.0, 0.0, 50.0], 0.0, 1e4);
    let stepping = Stepping::fixed(Scheme::RK4, 1e-3).unwrap();
    for entry in integrators() {
        let solver = entry.solver(&Settings { stepping, ..Settings::default() }).unwrap();
        assert!(matches!(solver.land(&long), Err(SolveError::StepLimit { .. })), "{}", entry.name());
    }
}
