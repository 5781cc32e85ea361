//! Tests of schemes with their step control, and of the error estimates.

use nalgebra::Vector3;

use super::*;
use crate::coin::Coin;
use crate::launch::Launch;
use crate::time_of_flight::TimeOfFlight;

#[test]
fn the_error_estimate_follows_from_the_tolerance_or_from_the_order_and_the_step() {
    // A sphere at 2 rad/s for 3 s: a phase of 6 rad.
    let launch = Launch::new(Vector3::new(0.0, 2.0, 0.0), TimeOfFlight::Given(3.0)).unwrap();
    let toss = Toss::new(Coin::from_moments(1.0, 1.0).unwrap(), launch);
    let near = |found: f64, expected: f64| assert!((found / expected - 1.0).abs() < 1e-12, "{found}, not {expected}");
    let adaptive = Stepping::adaptive(Scheme::DOPRI5, 1e-8).unwrap();
    // 1e-8^(-1/5) is 39.8, and 64 the next power of two.
    near(
        adaptive.error_estimate(&toss).unwrap().unwrap(),
        (100.0 * 1e-8 + 4.0 * f64::EPSILON * (1.0 + 0.25 * 64.0 * 7.0)) * 7.0,
    );
    let series = Stepping::adaptive(Scheme::TAYLOR, f64::EPSILON).unwrap();
    near(series.error_estimate(&toss).unwrap().unwrap(), (100.0 + 4.0 * (1.0 + 0.25 * 7.0)) * f64::EPSILON * 7.0);
    let fixed = Stepping::fixed(Scheme::RK4, 0.01).unwrap();
    let truncation = 0.02_f64.powi(4) * (1.0 + 0.02 * 6.0 / 100.0);
    near(fixed.error_estimate(&toss).unwrap().unwrap(), (truncation + 4.0 * f64::EPSILON * 301.0) * 7.0);
}

/// A flight of 1000 rad has a tenth of its tolerance, so that its steps are as many as those of that tolerance.
#[test]
fn the_estimate_of_a_long_flight_counts_the_steps_of_its_tightened_tolerance() {
    let launch = Launch::new(Vector3::new(0.0, 2.0, 0.0), TimeOfFlight::Given(500.0)).unwrap();
    let toss = Toss::new(Coin::from_moments(1.0, 1.0).unwrap(), launch);
    for (tolerance, root) in [(1e-11, 32.0), (1e-12, 64.0), (1e-15, 128.0), (f64::EPSILON, 128.0)] {
        let expected = (100.0 * tolerance + 4.0 * f64::EPSILON * (1.0 + 0.25 * root * 1001.0)) * 1001.0;
        let found = Stepping::adaptive(Scheme::DOP853, tolerance).unwrap().error_estimate(&toss).unwrap().unwrap();
        assert!((found / expected - 1.0).abs() < 1e-12, "{tolerance:e}: {found:e}, not {expected:e}");
    }
}

/// The documented defaults, on which the figures of every flight without settings rest.
#[test]
fn the_defaults_are_dop853_at_a_tolerance_of_1e_10_and_steps_of_a_millisecond() {
    let default = (Stepping::DEFAULT.scheme(), Stepping::DEFAULT.control());
    assert_eq!(default, (Scheme::DOP853, StepControl::Tolerance(1e-10)));
    assert_eq!([Stepping::DEFAULT_TOLERANCE, Stepping::DEFAULT_STEP], [1e-10, 1e-3]);
}

#[test]
fn a_stepping_that_was_written_is_read_back_and_others_are_refused_by_name() {
    let (fine, own_step) = (Stepping::adaptive(Scheme::TAYLOR, 1.0 / 3e9), Stepping::fixed(Scheme::DOPRI5, 1.0 / 3.0));
    for stepping in [Stepping::DEFAULT, fine.unwrap(), own_step.unwrap(), Stepping::of(Scheme::RK4).unwrap()] {
        assert_eq!(stepping.to_string().parse(), Ok(stepping));
    }
    assert_eq!(Stepping::of(Scheme::RK4).unwrap().to_string(), "rk4 step=1e-3s");
    assert_eq!("dopri5".parse(), Stepping::adaptive(Scheme::DOPRI5, Stepping::DEFAULT_TOLERANCE));
    assert_eq!(" rk4  step = 2 ms ".replace(" = ", "=").parse(), Stepping::fixed(Scheme::RK4, 0.002));
    for (text, message) in [
        ("heun", "scheme = 'heun' is unknown"),
        ("rk4 tolerance=1e-9", "scheme with a tolerance = 'rk4'"),
        ("taylor step=1e-3", "scheme with a step = 'taylor'"),
        ("dop853 tolerance=2", "tolerance = 2.0 is outside"),
        ("dop853 tolerance=small", "stepping = 'dop853 tolerance=small'"),
        ("dop853 1e-9", "stepping = 'dop853 1e-9'"),
        ("rk4 step=3m", "step [s] = '3m'"),
    ] {
        let error = text.parse::<Stepping>().unwrap_err().to_string();
        assert!(error.starts_with(message), "{error}");
    }
}

#[test]
fn tightening_stops_at_epsilon_and_does_not_change_fixed_steps() {
    let adaptive = Stepping::adaptive(Scheme::DOP853, 1e-10).unwrap();
    assert_eq!(adaptive.tightened(0.5), adaptive);
    assert_eq!(adaptive.tightened(100.0), Stepping::adaptive(Scheme::DOP853, 1e-12).unwrap());
    assert_eq!(adaptive.tightened(1e9), Stepping::adaptive(Scheme::DOP853, f64::EPSILON).unwrap());
    let fixed = Stepping::fixed(Scheme::RK4, 0.01).unwrap();
    assert_eq!(fixed.tightened(100.0), fixed);
}

#[test]
fn takes_tolerances_from_epsilon_to_below_1_and_steps_above_0() {
    for (tolerance, taken) in [(f64::EPSILON, true), (0.999, true), (1.0, false), (0.99 * f64::EPSILON, false)] {
        assert_eq!(Stepping::adaptive(Scheme::DOPRI5, tolerance).is_ok(), taken, "{tolerance}");
    }
    for (step, taken) in [(5e-324, true), (1e9, true), (0.0, false), (-1.0, false), (f64::NAN, false)] {
        assert_eq!(Stepping::fixed(Scheme::RK4, step).is_ok(), taken, "{step}");
    }
    let stepping = Stepping::fixed(Scheme::RK4, 0.25).unwrap();
    assert_eq!((stepping.scheme(), stepping.control()), (Scheme::RK4, StepControl::Step(0.25)));
}
