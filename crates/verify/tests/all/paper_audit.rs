//! These tests keep docs/paper-audit.md true: the checks and tests that it names must exist, and its table of failures
//! must be that of the atlas. Otherwise the document would become outdated without notice.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

const AUDIT: &str = include_str!("../../../../docs/paper-audit.md");

/// The commands of the document that begin with `prefix`, with the prefix removed.
fn commands(prefix: &str) -> Vec<&'static str> {
    let spans = AUDIT.split('`').filter_map(|span| span.strip_prefix(prefix));
    let commands: Vec<&str> = spans.collect();
    assert_eq!(commands.len(), AUDIT.matches(prefix.trim_end()).count(), "{prefix} in a span and on a line");
    commands
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

#[test]
fn every_check_that_the_audit_names_exists() {
    for id in commands("cargo xtask verify --only ") {
        assert!(verify::CHECKS.iter().any(|check| check.id == id), "no check {id}");
    }
}

#[test]
fn every_test_that_the_audit_names_is_in_the_named_crate() {
    for command in commands("cargo test --release -p ") {
        let (package, name) = command.split_once(' ').unwrap();
        let folder = if package == "blackbox" { "tests".to_owned() } else { format!("crates/{package}") };
        assert!(defines(&root().join(folder), &format!("fn {name}(")), "{command}");
    }
}

/// Whether a source file in `folder` contains the text `function`.
fn defines(folder: &Path, function: &str) -> bool {
    std::fs::read_dir(folder).expect("a crate's folder").any(|entry| {
        let path = entry.expect("an entry").path();
        let is_source = path.extension().is_some_and(|extension| extension == "rs");
        path.is_dir() && defines(&path, function)
            || is_source && std::fs::read_to_string(&path).expect("text").contains(function)
    })
}

#[test]
fn the_audits_table_of_failures_is_that_of_the_atlas() {
    let text = std::fs::read_to_string(root().join("crates/verify/data/atlas.toml")).unwrap();
    let atlas: BTreeMap<String, BTreeMap<String, String>> = toml::from_str(&text).unwrap();
    let contestants = ["gamma/dop853/raw", "gamma/dop853/vertical", "euler/dop853/raw", "euler/dop853/vertical"];
    // The paper is about coins; F9 to F12 are other bodies.
    for hazard in atlas["exact"].keys().filter(|hazard| !["F9", "F10", "F11", "F12"].contains(&hazard.as_str())) {
        let row = AUDIT.lines().find(|line| line.starts_with(&format!("| {hazard} |"))).unwrap();
        let [raw, default] =
            ["/raw", ""].map(|formulation| atlas[&format!("quaternion/dop853{formulation}")][hazard].clone());
        for integrator in ["gamma/dop853", "euler/dop853"] {
            assert_eq!(atlas[integrator][hazard], default, "{integrator}");
        }
        let answers = contestants.map(|contestant| atlas[contestant][hazard].clone()).join(" | ");
        assert!(row.ends_with(&format!(" | {answers} | {raw} | {default} |")), "{row}");
    }
}
