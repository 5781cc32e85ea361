//! This kernel computes the attitudes at landing, Q0 ⊗ exp(½ ωL T ŝ) ⊗ exp(-½ q T ẑ), of all tosses of a batch. ŝ is
//! the direction of the angular momentum at launch and q = (k - 1) ωz the rate of the spin.

use dynamics::{CoinToss, Error, SolveError};
use numerics::lanes::{Real, Simd, sin_cos_to_sign};

use super::Batch;
use super::kernel::{BatchRun, Kernel};
use super::momentum::{Constants, Extent, without_negligible};
use crate::compensated::compensated_landing;

impl Batch<'_> {
    /// Writes the attitude at landing of each toss, from the body to the laboratory frame (LF), as columns of the
    /// quaternion's w, x, y and z. The sign of each quaternion is arbitrary. Fails for the first toss that has no
    /// attitude; the contents of `out` are then unspecified. Panics if a column does not have one entry per toss.
    pub fn attitudes(&self, out: [&mut [f64]; 4]) -> Result<(), Error> {
        assert!(out.iter().all(|column| column.len() == self.tosses.len()), "each column must have one entry per toss");
        // Half of an angle, measured in quarters of a turn, is twice the angle measured in turns.
        let constants = Constants::new(&self.tosses).with_phases_times(2.0);
        let start = if self.is_flat() { None } else { Some(self.tosses.attitude().components()) };
        self.level.run(BatchRun { kernel: &Attitudes { constants, start }, tosses: self.tosses, out })
    }
}

struct Attitudes {
    /// Their phases are halved, and in quarters of a turn.
    constants: Constants,
    /// Q0; `None` if it is the identity.
    start: Option<[f64; 4]>,
}

impl Kernel<7, 4> for Attitudes {
    fn constants(&self) -> &Constants {
        &self.constants
    }

    #[inline(always)]
    fn begin<S: Simd>(&self, rates: [Real<S>; 3], speed: Real<S>, extent: &mut Extent<S>) -> [Real<S>; 7] {
        let motion = self.constants.motion(rates, speed, extent);
        let [x, y, z] = rates;
        let ([turn, rest], [spin, spin_rest]) = (motion.turns, self.constants.spin_turns(z, speed));
        let inverse = motion.size * (motion.half_inverse + motion.half_inverse);
        let (rest, spin_rest) = (without_negligible(rest), without_negligible(spin_rest));
        [turn, rest, spin, spin_rest, x * inverse, y * inverse, motion.along * inverse]
    }

    #[inline(always)]
    fn end<S: Simd>(&self, [turn, turn_rest, spin, spin_rest, x, y, z]: [Real<S>; 7]) -> [Real<S>; 4] {
        let turned = turned_and_spun([turn, turn_rest], [spin, spin_rest], [x, y, z]);
        match self.start {
            None => turned,
            Some([a, b, c, d]) => product([x.constant(a), x.constant(b), x.constant(c), x.constant(d)], turned),
        }
    }

    fn solve_one(&self, toss: &CoinToss) -> Result<[f64; 4], SolveError> {
        compensated_landing(toss).map(|landing| landing.attitude.components())
    }
}

/// exp(½ φ ŝ) ⊗ exp(-½ q T ẑ), up to its sign, of φ and q T (quarters of a turn of their halves) with their rests, and the
/// axis ŝ.
#[inline(always)]
pub(super) fn turned_and_spun<S: Simd>(phase: [Real<S>; 2], spin: [Real<S>; 2], axis: [Real<S>; 3]) -> [Real<S>; 4] {
    let ([sin, cos], _) = sin_cos_to_sign(phase[0], phase[1]);
    let ([sin_spin, cos_spin], _) = sin_cos_to_sign(spin[0], spin[1]);
    let [x, y, z] = axis;
    let (x, y, z) = (x * sin, y * sin, z * sin);
    [
        cos.mul_add(cos_spin, z * sin_spin),
        x.mul_add(cos_spin, -(y * sin_spin)),
        x.mul_add(sin_spin, y * cos_spin),
        z.mul_add(cos_spin, -(cos * sin_spin)),
    ]
}

/// The quaternion product `left` ⊗ `right`.
#[inline(always)]
pub(super) fn product<S: Simd>([a, b, c, d]: [Real<S>; 4], [w, x, y, z]: [Real<S>; 4]) -> [Real<S>; 4] {
    [
        a.mul_add(w, -b.mul_add(x, c.mul_add(y, d * z))),
        a.mul_add(x, b.mul_add(w, c.mul_add(z, -(d * y)))),
        a.mul_add(y, c.mul_add(w, d.mul_add(x, -(b * z)))),
        a.mul_add(z, d.mul_add(w, b.mul_add(y, -(c * x)))),
    ]
}
