//! The judge judges alone: of the crates that it depends on, the reference may name no code that it judges, no check may
//! take its landings from elsewhere than the reference, and no module uses those that come after it.

use std::fs;
use std::path::{Path, PathBuf};

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    entries.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("a source file");
    text.lines().filter(|line| !line.trim_start().starts_with("//")).map(|line| format!("{line}\n")).collect()
}

/// All that a file of the reference may take from this workspace: the toss as it was given, and plain types of results.
const PLAIN: [&str; 12] = [
    "Toss",
    "Attitude",
    "Coin",
    "CoinToss",
    "Launch",
    "Outcome",
    "SolveError",
    "TimeOfFlight",
    "Vector3",
    "DoubleDouble",
    "Body",
    "Quantity",
];

#[test]
fn the_reference_takes_nothing_from_the_workspace_but_the_toss_as_it_was_given() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../reference/src");
    let files = sources(&folder);
    assert!(files.len() >= 5, "{files:?}");
    for path in files {
        let text = code(&path);
        for name in [
            "principal",
            "Solver",
            ".land(",
            ".tilt(&",
            "rigid()",
            "inertia_ratio()",
            "exact_vertical",
            "exact_rate",
            "exact_inertia",
            "in_digits",
            "vertical",
            "numerics::Big",
        ] {
            assert!(!text.contains(name), "{} names {name}", path.display());
        }
        let is_of_the_workspace =
            |line: &&str| line.starts_with("use dynamics::") || line.starts_with("use numerics::");
        for line in text.lines().filter(is_of_the_workspace) {
            assert!(line.ends_with(';'), "{}: names of one import stand on one line: {line}", path.display());
            let names = line.split(|part: char| !part.is_alphanumeric()).filter(|name| !name.is_empty());
            let foreign = names.skip(2).find(|name| !PLAIN.contains(name));
            assert_eq!(foreign, None, "{}: {line}", path.display());
        }
    }
}

/// The solver of the exact motion is a subject, never what errors are taken against.
#[test]
fn no_check_has_a_judge_of_its_own() {
    let measure = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/measure");
    // In the tests of diagnoses it is a solver that gets mistakes.
    let is_judged = |path: &PathBuf| !path.ends_with("tests.rs");
    for path in sources(&measure).into_iter().filter(is_judged) {
        assert_eq!(code(&path).lines().find(|line| line.contains("ExactSolver.")), None, "{}", path.display());
    }
}

/// Data flows from measuring to judging to rendering, and never back. The compiler does not check this, because all three are
/// modules of one crate.
#[test]
fn no_module_uses_the_modules_that_come_after_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for (folder, forbidden) in [
        ("measure", ["crate::judge", "crate::render", "crate::bench", "crate::suite"].as_slice()),
        ("judge", &["measure::checks", "crate::render", "crate::bench", "crate::suite"]),
        ("render", &["measure::checks", "crate::bench", "crate::suite"]),
        ("bench", &["crate::measure", "crate::judge", "crate::render"]),
    ] {
        let sources = sources(&root.join(folder));
        assert!(sources.len() > 3, "{folder}");
        for path in sources {
            // Limits have ceilings, which the list of the checks gives; nobody but it may be used of them.
            let text = fs::read_to_string(&path).expect("text").replace("measure::checks::CHECKS", "");
            for module in forbidden {
                assert!(!text.contains(module), "{} uses {module}", path.display());
            }
        }
    }
}
