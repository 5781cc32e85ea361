//! These tests start the suite's program and look at what a script, a user or continuous integration sees: exit codes,
//! standard output and the files that it writes. The library's tests do not reach these.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use toss::Registry;

const CHECK: &str = "reference-cos-tilt";

fn validation() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation")
}

fn run(arguments: &[&str], validation: &Path, out: &Path) -> Output {
    run_with_summary(arguments, validation, out, Path::new(""))
}

fn run_with_summary(arguments: &[&str], validation: &Path, out: &Path, summary: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(arguments)
        .args([Path::new("--validation"), validation, Path::new("--out"), out])
        .env("GITHUB_STEP_SUMMARY", summary)
        .output()
        .expect("the program starts")
}

/// What a run left behind.
struct Ran {
    code: Option<i32>,
    stdout: String,
    out: tempfile::TempDir,
}

impl Ran {
    /// Runs the check in `format` with the lines of `baseline`, if any, as its baseline.
    fn new(format: &str, baseline: Option<&[&str]>, summary: &Path) -> Self {
        let (folder, out) = (empty_validation(), tempfile::tempdir().expect("a folder"));
        if let Some(lines) = baseline {
            let path = verify::judge::baseline::file(&folder.path().join("baseline"), verify::Effort::Standard);
            std::fs::create_dir_all(path.parent().expect("it is there")).expect("it is there");
            std::fs::write(path, ["check,subject,error,calls", &lines.join("\n")].join("\n")).expect("it is there");
        }
        let arguments = ["run", "--only", CHECK, "--format", format];
        let output = run_with_summary(&arguments, folder.path(), out.path(), summary);
        Self { code: output.status.code(), stdout: String::from_utf8(output.stdout).expect("text"), out }
    }

    fn file(&self, name: &str) -> String {
        std::fs::read_to_string(self.out.path().join(name)).expect("it is there")
    }
}

/// A folder without limits, baseline or records, so that a test can add its own.
fn empty_validation() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

#[test]
fn a_run_of_a_check_with_a_chart_writes_that_chart_beside_the_reports() {
    let out = tempfile::tempdir().unwrap();
    let output = run(&["run", "--quick", "--only", "convergence-order"], &validation(), out.path());
    assert_eq!(output.status.code(), Some(0));
    let chart = std::fs::read_to_string(out.path().join("order.svg")).unwrap();
    assert!(chart.contains("quaternion/dopri5"));
    let report: Value =
        serde_json::from_str(&std::fs::read_to_string(out.path().join("report.json")).unwrap()).unwrap();
    assert!(report["records"]["convergence"].as_array().unwrap().len() > 5);
    assert!(report["records"]["atlas"].is_null());
}

#[test]
fn a_baseline_that_cannot_be_trusted_ends_the_run_with_4_before_it_begins_and_is_not_written() {
    let heading = "check,subject,error,calls";
    for (lines, error) in [
        ("x,y,NaN,", "line 2: error = 'NaN': expected a finite number from 0"),
        ("x,y,1,\r\n\r\nx, y,2,", "line 4: x, y is there twice, first in line 2"),
        ("x,y,1,\nx,z,1,1.5", "line 3: calls = '1.5': expected a whole number from 0, or nothing"),
        ("", "there is no row"),
    ] {
        for blessing in [&["--only", CHECK][..], &["--bless", "--time-factor", "1e-9"]] {
            let (folder, out) = (empty_validation(), tempfile::tempdir().unwrap());
            let path = verify::judge::baseline::file(&folder.path().join("baseline"), verify::Effort::Quick);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(&path, format!("{heading}\n{lines}\n")).unwrap();
            let output = run(&[&["--quick"], blessing].concat(), folder.path(), out.path());
            let said = String::from_utf8(output.stderr).unwrap();
            assert!(output.status.code() == Some(4) && said.contains(error) && said.contains("quick.csv"), "{said}");
            assert_eq!(said.lines().count(), 1, "{said}");
            assert_eq!(std::fs::read_to_string(&path).unwrap(), format!("{heading}\n{lines}\n"));
        }
    }
}

/// The number of subjects: every solver of the registry, each integrator with all of its schemes.
fn subjects() -> usize {
    Registry::standard().entries().iter().map(|entry| entry.schemes().len().max(1)).sum()
}

