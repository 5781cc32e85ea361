//! Invalid launches, and tosses without an outcome, are refused by their index.

use dynamics::{Attitude, Coin, Error, InputError, Outcome, SolveError, Tosses};
use exact::{Batch, certify};
use numerics::lanes::SimdLevel;

use super::columns::{attitudes, mixed};

#[test]
fn rejects_invalid_launches_by_index_and_field() {
    for (bad, field) in [
        ([f64::NAN, 1.0, 1.0, 3.0], "rate x [rad/s]"),
        ([1.0, f64::INFINITY, 1.0, 3.0], "rate y [rad/s]"),
        ([1.0, 1.0, -f64::INFINITY, 3.0], "rate z [rad/s]"),
        ([1.0, 1.0, 1.0, -1e-300], "speed [m/s]"),
        ([1.0, 1.0, 1.0, -1e20], "speed [m/s]"),
        ([1.0, 1.0, 1.0, -1e300], "speed [m/s]"),
        ([1.0, 1.0, 1.0, f64::NAN], "speed [m/s]"),
        ([1.0, 1.0, 1.0, f64::INFINITY], "speed [m/s]"),
    ] {
        let mut columns = mixed(700);
        columns.set(613, [1.0, 1.0, 1.0, -1.0]);
        columns.set(411, bad);
        for (level, attitude) in
            SimdLevel::all().into_iter().flat_map(|level| attitudes().map(|attitude| (level, attitude)))
        {
            let batch = Batch::new(columns.tosses(Coin::PAPER, attitude)).on(level);
            let mut room = vec![0.0; 700];
            let mut columns = [room.clone(), room.clone(), room.clone(), room.clone()];
            for error in [
                batch.cos_tilts(&mut room).unwrap_err(),
                batch.attitudes(columns.each_mut().map(Vec::as_mut_slice)).unwrap_err(),
                batch.outcomes(&mut vec![Outcome::Heads; 700]).unwrap_err(),
                batch.count().unwrap_err(),
            ] {
                assert!(matches!(error, Error::BadLaunch { index: 411, .. }), "{bad:?} {error}");
                assert_eq!(error.field(), Some(field), "{bad:?} {error}");
            }
        }
    }
}

#[test]
fn rejects_phases_above_two_to_the_53() {
    let mut columns = mixed(300);
    columns.set(123, [1e10, 0.0, 1.0, 1e9]);
    for attitude in attitudes() {
        let batch = Batch::new(columns.tosses(Coin::DISC, attitude));
        let error = batch.cos_tilts(&mut vec![0.0; 300]).unwrap_err();
        let too_large = |error: &Error, at| matches!(error, Error::Launch { index, source: SolveError::PhaseTooLarge { .. }, .. } if *index == at);
        assert!(too_large(&error, 123), "{error}");
        assert_eq!(batch.count().unwrap_err(), error);
        // A rod that hardly precesses can still spin beyond the limit.
        let spinning = [[1e-3], [0.0], [1e16]];
        let rod = Coin::from_moments(1.0, 1e-13).unwrap();
        let tosses = Tosses::new(rod, attitude, 2.0, spinning.each_ref().map(|rate| &rate[..]), &[1.0]).unwrap();
        let error = Batch::new(tosses).count().unwrap_err();
        assert!(too_large(&error, 0), "{error}");
    }
}

/// A rod with k = 0 and such a gravity have no ordinary toss at all.
#[test]
fn a_negative_speed_is_invalid_for_every_body_and_gravity() {
    let (rates, speeds) = ([[1.0], [2.0], [3.0]], [-1e-9]);
    for (ratio, gravity) in [(0.0, 9.81), (0.5, 1e-250), (2.0, 1e250)] {
        let coin = Coin::from_moments(1.0, ratio).unwrap();
        let rates = rates.each_ref().map(|rate| &rate[..]);
        for attitude in attitudes() {
            let batch = Batch::new(Tosses::new(coin, attitude, gravity, rates, &speeds).unwrap());
            for error in [batch.cos_tilts(&mut [0.0]).unwrap_err(), batch.count().unwrap_err()] {
                assert!(matches!(error, Error::BadLaunch { index: 0, .. }), "{error}");
            }
        }
    }
}

#[test]
fn the_first_toss_without_an_outcome_is_named_whatever_is_wrong_with_a_later_one() {
    let mut columns = mixed(700);
    columns.set(613, [1e10, 0.0, 1.0, 1e9]);
    columns.set(640, [1.0, 1.0, 1.0, -1.0]);
    for attitude in attitudes() {
        let batch = Batch::new(columns.tosses(Coin::DISC, attitude));
        let mut room = vec![0.0; 700];
        for error in [
            batch.cos_tilts(&mut room).unwrap_err(),
            batch.outcomes(&mut vec![Outcome::Heads; 700]).unwrap_err(),
            batch.count().unwrap_err(),
        ] {
            assert!(matches!(error, Error::Launch { index: 613, .. }), "{error}");
        }
        let body = dynamics::Body::from(Coin::DISC);
        let rates = columns.rates.each_ref().map(Vec::as_slice);
        let bodies = Batch::new(Tosses::new(body, attitude, 9.81, rates, &columns.speeds).unwrap());
        for error in [bodies.outcomes(&mut vec![Outcome::Heads; 700]).unwrap_err(), bodies.count().unwrap_err()] {
            assert!(matches!(error, Error::Launch { index: 613, .. }), "{error}");
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
    // Gravities beyond the range of the kernels are accepted; the tosses are solved one by one.
    for gravity in [1e-300, 1e60] {
        let mut outcomes = [Outcome::Undecided; 2];
        let tosses = tosses(gravity, &two).unwrap();
        let expected = (0..2).map(|index| certify(&tosses.toss(index).unwrap()));
        match Batch::new(tosses).outcomes(&mut outcomes) {
            Ok(()) => assert!(expected.zip(outcomes).all(|(single, batch)| single.unwrap().outcome() == batch)),
            Err(Error::Launch { source, .. }) => {
                assert!(expected.into_iter().any(|single| single.err() == Some(source.clone())));
            }
            Err(error) => panic!("{error}"),
        }
    }
    let none: [&[f64]; 3] = [&[], &[], &[]];
    assert!(Tosses::new(Coin::PAPER, Attitude::IDENTITY, 9.81, none, &[]).unwrap().is_empty());
}

/// The phase of the first toss is beyond every limit, and the speed of the last one is negative.
#[test]
fn a_phase_without_bounds_is_named_before_a_negative_speed_for_bodies_too() {
    let (rates, speeds) = ([[8e-5, 3.0, 1.0], [1.0, 1.0, 1.002], [2.5, 1.002, 1.0]], [3.0, 1.0, -3.0]);
    let rates = rates.each_ref().map(|rate| &rate[..]);
    for moments in [[1.0, 1.0, 0.5], [1.0, 2.0, 2.5], [0.5, 1.0, 1.0]] {
        for gravity in [5.456_993_637_988_912e-308, 1e-40] {
            let body = dynamics::Body::from_moments(moments).unwrap();
            let tosses = Tosses::new(body, Attitude::about_x(3e-318), gravity, rates, &speeds).unwrap();
            for level in SimdLevel::all() {
                let batch = Batch::new(tosses).on(level);
                for error in [batch.outcomes(&mut [Outcome::Heads; 3]).unwrap_err(), batch.count().unwrap_err()] {
                    assert!(matches!(error, Error::Launch { index: 0, .. }), "{moments:?} {gravity:e}: {error}");
                }
            }
        }
    }
}
