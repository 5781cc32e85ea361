use dynamics::Coin;

use super::*;
use crate::coordinate::Coordinate::{RateX, RateY, RateZ, Speed};
use crate::sampler::Sampler;
use crate::space::Space;

fn read<T: for<'de> Deserialize<'de>>(text: &str) -> Result<T, String> {
    toml::from_str(text).map_err(|error| error.message().to_owned())
}

#[test]
fn plans_are_read_back_and_have_defaults() {
    let scrambled = Scrambled { points: 96, scrambles: 3, seed: 7 };
    for plan in [
        Plan::Grid,
        Plan::Random { points: 1000, seed: 5 },
        Plan::Sobol(scrambled),
        Plan::ExactSpeed(Rest::Grid),
        Plan::ExactSpeed(Rest::Sobol(scrambled)),
        Plan::Enclosure { accuracy: 1e-9 },
    ] {
        assert_eq!(read::<Plan>(&toml::to_string(&plan).unwrap()), Ok(plan));
        assert_eq!(plan.method().to_string().parse(), Ok(plan.method()));
    }
    // 2^53 + 1 is the first whole number that no f64 holds.
    for (seed, written) in [(1_u64 << 53, "9007199254740992"), ((1 << 53) + 1, "'9007199254740993'"), (u64::MAX, "")] {
        let plan = Plan::Random { points: 64, seed };
        let (toml, json) = (toml::to_string(&plan).unwrap(), serde_json::to_string(&plan).unwrap());
        assert!(toml.replace('"', "'").contains(written), "{toml}");
        assert_eq!((read::<Plan>(&toml), serde_json::from_str(&json).ok()), (Ok(plan), Some(plan)));
    }
    let plain = "{\"method\":\"random\",\"points\":64,\"seed\":18446744073709551615}";
    assert_eq!(serde_json::from_str(plain).ok(), Some(Plan::Random { points: 64, seed: u64::MAX }));
    assert_eq!(
        read::<Plan>("method = 'random'\npoints = 64\nseed = '1e6'"),
        Ok(Plan::Random { points: 64, seed: 1_000_000 })
    );
    assert_eq!(read::<Plan>("method = 'sobol'\npoints = 64"), Ok(Plan::Sobol(Scrambled::new(64, 1))));
    assert_eq!(read::<Plan>("method = 'random'\npoints = 64"), Ok(Plan::Random { points: 64, seed: 1 }));
}

#[test]
fn plans_that_no_sampler_carries_out_are_refused_with_the_field_at_fault() {
    for (text, message) in [
        ("method = 'magic'", "method = 'magic' is unknown; known: grid, random, sobol, exact-speed, enclosure"),
        ("method = 'random'", "points is missing"),
        ("method = 'random'\npoints = 0", "points = 0.0 is outside its valid range: at least 1"),
        ("method = 'random'\npoints = 8\nscrambles = 8", "scrambles = '8' can't be used: expected none"),
        ("method = 'grid'\npoints = 8", "points = '8' can't be used: expected none"),
        ("method = 'grid'\nseed = 8", "seed = '8' can't be used"),
        ("method = 'exact-speed'\nseed = 8", "seed = '8' can't be used"),
        ("method = 'enclosure'", "accuracy"),
        ("method = 'enclosure'\naccuracy = 0", "accuracy"),
        ("method = 'enclosure'\naccuracy = 1e-9\npoints = 8", "points = '8' can't be used"),
        ("method = 'grid'\naccuracy = 1e-9", "accuracy = '0.000000001' can't be used"),
        ("method = 'random'\npoints = 8\nseed = -1", "expected a seed: a whole number from 0 to 2^64 - 1"),
        ("method = 'random'\npoints = 8\nseed = '1.5'", "seed = '1.5' can't be used: expected a whole number"),
        ("method = 'sobol'\npoints = 12", "points = '12' can't be used: expected a multiple"),
        ("method = 'sobol'\npoints = 0", "points = 0.0 is outside"),
        ("method = 'sobol'\npoints = 8\nscrambles = 0", "scrambles = 0.0 is outside"),
        ("method = 'sobol'\npoints = 8\nsead = 1", "unknown field `sead`"),
    ] {
        let found = read::<Plan>(text).unwrap_err();
        assert!(found.starts_with(message), "{found} for {text}");
    }
}

