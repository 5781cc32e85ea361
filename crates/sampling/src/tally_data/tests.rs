//! Tests of files of parts: no digit of one can change unseen, and their streams are those of known sums.

use dynamics::catalogue::named_body;
use dynamics::{Body, Coin};
use serde_json::{Value, from_str, from_value, json, to_string, to_value};

use super::*;
use crate::coordinate::Coordinate::{Gravity, RateX, RateY, RateZ, Speed, Tilt};
use crate::exact_speed::Share;
use crate::sampler::Sampler;

const SCRAMBLED: Scrambled = Scrambled { points: 512, scrambles: 8, seed: 3 };

fn space(body: impl Into<Body>) -> Space {
    let texts = [(RateX, "1:60:11"), (RateY, "normal:5:3"), (RateZ, "-30:30:5"), (Speed, "3:5:9"), (Tilt, "0.1")];
    Space::parse(body, &texts).unwrap()
}

/// A space with a grid in each coordinate.
fn grid(body: impl Into<Body>) -> Space {
    let texts = [(RateX, "1:60:11"), (RateY, "-30:30:7"), (RateZ, "1:60:5"), (Speed, "3:5:9"), (Gravity, "9.7:9.9:2")];
    Space::parse(body, &texts).unwrap()
}

fn cases() -> [(Space, Plan); 7] {
    let book = named_body("book").unwrap();
    [
        (grid(Coin::PAPER), Plan::Grid),
        (space(Coin::PAPER), Plan::Random { points: 1000, seed: 4 }),
        (space(Coin::DISC), Plan::Sobol(SCRAMBLED)),
        (space(book).with_drop(Some(0.3)).unwrap(), Plan::Random { points: 1000, seed: 4 }),
        (space(book), Plan::Sobol(SCRAMBLED)),
        (grid(Coin::PAPER), Plan::ExactSpeed(Rest::Grid)),
        (space(Coin::PAPER), Plan::ExactSpeed(Rest::Sobol(SCRAMBLED))),
    ]
}

/// The sums of all launches of a plan: heads of each scramble, or the mean share in 12 digits and its error in 2, which
/// rounding on another platform does not change.
fn sums(space: &Space, plan: Plan) -> String {
    let tally = Sampler::exact().tally(space, plan, 0..plan.points(space).unwrap()).unwrap();
    let texts: Vec<String> = match &tally.sums {
        Sums::Counts(counts) => counts.iter().map(|counts| counts.heads().to_string()).collect(),
        Sums::Shares(shares) => shares.iter().map(|shares| share(shares.mean())).collect(),
    };
    texts.join(" ")
}

fn share(Share { probability, error }: Share) -> String {
    format!("{probability:.12}±{error:.1e}")
}

/// If this fails because launches or shares are chosen in another way: count up `STREAMS`, so that parts of before are
/// refused, and then write down the new sums.
#[test]
fn the_streams_are_those_of_known_sums() {
    let found = cases().map(|(space, plan)| sums(&space, plan));
    assert_eq!((STREAMS, found.each_ref().map(String::as_str)), (1, KNOWN));
}

const KNOWN: [&str; 7] = [
    "4356",
    "604",
    "53 56 52 52 43 52 52 49",
    "787",
    "56 50 50 49 44 52 50 50",
    "0.627391099352±1.1e-14",
    "0.575831050155±1.2e-14 0.565440268991±1.3e-14 0.576796307498±1.2e-14 0.577291042122±1.3e-14 \
     0.573408948982±1.2e-14 0.572315233334±1.3e-14 0.590213150792±1.2e-14 0.582359341526±1.3e-14",
];

#[test]
fn the_hash_has_its_published_values() {
    for (text, hash) in [("", 0xcbf2_9ce4_8422_2325), ("a", 0xaf63_dc4c_8601_ec8c), ("foobar", 0x8594_4171_f739_67e8)] {
        assert_eq!(fnv_1a(text.as_bytes()), hash, "{text}");
    }
}

