//! Counts memory allocations, because an allocation per step or per toss would dominate the cost. The exact motion and
//! batches allocate nothing; an integrator allocates a number of times that grows with the logarithm of its steps.

use allocation_counter::measure;
use blackbox::integrators;
use toss::{
    Attitude, Batch, Coin, ExactSolver, Formulation, Outcome, QuaternionSolver, Scheme, Settings, SimdLevel, Solver,
    Stepping, TAYLOR, Tosses,
};

/// The allowed number of allocations: 4 for the stages of the scheme, and those of two vectors of results that double
/// their size when they are full.
fn allowed(steps: u64) -> u64 {
    4 + 2 * u64::from(steps.next_power_of_two().ilog2())
}

#[test]
fn the_exact_motion_allocates_nothing() {
    let toss = blackbox::toss(0.5, [9.0, 4.0, 3.0], 0.2, 1.0);
    let count = measure(|| {
        ExactSolver.land(&toss).unwrap();
        ExactSolver.tilt(&toss).unwrap();
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
            let batch = Batch::new(tosses);
            batch.cos_tilts(&mut numbers).unwrap();
            batch.attitudes(quaternions.each_mut().map(|column| &mut column[..])).unwrap();
            batch.outcomes(&mut outcomes).unwrap();
            assert_eq!(batch.count().unwrap().total(), 1000);
        });
        assert_eq!(count.count_total, 0);
    }
}

#[test]
fn taylor_series_allocate_only_the_vector_of_results() {
    let tosses = [blackbox::toss(0.5, [9.0, 4.0, 3.0], 0.2, 20.0); 20];
    let solver = QuaternionSolver::new(Stepping::adaptive(TAYLOR, 1e-12).unwrap(), Formulation::default());
    assert_eq!(measure(|| assert!(solver.land(&tosses[0]).is_ok())).count_total, 0);
    assert_eq!(measure(|| assert_eq!(solver.land_all(&tosses, SimdLevel::widest()).len(), 20)).count_total, 1);
}

#[test]
fn allocations_of_integrators_grow_with_the_logarithm_of_the_steps() {
    let toss = blackbox::toss(0.5, [9.0, 4.0, 3.0], 0.2, 20.0);
    let adaptive = [Scheme::DOP853, Scheme::DOPRI5].map(|scheme| Stepping::adaptive(scheme, 1e-12).unwrap());
    let all = [adaptive[0], adaptive[1], Stepping::fixed(Scheme::RK4, 1e-3).unwrap()];
    for entry in integrators() {
        for stepping in all {
            let solver = entry.solver(&Settings { stepping, ..Settings::default() }).unwrap();
            let mut steps = 0;
            let count = measure(|| {
                let work = solver.land(&toss).unwrap().work;
                steps = work.accepted_steps;
            });
            assert!(steps > 10, "{} {stepping:?}", entry.name());
            assert!(
                count.count_total <= allowed(steps),
                "{} {stepping:?}: {} for {steps}",
                entry.name(),
                count.count_total
            );
        }
    }
}

/// A flight of a Runge-Kutta scheme allocates, so that a second, needless flight for cos θ or its error estimate shows here.
#[test]
fn cos_tilt_with_its_error_estimate_takes_no_more_allocations_than_the_landing() {
    let toss = blackbox::toss(0.5, [9.0, 4.0, 3.0], 0.2, 2.0);
    let stepping = |scheme: &Scheme| {
        let adaptive = scheme.is_adaptive().then(|| Stepping::adaptive(*scheme, 1e-10));
        adaptive.unwrap_or_else(|| Stepping::fixed(*scheme, 1e-3)).unwrap()
    };
    for entry in integrators() {
        for stepping in entry.schemes().iter().map(stepping) {
            let solver = entry.solver(&Settings { stepping, ..Settings::default() }).unwrap();
            let landing = measure(|| _ = solver.land(&toss).unwrap()).count_total;
            let tilt = measure(|| _ = solver.tilt(&toss).unwrap()).count_total;
            assert!(tilt <= landing, "{} {stepping:?}: {tilt}, a landing {landing}", entry.name());
        }
    }
}
