//! The counts of several people: the answers to twelve files, how often the interval holds, and files of every kind.
//!
//! `people/answers.json` is from `validation/reference/derive_people.py`. The file `04-published-48.csv` has the counts of
//! 48 people from table 1 of F. Bartoš et al., "Fair coins tend to land on the same side they started", arXiv 2310.04153.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use sampling::{Interval, SameSide, SameSideBias};
use serde_json::Value;
use statrs::distribution::{Beta, ContinuousCDF};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/people")
}

fn same_side_bias(people: impl IntoIterator<Item = (u64, u64)>) -> SameSideBias {
    let people: Vec<SameSide> =
        people.into_iter().map(|(same, tosses)| SameSide::new(same, tosses).expect("counts that can be")).collect();
    SameSideBias::of(&people).expect("a person with a toss")
}

/// The people of a file, with the rows of each person added up.
fn people(name: &str) -> Vec<(u64, u64)> {
    let text = std::fs::read_to_string(folder().join(name)).expect("the file is in the package");
    let number = |cell: &str| cell.parse::<u64>().expect("a whole number");
    let mut people = BTreeMap::<String, (u64, u64)>::new();
    for (index, row) in text.lines().skip(1).enumerate() {
        let cells: Vec<&str> = row.split(',').collect();
        let [.., same, tosses] = cells[..] else { panic!("{name}: {row}") };
        let person = if cells.len() > 2 { cells[0].to_owned() } else { index.to_string() };
        let counts = people.entry(person).or_default();
        *counts = (counts.0 + number(same), counts.1 + number(tosses));
    }
    people.into_values().collect()
}

fn ends(interval: Interval) -> Vec<f64> {
    vec![interval.lo, interval.hi]
}

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Null => Vec::new(),
        Value::Array(values) => values.iter().map(|value| value.as_f64().expect("a number")).collect(),
        one => vec![one.as_f64().expect("a number")],
    }
}

#[test]
fn twelve_files_have_the_answers_of_the_reference() {
    let answers = std::fs::read_to_string(folder().join("answers.json")).unwrap();
    let answers: BTreeMap<String, Value> = serde_json::from_str(&answers).unwrap();
    assert_eq!(answers.len(), 12);
    for (name, expected) in &answers {
        let found = same_side_bias(people(name));
        let counts = [found.counts.same(), found.counts.tosses(), found.people as u64];
        assert_eq!(
            counts.map(Value::from),
            ["same", "tosses", "people"].map(|field| expected[field].clone()),
            "{name}"
        );
        let near = |field: &str, found: Vec<f64>, expected: &Value, within: f64| {
            let expected = numbers(expected);
            assert_eq!(found.len(), expected.len(), "{name}, {field}: {found:?}, not {expected:?}");
            let pairs = found.iter().zip(&expected);
            assert!(
                pairs.into_iter().all(|(one, other)| (one - other).abs() <= within),
                "{name}, {field}: {found:?}, not {expected:?}"
            );
        };
        let optional = |interval: Option<Interval>| interval.map_or(Vec::new(), ends);
        // Clopper and Pearson's ends are up to 0.2 % of their distance from the share farther out.
        let pooled = 0.002 * found.these_flips.width();
        let is_pooled = found.interval.lo == found.these_flips.lo || found.interval.hi == found.these_flips.hi;
        near("these_flips", ends(found.these_flips), &expected["these_flips"], pooled);
        near("interval", ends(found.interval), &expected["interval"], if is_pooled { pooled } else { 1e-7 });
        near("mean_over_people", vec![found.mean], &expected["mean_over_people"], 1e-6);
        near("next_person", optional(found.next_person), &expected["next_person"], 1e-6);
        let spread = &expected["spread"];
        near("sd", found.spread.map_or(Vec::new(), |spread| vec![spread.sd]), &spread["sd"], 1e-6);
        near("sd", optional(found.spread.map(|spread| spread.interval)), &spread["interval"], 1e-6);
        for (field, found) in
            [("chi2", found.spread.map(|spread| spread.chi2)), ("p_value", found.spread.map(|spread| spread.p_value))]
        {
            let within = 1e-4 * spread[field].as_f64().unwrap_or(0.0);
            near(field, found.into_iter().collect(), &spread[field], within);
        }
        let degrees = |angle: f64| angle.to_degrees();
        near("psi", found.cone.map_or(Vec::new(), |cone| vec![degrees(cone.angle)]), &expected["psi"], 0.002);
        near(
            "psi",
            found.cone.map_or(Vec::new(), |cone| cone.interval.map(degrees).to_vec()),
            &expected["psi_interval"],
            if is_pooled { 0.01 } else { 1e-5 },
        );
    }
}

#[test]
fn the_published_people_have_their_mean_and_interval() {
    let found = same_side_bias(people("04-published-48.csv"));
    let rounded = |value: f64, places: i32| (value * 10f64.powi(places)).round() / 10f64.powi(places);
    assert_eq!(
        (rounded(found.mean, 5), ends(found.interval).iter().map(|end| rounded(*end, 4)).collect::<Vec<_>>()),
        (0.50996, vec![0.5044, 0.5157])
    );
    assert_eq!(found.interval_kind, "beta-binomial 95 % of 48 people");
}

#[test]
fn shares_that_agree_have_an_interval_and_a_share_of_a_half_is_one_of_90_degrees() {
    for people in [vec![(50, 100), (5, 10), (500, 1000)], vec![(40, 100), (60, 100)], vec![(1, 2); 9]] {
        let found = same_side_bias(people);
        assert_eq!((found.mean, found.cone.unwrap().angle), (0.5, std::f64::consts::FRAC_PI_2), "{found:?}");
        assert!(found.interval.width() > found.these_flips.width(), "{found:?}");
    }
}

