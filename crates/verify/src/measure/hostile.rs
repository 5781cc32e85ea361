//! Long flights at fine tolerances, of the coins and bodies and at the rates at which rounding adds up: there it is all of
//! the error of an integrator, and errors of the steps need not cancel. Random launches hardly ever are of this kind.
//!
//! Rounding adds up where every step rounds alike: the rate of a coin whose moments are nearly equal, or of one that turns
//! about a line in its face, changes by less than its last digit in a step. Rods, discs and bodies with nearly equal
//! moments are here too, and rates with components of different sizes.

use dynamics::Toss;
use rand::RngExt;
use rand::rngs::ChaCha8Rng;
use toss::{Coin, Formulation, InputError, Scheme, SolverEntry, Stepping, TimeOfFlight, Vector3};

use super::effort::Effort;
use super::families::{FAMILIES, flown_for};
use super::subject::{Subject, by_kind};
use super::tosses::{decades, level_or_tilted, one, tossed};

const SEED: u64 = 20_270_115;

/// The finest tolerance that takes part: 2^-52, rounded up.
const FINEST: f64 = 2.3e-16;

/// Steps of schemes without a tolerance, in units of 1/|ω|.
const STEPS: [f64; 4] = [0.1, 0.03, 0.01, 0.003];

/// The longest flight (rad).
const LONGEST: f64 = 1e6;

pub(super) struct Flight {
    pub(super) toss: Toss,
    pub(super) by: Subject,
}

/// One flight in a hundred takes up to so many steps, which is as many as the schemes of this workspace take.
const MOST_STEPS: f64 = 9e5;

/// The random numbers for the flight `index` of a kind.
fn stream(kind: u64, index: u64) -> ChaCha8Rng {
    super::tosses::stream(SEED + kind, index)
}

/// The flights of a solver and its `scheme`: of coins and of each family of bodies.
pub(super) fn flights(entry: &SolverEntry, scheme: Scheme, effort: Effort) -> Result<Vec<Flight>, InputError> {
    // The last ones are 100 000 of the solvers and schemes of this workspace.
    let (coins, bodies, most_steps) = effort.of([(40, 3, 2e4), (150, 12, 5e4), (6000, 820, 1e5)]);
    let flight = |kind: u64, index: u64, toss: &dyn Fn(&mut ChaCha8Rng, f64) -> Option<Toss>| {
        let mut rng = stream(kind, index);
        let settings = Settings::drawn(scheme, &mut rng);
        let phase = settings.phase(if index % 100 == 99 { MOST_STEPS } else { most_steps }, &mut rng);
        let toss = toss(&mut rng, phase)?;
        Some(settings.subject(entry, toss.launch.turn_rate()).map(|by| Flight { toss, by }))
    };
    let coins = (0..coins).filter_map(|index| flight(0, index, &|rng, phase| Some(coin(rng, phase))));
    let of_bodies = (0..bodies).flat_map(|index| (1..).zip(&FAMILIES).map(move |(kind, family)| (kind, family, index)));
    // A family may have no such body.
    let bodies =
        of_bodies.filter_map(|(kind, family, index)| flight(kind, index, &|_, phase| flown_for(family, index, phase)));
    coins.chain(bodies).collect()
}

/// `entry` with its `scheme`, by turns at the finest tolerance and at one between that and 1e-6, for `toss`.
pub(super) fn of_toss(entry: &SolverEntry, scheme: Scheme, toss: &Toss, index: u64) -> Result<Subject, InputError> {
    Settings::drawn(scheme, &mut stream(200, index)).subject(entry, toss.launch.turn_rate())
}

/// `scheme` at the finest settings that take part.
pub(super) fn finest(scheme: Scheme) -> Result<Stepping, InputError> {
    by_kind(scheme, FINEST, STEPS[3])
}

/// A scheme with its tolerance, or with its step in units of 1/|ω|.
struct Settings {
    scheme: Scheme,
    size: f64,
}

impl Settings {
    /// Half of all flights with a tolerance take the finest.
    fn drawn(scheme: Scheme, rng: &mut ChaCha8Rng) -> Self {
        let size = match scheme.is_adaptive() {
            true if rng.random() => FINEST,
            true => decades(rng, -15.6, -6.0),
            false => one(rng, STEPS),
        };
        Self { scheme, size }
    }