#[test]
fn a_passing_run_ends_with_0_writes_every_report_and_compares_nothing_without_a_baseline() {
    let ran = Ran::new("json", None, Path::new(""));
    assert_eq!(ran.code, Some(0));
    let report: Value = serde_json::from_str(&ran.stdout).unwrap();
    assert_eq!(report, serde_json::from_str::<Value>(&ran.file("report.json")).unwrap());
    assert_eq!(report["passed"], true);
    let rows = report["rows"].as_array().unwrap();
    assert_eq!(rows.len(), subjects());
    for row in rows {
        for field in ["claim", "basis", "measured", "limit", "reserve", "worst_input", "replay"] {
            assert!(!row[field].is_null(), "{field} of {row}");
        }
        assert!(row["worst_input"].as_str().unwrap().contains("moments="), "{row}");
    }
    assert_eq!((&report["moves"], &report["baseline"]["found"]), (&Value::Array(Vec::new()), &Value::Bool(false)));
    let file = report["baseline"]["file"].as_str().unwrap();
    assert!(file.ends_with(&format!("baseline/{}/standard.csv", std::env::consts::ARCH)), "{file}");
    let junit = ran.file("junit.xml");
    assert!(junit.contains("failures=\"0\"") && !junit.contains("Some("), "{junit}");
    assert_eq!(junit.matches("<testcase ").count(), subjects());
    for property in ["measured", "limit", "unit", "judges"] {
        assert_eq!(junit.matches(&format!("<property name=\"{property}\"")).count(), subjects(), "{property}");
    }
    assert!(junit.lines().nth(2).is_some_and(|suite| suite.contains("time=\"")), "{junit}");
    let ran = Ran::new("junit", None, Path::new(""));
    assert_eq!(ran.stdout.trim_end(), ran.file("junit.xml").trim_end());
}

#[test]
fn a_row_above_its_limit_ends_the_run_with_1_and_is_printed_with_a_command_that_repeats_it() {
    let (folder, out) = (empty_validation(), tempfile::tempdir().unwrap());
    let tightened = format!("[{CHECK}]\nreason = 'a test'\nallowed = {{ exact = 1e-20 }}");
    std::fs::write(folder.path().join("limits.toml"), tightened).unwrap();
    let output = run(&["run", "--only", CHECK], folder.path(), out.path());
    assert_eq!(output.status.code(), Some(1));
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(table.contains("> 1.0e-20") && table.contains(" times over"), "{table}");
    assert!(
        table.contains("FAIL: reference-cos-tilt / exact")
            && table.contains(&format!("FAIL: {} of {} rows pass", subjects() - 1, subjects())),
        "{table}"
    );
    // By itself the toss of the worst case would be within what the solver claims.
    assert!(table.contains("repeat with: cargo xtask verify --only reference-cos-tilt\n"), "{table}");
    let pattern = "Fails: exact, in one check (reference-cos-tilt). Passes: euler, gamma, quaternion.";
    assert!(table.contains(pattern), "{table}");
    for file in ["report.html", "report.json", "summary.md"] {
        assert!(std::fs::read_to_string(out.path().join(file)).unwrap().contains(pattern), "{file}");
    }
    let junit = std::fs::read_to_string(out.path().join("junit.xml")).unwrap();
    assert!(junit.contains("failures=\"1\"") && !junit.contains("Some("), "{junit}");
}

#[test]
fn a_run_prints_one_line_per_check_and_with_verbose_one_per_row() {
    let lines = |arguments: &[&str], wanted: fn(&str) -> bool| {
        let out = tempfile::tempdir().unwrap();
        let output = run(arguments, &validation(), out.path());
        let table = String::from_utf8(output.stdout).unwrap();
        let shown = String::from_utf8(output.stderr).unwrap();
        assert!(
            shown.contains(" s ") && shown.ends_with(&format!("{} rows  ok\n", subjects())),
            "what has ended, for who waits: {shown}"
        );
        table.lines().filter(|line| wanted(line)).count()
    };
    assert_eq!(lines(&["run", "--only", CHECK], |line| line.starts_with(CHECK)), 1);
    assert_eq!(
        lines(&["--only", CHECK], |line| line.starts_with(CHECK)),
        1,
        "to run is what it does without a command"
    );
    assert_eq!(lines(&["run", "--only", CHECK, "--verbose"], |line| line.contains(" cases ")), subjects());
}

/// A baseline as if the γ-ODE had been twice as accurate as it is, and the quaternion half as accurate.
const MOVED: [&str; 2] = ["reference-cos-tilt,gamma/dop853,1.5e-12,", "reference-cos-tilt,quaternion/dop853,8e-12,"];

