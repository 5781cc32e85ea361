//! These tests compare batches with single tosses: the outcomes must be the same, the landings must agree to the last
//! bits, and the results of a batch must be the same to the bit at every SIMD level.

use std::f64::consts::TAU;

use dynamics::{Attitude, Coin, Error, InputError, Outcome, SolveError, Tosses};
use exact::{Batch, ExactMotion, certify};
use numerics::lanes::SimdLevel;

/// Columns of ωx, ωy, ωz and v0.
struct Columns {
    rates: [Vec<f64>; 3],
    speeds: Vec<f64>,
}

impl Columns {
    /// `count` launches from Weyl's sequence, with rates from -`fastest` to `fastest` (rad/s) and speeds up to `speed`
    /// (m/s).
    fn new(count: u32, fastest: f64, speed: f64) -> Self {
        let part = |index: u32, irrational: f64| (f64::from(index) * irrational).fract();
        let column = |irrational| (0..count).map(|index| fastest * (2.0 * part(index, irrational) - 1.0)).collect();
        let speeds = (0..count).map(|index| speed * part(index, 7f64.sqrt())).collect();
        Self { rates: [2.0, 3.0, 5.0].map(|square: f64| column(square.sqrt())), speeds }
    }

    fn tosses(&self, coin: Coin, attitude: Attitude) -> Tosses<'_> {
        let [x, y, z] = &self.rates;
        Tosses::new(coin, attitude, 9.81, [x, y, z], &self.speeds).expect("columns of one length")
    }

    /// Replaces the rates and the speed of toss `index`.
    fn set(&mut self, index: usize, [x, y, z, speed]: [f64; 4]) {
        for (column, value) in self.rates.iter_mut().zip([x, y, z]) {
            column[index] = value;
        }
        self.speeds[index] = speed;
    }
}

/// cos θ, the four columns of the attitude, and the outcomes.
type Solved = (Vec<f64>, [Vec<f64>; 4], Vec<Outcome>);

fn solved(batch: Batch<'_>, tosses: &Tosses<'_>) -> Result<Solved, Error> {
    let (mut cos_tilts, mut outcomes) = (vec![f64::NAN; tosses.len()], vec![Outcome::Undecided; tosses.len()]);
    let mut attitudes: [Vec<f64>; 4] = std::array::from_fn(|_| vec![f64::NAN; tosses.len()]);
    batch.cos_tilts(&mut cos_tilts)?;
    batch.attitudes(attitudes.each_mut().map(Vec::as_mut_slice))?;
    batch.outcomes(&mut outcomes)?;
    Ok((cos_tilts, attitudes, outcomes))
}

fn bits(tosses: Tosses<'_>, level: SimdLevel) -> (Vec<u64>, Vec<Outcome>) {
    let (cos_tilts, attitudes, outcomes) = solved(Batch::new(tosses).on(level), &tosses).expect("valid tosses");
    (cos_tilts.iter().chain(attitudes.iter().flatten()).map(|number| number.to_bits()).collect(), outcomes)
}

fn coins() -> [Coin; 4] {
    // The inertia ratio of the third has no exact f64; the last is nearly a rod.
    [
        Coin::PAPER,
        Coin::DISC,
        Coin::from_moments(1.1, 1.3).expect("valid"),
        Coin::from_moments(1.0, 1e-3).expect("valid"),
    ]
}

fn attitudes() -> [Attitude; 4] {
    [
        Attitude::IDENTITY,
        Attitude::about_x(1e-8),
        Attitude::about_x(0.7),
        Attitude::from_components([0.3, -0.5, 0.7, 0.2]).expect("valid"),
    ]
}

/// Slow and fast tosses, with special cases in between, some of which no kernel solves.
fn mixed(count: u32) -> Columns {
    let mut columns = Columns::new(count, 60.0, 5.0);
    let others = [
        [0.0; 4],
        [0.0, 0.0, 7.0, 3.0],
        [3.0, 4.0, 0.0, 0.0],
        [1e-60, 0.0, 0.0, 3.0],
        [1e-160, 2e-160, 1e-160, 3.0],
        [1e60, 1e60, 1e60, 1e-60],
        [3e6, 4e6, 5e6, 1e5],
        [7.0, 0.0, 1e-9, 3.0],
        [7.0, 1.0, 2.0, 1e-300],
    ];
    for (index, other) in others.into_iter().enumerate() {
        let place = 5 + 13 * index;
        if place < count as usize {
            columns.set(place, other);
        }
    }
    columns
}

