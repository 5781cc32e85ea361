//! Bodies in families each of which is hard for a method of its own, with launches of them. All checks take their bodies
//! from here: surveys, proofs, adversaries, flights at the finest tolerances, margins and the comparison of the references.

use dynamics::{Body, Toss};
use nalgebra::{Matrix3, Quaternion, UnitQuaternion};
use toss::quantity::{Quantity, Unit};
use toss::{Attitude, Coin, InputError, Launch, TimeOfFlight, Vector3};

use crate::measure::effort::Effort;
use crate::measure::reference::Reference;
use crate::measure::tosses::throw;

/// The sizes of rates (rad/s, each component at most) and of phases (rad), as powers of ten.
#[derive(Debug, Clone, Copy)]
pub(super) struct Within {
    rate: [f64; 2],
    phase: [f64; 2],
}

/// Phases from 1 to 1e9 rad, which a closed form has to stand.
pub(super) const LONG: Within = Within { rate: [-3.0, 3.0], phase: [0.0, 9.0] };

/// Phases of 1 to 30 rad, as of tosses by hand.
pub(super) const TOSSED: Within = Within { rate: [1.0, 1.5], phase: [0.0, 1.5] };

/// Phases of 1 to 1000 rad, which integrators fly in moments.
pub(super) const FLOWN: Within = Within { rate: [-3.0, 3.0], phase: [0.0, 3.0] };

/// Bodies and launches that are hard in the same way.
pub(super) struct Family {
    pub(super) name: &'static str,
    /// Makes body number `index`, and a launch without its time, of numbers in 0..1 of which no two are related; `None` where
    /// rounding leaves no such body.
    make: fn(&mut Numbers, u64) -> Option<Drawn>,
}

/// A body, and a launch without its time.
struct Drawn {
    body: Body,
    /// In the unit, of the size of 1.
    rate: [f64; 3],
    unit: Unit,
    /// `None` for any.
    attitude: Option<Attitude>,
}

impl Drawn {
    fn new(body: Result<Body, InputError>, rate: [f64; 3]) -> Option<Self> {
        Some(Self { body: body.ok()?, rate, unit: Unit::ONE, attitude: None })
    }

    /// A body with these moments and the rate along them, about axes that `index` permutes.
    fn along(moments: [f64; 3], mut rate: [f64; 3], index: u64) -> Option<Self> {
        rate.rotate_left((index % 3) as usize);
        Self::new(turned_moments(moments, index), rate)
    }
}

/// Bodies with three moments.
pub(super) const FAMILIES: [Family; 7] = [
    Family { name: "random", make: |numbers, index| Drawn::along(moments(numbers), vector(numbers), index) },
    Family {
        name: "nearly symmetric",
        make: |numbers, index| {
            let (a, c) = (numbers.between(0.5, 1.0), numbers.between(0.01, 1.0));
            Drawn::along([a, a * (1.0 + numbers.small(15.0)), a * 2.0 * c], vector(numbers), index)
        },
    },
    Family {
        name: "nearly spherical",
        make: |numbers, index| {
            let near = [1.0, 1.0 + numbers.small(15.0), 1.0 - numbers.small(15.0)];
            Drawn::along(near, vector(numbers), index)
        },
    },
    Family {
        name: "near pure spin",
        make: |numbers, index| {
            let (outer, body) = (if numbers.next() < 0.5 { 0 } else { 2 }, sorted(moments(numbers)));
            let mut rate = [numbers.small(12.0), -numbers.small(12.0), numbers.small(12.0)];
            rate[outer] = 1.0;
            Drawn::along(body, rate, index)
        },
    },
    Family {
        name: "near the middle axis",
        make: |numbers, index| {
            let body = sorted(moments(numbers));
            Drawn::along(body, [numbers.small(12.0), 1.0, -numbers.small(12.0)], index)
        },
    },
    Family {
        name: "near the separatrix",
        make: |numbers, index| {
            let ([a, b, c], [_, y, z]) = (sorted(moments(numbers)), vector(numbers));
            let on = (c * (c - b) / (a * (b - a))).sqrt() * z;
            let off = numbers.small(16.0);
            // Where two moments are nearly equal, the separatrix is far out, but no rate is to be much above 1.
            let outside = on.abs().max(1.0);
            Drawn::along([a, b, c], [on * (1.0 + off), y, z].map(|rate| rate / outside), index)
        },
    },
    Family {
        name: "rods and plates",
        make: |numbers, index| {
            let (thin, long) = (numbers.small(8.0), numbers.between(0.5, 1.0));
            let body = if numbers.next() < 0.5 { [thin, long, long + 0.9 * thin] } else { [1.0 - long, long, 1.0] };
            Drawn::along(body, vector(numbers), index)
        },
    },
];

