//! Tests of both solvers, in every formulation, against the exact motion. The launches are regular in the formulation,
//! except where a test shows how the paper's printed equations fail.

use std::f64::consts::PI;

use dynamics::{
    Attitude, Coin, EulerAngles, Formulation, Launch, Scheme, SolveError, Solver, Stepping, TimeOfFlight, Toss,
};
use exact::ExactMotion;
use kinematics_euler::{EulerAnglesSolver, GammaSolver};

fn method() -> Stepping {
    Stepping::adaptive(Scheme::DOP853, 1e-12).expect("valid")
}

fn solvers(formulation: Formulation) -> [Box<dyn Solver>; 2] {
    [Box::new(GammaSolver::new(method(), formulation)), Box::new(EulerAnglesSolver::new(method(), formulation))]
}

/// A toss with this attitude at launch.
fn toss(k: f64, rate: [f64; 3], attitude: Attitude, time: f64) -> Toss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).expect("valid");
    Toss::new(Coin::from_moments(1.0, k).expect("valid"), launch.with_attitude(attitude))
}

/// The attitude at the Euler angles α, β, γ (rad).
fn at(alpha: f64, beta: f64, gamma: f64) -> Attitude {
    EulerAngles { alpha, beta, gamma }.attitude()
}

/// Errors of the attitude (rad) and of the body rate (rad/s) at landing.
fn errors(solver: &dyn Solver, toss: &Toss) -> Result<(f64, f64), SolveError> {
    let landing = solver.land(toss)?.state;
    let exact = ExactMotion::new(toss).state(toss.launch.time_of_flight())?;
    Ok((exact.attitude.angle_to(&landing.attitude), (exact.rate - landing.rate).norm()))
}

fn check(formulation: Formulation, tosses: &[Toss]) {
    for toss in tosses {
        for solver in solvers(formulation) {
            let (attitude, rate) = errors(&*solver, toss).expect("regular");
            assert!(attitude < 2e-10 && rate < 2e-10, "{}, {toss:?}: {attitude:e}, {rate:e}", solver.name());
        }
    }
}

/// Body rates with spin of both signs and without, with transverse rates in several directions and without.
const RATES: [[f64; 3]; 8] = [
    [1.0, 1.0, 2.5],
    [-1.0, 2.0, -3.0],
    [2.0, -3.0, 0.5],
    [-2.0, -0.3, -0.4],
    [3.0, 4.0, 0.0],
    [0.0, 2.0, -5.0],
    [4.0, 0.0, 1.0],
    [0.0, 0.0, -4.0],
];

#[test]
fn along_the_momentum_every_launch_is_regular() {
    let launched = [Attitude::IDENTITY, at(0.0, 1.0, 0.0), at(2.0, 2.5, -1.0)];
    for k in [0.5, 1.0, 1.98] {
        let tosses: Vec<Toss> =
            RATES.iter().flat_map(|rate| launched.map(|attitude| toss(k, *rate, attitude, 3.0))).collect();
        check(Formulation::MOMENTUM, &tosses);
    }
}

/// Launches from both poles, turned about the vertical, with flights that end before n is vertical again.
#[test]
fn in_the_vertical_frame_a_launch_may_start_at_a_pole() {
    for pole in [0.0, PI] {
        for (alpha, gamma) in [(0.0, 0.0), (0.7, 0.4), (-2.0, 1.2)] {
            let attitude = at(alpha, pole, gamma);
            let tosses: Vec<Toss> =
                RATES.iter().filter(|rate| rate[2] != 0.0).map(|rate| toss(0.5, *rate, attitude, 0.7)).collect();
            check(Formulation::VERTICAL, &tosses);
        }
    }
}

/// Launches whose cone around S contains the vertical, so that α' never vanishes, on flights so short that cos β does
/// not vanish either.
fn regular_in_the_vertical_frame() -> Vec<Toss> {
    let up = [([0.3, 1.6, 1.4], 1.0), ([0.5, 2.0, 0.9], 0.8), ([-0.6, 1.5, 1.2], 0.7)];
    up.into_iter()
        .flat_map(|([x, y, z], tilt)| {
            // The second rate is the same motion backwards, with S down.
            [[x, y, z], [-x, -y, -z]].map(|rate| {
                let attitude = at(0.3, tilt, -0.2);
                toss(1.98, rate, attitude, 0.25)
            })
        })
        .collect()
}

#[test]
fn away_from_the_poles_every_formulation_is_right() {
    for formulation in Formulation::ALL {
        check(formulation, &regular_in_the_vertical_frame());
    }
}

/// (9) as the paper prints it, by tan β, loses the quadrant of β. The vertical formulation, by atan2, keeps it.
#[test]
fn as_printed_the_gamma_ode_loses_the_quadrant_of_beta() {
    let upside_down = at(0.0, 2.2, 0.0);
    for toss in [toss(0.5, [2.0, 5.0, 1.0], at(0.0, 1.2, 0.0), 0.4), toss(1.98, [0.3, 1.6, 1.4], upside_down, 0.2)] {
        let [raw, angles] = solvers(Formulation::RAW);
        assert!(errors(&*angles, &toss).expect("regular").0 < 1e-9);
        assert!(errors(&*raw, &toss).expect("no error, and wrong").0 > 1.0);
        check(Formulation::VERTICAL, &[toss]);
    }
}

#[test]
fn as_printed_a_horizontal_launch_is_0_over_0() {
    for solver in solvers(Formulation::RAW) {
        let horizontal = toss(0.5, [1.0, 1.0, 2.5], Attitude::IDENTITY, 0.5);
        assert!(
            matches!(
                solver.land(&horizontal),
                Err(SolveError::NotFinite { .. } | SolveError::StepSizeUnderflow { .. })
            ),
            "{:?}",
            solver.land(&horizontal)
        );
    }
}

#[test]
fn solvers_report_their_name_and_stepping() {
    for formulation in Formulation::ALL {
        let [gamma, euler] = solvers(formulation);
        assert_eq!((gamma.name(), gamma.stepping()), ("gamma", Some(method())));
        assert_eq!((euler.name(), euler.stepping()), ("euler", Some(method())));
    }
}
