//! This test reads the sources and checks that data flows from measuring to judging to rendering, and never back. The
//! compiler does not check this, because all three are modules of one crate.

use std::path::{Path, PathBuf};

/// The source files in a folder of the crate.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

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
            let text = std::fs::read_to_string(&path).expect("text").replace("measure::checks::CHECKS", "");
            for module in forbidden {
                assert!(!text.contains(module), "{} uses {module}", path.display());
            }
        }
    }
}
