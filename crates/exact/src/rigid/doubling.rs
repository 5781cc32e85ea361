//! The turn of a free rigid body between launch and landing, in the frame in which its inertia tensor is given: by
//! doubling a point of an elliptic curve. No formula divides by a difference of two moments, looks for a principal axis,
//! or has a case for equal moments, for a spin about an axis or for the separatrix. The only functions are a root, and
//! the sine and the cosine of a small angle.
//!
//! Let J be the inertia tensor, ω the rate at launch, m = Jω, G = |m| and 2T = ω·m. Products, cofactors ("cof") and
//! differences of functions of J are those of their eigenvalues, of which Iᵢ are those of J; they are computed from the
//! matrices. With
//!
//! ```text
//! B = 2T J - G²
//! E = ((Iⱼ - Iᵢ) Bₖ + (Iₖ - Iᵢ) Bⱼ)/(3 det J)       eᵢ - eⱼ = Bₖ (Iⱼ - Iᵢ)/det J, tr E = 0
//! K = E² - cof B (Iᵢ - Iⱼ)(Iᵢ - Iₖ)/det² J         eᵢ² - (eᵢ - eⱼ)(eᵢ - eₖ)
//! a = -tr E²/2,  b = -det E                        y² = x³ + a x + b has the roots eᵢ
//! x₀ = -ω·J (Iᵢ - Iⱼ)(Iᵢ - Iₖ) ω/(3 det J)
//! xₐ = -tr(J cof B)/(3 G² det J),  κ = det B/(G³ det J)
//! ```
//!
//! the squares of the components of the rate are, but for constants, ℘ - eᵢ, where ℘ is Weierstrass' function of that
//! curve. With τ half the time of flight, t = 1/℘ and q = -℘'/(2 ℘²) at τ/2, s = 2q, S = 1 - 2tE + K t² and
//! D = 1 - 2a t² - 8b t³ + a² t⁴, the rate ω_c at τ and the turn Q from launch to landing are
//!
//! ```text
//! ω_c = (cof S ω + s S J⁻¹(m × ω))/(D - x₀ s²)
//! Q = (G² Re n, -(G Im n J cof S + s Re n B S) ω_c/(D - xₐ s²))               of any norm
//! ```
//!
//! where n is e^(cτ) σ(τ + α)/σ(α) of any size, with ℘(α) = xₐ and ℘'(α) = -2iκ. A short series gives t, q and n after
//! a small part of τ, and each doubling of the time is
//!
//! ```text
//! t → 4t (1 + a t² + b t³)/D
//! q → 2q (1 + 5a t² + 20b t³ - 5a² t⁴ - 4ab t⁵ - (8b² + a³) t⁶)/D²
//! n → n² (1 - 3xₐ t - a t² - (a xₐ + 2b) t³ + 2iκ t q)
//! ```
//!
//! # Near the separatrix
//! Two roots are nearly equal there, ℘ comes near both, and each half-period would take digits of its difference from them. Of a body that is
//! given by its moments the differences of the roots are known to all digits, and the curve is taken in X = ℘ - e, with the largest root e: then x₀, xₐ and E
//! are those less e, t = 1/X, q = -X'/(2X²), K has the eigenvalues eᵢ (eⱼ + eₖ) - eⱼ eₖ of these, and with A = -tr E and B, the product of the other two roots,
//!
//! ```text
//! D = (1 - B t²)²,   t → 4t (1 + A t + B t²)/D
//! q → 2q (1 + 2A t + 6B t² + 2AB t³ + B² t⁴)/(1 - B t²)³
//! n → n² (1 - 3xₐ t - (2A xₐ + B) t² - B xₐ t³ + 2iκ t q)
//! ```
//!
//! As the other roots and xₐ are not above 0, nothing cancels but where 2τ is near a half-period.
//!
//! The derivation is in `docs/proofs/motion.md`. It takes that J has an inverse and that m is not 0.

use numerics::Elementary;
use numerics::scale::mantissa_and_exponent;

use super::quaternion::Quaternion;
use super::tensor::{Symmetric, cross, dot};

/// Binary digits by which each term of a series is smaller than the one before it: so many, and so many times the root of
/// the digits of a number. More digits in a term take more doublings and fewer terms.
const FALL: (f64, f64) = (2.0, 0.5);

