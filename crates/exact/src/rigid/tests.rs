//! Tests of the motion of any body: attitudes and rates from outside, the motion of coins, and outcomes.

use dynamics::{Body, Coin, CoinToss, Launch, Outcome, TimeOfFlight};

use super::*;
use crate::given::scaled;

fn toss(moments: [f64; 3], rate: [f64; 3], time: f64) -> Toss {
    let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(time)).unwrap();
    Toss { body: Body::from_moments(moments).unwrap(), launch }
}

/// Attitudes by theta functions and by an integration with 128 bits, right to the last digit printed.
#[test]
fn attitudes_are_those_of_an_independent_integration_in_every_regime() {
    use Regime::{AroundLargest, AroundSmallest, Separatrix};
    #[rustfmt::skip]
    let cases = [
        ([2.0, 3.0, 4.0], [0.5, -1.25, 2.0], 25.0, AroundLargest, [0.843_159_498_103_707, 0.094_991_018_164_872, 0.014_213_294_380_417, 0.529_014_885_885_418]),
        ([2.0, 3.0, 4.0], [2.0, 0.5, -0.75], 25.0, AroundSmallest, [0.789_527_798_386_622, 0.514_622_473_887_151, 0.118_538_481_973_725, -0.312_663_066_633_089]),
        ([2.0, 3.0, 4.0], [0.5, -1.25, 2.0], 1e4, AroundLargest, [0.715_354_064_068_680, 0.374_064_121_901_607, 0.074_931_711_483_852, 0.585_431_323_333_918]),
        ([1.0, 2.0, 2.25], [0.750_749_999_999_999_9, 1.0, 1.0], 20.0, AroundSmallest, [0.097_971_959_898_981, -0.846_301_920_881_193, 0.341_806_050_401_791, -0.396_665_069_920_562]),
        ([1.0, 2.0, 2.25], [0.749_25, 1.0, 1.0], 20.0, AroundLargest, [0.454_773_741_854_494, -0.697_203_009_107_969, 0.271_470_144_137_772, -0.483_107_409_022_335]),
        ([1.0, 2.0, 2.25], [0.750_000_007_5, 1.0, 1.0], 50.0, AroundSmallest, [0.380_180_872_908_218, -0.658_839_168_586_013, -0.181_639_256_626_490, 0.623_217_966_897_467]),
        ([1.0, 2.0, 2.25], [0.75, 1.0, 1.0], 10.0, Separatrix, [0.088_776_941_851_129, 0.172_285_221_657_342, 0.901_367_517_439_453, 0.387_263_547_857_371]),
        ([1.0, 1.000_000_001, 2.0], [0.7, -0.4, 1.1], 100.0, AroundLargest, [0.730_383_556_713_777, 0.130_012_377_020_177, 0.239_682_293_172_744, -0.626_249_982_230_060]),
        ([1.0, 1.000_001, 1.000_003], [0.3, -0.5, 0.8], 1e4, AroundLargest, [0.167_447_373_038_000, -0.302_165_606_992_909, 0.493_810_898_872_256, -0.798_002_581_053_629]),
    ];
    for (moments, rate, time, regime, expected) in cases {
        let motion = ExactMotion::new(&toss(moments, rate, time));
        let found = motion.state(time).unwrap();
        let sign = found.attitude.components()[0].signum();
        for (part, digits) in found.attitude.components().into_iter().zip(expected) {
            assert!((sign * part - digits).abs() < 7e-16, "{moments:?} {rate:?} {time}: {found:?}");
        }
        assert_eq!(motion.regime(), regime, "{rate:?}");
        let [w, x, y, z] = expected;
        assert!((motion.cos_tilt(time).unwrap() - (w * w + z * z - x * x - y * y)).abs() < 2e-15, "{rate:?}");
    }
}

/// Directions of launch in all octants and near all axes.
fn rates() -> Vec<[f64; 3]> {
    let sizes = [0.0, 1e-9, 0.3, 1.0];
    let mut rates = Vec::new();
    for index in 0..64 {
        let part =
            |shift: u32| sizes[index >> (2 * shift) & 3] * if index % (3 + shift as usize) == 0 { -1.0 } else { 1.0 };
        rates.push([part(0), part(1), part(2)]);
    }
    rates
}

