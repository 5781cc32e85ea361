//! Tests of proofs by Runge-Kutta schemes.

use dynamics::{Coin, Formulation, Launch, Scheme, SolveError, Solver, Stepping, TimeOfFlight};
use exact::certify;
use nalgebra::Vector3;

use super::*;
use crate::proven::tests::{Numbers, awkward, random, shares};
use crate::{Integration, QuaternionSolver, half_product};

fn solver(stepping: Stepping) -> QuaternionSolver {
    QuaternionSolver::new(stepping, Formulation::default())
}

/// Every scheme with tolerances or steps.
fn steppings() -> Vec<Stepping> {
    let adaptive = |scheme| [1e-4, 1e-6, 1e-9, 1e-12].map(|tolerance| Stepping::adaptive(scheme, tolerance).unwrap());
    let fixed = |scheme| [0.2, 0.02].map(|step| Stepping::fixed(scheme, step).unwrap());
    let adaptive = [Scheme::DOP853, Scheme::DOPRI5].into_iter().flat_map(adaptive);
    adaptive.chain(Scheme::RUNGE_KUTTA.into_iter().flat_map(fixed)).collect()
}

/// The bounds are so close that half of any of them is broken, but where rounding is most of it.
#[test]
fn errors_are_below_their_bounds_and_close_to_them() {
    for stepping in steppings() {
        let (solver, mut numbers, mut largest, mut bounded) = (solver(stepping), Numbers(7), 0.0_f64, 0);
        for phase in [0.1, 3.0, 30.0, 300.0, 3e3] {
            for index in 0..40 {
                let toss = if index % 3 == 0 { awkward(&mut numbers, phase) } else { random(&mut numbers, phase) };
                let found = solver.enclose(&toss).unwrap();
                bounded += i32::from(found.error_bound() < 2.0);
                for share in shares(&found, &toss) {
                    assert!(share <= 1.0, "{stepping}, {phase}: {share} of the bound, {toss:?}");
                    largest = largest.max(share);
                }
            }
        }
        assert!(largest > 0.5, "{stepping}: at most {largest} of the bound");
        assert!(bounded > 80, "{stepping}: {bounded} of 200 have a bound");
    }
}

/// Times that are rounded in long flights count with their signs.
#[test]
fn bounds_of_long_flights_are_close() {
    let solver = solver(Stepping::adaptive(Scheme::DOP853, 1e-9).unwrap());
    let mut numbers = Numbers(17);
    for _ in 0..3 {
        let toss = random(&mut numbers, 1e5);
        let share = shares(&solver.enclose(&toss).unwrap(), &toss)[1];
        assert!((0.1..=1.0).contains(&share), "{share}");
    }
}

#[test]
fn outcomes_are_those_of_the_exact_motion() {
    let (mut numbers, mut by) = (Numbers(19), [0; 4]);
    for stepping in steppings() {
        for index in 0..60 {
            let toss = random(&mut numbers, [3.0, 30.0, 300.0][index % 3]);
            let found = solver(stepping).certify(&toss).unwrap();
            assert_eq!(found.outcome(), certify(&toss).unwrap().outcome(), "{stepping}: {toss:?}");
            assert!(found.cos_tilt().abs() > found.error_bound());
            by[found.integration() as usize] += 1;
        }
    }
    assert!(by[Integration::AsConfigured as usize] > 600 && by[Integration::Finest as usize] > 3, "{by:?}");
}

#[test]
fn landings_are_those_of_the_solver_and_the_same_at_every_simd_level() {
    let mut numbers = Numbers(5);
    let tosses: Vec<Toss> = (0..12).map(|index| random(&mut numbers, [1.0, 40.0, 400.0][index % 3])).collect();
    for stepping in steppings() {
        let solver = solver(stepping);
        let alone: Vec<_> = tosses.iter().map(|toss| solver.certify(toss)).collect();
        for level in SimdLevel::all() {
            assert_eq!(solver.certify_all(&tosses, level), alone, "{stepping}, {}", level.name());
        }
        for toss in &tosses {
            let (enclosed, landing) = (solver.enclose(toss).unwrap(), solver.propagate(toss).unwrap());
            assert_eq!(enclosed.landing().state, landing.state);
            assert!((enclosed.cos_tilt() - landing.cos_tilt).abs() < 1e-14);
            // The coefficients of the series are counted with the right-hand sides.
            let (with, without) = (enclosed.work(), landing.work);
            assert_eq!((with.accepted_steps, with.rejected_steps), (without.accepted_steps, without.rejected_steps));
            assert!(with.rhs_calls >= without.rhs_calls + 10 * without.accepted_steps);
        }
    }
}

