//! Holds the reference against an integration of the equations of motion.

use dynamics::Body;
use toss::{Launch, Vector3};

use super::super::turn;
use super::*;

/// Integrates Euler's equations and Q' = ½ Q (0, ω) by Taylor series of order 40 in 256 bits.
fn integrated(moments: [f64; 3], rate: [f64; 3], time: f64, steps: u32) -> [Big; 4] {
    const ORDER: usize = 40;
    let i = moments.map(big);
    let couplings = [(&i[1] - &i[2]) / &i[0], (&i[2] - &i[0]) / &i[1], (&i[0] - &i[1]) / &i[2]];
    let step = big(time) / big(f64::from(steps));
    let (mut w, mut q) = (rate.map(big), [1.0, 0.0, 0.0, 0.0].map(big));
    for _ in 0..steps {
        let (mut ws, mut qs) = (vec![w], vec![q]);
        for n in 0..ORDER {
            let sum = |term: &dyn Fn(usize, usize) -> Big| (0..=n).fold(big(0.0), |sum, k| sum + term(k, n - k));
            let next = big((n + 1) as f64);
            ws.push([0, 1, 2].map(|axis: usize| {
                let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
                &couplings[axis] * sum(&|k, l| &ws[k][b] * &ws[l][c]) / &next
            }));
            let half = big(0.5) / &next;
            // The rows of Q (0, ω), with the signs of Hamilton's product.
            let rows: [[(usize, usize, f64); 3]; 4] = [
                [(1, 0, -1.0), (2, 1, -1.0), (3, 2, -1.0)],
                [(0, 0, 1.0), (2, 2, 1.0), (3, 1, -1.0)],
                [(0, 1, 1.0), (1, 2, -1.0), (3, 0, 1.0)],
                [(0, 2, 1.0), (1, 1, 1.0), (2, 0, -1.0)],
            ];
            qs.push(rows.map(|row| {
                row.iter().fold(big(0.0), |all, &(part, axis, sign)| {
                    all + big(sign) * sum(&|k, l| &qs[k][part] * &ws[l][axis])
                }) * &half
            }));
        }
        let at = |coefficients: &[&Big]| coefficients.iter().rev().fold(big(0.0), |sum, part| sum * &step + *part);
        w = [0, 1, 2].map(|axis: usize| at(&ws.iter().map(|part| &part[axis]).collect::<Vec<_>>()));
        q = [0, 1, 2, 3].map(|part: usize| at(&qs.iter().map(|all| &all[part]).collect::<Vec<_>>()));
    }
    q
}

#[test]
fn the_256_bit_motion_is_that_of_an_integration_in_256_bits() {
    for (moments, rate, time, steps) in [
        ([2.0, 3.0, 4.0], [0.5, -1.25, 2.0], 10.0, 60),
        ([2.0, 3.0, 4.0], [2.0, 0.5, -0.75], 5.0, 20),
        ([4.0, 2.0, 3.0], [-2.0, 0.5, -0.75], 5.0, 20),
        ([1.0, 2.0, 2.25], [0.750_749_999_999_999_9, 1.0, 1.0], 10.0, 40),
        ([1.0, 2.0, 2.25], [0.749_25, -1.0, 1.0], 10.0, 40),
        ([1.0, 2.0, 2.25], [0.750_000_007_5, 1.0, 1.0], 10.0, 40),
        ([1.0, 1.000_000_001, 2.0], [-0.7, -0.4, 1.1], 5.0, 20),
        ([1.0, 1.000_001, 1.000_003], [0.3, -0.5, 0.8], 5.0, 20),
        ([2.25, 1.0, 2.0], [1e-9, 1.0, 1e-9], 15.0, 60),
        ([0.01, 1.0, 1.005], [0.3, 1.0, 0.2], 2.0, 20),
    ] {
        let integrated = integrated(moments, rate, time, steps);
        let found = turned(moments, rate, time).unwrap();
        let [_, x, y, z] = turn(&found, &integrated);
        let off = to_f64(&(&x * &x + &y * &y + &z * &z).sqrt());
        assert!(off < 1e-26, "{moments:?} {rate:?}: {off:e}");
    }
}

#[test]
fn what_it_does_not_solve_it_refuses() {
    let solved = |moments: [f64; 3], rate: [f64; 3]| {
        let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(1.0)).unwrap();
        let toss = Toss { body: Body::from_moments(moments).unwrap(), launch };
        assert_eq!(attitude(&toss).is_some(), solves(&toss));
        solves(&toss)
    };
    assert!(solved([1.0, 2.0, 2.5], [0.1, 0.2, 0.3]));
    assert!(!solved([1.0, 2.0, 2.0], [0.1, 0.2, 0.3]) && !solved([1.0, 2.0, 2.5], [0.0, 0.2, 0.0]));
}
