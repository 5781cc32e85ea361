//! These tests compare the batches of rigid bodies with single tosses: the outcomes must be the same, at every SIMD level.

use dynamics::{Attitude, Body, Error, Outcome, Tosses};
use exact::{Batch, certify};
use numerics::lanes::SimdLevel;

/// The part after the point of a multiple of a root.
fn part(index: usize, square: f64) -> f64 {
    (index as f64 * square.sqrt()).fract()
}

/// Bodies of many kinds, each with its normal along every principal axis in turn; the last ones are given by tensors.
fn bodies() -> Vec<Body> {
    let mut bodies = Vec::new();
    for index in 0..24_usize {
        let [a, b, c] = [2.0, 3.0, 5.0].map(|square| 0.1 + part(index + 1, square));
        let tiny = 10f64.powi(-(index as i32 % 8) - 2);
        let moments = match index % 8 {
            0 | 1 => [a + b, b + c, a + c],
            2 => [a, a * (1.0 + tiny), a * (1.0 + 0.8 * c)],
            3 => [a, a + 0.9 * c.min(a), (a + 0.9 * c.min(a)) * (1.0 + 0.1 * tiny * a)],
            4 => [1.0, 1.0 + tiny * a, 1.0 + tiny * b],
            5 => [a, b, a + b],
            6 => [tiny * a, b, b * (1.0 + 0.9 * tiny * a)],
            _ => [1.0, 2.0, 2.25],
        };
        let mut moments = moments;
        moments.rotate_left(index % 3);
        bodies.push(Body::from_moments(moments).expect("valid"));
    }
    bodies.extend(["us-quarter-engraved", "racket"].map(|name| dynamics::catalogue::named_body(name).expect("known")));
    bodies.push(Body::from_tensor([[2.0, 0.3, -0.2], [0.3, 2.5, 0.1], [-0.2, 0.1, 3.0]]).expect("valid"));
    bodies
}

/// Columns of ωx, ωy, ωz (rad/s) and speeds (m/s).
struct Columns([Vec<f64>; 4]);

impl Columns {
    /// Launches: most are random, some are next to the separatrix, next to a principal axis or on it, and some
    /// are slow, fast or long.
    fn new(count: usize, body: &Body) -> Self {
        let principal = *body.rigid().principal();
        let mut columns: [Vec<f64>; 4] = Default::default();
        for index in 0..count {
            let [mut x, mut y, mut z] = [2.0, 3.0, 5.0].map(|square| 120.0 * part(index, square) - 60.0);
            let mut speed = 5.0 * part(index, 7.0);
            let [one, two, three] = principal.moments.map(numerics::DoubleDouble::hi);
            let tiny = 10f64.powi(-((index / 16) as i32 % 16));
            match index % 16 {
                1 => z = x * (one * (two - one) / (three * (three - two))).sqrt() * (1.0 + tiny),
                2 => (x, z) = (tiny * x, tiny * z),
                3 => (y, z) = (tiny * y, tiny * z),
                4 => (x, y) = (tiny * x, tiny * y),
                5 => z = 0.0,
                6 => (x, y) = (0.0, 0.0),
                7 => (x, z) = (0.0, 0.0),
                8 => (x, y, z) = (x * 1e-40, y * 1e-40, z * 1e-40),
                9 => speed *= 1e6,
                10 => speed *= 1e-9,
                _ => {}
            }
            let along = [x, y, z];
            // A launch that was made in principal axes is turned into those of the body.
            let rate =
                if (1..8).contains(&(index % 16)) { <[f64; 3]>::from(principal.from_principal(along)) } else { along };
            for (column, value) in columns.iter_mut().zip(rate.into_iter().chain([speed])) {
                column.push(value);
            }
        }
        Self(columns)
    }

    fn tosses(&self, body: Body, attitude: Attitude) -> Tosses<'_, Body> {
        let [x, y, z, speeds] = &self.0;
        Tosses::new(body, attitude, 9.81, [x, y, z], speeds).expect("columns of one length")
    }
}

fn outcomes(batch: &Batch<'_, Body>, number: usize) -> Vec<Outcome> {
    let mut outcomes = vec![Outcome::Undecided; number];
    batch.outcomes(&mut outcomes).expect("valid tosses");
    outcomes
}

#[test]
fn outcomes_of_a_batch_are_those_of_single_tosses_at_every_level() {
    let attitudes =
        [Attitude::IDENTITY, Attitude::about_x(0.7), Attitude::from_components([0.3, -0.5, 0.7, 0.2]).unwrap()];
    for (number, body) in bodies().into_iter().enumerate() {
        let columns = Columns::new(4000, &body);
        let tosses = columns.tosses(body, attitudes[number % 3]);
        let found = outcomes(&Batch::new(tosses), 4000);
        for (index, found) in found.iter().enumerate() {
            let expected = tosses.solve(index, certify).unwrap().outcome();
            assert_eq!(*found, expected, "{:?}", tosses.solve(index, |toss| Ok(*toss)));
        }
        for level in SimdLevel::all() {
            let found = &found[..400];
            let batch = Batch::new(tosses.part(0..400)).on(level);
            assert_eq!(outcomes(&batch, 400), found, "{}", level.name());
            let counts = batch.count().unwrap();
            let number = |of: Outcome| found.iter().filter(|outcome| **outcome == of).count() as u64;
            let expected = [Outcome::Heads, Outcome::Tails, Outcome::Undecided].map(number);
            assert_eq!([counts.heads, counts.tails, counts.undecided], expected);
        }
    }
}

#[test]
fn ties_are_undecided_and_errors_have_the_index_of_their_toss() {
    let body = Body::from_moments([1.0, 2.0, 2.25]).unwrap();
    // The normal starts exactly horizontal, and lands at once.
    let on_edge = Attitude::from_components([1.0, 1.0, 0.0, 0.0]).unwrap();
    let mut columns = Columns::new(3000, &body);
    columns.0[3][2000] = 0.0;
    let tie = Batch::new(columns.tosses(body, on_edge).part(2000..2001));
    assert_eq!((outcomes(&tie, 1), tie.count().unwrap().undecided), (vec![Outcome::Undecided], 1));
    for (column, value) in [(0, f64::NAN), (1, f64::INFINITY), (3, -1.0), (3, f64::NAN)] {
        let mut columns = Columns::new(3000, &body);
        columns.0[column][2000] = value;
        let error = Batch::new(columns.tosses(body, on_edge)).count().unwrap_err();
        assert!(matches!(error, Error::BadLaunch { index: 2000, .. }), "{error:?}");
    }
    columns.0[3][2000] = 1e300;
    let error = Batch::new(columns.tosses(body, on_edge)).count().unwrap_err();
    assert!(matches!(error, Error::Launch { index: 2000, .. }), "{error:?}");
}
