//! These tests check properties that all methods of sampling share: results that do not depend on threads,
//! agreement with each other, and errors. They use the public interface alone.

use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use dynamics::{Coin, Error, Landing, SolveError, Solver, Toss};
use exact::ExactSolver;
use sampling::Coordinate::{Drop, RateX, RateY, RateZ, Speed};
use sampling::{Found, Interval, IntervalKind, Plan, Rest, Sampler, Scrambled, Space, named_space};

fn space(texts: [&str; 4]) -> Space {
    let [x, y, z, speed] = texts;
    Space::parse(Coin::PAPER, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed)]).expect("a valid space")
}

const PLANS: [Plan; 5] = [
    Plan::Grid,
    Plan::Random { points: 30_001, seed: 3 },
    Plan::Sobol(Scrambled { points: 40_000, scrambles: 8, seed: 3 }),
    Plan::ExactSpeed(Rest::Grid),
    Plan::ExactSpeed(Rest::Sobol(Scrambled { points: 40_000, scrambles: 8, seed: 3 })),
];

#[test]
fn estimates_have_the_same_bits_for_any_number_of_threads() {
    let space = named_space("paper-fig4").unwrap();
    for plan in PLANS.into_iter().chain([Plan::Enclosure { accuracy: 1e-9 }]) {
        let estimates = [1, 2, 8].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Sampler::exact().estimate(&space, plan)).unwrap()
        });
        assert!(estimates.iter().all(|estimate| *estimate == estimates[0]), "{estimates:?}");
    }
}

#[test]
fn progress_adds_up_to_the_number_of_launches() {
    for (name, plan) in ["paper-fig4", "tails"].into_iter().flat_map(|name| PLANS.map(|plan| (name, plan))) {
        let space = named_space(name).unwrap();
        let done = AtomicU64::new(0);
        let found = Sampler::exact()
            .on_progress(&|more| _ = done.fetch_add(more, Ordering::Relaxed))
            .estimate(&space, plan)
            .unwrap();
        assert_eq!((done.into_inner(), found.points), (found.points, plan.points(&space).unwrap()));
    }
}

/// Each interval that is reported is narrower than those before, and the last is the answer.
#[test]
fn an_enclosure_reports_how_it_narrows() {
    let reported = Mutex::new(Vec::new());
    let narrowed = |interval: Interval| reported.lock().unwrap().push(interval);
    let plan = Plan::Enclosure { accuracy: 1e-7 };
    let found = Sampler::exact().on_narrowing(&narrowed).estimate(&named_space("paper-fig4").unwrap(), plan).unwrap();
    let reported = reported.into_inner().unwrap();
    assert!(reported.len() >= 2 && reported.is_sorted_by(|one, next| one.width() > next.width()), "{reported:?}");
    assert_eq!(reported.last(), found.interval.as_ref());
}

#[test]
fn all_methods_agree_on_the_same_space() {
    let space = named_space("paper-fig4").unwrap();
    // The ends of a grid have the same weight as its inner points, which shifts its share by some 1e-3.
    let plans = PLANS.into_iter().chain([Plan::Enclosure { accuracy: 1e-9 }]);
    for (plan, within) in plans.zip([2e-3, 1e-2, 1e-3, 1e-3, 1e-4, 2e-7]) {
        let found = Sampler::exact().estimate(&space, plan).unwrap();
        assert!((found.probability - 0.661_452).abs() < within, "{plan:?}: {found:?}");
        assert!(found.interval.is_none_or(|interval| interval.contains(found.probability)));
    }
}

#[test]
fn intervals_of_certain_outcomes_have_a_width_only_if_points_were_sampled() {
    for (name, probability) in [("cheated", 1.0), ("tails", 0.0)] {
        let space = named_space(name).unwrap();
        for plan in PLANS {
            let found = Sampler::exact().estimate(&space, plan).unwrap();
            assert_eq!(found.probability, probability, "{name} {plan:?}");
            let width = found.interval.map(|interval| interval.hi - interval.lo);
            match plan {
                Plan::Grid => assert_eq!(width, None),
                Plan::ExactSpeed(_) => {
                    assert_eq!(found.points, 1, "nothing is free but the speed");
                    assert!(width.unwrap() < 1e-13 && found.interval_kind == IntervalKind::Rounding);
                }
                _ => assert!(width.unwrap() > 5e-5 && width.unwrap() < 2e-4, "{width:?}"),
            }
        }
    }
}

#[test]
fn exact_speed_has_the_interval_of_independent_launches_if_all_points_agree() {
    // ψ < 45° for all launches, so that all land heads.
    let space = space(["0:10", "x", "60", "3:5"]);
    let plan = Plan::ExactSpeed(Rest::Sobol(Scrambled::new(4096, 1)));
    let found = Sampler::exact().estimate(&space, plan).unwrap();
    assert_eq!((found.probability, found.interval_kind), (1.0, IntervalKind::Unanimous));
    assert!((0.9989..0.9992).contains(&found.interval.unwrap().lo), "{found:?}");
}