/// The curve of a launch. Symbols are those of the [module](self).
#[derive(Debug, Clone)]
pub(super) struct Curve<N> {
    tensor: Symmetric<N>,
    rate: [N; 3],
    /// J⁻¹(m × ω).
    acceleration: [N; 3],
    /// G² and G.
    squared: N,
    size: N,
    twice_energy: N,
    /// 1/det J.
    by_determinant: N,
    /// B, E - e and K.
    excess: Symmetric<N>,
    roots: Symmetric<N>,
    products: Symmetric<N>,
    a: N,
    b: N,
    /// The root e, if it is not 0.
    root: Option<Root<N>>,
    /// x₀ - e, xₐ - e and κ.
    at_launch: N,
    pole: N,
    kappa: N,
}

/// The largest root e, and A and B of the cubic X³ + A X² + B X of the others less e.
#[derive(Debug, Clone)]
struct Root<N> {
    value: N,
    linear: N,
    square: N,
}

/// t and q.
struct Point<N> {
    t: N,
    q: N,
}

/// What a doubling takes of t: D, the factor of 4t over D, that of 2q as a fraction, and the real factor of n².
struct Terms<N> {
    below: N,
    cubic: N,
    slope: [N; 2],
    real: N,
}

fn times<N: Elementary>(a: &N, b: &N) -> N {
    a.clone() * b.clone()
}

fn square<N: Elementary>(a: &N) -> N {
    times(a, a)
}

fn twice<N: Elementary>(a: &N) -> N {
    a.clone() + a.clone()
}

fn multiple<N: Elementary>(factor: f64, a: &N) -> N {
    a.like(factor) * a.clone()
}

/// A number, or a series all of whose coefficients are, within 2^`exponent` of 0.
fn within_power_of_two<N: Elementary>(like: &N, exponent: i32) -> N {
    like.like(0.0).widened_throughout(1.0).times_power_of_two(exponent)
}

/// An exponent of two above the bound of a number; one that leaves no digits if that is beyond f64 or unknown.
fn exponent_above<N: Elementary>(number: &N) -> i32 {
    let most = number.bound().max(f64::MIN_POSITIVE);
    if most.is_finite() && !number.bound().is_nan() { mantissa_and_exponent(most).1 + 1 } else { 1 << 20 }
}

impl<N: Elementary> Curve<N> {
    /// The curve of a body with the inertia `tensor` at the `rate` (BF).
    pub(super) fn new(tensor: Symmetric<N>, rate: [N; 3]) -> Self {
        let momentum = tensor.apply(&rate);
        let [squared, twice_energy] = [dot(&momentum, &momentum), dot(&momentum, &rate)];
        let size = squared.sqrt();
        let cofactors = tensor.cofactors();
        let by_determinant = size.like(1.0) / tensor.determinant(&cofactors);
        let third = by_determinant.clone() / size.like(3.0);
        let (excess, gaps) = (tensor.excess(&rate), tensor.gaps());
        let cofactors_of_excess = excess.cofactors();
        let roots = tensor.differences(&excess).scaled(&third);
        let products = roots.times(&roots).minus(&cofactors_of_excess.times(&gaps).scaled(&square(&by_determinant)));
        let cofactors_of_roots = roots.cofactors();
        let a = cofactors_of_roots.trace();
        let b = -roots.determinant(&cofactors_of_roots);
        let at_launch = -(dot(&rate, &tensor.times(&gaps).apply(&rate)) * third.clone());
        let pole = -(tensor.times(&cofactors_of_excess).trace() * third / squared.clone());
        let kappa = excess.determinant(&cofactors_of_excess) * by_determinant.clone() / times(&squared, &size);
        let acceleration = cofactors.scaled(&by_determinant).apply(&cross(&momentum, &rate));
        Self {
            tensor,
            rate,
            acceleration,
            squared,
            size,
            twice_energy,
            by_determinant,
            excess,
            roots,
            products,
            a,
            b,
            root: None,
            at_launch,
            pole,
            kappa,
        }
    }

