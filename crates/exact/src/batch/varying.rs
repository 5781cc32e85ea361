//! This kernel computes cos θ at landing for tosses of a coin of which each has a gravity, a drop and an attitude of its own.
//! The time of flight T comes with its rest, as a rate times T is a phase:
//!
//! ```text
//! T = 2 v0/g,   or (v0 + √d)/g with d = v0² + 2 g h          each product, sum and quotient with what rounding has lost
//! cos θ = (A + B cos φ + C sin φ)/|L|²,   φ = |L| T          as from any attitude, with m the vertical at launch (BF)
//! ```
//!
//! In units of u = 2^-53, m is off by 6u (sine and cosine 2u each of a tilt; products, norm and division of a quaternion), A,
//! B and C by 24u |L|² in all, sine, cosine and the scale by 3u each, and φ by less than 2^-56: together less than 1e-14, a
//! hundredth of `PROVEN_ABOVE`. φ, of at most 2^43 rad, has a relative error of some u² from the products, and from the root,
//! whose rest is of the first order in the rest of d: at most ε²/8 of itself with ε = 2u v0²/d ≤ 20u, as d is at least a tenth
//! of v0².

use dynamics::attitude::vertical_in_body;
use dynamics::{Attitude, Coin, InputError, Outcome, Tosses};
use numerics::lanes::{Real, Simd, SimdLevel, WithSimd, sin_cos};

use super::momentum::{Constants, Extent, without_negligible};
use crate::tilt_terms::terms;

/// |cos θ| above which the sign of a result is proven to be that of cos θ.
const PROVEN_ABOVE: f64 = 1e-12;

/// The outcome that a result of [`Varying::cos_tilts`] proves; `None` next to an edge, and of one that was not solved.
#[inline]
pub fn proven(cos_tilt: f64) -> Option<Outcome> {
    // Nothing is above or below a NaN.
    match (cos_tilt > PROVEN_ABOVE, cos_tilt < -PROVEN_ABOVE) {
        (true, _) => Some(Outcome::Heads),
        (_, true) => Some(Outcome::Tails),
        _ => None,
    }
}

/// Tosses in a tile, a multiple of the number of lanes of every SIMD level.
const TILE: usize = 128;

/// The part of v0² that is left of d where the drop is negative: with less, its rest would be too large.
const LEAST_LEFT: f64 = 0.1;

/// The limits of the gravity, and of the drop and a tilt.
const GRAVITY: [f64; 2] = [1e-50, 1e50];
const LARGEST: f64 = 1e50;
const LARGEST_TILT: f64 = 1e6;

/// 2/π and its rest: quarters of a turn per radian.
const QUARTERS: [f64; 2] = [std::f64::consts::FRAC_2_PI, -3.935_735_335_036_497e-17];

/// A number for each toss, or one for all.
#[derive(Debug, Clone, Copy)]
pub enum Column<'a> {
    /// As many as there are tosses.
    Each(&'a [f64]),
    /// The same for all.
    All(f64),
}

impl Column<'_> {
    /// Copies those from `start` on; the last ones of `room` stay.
    fn fill(self, room: &mut [f64; TILE], start: usize, number: usize) {
        match self {
            Self::Each(column) => room[..number].copy_from_slice(&column[start..start + number]),
            Self::All(value) => room.fill(value),
        }
    }
}

