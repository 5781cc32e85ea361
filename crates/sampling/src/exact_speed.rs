//! This file computes the share of heads over all speeds in closed form. It replaces the sampling of one coordinate by
//! a formula, which makes this method far more accurate than the others.
//!
//! With everything but the speed fixed, the phase at landing ωL T = 2 ωL v0/g is proportional to v0. The coin lands
//! heads while this phase is within the half-width w of a crest c + 2π n ([`HeadsPhases`]). So the probability of heads
//! is that of these intervals under the distribution of the phase:
//!
//! ```text
//! v0 uniform, phase from a to b:    P = (H(b) - H(a))/(b - a),   H(x) = 2 w n + clamp(x - c - 2π n, -w, w)
//! v0 normal, phase with μ and σ:    P = Σ Φ((c + 2π n + w - μ)/σ) - Φ((c + 2π n - w - μ)/σ)
//! ```
//!
//! where n is the turn whose crest is nearest to x, and Φ the normal distribution function. For σ ≥ 9 the phase is
//! uniform on the circle within (2/π) exp(-σ²/2) < 2e-18, and P = w/π.

use std::f64::consts::{PI, SQRT_2, TAU};

use dynamics::phase::require_phase;
use dynamics::{Outcome, SolveError, Toss};
use exact::{HeadsPhases, TiltTerms, certify};

use crate::axis::{Distribution, NORMAL_REACH};
use crate::coordinate::Coordinate;
use crate::space::{Space, Values};

/// Relative error of a phase (6u by [`exact::tilt_terms::PHASE_ERROR`]), with a margin for the rounding of a few terms.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A probability with a bound on its rounding error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Share {
    /// Probability of heads, from 0 to 1.
    pub probability: f64,
    /// Bound on the rounding error, from 0 to 1. It is an estimate, not a proof.
    pub error: f64,
}

impl Share {
    pub(crate) fn new(probability: f64, error: f64) -> Self {
        Self { probability: probability.clamp(0.0, 1.0), error: error.min(1.0) }
    }

    /// The share of a single toss: 1 for heads, 0 for tails, and 0.5 ± 0.5 for an exact tie.
    fn of_one(toss: &Toss) -> Result<Self, SolveError> {
        Ok(match certify(toss)?.outcome() {
            Outcome::Heads => Self::new(1.0, 0.0),
            Outcome::Tails => Self::new(0.0, 0.0),
            Outcome::Undecided => Self::new(0.5, 0.5),
        })
    }
}

/// The share of heads over the speeds of `space`, with all other coordinates as in `values`.
pub(crate) fn share(space: &Space, values: &Values) -> Result<Share, (Box<Toss>, SolveError)> {
    let speeds = space.axis(Coordinate::Speed);
    let toss = |speed: f64| {
        let mut values = *values;
        values[Coordinate::Speed as usize] = speed;
        space.toss(&values)
    };
    let [slowest, fastest] = speeds.bounds().map(toss);
    let failed = |error: SolveError| (Box::new(fastest), error);
    let terms = TiltTerms::new(&fastest);
    let [to, spin] = terms.phases(fastest.launch.flight_time());
    let [from, _] = terms.phases(slowest.launch.flight_time());
    require_phase(to.max(spin)).map_err(failed)?;
    if from == to {
        return Share::of_one(&fastest).map_err(failed);
    }
    let heads = terms.heads();
    // The coin shows heads always or never.
    if heads.half_width_error == 0.0 {
        return Ok(Share::new(if heads.half_width > 0.0 { 1.0 } else { 0.0 }, 0.0));
    }
    Ok(match speeds.distribution() {
        Distribution::Uniform { .. } => uniform_share(&heads, from, to),
        Distribution::Normal { .. } => {
            let sd = (to - from) / (2.0 * NORMAL_REACH);
            normal_share(&heads, 0.5 * (from + to), sd)
        }
    })
}

