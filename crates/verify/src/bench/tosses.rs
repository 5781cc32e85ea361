//! This file makes the tosses that all benchmarks solve, so that their times and errors can be compared. They are the
//! same in every run.

use toss::{Attitude, Batch, Body, Coin, ExactMotion, SimdLevel, Toss, Tosses};

/// Number of tosses, so few that their columns stay in the second-level cache.
pub(super) const TOSSES: usize = 4096;

/// Columns of rates from 1 to 60 rad/s on each axis and of speeds from 3 to 5 m/s, spread evenly by Weyl's sequence.
pub(super) struct Columns {
    pub(super) rates: [Vec<f64>; 3],
    pub(super) speeds: Vec<f64>,
}

impl Columns {
    pub(super) fn new(number: usize) -> Self {
        let column = |from: f64, length: f64, square: f64| {
            (0..number).map(|index| from + length * (index as f64 * square.sqrt()).fract()).collect()
        };
        Self { rates: [2.0, 3.0, 5.0].map(|square| column(1.0, 59.0, square)), speeds: column(3.0, 2.0, 7.0) }
    }

    /// The columns as tosses of the paper's coin that start horizontal.
    pub(super) fn tosses(&self) -> Tosses<'_> {
        self.tosses_of(Coin::PAPER)
    }

    pub(super) fn tosses_of<B: Copy + Into<Body>>(&self, body: B) -> Tosses<'_, B> {
        let [x, y, z] = &self.rates;
        let tosses = Tosses::new(body, Attitude::IDENTITY, 9.81, [x, y, z], &self.speeds);
        tosses.expect("columns of one length")
    }

    pub(super) fn batch(&self, level: SimdLevel) -> Batch<'_> {
        Batch::new(self.tosses()).on(level)
    }

    pub(super) fn each(&self) -> Vec<Toss> {
        let tosses = self.tosses();
        (0..tosses.len()).map(|index| tosses.toss(index).expect("a valid toss")).collect()
    }

    pub(super) fn each_of(&self, body: Body) -> Vec<Toss> {
        self.each().into_iter().map(|toss| Toss { body, launch: toss.launch }).collect()
    }
}

/// The largest angle between the attitudes that were found and the exact ones (rad).
pub(super) fn attitude_error(tosses: &[Toss], found: impl IntoIterator<Item = Attitude>) -> f64 {
    let error = |(toss, found): (&Toss, Attitude)| {
        let exact = ExactMotion::new(toss).state(toss.launch.time_of_flight());
        exact.map_or(f64::INFINITY, |exact| found.angle_to(&exact.attitude))
    };
    tosses.iter().zip(found).map(error).fold(0.0, f64::max)
}
