//! What kind of motion a launch leads to, decided by numbers that are exact: which principal axis the angular momentum
//! circles, whether it stays on the separatrix, and whether the body is symmetric.

use dynamics::Body;
use numerics::{Big, Elementary};

/// A launch in principal axes that were relabelled for the formulas of the motion.
pub(super) struct Start<N> {
    /// Moments about the axes 1, 2, 3, relative to a power of two near the largest.
    pub(super) moments: [N; 3],
    /// Directions of the axes in BF.
    pub(super) axes: [[N; 3]; 3],
    /// Body rate along the axes, in the unit of the rates.
    pub(super) rate: [N; 3],
    /// E = L² - 2 T I2, with L the angular momentum and T the kinetic energy. Its sign is that of the regime before the
    /// axes were relabelled.
    pub(super) excess: N,
    /// The kind of motion.
    pub(super) regime: Regime,
}

/// The kind of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// The body precesses uniformly about the angular momentum and spins uniformly about an axis of symmetry, or it
    /// turns about a principal axis for ever.
    Uniform,
    /// The angular momentum circles the axis of the largest moment.
    AroundLargest,
    /// The angular momentum circles the axis of the smallest moment.
    AroundSmallest,
    /// The angular momentum approaches the axis of the middle moment, once and for ever.
    Separatrix,
}

/// Whether E is to be computed anew because of cancellation: its terms agree in three digits.
const CANCELLED: f64 = 0.125;

impl<N: Elementary> Start<N> {
    /// The launch of `body` at the `rate` (BF) in a unit near its largest component. `None` if the numbers have too few
    /// digits to tell the regime.
    pub(super) fn new(body: &Body, rate: &[N; 3]) -> Option<Self> {
        let principal = body.rigid().scaled_principal(&rate[0]);
        let axes = principal.axes;
        let rate = axes.each_ref().map(|axis| along(axis, rate));
        let excess = excess(&principal.moments, &rate);
        let mut start = Self { moments: principal.moments, axes, rate, excess, regime: Regime::Uniform };
        start.regime = start.regime()?;
        match start.regime {
            Regime::Uniform => {}
            Regime::AroundLargest => start.upright()?,
            Regime::AroundSmallest => {
                start.exchange();
                start.upright()?;
            }
            Regime::Separatrix => {
                start.upright()?;
                if !start.rate[0].has_known_sign() {
                    return None;
                }
                if start.rate[0].sign() < 0.0 {
                    start.reverse([0, 1]);
                }
            }
        }
        Some(start)
    }

    fn regime(&self) -> Option<Regime> {
        let [first, second, third] = &self.moments;
        let gaps = [second.clone() - first.clone(), third.clone() - second.clone()];
        let [x, y, z] = &self.rate;
        if gaps.iter().chain(&self.rate).chain([&self.excess]).any(|part| !part.has_known_sign() && part.sign() == 0.0)
        {
            return None;
        }
        let is_0 = |part: &N| part.sign() == 0.0;
        let about_one_axis = [[x, y], [y, z], [x, z]].iter().any(|[a, b]| is_0(a) && is_0(b));
        if gaps.iter().any(is_0) || about_one_axis {
            return Some(Regime::Uniform);
        }
        if !self.excess.has_known_sign() {
            return None;
        }
        let excess = self.excess.sign();
        Some(if excess > 0.0 {
            Regime::AroundLargest
        } else if excess < 0.0 {
            Regime::AroundSmallest
        } else {
            Regime::Separatrix
        })
    }

    /// Relabels the axes (1, 2, 3) as (3, -2, 1).
    fn exchange(&mut self) {
        self.moments.swap(0, 2);
        self.axes.swap(0, 2);
        self.rate.swap(0, 2);
        self.reverse([1]);
    }

    /// Reverses the axes 2 and 3 if the rate about the third is negative.
    fn upright(&mut self) -> Option<()> {
        if self.rate[2].sign() < 0.0 {
            self.reverse([1, 2]);
        }
        self.rate[2].has_known_sign().then_some(())
    }

    /// Reverses some axes.
    fn reverse<const NUMBER: usize>(&mut self, axes: [usize; NUMBER]) {
        for axis in axes {
            self.axes[axis] = self.axes[axis].clone().map(|part| -part);
            self.rate[axis] = -self.rate[axis].clone();
        }
    }

    /// α_ij = (I_j - I_i)/(I_i I_j) for the axes i and j.
    pub(super) fn alpha(&self, i: usize, j: usize) -> N {
        let [first, second] = [&self.moments[i], &self.moments[j]];
        (second.clone() - first.clone()) / (first.clone() * second.clone())
    }
}

