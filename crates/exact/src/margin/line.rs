//! The line of turns that one input of a toss moves along, in f64: where it is sampled, and how far no flip can be.
//!
//! These bounds let the search skip parts of the line, each proven here or in [`height`](super::height):
//!
//! ```text
//! |f''| ≤ 1                                            everywhere
//! |f''| ≤ σ² + (1 + 4.5 σ)/φ + 10/φ²                   σ = |Φ·e|/φ and φ where each is worst on the part skipped
//! |f''| ≤ |mz| + |a|/3 + |a'| + |b|/12 + |b'|/3 + |b''|/2
//! (m·Φ)² + Φz² > |Φ|²                                  no flip: the cone of n does not reach the horizontal
//! ```
//!
//! The second follows from cos θ = F(s, φ) = (m·s)(ẑ·s)(1 - cos φ) + mz cos φ + sin φ (m × s)z with s = Φ/φ:
//! φ' = σ and φ'' ≤ 1/φ; |s'| ≤ 1/φ and |s''| ≤ 1.16/φ²; the derivatives of F are at most 1 (twice by φ, or once), √5 (by s
//! and φ), 5 (by s) and 4 (twice by s). The third is for coins that stay near the edge all the time; there S = ∫ cos(t φ) dt
//! and V = ∫ (1 - t) cos(t φ) dt over t from 0 to 1, and the n-th derivative of cos(t φ) is at most tⁿ. The last is that of
//! cos θ = A + B cos φ + C sin φ, and says |A| > √(B² + C²).
//!
//! Errors of f in units of u = 2^-53, in the notation of [`height`](super::height):
//!
//! ```text
//! m                 1       rounded from double-double
//! mz cos φ          2.2     a cosine that is right to 1.2 and a product
//! S a               10      3 of Φ/φ, 1.2 of the sine, 5 operations
//! V b               33      V b ≤ 2, with 15 of Φ/φ (three times) and operations, 3 of 1 - cos φ
//! the sums          3
//! the phase         70 u φ  as in the crate's double-double stage; |df/dφ| ≤ 1
//! ```
//!
//! That is 50 + 70 u φ, of which [`error`] makes 64 + 80 u φ; the slope has twice as many operations and twice the bound.

use dynamics::CoinToss;
use dynamics::time_of_flight::ExactTime;
use numerics::scale::mantissa_and_exponent;
use numerics::{DoubleDouble, UNIT_ROUNDOFF};

use super::digits::height_in_digits;
use super::height::{Height, Landing, functions_of_phase};

/// The turns Φ + u e of one input.
pub(super) struct Line<'a> {
    toss: &'a CoinToss,
    /// The input, ωx, ωy or ωz, by its index.
    axis: usize,
    /// m.
    vertical: [DoubleDouble; 3],
    /// e.
    direction: [DoubleDouble; 3],
    /// The part of Φ that the input does not move (rad), and its square.
    across: [DoubleDouble; 3],
    across_squared: DoubleDouble,
    /// Φ·e at launch (rad).
    along: DoubleDouble,
}

impl<'a> Line<'a> {
    /// The line of a rate.
    pub(super) fn of_rate(toss: &'a CoinToss, axis: usize, turn: [DoubleDouble; 3]) -> Self {
        let mut direction = [DoubleDouble::ZERO; 3];
        direction[axis] = 1.0.into();
        let mut across = turn;
        across[axis] = DoubleDouble::ZERO;
        let across_squared = across.iter().fold(DoubleDouble::ZERO, |sum, part| sum + *part * *part);
        Self {
            toss,
            axis,
            vertical: toss.launch.attitude().exact_vertical(),
            direction,
            across,
            across_squared,
            along: turn[axis],
        }
    }

    /// Φ·e at launch (rad).
    pub(super) fn along(&self) -> DoubleDouble {
        self.along
    }

    /// The size of the part of Φ that the input does not move (rad).
    pub(super) fn across(&self) -> f64 {
        self.across_squared.sqrt().hi()
    }

