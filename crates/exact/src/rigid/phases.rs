//! Phases of more digits than the functions of them. A phase of 10^9 rad that is off by 10^-16 needs 83 digits, but its
//! sine only 53 of them.

use numerics::{DoubleDouble, Elementary};

/// A number for phases, and `M` for functions that are periodic in them.
pub(super) trait Phases<M>: Elementary {
    /// The number as an `M`.
    fn part(&self) -> M;

    /// An `M` as a number for phases.
    fn of_part(part: M) -> Self;

    /// Sine and cosine of the number as an angle (rad).
    fn circle(&self) -> [M; 2];
}

/// One kind of number for both.
impl<N: Elementary> Phases<N> for N {
    fn part(&self) -> N {
        self.clone()
    }

    fn of_part(part: N) -> N {
        part
    }

    fn circle(&self) -> [N; 2] {
        self.sine_and_cosine()
    }
}

impl Phases<f64> for DoubleDouble {
    fn part(&self) -> f64 {
        self.hi()
    }

    fn of_part(part: f64) -> Self {
        part.into()
    }

    fn circle(&self) -> [f64; 2] {
        let (sin, cos) = self.rounded_sin_cos();
        [sin, cos]
    }
}
