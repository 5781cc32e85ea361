//! The probability tables as integer counts, which no change may move unnoticed.

#[test]
fn probability_tables() {
    let lines: Vec<_> = verify::measure::tables::tables().unwrap().into_iter().map(|(line, _)| line).collect();
    insta::assert_json_snapshot!("probability_tables", lines);
}
