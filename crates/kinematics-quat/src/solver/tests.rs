//! Tests of the quaternion solver by Runge-Kutta schemes and Taylor series.

use dynamics::{Body, Coin, Launch, Scheme, TimeOfFlight, Tosses, Vector3};

use super::*;

fn toss(tilt: f64) -> Toss {
    let launch = Launch::new(Vector3::new(9.0, -4.0, 3.0), TimeOfFlight::Given(0.8)).unwrap();
    Toss::new(Coin::PAPER, launch.with_tilt(tilt).unwrap())
}

#[test]
fn neither_work_nor_error_depends_on_the_tilt() {
    let solver = QuaternionSolver::new(Stepping::DEFAULT, Formulation::default());
    let horizontal = solver.land(&toss(0.0)).unwrap();
    for tilt in [1e-300, 1e-16, 1e-4, 1.0, 3.0] {
        let tilted = solver.land(&toss(tilt)).unwrap();
        assert_eq!(tilted.work, horizontal.work);
        assert_eq!(tilted.norm_error, horizontal.norm_error);
    }
}

#[test]
fn the_norm_error_is_the_sum_of_the_norms_lost_in_the_steps() {
    // In a steady turn, RK4 loses the fraction (ωh/2)⁶/144 of the norm in each step of length h.
    let launch = Launch::new(Vector3::new(4.0, 0.0, 0.0), TimeOfFlight::Given(1.0)).unwrap();
    let solver = QuaternionSolver::new(Stepping::fixed(Scheme::RK4, 0.05).unwrap(), Formulation::default());
    let landing = solver.land(&Toss::new(Coin::DISC, launch)).unwrap();
    let lost = 20.0 * (4.0 * 0.05 / 2.0_f64).powi(6) / 144.0;
    assert!((landing.norm_error / lost - 1.0).abs() < 0.01, "{:e}, not {lost:e}", landing.norm_error);
}

#[test]
fn raw_computes_cos_theta_without_dividing_by_the_norm() {
    let thrown = |rate: [f64; 3]| Launch::new(rate, TimeOfFlight::Given(1.0)).unwrap();
    let body = Body::from_moments([1.0, 2.0, 2.5]).unwrap();
    for (toss, step) in [
        (Toss::new(Coin::DISC, thrown([4.0, 0.0, 0.0])), 0.05),
        (Toss::new(body, thrown([2.0, 3.0, -1.0]).with_tilt(0.3).unwrap()), 0.02),
    ] {
        let method = Stepping::fixed(Scheme::RK4, step).unwrap();
        let landing = |formulation| QuaternionSolver::new(method, formulation).land(&toss).unwrap();
        let (projected, raw) = (landing(Formulation::MOMENTUM), landing(Formulation::RAW));
        assert_eq!(projected.cos_tilt, projected.state.attitude.cos_tilt());
        let norm = 1.0 - raw.norm_error;
        assert!(raw.norm_error > 1e-9 && (raw.cos_tilt - norm * norm * projected.cos_tilt).abs() < 1e-15);
    }
}

#[test]
fn many_tosses_land_as_they_do_one_by_one_in_their_order() {
    let [x, y, z, speed] = [[9.0, 3.0, 0.0], [-4.0, 2.0, 1.0], [3.0, 0.5, 2.0], [3.0, 4.0, 5.0]];
    let tosses = Tosses::new(Coin::PAPER, Attitude::IDENTITY, 9.81, [&x, &y, &z], &speed).unwrap();
    for scheme in [TAYLOR, Scheme::DOP853] {
        let solver = QuaternionSolver::new(Stepping::adaptive(scheme, 1e-9).unwrap(), Formulation::default());
        let each = tosses.each().unwrap();
        let mut found = [Tilt { cos_tilt: f64::NAN, error: None }; 3];
        solver.tilts(&each, &mut found).unwrap();
        let alone: Vec<Tilt> = each.iter().map(|toss| solver.tilt(toss).unwrap()).collect();
        assert_eq!(found[..], alone);
        assert_eq!((solver.name(), solver.stepping().map(|by| by.scheme())), ("quaternion", Some(scheme)));
    }
}

/// (tolerance + ε (1 + φ)) (1 + φ), twice as much for a body in a steady turn about its first axis, whose disturbances grow
/// to the double, and nothing where that is 1 or more.
#[test]
fn estimates_of_series_are_those_of_their_formula() {
    let launch = Launch::new([3.0, 0.0, 0.0], TimeOfFlight::Given(2.0)).unwrap();
    let body = Body::from_moments([1.0, 2.0, 2.5]).unwrap();
    for tolerance in [0.1, 1e-3, 1e-10, f64::EPSILON] {
        let solver = QuaternionSolver::new(Stepping::adaptive(TAYLOR, tolerance).unwrap(), Formulation::default());
        let estimate = |toss: Toss| solver.land(&toss).unwrap().error;
        let expected = |phase: f64| (tolerance + f64::EPSILON * (1.0 + phase)) * (1.0 + phase);
        let close = |found: Option<f64>, expected: f64| found.is_some_and(|it| (it / expected - 1.0).abs() < 1e-14);
        assert!(close(estimate(Toss::new(Coin::DISC, launch)), expected(6.0)), "{tolerance:e}");
        let (found, expected) = (estimate(Toss { body, launch }), 2.0 * expected(72.0_f64.sqrt()));
        assert!(if tolerance == 0.1 { found.is_none() } else { close(found, expected) }, "{tolerance:e}: {found:?}");
    }
}
