//! Tests of proofs by integration over all kinds of bodies, coins among them.

use dynamics::{Body, Launch, Solver, TimeOfFlight, Unit, Vector3};
use exact::{ExactSolver, certify};

use super::tests::{Numbers, random, solver};
use super::*;

impl Numbers {
    /// From 1e-2 down to 10^-`digits`, with either sign.
    fn small(&mut self, digits: f64) -> f64 {
        10f64.powf(-self.between(2.0, digits)) * if self.next() < 0.5 { -1.0 } else { 1.0 }
    }

    fn vector(&mut self) -> [f64; 3] {
        [0; 3].map(|_| self.between(-1.0, 1.0))
    }

    fn moments(&mut self) -> [f64; 3] {
        let [a, b, c] = [0; 3].map(|_| self.between(0.01, 1.0));
        let mut moments = [b + c, c + a, a + b];
        moments.sort_by(f64::total_cmp);
        moments
    }
}

/// Moments and rates.
type Make = fn(&mut Numbers) -> ([f64; 3], [f64; 3]);

/// The kind that comes first: its third axis is n.
const COIN: usize = 0;

/// Kinds of bodies and launches: principal moments, the smallest first but of coins, and the rates about their axes.
const KINDS: [(&str, Make); 9] = [
    ("coin", |numbers| {
        let inertia = numbers.between(0.5, 1.0);
        ([inertia, inertia, inertia * numbers.between(0.0, 2.0)], numbers.vector())
    }),
    ("random", |numbers| (numbers.moments(), numbers.vector())),
    ("nearly symmetric", |numbers| {
        let (a, c) = (numbers.between(0.5, 1.0), numbers.between(0.01, 1.0));
        ([a, a * (1.0 + numbers.small(15.0)), 2.0 * a * c], numbers.vector())
    }),
    ("nearly spherical", |numbers| ([1.0, 1.0 + numbers.small(12.0), 1.0 + numbers.small(12.0)], numbers.vector())),
    ("near pure spin", |numbers| {
        let mut rate = [numbers.small(12.0), numbers.small(12.0), numbers.small(12.0)];
        rate[if numbers.next() < 0.5 { 0 } else { 2 }] = 1.0;
        (numbers.moments(), rate)
    }),
    ("near the middle axis", |numbers| {
        (numbers.moments(), [numbers.small(12.0), numbers.between(0.5, 1.0), numbers.small(12.0)])
    }),
    ("near the separatrix", |numbers| {
        let ([a, b, c], [_, y, z]) = (numbers.moments(), numbers.vector());
        ([a, b, c], [(c * (c - b) / (a * (b - a))).sqrt() * z * (1.0 + numbers.small(16.0)), y, z])
    }),
    ("thin", |numbers| {
        let (thin, long) = (numbers.small(8.0).abs(), numbers.between(0.5, 1.0));
        (if numbers.next() < 0.5 { [thin, long, long + 0.9 * thin] } else { [1.0 - long, long, 1.0] }, numbers.vector())
    }),
    ("spin", |numbers| {
        let mut rate = [0.0; 3];
        rate[(3.0 * numbers.next()) as usize] = numbers.between(-2.0, 2.0);
        (numbers.moments(), rate)
    }),
];

/// A toss of a kind with about this phase: each third one in degrees and from a speed, each fourth one with a tensor.
fn toss(kind: usize, index: usize, numbers: &mut Numbers, phase: f64) -> Toss {
    loop {
        let (mut moments, mut rate) = (KINDS[kind].1)(numbers);
        if kind != COIN {
            moments.rotate_left(index % 3);
            rate.rotate_left(index % 3);
        }
        let size = Vector3::from(rate).norm();
        let time = phase * numbers.between(0.5, 1.0);
        let launch = if index % 3 == 1 {
            let time = TimeOfFlight::thrown(time, 1.9 * std::f64::consts::PI / 180.0 * size, Some(numbers.next()));
            let tilt = Unit::DEGREE.times(100.0 * numbers.between(-3.0, 3.0));
            Launch::in_unit(rate, Unit::DEGREE, time).and_then(|launch| launch.with_tilt(tilt))
        } else {
            Launch::new(rate, TimeOfFlight::Given(time / size))
                .and_then(|launch| launch.with_tilt(numbers.between(-3.0, 3.0)))
        };
        let body =
            if index % 4 == 3 && kind != COIN { tensor(moments, numbers) } else { Body::from_moments(moments).ok() };
        if let (Some(body), Ok(launch)) = (body, launch) {
            return Toss { body, launch };
        }
    }
}