    /// The same curve by coordinates less the largest root, of a body that was given by its moments. No difference loses digits then, but for B near
    /// the separatrix.
    pub(super) fn less_largest_root(self) -> Self {
        if !self.tensor.is_diagonal() {
            return self;
        }
        let [moments, roots, excess] = [&self.tensor, &self.roots, &self.excess].map(Symmetric::on_diagonal);
        let above = |a: usize, b: usize| if roots[b].to_f64() > roots[a].to_f64() { b } else { a };
        let largest = above(above(0, 1), 2);
        let less = |i: usize| match i == largest {
            true => moments[i].like(0.0),
            false => times(&excess[3 - i - largest], &(moments[largest].clone() - moments[i].clone())),
        };
        let others = Symmetric::diagonal([0, 1, 2].map(|i| less(i) * self.by_determinant.clone()));
        let square_term = others.cofactors().on_diagonal()[largest].clone();
        let sign = |i: usize| if i == largest { -square_term.clone() } else { square_term.clone() };
        let products = Symmetric::diagonal([0, 1, 2].map(sign));
        let along =
            |of: &Symmetric<N>| times(&of.on_diagonal()[largest], &moments[largest]) * self.by_determinant.clone();
        let at_launch = -(along(&self.tensor.gaps()) * square(&self.rate[largest]));
        let pole = -(along(&self.excess.cofactors()) / self.squared.clone());
        let root = Root { value: roots[largest].clone(), linear: -others.trace(), square: square_term };
        Self { roots: others, products, root: Some(root), at_launch, pole, ..self }
    }

    /// The turn after `time`, of any norm; `None` if the numbers have too few digits for it.
    pub(super) fn turn(&self, time: &N) -> Option<Quaternion<N>> {
        let (point, n) = self.half_way(time)?;
        Some(self.assembled(&point, &n))
    }

    /// The turn after `time` of a launch that is exactly on the separatrix, det B = 0, and does not spin about an axis. The
    /// curve then has the roots e, e and -2e with e > 0, ℘ = e + 3e/sinh²(λτ), λ² = 3e, xₐ = e and κ = 0, so that no
    /// digit is lost with the length of the flight.
    pub(super) fn turn_on_separatrix(&self, time: &N) -> Quaternion<N> {
        let (tau, one) = (time.halved(), time.like(1.0));
        let e = -(multiple(1.5, &self.b) / self.a.clone());
        let lambda = multiple(3.0, &e).sqrt();
        let falling = (-times(&lambda, &tau)).exp();
        let square_falling = square(&falling);
        let below = one.clone() + square_falling.clone();
        let (sech, tanh) = (twice(&falling) / below.clone(), (one.clone() - square_falling) / below);
        let (s, sech2) = (tanh.clone() / lambda, square(&sech));
        let size = square(&tanh) / one.like(3.0) + sech2.clone() - times(&self.at_launch, &square(&s));
        // The function of J that is 1 for the middle moment and 0 for the others.
        let middle = self.roots.less(&e).scaled(&-(one / multiple(3.0, &e)));
        let combined =
            |weight: &N| std::array::from_fn(|i| times(&self.rate[i], weight) + times(&self.acceleration[i], &s));
        let all: [N; 3] = combined(&s.like(1.0));
        let along = middle.apply(&all);
        let outer = std::array::from_fn(|i| all[i].clone() - along[i].clone());
        let inner = middle.apply(&combined(&sech2));
        let [sin, cos] = (self.twice_energy.clone() * tau / self.size.clone()).sine_and_cosine();
        let turned = self.tensor.scaled(&-times(&self.size, &sin));
        let [x, y, z] = turned.plus(&self.excess.scaled(&times(&cos, &s))).apply(&outer);
        let [u, v, w] = turned.apply(&inner);
        [times(&self.squared, &cos) * size, -(x + u), -(y + v), -(z + w)]
    }

    /// t and q at a quarter of the `time`, and n at half of it.
    fn half_way(&self, time: &N) -> Option<(Point<N>, [N; 2])> {
        let (digits, tau) = (f64::from(time.digits()), time.halved());
        let fall = (FALL.0 + digits.sqrt() * FALL.1).round();
        // Both series have terms below those of 1/(1 - r h)² with the step h, if r to a power is above each of these times
        // a power of two.
        let pole = self.with_root(&self.pole);
        let second = multiple(3.0, &square(&pole)) + self.a.clone();
        let powers = [(&self.a, 4, -3), (&self.b, 6, -4), (&pole, 2, 0), (&self.kappa, 3, 0), (&second, 4, -1)];
        let exponent =
            |(number, power, scale): (&N, i32, i32)| f64::from(exponent_above(number) + scale) / f64::from(power);
        let growth = powers.into_iter().map(exponent).fold(f64::NEG_INFINITY, f64::max);
        let doublings = (f64::from(exponent_above(&tau)) + growth + fall).ceil().max(1.0);
        // Each doubling takes two digits, so that none would be left.
        if doublings > digits {
            return None;
        }
        let (doublings, terms, fall) = (doublings as i32, (digits / fall).ceil() as usize + 2, -(fall as i32));
        let (mut point, mut n) = self.begun(&tau.times_power_of_two(-doublings), terms, fall);
        for left in (0..doublings).rev() {
            let terms = self.terms(&point.t);
            n = self.doubled_phase(&point, &terms, &n);
            if left > 0 {
                point = Self::doubled(&point, terms);
            }
        }
        Some((point, n))
    }

