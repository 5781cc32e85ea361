//! Tests of axes: how they are read and written, their units, and what is refused.

use super::*;

const SPEED: Coordinate = Coordinate::Speed;

#[test]
fn a_grid_over_a_range_includes_both_ends() {
    let axis = Axis::parse(SPEED, "3:5:5").unwrap();
    let points: Vec<f64> = (0..5).map(|index| axis.grid_point(index, 5)).collect();
    assert_eq!(points, [3.0, 3.5, 4.0, 4.5, 5.0]);
}

#[test]
fn a_grid_over_a_normal_distribution_has_parts_of_equal_probability() {
    let axis = Axis::parse(SPEED, "normal:4:0.5:3").unwrap();
    // Φ(±0.967421566101701) = 1/6 and 5/6.
    let expected = [4.0 - 0.5 * 0.967_421_566_101_701, 4.0, 4.0 + 0.5 * 0.967_421_566_101_701];
    for (index, value) in expected.into_iter().enumerate() {
        assert!((axis.grid_point(index as u64, 3) - value).abs() < 1e-14);
    }
}

#[test]
fn a_normal_quantile_has_its_fraction_of_the_distribution_below_it() {
    let axis = Axis::parse(SPEED, "normal:0:1").unwrap();
    for part in [2f64.powi(-53), 1e-12, 1e-6, 0.01, 0.3, 0.5, 0.77, 0.999] {
        let below = 0.5 * libm::erfc(-axis.quantile(part) / std::f64::consts::SQRT_2);
        assert!((below - part).abs() < 1e-10 * part, "{part:e}: {below:e}");
    }
}

#[test]
fn extreme_draws_lie_just_within_the_bounds() {
    let axis = Axis::parse(SPEED, "normal:4:0.5").unwrap();
    let [lo, hi] = axis.bounds();
    let farthest = [2f64.powi(-53), 1.0 - 2f64.powi(-53)].map(|part| axis.quantile(part));
    assert!(lo < farthest[0] && farthest[1] < hi, "{farthest:?} in [{lo}, {hi}]");
    assert!(farthest[0] < lo + 0.06 && hi - 0.06 < farthest[1], "the bounds are no wider than need be");
}

#[test]
fn a_range_of_one_value_has_one_grid_point() {
    for text in ["4", "4:4", "4:4:1", "4:4:500"] {
        let axis = Axis::parse(SPEED, text).unwrap();
        assert_eq!(axis.points(), Some(1));
        assert_eq!(axis.grid_point(0, 1), 4.0);
        assert_eq!(axis.to_string(), "4");
    }
}

#[test]
fn the_displayed_text_parses_to_the_same_axis() {
    for text in ["0.1", "3:5", "-1.5:1e-300:7", "normal:0:2.5", "normal:-1:0.1:12", "4:4:500"] {
        let axis = Axis::parse(SPEED, text).unwrap();
        assert_eq!(Axis::parse(SPEED, &axis.to_string()), Ok(axis));
    }
}

#[test]
fn accepts_normal_distributions_up_to_the_range_of_f64() {
    assert!(Axis::normal(0.0, 1.08e307).validated(SPEED).is_ok());
    assert!(Axis::normal(-8.9e307, 1.0).validated(SPEED).is_ok());
}

#[test]
fn rejects_invalid_axes_and_names_the_coordinate() {
    // 2 (|μ| + 8.3 σ) of the last two is 1.81e308 and 1.93e308; the largest number is 1.798e308.
    #[rustfmt::skip]
    let texts = [
        "", "a", "1:2:3:4", "5:3", "nan", "1:inf", "1:2:0", "1:2:1", "1:2:-3", "1:2:2.5", "-1e308:1e308",
        "normal:1", "normal:1:0", "normal:1:-1", "normal:nan:1", "normal:1:1:0", "normal:0:1e308",
        "uniform:0:1", "normal:0:1.09e307", "normal:-8e307:2e306",
    ];
    for text in texts {
        let error = Axis::parse(SPEED, text).and_then(|axis| axis.validated(SPEED)).unwrap_err().to_string();
        assert!(error.starts_with("speed [m/s] = "), "{text}: {error}");
    }
}
