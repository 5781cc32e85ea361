//! Launches as CSV, which `sample -` reads.

use crate::program::{assert_finite, run};

/// Every row is answered or the run fails with a message; JSON has the same rows; and what was answered can be read again
/// with the same answers.
///
/// # Panics
/// If this does not hold for `data`.
pub fn check(data: &[u8]) {
    let csv = run(&["sample", "-", "--threads", "1"], data);
    let json = run(&["sample", "-", "--threads", "1", "--format", "json"], data);
    assert_eq!(csv.code, json.code);
    let rows = csv.out.lines().count().saturating_sub(1);
    let error = usize::from(csv.code != 0);
    assert_eq!(json.out.lines().count(), rows + error, "{}", json.out);
    for line in json.out.lines() {
        assert_finite(&serde_json::from_str(line).unwrap_or_else(|error| panic!("{line}: {error}")));
    }
    for line in csv.out.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |at: usize| cells[at].parse::<f64>().expect("a number");
        assert!(number(8) >= 0.0 && number(8).is_finite(), "{line}");
        assert_eq!(crate::program::name_by_sign(number(9)), cells[10], "{line}");
        assert_eq!(cells[11], "true", "{line}");
    }
    let again = run(&["sample", "-", "--threads", "1"], csv.out.as_bytes());
    if rows > 0 {
        assert_eq!((again.code, &again.out), (0, &csv.out), "read again");
    }
}
