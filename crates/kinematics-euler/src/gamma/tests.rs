//! Tests of the γ-ODE: its derivatives against the exact motion, and its guards on both sides of their thresholds. A
//! guard that fails shows as a wrong answer without an error, which no other test would notice.

use dynamics::{Coin, Launch, TimeOfFlight, Vector3};
use exact::{CoinMotion, ExactMotion};

use super::*;

fn toss(k: f64, rate: [f64; 3], tilt: f64) -> Toss {
    let launch = Launch::new(rate, TimeOfFlight::Given(1.0)).unwrap().with_tilt(tilt).unwrap();
    Toss::new(Coin::from_moments(1.0, k).unwrap(), launch)
}

#[test]
fn from_horizontal_it_starts_on_the_regular_solution() {
    let toss = toss(0.5, [1.0, 1.0, 2.5], 0.0);
    let rate = toss.launch.rate();
    let start = InitialConditions::new(&toss.coin().unwrap(), &rate, Formulation::VERTICAL);
    assert_eq!((start.angles.beta, start.angles.gamma), (0.0, (-1.0_f64).atan2(1.0)));
    assert_eq!(rate.z - start.u, rate.z * (1.0 - 0.5 / 2.0), "γ'(0) = ωz (1 - k/2)");
    let system = GammaSystem::new(0.5, rate.z, start.precession);
    let y = SVector::from([start.angles.gamma, rate.z - start.u, start.angles.alpha, rate.x, rate.y]);
    assert_eq!(system.derivative(&y)[1], 0.0, "γ'' = 0 in the limit");
}

#[test]
fn along_the_momentum_the_angles_turn_steadily() {
    for rate in [[1.0, 1.0, 2.5], [1.0, -2.0, -3.0], [1e-12, 0.0, -1.0]] {
        let toss = toss(1.98, rate, 0.4);
        let start = InitialConditions::new(&toss.coin().unwrap(), &toss.launch.rate(), Formulation::MOMENTUM);
        assert!((0.0..=std::f64::consts::FRAC_PI_2).contains(&start.angles.beta));
        let precession = CoinMotion::new(&toss.coin().unwrap()).precession_rate();
        assert!((start.precession.abs() - precession).abs() < 1e-15 * precession);
        let system = GammaSystem::new(1.98, rate[2], start.precession);
        let y = SVector::from([start.angles.gamma, rate[2] - start.u, 0.0, rate[0], rate[1]]);
        let derivative = system.derivative(&y);
        assert!((derivative[0] + 0.98 * rate[2]).abs() < 1e-14, "γ' = -q");
        assert!(derivative[1].abs() < 1e-13, "γ'' = 0");
        assert!((derivative[2] - start.precession).abs() < 1e-13, "α' = ±ωL");
        let there = start.frame * start.angles.attitude();
        assert!(there.angle_to(&toss.launch.attitude()) < 1e-15);
    }
}

/// Compares (10) and (11) with central differences of the exact γ, on flights where the vertical frame is regular.
#[test]
fn the_acceleration_is_that_of_the_exact_motion() {
    for (k, rate, tilt) in [(0.5, [0.8, 1.6, 0.9], 1.3), (1.98, [0.5, 2.0, -0.5], 1.2), (1.0, [1.0, 2.0, 1.0], 1.4)] {
        let toss = toss(k, rate, tilt);
        let motion = CoinMotion::new(&toss.coin().unwrap());
        let h = 1e-3;
        let gamma = |time: f64| motion.euler_angles(time).unwrap().gamma;
        for step in 1..10 {
            let time = 0.1 * f64::from(step);
            let [before, now, after] = [time - h, time, time + h].map(gamma);
            let velocity = (after - before) / (2.0 * h);
            let state = motion.state(time).unwrap();
            let system = GammaSystem::new(k, rate[2], 1.0);
            let y = SVector::from([now, velocity, 0.0, state.rate.x, state.rate.y]);
            let found = system.gamma_acceleration(&system.terms(&y), velocity);
            let expected = (after - 2.0 * now + before) / (h * h);
            assert!((found - expected).abs() < 1e-4 * (1.0 + expected.abs()), "k {k}: {found}, not {expected}");
        }
    }
}

#[test]
fn a_precession_that_turns_back_is_an_error_with_its_time() {
    let launch = Launch::new(Vector3::new(0.3, 0.3, 5.0), TimeOfFlight::Given(5.0)).unwrap().with_tilt(1.0).unwrap();
    let tilted = Toss::new(Coin::PAPER, launch);
    for scheme in [dynamics::Scheme::DOP853, dynamics::Scheme::DOPRI5] {
        let stepping = Stepping::adaptive(scheme, 1e-10).unwrap();
        let error = GammaSolver::new(stepping, Formulation::VERTICAL).land(&tilted).unwrap_err();
        let SolveError::Singular { point: Singularity::PrecessionTooSlow, time } = error else { panic!("{error}") };
        assert!(time > 0.0 && time < 5.0, "{time}");
        // In the momentum frame the same flight is regular.
        let landing = GammaSolver::new(stepping, Formulation::MOMENTUM).land(&tilted).unwrap();
        let exact = ExactMotion::new(&tilted).cos_tilt(5.0).unwrap();
        assert!((landing.state.attitude.cos_tilt() - exact).abs() < 1e-8);
    }
}

