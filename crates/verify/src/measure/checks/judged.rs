//! Judges bounds by the exact motion, which costs far less than the 256-bit reference, where its error is a small part of the
//! bound. What comes near the largest share is judged again by the
//! reference, so that no row rests on the exact motion alone.

use rayon::prelude::*;

use crate::measure::measurement::Deviation;

/// More than the error of the exact motion, of cos θ or of half the angle of an attitude: twice what its own checks allow.
pub(super) const EXACT: f64 = 2e-15;

/// The part of a bound that the error of the exact motion is at most, where it judges.
const PART: f64 = 0.02;

/// Errors divided by their `bounds`, the larger one, if the exact motion can judge them: `errors` are against it.
pub(super) fn by_exact_motion(errors: [f64; 2], bounds: [f64; 2]) -> Option<f64> {
    let can_judge = bounds.iter().all(|bound| EXACT <= PART * bound);
    can_judge.then(|| (errors[0] / bounds[0]).max(errors[1] / bounds[1]))
}

/// The shares of `cases` by `quick`; where it says nothing, and for all shares near the largest, by `thorough`.
pub(super) fn shares<T: Sync>(
    cases: &[T],
    quick: impl Fn(usize, &T) -> Option<f64> + Sync,
    thorough: impl Fn(usize, &T) -> Deviation + Sync,
) -> Vec<Deviation> {
    let judged: Vec<Option<f64>> = cases.par_iter().enumerate().map(|(index, case)| quick(index, case)).collect();
    let largest = judged.iter().flatten().copied().fold(0.0, f64::max);
    // Whatever exceeds its bound, or may be the largest, is within the two errors of the largest found.
    let is_far = |share: f64| share < (largest - 2.0 * PART).min(1.0 - PART);
    let all = cases.par_iter().zip(judged).enumerate();
    all.map(|(index, (case, share))| match share {
        Some(share) if is_far(share) => Ok(share),
        _ => thorough(index, case),
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_is_judged_thoroughly_and_what_the_exact_motion_cannot_judge_too() {
        assert_eq!(by_exact_motion([1e-13, 4e-13], [1e-12, 2e-12]), Some(0.2));
        assert_eq!(by_exact_motion([1e-14, 4e-13], [1e-13 * 0.99, 2e-12]), None);
        let cases = [0.3, 0.31, 0.2, -1.0, 0.29, 0.26];
        let thorough = |_, case: &f64| Ok(case + 100.0);
        let found = shares(&cases, |_, case| Some(*case).filter(|case| *case > 0.0), thorough);
        assert_eq!(found, [Ok(100.3), Ok(100.31), Ok(0.2), Ok(99.0), Ok(100.29), Ok(0.26)]);
        let found = shares(&[2.0, 0.99, 0.97], |_, case| Some(*case), thorough);
        assert_eq!(found, [Ok(102.0), Ok(100.99), Ok(0.97)], "all that may be above 1");
        let found = shares(&[f64::NAN, 0.5], |_, case| Some(*case), |_, _| Ok(7.0));
        assert_eq!(found, [Ok(7.0), Ok(7.0)], "what is no number");
    }
}
