//! This file turns measurements into rows, each with a verdict: it is the only place that decides whether something
//! passes. A measurement is compared with its limit or, if it has none, with what the solver's own error estimate
//! allows (its claim), so solvers from outside can be judged too.

use std::collections::BTreeMap;

use serde::Serialize;

use super::limits::Limits;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::effort::Effort;
use crate::measure::replay::{Commands, Replay};
use crate::measure::trial::{Claim, Measurement};
use crate::shown::shown;

/// A limit that is this many times above what was measured or more is reported as loose, because it would hide bugs.
const LOOSE: f64 = 10.0;

/// The verdict on a row.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Within its limit.
    Pass,
    /// Within its limit, but the limit is ten times what was measured or more.
    PassLoose,
    /// It has no limit, and is within the error that the solver claims.
    PassByClaim,
    /// It has no limit, and it is not an error, so no error estimate applies.
    NotJudged,
    /// Above its limit.
    Fail,
    /// It has no limit, and is above the error that the solver claims.
    FailByClaim,
    /// It has no limit, and the solver claims no error, or one so large that it says nothing.
    NoClaim,
    /// It has no limit, and does not belong to a solver.
    NoLimit,
    /// There is a limit for it, but it was not measured.
    #[default]
    NotMeasured,
}

impl Status {
    /// Whether the row passes.
    pub fn passes(self) -> bool {
        matches!(self, Self::Pass | Self::PassLoose | Self::PassByClaim | Self::NotJudged)
    }
}

/// A judged measurement, with everything that a report shows of it.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Row {
    /// The id of the check.
    pub check: String,
    /// The claim of the check.
    pub claim: String,
    /// The kind of evidence for the claim.
    pub basis: Option<Basis>,
    /// Whether the row judges a solver of the registry or this library; `None` if nothing was measured.
    pub judges: Option<Judges>,
    /// The subject that was measured.
    pub subject: String,
    /// Unit of `measured` and `limit`.
    pub unit: String,
    /// The deviation that was judged; `None` if the subject failed.
    pub measured: Option<f64>,
    /// The deviation that is allowed, by the limit or by the solver's claim.
    pub limit: Option<f64>,
    /// `limit / measured`; `None` where either is missing or zero.
    pub reserve: Option<f64>,
    /// The verdict.
    pub status: Status,
    /// Number of cases that were tried and judged.
    pub cases: u64,
    /// Number of further cases, which were not judged because there is no reference of them.
    pub without_reference: u64,
    /// Number of cases in which the subject failed instead of giving an answer.
    pub without_answer: u64,
    /// The input of the worst case, as the text of a toss or in words.
    pub worst_input: Option<String>,
    /// Why the subject failed on the worst case, if it did.
    pub failure: Option<String>,
    /// A command that repeats the worst case, or the whole check where there is none; `None` for what was not measured.
    pub replay: Option<String>,
    /// The largest deviation of all cases. `measured` is another one where a claim is judged, which allows each case a
    /// deviation of its own.
    #[serde(skip)]
    pub largest: Option<f64>,
}

/// A check that gave no row, and why, in words. A run that passes should say what it does not speak of.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// The id of the check.
    pub check: &'static str,
    /// The reason.
    pub why: &'static str,
}

/// What rows are judged by, and how their cases are repeated.
#[derive(Debug, Clone, Copy)]
pub struct Judge<'a> {
    /// The limits.
    pub limits: &'a Limits,
    /// How the program of the suite is started.
    pub commands: &'a Commands,
    /// With how many cases the checks were run, which a command that repeats a whole check says too.
    pub effort: Effort,
}

impl Judge<'_> {
    /// The command that does `replay` or, without one, the whole of `check`.
    pub fn command(self, check: &Check, replay: Option<&Replay>) -> String {
        replay.map_or_else(|| self.commands.check(check.id) + self.effort.flag(), |replay| self.commands.line(replay))
    }

    /// Judges the measurements of `check`.
    pub fn rows(self, check: &Check, measurements: Vec<Measurement>) -> Vec<Row> {
        measurements.into_iter().map(|measurement| row(check, measurement, self)).collect()
    }
}

impl Row {
    /// A row that says something of the suite itself, with nothing else in it.
    pub(super) fn of_the_suite(check: &str, claim: &str, subject: &str, status: Status) -> Self {
        Self { check: shown(check), claim: claim.to_owned(), subject: shown(subject), status, ..Self::default() }
    }

    /// What was measured, divided by the limit: above 1 for what is over its limit, 0 if nothing deviates or nothing is
    /// judged, infinite if the subject failed or if nothing at all is allowed.
    pub fn part(&self) -> f64 {
        match (self.measured, self.limit) {
            (Some(0.0), Some(_)) => 0.0,
            (Some(measured), Some(limit)) => measured / limit,
            _ if self.status.passes() => 0.0,
            _ => f64::INFINITY,
        }
    }
}

