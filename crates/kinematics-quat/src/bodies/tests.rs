//! Tests of one step and of the right-hand side, against the exact motion and central differences.

use dynamics::{Attitude, Body, Launch, TimeOfFlight, Vector3};
use exact::RigidMotion;
use numerics::lanes::{SimdLevel, WithSimd};

use super::*;

fn toss(moments: [f64; 3], rate: [f64; 3], time: f64) -> RigidToss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
    RigidToss { body: Body::from_moments(moments).unwrap(), launch }
}

/// Compares the right-hand side with central differences of the exact motion.
#[test]
fn the_derivative_is_that_of_the_exact_motion() {
    let toss = toss([1.0, 2.0, 2.5], [0.7, -0.4, 1.1], 1.0);
    let (motion, system) = (RigidMotion::new(&toss), RigidSystem::new(toss.body.couplings()));
    let h = 1e-5;
    for step in 1..8 {
        let time = 0.3 * f64::from(step);
        let [before, now, after] = [time - h, time, time + h].map(|time| motion.state(time).unwrap());
        let [w, x, y, z] = now.attitude.components();
        let found = system.derivative(&SVector::from([w, x, y, z, now.rate.x, now.rate.y, now.rate.z]));
        let slope = |a: f64, b: f64| (a - b) / (2.0 * h);
        for part in 0..4 {
            let expected = slope(after.attitude.components()[part], before.attitude.components()[part]);
            assert!((found[part] - expected).abs() < 1e-9, "component {part} at {time}");
        }
        for axis in 0..3 {
            assert!(
                (found[4 + axis] - slope(after.rate[axis], before.rate[axis])).abs() < 1e-9,
                "rate {axis} at {time}"
            );
        }
    }
}

/// The turn and half the rates after a step of this order and length.
struct Step([f64; 3], [f64; 3], usize, f64);

impl WithSimd for Step {
    type Output = [f64; 7];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [f64; 7] {
        let Self(rates, couplings, order, h) = self;
        let mut series = Bodies::series(simd);
        let splat = |value: f64| Real::splat(simd, value);
        series.expand(order, rates.map(|rate| splat(0.5 * rate)), couplings.map(|coupling| splat(2.0 * coupling)));
        series.after(order, splat(h)).map(|value| {
            let mut number = [0.0];
            value.store_up_to(&mut number);
            number[0]
        })
    }
}

#[test]
fn a_step_of_the_largest_order_is_the_exact_motion() {
    let h = 0.3;
    for (moments, rate) in [([1.0, 2.0, 2.5], [0.7, -0.4, 1.1]), ([1.0, 1.9, 2.0], [0.1, 0.9, -0.4])] {
        let toss = toss(moments, rate, h);
        let exact = RigidMotion::new(&toss).state(h).unwrap();
        let [w, x, y, z, a, b, c] = SimdLevel::widest().run(Step(rate, toss.body.couplings(), LARGEST_ORDER, h));
        assert!(exact.attitude.angle_to(&Attitude::from_components([w, x, y, z]).unwrap()) < 1e-15);
        assert!((exact.rate - 2.0 * Vector3::new(a, b, c)).norm() < 1e-15);
    }
}

#[test]
fn the_local_error_of_order_n_falls_with_power_n_plus_1_of_the_step() {
    let error = |order: usize, h: f64| {
        let couplings = [-0.5, 0.75, -0.4];
        let [rough, fine] =
            [order, LARGEST_ORDER].map(|order| SimdLevel::widest().run(Step([0.9, -0.5, 0.7], couplings, order, h)));
        rough.iter().zip(fine).map(|(rough, fine)| (rough - fine).abs()).fold(0.0, f64::max)
    };
    for order in 2..=9 {
        let ratio = error(order, 0.3) / error(order, 0.15);
        let expected = f64::exp2(order as f64 + 1.0);
        assert!((ratio / expected - 1.0).abs() < 0.3, "order {order}: {ratio}, not {expected}");
    }
}
