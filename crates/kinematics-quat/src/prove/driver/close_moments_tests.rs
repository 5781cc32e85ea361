//! Proofs of flights of bodies with equal and nearly equal moments, against an integration in 200 binary digits in the
//! frame in which the tensor is given. That knows neither principal axes nor an order of moments.

use dynamics::{Body, Launch, Outcome, TimeOfFlight};
use numerics::Big;
use numerics::big::exactly;

use super::tests::{Numbers, solver};
use super::*;

type Vector = [Big; 3];

fn big(value: f64) -> Big {
    exactly(value).with_precision(200).value()
}

fn cross([a, b, c]: &Vector, [d, e, f]: &Vector) -> Vector {
    [b * f - c * e, c * d - a * f, a * e - b * d]
}

fn add<const N: usize>(sum: [Big; N], terms: [Big; N]) -> [Big; N] {
    let mut terms = terms.into_iter();
    sum.map(|part| part + terms.next().unwrap())
}

fn apply(matrix: &[Vector; 3], vector: &Vector) -> Vector {
    matrix.each_ref().map(|[a, b, c]| a * &vector[0] + b * &vector[1] + c * &vector[2])
}

/// P ⊗ (0, ω).
fn product([w, x, y, z]: &[Big; 4], [a, b, c]: &Vector) -> [Big; 4] {
    [-(x * a + y * b + z * c), w * a + y * c - z * b, w * b + z * a - x * c, w * c + x * b - y * a]
}

/// Σ cₖ hᵏ.
fn at<const N: usize>(terms: &[[Big; N]], h: &Big) -> [Big; N] {
    let zero = || [0; N].map(|_| Big::ZERO.with_precision(200).value());
    terms.iter().rev().fold(zero(), |sum, term| add(sum.map(|part| part * h), term.clone()))
}

/// The quaternion at landing: m' = m × J⁻¹ m and Q' = ½ Q ⊗ (0, ω) by Taylor series of order 40, in steps of a radian.
fn reference(toss: &Toss) -> [Big; 4] {
    const ORDER: usize = 40;
    let tensor = toss.body.tensor().map(|row| row.map(big));
    let [x, y, z] = &tensor;
    let cofactors = [cross(y, z), cross(z, x), cross(x, y)];
    let determinant = x.iter().zip(&cofactors[0]).fold(big(0.0), |sum, (a, b)| sum + a * b);
    let inverse = cofactors.map(|row| row.map(|part| part / &determinant));
    let rate = toss.launch.rate();
    let mut momentum = apply(&tensor, &[rate.x, rate.y, rate.z].map(big));
    let mut attitude = toss.launch.attitude().components().map(big);
    let steps = (rate.norm() * toss.launch.flight_time()).ceil();
    let h = big(toss.launch.flight_time()) / big(steps);
    for _ in 0..steps as usize {
        let (mut m, mut q, mut rates) = (vec![momentum], vec![attitude], Vec::new());
        for k in 0..ORDER {
            rates.push(apply(&inverse, &m[k]));
            let mut next = ([big(0.0), big(0.0), big(0.0)], [big(0.0), big(0.0), big(0.0), big(0.0)]);
            for i in 0..=k {
                next = (add(next.0, cross(&m[i], &rates[k - i])), add(next.1, product(&q[i], &rates[k - i])));
            }
            let count = big((k + 1) as f64);
            m.push(next.0.map(|part| part / &count));
            q.push(next.1.map(|part| part / &count / big(2.0)));
        }
        (momentum, attitude) = (at(&m, &h), at(&q, &h));
    }
    attitude
}

/// cos θ of a quaternion of any norm.
fn cos_tilt([w, x, y, z]: &[Big; 4]) -> Big {
    let (upright, inverted) = (w * w + z * z, x * x + y * y);
    (&upright - &inverted) / (upright + inverted)
}

/// Flies `toss`, and compares what is proven with the reference.
fn assert_proven(toss: &Toss) -> IntegratedCertificate {
    let found = solver(1e-10).certify(toss).unwrap_or_else(|error| panic!("{error}: {toss:?}"));
    let exact = reference(toss);
    let cos_tilt = cos_tilt(&exact);
    let off = (exactly(found.cos_tilt()) - &cos_tilt).to_f64().value().abs();
    assert!(off <= found.error_bound() && found.error_bound() < 1e-9, "{off:e}, {found:?}, {toss:?}");
    let expected = if cos_tilt > Big::ZERO { Outcome::Heads } else { Outcome::Tails };
    assert_eq!(found.outcome(), expected, "{found:?}, {toss:?}");
    let norm = exact.iter().fold(big(0.0), |sum, part| sum + part * part).sqrt();
    let parts = found.landing().state.attitude.components();
    let distance = |sign: f64| {
        let off = |(exact, part): (&Big, f64)| (exact / &norm - exactly(sign * part)).to_f64().value();
        exact.iter().zip(parts).map(off).map(|off| off * off).sum::<f64>().sqrt()
    };
    assert!(distance(1.0).min(distance(-1.0)) <= found.attitude_error_bound(), "{found:?}, {toss:?}");
    found
}

