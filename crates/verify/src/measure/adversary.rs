//! This file makes launches that an adversary would choose to break a solver: random ones of all sizes, and ones at and
//! next to every special case. Launches of ordinary size hardly ever come near enough to a singular point to provoke a
//! wrong answer.
//!
//! n is the coin's normal, S its angular momentum, k = I3/I1 its inertia ratio, ψ the cone angle between n and S, β the
//! angle of n to the vertical.

use std::f64::consts::{FRAC_PI_2, PI};

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use toss::{Coin, CoinMotion, CoinToss, InputError, Launch, TimeOfFlight, Vector3};

use crate::measure::case::Case;
use crate::measure::throws::throw;

/// One launch in so many is slow: all its rates are below 1e-3 rad/s, and it turns by up to 300 rad in hours to years.
pub const SLOW_EVERY: u64 = 40;

/// Launch number `index` of the sequence that `seed` starts. It depends on these two numbers alone.
///
/// # Errors
/// Never: every launch is valid.
pub fn launch(seed: u64, index: u64) -> Result<Case, InputError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(index);
    let k = inertia_ratio(&mut rng);
    let coin = Coin::from_moments(1.0, k)?;
    let mut rate = rate(&mut rng, k);
    if is_slow(index) && rate.amax() > 0.0 {
        rate = rate / rate.amax() * decades(&mut rng, -9.0, -3.0);
    }
    let still = CoinToss { coin, launch: Launch::new(rate, TimeOfFlight::Given(0.0))? };
    let motion = CoinMotion::new(&still);
    let tilt = tilt(&mut rng, motion.cone_angle());
    let time = time(&mut rng, &motion, &rate);
    let launch = Launch::new(rate, throw(TimeOfFlight::Given(time), index))?.with_tilt(tilt)?;
    // The motion depends on the ratio of the moments alone, whatever their size (kg m²).
    let i1 = decades(&mut rng, -12.0, 3.0);
    Ok(Case { toss: CoinToss { coin: Coin::from_moments(i1, (k * i1).min(2.0 * i1))?, launch }, tilt })
}

/// Whether launch number `index` is a slow one.
pub fn is_slow(index: u64) -> bool {
    index % SLOW_EVERY == SLOW_EVERY - 1
}

/// One of `values`, each equally likely.
fn one<const N: usize>(rng: &mut ChaCha8Rng, values: [f64; N]) -> f64 {
    values[rng.random_range(0..N)]
}

/// 10 to a power that is uniform between `low` and `high`.
fn decades(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    10f64.powf(rng.random_range(low..high))
}

/// A number of either sign and of a size from 1e-17 to 1, equally likely in each decade.
fn near(rng: &mut ChaCha8Rng) -> f64 {
    decades(rng, -17.0, 0.0) * one(rng, [-1.0, 1.0])
}

/// An inertia ratio k from a rod (0) to a flat disc (2), often at or next to that of a sphere (1).
fn inertia_ratio(rng: &mut ChaCha8Rng) -> f64 {
    match rng.random_range(0..3) {
        0 => one(rng, [0.0, 5e-324, 1e-300, 1e-9, 0.5, 1.0 - f64::EPSILON, 1.0, 1.0 + f64::EPSILON, 1.98, 2.0]),
        1 => (1.0 + near(rng)).clamp(0.0, 2.0),
        _ => rng.random_range(0.0..2.0),
    }
}

/// The body rate ω (rad/s) of a coin of inertia ratio `k`: as of a hand; near pure spin, no spin or ψ = 45°; with
/// components of very different sizes; or of any size.
fn rate(rng: &mut ChaCha8Rng, k: f64) -> Vector3<f64> {
    let hand = Vector3::from_fn(|_, _| rng.random_range(-60.0..60.0));
    match rng.random_range(0..6) {
        0 | 1 => hand,
        2 => {
            let part = near(rng);
            let [across, along] = if rng.random() { [part, 1.0] } else { [1.0, part] };
            Vector3::new(hand.x * across, hand.y * across, hand.z * along)
        }
        3 => {
            let diagonal = hand.x.hypot(hand.y) / k.max(1e-3) * (1.0 + near(rng));
            Vector3::new(hand.x, hand.y, diagonal)
        }
        4 => hand.map(|part| part * one(rng, [0.0, 1.0, 1e-8, 1e-16, 1e-160, 1e-320])),
        _ => hand * decades(rng, -320.0, 300.0),
    }
}

/// The tilt β at launch (rad), from 0 to π: level, on edge, upside down or with S along the vertical (`cone` is the
/// angle between n and S); next to one of these; or any.
fn tilt(rng: &mut ChaCha8Rng, cone: f64) -> f64 {
    let special = one(rng, [0.0, FRAC_PI_2, PI, cone, PI - cone]);
    match rng.random_range(0..4) {
        0 => special,
        1 => (special + near(rng)).clamp(0.0, PI),
        2 => one(rng, [0.0, 1e-300, 1e-16, 1e-8]),
        _ => rng.random_range(0.0..PI),
    }
}

/// The time of flight (s). Most coins, slow or fast, get a time in which they turn by up to 300 rad. One in fifty flies
/// for up to 100 s, if it is of ordinary speed, and one in a hundred turns by more than 10^16 rad, where every solver
/// must refuse. Phases in between are left out: there integrators only reach their largest number of steps, which takes
/// a second a flight.
fn time(rng: &mut ChaCha8Rng, motion: &CoinMotion, rate: &Vector3<f64>) -> f64 {
    let turns_in_a_second = motion.phase(1.0).unwrap_or(f64::INFINITY).max(rate.amax()).max(f64::MIN_POSITIVE);
    let ordinary = (1e-3..200.0).contains(&turns_in_a_second);
    let time = match rng.random_range(0..100) {
        0 => decades(rng, 16.0, 300.0) / turns_in_a_second,
        1 | 2 if ordinary => rng.random_range(0.0..100.0),
        3 => 0.0,
        _ => decades(rng, -3.0, 2.5) / turns_in_a_second,
    };
    // A time beyond the range of f64 becomes the largest one.
    if time.is_finite() { time } else { f64::MAX }
}
