//! Tests of quantities with units: the table of units, conversions, and what is refused.

use std::f64::consts::PI;

use Dimension::{Acceleration, Angle, Inertia, Length, Mass, Speed, Time, TurnRate};

use super::*;

#[test]
fn a_quantity_is_written_and_read_back() {
    for (dimension, unit) in Dimension::ALL.into_iter().flat_map(|of| of.units().iter().map(move |unit| (of, unit))) {
        for value in [24.26, -1.0 / 3.0, 1e-300, 6e22, 0.0] {
            let given = unit.times(value);
            assert_eq!(dimension.given("quantity", &given.to_string()), Ok(given), "{given}");
        }
    }
}

#[test]
fn what_is_expected_names_every_unit() {
    for dimension in Dimension::ALL {
        let words = dimension.expected();
        for unit in dimension.units() {
            assert!(words.contains(unit.name()), "{words}: {}", unit.name());
        }
        let si = dimension.units()[0];
        let is_told = words.ends_with(&format!("({} without a unit)", si.name()));
        assert!(is_told || dimension == Dimension::Number, "{words}");
        assert_eq!(si.size(), Unit::ONE);
    }
}

#[test]
fn a_unit_without_a_name_is_written_as_its_size() {
    let seventh = Unit::ratio(3, 7).unwrap();
    for (dimension, size, text) in [
        (TurnRate, seventh.of_turn(), "0.1@3/7turn"),
        (Angle, seventh, "0.1@3/7"),
        (Length, seventh, "0.1@3/7"),
        (Length, Unit::ratio(1, 1000).unwrap(), "0.1mm"),
    ] {
        let given = dimension.in_unit(0.1, size);
        assert_eq!((given.to_string().as_str(), dimension.given("x", text)), (text, Ok(given)));
    }
    assert_eq!(Length.given("x", "2@1/1"), Length.given("x", "2"));
    assert_eq!(Length.given("x", "2@1/1000"), Length.given("x", "2mm"));
    for (dimension, text) in
        [(Length, "1@3/7turn"), (Length, "1@3/0"), (Angle, "1@0/3turn"), (Angle, "1@3"), (Mass, "1@")]
    {
        assert!(dimension.given("x", text).is_err(), "{text}");
    }
}

/// The expected numbers are the exact products, computed in 80 decimal digits and rounded once. Two roundings, as in
/// 181.04 × (π/180) in f64, give another number for every thirteenth angle.
#[test]
fn conversions_are_rounded_once() {
    for (dimension, text, expected) in [
        (Angle, "15deg", 0.261_799_387_799_149_46),
        (Angle, "-44°", -0.767_944_870_877_505),
        (Angle, "181.04deg", 3.159_744_077_810_534_3),
        (Angle, "0.1rev", 0.628_318_530_717_958_7),
        (TurnRate, "38rev/s", 238.761_041_672_824_3),
        (TurnRate, "600rpm", 62.831_853_071_795_86),
        (TurnRate, "33.3 deg/s", 0.581_194_640_914_111_7),
        (TurnRate, " 1e3rpm", 104.719_755_119_659_78),
        (Speed, "2.4m/s", 2.4),
        (Speed, "100km/h", 27.777_777_777_777_78),
        (Speed, "7.3mph", 3.263_392),
        (Time, "3us", 3e-6),
        (Acceleration, "981cm/s2", 9.81),
        (Acceleration, "32.174ft/s^2", 9.806_635_2),
        (Length, "24mm", 0.024),
        (Length, "0.955in", 0.024_256_999_999_999_997),
        (Mass, "5.67g", 0.005_67),
        (Inertia, "1.7 g cm²", 1.7e-7),
        (Inertia, "5e-7kg*m^2", 5e-7),
    ] {
        assert_eq!(dimension.read("x", text), Ok(expected), "{text}");
    }
    assert_eq!(181.04 * PI / 180.0, 3.159_744_077_810_534);
}

#[test]
fn a_conversion_is_exact_if_nothing_was_rounded() {
    for (dimension, text, is_exact) in [
        (Speed, "2.4", true),
        (Speed, "2.4m/s", true),
        (Speed, "250cm/s", true),
        (Speed, "240cm/s", false),
        (Speed, "18km/h", true),
        (Speed, "1km/h", false),
        (Angle, "15deg", false),
        (Angle, "0deg", true),
    ] {
        assert_eq!(dimension.given("x", text).unwrap().is_exact_in_si(), is_exact, "{text}");
    }
}

#[test]
fn an_angle_in_its_unit_is_the_converted_one_to_rounding() {
    for text in ["1", "15deg", "-44°", "0.1rev", "181.04deg"] {
        let given = Angle.given("x", text).unwrap();
        assert_eq!(given.quantity().to_f64(), given.si(), "{text}");
    }
    let millimetres = Length.given("x", "24.26mm").unwrap();
    assert_eq!(millimetres.quantity().to_f64(), millimetres.si());
}

#[test]
fn numbers_without_a_unit_and_out_of_the_range_of_f64_stay_what_they_are() {
    for text in ["3", "-0.5", "1e-300", "inf", "0"] {
        assert_eq!(Speed.read("x", text), Ok(text.parse().unwrap()));
    }
    assert!(Speed.read("x", "NaN").unwrap().is_nan() && Angle.read("x", "nandeg").unwrap().is_nan());
    assert_eq!(Angle.read("x", "1e308rev"), Ok(f64::INFINITY));
    assert_eq!(Length.read("x", "-infmm"), Ok(f64::NEG_INFINITY));
    assert_eq!(Length.read("x", "0mm"), Ok(0.0));
}

#[test]
fn other_units_and_other_texts_are_refused_with_the_units_that_fit() {
    for (dimension, text) in
        [(Speed, "3deg"), (Angle, "15d"), (Angle, "deg"), (Length, ""), (Mass, "5..1g"), (Time, "3 s s"), (Speed, "3m")]
    {
        let error = dimension.read("x [u]", text).unwrap_err();
        let expected = InputError::Malformed { field: "x [u]", value: text.to_owned(), expected: dimension.expected() };
        assert_eq!(error, expected);
    }
}

#[test]
fn numbers_that_belong_together_have_units_all_or_none() {
    let read = |text: &str| {
        let parts: Vec<_> = text.split(',').map(|part| (TurnRate, part)).collect();
        let read = read_quantities("rate", text, "rates", &parts);
        read.map(|read| read.into_iter().map(Given::si).collect::<Vec<f64>>()).map_err(|error| error.to_string())
    };
    assert_eq!(read("1,2.5,-3"), Ok(vec![1.0, 2.5, -3.0]));
    assert_eq!(read("1rev/s,0,30rpm"), Ok(vec![std::f64::consts::TAU, 0.0, PI]));
    assert!(read("1,2,3rev/s").unwrap_err().contains("a unit after each of the numbers, or after none"));
    assert!(read("1m,2m,3m").unwrap_err().contains("expected rates"));
}

#[test]
fn numbers_have_a_unit_in_common_unless_one_that_is_not_0_has_another() {
    let common = |texts: &[&str]| {
        let given: Vec<_> = texts.iter().map(|text| TurnRate.given("rate", text).unwrap()).collect();
        common_unit(&given).map(|unit| unit.name)
    };
    assert_eq!(common(&["1rev/s", "0", "-2rev/s"]), Some("rev/s"));
    assert_eq!(common(&["0rpm", "0rev/s"]), Some("rpm"));
    assert_eq!([common(&["1rev/s", "1rpm"]), common(&[])], [None, None]);
}
