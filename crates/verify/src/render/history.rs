//! Renders the accuracy of the committed records over time as a table.

use crate::judge::record::Record;

/// The check whose errors are followed: random launches, against the exact motion.
pub const FOLLOWED: &str = "random-attitude";

/// One block for each record: its date, commit and host, then the errors of every subject.
pub fn text(records: &[Record]) -> String {
    let block = |record: &Record| {
        let host = &record.host;
        let commit: String = host.commit.chars().take(12).collect();
        let heading = format!("\n{}  {commit}  {}, {} cores\n", host.date, host.cpu, host.cores);
        let line = |subject: &str| {
            let error = record.accuracy.error(FOLLOWED, subject).unwrap_or(f64::NAN);
            format!("  {FOLLOWED} / {subject:<18} {error:.2e} rad\n")
        };
        heading + &record.accuracy.subjects(FOLLOWED).map(line).collect::<String>()
    };
    records.iter().map(block).collect()
}
