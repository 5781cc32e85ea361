//! Columns of launches, coins and attitudes for the tests of batches.

use dynamics::{Attitude, Coin, Tosses};

/// Columns of ωx, ωy, ωz and v0.
pub(crate) struct Columns {
    pub(crate) rates: [Vec<f64>; 3],
    pub(crate) speeds: Vec<f64>,
}

impl Columns {
    /// `count` launches from Weyl's sequence, with rates from -`fastest` to `fastest` (rad/s) and speeds up to `speed`
    /// (m/s).
    pub(crate) fn new(count: u32, fastest: f64, speed: f64) -> Self {
        let part = |index: u32, irrational: f64| (f64::from(index) * irrational).fract();
        let column = |irrational| (0..count).map(|index| fastest * (2.0 * part(index, irrational) - 1.0)).collect();
        let speeds = (0..count).map(|index| speed * part(index, 7f64.sqrt())).collect();
        Self { rates: [2.0, 3.0, 5.0].map(|square: f64| column(square.sqrt())), speeds }
    }

    pub(crate) fn tosses(&self, coin: Coin, attitude: Attitude) -> Tosses<'_> {
        let [x, y, z] = &self.rates;
        Tosses::new(coin, attitude, 9.81, [x, y, z], &self.speeds).expect("columns of one length")
    }

    /// Replaces the rates and the speed of toss `index`.
    pub(crate) fn set(&mut self, index: usize, [x, y, z, speed]: [f64; 4]) {
        for (column, value) in self.rates.iter_mut().zip([x, y, z]) {
            column[index] = value;
        }
        self.speeds[index] = speed;
    }
}

pub(crate) fn coins() -> [Coin; 4] {
    // The inertia ratio of the third has no exact f64; the last is nearly a rod.
    [
        Coin::PAPER,
        Coin::DISC,
        Coin::from_moments(1.1, 1.3).expect("valid"),
        Coin::from_moments(1.0, 1e-3).expect("valid"),
    ]
}

pub(crate) fn attitudes() -> [Attitude; 4] {
    [
        Attitude::IDENTITY,
        Attitude::about_x(1e-8),
        Attitude::about_x(0.7),
        Attitude::from_components([0.3, -0.5, 0.7, 0.2]).expect("valid"),
    ]
}

/// Slow and fast tosses, with special cases in between, some of which no kernel solves.
pub(crate) fn mixed(count: u32) -> Columns {
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
