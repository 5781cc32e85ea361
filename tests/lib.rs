//! Functions that the tests across crates share: random tosses, the solvers of the registry, and the errors that are
//! allowed. Solvers and schemes come from the registry, so that a new solver is tested by every test.

use dynamics::Phases;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use toss::{
    Body, Coin, ExactMotion, Launch, Registry, Scheme, Settings, Solver, SolverEntry, Stepping, TimeOfFlight, Toss,
};

/// Tolerance of the adaptive schemes under test.
pub const TOLERANCE: f64 = 1e-11;

/// The settings of the property tests: the same cases in every run, and more of them if `PROPTEST_CASES` says so.
pub fn config() -> ProptestConfig {
    let cases = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok()).unwrap_or(96);
    ProptestConfig { cases, failure_persistence: None, rng_seed: RngSeed::Fixed(1), ..ProptestConfig::default() }
}

/// All entries of the registry.
pub fn entries() -> &'static [SolverEntry] {
    Registry::standard().entries()
}

/// The entries of the registry that step through time.
pub fn integrators() -> impl Iterator<Item = &'static SolverEntry> {
    entries().iter().filter(|entry| entry.integrates())
}

/// Every solver of the registry, each integrator by every adaptive scheme.
pub fn solvers() -> Vec<Box<dyn Solver>> {
    let mut solvers = Vec::new();
    for entry in entries() {
        let schemes = if entry.integrates() { entry.schemes() } else { &[Scheme::DOP853] };
        for scheme in schemes.iter().filter(|scheme| scheme.is_adaptive()) {
            let stepping = Stepping::adaptive(*scheme, TOLERANCE).expect("valid");
            solvers.push(entry.solver(&Settings { stepping, ..Settings::default() }).expect("an offered scheme"));
        }
    }
    solvers
}

/// Name and scheme of a solver, for the messages of failing tests.
pub fn name(solver: &dyn Solver) -> String {
    format!("{} {:?}", solver.name(), solver.stepping().map(|by| by.scheme().name()))
}

/// The error of cos θ that is allowed on `toss`: the solver's own estimate, and what rounding the inputs of a related
/// toss can change. θ is the angle between the normal and the vertical. It is infinite where a solver estimates no error,
/// which is allowed next to an unstable turn of a body with I1 ≠ I2 alone.
pub fn tilt_error(solver: &dyn Solver, toss: &Toss) -> f64 {
    let Phases { largest, growth } = Phases::new(toss).expect("the tosses of the tests are short");
    let turned = if toss.coin().is_some() { phase(toss) } else { largest };
    let estimate = solver.land(toss).expect("the solver lands it").error;
    assert!(estimate.is_some() || toss.coin().is_none(), "{} has no error estimate for a coin", name(solver));
    estimate.unwrap_or(f64::INFINITY) + 4.0 * f64::EPSILON * (2.0 + turned) * growth
}

/// The error of an attitude (rad) that is allowed: ten times that of cos θ, because an error of the attitude shows in
/// cos θ only in part where cos θ is near ±1.
pub fn attitude_error(solver: &dyn Solver, toss: &Toss) -> f64 {
    10.0 * tilt_error(solver, toss)
}

/// The phase of a toss (rad): how far its motion turns.
pub fn phase(toss: &Toss) -> f64 {
    ExactMotion::new(toss).phase(toss.launch.flight_time()).expect("the tosses of the tests are short")
}

/// A toss from plain numbers: k = I3/I1, body rate (rad/s), tilt at launch (rad) and time of flight (s).
pub fn toss(k: f64, rate: [f64; 3], tilt: f64, time: f64) -> Toss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).and_then(|launch| launch.with_tilt(tilt));
    Toss::new(Coin::from_moments(1.0, k).expect("valid"), launch.expect("valid"))
}

/// The same toss with another time of flight (s).
pub fn lasting(toss: &Toss, time: f64) -> Toss {
    let launch = Launch::new(toss.launch.rate(), TimeOfFlight::Given(time)).expect("valid");
    Toss { launch: launch.with_attitude(toss.launch.attitude()), ..*toss }
}

prop_compose! {
    /// Tosses of all coins from rod to disc and from all tilts. Special values (k of 0, 1/2, 1 and 2; tilts of
    /// 0, π/2, π and tiny ones) are more likely than all other values together.
    pub fn tosses()(
        k in prop_oneof![Just(0.0), Just(0.5), Just(1.0), Just(2.0), 0.0..2.0],
        rate_x in rates(), rate_y in rates(), rate_z in rates(),
        tilt in prop_oneof![Just(0.0), Just(1e-300), Just(1e-16), Just(1e-8), Just(std::f64::consts::FRAC_PI_2),
                            Just(std::f64::consts::PI), 0.0..std::f64::consts::PI],
        time in 0.0..1.5,
    ) -> Toss {
        toss(k, [rate_x, rate_y, rate_z], tilt, time)
    }
}

prop_compose! {
    /// Bodies with mass at random distances from three planes, plates and rods among them.
    pub fn bodies()(parts in prop::array::uniform3(prop_oneof![1 => Just(1e-9), 1 => Just(0.5), 6 => 0.01..1.0])) -> Body {
        let [a, b, c]: [f64; 3] = parts;
        Body::from_moments([b + c, c + a, a + b]).expect("a body")
    }
}

prop_compose! {
    /// Tosses of any rigid body for a few turns, from any tilt.
    pub fn body_tosses()(
        body in bodies(), x in rates(), y in rates(), z in rates(),
        tilt in prop_oneof![Just(0.0), Just(std::f64::consts::PI), 0.0..std::f64::consts::PI],
        time in 0.0..0.5,
    ) -> Toss {
        let launch = Launch::new([x, y, z], TimeOfFlight::Given(time)).expect("finite");
        Toss::new(body, launch.with_tilt(tilt).expect("finite"))
    }
}

/// The toss of a coin and that of any body.
pub fn coin_and_body() -> impl Strategy<Value = [Toss; 2]> {
    (tosses(), body_tosses()).prop_map(<[Toss; 2]>::from)
}

/// Components of the body rate of up to 60 rad/s; one in eight is zero and one in eight is tiny.
pub fn rates() -> impl Strategy<Value = f64> {
    prop_oneof![1 => Just(0.0), 1 => Just(1e-9), 6 => -60.0..60.0]
}

/// Compiles and runs the Rust code of README.md as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// The Rust of the page for authors of solvers compiles.
#[cfg(doctest)]
#[doc = include_str!("../docs/your-solver.md")]
pub struct YourSolver;
