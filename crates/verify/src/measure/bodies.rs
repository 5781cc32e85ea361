//! Tosses of bodies that are no coins, in families each of which is hard for a method of its own, and the landings of
//! every solver on them. Some solvers are for coins alone, and refuse them.

use dynamics::{Body, Toss};
use rayon::prelude::*;
use toss::{Launch, SolveError, TimeOfFlight, Vector3};

use crate::measure::any_case::AnyReference;
use crate::measure::drift;
use crate::measure::effort::Effort;
use crate::measure::reference::rigid::RigidReference;
use crate::measure::subject::Subject;

/// The sizes of rates (rad/s, each component at most) and of phases (rad), as powers of ten.
#[derive(Debug, Clone, Copy)]
pub(super) struct Within {
    rate: [f64; 2],
    phase: [f64; 2],
}

/// Phases from 1 to 1e9 rad, which a closed form has to stand.
pub(super) const LONG: Within = Within { rate: [-3.0, 3.0], phase: [0.0, 9.0] };

/// Phases of 1 to 30 rad, as of tosses by hand.
const TOSSED: Within = Within { rate: [1.0, 1.5], phase: [0.0, 1.5] };

/// Phases of 1 to 1000 rad, which integrators fly in moments.
pub(super) const FLOWN: Within = Within { rate: [-3.0, 3.0], phase: [0.0, 3.0] };

/// Bodies and launches that are hard in the same way.
pub struct Family {
    /// Its name.
    pub name: &'static str,
    /// Moments about three axes and the rate along them, from numbers in 0..1 of which no two are related.
    make: fn(&mut Numbers) -> ([f64; 3], [f64; 3]),
}

/// All families.
pub const FAMILIES: [Family; 7] = [
    Family { name: "random", make: |numbers| (moments(numbers), vector(numbers)) },
    Family {
        name: "nearly symmetric",
        make: |numbers| {
            let (a, c) = (numbers.between(0.5, 1.0), numbers.between(0.01, 1.0));
            ([a, a * (1.0 + numbers.small(15.0)), a * 2.0 * c], vector(numbers))
        },
    },
    Family {
        name: "nearly spherical",
        make: |numbers| {
            let near = [1.0, 1.0 + numbers.small(15.0), 1.0 - numbers.small(15.0)];
            (near, vector(numbers))
        },
    },
    Family {
        name: "near pure spin",
        make: |numbers| {
            let (outer, body) = (if numbers.next() < 0.5 { 0 } else { 2 }, sorted(moments(numbers)));
            let mut rate = [numbers.small(12.0), -numbers.small(12.0), numbers.small(12.0)];
            rate[outer] = 1.0;
            (body, rate)
        },
    },
    Family {
        name: "near the middle axis",
        make: |numbers| {
            let body = sorted(moments(numbers));
            (body, [numbers.small(12.0), 1.0, -numbers.small(12.0)])
        },
    },
    Family {
        name: "near the separatrix",
        make: |numbers| {
            let ([a, b, c], [_, y, z]) = (sorted(moments(numbers)), vector(numbers));
            let on = (c * (c - b) / (a * (b - a))).sqrt() * z;
            let off = numbers.small(16.0);
            // Where two moments are nearly equal, the separatrix is far out, but no rate is to be much above 1.
            let outside = on.abs().max(1.0);
            ([a, b, c], [on * (1.0 + off), y, z].map(|rate| rate / outside))
        },
    },
    Family {
        name: "rods and plates",
        make: |numbers| {
            let (thin, long) = (numbers.small(8.0), numbers.between(0.5, 1.0));
            let body = if numbers.next() < 0.5 { [thin, long, long + 0.9 * thin] } else { [1.0 - long, long, 1.0] };
            (body, vector(numbers))
        },
    },
];

/// Numbers that look random, the same in every run (S. Vigna, splitmix64).
pub struct Numbers(u64);

