//! Where a solver stands beside the library's quaternion on the chart of work and accuracy, in one sentence.

use super::Report;
use super::report::{ENOUGH, Reached};
use crate::measure::work_precision::YARDSTICK;

/// A sentence for each judged solver that counts its calls; empty where the library's quaternion did not fly beside it.
pub(crate) fn sentences(report: &Report) -> String {
    let reached = report.reached();
    let yardstick = format!("{YARDSTICK}/dop853");
    let calls = |one: &Reached| one.enough.map(|cost| cost.calls).filter(|calls| *calls > 0.0);
    let Some(ours) = reached.iter().find(|one| one.subject == yardstick).and_then(calls) else { return String::new() };
    let of = |one: &Reached| {
        let (subject, finest) = (&one.subject, one.finest.error);
        match (calls(one), one.enough) {
            (Some(calls), _) => Some(format!(
                "{subject} is as accurate as {ENOUGH:e} rad at {:.2} times the calls of dop853 here ({calls:.0} to {ours:.0}).\n",
                calls / ours
            )),
            (None, Some(_)) => None,
            (None, None) => {
                Some(format!("{subject} is not as accurate as {ENOUGH:e} rad; at best {finest:.1e} rad.\n"))
            }
        }
    };
    let is_theirs = |one: &&Reached| one.subject.split('/').next() != Some(YARDSTICK);
    reached.iter().filter(is_theirs).filter_map(of).collect()
}
