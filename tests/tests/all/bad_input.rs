//! Gives invalid and extreme input to the library. The answer has to be right, or a typed error that names the field;
//! it must never be a panic or a NaN.

use blackbox::{entries, integrators, name, solvers, tilt_error, toss};
use toss::{
    Attitude, Coin, CoinMotion, ExactSolver, Formulation, InputError, Launch, Outcome, Registry, Scheme, Settings,
    SolveError, Solver, Stepping, TAYLOR, Tilt, TimeOfFlight,
};

const NOT_FINITE: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

fn launch(rate: [f64; 3], time_of_flight: TimeOfFlight) -> Result<Launch, InputError> {
    Launch::new(rate, time_of_flight)
}

#[test]
fn input_that_is_not_finite_is_refused_with_the_name_of_the_field() {
    let thrown = |speed, gravity| TimeOfFlight::Ballistic { speed, gravity };
    for bad in NOT_FINITE {
        for (result, expected) in [
            (Coin::from_cylinder(bad, 0.01, 0.001).err(), "mass"),
            (Coin::from_cylinder(0.005, bad, 0.001).err(), "radius"),
            (Coin::from_cylinder(0.005, 0.01, bad).err(), "thickness"),
            (Coin::from_moments(bad, 1e-7).err(), "I1"),
            (Coin::from_moments(1e-7, bad).err(), "I3"),
            (launch([bad, 0.0, 0.0], TimeOfFlight::Given(1.0)).err(), "rate x"),
            (launch([0.0, bad, 0.0], TimeOfFlight::Given(1.0)).err(), "rate y"),
            (launch([0.0, 0.0, bad], TimeOfFlight::Given(1.0)).err(), "rate z"),
            (launch([1.0; 3], TimeOfFlight::Given(bad)).err(), "time"),
            (launch([1.0; 3], thrown(bad, 9.81)).err(), "speed"),
            (launch([1.0; 3], thrown(3.0, bad)).err(), "gravity"),
            (launch([1.0; 3], TimeOfFlight::BallisticTo { speed: 3.0, gravity: 9.81, drop: bad }).err(), "drop"),
            (toss(0.5, [1.0; 3], 0.0, 1.0).launch.with_tilt(bad).err(), "tilt"),
            (Attitude::from_components([bad, 0.0, 0.0, 1.0]).err(), "attitude"),
            (Stepping::adaptive(Scheme::DOP853, bad).err(), "tolerance"),
            (Stepping::fixed(Scheme::RK4, bad).err(), "step"),
        ] {
            let error = result.unwrap_or_else(|| panic!("{expected} = {bad} was accepted"));
            let found = error.field();
            assert!(found.starts_with(expected), "{found} for {expected} = {bad}");
        }
    }
}

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

/// Every solver with every adaptive scheme in both guarded formulations, `momentum` and `vertical` (the paper's frame).
/// The formulation `raw` is left out, because it may be wrong without an error.
fn every_guarded_formulation() -> Vec<Box<dyn Solver>> {
    let guarded = [Formulation::MOMENTUM, Formulation::VERTICAL];
    let mut all = Vec::new();
    for entry in entries() {
        let schemes = if entry.integrates() { entry.schemes() } else { &[Scheme::DOP853] };
        for scheme in schemes.iter().filter(|scheme| scheme.is_adaptive()) {
            let stepping = Stepping::adaptive(*scheme, 1e-10).expect("valid");
            all.extend(guarded.map(|formulation| entry.solver(&Settings { stepping, formulation }).expect("offered")));
        }
    }
    all
}

