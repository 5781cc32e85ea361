//! Uses `toss` and `verify` as other people do: from crates outside this workspace, which have path dependencies and nothing
//! else of it.
//!
//! The Rust of README.md and of the front page of `toss` has to compile and run there, too, with the dependency that
//! README.md shows.

use std::path::{Path, PathBuf};
use std::process::Command;

const MANIFEST: &str = "[package]
name = \"downstream\"
version = \"0.0.0\"
edition = \"2024\"

[workspace]

";

/// What the examples name themselves, in addition to `toss`.
const EXAMPLES_NEED: &str = "serde = { version = \"1\", features = [\"derive\"] }
toml = \"1\"
";

/// Where README.md assumes the clone to be.
const CLONE: &str = "../unfair-toss/";

/// All of it is built again here, because features differ. The examples take a moment to run, and minutes to optimise.
const PROFILES: &str = "
[profile.dev]
debug = \"line-tables-only\"
[profile.dev.package.\"*\"]
debug = false
";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the root of the workspace")
}

fn read(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The blocks of Rust in a text of Markdown, without the marks of hidden lines. A block without a language is Rust in the
/// documentation of a crate (`bare`), and not in a file of its own.
fn blocks(markdown: &str, bare: bool) -> Vec<String> {
    blocks_of(markdown, |language| language == "rust" || bare && language.is_empty())
}

/// The blocks in a text of Markdown whose language is meant, without the marks of hidden lines.
fn blocks_of(markdown: &str, is_meant: impl Fn(&str) -> bool) -> Vec<String> {
    let mut blocks = Vec::new();
    let mut open: Option<(bool, String)> = None;
    for line in markdown.lines() {
        match (line.strip_prefix("```"), &mut open) {
            (Some(language), None) => open = Some((is_meant(language), String::new())),
            (Some(_), Some(_)) => blocks.extend(open.take().filter(|(is_meant, _)| *is_meant).map(|(_, block)| block)),
            (None, Some((_, block))) => {
                block.push_str(line.strip_prefix("# ").unwrap_or(line));
                block.push('\n');
            }
            (None, None) => {}
        }
    }
    blocks
}

/// The documentation of a crate, from the lines `//!` of its first file.
fn documentation(source: &str) -> String {
    let lines = source.lines().map_while(|line| line.strip_prefix("//!"));
    lines.flat_map(|line| [line.strip_prefix(' ').unwrap_or(line), "\n"]).collect()
}

/// A module with a block of Rust in it, in a function `main` if it has none.
fn module(index: usize, block: &str) -> String {
    let body = if block.contains("fn main()") {
        block.replace("fn main()", "pub fn main()")
    } else {
        format!("pub fn main() -> Result<(), Box<dyn std::error::Error>> {{\n{block}}}\n")
    };
    format!("mod block_{index} {{\n{body}}}\n")
}

/// A new crate with these blocks, whose program runs all of them. It has the lock file of the workspace, and so the same
/// versions of what it depends on.
fn write_crate(dependencies: &str, blocks: &[String]) -> PathBuf {
    let folder = root().join("target/downstream");
    std::fs::create_dir_all(folder.join("src")).expect("a folder");
    let dependencies = dependencies.replace(CLONE, &format!("{}/", root().display()));
    std::fs::write(folder.join("Cargo.toml"), format!("{MANIFEST}{dependencies}{EXAMPLES_NEED}{PROFILES}"))
        .expect("written");
    std::fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).expect("copied");
    let modules: String = blocks.iter().enumerate().map(|(index, block)| module(index, block)).collect();
    let calls: String = (0..blocks.len()).map(|index| format!("    block_{index}::main()?;\n")).collect();
    let main = format!("{modules}fn main() -> Result<(), Box<dyn std::error::Error>> {{\n{calls}    Ok(())\n}}\n");
    std::fs::write(folder.join("src/main.rs"), main).expect("written");
    folder
}

