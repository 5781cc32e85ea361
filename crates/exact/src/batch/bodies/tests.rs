//! These tests hold the filter and the bound of its error against the motion in double-double.

use dynamics::{Attitude, Body, Stage, Toss, Tosses};
use numerics::DoubleDouble;
use numerics::lanes::SimdLevel;

use super::*;
use crate::rigid::state;

/// Numbers between two, of Weyl's sequence.
fn column(count: usize, square: f64, [from, to]: [f64; 2]) -> Vec<f64> {
    (0..count).map(|index| from + (to - from) * (index as f64 * square.sqrt()).fract()).collect()
}

/// Columns of launches: rates (rad/s) and speeds (m/s).
struct Columns([Vec<f64>; 4]);

impl Columns {
    fn new(count: usize, fastest: f64, speed: f64) -> Self {
        let [x, y, z] = [2.0, 3.0, 5.0].map(|square| column(count, square, [-fastest, fastest]));
        Self([x, y, z, column(count, 7.0, [0.0, speed])])
    }

    fn tosses(&self, body: Body, attitude: Attitude) -> Tosses<'_, Body> {
        let [x, y, z, speeds] = &self.0;
        Tosses::new(body, attitude, 9.81, [x, y, z], speeds).unwrap()
    }
}

/// Writes cos θ, the bound of its error, and the norm, of each toss.
struct Bounded<'a>(&'a Constants, Tosses<'a, Body>, &'a mut Vec<[f64; 3]>);

impl WithSimd for Bounded<'_> {
    type Output = ();

    fn with_simd<S: Simd>(self, simd: S) {
        for index in 0..self.1.len() {
            let launch = self.1.columns(index..index + 1).map(|column| Real::splat(simd, column[0]));
            let Height { height, norm, bound } = self.0.end(self.0.begin(launch));
            self.2.push([height / norm, bound, norm].map(Real::first));
        }
    }
}

/// cos θ, the bound of its error, and the norm, of each toss.
fn bounded(constants: &Constants, tosses: Tosses<'_, Body>) -> Vec<[f64; 3]> {
    let mut found = Vec::new();
    SimdLevel::for_one_lane().run(Bounded(constants, tosses, &mut found));
    found
}

/// What is written for cos θ times the norm, the norm, and the bound of the error of cos θ.
struct Written([f64; 3]);

impl WithSimd for Written {
    type Output = f64;

    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let [height, norm, bound] = self.0.map(|part| Real::splat(simd, part));
        Height { height, norm, bound }.written().first()
    }
}

#[test]
fn heights_are_written_where_cos_tilt_is_beyond_its_bound() {
    for norm in [0.15, 4.0] {
        for (cos_tilt, bound, is_written) in [(0.9, 0.8, true), (-0.8, 0.9, false), (-1e-12, 0.9e-12, true)] {
            let height = cos_tilt * norm;
            let written = SimdLevel::for_one_lane().run(Written([height, norm, bound]));
            assert_eq!(written, if is_written { height } else { 0.0 }, "{cos_tilt} to {bound}, norm {norm}");
        }
    }
}

/// The largest ratio of an error to its bound, of the tosses whose bounds are in a range.
fn largest_ratio(tosses: Tosses<'_, Body>, bounds: Range<f64>) -> (f64, usize) {
    let found = bounded(&Constants::new(&tosses).unwrap(), tosses);
    let (mut largest, mut tried) = (0.0_f64, 0);
    for (index, [cos_tilt, bound, norm]) in found.into_iter().enumerate() {
        if bound.is_infinite() || !bounds.contains(&bound) {
            continue;
        }
        // Far below the bound: more digits would take longer.
        let landed = |toss: &Toss| state(toss, toss.launch.time_of_flight().into(), Stage::DoubleDouble, 1e-3 * bound);
        let error = (cos_tilt - tosses.solve(index, landed).unwrap().attitude.cos_tilt()).abs();
        assert!(error <= bound, "{:?}: {error:e} > {bound:e}", tosses.solve(index, |toss| Ok(*toss)));
        assert!(norm > 0.142, "(|θ4|² + |θ1|²)² = {norm}");
        largest = largest.max(error / bound);
        tried += 1;
    }
    (largest, tried)
}

