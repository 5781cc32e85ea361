//! Tests of tallies: any partition gives the whole to the bit, and only neighbours of one plan merge.

use dynamics::Coin;
use exact::ExactSolver;

use super::*;
use crate::coordinate::Coordinate::{RateX, RateY, RateZ, Speed};
use crate::plan::Scrambled;

fn space() -> Space {
    let texts = [(RateX, "1:60:11"), (RateY, "-30:30:7"), (RateZ, "1:60:5"), (Speed, "3:5:9")];
    Space::parse(Coin::PAPER, &texts).unwrap()
}

fn plans() -> [Plan; 6] {
    let scrambled = Scrambled { points: 8 * 1111, scrambles: 8, seed: 3 };
    [
        Plan::Grid,
        Plan::Random { points: 5000, seed: 4 },
        Plan::Sobol(scrambled),
        Plan::Sobol(Scrambled { points: 9000, scrambles: 1, seed: 5 }),
        Plan::ExactSpeed(Rest::Grid),
        Plan::ExactSpeed(Rest::Sobol(scrambled)),
    ]
}

/// `points` launches in `parts` parts of about the same size.
fn parts(points: u64, parts: u64) -> impl Iterator<Item = Range<u64>> {
    (0..parts).map(move |part| points * part / parts..points * (part + 1) / parts)
}

#[test]
fn ninety_seven_parts_and_any_others_merge_to_the_whole_in_any_order() {
    let sampler = Sampler::exact();
    for plan in plans() {
        let points = plan.points(&space()).unwrap();
        let whole = sampler.tally(&space(), plan, 0..points).unwrap();
        let expected = sampler.estimate(&space(), plan).unwrap();
        assert_eq!(whole.estimate().unwrap(), expected, "{plan:?}");
        for number in [1, 2, 3, 97] {
            let tallies = parts(points, number).map(|part| sampler.tally(&space(), plan, part).unwrap());
            let merged = tallies.reduce(|one, two| two.merge(one).unwrap()).unwrap();
            assert_eq!(merged, whole, "{plan:?} in {number} parts");
            assert_eq!(merged.estimate().unwrap(), expected, "{plan:?} in {number} parts");
        }
    }
}

#[test]
fn gaps_overlaps_other_plans_and_incomplete_tallies_are_refused() {
    let (sampler, plan) = (Sampler::exact(), Plan::Random { points: 100, seed: 4 });
    let tally = |plan, range| sampler.tally(&space(), plan, range).unwrap();
    let first = tally(plan, 0..40);
    let other_space = space().with_axis(RateX, 1.0).unwrap();
    for (second, words) in [
        (tally(plan, 41..100), "launches are missing"),
        (tally(plan, 39..100), "share no launch"),
        (tally(plan, 0..40), "share no launch"),
        (tally(Plan::Random { points: 100, seed: 5 }, 40..100), "the same plan"),
        (tally(Plan::Random { points: 101, seed: 4 }, 40..100), "the same plan"),
        (sampler.tally(&other_space, plan, 40..100).unwrap(), "the same space"),
    ] {
        for (one, two) in [(first.clone(), second.clone()), (second, first.clone())] {
            let error = one.merge(two).unwrap_err();
            assert!(error.field() == "range" && error.to_string().contains(words), "{error}");
        }
    }
    assert!(first.estimate().unwrap_err().to_string().contains("0..40 of 100"));
    assert!(first.merge(tally(plan, 40..100)).unwrap().estimate().is_ok());
    #[expect(clippy::reversed_empty_ranges, reason = "it is refused")]
    for range in [0..101, 101..101, 7..3] {
        assert_eq!(sampler.tally(&space(), plan, range).unwrap_err().field(), Some("range"));
    }
    let by_solver = Sampler::by(&ExactSolver);
    assert_eq!(by_solver.tally(&space(), plan, 0..9).unwrap_err().field(), Some("solver"));
}

