//! Arithmetic and geometric means from 1 and k', and with them: the integrals, the decay towards the smaller one of c
//! and v, the nome, and the amplitude at launch.

use numerics::lanes::{Real, Simd};

use super::start::Start;

/// Steps of the means, after which they differ by 4 q^16 of themselves at most.
const STEPS: usize = 4;

/// What the means leave to the roots and the landing.
pub(super) struct Means<S: Simd> {
    /// x(T) - x(0), and ΩT (turns).
    pub(super) turns: [Real<S>; 2],
    /// The 32nd power of e^(-πc/(2K)), or of e^(-πv/(2K)).
    pub(super) decay: Real<S>,
    /// (1 - √k1)/(1 + √k1)/2 of the second step, of which q² is a series.
    pub(super) nome: Real<S>,
    /// Points whose angles, halved and halved again, correct the amplitude at launch.
    pub(super) points: [[Real<S>; 2]; STEPS],
}

/// The integral of the third kind between two steps, as Bulirsch has it.
struct ThirdKind<S: Simd> {
    p: Real<S>,
    weights: [Real<S>; 2],
}

impl<S: Simd> ThirdKind<S> {
    /// A step, given the product of the means.
    #[inline(always)]
    fn step(&mut self, product: Real<S>) {
        let inverse = product.constant(1.0) / self.p;
        let shift = product * inverse;
        let [first, second] = self.weights;
        self.weights = [second.mul_add(inverse, first), first.mul_add(shift, second)];
        self.p = product.constant(0.5) * (self.p + shift);
    }
}

impl<S: Simd> Start<S> {
    /// The four iterations.
    #[inline(always)]
    pub(super) fn means(&self) -> Means<S> {
        let number = |value: f64| self.complementary.constant(value);
        let (one, half) = (number(1.0), number(0.5));
        let (mut a, mut b) = (one, self.complementary);
        let mut sum = a + b;
        // a - b, with digits of its own.
        let mut difference = self.modulus_squared / sum;
        let mut third = ThirdKind { p: self.root, weights: [self.weight, one / self.root] };
        let (mut decay, [mut x, mut y]) = (self.decay, self.point);
        let mut points = [[one; 2]; STEPS];
        let mut ratios = [one; STEPS];
        for (point, ratio) in points.iter_mut().zip(&mut ratios) {
            let product = a * b;
            third.step(product);
            decay = decay * (sum.mul_add(decay, difference) / difference.mul_add(decay, sum));
            let (squares, across) = ([a * (x * x), b * (y * y)], x * y);
            *point = [squares[0] + squares[1], -(difference * across)];
            [x, y] = [squares[0] - squares[1], sum * across];
            (a, b) = (half * sum, product.sqrt());
            sum = a + b;
            *ratio = difference / (sum + sum);
            difference = half * (difference * *ratio);
        }
        third.step(a * b);
        let mean = half * sum;
        let [first, second] = third.weights;
        let integral = first.mul_add(mean, second) / ((mean + third.p) * number(32.0));
        Means {
            turns: [self.turns[0] * mean, self.turns[2].mul_add(integral, self.turns[1])],
            decay: ratios[3].mul_add(half * ratios[3], decay),
            nome: half * ratios[1],
            points,
        }
    }
}