fn estimates() -> Vec<Estimate> {
    let texts = [(RateX, "1:60:9"), (RateY, "2"), (RateZ, "1:60:9"), (Speed, "3:5:9")];
    let space = Space::parse(Coin::PAPER, &texts).unwrap();
    let one = Scrambled { points: 64, scrambles: 1, seed: 1 };
    let plans = [
        Plan::Grid,
        Plan::Random { points: 1000, seed: 1 },
        Plan::Sobol(Scrambled::new(1024, 1)),
        Plan::Sobol(one),
        Plan::ExactSpeed(Rest::Grid),
        Plan::ExactSpeed(Rest::Sobol(Scrambled::new(1024, 1))),
    ];
    plans.into_iter().map(|plan| Sampler::exact().estimate(&space, plan).unwrap()).collect()
}

/// A file proves nothing: what was proven is written so, and read as estimated.
#[test]
fn estimates_are_read_back_but_their_proofs_are_not() {
    for estimate in estimates() {
        let text = toml::to_string(&estimate).unwrap();
        let back = read::<Estimate>(&text).unwrap();
        assert_eq!(
            (back.probability, back.interval, back.interval_kind, back.points),
            (estimate.probability, estimate.interval, estimate.interval_kind, estimate.points)
        );
        match (back.found, estimate.found) {
            (Found::Counts(back), Found::Counts(counts)) => {
                assert_eq!((back.heads(), back.tails()), (counts.heads(), counts.tails()));
                assert!(counts.are_certified() && !back.are_certified(), "{text}");
                assert!(text.contains("[counts.proven]"), "{text}");
            }
            (back, found) => assert_eq!(back, found),
        }
    }
}

#[test]
fn estimates_that_contradict_themselves_are_refused_with_the_field_at_fault() {
    let valid = "probability = 0.25\npoints = 4\ninterval_kind = 'clopper-pearson'\ninterval = { lo = 0.1, hi = 0.6 }\n\
                 counts = { heads = 1, tails = 2, undecided = 1 }";
    assert!(read::<Estimate>(valid).is_ok());
    for (from, to, message) in [
        ("= 0.25", "= 0.5", "probability = 0.5 is outside its valid range: heads/points"),
        ("= 0.25", "= nan", "probability = NaN"),
        ("= 4", "= 5", "points = '5' can't be used: expected the sum"),
        ("undecided = 1", "undecided = 9223372036854775807", "points = '4' can't be used"),
        ("hi = 0.6", "hi = 1.5", "hi = 1.5 is outside its valid range: from 0 to 1"),
        ("lo = 0.1", "lo = 0.7", "lo = 0.7 is outside its valid range: from 0 to hi"),
        ("'clopper-pearson'", "'grid'", "interval = 'Some(Interval { lo: 0.1, hi: 0.6 })' can't be used"),
        ("'clopper-pearson'", "'guess'", "unknown variant `guess`"),
        ("points = 4", "points = 4\nrounding_error = 0.1", "counts is missing: expected either counts or"),
        ("points = 4", "points = 4\nheads = 1", "unknown field `heads`"),
    ] {
        let found = read::<Estimate>(&valid.replace(from, to)).unwrap_err();
        assert!(found.starts_with(message), "{found}");
    }
    let shares = "probability = 0.25\npoints = 4\ninterval_kind = 'grid'\nrounding_error = -1.0";
    assert!(read::<Estimate>(shares).unwrap_err().starts_with("rounding_error = -1.0"));
}
