//! Tests relations that follow from the motion itself, such as symmetries and conservation laws, with every solver of
//! the registry. A relation needs no reference value, so it can be tested on random tosses.
//!
//! BF is the body frame, whose z axis is the coin's normal n; θ is the angle between n and the vertical.

use blackbox::{attitude_error, config, lasting, name, phase, solvers, tilt_error, toss, tosses};
use dynamics::Singularity;
use dynamics::body_rate::{angular_momentum, angular_momentum_tf, kinetic_energy};
use proptest::prelude::*;
use toss::{
    Attitude, Body, Coin, ExactMotion, ExactSolver, Launch, Outcome, Registry, RigidToss, Scheme, Settings, SolveError,
    Solver, State, Stepping, TimeOfFlight, Toss, Vector3,
};

/// The state at landing, or `None` where the γ-ODE refuses a toss because the precession is too slow. Any other error
/// fails the test.
fn landing(solver: &dyn Solver, toss: &Toss) -> Option<State> {
    match solver.propagate(toss) {
        Ok(propagation) => Some(propagation.state),
        Err(SolveError::Singular { point: Singularity::PrecessionTooSlow, .. })
            if solver.name() == "gamma"
                && ExactMotion::new(toss).precession_rate() < 0.01 * toss.launch.rate().amax() =>
        {
            None
        }
        Err(error) => panic!("{} on {toss:?}: {error}", name(solver)),
    }
}

/// The toss that starts from `state` and lasts `time` (s).
fn resume(toss: &Toss, state: &State, time: f64) -> Toss {
    Toss { launch: Launch::from_state(state, TimeOfFlight::Given(time)).expect("a landing is a launch"), ..*toss }
}

/// Asserts for every solver that `change` of the toss turns its cos θ into `expected` of it.
fn check_tilt(toss: &Toss, change: impl Fn(&Toss) -> Toss, expected: impl Fn(f64) -> f64) {
    let changed = change(toss);
    for solver in solvers() {
        let (Some(before), Some(after)) = (landing(solver.as_ref(), toss), landing(solver.as_ref(), &changed)) else {
            continue;
        };
        let difference = (after.attitude.cos_tilt() - expected(before.attitude.cos_tilt())).abs();
        let allowed = tilt_error(solver.as_ref(), toss) + tilt_error(solver.as_ref(), &changed);
        assert!(difference <= allowed, "{}: {difference:e} > {allowed:e}", name(solver.as_ref()));
    }
}

fn with_rate(toss: &Toss, rate: Vector3<f64>) -> Toss {
    let launch = Launch::new(rate, toss.launch.time_of_flight()).expect("finite");
    Toss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss }
}

