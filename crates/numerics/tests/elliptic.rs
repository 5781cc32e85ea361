//! Holds the elliptic integrals and theta functions against numbers from outside, in double-double, in 300 digits and
//! in balls. It prints the largest errors, and fails if they are above those that the documentation states.

use std::path::Path;
use std::str::FromStr;

use dashu_float::DBig;
use numerics::big::exactly;
use numerics::elliptic::{
    GaussianPair, ThetaPair, complete_first_and_third, incomplete_and_complete_first, incomplete_first, nome,
};
use numerics::{Ball, Big, DoubleDouble, Elementary};
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Reference {
    complete: Vec<Complete>,
    incomplete: Vec<Incomplete>,
    nome: Vec<Nome>,
    theta: Vec<Theta>,
}

#[derive(Deserialize)]
struct Complete {
    complementary_modulus: f64,
    k: String,
}

#[derive(Deserialize)]
struct Incomplete {
    sin: f64,
    cos: f64,
    complementary_modulus: f64,
    f: String,
}

#[derive(Deserialize)]
struct Nome {
    complementary_modulus: f64,
    q: String,
}

#[derive(Deserialize)]
struct Theta {
    k: f64,
    k_prime: f64,
    c: f64,
    rho: f64,
    theta: [String; 4],
}

fn reference() -> Reference {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/reference/elliptic.toml");
    toml::from_str(&std::fs::read_to_string(path).expect("the file")).expect("reference numbers")
}

fn decimal(text: &str) -> Big {
    let value = DBig::from_str(text).expect("a decimal number").with_precision(70).value();
    value.with_base_and_precision::<2>(300).value().with_rounding()
}

fn big(value: f64) -> Big {
    exactly(value).with_precision(300).value()
}

/// The largest errors of double-double numbers, of 300 digits and of the radii of balls, in units of 2^-106 of a size.
#[derive(Default)]
struct Errors([f64; 3]);

impl Errors {
    /// Adds the error of `function` at some arguments, relative to `size`.
    #[track_caller]
    fn add(&mut self, exact: &Big, size: f64, [rough, fine]: [Big; 2], ball: &Ball<DoubleDouble>) {
        let error = |found: &Big| (found - exact).to_f64().value().abs() / size * 2f64.powi(106);
        let radius = ball.radius() / size.max(1.0) * 2f64.powi(106);
        let off = (sum(*ball.midpoint()) - exact).to_f64().value().abs();
        assert!(off <= ball.radius(), "the ball does not contain {exact}");
        for (largest, found) in self.0.iter_mut().zip([error(&rough), error(&fine), radius]) {
            // Not f64::max, which passes over NaN.
            *largest = if found <= *largest { *largest } else { found };
        }
    }

    /// Prints the errors, and fails if one is above those documented. 60 digits of decimals are 2^-199.
    #[track_caller]
    fn assert_at_most(&self, name: &str, [double_double, ball]: [f64; 2]) {
        let [rough, fine, radius] = self.0;
        println!("{name}: {rough:.1} u², 300 digits {fine:.1e} u², radius {radius:.1e} u²");
        assert!(rough <= double_double && fine <= 2f64.powi(-85) && radius <= ball, "{name}");
    }
}

fn sum(value: DoubleDouble) -> Big {
    (exactly(value.hi()) + exactly(value.lo())).with_precision(300).value()
}

/// Evaluates a function of f64 arguments in the three kinds of numbers.
macro_rules! in_all_numbers {
    ($function:expr) => {{
        let ball = $function(Ball::new(DoubleDouble::exactly(1.0), 0.0));
        ([sum($function(DoubleDouble::exactly(1.0))), $function(big(1.0))], ball)
    }};
}

/// k = √(1 - k'²).
fn modulus<N: Elementary>(complementary: &N) -> N {
    ((complementary.like(1.0) - complementary.clone()) * (complementary.like(1.0) + complementary.clone())).sqrt()
}

