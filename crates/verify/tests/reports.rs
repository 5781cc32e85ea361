//! These tests run the suite's program as continuous integration does and read the files that other programs read:
//! JUnit, GitHub's annotations and summary, metrics.

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use toss::Registry;

const CHECK: &str = "reference-cos-tilt";

/// The number of subjects: every solver of the registry, each integrator with all of its schemes.
fn subjects() -> usize {
    Registry::standard().entries().iter().map(|entry| entry.schemes().len().max(1)).sum()
}

/// What a run left behind.
struct Ran {
    output: Output,
    out: tempfile::TempDir,
}

impl Ran {
    /// Runs the check in `format` with the lines of `baseline`, if any, as its baseline.
    fn new(format: &str, baseline: Option<&[&str]>, summary: &Path) -> Self {
        let (folder, out) = (tempfile::tempdir().expect("a folder"), tempfile::tempdir().expect("it is there"));
        if let Some(lines) = baseline {
            let path = verify::judge::baseline::file(&folder.path().join("baseline"), verify::Effort::Standard);
            std::fs::create_dir_all(path.parent().expect("it is there")).expect("it is there");
            std::fs::write(path, ["check,subject,error,calls", &lines.join("\n")].join("\n")).expect("it is there");
        }
        let output = Command::new(env!("CARGO_BIN_EXE_verify"))
            .args(["run", "--only", CHECK, "--format", format])
            .args([Path::new("--validation"), folder.path(), Path::new("--out"), out.path()])
            .env("GITHUB_STEP_SUMMARY", summary)
            .output()
            .expect("the program starts");
        Self { output, out }
    }

    fn stdout(&self) -> String {
        String::from_utf8(self.output.stdout.clone()).expect("it is there")
    }

    fn file(&self, name: &str) -> String {
        std::fs::read_to_string(self.out.path().join(name)).expect("it is there")
    }
}

/// A baseline as if the γ-ODE had been twice as accurate as it is, and the quaternion half as accurate.
const MOVED: [&str; 2] = ["reference-cos-tilt,gamma/dop853,1.5e-12,", "reference-cos-tilt,quaternion/dop853,8e-12,"];

#[test]
fn a_run_that_became_worse_ends_with_3_names_the_row_and_writes_a_junit_that_fails() {
    let ran = Ran::new("text", Some(&MOVED), Path::new(""));
    let (table, junit) = (ran.stdout(), ran.file("junit.xml"));
    assert_eq!(ran.output.status.code(), Some(3), "{table}");
    assert!(
        table.contains("WORSE than the baseline: 1\n  reference-cos-tilt / gamma/dop853: error 1.500e-12 → "),
        "{table}"
    );
    assert!(table.contains("Worse than the baseline: gamma, by dop853 alone, in one check ("), "{table}");
    assert_eq!(table.matches("    repeat with: cargo xtask verify --replay").count(), 1, "{table}");
    assert!(
        table.contains("better than the baseline; --bless takes it over: 1\n  reference-cos-tilt / quaternion/dop853")
    );
    assert!(table.contains(&format!("1 worse, 1 better, {} new, 0 gone.", subjects() - 2)), "{table}");
    assert!(ran.file("report.html").contains("1 worse, 1 better"));
    // The file is read as a consumer reads it: line by line is enough, since each element has a line of its own.
    assert!(junit.lines().nth(1).is_some_and(|line| line.contains("failures=\"1\"")), "{junit}");
    let suite = junit.split("<testsuite name=").find(|suite| suite.starts_with("\"worse than the baseline\""));
    let suite = suite.expect("a suite of what became worse");
    assert!(suite.contains("tests=\"1\"") && suite.contains("failures=\"1\""), "{suite}");
    assert!(suite.contains("<testcase name=\"gamma/dop853: error\""), "{suite}");
    assert!(suite.contains("<property name=\"accepted\" value=\"1.5e-12\"/>"), "{suite}");
    assert!(suite.contains("message=\"worse than the baseline: error 1.500e-12 → "), "{suite}");
    assert!(suite.contains("cargo xtask verify --replay &quot;i1="), "{suite}");
}

#[test]
fn every_case_of_a_junit_has_what_was_measured_its_limit_and_unit() {
    let ran = Ran::new("junit", None, Path::new(""));
    let junit = ran.stdout();
    assert_eq!(junit.trim_end(), ran.file("junit.xml").trim_end());
    assert!(!junit.contains("Some("), "{junit}");
    let cases = junit.matches("<testcase ").count();
    assert_eq!(cases, subjects());
    for property in ["measured", "limit", "unit", "judges"] {
        assert_eq!(junit.matches(&format!("<property name=\"{property}\"")).count(), cases, "{property}");
    }
    assert!(junit.lines().nth(2).is_some_and(|suite| suite.contains("time=\"")), "{junit}");
}

