//! Data flows from measuring to judging to rendering, and never back.

use std::path::{Path, PathBuf};

/// The source files in a folder of the crate.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

#[test]
fn measuring_knows_no_judge_and_judging_no_check_and_nothing_how_it_is_rendered() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for (folder, forbidden) in [
        ("measure", ["crate::judge", "crate::render", "crate::bench"].as_slice()),
        ("judge", &["measure::checks", "crate::render", "crate::bench"]),
        ("render", &["measure::checks", "crate::bench"]),
        ("bench", &["crate::measure", "crate::judge", "crate::render"]),
    ] {
        let sources = sources(&root.join(folder));
        assert!(sources.len() > 3, "{folder}");
        for path in sources {
            let text = std::fs::read_to_string(&path).expect("text");
            for module in forbidden {
                assert!(!text.contains(module), "{} uses {module}", path.display());
            }
        }
    }
}
