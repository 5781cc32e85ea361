//! `cargo xtask affected`: which parts of `.ci/run` a change can affect, and why.
//!
//! What a part builds is named here; what that depends on is read from the manifests by `cargo metadata`. A file of a
//! package affects each part that builds this package or one that depends on it. A file that no row knows affects every
//! part.

use std::collections::{BTreeMap, VecDeque};
use std::io::Read;
use std::path::Path;
use std::process::ExitCode;

use clap::Args;
use serde_json::Value;

use crate::{output, program, root};

/// Name the parts of continuous integration that a change can affect, each with the reason
///
/// Reads the names of the changed files from standard input, one a line, as git prints them. Prints a part a line: its
/// name, a tab, the reason.
#[derive(Debug, Args)]
pub(crate) struct Affected {}

/// A part of `.ci/run`, which is the script `.ci/NAME`.
struct Part {
    name: &'static str,
    /// It checks every file of the repository.
    always: bool,
    /// The packages that it builds and runs.
    builds: &'static [&'static str],
    /// What else it reads: files, or folders with a slash at the end.
    reads: &'static [&'static str],
}

const fn part(name: &'static str, builds: &'static [&'static str], reads: &'static [&'static str]) -> Part {
    Part { name, always: false, builds, reads }
}

const PARTS: [Part; 9] = [
    Part { always: true, ..part("tests", &[], &[]) },
    Part { always: true, ..part("lints", &[], &[]) },
    Part { always: true, ..part("suite", &[], &[]) },
    part("instructions", &["verify", "xtask"], &["validation/baseline/"]),
    // Whether the contestants compile and what they reach, which depends on their code and on the driver that flies them. A
    // change of another crate that they would not compile with is found in the next run of every part.
    part(
        "contest",
        &[],
        &[
            "crates/contestants/",
            "crates/dynamics/src/integrate.rs",
            "crates/dynamics/src/integrate/",
            "docs/contestants.md",
            "docs/contestants.svg",
            "xtask/src/contest.rs",
            // Its table of contestants is generated.
            "README.md",
        ],
    ),
    // What a package is made of beside its sources, and the pages with crates of a reader. In the sources, `lints` finds what
    // an older Rust does not have and what one set of features lacks.
    part(
        "packages",
        &[],
        &[
            "README.md",
            "LICENSE-APACHE",
            "LICENSE-MIT",
            "crates/chart/Cargo.toml",
            "crates/cli/Cargo.toml",
            "crates/dynamics/Cargo.toml",
            "crates/exact/Cargo.toml",
            "crates/kinematics-euler/Cargo.toml",
            "crates/kinematics-quat/Cargo.toml",
            "crates/numerics/Cargo.toml",
            "crates/reference/Cargo.toml",
            "crates/sampling/Cargo.toml",
            "crates/toss/Cargo.toml",
            "crates/verify/Cargo.toml",
            "crates/whole-file/Cargo.toml",
            "docs/your-solver.md",
        ],
    ),
    part(
        "python",
        &["unfair-toss-python", "unfair-toss"],
        &[
            // Their lines are run by pytest, and the recipes' notebooks lie beside the tests.
            "bindings/",
            "README.md",
            "docs/guide/python.md",
            // How `unfair_toss.verify` asks the program, and what it reads of its report.
            "crates/verify/src/commands/",
            "crates/verify/src/process/",
            "crates/verify/src/render/report.rs",
        ],
    ),
    part("web", &["web", "unfair-toss", "xtask"], &["web/", "docs/page.png"]),
    // What computes. The command line that prints it adds nothing that a processor could change.
    part("aarch64", &["toss"], &["crates/exact/tests/"]),
];

/// What nothing but `tests`, `lints` and `suite` reads; folders with a slash at the end.
const DOCUMENTS: [&str; 15] = [
    ".cargo/mutants.toml",
    ".ci/passed",
    ".dockerignore",
    ".github/",
    ".gitignore",
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CITATION.cff",
    "CONTRIBUTING.md",
    "DESIGN.md",
    "Dockerfile",
    "README.md",
    "docs/",
    "templates/",
    "validation/",
];

/// The folders of a package that no other package is built from.
const OF_ITS_OWN_TESTS: [&str; 3] = ["tests/", "benches/", "examples/"];

impl Affected {
    pub(crate) fn run() -> Result<ExitCode, String> {
        let mut changed = String::new();
        std::io::stdin()
            .read_to_string(&mut changed)
            .map_err(|error| format!("cannot read the names of the changed files: {error}"))?;
        let packages = Packages::of_the_repository()?;
        let lines: String =
            affected(&packages, changed.lines()).iter().map(|(part, reason)| format!("{part}\t{reason}\n")).collect();
        output::print(&lines)?;
        Ok(ExitCode::SUCCESS)
    }
}

/// The parts that the changed files affect, in the order of [`PARTS`], each with its first reason.
fn affected<'a>(packages: &Packages, changed: impl IntoIterator<Item = &'a str>) -> Vec<(&'static str, String)> {
    let changed: Vec<&str> = changed.into_iter().collect();
    PARTS
        .iter()
        .filter_map(|part| {
            let reason = if part.always {
                Some("runs after every change".to_owned())
            } else {
                changed.iter().find_map(|file| packages.reason(part, file))
            };
            reason.map(|reason| (part.name, reason))
        })
        .collect()
}

/// The packages of the repository by name.
struct Packages(BTreeMap<String, Package>);

struct Package {
    /// From the root, with a slash at the end.
    folder: String,
    /// The packages of the repository that it is built from.
    needs: Vec<String>,
}

impl Packages {
    fn of_the_repository() -> Result<Self, String> {
        let mut packages = BTreeMap::new();
        for package in metadata()?["packages"].as_array().into_iter().flatten() {
            let (name, found) = Package::read(package).ok_or("cargo metadata names no folder")?;
            packages.insert(name, found);
        }
        Ok(Self(packages))
    }

    /// Why a change of `file` affects `part`, if it does.
    fn reason(&self, part: &Part, file: &str) -> Option<String> {
        if is_below(file, part.reads) {
            return Some(format!("reads {file}"));
        }
        if file == format!(".ci/{}", part.name) {
            return Some(format!("is the script {file}"));
        }
        if let Some((name, package)) = self.owner(file) {
            if is_below(&file[package.folder.len()..], &OF_ITS_OWN_TESTS) {
                return None;
            }
            return part.builds.iter().find_map(|built| self.path(built, name)).map(|path| {
                let path = path.join(", which needs ");
                format!("builds {path}, which has {file}")
            });
        }
        let of_another_part = PARTS.iter().any(|other| file == format!(".ci/{}", other.name));
        let known =
            of_another_part || is_below(file, &DOCUMENTS) || PARTS.iter().any(|other| is_below(file, other.reads));
        (!known).then(|| format!("no row of xtask/src/affected.rs knows {file}"))
    }

    /// The package that a file belongs to.
    fn owner(&self, file: &str) -> Option<(&str, &Package)> {
        let all = self.0.iter().filter(|(_, package)| file.starts_with(&package.folder));
        all.max_by_key(|(_, package)| package.folder.len()).map(|(name, package)| (name.as_str(), package))
    }

    /// The shortest way from a package to one that it needs.
    fn path(&self, from: &str, to: &str) -> Option<Vec<&str>> {
        let (from, _) = self.0.get_key_value(from)?;
        let mut ways = VecDeque::from([vec![from.as_str()]]);
        let mut seen = vec![from.as_str()];
        while let Some(way) = ways.pop_front() {
            let last = *way.last()?;
            if last == to {
                return Some(way);
            }
            for next in self.0.get(last).into_iter().flat_map(|package| &package.needs) {
                if !seen.contains(&next.as_str()) {
                    seen.push(next);
                    ways.push_back([&way[..], &[next]].concat());
                }
            }
        }
        None
    }
}

impl Package {
    fn read(package: &Value) -> Option<(String, Self)> {
        let folder = Path::new(package["manifest_path"].as_str()?).parent()?;
        let folder = format!("{}/", folder.strip_prefix(root()).ok()?.to_str()?.replace('\\', "/"));
        let is_needed = |dependency: &&Value| dependency["path"].is_string() && dependency["kind"] != "dev";
        let needs = package["dependencies"].as_array()?.iter().filter(is_needed);
        let needs = needs.filter_map(|dependency| dependency["name"].as_str().map(str::to_owned)).collect();
        Some((package["name"].as_str()?.to_owned(), Self { folder, needs }))
    }
}

/// What cargo says of the packages of the workspace. It fetches nothing.
fn metadata() -> Result<Value, String> {
    let output = program::cargo()
        .args(["metadata", "--no-deps", "--format-version", "1"])
        .output()
        .map_err(|error| format!("cannot start cargo: {error}"))?;
    if !output.status.success() {
        return Err(format!("cargo metadata: {}", String::from_utf8_lossy(&output.stderr).trim()));
    }
    serde_json::from_slice(&output.stdout).map_err(|error| format!("cargo metadata: {error}"))
}

/// Whether `file` is one of these, or lies in one of those that end with a slash.
fn is_below(file: &str, names: &[&str]) -> bool {
    names.iter().any(|name| file == *name || (name.ends_with('/') && file.starts_with(name)))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;
    use std::process::Command;

    use super::*;

    fn parts(files: &[&str]) -> BTreeSet<&'static str> {
        let packages = Packages::of_the_repository().expect("the manifests");
        affected(&packages, files.iter().copied()).into_iter().map(|(part, _)| part).collect()
    }

    fn every_part() -> BTreeSet<&'static str> {
        PARTS.iter().map(|part| part.name).collect()
    }

    /// Those after every change, and these.
    fn always_and(parts: &[&'static str]) -> BTreeSet<&'static str> {
        ["tests", "lints", "suite"].into_iter().chain(parts.iter().copied()).collect()
    }

    #[test]
    fn a_crate_affects_what_is_built_from_it() {
        let numerical = ["instructions", "python", "web", "aarch64"];
        assert_eq!(parts(&["crates/exact/src/lib.rs"]), always_and(&numerical));
        let manifest = [numerical.as_slice(), &["packages"]].concat();
        assert_eq!(parts(&["crates/numerics/Cargo.toml"]), always_and(&manifest));
        assert_eq!(parts(&["crates/verify/src/main.rs"]), always_and(&["instructions"]));
        let asked = ["crates/verify/src/process/protocol.rs"];
        assert_eq!(parts(&asked), always_and(&["instructions", "python"]));
        assert_eq!(parts(&["crates/cli/src/main.rs"]), always_and(&["python", "web"]));
        assert_eq!(parts(&["web/page/main.js"]), always_and(&["web"]));
        assert_eq!(parts(&["bindings/python/tests/test_toss.py", "docs/json.md"]), always_and(&["python"]));
    }

    #[test]
    fn the_contestants_fly_when_they_or_their_driver_change() {
        assert_eq!(parts(&["crates/contestants/src/main.rs"]), always_and(&["contest"]));
        assert!(parts(&["crates/dynamics/src/integrate.rs"]).contains("contest"));
        assert!(root().join("crates/dynamics/src/integrate.rs").is_file());
        assert!(!parts(&["crates/exact/src/lib.rs", "crates/dynamics/src/coin.rs"]).contains("contest"));
    }

    #[test]
    fn tests_and_documents_affect_only_what_reads_them() {
        assert_eq!(parts(&[]), always_and(&[]));
        let read_by_none = ["docs/guide/toss.md", "crates/dynamics/tests/bodies.rs", "CHANGELOG.md", ".ci/passed"];
        assert_eq!(parts(&read_by_none), always_and(&[]));
        assert_eq!(parts(&["crates/exact/tests/bodies.rs"]), always_and(&["aarch64"]));
        assert_eq!(parts(&["README.md"]), always_and(&["contest", "packages", "python"]));
        assert_eq!(parts(&["validation/baseline/x86_64/instructions.csv"]), always_and(&["instructions"]));
    }

    #[test]
    fn what_no_row_knows_affects_every_part() {
        for file in
            [".ci/run", ".ci/lib.sh", "Cargo.toml", "Cargo.lock", ".cargo/config.toml", "clippy.toml", "new", ""]
        {
            assert_eq!(parts(&[file]), every_part(), "{file}");
        }
        assert_eq!(parts(&[".ci/web"]), always_and(&["web"]));
    }

    #[test]
    fn a_reason_names_the_way_from_the_part_to_the_file() {
        let packages = Packages::of_the_repository().expect("the manifests");
        let reasons: BTreeMap<_, _> = affected(&packages, ["crates/numerics/src/ball.rs"]).into_iter().collect();
        assert_eq!(reasons["tests"], "runs after every change");
        let web = "builds web, which needs dynamics, which needs numerics, which has crates/numerics/src/ball.rs";
        assert_eq!(reasons["web"], web);
    }

    /// A part is a script that `.ci/run` runs, and what it reads and builds is there.
    #[test]
    fn the_rows_name_what_is_there() {
        let list = Command::new("bash").arg(root().join(".ci/run")).args(["--all", "--list"]).output().expect("bash");
        let text = String::from_utf8(list.stdout).expect("text");
        let listed: BTreeSet<&str> = text.lines().map(|line| line.split('\t').next().unwrap_or(line)).collect();
        assert_eq!(listed, every_part());
        let packages = Packages::of_the_repository().expect("the manifests");
        for part in PARTS {
            assert!(root().join(".ci").join(part.name).is_file(), "{}", part.name);
            part.builds.iter().for_each(|built| assert!(packages.0.contains_key(*built), "{built}"));
            part.reads.iter().for_each(|file| assert!(root().join(file).exists(), "{file}"));
        }
    }
}