    /// The point and n at the small time `h`, by so many terms of series in which each is below 2^`fall` times the one
    /// before it.
    fn begun(&self, h: &N, terms: usize, fall: i32) -> (Point<N>, [N; 2]) {
        let left = |power: usize| {
            let power = i32::try_from(power).unwrap_or(i32::MAX);
            within_power_of_two(h, fall.saturating_mul(power))
        };
        let h2 = square(h);
        let ([u, v], power) = self.laurent(&h2, terms);
        let u = u + multiple(4.0, &left(power));
        let u = self.root.as_ref().map_or(u.clone(), |root| u - times(&root.value, &h2));
        let v = v + multiple(8.0 * count(power), &left(power));
        let t = h2.clone() / u.clone();
        let q = h.clone() * v / square(&u);
        let (angle, power) = self.phase(h, &h2, terms);
        let [sin, cos] = (angle + multiple(2.0, &left(power))).sine_and_cosine();
        (Point { t, q }, [cos, -sin])
    }

    /// h² ℘(h) and -h³ ℘'(h)/2 by Laurent's series 1 + Σ cₖ, without its terms from the power of h that is returned on. It
    /// is cₖ = 3/((2k + 1)(k - 3)) Σ cₘ cₖ₋ₘ, at most 3 (r h)²ᵏ, from c₂ = -a h⁴/5 and c₃ = -b h⁶/7 on (DLMF 23.9.5).
    fn laurent(&self, h2: &N, terms: usize) -> ([N; 2], usize) {
        let number = |value: usize| h2.like(count(value));
        let (zero, one, h4) = (h2.like(0.0), h2.like(1.0), square(h2));
        let [second, third] = [times(&self.a, &h4) / number(5), times(&self.b, &(h4 * h2.clone())) / number(7)];
        let mut c = Vec::with_capacity(terms);
        c.extend([zero.clone(), zero.clone(), -second, -third]);
        for k in 4..=terms / 2 {
            let sum = (2..k - 1).fold(zero.clone(), |sum, m| sum + times(&c[m], &c[k - m]));
            c.push(sum * number(3) / number((2 * k + 1) * (k - 3)));
        }
        let [mut u, mut v] = [one.clone(), one];
        for (k, term) in c.iter().enumerate().skip(2).rev() {
            u = u + term.clone();
            v = v - number(k - 1) * term.clone();
        }
        ([u, v], 2 * c.len())
    }

    /// The argument of n at the time h but for its sign, 2T h/G + Σ Im fⱼ hʲ⁺²/((j + 1)(j + 2)), where ℘(α + h) = Σ fⱼ hʲ, without
    /// the terms from the power of h that is returned on. From f₀ = xₐ and f₁ = -2iκ on, ℘'' = 6℘² + 2a gives the others, at
    /// most (j + 1) rʲ⁺². Those of odd j are i times the numbers here.
    fn phase(&self, h: &N, h2: &N, terms: usize) -> (N, usize) {
        let number = |value: usize| h.like(count(value));
        let mut f = Vec::with_capacity(terms + 1);
        f.extend([times(&self.with_root(&self.pole), h2), -twice(&times(&self.kappa, &times(h2, h)))]);
        let of_curve = multiple(2.0, &times(&self.a, &square(h2)));
        for j in 0..terms.saturating_sub(2) {
            let product = |l: usize| {
                let product = times(&f[l], &f[j - l]);
                if l % 2 == 1 && j % 2 == 0 { -product } else { product }
            };
            let pairs = (0..j.div_ceil(2)).fold(h.like(0.0), |sum, l| sum + product(l));
            let all = if j % 2 == 0 { twice(&pairs) + product(j / 2) } else { twice(&pairs) };
            let sum = multiple(6.0, &all);
            let sum = if j == 0 { sum + of_curve.clone() } else { sum };
            f.push(sum / number((j + 1) * (j + 2)));
        }
        let mut angle = self.twice_energy.clone() * h.clone() / self.size.clone();
        for (j, term) in f.iter().enumerate().skip(1).step_by(2) {
            angle = angle + term.clone() / number((j + 1) * (j + 2));
        }
        (angle, f.len() + 2)
    }

