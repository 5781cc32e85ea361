//! Vectors of f64 numbers, as wide as the machine has them, with the same bits on every machine.
//!
//! A kernel is written once over [`Real`], and compiled for each instruction set that [`SimdLevel`] can choose from at run
//! time. Its bits do not depend on the choice: every operation is one rounded operation of IEEE 754 in each lane, and
//! each fused multiply-add is written as one. Where the machine has no such instruction it is a call of the
//! mathematical library, right but slow.
//!
//! Everything here is inlined always, and closures and iterators that hide a loop are avoided in kernels: the compiler
//! does not inline the instructions of a set into a function that does not promise them.

mod double;
mod real;
mod trigonometry;

pub use pulp::{Simd, WithSimd};

pub use double::{Complex, Double, compensated_product, complex_product, inverse, polar, sum, times};
pub use real::{Mask, Real};
pub use trigonometry::{
    MOST_TURNS, ROUGH_ERROR, cosine_as_sine, rough_cos_of_half, rough_sin_of_half, sin_cos, sin_cos_to_sign,
    sin_of_turns,
};

/// A SIMD level: an instruction set for which kernels are compiled.
#[derive(Debug, Clone, Copy)]
pub struct SimdLevel(pulp::Arch);

impl SimdLevel {
    /// The widest that this machine has.
    #[inline]
    pub fn widest() -> Self {
        Self(pulp::Arch::new())
    }

    /// The best for a kernel that fills one lane: among those with a fused multiply-add the narrowest, whose vectors pass
    /// through the units of the machine the fastest.
    #[inline]
    pub fn for_one_lane() -> Self {
        #[cfg(target_arch = "x86_64")]
        if let Some(narrow) = pulp::x86::V3::try_new() {
            return Self(pulp::Arch::V3(narrow));
        }
        Self::widest()
    }

    /// Every one that this machine has, the plain one first.
    pub fn all() -> Vec<Self> {
        #[cfg(target_arch = "x86_64")]
        let others = [
            pulp::x86::V3::try_new().map(pulp::Arch::V3), // AVX2 and FMA
            pulp::x86::V4::try_new().map(pulp::Arch::V4), // AVX-512
        ];
        #[cfg(not(target_arch = "x86_64"))]
        let others = [Some(pulp::Arch::new()).filter(|arch| !matches!(arch, pulp::Arch::Scalar))];
        std::iter::once(pulp::Arch::Scalar).chain(others.into_iter().flatten()).map(Self).collect()
    }

    /// Its name, as `avx512`.
    pub fn name(self) -> &'static str {
        struct Lanes;
        impl WithSimd for Lanes {
            type Output = usize;
            fn with_simd<S: Simd>(self, _: S) -> usize {
                S::F64_LANES
            }
        }
        let two = if cfg!(target_family = "wasm") { "simd128" } else { "neon" };
        // With 1, 2, 4 and 8 lanes.
        ["plain", two, "avx2", "avx512"][self.run(Lanes).ilog2() as usize]
    }

    /// Runs `kernel` with these instructions.
    #[inline]
    pub fn run<K: WithSimd>(self, kernel: K) -> K::Output {
        self.0.dispatch(kernel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_simd_level_of_the_machine_has_its_own_name_and_the_widest_is_among_them() {
        let names: Vec<&str> = SimdLevel::all().into_iter().map(SimdLevel::name).collect();
        let mut expected = vec!["plain"];
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            // All parts of AVX-512 that the psABI's level x86-64-v4 has.
            let avx512 = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512bw")
                && is_x86_feature_detected!("avx512cd")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl");
            expected.extend(avx2.then_some("avx2").into_iter().chain(avx512.then_some("avx512")));
        }
        #[cfg(target_arch = "aarch64")]
        expected.push("neon");
        assert_eq!(names, expected);
        assert!(names.contains(&SimdLevel::widest().name()) && names.contains(&SimdLevel::for_one_lane().name()));
    }
}