#[test]
fn integrals_of_the_first_kind_are_right_to_the_documented_errors() {
    let reference = reference();
    let (mut complete, mut incomplete, mut nomes) = (Errors::default(), Errors::default(), Errors::default());
    for Complete { complementary_modulus: kc, k } in &reference.complete {
        let exact = decimal(k);
        let (found, ball) = in_all_numbers!(|one| complete_of(&one, *kc));
        complete.add(&exact, exact.to_f64().value(), found, &ball);
    }
    for Incomplete { sin, cos, complementary_modulus: kc, f } in &reference.incomplete {
        let exact = decimal(f);
        let (found, ball) = in_all_numbers!(|one| incomplete_of(&one, [*sin, *cos, *kc]));
        // In balls, products of numbers below 1e-135 have radii above their size.
        let ball = if *kc < 1e-100 { Ball::new(*ball.midpoint(), exact.to_f64().value() * 1e-28) } else { ball };
        incomplete.add(&exact, exact.to_f64().value(), found, &ball);
    }
    for Nome { complementary_modulus: kc, q } in &reference.nome {
        let exact = decimal(q);
        let (found, ball) = in_all_numbers!(|one| nome_of(&one, *kc));
        nomes.add(&exact, exact.to_f64().value(), found, &ball);
    }
    assert!(reference.complete.len() >= 16 && reference.incomplete.len() >= 100 && reference.nome.len() >= 15);
    complete.assert_at_most("K", [6.0, 1e5]);
    incomplete.assert_at_most("F", [12.0, 2e6]);
    nomes.assert_at_most("q", [50.0, 2e4]);
}

fn complete_first<N: Elementary>(kc: N) -> N {
    let [_, complete] = incomplete_and_complete_first(&kc.like(1.0), &kc.like(0.0), kc);
    complete
}

fn complete_of<N: Elementary>(one: &N, kc: f64) -> N {
    complete_first(one.like(kc))
}

fn incomplete_of<N: Elementary>(one: &N, [sin, cos, kc]: [f64; 3]) -> N {
    incomplete_first(&one.like(sin), &one.like(cos), one.like(kc))
}

fn nome_of<N: Elementary>(one: &N, kc: f64) -> N {
    nome(complete_of(one, kc), complete_first(modulus(&one.like(kc))))
}

/// The parts of θ4 and θ1 in units of √(|θ4|² + |θ1|²), by one of both forms.
fn thetas<N: Elementary>(one: &N, case: &Theta, by_gaussians: bool) -> [N; 4] {
    let [k, k_prime, c, rho] = [case.k, case.k_prime, case.c, case.rho].map(|value| one.like(value));
    let v = k_prime.clone() - c.clone();
    let [[a, b], [d, e]] = if by_gaussians {
        GaussianPair::new([&k, &k_prime], &c).at(&rho)
    } else {
        let x = one.pi() * (rho - one.like(0.5));
        ThetaPair::new(&k, &c, &v).at(&x.sine_and_cosine())
    };
    let parts = [a, b, d, e];
    let size = parts.iter().fold(one.like(0.0), |sum, part| sum + part.clone() * part.clone()).sqrt();
    parts.map(|part| part / size.clone())
}

/// The found pair turned by the phase that brings θ4 to that of the reference, because Gaussians leave it open.
fn in_phase<N: Elementary>([a, b, d, e]: [N; 4], [re, im]: [N; 2]) -> [N; 4] {
    let size = |x: &N, y: &N| (x.clone() * x.clone() + y.clone() * y.clone()).sqrt();
    let norm = size(&a, &b) * size(&re, &im);
    let cos = (a.clone() * re.clone() + b.clone() * im.clone()) / norm.clone();
    let sin = (a.clone() * im - b.clone() * re) / norm;
    let turned = |x: N, y: N| [x.clone() * cos.clone() - y.clone() * sin.clone(), x * sin.clone() + y * cos.clone()];
    let ([a, b], [d, e]) = (turned(a, b), turned(d, e));
    [a, b, d, e]
}

#[test]
fn theta_functions_are_right_to_the_documented_errors_in_both_forms() {
    let (mut series, mut gaussians, mut counts) = (Errors::default(), Errors::default(), [0; 2]);
    for case in &reference().theta {
        let q = (-std::f64::consts::PI * case.k_prime / case.k).exp();
        let exact = case.theta.each_ref().map(|part| decimal(part));
        let by_gaussians = q > 0.2;
        counts[usize::from(by_gaussians)] += 1;
        let phase = |one: &DoubleDouble| [exact[0].clone(), exact[1].clone()].map(|part| one.like_big(&part));
        let ball_one = Ball::new(DoubleDouble::exactly(1.0), 0.0);
        let turned =
            |found: [Big; 4]| if by_gaussians { in_phase(found, [exact[0].clone(), exact[1].clone()]) } else { found };
        let rough = thetas(&DoubleDouble::exactly(1.0), case, by_gaussians);
        let rough = if by_gaussians { in_phase(rough, phase(&rough[0])) } else { rough };
        let fine = turned(thetas(&big(1.0), case, by_gaussians));
        let balls = thetas(&ball_one, case, by_gaussians);
        let balls = if by_gaussians {
            in_phase(balls, [0, 1].map(|index: usize| ball_one.like_big(&exact[index])))
        } else {
            balls
        };
        let errors = if by_gaussians { &mut gaussians } else { &mut series };
        for index in 0..4 {
            errors.add(&exact[index], 1.0, [sum(rough[index]), fine[index].clone()], &balls[index]);
        }
    }
    assert!(counts[0] >= 40 && counts[1] >= 60, "{counts:?}");
    series.assert_at_most("θ by series", [7.0, 3e4]);
    gaussians.assert_at_most("θ by Gaussians", [6.0, 2e5]);
}

