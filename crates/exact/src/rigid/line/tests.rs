use dynamics::{Body, Launch, TimeOfFlight};
use numerics::big::exactly;

use super::*;

fn toss() -> Toss {
    let launch = Launch::new([3.0, 2.0, 5.0], TimeOfFlight::Given(0.8)).unwrap();
    Toss { body: Body::from_moments([1.0, 2.0, 2.25]).unwrap(), launch }
}

/// A rate below 10^-250 in another unit has fewer digits of its own, which are enough for a motion of such rates alone.
#[test]
fn tiny_rates_in_another_unit_have_the_outcome_of_the_scaled_motion() {
    let thirds = dynamics::Unit::ratio(1, 3).unwrap();
    let body = Body::from_moments([1.0, 2.0, 2.5]).unwrap();
    for time in [0.3, 1.0, 1.7] {
        let [found, expected] = [1e-260, 1.0].map(|scale: f64| {
            let rate = [18.0, 9.0, 12.0].map(|part: f64| part * scale);
            let launch = Launch::in_unit(rate, thirds, TimeOfFlight::Given(time / scale)).unwrap();
            Line::new(&Toss { body, launch }, Input::Time).outcome_at(0.0)
        });
        assert!(found == expected && found != Outcome::Undecided, "{time}: {found:?} {expected:?}");
    }
}

/// By exact arithmetic, and a ball is as small as the digits allow.
#[test]
fn balls_of_rates_contain_the_rates_as_they_were_given_and_all_changes() {
    let (body, thirds) = (toss().body, dynamics::Unit::ratio(1, 3).unwrap());
    for scale in [1.0, 1e200, 1e-300] {
        let rate = [3.1, -0.7, 4.9].map(|part| part * scale);
        let launch = Launch::in_unit(rate, thirds, TimeOfFlight::Given(0.8)).unwrap();
        let (toss, input) = (Toss { body, launch }, Input::Rate(1));
        let line = Line::new(&toss, input);
        for change in [0.0, 0.3 * scale, -0.2 * scale] {
            let moved = line.moved(&line.fine.given, change);
            let in_unit = |value: f64| exactly(value).times_power_of_two(-moved.exponent);
            for (axis, ball) in moved.rate.into_iter().enumerate() {
                let change = in_unit(if axis == 1 { change } else { 0.0 }).times_power_of_two(line.change_exponent);
                let off = (exactly(3.0) * (ball.to_big() - change) - in_unit(rate[axis])).magnitude();
                assert!(off <= exactly(3.0) * exactly(ball.radius()), "{scale} {axis}: {}", ball.radius());
                assert!(ball.radius() <= 10.0 * 2f64.powi(-97), "{scale} {axis}: {}", ball.radius());
            }
        }
    }
}

/// In a unit near the largest, squares of rates stay in the range of f64.
#[test]
fn rates_of_any_size_are_decided_in_f64() {
    for scale in [1e-200, 1e-100, 1e100, 1e200] {
        let launch = Launch::new([3.0, 2.0, 5.0].map(|part| part * scale), TimeOfFlight::Given(0.8 / scale)).unwrap();
        let scaled = Toss { launch, ..toss() };
        let sign = |toss: &Toss| Line::new(toss, Input::Rate(0)).enclosure(0, 0.0, 0.0).sign();
        assert!(sign(&scaled) == sign(&toss()) && sign(&scaled) != 0.0, "{scale:e}");
    }
}

#[test]
fn each_stage_has_its_own_digits() {
    let toss = toss();
    let line = Line::new(&toss, Input::Time);
    for (index, digits) in DIGITS.into_iter().take(WORK.len() - 2).enumerate() {
        assert_ne!(line.enclosure(2 + index, 0.0, 0.0).sign(), 0.0);
        let made = line.many.each_ref().map(|stage| stage.get().map(|stage| stage.given.time.digits()));
        assert_eq!(made[index], i32::try_from(digits).ok());
        assert!(made[index + 1..].iter().all(Option::is_none), "{made:?}");
    }
}