/// The component of a vector along an axis. A component of the axis that is exactly 0 or 1 takes no digits.
pub(super) fn along<N: Elementary>(axis: &[N; 3], vector: &[N; 3]) -> N {
    let mut sum: Option<N> = None;
    for (cosine, part) in axis.iter().zip(vector) {
        let value = if cosine.error() == 0.0 { cosine.to_f64() } else { f64::NAN };
        let is_exact = |number: f64| value == number && (cosine.clone() - cosine.like(number)).to_f64() == 0.0;
        if is_exact(0.0) {
            continue;
        }
        let term = match () {
            () if is_exact(1.0) => part.clone(),
            () if is_exact(-1.0) => -part.clone(),
            () => cosine.clone() * part.clone(),
        };
        sum = Some(match sum {
            None => term,
            Some(sum) => sum + term,
        });
    }
    sum.unwrap_or_else(|| vector[0].like(0.0))
}

/// E = I3 (I3 - I2) ω3² - I1 (I2 - I1) ω1². Next to the separatrix, rounding it would lose all digits of the period, so
/// that it is taken exactly there.
fn excess<N: Elementary>([first, second, third]: &[N; 3], [x, _, z]: &[N; 3]) -> N {
    let term = |moment: &N, less: N, rate: &N| moment.clone() * less * (rate.clone() * rate.clone());
    let outer = term(third, third.clone() - second.clone(), z);
    let inner = term(first, second.clone() - first.clone(), x);
    let rounded = outer.clone() - inner.clone();
    let sum = outer + inner;
    let left = if sum.sign() == 0.0 { 0.0 } else { (rounded.clone() / sum.clone()).to_f64().abs() };
    if left >= CANCELLED {
        return rounded;
    }
    if x.error() > 0.0 || z.error() > 0.0 {
        // Balls of rates hold many values of E.
        return rounded;
    }
    let [first, second, third, x, z] = [first, second, third, x, z].map(N::to_big);
    let product = |moment: &Big, less: Big, rate: &Big| moment * less * rate * rate;
    let exact = product(&third, &third - &second, &z) - product(&first, &second - &first, &x);
    if exact == Big::ZERO { rounded.like(0.0) } else { rounded.with_value(&exact) }
}

#[cfg(test)]
mod tests {
    use numerics::{Ball, DoubleDouble};

    use super::*;

    /// ω = (0.75, 1, 1) of this body is on the separatrix, and a ball about it has motions of all three kinds.
    #[test]
    fn a_ball_of_rates_about_the_separatrix_has_no_regime() {
        let body = Body::from_moments([1.0, 2.0, 2.25]).unwrap();
        for (widened, radius) in (0..3).flat_map(|axis| [0.0, 1e-30, 1e-3].map(|radius| (axis, radius))) {
            let mut rate = [0.75, 1.0, 1.0].map(|part| Ball::new(DoubleDouble::exactly(part), 0.0));
            rate[widened] = rate[widened].widened(radius);
            let regime = Start::new(&body, &rate).map(|start| start.regime);
            let expected = if radius == 0.0 || widened == 1 { Some(Regime::Separatrix) } else { None };
            assert_eq!(regime, expected, "{widened} {radius:e}");
        }
    }

    /// A component that is exactly 0 leaves a spin about the third axis, and one that may be 0 does not tell.
    #[test]
    fn a_ball_about_a_spin_has_no_regime() {
        let body = Body::from_moments([1.0, 2.0, 2.25]).unwrap();
        for (first, radius, expected) in [
            (0.0, 0.0, Some(Regime::Uniform)),
            (0.0, 1e-3, None),
            (1e-4, 1e-3, Some(Regime::AroundLargest)),
            (1e-2, 1e-3, Some(Regime::AroundLargest)),
        ] {
            let rate = [first, 0.0, 1.0].map(|part| Ball::new(DoubleDouble::exactly(part), 0.0));
            let rate = [rate[0].widened(radius), rate[1], rate[2]];
            assert_eq!(Start::new(&body, &rate).map(|start| start.regime), expected, "{first} {radius}");
        }
    }

    /// E is (ω3/ω1)² (3/4)² - 1, in parts of a term. Of exact rates it is taken exactly, however little is left of it.
    #[test]
    fn a_launch_next_to_the_separatrix_has_the_regime_of_its_side() {
        let body = Body::from_moments([1.0, 2.0, 2.25]).unwrap();
        for (size, apart) in [1.0, 2f64.powi(-60)].into_iter().flat_map(|size| [1.0, -1.0].map(|side| (size, side))) {
            let third = DoubleDouble::exactly(size) + (apart * size * 2f64.powi(-104)).into();
            let rate = [DoubleDouble::exactly(0.75 * size), 1.0.into(), third].map(|part| Ball::new(part, 0.0));
            let regime = Start::new(&body, &rate).map(|start| start.regime);
            let expected = if apart > 0.0 { Regime::AroundLargest } else { Regime::AroundSmallest };
            assert_eq!(regime, Some(expected), "{size} {apart}");
        }
    }
}
