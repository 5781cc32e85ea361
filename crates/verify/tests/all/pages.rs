//! These tests follow docs/your-solver.md and docs/ci.md to the letter: they run the programs that the pages show, whole,
//! by the commands that the pages show, in their order, and compare the reports.

use std::path::Path;
use std::process::{Command, Output};

use crate::programs::{example, has_python};

const SOLVER: &str = include_str!("../../../../docs/your-solver.md");
const CI: &str = include_str!("../../../../docs/ci.md");

/// The block of `page` behind the fence that says `kind`.
fn block<'a>(page: &'a str, kind: &str) -> &'a str {
    let block = page.split(&format!("```{kind}\n")).nth(1).and_then(|rest| rest.split("```").next());
    block.unwrap_or_else(|| panic!("no block {kind}"))
}

/// Runs the lines of `script` in `folder`, where `cargo` starts `program` with what stands behind `run … --`, or behind
/// `xtask verify`, and builds nothing. The first command that fails ends it.
fn run(script: &str, program: &Path, folder: &Path) -> Output {
    let cargo = "cargo() {
        case $1 in
            run) while [ \"$1\" != -- ]; do shift; done; shift ;;
            xtask) shift 2 ;;
            *) return 0 ;;
        esac
        \"$PROGRAM\" \"$@\"
    }";
    let script = format!("set -e -o pipefail\n{cargo}\n{script}");
    let mut bash = Command::new("bash");
    bash.args(["-c", &script]).env("PROGRAM", program).env_remove("GITHUB_STEP_SUMMARY").current_dir(folder);
    bash.output().expect("bash starts")
}

/// Runs the commands of `kind` and compares what they print with the text of `kind`.
#[track_caller]
fn assert_printed(kind: &str, program: &Path, folder: &Path) {
    let output = run(block(SOLVER, &format!("sh {kind}")), program, folder);
    let (printed, said) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(printed.trim(), block(SOLVER, &format!("text {kind}")).trim(), "{said}");
}

/// The program of the crate that the page shows, which is the example `own_solver`.
fn own_solver() -> std::path::PathBuf {
    let example = include_str!("../../examples/own_solver.rs");
    assert_eq!(block(SOLVER, "rust,no_run src/main.rs"), example, "the page shows the whole program");
    let test = std::env::current_exe().expect("a test knows where it is");
    let profile = test.ancestors().nth(2).expect("target/PROFILE/deps/TEST");
    profile.join("examples/own_solver")
}

#[test]
fn the_program_of_the_page_has_the_report_that_the_page_shows() {
    if !has_python() {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    example(folder.path());
    assert_printed("program", Path::new(env!("CARGO_BIN_EXE_verify")), folder.path());
}

#[test]
fn the_crate_of_the_page_has_the_report_that_the_page_shows() {
    let folder = tempfile::tempdir().expect("a folder");
    assert_printed("crate", &own_solver(), folder.path());
}

#[test]
fn the_commands_for_continuous_integration_end_with_0_for_an_unchanged_solver() {
    let folder = tempfile::tempdir().expect("a folder");
    let workflow = CI.lines().filter_map(|line| line.trim().strip_prefix("- run: cargo "));
    let workflow: Vec<String> = workflow.map(|line| format!("cargo {line}\n")).collect();
    assert_eq!(workflow.len(), 2);
    let output = run(&(block(CI, "sh").to_owned() + &workflow.concat()), &own_solver(), folder.path());
    let (printed, said) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{printed}{said}");
    assert!(printed.contains("This run began the baseline validation/baseline/"), "{printed}");
    assert_eq!(printed.matches(": 0 worse, 0 better, 0 new, 0 gone.").count(), 2, "{printed}");
    assert!(!printed.contains("::error") && !printed.contains("::warning"), "{printed}");
    for file in ["junit.xml", "metrics.json", "github-action-benchmark.json", "report.json"] {
        assert!(CI.contains(file) && folder.path().join("target/verify").join(file).exists(), "{file}");
    }
}
