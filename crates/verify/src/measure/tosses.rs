//! The tosses on which solvers and the library are measured: random ones, given in every form; those for which rounding is
//! hardest, with large phases, at corners of the model, and within a few ulp of a change of the outcome. Bodies that are
//! no coins are in [`families`](super::families).
//!
//! They share no code with the random launches of the crate `sampling`, which is measured itself, so that a change of these
//! moves no measurement of a solver.

use std::f64::consts::{FRAC_PI_2, PI, SQRT_2, TAU};

use rand::distr::Open01;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use sampling::Coordinate::{self, Drop, Gravity, RateX, RateY, RateZ, Speed, Tilt};
use sampling::{AxisOrTie, Distribution, Space};
use toss::{Attitude, Coin, CoinMotion, CoinToss, InputError, Launch, TimeOfFlight, Toss, Vector3};

use crate::measure::effort::Effort;

/// The random numbers for the item `index` of the sequence that `seed` starts.
pub(super) fn stream(seed: u64, index: u64) -> ChaCha8Rng {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(index);
    rng
}

/// 10 to a power that is uniform between `low` and `high`.
pub(super) fn decades(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    10f64.powf(rng.random_range(low..high))
}

/// One of `values`, each equally likely.
pub(super) fn one<T: Copy, const N: usize>(rng: &mut ChaCha8Rng, values: [T; N]) -> T {
    values[rng.random_range(0..N)]
}

/// The golden section, whose multiples are [spread evenly](evenly).
pub(super) const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// The weakest and the strongest gravity of the throws (m/s²): about those of the Moon and of Jupiter.
const GRAVITY: [f64; 2] = [1.62, 24.8];

/// The fastest throw, in units of g T/2, the speed of a throw that lasts T and is caught at the height of the launch. A
/// throw of twice that speed is caught at its apex.
const FASTEST: f64 = 1.95;

/// A number from 0 to 1. The numbers of many turns are spread evenly, independently for each `irrational` factor.
#[expect(clippy::cast_precision_loss, reason = "turns stay far below 2^53")]
pub(super) fn evenly(turn: u64, irrational: f64) -> f64 {
    (turn as f64 * irrational).fract()
}

/// A flight that lasts as long as `flight`, to rounding, in a form that `turn` chooses: of each five, one stays as it
/// is, one is given by its time, one thrown under another gravity, and two are caught above or below the launch. A solver
/// that ignores one of these inputs fails. A throw is chosen by the time that it takes: errors depend on that time alone, and
/// bounds hold for every form.
pub(super) fn throw(flight: TimeOfFlight, turn: u64) -> TimeOfFlight {
    let time = flight.seconds();
    let [weakest, strongest] = GRAVITY;
    let gravity = weakest * (strongest / weakest).powf(evenly(turn, GOLDEN));
    let level = 0.5 * gravity * time;
    let part = FASTEST * evenly(turn, SQRT_2);
    let thrown = match turn % 5 {
        0 => return flight,
        1 => TimeOfFlight::Given(time),
        2 => TimeOfFlight::Ballistic { speed: level, gravity },
        _ => TimeOfFlight::BallisticTo { speed: part * level, gravity, drop: (1.0 - part) * level * time },
    };
    // Times next to the ends of the range of f64 have speeds or drops beyond it.
    let valid = Launch::new(Vector3::zeros(), thrown).is_ok();
    let as_long = (thrown.seconds() - time).abs() <= 1e-12 * time;
    if valid && as_long { thrown } else { TimeOfFlight::Given(time) }
}

/// The toss of `coin` at `rate` (rad/s) from a tilt (rad).
pub(super) fn tossed(
    coin: Coin,
    rate: impl Into<Vector3<f64>>,
    flight: TimeOfFlight,
    tilt: f64,
) -> Result<Toss, InputError> {
    Ok(Toss::new(coin, Launch::new(rate, flight)?.with_tilt(tilt)?))
}

/// Level half of the time, otherwise tilted by up to `most` (rad).
pub(super) fn level_or_tilted(rng: &mut ChaCha8Rng, most: f64) -> f64 {
    if rng.random() { 0.0 } else { rng.random_range(0.0..most) }
}

/// The first `number` independent launches of `space`, whose axes are ranges or single values.
pub(super) fn random_flights(space: &Space, seed: u64, number: u64) -> Result<Vec<Toss>, InputError> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..number).map(|_| flight(space, &mut rng)).collect()
}