#[test]
fn a_fixed_step_across_the_pole_is_an_error_with_its_time() {
    let toss = toss(0.5, [9.0, 4.0, 3.0], 0.0);
    let first_return = std::f64::consts::TAU / CoinMotion::new(&toss.coin().unwrap()).precession_rate();
    for step in [1e-3, 3e-4, 1e-4] {
        let stepping = Stepping::fixed(dynamics::Scheme::RK4, step).unwrap();
        let error = GammaSolver::new(stepping, Formulation::VERTICAL).land(&toss).unwrap_err();
        let SolveError::Singular { point: Singularity::NormalAlongAxis, time } = error else { panic!("{error}") };
        assert!((time - first_return).abs() < 0.02, "{time}, not {first_return}");
    }
}

/// A state of `system` with these D, u and β'. At γ = 0, ωy is D and ωx is β'.
fn state(system: &GammaSystem, d: f64, u: f64, beta_rate: f64) -> SVector<f64, 5> {
    SVector::from([0.0, system.rate_z - u, 0.0, beta_rate, d])
}

#[test]
fn where_d_vanishes_only_the_regular_solution_has_an_acceleration_of_0() {
    for rate_z in [0.5, 2.0, -3.0] {
        let system = GammaSystem::new(0.5, rate_z, 1.0);
        let acceleration = |d: f64, u: f64, beta_rate: f64| {
            let y = state(&system, d, u, beta_rate);
            system.gamma_acceleration(&system.terms(&y), y[1])
        };
        let regular = 0.25 * rate_z;
        assert_eq!(acceleration(0.0, regular, 3.0), 0.0);
        // The sum in (10) vanishes at the regular u, and its derivative with respect to u is -`slope` there.
        let slack = CANCELLATION_THRESHOLD * (rate_z * rate_z + (rate_z - regular).powi(2));
        let slope = system.q + rate_z;
        for (part, passes) in [(0.8, true), (-0.8, true), (1.25, false), (-1.25, false)] {
            let u = regular + part * slack / slope;
            assert_eq!(acceleration(0.0, u, 3.0) == 0.0, passes, "{rate_z}, {part}");
        }
        // Whether D has a correct digit depends on D/β' only.
        for (d, passes) in [(0.8, true), (1.25, false)] {
            for beta_rate in [0.01, -7.0] {
                let found =
                    acceleration(d * CANCELLATION_THRESHOLD * beta_rate, regular + 0.5 * slack / slope, beta_rate);
                assert_eq!(found == 0.0, passes, "{d}, {beta_rate}");
            }
        }
    }
}

#[test]
fn precession_is_too_slow_below_one_in_a_hundred_of_the_rate() {
    let system = GammaSystem::new(0.5, 0.0, 1.0);
    assert!(!system.precession_too_slow(&state(&system, 0.0, 1e-2, 1.0)), "at 1 % it goes on");
    assert!(system.precession_too_slow(&state(&system, 0.0, 0.99e-2, 1.0)));
    for scale in [1e-3, 8.0] {
        for transverse in [0.1, 5.0] {
            let system = GammaSystem::new(0.5, scale, 1.0);
            let largest = scale * f64::max(1.0, transverse);
            for (part, stops) in [(0.9, true), (1.1, false)] {
                let y = state(&system, 0.6 * 1e-2 * part * largest, 0.8 * 1e-2 * part * largest, scale * transverse);
                assert_eq!(system.precession_too_slow(&y), stops, "{scale}, {transverse}, {part}");
            }
        }
    }
}