/// The fraction of the phases from `from` to `to` > `from` (rad) that show heads.
fn uniform_share(heads: &HeadsPhases, from: f64, to: f64) -> Share {
    let (begin, end) = (Place::of(heads, from), Place::of(heads, to));
    let turns = end.turn - begin.turn;
    // Rounding errors of the phase at an end, and of its distance from an edge of the heads.
    let end_error = ROUNDING * (1.0 + to);
    let edge_error = heads.half_width_error + heads.crest_error + end_error;
    if begin.interval == end.interval && begin.to_edge.min(end.to_edge) > edge_error {
        return Share::new(if begin.interval % 2.0 == 0.0 { 1.0 } else { 0.0 }, 0.0);
    }
    let measure = 2.0 * heads.half_width * turns + (end.within - begin.within);
    let edges = 2.0 * (turns + 1.0) * heads.half_width_error + 2.0 * heads.crest_error.min(PI);
    Share::new(measure / (to - from), (edges + 3.0 * end_error) / (to - from) + ROUNDING)
}

/// The position of a phase among the intervals of heads and tails.
struct Place {
    /// Number of the nearest crest.
    turn: f64,
    /// Phase relative to the nearest crest, clamped to the interval of heads about it (rad).
    within: f64,
    /// Number of the interval: even for heads, odd for tails.
    interval: f64,
    /// Distance to the nearer edge of that interval (rad).
    to_edge: f64,
}

impl Place {
    fn of(heads: &HeadsPhases, phase: f64) -> Self {
        let turn = ((phase - heads.crest) / TAU).round();
        let from_crest = phase - heads.crest - TAU * turn;
        let within = from_crest.clamp(-heads.half_width, heads.half_width);
        let beyond = if from_crest == within { 0.0 } else { from_crest.signum() };
        let to_edge = (from_crest.abs() - heads.half_width).abs();
        Self { turn, within, interval: 2.0 * turn + beyond, to_edge }
    }
}

/// The probability of heads for a normally distributed phase with `mean` and `sd` > 0 (rad).
fn normal_share(heads: &HeadsPhases, mean: f64, sd: f64) -> Share {
    let width = heads.half_width;
    if sd >= 9.0 {
        return Share::new(width / PI, heads.half_width_error / PI);
    }
    let turn_of = |phase: f64| ((phase - heads.crest) / TAU).round();
    let [first, last] = [turn_of(mean - NORMAL_REACH * sd), turn_of(mean + NORMAL_REACH * sd)];
    let below = |phase: f64| 0.5 * libm::erfc((mean - phase) / (sd * SQRT_2));
    let (mut probability, mut turn) = (0.0, first);
    while turn <= last {
        let crest = heads.crest + TAU * turn;
        probability += below(crest + width) - below(crest - width);
        turn += 1.0;
    }
    let highest_density = 0.4 / sd;
    let edge = heads.half_width_error + heads.crest_error + ROUNDING * (1.0 + mean.abs() + NORMAL_REACH * sd);
    Share::new(probability, 2.0 * (last - first + 1.0) * (edge * highest_density + ROUNDING))
}

#[cfg(test)]
mod tests {
    use dynamics::{Coin, Outcome};

    use super::*;
    use crate::coordinate::Coordinate::{Gravity, RateX, RateY, RateZ, Speed, Tilt};

