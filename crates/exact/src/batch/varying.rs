//! This kernel computes cos θ or the attitude at landing for tosses of coins of which each has a coin, a gravity, a drop and an
//! attitude of its own. The time of flight T comes with its rest, as a rate times T is a phase:
//!
//! ```text
//! T = 2 v0/g,   or (v0 + √d)/g with d = v0² + 2 g h          each product, sum and quotient with what rounding has lost,
//!                                                            a quotient as the product with the rounded inverse
//! k = I3/I1                                                  and its rest, to u² k
//! cos θ = (A + B cos φ + C sin φ)/|L|²,   φ = |L| T          as from any attitude, with m the vertical at launch (BF)
//! Q = Q0 ⊗ exp(½ φ ŝ) ⊗ exp(-½ q T ẑ)                        as by the kernel of attitudes, q = (k - 1) ωz with its rest
//! ```
//!
//! In units of u = 2^-53, m is off by 6u (sine and cosine 2u each of a tilt; products, norm and division of a quaternion), A,
//! B and C by 24u |L|² in all, sine, cosine and the scale by 3u each, and φ by less than 2^-56: together less than 1e-14, a
//! hundredth of `PROVEN_ABOVE`. φ, of at most 2^43 rad, has a relative error of some u² from the products, and from the root,
//! whose rest is of the first order in the rest of d: at most ε²/8 of itself with ε = 2u v0²/d ≤ 20u, as d is at least a tenth
//! of v0².

use dynamics::Coin;
use dynamics::attitude::vertical_in_body;
use numerics::lanes::{MOST_TURNS, Real, Simd, SimdLevel, WithSimd, sin_cos};

use super::attitude::{product, turned_and_spun};
use super::momentum::{Constants, Extent, Motion, SMALLEST_RATIO, without_negligible};
use crate::tilt_terms::terms;

/// |cos θ| above which the sign of a result of [`Varying::cos_tilts`] is proven to be that of cos θ. A NaN is not above it.
pub const PROVEN_ABOVE: f64 = 1e-12;

/// Tosses in a tile, a multiple of the number of lanes of every SIMD level.
const TILE: usize = 128;

/// The part of v0² that is left of d where the drop is negative: with less, its rest would be too large.
const LEAST_LEFT: f64 = 0.1;

/// The limits of the gravity, and of the drop and a tilt.
const GRAVITY: [f64; 2] = [1e-50, 1e50];
const LARGEST: f64 = 1e50;
const LARGEST_TILT: f64 = 1e6;

/// The limits of the squared norm of a quaternion.
const NORM: [f64; 2] = [1e-100, 1e100];

/// 2/π and its rest: quarters of a turn per radian.
const QUARTERS: [f64; 2] = [std::f64::consts::FRAC_2_PI, -3.935_735_335_036_497e-17];

/// The largest moment, in any unit; the smallest is its inverse.
const LARGEST_MOMENT: f64 = 1e100;

/// A number for each toss, or one for all.
#[derive(Debug, Clone, Copy)]
pub enum Column<'a> {
    /// As many as there are tosses.
    Each(&'a [f64]),
    /// The same for all.
    All(f64),
}

