//! Tests solvers that other crates bring, with wrong and broken ones. No answer of theirs may count as proven, and an
//! impossible answer (a panic, a NaN, a negative error estimate) must become a typed error that names the solver,
//! wherever solvers are used.

use blackbox::toss;
use toss::sampling::{Axis, Coordinate, Counts, Found, Plan, Rest, Sampler, Scrambled, Space};
use toss::{
    Coin, Error, ExactSolver, Landing, Outcome, Registry, Scene, Scheme, Settings, SolveError, Solver, SolverEntry,
    Stepping, Toss, Want, trace,
};

/// A wrong solver: the exact motion with heads and tails exchanged, and with an error estimate of 0.
#[derive(Clone, Copy)]
struct Liar;

const NAME: &str = "liar";
const OWN_SCHEME: Scheme = Scheme::new("guess", Some(1)).adaptive();

impl Solver for Liar {
    fn name(&self) -> &str {
        NAME
    }
    fn stepping(&self) -> Option<Stepping> {
        Stepping::adaptive(OWN_SCHEME, 1e-9).ok()
    }
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let landing = ExactSolver.land(toss)?;
        let cos_tilt = -landing.cos_tilt;
        Ok(landing.with_cos_tilt(cos_tilt).with_error(0.0))
    }
}

fn registry() -> Registry {
    let entry = SolverEntry::new(NAME, "lies", |_| Box::new(Liar)).with_schemes(&[OWN_SCHEME]);
    Registry::standard().with(entry).expect("a new name")
}

/// Settings with the liar's own scheme.
fn settings() -> Settings {
    Settings { stepping: Stepping::adaptive(OWN_SCHEME, 1e-9).expect("valid"), ..Settings::default() }
}

/// A space whose launches are solved in batches, and one in which the tilt varies, so that they are solved one by one.
fn spaces() -> [Space; 2] {
    let rates = Axis::range(1.0..=40.0).with_points(12);
    let builder = Space::builder(Coin::PAPER).rate_x(rates).rate_y(2.0).rate_z(Axis::range(1.0..=9.0).with_points(4));
    let builder = builder.speed(Axis::range(3.0..=5.0).with_points(9));
    [builder.clone(), builder.tilt(Axis::range(0.0..=0.1).with_points(2))]
        .map(|builder| builder.build().expect("valid"))
}

const COUNTED: [Plan; 3] =
    [Plan::Grid, Plan::Random { points: 400, seed: 1 }, Plan::Sobol(Scrambled { points: 512, scrambles: 8, seed: 1 })];

fn counts(sampler: &Sampler<'_>, space: &Space, plan: Plan) -> Counts {
    let Found::Counts(counts) = sampler.estimate(space, plan).expect("valid launches").found else {
        panic!("{plan:?} counts")
    };
    counts
}

#[test]
fn outcomes_of_a_wrong_solver_never_count_as_proven() {
    let backend = registry().backend(NAME, &settings()).unwrap();
    let one = toss(0.5, [1.0, 1.0, 2.5], 0.0, 0.6);
    let verdict = backend.verdict(&one, backend.solver().tilt(&one).unwrap()).unwrap();
    assert_eq!((verdict.outcome(), verdict.is_proven(), verdict.stage()), (Outcome::Tails, false, None));
    for (space, plan) in spaces().iter().flat_map(|space| COUNTED.map(|plan| (space, plan))) {
        for sampler in [Sampler::by(&Liar), backend.sampler()] {
            let lies = counts(&sampler, space, plan);
            let truth = counts(&Sampler::exact(), space, plan);
            assert_eq!((lies.heads(), lies.tails()), (truth.tails(), truth.heads()), "{plan:?}");
            assert_eq!((lies.are_certified(), lies.proven().total()), (false, 0), "{plan:?}");
            assert!(truth.are_certified(), "{plan:?}");
        }
    }
    let map = Sampler::by(&Liar).map(&spaces()[0], [Coordinate::RateX, Coordinate::RateZ], COUNTED[1]).unwrap();
    assert!(map.nodes.iter().any(|node| node.probability.is_some_and(|probability| probability < 0.5)));
}

#[test]
fn exact_speed_refuses_any_solver_but_the_exact_motion() {
    let error = Sampler::by(&Liar).estimate(&spaces()[0], Plan::ExactSpeed(Rest::Grid)).unwrap_err();
    assert_eq!((error.kind(), error.field()), ("input", Some("solver")));
    assert!(error.to_string().contains(NAME), "{error}");
}

#[test]
fn no_plan_takes_a_wrong_solver_although_its_error_estimate_is_zero() {
    let toss = toss(0.5, [1.0, 1.0, 2.5], 0.0, 0.6);
    let scene = Scene::new(Want::Attitude(toss), 1e-6).by("quaternion", None);
    assert!(scene.plan_with(&registry()).is_ok());
    for want in [Want::Outcome(toss), Want::Tilt(toss)] {
        let error = Scene::new(want, 1e-6).by(NAME, None).plan_with(&registry()).unwrap_err();
        assert_eq!(error.field(), Some("accuracy"));
        assert!(error.to_string().contains("what the integrator reaches at its finest tolerance"), "{error}");
    }
    // A plan without an integrator does not depend on the other solvers of the registry.
    let outcome = Scene::new(Want::Outcome(toss), 1e-6).plan_with(&registry()).unwrap();
    assert_eq!(outcome.choice.model.name, "outcome");
}