/// A body with about these moments about other axes.
fn tensor(moments: [f64; 3], numbers: &mut Numbers) -> Option<Body> {
    let turn = dynamics::Attitude::from_components([1.0, numbers.next(), numbers.next(), numbers.next()]).ok()?;
    let axes = [0, 1, 2].map(|axis: usize| turn.body_to_lab(&Vector3::ith(axis, 1.0)));
    let element = |row: usize, column: usize| (0..3).map(|k| moments[k] * axes[k][row] * axes[k][column]).sum::<f64>();
    Body::from_inertia([element(0, 0), element(1, 1), element(2, 2), element(0, 1), element(0, 2), element(1, 2)]).ok()
}

/// Errors of cos θ and of the attitude, of which half the angle is the distance of the quaternions, to third order.
fn errors(found: &IntegratedCertificate, toss: &Toss) -> [f64; 2] {
    let exact = ExactSolver.land(toss).unwrap();
    let distance = 0.5 * found.landing().state.attitude.angle_to(&exact.state.attitude);
    [(found.cos_tilt() - exact.cos_tilt).abs(), distance]
}

/// Errors divided by their bounds.
pub(super) fn shares(found: &IntegratedCertificate, toss: &Toss) -> [f64; 2] {
    let [of_cos_tilt, of_attitude] = errors(found, toss);
    [of_cos_tilt / found.error_bound(), of_attitude / found.attitude_error_bound()]
}

/// Flights that stay away from a turn about the middle axis have a bound at the default tolerance, and a close one.
#[test]
fn bounds_are_close_but_next_to_the_middle_axis() {
    let solver = solver(1e-10);
    for (kind, (name, _)) in KINDS.iter().enumerate().filter(|(_, (name, _))| !name.starts_with("near the")) {
        let (mut numbers, mut ratios) = (Numbers(9), Vec::new());
        for index in 0..100 {
            let toss = toss(kind, index, &mut numbers, 300.0);
            let found = solver.enclose(&toss).unwrap();
            assert!(found.error_bound() < 1e-3, "{name}: {:e}, {toss:?}", found.error_bound());
            ratios.push(found.attitude_error_bound() / errors(&found, &toss)[1].max(1e-17));
        }
        ratios.sort_by(f64::total_cmp);
        assert!(ratios[50] < 500.0, "{name}: {}", ratios[50]);
    }
}

#[test]
fn landings_are_those_of_the_solver_and_the_same_at_every_simd_level() {
    let (mut numbers, solver) = (Numbers(5), solver(1e-10));
    let kinds = 0..KINDS.len();
    let mut tosses: Vec<_> = kinds
        .flat_map(|kind| [0, 1, 2, 3].map(|index| (kind, index)))
        .collect::<Vec<_>>()
        .into_iter()
        .map(|(kind, index)| toss(kind, index, &mut numbers, [1.0, 40.0, 400.0][index % 3]))
        .collect();
    // Coins between the bodies, and more of them than lanes at the end.
    tosses.insert(3, Toss { body: dynamics::Coin::PAPER.into(), ..tosses[0] });
    let mut numbers = Numbers(5);
    for index in 0..40 {
        let coin = random(&mut numbers, [1.0, 40.0, 400.0][index % 3]);
        let position = if index < 20 { 2 * index } else { tosses.len() };
        tosses.insert(position, coin);
    }
    let proven = |tosses: &[Toss], level| solver.proven(tosses, level, &Stage::ALL[1..]);
    let alone: Vec<_> = tosses.chunks(1).flat_map(|one| proven(one, SimdLevel::for_one_lane())).collect();
    for level in SimdLevel::all() {
        assert_eq!(proven(&tosses, level), alone, "{}", level.name());
    }
    for (toss, landing) in tosses.iter().zip(solver.land_all(&tosses, SimdLevel::widest())) {
        let (enclosed, landing) = (solver.enclose(toss).unwrap(), landing.unwrap());
        assert_eq!((enclosed.landing().state, enclosed.work()), (landing.state, landing.work));
        assert!((enclosed.cos_tilt() - landing.cos_tilt).abs() < 1e-14);
    }
}

/// Without a shift in time, the bound of a turn about an axis grows like e^(μ t), which a flight of 300 rad does not stand.
/// A symmetric body that turns across its axis is slow everywhere on its polhode, so that (22) alone bounds its errors.
#[test]
fn steady_turns_are_proven() {
    let [generic, symmetric] = [[1.0, 2.0, 2.5], [2.0, 1.0, 1.0]].map(|moments| Body::from_moments(moments).unwrap());
    let turned = Body::from_inertia([1.5, 1.5, 1.5, -0.2, -0.2, -0.2]).unwrap();
    let (radian, degree) = (Unit::ONE, Unit::DEGREE);
    for (body, rate, unit) in [
        (generic, [300.1, 0.0, 0.0], radian),
        (generic, [0.0, 300.1, 0.0], radian),
        (generic, [0.0, 300.1, 0.0], degree),
        (generic, [0.0, 0.0, 300.1], radian),
        (turned, [72.0, -72.0, 0.0], radian),
        (symmetric, [0.0, 72.0, -72.0], radian),
    ] {
        let launch = Launch::in_unit(rate, unit, TimeOfFlight::Given(1.0)).unwrap().with_tilt(0.3).unwrap();
        let toss = Toss { body, launch };
        let found = solver(1e-12).certify(&toss).unwrap();
        assert!(found.attitude_error_bound() < 1e-10, "{found:?}");
        assert!(shares(&found, &toss).into_iter().all(|share| share <= 1.0), "{found:?}");
    }
}