/// The order of the people changes no bit, and landings on the other side have the mirrored answer.
#[test]
fn people_have_no_order_and_both_sides_of_a_coin_the_same_rules() {
    for name in ["02-one-dominates.csv", "05-class-of-25.csv", "12-near-one.csv"] {
        let (mut people, of) = (people(name), same_side_bias(people(name)));
        people.reverse();
        assert_eq!(same_side_bias(people.clone()), of, "{name}");
        let other = same_side_bias(people.into_iter().map(|(same, tosses)| (tosses - same, tosses)));
        for (one, other) in [(of.interval, other.interval), (of.next_person.unwrap(), other.next_person.unwrap())] {
            assert!((one.lo + other.hi - 1.0).abs() < 1e-7 && (one.hi + other.lo - 1.0).abs() < 1e-7, "{name}");
        }
        assert!((of.mean + other.mean - 1.0).abs() < 1e-7, "{name}: {} and {}", of.mean, other.mean);
        assert!((of.spread.unwrap().sd - other.spread.unwrap().sd).abs() < 1e-7, "{name}");
    }
}

/// People whose probabilities have a beta distribution.
struct Drawn {
    mean: f64,
    sd: f64,
    tosses: Vec<u64>,
    rng: ChaCha8Rng,
}

impl Drawn {
    fn new(mean: f64, sd: f64, tosses: &[u64]) -> Self {
        Self { mean, sd, tosses: tosses.to_vec(), rng: ChaCha8Rng::seed_from_u64(1) }
    }

    fn file(&mut self) -> Vec<(u64, u64)> {
        let phi = self.mean * (1.0 - self.mean) / (self.sd * self.sd) - 1.0;
        let people = Beta::new(self.mean * phi, (1.0 - self.mean) * phi).expect("a variance below the largest");
        let mut person = |tosses: &u64| {
            let probability = people.inverse_cdf(self.rng.random());
            ((0..*tosses).filter(|_| self.rng.random::<f64>() < probability).count() as u64, *tosses)
        };
        self.tosses.iter().map(&mut person).collect()
    }
}

/// Of files of people who differ, the interval holds the mean of all people in 95 % or more, also where one person has most
/// of the flips, and where the shares agree by luck. Student's interval of shares weighted by flips holds in 4 % and 0 % of
/// these, and that of the likelihood without a cap in 84 % of the former.
#[test]
fn intervals_of_people_hold_their_mean() {
    let agree = |people: &[(u64, u64)]| people.iter().all(|person| person == &people[0]);
    // The mean, the standard deviation, the flips of each person, whether shares have to agree, and the number of files.
    let cells = [
        (0.508, 0.016, vec![5000; 3], false, 200),
        (0.508, 0.05, vec![10_000, 20, 20], false, 200),
        (0.508, 0.016, vec![20; 3], true, 100),
        (0.508, 0.1, [vec![10_000], vec![20; 9]].concat(), false, 100),
        (0.98, 0.03, vec![50; 10], false, 100),
    ];
    for (mean, sd, tosses, is_lucky, files) in cells {
        let mut drawn = Drawn::new(mean, sd, &tosses);
        let found = std::iter::repeat_with(|| drawn.file()).filter(|people| !is_lucky || agree(people)).take(files);
        let held = found.filter(|people| same_side_bias(people.iter().copied()).interval.contains(mean)).count();
        assert!(20 * held >= 19 * files, "{mean} ± {sd}, {tosses:?}: {held} of {files}");
    }
}

/// Counts of all kinds, small and large, have answers of which each part fits the others.
#[test]
fn every_file_has_an_answer_that_makes_sense() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let mut one = || {
        let most = [1, 2, 3, 10, 1000, 1_000_000, 100_000_000_000][rng.random_range(0..7)];
        let tosses = rng.random_range(0..=most);
        let same = [0, tosses, tosses / 2, tosses - tosses / 1000, rng.random_range(0..=tosses)];
        (same[rng.random_range(0..5)], tosses)
    };
    for case in 0..400 {
        let people: Vec<(u64, u64)> =
            std::iter::repeat_with(&mut one).take(1 + case % 9).chain([(case as u64 % 2, 1)]).collect();
        let found = same_side_bias(people.iter().copied());
        let is_within = |value: f64, interval: Interval| {
            interval.contains(value) && interval.lo >= 0.0 && interval.hi <= 1.0 && interval.lo <= interval.hi
        };
        assert!(
            is_within(found.mean, found.interval) && is_within(found.share, found.these_flips),
            "{people:?}: {found:?}"
        );
        assert!(found.interval.lo <= found.these_flips.lo && found.interval.hi >= found.these_flips.hi, "{people:?}");
        assert!(found.interval.width() > 0.0, "{people:?}: {found:?}");
        if let Some(spread) = found.spread {
            assert!(
                is_within(spread.sd, spread.interval) && (0.0..=1.0).contains(&spread.p_value),
                "{people:?}: {found:?}"
            );
            assert!(
                spread.chi2 >= 0.0 && spread.interval.hi <= 0.5 && spread.interval.hi > 0.0,
                "{people:?}: {found:?}"
            );
        }
        if let Some(next) = found.next_person {
            assert!(is_within(next.lo, next) && next.width() > 0.0, "{people:?}: {found:?}");
        }
    }
}