#[test]
fn a_batch_matches_its_single_tosses_to_the_last_bits() {
    for (coin, attitude) in coins().into_iter().flat_map(|coin| attitudes().map(|attitude| (coin, attitude))) {
        for columns in
            [Columns::new(5000, 60.0, 5.0), Columns::new(1000, 60.0, 0.0), Columns::new(1000, 1e4, 1e4), mixed(700)]
        {
            let tosses = columns.tosses(coin, attitude);
            let (cos_tilts, attitudes, outcomes) = solved(Batch::new(tosses), &tosses).unwrap();
            for index in 0..tosses.len() {
                let toss = tosses.toss(index).unwrap();
                let (motion, time) = (ExactMotion::new(&toss), toss.launch.time_of_flight());
                assert!(cos_tilts[index].abs() <= 1.0, "{toss:?}: {}", cos_tilts[index]);
                let error = cos_tilts[index] - motion.cos_tilt(time).unwrap();
                assert!(error.abs() <= 2.75 * f64::EPSILON, "{toss:?}: cos θ is off by {error:e}");
                let landing = Attitude::from_components(attitudes.each_ref().map(|column| column[index])).unwrap();
                let error = landing.angle_to(&motion.state(time).unwrap().attitude);
                assert!(error <= 7.0 * f64::EPSILON, "{toss:?}: the attitude is off by {error:e}");
                assert_eq!(outcomes[index], certify(&toss).unwrap().outcome(), "{toss:?}");
            }
        }
    }
}

/// The neighbours are changed by solving parts of the batch, of several lengths and from several starts.
#[test]
fn neither_the_simd_level_nor_the_neighbours_change_a_bit() {
    let has_vectors = cfg!(any(target_arch = "x86_64", target_arch = "aarch64"));
    assert!(SimdLevel::all().len() > 1 || !has_vectors, "only the plain level was tried");
    let columns = mixed(700);
    for (coin, attitude) in coins().into_iter().flat_map(|coin| attitudes().map(|attitude| (coin, attitude))) {
        let tosses = columns.tosses(coin, attitude);
        let plain = bits(tosses, SimdLevel::all()[0]);
        for level in SimdLevel::all() {
            assert_eq!(bits(tosses, level), plain, "{}", level.name());
            for range in [0..1, 1..8, 17..34, 3..259, 444..700] {
                let rates = columns.rates.each_ref().map(|column| &column[range.clone()]);
                let some = Tosses::new(coin, attitude, 9.81, rates, &columns.speeds[range.clone()]).unwrap();
                let (cos_tilts, outcomes) = (&plain.0[range.clone()], &plain.1[range.clone()]);
                let found = bits(some, level);
                assert_eq!(
                    (&found.0[..range.len()], &found.1[..]),
                    (cos_tilts, outcomes),
                    "{range:?} {}",
                    level.name()
                );
            }
        }
    }
}

/// The phases at landing approach one that lands on edge, down to the last digit of the speeds, after few turns and
/// after many.
#[test]
fn near_an_edge_the_filter_decides_rightly_or_not_at_all() {
    for (coin, attitude) in coins().into_iter().flat_map(|coin| attitudes().map(|attitude| (coin, attitude))) {
        for (turns, fewest_left) in [(0.0, 300), (3.0, 300), (1e5, 400), (1e8, 900)] {
            let mut columns = Columns::new(4000, 60.0, 5.0);
            for index in 0..4000 {
                let toss = columns.tosses(coin, attitude).toss(index).unwrap();
                let motion = ExactMotion::new(&toss);
                let heads = motion.heads();
                let away = 10f64.powi(-2 - (index % 15) as i32) * if index % 2 == 0 { 1.0 } else { -1.0 };
                let edge = (heads.crest + heads.half_width).rem_euclid(TAU) + TAU * turns + away;
                let speed = 0.5 * 9.81 * edge / motion.precession_rate();
                if speed >= 0.0 {
                    columns.speeds[index] = speed;
                }
            }
            let tosses = columns.tosses(coin, attitude);
            let (mut outcomes, mut rest) = (vec![Outcome::Undecided; tosses.len()], 0);
            Batch::new(tosses).outcomes(&mut outcomes).unwrap();
            Batch::new(tosses).count_and(|_| rest += 1).unwrap();
            let certified = |index| certify(&tosses.toss(index).unwrap()).unwrap().outcome();
            assert!((0..tosses.len()).all(|index| outcomes[index] == certified(index)), "{turns} turns");
            assert!((fewest_left..3900).contains(&rest), "the filter left {rest} after {turns} turns");
        }
    }
}

#[test]
fn counts_match_the_outcomes() {
    let columns = mixed(2000);
    for attitude in attitudes() {
        let tosses = columns.tosses(Coin::PAPER, attitude);
        let mut outcomes = vec![Outcome::Undecided; tosses.len()];
        Batch::new(tosses).outcomes(&mut outcomes).unwrap();
        let all = |of: Outcome| outcomes.iter().filter(|outcome| **outcome == of).count() as u64;
        for level in SimdLevel::all() {
            let mut left = 0;
            let counts = Batch::new(tosses).on(level).count_and(|_| left += 1).unwrap();
            assert_eq!((counts.heads(), counts.tails()), (all(Outcome::Heads), all(Outcome::Tails)));
            assert_eq!((counts.ties(), counts.total()), (all(Outcome::Undecided), 2000));
            assert!((1..50).contains(&left), "the filter left {left}");
            assert_eq!(Batch::new(tosses).on(level).count(), Ok(counts));
        }
    }
}

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
