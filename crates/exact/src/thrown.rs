//! This file finds the speeds that land heads for a landing at any height. At the height of the launch the time of flight
//! is proportional to the speed, and [`level_speeds_of_heads`] has the answer. A landing at h below the launch has the time
//! T = (v0 + √(v0² + 2 g h))/g, which a throw at u = g T/2 has without the drop; back from it, v0 = u - g h/(2 u).

use dynamics::{CoinToss, SolveError, TimeOfFlight};

use crate::margin::level_speeds_of_heads;

/// The intervals of speeds (m/s) from `slowest` to that of `toss` that land heads, in order; `None` if its time of flight
/// was given without a speed.
///
/// # Errors
/// [`SolveError::PhaseTooLarge`].
pub(crate) fn thrown_speeds_of_heads(toss: &CoinToss, slowest: f64) -> Result<Option<Vec<[f64; 2]>>, SolveError> {
    let (speed, gravity, drop) = match toss.launch.time_of_flight() {
        TimeOfFlight::Ballistic { .. } => return Ok(level_speeds_of_heads(toss, slowest)?.map(Iterator::collect)),
        TimeOfFlight::BallisticTo { speed, gravity, drop } => (speed, gravity, drop),
        TimeOfFlight::Given(_) => return Ok(None),
    };
    let level = |speed: f64| 0.5 * gravity * TimeOfFlight::BallisticTo { speed, gravity, drop }.seconds();
    let (from, to) = (level(slowest), level(speed));
    let as_level = TimeOfFlight::Ballistic { speed: to, gravity };
    // The time of flight is that of the valid launch to rounding, so that only the largest of all f64 can be too large.
    let too_large = |_| SolveError::PhaseTooLarge { phase: f64::MAX };
    let level_toss = CoinToss { launch: toss.launch.with_time_of_flight(as_level).map_err(too_large)?, ..*toss };
    let speed_of = |level: f64| match level {
        end if end <= from => slowest,
        end if end >= to => speed,
        level => (level - 0.5 * gravity * drop / level).clamp(slowest, speed),
    };
    Ok(level_speeds_of_heads(&level_toss, from)?.map(|heads| heads.map(|interval| interval.map(speed_of)).collect()))
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Launch, Outcome};
    use nalgebra::Vector3;

    use super::*;
    use crate::certified::certify_coin;

    fn toss(speed: f64, drop: Option<f64>) -> CoinToss {
        let launch = Launch::new(Vector3::new(20.0, 5.0, 3.0), TimeOfFlight::thrown(speed, 9.81, drop)).unwrap();
        CoinToss { coin: Coin::PAPER, launch: launch.with_tilt(0.4).unwrap() }
    }

    #[test]
    fn the_outcome_changes_at_the_ends_of_the_intervals() {
        for drop in [Some(1.3), Some(-0.4), Some(0.0), None] {
            let heads = thrown_speeds_of_heads(&toss(9.0, drop), 3.0).unwrap().unwrap();
            assert!(heads.len() > 2, "{heads:?}");
            for speed in (0..=6000).map(|step| 3.0 + f64::from(step) * 1e-3) {
                let nearest = heads.iter().flatten().map(|end| (end - speed).abs()).fold(f64::MAX, f64::min);
                let expected = heads.iter().any(|[slow, fast]| (*slow..=*fast).contains(&speed));
                let found = certify_coin(&toss(speed, drop)).unwrap().outcome() == Outcome::Heads;
                assert!(found == expected || nearest < 1e-11, "{drop:?}, {speed} m/s");
            }
        }
        let given =
            CoinToss { launch: Launch::new([1.0, 0.0, 0.0], TimeOfFlight::Given(1.0)).unwrap(), coin: Coin::PAPER };
        assert_eq!(thrown_speeds_of_heads(&given, 0.0), Ok(None));
    }
}
