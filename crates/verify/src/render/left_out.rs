//! The checks that gave no row, as text. A suite may leave checks out, and a report that passes should say what it does
//! not speak of.

use std::collections::BTreeMap;

use crate::judge::LeftOut;

/// One line for each reason; empty if no check was left out.
pub fn text(left_out: &[LeftOut]) -> String {
    let mut by_reason: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for LeftOut { check, why } in left_out {
        by_reason.entry(why).or_default().push(check);
    }
    let line = |(why, checks): (&str, Vec<&str>)| format!("left out, {why}: {}\n", checks.join(", "));
    by_reason.into_iter().map(line).collect()
}
