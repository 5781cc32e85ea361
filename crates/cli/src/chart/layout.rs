//! What the panels of a flight share: colours, times, and how many points the curves need. The panels stand above and beside
//! each other, so they have to agree on these.

use chart::Axis;
use plotters::style::RGBColor;
use toss::{CoinMotion, ExactMotion, Toss, TracePoint};

/// The colour of n.
pub(super) const NORMAL: RGBColor = chart::BLUE;
/// The colour of the vector in the face.
pub(super) const FACE: RGBColor = chart::VERMILION;

/// Space beside the panels over time (pixels), for "heads" and "tails".
pub(super) const RIGHT: u32 = 110;

/// How many coins are drawn.
pub(super) const COINS: usize = 11;

/// Points of a curve for each turn: at 60 a chord is nowhere farther than 0.0014 radii from its circle.
const POINTS_PER_TURN: f64 = 60.0;
/// More turns than these would be too narrow to be seen; a faster flight is drawn by as many points.
const MOST_TURNS: f64 = 500.0;
/// The fewest turns' worth of points, for a flight of less than a turn.
const FEWEST_TURNS: f64 = 2.0;

/// The axis of the times that are drawn (s), with room for half a coin at either end.
pub(super) fn times(label: &str, flight: &[TracePoint]) -> Axis {
    let end = flight.last().map_or(0.0, |point| point.time).max(f64::MIN_POSITIVE);
    Axis::linear(label, -0.06 * end..1.06 * end)
}

/// How many points the curves of `toss` are drawn by. The coins are at points of the curve, at equal times.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 30 000")]
pub(crate) fn points_to_draw(toss: &Toss) -> usize {
    let between_coins = POINTS_PER_TURN * turns(toss).clamp(FEWEST_TURNS, MOST_TURNS) / (COINS - 1) as f64;
    between_coins.ceil() as usize * (COINS - 1) + 1
}

/// Whether the flight has more turns than can be drawn.
pub(super) fn is_too_fast(toss: &Toss) -> bool {
    turns(toss) > MOST_TURNS
}

/// Turns of the fastest motion of a flight: n goes round S at ωL, and the coin spins about n at (1 - k) ωz as well. Of
/// another body they are twice the larger one of its two phases.
fn turns(toss: &Toss) -> f64 {
    let Some(toss) = toss.coin() else {
        let phase = ExactMotion::new(toss).phase(toss.launch.time_of_flight());
        return phase.map_or(f64::INFINITY, |phase| 2.0 * phase / std::f64::consts::TAU);
    };
    let spin = (1.0 - toss.coin.inertia_ratio()) * toss.launch.rate().z;
    let rate = CoinMotion::new(&toss).precession_rate() + spin.abs();
    let turns = rate * toss.launch.flight_time() / std::f64::consts::TAU;
    // An infinite rate for no time at all.
    if turns.is_nan() { 0.0 } else { turns }
}

#[cfg(test)]
mod tests {
    use toss::{Body, Coin, Launch, TimeOfFlight};

    use super::*;

    fn toss(rate: [f64; 3], time: f64) -> Toss {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
        Toss { body: Coin::PAPER.into(), launch }
    }

    #[test]
    fn a_body_of_three_moments_has_points_for_each_of_its_turns() {
        let body: Body = "racket".parse().unwrap();
        let drawn = |rate, time| points_to_draw(&Toss { body, ..toss(rate, time) });
        // About y for sixteen turns, which the racket does not do for ever, and about its handle.
        assert!((1900..2000).contains(&drawn([0.0, 10.0, 0.0], 10.0)), "{}", drawn([0.0, 10.0, 0.0], 10.0));
        assert!((950..4000).contains(&drawn([0.01, 10.0, 0.01], 10.0)), "{}", drawn([0.01, 10.0, 0.01], 10.0));
        assert_eq!(drawn([0.0, 1e300, 0.0], 10.0), 30_001);
    }

    #[test]
    fn curves_have_sixty_points_for_each_turn_of_n_and_of_the_face() {
        // ωL = 10 rad/s without spin, and ωL = spin = 20 rad/s: 16 and 64 turns in ten seconds.
        let [wobbling, spinning] = [[6.0, 8.0, 0.0], [0.0, 0.0, 40.0]].map(|rate| points_to_draw(&toss(rate, 10.0)));
        assert!((955..980).contains(&wobbling), "{wobbling}");
        assert!((3820..3850).contains(&spinning), "{spinning}");
    }

    #[test]
    fn flights_of_no_time_or_of_countless_turns_have_a_bounded_number_of_points() {
        let fastest = [1.7e308; 3];
        for (rate, time, is_fast) in [([0.0; 3], 0.0, false), (fastest, 0.0, false), (fastest, 1e300, true)] {
            let flight = toss(rate, time);
            assert!((121..=30_001).contains(&points_to_draw(&flight)), "{rate:?}");
            assert_eq!(is_too_fast(&flight), is_fast);
        }
    }
}