/// Judges the measurements of `check` by `limits`, with the commands of this workspace for a run of standard effort.
pub fn judge(check: &Check, measurements: Vec<Measurement>, limits: &Limits) -> Vec<Row> {
    Judge { limits, commands: &Commands::of_this_workspace(), effort: Effort::Standard }.rows(check, measurements)
}

fn by_limit(measured: f64, limit: f64) -> Status {
    match measured <= limit {
        true if limit >= LOOSE * measured && limit > 0.0 => Status::PassLoose,
        true => Status::Pass,
        false => Status::Fail,
    }
}

/// Neither a limit nor a claim can allow more than the ceiling. Where the ceiling is 0, a claim counts what is wrong, but
/// `measured` also what is undecided.
fn row(check: &Check, measurement: Measurement, judge: Judge<'_>) -> Row {
    let Measurement { subject, measured, cases, without_reference, without_answer, worst, claim, judges } = measurement;
    let (largest, ceiling) = (Some(measured).filter(|largest| largest.is_finite()), check.ceiling);
    let limit = judge.limits.get(check.id, &subject).map(|limit| limit.min(ceiling));
    let (measured, limit, worst, status) = match (limit, claim) {
        (Some(limit), _) => (measured, Some(limit), worst, by_limit(measured, limit)),
        (None, Claim::Allows { measured: by_claim, allowed, .. })
            if by_claim <= allowed && measured > ceiling && ceiling > 0.0 =>
        {
            (measured, Some(ceiling), worst, Status::FailByClaim)
        }
        (None, Claim::Allows { measured, allowed, worst }) => {
            let allowed = allowed.min(ceiling);
            let status = if measured <= allowed { Status::PassByClaim } else { Status::FailByClaim };
            (measured, Some(allowed), worst, status)
        }
        (None, Claim::Silent) => (measured, None, worst, Status::NotJudged),
        (None, Claim::NoEstimate) => (measured, None, worst, Status::NoClaim),
        (None, Claim::NoSolver) => (measured, None, worst, Status::NoLimit),
    };
    let worst = worst.map(|worst| (Some(shown(&worst.input)), worst.failure.as_deref().map(shown), worst.replay));
    let (worst_input, failure, replay) = worst.unwrap_or_default();
    // A toss that is flown again by itself is judged by the claim. What a limit decides, the whole check repeats.
    let by_limit = status == Status::Fail || limit == Some(ceiling);
    let replay = replay.filter(|replay| status.passes() || replay.row.is_some() || failure.is_some() || !by_limit);
    Row {
        check: check.id.to_owned(),
        claim: check.claim.to_owned(),
        basis: Some(check.basis),
        judges: Some(judges.unwrap_or(check.judges)),
        unit: check.unit.to_owned(),
        measured: measured.is_finite().then_some(measured),
        limit,
        reserve: limit.map(|limit| limit / measured).filter(|reserve| reserve.is_finite() && *reserve > 0.0),
        status,
        cases,
        without_reference,
        without_answer,
        worst_input,
        failure,
        replay: Some(judge.command(check, replay.as_ref())),
        largest,
        subject: shown(&subject),
    }
}

/// Checks that every row has a name of its own, because limits, baselines and reports know it by its check and subject
/// alone: of two rows of one name, one would be judged by the other's limit and lost in the baseline.
///
/// # Errors
/// If two rows have the same name; the error says where both come from.
pub fn require_distinct(rows: &[Row]) -> anyhow::Result<()> {
    let mut seen = BTreeMap::new();
    for row in rows {
        if let Some(first) = seen.insert((&row.check, &row.subject), row) {
            let from =
                |row: &Row| row.replay.clone().or(row.worst_input.clone()).unwrap_or_else(|| "nothing".to_owned());
            anyhow::bail!(
                "two rows are called '{} / {}': one from `{}`, the other from `{}`",
                row.check,
                row.subject,
                from(first),
                from(row)
            );
        }
    }
    Ok(())
}

/// A failing row for every limit that no row of a complete run used, because its check or its subject no longer exists.
/// `measures` says whether the run measures a subject under a check if both exist.
pub fn unused_limits(rows: &[Row], limits: &Limits, measures: impl Fn(&str, &str) -> bool) -> Vec<Row> {
    limits
        .pairs()
        .filter(|(check, subject)| measures(check, subject))
        .filter(|(check, subject)| !rows.iter().any(|row| row.check == *check && row.subject == *subject))
        .map(|(check, subject)| {
            let claim = "Every limit belongs to something that was measured; a limit for anything else fails.";
            Row { limit: limits.get(check, subject), ..Row::of_the_suite(check, claim, subject, Status::NotMeasured) }
        })
        .collect()
}

#[cfg(test)]
mod tests;