#[test]
fn a_step_reports_the_singular_point_that_it_crosses() {
    let system = GammaSystem::new(0.5, 1.0, 1.0);
    let met = |was: [f64; 3], is: [f64; 3]| {
        let [before, after] = [was, is].map(|[d, u, beta_rate]| state(&system, d, u, beta_rate));
        system.singularity(&before, &after)
    };
    let pole = Some(Singularity::NormalAlongAxis);
    for beta_rate in [1.0, 1e-3] {
        assert_eq!(met([0.2, 0.5, beta_rate], [0.1, 0.5, beta_rate]), None, "no crossing");
        assert_eq!(met([0.2, 0.5, beta_rate], [-0.3, 0.5, beta_rate]), pole);
        assert_eq!(met([-0.3, 0.5, beta_rate], [0.2, 0.5, beta_rate]), pole);
        assert_eq!(met([0.2, 0.5, beta_rate], [0.0, 0.5, beta_rate]), None, "underflow");
        assert_eq!(met([-0.2, 0.5, beta_rate], [0.0, 0.5, beta_rate]), None, "underflow");
        let rounding = CANCELLATION_THRESHOLD * beta_rate;
        assert_eq!(met([0.9 * rounding, 0.5, beta_rate], [-0.3, 0.5, beta_rate]), None, "launched there");
        assert_eq!(met([1.1 * rounding, 0.5, beta_rate], [-0.3, 0.5, beta_rate]), pole);
    }
    assert_eq!(met([CANCELLATION_THRESHOLD, 0.5, 1.0], [-0.3, 0.5, 1.0]), None, "at the limit it was launched there");
    let stops = Some(Singularity::PrecessionTooSlow);
    assert_eq!(met([0.2, 0.5, 1.0], [1e-4, 1e-4, 1.0]), stops);
    assert_eq!(met([1e-4, 1e-4, 1.0], [1e-4, 1e-4, 1.0]), None, "it never went");
    assert_eq!(met([0.2, 0.5, 1.0], [-0.2, -0.1, 1.0]), stops, "it turned back");
    assert_eq!(met([0.2, 0.5, 1.0], [0.2, -0.1, 1.0]), None, "past the horizontal");
    assert_eq!(met([0.2, 0.0, 1.0], [-0.2, -0.5, 1.0]), pole);
    assert_eq!(met([0.2, -0.5, 1.0], [-0.2, 0.0, 1.0]), pole);
}

#[test]
fn accepts_a_rod_in_pure_spin_at_the_pole_and_refuses_other_rods_without_precession() {
    let stepping = Stepping::adaptive(Scheme::DOP853, 1e-10).unwrap();
    for formulation in [Formulation::MOMENTUM, Formulation::VERTICAL] {
        let solver = GammaSolver::new(stepping, formulation);
        for rate_z in [5.0, -5.0] {
            let spun = solver.land(&toss(0.0, [0.0, 0.0, rate_z], 0.0)).unwrap().state.attitude;
            assert!(spun.angle_to(&dynamics::Attitude::about_z(rate_z)) < 1e-9);
            for rate in [[1e-3, 0.0, rate_z], [0.0, 1e-3, rate_z]] {
                let error = solver.land(&toss(0.0, rate, 0.0)).unwrap_err();
                assert_eq!(error, SolveError::Singular { point: Singularity::PrecessionTooSlow, time: 0.0 });
            }
        }
    }
    let tilted = GammaSolver::new(stepping, Formulation::VERTICAL).land(&toss(0.0, [0.0, 0.0, 5.0], 1.0));
    assert_eq!(tilted, Err(SolveError::Singular { point: Singularity::PrecessionTooSlow, time: 0.0 }));
}

#[test]
fn beta_is_found_in_all_quadrants_and_is_0_for_a_coin_at_rest() {
    use std::f64::consts::{FRAC_PI_2, PI};
    for (sense, rate_z) in [(1.0, 0.0), (-1.0, 0.0), (1.0, -0.0), (-1.0, -0.0)] {
        let system = GammaSystem::new(0.5, rate_z, sense);
        let beta = |d: f64, u: f64| system.angles(&SVector::from([0.0, rate_z - u, 0.0, 0.0, d])).beta;
        for (d, u, expected) in
            [(1.0, 0.0, FRAC_PI_2), (0.0, 1.0, 0.0), (-1.0, 0.0, -FRAC_PI_2), (1.0, -1.0, 0.75 * PI)]
        {
            assert_eq!(beta(sense * d, sense * u), expected, "{sense}: {d}, {u}");
        }
        assert_eq!(beta(0.0, -sense).abs(), PI);
        assert_eq!([beta(0.0, 0.0), beta(-0.0, 0.0), beta(0.0, -0.0), beta(-0.0, -0.0)], [0.0; 4]);
    }
}

/// Without a rate nothing defines D and u, and so they do not tell the attitude.
#[test]
fn a_coin_at_rest_stays_as_it_was_thrown() {
    for formulation in [Formulation::MOMENTUM, Formulation::VERTICAL] {
        for tilt in [0.0, 1e-17, 1e-9, 1.0, 2.0, -2.0, std::f64::consts::PI, 3.2] {
            for rest in [[0.0; 3], [-0.0; 3], [0.0, -0.0, -0.0]] {
                let toss = toss(0.5, rest, tilt);
                let landing = GammaSolver::new(Stepping::DEFAULT, formulation).land(&toss).unwrap();
                assert!((landing.cos_tilt - tilt.cos()).abs() < 1e-15, "{tilt}: {landing:?}");
                assert!(landing.state.attitude.angle_to(&toss.launch.attitude()) < 1e-14, "{rest:?} {tilt}");
            }
        }
    }
}
