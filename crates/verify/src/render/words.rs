//! Puts rows into words and into order, so that every rendering says the same about them: the numbers of a row, the rows
//! of a check, what moved against the baseline, and the checks that gave no row.
//!
//! The *reserve* of a row is its limit divided by what was measured.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use crate::judge::baseline::{Direction, Move};
use crate::judge::limits::ceiling;
use crate::judge::{LeftOut, Row, Status};

/// A number in few characters: whole numbers as they are, others with two digits.
pub(super) fn number(value: Option<f64>) -> String {
    match value {
        Some(value) if value == 0.0 || (value.fract() == 0.0 && value.abs() < 1e6) => format!("{value}"),
        Some(value) if (0.1..1.0).contains(&value.abs()) => format!("{value:.2}"),
        Some(value) if (1.0..1e3).contains(&value.abs()) => format!("{value:.1}"),
        Some(value) => format!("{value:.1e}"),
        None => "–".to_owned(),
    }
}

/// What was measured and what is allowed, as in `5.6e-9 > 1.0e-11 rad`.
pub(super) fn comparison(row: &Row) -> String {
    let unit = if row.unit == "1" { "" } else { row.unit.as_str() };
    format!("{} {} {} {unit}", measured(row), relation(row), number(row.limit)).trim_end().to_owned()
}

pub(super) fn measured(row: &Row) -> String {
    if row.failure.is_some() && row.measured.is_none() { "failed".to_owned() } else { number(row.measured) }
}

/// `≤` for what is within its limit, `>` for what is above it.
pub(super) fn relation(row: &Row) -> &'static str {
    if row.part() <= 1.0 { "≤" } else { ">" }
}

/// How many cases have no reference, in words; empty if all have one.
pub(super) fn unjudged(row: &Row) -> String {
    if row.without_reference > 0 { format!(", {} more not judged", row.without_reference) } else { String::new() }
}

/// How far the row is from its limit: `reserve 2.3×`, `830 times over`, `not judged`; `–` where nothing deviates or nothing is
/// allowed.
pub(super) fn reserve(row: &Row) -> String {
    match row.part() {
        _ if row.status == Status::NotMeasured => "not measured".to_owned(),
        _ if row.status == Status::NotJudged => "not judged".to_owned(),
        0.0 => "–".to_owned(),
        part if part < 1e-4 => format!("reserve {:.1e}×", 1.0 / part),
        part if part <= 1.0 => format!("reserve {:.1}×", 1.0 / part),
        part if part.is_finite() => over(part),
        _ if row.measured.is_none() => "no number".to_owned(),
        _ if row.limit.is_none() => "no limit".to_owned(),
        _ => "over a limit of 0".to_owned(),
    }
}

fn over(part: f64) -> String {
    match part {
        part if part >= 1e6 => format!("{part:.1e} times over"),
        // Two digits are enough.
        part if part >= 100.0 => format!("{:.0} times over", (part / 10.0).round() * 10.0),
        part if part >= 10.0 => format!("{part:.0} times over"),
        part if part >= 1.05 => format!("{part:.1} times over"),
        _ => "just over".to_owned(),
    }
}

/// The verdict on a row. A row without a limit of its own is judged by the solver's claim, but never allowed more than the
/// ceiling of its check; where that decides, or a solver gave no answer, nothing is said of a claim.
pub(super) fn verdict(row: &Row) -> &'static str {
    let by_ceiling = row.limit == Some(ceiling(&row.check));
    match row.status {
        Status::Pass => "pass",
        Status::PassLoose => "pass, loose limit",
        Status::PassByClaim if by_ceiling => "pass, within the limit of the check",
        Status::PassByClaim => "pass, by its own claim",
        Status::NotJudged => "not judged: no limit",
        Status::Fail => "FAIL",
        Status::FailByClaim if row.measured.is_none() => "FAIL, no answer",
        Status::FailByClaim if by_ceiling => "FAIL, above the limit of the check",
        Status::FailByClaim => "FAIL, above its own claim",
        Status::NoClaim => "FAIL, claims no error",
        Status::NoLimit => "FAIL, no limit",
        Status::NotMeasured => "FAIL, not measured",
    }
}

/// The order of rows in reports: what fails first, then by measured over limit, the largest first.
pub(super) fn worst_first(a: &Row, b: &Row) -> Ordering {
    a.status.passes().cmp(&b.status.passes()).then(b.part().total_cmp(&a.part()))
}

/// The rows of each check, the worst check and the worst row of each first. A check has one row at least.
pub(super) fn by_check(rows: &[Row]) -> Vec<Vec<&Row>> {
    let mut checks: Vec<Vec<&Row>> = Vec::new();
    for row in rows {
        match checks.iter_mut().find(|rows| rows[0].check == row.check) {
            Some(rows) => rows.push(row),
            None => checks.push(vec![row]),
        }
    }
    for rows in &mut checks {
        rows.sort_by(|a, b| worst_first(a, b));
    }
    checks.sort_by(|a, b| worst_first(a[0], b[0]));
    checks
}