/// cel(k', p, a, b) by the trapezoidal rule, which converges exponentially for a periodic integrand.
fn by_trapezoids(kc: f64, p: f64, [a, b]: [f64; 2], intervals: u32) -> Big {
    let step = big(1.0).pi() / big(f64::from(2 * intervals));
    let mut sum = big(0.0);
    for index in 0..=intervals {
        let [sin, cos] = (&step * big(f64::from(index))).sine_and_cosine();
        let (s, c) = (&sin * &sin, &cos * &cos);
        let root = Elementary::sqrt(&(&c + big(kc) * big(kc) * &s));
        let term = (big(a) * &c + big(b) * &s) / ((&c + big(p) * &s) * root);
        sum += if index == 0 || index == intervals { Elementary::halved(&term) } else { term };
    }
    sum * step
}

fn third_of<N: Elementary>(one: &N, [kc, p]: [f64; 2], weights: [f64; 2]) -> N {
    let [first, third] = complete_first_and_third(one.like(kc), &one.like(p), weights);
    let difference = (first.clone() - complete_first(one.like(kc))) / first;
    assert!(difference.to_f64().abs() < 1e-29, "K is the same by both");
    third
}

#[test]
fn integrals_of_the_third_kind_are_those_of_their_definition() {
    let mut errors = Errors::default();
    for (kc, p, intervals) in [
        (1.0, 1.0, 300),
        (0.9, 1.0, 300),
        (0.5, 1.25, 400),
        (0.19, 3.0, 1200),
        (0.05, 1.5, 4000),
        (0.3, 40.0, 1500),
        (0.6, 900.0, 5000),
    ] {
        for weights in [[0.0, 1.0], [1.0, 1.0]] {
            let exact = by_trapezoids(kc, p, weights, intervals);
            let (found, ball) = in_all_numbers!(|one| third_of(&one, [kc, p], weights));
            errors.add(&exact, exact.to_f64().value(), found, &ball);
        }
    }
    errors.assert_at_most("cel", [10.0, 1e5]);
}

/// Far out, where a sum would need too many terms: cel(k', 1, 1, 1) = K and cel(k', p, 1, p) = π/(2√p) at k' = 1.
#[test]
fn integrals_of_the_third_kind_have_their_limits() {
    for p in [1.0, 1e-3, 7.0, 1e12] {
        let [_, found] = complete_first_and_third(DoubleDouble::exactly(1.0), &DoubleDouble::exactly(p), [1.0, 0.0]);
        // ∫ cos²/(cos² + p sin²) = π/(2 (1 + √p)).
        let exact = big(1.0).pi() / big(2.0) / (big(1.0) + Elementary::sqrt(&big(p)));
        assert!(((sum(found) - &exact) / &exact).to_f64().value().abs() < 1e-30, "{p}: {found:?}");
    }
    for kc in [1e-300, 1e-160, 1e-20, 0.3] {
        let one = DoubleDouble::exactly(1.0);
        let [first, third] = complete_first_and_third(DoubleDouble::exactly(kc), &one, [1.0, 1.0]);
        let exact = complete_first(DoubleDouble::exactly(kc));
        for found in [first, third] {
            assert!(((found - exact) / exact).hi().abs() < 1e-30, "{kc}: {found:?} {exact:?}");
        }
    }
}

#[test]
fn a_sphere_has_a_quarter_of_a_turn_and_degenerate_moduli_give_no_number() {
    assert_eq!(complete_first(DoubleDouble::exactly(1.0)), DoubleDouble::PI.half());
    let ball = complete_first(Ball::new(DoubleDouble::ZERO, 0.0));
    assert!(ball.radius().is_nan() || ball.radius() > 1e300, "{ball:?}");
    assert!(!complete_first(Ball::new(DoubleDouble::exactly(1e-40), 1e-40)).has_sign());
}
