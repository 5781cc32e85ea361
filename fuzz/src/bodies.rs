//! Columns of tosses of any rigid body: a header of its three moments, the tilt and gravity, and rows of ωx, ωy, ωz and
//! the speed.

use toss::{Attitude, Batch, Body, Certificate, Outcome, SimdLevel, Tosses, certify};

/// The most tosses of an input. A proof of one of them may take a millisecond.
const MOST: usize = 24;

/// Every SIMD level gives the same outcomes, those that are proven for the tosses alone, or names the first toss that has
/// none.
///
/// # Panics
/// If this does not hold for `data`.
pub fn check(data: &[u8]) {
    let numbers: Vec<f64> = data.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    let Some((&[i1, i2, i3, tilt, gravity], rest)) = numbers.split_first_chunk() else { return };
    let Ok(body) = Body::from_moments([i1, i2, i3]).map_err(|error| crate::assert_said(&error)) else { return };
    if !tilt.is_finite() {
        return;
    }
    let rows = &rest.as_chunks::<4>().0[..(rest.len() / 4).min(MOST)];
    let [x, y, z, speeds] = [0, 1, 2, 3].map(|of| rows.iter().map(|row| row[of]).collect::<Vec<f64>>());
    let tosses = match Tosses::new(body, Attitude::about_x(tilt), gravity, [&x, &y, &z], &speeds) {
        Ok(tosses) => tosses,
        Err(error) => return crate::assert_said(&error),
    };
    let alone: Vec<Option<Outcome>> =
        (0..tosses.len()).map(|index| tosses.solve(index, certify).ok().map(Certificate::outcome)).collect();
    let found: Vec<Option<Vec<Outcome>>> =
        SimdLevel::all().into_iter().map(|level| outcomes(&Batch::new(tosses).on(level), &alone)).collect();
    assert!(found.iter().all(|of_level| *of_level == found[0]), "{found:?}");
    let Some(outcomes) = &found[0] else { return };
    for ((row, outcome), alone) in rows.iter().zip(outcomes).zip(&alone) {
        let may_decide_more = *alone == Some(Outcome::Undecided) && !are_comparable(row);
        assert!(may_decide_more || Some(*outcome) == *alone, "{row:?}: {outcome:?}, not {alone:?}");
    }
}

/// Whether no number is so small compared with another that the radii of a proof underflow. `certify` documents that such a
/// toss may stay undecided, which a batch does not have to.
fn are_comparable([x, y, z, speed]: &[f64; 4]) -> bool {
    const FACTOR: f64 = 1e100;
    let sizes = [x.abs(), y.abs(), z.abs()].into_iter().filter(|size| *size > 0.0);
    let (least, most) = sizes.fold((f64::INFINITY, 0.0), |(least, most), size| (size.min(least), size.max(most)));
    most <= FACTOR * least && (*speed == 0.0 || speed.abs() >= 1.0 / FACTOR)
}

/// The outcomes of a batch, which are those that it counts; `None` if a toss has none alone, which the batch then names.
fn outcomes(batch: &Batch<'_, Body>, alone: &[Option<Outcome>]) -> Option<Vec<Outcome>> {
    let mut outcomes = vec![Outcome::Undecided; alone.len()];
    let (found, counted) = (batch.outcomes(&mut outcomes), batch.count());
    if let Some(index) = alone.iter().position(Option::is_none) {
        for error in [found.err(), counted.err()] {
            let error = error.unwrap_or_else(|| panic!("launch {index} has no outcome, and the batch has")).to_string();
            // It says in brackets what the launch is, if it is valid.
            let named = error.strip_prefix(&format!("launch {index}"));
            assert!(named.is_some_and(|rest| rest.starts_with([':', ' '])), "{error} instead of launch {index}");
        }
        return None;
    }
    found.expect("every toss has an outcome");
    let counted = counted.expect("every toss has an outcome");
    let number = |of| outcomes.iter().filter(|outcome| **outcome == of).count() as u64;
    let expected = [Outcome::Heads, Outcome::Tails, Outcome::Undecided].map(number);
    assert_eq!([counted.heads, counted.tails, counted.undecided], expected);
    Some(outcomes)
}
