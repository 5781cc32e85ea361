//! Tests relations that follow from the motion of any rigid body, with every solver of the registry that solves bodies
//! which are no coins. A relation needs no reference value, so it can be tested on random tosses.
//!
//! BF is the body frame, whose z axis is the normal n; θ is the angle between n and the vertical.

use blackbox::{config, name, rates, solvers};
use dynamics::RigidPhase;
use proptest::prelude::*;
use toss::{Attitude, Body, ExactSolver, Launch, RigidToss, SolveError, Solver, State, TimeOfFlight, Toss, Vector3};

/// Every solver that solves bodies, and not coins alone.
fn for_bodies() -> impl Iterator<Item = Box<dyn Solver>> {
    let launch = Launch::new([1.0, 2.0, 3.0], TimeOfFlight::Given(0.1)).expect("valid");
    let brick = RigidToss { body: Body::from_moments([1.0, 1.5, 2.0]).expect("a body"), launch };
    solvers().into_iter().filter(move |solver| match solver.propagate_rigid(&brick) {
        Err(SolveError::NotSymmetric { .. }) => false,
        other => other.is_ok(),
    })
}

/// The state at landing.
fn landing(solver: &dyn Solver, toss: &RigidToss) -> State {
    match solver.propagate_rigid(toss) {
        Ok(propagation) => propagation.state,
        Err(error) => panic!("{} on {toss:?}: {error}", name(solver)),
    }
}

/// The error of the attitude (rad) that is allowed: ten times that of cos θ, and what rounding the inputs of a related
/// toss can change; `None` where the solver does not say.
fn allowed(solver: &dyn Solver, toss: &RigidToss) -> Option<f64> {
    let RigidPhase { angle, growth } = RigidPhase::new(toss).expect("the tosses of the tests are short");
    let rounding = 4.0 * f64::EPSILON * (2.0 + angle) * growth;
    solver.error_estimate_rigid(toss).expect("it is solved").map(|estimate| 10.0 * (estimate + rounding))
}

fn with(toss: &RigidToss, rate: Vector3<f64>, attitude: Attitude, time: f64) -> RigidToss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).expect("finite");
    RigidToss { launch: launch.with_attitude(attitude), ..*toss }
}

/// Asserts for every solver that a changed toss lands where `expected` of the landing says.
fn check(toss: &RigidToss, changed: &RigidToss, expected: impl Fn(&State) -> State) {
    for solver in for_bodies() {
        let solver = solver.as_ref();
        let Some(allowed) = allowed(solver, toss).zip(allowed(solver, changed)).map(|(a, b)| a + b) else { continue };
        let (expected, found) = (expected(&landing(solver, toss)), landing(solver, changed));
        let turned = found.attitude.angle_to(&expected.attitude);
        assert!(turned <= allowed, "{}: {turned:e} > {allowed:e}", name(solver));
        let rates = (found.rate - expected.rate).norm();
        assert!(rates <= allowed * (1.0 + toss.launch.turn_rate()), "{}: rates by {rates:e}", name(solver));
    }
}

prop_compose! {
    /// Bodies with mass at random distances from three planes, plates and rods among them.
    fn bodies()(parts in prop::array::uniform3(prop_oneof![1 => Just(1e-9), 1 => Just(0.5), 6 => 0.01..1.0])) -> Body {
        let [a, b, c]: [f64; 3] = parts;
        Body::from_moments([b + c, c + a, a + b]).expect("a body")
    }
}