/// How the tosses are held at launch.
#[derive(Debug, Clone, Copy)]
pub enum Attitudes<'a> {
    /// The angles (rad) by which they are turned about the laboratory's x axis.
    Tilts(Column<'a>),
    /// The components w, x, y and z of quaternions of any norm, from the body to the laboratory.
    Quaternions([Column<'a>; 4]),
}

/// When the tosses land.
#[derive(Debug, Clone, Copy)]
pub enum Flights<'a> {
    /// After these times (s).
    Times(Column<'a>),
    /// At the height of their launch: speeds (m/s) and gravities (m/s²).
    Level(Column<'a>, Column<'a>),
    /// Below their launch: speeds (m/s), gravities (m/s²) and drops (m).
    Below(Column<'a>, Column<'a>, Column<'a>),
}

/// Tosses of a coin that differ in all but the coin.
#[derive(Debug, Clone, Copy)]
pub struct Varying<'a> {
    /// The coin.
    pub coin: Coin,
    /// Angular velocities at launch (body frame, rad/s): all ωx, all ωy, all ωz.
    pub rates: [&'a [f64]; 3],
    /// When they land.
    pub flights: Flights<'a>,
    /// How they are held.
    pub attitudes: Attitudes<'a>,
}

impl Varying<'_> {
    /// Writes cos θ at landing of each toss to 1e-15, and NaN for those that the kernel does not solve: impossible ones, and
    /// those with numbers as large or small as no coin has them. The same bits at every SIMD level. Panics if a column does
    /// not have one entry per toss.
    ///
    /// # Errors
    /// None but for a coin that no [`Tosses`] take.
    pub fn cos_tilts(&self, out: &mut [f64]) -> Result<(), InputError> {
        self.cos_tilts_on(SimdLevel::widest(), out)
    }

    fn cos_tilts_on(&self, level: SimdLevel, out: &mut [f64]) -> Result<(), InputError> {
        assert!(self.rates.iter().all(|column| column.len() == out.len()), "a column must have one entry per toss");
        // With a gravity of 2 m/s², a speed is the time of flight.
        let constants = Constants::new(&Tosses::new(self.coin, Attitude::IDENTITY, 2.0, [&[]; 3], &[])?);
        level.run(Run { tosses: self, constants: constants.with_phases_times(4.0), out });
        Ok(())
    }

    /// Fills `columns` with the tosses from `start` on: rates, speeds or times, gravity, drop, and the attitude, which is a tilt
    /// or the vertical (BF).
    fn fill(&self, columns: &mut [[f64; TILE]; 9], start: usize, number: usize) {
        let [x, y, z, speed, gravity, drop, tilt, across, along] = columns;
        for (column, room) in self.rates.into_iter().zip([x, y, z]) {
            Column::Each(column).fill(room, start, number);
        }
        let (speeds, gravities, drops) = match self.flights {
            Flights::Times(times) => (times, Column::All(2.0), Column::All(0.0)),
            Flights::Level(speeds, gravities) => (speeds, gravities, Column::All(0.0)),
            Flights::Below(speeds, gravities, drops) => (speeds, gravities, drops),
        };
        for (column, room) in [(speeds, speed), (gravities, gravity), (drops, drop)] {
            column.fill(room, start, number);
        }
        match self.attitudes {
            Attitudes::Tilts(tilts) => tilts.fill(tilt, start, number),
            Attitudes::Quaternions(parts) => {
                let mut quaternions = [[1.0; TILE]; 4];
                for (column, room) in parts.into_iter().zip(&mut quaternions) {
                    column.fill(room, start, number);
                }
                for place in 0..number {
                    let (vertical, norm) = vertical_in_body(quaternions.each_ref().map(|part| part[place]));
                    // What is NaN is solved by itself.
                    let scale = if (1e-100..1e100).contains(&norm) { 1.0 / norm } else { f64::NAN };
                    [tilt[place], across[place], along[place]] = vertical.map(|part| part * scale);
                }
            }
        }
    }
}

/// The kernel, with its tosses and where its results go. Its phases are in quarters of a turn.
struct Run<'a, 'out> {
    tosses: &'a Varying<'a>,
    constants: Constants,
    out: &'out mut [f64],
}

impl WithSimd for Run<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut columns = [[1.0; TILE]; 9];
        for start in (0..self.out.len()).step_by(TILE) {
            let number = TILE.min(self.out.len() - start);
            self.tosses.fill(&mut columns, start, number);
            for at in (0..number).step_by(Real::<S>::LANES) {
                // No closure, which would be compiled without the instructions of the level.
                let mut launch = [Real::splat(simd, 0.0); 9];
                for (number, column) in launch.iter_mut().zip(&columns) {
                    *number = Real::load(simd, &column[at..]);
                }
                self.cos_tilt(simd, launch).store_up_to(&mut self.out[start + at..start + number]);
            }
        }
    }
}