/// The coins that are tossed.
#[derive(Debug, Clone, Copy)]
pub enum Coins<'a> {
    /// Their inertia ratios k, and the rests of these: [`Coin::exact_inertia_ratio`].
    Ratios([Column<'a>; 2]),
    /// Their moments I1 and I3, in any unit.
    Moments([Column<'a>; 2]),
}

impl From<Coin> for Coins<'_> {
    /// The same coin for all tosses.
    fn from(coin: Coin) -> Self {
        let ratio = coin.exact_inertia_ratio();
        Self::Ratios([ratio.hi(), ratio.lo()].map(Column::All))
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

/// Tosses of coins that may differ in all.
#[derive(Debug, Clone, Copy)]
pub struct Varying<'a> {
    /// The coins.
    pub coins: Coins<'a>,
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
    pub fn cos_tilts(&self, out: &mut [f64]) {
        self.run(SimdLevel::widest(), CosTilt, [out]);
    }

    /// As [`Varying::cos_tilts`] the attitudes at landing, as columns of the quaternion's w, x, y and z, of either sign: to
    /// 2e-15 rad.
    pub fn attitudes(&self, out: [&mut [f64]; 4]) {
        self.run(SimdLevel::widest(), Turned, out);
    }

    fn run<A: Answer<OUT>, const OUT: usize>(&self, level: SimdLevel, answer: A, out: [&mut [f64]; OUT]) {
        let mut lengths = self.rates.iter().map(|column| column.len()).chain(out.iter().map(|column| column.len()));
        assert!(lengths.all(|length| length == out[0].len()), "a column must have one entry per toss");
        // With a gravity of 2 m/s², a speed is the time of flight. The coin is none of the tosses.
        let constants = Constants::of(&Coin::PAPER, 2.0).with_phases_times(A::PHASE);
        level.run(Run { tosses: self, constants, answer, out });
    }

    /// Rates, speeds or times, gravity, drop, ratio and rest or moments, and a tilt or the components of a quaternion.
    fn columns(&self) -> [Column<'_>; 12] {
        let [x, y, z] = self.rates.map(Column::Each);
        let zero = Column::All(0.0);
        let [speed, gravity, drop] = match self.flights {
            Flights::Times(times) => [times, Column::All(2.0), zero],
            Flights::Level(speeds, gravities) => [speeds, gravities, zero],
            Flights::Below(speeds, gravities, drops) => [speeds, gravities, drops],
        };
        let (Coins::Ratios([first, second]) | Coins::Moments([first, second])) = self.coins;
        let [a, b, c, d] = match self.attitudes {
            Attitudes::Tilts(tilts) => [tilts, zero, zero, zero],
            Attitudes::Quaternions(parts) => parts,
        };
        [x, y, z, speed, gravity, drop, first, second, a, b, c, d]
    }
}

/// What is asked of each toss.
trait Answer<const OUT: usize> {
    /// The unit of phases, as parts of a turn.
    const PHASE: f64;

    /// The answer, from what is known of the toss.
    fn of<S: Simd>(&self, tosses: &Varying<'_>, constants: &Constants, launch: &Flown<S>) -> [Real<S>; OUT];

    /// Whether it is one: a number that is below 2 if it is, and NaN or more if it is not.
    fn size<S: Simd>(answer: &[Real<S>; OUT]) -> Real<S>;
}

/// Tosses at their landing.
struct Flown<S: Simd> {
    rates: [Real<S>; 3],
    ratio: [Real<S>; 2],
    /// The time of flight (s) and its rest.
    time: [Real<S>; 2],
    motion: Motion<S>,
    /// The phase ωL T and its rest, in the unit of the answer.
    phase: [Real<S>; 2],
    held: [Real<S>; 4],
}

/// cos θ.
struct CosTilt;

impl Answer<1> for CosTilt {
    // A quarter of a turn.
    const PHASE: f64 = 4.0;

    #[inline(always)]
    fn of<S: Simd>(&self, tosses: &Varying<'_>, _: &Constants, flown: &Flown<S>) -> [Real<S>; 1] {
        let Flown { rates: [x, y, _], motion, phase, held, .. } = flown;
        let vertical = match tosses.attitudes {
            Attitudes::Tilts(_) => {
                let [sin, cos] = sin_cos_of(held[0], 1.0);
                [x.constant(0.0), sin, cos]
            }
            Attitudes::Quaternions(_) => {
                let ([x, y, z], norm) = vertical_in_body(*held);
                let scale = norm.constant(1.0) / within(norm, NORM);
                [x * scale, y * scale, z * scale]
            }
        };
        let [sin, cos] = sin_cos(phase[0], phase[1]);
        let [mean, cosine, sine] = terms(vertical, [*x, *y, motion.along], motion.across_squared);
        let height = mean + cosine.mul_add(cos, (sine * motion.size) * sin);
        [height * (motion.half_inverse + motion.half_inverse)]
    }

    #[inline(always)]
    fn size<S: Simd>([cos]: &[Real<S>; 1]) -> Real<S> {
        cos.abs()
    }
}

/// The attitude.
struct Turned;

impl Answer<4> for Turned {
    // Half of an angle, measured in quarters of a turn.
    const PHASE: f64 = 2.0;

    #[inline(always)]
    fn of<S: Simd>(&self, tosses: &Varying<'_>, constants: &Constants, flown: &Flown<S>) -> [Real<S>; 4] {
        let Flown { rates: [x, y, z], ratio, time, motion, phase, held } = flown;
        let inverse = motion.size * (motion.half_inverse + motion.half_inverse);
        let axis = [*x * inverse, *y * inverse, motion.along * inverse];
        // q T, each factor with its rest.
        let [less_one, less_one_rest] = ratio[0].sum(x.constant(-1.0));
        let [rate, rate_rest] = z.product_in_range(less_one);
        let rate_rest = z.mul_add(less_one_rest + ratio[1], rate_rest);
        let [angle, angle_rest] = rate.product_in_range(time[0]);
        let angle_rest = rate.mul_add(time[1], rate_rest.mul_add(time[0], angle_rest));
        let [one, one_rest] = constants.phase_of_one();
        let [spin, spin_rest] = angle.product_in_range(x.constant(one));
        let spin_rest = spin.mul_add(x.constant(one_rest), angle_rest.mul_add(x.constant(one), spin_rest));
        let turned = turned_and_spun(*phase, [spin, without_negligible(spin_rest)], axis);
        match tosses.attitudes {
            Attitudes::Tilts(Column::All(0.0)) => turned,
            Attitudes::Tilts(_) => {
                let [sin, cos] = sin_cos_of(held[0], 0.5);
                product([cos, sin, x.constant(0.0), x.constant(0.0)], turned)
            }
            Attitudes::Quaternions(_) => {
                let [w, x, y, z] = *held;
                let norm = w.mul_add(w, x.mul_add(x, y.mul_add(y, z * z)));
                let scale = norm.constant(1.0) / within(norm, NORM).sqrt();
                product([w * scale, x * scale, y * scale, z * scale], turned)
            }
        }
    }

    #[inline(always)]
    fn size<S: Simd>([w, x, y, z]: &[Real<S>; 4]) -> Real<S> {
        w.mul_add(*w, x.mul_add(*x, y.mul_add(*y, *z * *z)))
    }
}

/// The kernel, with its tosses and where its results go.
struct Run<'a, 'out, A, const OUT: usize> {
    tosses: &'a Varying<'a>,
    constants: Constants,
    answer: A,
    out: [&'out mut [f64]; OUT],
}

impl<A: Answer<OUT>, const OUT: usize> WithSimd for Run<'_, '_, A, OUT> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let (columns, mut tile) = (self.tosses.columns(), [[1.0; TILE]; 12]);
        for (column, room) in columns.iter().zip(&mut tile) {
            if let Column::All(value) = column {
                room.fill(*value);
            }
        }
        let tosses = self.out[0].len();
        for start in (0..tosses).step_by(TILE) {
            let number = TILE.min(tosses - start);
            for (column, room) in columns.iter().zip(&mut tile) {
                if let Column::Each(column) = column {
                    room[..number].copy_from_slice(&column[start..start + number]);
                }
            }
            for at in (0..number).step_by(Real::<S>::LANES) {
                // No closure, which would be compiled without the instructions of the level.
                let mut launch = [Real::splat(simd, 0.0); 12];
                for (number, column) in launch.iter_mut().zip(&tile) {
                    *number = Real::load(simd, &column[at..]);
                }
                let found = self.found(simd, launch);
                for (part, out) in found.iter().zip(&mut self.out) {
                    part.store_up_to(&mut out[start + at..start + number]);
                }
            }
        }
    }
}

impl<A: Answer<OUT>, const OUT: usize> Run<'_, '_, A, OUT> {
    /// The answer, and NaN where it is none.
    #[inline(always)]
    fn found<S: Simd>(&self, simd: S, launch: [Real<S>; 12]) -> [Real<S>; OUT] {
        let [x, y, z, speed, gravity, drop, first, second, a, b, c, d] = launch;
        let time = self.time(within(speed, [0.0, f64::MAX]), within(gravity, GRAVITY), drop);
        let ratio = match self.tosses.coins {
            Coins::Ratios(_) => [within(first, [SMALLEST_RATIO, 2.0]), second],
            Coins::Moments(_) => ratio_of(first, second),
        };
        let mut extent = Extent::new(simd);
        let motion = self.constants.motion_with(ratio, [x, y, z], time[0], &mut extent);
        let later = (motion.size * time[1]) * x.constant(self.constants.phase_of_one()[0]);
        let phase = [motion.turns[0], without_negligible(motion.turns[1] + later)];
        let flown = Flown { rates: [x, y, z], ratio, time, motion, phase, held: [a, b, c, d] };
        let mut answer = self.answer.of(self.tosses, &self.constants, &flown);
        let size = A::size(&answer);
        // The phase of the spin, |q| T, is at most 1/k times as large if k < 1.
        let most = x.constant(A::PHASE * MOST_TURNS) * ratio[0].min(x.constant(1.0));
        let (is_known, is_ordinary) = (size.at_most(x.constant(2.0)), extent.are_ordinary(most));
        let nan = x.constant(f64::NAN);
        for part in &mut answer {
            *part = is_ordinary.choose(is_known.choose(part.clamp_to_cosine(), nan), nan);
        }
        answer
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
        let inverse = gravity.constant(1.0) / gravity;
        let time = sum * inverse;
        let [back, back_rest] = time.product_in_range(gravity);
        [time, (((sum - back) - back_rest) + rest) * inverse]
    }
}

/// k = I3/I1 and its rest; NaN of moments that no coin has.
#[inline(always)]
fn ratio_of<S: Simd>(i1: Real<S>, i3: Real<S>) -> [Real<S>; 2] {
    let limits = [1.0 / LARGEST_MOMENT, LARGEST_MOMENT];
    let (i1, i3) = (within(i1, limits), within(i3, limits));
    let inverse = i1.constant(1.0) / i1;
    let ratio = i3 * inverse;
    let [back, back_rest] = ratio.product_in_range(i1);
    let is_coin = i3.at_most(i1 + i1);
    [is_coin.choose(ratio, ratio.constant(f64::NAN)), ((i3 - back) - back_rest) * inverse]
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

/// The sine and the cosine of `part` of a tilt (rad), a power of two.
#[inline(always)]
fn sin_cos_of<S: Simd>(tilt: Real<S>, part: f64) -> [Real<S>; 2] {
    let tilt = within(tilt, [-LARGEST_TILT, LARGEST_TILT]);
    let [quarters, rest] = tilt.product_in_range(tilt.constant(part * QUARTERS[0]));
    sin_cos(quarters, tilt.mul_add(tilt.constant(part * QUARTERS[1]), rest))
}

#[cfg(test)]
mod tests {
    use dynamics::{Attitude, CoinToss, Launch, TimeOfFlight};

    use super::*;
    use crate::compensated::{compensated_cos_tilt, compensated_landing};

    const TOSSES: usize = 1003;

    /// Numbers between two others, another sequence for each root.
    fn spread(root: f64, [least, most]: [f64; 2]) -> Vec<f64> {
        (0..TOSSES).map(|index| least + (most - least) * (index as f64 * root.sqrt()).fract()).collect()
    }

    fn at(column: Column<'_>, index: usize) -> f64 {
        match column {
            Column::Each(column) => column[index],
            Column::All(value) => value,
        }
    }

    /// Toss `index` by itself, if it is one.
    fn alone(tosses: &Varying<'_>, index: usize) -> Option<CoinToss> {
        let at = |column| at(column, index);
        let coin = match tosses.coins {
            Coins::Moments([i1, i3]) => Coin::from_moments(at(i1), at(i3)).unwrap(),
            Coins::Ratios([ratio, _]) => {
                let coins = COINS.map(|name| name.parse::<Coin>().unwrap());
                coins.into_iter().find(|coin| coin.inertia_ratio() == at(ratio)).unwrap()
            }
        };
        let time = match tosses.flights {
            Flights::Times(times) => TimeOfFlight::Given(at(times)),
            Flights::Level(speeds, gravities) => TimeOfFlight::thrown(at(speeds), at(gravities), None),
            Flights::Below(speeds, gravities, drops) => {
                TimeOfFlight::thrown(at(speeds), at(gravities), Some(at(drops)))
            }
        };
        let attitude = match tosses.attitudes {
            Attitudes::Tilts(tilts) => Attitude::about_x(at(tilts)),
            Attitudes::Quaternions(parts) => Attitude::from_components(parts.map(at)).unwrap(),
        };
        let launch = Launch::new(tosses.rates.map(|column| column[index]), time).ok()?;
        Some(CoinToss { coin, launch: launch.with_attitude(attitude) })
    }

    const COINS: [&str; 3] = ["us-quarter", "paper", "euro-2c"];

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
        let moments = [spread(37.0, [2e-7, 9e-7]), spread(41.0, [1e-9, 4e-7])];
        let ratios = COINS.map(|name| name.parse::<Coin>().unwrap().exact_inertia_ratio());
        let ratio = |part: fn(&numerics::DoubleDouble) -> f64| -> Vec<f64> {
            (0..TOSSES).map(|index| part(&ratios[index % 3])).collect()
        };
        let ratios = [ratio(|ratio| ratio.hi()), ratio(|ratio| ratio.lo())];
        let coins = [
            COINS[0].parse::<Coin>().unwrap().into(),
            Coins::Moments(moments.each_ref().map(|column| Column::Each(column))),
            Coins::Ratios(ratios.each_ref().map(|column| Column::Each(column))),
        ];
        for (coins, flights) in coins.into_iter().flat_map(|coins| flights.map(|flights| (coins, flights))) {
            for attitudes in [Attitudes::Tilts(tilt), Attitudes::Tilts(Column::All(0.0)), quaternions] {
                let tosses = Varying { coins, rates, flights, attitudes };
                let (mut found, mut turned) = ([0.0; TOSSES], [[0.0; TOSSES]; 4]);
                tosses.cos_tilts(&mut found);
                tosses.attitudes(turned.each_mut().map(|column| &mut column[..]));
                for level in SimdLevel::all() {
                    let (mut lowest, mut low) = ([0.0; TOSSES], [[0.0; TOSSES]; 4]);
                    tosses.run(level, CosTilt, [&mut lowest]);
                    tosses.run(level, Turned, low.each_mut().map(|column| &mut column[..]));
                    assert_eq!(found.map(f64::to_bits), lowest.map(f64::to_bits), "{}", level.name());
                    assert_eq!(turned.map(|part| part.map(f64::to_bits)), low.map(|part| part.map(f64::to_bits)));
                }
                let (mut largest, mut most_turned, mut unsolved) = (0.0_f64, 0.0_f64, 0);
                for index in 0..TOSSES {
                    let (found, turned) = (found[index], turned.map(|part| part[index]));
                    assert_eq!(turned.map(f64::is_nan), [found.is_nan(); 4], "{index}");
                    let alone = alone(&tosses, index);
                    if found.is_nan() || alone.is_none() {
                        assert!(found.is_nan(), "{index} does not reach its landing");
                        unsolved += 1;
                        continue;
                    }
                    let alone = alone.unwrap();
                    largest = largest.max((found - compensated_cos_tilt(&alone).unwrap()).abs());
                    let right = compensated_landing(&alone).unwrap().attitude;
                    most_turned = most_turned.max(angle(right.components(), turned));
                }
                let is_right = largest < 1e-15 && most_turned < 2e-15 && unsolved < 100;
                assert!(is_right, "{flights:?} {attitudes:?}: {largest:e}, {most_turned:e} rad, {unsolved}");
            }
        }
    }

    /// The angle (rad) between two attitudes near each other.
    fn angle(one: [f64; 4], two: [f64; 4]) -> f64 {
        let sign = one.iter().zip(two).map(|(one, two)| one * two).sum::<f64>().signum();
        2.0 * one.iter().zip(two).map(|(one, two)| (one - sign * two).powi(2)).sum::<f64>().sqrt()
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
        let which = |tosses: Varying<'_>| {
            let (mut out, mut turned) = ([0.0; 9], [[0.0; 9]; 4]);
            tosses.cos_tilts(&mut out);
            tosses.attitudes(turned.each_mut().map(|column| &mut column[..]));
            let left_out = out.map(f64::is_nan);
            assert_eq!(turned.map(|part| part.map(f64::is_nan)), [left_out; 4]);
            left_out
        };
        let flights = Flights::Below(Column::Each(&speeds), Column::Each(&gravities), Column::Each(&drops));
        let attitudes = Attitudes::Tilts(Column::Each(&tilts));
        let coins = Coins::from(Coin::PAPER);
        let found = which(Varying { coins, rates: [&x, &column, &column], flights, attitudes });
        assert_eq!(found, [true, true, true, true, true, false, false, false, false]);
        let parts = [0.0, 1e-60, 1e60, f64::NAN, 1.0, 1.0, 1.0, 1.0, 1.0];
        let attitudes = Attitudes::Quaternions([Column::Each(&parts); 4]);
        let flights = Flights::Times(Column::All(1.0));
        let found = which(Varying { coins, rates: [&column; 3], flights, attitudes });
        assert_eq!(found[..5], [true, true, true, true, false]);
        let attitudes = Attitudes::Tilts(Column::All(0.0));
        let above_two = 2.0_f64.next_up();
        let i3 = [0.0, -1.0, 2.1, f64::NAN, above_two, 2.0, 1.0, 1e-9, 1e-101];
        let coins = Coins::Moments([Column::All(1.0), Column::Each(&i3)]);
        let found = which(Varying { coins, rates: [&column; 3], flights, attitudes });
        assert_eq!(found, [true, true, true, true, true, false, false, false, true]);
        let rests = [0.0; 9];
        let coins = Coins::Ratios([Column::Each(&i3), Column::Each(&rests)]);
        let found = which(Varying { coins, rates: [&column; 3], flights, attitudes });
        // The spin of the last one takes too many turns.
        assert_eq!(found, [true, true, true, true, true, false, false, false, true]);
    }
}
