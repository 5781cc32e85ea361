//! These tests follow docs/your-solver.md and docs/ci.md to the letter: they run the programs that the pages show, whole,
//! by the commands that the pages show, in their order, and compare the reports.

use std::path::Path;
use std::process::{Command, Output};

use crate::programs::{example, has};

const SOLVER: &str = include_str!("../../../../docs/your-solver.md");
const CI: &str = include_str!("../../../../docs/ci.md");

/// The block of `page` behind the fence that says `kind`.
fn block<'a>(page: &'a str, kind: &str) -> &'a str {
    let block = page.split(&format!("```{kind}\n")).nth(1).and_then(|rest| rest.split("```").next());
    block.unwrap_or_else(|| panic!("no block {kind}"))
}

/// Runs the lines of `script` in `folder`, where `cargo` starts `program` with what stands behind `run … --`, or behind
/// `xtask verify`, and builds nothing. The first command that fails ends it.
pub(crate) fn run(script: &str, program: &Path, folder: &Path) -> Output {
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

/// The suite's own program.
pub(crate) fn verify_program() -> &'static Path {
    Path::new(env!("CARGO_BIN_EXE_verify"))
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
    if !has("python3") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    example(folder.path());
    assert_printed("program", verify_program(), folder.path());
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
    for file in ["junit.xml", "report.json"] {
        assert!(CI.contains(file) && folder.path().join("target/verify").join(file).exists(), "{file}");
    }
}

/// Copies what is in `from`, with its folders.
fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("a folder");
    for entry in std::fs::read_dir(from).expect("a folder").flatten() {
        let to = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &to);
        } else {
            std::fs::copy(entry.path(), to).expect("a copy");
        }
    }
}

#[test]
fn the_template_passes_in_a_folder_of_its_own_and_becomes_worse_when_its_program_does() {
    if !has("python3") || !has("c++") {
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../templates/your-solver"), folder.path());
    let file = |name: &str| std::fs::read_to_string(folder.path().join(name)).expect(name);
    let workflow = file(".github/workflows/accuracy.yml");
    let check = workflow.lines().find_map(|line| line.trim().strip_prefix("- run: sh ")).expect("the check");
    assert!(
        workflow.contains("path: unfair-toss\n") && file("check.sh").contains("VERIFY:-unfair-toss/target/release")
    );
    let one = "random-cos-tilt";
    let verify = |script: &str| {
        let output = run(&format!("export VERIFY=\"$PROGRAM\"\n{script}"), verify_program(), folder.path());
        let text = [output.stdout, output.stderr].concat();
        (output.status.code(), String::from_utf8_lossy(&text).into_owned())
    };
    let (code, text) = verify(&format!("sh {check}"));
    assert!(code == Some(0) && text.matches("\nPASS: 2").count() == 2, "{code:?} {text}");
    let (code, text) = verify(&format!("sh {check} --only {one}"));
    assert!(code == Some(0) && text.matches("PASS: 1 of 1 rows pass\n").count() == 2, "{code:?} {text}");
    assert_eq!(text.matches("There is no baseline yet at validation/").count(), 2, "{text}");
    for language in ["python", "cpp"] {
        let limits = file(&format!("validation/{language}/limits.toml"));
        let digits = limits.lines().filter_map(|line| line.split_once("\"command/own\" = ")).map(|(_, limit)| limit);
        for limit in digits {
            let mantissa = limit.split('e').next().unwrap_or_default();
            assert!(limit.parse::<f64>().is_ok_and(|limit| limit > 0.0) && mantissa.len() <= 3, "{language}: {limit}");
        }
        // As if the program had been ten times as accurate.
        let report: serde_json::Value =
            serde_json::from_str(&file(&format!("out/{language}/report.json"))).expect("JSON");
        let error = report["rows"][0]["measured"].as_f64().expect("an error");
        let baseline = verify::judge::baseline::file(
            &folder.path().join(format!("validation/{language}/baseline")),
            verify::Effort::Quick,
        );
        std::fs::create_dir_all(baseline.parent().expect("a folder")).expect("a folder");
        std::fs::write(baseline, format!("check,subject,error,calls\n{one},command/own,{:e},\n", error / 10.0))
            .expect(language);
    }
    let (code, text) = verify(&format!("sh {check} --only {one}"));
    assert!(code == Some(3) && text.matches("WORSE than the baseline: 1").count() == 2, "{code:?} {text}");
    assert_eq!(text.matches("::warning title=random-cos-tilt / command/own").count(), 2, "{text}");
    let wrong = file("solver.py").replace("turn(x, y, k * z)", "turn(x, y, z)");
    assert_ne!(wrong, file("solver.py"));
    std::fs::write(folder.path().join("solver.py"), wrong).expect("a program");
    let (_, text) = verify(&format!("sh {check} --only {one}"));
    assert!(text.contains("FAIL: 0 of 1 rows pass") && text.contains("::error title=random-cos-tilt"), "{text}");
}
