//! This file computes angular momenta and phases with their rounding errors, for as many tosses as a register holds. It
//! is the arithmetic of [`compensated`](crate::compensated) in SIMD registers, which all kernels share.
//!
//! Unlike there, phases are in turns, and rates are not scaled: a toss whose squares could leave the range of f64 is
//! not ordinary, and no kernel solves it. L = (ωx, ωy, k ωz) is the angular momentum divided by I1, Ω² = Lx² + Ly², and
//! q = (k - 1) ωz. A pair is a rounded value and its rest, the part that rounding has lost.

use dynamics::{Coin, Tosses};
use numerics::DoubleDouble;
use numerics::lanes::{MOST_TURNS, Mask, Real, Simd};

use crate::tilt_terms::terms;

/// Largest |L|² ((rad/s)²) of an ordinary toss. The smallest is half of its inverse.
const LARGEST_SQUARE: f64 = 1e100;

/// Smallest inertia ratio k of ordinary tosses, whose ωz then stays far below the largest f64.
pub(super) const SMALLEST_RATIO: f64 = 1e-200;

/// Far below a rest that matters, and far above one in which digits below the range of f64 are missing.
const NEGLIGIBLE: f64 = 1e-150;

/// 1/π and its rest.
const INVERSE_PI: [f64; 2] = [std::f64::consts::FRAC_1_PI, -1.967_867_667_518_248_6e-17];

/// Constants that all tosses of a batch share.
#[derive(Debug, Clone, Copy)]
pub(super) struct Constants {
    /// k, and its rest.
    ratio: [f64; 2],
    /// 1/(π g), the turns of ωL T per unit of ωL v0, and its rest divided by it.
    turns: [f64; 2],
    /// (k - 1)/(π g), the turns of q T per unit of ωz v0, and its rest.
    spin_turns: [f64; 2],
    /// Largest number of turns of ωL T of an ordinary toss.
    most_turns: f64,
}

/// The motions of as many tosses as a register holds.
pub(super) struct Motion<S: Simd> {
    /// Lz = k ωz (rad/s).
    pub(super) along: Real<S>,
    /// Lz² ((rad/s)²).
    pub(super) along_squared: Real<S>,
    /// Ω² = Lx² + Ly².
    pub(super) across_squared: Real<S>,
    /// |L| = ωL (rad/s).
    pub(super) size: Real<S>,
    /// ½/|L|² ((rad/s)^-2).
    pub(super) half_inverse: Real<S>,
    /// ωL T (turns), and its rest.
    pub(super) turns: [Real<S>; 2],
}

/// The same as [`Motion`] in plain f64, without the rests.
pub(super) struct PlainMotion<S: Simd> {
    pub(super) along: Real<S>,
    pub(super) across_squared: Real<S>,
    /// |L|².
    pub(super) squared: Real<S>,
    pub(super) size: Real<S>,
    pub(super) turns: Real<S>,
}

/// Sums over the tosses of a tile that show whether all of them are ordinary.
pub(super) struct Extent<S: Simd> {
    squared: Real<S>,
    inverse: Real<S>,
    turns: Real<S>,
    sign: Real<S>,
}

impl Constants {
    pub(super) fn new(tosses: &Tosses<'_>) -> Self {
        Self::of(tosses.body(), tosses.gravity())
    }

    /// Those of a coin and a gravity (m/s²).
    pub(super) fn of(coin: &Coin, gravity: f64) -> Self {
        let k = coin.exact_inertia_ratio();
        let inverse_pi = DoubleDouble::exactly(INVERSE_PI[0]) + INVERSE_PI[1].into();
        let turns = inverse_pi / gravity.into();
        let spin_turns = turns * (k - 1.0.into());
        // In this range no product with 1/(π g) overflows, and none underflows that counts.
        let is_ordinary = (1e-50..1e50).contains(&gravity) && k.hi() >= SMALLEST_RATIO;
        Self {
            ratio: [k.hi(), k.lo()],
            turns: [turns.hi(), turns.lo() / turns.hi()],
            spin_turns: [spin_turns.hi(), spin_turns.lo()],
            // The phase of the spin, |q| T, is at most 1/k times as large if k < 1.
            most_turns: if is_ordinary { MOST_TURNS * k.hi().min(1.0) } else { 0.0 },
        }
    }