/// A flight in two legs is the flight in one, whatever regime's formula each of them uses. Equal rates about the first and
/// the last axis of the second body are on its separatrix.
#[test]
fn a_flight_in_legs_is_the_flight_in_one() {
    for moments in [
        [1.0, 2.0, 2.5],
        [1.0, 2.5, 3.0],
        [2.5, 1.0, 2.0],
        [2.0, 2.5, 1.0],
        [1.0, 2.0, 2.0],
        [1.0, 1.0, 1.0],
        [0.1, 0.7, 0.8],
    ] {
        for rate in rates() {
            let whole = ExactMotion::new(&toss(moments, rate, 1.0));
            let middle = whole.state(2.0).unwrap();
            let launch = Launch::from_state(&middle, TimeOfFlight::Given(1.0)).unwrap();
            let rest = ExactMotion::new(&Toss { body: Body::from_moments(moments).unwrap(), launch });
            let (one, two) = (whole.state(5.0).unwrap(), rest.state(3.0).unwrap());
            assert!(one.attitude.angle_to(&two.attitude) < 2e-14, "{moments:?} {rate:?}: {one:?} {two:?}");
            assert!((one.rate - two.rate).amax() < 2e-14, "{moments:?} {rate:?}: {one:?} {two:?}");
        }
    }
}

#[test]
fn a_coin_keeps_every_bit_and_a_nearly_symmetric_body_moves_like_one() {
    for coin in [Coin::PAPER, Coin::DISC, Coin::from_cylinder(0.003, 0.01874, 0.00114).unwrap()] {
        for rate in rates() {
            let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(0.6)).unwrap().with_tilt(0.7).unwrap();
            let exact = CoinMotion::new(&CoinToss { coin, launch });
            let rigid = ExactMotion::new(&CoinToss { coin, launch }.into());
            assert_eq!((rigid.state(0.6), rigid.cos_tilt(0.6)), (exact.state(0.6), exact.cos_tilt(0.6)));
            let body = Body::from_moments([coin.i1(), coin.i1() * (1.0 - f64::EPSILON), coin.i3()]);
            // A flat disc has no room below I1 = I2.
            let Ok(body) = body else { continue };
            let near = ExactMotion::new(&Toss { body, launch });
            let (one, two) = (near.state(0.6).unwrap(), exact.state(0.6).unwrap());
            assert!(one.attitude.angle_to(&two.attitude) < 1.5e-15, "{coin:?} {rate:?}: {one:?} {two:?}");
            assert!((one.rate - two.rate).amax() < 1e-15, "{coin:?} {rate:?}: {one:?} {two:?}");
        }
    }
}

/// A body symmetric about an axis in its plane is a coin whose axes have other names.
#[test]
fn a_body_symmetric_about_another_axis_is_a_coin_with_other_names() {
    for (own, across) in [(1.5, 1.0), (0.4, 1.0), (0.0, 1.0)] {
        for [x, y, z] in rates() {
            let lying = ExactMotion::new(&toss([own, across, across], [z, x, y], 1.0)).state(1.0).unwrap();
            let standing = ExactMotion::new(&toss([across, across, own], [x, y, z], 1.0)).state(1.0).unwrap();
            let ([w, a, b, c], [w2, x2, y2, z2]) = (lying.attitude.components(), standing.attitude.components());
            let cos = (w * w2 + b * x2 + c * y2 + a * z2).abs();
            assert!(cos > 1.0 - 1e-15, "{own}: {lying:?} {standing:?}");
            assert!((lying.rate - Vector3::new(standing.rate.z, standing.rate.x, standing.rate.y)).amax() < 2e-15);
        }
    }
}

/// A perturbation of 1e-160 grows by e in each time 1/λ and flips the body after some four hundred of them.
#[test]
fn a_tiny_perturbation_of_the_spin_about_the_middle_axis_flips_the_body_in_time() {
    let motion = |tiny: f64| ExactMotion::new(&toss([1.0, 2.0, 3.0], [tiny, 1.0, tiny], 1.0));
    // λ = G √(α12 α23) = √(1/3), and the first flip is when sinh λt reaches the inverse of the perturbation.
    let lambda = (1.0f64 / 3.0).sqrt();
    for tiny in [1e-5, 1e-60, 1e-160, 1e-300, 5e-324] {
        let time = -f64::ln(tiny) / lambda;
        let along = |time: f64| motion(tiny).state(time).unwrap().rate.y;
        assert!(
            along(time - 12.0) > 0.99 && along(time + 12.0) < -0.99,
            "{tiny:e} {} {}",
            along(time - 12.0),
            along(time + 12.0)
        );
    }
}