    /// Φ·e and φ at a `change` (rad).
    fn along_and_phase(&self, change: f64) -> [DoubleDouble; 2] {
        let along = self.along + change.into();
        [along, (self.across_squared + along * along).sqrt()]
    }

    /// The landing in f64 where Φ·e is `along` (rad).
    fn landing(&self, along: f64) -> Landing<f64> {
        let [vertical, direction, across] =
            [self.vertical, self.direction, self.across].map(|vector| vector.map(DoubleDouble::hi));
        let part = |index: usize| across[index] + along * direction[index];
        Landing { vertical, turn: [part(0), part(1), part(2)], direction, along }
    }

    /// f and f' at a `change` (rad): in f64, in double-double, and in as many digits as tell f from 0.
    pub(super) fn height(&self, stage: usize, change: f64) -> Height {
        match stage {
            0 => self.rough_height(change),
            1 => self.fine_height(change),
            _ => height_in_digits(self.toss, self.axis, change),
        }
    }

    fn rough_height(&self, change: f64) -> Height {
        let [along, phase] = self.along_and_phase(change);
        height_of(self.landing(along.hi()), phase)
    }

    #[cold]
    fn fine_height(&self, change: f64) -> Height {
        let [along, phase] = self.along_and_phase(change);
        let part = |index: usize| self.across[index] + self.direction[index] * along;
        let turn = [part(0), part(1), part(2)];
        let height = fine_height_of(Landing { vertical: self.vertical, turn, direction: self.direction, along }, phase);
        // f' is of at most twice the size of the vertical.
        let of_vertical = error_of_vertical(self.toss);
        Height { error: height.error + of_vertical, slope_error: height.slope_error + 2.0 * of_vertical, ..height }
    }

    /// A bound of |f''| over a `length` ≥ 0 (rad) from `change` in the direction of `sense`, 1 or -1.
    pub(super) fn curvature(&self, change: f64, sense: f64, length: f64) -> f64 {
        let from = self.along.hi() + change;
        let ends = [from, from + sense * length];
        let bound = self.curvature_far_out(ends).min(self.curvature_by_size(ends));
        // The factor is for the roundings of the bound.
        (1.000_001 * bound).min(1.0)
    }

    /// The bound by the change of the phase, between two values of Φ·e.
    fn curvature_far_out(&self, ends: [f64; 2]) -> f64 {
        let across = self.across_squared.hi();
        let far = ends[0].abs().max(ends[1].abs());
        let near = ends[0].min(ends[1]).max(-ends[0].max(ends[1])).max(0.0);
        let sine = far / (across + far * far).sqrt();
        let inverse = 1.0 / (across + near * near).sqrt();
        let bound = sine * sine + inverse * (1.0 + 4.5 * sine + 10.0 * inverse);
        // Not a number where all are 0, which leaves 1.
        bound.min(1.0)
    }

    /// The bound by the sizes of mz, a and b, between two values of Φ·e. It is convex, so that an end has the most, and
    /// the same for both signs of Φ·e, because across it the line does not move.
    fn curvature_by_size(&self, ends: [f64; 2]) -> f64 {
        let far = ends[0].abs().max(ends[1].abs());
        let Landing { vertical, turn, direction, .. } = self.landing(far);
        let [[m_x, m_y, m_z], [x, y, z], [e_x, e_y, e_z]] =
            [vertical, turn, direction].map(|vector| vector.map(f64::abs));
        let (level, level_slope) = (m_x * x + m_y * y + m_z * z, m_x * e_x + m_y * e_y + m_z * e_z);
        let by_across = (m_x * y + m_y * x) / 3.0 + (m_x * e_y + m_y * e_x);
        let by_tilted = z * level / 12.0 + (e_z * level + z * level_slope) / 3.0 + e_z * level_slope;
        m_z + by_across + by_tilted
    }

