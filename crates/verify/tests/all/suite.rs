//! These tests use the suite as a crate elsewhere does, for the solver of the example `own_solver` and for parts of our
//! registry: what it judges, what it leaves out, the limits that it proposes, and the program that it gives.

use std::path::Path;
use std::process::{Command, Output};

use toss::{Attitude, Body, ExactSolver, Landing, Registry, Scheme, SolveError, Solver, SolverEntry, Toss, Vector3};
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
    let suite = || of_one_solver().folder(folder.path());
    let mut verified = suite().keeping_in(folder.path()).run().unwrap();
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
    // What the first run has kept is judged by limits, and not measured again.
    let limits = Limits::parse(&proposed).unwrap();
    let judged = of_one_solver().limits(limits).keeping_in(folder.path()).run().unwrap();
    // Where nothing deviates, or the ceiling of the check judges, there is no limit to propose.
    let ceiling = |row: &Row| CHECKS.iter().find(|check| check.id == row.check).map(|check| check.ceiling);
    let needs_none = |row: &Row| row.measured == Some(0.0) || row.limit == ceiling(row);
    let by_limits = |row: &Row| matches!(row.status, Status::Pass | Status::PassLoose) || needs_none(row);
    assert!(judged.rows.iter().all(by_limits), "{:#?}", judged.rows);
    let owed = judged.rows.iter().filter(|row| !needs_none(row)).count();
    assert!(owed >= 8, "{owed}");
    assert_eq!(judged.proposed_limits(), None);

    suite().accept(&mut verified).unwrap();
    assert!(baseline::file(&folder.path().join("baseline"), Effort::Quick).exists());
    assert!(suite().run().unwrap().moves.is_empty(), "a second run finds what the first one did");
}

#[test]
fn a_part_of_our_registry_is_judged_by_our_limits_and_needs_no_rows_of_the_others() {
    let registry = Registry::standard().only(&["exact"]).unwrap();
    let verified = Suite::new(registry).effort(Effort::Quick).folder("no/such/folder").run().unwrap();
    assert_eq!(failing(&verified), Vec::<&Row>::new());
    assert!(verified.rows.iter().all(|row| row.subject.starts_with("exact") && row.limit.is_some()));
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

/// A wrong function, a rough stepper and a wrong solver of bodies are told what a program is told.
#[test]
fn wrong_solvers_in_rust_get_a_diagnosis() {
    let reversed = SolverEntry::from_attitude(
        "reversed",
        "",
        |_| 1e-12,
        |toss| {
            let k = toss.coin.inertia_ratio();
            let (rate, time) = (toss.launch.rate(), toss.launch.flight_time());
            let momentum = Vector3::new(rate.x, rate.y, k * rate.z) * time;
            let half = 0.5 * momentum.norm();
            let axis = momentum.try_normalize(0.0).unwrap_or(Vector3::z());
            let turn = Attitude::about_unit_axis(&axis, half.sin_cos());
            Ok(toss.launch.attitude() * turn * Attitude::about_z((k - 1.0) * rate.z * time))
        },
    );
    let rough = SolverEntry::from_stepper("rough", "", &[Scheme::DOP853], |system, _| {
        let steps = (50.0 * system.duration()).ceil().clamp(1.0, 1e5);
        let (mut y, step) = (system.start(), system.duration() / steps);
        for _ in 0..steps as u64 {
            let slope = system.derivative(&y);
            let middle = std::array::from_fn(|i| y[i] + 0.5 * step * slope[i]);
            let slope = system.derivative(&middle);
            y = std::array::from_fn(|i| y[i] + step * slope[i]);
        }
        Ok((y, system.work(steps as u64, 0)))
    });
    let exchanged = SolverEntry::new("exchanged", "", |_| Box::new(Exchanged));
    for (entry, check, cause) in [
        (reversed, "any-launch", "reversed: right if its spin about n is reversed: 1000 of 1000."),
        (rough, "any-launch", "rough/dop853: right up to a tolerance of about "),
        (exchanged, "bodies-within-estimate", "exchanged: right if i1 and i2 are exchanged: 884 of 884."),
    ] {
        let suite = Suite::new(Registry::empty().with(entry).expect("a name")).effort(Effort::Quick).only(check);
        let report = suite.run().expect("a report");
        let page = tempfile::tempdir().expect("a folder");
        report.write(page.path()).expect("written");
        let summary = std::fs::read_to_string(page.path().join("summary.md")).expect("a summary");
        assert!(!report.passed && summary.contains(cause), "{summary}");
    }
}

/// It takes i1 for i2, and refuses tensors.
struct Exchanged;

impl Solver for Exchanged {
    fn name(&self) -> &str {
        "exchanged"
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let Some([i1, i2, i3]) = toss.body.moments() else {
            return Err(SolveError::NotSymmetric { solver: "exchanged".to_owned(), why: "it takes moments alone" });
        };
        let body = Body::from_moments([i2, i1, i3]).map_err(|error| SolveError::failed("exchanged", error))?;
        Ok(ExactSolver.land(&Toss { body, ..*toss })?.with_error(1e-12))
    }
}