    /// With all phases multiplied by `factor`, a power of two, so that the kernel does not have to do it for each toss.
    pub(super) fn with_phases_times(self, factor: f64) -> Self {
        Self {
            turns: [factor * self.turns[0], self.turns[1]],
            spin_turns: self.spin_turns.map(|part| factor * part),
            most_turns: factor * self.most_turns,
            ..self
        }
    }

    /// The phase ωL T per unit of ωL v0, in the unit of phases, and its rest divided by it.
    pub(super) fn phase_of_one(&self) -> [f64; 2] {
        self.turns
    }

    /// The motions after launches with these rates (BF, rad/s) and speeds (m/s), which it adds to `extent`.
    #[inline(always)]
    pub(super) fn motion<S: Simd>(&self, rates: [Real<S>; 3], speed: Real<S>, extent: &mut Extent<S>) -> Motion<S> {
        let ratio = [speed.constant(self.ratio[0]), speed.constant(self.ratio[1])];
        self.motion_with(ratio, rates, speed, extent)
    }

    /// The same with other inertia ratios, each with its rest.
    #[inline(always)]
    pub(super) fn motion_with<S: Simd>(
        &self,
        ratio: [Real<S>; 2],
        [x, y, z]: [Real<S>; 3],
        speed: Real<S>,
        extent: &mut Extent<S>,
    ) -> Motion<S> {
        let [along, along_rest] = ratio[0].product_in_range(z);
        let along_rest = ratio[1].mul_add(z, along_rest);
        let (x_squared, y_squared, along_squared) =
            (x.product_in_range(x), y.product_in_range(y), along.product_in_range(along));
        let along_squared_rest = (along + along).mul_add(along_rest, along_squared[1]);
        let [across, across_rest] = x_squared[0].sum(y_squared[0]);
        let [squared, squared_rest] = across.sum(along_squared[0]);
        let squared_rest = (squared_rest + along_squared_rest) + (across_rest + (x_squared[1] + y_squared[1]));
        let size = squared.sqrt();
        let half_inverse = x.constant(0.5) / squared;
        // The rest of |L| divided by |L|, which is also the relative rest of all that is proportional to |L|.
        let size_rest = ((-size).mul_add(size, squared) + squared_rest) * half_inverse;
        let [turned, turned_rest] = size.product_in_range(speed);
        let [turns, turns_rest] = turned.product_in_range(x.constant(self.turns[0]));
        let turns_rest = turned_rest.mul_add(x.constant(self.turns[0]), turns_rest);
        let turns_rest = turns.mul_add(size_rest + x.constant(self.turns[1]), turns_rest);
        extent.add(squared, half_inverse, turns, speed);
        Motion {
            along,
            along_squared: along_squared[0],
            across_squared: across,
            size,
            half_inverse,
            turns: [turns, turns_rest],
        }
    }

    /// q T (turns) and its rest, for the rates ωz (rad/s) and speeds v0 (m/s).
    #[inline(always)]
    pub(super) fn spin_turns<S: Simd>(&self, z: Real<S>, speed: Real<S>) -> [Real<S>; 2] {
        let [turned, turned_rest] = z.product_in_range(speed);
        let [turns, turns_rest] = turned.product_in_range(z.constant(self.spin_turns[0]));
        let turns_rest = turned_rest.mul_add(z.constant(self.spin_turns[0]), turns_rest);
        [turns, turned.mul_add(z.constant(self.spin_turns[1]), turns_rest)]
    }