#[test]
fn a_range_of_speeds_has_the_weighted_mean_of_its_parts() {
    let probability = |speeds: &str| {
        let found = Sampler::exact().estimate(&space(["3", "2", "1", speeds]), PLANS[3]).unwrap();
        found.probability
    };
    let parts = 0.25 * probability("3:3.5") + 0.75 * probability("3.5:5");
    assert!((probability("3:5") - parts).abs() < 1e-14);
    let heads = |speeds: &str| {
        let grid = Sampler::exact().estimate(&space(["3", "2", "1", speeds]), Plan::Grid).unwrap();
        let Found::Counts(counts) = grid.found else { panic!("a grid counts") };
        counts.heads()
    };
    assert_eq!(heads("3:5:201"), heads("3:4:101") + heads("4.01:5:100"));
}

#[test]
fn rejects_invalid_plans_before_any_launch_is_solved() {
    let fig4 = named_space("paper-fig4").unwrap();
    let scrambled = |points, scrambles| Scrambled { points, scrambles, seed: 1 };
    for plan in [
        Plan::Random { points: 0, seed: 1 },
        Plan::Sobol(scrambled(0, 8)),
        Plan::Sobol(scrambled(1001, 8)),
        Plan::Sobol(scrambled(1000, 0)),
        Plan::Sobol(scrambled(1 << 40, 8)),
        Plan::ExactSpeed(Rest::Sobol(scrambled(7, 8))),
    ] {
        let refused = Sampler::exact().on_progress(&|_| panic!("nothing was to be done")).estimate(&fig4, plan);
        assert!(matches!(&refused, Err(Error::Input(error)) if error.field() == "points"), "{refused:?}");
    }
    let no_grid = space(["0:1", "x", "7", "3:5"]);
    for plan in [Plan::Grid, Plan::ExactSpeed(Rest::Grid)] {
        let refused = Sampler::exact().estimate(&no_grid, plan);
        assert!(matches!(&refused, Err(Error::Input(error)) if error.field() == "rate x [rad/s]"));
    }
}

/// A solver that fails for every speed above 4 m/s.
struct Fragile;
impl Solver for Fragile {
    fn name(&self) -> &str {
        "fragile"
    }
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let time = toss.launch.flight_time();
        if time > 8.0 / 9.81 { Err(SolveError::NotFinite { time }) } else { ExactSolver.land(toss) }
    }
}

#[test]
fn an_estimate_with_failing_launches_is_the_error_of_the_first() {
    let space = space(["1", "1", "1", "3:5:20001"]);
    for threads in [1, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let error = pool.install(|| Sampler::by(&Fragile).estimate(&space, Plan::Grid)).unwrap_err();
        assert!(matches!(error, Error::Launch { index: 10_001, .. }), "{error}");
    }
}

/// A solver that fails for the 10th toss that it solves. On one thread this is launch 9 of the plan.
#[derive(Default)]
struct Worn(AtomicU64);
impl Solver for Worn {
    fn name(&self) -> &str {
        "worn"
    }
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let tosses = self.0.fetch_add(1, Ordering::Relaxed);
        if tosses == 9 { Err(SolveError::NotFinite { time: 0.0 }) } else { ExactSolver.land(toss) }
    }
}

#[test]
fn launches_are_numbered_across_scrambles() {
    let plan = Plan::Sobol(Scrambled { points: 32, scrambles: 8, seed: 1 });
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let worn = Worn::default();
    let error = pool.install(|| Sampler::by(&worn).estimate(&named_space("tails").unwrap(), plan)).unwrap_err();
    assert!(matches!(error, Error::Launch { index: 9, .. }), "{error}");
}

/// Exact-speed uses the exact motion, so that a solver would have no effect.
#[test]
fn exact_speed_rejects_a_solver() {
    let error = Sampler::by(&Fragile).estimate(&named_space("tails").unwrap(), PLANS[3]).unwrap_err();
    assert_eq!((error.kind(), error.field()), ("input", Some("solver")));
    assert!(error.to_string().contains("'fragile'"), "{error}");
}

/// A coin that is thrown flat, end over end at ω, shows heads while cos ωT > 0. It lands after T if it falls by ½ g T² - v0 T,
/// so that the share of an interval of drops is known.
#[test]
fn a_drop_that_varies_has_the_share_of_its_heights() {
    let [rate, speed, gravity, lowest] = [20.0, 2.0, 9.81, 1.0];
    let fallen = |time: f64| (0.5 * gravity * time * time - speed * time).clamp(0.0, lowest);
    let side = |face: i32| fallen((f64::from(face) + 0.5) * std::f64::consts::PI / rate);
    let exact = (1..20).map(|turn| side(2 * turn) - side(2 * turn - 1)).sum::<f64>() / lowest;
    assert!((0.3..0.7).contains(&exact), "{exact}");
    let texts = [(RateX, "20"), (RateY, "0"), (RateZ, "0"), (Speed, "2"), (Drop, "0:1:100001")];
    let space = Space::parse(Coin::PAPER, &texts).unwrap();
    let plans = [Plan::Grid, PLANS[1], PLANS[2]];
    for (plan, within) in plans.into_iter().zip([2e-5, 1e-2, 1e-4]) {
        let found = Sampler::exact().estimate(&space, plan).unwrap();
        assert!((found.probability - exact).abs() < within, "{plan:?}: {found:?}, not {exact}");
    }
    for plan in [PLANS[3], Plan::Enclosure { accuracy: 1e-3 }] {
        assert_eq!(Sampler::exact().estimate(&space, plan).unwrap_err().field(), Some("drop [m]"));
    }
}
