//! Runs every example and compares its output with the output that its documentation shows. So the documentation stays
//! true, and the assertions in the examples are checked.

use std::path::Path;
use std::process::Command;

/// Runs an example and returns what it prints. Cargo builds the examples beside this test, in the folder `examples`
/// next to the test's folder `deps`.
fn run(name: &str) -> String {
    let test = std::env::current_exe().expect("a test knows where it is");
    let profile = test.ancestors().nth(2).expect("target/PROFILE/deps/TEST");
    let example = profile.join("examples").join(name).with_extension(std::env::consts::EXE_EXTENSION);
    let output = Command::new(&example).output();
    let output =
        output.unwrap_or_else(|error| panic!("{}: {error}; `cargo test -p toss` builds it", example.display()));
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("examples print text")
}

/// The block of text in the header of an example: the output that it shows.
fn documented(source: &str) -> String {
    let lines =
        source.lines().map_while(|line| line.strip_prefix("//!")).map(|line| line.strip_prefix(' ').unwrap_or(line));
    let block = lines.skip_while(|line| *line != "```text").skip(1).take_while(|line| *line != "```");
    block.flat_map(|line| [line, "\n"]).collect()
}

#[test]
fn every_example_prints_the_output_in_its_documentation() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut names: Vec<String> = Vec::new();
    for file in std::fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        assert_eq!(run(&name), documented(&std::fs::read_to_string(&path).unwrap()), "{name}");
        names.push(name);
    }
    names.sort();
    assert_eq!(names, ["engraved", "human", "inverse", "map", "racket", "two_solvers"]);
}

#[test]
fn readme_shows_an_example_with_its_output() {
    let read = |path: &str| std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap();
    let example = read("examples/two_solvers.rs");
    let (_, program) = example.split_once("\n\n").expect("a program below the header");
    assert!(read("../../README.md").contains(&format!("```rust\n{program}```\n")), "{program}");
    assert!(program.contains(&format!("// {}", documented(&example))), "{program}");
}
