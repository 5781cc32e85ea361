//! Proposes limits for rows that have none, by the rule of this workspace: twice the largest deviation, rounded up to
//! one digit. Whoever brings a solver starts from these numbers, instead of from the solver's claim, which is often far
//! above what the solver reaches.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::limits::ceiling;
use super::row::{Row, Status};

/// The limits for all rows that pass without one, within the ceilings of their checks, as the text of a file of limits;
/// `None` if there are no such rows. `run` says which run measured them, such as `a standard run on 2026-11-22`.
pub(crate) fn text(rows: &[Row], run: &str) -> Option<String> {
    let mut checks: BTreeMap<&str, Vec<(&str, f64)>> = BTreeMap::new();
    for row in rows.iter().filter(|row| matches!(row.status, Status::PassByClaim | Status::NotJudged)) {
        let ceiling = ceiling(&row.check);
        if let Some(largest) = row.largest.filter(|largest| largest.is_finite() && *largest <= ceiling) {
            checks.entry(&row.check).or_default().push((&row.subject, limit(largest).min(ceiling)));
        }
    }
    if checks.is_empty() {
        return None;
    }
    let mut text = format!(
        "# Proposed limits, in the unit of each check: twice the largest deviation of {run}, rounded up to one\n\
         # digit. Read them before you keep them: a limit should be what the solver is meant to reach. Rows that fail\n\
         # have no proposal.\n"
    );
    for (check, limits) in checks {
        let _ = write!(text, "\n[{check}]\nreason = \"Twice the largest deviation of {run}.\"\n[{check}.allowed]\n");
        for (subject, limit) in limits {
            let _ = writeln!(text, "{} = {limit:e}", toml::Value::from(subject));
        }
    }
    Some(text)
}

/// Twice `deviation`, rounded up to one digit.
fn limit(deviation: f64) -> f64 {
    let twice = 2.0 * deviation;
    let (digits, exponent) = format!("{twice:e}").split_once('e').map_or((0.0, 0), |(digits, exponent)| {
        (digits.parse::<f64>().unwrap_or(0.0), exponent.parse::<i32>().unwrap_or(0))
    });
    // Digits and exponent are read as one decimal number, so that 3e-12 is the same f64 as in the file.
    format!("{}e{exponent}", digits.ceil()).parse().unwrap_or(f64::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::judge;
    use crate::judge::limits::Limits;
    use crate::measure::check::{Check, Measure};
    use crate::measure::trial::Measurement;

    const CHECK: Check = Check::of_solvers("c", Measure::Own(|_| Ok(Vec::new()))).up_to(10.0, "1");

    #[test]
    fn a_limit_is_twice_the_deviation_rounded_up_to_one_digit() {
        for (deviation, expected) in
            [(1.5e-12, 3e-12), (1.51e-12, 4e-12), (4.9e-9, 1e-8), (5e-9, 1e-8), (0.0, 0.0), (7.0, 20.0)]
        {
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
            ]
        };
        let none = Limits::parse("").unwrap();
        let proposed = text(&judge(&CHECK, measured(), &none), "a test").unwrap();
        let rows = judge(&CHECK, measured(), &Limits::parse(&proposed).unwrap());
        let statuses: Vec<Status> = rows.iter().map(|row| row.status).collect();
        assert_eq!(statuses, [Status::Pass, Status::Pass, Status::FailByClaim], "{proposed}");
        assert_eq!(rows[0].limit, Some(3e-9));
        assert_eq!(text(&rows[..2], "a test"), None, "rows with limits need no proposal");
    }
}