#[test]
fn a_run_that_became_worse_ends_with_3_names_the_row_and_writes_a_junit_that_fails() {
    let ran = Ran::new("text", Some(&MOVED), Path::new(""));
    let (table, junit) = (&ran.stdout, ran.file("junit.xml"));
    assert_eq!(ran.code, Some(3), "{table}");
    assert!(
        table.contains("WORSE than the baseline: 1\n  reference-cos-tilt / gamma/dop853: error 1.500e-12 → "),
        "{table}"
    );
    assert!(table.contains("Worse than the baseline: gamma, by dop853, in one check ("), "{table}");
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
    assert!(suite.contains("cargo xtask verify --replay &quot;moments="), "{suite}");
}

#[test]
fn github_gets_annotations_after_the_text_and_a_summary_that_is_appended() {
    let folder = tempfile::tempdir().unwrap();
    let summary = folder.path().join("summary");
    std::fs::write(&summary, "what another step wrote\n").unwrap();
    let ran = Ran::new("github", Some(&MOVED), &summary);
    let table = &ran.stdout;
    let last = table.lines().last().unwrap();
    assert!(last.starts_with("::warning title=reference-cos-tilt / gamma/dop853::Worse than the baseline"), "{table}");
    assert!(last.contains("%0ARepeat with: cargo xtask verify --replay \"moments="), "{last}");
    assert!(table.contains(&format!("PASS: {0} of {0} rows pass", subjects())), "{table}");
    let text = std::fs::read_to_string(&summary).unwrap();
    assert_eq!(text, format!("what another step wrote\n{}", ran.file("summary.md")));
    assert!(text.contains("## ⚠️ WORSE than the baseline: "), "{text}");
    assert!(text.contains("\n    WORSE than the baseline: 1\n      reference-cos-tilt / gamma/dop853: "), "{text}");
    assert!(text.contains("repeat with: cargo xtask verify --replay \"moments="), "{text}");
    assert!(text.contains("Worse than the baseline: gamma, by dop853"), "the pattern: {text}");
    // Without the variable, there is a file all the same and no other one.
    let ran = Ran::new("github", None, Path::new(""));
    assert_eq!(ran.code, Some(0));
    assert!(ran.file("summary.md").contains("There is no baseline yet"));
    assert!(!ran.stdout.contains("::warning"), "nothing is worse than no baseline");
}

#[test]
fn a_check_that_does_not_end_fails_the_run_and_every_report() {
    let (folder, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let arguments = ["run", "--only", "atlas-answers", "--time-factor", "1e-6"];
    let output = run(&arguments, folder.path(), out.path());
    assert_eq!(output.status.code(), Some(1));
    for file in ["report.json", "junit.xml", "report.html", "summary.md"] {
        let text = std::fs::read_to_string(out.path().join(file)).unwrap();
        assert!(text.contains("did not end within") && text.contains("the 0 checks after it were not run"), "{file}");
    }
    assert!(String::from_utf8(output.stdout).unwrap().contains("FAIL: 0 of 1 rows pass"));
}

#[test]
fn history_needs_records_and_says_how_to_make_one() {
    let (folder, out) = (empty_validation(), tempfile::tempdir().unwrap());
    std::fs::create_dir(folder.path().join("record")).unwrap();
    let output = run(&["history"], folder.path(), out.path());
    assert_eq!(output.status.code(), Some(4));
    assert!(String::from_utf8(output.stderr).unwrap().contains("--bless"));
    let output = run(&["history"], &validation(), out.path());
    assert_eq!(output.status.code(), Some(0));
    assert!(out.path().join("history.svg").exists());
}

#[test]
fn figures_are_drawn_from_committed_data() {
    let (folder, out) = (empty_validation(), tempfile::tempdir().unwrap());
    let path = out.path().join("figure.svg");
    let draw = |figure, validation: &Path| {
        run(&["figure", figure, "--svg", path.to_str().unwrap()], validation, out.path()).status.code()
    };
    assert_eq!(draw("atlas-matrix", folder.path()), Some(0));
    let matrix = std::fs::read_to_string(&path).unwrap();
    assert!(matrix.contains("gamma/dop853/raw") && matrix.contains("WRONG") && matrix.contains("right or error"));
    assert_eq!(draw("work-precision", folder.path()), Some(4), "there are no records");
    assert_eq!(draw("work-precision", &validation()), Some(0));
    assert!(std::fs::read_to_string(&path).unwrap().contains("quaternion/taylor"));
    assert_eq!(draw("proven-error", folder.path()), Some(0));
    let proven = std::fs::read_to_string(&path).unwrap();
    assert_eq!(proven.matches("proven bound").count(), 2, "one for each panel");
}

#[test]
fn bad_usage_ends_with_2_and_unreadable_limits_end_with_4() {
    let (folder, out) = (empty_validation(), tempfile::tempdir().unwrap());
    for arguments in [
        ["run", "--only", "nonsense"],
        ["run", "--quick", "--deep"],
        ["--list", "--quick", "--verbose"],
        ["--list", "--format", "json"],
        ["--list", "--command", "a"],
        ["--replay", LINE, "--verbose"],
        ["run", "--claim", "1e-9"],
        ["run", "--format", "yaml"],
        ["run", "--format=json", "--verbose"],
        ["run", "--bless", "--only=rounding"],
        ["run", "--time-factor", "0"],
        ["bench", "--bless", "--bless"],
        ["bench", "--instructions", "--to=1e-6"],
        ["--replay", "moments=nonsense", "--verbose"],
        ["figure", "ladder", "--svg=x"],
    ] {
        let output = run(&arguments, &validation(), out.path());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty() && !output.stderr.contains(&b'\x1b'), "{arguments:?}");
    }
    let output = run(&["--only", CHECK], Path::new("/no/such\u{1b}[31m folder"), out.path());
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && said.contains("u{1b}[31m folder' for '--validation"), "{said}");
    std::fs::write(folder.path().join("limits.toml"), "[c]\nreason = 'r'\nallowed = { s = -1.0 }").unwrap();
    let output = run(&["run", "--only", CHECK], folder.path(), out.path());
    assert_eq!(output.status.code(), Some(4));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("limits.toml") && message.contains("[c] s = -1"), "{message}");
    assert!(!out.path().join("report.json").exists());
}

