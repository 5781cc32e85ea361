//! Files of parts of an estimate, which `probability --shard` writes and `merge` reads.

use sampling::{Found, Tally};

/// A part reads back as itself and cannot be merged with itself. If it is a whole plan, its estimate is a probability
/// within its interval, and nothing in it is proven. Changed contents are refused; they are then read with their own
/// digest, which the refusal states, so that what lies behind it is tried, too.
///
/// # Panics
/// If this does not hold for `data`.
pub fn check(data: &[u8]) {
    let Some(part) = read(data) else { return };
    let json = serde_json::to_string(&part).expect("it can be written");
    let read: Tally = serde_json::from_str(&json).unwrap_or_else(|error| panic!("{json}: {error}"));
    assert_eq!(read, part, "by {json}");
    let is_empty = part.range().is_empty();
    match part.clone().merge(read) {
        Ok(merged) => assert!(is_empty && merged == part, "counted twice: {json}"),
        Err(error) => crate::assert_said(&error),
    }
    let points = part.plan().points(part.space()).expect("a part was read for its plan");
    match part.estimate() {
        Ok(found) => {
            assert_eq!((part.range().start, part.range().end), (0, points), "{json}");
            assert!((0.0..=1.0).contains(&found.probability), "{found:?}");
            if let Some(interval) = found.interval {
                assert!(interval.lo <= found.probability && found.probability <= interval.hi, "{found:?}");
            }
            assert!(!matches!(found.found, Found::Counts(counts) if counts.are_certified()), "a file proves nothing");
        }
        Err(error) => crate::assert_said(&error),
    }
}

/// The part in `data`, with its digest set right.
fn read(data: &[u8]) -> Option<Tally> {
    let error = match serde_json::from_slice::<Tally>(data) {
        Ok(part) => return Some(part),
        Err(error) => error.to_string(),
    };
    crate::assert_said(&error);
    let (digest, _) = error.split_once(", and ")?.1.split_once(" of the contents")?;
    let mut contents: serde_json::Value = serde_json::from_slice(data).ok()?;
    contents["digest"] = digest.into();
    serde_json::from_value(contents).map_err(|error| crate::assert_said(&error)).ok()
}
