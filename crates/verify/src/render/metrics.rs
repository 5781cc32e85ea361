//! Renders errors and calls in the formats of two services that follow numbers over time, which take accuracy as any
//! other number: Bencher and github-action-benchmark.

use std::collections::BTreeMap;

use serde::Serialize;

use super::Report;
use super::words::{comparison, reserve};
use crate::judge::baseline::Entry;

/// Errors and calls by check and subject, in Bencher's metric format:
/// `{"check/subject": {"error": {"value": 1e-12}, "calls": {"value": 900}}}`. See
/// <https://bencher.dev/docs/reference/bencher-metric-format>. A row that gave no number is left out.
pub(crate) fn bencher(report: &Report) -> anyhow::Result<String> {
    let mut metrics: BTreeMap<String, BTreeMap<&str, Metric>> = BTreeMap::new();
    for (check, subject, Entry { error, calls }) in report.metrics() {
        let entry = metrics.entry(format!("{check}/{subject}")).or_default();
        entry.insert("error", Metric { value: error });
        entry.extend(calls.map(|calls| ("calls", Metric { value: calls as f64 })));
    }
    Ok(serde_json::to_string_pretty(&metrics)? + "\n")
}

#[derive(Serialize)]
struct Metric {
    value: f64,
}

/// The same as a list of `{"name", "unit", "value", "extra"}`, which github-action-benchmark reads by its tool
/// `customSmallerIsBetter`. See <https://github.com/benchmark-action/github-action-benchmark>.
pub(crate) fn smaller_is_better(report: &Report) -> anyhow::Result<String> {
    let mut metrics = Vec::new();
    for (check, subject, Entry { error, calls }) in report.metrics() {
        let row = report.rows.iter().find(|row| row.check == check && row.subject == subject);
        let extra = row.map_or_else(String::new, |row| {
            format!("{} ({})\n{}", comparison(row), reserve(row), row.replay.as_deref().unwrap_or_default())
        });
        let name = format!("{check} / {subject}");
        // The error of a problem of speed and accuracy is an angle.
        let unit = row.map_or("rad", |row| row.unit.as_str()).to_owned();
        if let Some(calls) = calls {
            let (name, unit) = (format!("{name}: calls"), "calls".to_owned());
            metrics.push(Named { name, unit, value: calls as f64, extra: String::new() });
        }
        metrics.push(Named { name, unit, value: error, extra });
    }
    Ok(serde_json::to_string_pretty(&metrics)? + "\n")
}

#[derive(Serialize)]
struct Named {
    name: String,
    unit: String,
    value: f64,
    extra: String,
}
