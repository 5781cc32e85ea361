//! The constants of a motion: its frequencies, its phase at launch, and the theta functions or Gaussians that it is
//! made of. The formulas are those of [the module](super).

use numerics::Elementary;
use numerics::elliptic::{
    GaussianPair, ThetaPair, complete_first_and_third, incomplete_and_complete_first, incomplete_first, nome,
};

use super::form::Form;
use super::phases::Phases;
use super::regime::Start;

/// The nome from which on Gaussians have fewer terms than the Fourier series.
const LARGE_NOME: f64 = 0.2;

/// P1, P3 and the α, of one sign each; see [the module](super).
pub(super) struct Combinations<N> {
    pub(super) alpha: [N; 3],
    pub(super) p1: N,
    pub(super) p3: N,
}

impl<N: Elementary> Combinations<N> {
    /// Those of the launch `start` with the angular momentum `m`.
    pub(super) fn new(start: &Start<N>, m: &[N; 3]) -> Self {
        let square = |part: &N| part.clone() * part.clone();
        let [a12, a13, a23] = [start.alpha(0, 1), start.alpha(0, 2), start.alpha(1, 2)];
        let p1 = a12.clone() * square(&m[1]) + a13.clone() * square(&m[2]);
        let p3 = a13.clone() * square(&m[0]) + a23.clone() * square(&m[1]);
        Self { alpha: [a12, a13, a23], p1, p3 }
    }
}

/// Ω/2 and the form of a motion off the separatrix.
pub(super) fn periodic<N: Phases<M>, M: Elementary>(
    start: &Start<N>,
    m: &[N; 3],
    momentum: &N,
    of: &Combinations<N>,
) -> (N, Form<N, M>) {
    let [a12, a13, a23] = &of.alpha;
    let product = |a: &N, b: &N| a.clone() * b.clone();
    let lambda = product(&of.p1, a23).sqrt();
    let lambda = if a13.sign() < 0.0 { -lambda } else { lambda };
    // k² = m = α12 P3/(α23 P1), k'² = |α13 E|/(I2 α23 P1): both without a difference.
    let below = product(a23, &of.p1);
    let complementary = (product(a13, &start.excess).magnitude() / product(&start.moments[1], &below)).sqrt();
    let (k, half_rate) = mean_precession(start, momentum, of, &complementary);
    let frequency = lambda / (k.clone() + k.clone());
    let k = k.part();
    let modulus = (product(a12, &of.p3) / below).part().sqrt();
    let root = |number: &N| number.magnitude().part().sqrt();
    // v has to be right to an ulp of 1, because θ1 begins with e^(-πv/2K). Where c is small, v = K' - c is large, and the
    // digits that c loses as a difference are digits of a small number.
    let [v, k_prime] = incomplete_and_complete_first(&root(&of.p1), &root(&of.p3), modulus);
    let c = k_prime.clone() - v.clone();
    let [sin, cos] = [m[1].part() * root(a23), m[0].part() * root(a13)];
    let launch = launch_phase(&sin, &cos, &complementary.part(), &k) / (k.clone() + k.clone());
    let launch = N::of_part(launch);
    if nome(k.clone(), k_prime.clone()).to_f64() <= LARGE_NOME {
        (half_rate, Form::Series { pair: ThetaPair::new(&k, &c, &v), frequency, launch })
    } else {
        let turn = k.pi() * c.clone() / (k_prime.clone() + k_prime.clone());
        (half_rate, Form::Gaussian { pair: GaussianPair::new([&k, &k_prime], &c), turn, frequency, launch })
    }
}

/// K, and half of Ω, the mean rate at which the body turns about the angular momentum. Each part of a sum has the sign
/// of the sum.
fn mean_precession<N: Elementary>(start: &Start<N>, momentum: &N, of: &Combinations<N>, complementary: &N) -> (N, N) {
    let [first, _, third] = &start.moments;
    let [_, a13, _] = &of.alpha;
    let parameter = a13.clone() * momentum.clone() * momentum.clone() / of.p1.clone();
    let (steady, weights, share) = if a13.sign() > 0.0 {
        (third, [0.0, 1.0], of.p3.clone() / of.p1.clone())
    } else {
        (first, [1.0, 1.0], a13.like(-1.0))
    };
    let [k, integral] = complete_first_and_third(complementary.clone(), &parameter, weights);
    let rate = momentum.clone() * (a13.like(1.0) / steady.clone() + a13.clone() * share * integral / k.clone());
    (k, rate.halved())
}

/// u0 with sn u0 : cn u0 = `sin` : `cos`, from F of the smaller one of two amplitudes.
fn launch_phase<N: Elementary>(sin: &N, cos: &N, complementary: &N, k: &N) -> N {
    let scaled = complementary.clone() * sin.magnitude();
    // The smaller one of u0 and K - u0 has all its digits: at K/2 the tangent is 1/√k'.
    if (complementary.sqrt() * sin.magnitude() - cos.magnitude()).sign() <= 0.0 {
        let phase = incomplete_first(sin, &cos.magnitude(), complementary.clone());
        return if cos.sign() < 0.0 { k.clone() + k.clone() - phase } else { phase };
    }
    let phase = k.clone() - incomplete_first(cos, &scaled, complementary.clone());
    if sin.sign() < 0.0 { -phase } else { phase }
}