    fn share_of(coin: Coin, rate: [&str; 3], tilt: &str, speed: &str) -> Share {
        let [x, y, z] = rate;
        let space = Space::parse(coin, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed), (Tilt, tilt)]).unwrap();
        share(&space, &space.fixed_values()).unwrap()
    }

    /// The same share, found by counting the proven outcomes at the medians of 40 000 parts of equal probability.
    fn counted(coin: Coin, rate: [&str; 3], tilt: &str, speed: &str) -> f64 {
        const PARTS: u32 = 40_000;
        let [x, y, z] = rate;
        let space = Space::parse(coin, &[(RateX, x), (RateY, y), (RateZ, z), (Speed, speed), (Tilt, tilt)]).unwrap();
        let heads = (0..PARTS).filter(|part| {
            let mut values = space.fixed_values();
            values[Speed as usize] = space.axis(Speed).quantile((f64::from(*part) + 0.5) / f64::from(PARTS));
            certify(&space.toss(&values)).is_ok_and(|found| found.outcome() == Outcome::Heads)
        });
        heads.count() as f64 / f64::from(PARTS)
    }

    #[test]
    fn the_share_matches_counted_outcomes() {
        let rates = [["1", "1", "2.5"], ["20", "-31", "7"], ["0", "9", "0"], ["-3", "40", "-60"], ["2", "2", "0.5"]];
        let mut certain = 0;
        for coin in [Coin::PAPER, Coin::DISC, Coin::from_moments(1.0, 1.0).unwrap()] {
            for rate in rates {
                for tilt in ["0", "0.4", "1.5707963", "2.9", "-0.7"] {
                    for speed in ["3:5", "0:0.2", "0:300", "4:4.0001", "normal:4:0.1", "normal:4:0.4", "normal:90:9"] {
                        let share = share_of(coin, rate, tilt, speed);
                        let counted = counted(coin, rate, tilt, speed);
                        // Each edge of an interval of heads may add an error of one part; 300 m/s are at most 800
                        // turns.
                        let within = if speed.ends_with("00") || speed.ends_with(":9") { 5e-2 } else { 5e-4 };
                        let error = (share.probability - counted).abs();
                        assert!(error < within, "{rate:?} {tilt} {speed}: {share:?}, {counted}");
                        // The largest error is that of a coin that turns end over end at a tilt of nearly 90°, where
                        // cos θ stays below 1e-7.
                        assert!(share.error < 2e-6, "{rate:?} {tilt} {speed}: {share:?}");
                        certain += u32::from(share.error == 0.0);
                    }
                }
            }
        }
        assert!(certain > 20, "{certain}");
    }

    #[test]
    fn the_share_of_a_single_speed_is_0_or_1() {
        for (speed, probability) in [("0", 1.0), ("3", 0.0), ("3:3", 0.0)] {
            let share = share_of(Coin::PAPER, ["2", "2", "0.5"], "0", speed);
            assert_eq!(share, Share { probability, error: 0.0 });
        }
        // A quarter of a turn end over end: cos θ = 0 to rounding, but not exactly.
        let speed = (9.81 * PI / 36.0).to_string();
        assert_eq!(share_of(Coin::PAPER, ["0", "9", "0"], "0", &speed).error, 0.0);
        assert_eq!(share_of(Coin::PAPER, ["0", "0", "0"], "0.3", "3:5").probability, 1.0);
    }

    #[test]
    fn a_share_that_depends_on_rounding_has_an_error() {
        // Phases whose distance to the edge of the heads is about its rounding error.
        let heads = HeadsPhases { crest: 0.0, half_width: 2.0, crest_error: 1e-15, half_width_error: 1e-15 };
        for (from, to) in [(2.0 - 3e-15, 2.0 - 1e-15), (1.0, 2.0 - 1e-15), (2.0 + 1e-15, 2.0 + 3e-15)] {
            let share = uniform_share(&heads, from, to);
            assert!(share.error > 1e-15 / (to - from), "{from}, {to}: {share:?}");
        }
        assert_eq!(uniform_share(&heads, 1.0, 1.9), Share { probability: 1.0, error: 0.0 });
    }

    #[test]
    fn a_share_is_certain_only_beyond_the_error_of_the_edge() {
        let (half_width_error, crest_error, rounding) = (f64::exp2(-40.0), f64::exp2(-41.0), f64::exp2(-49.0));
        // `rounding` is the error of the phase 1: 4 ε (1 + 1).
        let error = half_width_error + crest_error + rounding;
        let heads = |half_width| HeadsPhases { crest: 0.0, half_width, crest_error, half_width_error };
        assert!(uniform_share(&heads(1.0 + error), 0.5, 1.0).error > 0.0);
        assert_eq!(uniform_share(&heads((1.0 + error).next_up()), 0.5, 1.0).error, 0.0);
        assert!(uniform_share(&heads(1.0 - error), 1.0, 1.0 + f64::EPSILON).error > 0.0);
    }

    fn assert_share(found: Share, probability: f64, error: f64) {
        assert!((found.probability - probability).abs() < 1e-15, "{found:?}, not {probability}");
        assert!((found.error - error).abs() < 1e-10 * error, "{found:?}, not {error}");
    }

    #[test]
    fn shares_and_errors_match_the_formulas() {
        let heads =
            |crest_error, half_width_error| HeadsPhases { crest: 0.5, half_width: 1.0, crest_error, half_width_error };
        let rounding = 4.0 * f64::EPSILON;
        // The range ends 0.25 rad after the fourth edge from the crest; it shows heads for 1, 2 and 0.25 rad.
        let to = 0.5 + 4.0 * PI - 0.75;
        assert_share(
            uniform_share(&heads(0.0, 0.0), 0.5, to),
            3.25 / (to - 0.5),
            rounding * (3.0 * (1.0 + to) / (to - 0.5) + 1.0),
        );
        assert_share(uniform_share(&heads(1e-2, 1e-1), 0.5, to), 3.25 / (to - 0.5), (0.6 + 0.02) / (to - 0.5));
        assert_share(uniform_share(&heads(4.0, 1e-1), 0.5, to), 3.25 / (to - 0.5), (0.6 + TAU) / (to - 0.5));
        // Φ((1.5 - 1)/0.5) - Φ((-0.5 - 1)/0.5); the crests of three turns lie within the reach of the distribution.
        let probability = 0.839_994_848_036_912_8;
        assert_share(normal_share(&heads(0.0, 0.0), 1.0, 0.5), probability, 6.0 * rounding * (6.15 * 0.8 + 1.0));
        assert_share(normal_share(&heads(1e-4, 1e-3), 1.0, 0.5), probability, 6.0 * 1.1e-3 * 0.8);
        assert_share(normal_share(&heads(1e-4, 1e-3), 1.0, 2.0), 0.381_985_954_673_481_5, 14.0 * 1.1e-3 * 0.2);
        // The crest of a single turn lies within reach.
        assert_share(normal_share(&heads(1e-4, 1e-3), 0.5, 0.1), 1.0, 2.0 * 1.1e-3 * 4.0);
    }

    #[test]
    fn a_motion_that_is_always_heads_or_never_has_a_share_without_error() {
        for speed in ["3:5", "normal:4:0.1"] {
            for (tilt, probability) in [("0", 1.0), ("3.1", 0.0)] {
                let share = share_of(Coin::PAPER, ["1", "1", "60"], tilt, speed);
                assert_eq!(share, Share { probability, error: 0.0 });
            }
            // At ψ = 45° the motion only touches cos θ = 0, but within its rounding error it may cross it.
            let share = share_of(Coin::PAPER, ["30", "0", "60"], "0", speed);
            assert!(share.probability > 1.0 - 1e-7 && share.error > 0.0, "{share:?}");
        }
    }

    #[test]
    fn a_wide_normal_speed_gives_the_long_flight_limit() {
        let wide = share_of(Coin::PAPER, ["20", "0", "3"], "0", "normal:1000:20");
        let cone = 20_f64.atan2(1.5);
        let limit = crate::long_flight_probability(cone, cone);
        assert!((wide.probability - limit).abs() < 1e-15);
        // Both formulas agree at σ = 9 rad, where the code changes from one to the other.
        let heads = TiltTerms::new(
            &Space::parse(Coin::PAPER, &[(RateX, "20"), (RateY, "0"), (RateZ, "3"), (Speed, "3")])
                .unwrap()
                .toss(&[20.0, 0.0, 3.0, 3.0, 9.81, 0.0]),
        )
        .heads();
        let [below, above] = [9.0_f64.next_down(), 9.0].map(|sd| normal_share(&heads, 100.0, sd));
        assert!((below.probability - above.probability).abs() < 1e-14, "{below:?} {above:?}");
        assert_eq!(above.error, heads.half_width_error / PI);
    }

    #[test]
    fn refuses_a_phase_above_two_to_the_53() {
        let texts = [(RateX, "1e9"), (RateY, "0"), (RateZ, "0"), (Speed, "0:1e9")];
        let space = Space::parse(Coin::PAPER, &texts).unwrap();
        let (_, error) = share(&space, &space.fixed_values()).unwrap_err();
        assert!(matches!(error, SolveError::PhaseTooLarge { .. }));
        // A phase of exactly 2^53 rad is accepted.
        let texts = [(RateX, "9007199254740992"), (RateY, "0"), (RateZ, "0"), (Speed, "0:1"), (Gravity, "2")];
        let space = Space::parse(Coin::PAPER, &texts).unwrap();
        assert!(share(&space, &space.fixed_values()).is_ok());
    }
}
