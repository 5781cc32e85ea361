//! This file makes random scenes for the planner: questions about tosses as hands and machines make them, and about
//! spaces of such tosses. Each follows from a seed and an index alone, so a failing scene can be made again.

use std::f64::consts::PI;

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use sampling::{Coordinate, Space};
use toss::catalogue::CATALOGUE;
use toss::{Coin, CoinToss, InputError, Launch, Registry, Scene, TimeOfFlight, Vector3, Want};

use crate::measure::case::Case;

/// A scene about a toss.
#[derive(Debug, Clone)]
pub struct TossScene {
    /// Its kind: what is wanted, or `integrator` if the scene asks for one.
    pub kind: &'static str,
    /// The scene.
    pub scene: Scene,
    /// Its toss.
    pub case: Case,
}

/// The random numbers for the item `index` of the sequence that `seed` starts.
pub(super) fn stream(seed: u64, index: u64) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(index);
    rng
}

/// 10 to a power that is uniform between `low` and `high`.
fn decades(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    10f64.powf(rng.random_range(low..high))
}

/// Toss number `index` of the sequence that `seed` starts.
///
/// # Errors
/// Never: every toss is valid.
pub fn toss(seed: u64, index: u64) -> Result<Case, InputError> {
    random_toss(&mut stream(seed, index))
}

/// A random toss. The coin is from the catalogue or any other; the rates are up to 60 rad/s or, in a third of the
/// tosses, up to a limit between 0.1 and 1000 rad/s, some without spin and some with little wobble. Half of the
/// launches start horizontal. One in six lands at another height, one in six has a given time of flight.
fn random_toss(rng: &mut ChaCha8Rng) -> Result<Case, InputError> {
    let coin = match rng.random_range(0..3) {
        0 => CATALOGUE[rng.random_range(0..CATALOGUE.len())].coin()?,
        1 => Coin::from_moments(1.0, rng.random_range(1.9..2.0))?,
        _ => Coin::from_moments(1.0, rng.random_range(0.0..2.0))?,
    };
    let largest = if rng.random_range(0..3) == 0 { decades(rng, -1.0, 3.0) } else { 60.0 };
    let any = Vector3::from_fn(|_, _| rng.random_range(-largest..largest));
    let rate = match rng.random_range(0..6) {
        0 => Vector3::new(any.x, any.y, 0.0),
        1 => Vector3::new(0.1 * any.x, 0.1 * any.y, any.z),
        _ => any,
    };
    let tilt = if rng.random() { 0.0 } else { rng.random_range(0.0..PI) };
    let (speed, gravity) = (rng.random_range(1.0..6.0), 9.81);
    let time = match rng.random_range(0..6) {
        0 => TimeOfFlight::thrown(speed, gravity, Some(rng.random_range(-0.9..1.5) * speed * speed / (2.0 * gravity))),
        1 => TimeOfFlight::Given(decades(rng, -2.0, 1.0)),
        _ => TimeOfFlight::thrown(speed, gravity, None),
    };
    Ok(Case { toss: CoinToss { coin, launch: Launch::new(rate, time)?.with_tilt(tilt)? }, tilt })
}

/// A toss that differs from `case` by up to 1 % in each rate and in time. Its errors are of the same size on average,
/// but not the same.
///
/// # Errors
/// Never: every toss is valid.
pub fn neighbour(case: &Case, seed: u64, index: u64) -> Result<CoinToss, InputError> {
    let mut rng = stream(seed, index);
    let launch = case.toss.launch;
    let rate = launch.rate().map(|part| part * rng.random_range(0.99..1.01));
    let time = TimeOfFlight::Given(launch.flight_time() * rng.random_range(0.99..1.01));
    Ok(CoinToss { launch: Launch::new(rate, time)?.with_attitude(launch.attitude()), ..case.toss })
}

/// Scene number `index` of the sequence that `seed` starts. Of ten scenes three want an outcome, three cos θ, two an
/// attitude and one a trace, with accuracies from 1e-2 to 2e-15; the tenth asks for an integrator, with accuracies from
/// 1e-2 to 1e-11.
///
/// # Errors
/// Never: every scene is valid.
pub fn toss_scene(seed: u64, index: u64) -> Result<TossScene, InputError> {
    let mut rng = stream(seed, index);
    let case = random_toss(&mut rng)?;
    let kinds =
        ["outcome", "outcome", "outcome", "tilt", "tilt", "tilt", "attitude", "attitude", "trace", "integrator"];
    let kind = kinds[rng.random_range(0..kinds.len())];
    let wanted = if kind == "integrator" { kinds[rng.random_range(0..9)] } else { kind };
    let want = match wanted {
        "outcome" => Want::Outcome(case.toss.into()),
        "tilt" => Want::Tilt(case.toss.into()),
        "attitude" => Want::Attitude(case.toss.into()),
        _ => Want::Trace { toss: case.toss.into(), points: rng.random_range(2..8) },
    };
    let scene = if kind == "integrator" {
        let entries: Vec<_> = Registry::standard().entries().iter().filter(|entry| entry.integrates()).collect();
        let scheme = [None, Some("dop853"), Some("dopri5")][rng.random_range(0..3)];
        let solver = entries[rng.random_range(0..entries.len())].name();
        Scene::new(want, decades(&mut rng, -11.0, -2.0)).by(solver, scheme)
    } else {
        Scene::new(want, decades(&mut rng, -14.7, -2.0))
    };
    Ok(TossScene { kind, scene, case })
}

/// Space number `index` of the sequence that `seed` starts. Each rate and the tilt is a value or a range; four spaces
/// of five have a range of speeds.
///
/// # Errors
/// Never: every space is valid.
pub fn space(seed: u64, index: u64) -> Result<Space, InputError> {
    let mut rng = stream(seed, index);
    let mut range = |free: f64, from: f64, to: f64, width: f64| {
        let lo = rng.random_range(from..to);
        if rng.random_range(0.0..1.0) < free {
            format!("{lo}:{}", lo + rng.random_range(0.1..1.0) * width)
        } else {
            lo.to_string()
        }
    };
    let texts = [
        (Coordinate::RateX, range(0.6, 0.0, 40.0, 30.0)),
        (Coordinate::RateY, range(0.3, 0.0, 40.0, 30.0)),
        (Coordinate::RateZ, range(0.3, 0.0, 40.0, 30.0)),
        (Coordinate::Speed, range(0.8, 2.0, 4.0, 3.0)),
        (Coordinate::Tilt, range(0.2, 0.0, 0.5, 1.0)),
    ];
    let texts = texts.each_ref().map(|(of, text)| (*of, text.as_str()));
    let coin = if index.is_multiple_of(2) { Coin::PAPER } else { Coin::from_moments(1.0, 1.95)? };
    Space::parse(coin, &texts)
}

/// The accuracy that scene number `index` asks of a probability, from 1e-1 to 1e-3.
pub fn accuracy_of_a_probability(seed: u64, index: u64) -> f64 {
    decades(&mut stream(seed, index), -3.0, -1.0)
}
