//! What moved against the baseline, as a table.

use crate::judge::Row;
use crate::judge::baseline::{Direction, Move};

/// One line per entry that moved, the worse ones first and with the command that repeats their row; empty if nothing did.
pub fn text(moves: &[Move], rows: &[Row]) -> String {
    let mut out = String::new();
    for (direction, heading) in [
        (Direction::Worse, "WORSE than the baseline"),
        (Direction::Better, "better than the baseline; --bless takes it over"),
        (Direction::New, "not in the baseline; --bless takes it over"),
        (Direction::Gone, "in the baseline, but not measured; --bless drops it"),
    ] {
        let moved: Vec<&Move> = moves.iter().filter(|moved| moved.direction == direction).collect();
        if moved.is_empty() {
            continue;
        }
        out += &format!("\n{heading}: {}\n", moved.len());
        // What is new comes by the hundred, when a baseline is begun.
        let shown = if direction == Direction::New { 10 } else { moved.len() };
        for moved in moved.iter().take(shown) {
            out += &line(moved);
            out += &repeat(moved, rows);
        }
        if moved.len() > shown {
            out += &format!("  and {} more\n", moved.len() - shown);
        }
    }
    out
}

/// How to repeat a row that became worse.
fn repeat(moved: &Move, rows: &[Row]) -> String {
    if moved.direction != Direction::Worse {
        return String::new();
    }
    format!("    repeat with: {}\n", replay(moved, rows))
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

fn line(moved: &Move) -> String {
    format!("  {} / {}: {}\n", moved.check, moved.subject, change(moved))
}
