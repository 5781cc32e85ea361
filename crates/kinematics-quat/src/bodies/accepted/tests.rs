//! Tests of proofs by Runge-Kutta schemes of any rigid body.

use dynamics::{Body, Formulation, Launch, Outcome, Scheme, SolveError, Solver, TimeOfFlight, Work};
use exact::RigidMotion;

use super::*;
use crate::bodies::Enclosed;
use crate::lockstep::fly;
use crate::plan::Plans;
use crate::proven_bodies::tests::{KINDS, Numbers, shares, toss};
use crate::{QuaternionSolver, RigidSystem, half_product};

fn solver(stepping: Stepping) -> QuaternionSolver {
    QuaternionSolver::new(stepping, Formulation::default())
}

/// Every scheme with tolerances or steps (s), of which slow bodies take many.
fn steppings() -> Vec<Stepping> {
    let adaptive = |scheme| [1e-6, 1e-9, 1e-12].map(|tolerance| Stepping::adaptive(scheme, tolerance).unwrap());
    let adaptive = [Scheme::DOP853, Scheme::DOPRI5].into_iter().flat_map(adaptive);
    adaptive.chain(Scheme::RUNGE_KUTTA.map(|scheme| Stepping::fixed(scheme, 0.02).unwrap())).collect()
}

#[test]
fn errors_are_below_their_bounds_and_not_far_below() {
    for stepping in steppings() {
        let solver = solver(stepping);
        for (kind, (name, _)) in KINDS.iter().enumerate() {
            let (mut numbers, mut largest, mut bounded) = (Numbers(7), 0.0_f64, 0);
            for phase in [1.0, 10.0, 50.0, 300.0] {
                for index in 0..8 {
                    let toss = toss(kind, index, &mut numbers, phase);
                    let found = match solver.enclose_rigid(&toss) {
                        Err(SolveError::StepLimit { .. }) => continue,
                        found => found.unwrap(),
                    };
                    bounded += i32::from(found.error_bound() < 2.0);
                    for share in shares(&found, &toss) {
                        assert!(share <= 1.0, "{name}, {stepping}, {phase}: {share} of the bound, {toss:?}");
                        largest = largest.max(share);
                    }
                }
            }
            assert!(largest > 0.1 && bounded > 8, "{name}, {stepping}: at most {largest}, {bounded} have a bound");
        }
    }
}

#[test]
fn outcomes_are_those_of_the_exact_motion_or_undecided_within_the_bound() {
    let mut numbers = Numbers(13);
    for stepping in steppings() {
        for kind in 0..KINDS.len() {
            for index in 0..6 {
                let toss = toss(kind, index, &mut numbers, [3.0, 30.0, 100.0][index % 3]);
                let exact = RigidMotion::new(&toss).cos_tilt(toss.launch.time_of_flight()).unwrap();
                match solver(stepping).certify_rigid(&toss) {
                    Ok(found) => {
                        let within = found.cos_tilt().abs() <= found.error_bound();
                        let expected = if within { Outcome::Undecided } else { Outcome::of(exact, 1e-14) };
                        assert_eq!(found.outcome(), expected, "{toss:?}");
                    }
                    Err(SolveError::NotProven { .. } | SolveError::StepLimit { .. }) => {}
                    Err(error) => panic!("{error}"),
                }
            }
        }
    }
}

#[test]
fn landings_are_those_of_the_solver_and_the_same_at_every_simd_level() {
    let mut numbers = Numbers(5);
    let tosses: Vec<_> = (0..16).map(|index| toss(index / 2, index, &mut numbers, [5.0, 25.0][index % 2])).collect();
    for stepping in steppings() {
        let solver = solver(stepping);
        let alone: Vec<_> = tosses.iter().map(|toss| solver.certify_rigid(toss)).collect();
        for level in SimdLevel::all() {
            assert_eq!(solver.certify_all_rigid(&tosses, level), alone, "{stepping}, {}", level.name());
        }
        for toss in &tosses {
            let (enclosed, landing) = (solver.enclose_rigid(toss).unwrap(), solver.propagate_rigid(toss).unwrap());
            assert_eq!(enclosed.landing().state, landing.state);
            let (with, without) = (enclosed.work(), landing.work);
            assert_eq!((with.accepted_steps, with.rejected_steps), (without.accepted_steps, without.rejected_steps));
            let coefficients = (with.rhs_calls - without.rhs_calls) / without.accepted_steps;
            assert!((8..500).contains(&coefficients), "{stepping}: {coefficients} a step");
        }
    }
}

