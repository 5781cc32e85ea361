//! `.ci/affected` says which parts of `.ci/run` a change can affect. These tests hold it against the manifests: a part that
//! builds a package runs after a change of any crate that the package depends on.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The parts that build something, with the manifests of what they build.
const BUILT: [(&str, &[&str]); 7] = [
    ("instructions", &["crates/verify"]),
    ("contestants", &["crates/contestants"]),
    ("fuzz", &["fuzz"]),
    ("packages", &["crates/cli", "crates/verify"]),
    ("python", &["bindings/python", "crates/cli"]),
    ("web", &["web", "crates/cli"]),
    ("aarch64", &["crates/cli", "crates/verify"]),
];

/// What runs after every change.
const ALWAYS: [&str; 3] = ["lints", "suite", "tests"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the root of the workspace")
}

/// The parts that changes of these files affect.
fn affected(files: &[&str]) -> BTreeSet<String> {
    let mut rule = Command::new("bash")
        .arg(root().join(".ci/affected"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("bash starts");
    let lines: String = files.iter().map(|file| format!("{file}\n")).collect();
    rule.stdin.take().expect("a pipe").write_all(lines.as_bytes()).expect("it reads");
    let output = rule.wait_with_output().expect("it ends");
    assert!(output.status.success());
    String::from_utf8(output.stdout).expect("text").lines().map(str::to_owned).collect()
}

fn every_part() -> BTreeSet<String> {
    BUILT.iter().map(|(part, _)| *part).chain(ALWAYS).map(str::to_owned).collect()
}

/// The folders, from the root, of the packages of ours that the normal dependencies of `folder` reach, and itself.
fn reached(folder: &str, found: &mut BTreeSet<String>) {
    if !found.insert(folder.to_owned()) {
        return;
    }
    let manifest = root().join(folder).join("Cargo.toml");
    let text = std::fs::read_to_string(&manifest).unwrap_or_else(|error| panic!("{}: {error}", manifest.display()));
    let table: toml::Table = text.parse().expect("TOML");
    let workspace: toml::Table =
        std::fs::read_to_string(root().join("Cargo.toml")).expect("a file").parse().expect("TOML");
    let shared = &workspace["workspace"]["dependencies"];
    for (name, dependency) in table.get("dependencies").and_then(toml::Value::as_table).into_iter().flatten() {
        let is_shared = dependency.get("workspace").is_some();
        let (path, from) = if is_shared {
            (shared[name.as_str()].get("path"), PathBuf::new())
        } else {
            (dependency.get("path"), PathBuf::from(folder))
        };
        if let Some(path) = path.and_then(toml::Value::as_str) {
            let there = root().join(from).join(path).canonicalize().expect("a folder of ours");
            let relative = there.strip_prefix(root().canonicalize().expect("the root")).expect("inside").to_owned();
            reached(relative.to_str().expect("UTF-8"), found);
        }
    }
}

#[test]
fn a_change_of_a_crate_affects_every_part_that_builds_it() {
    let mut pairs = 0;
    for (part, manifests) in BUILT {
        let mut crates = BTreeSet::new();
        manifests.iter().for_each(|folder| reached(folder, &mut crates));
        for folder in &crates {
            for file in ["src/lib.rs", "Cargo.toml", "a_new_file"] {
                let file = format!("{folder}/{file}");
                assert!(affected(&[&file]).contains(part), "{file} does not affect {part}");
                pairs += 1;
            }
        }
    }
    // Nine crates below the command line, in six of the parts.
    assert!(pairs > 150, "{pairs}");
}

#[test]
fn what_no_row_names_affects_every_part() {
    for file in [".ci/run", ".ci/affected", "Cargo.toml", "Cargo.lock", ".cargo/config.toml", "clippy.toml", "new", ""]
    {
        assert_eq!(affected(&[file]), every_part(), "{file}");
    }
    assert_eq!(affected(&["docs/ci.md", "xtask/src/main.rs"]), every_part());
}

#[test]
fn what_cannot_be_affected_does_not_run() {
    let always: BTreeSet<String> = ALWAYS.map(str::to_owned).into();
    assert_eq!(affected(&[]), always);
    assert_eq!(
        affected(&["docs/guide/toss.md", "crates/dynamics/tests/bodies.rs", "CHANGELOG.md", ".ci/passed"]),
        always
    );
    let with = |part: &str| always.iter().cloned().chain([part.to_owned()]).collect::<BTreeSet<_>>();
    assert_eq!(affected(&["web/page/main.js"]), with("web"));
    assert_eq!(affected(&["bindings/python/src/lib.rs", "docs/json.md"]), with("python"));
    assert_eq!(affected(&["crates/contestants/src/main.rs"]), with("contestants"));
}

/// A part that `.ci/run` knows is a script, and the rule knows it.
#[test]
fn the_parts_of_the_rule_are_those_that_run() {
    let list =
        Command::new("bash").arg(root().join(".ci/run")).args(["--all", "--list"]).output().expect("bash starts");
    assert!(list.status.success(), "{}", String::from_utf8_lossy(&list.stderr));
    let listed: BTreeSet<String> = String::from_utf8(list.stdout).expect("text").lines().map(str::to_owned).collect();
    assert_eq!(listed, every_part());
    for part in listed {
        assert!(root().join(".ci").join(&part).is_file(), "{part}");
    }
}
