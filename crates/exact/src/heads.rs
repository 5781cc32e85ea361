//! This file computes the phases at which a coin in flight shows heads. They are intervals about one crest per turn, so
//! that flips, margins and shares of heads follow without sampling the motion.
//!
//! cos θ = a + b cos(ωL t) + c sin(ωL t) = a + r cos(ωL t - crest), r = √(b² + c²), is positive exactly while the phase
//! ωL t is within `half_width` = acos(-a/r) of a crest. From a horizontal launch the crest is at 0 and a/r = cot²ψ,
//! with ψ the angle between the coin's normal and its angular momentum.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The phases ωL t at which a motion shows heads: those nearer than `half_width` to `crest` + 2π n.
///
/// The errors are estimated from those of the terms; they prove nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeadsPhases {
    /// Phase at which cos θ is greatest (rad), from -π to π.
    pub crest: f64,
    /// Half the width of the interval of heads (rad): 0 if the motion never shows heads, π if it always does.
    pub half_width: f64,
    /// Error of `crest` (rad).
    pub crest_error: f64,
    /// Error of `half_width` (rad). It is large where the motion grazes cos θ = 0. It is 0 only if the motion shows
    /// heads always or never for all values of its terms within their errors.
    pub half_width_error: f64,
}

impl HeadsPhases {
    /// The phases of cos θ = `mean` + `cosine` cos(ωL t) + `sine` sin(ωL t), whose terms may each be off by `error`.
    pub(crate) fn new([mean, cosine, sine]: [f64; 3], error: f64) -> Self {
        let amplitude = cosine.hypot(sine);
        if amplitude <= error {
            // cos θ is constant within its error: the crest may be anywhere, and only the sign of the mean matters.
            let half_width_error = if mean.abs() > 2.0 * error { 0.0 } else { PI };
            return Self { crest: 0.0, half_width: always(mean), crest_error: PI, half_width_error };
        }
        // √(r² - a²) as a product keeps its digits where the motion grazes cos θ = 0.
        let grazing = ((amplitude - mean) * (amplitude + mean)).max(0.0).sqrt();
        let half_width = if amplitude <= mean.abs() { always(mean) } else { grazing.atan2(-mean) };
        Self {
            crest: sine.atan2(cosine),
            half_width,
            crest_error: FRAC_PI_2 * error / amplitude,
            half_width_error: half_width_error(mean, amplitude, 2.0 * error / amplitude),
        }
    }

    /// The phases of a motion whose cos θ does not change.
    pub fn constant(cos_tilt: f64) -> Self {
        Self::new([cos_tilt, 0.0, 0.0], 0.0)
    }

    /// The intervals of phases between `from` and `to` ≥ `from` that show heads (rad), in ascending order, without
    /// overlap.
    pub fn intervals(self, from: f64, to: f64) -> impl Iterator<Item = [f64; 2]> {
        let Self { crest, half_width, .. } = self;
        let always = half_width >= PI;
        let never = half_width <= 0.0;
        let turn_of = |phase: f64| ((phase - crest) / TAU).round();
        let (first, last) = if always { (0.0, 0.0) } else { (turn_of(from), turn_of(to)) };
        let about = move |turn: f64| {
            let middle = crest + TAU * turn;
            let ends = if always { [from, to] } else { [middle - half_width, middle + half_width] };
            [ends[0].max(from), ends[1].min(to)]
        };
        std::iter::successors(Some(first), move |turn| Some(turn + 1.0).filter(|turn| *turn <= last))
            .map(about)
            .filter(move |[begin, end]| !never && begin < end)
    }

    /// The first phase after launch at which the coin changes its face (rad); `None` if it never does. A motion that
    /// only touches cos θ = 0 does not change the face.
    pub fn first_flip(&self) -> Option<f64> {
        if self.half_width <= 0.0 || self.half_width >= PI {
            return None;
        }
        let [sets, rises] = [self.crest + self.half_width, self.crest - self.half_width];
        Some(sets.rem_euclid(TAU).min(rises.rem_euclid(TAU)))
    }
}

/// The half-width of a motion that always shows the face of its mean.
fn always(mean: f64) -> f64 {
    if mean > 0.0 { PI } else { 0.0 }
}