    /// A phase (rad) from 10 to what these steps reach in `most_steps`, more often a long one.
    fn phase(&self, most_steps: f64, rng: &mut ChaCha8Rng) -> f64 {
        let in_a_radian = match (self.scheme.is_adaptive(), self.scheme.order()) {
            (false, _) => 1.0 / self.size,
            (true, Some(order)) => 0.25 * self.size.powf(-1.0 / f64::from(order)),
            (true, None) => 1.0,
        };
        let longest = (most_steps / in_a_radian).clamp(11.0, LONGEST);
        let part = 1.0 - rng.random_range(0.0..1.0_f64).powi(3);
        10.0 * (longest / 10.0).powf(part)
    }

    fn subject(&self, entry: &SolverEntry, turn_rate: f64) -> Result<Subject, InputError> {
        let stepping = by_kind(self.scheme, self.size, self.size / turn_rate)?;
        Ok(Subject::new(entry, Some(stepping), Formulation::default()))
    }
}

/// A coin that turns by about `phase` (rad).
fn coin(rng: &mut ChaCha8Rng, phase: f64) -> Toss {
    let sign = one(rng, [-1.0, 1.0]);
    let k = match rng.random_range(0..6) {
        0 => 0.0,
        1 | 2 => 1.0 + sign * decades(rng, -15.7, -12.0),
        3 => 2.0 - one(rng, [0.0, 1.0]) * decades(rng, -16.0, 0.0),
        4 => decades(rng, -16.0, 0.0),
        _ => rng.random_range(0.0..2.0),
    };
    let mut rate = Vector3::from_fn(|_, _| rng.random_range(-1.0..1.0));
    let small = decades(rng, -8.0, 0.0);
    match rng.random_range(0..6) {
        0 => rate = Vector3::new(small * rate.x, small * rate.y, rate.z),
        1 => rate.z *= small,
        2 => {
            // About one axis, with the last digits of its rate as far from a power of two as they get, or close to one.
            let (axis, digits) = (rng.random_range(0..3), one(rng, [1.0, 1.000_000_1, 1.5, 1.999_999]));
            rate *= decades(rng, -16.0, 0.0);
            rate[axis] = sign * digits;
        }
        _ => {}
    }
    // At rest a coin turns by nothing in any time.
    if rate.norm() == 0.0 {
        rate.x = 1.0;
    }
    let rate = rate * decades(rng, -3.0, 3.0);
    of_ratio(rng, k, rate, phase)
}

/// A coin of inertia ratio `k` that turns by about `phase` (rad), level or tilted.
fn of_ratio(rng: &mut ChaCha8Rng, k: f64, rate: Vector3<f64>, phase: f64) -> Toss {
    let (tilt, flight) = (level_or_tilted(rng, 3.0), TimeOfFlight::Given(phase / rate.norm()));
    let coin = Coin::from_moments(1.0, k);
    coin.and_then(|coin| tossed(coin, rate, flight, tilt)).expect("k is from 0 to 2, and the numbers are finite")
}

/// A body of any of the families for a plan, which turns by up to 300 rad. `None` where the family has no such body.
pub(super) fn planned_body(index: u64) -> (ChaCha8Rng, Option<Toss>) {
    let mut rng = stream(101, index);
    let phase = decades(&mut rng, -1.0, 2.5);
    let families = FAMILIES.len() as u64;
    let family = &FAMILIES[usize::try_from(index % families).unwrap_or(0)];
    (rng, flown_for(family, index / families, phase))
}

/// A coin for a plan: half of them rods that spin fast and turn by up to 1000 rad.
pub(super) fn planned(index: u64) -> (ChaCha8Rng, Toss) {
    let mut rng = stream(100, index);
    if rng.random() {
        let phase = decades(&mut rng, -1.0, 2.5);
        let toss = coin(&mut rng, phase);
        return (rng, toss);
    }
    let across = decades(&mut rng, -3.0, 0.0);
    let rate = Vector3::from_fn(|_, _| rng.random_range(-across..across));
    let rate = Vector3::new(rate.x, rate.y, one(&mut rng, [-1.0, 1.0])) * decades(&mut rng, -1.0, 2.0);
    let phase = decades(&mut rng, 0.0, 3.0);
    let toss = of_ratio(&mut rng, 0.0, rate, phase);
    (rng, toss)
}