/// Bodies and launches for which no method has a simple case, given in every form.
pub(super) const HARD: [Family; 8] = [
    Family {
        name: "two moments nearly equal",
        make: |numbers, index| {
            let (a, c) = (numbers.between(0.5, 50.0), numbers.between(0.01, 1.0));
            Drawn::new(turned_moments([a, a * (1.0 + numbers.gap()), 2.0 * a * c], index), vector(numbers))
        },
    },
    Family {
        name: "three moments nearly equal",
        make: |numbers, index| {
            let a = numbers.between(1e-7, 1e-5);
            let moments = [a, a * (1.0 + numbers.gap()), a * (1.0 - numbers.gap())];
            Drawn::new(turned_moments(moments, index), vector(numbers))
        },
    },
    Family {
        name: "nearly diagonal tensors",
        make: |numbers, index| {
            let a = numbers.between(0.5, 2.0);
            let c = if index % 3 == 0 { a * numbers.between(0.1, 1.9) } else { a };
            let b = if index % 5 == 0 { a * (1.0 + numbers.gap()) } else { a };
            let [xy, xz, yz] = [0; 3].map(|_| numbers.off_the_diagonal() * a);
            Drawn::new(Body::from_inertia([a, b, c, xy, xz, yz]), vector(numbers))
        },
    },
    Family {
        name: "turned tensors",
        make: |numbers, index| {
            let a = numbers.between(0.5, 2.0);
            let moments = match index % 4 {
                0 => moments(numbers),
                1 => [a, a, a * numbers.between(0.1, 1.9)],
                2 => [a, a * (1.0 + numbers.gap()), a * (1.0 - numbers.gap())],
                _ => [a, a, a],
            };
            Drawn::new(turned_tensor(numbers, moments), vector(numbers))
        },
    },
    Family {
        name: "plates and rods",
        make: |numbers, index| {
            let (a, b, thin) = (numbers.between(0.1, 1.0), numbers.between(0.1, 1.0), numbers.small(12.0));
            let body = match index % 4 {
                0 => turned_moments([a, b, a + b], index / 4),
                1 => turned_tensor(numbers, [a, b, a + b]),
                2 => turned_moments([0.0, a, a], index / 4),
                _ => turned_moments([thin * a, a, a * (1.0 + 0.9 * thin)], index / 4),
            };
            Drawn::new(body, vector(numbers))
        },
    },
    Family {
        name: "quaternions of any norm",
        make: |numbers, index| {
            let size = 10f64.powf(numbers.between(-3.0, 3.0));
            // By turns Q and -Q.
            let size = if index % 2 == 0 { size } else { -size };
            let [x, y, z] = vector(numbers);
            let attitude = Attitude::from_components([numbers.between(-1.0, 1.0), x, y, z].map(|part| part * size));
            let moments = moments(numbers);
            let drawn = Drawn::new(Body::from_moments(moments), vector(numbers))?;
            Some(Drawn { attitude: Some(attitude.ok()?), ..drawn })
        },
    },
    Family {
        name: "units",
        make: |numbers, index| {
            let (radius, thickness) = (numbers.between(5.0, 20.0), numbers.between(0.5, 60.0));
            let [gram, millimetre] = [(); 2].map(|()| Unit::ratio(1, 1000).unwrap_or(Unit::ONE));
            let coin = Coin::from_cylinder(
                gram.times(numbers.between(1.0, 30.0)),
                millimetre.times(radius),
                millimetre.times(thickness),
            );
            let body = if index % 2 == 0 { coin.map(Body::from) } else { Body::from_moments(moments(numbers)) };
            let unit = if index % 3 == 0 { Unit::TURN } else { Unit::DEGREE };
            let drawn = Drawn::new(body, vector(numbers))?;
            Some(Drawn { unit, attitude: Some(Attitude::about_x(in_degrees(numbers))), ..drawn })
        },
    },
    Family {
        name: "axes, separatrix and tiny rates",
        make: |numbers, index| {
            let tiny = [0; 3].map(|_| 10f64.powf(-numbers.between(15.0, 60.0)));
            let mut rate = match index % 4 {
                0 => [0.0; 3],
                1 => [tiny[0], -tiny[1], tiny[2]],
                2 => vector(numbers).map(|part| part * tiny[0]),
                // On the separatrix of the body below.
                _ => [0.75, numbers.between(-1.0, 1.0), 1.0],
            };
            if index % 4 < 3 {
                rate[(index / 4 % 3) as usize] = numbers.between(0.5, 1.0);
            }
            let general = [[1.0, 2.0, 2.25], [2.0, 2.25, 1.0], [1.0, 1.0, 1.5], [1.5, 1.0, 1.0]];
            let body = if index % 4 == 3 { general[0] } else { general[(index / 12 % 4) as usize] };
            Drawn::new(Body::from_moments(body), rate)
        },
    },
];

