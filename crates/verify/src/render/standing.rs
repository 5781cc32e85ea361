//! Where a solver stands beside the library's quaternion on the chart of work and accuracy, in one sentence.

use super::Report;
use super::report::{ENOUGH, Reached};
use crate::measure::work_precision::YARDSTICK;

/// A sentence for each judged solver: by its calls, or by its time if it counts none. It is empty where the library's
/// quaternion did not fly beside it.
pub(crate) fn sentences(report: &Report) -> String {
    let reached = report.reached();
    let yardstick = format!("{YARDSTICK}/dop853");
    let ours = reached.iter().find(|one| one.subject == yardstick).and_then(|one| one.enough);
    let Some(ours) = ours else { return String::new() };
    let of = |one: &Reached| {
        let (subject, finest) = (&one.subject, one.finest.error);
        let Some(cost) = one.enough else {
            return format!("{subject} is not as accurate as {ENOUGH:e} rad; at best {finest:.1e} rad.\n");
        };
        let ([_, calls, time], [_, our_calls, our_time]) = (cost.words(), ours.words());
        let (what, times, from, to) = if cost.calls > 0.0 {
            ("calls", cost.calls / ours.calls, calls, our_calls)
        } else {
            ("time", cost.microseconds / ours.microseconds, time, our_time)
        };
        format!(
            "{subject} is as accurate as {ENOUGH:e} rad at {times:.2} times the {what} of dop853 here ({from} to {to}).\n"
        )
    };
    let is_theirs = |one: &&Reached| one.subject.split('/').next() != Some(YARDSTICK);
    reached.iter().filter(is_theirs).map(of).collect()
}
