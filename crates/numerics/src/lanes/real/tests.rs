//! Tests that compare every operation, in every lane and at every SIMD level, with the same operation on f64. Equal
//! bits are required, because results must not depend on the machine.

use super::*;
use crate::lanes::{SimdLevel, WithSimd};

/// Three numbers for each lane of the widest SIMD level.
struct Numbers([[f64; 8]; 3]);

/// For each operation, its name and its result in each lane.
type Found = Vec<(&'static str, Vec<f64>)>;

impl WithSimd for Numbers {
    type Output = Found;

    fn with_simd<S: Simd>(self, simd: S) -> Found {
        let [a, b, c] = self.0.each_ref().map(|numbers| Real::load(simd, numbers));
        let ([product, product_error], [sum, sum_error]) = (a.product(b), a.sum(b));
        let operations = [
            ("a + b", a + b),
            ("a - b", a - b),
            ("a b", a * b),
            ("a / b", a / b),
            ("-a", -a),
            ("√|a|", a.abs().sqrt()),
            ("a b + c", a.mul_add(b, c)),
            ("product", product),
            ("error of the product", product_error),
            ("sum", sum),
            ("error of the sum", sum_error),
            ("a with the sign of b", a.times_sign_of(b)),
            ("1 with either sign", a.constant(1.0).times_sign_of(a.either_sign(b))),
            ("larger", a.max(b)),
            ("smaller", a.min(b)),
            ("cosine", a.clamp_to_cosine()),
            ("round", (a * a.constant(10.0)).round()),
            ("less", a.less_than(b).choose(a, c)),
            ("at most", a.at_most(b).choose(a, c)),
        ];
        let lanes = |value: Real<S>| {
            let mut lanes = vec![f64::NAN; Real::<S>::LANES];
            value.store(&mut lanes);
            lanes
        };
        operations.map(|(name, value)| (name, lanes(value))).to_vec()
    }
}

/// The result of the operation called `name` for one lane, in f64.
fn expected(name: &str, a: f64, b: f64, c: f64) -> f64 {
    match name {
        "a + b" | "sum" => a + b,
        "a - b" => a - b,
        "a b" | "product" => a * b,
        "a / b" => a / b,
        "-a" => -a,
        "√|a|" => a.abs().sqrt(),
        "a b + c" => a.mul_add(b, c),
        "error of the product" => a.mul_add(b, -(a * b)),
        // This formula is exact for |a| ≥ |b|, the next one for |a| < |b|.
        "error of the sum" if a.abs() >= b.abs() => b - ((a + b) - a),
        "error of the sum" => a - ((a + b) - b),
        "a with the sign of b" => a * b.signum(),
        "1 with either sign" if a < 0.0 || b < 0.0 => -1.0,
        "1 with either sign" => 1.0,
        "larger" => a.max(b),
        "smaller" => a.min(b),
        "cosine" => a.clamp(-1.0, 1.0),
        "round" => (10.0 * a).round_ties_even(),
        "less" if a < b => a,
        "at most" if a <= b => a,
        "less" | "at most" => c,
        _ => unreachable!("an operation of the list"),
    }
}

#[test]
fn each_lane_has_the_bits_of_the_same_operation_on_f64() {
    let part = |index: usize, square: f64| 4.0 * ((index + 1) as f64 * square.sqrt()).fract() - 2.0;
    let mut numbers = [2.0, 3.0, 5.0].map(|square| std::array::from_fn(|index| part(index, square)));
    // Two lanes hold equal numbers, to test the comparisons.
    numbers[1][0] = numbers[0][0];
    numbers[1][5] = numbers[0][5];
    for level in SimdLevel::all() {
        for (name, lanes) in level.run(Numbers(numbers)) {
            for (lane, found) in lanes.into_iter().enumerate() {
                let [a, b, c] = numbers.map(|numbers| numbers[lane]);
                assert_eq!(
                    found.to_bits(),
                    expected(name, a, b, c).to_bits(),
                    "{name} in lane {lane} on {}",
                    level.name()
                );
            }
        }
    }
}

/// Numbers of every size, from the smallest to the largest: 0, powers of two and numbers with all digits.
fn sizes() -> Vec<f64> {
    let digits = [1.0, -1.1, 1.0 + f64::EPSILON, 1.9, 1.3];
    let powers = (-1074_i32..=1023)
        .step_by(41)
        .map(|exponent: i32| 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2));
    let ends = [0.0, f64::from_bits(1), f64::MIN_POSITIVE, f64::MAX];
    powers.flat_map(|power| digits.map(|digits| digits * power)).chain(ends).collect()
}

/// The products of a number and many others at a level, and their errors.
struct Products<'a>(f64, &'a [f64]);

impl WithSimd for Products<'_> {
    type Output = Vec<[f64; 2]>;

    fn with_simd<S: Simd>(self, simd: S) -> Vec<[f64; 2]> {
        let splat = |value| Real::splat(simd, value);
        self.1.iter().map(|other| splat(self.0).product(splat(*other)).map(Real::first)).collect()
    }
}

/// Where a product has digits below the range of f64, or a part of it leaves that range, its error is what one rounding leaves.
#[test]
fn products_of_numbers_of_every_size_have_the_same_error_at_every_level() {
    let numbers = sizes();
    for (level, a) in SimdLevel::all().into_iter().flat_map(|level| numbers.iter().map(move |a| (level, *a))) {
        for ([product, error], b) in level.run(Products(a, &numbers)).into_iter().zip(&numbers) {
            let expected = [a * b, a.mul_add(*b, -(a * b))];
            let are_equal = [product, error].map(f64::to_bits) == expected.map(f64::to_bits);
            assert!(
                are_equal || (product.is_infinite() && error.is_nan()),
                "{a:e} × {b:e} on {}: {error:e}",
                level.name()
            );
        }
    }
}

/// Numbers, a bound for them, and a slice to store the first of them in. The output is the number of lanes, the total
/// of the lanes, and whether all are below the bound.
struct Reduced<'a>(&'a [f64; 8], f64, &'a mut [f64]);

impl WithSimd for Reduced<'_> {
    type Output = (usize, f64, bool);

    fn with_simd<S: Simd>(self, simd: S) -> (usize, f64, bool) {
        let value = Real::load(simd, self.0);
        value.store_up_to(self.2);
        (Real::<S>::LANES, value.total(), value.less_than(value.constant(self.1)).everywhere())
    }
}

#[test]
fn lanes_are_added_and_compared_and_fill_no_more_than_the_slice() {
    let numbers = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0];
    for level in SimdLevel::all() {
        for room in 0..=8 {
            let mut stored = vec![f64::NAN; room];
            let (lanes, total, below) = level.run(Reduced(&numbers, 1e3, &mut stored));
            assert_eq!((total, below), (numbers[..lanes].iter().sum(), true), "{}", level.name());
            let filled = room.min(lanes);
            assert_eq!(stored[..filled], numbers[..filled], "{}", level.name());
            assert!(stored[filled..].iter().all(|number| number.is_nan()));
            // The first bound excludes the last lane alone, the second one every lane.
            for bound in [numbers[lanes - 1], 0.5] {
                assert!(!level.run(Reduced(&numbers, bound, &mut [])).2, "{}", level.name());
            }
        }
    }
}
