//! These tests start the suite's program and look at what a script or a user sees: exit codes, standard output and the
//! files that it writes. The library's tests do not reach these.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;
use toss::Registry;

const CHECK: &str = "reference-cos-tilt";

fn validation() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation")
}

fn run(arguments: &[&str], validation: &Path, out: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(arguments)
        .args([Path::new("--validation"), validation, Path::new("--out"), out])
        .output()
        .expect("the program starts")
}

/// A folder without limits, baseline or records, so that a test can add its own.
fn empty_validation() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder")
}

#[test]
fn a_run_of_a_check_with_a_chart_writes_that_chart_beside_the_reports() {
    let out = tempfile::tempdir().unwrap();
    let output = run(&["run", "--only", "long-flight-error"], &validation(), out.path());
    assert_eq!(output.status.code(), Some(0));
    let chart = std::fs::read_to_string(out.path().join("long-flights.svg")).unwrap();
    assert!(chart.contains("quaternion/dopri5") && chart.contains("an error, no answer"));
    let report: Value =
        serde_json::from_str(&std::fs::read_to_string(out.path().join("report.json")).unwrap()).unwrap();
    assert!(report["records"]["long_flights"].as_array().unwrap().len() > 80);
    assert!(report["records"]["atlas"].is_null());
}

/// The number of subjects: every solver of the registry, each integrator with all of its schemes.
fn subjects() -> usize {
    Registry::standard().entries().iter().map(|entry| entry.schemes().len().max(1)).sum()
}

#[test]
fn a_passing_run_ends_with_0_and_writes_both_reports() {
    let out = tempfile::tempdir().unwrap();
    let output = run(&["run", "--only", CHECK, "--format", "json"], &validation(), out.path());
    assert_eq!(output.status.code(), Some(0));
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    let written: Value =
        serde_json::from_str(&std::fs::read_to_string(out.path().join("report.json")).unwrap()).unwrap();
    assert_eq!(printed, written);
    assert_eq!(printed["passed"], true);
    let rows = printed["rows"].as_array().unwrap();
    assert_eq!(rows.len(), subjects());
    for row in rows {
        for field in ["claim", "basis", "measured", "limit", "reserve", "worst_input", "replay"] {
            assert!(!row[field].is_null(), "{field} of {row}");
        }
        assert!(row["worst_input"].as_str().unwrap().contains("i1="), "{row}");
    }
    let junit = std::fs::read_to_string(out.path().join("junit.xml")).unwrap();
    assert!(junit.contains(&format!("tests=\"{}\"", subjects())) && junit.contains("failures=\"0\""));
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
    assert!(table.contains("repeat with: cargo xtask verify --replay \"i1="), "{table}");
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
        ["--replay", "i1=nonsense", "--verbose"],
        ["figure", "ladder", "--svg=x"],
    ] {
        let output = run(&arguments, &validation(), out.path());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }
    std::fs::write(folder.path().join("limits.toml"), "[c]\nreason = 'r'\nallowed = { s = -1.0 }").unwrap();
    let output = run(&["run", "--only", CHECK], folder.path(), out.path());
    assert_eq!(output.status.code(), Some(4));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("limits.toml") && message.contains("[c] s = -1"), "{message}");
    assert!(!out.path().join("report.json").exists());
}

/// A flight on which the precession turns back (α' = 0).
const LINE: &str = "i1=2 i3=1 rate=0.3,0.3,5 tilt=1 time=5";

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
    let output = run(&["--replay", "i1=nonsense"], &validation(), Path::new("unused"));
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("i1: 'nonsense' is no number"));
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