#[test]
fn the_rust_of_the_readme_and_of_the_front_page_runs_in_a_crate_outside_the_workspace() {
    let readme = blocks(&read("README.md"), false);
    let dependencies = blocks_of(&read("README.md"), |language| language == "toml").concat();
    assert!(dependencies.contains(CLONE), "{dependencies}");
    let front_page = blocks(&documentation(&read("crates/toss/src/lib.rs")), true);
    assert!(!readme.is_empty() && front_page.len() >= 8, "{} and {} blocks", readme.len(), front_page.len());
    let folder = write_crate(&dependencies, &[readme, front_page].concat());
    // What the workspace has built is not built again: target/PROFILE/deps/TEST.
    let test = std::env::current_exe().expect("a test knows where it is");
    let target = test.ancestors().nth(3).expect("the folder of builds");
    let run = Command::new(env!("CARGO"))
        .args(["run", "--offline", "--quiet", "--target-dir"])
        .arg(target)
        .current_dir(&folder)
        .output()
        .expect("cargo starts");
    let (stdout, stderr) = (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
    assert!(run.status.success(), "{stdout}{stderr}");
    // What the README says that its program prints.
    assert_eq!(stdout, "heads: 0.66566129, integrated 0.66566129\n");
}

/// The crate of docs/your-solver.md, which has the clone beside it there, and the workspace around it here. Its profiles are those of
/// the workspace, so that what the workspace has built is not built again.
fn write_crate_of_the_page() -> PathBuf {
    let page = read("docs/your-solver.md");
    let block = |kind: &str| {
        let block = page.split(&format!("```{kind}\n")).nth(1).and_then(|rest| rest.split("```").next());
        block.unwrap_or_else(|| panic!("no block {kind}")).to_owned()
    };
    let folder = root().join("target/your-solver");
    std::fs::create_dir_all(folder.join("src")).expect("a folder");
    let mut manifest = block("toml Cargo.toml");
    for name in ["toss", "verify"] {
        let path = root().join("crates").join(name);
        let line = format!("{name} = {{ path = \"../unfair-toss/crates/{name}\" }}");
        assert!(manifest.contains(&line), "{manifest}");
        manifest = manifest.replace(&line, &format!("{name} = {{ path = {:?} }}", path.display().to_string()));
    }
    let workspace = read("Cargo.toml");
    let profiles = &workspace[workspace.find("[profile.dev]").expect("profiles")..];
    let profiles: Vec<&str> = profiles.split_inclusive("\n\n").filter(|part| !part.contains("criterion]")).collect();
    manifest += &format!("\n[workspace]\n\n{}", profiles.concat());
    std::fs::write(folder.join("Cargo.toml"), manifest).expect("written");
    std::fs::write(folder.join("src/main.rs"), block("rust,no_run src/main.rs")).expect("written");
    std::fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).expect("copied");
    folder
}

#[test]
fn the_crate_of_the_page_for_solvers_is_built_outside_the_workspace_and_passes_a_check() {
    let folder = write_crate_of_the_page();
    let test = std::env::current_exe().expect("a test knows where it is");
    let target = test.ancestors().nth(3).expect("the folder of builds");
    let profile: &[&str] = if cfg!(debug_assertions) { &[] } else { &["--release"] };
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["run", "--offline", "--quiet"]).args(profile).arg("--target-dir").arg(target);
    let run = cargo.args(["--", "--quick", "--only", "random-attitude"]).current_dir(&folder).output();
    let run = run.expect("cargo starts");
    let (stdout, stderr) = (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
    assert!(run.status.success() && stdout.contains("All 1 rows pass: two-turns."), "{stdout}{stderr}");
}

#[test]
fn blocks_of_rust_are_found_and_others_are_not() {
    let text = "a\n```rust\none\n# hidden\n```\n```text\nnone\n```\n```\ntwo\n```\n";
    assert_eq!(blocks(text, false), ["one\nhidden\n"]);
    assert_eq!(blocks(text, true), ["one\nhidden\n", "two\n"]);
    assert_eq!(documentation("//! a\n//!\n//!  b\nmod c;\n//! d\n"), "a\n\n b\n");
}
