//! This file reads tables of allowed deviations. Limits stand in a file of their own, with reasons, so that every
//! change of one is visible in a review: `data/limits.toml` for the solvers of this workspace, and `limits.toml` in the
//! folder of a suite for others. It also proposes limits for rows that have none, by the rule of this workspace: whoever
//! brings a solver starts from these, instead of from the solver's claim, which is often far above what it reaches.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt::Write;
use std::path::Path;

use anyhow::{Context, anyhow, ensure};
use serde::Deserialize;

use super::row::{Row, Status};
use crate::files;
use crate::measure::checks::CHECKS;

/// Allowed deviations by check and subject, with the reason for each check's limits.
#[derive(Debug, Clone, Deserialize)]
#[serde(transparent)]
pub struct Limits(BTreeMap<String, CheckLimits>);

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct CheckLimits {
    reason: String,
    allowed: BTreeMap<String, f64>,
}

/// The largest limit that a table may give under the check called `check`; infinite for a check that is not in
/// [`CHECKS`], whose rows its own ceiling still limits.
pub(crate) fn ceiling(check: &str) -> f64 {
    CHECKS.iter().find(|known| known.id == check).map_or(f64::INFINITY, |known| known.ceiling)
}

impl Limits {
    /// Reads the table at `path`.
    ///
    /// # Errors
    /// If the file can't be read, or a limit is negative, not finite or above the ceiling of its check, or has no
    /// reason.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        Self::parse(&files::read(path)?).with_context(|| format!("in {}", path.display()))
    }

    /// Reads the table at `path`; empty if there is no such file.
    pub fn read_if_any(path: &Path) -> anyhow::Result<Self> {
        let Some(text) = files::read_if_any(path)? else { return Ok(Self(BTreeMap::new())) };
        Self::parse(&text).with_context(|| format!("in {}", path.display()))
    }

    /// The limits of the solvers and libraries of this workspace.
    pub fn of_this_workspace() -> anyhow::Result<Self> {
        Self::parse(include_str!("../../data/limits.toml"))
    }

    /// These limits and, for each check and subject without one among them, that of `others`.
    #[must_use]
    pub fn over(self, others: Self) -> Self {
        let mut all = others.0;
        for (check, own) in self.0 {
            match all.entry(check) {
                Entry::Vacant(place) => drop(place.insert(own)),
                Entry::Occupied(mut place) => place.get_mut().allowed.extend(own.allowed),
            }
        }
        Self(all)
    }

    /// Reads the table from its text.
    pub fn parse(text: &str) -> anyhow::Result<Self> {
        let limits: Self = toml::from_str(text).map_err(|error| {
            match dynamics::Error::in_text(text, error.span().map(|span| span.start), error.message().to_owned()) {
                dynamics::Error::Text { line, message, .. } => anyhow!("line {line}: {message}"),
                other => other.into(),
            }
        })?;
        for (check, entry) in &limits.0 {
            ensure!(!entry.reason.trim().is_empty(), "[{check}] gives no reason for its limits");
            for (subject, limit) in &entry.allowed {
                ensure!(
                    limit.is_finite() && *limit >= 0.0,
                    "[{check}] {subject} = {limit}: a limit must be finite and at least 0"
                );
                let ceiling = ceiling(check);
                ensure!(
                    *limit <= ceiling,
                    "[{check}] {subject} = {limit}: no limit of this check may be above {ceiling}, its ceiling"
                );
            }
        }
        Ok(limits)
    }

    /// The limit of `subject` under `check`, in the unit of the check.
    pub fn get(&self, check: &str, subject: &str) -> Option<f64> {
        self.0.get(check)?.allowed.get(subject).copied()
    }

    /// All pairs of check and subject that have a limit.
    pub fn pairs(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0
            .iter()
            .flat_map(|(check, entry)| entry.allowed.keys().map(move |subject| (check.as_str(), subject.as_str())))
    }
}

