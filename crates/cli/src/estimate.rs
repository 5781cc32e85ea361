//! An estimate of P(heads) as text, of one run or of parts that were merged.

use sampling::{Estimate, Found, IntervalKind};
use toss::STAGES;

use crate::quantity::{interval, probability as shown, rounded_up, shortest};

/// An estimate as text.
pub(crate) fn text(found: &Estimate, solver: &str) -> String {
    let (probability, kind) = (found.probability, &found.interval_kind);
    let (probability, interval) = match (found.interval, found.half_width()) {
        _ if !found.is_known() => ("not known".to_owned(), format!("0 to 1 ({kind})")),
        (Some(_), Some(error)) if *kind == IntervalKind::Rounding => {
            (shortest(probability), format!("± {} ({kind})", rounded_up(error)))
        }
        (Some(found), Some(error)) => {
            let digits = digits_for(error);
            let places = if *kind == IntervalKind::Proven { 16 } else { digits };
            (shown(probability, digits), format!("{} ({kind})", interval(found, places)))
        }
        _ => (shown(probability, 6), kind.to_string()),
    };
    let launches = match found.found {
        Found::Counts(counts) => {
            format!("{} heads, {} tails, {} undecided", counts.heads(), counts.tails(), counts.undecided())
        }
        Found::Enclosed { .. } => format!("all, in {} cells", found.points),
        Found::Shares { .. } => format!("{}, each at all its speeds", found.points),
    };
    let mut lines = vec![
        format!("P(heads)     {probability}"),
        format!("interval     {interval}"),
        format!("launches     {launches}"),
        format!("solver       {solver}"),
    ];
    if let Found::Counts(counts) = found.found
        && counts.are_certified()
    {
        let stages = STAGES.map(|stage| format!("{stage} {}", counts.proven().by(stage)));
        lines.push(format!("proven by    {}", stages.join(", ")));
    }
    lines.join("\n")
}

/// The number of decimal places that show two digits of `error`, at least six.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 6 and 17")]
fn digits_for(error: f64) -> usize {
    (1.0 - error.log10().floor()).clamp(6.0, 17.0) as usize
}
