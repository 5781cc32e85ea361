//! Records of contests, one folder a day, as the verification suite keeps its own.

use std::path::{Path, PathBuf};

use anyhow::Context as _;
use verify::files;
use verify::judge::record::parse_samples;
use verify::measure::work_precision::Sample;

use crate::contest::Contest;

const CONTEST: &str = "contest.json";
const SAMPLES: &str = "work-precision.jsonl";

/// Writes a record into the folder of its day.
///
/// # Errors
/// If a file can't be written.
pub fn write(folder: &Path, contest: &Contest, samples: &[Sample]) -> anyhow::Result<()> {
    let folder = folder.join(&contest.host.date);
    let lines: Result<Vec<String>, _> = samples.iter().map(serde_json::to_string).collect();
    files::write(&folder.join(SAMPLES), &(lines?.join("\n") + "\n"))?;
    files::write(&folder.join(CONTEST), &(serde_json::to_string_pretty(contest)? + "\n"))
}

/// The newest record; `None` if there is none.
///
/// # Errors
/// If it can't be read.
pub fn newest(folder: &Path) -> anyhow::Result<Option<(Contest, Vec<Sample>)>> {
    let days = std::fs::read_dir(folder).into_iter().flatten().flatten().map(|day| day.path());
    let Some(day) = days.filter(|day| day.join(CONTEST).exists()).max() else { return Ok(None) };
    let read = |path: PathBuf| files::read(&path).with_context(|| format!("in {}", path.display()));
    let contest = serde_json::from_str(&read(day.join(CONTEST))?).with_context(|| format!("in {}", day.display()))?;
    let samples = parse_samples(&read(day.join(SAMPLES))?).with_context(|| format!("in {}", day.display()))?;
    Ok(Some((contest, samples)))
}