/// An angle of up to 180 degrees.
fn in_degrees(numbers: &mut Numbers) -> Quantity {
    Unit::DEGREE.times(numbers.between(-180.0, 180.0))
}

/// A body with these moments about axes that `turn` permutes.
fn turned_moments(mut moments: [f64; 3], turn: u64) -> Result<Body, InputError> {
    moments.rotate_left((turn % 3) as usize);
    Body::from_moments(moments)
}

/// A body with these principal moments, to rounding, about axes in any directions.
fn turned_tensor(numbers: &mut Numbers, moments: [f64; 3]) -> Result<Body, InputError> {
    let [x, y, z] = vector(numbers);
    let turn = UnitQuaternion::new_normalize(Quaternion::new(numbers.between(-1.0, 1.0), x, y, z)).to_rotation_matrix();
    let tensor = turn.matrix() * Matrix3::from_diagonal(&Vector3::from(moments)) * turn.matrix().transpose();
    let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = <[[f64; 3]; 3]>::from(tensor);
    Body::from_inertia([xx, yy, zz, xy, xz, yz])
}

/// How many tosses of each hard family there are.
pub(super) fn hard_number(effort: Effort) -> u64 {
    effort.of([12, 60, 1500])
}

pub(super) fn hard_tosses(effort: Effort) -> Vec<Vec<Toss>> {
    HARD.iter().map(|family| hard_tosses_of(family, hard_number(effort))).collect()
}

/// Tosses of a hard family, which turn by 1 to 30 rad at rates from 1e-3 to 1e3 in their units.
pub(super) fn hard_tosses_of(family: &Family, number: u64) -> Vec<Toss> {
    (0..number).filter_map(|index| hard_toss(family, index, None)).collect()
}

/// Toss number `index` of a hard family, which turns by `phase` (rad), or by 1 to 30 rad.
pub(super) fn hard_toss(family: &Family, index: u64, phase: Option<f64>) -> Option<Toss> {
    let mut numbers = Numbers(index.wrapping_mul(0x2545_f491_4f6c_dd1d).wrapping_add(family.name.len() as u64));
    let Drawn { body, rate, unit, attitude } = (family.make)(&mut numbers, index)?;
    // A power of two keeps every digit.
    let size = 2f64.powf(numbers.between(-10.0, 10.0).round());
    let rate = Vector3::from(rate) * size;
    let phase = phase.unwrap_or_else(|| 10f64.powf(numbers.between(TOSSED.phase[0], TOSSED.phase[1])));
    let still = Launch::in_unit(rate, unit, TimeOfFlight::Given(0.0)).ok()?;
    let time = phase / still.turn_rate();
    let launch = still.with_time_of_flight(throw(TimeOfFlight::Given(time), index)).ok()?;
    let quarter = |part: &mut Numbers| [0; 4].map(|_| part.between(-1.0, 1.0));
    let attitude = match (attitude, index % 4) {
        (Some(attitude), _) => attitude,
        (None, 0) => Attitude::IDENTITY,
        (None, 1) => Attitude::about_x(numbers.between(-3.0, 3.0)),
        (None, 2) => Attitude::about_x(in_degrees(&mut numbers)),
        (None, _) => Attitude::from_components(quarter(&mut numbers)).ok()?,
    };
    Some(Toss { body, launch: launch.with_attitude(attitude) })
}

