//! Renders what moved against the baseline as a table.

use crate::judge::baseline::{Direction, Move};

/// One line for each entry that moved, the worse ones first. The text is empty if nothing moved.
pub fn text(moves: &[Move]) -> String {
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
        // A new baseline has hundreds of new entries.
        let shown = if direction == Direction::New { 10 } else { moved.len() };
        out.extend(moved.iter().take(shown).map(|moved| line(moved)));
        if moved.len() > shown {
            out += &format!("  and {} more\n", moved.len() - shown);
        }
    }
    out
}

fn line(moved: &Move) -> String {
    let number = |value: Option<f64>| match value {
        Some(value) if value == 0.0 || value.abs() >= 1e4 => format!("{value:.0}"),
        Some(value) => format!("{value:.3e}"),
        None => "-".to_owned(),
    };
    let ratio = moved.before.zip(moved.now).map_or_else(String::new, |(before, now)| {
        if before > 0.0 { format!("  {:.3} times", now / before) } else { String::new() }
    });
    let Move { check, subject, what, before, now, .. } = moved;
    format!("  {check} / {subject}: {what} {} → {}{ratio}\n", number(*before), number(*now))
}