    /// A length from `change` on in the direction of `sense` over which the cone of n does not reach the horizontal: 0 if it
    /// may do so at once, infinite if it never does.
    ///
    /// The condition is a quadratic of the length, of which each term is off by less than 16u of the size subtracted.
    pub(super) fn closed_length(&self, change: f64, sense: f64) -> f64 {
        const ERROR: f64 = 32.0 * UNIT_ROUNDOFF;
        let [along, phase] = self.along_and_phase(change);
        let Landing { vertical: m, turn, direction: e, along } = self.landing(along.hi());
        let dot = |a: &[f64; 3], b: &[f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let (level, level_slope, phase) = (dot(&m, &turn), dot(&m, &e), phase.hi());
        let constant = level * level + turn[2] * turn[2] - (1.0 + ERROR) * (phase * phase);
        if constant <= 0.0 {
            return 0.0;
        }
        let linear = sense * (level * level_slope + turn[2] * e[2] - along) - ERROR * phase;
        let square = level_slope * level_slope + e[2] * e[2] - (1.0 + ERROR);
        // The smallest positive root of constant + 2 linear h + square h².
        let discriminant = linear * linear - square * constant;
        // Where the square is positive, the line is that of ωz, and passes Φz = 0, where the cone reaches the horizontal.
        if square >= 0.0 && linear >= 0.0 {
            return f64::INFINITY;
        }
        (1.0 - 1e-9) * (constant / (discriminant.max(0.0).sqrt() - linear))
    }
}

/// Φ at landing (rad), in double-double.
pub(super) fn turn(toss: &CoinToss) -> [DoubleDouble; 3] {
    let time = ExactTime::from(toss.launch.time_of_flight());
    let [x, y, z] = toss.launch.exact_rate();
    let k = toss.coin.exact_inertia_ratio();
    [(x, 1.0.into()), (y, 1.0.into()), (z, k)].map(|(rate, ratio): (DoubleDouble, DoubleDouble)| {
        let (_, exponent) = mantissa_and_exponent(rate.hi());
        (ratio * rate.times_power_of_two(-exponent) * time.mantissa()).times_power_of_two(exponent + time.exponent())
    })
}

/// cos θ of a toss with the turn Φ at landing, and what it becomes after a quarter of a turn of the launch about the lab's x
/// axis; in f64 or, at `stage` 1, in double-double.
pub(super) fn tilted_heights(toss: &CoinToss, turn: [DoubleDouble; 3], stage: usize) -> [Height; 2] {
    let attitude = toss.launch.attitude();
    [attitude.exact_vertical(), attitude.exact_quarter_turned_vertical()].map(|vertical| {
        let line = Line { vertical, ..Line::of_rate(toss, 0, turn) };
        line.height(stage, 0.0)
    })
}

/// f and f' in f64 at a landing with a `phase` (rad).
fn height_of(landing: Landing<f64>, phase: DoubleDouble) -> Height {
    let functions = functions_of_phase(&phase.hi(), phase.rounded_sin_cos(), |number| number);
    let [value, slope] = landing.height_and_slope(functions);
    let error = error(phase.hi());
    Height { value, slope, error, slope_error: 2.0 * error }
}

/// f and f' in double-double at a landing with a `phase` (rad).
fn fine_height_of(landing: Landing<DoubleDouble>, phase: DoubleDouble) -> Height {
    let functions = functions_of_phase(&phase, phase.exact_sin_cos(), DoubleDouble::from);
    let [value, slope] = landing.height_and_slope(functions).map(DoubleDouble::hi);
    let error = fine_error(phase.hi());
    let rounding = UNIT_ROUNDOFF;
    Height { value, slope, error: error + rounding * value.abs(), slope_error: 2.0 * error + rounding * slope.abs() }
}

/// Bound of the error of f in f64 at a `phase` (rad).
fn error(phase: f64) -> f64 {
    (64.0 + 80.0 * UNIT_ROUNDOFF * phase) * UNIT_ROUNDOFF
}

/// Bound of the error of f in double-double at a `phase` (rad): the same operations with 10 u² each, sine and cosine to
/// 64 u².
pub(super) fn fine_error(phase: f64) -> f64 {
    (2000.0 + 100.0 * phase) * (UNIT_ROUNDOFF * UNIT_ROUNDOFF)
}

/// What the vertical adds to the error of f in double-double: seen from a tilted coin, it is right to 2^-67.
pub(super) fn error_of_vertical(toss: &CoinToss) -> f64 {
    const ERROR: f64 = 1.355_252_715_606_880_5e-20; // 2^-66
    if toss.launch.attitude().tilt().is_some() { ERROR } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use dynamics::{AngleUnit, Attitude, Coin, Launch, TimeOfFlight, Unit};

    use super::*;

    /// Tosses with parts of all signs, from horizontal, tilted and in any attitude; the last ones in degrees per second.
    fn tosses() -> Vec<CoinToss> {
        let rates = [[1.0, 1.0, 2.5], [20.0, -31.0, 7.0], [0.0, 9.0, 0.0], [-3.0, 4.0, -6.0], [2e3, 3e3, 5e2]];
        let start = |rate: [f64; 3]| Launch::new(rate, TimeOfFlight::Given(0.7)).unwrap();
        let turned = Attitude::from_components([0.5, 0.6, -0.3, 0.2]).unwrap();
        let launches = rates.into_iter().flat_map(|rate| {
            let start = start(rate);
            [start, start.with_tilt(0.6).unwrap(), start.with_tilt(-2.0).unwrap(), start.with_attitude(turned)]
        });
        let degree = AngleUnit::Turns(Unit::ratio(1, 360).unwrap());
        let in_degrees = Launch::in_unit([60.0, -35.0, 143.0], degree, TimeOfFlight::Given(0.7)).unwrap();
        let launches = launches.chain([in_degrees, in_degrees.with_attitude(turned)]);
        launches.map(|launch| CoinToss { coin: Coin::from_moments(1.0, 1.3).unwrap(), launch }).collect()
    }

    fn lines(test: impl FnMut(&Line)) {
        lines_of(&tosses(), test);
    }

    fn lines_of(tosses: &[CoinToss], mut test: impl FnMut(&Line)) {
        for toss in tosses {
            let turn = turn(toss);
            (0..3).for_each(|axis| test(&Line::of_rate(toss, axis, turn)));
        }
    }

    fn are_close(one: f64, other: f64, part: f64) -> bool {
        (one - other).abs() <= part * one.abs().max(other.abs())
    }

    /// The second bound of the module's table, with σ where the line is at `far` and φ where it is at `near`.
    fn far_out(line: &Line, far: f64, near: f64) -> f64 {
        let [sine, phase] = [far.abs() / line.across().hypot(far), line.across().hypot(near)];
        (sine * sine + (1.0 + 4.5 * sine) / phase + 10.0 / (phase * phase)).min(1.0)
    }

    /// The third bound at one point. Both terms are polynomials of the distance, of which differences give the derivatives.
    fn by_size(line: &Line, along: f64) -> f64 {
        let Landing { vertical, turn, direction, .. } = line.landing(along);
        let [m, turn, e] = [vertical, turn, direction].map(|vector| vector.map(f64::abs));
        let part = |index: usize, further: f64| turn[index] + further * e[index];
        let across = |further| m[0] * part(1, further) + m[1] * part(0, further);
        let level = |further| (0..3).map(|index| m[index] * part(index, further)).sum::<f64>();
        let tilted = |further| part(2, further) * level(further);
        let slope = 0.5 * (tilted(1.0) - tilted(-1.0));
        let curvature = tilted(1.0) - 2.0 * tilted(0.0) + tilted(-1.0);
        m[2] + across(0.0) / 3.0 + (across(1.0) - across(0.0)) + tilted(0.0) / 12.0 + slope / 3.0 + curvature / 2.0
    }

    #[test]
    fn bounds_of_the_curvature_are_those_of_the_table_at_the_worst_end() {
        lines(|line| {
            let at_launch = line.along().hi();
            for (from, to) in [(0.3, 0.3), (-0.2, 0.9), (7.0, 2.0), (-40.0, -4e3), (0.0, 5.0), (-6.0, 1.0)] {
                let [change, length] = [from - at_launch, f64::abs(to - from)];
                let sense = if to < from { -1.0 } else { 1.0 };
                // The sine is worst at the far end, the size at the near one, or between the ends where they have two signs.
                let ends = [from, to];
                let far = if from.abs() > to.abs() { from } else { to };
                let near = if from * to > 0.0 { f64::min(from.abs(), to.abs()) } else { 0.0 };
                let [found, expected] = [line.curvature_far_out(ends), far_out(line, far, near)];
                assert!(are_close(found, expected, 1e-9), "{found} {expected}");
                let [found, expected] = [line.curvature_by_size(ends), by_size(line, far)];
                assert!(are_close(found, expected, 1e-6), "{found} {expected}");
                let both = line.curvature(change, sense, length);
                let least = line.curvature_far_out(ends).min(line.curvature_by_size(ends));
                assert!(
                    both >= least.min(1.0) * (1.0 - 1e-9) && both <= (1.000_002 * least).min(1.0),
                    "{both} {least}"
                );
                // Over a part of the line it is at least that at each of its points.
                for step in 0..=20 {
                    let along = from + (to - from) * f64::from(step) / 20.0;
                    let here = far_out(line, along, along).min(by_size(line, along));
                    assert!(both >= here.min(1.0) * (1.0 - 1e-9), "{from} {to} {along}: {both} {here}");
                }
            }
        });
    }

    /// Where it ends, the cone just reaches the horizontal: (m·Φ)² + Φz² = |Φ|².
    #[test]
    fn the_cone_is_closed_as_far_as_its_length_and_no_further() {
        let (mut ended, mut endless) = (0, 0);
        let short = tosses().into_iter().map(|toss| {
            let flight = TimeOfFlight::Given(1e-6);
            CoinToss { launch: toss.launch.with_time_of_flight(flight).unwrap(), ..toss }
        });
        lines_of(&tosses().into_iter().chain(short).collect::<Vec<_>>(), |line| {
            let size = line.across().hypot(line.along().hi());
            let changes = [0.0, -0.3, 1.1].map(|part| part * size.min(10.0));
            for (change, sense) in changes.into_iter().flat_map(|change| [(change, 1.0), (change, -1.0)]) {
                let closed = |length: f64| {
                    let along = line.along().hi() + change + sense * length;
                    let Landing { vertical: m, turn, .. } = line.landing(along);
                    let level: f64 = (0..3).map(|index| m[index] * turn[index]).sum();
                    let size: f64 = turn.iter().map(|part| part * part).sum();
                    (level * level + turn[2] * turn[2] - size) / size
                };
                let length = line.closed_length(change, sense);
                if length == 0.0 {
                    assert!(closed(0.0) <= 1e-12, "{change} {sense}: {}", closed(0.0));
                } else if length.is_finite() {
                    ended += 1;
                    let [before, at, beyond] = [0.5, 1.0, 1.0 + 1e-7].map(|part| closed(part * length));
                    assert!(
                        before > 0.0 && at > 0.0 && beyond < 0.0,
                        "{change} {sense} {length}: {before} {at} {beyond}"
                    );
                } else {
                    endless += 1;
                    assert!([0.0, 0.1, 1.0, 10.0, 1e3, 1e6].map(closed).iter().all(|closed| *closed > -1e-12));
                }
            }
        });
        assert!(ended > 30 && endless > 5, "{ended} {endless}");
    }

    /// With m along (1, 0, s) and Φ = (1, 0, z) that is c + 2 l h + q h² with c = 2 z s + (z² - 1) s², l = z s - s² and
    /// q = -s², up to s³. Where these are as small as their errors, the length is that of some 32u less of each.
    #[test]
    fn a_cone_that_just_closes_is_closed_as_far_as_the_errors_of_its_terms_allow() {
        for (s, z) in [(1e-7, 1e-7), (1e-9, 1.0)] {
            let launch = Launch::new([1.0, 0.0, z], TimeOfFlight::Given(1.0)).unwrap();
            let attitude = Attitude::from_components([1.0, 0.0, s - 1.0, 0.0]).unwrap();
            let toss = CoinToss { coin: Coin::from_moments(1.0, 1.0).unwrap(), launch: launch.with_attitude(attitude) };
            let found = Line::of_rate(&toss, 0, turn(&toss)).closed_length(0.0, 1.0);
            let length = |error: f64| {
                let phase = f64::hypot(1.0, z);
                let [c, l] =
                    [2.0 * z * s + (z * z - 1.0) * s * s - error * phase * phase, z * s - s * s - error * phase];
                let q = -s * s - error;
                c / ((l * l - q * c).sqrt() - l)
            };
            let [least, most] = [64.0, 16.0].map(|units| length(units * UNIT_ROUNDOFF));
            assert!(found > least && found < most, "{s} {z}: {least:e} {found:e} {most:e}");
        }
    }

    /// Next to a flip, and next to where the slope is 0: where nothing but the errors is left of either.
    #[test]
    fn heights_and_slopes_next_to_0_are_right_to_their_errors_and_these_are_not_much_larger() {
        let mut largest = [[0.0_f64; 2]; 2];
        let mut check = |line: &Line, change: f64| {
            let exact = line.height(2, change);
            for (stage, largest) in largest.iter_mut().enumerate() {
                let Height { value, slope, error, slope_error } = line.height(stage, change);
                // Each was rounded to f64.
                assert!(error >= UNIT_ROUNDOFF * value.abs() && slope_error >= UNIT_ROUNDOFF * slope.abs(), "{stage}");
                let off = [(value - exact.value).abs() - exact.error, (slope - exact.slope).abs() - exact.slope_error];
                for ((off, error), largest) in off.into_iter().zip([error, slope_error]).zip(largest) {
                    assert!(off <= error, "{stage} {change}: {off:e} > {error:e}");
                    *largest = largest.max(off / error);
                }
            }
            exact
        };
        let launch = Launch::new([0.0; 3], TimeOfFlight::Given(0.7)).unwrap().with_tilt(0.6).unwrap();
        let at_rest = CoinToss { coin: Coin::PAPER, launch };
        lines_of(&[tosses(), vec![at_rest]].concat(), |line| {
            let [mut flip, mut top] = [0.1; 2];
            for _ in 0..8 {
                let Height { value, slope, .. } = check(line, flip);
                if slope.abs() > 1e-3 {
                    flip -= value / slope;
                }
                let Height { slope, .. } = check(line, top);
                let [before, after] = [-1e-4, 1e-4].map(|further| line.height(2, top + further).slope);
                let curvature = (after - before) / 2e-4;
                if curvature.abs() > 1e-3 {
                    top -= slope / curvature;
                }
            }
        });
        assert!(largest.iter().flatten().all(|part| *part > 0.01), "{largest:?}");
    }

    #[test]
    fn errors_grow_with_the_phase() {
        for phase in [0.0, 1.0, 1e3, 1e15] {
            let [f64_error, fine] = [error(phase), fine_error(phase)].map(|error| error / UNIT_ROUNDOFF);
            assert!(are_close(f64_error, 64.0 + 80.0 * UNIT_ROUNDOFF * phase, 1e-12), "{phase}");
            assert!(are_close(fine / UNIT_ROUNDOFF, 2000.0 + 100.0 * phase, 1e-12), "{phase}");
        }
    }
}
