//! Relations that hold for the motion itself, so for every solver of the registry.

use blackbox::{attitude_error, config, lasting, name, phase, solvers, tilt_error, toss, tosses};
use dynamics::Singularity;
use dynamics::body_rate::{angular_momentum, angular_momentum_tf, kinetic_energy};
use proptest::prelude::*;
use toss::{Attitude, Coin, ExactMotion, ExactSolver, Launch, SolveError, Solver, State, TimeOfFlight, Toss, Vector3};

/// The landing, or `None` where a solver may refuse: the γ-ODE on rods that spin without precession.
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

fn resume(toss: &Toss, state: &State, time: f64) -> Toss {
    Toss { launch: Launch::from_state(state, TimeOfFlight::Given(time)).expect("a landing is a launch"), ..*toss }
}

/// `change` of the toss leaves cos θ as `expected` makes of it, by every solver.
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
            prop_assert!(difference <= attitude_error(solver.as_ref(), &toss), "{}: {difference:e}", name(solver.as_ref()));
            let tilt = (solver.cos_tilt(&toss).unwrap() - exact.attitude.cos_tilt()).abs();
            prop_assert!(tilt <= tilt_error(solver.as_ref(), &toss), "{}: {tilt:e}", name(solver.as_ref()));
        }
    }

    #[test]
    fn rates_and_times_scaled_by_a_power_of_two_change_no_bit(toss in tosses(), exponent in -40..40) {
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
    fn moments_scaled_together_change_nothing(toss in tosses(), exponent in -40..40) {
        let scaled = |s: f64| Toss { coin: Coin::from_moments(toss.coin.i1() * s, toss.coin.i3() * s).unwrap(), ..toss };
        for solver in solvers() {
            let Some(before) = landing(solver.as_ref(), &toss) else { continue };
            prop_assert_eq!(landing(solver.as_ref(), &scaled(2f64.powi(exponent))), Some(before));
        }
        for s in [1e-12, 1e12] {
            check_tilt(&toss, |_| scaled(s), |cos_tilt| cos_tilt);
        }
    }

    #[test]
    fn two_flights_in_a_row_are_one(toss in tosses(), part in 0.0..1.0) {
        let time = toss.launch.flight_time();
        for solver in solvers() {
            let solver = solver.as_ref();
            let Some(middle) = landing(solver, &lasting(&toss, part * time)) else { continue };
            let (Some(end), Some(whole)) =
                (landing(solver, &resume(&toss, &middle, time - part * time)), landing(solver, &toss)) else { continue };
            let difference = end.attitude.angle_to(&whole.attitude);
            prop_assert!(difference <= 2.0 * attitude_error(solver, &toss), "{}: {difference:e}", name(solver));
        }
    }

    #[test]
    fn a_reversed_flight_comes_back(toss in tosses()) {
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
    fn a_launch_turned_about_the_vertical_or_spun_in_its_face_keeps_its_tilt(toss in tosses(), angle in -6.0..6.0) {
        check_tilt(&toss, |t| with_attitude(t, Attitude::about_z(angle) * t.launch.attitude()), |cos_tilt| cos_tilt);
        // Turning the body's axes by -angle about n turns (ωx, ωy) by angle and the attitude's spin along.
        let spun = |t: &Toss| {
            let rate = Attitude::about_z(angle).body_to_lab(&t.launch.rate());
            with_attitude(&with_rate(t, rate), t.launch.attitude() * Attitude::about_z(-angle))
        };
        check_tilt(&toss, spun, |cos_tilt| cos_tilt);
    }

    #[test]
    fn a_launch_turned_by_r_lands_turned_by_r(toss in tosses(), q in prop::array::uniform4(0.1..1.0)) {
        let turn = Attitude::from_components(q).unwrap();
        let turned = with_attitude(&toss, turn * toss.launch.attitude());
        for solver in solvers() {
            let (Some(before), Some(after)) = (landing(solver.as_ref(), &toss), landing(solver.as_ref(), &turned)) else {
                continue;
            };
            // The flight relative to its launch is the same numbers; only the last products round differently.
            let difference = after.attitude.angle_to(&(turn * before.attitude));
            prop_assert!(difference <= 4e-15, "{}: {difference:e}", name(solver.as_ref()));
        }
    }

    #[test]
    fn mirrored_rates_keep_the_tilt_from_horizontal(toss in tosses()) {
        let toss = with_attitude(&toss, Attitude::IDENTITY);
        for mirror in [Vector3::new(1.0, 1.0, -1.0), Vector3::new(-1.0, 1.0, 1.0)] {
            check_tilt(&toss, |t| with_rate(t, t.launch.rate().component_mul(&mirror)), |cos_tilt| cos_tilt);
        }
    }

    #[test]
    fn the_other_face_lands_the_other_way(toss in tosses()) {
        // The same motion with BF turned by π about its x axis: n → -n.
        let other_face = |t: &Toss| {
            let rate = t.launch.rate().component_mul(&Vector3::new(1.0, -1.0, -1.0));
            let half_turn = Attitude::from_components([0.0, 1.0, 0.0, 0.0]).unwrap();
            with_attitude(&with_rate(t, rate), t.launch.attitude() * half_turn)
        };
        check_tilt(&toss, other_face, |cos_tilt| -cos_tilt);
    }

    #[test]
    fn the_tilt_repeats_with_the_precession(toss in tosses()) {
        let rate = ExactMotion::new(&toss).precession_rate();
        if rate < 0.5 {
            return Ok(());
        }
        let later = |t: &Toss| lasting(t, t.launch.flight_time() + std::f64::consts::TAU / rate);
        check_tilt(&toss, later, |cos_tilt| cos_tilt);
    }

    #[test]
    fn the_sign_of_the_quaternion_means_nothing(toss in tosses()) {
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
            prop_assert!(difference <= attitude_error(solver.as_ref(), &sphere), "{}: {difference:e}", name(solver.as_ref()));
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
            prop_assert!((transverse(&end) - transverse(&launch)).abs() <= allowed * launch.rate.norm(), "{}", name(solver));
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
        // Two wobbles in one turn of the spin: back at no tilt after half a turn, farthest after a quarter.
        let (quarter, half) = (tilt_at(solver.as_ref(), 0.25), tilt_at(solver.as_ref(), 0.5));
        assert!((quarter - small / spin).abs() < 1e-8, "{}: {quarter:e}", name(solver.as_ref()));
        assert!(half < 1e-8, "{}: {half:e}", name(solver.as_ref()));
    }
}

#[test]
fn long_phases_stay_within_what_the_solvers_answer_for() {
    let toss = toss(1.98, [31.0, -17.0, 42.0], 0.6, 60.0);
    assert!(phase(&toss) > 4000.0);
    let exact = ExactSolver.cos_tilt(&toss).unwrap();
    for solver in solvers() {
        let difference = (solver.cos_tilt(&toss).unwrap() - exact).abs();
        assert!(difference <= tilt_error(solver.as_ref(), &toss), "{}: {difference:e}", name(solver.as_ref()));
    }
}
