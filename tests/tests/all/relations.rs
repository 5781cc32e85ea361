//! Tests relations that follow from the motion itself, such as symmetries and conservation laws, with every solver of
//! the registry. A relation needs no reference value, so it can be tested on random tosses.
//!
//! BF is the body frame, whose z axis is the normal n; θ is the angle between n and the vertical.

use blackbox::{attitude_error, body_tosses, coin_and_body, config, lasting, name, solvers, tilt_error, toss, tosses};
use dynamics::Singularity;
use proptest::prelude::*;
use toss::{
    Attitude, Body, Coin, CoinMotion, ExactSolver, Launch, Outcome, Registry, Scheme, Settings, SolveError, Solver,
    State, Stepping, Tilt, TimeOfFlight, Toss, Vector3,
};

/// The state at landing, or `None` where the γ-ODE refuses a body with I1 ≠ I2, or a coin whose precession is too slow. Any
/// other error fails the test.
fn landing(solver: &dyn Solver, toss: &Toss) -> Option<State> {
    match solver.land(toss) {
        Ok(landing) => Some(landing.state),
        Err(SolveError::NotSymmetric { .. }) if solver.name() == "gamma" && toss.coin().is_none() => None,
        Err(SolveError::Singular { point: Singularity::PrecessionTooSlow, .. })
            if solver.name() == "gamma" && precession_rate(toss) < 0.01 * toss.launch.rate().amax() =>
        {
            None
        }
        Err(error) => panic!("{} on {toss:?}: {error}", name(solver)),
    }
}

/// The coin of a toss.
fn coin(toss: &Toss) -> Coin {
    toss.body.coin().expect("the toss of a coin")
}

