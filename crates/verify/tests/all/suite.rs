//! These tests use the suite as a crate elsewhere does, for the solver of the example `own_solver` and for parts of our
//! registry: what it judges, what it leaves out, the limits that it proposes, and the program that it gives.

use std::path::Path;
use std::process::{Command, Output};

use toss::Registry;
use verify::judge::baseline;
use verify::judge::limits::Limits;
use verify::{CHECKS, Effort, Judges, Report, Row, Status, Suite, Verdict};

#[path = "../../examples/own_solver.rs"]
#[expect(dead_code, reason = "its main function is tested as a program")]
mod own_solver;

fn of_one_solver() -> Suite {
    let registry = Registry::empty().with(own_solver::entry()).expect("a name of its own");
    Suite::new(registry).effort(Effort::Quick).command("cargo run --release --")
}

fn failing(verified: &Report) -> Vec<&Row> {
    verified.rows.iter().filter(|row| !row.status.passes()).collect()
}

#[test]
fn a_solver_from_elsewhere_is_judged_alone_and_gets_limits_that_it_then_passes() {
    let folder = tempfile::tempdir().unwrap();
    let suite = of_one_solver().folder(folder.path());
    let mut verified = suite.run().unwrap();
    assert_eq!(failing(&verified), Vec::<&Row>::new());
    assert_eq!((verified.verdict(), verified.exit_code()), (Verdict::Pass, 0));
    for row in &verified.rows {
        assert_eq!((row.subject.as_str(), row.judges), ("two-turns", Some(Judges::Solver)), "{row:?}");
        let replay = row.replay.as_deref();
        assert!(replay.is_none_or(|replay| replay.starts_with("cargo run --release -- ")), "{replay:?}");
    }
    let run: Vec<&str> = verified.rows.iter().map(|row| row.check.as_str()).collect();
    for check in ["reference-attitude", "random-cos-tilt", "adversarial-silence", "atlas-answers", "fig4-same-counts"] {
        assert!(run.contains(&check), "{check}");
    }
    let left_out = |check: &str| verified.left_out.iter().any(|left_out| left_out.check == check);
    assert!(left_out("batch-cos-tilt"), "{:?}", verified.left_out);
    assert!(CHECKS.iter().all(|check| run.contains(&check.id) || left_out(check.id)));

    let proposed = verified.proposed_limits().expect("no row has a limit");
    let judged = of_one_solver().limits(Limits::parse(&proposed).unwrap()).run().unwrap();
    // Where nothing deviates, or the ceiling of the check judges, there is no limit to propose.
    let ceiling = |row: &Row| CHECKS.iter().find(|check| check.id == row.check).map(|check| check.ceiling);
    let needs_none = |row: &Row| row.measured == Some(0.0) || row.limit == ceiling(row);
    let by_limits = |row: &Row| matches!(row.status, Status::Pass | Status::PassLoose) || needs_none(row);
    assert!(judged.rows.iter().all(by_limits), "{:#?}", judged.rows);
    let owed = judged.rows.iter().filter(|row| !needs_none(row)).count();
    assert!(owed >= 8, "{owed}");
    assert_eq!(judged.proposed_limits(), None);

    suite.accept(&mut verified).unwrap();
    assert!(baseline::file(&folder.path().join("baseline"), Effort::Quick).exists());
    assert!(suite.run().unwrap().moves.is_empty(), "a second run finds what the first one did");
}

#[test]
fn a_part_of_our_registry_is_judged_by_our_limits_and_needs_no_rows_of_the_others() {
    let registry = Registry::standard().only(&["gamma"]).unwrap();
    let verified = Suite::new(registry).effort(Effort::Quick).folder("no/such/folder").run().unwrap();
    assert_eq!(failing(&verified), Vec::<&Row>::new());
    assert!(verified.rows.iter().all(|row| row.subject.starts_with("gamma") && row.limit.is_some()));
    assert_eq!(verified.proposed_limits(), None);
}