fn with_attitude(toss: &Toss, attitude: Attitude) -> Toss {
    Toss { launch: toss.launch.with_attitude(attitude), ..*toss }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn every_solver_lands_where_the_exact_motion_does(toss in tosses()) {
        let exact = ExactSolver.propagate(&toss).unwrap().state;
        for solver in solvers() {
            let Some(state) = landing(solver.as_ref(), &toss) else { continue };
            let difference = state.attitude.angle_to(&exact.attitude);
            let allowed = attitude_error(solver.as_ref(), &toss);
            prop_assert!(difference <= allowed, "{}: {difference:e}", name(solver.as_ref()));
            let tilt = (solver.cos_tilt(&toss).unwrap() - exact.attitude.cos_tilt()).abs();
            prop_assert!(tilt <= tilt_error(solver.as_ref(), &toss), "{}: {tilt:e}", name(solver.as_ref()));
        }
    }

    #[test]
    fn scaling_rate_and_time_by_powers_of_two_changes_no_bit(toss in tosses(), exponent in -40..40) {
        let c = 2f64.powi(exponent);
        let faster = lasting(&with_rate(&toss, toss.launch.rate() * c), toss.launch.flight_time() / c);
        for solver in solvers() {
            let (Some(slow), Some(fast)) = (landing(solver.as_ref(), &toss), landing(solver.as_ref(), &faster)) else {
                continue;
            };
            prop_assert_eq!(slow.attitude, fast.attitude, "{}", name(solver.as_ref()));
            prop_assert_eq!(slow.rate * c, fast.rate, "{}", name(solver.as_ref()));
        }
    }

    #[test]
    fn scaling_both_moments_of_inertia_changes_nothing(toss in tosses(), exponent in -40..40) {
        let moments = |s: f64| Coin::from_moments(toss.coin.i1() * s, toss.coin.i3() * s).unwrap();
        let scaled = |s: f64| Toss { coin: moments(s), ..toss };
        for solver in solvers() {
            let Some(before) = landing(solver.as_ref(), &toss) else { continue };
            prop_assert_eq!(landing(solver.as_ref(), &scaled(2f64.powi(exponent))), Some(before));
        }
        for s in [1e-12, 1e12] {
            check_tilt(&toss, |_| scaled(s), |cos_tilt| cos_tilt);
        }
    }

    #[test]
    fn a_flight_in_two_legs_lands_like_the_whole_flight(toss in tosses(), part in 0.0..1.0) {
        let time = toss.launch.flight_time();
        for solver in solvers() {
            let solver = solver.as_ref();
            let Some(middle) = landing(solver, &lasting(&toss, part * time)) else { continue };
            let (Some(end), Some(whole)) =
                (landing(solver, &resume(&toss, &middle, time - part * time)), landing(solver, &toss))
            else {
                continue;
            };
            let difference = end.attitude.angle_to(&whole.attitude);
            prop_assert!(difference <= 2.0 * attitude_error(solver, &toss), "{}: {difference:e}", name(solver));
        }
    }

    #[test]
    fn a_flight_with_reversed_rate_returns_to_the_launch(toss in tosses()) {
        for solver in solvers() {
            let solver = solver.as_ref();
            let Some(there) = landing(solver, &toss) else { continue };
            let reversed = State { rate: -there.rate, ..there };
            let Some(back) = landing(solver, &resume(&toss, &reversed, toss.launch.flight_time())) else { continue };
            let difference = back.attitude.angle_to(&toss.launch.attitude());
            prop_assert!(difference <= 2.0 * attitude_error(solver, &toss), "{}: {difference:e}", name(solver));
            let rates = (back.rate + toss.launch.rate()).norm();
            let allowed = 2.0 * attitude_error(solver, &toss) * (1.0 + toss.launch.rate().norm());
            prop_assert!(rates <= allowed, "{}: {rates:e}", name(solver));
        }
    }

    #[test]
    fn turning_a_launch_about_the_vertical_or_about_its_normal_keeps_the_tilt(toss in tosses(), angle in -6.0..6.0) {
        check_tilt(&toss, |t| with_attitude(t, Attitude::about_z(angle) * t.launch.attitude()), |cos_tilt| cos_tilt);
        // Turning the axes of BF by -angle about n turns (ωx, ωy) by angle and changes the attitude by the same turn.
        let spun = |t: &Toss| {
            let rate = Attitude::about_z(angle).body_to_lab(&t.launch.rate());
            with_attitude(&with_rate(t, rate), t.launch.attitude() * Attitude::about_z(-angle))
        };
        check_tilt(&toss, spun, |cos_tilt| cos_tilt);
    }

    #[test]
    fn turning_a_launch_turns_its_landing_by_the_same_rotation(toss in tosses(), q in prop::array::uniform4(0.1..1.0)) {
        let turn = Attitude::from_components(q).unwrap();
        let turned = with_attitude(&toss, turn * toss.launch.attitude());
        for solver in solvers() {
            let (Some(before), Some(after)) =
                (landing(solver.as_ref(), &toss), landing(solver.as_ref(), &turned))
            else {
                continue;
            };
            // Solvers compute the flight relative to its launch, which is the same; only the last product rounds
            // differently.
            let difference = after.attitude.angle_to(&(turn * before.attitude));
            prop_assert!(difference <= 4e-15, "{}: {difference:e}", name(solver.as_ref()));
        }
    }

    #[test]
    fn mirroring_the_rate_of_a_horizontal_launch_keeps_the_tilt(toss in tosses()) {
        let toss = with_attitude(&toss, Attitude::IDENTITY);
        for mirror in [Vector3::new(1.0, 1.0, -1.0), Vector3::new(-1.0, 1.0, 1.0)] {
            check_tilt(&toss, |t| with_rate(t, t.launch.rate().component_mul(&mirror)), |cos_tilt| cos_tilt);
        }
    }

    #[test]
    fn launching_the_other_face_up_changes_the_sign_of_cos_tilt(toss in tosses()) {
        // The same motion with BF turned by π about its x axis, so that n becomes -n.
        let other_face = |t: &Toss| {
            let rate = t.launch.rate().component_mul(&Vector3::new(1.0, -1.0, -1.0));
            let half_turn = Attitude::from_components([0.0, 1.0, 0.0, 0.0]).unwrap();
            with_attitude(&with_rate(t, rate), t.launch.attitude() * half_turn)
        };
        check_tilt(&toss, other_face, |cos_tilt| -cos_tilt);
    }

    #[test]
    fn the_tilt_repeats_after_one_turn_of_the_precession(toss in tosses()) {
        let rate = ExactMotion::new(&toss).precession_rate();
        if rate < 0.5 {
            return Ok(());
        }
        let later = |t: &Toss| lasting(t, t.launch.flight_time() + std::f64::consts::TAU / rate);
        check_tilt(&toss, later, |cos_tilt| cos_tilt);
    }

    #[test]
    fn the_sign_of_the_quaternion_does_not_change_the_outcome(toss in tosses()) {
        let [w, x, y, z] = toss.launch.attitude().components();
        let negative = Attitude::from_components([-w, -x, -y, -z]).unwrap();
        for solver in solvers() {
            let changed = with_attitude(&toss, negative);
            if landing(solver.as_ref(), &toss).is_some() {
                prop_assert_eq!(solver.outcome(&changed), solver.outcome(&toss), "{}", name(solver.as_ref()));
            }
        }
    }

    #[test]
    fn a_sphere_turns_about_a_fixed_axis(toss in tosses()) {
        let sphere = Toss { coin: Coin::from_moments(1.0, 1.0).unwrap(), ..toss };
        let angle = toss.launch.rate() * toss.launch.flight_time();
        let half = 0.5 * angle.norm();
        let axis = if half > 0.0 { angle.normalize() * half.sin() } else { angle };
        let turn = Attitude::from_components([half.cos(), axis.x, axis.y, axis.z]).unwrap();
        for solver in solvers() {
            let Some(state) = landing(solver.as_ref(), &sphere) else { continue };
            let difference = state.attitude.angle_to(&(toss.launch.attitude() * turn));
            let allowed = attitude_error(solver.as_ref(), &sphere);
            prop_assert!(difference <= allowed, "{}: {difference:e}", name(solver.as_ref()));
        }
    }

    #[test]
    fn momentum_energy_and_spin_are_conserved(toss in tosses()) {
        if toss.launch.rate().norm() == 0.0 {
            return Ok(());
        }
        let launch = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
        for solver in solvers() {
            let solver = solver.as_ref();
            let Some(end) = landing(solver, &toss) else { continue };
            let allowed = attitude_error(solver, &toss);
            let (before, after) = (angular_momentum_tf(&toss.coin, &launch), angular_momentum_tf(&toss.coin, &end));
            let scale = toss.coin.i1() * launch.rate.norm();
            prop_assert!((after - before).norm() <= allowed * scale, "{}: S", name(solver));
            let length = |state: &State| angular_momentum(&toss.coin, &state.rate).norm();
            prop_assert!((length(&end) - length(&launch)).abs() <= allowed * scale, "{}: |S|", name(solver));
            let energy = |state: &State| kinetic_energy(&toss.coin, &state.rate);
            let energy_scale = scale * launch.rate.norm();
            prop_assert!((energy(&end) - energy(&launch)).abs() <= allowed * energy_scale, "{}: energy", name(solver));
            prop_assert_eq!(end.rate.z, launch.rate.z);
            let transverse = |state: &State| state.rate.x.hypot(state.rate.y);
            let drift = (transverse(&end) - transverse(&launch)).abs();
            prop_assert!(drift <= allowed * launch.rate.norm(), "{}", name(solver));
        }
    }
}