/// Numbers that look random, the same in every run (S. Vigna, splitmix64).
pub(super) struct Numbers(u64);

impl Numbers {
    /// A number from 0 to 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 * 2f64.powi(-53)
    }

    /// A relative difference of two moments: 0, some ulp, or from 1e-15.6 to 1e-10.
    fn gap(&mut self) -> f64 {
        match (4.0 * self.next()) as u32 {
            0 => 0.0,
            1 => f64::EPSILON * (1.0 + (4.0 * self.next()).floor()),
            _ => 10f64.powf(-self.between(10.0, 15.6)),
        }
    }

    /// An element off the diagonal: 0, or of either sign from 1e-5 down to 1e-40.
    fn off_the_diagonal(&mut self) -> f64 {
        let sign = if self.next() < 0.5 { -1.0 } else { 1.0 };
        match (5.0 * self.next()) as u32 {
            0 | 1 => 0.0,
            2 => sign * 10f64.powf(-self.between(20.0, 40.0)),
            3 => sign * 10f64.powf(-self.between(16.0, 20.0)),
            _ => sign * 10f64.powf(-self.between(5.0, 16.0)),
        }
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    /// A number from 1e-2 down to 10^-`digits`, of any size alike.
    fn small(&mut self, digits: f64) -> f64 {
        10f64.powf(-self.between(2.0, digits))
    }
}

/// Moments of a body with mass at random distances from three planes.
fn moments(numbers: &mut Numbers) -> [f64; 3] {
    let [a, b, c] = [0; 3].map(|_| numbers.between(0.01, 1.0));
    [b + c, c + a, a + b]
}

fn sorted(mut moments: [f64; 3]) -> [f64; 3] {
    moments.sort_by(f64::total_cmp);
    moments
}

fn vector(numbers: &mut Numbers) -> [f64; 3] {
    [0; 3].map(|_| numbers.between(-1.0, 1.0))
}

/// Tosses of a family. n is any one of the three axes.
pub(super) fn launches(family: &Family, number: u64, Within { rate, phase }: Within) -> Vec<Toss> {
    let phase = |numbers: &mut Numbers| 10f64.powf(numbers.between(phase[0], phase[1]));
    (0..number).filter_map(|index| launch(family, index, rate, phase)).collect()
}

/// Toss number `index` of a family, of any size of rates, which turns by about `phase` (rad); `None` if there is none.
pub(super) fn flown_for(family: &Family, index: u64, phase: f64) -> Option<Toss> {
    launch(family, index, FLOWN.rate, |_| phase)
}

fn launch(family: &Family, index: u64, sizes: [f64; 2], phase: impl FnOnce(&mut Numbers) -> f64) -> Option<Toss> {
    let mut numbers = Numbers(index.wrapping_mul(0x5851_f42d_4c95_7f2d));
    let Drawn { body, rate, .. } = (family.make)(&mut numbers, index)?;
    let rate = Vector3::from(rate) * 10f64.powf(numbers.between(sizes[0], sizes[1]));
    let time = phase(&mut numbers) / rate.norm();
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).ok()?;
    let tilt = if index.is_multiple_of(2) { 0.0 } else { numbers.between(-3.0, 3.0) };
    // A family may make a launch that needs no elliptic function.
    let toss = Toss { body, launch: launch.with_tilt(tilt).ok()? };
    Reference::is_elliptic(&toss).then_some(toss)
}