#[test]
fn github_gets_annotations_after_the_text_and_a_summary_that_is_appended() {
    let folder = tempfile::tempdir().unwrap();
    let summary = folder.path().join("summary");
    std::fs::write(&summary, "what another step wrote\n").unwrap();
    let ran = Ran::new("github", Some(&MOVED), &summary);
    let table = ran.stdout();
    let last = table.lines().last().unwrap();
    assert!(last.starts_with("::warning title=reference-cos-tilt / gamma/dop853::Worse than the baseline"), "{table}");
    assert!(last.contains("%0ARepeat with: cargo xtask verify --replay \"i1="), "{last}");
    assert!(table.contains(&format!("PASS: {0} of {0} rows pass", subjects())), "{table}");
    let text = std::fs::read_to_string(&summary).unwrap();
    assert_eq!(text, format!("what another step wrote\n{}", ran.file("summary.md")));
    assert!(text.contains("## ⚠️ WORSE than the baseline: ") && text.contains("### Worse than the baseline: 1"));
    assert_eq!(text.matches("| ✅ | reference-cos-tilt | ").count(), 1, "{text}");
    // Without the variable, there is a file all the same and no other one.
    let ran = Ran::new("github", None, Path::new(""));
    assert_eq!(ran.output.status.code(), Some(0));
    assert!(ran.file("summary.md").contains("There is no baseline yet"));
    assert!(!ran.stdout().contains("::warning"), "nothing is worse than no baseline");
}

#[test]
fn a_run_without_a_baseline_for_this_architecture_compares_nothing_and_says_so() {
    let ran = Ran::new("json", None, Path::new(""));
    let report: Value = serde_json::from_str(&ran.stdout()).unwrap();
    assert_eq!(report["moves"], Value::Array(Vec::new()));
    assert_eq!(report["baseline"]["found"], false);
    let file = report["baseline"]["file"].as_str().unwrap();
    assert!(file.ends_with(&format!("baseline/{}/standard.csv", std::env::consts::ARCH)), "{file}");
}

#[test]
fn the_metrics_are_in_the_formats_of_bencher_and_of_github_action_benchmark() {
    let ran = Ran::new("text", None, Path::new(""));
    let (bencher, list): (Value, Value) = (
        serde_json::from_str(&ran.file("metrics.json")).unwrap(),
        serde_json::from_str(&ran.file("github-action-benchmark.json")).unwrap(),
    );
    let error = bencher["reference-cos-tilt/gamma/dop853"]["error"]["value"].as_f64().unwrap();
    assert!(error > 0.0 && error < 1e-11);
    let entry = list.as_array().unwrap().iter().find(|entry| entry["name"] == "reference-cos-tilt / gamma/dop853");
    let entry = entry.expect("the row");
    assert_eq!((entry["value"].as_f64(), entry["unit"].as_str()), (Some(error), Some("1")));
    assert!(
        entry["extra"].as_str().unwrap().contains("reserve") && list.as_array().unwrap().len() == subjects(),
        "{list}"
    );
}

#[test]
fn a_check_that_does_not_end_fails_the_run_and_every_report() {
    let (folder, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let output = Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(["run", "--only", "long-flight-error", "--time-factor", "1e-6"])
        .args([Path::new("--validation"), folder.path(), Path::new("--out"), out.path()])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1));
    for file in ["report.json", "junit.xml", "report.html", "summary.md"] {
        let text = std::fs::read_to_string(out.path().join(file)).unwrap();
        assert!(text.contains("did not end within") && text.contains("the 0 checks after it were not run"), "{file}");
    }
    assert!(String::from_utf8(output.stdout).unwrap().contains("FAIL: 0 of 1 rows pass"));
}

#[test]
fn the_program_takes_the_options_of_the_workflow() {
    let page = include_str!("../../../docs/ci.md");
    let lines = page.lines().filter_map(|line| line.split_once("cargo run --release --locked -- "));
    let mut tried = 0;
    for (_, options) in lines {
        let (folder, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let output = Command::new(env!("CARGO_BIN_EXE_verify"))
            .arg("run")
            .args(options.split_whitespace())
            .args(["--only", "detest-b5"])
            .args([Path::new("--validation"), folder.path(), Path::new("--out"), out.path()])
            .env_remove("GITHUB_STEP_SUMMARY")
            .output()
            .unwrap();
        assert_eq!(output.status.code(), Some(0), "{options}: {}", String::from_utf8_lossy(&output.stderr));
        for file in ["junit.xml", "metrics.json", "github-action-benchmark.json", "report.json", "report.html"] {
            assert!(out.path().join(file).exists() && page.contains(file) || file == "report.html", "{file}");
        }
        tried += 1;
    }
    assert_eq!(tried, 2);
}
