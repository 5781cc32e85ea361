//! Puts the numbers of a row into words, so that every rendering says the same about it.

use std::cmp::Ordering;

use crate::judge::{Row, Status};

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
    format!("{} {} {} {unit}", measured(row), relation(row), number(row.bound)).trim_end().to_owned()
}

/// What was measured, or that the subject failed.
pub(super) fn measured(row: &Row) -> String {
    if row.failure.is_some() && row.measured.is_none() { "failed".to_owned() } else { number(row.measured) }
}

/// `≤` for what is within its bound, `>` for what is above it.
pub(super) fn relation(row: &Row) -> &'static str {
    if row.part() <= 1.0 { "≤" } else { ">" }
}

/// How far the row is from its bound: `margin 2.3×`, `830 times over`; `–` where nothing deviates or nothing is
/// allowed.
pub(super) fn margin(row: &Row) -> String {
    match row.part() {
        _ if row.status == Status::NotMeasured => "not measured".to_owned(),
        0.0 => "–".to_owned(),
        part if part <= 1.0 => format!("margin {:.1}×", 1.0 / part),
        part if part.is_finite() => over(part),
        _ if row.measured.is_none() => "no number".to_owned(),
        _ if row.bound.is_none() => "no bound".to_owned(),
        _ => "over a bound of 0".to_owned(),
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

/// The order of rows in reports: what fails first, then by measured over bound, the largest first.
pub(super) fn worst_first(a: &Row, b: &Row) -> Ordering {
    a.status.passes().cmp(&b.status.passes()).then(b.part().total_cmp(&a.part()))
}

/// The rows of one check, the worst first.
pub(super) struct Block<'a> {
    /// The rows; there is at least one.
    pub(super) rows: Vec<&'a Row>,
}

impl<'a> Block<'a> {
    /// The blocks of `rows`, the worst first.
    pub(super) fn all(rows: &'a [Row]) -> Vec<Self> {
        let mut blocks: Vec<Self> = Vec::new();
        for row in rows {
            match blocks.iter_mut().find(|block| block.rows[0].check == row.check) {
                Some(block) => block.rows.push(row),
                None => blocks.push(Self { rows: vec![row] }),
            }
        }
        for block in &mut blocks {
            block.rows.sort_by(|a, b| worst_first(a, b));
        }
        blocks.sort_by(|a, b| worst_first(a.worst(), b.worst()));
        blocks
    }

    /// The row that is the furthest above its bound, or else the closest to it.
    pub(super) fn worst(&self) -> &'a Row {
        self.rows[0]
    }

    /// The number of rows that fail.
    pub(super) fn failing(&self) -> usize {
        self.rows.iter().filter(|row| !row.status.passes()).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::tests::row;

    #[test]
    fn what_is_above_its_bound_is_said_to_be_over_and_never_to_have_a_margin() {
        for (measured, bound, comparison_, margin_) in [
            (4.3e-12, 1e-11, "4.3e-12 ≤ 1.0e-11 rad", "margin 2.3×"),
            (8.3e-9, 1e-11, "8.3e-9 > 1.0e-11 rad", "830 times over"),
            (1.3e-11, 1e-11, "1.3e-11 > 1.0e-11 rad", "1.3 times over"),
            (1.0001, 1.0, "1.0 > 1 rad", "just over"),
            (0.14, 42.5, "0.14 ≤ 42.5 rad", "margin 303.6×"),
            (2.0, 1e-16, "2 > 1.0e-16 rad", "2.0e16 times over"),
            (3.0, 0.0, "3 > 0 rad", "over a bound of 0"),
            (0.0, 0.0, "0 ≤ 0 rad", "–"),
        ] {
            let row = row("check", "gamma/rk4", measured, bound);
            assert_eq!((comparison(&row).as_str(), margin(&row).as_str()), (comparison_, margin_));
        }
    }

    #[test]
    fn blocks_and_their_rows_are_sorted_by_measured_over_bound() {
        let rows = [
            row("near", "a", 0.9, 1.0),
            row("far", "a", 0.1, 1.0),
            row("over", "a", 0.5, 1.0),
            row("over", "b", 7.0, 1.0),
            row("nothing", "a", 0.0, 0.0),
            row("over nothing", "a", 1.0, 0.0),
        ];
        let blocks = Block::all(&rows);
        let order: Vec<&str> = blocks.iter().map(|block| block.worst().check.as_str()).collect();
        assert_eq!(order, ["over nothing", "over", "near", "far", "nothing"]);
        assert_eq!(blocks[1].worst().subject, "b");
        assert_eq!(blocks[1].failing(), 1);
    }
}
