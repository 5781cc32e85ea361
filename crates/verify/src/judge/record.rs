//! A record is what a run found on a certain day, together with the machine that ran it. Records are committed, so that
//! accuracy and speed can be followed over time.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, anyhow, ensure};

use super::baseline::Baseline;
use crate::files;
use crate::host::Host;
use crate::measure::work_precision::{Sample, Sweep};

/// Name of the file with a record's samples, one on each line.
const SAMPLES: &str = "work-precision.jsonl";

/// One committed record.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// The machine, the commit and the day.
    pub host: Host,
    /// The errors and calls by check and subject.
    pub accuracy: Baseline,
}

/// Writes the record of a run into `folder`/DATE.
pub fn write(folder: &Path, host: &Host, accuracy: &Baseline, sweep: &Sweep) -> anyhow::Result<()> {
    let folder = folder.join(&host.date);
    let lines: Result<Vec<String>, _> = sweep.samples.iter().map(serde_json::to_string).collect();
    files::write(&folder.join(SAMPLES), &(lines?.join("\n") + "\n"))?;
    files::write(&folder.join("accuracy.csv"), &accuracy.csv()?)?;
    files::write(&folder.join("host.json"), &(serde_json::to_string_pretty(host)? + "\n"))
}

/// Reads the records in `folder`, ordered by date; none if there is no such folder.
///
/// # Errors
/// If one can't be read, or has no accuracy that can be trusted.
pub fn read(folder: &Path) -> anyhow::Result<Vec<Record>> {
    let failed = || format!("cannot read {}", folder.display());
    let entries = match std::fs::read_dir(folder) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.with_context(failed)?,
    };
    let mut dates: Vec<_> = entries.collect::<Result<_, _>>().with_context(failed)?;
    dates.sort_by_key(std::fs::DirEntry::file_name);
    let record = |folder: &Path| {
        let (path, accuracy) = (folder.join("host.json"), folder.join("accuracy.csv"));
        let host = Host::parse(&files::read(&path)?).with_context(|| format!("cannot read {}", path.display()))?;
        let missing = || format!("cannot read {}: there is no such file", accuracy.display());
        let accuracy = Baseline::read(&accuracy)?.with_context(missing)?;
        Ok(Record { host, accuracy })
    };
    dates.iter().filter(|entry| entry.path().is_dir()).map(|entry| record(&entry.path())).collect()
}

/// Reads the samples of the record in `folder`/`date`.
///
/// # Errors
/// If they can't be read, as [`parse_samples`] says.
pub fn samples(folder: &Path, date: &str) -> anyhow::Result<Vec<Sample>> {
    let path = folder.join(date).join(SAMPLES);
    parse_samples(&files::read(&path)?).with_context(|| format!("cannot read {}", path.display()))
}

/// The samples that the lines of `text` describe, each as JSON. Blank lines do not count.
///
/// # Errors
/// If a line is no sample, a number in it is negative, two samples are of the same run, or there is none. The error begins
/// with the line.
pub fn parse_samples(text: &str) -> anyhow::Result<Vec<Sample>> {
    let (mut samples, mut lines) = (Vec::new(), BTreeMap::new());
    for (number, line) in (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty()) {
        let sample: Sample = serde_json::from_str(line).map_err(|error| {
            let place = format!(" at line {} column {}", error.line(), error.column());
            anyhow!("line {number}, column {}: {}", error.column(), error.to_string().replace(&place, ""))
        })?;
        if let Some((field, value)) = sample.first_negative() {
            anyhow::bail!("line {number}: {field} = {value:e}: expected a number from 0");
        }
        let settings = [sample.tol, sample.step].map(|setting| setting.map(f64::to_bits));
        let run = (sample.problem.clone(), sample.subject(), settings);
        if let Some(first) = lines.insert(run, number) {
            let (problem, subject) = (&sample.problem, sample.subject());
            anyhow::bail!(
                "line {number}: {subject} on {problem} is there twice by these settings, first in line {first}"
            );
        }
        samples.push(sample);
    }
    ensure!(!samples.is_empty(), "there is no sample");
    Ok(samples)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_that_cannot_be_trusted_are_refused_with_their_line() {
        let line =
            include_str!("../../../../validation/record/2026-11-22/work-precision.jsonl").lines().next().unwrap();
        assert_eq!(parse_samples(&format!("\r\n{line}\r\n")).unwrap().len(), 1);
        let negative = line.replace("\"err_cos_theta\":", "\"err_cos_theta\":-");
        for (text, error) in [
            (
                format!("{line}\n\n{line}\n"),
                "line 3: exact on cheated is there twice by these settings, first in line 1",
            ),
            (format!("\n{negative}\n"), "line 2: err_cos_theta = -3.26"),
            (format!("{line}\n{{\"problem\":NaN}}"), "line 2, column "),
            (format!("{line}\n{}", line.replace("\"step\"", "\"steps\"")), "line 2, column "),
            (line.replace("\"status\"", "\"tol\":1,\"status\""), "line 1, column "),
            (" \n".to_owned(), "there is no sample"),
        ] {
            let found = parse_samples(&text).unwrap_err().to_string();
            assert!(found.starts_with(error) && !found.contains(" at line "), "{found}");
        }
    }
}