/// The limits for all rows that pass without one, within the ceilings of their checks, as the text of a file of limits;
/// `None` if there are no such rows. `run` says which run measured them, such as `a standard run on 2026-11-22`.
///
/// Where nothing deviated, or the ceiling judges, there is no proposal: on another machine one case could be above a limit
/// of 0, and what is measured as a part of what the solver claims is limited by 1.
pub(crate) fn proposed(rows: &[Row], run: &str) -> Option<String> {
    let mut checks: BTreeMap<&str, Vec<(&str, f64)>> = BTreeMap::new();
    for row in rows.iter().filter(|row| matches!(row.status, Status::PassByClaim | Status::NotJudged)) {
        let ceiling = ceiling(&row.check);
        let is_limited = row.limit == Some(ceiling);
        if let Some(largest) = row.largest.filter(|largest| *largest > 0.0 && *largest <= ceiling && !is_limited) {
            checks.entry(&row.check).or_default().push((&row.subject, limit(largest).min(ceiling)));
        }
    }
    if checks.is_empty() {
        return None;
    }
    let mut text = format!(
        "# Proposed limits, in the unit of each check: twice the largest deviation of {run}, rounded up to two\n\
         # digits, and at least {ROUNDING:e}, since the last digits differ between machines. Read them before you keep\n\
         # them: a limit should be what the solver is meant to reach. Rows that fail, in which nothing deviates, or\n\
         # which the limit of their check judges, have no proposal.\n"
    );
    for (check, limits) in checks {
        let _ = write!(text, "\n[{check}]\nreason = \"Twice the largest deviation of {run}.\"\n[{check}.allowed]\n");
        for (subject, limit) in limits {
            let _ = writeln!(text, "{} = {limit:e}", toml::Value::from(subject));
        }
    }
    Some(text)
}

/// No limit below this one is proposed, because the sine and the cosine of another machine round differently.
const ROUNDING: f64 = 2e-14;

/// Twice `deviation`, rounded up to two digits, and at least [`ROUNDING`].
fn limit(deviation: f64) -> f64 {
    let twice = (2.0 * deviation).max(ROUNDING);
    let (digits, exponent) = format!("{twice:e}").split_once('e').map_or((0.0, 0), |(digits, exponent)| {
        (digits.parse::<f64>().unwrap_or(0.0), exponent.parse::<i32>().unwrap_or(0))
    });
    // Digits and exponent are read as one decimal number, so that 3e-12 is the same f64 as in the file.
    format!("{}e{}", (10.0 * digits).ceil(), exponent - 1).parse().unwrap_or(f64::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::judge;
    use crate::measure::check::{Check, Measure};
    use crate::measure::trial::Measurement;

    const CHECK: Check = Check::of_solvers("c", Measure::Own(|_| Ok(Vec::new()))).up_to(10.0, "1");

    #[test]
    fn a_limit_is_twice_the_deviation_rounded_up_to_two_digits() {
        for (deviation, expected) in [
            (1.5e-12, 3e-12),
            (1.51e-12, 3.1e-12),
            (4.99e-9, 1e-8),
            (5e-9, 1e-8),
            (7.0, 14.0),
            (7.3, 15.0),
            (1e-14, 2e-14),
            (5e-324, 2e-14),
        ] {
            assert_eq!(limit(deviation), expected, "{deviation:e}");
        }
    }

    #[test]
    fn rows_pass_by_the_limits_that_are_proposed_for_them_and_failing_rows_get_none() {
        let figure = |subject: &str, measured| Measurement::figure(subject, measured, 1, String::new());
        let measured = || {
            vec![
                figure("mine/rk \"4\"", 1.3e-9).claiming(Some(1.0)),
                figure("mine/order", 0.02).without_claim(),
                figure("mine/wrong", 1.0).claiming(Some(1e-9)),
                figure("mine/never", 0.0).claiming(Some(1.0)),
            ]
        };
        let none = Limits::parse("").unwrap();
        let table = proposed(&judge(&CHECK, measured(), &none), "a test").unwrap();
        let rows = judge(&CHECK, measured(), &Limits::parse(&table).unwrap());
        let statuses: Vec<Status> = rows.iter().map(|row| row.status).collect();
        assert_eq!(statuses, [Status::Pass, Status::Pass, Status::FailByClaim, Status::PassByClaim], "{table}");
        assert_eq!(rows[0].limit, Some(2.6e-9));
        assert!(!table.contains("never"), "{table}");
        assert_eq!(proposed(&rows[..2], "a test"), None, "rows with limits need no proposal");
    }
}