#[test]
fn every_guarded_formulation_is_right_or_a_typed_error_at_special_rates_and_tilts() {
    let rates =
        [[0.0, 9.0, 0.0], [4.0, -3.0, 0.0], [0.0, 0.0, 20.0], [0.0, 0.0, -7.0], [3.0, 1.0, 5.0], [0.3, 0.3, 5.0]];
    let tilts = [0.0, 1e-300, 1e-16, 1e-9, 1e-4, 1.0, std::f64::consts::FRAC_PI_2, std::f64::consts::PI];
    for rate in rates {
        for tilt in tilts {
            for k in [0.0, 0.5, 1.0, 1.98, 2.0] {
                let toss = toss(k, rate, tilt, 0.9);
                let exact = ExactSolver.tilt(&toss).unwrap().cos_tilt;
                for solver in every_guarded_formulation() {
                    if let Ok(found) = solver.tilt(&toss) {
                        let error = (found.cos_tilt - exact).abs();
                        let allowed = tilt_error(solver.as_ref(), &toss);
                        assert!(error <= allowed, "{}: {error:e} on {toss:?}", name(solver.as_ref()));
                    } else {
                        assert!(solver.name() != "quaternion" && solver.name() != "exact", "{toss:?}");
                    }
                }
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
fn rk4_returns_finite_states_or_errors() {
    for entry in entries() {
        for formulation in Formulation::ALL {
            for step in [1e-4, 1e-3, 1e-2, 0.1, 1.0, 1e300] {
                let stepping = Stepping::fixed(Scheme::RK4, step).unwrap();
                let solver = entry.solver(&Settings { stepping, formulation }).unwrap();
                for tilt in [0.0, 1e-16, 1e-4, 1.0] {
                    if let Ok(landing) = solver.land(&toss(0.5, [50.0, -20.0, 30.0], tilt, 1.0)) {
                        let state = landing.state;
                        assert!(state.attitude.components().iter().chain(&state.rate).all(|part| part.is_finite()));
                    }
                }
            }
        }
    }
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
fn an_outcome_at_the_edge_is_never_misjudged() {
    // ψ (the angle between the normal and the angular momentum) is 45° within two ulp, where ωL = √2 k ωz. After half a
    // turn cos θ is 0 to rounding. For ψ ≤ 45° it is positive, because no f64 is a phase of exactly π. For ψ > 45° it
    // is negative over some 1e-8 rad of phase.
    for ulps in -2..=2_i64 {
        let transverse = f64::from_bits(1.0_f64.to_bits().wrapping_add_signed(ulps));
        let half_turn = std::f64::consts::PI / 2f64.sqrt();
        for nudge in -3..=3_i64 {
            let time = f64::from_bits(half_turn.to_bits().wrapping_add_signed(nudge));
            let edge = toss(2.0, [transverse, 0.0, 0.5], 0.0, time);
            let outcome = if ulps <= 0 { Outcome::Heads } else { Outcome::Tails };
            assert_eq!(ExactSolver.tilt(&edge).map(Tilt::outcome), Ok(outcome), "{ulps}, {nudge}");
            for solver in solvers().iter().filter(|solver| solver.stepping().is_some()) {
                assert_eq!(solver.tilt(&edge).map(Tilt::outcome), Ok(Outcome::Undecided), "{}", name(solver.as_ref()));
            }
        }
        // After 0.9 times half a turn the outcome is clear.
        let before = toss(2.0, [transverse, 0.0, 0.5], 0.0, 0.9 * half_turn);
        assert_eq!(ExactSolver.tilt(&before).map(Tilt::outcome), Ok(Outcome::Heads));
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

#[test]
fn a_scheme_that_a_solver_does_not_offer_is_refused() {
    let own = Scheme::new("own", Some(3)).adaptive();
    for entry in integrators() {
        for scheme in [Scheme::DOP853, Scheme::DOPRI5, Scheme::RK4, TAYLOR, own] {
            let stepping = Stepping::adaptive(scheme, 1e-9).or_else(|_| Stepping::fixed(scheme, 1e-3)).unwrap();
            let made = entry.solver(&Settings { stepping, ..Settings::default() });
            if entry.schemes().contains(&scheme) {
                assert!(made.is_ok(), "{} by {}", entry.name(), scheme.name());
            } else {
                let refused = made.err().unwrap().to_string();
                let known =
                    format!("scheme of this solver = '{}' is unknown; known: dop853, dopri5, rk4", scheme.name());
                assert!(refused.starts_with(&known), "{refused}");
            }
        }
    }
}