impl Numbers {
    /// A number from 0 to 1.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) >> 11) as f64 * 2f64.powi(-53)
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
pub(super) fn launches(family: &Family, number: u64, within: Within) -> impl Iterator<Item = Toss> {
    (0..number).filter_map(move |index| {
        launch(family, index, within.rate, |numbers| 10f64.powf(numbers.between(within.phase[0], within.phase[1])))
    })
}

/// Toss number `index` of a family, of any size of rates, which turns by about `phase` (rad); `None` if there is none.
pub(super) fn flown_for(family: &Family, index: u64, phase: f64) -> Option<Toss> {
    launch(family, index, FLOWN.rate, |_| phase)
}

fn launch(family: &Family, index: u64, sizes: [f64; 2], phase: impl FnOnce(&mut Numbers) -> f64) -> Option<Toss> {
    let mut numbers = Numbers(index.wrapping_mul(0x5851_f42d_4c95_7f2d));
    let (mut moments, mut rate) = (family.make)(&mut numbers);
    moments.rotate_left((index % 3) as usize);
    rate.rotate_left((index % 3) as usize);
    let rate = Vector3::from(rate) * 10f64.powf(numbers.between(sizes[0], sizes[1]));
    let time = phase(&mut numbers) / rate.norm();
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).ok()?;
    let tilt = if index.is_multiple_of(2) { 0.0 } else { numbers.between(-3.0, 3.0) };
    // A family may make a body that rounding leaves without room, or a launch that needs no elliptic function.
    let toss = Toss { body: Body::from_moments(moments).ok()?, launch: launch.with_tilt(tilt).ok()? };
    RigidReference::solves(&toss).then_some(toss)
}

/// What a subject did with one toss of a body.
pub struct BodyFinding {
    /// The family.
    pub family: &'static str,
    /// The toss.
    pub toss: Toss,
    /// Its errors, or why it has no landing.
    pub errors: Result<BodyErrors, SolveError>,
}

/// The errors of a landing.
#[derive(Debug, Clone, Copy)]
pub struct BodyErrors {
    /// Of cos θ.
    pub cos_tilt: f64,
    /// Of the attitude (rad).
    pub attitude: f64,
    /// The largest drift of |S|, of the energy, and of S as a vector; see [`drift::of_rigid`].
    pub drift: f64,
    /// The error estimate; `None` where the solver does not say.
    pub estimate: Option<f64>,
}

/// What one subject did with all bodies.
pub struct BodyFindings {
    /// The index of the subject.
    pub subject: usize,
    /// One for each toss.
    pub findings: Vec<BodyFinding>,
}

/// The landings of tosses of every family by each of `subjects` that solves bodies at all.
pub fn survey(subjects: &[Subject], effort: Effort) -> Vec<BodyFindings> {
    let number = match effort {
        Effort::Quick => 20,
        Effort::Standard => 100,
        Effort::Deep => 15_000,
    };
    let each = |family: &'static Family| launches(family, number, TOSSED).map(move |toss| (family.name, toss));
    let tosses: Vec<(&'static str, Toss)> = FAMILIES.iter().flat_map(each).collect();
    let references: Vec<_> = tosses.par_iter().map(|(_, toss)| AnyReference::of_rigid(toss)).collect();
    let fly = |(subject, by): (usize, &Subject)| {
        let of = |((family, toss), reference): (&(&'static str, Toss), &Result<AnyReference, SolveError>)| {
            let errors = reference.as_ref().map_err(Clone::clone).and_then(|reference| errors(by, toss, reference));
            BodyFinding { family, toss: *toss, errors }
        };
        let refuses = |toss: &Toss| matches!(by.solver.tilt(toss), Err(SolveError::NotSymmetric { .. }));
        if tosses.iter().all(|(_, toss)| refuses(toss)) {
            return None;
        }
        let findings = tosses.par_iter().with_max_len(1).zip(&references).map(of).collect();
        Some(BodyFindings { subject, findings })
    };
    subjects.iter().enumerate().filter_map(fly).collect()
}

/// The errors of `by` on `toss`.
///
/// # Errors
/// Those of the solver.
pub fn errors(by: &Subject, toss: &Toss, reference: &AnyReference) -> Result<BodyErrors, SolveError> {
    let landing = by.solver.land(toss)?;
    Ok(BodyErrors {
        cos_tilt: reference.cos_tilt_error(landing.cos_tilt),
        attitude: reference.attitude_error(&landing.state.attitude),
        drift: drift::of_rigid(toss, &landing.state).into_iter().fold(0.0, f64::max),
        estimate: landing.error,
    })
}