impl Run<'_, '_> {
    #[inline(always)]
    fn cos_tilt<S: Simd>(&self, simd: S, launch: [Real<S>; 9]) -> Real<S> {
        let [x, y, z, speed, gravity, drop, first, second, third] = launch;
        let nan = x.constant(f64::NAN);
        let [time, rest] = self.time(within(speed, [0.0, f64::MAX]), within(gravity, GRAVITY), drop);
        let vertical = match self.tosses.attitudes {
            Attitudes::Tilts(_) => vertical_at(first),
            Attitudes::Quaternions(_) => [first, second, third],
        };
        let mut extent = Extent::new(simd);
        let motion = self.constants.motion([x, y, z], time, &mut extent);
        let later = (motion.size * rest) * x.constant(self.constants.phase_of_one());
        let [sin, cos] = sin_cos(motion.turns[0], without_negligible(motion.turns[1] + later));
        let [mean, cosine, sine] = terms(vertical, [x, y, motion.along], motion.across_squared);
        let height = mean + cosine.mul_add(cos, (sine * motion.size) * sin);
        let inverse = motion.half_inverse + motion.half_inverse;
        // NaN where any of the numbers is.
        let is_number = (height * inverse).abs().at_most(x.constant(2.0));
        let known = is_number.choose((height * inverse).clamp_to_cosine(), nan);
        extent.are_ordinary(&self.constants).choose(known, nan)
    }

    /// T and its rest, from the speed, the gravity and the drop.
    #[inline(always)]
    fn time<S: Simd>(&self, speed: Real<S>, gravity: Real<S>, drop: Real<S>) -> [Real<S>; 2] {
        if let Flights::Times(_) = self.tosses.flights {
            return [speed, speed.constant(0.0)];
        }
        let [sum, rest] = match self.tosses.flights {
            Flights::Below(..) => {
                let [square, square_rest] = speed.product_in_range(speed);
                let drop = within(drop, [-LARGEST, LARGEST]);
                let [fall, fall_rest] = (gravity + gravity).product_in_range(drop);
                let [left, left_rest] = square.sum(fall);
                let left = enough(left, square);
                let root = left.sqrt();
                let [back, back_rest] = root.product_in_range(root);
                let root_rest = (((left - back) - back_rest) + (left_rest + (square_rest + fall_rest)))
                    * (left.constant(0.5) / root);
                let [sum, rest] = speed.sum(root);
                [sum, rest + root_rest]
            }
            _ => [speed + speed, speed.constant(0.0)],
        };
        let time = sum / gravity;
        let [back, back_rest] = time.product_in_range(gravity);
        [time, (((sum - back) - back_rest) + rest) / gravity]
    }
}

/// d if enough of v0² is left in it, else NaN.
#[inline(always)]
fn enough<S: Simd>(left: Real<S>, square: Real<S>) -> Real<S> {
    (square * square.constant(LEAST_LEFT)).less_than(left).choose(left, left.constant(f64::NAN))
}

/// The number if it is within these limits, else NaN.
#[inline(always)]
fn within<S: Simd>(number: Real<S>, [least, most]: [f64; 2]) -> Real<S> {
    let nan = number.constant(f64::NAN);
    let is_small = number.at_most(number.constant(most));
    number.constant(least).at_most(number).choose(is_small.choose(number, nan), nan)
}

/// The vertical (BF) at a tilt (rad).
#[inline(always)]
fn vertical_at<S: Simd>(tilt: Real<S>) -> [Real<S>; 3] {
    let tilt = within(tilt, [-LARGEST_TILT, LARGEST_TILT]);
    let [quarters, rest] = tilt.product_in_range(tilt.constant(QUARTERS[0]));
    let [sin, cos] = sin_cos(quarters, tilt.mul_add(tilt.constant(QUARTERS[1]), rest));
    [tilt.constant(0.0), sin, cos]
}

#[cfg(test)]
mod tests {
    use dynamics::{CoinToss, Launch, TimeOfFlight};

    use super::*;
    use crate::compensated::compensated_cos_tilt;

    const TOSSES: usize = 1003;

    /// Numbers between two others, another sequence for each root.
    fn spread(root: f64, [least, most]: [f64; 2]) -> Vec<f64> {
        (0..TOSSES).map(|index| least + (most - least) * (index as f64 * root.sqrt()).fract()).collect()
    }

