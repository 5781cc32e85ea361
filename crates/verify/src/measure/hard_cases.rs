//! Tosses for which rounding is hardest, for checks of last bits and of proofs: large phases, corners of the model, and
//! landings within a few ulp of a change of the outcome.

use std::f64::consts::{FRAC_PI_2, PI};

use sampling::Coordinate::{RateX, RateY, RateZ, Speed, Tilt};
use sampling::Space;
use toss::{Coin, CoinMotion, CoinToss, Launch, TimeOfFlight, Vector3};

use super::case::Case;
use super::effort::Effort;
use super::random_flights::random_flights;
use super::throws::throw;

/// The number of tosses from which a check derives the sizes of its sets.
pub(crate) fn tries(effort: Effort) -> u64 {
    match effort {
        Effort::Quick => 1000,
        Effort::Standard => 8000,
        Effort::Deep => 350_000,
    }
}

/// `number` random tosses, of five coins in turn, every second one tilted, and [thrown in every form](throw), whose
/// rates and times of up to 1 s give phases of up to about `phase` (rad).
pub(crate) fn random(number: u64, phase: f64, seed: u64) -> anyhow::Result<Vec<Case>> {
    let fastest = format!("{0:?}:{1:?}", -phase / 2.0, phase / 2.0);
    let axes = [(RateX, &*fastest), (RateY, &fastest), (RateZ, &fastest), (Speed, "0:4.905"), (Tilt, "-3.2:3.2")];
    let space = Space::parse(Coin::PAPER, &axes)?;
    let coins = [0.5, 1.0, 1.98, 2.0, 0.0].map(|k| Coin::from_moments(5e-7, k * 5e-7));
    let case = |(index, toss): (usize, CoinToss)| {
        let tilt = if index % 2 == 0 { 0.0 } else { 2.0 * toss.launch.attitude().components()[1].asin() };
        let flight = throw(toss.launch.time_of_flight(), index as u64);
        let launch = Launch::new(toss.launch.rate(), flight)?.with_tilt(tilt)?;
        Ok(Case { toss: CoinToss { coin: coins[index / 5 % 5].clone()?, launch }, tilt })
    };
    random_flights(&space, seed, number)?.into_iter().enumerate().map(case).collect()
}

/// Tosses at the corners of the model: pure spin, no spin, spheres, rods, discs, slow and subnormal rates, each
/// combined with several tilts and with short and long times.
pub(crate) fn corners() -> anyhow::Result<Vec<Case>> {
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
    let mut cases = Vec::new();
    for k in [0.0, 1e-300, 0.5, 1.0, 2.0] {
        for rate in rates {
            for tilt in tilts {
                for time in times {
                    let launch = Launch::new(rate, TimeOfFlight::Given(time))?.with_tilt(tilt)?;
                    cases.push(Case { toss: CoinToss { coin: Coin::from_moments(1.0, k)?, launch }, tilt });
                }
            }
        }
    }
    Ok(cases)
}

/// Tosses that land within 3 ulp of the speed at which the outcome changes. Of each three, one is a random launch, one
/// is horizontal with ψ within 3 ulp of 45°, where cos θ touches 0 at half a turn, and one is tilted so that n only
/// touches the horizontal plane. `turns` says how many turns the phase of each has before the change.
pub(crate) fn adversarial(number: u64, turns: fn(usize) -> f64) -> anyhow::Result<Vec<Case>> {
    const GRAVITIES: [f64; 4] = [9.81, 1.62, 9.80665, 24.79];
    let mut cases = Vec::new();
    for (index, case) in random(number, 100.0, 77)?.into_iter().enumerate() {
        let rate = case.toss.launch.rate();
        let (rate, tilt) = match index % 3 {
            // ψ = 45° where Ω = k ωz, with Ω = √(ωx² + ωy²).
            1 => (
                Vector3::new(rate.x, rate.y, ulps(rate.x.hypot(rate.y) / case.toss.coin.inertia_ratio(), index / 3)),
                0.0,
            ),
            2 => (rate, grazing_tilt(&case.toss, index / 3)),
            _ => (rate, case.tilt),
        };
        if !(rate.z.is_finite() && rate.z.abs() < 1e6) {
            continue;
        }
        let toss = |time| -> anyhow::Result<CoinToss> {
            Ok(CoinToss { launch: Launch::new(rate, time)?.with_tilt(tilt)?, ..case.toss })
        };
        let motion = CoinMotion::new(&toss(TimeOfFlight::Given(0.0))?);
        let heads = motion.heads();
        // Where cos θ never changes its sign the two edges coincide at its trough, where it comes nearest to 0.
        let before = std::f64::consts::TAU * turns(index);
        for edge in [heads.crest + heads.half_width, heads.crest - heads.half_width] {
            let phase = edge.rem_euclid(std::f64::consts::TAU) + before;
            let (time, gravity) = (phase / motion.precession_rate(), GRAVITIES[index % GRAVITIES.len()]);
            let speed = ulps(0.5 * gravity * time, index);
            if speed.is_finite() && speed >= 0.0 {
                cases.push(Case { toss: toss(caught(speed, gravity, time, index))?, tilt });
            }
        }
    }
    Ok(cases)
}

/// A throw that lasts about `time` (s): three of five at `speed`, one at half and caught below, one at 1.5 times and above.
fn caught(speed: f64, gravity: f64, time: f64, turn: usize) -> TimeOfFlight {
    let part = [1.0, 1.0, 1.0, 0.5, 1.5][turn % 5];
    let drop = (part != 1.0).then_some((1.0 - part) * 0.5 * gravity * time * time);
    TimeOfFlight::thrown(part * speed, gravity, drop)
}

/// Up to six turns, in turn.
pub(crate) fn few_turns(index: usize) -> f64 {
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
