//! The same flight can be given as a time, as a throw under any gravity, or as a throw that is caught above or below
//! the launch. The launches of the suite take these forms in turn, so that a solver that ignores one of their inputs
//! fails.
//!
//! A throw is chosen by the time that it takes: errors depend on that time alone, and bounds hold for every form.

use toss::{Launch, TimeOfFlight, Vector3};

/// The weakest and the strongest gravity of the throws (m/s²): about those of the Moon and of Jupiter.
const GRAVITY: [f64; 2] = [1.62, 24.8];

/// The fastest throw, in units of g T/2, the speed of a throw that lasts T and is caught at the height of the launch. A
/// throw of twice that speed is caught at its apex.
const FASTEST: f64 = 1.95;

/// A number from 0 to 1. The numbers of many turns are spread evenly, independently for each `irrational` factor.
#[expect(clippy::cast_precision_loss, reason = "turns stay far below 2^53")]
pub fn evenly(turn: u64, irrational: f64) -> f64 {
    (turn as f64 * irrational).fract()
}

/// A flight that lasts as long as `flight`, to rounding, in a form that `turn` chooses: of each five, one stays as it
/// is, one is given by its time, one thrown under another gravity, and two are caught above or below the launch.
pub fn throw(flight: TimeOfFlight, turn: u64) -> TimeOfFlight {
    let time = flight.seconds();
    let [weakest, strongest] = GRAVITY;
    let gravity = weakest * (strongest / weakest).powf(evenly(turn, 0.618_033_988_749_894_9));
    let level = 0.5 * gravity * time;
    let part = FASTEST * evenly(turn, std::f64::consts::SQRT_2);
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