/// Bodies whose proofs were wrong or missing, with cos θ by an integration in 77 digits.
#[test]
fn known_bodies_are_proven() {
    for (inertia, rate, time, tilt, cos_tilt) in [
        ([1.0, 1.0, 1.0, 0.0, -5e-18, 0.0], [6.0, 9.0, 7.0], 0.3, 0.0, -0.233_012_678_425_572_84),
        ([1.0, 1.0, 1.0, 0.0, -1e-19, 0.0], [8.0, 8.0, -7.0], 0.8, 0.0, 0.027_325_799_927_544_077),
        ([1.0, 1.0, 0.5, -1e-17, 0.0, 0.0], [3.0, 4.0, 5.0], 0.5, 0.0, -0.552_451_592_217_799_5),
        ([1.5, 1.5, 1.5, -0.2, -0.2, -0.2], [-6.0, -15.6, -4.9], 0.41, 0.0, 0.149_128_538_462_607_58),
        ([1.25, 1.0, 1.0, 0.0, 0.0, -3e-18], [-1.35, -6.0, 3.0], 1.94, 1.2, -0.202_299_053_796_386_4),
        ([0.7, 0.7, 0.7, 0.0, -3e-18, -7e-19], [-0.6, -11.09, -11.23], 2.08, -2.0, -0.665_284_337_073_892_8),
    ] {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).and_then(|launch| launch.with_tilt(tilt)).unwrap();
        let toss = Toss { body: Body::from_inertia(inertia).unwrap(), launch };
        let found = solver(1e-10).certify(&toss).unwrap();
        let off = (found.cos_tilt() - cos_tilt).abs();
        assert!(off <= found.error_bound() && found.error_bound() < 1e-9, "{inertia:?}: {off:e}, {found:?}");
        assert_eq!(found.outcome(), Outcome::of(cos_tilt, 0.0), "{inertia:?}: {found:?}");
    }
}

#[test]
fn extreme_numbers_have_bounds_or_errors() {
    let (mut numbers, solver) = (Numbers(11), solver(1e-10));
    let sizes = [0.0, 5e-324, 1e-310, 1e-160, 1e-30, 1.0, 1e30, 1e300];
    for index in 0..4000 {
        let mut size = || sizes[(8.0 * numbers.next()) as usize] * numbers.between(-1.0, 1.0);
        let (rate, thin) = ([size(), size(), size()], size().abs());
        let largest = rate.iter().fold(0.0_f64, |most, part| most.max(part.abs()));
        let time = TimeOfFlight::Given(50.0 * numbers.next() / largest.max(1e-300));
        let ratio = [0.0, 1e-300, 0.3, 1.0, 2.0][numbers.below(5)];
        let plate = [thin.min(1.0), 1.0, 1.0 + 0.5 * thin.min(1.0)];
        let moments = [[1.0, 1.0, ratio], [thin, 1.0, 1.0], [1.0, 2.0, 2.5], plate][index % 4];
        let Ok(body) = Body::from_moments(moments) else { continue };
        let unit = if index % 8 < 4 { Unit::ONE } else { Unit::DEGREE };
        let Ok(launch) = Launch::in_unit(rate, unit, time) else { continue };
        let toss = Toss { body, launch: launch.with_tilt(numbers.between(-3.0, 3.0)).unwrap() };
        let found = solver.enclose(&toss);
        if toss.coin().is_some() {
            let certified = solver.certify(&toss).map(|found| found.outcome());
            assert_eq!(certified, certify(&toss).map(exact::Certificate::outcome), "{toss:?}");
            match &found {
                // A subnormal rate in degrees loses its digits.
                Ok(found) => assert!(found.error_bound() < 1e-8 || unit != Unit::ONE, "{toss:?}: {found:?}"),
                Err(error) => assert!(matches!(error, SolveError::PhaseTooLarge { .. }), "{toss:?}: {error}"),
            }
        }
        let Ok(found) = found else { continue };
        let parts = [found.error_bound(), found.attitude_error_bound(), found.cos_tilt()];
        assert!(parts.iter().all(|part| part.is_finite()), "{toss:?}: {found:?}");
        assert!(shares(&found, &toss).into_iter().all(|share| share <= 1.0), "{toss:?}");
    }
}
