//! Selects what a suite measures: its checks, and the limits that must belong to a row. A registry may hold any solvers,
//! so checks and limits of others are left out, and the report says which.

use anyhow::Context as _;
use toss::Registry;

use super::Suite;
use crate::CHECKS;
use crate::judge::LeftOut;
use crate::measure::check::{Check, Judges};

impl Suite {
    /// The checks that are run, and those that are left out because they judge the library.
    pub(super) fn checks(&self) -> anyhow::Result<(Vec<&'static Check>, Vec<LeftOut>)> {
        if let Some(id) = &self.only {
            return Ok((vec![named(id)?], Vec::new()));
        }
        let (run, left_out): (Vec<&Check>, Vec<&Check>) =
            CHECKS.iter().partition(|check| self.of_the_library || check.judges == Judges::Solver);
        let about_the_library =
            |check: &Check| LeftOut { check: check.id, why: "as they judge the library and not a solver" };
        Ok((run, left_out.into_iter().map(about_the_library).collect()))
    }

    /// Whether `subject` must have a row under `check`: not if the check was left out, nor if the subject is a solver of this
    /// workspace that is not in the registry. A name that nobody knows must have one, so that a
    /// misspelt limit is found.
    pub(super) fn measures(&self, run: &[&Check], check: &str, subject: &str) -> bool {
        let is_left_out = CHECKS.iter().any(|known| known.id == check) && !run.iter().any(|known| known.id == check);
        let solver = subject.split('/').next().unwrap_or(subject);
        let is_absent = Registry::standard().named(solver).is_ok() && self.registry.named(solver).is_err();
        !is_left_out && !is_absent
    }
}

pub(crate) fn named(id: &str) -> anyhow::Result<&'static Check> {
    let known = || CHECKS.iter().map(|check| check.id).collect::<Vec<_>>().join(", ");
    CHECKS.iter().find(|check| check.id == id).with_context(|| format!("no such check: '{id}'; known: {}", known()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_of_absent_solvers_and_of_checks_left_out_need_no_row_and_unknown_names_do() {
        let suite = Suite::new(Registry::standard().only(&["gamma"]).unwrap());
        let (run, left_out) = suite.checks().unwrap();
        assert!(left_out.iter().any(|left| left.check == "batch-cos-tilt"));
        for (check, subject, expected) in [
            ("random-cos-tilt", "gamma/dop853", true),
            ("random-cos-tilt", "euler/dop853", false),
            ("random-cos-tilt", "eulre/dop853", true),
            ("batch-cos-tilt", "corners", false),
            ("no-such-check", "gamma", true),
        ] {
            assert_eq!(suite.measures(&run, check, subject), expected, "{check} / {subject}");
        }
        let all = suite.with_library_checks();
        assert_eq!(all.checks().unwrap().1, []);
        assert!(all.only("nonsense").checks().unwrap_err().to_string().contains("no such check: 'nonsense'"));
    }
}
