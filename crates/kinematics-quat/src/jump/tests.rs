//! Tests of what a step lands off the series that starts where it does.

use super::*;

#[test]
fn a_jump_is_the_angle_that_no_shift_of_the_time_explains() {
    let (series, rates) = ([0.5, -0.5, 0.5, 0.5], [0.3, 0.4, 1.2]);
    // The shift may be 2^-53 of the time.
    let jump = |later: f64, turned: f64, time: f64| {
        let moved = half_product(series, rates).map(|part| part * later);
        let across = half_product(series, [0.8, -0.6, 0.0]).map(|part| 2.0 * part * turned);
        Jump::new(series, rates, std::array::from_fn(|part| 3.0 * (series[part] + moved[part] + across[part])), time)
    };
    let none = jump(0.0, 0.0, 1.0);
    assert!(none.turn < 2e-14 && none.shift.abs() < 1e-15, "{none:?}");
    let early = jump(-1e-11, 1e-9, 1e6);
    approx::assert_relative_eq!(early.turn, 1e-9, epsilon = 0.0, max_relative = 1e-4);
    approx::assert_relative_eq!(early.shift, -1e-11, epsilon = 0.0, max_relative = 1e-3);
    let far = jump(1e-9, 0.0, 1.0);
    // Half the rate is 0.65.
    approx::assert_relative_eq!(far.turn, 0.65e-9, epsilon = 0.0, max_relative = 1e-4);
    assert!(far.shift <= UNIT_ROUNDOFF);
    assert_eq!(Jump::new(series, rates, series.map(|part| -part), 1.0).turn, f64::INFINITY);
    assert!(!Jump::new([0.0; 4], rates, series, 1.0).turn.is_finite());
}

/// Of a jump in exact numbers that a shift explains whole, what is left are the roundings and the square of the shift.
#[test]
fn the_roundings_and_the_square_of_a_shift_count_by_their_formula() {
    const SHIFT: f64 = 1.0 / (1u64 << 34) as f64;
    for (scale, rate) in [(1.0, 2f64.powi(14)), (1.0, 2.0), (2.0, 2f64.powi(14))] {
        // Half the rate, of a quaternion of the norm 2.
        let moving = 2.0 * 0.5 * rate;
        let step = [scale * 2.0, scale * SHIFT * moving, 0.0, 0.0];
        let found = Jump::new([2.0, 0.0, 0.0, 0.0], [rate, 0.0, 0.0], step, 1e6);
        let jump = (step[0] - 2.0).hypot(step[1]);
        let expected = OF_JUMP * (2.0 * jump + SHIFT * moving) / 2.0 + 8.0 * SHIFT * SHIFT;
        assert_eq!(found.shift, SHIFT);
        approx::assert_relative_eq!(found.turn, expected, epsilon = 0.0, max_relative = 1e-12);
    }
    assert_eq!(OF_JUMP, 32.0 * UNIT_ROUNDOFF);
}

#[test]
fn elapsed_time_keeps_what_rounding_loses() {
    let mut elapsed = Elapsed::ZERO;
    for _ in 0..1000 {
        elapsed.add(1.0, -1e-17);
    }
    approx::assert_relative_eq!(elapsed.off(1000.0), 1e-14, epsilon = 0.0, max_relative = 1e-9);
    let mut even = Elapsed::ZERO;
    (0..1000).for_each(|_| even.add(2.0, 0.0));
    // 8 u² a step, of the whole.
    approx::assert_relative_eq!(
        even.off(2000.0),
        8.0 * 2f64.powi(-106) * 1000.0 * 2000.0,
        epsilon = 0.0,
        max_relative = 1e-12
    );
    assert!(Elapsed::ZERO.off(0.0) == 0.0);
    // The rounding of the difference itself.
    assert_eq!(Elapsed::ZERO.off(1.0), 1.0 + 2.0 * UNIT_ROUNDOFF);
}