/// Bodies of all kinds: far from symmetric, nearly symmetric in both ways, nearly spherical, needles and plates.
fn bodies() -> Vec<Body> {
    let moments = [
        [1.0, 2.0, 2.25],
        [2.25, 1.0, 2.0],
        [2.0, 2.25, 1.0],
        [1.0, 1.001, 2.0],
        [1.0, 2.0, 2.001],
        [1.0, 1.0 + 1e-12, 2.0],
        [1.0, 1.00001, 1.00003],
        [0.01, 1.0, 1.003],
        [1e-6, 1.0, 1.0 + 9e-7],
        [1.0, 2.0, 3.0],
        [1.0, 2.0, 2.0],
        [3.0, 2.0, 2.0],
    ];
    let tensor = [[2.0, 0.3, -0.2], [0.3, 2.5, 0.1], [-0.2, 0.1, 3.0]];
    let engraved = dynamics::catalogue::named_body("us-quarter-engraved").unwrap();
    let turned = [Body::from_tensor(tensor).unwrap(), engraved];
    moments.map(|moments| Body::from_moments(moments).unwrap()).into_iter().chain(turned).collect()
}

/// Short, ordinary and long flights of all bodies have errors within their bounds, of which the part `least` would not do.
#[test]
fn errors_are_within_their_bounds_and_not_far_below() {
    for (speed, least) in [(0.02, 0.03), (5.0, 0.1), (5e5, 0.01)] {
        for body in bodies() {
            let launches = Columns::new(1500, 60.0, speed);
            let (largest, tried) = largest_ratio(launches.tosses(body, Attitude::about_x(0.3)), 0.0..f64::MAX);
            assert!(tried > 1490 && largest > least, "{body:?}, {speed} m/s: {largest:e} of {tried}");
        }
    }
}

/// There the rounding of E counts, and the series end too early.
#[test]
fn errors_next_to_the_separatrix_are_within_bounds_of_which_a_hundredth_would_not_do() {
    let body = Body::from_moments([1.0, 2.0, 2.25]).unwrap();
    for (speed, least) in [(3.0, 0.03), (3e5, 0.005)] {
        let mut launches = Columns::new(6000, 40.0, speed);
        let [x, _, z, _] = &mut launches.0;
        for (index, (x, z)) in x.iter().zip(z).enumerate() {
            let apart = [1e-2, -1e-3, 1e-3, 2e-4][index % 4] * (1.0 + (index as f64 * 11f64.sqrt()).fract());
            *z = (x * x / (2.25 * 0.25)).sqrt() * (1.0 + apart);
        }
        for bounds in [1e-9..1e-7, 1e-7..1e-6, 1e-6..1e-5, 1e-5..1e-3] {
            let (largest, tried) = largest_ratio(launches.tosses(body, Attitude::IDENTITY), bounds.clone());
            assert!(tried > 100 && largest > least, "{bounds:?}, {speed} m/s: {largest:e} of {tried}");
        }
    }
}

#[test]
fn results_have_the_same_bits_at_every_level_and_length() {
    let launches = Columns::new(300, 60.0, 5.0);
    for body in bodies() {
        let tosses = launches.tosses(body, Attitude::about_x(0.4));
        let constants = Constants::new(&tosses).unwrap();
        let found = |level: SimdLevel, range: Range<usize>| {
            let mut out = vec![f64::NAN; range.len()];
            level.run(BatchRun { constants: &constants, tosses: tosses.part(range), out: &mut out });
            out.into_iter().map(f64::to_bits).collect::<Vec<_>>()
        };
        let plain = found(SimdLevel::all()[0], 0..300);
        assert!(plain.iter().filter(|height| f64::from_bits(**height) == 0.0).count() < 3, "nearly all are decided");
        for level in SimdLevel::all() {
            for range in [0..300, 0..1, 1..8, 17..34, 3..259, 63..130] {
                assert_eq!(found(level, range.clone()), plain[range.clone()], "{range:?} at {}", level.name());
            }
        }
    }
}