fn flight(space: &Space, rng: &mut ChaCha8Rng) -> Result<Toss, InputError> {
    let mut values = [0.0; Coordinate::COUNT];
    for of in Coordinate::ALL {
        if let Some(AxisOrTie::Axis(axis)) = space.axis_or_tie(of) {
            values[of as usize] = match axis.distribution() {
                Distribution::Uniform { lo, hi } if lo == hi => lo,
                Distribution::Uniform { lo, hi } => lo + rng.sample::<f64, _>(Open01) * (hi - lo),
                Distribution::Normal { .. } => {
                    let (field, value) = (of.field(), axis.to_string());
                    return Err(InputError::Malformed { field, value, expected: "a range or a single value" });
                }
            };
        }
    }
    let value = |of| match space.axis_or_tie(of) {
        Some(AxisOrTie::SameAs(other)) => values[other as usize],
        _ => values[of as usize],
    };
    let rate = Vector3::new(value(RateX), value(RateY), value(RateZ));
    let launch =
        Launch::new(rate, TimeOfFlight::thrown(value(Speed), value(Gravity), space.drop().map(|_| value(Drop))))?;
    let launch = if value(Tilt) == 0.0 { launch } else { launch.with_tilt(value(Tilt))? };
    Ok(Toss::new(space.coin().ok_or(dynamics::coin::NO_COIN)?, launch))
}

/// The number of tosses from which a check derives the sizes of its sets.
pub(super) fn tries(effort: Effort) -> u64 {
    effort.launches([1000, 8000, 350_000])
}

/// `number` random tosses, of five coins in turn, every second one tilted, and [thrown in every form](throw), whose
/// rates and times of up to 1 s give phases of up to about `phase` (rad).
pub(super) fn random(number: u64, phase: f64, seed: u64) -> anyhow::Result<Vec<Toss>> {
    let fastest = format!("{0:?}:{1:?}", -phase / 2.0, phase / 2.0);
    let axes = [(RateX, &*fastest), (RateY, &fastest), (RateZ, &fastest), (Speed, "0:4.905"), (Tilt, "-3.2:3.2")];
    let space = Space::parse(Coin::PAPER, &axes)?;
    let coins = [0.5, 1.0, 1.98, 2.0, 0.0].map(|k| Coin::from_moments(5e-7, k * 5e-7));
    let vary = |(index, toss): (usize, Toss)| {
        let tilt = if index % 2 == 0 { 0.0 } else { 2.0 * toss.launch.attitude().components()[1].asin() };
        let flight = throw(toss.launch.time_of_flight(), index as u64);
        Ok(tossed(coins[index / 5 % 5].clone()?, toss.launch.rate(), flight, tilt)?)
    };
    random_flights(&space, seed, number)?.into_iter().enumerate().map(vary).collect()
}

/// Tosses at the corners of the model: pure spin, no spin, spheres, rods, discs, slow and subnormal rates, each
/// combined with several tilts and with short and long times.
pub(super) fn corners() -> anyhow::Result<Vec<Toss>> {
    let rates = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 7.0],
        [3.0, -4.0, 0.0],
        [1.0, 1.0, 2.5],
        [20.0, 0.0, 10.0],
        [1e-9, 0.0, 60.0],
        [5e-324, 0.0, 5e-324],
        [1e-160, 1e-170, 1.0],
        [1e5, -2e5, 3e5],
    ];
    let tilts = [0.0, 1e-300, 1e-16, 1e-8, 0.5, FRAC_PI_2, 2.0, PI, -1.0];
    let times = [0.0, 1e-300, 1e-3, 0.7, 1000.0];
    let mut tosses = Vec::new();
    for k in [0.0, 1e-300, 0.5, 1.0, 2.0] {
        for rate in rates {
            for tilt in tilts {
                for time in times {
                    tosses.push(tossed(Coin::from_moments(1.0, k)?, rate, TimeOfFlight::Given(time), tilt)?);
                }
            }
        }
    }
    Ok(tosses)
}

