//! No integrator allocates memory per step: what it allocates grows with the logarithm of the number of steps. Batches and
//! the exact motion allocate none.

use allocation_counter::measure;
use toss::batch::{Filtered, Tosses};
use toss::lanes::Path;
use toss::{Attitude, Coin, Formulation, Method, Outcome, QuaternionSolver, SOLVERS, Scheme, Settings, Solver};

/// The stages, and two vectors of results that double when full.
fn allowed(steps: u64) -> u64 {
    4 + 2 * u64::from(steps.next_power_of_two().ilog2())
}

#[test]
fn the_exact_motion_allocates_nothing() {
    let toss = blackbox::toss(0.5, [9.0, 4.0, 3.0], 0.2, 1.0);
    let solver = (SOLVERS[0].build)(&Settings::default());
    assert_eq!(solver.name(), "exact");
    let count = measure(|| {
        solver.propagate(&toss).unwrap();
        solver.outcome(&toss).unwrap();
    });
    assert_eq!(count.count_total, 0);
}

#[test]
fn a_batch_allocates_nothing() {
    let (column, mut numbers, mut outcomes) = ([3.5; 1000], [0.0; 1000], [Outcome::Undecided; 1000]);
    let mut quaternions = [[0.0; 1000]; 4];
    for attitude in [Attitude::IDENTITY, Attitude::about_x(0.7)] {
        let tosses = Tosses::new(Coin::PAPER, attitude, 9.81, [&column; 3].map(|column| &column[..]), &column).unwrap();
        let count = measure(|| {
            tosses.cos_tilts(&mut numbers).unwrap();
            tosses.attitudes(quaternions.each_mut().map(|column| &mut column[..])).unwrap();
            tosses.outcomes(&mut outcomes).unwrap();
            let Filtered { heads, tails } = tosses.count(|_| ()).unwrap();
            assert_eq!(heads + tails, 1000);
        });
        assert_eq!(count.count_total, 0);
    }
}

#[test]
fn taylor_series_allocate_nothing_but_their_results() {
    let tosses = [blackbox::toss(0.5, [9.0, 4.0, 3.0], 0.2, 20.0); 20];
    let solver = QuaternionSolver::new(Method::adaptive(Scheme::Taylor, 1e-12).unwrap(), Formulation::default());
    assert_eq!(measure(|| assert!(solver.propagate(&tosses[0]).is_ok())).count_total, 0);
    assert_eq!(measure(|| assert_eq!(solver.propagate_all(&tosses, Path::widest()).len(), 20)).count_total, 1);
}

#[test]
fn integrators_allocate_with_the_logarithm_of_the_steps() {
    let toss = blackbox::toss(0.5, [9.0, 4.0, 3.0], 0.2, 20.0);
    let adaptive = [Scheme::Dop853, Scheme::Dopri5].map(|scheme| Method::adaptive(scheme, 1e-12).unwrap());
    let methods = [adaptive[0], adaptive[1], Method::fixed(Scheme::Rk4, 1e-3).unwrap()];
    for entry in SOLVERS.iter().filter(|entry| entry.integrates()) {
        for method in methods {
            let solver = (entry.build)(&Settings { method, ..Settings::default() });
            let mut steps = 0;
            let count = measure(|| {
                let work = solver.propagate(&toss).unwrap().work;
                steps = work.accepted_steps;
            });
            assert!(steps > 10, "{} {method:?}", entry.name);
            assert!(
                count.count_total <= allowed(steps),
                "{} {method:?}: {} for {steps}",
                entry.name,
                count.count_total
            );
        }
    }
}