/// A filter for other tosses must not decide these by its own constants.
#[test]
fn counts_are_the_same_by_every_filter() {
    let (columns, bodies) = (Columns::new(600, 60.0, 5.0), bodies());
    let [x, y, z, speeds] = &columns.0;
    let attitudes = [Attitude::IDENTITY, Attitude::about_x(2.0)];
    let all: Vec<Tosses<'_, Body>> = bodies[..2]
        .iter()
        .flat_map(|body| attitudes.map(|attitude| (*body, attitude)))
        .flat_map(|(body, attitude)| [9.81, 5.0].map(|gravity| (body, attitude, gravity)))
        .map(|(body, attitude, gravity)| Tosses::new(body, attitude, gravity, [x, y, z], speeds).unwrap())
        .collect();
    for tosses in &all {
        let batch = Batch::new(*tosses);
        let expected = batch.count().unwrap();
        for other in &all {
            let filter = BodyFilter::new(other);
            assert!(filter.constants_of(tosses).is_some());
            assert_eq!(batch.count_by(&filter).unwrap(), expected);
        }
    }
}

#[test]
fn launches_outside_the_derivation_have_no_bound() {
    let tensor = Body::from_tensor([[2.0, 0.3, -0.2], [0.3, 2.5, 0.1], [-0.2, 0.1, 3.0]]).unwrap();
    let along = |rate: [f64; 3]| <[f64; 3]>::from(tensor.rigid().principal().from_principal(rate));
    let [far, symmetric] = [[1.0, 2.0, 2.25], [1.0, 1.0, 2.0]].map(|moments| Body::from_moments(moments).unwrap());
    let rate = [3.0, -4.0, 5.0];
    for (body, rate, speed, has_bound) in [
        (far, rate, 3.0, true),
        (far, rate, 1e12, true),
        (far, rate, 1e13, false),
        (far, rate, -1.0, false),
        (far, rate.map(|part| part * 1e28), 1e-28, true),
        (far, rate.map(|part| part * 1e31), 1e-31, false),
        (far, rate.map(|part| part * 1e-28), 3.0, true),
        (far, rate.map(|part| part * 1e-32), 3.0, false),
        (far, [1.0, 2.0, (1.0f64 / 0.5625).sqrt() * (1.0 + 1e-6)], 3.0, false),
        (symmetric, [1e-8, 0.0, 1.0], 3.0, true),
        (symmetric, [1e-10, 0.0, 1.0], 3.0, false),
        (tensor, along([1e-6, 1.0, 2.0]), 3.0, true),
        (tensor, along([1.0, 2.0, 1e-8]), 3.0, false),
        (tensor, along([1.0, 1e-8, 2.0]), 3.0, false),
        (tensor, along([1e-8, 1.0, 2.0]), 3.0, false),
    ] {
        let [x, y, z] = rate.map(|part| [part]);
        let speeds = [speed];
        let tosses = Tosses::new(body, Attitude::about_x(0.3), 9.81, [&x, &y, &z], &speeds).unwrap();
        let [_, bound, _] = bounded(&Constants::new(&tosses).unwrap(), tosses)[0];
        assert_eq!(bound.is_finite(), has_bound, "{rate:?} {speed}: {bound:e}");
    }
}

/// Writes the rate along principal axes.
struct Along<'a>(&'a Constants, [f64; 3]);

impl WithSimd for Along<'_> {
    type Output = [f64; 3];

    fn with_simd<S: Simd>(self, simd: S) -> [f64; 3] {
        self.0.along_principal_axes(self.1.map(|part| Real::splat(simd, part))).map(Real::first)
    }
}

#[test]
fn rates_along_turned_axes_have_a_relative_error_of_a_rounding() {
    let body = dynamics::catalogue::named_body("us-quarter-engraved").unwrap();
    let launches = Columns::new(300, 60.0, 5.0);
    let constants = Constants::new(&launches.tosses(body, Attitude::IDENTITY)).unwrap();
    let mut refused = 0;
    for index in 0..300 {
        let near = [[1.0, 1.0, 1.0], [1e-6, 1.0, 1.0], [1.0, 1e-5, 1.0], [1.0, 1.0, 1e-6]][index % 4];
        let rate: [f64; 3] = std::array::from_fn(|axis| near[axis] * launches.0[axis][index]);
        let rate = <[f64; 3]>::from(body.rigid().principal().from_principal(rate));
        let found = SimdLevel::for_one_lane().run(Along(&constants, rate));
        if found[0].is_nan() {
            refused += 1;
            continue;
        }
        for (axis, found) in body.rigid().principal().axes.iter().zip(found) {
            let [x, y, z] = axis;
            let [a, b, c] = rate.map(DoubleDouble::exactly);
            let exact = *x * a + *y * b + *z * c;
            let error = (DoubleDouble::exactly(found) - exact).hi() / exact.hi();
            assert!(error.abs() <= 1.2e-16, "{rate:?}: {found} is off by {error:e}");
        }
    }
    // A component below 1e-7 of the rate.
    assert!((1..30).contains(&refused), "{refused}");
}