/// The ways in which a solver can break the contract of the trait.
#[derive(Clone, Copy, Debug)]
enum Misdeed {
    AnswersNan,
    Panics,
    ClaimsNan,
    ClaimsLessThanNothing,
}

/// The exact motion with one misdeed.
struct Broken(Misdeed);

impl Solver for Broken {
    fn name(&self) -> &str {
        "broken"
    }
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let landing = ExactSolver.land(toss)?.with_error(1e-9);
        Ok(match self.0 {
            Misdeed::AnswersNan => landing.with_cos_tilt(f64::NAN),
            Misdeed::Panics => panic!("out of order"),
            Misdeed::ClaimsNan => landing.with_error(f64::NAN),
            Misdeed::ClaimsLessThanNothing => landing.with_error(-1e-9),
        })
    }
}

fn assert_names_it<T>(result: Result<T, Error>, way: &str) {
    match result {
        Err(Error::Solve(source) | Error::Launch { source, .. }) => {
            assert_eq!(source.kind(), "misbehaved", "{way}");
            assert!(source.to_string().starts_with("solver 'broken' "), "{way}: {source}");
        }
        Err(other) => panic!("{way}: {other}"),
        Ok(_) => panic!("{way}: no error"),
    }
}

#[test]
fn an_impossible_answer_is_an_error_that_names_the_solver() {
    let all = [Misdeed::AnswersNan, Misdeed::Panics, Misdeed::ClaimsNan, Misdeed::ClaimsLessThanNothing];
    let one = toss(0.5, [1.0, 1.0, 2.5], 0.0, 0.6);
    for misdeed in all {
        let entry = SolverEntry::new("broken", "is out of order", move |_| Box::new(Broken(misdeed)));
        let backend = Registry::standard().with(entry).unwrap().backend("broken", &Settings::default()).unwrap();
        assert_names_it(backend.outcome(&one).map_err(Error::from), "outcome");
        assert_names_it(
            backend.solver().tilt(&one).and_then(|tilt| backend.verdict(&one, tilt)).map_err(Error::from),
            "verdict",
        );
        for (space, plan) in spaces().iter().flat_map(|space| COUNTED.map(|plan| (space, plan))) {
            assert_names_it(backend.sampler().estimate(space, plan), "estimate");
            assert_names_it(Sampler::by(&Broken(misdeed)).estimate(space, plan), "estimate by type");
        }
        let [space, _] = spaces();
        let axes = [Coordinate::RateX, Coordinate::RateZ];
        assert_names_it(Sampler::by(&Broken(misdeed)).map(&space, axes, COUNTED[1]), "map");
        assert_names_it(Sampler::by(&Broken(misdeed)).running_shares(&space, 3, 1), "running shares");
        let long = Sampler::by(&Broken(misdeed)).long_flight_shares(Coin::PAPER, &[1.0], (10, 1));
        assert_names_it(long, "long flights");
        assert_names_it(trace(&Broken(misdeed), &one, 3), "trace");
    }
}

#[test]
fn a_solver_cannot_take_the_name_of_another() {
    for name in ["exact", "gamma", "euler", "quaternion"] {
        let entry = SolverEntry::new(name, "not what it says", |_| Box::new(Liar));
        let error = Registry::standard().with(entry).unwrap_err();
        assert!(error.to_string().starts_with(&format!("solver = '{name}'")), "{error}");
    }
    // A solver whose own name differs from that of its entry is refused as well.
    let entry = SolverEntry::new("honest", "lies about its name", |_| Box::new(Liar));
    let error = Registry::standard().with(entry).unwrap().backend("honest", &Settings::default()).err().unwrap();
    assert!(error.to_string().contains("'honest'"), "{error}");
}

#[test]
fn a_solver_with_an_error_of_its_own_keeps_it_as_the_source() {
    use std::error::Error as _;

    struct Remote;
    impl Solver for Remote {
        fn name(&self) -> &str {
            "remote"
        }
        fn land(&self, _: &Toss) -> Result<Landing, SolveError> {
            Err(SolveError::failed("remote", std::io::Error::other("the line is dead")))
        }
    }
    let error = Sampler::by(&Remote).estimate(&spaces()[0], Plan::Grid).unwrap_err();
    assert_eq!(error.kind(), "failed");
    let (mut causes, mut cause) = (Vec::new(), error.source());
    while let Some(error) = cause {
        causes.push(error.to_string());
        cause = error.source();
    }
    assert!(causes.iter().any(|cause| cause == "the line is dead"), "{causes:?}");
}