#[test]
fn a_flat_disc_with_a_small_tilt_wobbles_twice_as_fast_as_it_spins() {
    let (spin, small) = (10.0, 1e-3);
    let tilt_at = |solver: &dyn Solver, turns_of_spin: f64| {
        let time = turns_of_spin * std::f64::consts::TAU / spin;
        let state = landing(solver, &toss(2.0, [small, 0.0, spin], 0.0, time)).unwrap();
        state.attitude.normal().xy().norm()
    };
    for solver in solvers() {
        // There are two wobbles in one turn of the spin: the tilt is largest after a quarter of a turn and 0 after
        // half.
        let (quarter, half) = (tilt_at(solver.as_ref(), 0.25), tilt_at(solver.as_ref(), 0.5));
        assert!((quarter - small / spin).abs() < 1e-8, "{}: {quarter:e}", name(solver.as_ref()));
        assert!(half < 1e-8, "{}: {half:e}", name(solver.as_ref()));
    }
}

#[test]
fn errors_of_long_flights_stay_within_the_error_estimates() {
    let toss = toss(1.98, [31.0, -17.0, 42.0], 0.6, 60.0);
    assert!(phase(&toss) > 4000.0);
    let exact = ExactSolver.cos_tilt(&toss).unwrap();
    for solver in solvers() {
        let difference = (solver.cos_tilt(&toss).unwrap() - exact).abs();
        assert!(difference <= tilt_error(solver.as_ref(), &toss), "{}: {difference:e}", name(solver.as_ref()));
    }
}

