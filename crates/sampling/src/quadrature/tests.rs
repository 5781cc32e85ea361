use dynamics::Coin;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::*;
use crate::coordinate::Coordinate::{Gravity, RateX, RateY, RateZ, Speed, Tilt};
use crate::plan::{Plan, Rest as Points, Scrambled};
use crate::sampler::Sampler;

fn space(texts: [&str; 6]) -> Space {
    let of = [RateX, RateY, RateZ, Speed, Gravity, Tilt];
    let texts: Vec<_> = of.into_iter().zip(texts).collect();
    Space::parse(Coin::PAPER, &texts).unwrap()
}

fn by(space: &Space, accuracy: f64) -> Result<Estimate, Error> {
    Sampler::exact().estimate(space, Plan::Quadrature { accuracy })
}

/// A space with one or two coordinates beside the speed: ranges and normal distributions, ties, tilts and gravities.
fn random_space(rng: &mut ChaCha8Rng) -> Space {
    loop {
        let mut axis = |least: f64, most: f64, free: f64| {
            let lo = rng.random_range(least..most);
            let width = rng.random_range(0.02..1.0) * (most - least);
            match rng.random_range(0.0..1.0) {
                part if part < free => format!("{lo}:{}", lo + width),
                part if part < 1.3 * free => format!("normal:{}:{}", lo + 0.5 * width, 0.05 * width),
                _ => lo.to_string(),
            }
        };
        let [x, z] = [axis(-60.0, 60.0, 0.6), axis(-60.0, 60.0, 0.4)];
        let y = if axis(0.0, 1.0, 0.2).contains(':') { "x".to_owned() } else { axis(-60.0, 60.0, 0.4) };
        let speed = axis(3.0, 6.0, 0.75);
        let gravity = if axis(0.0, 1.0, 0.1).contains(':') { axis(9.0, 10.0, 0.7) } else { "9.81".to_owned() };
        let tilt = if axis(0.0, 1.0, 0.3).contains(':') { axis(0.0, 1.5, 0.4) } else { "0".to_owned() };
        let space = space([&x, &y, &z, &speed, &gravity, &tilt]);
        if require_smooth(&space).is_ok() && coordinates(&space) > 0 {
            return space;
        }
    }
}

#[test]
fn intervals_contain_the_probability_at_much_higher_accuracy() {
    let mut rng = ChaCha8Rng::seed_from_u64(24);
    let (mut missed, mut largest, mut all) = (0, 0.0_f64, 0);
    for _ in 0..24 {
        let space = random_space(&mut rng);
        let accuracy = 10_f64.powf(rng.random_range(-7.0..-3.0));
        let (found, truth) = (by(&space, accuracy).unwrap(), by(&space, 1e-2 * accuracy).unwrap());
        let error = (found.probability - truth.probability).abs();
        let claimed = found.half_width().unwrap();
        assert!(claimed <= accuracy, "{space:?}");
        missed += u32::from(error > claimed + truth.half_width().unwrap());
        if claimed > 0.0 {
            largest = largest.max(error / claimed);
        }
        all += 1;
    }
    assert_eq!(missed, 0, "of {all}");
    assert!(largest < 1.0, "{largest}");
}

#[test]
fn probabilities_are_those_of_exact_speed_with_many_sobol_points() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    for _ in 0..16 {
        let space = random_space(&mut rng);
        let sampled =
            Sampler::exact().estimate(&space, Plan::ExactSpeed(Points::Sobol(Scrambled::new(1 << 15, 1)))).unwrap();
        let found = by(&space, 1e-7).unwrap();
        let apart = (found.probability - sampled.probability).abs();
        // Student's interval of 8 scrambles misses one in 20; three times as wide, it misses one in 4000.
        assert!(apart <= 3.0 * sampled.half_width().unwrap() + 1e-7, "{space:?}: {found:?}, {sampled:?}");
    }
}

