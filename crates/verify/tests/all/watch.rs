//! A check that is slow, panics or never ends must become a failing row; none may hide the rows of the others.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use toss::ExactSolver;
use verify::judge::Judge;
use verify::judge::limits::Limits;
use verify::judge::time::Timing;
use verify::measure::replay::Commands;
use verify::watch::{self, End};
use verify::{Check, Context, Effort, Measure, Measurement, Row};

const QUICK: Measure = Measure::Own(|_| Ok(vec![Measurement::figure("all", 0.0, 1, String::new())]));

static FINE: Check = Check::of_library("quick", QUICK);
static PANICS: Check = Check::of_library("panics", Measure::Own(|_| panic!("out of order")));
static WAITS: Check =
    Check::of_library("waits", Measure::Own(|_| for_ever(|| std::thread::sleep(Duration::from_secs(1)))));
static COMPUTES: Check = Check::of_library("computes", Measure::Own(|_| for_ever(std::hint::spin_loop)));

fn for_ever<T>(wait: fn()) -> T {
    loop {
        wait();
    }
}

/// What became of each of `checks`, with limits of 50 s times `factor`.
fn run(checks: &[&'static Check], factor: f64) -> Vec<(String, Timing, End)> {
    let context = Context::new(&[ExactSolver::entry()], Effort::Quick).expect("the reference numbers");
    let mut ended = Vec::new();
    let end = |check: &Check, timing: Timing, end: End| {
        ended.push((check.id.to_owned(), timing, end));
        Ok(ControlFlow::Continue(()))
    };
    watch::run(checks, &Arc::new(context), factor, |_| {}, end).expect("no error");
    ended
}

#[test]
fn a_check_that_panics_fails_alone() {
    let ended = run(&[&FINE, &PANICS, &FINE], 1.0);
    let names: Vec<&str> = ended.iter().map(|(name, ..)| name.as_str()).collect();
    assert_eq!(names, ["quick", "panics", "quick"]);
    assert!(matches!(&ended[1].2, End::Failed(why) if why == "panicked: out of order"), "{ended:?}");
    assert!(matches!(&ended[2].2, End::Measured(all) if all.len() == 1), "{ended:?}");
}

#[test]
fn a_check_that_never_ends_ends_the_run_with_a_row_that_says_so() {
    for (check, factor) in [(&WAITS, 1e-3), (&COMPUTES, 1e-3)] {
        let started = Instant::now();
        let ended = run(&[&FINE, check, &FINE, &FINE], factor);
        assert_eq!(ended.len(), 2, "{}", check.id);
        let (_, timing, End::Failed(why)) = &ended[1] else { panic!("{ended:?}") };
        assert!(why.starts_with("did not end within") && why.ends_with("the 2 checks after it were not run"), "{why}");
        assert!(!timing.failing(why).status.passes());
        assert!(started.elapsed() < Duration::from_secs(60), "{:?}", started.elapsed());
    }
}

#[test]
fn a_check_that_took_too_long_keeps_its_rows_and_gets_a_failing_one() {
    let limits = Limits::parse("[quick]\nreason = 'r'\nallowed = { all = 0.0 }").expect("limits");
    let commands = Commands::of_this_workspace();
    let judge = Judge { limits: &limits, commands: &commands, effort: Effort::Quick };
    let end = || End::Measured(vec![Measurement::figure("all", 0.0, 1, String::new())]);
    let timing = |took| Timing { check: "quick".to_owned(), t_wall_s: 1.0, t_processor_s: Some(took), limit_s: 50.0 };
    let names = |rows: Vec<Row>| -> Vec<(String, bool)> {
        rows.into_iter().map(|row| (row.subject, row.status.passes())).collect()
    };
    let all = || ("all".to_owned(), true);
    assert_eq!(names(end().rows(&FINE, &timing(49.0), judge)), [all()]);
    assert_eq!(names(end().rows(&FINE, &timing(51.0), judge)), [all(), ("time".to_owned(), false)]);
    let failed = End::Failed("panicked: x".to_owned()).rows(&FINE, &timing(1.0), judge);
    assert_eq!(failed[0].failure.as_deref(), Some("panicked: x"));
    assert_eq!(failed[0].replay.as_deref(), Some("cargo xtask verify --only quick --quick"));
    assert!(!failed[0].status.passes());
}