    /// As [`Constants::motion`], in plain f64. It sets no lower limit on |L|², because it adds no 1/|L|² to `extent`.
    #[inline(always)]
    pub(super) fn plain_motion<S: Simd>(
        &self,
        [x, y, z]: [Real<S>; 3],
        speed: Real<S>,
        extent: &mut Extent<S>,
    ) -> PlainMotion<S> {
        let along = z * z.constant(self.ratio[0]);
        let across_squared = x.mul_add(x, y * y);
        let squared = along.mul_add(along, across_squared);
        let size = squared.sqrt();
        let turns = size * (speed * size.constant(self.turns[0]));
        extent.add(squared, squared.constant(0.0), turns, speed);
        PlainMotion { along, across_squared, squared, size, turns }
    }

    /// Whether a toss with these rates (rad/s) and this speed (m/s) is ordinary: no square and no phase leaves its
    /// range.
    pub(super) fn is_ordinary(&self, [x, y, z, speed]: [f64; 4]) -> bool {
        let simd = pulp::Scalar;
        let mut extent = Extent::new(simd);
        self.motion([x, y, z].map(|rate| Real::splat(simd, rate)), Real::splat(simd, speed), &mut extent);
        extent.is_ordinary(self)
    }
}

impl<S: Simd> Extent<S> {
    #[inline(always)]
    pub(super) fn new(simd: S) -> Self {
        let zero = Real::splat(simd, 0.0);
        Self { squared: zero, inverse: zero, turns: zero, sign: zero }
    }

    #[inline(always)]
    pub(super) fn add(&mut self, squared: Real<S>, half_inverse: Real<S>, turns: Real<S>, speed: Real<S>) {
        self.squared = self.squared + squared;
        self.inverse = self.inverse + half_inverse;
        self.turns = self.turns + turns;
        self.sign = self.sign.either_sign(speed);
    }

    /// Whether all tosses are ordinary. Only sums are compared with the limits. No summand is negative unless a speed
    /// is, which `sign` records, so a single toss beyond a limit always takes the sum beyond it. Many ordinary tosses
    /// may do so too; they are then checked one by one. With a negative speed the limit is -1, which no absolute value
    /// keeps.
    #[inline(always)]
    pub(super) fn is_ordinary(&self, constants: &Constants) -> bool {
        let one = self.squared.constant(1.0);
        let extent = self.of_squares() + self.turns / self.squared.constant(constants.most_turns);
        extent.abs().at_most(one.times_sign_of(self.sign)).everywhere()
    }

    /// In which lanes all tosses are ordinary, with a largest phase ωL T above 0 in each lane. The sum is multiplied by it.
    #[inline(always)]
    pub(super) fn are_ordinary(&self, most_turns: Real<S>) -> Mask<S> {
        let extent = self.of_squares().mul_add(most_turns, self.turns);
        extent.abs().at_most(most_turns.times_sign_of(self.sign))
    }

    /// The sum of the parts of |L|² and of its inverse.
    #[inline(always)]
    fn of_squares(&self) -> Real<S> {
        let scale = self.squared.constant(1.0 / LARGEST_SQUARE);
        self.squared.mul_add(scale, self.inverse * scale)
    }
}

/// The rest of a phase without what is negligible. The error of a product below 2^-968 depends on the SIMD level, by less
/// than 2^-1021. The rests of ordinary tosses multiply it by 1e100 at most, and so it matters in no rest that is not
/// negligible; but it would be seen in a sine of such a phase.
#[inline(always)]
pub(super) fn without_negligible<S: Simd>(rest: Real<S>) -> Real<S> {
    let negligible = rest.constant(NEGLIGIBLE);
    (rest + negligible) - negligible
}

/// The factors of A, B and C of [`TiltTerms`](crate::TiltTerms) that all tosses of a batch share, by their attitude Q
/// at launch.
pub(super) struct TiltTerms {
    /// The vertical in the body frame (BF) at launch, times |Q|².
    pub(super) vertical: [f64; 3],
    /// |Q|².
    pub(super) norm: f64,
}

impl TiltTerms {
    pub(super) fn new(tosses: &Tosses<'_>) -> Self {
        let (vertical, norm) = tosses.attitude().vertical();
        Self { vertical, norm }
    }

