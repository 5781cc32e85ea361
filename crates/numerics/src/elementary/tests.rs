//! Tests of roots, exponentials and angles in every kind of number.

use super::*;

#[test]
fn functions_keep_the_precision_of_their_argument_also_where_they_are_exact() {
    for value in [0.0, 1.0, 0.3] {
        let number = exactly(0.0).with_precision(200).value().like(value);
        let [sin, cos] = number.sine_and_cosine();
        let zero = number.like(0.0);
        let angles = [Elementary::atan2(&number, &zero), Elementary::atan2(&zero, &number)];
        let [up, along] = angles;
        let results = [Elementary::exp(&number), Elementary::sqrt(&number), sin, cos, up, along];
        for result in results.into_iter().chain([number.pi(), number.halved(), zero]) {
            assert_eq!(Elementary::digits(&result), 200, "{value}: {result}");
        }
    }
}

/// What is said of a number of `digits`, whose value is `value`.
fn check<N: Elementary>(number: &N, value: f64, digits: i32, rounding: f64) {
    assert_eq!((number.digits(), number.rounding()), (digits, rounding), "{value}");
    assert_eq!((number.to_f64(), number.to_double_double()), (value, value.into()));
    assert_eq!(number.to_big(), exactly(value));
    assert_eq!(number.sign(), if value == 0.0 { 0.0 } else { value.signum() });
    assert_eq!((number.error(), number.clone().widened(1.0).error()), (0.0, 0.0));
    assert!(number.has_known_sign());
    assert_eq!((number.magnitude().to_f64(), number.halved().to_f64()), (value.abs(), value / 2.0));
    assert_eq!(number.times_power_of_two(5).to_f64(), 32.0 * value);
    assert_eq!((number.like(1.25).to_f64(), number.like(1.25).digits()), (1.25, digits));
    assert_eq!(number.like_big(&exactly(-3.5)).to_f64(), -3.5);
    // To the last digit but some, by numbers of more digits.
    let more = |value: &Big| value.clone().with_precision(400).value();
    let exact = more(&exactly(value));
    let (sin, cos) = exact.sin_cos();
    let [found_sin, found_cos] = number.sine_and_cosine();
    let root = if value > 0.0 { exact.sqrt() } else { Big::ZERO };
    for (name, found, exact) in [
        ("sin", found_sin, sin),
        ("cos", found_cos, cos),
        ("exp", number.exp(), exact.exp()),
        ("sqrt", Elementary::sqrt(number), root),
        ("atan2", number.atan2(&number.like(-2.0)), Elementary::atan2(&exact, &more(&exactly(-2.0)))),
        ("pi", number.pi(), Big::pi(400)),
    ] {
        let off = (more(&found.to_big()) - &exact).to_f64().value().abs();
        assert!(off <= rounding * exact.to_f64().value().abs(), "{name} of {value} with {digits} digits: {off:e}");
    }
}

#[test]
fn each_kind_of_number_keeps_what_it_promises() {
    for value in [-2.75, -1e-5, 0.0, 0.3, 1.0, 20.0] {
        check(&value, value, 53, 2f64.powi(-52));
        check(&DoubleDouble::exactly(value), value, 106, 2f64.powi(-98));
        check(&exactly(value).with_precision(150).value(), value, 150, 2f64.powi(-142));
    }
    assert_eq!(exactly(1.0).with_precision(5000).value().rounding(), 2f64.powi(-1000));
    // Of a zero with a sign, too.
    assert_eq!([Elementary::sqrt(&-0.0_f64), 0.0.magnitude()].map(f64::to_bits), [0, 0]);
    // Both parts of a double-double number count, and a sign below the range of f64.
    let third = DoubleDouble::quotient(1.0, 3.0);
    assert_eq!(third.to_big(), exactly(third.hi()) + exactly(third.lo()));
    let tiny = exactly(-1.0).with_precision(80).value().times_power_of_two(-5000);
    assert_eq!([&tiny, &tiny.magnitude()].map(Elementary::sign), [-1.0, 1.0]);
    assert_eq!(Elementary::to_f64(&tiny), 0.0);
    assert_eq!(Elementary::to_double_double(&third.to_big()), third);
}
