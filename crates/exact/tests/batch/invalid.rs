//! Invalid launches, and tosses without an outcome, are refused by their index.

use dynamics::{Attitude, Body, Coin, Error, InputError, Outcome, SolveError, Tosses};
use exact::{Batch, certify};
use numerics::lanes::SimdLevel;

use super::columns::{attitudes, mixed};

/// The errors of all that is asked of a batch, of the coin and of the same as a body, at every SIMD level.
fn errors(tosses: Tosses<'_>, bodies: Tosses<'_, Body>) -> Vec<Error> {
    let number = tosses.len();
    let (mut room, mut outcomes) = ([(); 4].map(|()| vec![0.0; number]), vec![Outcome::Heads; number]);
    let of_level = |level| {
        let (batch, bodies) = (Batch::new(tosses).on(level), Batch::new(bodies).on(level));
        [
            batch.cos_tilts(&mut room[0]).expect_err("no outcome"),
            batch.attitudes(room.each_mut().map(Vec::as_mut_slice)).expect_err("no outcome"),
            batch.outcomes(&mut outcomes).expect_err("no outcome"),
            batch.count().expect_err("no outcome"),
            bodies.outcomes(&mut outcomes).expect_err("no outcome"),
            bodies.count().expect_err("no outcome"),
        ]
    };
    SimdLevel::all().into_iter().flat_map(of_level).collect()
}

/// Whatever is wrong with a later one, and also where a phase is beyond every limit.
#[test]
fn the_first_toss_without_an_outcome_is_named_with_its_field() {
    const INVALID: [f64; 4] = [1.0, 1.0, 1.0, -1.0];
    for (bad, field) in [
        ([f64::NAN, 1.0, 1.0, 3.0], Some("rate x [rad/s]")),
        ([1.0, f64::INFINITY, 1.0, 3.0], Some("rate y [rad/s]")),
        ([1.0, 1.0, -f64::INFINITY, 3.0], Some("rate z [rad/s]")),
        ([1.0, 1.0, 1.0, -1e-300], Some("speed [m/s]")),
        ([1.0, 1.0, 1.0, -1e20], Some("speed [m/s]")),
        ([1.0, 1.0, 1.0, -1e300], Some("speed [m/s]")),
        ([1.0, 1.0, 1.0, f64::NAN], Some("speed [m/s]")),
        ([1.0, 1.0, 1.0, f64::INFINITY], Some("speed [m/s]")),
        ([1e10, 0.0, 1.0, 1e9], None),
    ] {
        let mut columns = mixed(700);
        columns.set(613, INVALID);
        columns.set(411, bad);
        let rates = columns.rates.each_ref().map(Vec::as_slice);
        for attitude in attitudes() {
            let bodies = Tosses::new(Body::from(Coin::PAPER), attitude, 9.81, rates, &columns.speeds).unwrap();
            for error in errors(columns.tosses(Coin::PAPER, attitude), bodies) {
                let at = match &error {
                    Error::BadLaunch { index, .. } if field.is_some() => Some(*index),
                    Error::Launch { index, source: SolveError::PhaseTooLarge { .. }, .. } => Some(*index),
                    _ => None,
                };
                assert_eq!((at, error.field()), (Some(411), field), "{bad:?} {error}");
            }
        }
    }
}

/// A rod that hardly precesses can still spin beyond the limit. A rod with k = 0 and such a gravity have no ordinary toss at
/// all, for which a negative speed is invalid too.
#[test]
fn tosses_that_no_kernel_solves_are_refused_like_others() {
    for (ratio, gravity, rate, speed) in [
        (1e-13, 2.0, [1e-3, 0.0, 1e16], 1.0),
        (0.0, 9.81, [1.0, 2.0, 3.0], -1e-9),
        (0.5, 1e-250, [1.0, 2.0, 3.0], -1e-9),
        (2.0, 1e250, [1.0, 2.0, 3.0], -1e-9),
    ] {
        let coin = Coin::from_moments(1.0, ratio).unwrap();
        let (rates, speeds) = (rate.map(|part| [part]), [speed]);
        let rates = rates.each_ref().map(|rate| &rate[..]);
        for attitude in attitudes() {
            let tosses = Tosses::new(coin, attitude, gravity, rates, &speeds).unwrap();
            for error in errors(tosses, Tosses::new(coin.into(), attitude, gravity, rates, &speeds).unwrap()) {
                let is_told = match error {
                    Error::BadLaunch { index: 0, .. } => speed < 0.0,
                    Error::Launch { index: 0, source: SolveError::PhaseTooLarge { .. }, .. } => speed > 0.0,
                    _ => false,
                };
                assert!(is_told, "{ratio} {gravity:e}: {error}");
            }
        }
    }
}

/// The phase of the first toss is beyond every limit, and the speed of the last one is negative.
#[test]
fn a_phase_without_bounds_is_named_before_a_negative_speed_for_bodies_too() {
    let (rates, speeds) = ([[8e-5, 3.0, 1.0], [1.0, 1.0, 1.002], [2.5, 1.002, 1.0]], [3.0, 1.0, -3.0]);
    let rates = rates.each_ref().map(|rate| &rate[..]);
    for moments in [[1.0, 1.0, 0.5], [1.0, 2.0, 2.5], [0.5, 1.0, 1.0]] {
        for gravity in [5.456_993_637_988_912e-308, 1e-40] {
            let (body, attitude) = (Body::from_moments(moments).unwrap(), Attitude::about_x(3e-318));
            let tosses = |body: Coin| Tosses::new(body, attitude, gravity, rates, &speeds).unwrap();
            let bodies = Tosses::new(body, attitude, gravity, rates, &speeds).unwrap();
            for error in errors(tosses(Coin::PAPER), bodies) {
                assert!(matches!(error, Error::Launch { index: 0, .. }), "{moments:?} {gravity:e}: {error}");
            }
        }
    }
}

#[test]
fn rejects_columns_of_different_lengths_and_impossible_gravities() {
    let (two, three) = ([1.0, 2.0], [1.0, 2.0, 3.0]);
    let tosses = |gravity, speeds| Tosses::new(Coin::PAPER, Attitude::IDENTITY, gravity, [&two, &two, &two], speeds);
    assert_eq!(tosses(9.81, &three).unwrap_err().field(), "columns");
    for gravity in [0.0, -9.81, f64::NAN, f64::INFINITY] {
        assert!(matches!(tosses(gravity, &two), Err(InputError::OutOfRange { field: "gravity [m/s²]", .. })));
    }
    // A gravity beyond the range of the kernels is accepted; the tosses are solved one by one.
    let (tosses, mut outcomes) = (tosses(1e60, &two).unwrap(), [Outcome::Undecided; 2]);
    Batch::new(tosses).outcomes(&mut outcomes).unwrap();
    assert_eq!(outcomes, [0, 1].map(|index| certify(&tosses.toss(index).unwrap()).unwrap().outcome()));
    let none: [&[f64]; 3] = [&[], &[], &[]];
    assert!(Tosses::new(Coin::PAPER, Attitude::IDENTITY, 9.81, none, &[]).unwrap().is_empty());
}