/// 80 steps of RK4, each compared with a series of this order, which leaves it whole.
#[test]
fn the_order_of_the_series_is_that_of_the_turn_in_the_longest_step() {
    let launch = Launch::new([1.9; 3], TimeOfFlight::Given(4.0)).unwrap();
    let toss = RigidToss { body: Body::from_moments([1.0, 1.4, 2.0]).unwrap(), launch };
    let solver = solver(Stepping::fixed(Scheme::RK4, 0.05).unwrap());
    let (with, without) = (solver.enclose_rigid(&toss).unwrap().work(), solver.propagate_rigid(&toss).unwrap().work);
    let (turn_rate, order) = (1.9 * 3f64.sqrt(), |turn| Plan::of_pieces_of_bodies(f64::EPSILON, turn).order as u64);
    assert_eq!(with.rhs_calls - without.rhs_calls, 80 * order(0.05 * turn_rate));
    assert!(order(0.05 * turn_rate) > order(0.05 / turn_rate) && order(0.05 * turn_rate) < order(0.05 + turn_rate));
}

/// A flight of a body away from its axes, with one change, and its bound.
fn bound(change: impl Fn(&mut Accepted<7>)) -> f64 {
    let launch = Launch::new([1.0, 0.3, 0.5], TimeOfFlight::Given(30.0)).unwrap();
    let toss = RigidToss { body: Body::from_moments([1.0, 1.4, 2.0]).unwrap(), launch };
    let flight = RigidFlight::new(&toss).unwrap();
    let stepping = Stepping::adaptive(Scheme::DOP853, 1e-11).unwrap();
    let mut accepted = RigidSystem::integrated(&flight, &stepping).unwrap();
    change(&mut accepted);
    compared(&toss, &flight, &stepping, &accepted, SimdLevel::for_one_lane()).0.unwrap().turn
}

#[test]
fn the_bound_grows_by_each_fault_of_a_step() {
    const FAULT: f64 = 1e-7;
    let right = bound(|_| {});
    assert!(right < 1e-9, "{right:e}");
    for axis in 0..3 {
        let turned = bound(|accepted| {
            let from = accepted.states.len() / 2;
            for state in &mut accepted.states[from..] {
                // ½ (0, e) ⊗ P, the conjugate of -½ P* ⊗ (0, e).
                let mut about = [0.0; 3];
                about[axis] = -1.0;
                let [w, x, y, z] = half_product([state[0], -state[1], -state[2], -state[3]], about);
                [w, -x, -y, -z].into_iter().enumerate().for_each(|(part, moved)| state[part] += FAULT * moved);
            }
        });
        assert!((0.49 * FAULT..0.55 * FAULT).contains(&turned), "{axis}: {turned:e}");
        // Rates that are off at the end of one step: the shift in time that this may be, at half the speed across.
        let jumped = bound(|accepted| {
            let from = accepted.states.len() / 2;
            accepted.states[from][4 + axis] += FAULT;
        });
        assert!(jumped > 0.3 * FAULT, "{axis}: {jumped:e}");
    }
    let scaled = bound(|accepted| {
        let from = accepted.states.len() / 2;
        accepted.states[from..].iter_mut().for_each(|state| (0..4).for_each(|part| state[part] *= 1.0 + FAULT));
    });
    assert!(scaled < 1.1 * right, "{scaled:e}");
    let shorter = bound(|accepted| {
        let last = accepted.states.len() - 1;
        accepted.states.truncate(last);
        accepted.times.truncate(last);
    });
    assert!(shorter < 1.1 * right, "what is left out counts as strayed, not in the turn");
}

