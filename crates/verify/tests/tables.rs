//! This test holds the probability tables fixed in a snapshot. They are counts of launches and shares of 12 digits, so
//! any change of the sampling or of an outcome changes them.

#[test]
fn probability_tables() {
    let lines: Vec<_> = verify::measure::tables::tables().unwrap().into_iter().map(|(line, _)| line).collect();
    insta::assert_json_snapshot!("probability_tables", lines);
}
