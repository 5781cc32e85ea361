//! Uses `toss` and `verify` as other people do: from crates outside this workspace, which have path dependencies and nothing
//! else of it.
//!
//! The Rust of README.md and of the front page of `toss` has to compile and run there, too, with the dependency that
//! README.md shows.

use std::path::{Path, PathBuf};
use std::process::Command;

/// What the examples name themselves, in addition to `toss`.
const EXAMPLES_NEED: &str = "serde = { version = \"1\", features = [\"derive\"] }
toml = \"1\"
";

/// Where README.md assumes the clone to be.
const CLONE: &str = "../unfair-toss/";

/// The crates of this workspace that are built again here, because the workspace around them is another one.
const CRATES: [&str; 10] = [
    "chart",
    "dynamics",
    "exact",
    "kinematics-euler",
    "kinematics-quat",
    "numerics",
    "sampling",
    "toss",
    "verify",
    "whole-file",
];

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

/// A package `name` in the workspace `target/downstream`. Its dependencies are those that a page shows, with the paths of
/// this clone.
fn write_package(folder: &Path, name: &str, manifest: &str, main: &str) {
    let sources = folder.join(name).join("src");
    std::fs::create_dir_all(&sources).expect("a folder");
    let clone = format!("{}/", root().display());
    std::fs::write(folder.join(name).join("Cargo.toml"), manifest.replace(CLONE, &clone)).expect("written");
    std::fs::write(sources.join("main.rs"), main).expect("written");
}

/// The crate of README.md and of the front page of `toss`, whose program runs all of their Rust.
fn write_crate_of_the_readme(folder: &Path) {
    let page = read("README.md");
    let dependencies = blocks_of(&page, |language| language == "toml").concat();
    assert!(dependencies.contains(CLONE), "{dependencies}");
    let (readme, front_page) = (blocks(&page, false), blocks(&documentation(&read("crates/toss/src/lib.rs")), true));
    assert!(!readme.is_empty() && front_page.len() >= 8, "{} and {} blocks", readme.len(), front_page.len());
    let blocks = [readme, front_page].concat();
    let modules: String = blocks.iter().enumerate().map(|(index, block)| module(index, block)).collect();
    let calls: String = (0..blocks.len()).map(|index| format!("    block_{index}::main()?;\n")).collect();
    let main = format!("{modules}fn main() -> Result<(), Box<dyn std::error::Error>> {{\n{calls}    Ok(())\n}}\n");
    let head = "[package]\nname = \"readme\"\nversion = \"0.0.0\"\nedition = \"2024\"\n\n";
    write_package(folder, "readme", &format!("{head}{dependencies}{EXAMPLES_NEED}"), &main);
}

/// The crate of docs/your-solver.md, which is called `mine`.
fn write_crate_of_the_page(folder: &Path) {
    let page = read("docs/your-solver.md");
    let block = |kind: &str| {
        let block = page.split(&format!("```{kind}\n")).nth(1).and_then(|rest| rest.split("```").next());
        block.unwrap_or_else(|| panic!("no block {kind}"))
    };
    let manifest = block("toml Cargo.toml");
    assert!(["toss", "verify"].iter().all(|name| manifest.contains(&format!("{CLONE}crates/{name}"))), "{manifest}");
    write_package(folder, "mine", manifest, block("rust,no_run src/main.rs"));
}

/// A workspace of the two, with the lock file and the profiles of this one, so that it shares what this one has built of
/// others' crates. Ours are built again, in a hurry.
fn write_workspace() -> PathBuf {
    let folder = root().join("target/downstream");
    write_crate_of_the_readme(&folder);
    write_crate_of_the_page(&folder);
    let workspace = read("Cargo.toml");
    let profiles = workspace[workspace.find("[profile.dev]").expect("profiles")..].split_inclusive("\n\n");
    let is_of_others = |part: &&str| {
        let is_of = |name: &str| part.contains(&format!(".package.{name}]"));
        !CRATES.iter().chain(&["criterion", "unfair-toss"]).any(|name| is_of(name))
    };
    let profiles: String = profiles.filter(is_of_others).collect();
    let hurried = |name: &&str| format!("[profile.release.package.{name}]\nopt-level = 1\ncodegen-units = 16\n");
    let hurried: String = CRATES.iter().map(hurried).collect();
    let members = "[workspace]\nresolver = \"3\"\nmembers = [\"readme\", \"mine\"]\n";
    std::fs::write(folder.join("Cargo.toml"), format!("{members}\n{profiles}\n{hurried}")).expect("written");
    std::fs::copy(root().join("Cargo.lock"), folder.join("Cargo.lock")).expect("copied");
    folder
}

/// What a program prints, which has to succeed.
fn output_of(command: &mut Command) -> String {
    let run = command.output().expect("it starts");
    let (stdout, stderr) = (String::from_utf8_lossy(&run.stdout), String::from_utf8_lossy(&run.stderr));
    assert!(run.status.success(), "{stdout}{stderr}");
    stdout.into_owned()
}

#[test]
fn crates_outside_the_workspace_build_and_run_as_the_pages_say() {
    let folder = write_workspace();
    // Where the workspace has its builds: target/PROFILE/deps/TEST.
    let test = std::env::current_exe().expect("a test knows where it is");
    let target = test.ancestors().nth(3).expect("the folder of builds");
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["build", "--offline", "--quiet", "--release", "--workspace"]).env("CARGO_TARGET_DIR", target);
    output_of(cargo.current_dir(&folder));
    let program = |name: &str| Command::new(target.join("release").join(name));
    // What the README says that its program prints.
    assert_eq!(output_of(&mut program("readme")), "heads: 0.66566129, integrated 0.66566129\n");
    let mut mine = program("mine");
    let printed = output_of(mine.args(["--quick", "--only", "reference-cos-tilt"]).current_dir(folder.join("mine")));
    assert!(printed.contains("All 1 rows pass: two-turns."), "{printed}");
}

#[test]
fn blocks_of_rust_are_found_and_others_are_not() {
    let text = "a\n```rust\none\n# hidden\n```\n```text\nnone\n```\n```\ntwo\n```\n";
    assert_eq!(blocks(text, false), ["one\nhidden\n"]);
    assert_eq!(blocks(text, true), ["one\nhidden\n", "two\n"]);
    assert_eq!(documentation("//! a\n//!\n//!  b\nmod c;\n//! d\n"), "a\n\n b\n");
}