#[test]
fn units_of_any_size_change_no_bit_of_the_attitude() {
    let base = ExactMotion::new(&toss([1.0, 2.0, 2.5], [0.3, -0.7, 1.1], 1.0)).state(3.0).unwrap();
    for (rates, moments) in [(300, -800), (-300, 700), (1000, 0)] {
        let [rates, moments] = [rates, moments].map(|exponent| 2f64.powi(exponent));
        let scaled = toss([1.0, 2.0, 2.5].map(|part| part * moments), [0.3, -0.7, 1.1].map(|part| part * rates), 1.0);
        assert_eq!(ExactMotion::new(&scaled).state(3.0 / rates).unwrap().attitude, base.attitude);
    }
    let still = ExactMotion::new(&toss([1.0, 2.0, 2.5], [0.0; 3], 1.0));
    assert_eq!(still.state(1e308).unwrap().attitude, Attitude::IDENTITY);
    assert!(ExactMotion::new(&toss([1.0, 2.0, 2.5], [1e3, 1.0, 2.0], 1.0)).state(1e16).is_err());
    assert!(ExactMotion::new(&toss([1.0, 2.0, 2.5], [1e300, 1e290, 1e300], 1.0)).cos_tilt(1e300).is_err());
}

#[test]
fn rates_are_scaled_by_the_largest_also_where_they_are_far_apart() {
    for rate in [[3e5, -2.0, 1.0], [3e5, 1e-90, 0.0], [-3e-5, 1e-190, 0.0]] {
        let rate = Vector3::from(rate);
        let unit = power_of_two_scale(rate.amax());
        assert_eq!(scaled(&rate, &DoubleDouble::ZERO).map(DoubleDouble::hi), [0, 1, 2].map(|axis| rate[axis] / unit));
    }
}

/// Launch times a few ulp beside an edge, where f64 can't tell.
#[test]
fn outcomes_next_to_an_edge_change_between_neighbouring_numbers_and_never_back() {
    for (moments, rate) in
        [([1.0, 2.0, 2.5], [0.3, 1.7, 0.4]), ([1.0, 2.0, 2.25], [0.75, 1.0, 1.0]), ([2.5, 1.0, 2.0], [1.3, 0.2, 0.4])]
    {
        let motion = ExactMotion::new(&toss(moments, rate, 1.0));
        let (mut before, mut after) = (0.0_f64, 0.0_f64);
        for step in 1..4000 {
            after = f64::from(step) * 0.01;
            if motion.cos_tilt(after).unwrap() < 0.0 {
                break;
            }
            before = after;
        }
        let outcome = |time: f64| certify(&toss(moments, rate, time)).unwrap().outcome();
        assert_eq!((outcome(before), outcome(after)), (Outcome::Heads, Outcome::Tails), "{moments:?}");
        while before.next_up() < after {
            let middle = 0.5 * (before + after);
            if outcome(middle) == Outcome::Heads { before = middle } else { after = middle }
        }
        assert_eq!((outcome(before), outcome(after)), (Outcome::Heads, Outcome::Tails), "{before} {after}");
    }
}

/// A needle so thin that its spin would lose seven digits in the sum of its rates.
#[test]
fn the_outcome_of_a_needle_is_proven_after_a_long_flight() {
    let moments = [5.013_432_253_748_628_6e-8, 0.715_763_998_524_255, 0.715_764_043_645_145_2];
    let rate = [0.010_402_776_325_362_652, -0.008_696_632_080_549_693, -0.003_814_738_162_276_736];
    let toss = toss(moments, rate, 623_945_565.369_074_3);
    let motion = ExactMotion::new(&toss);
    let cos_tilt = motion.cos_tilt(623_945_565.369_074_3).unwrap();
    let certificate = certify(&toss).unwrap();
    assert_eq!(certificate.outcome(), Outcome::of(cos_tilt, 0.0));
    assert_ne!(certificate.outcome(), Outcome::Undecided);
}
