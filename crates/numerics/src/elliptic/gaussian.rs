//! The functions θ4 and θ1 by Jacobi's imaginary transformation, for large nomes.

use super::{Complex, MOST_TERMS, is_below, largest, negligible, times};
use crate::elementary::Elementary;

/// θ4(z | q²) and θ1(z | q²) on the line z = x - i y as sums of Gaussians, up to a common factor:
///
/// ```text
/// E = Σ over even j of g_j e^(-i c' j),  O = Σ over odd j        g_j = exp(κ j (2ρ - j))
/// c' = π c/(2K'),  κ = π K/(2K')
/// θ4 ~ E + O,    θ1 ~ O - E                                      x = π ρ - π/2
/// ```
///
/// Adding n to ρ multiplies both functions by e^(-i c' n), and θ1 by (-1)^n besides. Therefore |ρ| ≤ ½ suffices. The
/// sums have few terms if the nome q is not small.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussianPair<N> {
    /// κ.
    rate: N,
    /// exp(-κ j (j - 1)) (cos c'j, sin c'j) for j = 1, 2, ...
    weights: Vec<[N; 2]>,
    /// Σ of the terms left out, relative to the largest.
    truncated: f64,
}

impl<N: Elementary> GaussianPair<N> {
    /// The functions for the quarter periods K and K', and for y = π `c`/(2K).
    pub fn new([k, k_prime]: [&N; 2], c: &N) -> Self {
        let quarter_turn = k.pi().halved();
        let rate = quarter_turn.clone() * k.clone() / k_prime.clone();
        let [sin, cos] = (quarter_turn * c.clone() / k_prime.clone()).sine_and_cosine();
        let (small, once) = (negligible(k), [cos, sin]);
        let (mut weights, mut angle) = (vec![once.clone()], once.clone());
        let fall = (-(rate.clone() + rate.clone())).exp();
        let (mut weight, mut ratio) = (k.like(1.0), k.like(1.0));
        let mut truncated = f64::INFINITY;
        for _ in 1..MOST_TERMS {
            angle = times(&angle, &once);
            ratio = ratio * fall.clone();
            weight = weight * ratio.clone();
            let size = largest(&weight);
            weights.push(angle.clone().map(|part| part * weight.clone()));
            if is_below(size, small) {
                truncated = 4.0 * small;
                break;
            }
        }
        Self { rate, weights, truncated }
    }

    /// κ = π K/(2K'), the steepness of the sums: |ρ| changes them by up to e^(2κ).
    pub fn steepness(&self) -> &N {
        &self.rate
    }

    /// θ4 and θ1 at `rho` = ρ, |ρ| ≤ ½, up to a common factor.
    pub fn at(&self, rho: &N) -> [Complex<N>; 2] {
        let one = rho.like(1.0);
        let twice = rho.clone() + rho.clone();
        // g of 1 and of -1, of which the others are powers except for their weights.
        let [up, down] = [twice.clone(), -twice].map(|turn| (self.rate.clone() * (turn - one.clone())).exp());
        let (mut up_power, mut down_power) = (up.clone(), down.clone());
        let mut even = [one.clone(), rho.like(0.0)];
        let mut odd = [rho.like(0.0), rho.like(0.0)];
        for (index, [cos, sin]) in self.weights.iter().enumerate() {
            if index > 0 {
                up_power = up_power * up.clone();
                down_power = down_power * down.clone();
            }
            let sum = if index % 2 == 0 { &mut odd } else { &mut even };
            let [re, im] = sum.clone();
            *sum = [
                re + (up_power.clone() + down_power.clone()) * cos.clone(),
                im + (down_power.clone() - up_power.clone()) * sin.clone(),
            ];
        }
        let combined = |sign: f64| {
            let [[e_re, e_im], [o_re, o_im]] = [even.clone(), odd.clone()];
            let [e_re, e_im] = if sign > 0.0 { [e_re, e_im] } else { [-e_re, -e_im] };
            [(o_re + e_re).widened(self.truncated), (o_im + e_im).widened(self.truncated)]
        };
        [combined(1.0), combined(-1.0)]
    }

    /// The same functions in numbers of another kind.
    pub fn map<M>(&self, convert: impl Fn(&N) -> M) -> GaussianPair<M> {
        let weights = self.weights.iter().map(|[a, b]| [convert(a), convert(b)]).collect();
        GaussianPair { rate: convert(&self.rate), weights, truncated: self.truncated }
    }
}