    /// A, B and C ((rad/s)²) for these rates (BF, rad/s), Lz, Ω² and |L|.
    #[inline(always)]
    pub(super) fn terms<S: Simd>(
        &self,
        [x, y, _]: [Real<S>; 3],
        along: Real<S>,
        across_squared: Real<S>,
        size: Real<S>,
    ) -> [Real<S>; 3] {
        let [m_x, m_y, m_z] = self.vertical;
        let vertical = [x.constant(m_x), x.constant(m_y), x.constant(m_z)];
        let [mean, cosine, sine] = terms(vertical, [x, y, along], across_squared);
        [mean, cosine, sine * size]
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use dynamics::Attitude;

    use super::*;

    fn constants(k: f64, gravity: f64) -> Constants {
        let coin = Coin::from_moments(1.0, k).unwrap();
        Constants::new(&Tosses::new(coin, Attitude::IDENTITY, gravity, [&[]; 3], &[]).unwrap())
    }

    #[test]
    fn ordinary_tosses_reach_up_to_the_documented_limits() {
        let of_square = |squared: f64| constants(0.5, 1.0).is_ordinary([squared.sqrt(), 0.0, 0.0, 0.0]);
        assert!([0.51e-100, 1.0, 0.99e100].into_iter().all(of_square));
        assert!(![0.0, 0.49e-100, 1.01e100, 1e305, f64::INFINITY, f64::NAN].into_iter().any(of_square));
        for (k, most) in [(0.25, 0.25 * MOST_TURNS), (1.5, MOST_TURNS)] {
            // ωL T = 2π · 10 v0/(π g).
            let of_turns = |turns: f64| constants(k, 2.0).is_ordinary([6.0, 8.0, 0.0, 0.2 * PI * turns]);
            assert!(of_turns(0.0) && of_turns(0.999 * most) && !of_turns(1.001 * most), "{k}");
        }
        let of_gravity = |gravity: f64| constants(0.5, gravity).is_ordinary([1.0, 0.0, 0.0, 0.0]);
        assert!(of_gravity(1e-50) && of_gravity(0.99e50) && !of_gravity(0.99e-50) && !of_gravity(1e50));
        let of_speed = |speed: f64| constants(0.5, 1.0).is_ordinary([1.0, 0.0, 0.0, speed]);
        assert!(of_speed(1.0) && !of_speed(-1.0) && !of_speed(f64::INFINITY) && !of_speed(f64::NAN));
    }

    #[test]
    fn one_toss_that_is_not_ordinary_is_detected_beside_ordinary_ones() {
        let are_ordinary = |tosses: [[f64; 4]; 2]| {
            let mut extent = Extent::new(pulp::Scalar);
            for toss in tosses {
                let [squared, half_inverse, turns, speed] = toss.map(|value| Real::splat(pulp::Scalar, value));
                extent.add(squared, half_inverse, turns, speed);
            }
            extent.is_ordinary(&constants(0.5, 1.0))
        };
        let ordinary = [2.0, 0.25, 3.0, 4.0];
        assert!(are_ordinary([ordinary, [1.0, 0.5, 2.0, 3.0]]));
        for other in
            [[1.01e100, 0.0, 0.0, 0.0], [1.0, 1.01e100, 0.0, 0.0], [1.0, 0.5, MOST_TURNS, 0.0], [1.0, 0.5, 0.0, -1.0]]
        {
            assert!(!are_ordinary([ordinary, other]) && !are_ordinary([other, ordinary]), "{other:?}");
        }
        // Two beyond different limits do not make up for each other.
        let fast = [1.5e100, 0.0, 0.0, 0.0];
        for other in [[1.0, 1.5e100, 0.0, 0.0], [1.0, 0.5, 0.75 * MOST_TURNS, 0.0]] {
            assert!(!are_ordinary([fast, other]) && !are_ordinary([other, fast]), "{other:?}");
        }
    }

    #[test]
    fn a_negligible_rest_is_0_and_another_keeps_its_bits() {
        let kept = |rest: f64| without_negligible(Real::splat(pulp::Scalar, rest)).first();
        assert_eq!([0.0, 5e-324, -1e-170, 1e-120, -1e-20].map(kept), [0.0, 0.0, 0.0, 1e-120, -1e-20]);
    }
}