/// Error of acos(-mean/amplitude) for an `error` of the ratio. Away from a ratio of ±1 it follows from
/// |acos'| = 1/√(1 - x²), near it from acos(1 - x) ≤ 1.6 √x.
fn half_width_error(mean: f64, amplitude: f64, error: f64) -> f64 {
    let ratio = mean.abs() / amplitude;
    let from_edge = 1.0 - ratio;
    if from_edge > 4.0 * error {
        // 1 - x² is at least half of its value over the whole interval of the error.
        return error * (2.0 / (from_edge * (1.0 + ratio))).sqrt();
    }
    if -from_edge > error { 0.0 } else { (1.6 * (error + from_edge.abs()).sqrt()).min(PI) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ERROR: f64 = 8.0 * f64::EPSILON;

    #[test]
    fn certain_and_constant_motions_have_no_edge() {
        for (tilt, half_width) in [([0.6, 0.4, 0.0], PI), ([0.5, 0.5, 0.0], PI), ([-0.6, 0.3, 0.2], 0.0)] {
            let heads = HeadsPhases::new(tilt, ERROR);
            assert_eq!((heads.half_width, heads.first_flip()), (half_width, None), "{tilt:?}");
        }
        assert_eq!(HeadsPhases::new([0.8, 0.0, 0.0], ERROR).half_width_error, 0.0);
        assert_eq!(HeadsPhases::new([0.0, 0.0, 0.0], ERROR).half_width_error, PI);
    }

    #[test]
    fn intervals_are_where_cos_tilt_is_positive() {
        for terms in [[0.25, 0.75, 0.0], [-0.3, 0.2, 0.6], [0.6, 0.4, 0.0], [-0.6, 0.3, 0.2], [0.1, -0.5, -0.5]] {
            let heads = HeadsPhases::new(terms, ERROR);
            for (from, to) in [(0.0, 0.1), (0.0, 20.0), (3.0, 9.5), (6.0, 6.5)] {
                let intervals: Vec<[f64; 2]> = heads.intervals(from, to).collect();
                assert!(intervals.windows(2).all(|pair| pair[0][1] < pair[1][0]), "{intervals:?}");
                assert!(intervals.iter().flatten().all(|end| (from..=to).contains(end)), "{intervals:?}");
                for part in 0..1000 {
                    let phase = from + (to - from) * (f64::from(part) + 0.5) / 1000.0;
                    let (sin, cos) = phase.sin_cos();
                    let inside = intervals.iter().any(|[begin, end]| *begin < phase && phase < *end);
                    assert_eq!(terms[0] + terms[1] * cos + terms[2] * sin > 0.0, inside, "{terms:?} at {phase}");
                }
            }
        }
    }

    #[test]
    fn the_error_covers_the_grazing_motion() {
        // If the mean moves by its rounding error, the edge moves by no more than `half_width_error`.
        for from_edge in [0.0, 1e-16, 1e-15, 3e-15, 1e-14, 1e-12, 1e-9, 1e-5, 0.1, 0.9] {
            let mean = 0.5 * (1.0 - from_edge);
            let heads = HeadsPhases::new([mean, 0.5, 0.0], ERROR);
            for moved in [mean - ERROR, mean + ERROR] {
                let change = (HeadsPhases::new([moved, 0.5, 0.0], ERROR).half_width - heads.half_width).abs();
                assert!(change <= heads.half_width_error, "{from_edge:e}: {change:e} > {:e}", heads.half_width_error);
            }
        }
    }

    #[test]
    fn a_span_without_a_length_has_no_interval() {
        let heads = HeadsPhases::new([0.25, 0.75, 0.0], ERROR);
        assert_eq!(heads.intervals(0.5, 0.5).count(), 0);
        assert_eq!(HeadsPhases::constant(1.0).intervals(0.5, 0.5).count(), 0);
    }

    #[test]
    fn the_error_of_the_half_width_is_that_of_the_arc_cosine() {
        let error = f64::exp2(-10.0);
        for (mean, expected) in [
            (0.5, error * (2.0 / (0.5 * 1.5_f64)).sqrt()),
            (-0.5, error * (2.0 / (0.5 * 1.5_f64)).sqrt()),
            // Four errors inside of the edge, on it, one error beyond it, and further out.
            (1.0 - 4.0 * error, 1.6 * (5.0 * error).sqrt()),
            (1.0, 1.6 * error.sqrt()),
            (1.0 + error, 1.6 * (2.0 * error).sqrt()),
            (1.0 + 2.0 * error, 0.0),
            (1.1, 0.0),
        ] {
            // The result does not depend on the common scale of mean and amplitude.
            let found = half_width_error(4.0 * mean, 4.0, error);
            assert!((found - expected).abs() <= 1e-14 * expected, "{mean}: {found}, not {expected}");
        }
        assert_eq!(HeadsPhases::constant(0.0).half_width, 0.0);
    }
}
