//! SIMD vectors of f64 that use the machine's widest registers. Their results have the same bits on every machine, so
//! that a batch of launches can be repeated anywhere.
//!
//! A kernel is a function written over [`Real`]. It is compiled for each instruction set that [`SimdLevel`] can choose
//! at run time. The choice does not change a bit of the result, because every operation is one rounded operation of
//! IEEE 754 in each lane (one number of a vector), and because the compiler never fuses a product and a sum by itself:
//! each fused multiply-add is written as one. A machine without that instruction calls the mathematical library
//! instead, which gives the same bits slowly.
//!
//! All functions here are `#[inline(always)]`, and kernels avoid closures and iterators that hide a loop. The reason is
//! that the compiler cannot inline the instructions of a set into a function that is not compiled for this set.

mod arctangent;
mod double;
mod philox;
mod real;
mod trigonometry;

pub use pulp::{Simd, WithSimd};

pub use arctangent::{ATAN2_ERROR, atan2};
pub use double::{Complex, Double, compensated_product, complex_product, inverse, polar, sum, times};
pub use philox::Philox;
pub use real::{Mask, Real};
pub use trigonometry::{
    HALF_TURN_ERROR, MOST_TURNS, ROUGH_ERROR, cosine_as_sine, rough_cos_of_half, rough_sin_of_half, sin_cos,
    sin_cos_of_half_turn, sin_cos_to_sign, sin_of_turns,
};

/// A SIMD level: an instruction set for which kernels are compiled.
#[derive(Debug, Clone, Copy)]
pub struct SimdLevel(pulp::Arch);

impl SimdLevel {
    /// The widest level that this machine has.
    #[inline]
    pub fn widest() -> Self {
        Self(pulp::Arch::new())
    }

    /// The fastest level for a kernel that fills one lane only. It is the narrowest one with a fused multiply-add,
    /// because narrow vectors pass through the execution units the fastest.
    #[inline]
    pub fn for_one_lane() -> Self {
        #[cfg(target_arch = "x86_64")]
        if let Some(narrow) = pulp::x86::V3::try_new() {
            return Self(pulp::Arch::V3(narrow));
        }
        Self::widest()
    }

    /// Every level that this machine has, the plain one (one lane, no SIMD) first.
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

    /// Its name, for example `avx512`.
    pub fn name(self) -> &'static str {
        struct Lanes;
        impl WithSimd for Lanes {
            type Output = usize;
            fn with_simd<S: Simd>(self, _: S) -> usize {
                S::F64_LANES
            }
        }
        let two = if cfg!(target_family = "wasm") { "simd128" } else { "neon" };
        // The levels with 1, 2, 4 and 8 lanes.
        ["plain", two, "avx2", "avx512"][self.run(Lanes).ilog2() as usize]
    }

    /// Runs `kernel` with the instructions of this level.
    #[inline]
    pub fn run<K: WithSimd>(self, kernel: K) -> K::Output {
        self.0.dispatch(kernel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_simd_level_of_the_machine_has_its_own_name_and_the_default_is_the_widest() {
        let names: Vec<&str> = SimdLevel::all().into_iter().map(SimdLevel::name).collect();
        let mut expected = vec!["plain"];
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            // The parts of AVX-512 that make up x86-64-v4 in the psABI (the ABI document for the processor).
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
        assert_eq!(Some(&SimdLevel::widest().name()), expected.last());
        // The narrowest level with a fused multiply-add, of which one lane is used.
        let for_one_lane = if expected.contains(&"avx2") { "avx2" } else { SimdLevel::widest().name() };
        assert_eq!(SimdLevel::for_one_lane().name(), for_one_lane);
    }
}