/// Tosses that land within 3 ulp of the speed at which the outcome changes. Of each three, one is a random launch, one
/// is horizontal with ψ within 3 ulp of 45°, where cos θ touches 0 at half a turn, and one is tilted so that n only
/// touches the horizontal plane. `turns` says how many turns the phase of each has before the change.
pub(super) fn adversarial(number: u64, turns: fn(usize) -> f64) -> anyhow::Result<Vec<Toss>> {
    const GRAVITIES: [f64; 4] = [9.81, 1.62, 9.80665, 24.79];
    let mut tosses = Vec::new();
    for (index, toss) in random(number, 100.0, 77)?.iter().filter_map(Toss::coin).enumerate() {
        let rate = toss.launch.rate();
        let (rate, attitude) = match index % 3 {
            // ψ = 45° where Ω = k ωz, with Ω = √(ωx² + ωy²).
            1 => {
                let spin = ulps(rate.x.hypot(rate.y) / toss.coin.inertia_ratio(), index / 3);
                (Vector3::new(rate.x, rate.y, spin), Attitude::IDENTITY)
            }
            2 => (rate, Attitude::about_x(grazing_tilt(&toss, index / 3))),
            _ => (rate, toss.launch.attitude()),
        };
        if !(rate.z.is_finite() && rate.z.abs() < 1e6) {
            continue;
        }
        let toss = |flight| -> anyhow::Result<CoinToss> {
            Ok(CoinToss { launch: Launch::new(rate, flight)?.with_attitude(attitude), ..toss })
        };
        let motion = CoinMotion::new(&toss(TimeOfFlight::Given(0.0))?);
        let heads = motion.heads();
        // Where cos θ never changes its sign the two edges coincide at its trough, where it comes nearest to 0.
        let before = TAU * turns(index);
        for edge in [heads.crest + heads.half_width, heads.crest - heads.half_width] {
            let phase = edge.rem_euclid(TAU) + before;
            let (time, gravity) = (phase / motion.precession_rate(), GRAVITIES[index % GRAVITIES.len()]);
            let speed = ulps(0.5 * gravity * time, index);
            if speed.is_finite() && speed >= 0.0 {
                tosses.push(toss(caught(speed, gravity, time, index))?.into());
            }
        }
    }
    Ok(tosses)
}

/// A throw that lasts about `time` (s): three of five at `speed`, one at half and caught below, one at 1.5 times and above.
fn caught(speed: f64, gravity: f64, time: f64, turn: usize) -> TimeOfFlight {
    let part = [1.0, 1.0, 1.0, 0.5, 1.5][turn % 5];
    let drop = (part != 1.0).then_some((1.0 - part) * 0.5 * gravity * time * time);
    TimeOfFlight::thrown(part * speed, gravity, drop)
}

/// Up to six turns, in turn.
pub(super) fn few_turns(index: usize) -> f64 {
    (index % 7) as f64
}

/// A number within 3 ulp of `value`; which of the seven is chosen by `turn` modulo 7.
fn ulps(value: f64, turn: usize) -> f64 {
    let offset = i64::try_from(turn % 7).unwrap_or(0) - 3;
    f64::from_bits(value.to_bits().wrapping_add_signed(offset))
}

/// A tilt within 3 ulp of the one for which φ + ψ = 90°, where φ is the angle of S to the vertical: there cos θ only
/// touches 0.
fn grazing_tilt(toss: &CoinToss, turn: usize) -> f64 {
    // A turn by β about the laboratory's x axis gives S the height sin β Sy + cos β Sz. For φ + ψ = 90° this must be
    // |S| cos φ = |S| sin ψ = I1 Ω, with Ω = √(ωx² + ωy²). No tilt reaches it if Sy and Sz are too small.
    let rate = toss.launch.rate();
    let spin = toss.coin.inertia_ratio() * rate.z;
    let reach = rate.y.hypot(spin);
    let height = rate.x.hypot(rate.y) / reach;
    if height > 1.0 { 0.3 } else { ulps(rate.y.atan2(spin) + height.acos(), turn) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_form_lasts_as_long_and_all_inputs_vary() {
        let (mut above, mut below, mut gravities) = (0, 0, Vec::new());
        for turn in 0..1000 {
            let time = 10f64.powf(-3.0 + 6.0 * evenly(turn, 0.3));
            let thrown = throw(TimeOfFlight::Given(time), turn);
            assert!((thrown.seconds() / time - 1.0).abs() < 1e-12, "{thrown:?} for {time}");
            match thrown {
                TimeOfFlight::Given(_) => (),
                TimeOfFlight::Ballistic { gravity, .. } => gravities.push(gravity),
                TimeOfFlight::BallisticTo { gravity, drop, .. } => {
                    gravities.push(gravity);
                    if drop > 0.0 { below += 1 } else { above += 1 }
                }
            }
        }
        assert!(above > 150 && below > 150 && gravities.len() == 600, "{above} above, {below} below");
        assert!(gravities.iter().any(|g| *g < 1.7) && gravities.iter().any(|g| *g > 24.0));
    }

    #[test]
    fn times_without_a_throw_stay_times() {
        for time in [0.0, 5e-324, 1e-300, 1e300, f64::MAX] {
            for turn in 0..5 {
                let thrown = throw(TimeOfFlight::Given(time), turn);
                assert!(Launch::new(Vector3::zeros(), thrown).is_ok(), "{thrown:?}");
                assert!((thrown.seconds() - time).abs() <= 1e-12 * time, "{thrown:?} for {time}");
            }
        }
    }
}