#[test]
fn the_paper_s_space_and_the_box_of_four_are_known_to_ten_digits() {
    let fig4 = space(["0:50", "x", "30", "3:5", "9.81", "0"]);
    let found = by(&fig4, 1e-10).unwrap();
    assert!(
        (found.probability - 0.661_452_104_190_6).abs() < 1e-12 && found.half_width().unwrap() <= 1e-10,
        "{found:?}"
    );
    assert!(found.points < 1000, "{found:?}");
    // The reference has ten digits; see validation/reference.
    let found = by(&space(["1:60", "1:60", "1:60", "3:5", "9.81", "0"]), 1e-7).unwrap();
    assert!((found.probability - 0.580_665_055_2).abs() < 1e-8 && found.half_width().unwrap() <= 1e-7, "{found:?}");
    assert!(found.points < 1_500_000, "{found:?}");
}

#[test]
fn rates_across_the_normal_count_as_one_for_uniform_launches_from_horizontal() {
    for (texts, number) in [
        (["1:60", "1:60", "1:60", "3:5", "9.81", "0"], 2),
        (["-9:60", "-5:60", "1", "normal:3:0.1", "9.81", "0"], 1),
        (["1:60", "1:60", "1", "3:5", "9.81", "0.1"], 2),
        (["normal:9:1", "1:60", "1", "3:5", "9.81", "0"], 2),
        (["1:60", "1:60", "x", "3:5", "9.81", "0"], 2),
        (["1:60", "x", "1:60", "3:5", "9:10", "0"], 3),
        (["1", "1", "1", "3:5", "9.81", "0"], 0),
    ] {
        assert_eq!(coordinates(&space(texts)), number, "{texts:?}");
    }
    // Ranges whose densities overflow if multiplied, and a motion that is slow.
    let slow = by(&space(["0:1e-200", "0:1e-200", "0:1e-200", "3:5", "9.81", "0"]), 1e-6).unwrap();
    assert!((slow.probability - 1.0).abs() < 1e-6, "{slow:?}");
    // The same space with a tilt too small to matter, which keeps both coordinates.
    let both = |tilt| by(&space(["-20:50", "-5:30", "30", "3:5", "9.81", tilt]), 1e-6).unwrap().probability;
    assert!((both("0") - both("1e-9")).abs() < 1e-6);
}

#[test]
fn a_space_in_which_nothing_but_the_speed_varies_takes_one_share() {
    let alone = space(["20", "5", "3", "3:5", "9.81", "0.4"]);
    let found = by(&alone, 1e-9).unwrap();
    let share = Sampler::exact().estimate(&alone, Plan::ExactSpeed(Points::Grid)).unwrap();
    assert_eq!((found.points, found.half_width().is_some_and(|error| error < 1e-13)), (1, true));
    assert!((found.probability - share.probability).abs() < 1e-15);
}

#[test]
fn refuses_what_is_not_smooth_and_accuracies_out_of_reach() {
    let field = |space: &Space, accuracy| by(space, accuracy).unwrap_err().field();
    let fig4 = space(["0:50", "x", "30", "3:5", "9.81", "0"]);
    assert_eq!(field(&space(["0:50", "x", "30", "3", "9.81", "0"]), 1e-6), Some("speed [m/s]"));
    assert_eq!(field(&fig4.with_drop(Some(1.0)).unwrap(), 1e-6), Some("drop [m]"));
    assert_eq!(field(&space(["0:50", "0:50", "1:30", "3:5", "9.81", "0.1"]), 1e-6), Some("method"));
    assert_eq!(
        field(&space(["30", "30", "29.99999999999:30.00000000001", "3:5", "9.81", "0"]), 1e-6),
        Some("rate z [rad/s]")
    );
    for accuracy in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(field(&fig4, accuracy), Some("accuracy"));
    }
    let error = by(&fig4, 1e-17).unwrap_err();
    assert!(matches!(error, Error::NotReached { reached, .. } if reached < 1e-11), "{error:?}");
    let plan = Plan::Quadrature { accuracy: 1e-9 };
    assert!(
        Sampler::exact().tally(&fig4, plan, 0..1).is_err() && fig4.drawn(plan).is_err() && plan.points(&fig4).is_err()
    );
    // A motion beyond 2^53 rad.
    let far = Space::parse(Coin::PAPER, &[(RateX, "1:1e9"), (RateY, "0"), (RateZ, "0"), (Speed, "0:1e9")]).unwrap();
    assert!(matches!(by(&far, 1e-6), Err(Error::Launch { .. })));
}
