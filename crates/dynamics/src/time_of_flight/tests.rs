//! Tests of the times of flight against numbers of 200 digits, and of the refusal of impossible throws. Inputs reach to
//! the ends of the range of f64, where intermediate results over- or underflow most easily.

use super::*;
use crate::launch::Launch;

#[test]
fn a_launch_with_another_time_of_flight_is_that_which_is_made_with_it() {
    let [long, short] = [TimeOfFlight::Given(2.0), TimeOfFlight::Ballistic { speed: 1.0, gravity: 8.0 }];
    let launch = |time| Launch::new([1.0, 2.0, 3.0], time).unwrap().with_tilt(0.3).unwrap();
    assert_eq!(launch(long).with_time_of_flight(short), Ok(launch(short)));
    assert_eq!(launch(long).with_time_of_flight(short).unwrap().flight_time(), 0.25);
}

/// Compares with 200 digits, for short and long falls, from rest, at the apex and next to it.
#[test]
fn a_flight_to_another_height_lasts_until_its_later_crossing() {
    use dashu_float::FBig;
    use dashu_float::round::mode::HalfEven;
    type Big = FBig<HalfEven>;
    let big = |value: f64| Big::try_from(value).unwrap().with_precision(700).value();
    let apex = -3.0 * 3.0 / (2.0 * 9.81);
    let cases = [
        [3.0, 9.81, 0.0],
        [3.0, 9.81, 1.3],
        [3.0, 9.81, -0.3],
        [3.0, 9.81, apex * (1.0 - 1e-9)],
        [4.0, 2.0, -4.0],
        [0.0, 9.81, 1.0],
        [1e-300, 9.81, 1.0],
        [3.0, 9.81, 1e-300],
        [1e200, 1e-20, -1.0],
        [1e-160, 1e-3, 1e-310],
        [0.0, 5e-324, 5e-324],
        [5e-324, 1.0, 0.0],
    ];
    for [speed, gravity, drop] in cases {
        let time = TimeOfFlight::BallisticTo { speed, gravity, drop };
        assert!(time.validated_seconds().is_ok());
        let [v, g, h] = [speed, gravity, drop].map(big);
        let exact = (&v + (&v * &v + big(2.0) * &g * h).sqrt()) / g;
        let digits = time.in_digits(700) - &exact;
        assert!(digits.to_f64().value().abs() <= 1e-200 * exact.to_f64().value(), "{speed} {gravity} {drop}: {digits}");
        let (mantissa, exponent) = (time.exact().mantissa(), time.exact().exponent());
        assert!(exact == big(0.0) || (0.5..=2.0).contains(&mantissa.hi()), "{mantissa:?}");
        let found = (big(mantissa.hi()) + big(mantissa.lo()))
            * (Big::ONE << 1100 >> (1100 - isize::try_from(exponent).unwrap()));
        let error = ((found - &exact) / &exact).to_f64().value().abs();
        assert!(error < 25.0 * 2f64.powi(-106), "{speed} {gravity} {drop}: {error:e}");
        assert_eq!(time.seconds(), exact.to_f64().value());
    }
}

#[test]
fn an_impossible_throw_is_refused_with_the_field_at_fault() {
    let field = |speed, gravity, drop| {
        let time = TimeOfFlight::thrown(speed, gravity, drop);
        Launch::new([0.0; 3], time).err().map(|error| error.field())
    };
    for drop in [None, Some(0.0)] {
        assert_eq!([0.0, 3.0].map(|speed| field(speed, 9.81, drop)), [None, None]);
        assert_eq!([-1e-9, f64::NAN].map(|speed| field(speed, 9.81, drop)), [Some("speed [m/s]"); 2]);
        assert_eq!([0.0, -9.81].map(|gravity| field(3.0, gravity, drop)), [Some("gravity [m/s²]"); 2]);
    }
    // A height that is never reached, and a time that overflows.
    let apex = -3.0 * 3.0 / (2.0 * 9.81);
    assert_eq!([apex, 1.3].map(|drop| field(3.0, 9.81, Some(drop))), [None, None]);
    assert_eq!([-0.459, -1e300, f64::NAN].map(|drop| field(3.0, 9.81, Some(drop))), [Some("drop [m]"); 3]);
    assert_eq!(field(1e300, 1e-300, None), Some("time of flight 2 v0/g [s]"));
    assert_eq!(TimeOfFlight::Given(0.0).validated_seconds(), Ok(0.0));
    assert!(TimeOfFlight::Given(-5e-324).validated_seconds().is_err());
}

#[test]
fn a_coin_flies_if_it_is_thrown_up_or_has_a_way_to_fall() {
    let thrown = |speed, drop| TimeOfFlight::thrown(speed, 9.81, drop).is_positive();
    for (speed, drop, flies) in [
        (0.0, None, false),
        (5e-324, None, true),
        (0.0, Some(0.0), false),
        (5e-324, Some(0.0), true),
        (0.0, Some(5e-324), true),
    ] {
        assert_eq!(thrown(speed, drop), flies, "{speed} {drop:?}");
    }
    assert!(TimeOfFlight::Given(5e-324).is_positive() && !TimeOfFlight::Given(0.0).is_positive());
}

/// The rest has to be that of the exact quotient, whose digits no other number's size may cost.
#[test]
fn a_compensated_time_has_twice_the_digits_of_f64() {
    let speeds = [3.1, 1e-240, 1e-260, 1e-300, 1.7e-308, 3e-310, 7e-320, 5e-324, 1.7e300, 8.9e307];
    for (speed, gravity) in speeds.into_iter().flat_map(|speed| {
        let gravities = [9.81, 1e-3, 1.7e5, 0.31 * speed, 7e-9 * speed, 1e-310, 1.3e300].into_iter();
        gravities.filter(|gravity| *gravity > 0.0).map(move |gravity| (speed, gravity))
    }) {
        let time = TimeOfFlight::Ballistic { speed, gravity };
        if !time.seconds().is_finite() {
            continue;
        }
        let ([rounded, rest], exact) = (time.compensated(), time.exact());
        assert!(rest.abs() <= f64::EPSILON * rounded, "{speed:e} {gravity:e}: {rest:e} of {rounded:e}");
        let lo = exact.mantissa.times_power_of_two(exact.exponent).lo();
        // Of a time below 1e-290 s the rest leaves the range of f64.
        let within = 1e-14 * lo.abs() + 1e-32 * rounded + f64::MIN_POSITIVE;
        assert!((rest - lo).abs() <= within, "{speed:e} {gravity:e}: {rest:e}, not {lo:e}");
    }
}

#[test]
fn a_throw_of_another_speed_takes_the_time_of_that_speed() {
    for (time, at_five) in [
        (TimeOfFlight::thrown(3.0, 9.81, None), TimeOfFlight::thrown(5.0, 9.81, None)),
        (TimeOfFlight::thrown(3.0, 9.81, Some(0.3)), TimeOfFlight::thrown(5.0, 9.81, Some(0.3))),
        (TimeOfFlight::thrown(3.0, 9.81, Some(-0.3)), TimeOfFlight::thrown(5.0, 9.81, Some(-0.3))),
    ] {
        assert_eq!((time.throw(), time.with_speed(5.0)), (Some([3.0, 9.81]), Some(at_five)));
        assert!((time.speed_of(at_five.seconds()).unwrap() - 5.0).abs() < 1e-14, "{time:?}");
    }
    let given = TimeOfFlight::Given(1.0);
    assert_eq!((given.throw(), given.drop(), given.with_speed(5.0), given.speed_of(1.0)), (None, None, None, None));
}