    #[test]
    fn each_toss_lands_as_it_does_alone_whatever_varies() {
        let rates = [2.0, 3.0, 5.0].map(|root| spread(root, [-300.0, 300.0]));
        let rates = rates.each_ref().map(Vec::as_slice);
        let (speeds, gravities) = (spread(7.0, [0.0, 5.0]), spread(11.0, [1.6, 12.0]));
        let (drops, tilts) = (spread(13.0, [-0.3, 2.0]), spread(17.0, [-9.0, 9.0]));
        let parts = [19.0, 23.0, 29.0, 31.0].map(|root| spread(root, [-3.0, 3.0]));
        let [speed, gravity, drop, tilt] = [&speeds, &gravities, &drops, &tilts].map(|column| Column::Each(column));
        let flights = [
            Flights::Times(speed),
            Flights::Level(speed, gravity),
            Flights::Level(speed, Column::All(9.81)),
            Flights::Below(speed, gravity, drop),
            Flights::Below(speed, Column::All(9.81), Column::All(1.0)),
        ];
        let quaternions = Attitudes::Quaternions(parts.each_ref().map(|part| Column::Each(part)));
        let coin = Coin::from_moments(1.0, 1.7).unwrap();
        for flights in flights {
            for attitudes in [Attitudes::Tilts(tilt), Attitudes::Tilts(Column::All(0.0)), quaternions] {
                let tosses = Varying { coin, rates, flights, attitudes };
                let [mut found, mut lowest] = [[0.0; TOSSES]; 2];
                tosses.cos_tilts(&mut found).unwrap();
                for level in SimdLevel::all() {
                    tosses.cos_tilts_on(level, &mut lowest).unwrap();
                    assert_eq!(found.map(f64::to_bits), lowest.map(f64::to_bits), "{}", level.name());
                }
                let (mut largest, mut unsolved) = (0.0_f64, 0);
                for (index, found) in found.into_iter().enumerate() {
                    let at = |column: Column<'_>| match column {
                        Column::Each(column) => column[index],
                        Column::All(value) => value,
                    };
                    let time = match flights {
                        Flights::Times(times) => TimeOfFlight::Given(at(times)),
                        Flights::Level(speeds, gravities) => TimeOfFlight::thrown(at(speeds), at(gravities), None),
                        Flights::Below(speeds, gravities, drops) => {
                            TimeOfFlight::thrown(at(speeds), at(gravities), Some(at(drops)))
                        }
                    };
                    let attitude = match attitudes {
                        Attitudes::Tilts(tilts) => Attitude::about_x(at(tilts)),
                        Attitudes::Quaternions(parts) => Attitude::from_components(parts.map(at)).unwrap(),
                    };
                    let Ok(launch) = Launch::new(rates.map(|column| column[index]), time) else {
                        assert!(found.is_nan(), "{index} does not reach its landing");
                        unsolved += 1;
                        continue;
                    };
                    let alone = compensated_cos_tilt(&CoinToss { coin, launch: launch.with_attitude(attitude) });
                    if found.is_nan() {
                        unsolved += 1;
                    } else {
                        largest = largest.max((found - alone.unwrap()).abs());
                    }
                }
                assert!(largest < 1e-15 && unsolved < 100, "{flights:?} {attitudes:?}: {largest:e}, {unsolved}");
            }
        }
    }

    #[test]
    fn impossible_and_extreme_launches_are_left_out() {
        let column = [3.0; 9];
        let alone = |place: usize, value: f64| {
            column
                .iter()
                .copied()
                .enumerate()
                .map(move |(at, usual)| if at == place { value } else { usual })
                .collect::<Vec<_>>()
        };
        let [x, speeds, gravities] = [alone(0, f64::NAN), alone(1, -1.0), alone(2, 0.0)];
        let (drops, tilts) = (alone(3, -3.0), alone(4, f64::INFINITY));
        let mut out = [0.0; 9];
        let flights = Flights::Below(Column::Each(&speeds), Column::Each(&gravities), Column::Each(&drops));
        let attitudes = Attitudes::Tilts(Column::Each(&tilts));
        Varying { coin: Coin::PAPER, rates: [&x, &column, &column], flights, attitudes }.cos_tilts(&mut out).unwrap();
        assert_eq!(out.map(f64::is_nan), [true, true, true, true, true, false, false, false, false], "{out:?}");
        let parts = [0.0, 1e-60, 1e60, f64::NAN, 1.0, 1.0, 1.0, 1.0, 1.0];
        let attitudes = Attitudes::Quaternions([Column::Each(&parts); 4]);
        let flights = Flights::Times(Column::All(1.0));
        Varying { coin: Coin::PAPER, rates: [&column; 3], flights, attitudes }.cos_tilts(&mut out).unwrap();
        assert_eq!(out.map(f64::is_nan)[..5], [true, true, true, true, false], "{out:?}");
    }
}
