//! Files of spaces, as TOML and as JSON.

use sampling::space_file::DescribedSpace;
use sampling::{Plan, Sampler, Space};
use toss::{Error, ExactSolver, Solver, Tilt};

/// A space, read by either way, reads back as itself; each of its launches has finite values and lands or is refused; and
/// its estimate is a probability within its interval.
///
/// # Panics
/// If this does not hold for `data`.
pub fn check(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let described = DescribedSpace::from_toml(text);
    if let Err(Error::Text { line, column, .. }) = &described {
        // A carriage return alone ends a line, too.
        let lines = text.split(['\n', '\r']).count();
        assert!(*line >= 1 && *column >= 1 && *line <= lines, "line {line}, column {column}");
    }
    match (&described, toml::from_str::<Space>(text)) {
        (Ok(described), Ok(plain)) => assert_eq!(described.space, plain, "by both readers"),
        (Err(error), Ok(_)) => panic!("the reader of files alone refuses it: {error}"),
        (Err(error), Err(_)) => crate::assert_said(error),
        (Ok(_), Err(error)) => assert!(text.contains("description"), "{error}"),
    }
    for space in described.ok().map(|described| described.space).into_iter().chain(crate::read(text)) {
        check_space(&space);
    }
}

/// What holds for every space.
pub(crate) fn check_space(space: &Space) {
    const POINTS: u64 = 16;
    crate::assert_round_trip(space);
    let plan = Plan::Random { points: POINTS, seed: 1 };
    let Ok(blocks) = space.drawn(plan).map_err(|error| crate::assert_said(&error)) else { return };
    let launches: Vec<_> = blocks.flatten().collect();
    assert_eq!(launches.len() as u64, POINTS);
    let mut refused = false;
    for launch in &launches {
        assert!(launch.values.iter().all(|value| value.is_finite()), "{launch:?}");
        match ExactSolver.tilt(&launch.toss) {
            Ok(Tilt { cos_tilt, .. }) => assert!((-1.0..=1.0).contains(&cos_tilt), "{launch:?}: {cos_tilt}"),
            Err(error) => {
                crate::assert_said(&error);
                refused = true;
            }
        }
    }
    match Sampler::exact().estimate(space, plan) {
        Ok(found) => {
            let interval = found.interval.expect("random launches have an interval");
            assert!(!refused && found.points == POINTS, "{found:?}");
            assert!(0.0 <= interval.lo && interval.lo <= found.probability, "{found:?}");
            assert!(found.probability <= interval.hi && interval.hi <= 1.0, "{found:?}");
        }
        Err(error) => {
            crate::assert_said(&error);
            assert!(refused, "{error}, but every launch can be solved");
        }
    }
}
