//! Fixed steps over long flights: the amplitude of a rate then falls a little in every step, and the error of an angle grows
//! with the square of the phase.

use dynamics::{Body, Coin, Formulation, Launch, Scheme, Solver, Stepping, TimeOfFlight, Toss};
use exact::ExactSolver;
use kinematics_quat::QuaternionSolver;

/// The error of cos θ, divided by what is claimed, of a flight in so many steps of `part`/|ω|. `None` without a claim.
fn part_of_claim(body: Body, rate: [f64; 3], scheme: Scheme, (part, steps): (f64, f64)) -> Option<f64> {
    let launch = |time: f64| Launch::new(rate, TimeOfFlight::Given(time)).expect("finite numbers");
    let step = part / launch(0.0).turn_rate();
    let toss = Toss::new(body, launch(step * steps));
    let stepping = Stepping::fixed(scheme, step).expect("a scheme with equal steps");
    let found = QuaternionSolver::new(stepping, Formulation::default()).tilt(&toss).expect("few enough steps");
    let exact = ExactSolver.tilt(&toss).expect("a phase below 2^53");
    Some((found.cos_tilt - exact.cos_tilt).abs() / found.error?)
}

#[test]
fn the_estimate_holds_where_steps_all_lose_a_little_of_the_same_rate() {
    let rod = Coin::from_moments(1.0, 5.5e-9).unwrap().into();
    let bodies = [rod, Coin::PAPER.into(), Body::from_moments([0.0012, 0.0164, 0.0176]).unwrap()];
    let rates = [[1.19e-3, -0.589e-3, 3.35e-3], [1.0, 1.0, 2.5]];
    let mut largest = 0.0_f64;
    for body in bodies {
        for rate in rates {
            for scheme in Scheme::RUNGE_KUTTA {
                for (part, steps) in [(0.1, 9e4), (0.05, 4.9e5), (0.05, 4.901e5)] {
                    let found = part_of_claim(body, rate, scheme, (part, steps)).unwrap_or(0.0);
                    assert!(found <= 0.5, "{body:?}, {rate:?}, {scheme:?}, {steps} steps of {part}: {found}");
                    largest = largest.max(found);
                }
            }
        }
    }
    // The estimate says something here.
    assert!(largest > 0.05, "{largest}");
}
