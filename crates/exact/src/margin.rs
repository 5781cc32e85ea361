//! How far a toss is from the other outcome: the smallest change of one input that flips it.
//!
//! ```text
//! Δv0 = ½ g Δφ/ωL                 exactly, Δφ from the phase ωL T to the nearest edge of the phases that show heads
//! Δωi = -cos θ/(∂cos θ/∂ωi)       to first order, by the sensitivity of cos θ
//! ```
//!
//! See [`HeadsPhases`] and [`Sensitivity`].

use dynamics::{SolveError, TimeOfFlight, Toss};

use crate::heads::HeadsPhases;
use crate::motion::ExactMotion;
use crate::sensitivity::Sensitivity;

/// The smallest changes that flip the outcome, each of one input alone and with its sign; `None` where none does.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Margin {
    /// Of the time of flight (s).
    pub time: Option<f64>,
    /// Of the speed (m/s); `None` also where the time was given instead.
    pub speed: Option<f64>,
    /// Of ωx, ωy, ωz (rad/s), to first order.
    pub rate: [Option<f64>; 3],
}

/// The margin of a toss.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`].
pub fn margin(toss: &Toss) -> Result<Margin, SolveError> {
    let motion = ExactMotion::new(toss);
    let time_of_flight = toss.launch.time_of_flight();
    let phase = motion.phases(time_of_flight)?.0.hi();
    let (heads, rate) = (motion.heads(), motion.precession_rate());
    let to_edge = |shortest: f64| to_nearest_edge(&heads, phase, shortest * rate).map(|change| change / rate);
    let time = to_edge(0.0);
    let speed = match time_of_flight {
        TimeOfFlight::Ballistic { gravity, .. } => time.map(|time| 0.5 * gravity * time),
        TimeOfFlight::BallisticTo { gravity, drop, .. } => {
            // v0 = g T/2 - h/T, for flights not shorter than the fall from the apex or the rise to it.
            let now = toss.launch.flight_time();
            let change = |time: f64| time * (0.5 * gravity + drop / (now * (now + time)));
            to_edge((2.0 * drop.abs() / gravity).sqrt()).map(change)
        }
        TimeOfFlight::Given(_) => None,
    };
    let cos_tilt = motion.cos_tilt(time_of_flight)?;
    let slopes = Sensitivity::new(toss)?.cos_tilt;
    let rate = [slopes.x, slopes.y, slopes.z].map(|slope| Some(-cos_tilt / slope).filter(|change| change.is_finite()));
    Ok(Margin { time, speed, rate })
}