/// The number of rows that fail.
pub(super) fn failing<'a>(rows: impl IntoIterator<Item = &'a Row>) -> usize {
    rows.into_iter().filter(|row| !row.status.passes()).count()
}

/// One line per entry that moved, the worse ones first and with the command that repeats their row; empty if nothing did.
pub(crate) fn moves(all: &[Move], rows: &[Row]) -> String {
    let mut out = String::new();
    for (direction, heading) in [
        (Direction::Worse, "WORSE than the baseline"),
        (Direction::Better, "better than the baseline; --bless takes it over"),
        (Direction::New, "not in the baseline; --bless takes it over"),
        (Direction::Gone, "in the baseline, but not measured; --bless drops it"),
    ] {
        let moved: Vec<&Move> = all.iter().filter(|moved| moved.direction == direction).collect();
        if moved.is_empty() {
            continue;
        }
        out += &format!("\n{heading}: {}\n", moved.len());
        // What is new comes by the hundred, when a baseline is begun.
        let shown = if direction == Direction::New { 10 } else { moved.len() };
        for moved in moved.iter().take(shown) {
            out += &format!("  {} / {}: {}\n", moved.check, moved.subject, change(moved));
            if direction == Direction::Worse {
                out += &format!("    repeat with: {}\n", replay(moved, rows));
            }
        }
        if moved.len() > shown {
            out += &format!("  and {} more\n", moved.len() - shown);
        }
    }
    out
}

/// The command that repeats what moved: its row's, or else that of the whole check.
pub(super) fn replay(moved: &Move, rows: &[Row]) -> String {
    let of_row = rows.iter().find(|row| moved.is_of(row)).and_then(|row| row.replay.clone());
    let check = moved.check.split('/').next().unwrap_or(&moved.check);
    let of_check = || rows.iter().find(|row| row.check == check).and_then(|row| row.replay.clone());
    of_row.or_else(of_check).unwrap_or_else(|| format!("cargo xtask verify --only {check}"))
}

/// What changed and by how much, as in `error 1.500e-12 → 2.903e-12, 1.935 times`.
pub(super) fn change(moved: &Move) -> String {
    let number = |value: Option<f64>| match value {
        Some(value) if value == 0.0 || value.abs() >= 1e4 => format!("{value:.0}"),
        Some(value) => format!("{value:.3e}"),
        None => "-".to_owned(),
    };
    let ratio = moved.before.zip(moved.now).filter(|(before, _)| *before > 0.0);
    let ratio = ratio.map_or_else(String::new, |(before, now)| match now / before {
        ratio if ratio >= 1e3 => format!(", {ratio:.1e} times"),
        ratio => format!(", {ratio:.3} times"),
    });
    format!("{} {} → {}{ratio}", moved.what, number(moved.before), number(moved.now))
}

/// One line for each reason; empty if no check was left out.
pub(crate) fn left_out(checks: &[LeftOut]) -> String {
    let mut by_reason: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    for LeftOut { check, why } in checks {
        by_reason.entry(why).or_default().push(check);
    }
    let line = |(why, checks): (&str, Vec<&str>)| format!("left out, {why}: {}\n", checks.join(", "));
    by_reason.into_iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tests::row;

    #[test]
    fn what_is_above_its_limit_is_said_to_be_over_and_never_to_have_a_reserve() {
        for (measured, limit, comparison_, reserve_) in [
            (4.3e-12, 1e-11, "4.3e-12 ≤ 1.0e-11 rad", "reserve 2.3×"),
            (8.3e-9, 1e-11, "8.3e-9 > 1.0e-11 rad", "830 times over"),
            (1.3e-11, 1e-11, "1.3e-11 > 1.0e-11 rad", "1.3 times over"),
            (1.0001, 1.0, "1.0 > 1 rad", "just over"),
            (0.14, 42.5, "0.14 ≤ 42.5 rad", "reserve 303.6×"),
            (2.0, 1e-16, "2 > 1.0e-16 rad", "2.0e16 times over"),
            (3.0, 0.0, "3 > 0 rad", "over a limit of 0"),
            (0.0, 0.0, "0 ≤ 0 rad", "–"),
        ] {
            let row = row("check", "gamma/rk4", measured, limit);
            assert_eq!((comparison(&row).as_str(), reserve(&row).as_str()), (comparison_, reserve_));
        }
    }

    #[test]
    fn checks_and_their_rows_are_sorted_by_measured_over_limit() {
        let rows = [
            row("near", "a", 0.9, 1.0),
            row("far", "a", 0.1, 1.0),
            row("over", "a", 0.5, 1.0),
            row("over", "b", 7.0, 1.0),
            row("nothing", "a", 0.0, 0.0),
            row("over nothing", "a", 1.0, 0.0),
        ];
        let checks = by_check(&rows);
        let order: Vec<&str> = checks.iter().map(|rows| &*rows[0].check).collect();
        assert_eq!(order, ["over nothing", "over", "near", "far", "nothing"]);
        assert_eq!(checks[1][0].subject, "b");
        assert_eq!(failing(checks[1].iter().copied()), 1);
    }
}
