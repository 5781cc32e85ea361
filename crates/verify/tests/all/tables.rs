//! This test holds the probability tables fixed in a snapshot. Counts, and shares rounded to 12 digits, are the same on
//! every platform, so any change of the sampling or of an outcome changes them.

use sampling::{Estimate, Found};

#[test]
fn probability_tables() {
    let line = |(space, method, estimate): (&str, &str, Estimate)| match estimate.found {
        Found::Counts(counts) => {
            let [heads, tails, undecided] = [counts.heads(), counts.tails(), counts.undecided()];
            format!("{space} {method}: {heads} heads, {tails} tails, {undecided} undecided")
        }
        Found::Shares { .. } | Found::Enclosed { .. } => format!("{space} {method}: {:.12}", estimate.probability),
    };
    let lines: Vec<String> = verify::measure::tables::tables().unwrap().into_iter().map(line).collect();
    insta::assert_snapshot!("probability_tables", lines.join("\n"));
}
