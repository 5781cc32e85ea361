//! What counts as worse, and what a baseline takes over.

use super::*;
use crate::judge::tests::row;

fn one(error: f64, calls: u64) -> Baseline {
    [(("check".to_owned(), "a, b".to_owned()), Entry { error, calls: Some(calls) })].into_iter().collect()
}

fn directions(before: &Baseline, now: &Baseline) -> Vec<(&'static str, Direction)> {
    before.moves(now, true).iter().map(|moved| (moved.what, moved.direction)).collect()
}

#[test]
fn a_quarter_more_error_or_a_twentieth_more_calls_is_worse() {
    let baseline = one(1e-9, 1000);
    assert_eq!(directions(&baseline, &one(1.24e-9, 1049)), []);
    assert_eq!(directions(&baseline, &one(1.26e-9, 1000)), [("error", Direction::Worse)]);
    assert_eq!(directions(&baseline, &one(0.7e-9, 1051)), [("error", Direction::Better), ("calls", Direction::Worse)]);
    assert_eq!(directions(&baseline, &one(1e-9, 900)), [("calls", Direction::Better)]);
    assert_eq!(directions(&one(1e-16, 0), &one(9e-16, 0)), [], "differences of rounding do not count");
}

/// Where rounding decides, another machine's sine and cosine give up to a few times the error.
#[test]
fn another_ratio_is_that_of_what_is_worse_and_of_what_is_taken() {
    let baseline = one(1e-9, 1000).worse_above(4.0);
    assert_eq!(directions(&baseline, &one(3.9e-9, 1049)), []);
    assert_eq!(directions(&baseline, &one(4.1e-9, 1060)), [("error", Direction::Worse), ("calls", Direction::Worse)]);
    assert_eq!(baseline.ratcheted(&one(0.26e-9, 1000)), baseline);
    assert_eq!(baseline.ratcheted(&one(0.24e-9, 1000)), one(0.24e-9, 1000).worse_above(4.0));
}

#[test]
fn a_ratcheted_baseline_takes_what_is_better_and_keeps_what_would_be_worse() {
    let baseline = one(1e-9, 1000);
    assert_eq!(baseline.ratcheted(&one(1e-8, 900)), one(1e-9, 900));
    assert_eq!(baseline.ratcheted(&one(1e-10, 2000)), one(1e-10, 1000));
    assert_eq!(baseline.ratcheted(&one(0.99e-9, 999)), baseline, "small steps are not taken, in either direction");
    assert_eq!(Baseline::default().ratcheted(&baseline), baseline);
    assert_eq!(directions(&Baseline::default(), &baseline), [("error", Direction::New)]);
    assert_eq!(directions(&baseline, &Baseline::default()), [("error", Direction::Gone)]);
    assert!(baseline.moves(&Baseline::default(), false).is_empty());
}

#[test]
fn a_baseline_keeps_every_bit_through_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("quick.csv");
    assert_eq!(Baseline::read(&path).unwrap(), None);
    let baseline = one(0.1 + 0.2, 77);
    std::fs::write(&path, baseline.csv().unwrap()).unwrap();
    assert_eq!(Baseline::read(&path).unwrap(), Some(baseline));
    std::fs::write(&path, "\u{feff}check,subject,error,calls\r\nx,y,1,\r\n\r\nx,z,nan,\r\n").unwrap();
    let error = format!("{:#}", Baseline::read(&path).unwrap_err());
    assert!(error.ends_with("quick.csv: line 4: error = 'nan': expected a finite number from 0"), "{error}");
}

#[test]
fn a_row_that_fails_is_not_gone() {
    let rows = [row("check", "fails", 2.0, 1.0), row("check", "passes", 0.5, 1.0)];
    let before = "check,subject,error,calls\ncheck,fails,0.5,\ncheck,passes,0.5,\ncheck,nobody,0.5,\n";
    let moves = Baseline::parse(before).unwrap().moves_to(&Baseline::of(&rows, None), &rows, true);
    let moved: Vec<_> = moves.iter().map(|moved| (moved.subject.as_str(), moved.direction)).collect();
    assert_eq!(moved, [("nobody", Direction::Gone)]);
}