#[test]
fn bodies_without_a_filter_are_those_whose_constants_are_unknown() {
    let has_one = |body: Body| Constants::new(&Columns::new(1, 1.0, 1.0).tosses(body, Attitude::IDENTITY)).is_some();
    for moments in [[1.0, 1.0, 1.0], [0.0, 1.0, 1.0]] {
        assert!(!has_one(Body::from_moments(moments).unwrap()), "{moments:?}");
    }
    assert!(!has_one(Body::from_tensor([[3.0, 1.0, 0.0], [1.0, 3.0, 0.0], [0.0, 0.0, 2.0]]).unwrap()));
    assert!(has_one(Body::from_moments([2.0, 2.0, 1.0]).unwrap()));
    // Moments of 25, of 50 turned about the z axis, and of 3 parts in 10^16 more about that.
    let nearly = [[41.0, -12.0, 0.0], [-12.0, 34.0, 0.0], [0.0, 0.0, 50.0 + 2f64.powi(-46)]];
    assert!(!has_one(Body::from_tensor(nearly).unwrap()));
}

/// The condition of a launch, and the bound of the error after so many turns of both phases with this condition.
struct Told<'a>(&'a Constants, [f64; 3], [f64; 3]);

impl WithSimd for Told<'_> {
    type Output = [f64; 2];

    fn with_simd<S: Simd>(self, simd: S) -> [f64; 2] {
        let number = |value: f64| Real::splat(simd, value);
        let start = self.0.start(self.1.map(number), number(1.0));
        let mut begun = self.0.begin([self.1[0], self.1[1], self.1[2], 1.0].map(number));
        [begun[5], begun[6], begun[7]] = self.2.map(number);
        [start.condition.first(), self.0.end(begun).bound.first()]
    }
}

/// E is the difference of α23 m3² and α12 m1². A rounding of it moves cos θ the more, the longer the flight.
#[test]
fn the_bound_of_the_error_grows_with_the_condition_and_the_turns() {
    let body = Body::from_moments([1.0, 2.0, 2.25]).unwrap();
    let launches = Columns::new(1, 1.0, 1.0);
    let constants = Constants::new(&launches.tosses(body, Attitude::IDENTITY)).unwrap();
    let told = |rate, told| SimdLevel::for_one_lane().run(Told(&constants, rate, told));
    for rate in [[0.7, 1.0, 1.0], [0.8, 1.0, -1.0], [3.0, 0.5, 1.0]] {
        // α12 = ½ and α23 = 1/18 in these units, m1 = x and m3 = 2.25 z.
        let [first, third] = [0.5 * rate[0] * rate[0], 2.25 * 2.25 / 18.0 * rate[2] * rate[2]];
        let (condition, expected) = (told(rate, [0.0; 3])[0], (third + first) / (third - first).abs());
        assert!((condition / expected - 1.0).abs() < 1e-13 * expected, "{rate:?}: {condition}, not {expected}");
        let of_condition = |across, precession| {
            let [without, with] = [0.0, 1e9].map(|condition| told(rate, [condition, across, precession])[1]);
            with - without
        };
        let still = of_condition(0.0, 0.0);
        for (across, precession) in [(7.0, 0.0), (-21.0, 0.0), (0.0, 5.0), (14.0, -3.0)] {
            let expected =
                still * (1.0 + f64::abs(across) / 7.0) + 260e9 * numerics::UNIT_ROUNDOFF * f64::abs(precession);
            let found = of_condition(across, precession);
            assert!((found / expected - 1.0).abs() < 1e-9, "{rate:?} {across} {precession}: {found:e}");
        }
        assert!(still > 7.0 * 130e9 * numerics::UNIT_ROUNDOFF, "{still:e}");
    }
}