#[test]
fn steps_that_are_too_long_have_no_bound_and_other_flights_decide() {
    let toss = random(&mut Numbers(1), 400.0);
    for scheme in Scheme::RUNGE_KUTTA {
        for step in [1e2, 1e4] {
            let solver = solver(Stepping::fixed(scheme, step).unwrap());
            assert_eq!(solver.enclose(&toss).map(|found| found.attitude_error_bound()), Ok(2.0), "{scheme}, {step}");
            let found = solver.certify(&toss).unwrap();
            assert_eq!(found.outcome(), certify(&toss).unwrap().outcome());
            assert_eq!(found.integration(), Integration::Finest);
        }
    }
    let own = solver(Stepping::fixed(Scheme::new("own", Some(2)).with_fixed_steps(), 0.1).unwrap());
    assert!(matches!(own.certify(&toss), Err(SolveError::NotOffered { .. })));
}

#[test]
fn extreme_numbers_have_bounds_or_errors() {
    let mut numbers = Numbers(11);
    let steppings = [("dop853", 1e-8), ("dopri5", 1e-6), ("dop853", 0.5)];
    let solvers =
        steppings.map(|(scheme, tolerance)| solver(Stepping::adaptive(scheme.parse().unwrap(), tolerance).unwrap()));
    for index in 0..1500 {
        let rate = Vector3::from_fn(|_, _| {
            let size = [0.0, 5e-324, 1e-310, 1e-160, 1e-139, 1e-30, 1.0, 1e300][numbers.below(8)];
            size * numbers.between(-1.0, 1.0)
        });
        let time = 50.0 * numbers.next() / rate.amax().max(1e-300);
        let ratio = [0.0, 1e-300, 0.3, 1.0, 2.0][numbers.below(5)];
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
        let launch = launch.with_tilt(numbers.between(-3.0, 3.0)).unwrap();
        let toss = Toss { coin: Coin::from_moments(1.0, ratio).unwrap(), launch };
        let found = solvers[index % 3].enclose(&toss).unwrap();
        let parts = [found.error_bound(), found.attitude_error_bound(), found.cos_tilt()];
        assert!(parts.iter().all(|part| part.is_finite()), "{toss:?}: {found:?}");
        assert!(index % 3 == 2 || found.error_bound() < 1e-2, "{toss:?}: {found:?}");
        assert!(shares(&found, &toss).into_iter().all(|share| share <= 1.0), "{toss:?}: {found:?}");
        let outcome = solvers[index % 3].certify(&toss).map(|found| found.outcome());
        assert_eq!(outcome, certify(&toss).map(exact::Certificate::outcome), "{toss:?}");
    }
}

/// Every state of the flight of a comparison, with one change, and its bound.
fn bound(toss: &Toss, change: impl Fn(&mut Accepted<6>)) -> f64 {
    let stepping = Stepping::adaptive(Scheme::DOP853, 1e-11).unwrap();
    let (flight, mut accepted) = solver(stepping).accepted(toss).unwrap();
    change(&mut accepted);
    Compared::new(toss, &flight, &accepted, SimdLevel::for_one_lane()).bound
}

/// What a wrong step is off counts in full: a turn, a turn of the rates, another size of the rates for the rest of the
/// flight, and a time. A change of the norm counts nothing.
#[test]
fn the_bound_grows_by_each_fault_of_a_step() {
    const FAULT: f64 = 1e-6;
    let toss = random(&mut Numbers(3), 30.0);
    let right = bound(&toss, |_| {});
    assert!(right < 1e-9);
    let from = |accepted: &Accepted<6>| accepted.states.len() / 2;
    let turned = |axis: usize| {
        bound(&toss, |accepted| {
            let from = from(accepted);
            for state in &mut accepted.states[from..] {
                // ½ (0, e) ⊗ P, the conjugate of -½ P* ⊗ (0, e).
                let mut about = [0.0; 3];
                about[axis] = -1.0;
                let [w, x, y, z] = half_product([state[0], -state[1], -state[2], -state[3]], about);
                [w, -x, -y, -z].into_iter().enumerate().for_each(|(part, moved)| state[part] += FAULT * moved);
            }
        })
    };
    for axis in 0..3 {
        // The coin turns in space before all later steps.
        let found = turned(axis);
        assert!((0.49 * FAULT..0.51 * FAULT).contains(&found), "{axis}: {found:e}");
    }
    let of_phase = bound(&toss, |accepted| {
        let from = from(accepted);
        for state in &mut accepted.states[from..] {
            (state[4], state[5]) = (state[4] - FAULT * state[5], state[5] + FAULT * state[4]);
        }
    });
    // The rates of later steps are other ones, so that the turns are off as well.
    assert!(of_phase > FAULT, "{of_phase:e}");
    let of_size = bound(&toss, |accepted| {
        let from = from(accepted);
        let state = &mut accepted.states[from];
        (state[4], state[5]) = ((1.0 + FAULT) * state[4], (1.0 + FAULT) * state[5]);
    });
    let flight = Flight::new(&toss).unwrap();
    let eta = 0.5 * (flight.rate.x * flight.rate.x + flight.rate.y * flight.rate.y).sqrt();
    assert!(of_size > FAULT * eta * flight.span(), "{of_size:e}");
    let longer = bound(&toss, |accepted| {
        let last = accepted.states.len() - 1;
        accepted.states.truncate(last);
        accepted.times.truncate(last);
    });
    assert!(longer > 1e-2, "{longer:e}");
    let scaled = bound(&toss, |accepted| {
        let from = from(accepted);
        accepted.states[from..].iter_mut().for_each(|state| (0..4).for_each(|part| state[part] *= 1.0 + FAULT));
    });
    assert!(scaled < 1.1 * right, "{scaled:e}");
}