/// Each digit of a file, changed to each of the others. The seventeenth digit of a number may not change the f64.
#[test]
fn no_digit_of_a_file_changes_unseen() {
    let few = Plan::Random { points: 9, seed: u64::MAX };
    let others = ["us-quarter", "us-quarter-engraved"].map(|name| (space(named_body(name).unwrap()), few));
    for (space, plan) in cases().into_iter().chain(others) {
        let points = plan.points(&space).unwrap();
        let text = to_string(&Sampler::exact().tally(&space, plan, points / 3..points).unwrap()).unwrap();
        let part: Tally = from_str(&text).unwrap();
        for (at, digit) in text.bytes().enumerate().filter(|(_, byte)| byte.is_ascii_digit()) {
            for other in (b'0'..=b'9').filter(|other| *other != digit) {
                let mut bytes = text.clone().into_bytes();
                bytes[at] = other;
                let changed = String::from_utf8(bytes).unwrap();
                let is_seen = from_str::<Tally>(&changed).map_or(true, |read| read == part);
                assert!(is_seen, "{changed} at {at}");
            }
        }
    }
}

#[test]
fn a_file_that_is_laid_out_in_another_way_is_the_same_part() {
    for (space, plan) in cases() {
        let tally = Sampler::exact().tally(&space, plan, 0..99).unwrap();
        let read: Tally = from_str(&serde_json::to_string_pretty(&to_value(&tally).unwrap()).unwrap()).unwrap();
        assert_eq!(to_string(&read).unwrap(), to_string(&tally).unwrap());
    }
}

/// A file with the right digest of what it holds.
fn with_digest(mut written: Value) -> Value {
    let refused = from_value::<Tally>(written.clone()).unwrap_err().to_string();
    let (_, digest) = refused.split_once(", and ").expect("a digest");
    written["digest"] = json!(digest.split(' ').next());
    written
}

#[test]
fn parts_of_other_streams_and_of_other_formats_are_refused_with_the_reason() {
    let [(space, plan), ..] = cases();
    let written = to_value(Sampler::exact().tally(&space, plan, 0..9).unwrap()).unwrap();
    let refused = |field: &str, value: Value| {
        let mut changed = written.clone();
        changed[field] = value;
        from_value::<Tally>(changed).unwrap_err().to_string()
    };
    assert!(refused("schema", json!(1)).starts_with("schema = '1'"), "{}", refused("schema", json!(1)));
    assert!(refused("digest", json!("")).starts_with("digest = ', and "));
    let message = refused("version", json!("0.0.0"));
    assert!(message.starts_with("digest = '") && message.contains("changed since"), "{message}");
    // A build with other streams writes right digests of its own.
    let mut other = written.clone();
    (other["streams"], other["version"]) = (json!(STREAMS + 1), json!("0.9.0"));
    let message = from_value::<Tally>(with_digest(other)).unwrap_err().to_string();
    assert!(message.starts_with("streams = '2 of version 0.9.0'"), "{message}");
    // One with the same streams is another version, and no other part.
    let mut newer = written.clone();
    newer["version"] = json!("0.9.0");
    assert_eq!(from_value::<Tally>(with_digest(newer)).unwrap(), from_value(written).unwrap());
    // Files of before there were digests.
    let old = r#"{"schema":1,"version":"0.2.0","space":{"coin":{"moments":[5e-7,2.5e-7]},"rate_x":"2","rate_y":"2","rate_z":"0.5",
        "speed":"3:5:500","gravity":"9.81","tilt":"0"},"plan":{"method":"grid"},"range":[0,500],
        "counts":[{"heads":0,"tails":500,"undecided":0}]}"#;
    let message = from_str::<Tally>(old).unwrap_err().to_string();
    assert!(message.starts_with("schema = '1'"), "{message}");
}