fn toss(inertia: [f64; 6], rate: [f64; 3], time: f64, tilt: f64) -> Toss {
    let launch = Launch::new(rate, TimeOfFlight::Given(time)).and_then(|launch| launch.with_tilt(tilt)).unwrap();
    Toss { body: Body::from_inertia(inertia).unwrap(), launch }
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
        let found = assert_proven(&toss(inertia, rate, time, tilt));
        assert!((found.cos_tilt() - cos_tilt).abs() < 1e-12, "{inertia:?}: {found:?}");
    }
}

/// Moments with gaps from 0 to 1e-10, two or three of them, about any axes.
#[test]
fn random_bodies_with_nearly_equal_moments_are_proven() {
    let mut numbers = Numbers(5);
    let mut closed = [0; 2];
    for index in 0..320 {
        let tiny = |numbers: &mut Numbers| {
            let size = 10f64.powf(-numbers.between(10.0, [18.0, 40.0, 100.0, 320.0][index % 4]));
            if numbers.next() < 0.3 { 0.0 } else { numbers.between(-1.0, 1.0) * size }
        };
        let (across, along) = (numbers.between(0.5, 1.0), numbers.between(0.1, 0.9));
        let inertia = match index % 5 {
            // All three, by small elements.
            0 => [across, across, across, tiny(&mut numbers), tiny(&mut numbers), tiny(&mut numbers)],
            1 => [across * (1.0 + tiny(&mut numbers)), across, across, 0.0, tiny(&mut numbers), tiny(&mut numbers)],
            // Two, which may be any two of them.
            2 => [across, across, along, tiny(&mut numbers), tiny(&mut numbers), tiny(&mut numbers)],
            // Turned to any axes, with the gaps that rounding leaves.
            3 => {
                let gap = tiny(&mut numbers);
                let other = if index % 2 == 0 { across } else { 1.9 * along * across };
                turned([across, across * (1.0 + gap), other], &mut numbers)
            }
            // Two equal ones exactly: a multiple of n nᵀ, with n of whole numbers, is added to a sphere.
            _ => {
                let [x, y, z] = [0; 3].map(|_| (numbers.between(-4.0, 4.0)).round());
                let part = 0.0078125 * (1.0 + (2.0 * along).floor());
                let [xx, yy, zz] = [x, y, z].map(|n| 1.0 + part * n * n);
                [xx, yy, zz, part * x * y + tiny(&mut numbers), part * x * z, part * y * z]
            }
        };
        let rate = [0; 3].map(|_| numbers.between(-12.0, 12.0));
        let (time, tilt) = (numbers.between(0.01, 0.8), numbers.between(-3.0, 3.0));
        let body = Body::from_inertia(inertia).unwrap();
        if let Body::Rigid(body) = body {
            closed[usize::from(body.model().off > 0.0)] += 1;
            assert_proven(&toss(inertia, rate, time, tilt));
        }
    }
    assert!(closed.iter().all(|count| *count > 60), "models with their own gaps, and with closed ones: {closed:?}");
}

/// The elements of a tensor with about these moments about random axes.
fn turned(moments: [f64; 3], numbers: &mut Numbers) -> [f64; 6] {
    let parts = [0; 4].map(|_| numbers.between(-1.0, 1.0));
    let turn = Attitude::from_components(parts).unwrap();
    let axes = [0, 1, 2].map(|axis: usize| turn.body_to_lab(&dynamics::Vector3::ith(axis, 1.0)));
    let element = |row: usize, column: usize| (0..3).map(|k| moments[k] * axes[k][row] * axes[k][column]).sum::<f64>();
    [element(0, 0), element(1, 1), element(2, 2), element(0, 1), element(0, 2), element(1, 2)]
}

/// A symmetric body that turns across its axis is slow everywhere on its polhode, so that (22) alone bounds its errors.
#[test]
fn steady_turns_across_the_axis_of_a_symmetric_body_are_proven() {
    let found = assert_proven(&toss([1.5, 1.5, 1.5, -0.2, -0.2, -0.2], [6.0, -6.0, 0.0], 12.0, 0.3));
    assert!(found.error_bound() < 1e-10, "{found:?}");
    let body = Body::from_moments([2.0, 1.0, 1.0]).unwrap();
    let launch = Launch::new([0.0, 6.0, -6.0], TimeOfFlight::Given(12.0)).unwrap();
    assert_proven(&Toss { body, launch });
}
