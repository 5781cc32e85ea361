//! The probability tables as integer counts, which no change may move unnoticed.

#[test]
fn probability_tables() {
    insta::assert_json_snapshot!(verify::checks::probability::tables().unwrap());
}
