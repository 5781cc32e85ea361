//! Judges how long a check took. A fault can make a check slow instead of wrong, and a check that never ends would hide
//! all rows that come after it.
//!
//! A check is judged by the time of the processor where the system tells it (Linux), because other programs don't add
//! to it, and elsewhere by the clock. Its limit is ten times what it takes usually, so that slower machines pass; for
//! emulators and very slow solvers the limits can be multiplied.

use serde::{Deserialize, Serialize};

use super::row::{Row, Status};
use crate::measure::effort::Effort;
use crate::shown::shown;

/// What a check may take, in multiples of what it takes usually.
const PATIENCE: f64 = 10.0;

/// A check is abandoned if it takes this many times its limit by the processor.
const ABANDONED_BY_PROCESSOR: f64 = 3.0;

/// A check is abandoned if it takes this many times its limit by the clock, also if it only waits.
const ABANDONED_BY_CLOCK: f64 = 10.0;

/// What a check takes that is not in [`USUAL_S`] (s).
const USUAL: f64 = 5.0;

/// What checks take with `--quick` on one core of 3 GHz (s), by the beginning of their ids, with the shared results
/// that the first of them computes.
const USUAL_S: [(&str, f64); 8] = [
    ("adversarial-", 6.0),
    ("atlas-", 24.0),
    ("fig4-", 6.0),
    ("interval-", 6.0),
    ("invariant-", 6.0),
    ("plan-", 6.0),
    ("random-", 6.0),
    ("work-", 24.0),
];

/// The time that a check took.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// The id of the check.
    pub check: String,
    /// By the clock (s).
    pub t_wall_s: f64,
    /// Of the processor, summed over all threads (s); `None` if the system doesn't tell.
    pub t_processor_s: Option<f64>,
    /// What it may take (s).
    pub limit_s: f64,
}

impl Timing {
    /// The time by which the check is judged (s).
    fn judged_s(&self) -> f64 {
        self.t_processor_s.unwrap_or(self.t_wall_s)
    }

    /// Whether the check, which still runs, has taken so long that no end can be expected.
    pub fn is_hopeless(&self) -> bool {
        self.judged_s() > ABANDONED_BY_PROCESSOR * self.limit_s && self.t_processor_s.is_some()
            || self.t_wall_s > ABANDONED_BY_CLOCK * self.limit_s
    }

    /// The failing row of a check that took longer than its limit; `None` if it did not.
    pub fn row(&self) -> Option<Row> {
        let (took, limit) = (self.judged_s(), self.limit_s);
        let failure = format!("took {took:.1} s, limit {limit:.0} s; --time-factor multiplies the limits");
        (took > limit).then(|| self.failing(&failure))
    }

    /// The failing row of a check that gave no measurement, for the reason `failure`.
    pub fn failing(&self, failure: &str) -> Row {
        let (took, limit) = (self.judged_s(), self.limit_s);
        let claim = "A check ends, and in less than ten times its usual time.";
        Row {
            unit: "s".to_owned(),
            measured: Some(took),
            limit: Some(limit),
            reserve: Some(limit / took).filter(|reserve| reserve.is_finite()),
            cases: 1,
            failure: Some(shown(failure)),
            ..Row::of_the_suite(&self.check, claim, "time", Status::Fail)
        }
    }
}

/// How long `check` may take at `effort` (s), with all limits multiplied by `factor`.
pub fn limit_s(check: &str, effort: Effort, factor: f64) -> f64 {
    let usual = USUAL_S.iter().find(|(start, _)| check.starts_with(start)).map_or(USUAL, |(_, usual)| *usual);
    factor * PATIENCE * effort.of([1.0, 5.0, 50.0]) * usual
}

#[cfg(test)]
mod tests {
    use super::*;

    fn timing(t_wall_s: f64, t_processor_s: Option<f64>) -> Timing {
        Timing { check: "first-flip".to_owned(), t_wall_s, t_processor_s, limit_s: 50.0 }
    }

    #[test]
    fn a_check_is_judged_by_the_time_of_the_processor_where_it_is_known() {
        assert_eq!(timing(400.0, Some(49.0)).row(), None, "other programs took the rest");
        let row = timing(30.0, Some(51.0)).row().unwrap();
        assert_eq!(row.failure.as_deref(), Some("took 51.0 s, limit 50 s; --time-factor multiplies the limits"));
        assert!(!row.status.passes() && row.part() > 1.0);
        assert!(timing(51.0, None).row().is_some());
    }

    #[test]
    fn a_check_that_computes_or_waits_for_ever_is_hopeless() {
        assert!(!timing(149.0, Some(149.0)).is_hopeless());
        assert!(timing(80.0, Some(151.0)).is_hopeless());
        assert!(!timing(499.0, Some(0.1)).is_hopeless() && timing(501.0, Some(0.1)).is_hopeless());
        assert!(!timing(499.0, None).is_hopeless() && timing(501.0, None).is_hopeless());
    }

    #[test]
    fn more_cases_may_take_longer_and_a_factor_multiplies_every_limit() {
        assert_eq!(limit_s("first-flip", Effort::Quick, 1.0), 50.0);
        assert_eq!(limit_s("first-flip", Effort::Standard, 3.0), 750.0);
        assert!(limit_s("atlas-answers", Effort::Quick, 1.0) > 200.0);
        for (start, _) in USUAL_S {
            assert!(crate::CHECKS.iter().any(|check| check.id.starts_with(start)), "no check begins with {start}");
        }
    }
}
