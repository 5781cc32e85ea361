//! Holds the closed form against the ground truth.

use dynamics::{Body, Launch, TimeOfFlight};

use super::super::Reference;
use super::*;

fn toss(moments: [f64; 3], rate: [f64; 3], time: f64) -> Toss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
    Toss { body: Body::from_moments(moments).unwrap(), launch }
}

#[test]
fn the_closed_form_is_the_motion_of_the_ground_truth() {
    for (moments, rate, time) in [
        ([2.0, 3.0, 4.0], [0.5, -1.25, 2.0], 10.0),
        ([2.0, 3.0, 4.0], [2.0, 0.5, -0.75], 5.0),
        ([4.0, 2.0, 3.0], [-2.0, 0.5, -0.75], 5.0),
        ([1.0, 2.0, 2.25], [0.750_749_999_999_999_9, 1.0, 1.0], 10.0),
        ([1.0, 2.0, 2.25], [0.749_25, -1.0, 1.0], 10.0),
        ([1.0, 2.0, 2.25], [0.750_000_007_5, 1.0, 1.0], 10.0),
        ([1.0, 1.000_000_001, 2.0], [-0.7, -0.4, 1.1], 5.0),
        ([1.0, 1.000_000_000_000_000_2, 2.0], [-0.7, -0.4, 1.1], 25.0),
        ([1.0, 1.000_001, 1.000_003], [0.3, -0.5, 0.8], 5.0),
        ([2.25, 1.0, 2.0], [1e-12, 1.0, 1e-12], 30.0),
        ([1e-8, 1.0, 1.000_000_005], [0.3, 1.0, 0.2], 20.0),
        ([0.01, 1.0, 1.005], [0.3, 1.0, 0.2], 2.0),
    ] {
        let toss = toss(moments, rate, time);
        let (found, truth) = (Reference::in_closed_form(&toss).unwrap(), Reference::flown(&toss).unwrap());
        let (off, rate_off) = (found.distance(&truth), rate_distance(&found, &truth));
        assert!(off < ERROR && rate_off < ERROR, "{moments:?} {rate:?}: {off:e}, rate {rate_off:e}");
    }
}

fn rate_distance(a: &Reference, b: &Reference) -> f64 {
    a.rate.iter().zip(&b.rate).map(|(a, b)| to_f64(&(a - b)).abs()).fold(0.0, f64::max)
}

#[test]
fn what_it_does_not_solve_it_refuses() {
    let solved = |moments: [f64; 3], rate: [f64; 3]| {
        let toss = toss(moments, rate, 1.0);
        assert!(landed(&toss).is_none() || is_elliptic(&toss));
        landed(&toss).is_some()
    };
    assert!(solved([1.0, 2.0, 2.5], [0.1, 0.2, 0.3]));
    assert!(!solved([1.0, 2.0, 2.0], [0.1, 0.2, 0.3]) && !solved([1.0, 2.0, 2.5], [0.0, 0.2, 0.0]));
    assert!(!solved([1.0, 2.0, 2.5], [1e-14, 0.2, 1e-15]) && !solved([1.0, 2.0, 2.25], [0.75, 1.0, 1.0]));
}