/// A step that ends where the series does has the bound of the series, which measured jumps are far above elsewhere.
#[test]
fn a_step_without_a_jump_has_the_bound_of_its_series() {
    let rate = Vector3::new(0.7, -0.6, 1.1);
    let launch = Launch::new(rate, TimeOfFlight::Given(1.0)).unwrap();
    let toss = Toss { coin: Coin::from_moments(1.0, 1.5).unwrap(), launch };
    let flight = Flight::new(&toss).unwrap();
    let finest = solver(Stepping::adaptive(Scheme::TAYLOR, f64::EPSILON).unwrap());
    let landed = finest.propagate(&toss).unwrap().state;
    let [w, x, y, z] = landed.attitude.components();
    let end = [w, x, y, z, landed.rate.x, landed.rate.y].into();
    let start = [1.0, 0.0, 0.0, 0.0, rate.x, rate.y].into();
    let accepted = Accepted { times: vec![0.0, 1.0], states: vec![start, end], work: Work::default() };
    let found = Compared::new(&toss, &flight, &accepted, SimdLevel::for_one_lane()).bound;
    let q = 0.5 * rate.z;
    let plan = Plan::of_equal_steps(order(fastest(&flight, 0.5 * rate.z, q)), 1.0);
    let eta = 0.5 * (rate.x * rate.x + rate.y * rate.y).sqrt();
    let of_series = crate::defect::Steps { modulus: eta, spread: 0.0, half_z: 0.5 * rate.z, q, longest: 1.0 };
    let step = bounds(&plan, SimdLevel::for_one_lane(), &[of_series])[0];
    let sum = step.turn + step.rates + step.eta;
    assert!(found >= sum && found < 1.5 * sum, "{found:e}, {sum:e}");
}

#[test]
fn a_turn_of_the_rates_is_measured_against_a_turn_in_time() {
    // The rates of the step are twice as large, which is no turn, but too far off.
    assert_eq!(turned_off([0.6, 0.8], [0.0; 2], [1.2, 1.6], 0.0), f64::INFINITY);
    let off = |angle: f64, further: f64| {
        let (sin, cos) = angle.sin_cos();
        turned_off([0.6, 0.8], [0.0; 2], [0.6 * cos - 0.8 * sin, 0.8 * cos + 0.6 * sin], further)
    };
    approx::assert_relative_eq!(off(1e-6, 0.0), 1e-6, epsilon = 0.0, max_relative = 1e-8);
    approx::assert_relative_eq!(off(1e-6, 3e-6), 2e-6, epsilon = 0.0, max_relative = 1e-8);
    assert!(off(0.4, 0.0) > 0.4 && off(1e-7, 1e-7) < 1e-14);
    assert!(turned_off([0.6, 0.8], [1e-10, 0.0], [0.6, 0.8], 0.0) > 0.79e-10);
}

#[test]
fn the_fastest_terms_turn_with_half_of_all_rates() {
    let launch = Launch::new([3.0, 4.0, 1.0], TimeOfFlight::Given(1.0)).unwrap();
    let mut flight = Flight::new(&Toss { coin: Coin::DISC, launch }).unwrap();
    // 1, 4 and 8, whose squares are not twice as large, and 1.5 q.
    flight.rate = Vector3::new(2.0, 8.0, 1.0);
    assert_eq!(fastest(&flight, 6.0, 4.0), 9.0 + 6.0);
}

#[test]
fn the_order_is_the_smallest_that_leaves_less_than_a_rounding() {
    // 1/18! is 1.6e-16 and 1/20! 4e-19; u is 1.1e-16.
    assert_eq!([0.0, 1e-3, 1.0, LONGEST_PIECE, 40.0].map(order), [10, 10, 20, LARGEST_ORDER, LARGEST_ORDER]);
}