/// The smallest change of a `phase` that takes it to an edge of the heads, and not below `least` ≥ 0 (rad).
fn to_nearest_edge(heads: &HeadsPhases, phase: f64, least: f64) -> Option<f64> {
    use std::f64::consts::{PI, TAU};
    if heads.half_width <= 0.0 || heads.half_width >= PI {
        return None;
    }
    let turn = ((phase - heads.crest) / TAU).round();
    let from_crest = phase - heads.crest - TAU * turn;
    // About this crest and, for a phase after its edges, the next.
    let crests = [-from_crest, TAU - from_crest];
    let edges = crests.into_iter().flat_map(|crest| [crest - heads.half_width, crest + heads.half_width]);
    edges.filter(|change| phase + change >= least).min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// The intervals of speeds (m/s) from `slowest` to that of `toss` that land heads, in order; `None` if it was not thrown
/// and caught at the same height. A motion of many turns has as many intervals.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`].
pub fn speeds_of_heads(
    toss: &Toss,
    slowest: f64,
) -> Result<Option<impl Iterator<Item = [f64; 2]> + use<>>, SolveError> {
    let TimeOfFlight::Ballistic { speed, gravity } = toss.launch.time_of_flight() else { return Ok(None) };
    let motion = ExactMotion::new(toss);
    let fastest_phase = motion.phases(toss.launch.time_of_flight())?.0.hi();
    let slowest_phase = motion.phases(TimeOfFlight::Ballistic { speed: slowest, gravity })?.0.hi();
    // Without a precession every speed has the outcome of the launch, and a phase of 0 no length.
    let still = fastest_phase == slowest_phase;
    let span = if still { [slowest, speed] } else { [slowest_phase, fastest_phase] };
    let heads = if still { HeadsPhases::constant(motion.cos_tilt(0.0)?) } else { motion.heads() };
    let speed_of = move |phase: f64| {
        if still { phase } else { slowest + (phase - span[0]) / (span[1] - span[0]) * (speed - slowest) }
    };
    Ok(Some(heads.intervals(span[0], span[1]).map(move |interval| interval.map(speed_of))))
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch};
    use nalgebra::Vector3;

    use super::*;
    use crate::certified::certify;

    fn toss(rate: Vector3<f64>, tilt: f64, speed: f64) -> Toss {
        let thrown = TimeOfFlight::Ballistic { speed, gravity: 9.81 };
        let launch = Launch::new(rate, thrown).unwrap().with_tilt(tilt).unwrap();
        Toss { coin: Coin::from_moments(1.0, 1.3).unwrap(), launch }
    }

    const RATES: [[f64; 3]; 6] =
        [[1.0, 1.0, 2.5], [20.0, -31.0, 7.0], [0.0, 9.0, 0.0], [-3.0, 4.0, -6.0], [2.0, 2.0, 0.5], [0.0, 0.0, 0.0]];
    const TILTS: [f64; 4] = [0.0, 0.6, 2.0, -1.1];

    #[test]
    fn the_change_of_speed_flips_the_outcome_and_none_smaller_does() {
        let mut flips = 0;
        for rate in RATES.map(Vector3::from) {
            for (tilt, speed) in TILTS.into_iter().flat_map(|tilt| [0.3, 3.0, 4.1].map(|speed| (tilt, speed))) {
                let outcome = |speed| certify(&toss(rate, tilt, speed)).unwrap().outcome();
                let Some(change) = margin(&toss(rate, tilt, speed)).unwrap().speed else { continue };
                flips += 1;
                assert_ne!(outcome(speed + change * (1.0 + 1e-9)), outcome(speed), "{rate:?} {tilt} {speed}");
                for part in [-0.999_999, -0.5, 0.5, 0.999_999] {
                    let other = speed + part * change;
                    assert!(other < 0.0 || outcome(other) == outcome(speed), "{rate:?} {tilt} {speed}: {change}");
                }
            }
        }
        assert!(flips > 40, "{flips}");
    }

    #[test]
    fn the_change_of_speed_flips_the_outcome_at_another_height_too() {
        let mut flips = 0;
        for rate in RATES.map(Vector3::from) {
            for (drop, now) in [-0.4, 0.2, 1.5].into_iter().flat_map(|drop| [3.0, 4.1].map(|now| (drop, now))) {
                let toss = |speed| {
                    let thrown = TimeOfFlight::BallisticTo { speed, gravity: 9.81, drop };
                    Toss { coin: Coin::DISC, launch: Launch::new(rate, thrown).unwrap().with_tilt(0.6).unwrap() }
                };
                let outcome = |speed| certify(&toss(speed)).unwrap().outcome();
                let Some(change) = margin(&toss(now)).unwrap().speed else { continue };
                flips += 1;
                assert_ne!(outcome(now + change * (1.0 + 1e-9)), outcome(now), "{rate:?} {drop}");
                assert_eq!(outcome(now + change * (1.0 - 1e-9)), outcome(now), "{rate:?} {drop}");
            }
        }
        assert!(flips >= 18, "{flips}");
    }

    #[test]
    fn near_the_edge_the_change_of_rate_flips_the_outcome() {
        // 1e-4 m/s before the edge.
        let start = toss(Vector3::new(2.0, 3.0, 1.0), 0.4, 3.0);
        let edge = 3.0 + margin(&start).unwrap().speed.unwrap();
        let near = toss(Vector3::new(2.0, 3.0, 1.0), 0.4, edge - 1e-4);
        let outcome = certify(&near).unwrap().outcome();
        for (axis, change) in margin(&near).unwrap().rate.into_iter().enumerate() {
            let changed = |part: f64| near.launch.rate() + Vector3::ith(axis, part * change.unwrap());
            assert_eq!(certify(&toss(changed(0.99), 0.4, edge - 1e-4)).unwrap().outcome(), outcome);
            assert_ne!(certify(&toss(changed(1.01), 0.4, edge - 1e-4)).unwrap().outcome(), outcome);
        }
    }

    #[test]
    fn speeds_inside_the_intervals_land_heads_and_others_tails() {
        for rate in RATES.map(Vector3::from) {
            for tilt in TILTS {
                let intervals: Vec<[f64; 2]> = speeds_of_heads(&toss(rate, tilt, 9.0), 1.0).unwrap().unwrap().collect();
                for part in 0..500 {
                    let speed = 1.0 + 8.0 * (f64::from(part) + 0.5) / 500.0;
                    let inside = intervals.iter().any(|[slow, fast]| *slow < speed && speed < *fast);
                    let heads = certify(&toss(rate, tilt, speed)).unwrap().outcome() == dynamics::Outcome::Heads;
                    assert_eq!(inside, heads, "{rate:?} {tilt} {speed}: {intervals:?}");
                }
            }
        }
    }

    #[test]
    fn what_never_flips_has_no_margin_in_speed() {
        let certain = margin(&toss(Vector3::new(1.0, 0.0, 9.0), 0.0, 3.0)).unwrap();
        assert_eq!((certain.speed, certain.time), (None, None));
        let launch = Launch::new(Vector3::new(9.0, 0.0, 0.0), TimeOfFlight::Given(0.1)).unwrap();
        let given = margin(&Toss { coin: Coin::PAPER, launch }).unwrap();
        assert_eq!(given.speed, None);
        assert!((given.time.unwrap() - (std::f64::consts::FRAC_PI_2 / 9.0 - 0.1)).abs() < 1e-15);
    }

    /// Caught 1.5 m below, no flight is shorter than the fall from rest, 0.553 s: of the flips at 0.5 s and 1.5 s only the
    /// later one can be had.
    #[test]
    fn a_flip_before_the_shortest_flight_is_none() {
        let toss = |speed| {
            let thrown = TimeOfFlight::BallisticTo { speed, gravity: 9.81, drop: 1.5 };
            Toss {
                coin: Coin::DISC,
                launch: Launch::new(Vector3::new(std::f64::consts::PI, 0.0, 0.0), thrown).unwrap(),
            }
        };
        let change = margin(&toss(0.1)).unwrap().speed.unwrap();
        let flight = toss(0.1 + change).launch.flight_time();
        assert!((flight - 1.5).abs() < 1e-12, "{change}: {flight}");
    }

    /// Against all edges of twenty turns.
    #[test]
    fn the_nearest_edge_is_the_nearest_of_all() {
        use std::f64::consts::TAU;
        for (crest, half_width) in [(0.5, 2.5), (-3.0, 0.4), (2.9, 1.6)] {
            let heads = HeadsPhases { crest, half_width, crest_error: 0.0, half_width_error: 0.0 };
            let edges =
                || (-1..20).flat_map(|turn| [-1.0, 1.0].map(|side| crest + side * half_width + TAU * f64::from(turn)));
            for (phase, least) in (0..290).flat_map(|part| [0.0, 1.5].map(|least| (1.5 + 0.2 * f64::from(part), least)))
            {
                let changes = edges().filter(|edge| *edge >= least).map(|edge| edge - phase);
                let expected = changes.min_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap();
                let found = to_nearest_edge(&heads, phase, least).unwrap();
                assert!((found - expected).abs() < 1e-12, "{crest} {half_width} {phase} {least}: {found}");
            }
        }
    }
}