/// A flight on which the precession turns back (α' = 0).
const LINE: &str = "moments=2,1 rate=0.3,0.3,5 tilt=1 time=5";

#[test]
fn a_worst_input_is_replayed_by_every_contestant() {
    let output = run(&["--replay", LINE], &validation(), Path::new("unused"));
    assert_eq!(output.status.code(), Some(0));
    let table = String::from_utf8(output.stdout).unwrap();
    let answer = |subject: &str| {
        let line = table.lines().find(|line| line.split_whitespace().next() == Some(subject)).unwrap();
        line[subject.len()..].trim_start().split("  ").next().unwrap().to_owned()
    };
    assert_eq!(answer("gamma/dop853"), "right");
    assert_eq!(answer("gamma/dop853/vertical"), "typed error");
    assert_eq!(answer("gamma/dop853/raw"), "silently wrong");
    assert!(table.contains("certified-"), "{table}");
    let output = run(&["--replay", LINE, "--command", "cat"], &validation(), Path::new("unused"));
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(table.starts_with("command/own") && !table.contains("certified-"), "{table}");
    let as_row = |row| {
        let output = run(&["--replay", LINE, "--row", row], &validation(), Path::new("unused"));
        (output.status.code(), String::from_utf8(output.stdout).unwrap())
    };
    for (row, unit) in [("last-bit-attitude / phases to 1e2", "rad"), ("random-cos-tilt / gamma/dop853", "1")] {
        let (code, text) = as_row(row);
        assert_eq!(code, Some(0), "{text}");
        assert!(text.starts_with(&format!("{row}\nmeasured ")), "{text}");
        assert!(text.contains(&format!(" {unit}, limit ")) && text.contains("\npass"), "{text}");
    }
    assert_eq!(as_row("grid-counts / grid").0, Some(4), "of many launches");
    let output = run(&["--replay", "moments=nonsense"], &validation(), Path::new("unused"));
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("moments = 'nonsense' can't be used"));
}

#[test]
fn list_prints_one_line_for_every_check() {
    let output = run(&["--list"], &validation(), Path::new("unused"));
    assert_eq!(output.status.code(), Some(0));
    let list = String::from_utf8(output.stdout).unwrap();
    assert!(verify::CHECKS.iter().all(|check| list.contains(check.id) && list.contains(check.claim)));
    assert_eq!(list.lines().count(), verify::CHECKS.len());
}

/// The device is inherited as an open stream, so that no program could replace it.
#[cfg(unix)]
#[test]
fn full_outputs_end_with_their_codes_and_without_a_panic() {
    let full = || std::fs::OpenOptions::new().write(true).open("/dev/full").expect("a full device");
    let program = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_verify"));
        command.args(arguments);
        command
    };
    for arguments in [["--list"], ["--help"]] {
        let output = program(&arguments).stdout(full()).output().unwrap();
        assert_eq!(output.status.code(), Some(4), "{arguments:?}");
        assert!(String::from_utf8_lossy(&output.stderr).contains("cannot write standard output"));
    }
    assert_eq!(program(&["nonsense"]).stderr(full()).output().unwrap().status.code(), Some(2));
    assert_eq!(program(&["--list"]).stdout(full()).stderr(full()).output().unwrap().status.code(), Some(4));
}
