//! Checks the dependencies between the crates of this workspace against a table. The integrators must not depend on the
//! closed form (`exact`), with which they are compared, and no library may depend on the verification suite.
//! Dev-dependencies are not restricted.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Each crate of the workspace, with the other crates of the workspace that it may depend on.
const ALLOWED: &[(&str, &[&str])] = &[
    ("numerics", &[]),
    ("dynamics", &["numerics"]),
    ("kinematics-euler", &["dynamics", "numerics"]),
    ("kinematics-quat", &["dynamics", "numerics"]),
    ("reference", &["dynamics", "numerics"]),
    ("exact", &["dynamics", "numerics"]),
    ("sampling", &["dynamics", "exact", "numerics", "whole-file"]),
    ("toss", &["numerics", "dynamics", "exact", "kinematics-euler", "kinematics-quat", "sampling"]),
    ("chart", &[]),
    ("whole-file", &[]),
    ("verify", &["reference", "toss", "sampling", "exact", "dynamics", "numerics", "chart", "whole-file"]),
    ("unfair-toss", &["toss", "sampling", "exact", "dynamics", "numerics", "chart", "whole-file"]),
    ("xtask", &[]),
    ("blackbox", &["toss", "dynamics"]),
    ("unfair-toss-python", &["toss", "sampling", "exact", "dynamics", "whole-file"]),
    ("unfair-toss-fuzz", &["unfair-toss", "toss", "sampling", "dynamics"]),
    ("web", &["toss", "sampling", "exact", "dynamics"]),
];

/// The packages of the workspace, as `cargo metadata` describes them.
fn packages() -> Vec<Value> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the root of the workspace");
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--offline", "--no-deps", "--format-version", "1"])
        .current_dir(root)
        .output()
        .expect("cargo starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    metadata["packages"].as_array().expect("packages").clone()
}

fn name(of: &Value) -> &str {
    of["name"].as_str().expect("a name")
}

#[test]
fn every_crate_depends_only_on_those_that_the_table_allows() {
    let packages = packages();
    let ours: BTreeSet<&str> = packages.iter().map(name).collect();
    let listed: BTreeSet<&str> = ALLOWED.iter().map(|(package, _)| *package).collect();
    assert_eq!(ours, listed, "the table has a line for each crate of the workspace");
    for package in &packages {
        let (_, allowed) = ALLOWED.iter().find(|(listed, _)| *listed == name(package)).expect("it is listed");
        let dependencies = package["dependencies"].as_array().expect("dependencies");
        let found: Vec<&str> = dependencies
            .iter()
            .filter(|dependency| dependency["kind"] != "dev")
            .map(name)
            .filter(|dependency| ours.contains(dependency))
            .collect();
        let forbidden: Vec<&&str> = found.iter().filter(|dependency| !allowed.contains(dependency)).collect();
        assert!(forbidden.is_empty(), "{} must not depend on {forbidden:?}", name(package));
    }
}

/// The crates in the tree of `toss` with these features, itself included. Crates that are shown more than once, marked by
/// `(*)`, count as often as they are shown differently.
fn tree_of_toss(features: &[&str]) -> BTreeSet<String> {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--package", "toss", "--edges", "normal", "--prefix", "none"])
        .args(features)
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")))
        .output()
        .expect("cargo starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).lines().map(str::to_owned).collect()
}

#[test]
fn each_feature_of_toss_adds_its_own_crate() {
    let bare = tree_of_toss(&["--no-default-features"]);
    assert!(bare.len() <= 70, "{}: {bare:#?}", bare.len());
    let has = |tree: &BTreeSet<String>, name: &str| tree.iter().any(|line| line.starts_with(&format!("{name} ")));
    for (feature, name) in [("serde", "toml"), ("rayon", "rayon")] {
        let tree = tree_of_toss(&["--no-default-features", "--features", feature]);
        assert!(has(&tree, name) && !has(&bare, name), "{name} with {feature}");
    }
}