#[test]
fn extreme_numbers_have_bounds_or_errors() {
    let mut numbers = Numbers(11);
    let tolerances = [(Scheme::DOP853, 1e-9), (Scheme::DOPRI5, 1e-6), (Scheme::DOP853, 0.5)];
    let solvers = tolerances.map(|(scheme, tolerance)| solver(Stepping::adaptive(scheme, tolerance).unwrap()));
    let sizes = [0.0, 5e-324, 1e-310, 1e-160, 1e-30, 1.0, 1e30, 1e300];
    for index in 0..1500 {
        let mut size = || sizes[(8.0 * numbers.next()) as usize] * numbers.between(-1.0, 1.0);
        let (rate, thin) = ([size(), size(), size()], size().abs());
        let largest = rate.iter().fold(0.0_f64, |most: f64, part: &f64| most.max(part.abs()));
        let time = TimeOfFlight::Given(50.0 * numbers.next() / largest.max(1e-300));
        let moments = [[thin, 1.0, 1.0], [1.0, 2.0, 2.5], [thin.min(1.0), 1.0, 1.0 + 0.5 * thin.min(1.0)]][index % 3];
        let Ok(body) = Body::from_moments(moments) else { continue };
        let toss = RigidToss { body, launch: Launch::new(rate, time).unwrap() };
        let Ok(found) = solvers[index / 3 % 3].enclose_rigid(&toss) else { continue };
        let parts = [found.error_bound(), found.attitude_error_bound(), found.cos_tilt()];
        assert!(parts.iter().all(|part| part.is_finite()), "{toss:?}: {found:?}");
        assert!(shares(&found, &toss).into_iter().all(|share| share <= 1.0), "{toss:?}");
    }
    for about in 0..3 {
        let mut rate = [0.0; 3];
        rate[about] = 300.1;
        let launch = Launch::new(rate, TimeOfFlight::Given(1.0)).unwrap();
        let found = solvers[0].enclose_rigid(&RigidToss { body: Body::from_moments([1.0, 2.0, 2.5]).unwrap(), launch });
        assert!(found.unwrap().attitude_error_bound() < 1e-6, "a steady turn about axis {about} has a bound");
    }
}

/// A step that ends where the series does, in several pieces, has the bound of a flight by these series.
#[test]
fn a_step_without_a_jump_has_the_bound_of_its_series() {
    let rates = [1.0, 0.3, 0.5];
    let launch = Launch::new(rates, TimeOfFlight::Given(20.0)).unwrap();
    let toss = RigidToss { body: Body::from_moments([1.0, 1.4, 2.0]).unwrap(), launch };
    let flight = RigidFlight::new(&toss).unwrap();
    let stepping = Stepping::fixed(Scheme::RK4, 20.0).unwrap();
    let plan = Plan::of_pieces_of_bodies(f64::EPSILON, 20.0);
    let mut landed = None;
    let plans = Plans { short: plan, long: plan };
    fly::<Enclosed>(&plans, &[toss], SimdLevel::for_one_lane(), |_, found| landed = found.ok());
    let landed = landed.unwrap();
    let ([w, x, y, z], by_series) = (landed.turn, landed.enclosed.unwrap().turn);
    let start = [1.0, 0.0, 0.0, 0.0, rates[0], rates[1], rates[2]].into();
    let end = [w, x, y, z, landed.rate.x, landed.rate.y, landed.rate.z].into();
    let accepted = Accepted { times: vec![0.0, 20.0], states: vec![start, end], work: Work::default() };
    let (found, coefficients) = compared(&toss, &flight, &stepping, &accepted, SimdLevel::for_one_lane());
    assert_eq!(coefficients, landed.work.rhs_calls);
    assert!(landed.work.accepted_steps > 8, "so that the last piece, which counts twice, is a small part");
    let found = found.unwrap().turn;
    assert!((1.0..1.4).contains(&(found / by_series)), "{found:e}, {by_series:e}");
}