    /// A coordinate of the curve from one less e.
    fn with_root(&self, less: &N) -> N {
        self.root.as_ref().map_or_else(|| less.clone(), |root| less.clone() + root.value.clone())
    }

    fn terms(&self, t: &N) -> Terms<N> {
        let four = |number: &N| number.times_power_of_two(2);
        let (one, t2, pole) = (t.like(1.0), square(t), times(&self.pole, t));
        let real = one.clone() - (pole.clone() + twice(&pole));
        if let Some(Root { linear, square: squared, .. }) = &self.root {
            let [a, b] = [times(linear, t), times(squared, &t2)];
            let (product, root) = (times(&a, &b), one.clone() - b.clone());
            let below = square(&root);
            let slope = one.clone() + twice(&(a.clone() + product)) + multiple(6.0, &b) + square(&b);
            let real = real - times(&pole, &(twice(&a) + b.clone())) - b.clone();
            return Terms { slope: [slope, times(&below, &root)], below, cubic: one + a + b, real };
        }
        let [a, b] = [times(&self.a, &t2), times(&self.b, t) * t2];
        let a2 = square(&a);
        let below = one.clone() - twice(&(a.clone() + four(&b))) + a2.clone();
        let five = one.like(5.0) * (a.clone() + four(&b) - a2.clone());
        let last = times(&a, &(a2 + four(&b))) + square(&b).times_power_of_two(3);
        let real = real - twice(&b) - times(&a, &(one.clone() + pole));
        Terms { slope: [one.clone() + five - last, square(&below)], below, cubic: one + a + b, real }
    }

    /// The point at twice the time.
    fn doubled(Point { t, q }: &Point<N>, Terms { below, cubic, slope: [slope, of], .. }: Terms<N>) -> Point<N> {
        Point { t: t.times_power_of_two(2) * cubic / below, q: twice(q) * slope / of }
    }

    /// n at twice the time, times some power of two.
    fn doubled_phase(&self, Point { t, q }: &Point<N>, Terms { real, .. }: &Terms<N>, [re, im]: &[N; 2]) -> [N; 2] {
        let imaginary = twice(&self.kappa) * times(t, q);
        let (square_re, square_im) =
            (times(&(re.clone() + im.clone()), &(re.clone() - im.clone())), twice(&times(re, im)));
        let doubled = [
            times(&square_re, real) - times(&square_im, &imaginary),
            times(&square_re, &imaginary) + times(&square_im, real),
        ];
        let (_, exponent) = mantissa_and_exponent(doubled[0].to_f64().abs().max(doubled[1].to_f64().abs()));
        doubled.map(|part| part.times_power_of_two(-exponent))
    }

    /// The turn, from the point at a quarter of the time of flight and n at half of it.
    fn assembled(&self, Point { t, q }: &Point<N>, [re, im]: &[N; 2]) -> Quaternion<N> {
        let root = self.products.scaled(&square(t)).minus(&self.roots.scaled(&twice(t))).less(&-t.like(1.0));
        let s = twice(q);
        let cofactors = root.cofactors();
        let below = self.terms(t).below;
        let squared = square(&s);
        let along = root.scaled(&s).apply(&self.acceleration);
        let size = below.clone() - times(&self.at_launch, &squared);
        let middle: [N; 3] = cofactors.apply(&self.rate);
        let middle = std::array::from_fn(|i| middle[i].clone() + along[i].clone());
        let turned = self.tensor.times(&cofactors).scaled(&times(&self.size, im));
        let tilted = self.excess.times(&root).scaled(&times(re, &s));
        let [x, y, z] = turned.plus(&tilted).apply(&middle);
        let scale = size * (below - times(&self.pole, &squared));
        [times(&self.squared, re) * scale, -x, -y, -z]
    }
}

/// A small whole number.
fn count(value: usize) -> f64 {
    value as f64
}