/// Ω/2 and the form of a motion on the separatrix.
pub(super) fn separatrix<N: Phases<M>, M: Elementary>(
    start: &Start<N>,
    m: &[N; 3],
    momentum: &N,
    of: &Combinations<N>,
) -> (N, Form<N, M>) {
    let [a12, _, a23] = &of.alpha;
    let rate = momentum.clone() * (a12.clone() * a23.clone()).sqrt();
    let size = norm(&[a12.sqrt(), a23.sqrt(), rate.like(0.0)]);
    let angle = [a12.sqrt() / size.clone(), a23.sqrt() / size];
    // e^u0 with sinh u0 = m2/√(m1² + m3²), without a difference.
    let across = norm(&[m[0].clone(), m[2].clone(), rate.like(0.0)]);
    let launch = if m[1].sign() >= 0.0 {
        (m[1].clone() + momentum.clone()) / across
    } else {
        across / (momentum.clone() - m[1].clone())
    };
    (
        (momentum.clone() / start.moments[1].clone()).halved(),
        Form::Separatrix { rate, launch: launch.part(), angle: angle.each_ref().map(N::part) },
    )
}

/// The length of a vector.
pub(super) fn norm<N: Elementary>(vector: &[N; 3]) -> N {
    let [x, y, z] = vector.clone().map(|part| part.clone() * part);
    (x + y + z).sqrt()
}

#[cfg(test)]
mod tests {
    use dynamics::Body;
    use numerics::{Ball, DoubleDouble};

    use super::*;
    use crate::rigid::regime::Regime;

    /// Of a body that is a million times as slender as it is long, the other one of the two sums would lose twenty binary
    /// digits of the mean rate, and so would its error bound.
    #[test]
    fn the_mean_rate_of_a_slender_body_keeps_its_digits_in_both_regimes() {
        let body = Body::from_moments([1e-6, 1.0, 1.000_000_5]).unwrap();
        for rate in [[1.0, 1e-9, 1e-7], [1.0, 0.3, 1.0], [0.3, 0.3, 1.0]] {
            let rate = rate.map(|part| Ball::new(DoubleDouble::exactly(part), 0.0));
            let start = Start::new(&body, &rate).unwrap();
            let m: [_; 3] = [0, 1, 2].map(|axis: usize| start.moments[axis] * start.rate[axis]);
            let (half_rate, _) =
                periodic::<_, Ball<DoubleDouble>>(&start, &m, &norm(&m), &Combinations::new(&start, &m));
            let lost = half_rate.radius() / half_rate.to_f64().abs();
            assert!(lost < 2f64.powi(-88), "{:?}: {lost:e}", start.regime);
            let x = rate[0].to_f64();
            assert_eq!(start.regime, if x < 0.5 { Regime::AroundLargest } else { Regime::AroundSmallest });
        }
    }

    /// Without a modulus, u0 is the polar angle. F of the amplitude itself has lost digits only where K is close.
    #[test]
    fn the_phase_at_launch_has_the_sine_and_cosine_and_all_its_digits_in_each_quadrant() {
        let number = |value: f64| Ball::new(DoubleDouble::exactly(value), 0.0);
        let ratios = [(1e-20, 1.0), (1e-20, 1e-10), (1e-3, 1e-4), (0.3, 0.8), (0.8, 0.3), (1.0, 1e-20), (1e-10, 1e-20)];
        for ((sin, cos), complementary) in ratios.into_iter().flat_map(|ratio| [1.0, 0.5, 1e-3].map(|k| (ratio, k))) {
            let [k, amplitude] =
                [(1.0, 0.0), (sin, cos)].map(|(s, c)| incomplete_first(&number(s), &number(c), number(complementary)));
            for (sin, cos) in [(sin, cos), (sin, -cos), (-sin, cos), (-sin, -cos)] {
                let found = launch_phase(&number(sin), &number(cos), &number(complementary), &k);
                let is_right = |expected: Ball<DoubleDouble>| {
                    let off = (found - expected).to_f64().abs();
                    off <= found.radius() + expected.radius() && found.radius() < 2f64.powi(-80) * found.to_f64().abs()
                };
                let half = if cos < 0.0 { k + k - amplitude } else { amplitude };
                let expected = if sin < 0.0 { -half } else { half };
                let turn = (k + k) + (k + k);
                assert!(is_right(expected) || is_right(expected + turn), "{sin} {cos} {complementary}: {found:?}");
                if complementary == 1.0 {
                    let angle = number(sin).atan2(&number(cos));
                    assert!(is_right(angle) || is_right(angle + turn), "{sin} {cos}: {found:?}");
                }
            }
        }
    }

    /// Next to the spin about the middle axis, one of two forms of the phase at launch has no difference.
    #[test]
    fn a_launch_on_the_separatrix_keeps_its_digits_either_way_about_the_middle_axis() {
        let body = Body::from_moments([1.0, 2.5, 3.0]).unwrap();
        for middle in [1.0, 1e-9, -1e-9, -1.0] {
            let rate = [1e-9, middle, 1e-9].map(|part| Ball::new(DoubleDouble::exactly(part), 0.0));
            let start = Start::new(&body, &rate).unwrap();
            let m: [_; 3] = [0, 1, 2].map(|axis: usize| start.moments[axis] * start.rate[axis]);
            let (_, form) = separatrix::<_, Ball<DoubleDouble>>(&start, &m, &norm(&m), &Combinations::new(&start, &m));
            let Form::Separatrix { launch, .. } = form else { panic!("{middle}: {:?}", start.regime) };
            let lost = launch.radius() / launch.to_f64().abs();
            assert!(lost < 2f64.powi(-90), "{middle}: {lost:e}");
        }
    }
}
