//! Checks that each library crate can be packaged by itself: a file that its sources embed (`include_str!`) has to be
//! in its own folder. Cargo packages one folder, so a file from elsewhere would be missing from the package.

use std::path::{Component, Path, PathBuf};

/// The crates that downstream code may depend on.
const LIBRARIES: [&str; 7] =
    ["numerics", "dynamics", "exact", "kinematics-euler", "kinematics-quat", "sampling", "toss"];

/// Adds the Rust files below `folder` to `found`.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder of the workspace") {
        let path = entry.expect("a readable folder").path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// The paths that `include_str!` and `include_bytes!` name in a source.
fn embedded(text: &str) -> impl Iterator<Item = &str> {
    text.split("include_").skip(1).filter_map(|after| {
        let (macro_name, rest) = after.split_once("!(\"")?;
        ["str", "bytes"].contains(&macro_name).then(|| rest.split('"').next())?
    })
}

/// `path` with each `..` resolved.
fn normal(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut normal, component| {
        if component == Component::ParentDir {
            normal.pop();
        } else {
            normal.push(component);
        }
        normal
    })
}

#[test]
fn no_library_embeds_a_file_from_outside_its_folder() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates").canonicalize().unwrap();
    let mut embedded_files = 0;
    for library in LIBRARIES {
        let root = crates.join(library);
        let mut files = Vec::new();
        sources(&root, &mut files);
        assert!(!files.is_empty(), "{library}");
        for file in files {
            let text = std::fs::read_to_string(&file).unwrap();
            for path in embedded(&text) {
                let target = normal(&file.parent().unwrap().join(path));
                assert!(target.starts_with(&root), "{} embeds {}", file.display(), target.display());
                assert!(target.is_file(), "{} embeds {}", file.display(), target.display());
                embedded_files += 1;
            }
        }
    }
    // The named spaces.
    assert!(embedded_files >= 3, "{embedded_files}");
}
