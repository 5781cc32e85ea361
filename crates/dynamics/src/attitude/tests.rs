//! Tests of attitudes: what a turn does to vectors, norms, and angles between attitudes.

use std::f64::consts::{FRAC_PI_2, PI};

use super::*;

#[test]
fn rounding_takes_no_cosine_beyond_1() {
    for index in 0..1000 {
        let spun = Attitude::about_z(0.01 * f64::from(index));
        for attitude in [spun, Attitude::about_x(PI) * spun] {
            assert!(attitude.cos_tilt().acos().is_finite(), "{attitude:?}");
            assert!(attitude.normal().iter().all(|part| part.acos().is_finite()), "{attitude:?}");
        }
    }
}

#[test]
fn right_factors_turn_about_the_bodys_axes() {
    let tipped_then_spun = Attitude::about_x(FRAC_PI_2) * Attitude::about_z(1.0);
    approx::assert_abs_diff_eq!(tipped_then_spun.normal(), -Vector3::y(), epsilon = 1e-15);
    let spun_then_tipped = Attitude::about_z(FRAC_PI_2) * Attitude::about_x(FRAC_PI_2);
    approx::assert_abs_diff_eq!(spun_then_tipped.normal(), Vector3::x(), epsilon = 1e-15);
}

#[test]
fn the_sign_of_the_quaternion_does_not_matter() {
    let [w, x, y, z] = (Attitude::about_x(1.2) * Attitude::about_z(0.4)).components();
    let [plus, minus] = [[w, x, y, z], [-w, -x, -y, -z]].map(|q| Attitude::from_components(q).unwrap());
    assert_eq!(plus.cos_tilt(), minus.cos_tilt());
    approx::assert_abs_diff_eq!(plus.angle_to(&minus), 0.0, epsilon = 1e-15);
}

#[test]
fn the_angle_between_attitudes_is_precise_for_small_and_large_turns() {
    for angle in [1e-300, 1e-12, 0.3, PI] {
        approx::assert_relative_eq!(
            Attitude::IDENTITY.angle_to(&Attitude::about_z(angle)),
            angle,
            epsilon = 0.0,
            max_relative = 1e-15
        );
    }
}

#[test]
fn components_are_normalised_without_over_or_underflow() {
    for size in [1e-320, 1.0, 1e300] {
        let attitude = Attitude::from_components([size, 0.0, 0.0, size]).unwrap();
        approx::assert_abs_diff_eq!(attitude.angle_to(&Attitude::about_z(FRAC_PI_2)), 0.0, epsilon = 1e-15);
    }
    for bad in [[0.0; 4], [f64::NAN, 0.0, 0.0, 1.0], [f64::INFINITY, 0.0, 0.0, 1.0]] {
        assert!(Attitude::from_components(bad).is_err());
    }
}
/// A quarter of a turn about the lab's x axis makes the lab's y axis the vertical. Components have any norm.
#[test]
fn both_verticals_in_the_body_are_unit_vectors_and_those_of_more_digits() {
    let given = [[0.3, -0.7, 0.5, 0.4], [3e200, 7e200, -5e200, 4e200], [0.0, 1.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]];
    let attitudes = given.map(|components| Attitude::from_components(components).unwrap());
    let made = [Attitude::about_x(2.5), Attitude::about_z(1.0), Attitude::about_z(1.0) * Attitude::about_x(0.4)];
    for attitude in attitudes.into_iter().chain(made) {
        let (rough, norm) = attitude.vertical();
        approx::assert_abs_diff_eq!(Vector3::from(rough) / norm, attitude.lab_to_body(&Vector3::z()), epsilon = 1e-15);
        for (axis, vertical, (exact, norm)) in [
            (Vector3::z(), attitude.exact_vertical(), attitude.vertical_in_digits(100)),
            (Vector3::y(), attitude.exact_quarter_turned_vertical(), attitude.quarter_turned_vertical_in_digits(100)),
        ] {
            let rounded = Vector3::from(vertical.map(DoubleDouble::hi));
            approx::assert_abs_diff_eq!(rounded, attitude.lab_to_body(&axis), epsilon = 1e-15);
            for (exact, found) in exact.iter().zip(vertical) {
                let exact = exact / norm.clone().with_precision(100).value();
                let error = exact - exactly(found.hi()) - exactly(found.lo());
                assert!(error.to_f64().value().abs() < 1e-20, "{attitude:?}");
            }
        }
    }
}

/// What a product rounds is not what was given.
#[test]
fn an_attitude_keeps_what_it_was_made_from() {
    let tilted = Attitude::about_x(0.7);
    assert_eq!((tilted.tilt(), Attitude::about_x(0.0)), (Some(0.7.into()), Attitude::IDENTITY));
    let given = [0.3, -0.7, 0.5, 0.4];
    assert_eq!(Attitude::from_components(given).unwrap().given_components(), given);
    assert_eq!((tilted * tilted).tilt(), None);
    assert_ne!(Attitude::from_components(tilted.components()).unwrap(), tilted);
    assert_eq!(Attitude::from_components([4.0, 0.0, 0.0, 0.0]), Ok(Attitude::IDENTITY));
}