prop_compose! {
    /// Tosses of a few turns, from any tilt.
    fn tosses()(
        body in bodies(), x in rates(), y in rates(), z in rates(),
        tilt in prop_oneof![Just(0.0), Just(std::f64::consts::PI), 0.0..std::f64::consts::PI],
        time in 0.0..0.5,
    ) -> RigidToss {
        let launch = Launch::new([x, y, z], TimeOfFlight::Given(time)).expect("finite");
        RigidToss { body, launch: launch.with_tilt(tilt).expect("finite") }
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn every_solver_lands_where_the_exact_motion_does(toss in tosses()) {
        let exact = landing(&ExactSolver, &toss);
        for solver in for_bodies() {
            let Some(allowed) = allowed(solver.as_ref(), &toss) else { continue };
            let difference = landing(solver.as_ref(), &toss).attitude.angle_to(&exact.attitude);
            prop_assert!(difference <= allowed, "{}: {difference:e} > {allowed:e}", name(solver.as_ref()));
        }
    }

    #[test]
    fn turning_the_laboratory_turns_the_landing_by_the_same_rotation(toss in tosses(), q in prop::array::uniform4(0.1..1.0)) {
        let turn = Attitude::from_components(q).unwrap();
        let turned = RigidToss { launch: toss.launch.with_attitude(turn * toss.launch.attitude()), ..toss };
        for solver in for_bodies() {
            let (before, after) = (landing(solver.as_ref(), &toss), landing(solver.as_ref(), &turned));
            let difference = after.attitude.angle_to(&(turn * before.attitude));
            prop_assert!(difference <= 4e-15, "{}: {difference:e}", name(solver.as_ref()));
        }
    }

    #[test]
    fn a_flight_in_two_legs_lands_like_the_whole_flight(toss in tosses(), part in 0.0..1.0) {
        let time = toss.launch.flight_time();
        for solver in for_bodies() {
            let solver = solver.as_ref();
            let Some(allowed) = allowed(solver, &toss) else { continue };
            let middle = landing(solver, &with(&toss, toss.launch.rate(), toss.launch.attitude(), part * time));
            let end = landing(solver, &with(&toss, middle.rate, middle.attitude, time - part * time));
            let difference = end.attitude.angle_to(&landing(solver, &toss).attitude);
            prop_assert!(difference <= 2.0 * allowed, "{}: {difference:e} > {allowed:e}", name(solver));
        }
    }

    #[test]
    fn a_flight_with_reversed_rate_returns_to_the_launch(toss in tosses()) {
        let time = toss.launch.flight_time();
        for solver in for_bodies() {
            let solver = solver.as_ref();
            let Some(allowed) = allowed(solver, &toss) else { continue };
            let there = landing(solver, &toss);
            let back = landing(solver, &with(&toss, -there.rate, there.attitude, time));
            let difference = back.attitude.angle_to(&toss.launch.attitude());
            prop_assert!(difference <= 2.0 * allowed, "{}: {difference:e} > {allowed:e}", name(solver));
        }
    }

    /// In the mirror at the plane x = 0, a body with principal axes x, y, z is itself; its rate, an axial vector, keeps its
    /// x component and reverses the others, and so does the vector of its attitude.
    #[test]
    fn the_mirror_image_of_a_flight_is_a_flight(toss in tosses()) {
        let mirrored = |attitude: &Attitude| {
            let [w, x, y, z] = attitude.components();
            Attitude::from_components([w, x, -y, -z]).unwrap()
        };
        let reversed = |rate: Vector3<f64>| Vector3::new(rate.x, -rate.y, -rate.z);
        let image = with(&toss, reversed(toss.launch.rate()), mirrored(&toss.launch.attitude()), toss.launch.flight_time());
        check(&toss, &image, |state| State { attitude: mirrored(&state.attitude), rate: reversed(state.rate) });
    }

    /// The same body and launch in axes that are named in another order: only n is another axis.
    #[test]
    fn the_names_of_the_axes_do_not_matter(toss in tosses()) {
        let moments = toss.body.moments().unwrap();
        let body = Body::from_moments([moments[1], moments[2], moments[0]]).unwrap();
        let renamed = |vector: Vector3<f64>| Vector3::new(vector.y, vector.z, vector.x);
        // The turn that takes components along the new axes to those along the old ones.
        let turn = Attitude::from_components([0.5, 0.5, 0.5, 0.5]).unwrap();
        let other = RigidToss { body, ..toss };
        let other = with(&other, renamed(toss.launch.rate()), toss.launch.attitude() * turn, toss.launch.flight_time());
        check(&toss, &other, |state| State { attitude: state.attitude * turn, rate: renamed(state.rate) });
    }

    #[test]
    fn scaling_moments_or_rate_and_time_by_powers_of_two_changes_no_bit(toss in tosses(), exponent in -40..40) {
        let c = 2f64.powi(exponent);
        let heavier = RigidToss { body: Body::from_moments(toss.body.moments().unwrap().map(|moment| moment * c)).unwrap(), ..toss };
        let faster = with(&toss, toss.launch.rate() * c, toss.launch.attitude(), toss.launch.flight_time() / c);
        for solver in for_bodies() {
            let solver = solver.as_ref();
            let landed = landing(solver, &toss);
            prop_assert_eq!(landing(solver, &heavier), landed, "{}", name(solver));
            let fast = landing(solver, &faster);
            prop_assert_eq!(fast.attitude, landed.attitude, "{}", name(solver));
            prop_assert_eq!(fast.rate, landed.rate * c, "{}", name(solver));
        }
    }

    /// Every solver of the registry, also those for coins alone.
    #[test]
    fn a_body_with_two_equal_moments_about_n_is_a_coin_bit_by_bit(toss in blackbox::tosses()) {
        let Toss { coin, launch } = toss;
        let body = RigidToss { body: Body::from_moments([coin.i1(), coin.i1(), coin.i3()]).unwrap(), launch };
        for solver in solvers() {
            prop_assert_eq!(solver.propagate_rigid(&body), solver.propagate(&toss), "{}", name(solver.as_ref()));
            prop_assert_eq!(solver.error_estimate_rigid(&body), solver.error_estimate(&toss));
            prop_assert_eq!(solver.outcome_rigid(&body), solver.outcome(&toss));
        }
    }
}

#[test]
fn the_gamma_ode_alone_refuses_bodies() {
    let names: Vec<String> = for_bodies().map(|solver| name(solver.as_ref())).collect();
    let refusing: Vec<String> =
        solvers().iter().map(|solver| name(solver.as_ref())).filter(|name| !names.contains(name)).collect();
    assert!(names.len() == 6 && refusing.iter().all(|name| name.starts_with("gamma")), "{names:?}, {refusing:?}");
}
