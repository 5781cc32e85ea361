//! Reads a table of errors and costs, and refuses one that is not whole.

use dynamics::Error;

use super::{Fitted, IntegratorFit};

impl Fitted {
    /// Reads a table that was measured elsewhere, for [`Registry::measured`](crate::Registry::measured).
    ///
    /// # Errors
    /// [`Error::Text`] if the text is no such table: a field is missing, the bins do not increase, the tolerances do not
    /// decrease, a table has not one row for each bin, or a number is not finite and positive.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let fitted: Self = toml::from_str(text).map_err(|error: toml::de::Error| {
            Error::in_text(text, error.span().map(|span| span.start), error.message().to_owned())
        })?;
        fitted.complaint().map_or(Ok(fitted), |complaint| Err(Error::in_text(text, None, complaint)))
    }

    /// What is wrong with the table, if anything is.
    pub(super) fn complaint(&self) -> Option<String> {
        let increase =
            |ends: &[f64]| ends.windows(2).all(|pair| pair[0] < pair[1]) && ends.iter().all(|end| *end >= 0.0);
        let finer: Vec<f64> = self.tolerances.iter().rev().copied().collect();
        for (field, is_valid, valid) in [
            ("spins", !self.spins.is_empty() && increase(&self.spins), "at least one end of a bin, increasing from 0"),
            (
                "phases",
                !self.phases.is_empty() && increase(&self.phases) && self.phases[0] > 0.0,
                "at least one end of a bin, increasing and above 0",
            ),
            (
                "tolerances",
                finer.len() > 1 && increase(&finer) && finer[0] > 0.0,
                "at least two, decreasing to above 0",
            ),
        ] {
            if !is_valid {
                return Some(format!("{field}: must be {valid}"));
            }
        }
        self.integrators.iter().find(|fit| !self.has_shape_of(fit)).map(|fit| {
            let name = format!("{}/{}", fit.solver, fit.scheme);
            format!(
                "{name}: costs and tables must be finite and above 0, with a row for each spin, phase and tolerance"
            )
        })
    }

    fn has_shape_of(&self, fit: &IntegratorFit) -> bool {
        let is_cost = |value: f64| value.is_finite() && value > 0.0;
        let is_table = |table: &Vec<Vec<Vec<f64>>>| {
            table.len() == self.spins.len()
                && table.iter().all(|rows| rows.len() == self.phases.len())
                && table.iter().flatten().all(|row| row.len() == self.tolerances.len())
                && table.iter().flatten().flatten().all(|value| is_cost(*value))
        };
        // The cost of a flight without its calls may be too small to be seen.
        let costs = fit.cost_ns.is_finite() && fit.cost_ns >= 0.0 && is_cost(fit.call_ns);
        costs && [&fit.tilt_errors, &fit.errors, &fit.calls].into_iter().all(is_table)
    }
}