/// ωL of the toss of a coin (rad/s).
fn precession_rate(toss: &Toss) -> f64 {
    CoinMotion::new(&toss.coin().expect("the toss of a coin")).precession_rate()
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

/// Asserts for every solver that the `changed` toss lands where `expected` of the landing says.
fn check_landing(toss: &Toss, changed: &Toss, expected: impl Fn(&State) -> State) {
    for solver in solvers() {
        let solver = solver.as_ref();
        let (Some(before), Some(found)) = (landing(solver, toss), landing(solver, changed)) else { continue };
        let (expected, allowed) = (expected(&before), attitude_error(solver, toss) + attitude_error(solver, changed));
        let turned = found.attitude.angle_to(&expected.attitude);
        assert!(turned <= allowed, "{}: {turned:e} > {allowed:e}", name(solver));
        let rates = (found.rate - expected.rate).norm();
        assert!(rates <= allowed * (1.0 + toss.launch.turn_rate()), "{}: rates by {rates:e}", name(solver));
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
    fn every_solver_lands_where_the_exact_motion_does(tosses in coin_and_body()) {
        for toss in tosses {
            let exact = ExactSolver.land(&toss).unwrap().state;
            for solver in solvers() {
                let solver = solver.as_ref();
                let Some(state) = landing(solver, &toss) else { continue };
                let difference = state.attitude.angle_to(&exact.attitude);
                prop_assert!(difference <= attitude_error(solver, &toss), "{}: {difference:e}", name(solver));
                let tilt = (solver.tilt(&toss).unwrap().cos_tilt - exact.attitude.cos_tilt()).abs();
                prop_assert!(tilt <= tilt_error(solver, &toss), "{}: {tilt:e}", name(solver));
            }
        }
    }

    #[test]
    fn scaling_rate_and_time_by_powers_of_two_changes_no_bit(tosses in coin_and_body(), exponent in -40..40) {
        let c = 2f64.powi(exponent);
        for toss in tosses {
            let faster = lasting(&with_rate(&toss, toss.launch.rate() * c), toss.launch.flight_time() / c);
            for solver in solvers() {
                let solver = solver.as_ref();
                let (Some(slow), Some(fast)) = (landing(solver, &toss), landing(solver, &faster)) else { continue };
                prop_assert_eq!(slow.attitude, fast.attitude, "{}", name(solver));
                prop_assert_eq!(slow.rate * c, fast.rate, "{}", name(solver));
            }
        }
    }

    #[test]
    fn scaling_all_moments_of_inertia_by_a_power_of_two_changes_no_bit(tosses in coin_and_body(), exponent in -40..40) {
        for toss in tosses {
            let moments = toss.body.moments().unwrap().map(|moment| moment * 2f64.powi(exponent));
            let heavier = Toss::new(Body::from_moments(moments).unwrap(), toss.launch);
            for solver in solvers() {
                let solver = solver.as_ref();
                prop_assert_eq!(landing(solver, &heavier), landing(solver, &toss), "{}", name(solver));
            }
        }
    }

    /// A body with I1 = I2 is the coin, so that every solver lands both to the same bits.
    #[test]
    fn a_body_with_two_equal_moments_about_n_is_a_coin_bit_by_bit(toss in tosses()) {
        let coin = coin(&toss);
        let body = Toss::new(Body::from_moments([coin.i1(), coin.i1(), coin.i3()]).unwrap(), toss.launch);
        prop_assert_eq!(body, toss);
        for solver in solvers() {
            prop_assert_eq!(landing(solver.as_ref(), &body), landing(solver.as_ref(), &toss));
        }
    }

    #[test]
    fn a_flight_in_two_legs_lands_like_the_whole_flight(tosses in coin_and_body(), part in 0.0..1.0) {
        for toss in tosses {
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
    }

    #[test]
    fn a_flight_with_reversed_rate_returns_to_the_launch(tosses in coin_and_body()) {
        for toss in tosses {
            for solver in solvers() {
                let solver = solver.as_ref();
                let Some(there) = landing(solver, &toss) else { continue };
                let reversed = State { rate: -there.rate, ..there };
                let Some(back) = landing(solver, &resume(&toss, &reversed, toss.launch.flight_time())) else { continue };
                let (difference, allowed) =
                    (back.attitude.angle_to(&toss.launch.attitude()), 2.0 * attitude_error(solver, &toss));
                prop_assert!(difference <= allowed, "{}: {difference:e}", name(solver));
                let rates = (back.rate + toss.launch.rate()).norm();
                prop_assert!(rates <= allowed * (1.0 + toss.launch.rate().norm()), "{}: {rates:e}", name(solver));
            }
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
    fn turning_a_launch_turns_its_landing_by_the_same_rotation(
        tosses in coin_and_body(), q in prop::array::uniform4(0.1..1.0)
    ) {
        let turn = Attitude::from_components(q).unwrap();
        for toss in tosses {
            let turned = with_attitude(&toss, turn * toss.launch.attitude());
            for solver in solvers() {
                let solver = solver.as_ref();
                let (Some(before), Some(after)) = (landing(solver, &toss), landing(solver, &turned)) else { continue };
                // Solvers compute the flight relative to its launch, which is the same; only the last product rounds
                // differently.
                let difference = after.attitude.angle_to(&(turn * before.attitude));
                prop_assert!(difference <= 4e-15, "{}: {difference:e}", name(solver));
            }
        }
    }

    /// In the mirror at the plane x = 0, a body with principal axes x, y, z is itself; its rate, an axial vector, keeps its
    /// x component and reverses the others, and so does the vector of its attitude.
    #[test]
    fn the_mirror_image_of_a_flight_is_a_flight(tosses in coin_and_body()) {
        let mirrored = |attitude: &Attitude| {
            let [w, x, y, z] = attitude.components();
            Attitude::from_components([w, x, -y, -z]).unwrap()
        };
        let reversed = |rate: Vector3<f64>| Vector3::new(rate.x, -rate.y, -rate.z);
        for toss in tosses {
            let image = with_attitude(&with_rate(&toss, reversed(toss.launch.rate())), mirrored(&toss.launch.attitude()));
            check_landing(&toss, &image, |state| State {
                attitude: mirrored(&state.attitude),
                rate: reversed(state.rate),
            });
        }
    }

    /// The same body and launch in axes that are named in another order: only n is another axis.
    #[test]
    fn the_names_of_the_axes_do_not_matter(toss in body_tosses()) {
        let [i1, i2, i3] = toss.body.moments().unwrap();
        let renamed = |vector: Vector3<f64>| Vector3::new(vector.y, vector.z, vector.x);
        // The turn that takes components along the new axes to those along the old ones.
        let turn = Attitude::from_components([0.5, 0.5, 0.5, 0.5]).unwrap();
        let other = Toss::new(Body::from_moments([i2, i3, i1]).unwrap(), toss.launch);
        let other = with_attitude(&with_rate(&other, renamed(toss.launch.rate())), toss.launch.attitude() * turn);
        check_landing(&toss, &other, |state| State { attitude: state.attitude * turn, rate: renamed(state.rate) });
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
        let rate = precession_rate(&toss);
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
                prop_assert_eq!(solver.tilt(&changed).map(Tilt::outcome), solver.tilt(&toss).map(Tilt::outcome), "{}", name(solver.as_ref()));
            }
        }
    }

    #[test]
    fn momentum_energy_and_spin_are_conserved(toss in tosses()) {
        if toss.launch.rate().norm() == 0.0 {
            return Ok(());
        }
        let (coin, launch) = (coin(&toss), State { attitude: toss.launch.attitude(), rate: toss.launch.rate() });
        for solver in solvers() {
            let solver = solver.as_ref();
            let Some(end) = landing(solver, &toss) else { continue };
            let allowed = attitude_error(solver, &toss);
            let in_lab = |state: &State| state.attitude.body_to_lab(&toss.body.angular_momentum(&state.rate));
            let (before, after) = (in_lab(&launch), in_lab(&end));
            let scale = coin.i1() * launch.rate.norm();
            prop_assert!((after - before).norm() <= allowed * scale, "{}: S", name(solver));
            let length = |state: &State| toss.body.angular_momentum(&state.rate).norm();
            prop_assert!((length(&end) - length(&launch)).abs() <= allowed * scale, "{}: |S|", name(solver));
            let energy = |state: &State| toss.body.kinetic_energy(&state.rate);
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
fn the_gamma_ode_alone_refuses_bodies() {
    let launch = Launch::new([1.0, 2.0, 3.0], TimeOfFlight::Given(0.1)).unwrap();
    let brick = Toss::new(Body::from_moments([1.0, 1.5, 2.0]).unwrap(), launch);
    let refused = |by: &dyn Solver| matches!(by.land(&brick), Err(SolveError::NotSymmetric { .. }));
    let all = solvers();
    let (refusing, others): (Vec<_>, Vec<_>) = all.iter().partition(|by| refused(by.as_ref()));
    assert!(others.len() == 6 && others.iter().all(|by| by.land(&brick).is_ok()));
    assert!(!refusing.is_empty() && refusing.iter().all(|by| by.name() == "gamma"));
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
        let toss = Toss { body: Body::from_moments(moments).unwrap(), launch };
        let settings = Settings { stepping: Stepping::adaptive(scheme, tolerance).unwrap(), ..Settings::default() };
        let by = Registry::standard().named(solver).unwrap().solver(&settings).unwrap();
        let (found, exact) = (by.tilt(&toss).unwrap(), ExactSolver.tilt(&toss).unwrap());
        let (error, estimate) = ((found.cos_tilt - exact.cos_tilt).abs(), found.error.unwrap());
        assert!(error <= 0.1 * estimate, "{solver}/{scheme}: {error:e}, {estimate:e}");
        // An estimate that says nothing would hold, too.
        assert!(estimate < 1e-3, "{solver}/{scheme}: {estimate:e}");
        let (said, truth) = (found.outcome(), exact.outcome());
        assert!(said == truth || said == Outcome::Undecided, "{solver}/{scheme}: {said:?}, not {truth:?}");
    }
}
