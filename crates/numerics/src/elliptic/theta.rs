//! The functions θ4 and θ1 by their Fourier series, for small nomes.

use super::{Complex, MOST_TERMS, is_below, largest, negligible, times};
use crate::elementary::Elementary;

/// θ4(z | q²) and θ1(z | q²) on the line z = x - i y with a fixed y:
///
/// ```text
/// θ4 = 1 + 2 Σ (-1)^n q^(2n²) cos 2nz                n = 1, 2, ...
/// θ1 = 2 Σ (-1)^n q^(2(n + ½)²) sin (2n + 1)z        n = 0, 1, ...
/// ```
///
/// Here q = exp(-π K'/K) and y = π c/(2K) with 0 ≤ c < K'. The terms fall like q^(2n² - n).
#[derive(Debug, Clone, PartialEq)]
pub struct ThetaPair<N> {
    /// ±2 q^(2n²) (cosh 2ny, sinh 2ny) for n = 1, 2, ...
    even: Vec<[N; 2]>,
    /// ±2 q^(2(n + ½)²) (cosh (2n + 1)y, -sinh (2n + 1)y) for n = 0, 1, ...
    odd: Vec<[N; 2]>,
    /// Σ of the terms left out, relative to θ4.
    truncated: f64,
}

impl<N: Elementary> ThetaPair<N> {
    /// The functions for the quarter periods K and K' = `c` + `v`, and for y = π `c`/(2K).
    pub fn new(k: &N, c: &N, v: &N) -> Self {
        let rate = k.pi() / (k.clone() + k.clone());
        let [fall_v, fall_c] = [v, c].map(|part| (-(rate.clone() * part.clone())).exp());
        // q = r², and the terms are r^(j(j - 1)) e^(-πjv/2K) ± r^(jj) e^(-πjc/2K) for j = 1, 2, ...
        let root = fall_v.clone() * fall_c.clone();
        let (mut even, mut odd) = (Vec::new(), Vec::new());
        let (small, mut truncated) = (negligible(k), f64::INFINITY);
        let (mut grown, mut shrunk, mut power) = (fall_v.clone(), fall_c.clone() * root.clone(), root.clone());
        for j in 1..MOST_TERMS {
            let sizes = [grown.clone() + shrunk.clone(), grown.clone() - shrunk.clone()];
            let [cosh, sinh] = if j % 4 < 2 { sizes } else { sizes.map(|part| -part) };
            let (terms, pair) = if j % 2 == 0 { (&mut even, [cosh, sinh]) } else { (&mut odd, [cosh, -sinh]) };
            terms.push(pair);
            // The next terms are at least q times smaller, and q is small.
            if j % 2 == 1 && j > 1 && is_below(largest(&grown).max(last(&even)), small) {
                truncated = small;
                break;
            }
            // From r^(2j - 1) to r^2j, and then to r^(2j + 1).
            power = power * root.clone();
            grown = grown * fall_v.clone() * power.clone();
            power = power * root.clone();
            shrunk = shrunk * fall_c.clone() * power.clone();
        }
        Self { even, odd, truncated }
    }

    /// θ4 and θ1 at z = x - i y, from `[sin x, cos x]`.
    pub fn at(&self, [sin, cos]: &[N; 2]) -> [Complex<N>; 2] {
        let once = [cos.clone(), sin.clone()];
        let twice = times(&once, &once);
        let mut theta_4 = [sin.like(1.0), sin.like(0.0)];
        let mut theta_1 = [sin.like(0.0), sin.like(0.0)];
        let mut angle = once;
        for (n, [cosh, minus_sinh]) in self.odd.iter().enumerate() {
            if n > 0 {
                let [even_cos, even_sin] = times(&angle, &[cos.clone(), sin.clone()]);
                let [even_cosh, even_sinh] = &self.even[n - 1];
                let [re, im] = theta_4;
                theta_4 = [re + even_cosh.clone() * even_cos, im + even_sinh.clone() * even_sin];
                angle = times(&angle, &twice);
            }
            let [cos_odd, sin_odd] = angle.clone();
            let [re, im] = theta_1;
            theta_1 = [re + cosh.clone() * sin_odd, im + minus_sinh.clone() * cos_odd];
        }
        [theta_4, theta_1].map(|value| value.map(|part| part.widened(self.truncated)))
    }

    /// The same functions in numbers of another kind.
    pub fn map<M>(&self, convert: impl Fn(&N) -> M) -> ThetaPair<M> {
        let all = |terms: &[[N; 2]]| terms.iter().map(|[a, b]| [convert(a), convert(b)]).collect();
        ThetaPair { even: all(&self.even), odd: all(&self.odd), truncated: self.truncated }
    }
}

/// The largest size of the last term, 1 if there is none.
fn last<N: Elementary>(terms: &[[N; 2]]) -> f64 {
    terms.last().map_or(1.0, |[cosh, _]| largest(cosh))
}