#[test]
fn a_misspelt_limit_and_an_unknown_check_are_found() {
    let misspelt = "[random-cos-tilt]\nreason = 'r'\nallowed = { two-turn = 1e-9 }";
    let verified = of_one_solver().limits(Limits::parse(misspelt).unwrap()).run().unwrap();
    let failing = failing(&verified);
    assert_eq!(failing.len(), 1, "{failing:?}");
    assert_eq!((failing[0].subject.as_str(), failing[0].status), ("two-turn", Status::NotMeasured));
    assert_eq!(verified.exit_code(), 1);
    let error = of_one_solver().only("random").run().err().expect("an error").to_string();
    assert!(error.starts_with("no such check: 'random'; known: reference-cos-tilt, "), "{error}");
    let error = of_one_solver().only("catalogue-moments").run().unwrap().verdict();
    assert_eq!(error, Verdict::Pass, "a check of the library is run if it is asked for by name");
}

/// Runs the example as a program in `folder`.
fn program(arguments: &[&str], folder: &Path) -> Output {
    let test = std::env::current_exe().expect("a test knows where it is");
    let profile = test.ancestors().nth(2).expect("target/PROFILE/deps/TEST");
    let example = profile.join("examples/own_solver").with_extension(std::env::consts::EXE_EXTENSION);
    let output = Command::new(&example).args(arguments).current_dir(folder).output();
    output.unwrap_or_else(|error| panic!("{}: {error}; `cargo test -p verify` builds it", example.display()))
}

#[test]
fn the_program_of_another_crate_keeps_its_files_in_its_own_folder_and_knows_its_solver() {
    let folder = tempfile::tempdir().unwrap();
    let output = program(&["--only", "random-attitude"], folder.path());
    let table = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{table}");
    assert!(table.contains("proposed limits: target/verify/limits.proposed.toml"), "{table}");
    let proposed = std::fs::read_to_string(folder.path().join("target/verify/limits.proposed.toml")).unwrap();
    assert!(proposed.contains("[random-attitude.allowed]\n\"two-turns\" = "), "{proposed}");

    std::fs::create_dir(folder.path().join("validation")).unwrap();
    let tight = "[random-attitude]\nreason = 'a test'\nallowed = { two-turns = 1e-18 }";
    std::fs::write(folder.path().join("validation/limits.toml"), tight).unwrap();
    let output = program(&["--only", "random-attitude"], folder.path());
    let table = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{table}");
    let repeat = "repeat with: cargo run --release --example own_solver -- --replay \"";
    let command = table.lines().find_map(|line| line.trim().strip_prefix(repeat)).expect(&table);
    let (toss, row) = command.trim_end_matches('"').split_once("\" --row \"").expect(&table);
    let output = program(&["--replay", toss, "--row", row], folder.path());
    assert_eq!(output.status.code(), Some(1), "a row that fails");
    let judged = String::from_utf8(output.stdout).unwrap();
    assert!(judged.contains("random-attitude / two-turns") && judged.contains("FAIL"), "{judged}");
    let output = program(&["--replay", toss], folder.path());
    let answers = String::from_utf8(output.stdout).unwrap();
    assert!(answers.contains("two-turns") && answers.contains("right"), "{answers}");
    assert!(!answers.contains("gamma"), "the solvers are those of the suite: {answers}");
}

#[test]
fn an_interrupted_run_goes_on_with_what_the_same_program_has_kept() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("measured/quick/reference-cos-tilt.toml");
    let run = || of_one_solver().only("reference-cos-tilt").folder(folder.path()).keeping_in(folder.path()).run();
    let measured = run().unwrap().rows[0].clone();
    // A number that no run finds shows whether it was read or measured.
    let kept = std::fs::read_to_string(&file).unwrap();
    let found = format!("cases = {}", measured.cases);
    assert_eq!(kept.matches(&found).count(), 1, "{kept}");
    std::fs::write(&file, kept.replace(&found, "cases = 12345")).unwrap();
    assert_eq!(run().unwrap().rows, [Row { cases: 12345, ..measured.clone() }]);
    // Of another program nothing is taken.
    let program = kept.lines().next().unwrap();
    std::fs::write(&file, kept.replace(&found, "cases = 12345").replace(program, "program = \"another\"")).unwrap();
    assert_eq!(run().unwrap().rows, [measured]);
    std::fs::write(&file, "no = 1").unwrap();
    let error = format!("{:#}", run().err().expect("a file that is none"));
    assert!(error.contains("reference-cos-tilt.toml: remove it, to measure reference-cos-tilt again"), "{error}");
}