#[cfg(feature = "serde")]
mod files {
    use serde_json::{Value, from_value, json, to_value};

    use super::*;

    #[test]
    fn written_parts_are_read_and_merge_to_the_whole() {
        for plan in plans() {
            let points = plan.points(&space()).unwrap();
            let tallies = parts(points, 5).map(|part| Sampler::exact().tally(&space(), plan, part).unwrap());
            let read = tallies.map(|tally| from_value::<Tally>(to_value(tally).unwrap()).unwrap());
            let found = read.reduce(|one, two| one.merge(two).unwrap()).unwrap().estimate().unwrap();
            let expected = Sampler::exact().estimate(&space(), plan).unwrap();
            assert_eq!((found.probability, found.interval), (expected.probability, expected.interval), "{plan:?}");
            assert_eq!((found.interval_kind, found.points), (expected.interval_kind, expected.points));
            // A file proves nothing.
            assert!(!matches!(found.found, crate::Found::Counts(counts) if counts.are_certified()));
        }
    }

    /// Reads a part with the digest that its contents have.
    fn read(mut written: Value) -> Result<Tally, String> {
        let refused = match from_value::<Tally>(written.clone()) {
            Ok(tally) => return Ok(tally),
            Err(error) => error.to_string(),
        };
        let digest = refused.split_once(", and ").and_then(|(_, rest)| rest.split_once(" of the contents"));
        let Some((digest, _)) = digest else { return Err(refused) };
        written["digest"] = json!(digest);
        from_value(written).map_err(|error| error.to_string())
    }

    /// Changes one field of a written part, and its digest with it.
    fn changed(field: &str, value: Value) -> String {
        let plan = Plan::Sobol(Scrambled { points: 80, scrambles: 8, seed: 3 });
        let mut written = to_value(Sampler::exact().tally(&space(), plan, 5..40).unwrap()).unwrap();
        written[field] = value;
        read(written).err().unwrap_or_default()
    }

    #[test]
    fn damaged_parts_are_refused() {
        let count = |heads: u64| json!({ "heads": heads, "tails": 0, "undecided": 0 });
        let none = vec![count(0); 4];
        let counts = |first: u64| json!([vec![count(first), count(10), count(10), count(10)], none.clone()].concat());
        assert_eq!(changed("counts", counts(5)), "");
        for (field, value, words) in [
            ("schema", json!(1), "schema"),
            ("streams", json!(0), "streams"),
            ("range", json!([5, 41]), "sums"),
            ("range", json!([5, 81]), "range"),
            ("range", json!([40, 5]), "range"),
            ("counts", counts(6), "sums"),
            ("counts", json!([]), "sums"),
            ("counts", json!([{ "heads": u64::MAX, "tails": 1, "undecided": 0 }]), "counts"),
            ("counts", Value::Null, "counts"),
            ("shares", json!([]), "counts"),
            ("plan", json!({ "method": "random", "points": 80 }), "sums"),
            ("more", json!(1), "unknown field"),
        ] {
            let message = changed(field, value.clone());
            assert!(message.contains(words), "{field}: {value}: '{message}'");
        }
    }

    #[test]
    fn shares_beyond_their_launches_are_refused() {
        let plan = Plan::ExactSpeed(Rest::Grid);
        let written = to_value(Sampler::exact().tally(&space(), plan, 0..9).unwrap()).unwrap();
        for (field, value) in [
            ("probability", json!("81064793292668929")), // 9 · 2^53 + 1
            ("probability", json!("-1")),
            ("error", json!("9e9")),
            ("error", json!("340282366920938463463374607431768211455")),
            ("launches", json!(8)),
        ] {
            let mut written = written.clone();
            written["shares"][0][field] = value;
            let refused = read(written).unwrap_err();
            assert!(!refused.contains("digest"), "{field}: {refused}");
        }
        assert!(from_value::<Tally>(written).is_ok());
    }
}
