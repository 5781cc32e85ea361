use dynamics::{Body, Launch, TimeOfFlight};

use super::super::{Reference, decimal};
use super::*;

fn body(inertia: [f64; 6], rate: [f64; 3], tilt: f64, time: f64) -> Toss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap().with_tilt(tilt).unwrap();
    Toss { body: Body::from_inertia(inertia).unwrap(), launch }
}

/// The digits come from another program: an integration in 77 digits with mpmath, of the decimals as they are here.
#[test]
fn bodies_with_nearly_equal_moments_land_as_in_another_program() {
    for (inertia, rate, tilt, time, cos_tilt) in [
        (["1", "1", "1", "0", "-5e-18", "0"], ["6", "9", "7"], "0", "0.3", "-0.23301267842557283621"),
        (["1", "1", "1", "0", "-1e-19", "0"], ["8", "8", "-7"], "0", "0.8", "0.027325799927544077315"),
        (["1", "1", "0.5", "-1e-17", "0", "0"], ["3", "4", "5"], "0", "0.5", "-0.55245159221779951"),
        (["1.5", "1.5", "1.5", "-0.2", "-0.2", "-0.2"], ["-6", "-15.6", "-4.9"], "0", "0.41", "0.14912853846257760843"),
        (["1.25", "1", "1", "0", "0", "-3e-18"], ["-1.35", "-6", "3"], "1.2", "1.94", "-0.20229905379638641134"),
        (
            ["0.7", "0.7", "0.7", "0", "-3e-18", "-7e-19"],
            ["-0.6", "-11.09", "-11.23"],
            "-2",
            "2.08",
            "-0.66528433707389281",
        ),
    ] {
        // The exact number that the decimals of an element are.
        let exactly = |text: &str| decimal(text).with_precision(0).value();
        let [xx, yy, zz, xy, xz, yz] = inertia.map(exactly);
        let tensor = [[xx, xy.clone(), xz.clone()], [xy, yy, yz.clone()], [xz, yz, zz]];
        let flown = fly(&tensor, &rate.map(decimal), &decimal(time)).unwrap();
        let (sin, cos) = super::super::sin_cos(&(decimal(tilt) / big(2.0)));
        let attitude = super::super::product(&[cos, sin, big(0.0), big(0.0)], &flown.turn);
        let found = Reference { attitude, rate: flown.rate, error: flown.error };
        let off = to_f64(&(found.cos_tilt() - decimal(cos_tilt))).abs();
        let digits = cos_tilt.split_once('.').map_or(0, |(_, digits)| digits.len());
        let last = 0.6 * 10f64.powi(-i32::try_from(digits).unwrap());
        println!("{inertia:?}: {off:e}, last digit {last:e}");
        assert!(off < last, "{inertia:?}: {off:e}");
    }
}

#[test]
fn two_orders_agree_and_energy_and_momentum_stay() {
    for (inertia, rate) in [
        ([2.0, 3.0, 4.0, 0.3, -0.1, 0.2], [5.0, -3.0, 4.0]),
        ([1.0, 2.0, 3.0, 0.0, 0.0, 0.0], [1e-9, 1.0, 2e-9]),
        ([1.0, 2.0, 2.25, 0.0, 0.0, 0.0], [0.75, 1.0, 1.0]),
        ([1.0, 1.0, 1.0, 0.0, -5e-18, 0.0], [6.0, 9.0, 7.0]),
        ([0.0, 1.0, 1.0, 0.0, 0.0, 0.0], [60.0, 9.0, 7.0]),
        ([1e-12, 1.0, 1.0, 0.0, 0.0, 0.0], [60.0, 9.0, 7.0]),
    ] {
        let size = (rate.iter().map(|part: &f64| part * part).sum::<f64>()).sqrt();
        let toss = body(inertia, rate, 0.0, 1.0);
        let (tensor, unit) = (tensor(&toss), rate.map(|part| big(part) / big(size)));
        let motion = Motion::new(&tensor).unwrap();
        let [x, y, z] = unit.each_ref().map(|part| Fixed::new(part).unwrap());
        let landed = |order: usize| motion.flown([x, y, z], Fixed::new(&big(30.0)).unwrap(), order);
        let [one, other] = [landed(ORDERS[0]), landed(50)];
        let (drift, off) = (drift(&tensor, &unit, &one), one.distance(&other));
        assert!(drift < LARGEST_DRIFT && off < ERROR_OF_SHORT, "{inertia:?}: drift {drift:e}, orders {off:e}");
    }
}

#[test]
fn rates_of_any_size_land_alike_and_tiny_components_are_kept() {
    let landed = |size: f64, small: f64| {
        let toss = body([2.0, 3.0, 4.0, 0.3, -0.1, 0.2], [5.0 * size, small, 4.0 * size], 0.0, 2.0 / size);
        Reference::flown(&toss).unwrap()
    };
    let usual = landed(1.0, 1e-30);
    for size in [2f64.powi(900), 2f64.powi(-900)] {
        assert!(usual.distance(&landed(size, size * 1e-30)) < 1e-70);
    }
    // The landing moves in proportion to the component.
    let [moved, twice] = [1e-60, 2e-60].map(|small| landed(1.0, 0.0).distance(&landed(1.0, small)));
    assert!(moved > 1e-61 && (twice / moved - 2.0).abs() < 1e-6, "{moved:e} {twice:e}");
}

/// On the separatrix the distance to it grows from the roundings, and a tiny component that is lost is not known.
#[test]
fn where_roundings_grow_it_vouches_for_nothing() {
    let judged =
        |rate: [f64; 3], time: f64| Reference::flown(&body([1.0, 2.0, 2.25, 0.0, 0.0, 0.0], rate, 0.0, time)).is_ok();
    assert!(judged([0.75, 1.0, 1.0], 20.0));
    assert!(!judged([0.75, 1.0, 1.0], 600.0));
    assert!(judged([1e-12, 1.0, 1e-12], 200.0) && judged([0.0, 1.0, 0.0], 900.0));
    assert!(!judged([1e-200, 1.0, 1e-200], 900.0) && !judged([0.3, 1.0, 0.2], 2000.0));
}
