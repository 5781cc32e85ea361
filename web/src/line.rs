//! The lines of a map that have a formula.
//!
//! *Certainty.* With s = (ωx, ωy, k ωz), which is S over I1, and the vertical v = (0, sin b, cos b), both in BF at a launch
//! with the tilt b, the coin shows heads for ever if (s · v)² ≥ ωx² + ωy² and s · v has the sign of k ωz; the edge is where
//! the two are equal. From horizontal this is k |ωz| = √(ωx² + ωy²): ψ = 45° or 135°.
//!
//! *The first flip.* Over ωx and the speed, a coin that is caught before it changes its face for the first time shows heads.
//! That is at v0 = g T/2, with T the time of the first flip.

use serde::Serialize;
use toss::{CoinMotion, CoinToss, Error, Launch, Vector3};

use crate::map::{Grid, Up};
use crate::thrown::Thrown;

/// Points of a curved line.
const POINTS: u32 = 400;

/// Lines as points (ωx, ωz or v0). A gap in a line is a point of `None`.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Lines {
    certain: Vec<Option<[f64; 2]>>,
    first_flip: Vec<Option<[f64; 2]>>,
    /// Whether every launch of the map shows heads for ever.
    is_certain_everywhere: bool,
}

/// The lines on the map of `thrown`; none for a body with I1 ≠ I2.
pub(crate) fn lines(thrown: &Thrown, grid: &Grid) -> Result<Lines, Error> {
    let Some(toss) = thrown.coin() else { return Ok(Lines::default()) };
    let edge = Edge { k: toss.coin.inertia_ratio(), tilt: thrown.tilt, y: toss.launch.rate().y };
    match grid.up {
        Up::RateZ => Ok(Lines { certain: edge.over_rate_z(grid), ..Lines::default() }),
        Up::Speed => {
            let z = toss.launch.rate().z;
            let certain: Vec<_> = edge.over_speed(grid, z);
            let ends = grid.across.into_iter().chain([0.5 * (grid.across[0] + grid.across[1])]);
            let is_certain_everywhere = certain.is_empty() && ends.into_iter().all(|x| edge.is_certain(x, z));
            Ok(Lines { certain, first_flip: first_flips(&toss, grid)?, is_certain_everywhere })
        }
    }
}

/// The edge of the launches that show heads for ever.
struct Edge {
    k: f64,
    tilt: f64,
    y: f64,
}

impl Edge {
    /// Whether a launch shows heads for ever.
    fn is_certain(&self, x: f64, z: f64) -> bool {
        let along = self.along(z);
        along * self.k * z >= 0.0 && along.abs() >= x.hypot(self.y)
    }

    /// s · v.
    fn along(&self, z: f64) -> f64 {
        self.y * self.tilt.sin() + self.k * z * self.tilt.cos()
    }

    /// ωz as a function of ωx: s · v = ±√(ωx² + ωy²), on two branches.
    fn over_rate_z(&self, grid: &Grid) -> Vec<Option<[f64; 2]>> {
        let [lo, hi] = grid.across;
        let mut line = Vec::new();
        for sign in [1.0, -1.0] {
            for part in 0..=POINTS {
                let x = lo + (hi - lo) * f64::from(part) / f64::from(POINTS);
                let along = sign * x.hypot(self.y);
                let z = (along - self.y * self.tilt.sin()) / (self.k * self.tilt.cos());
                let is_on_map = (grid.over[0]..=grid.over[1]).contains(&z) && along * self.k * z >= 0.0;
                line.push(is_on_map.then_some([x, z]));
            }
            line.push(None);
        }
        line
    }

    /// The two values of ωx at which the launch becomes certain, at any speed.
    fn over_speed(&self, grid: &Grid, z: f64) -> Vec<Option<[f64; 2]>> {
        let along = self.along(z);
        if along * self.k * z < 0.0 || along.abs() < self.y.abs() {
            return Vec::new();
        }
        let x = ((along - self.y) * (along + self.y)).sqrt();
        let [lo, hi] = grid.across;
        let on_map = [x, -x].into_iter().filter(|x| (lo..=hi).contains(x));
        on_map.flat_map(|x| [Some([x, grid.over[0]]), Some([x, grid.over[1]]), None]).collect()
    }
}

/// The speed at which each ωx is caught at its first flip.
fn first_flips(toss: &CoinToss, grid: &Grid) -> Result<Vec<Option<[f64; 2]>>, Error> {
    let flight = toss.launch.time_of_flight();
    if flight.throw().is_none() {
        return Ok(Vec::new());
    }
    let rate = toss.launch.rate();
    let [lo, hi] = grid.across;
    let at = |part: u32| {
        let x = lo + (hi - lo) * f64::from(part) / f64::from(POINTS);
        let launch = Launch::new(Vector3::new(x, rate.y, rate.z), flight)?;
        let here = CoinToss { coin: toss.coin, launch: launch.with_attitude(toss.launch.attitude()) };
        let speed = CoinMotion::new(&here).first_flip().and_then(|time| flight.speed_of(time));
        Ok(speed.filter(|speed| (grid.over[0]..=grid.over[1]).contains(speed)).map(|speed| [x, speed]))
    };
    (0..=POINTS).map(at).collect()
}