/// A flight at the finest tolerances: solver, scheme, tolerance, moments, rate, tilt and time.
type Finest = (&'static str, Scheme, f64, [f64; 3], [f64; 3], f64, f64);

/// Here all errors are rounding. They are 2 to 40 times 100 × tolerance × (1 + φ); the first one lands on the other side.
#[rustfmt::skip]
const FINEST: [Finest; 9] = [
    ("quaternion", Scheme::DOP853, 2.3e-16, [1.0, 1.0, 0.47739035379568384],
     [-1.604681673871023, 0.6965716794093663, -1.6726716102919714], 0.0, 49458.071955706895),
    ("euler", Scheme::DOP853, 2.3e-16, [1.0, 1.0, 0.0006941365125386398],
     [-430.343150937898, -63.589061004923224, -413.79002706964354], 0.0, 55.226659404904154),
    ("gamma", Scheme::DOP853, 2.3e-16, [1.0, 1.0, 0.0],
     [-0.04669190319022872, -0.043818368448402104, -0.04958564623187387], 0.2144588579836225, 37215.90025925859),
    ("quaternion", Scheme::DOP853, 2.3e-16, [1.0, 1.0, 0.9999999999999704],
     [-0.004570113280230255, 0.0017673587279699865, 0.00037587129295562325], 2.4811002347109974, 387579.8038843713),
    ("quaternion", Scheme::DOP853, 2.3e-16, [1.0, 1.0, 2.0],
     [-0.4199945712938581, -0.0021188527995391593, 1.6273870764005736e-13], 0.0, 7431.597008930459),
    ("quaternion", Scheme::DOPRI5, 2.3e-16, [1.0, 1.0, 0.9999999999995688],
     [103.28660472304846, 212.74373721768686, -85.5228565231568], 1.0128156187957753, 0.4411518112228724),
    ("quaternion", Scheme::DOPRI5, 2.3e-16, [1.0, 1.0, 2.0],
     [-0.014758305912062852, 8.192465541340255e-6, -2.2244551921647235e-13], 0.0, 5178.747742360275),
    ("quaternion", Scheme::DOP853, 2.2092530539638186e-15, [1.0000000000000204, 0.9999999999999966, 1.0],
     [0.0007738112311568948, 0.0001983705734279974, -0.0002762707903234956], 2.7810829015849916, 40866777.6014738),
    ("quaternion", Scheme::TAYLOR, 2.3e-16, [0.7, 0.700000000008753, 0.13332628129099616],
     [-6.297305021940055, -1.7268460566056947, -6.329040667855497], 0.0, 26224.527859621005),
];

#[test]
fn error_estimates_at_the_finest_tolerances_know_rounding() {
    for (solver, scheme, tolerance, moments, rate, tilt, time) in FINEST {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap().with_tilt(tilt).unwrap();
        let toss = RigidToss { body: Body::from_moments(moments).unwrap(), launch };
        let settings = Settings { stepping: Stepping::adaptive(scheme, tolerance).unwrap(), ..Settings::default() };
        let by = Registry::standard().named(solver).unwrap().solver(&settings).unwrap();
        let cos_tilt = by.cos_tilt_rigid(&toss).unwrap();
        let error = (cos_tilt - ExactSolver.cos_tilt_rigid(&toss).unwrap()).abs();
        let estimate = by.error_estimate_rigid(&toss).unwrap().unwrap();
        assert!(error <= 0.1 * estimate, "{solver}/{scheme}: {error:e}, {estimate:e}");
        // An estimate that says nothing would hold, too.
        assert!(estimate < 1e-3, "{solver}/{scheme}: {estimate:e}");
        let (said, truth) = (by.outcome_at_rigid(&toss, cos_tilt).unwrap(), ExactSolver.outcome_rigid(&toss).unwrap());
        assert!(said == truth || said == Outcome::Undecided, "{solver}/{scheme}: {said:?}, not {truth:?}");
    }
}
