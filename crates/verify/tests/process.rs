//! Programs as solvers: what answers is judged like any solver, and what hangs, dies, floods or answers nonsense
//! becomes an error that says so, in bounded time and without a process left behind.
#![cfg(target_os = "linux")]

#[path = "all/programs.rs"]
mod programs;

use std::time::{Duration, Instant};

use toss::{
    Coin, ExactSolver, Landing, Launch, Settings, SolveError, Solver, SolverEntry, Stepping, TimeOfFlight, Toss,
    Vector3,
};
use verify::process::{Claim, Limits, OWN, Program};

use programs::{answering, example, has};

/// Limits that keep the tests of programs that hang short.
const SHORT: Limits = Limits { answer: Duration::from_millis(500), total: Duration::from_secs(60), memory: 200 << 20 };

/// Limits that a program that answers keeps, however busy the machine is.
const PATIENT: Limits = Limits { answer: Duration::from_secs(30), total: Duration::from_secs(120), memory: 200 << 20 };

/// The program of `command`, which answers each question.
fn program(command: &str) -> Program {
    Program { limits: PATIENT, ..Program::new(command) }
}

fn entry(command: &str) -> SolverEntry {
    program(command).entry("program")
}

/// The program of `command`, which hangs.
fn hanging(command: &str) -> SolverEntry {
    Program { limits: SHORT, ..Program::new(command) }.entry("program")
}

/// The solver of `entry` at a tolerance of 1e-10.
fn made(entry: &SolverEntry) -> Box<dyn Solver> {
    let stepping = Stepping::adaptive(OWN, 1e-10).expect("a valid tolerance");
    entry.solver(&Settings { stepping, ..Settings::default() }).expect("its scheme")
}

/// A toss that lasts so many seconds, which are the unit of time that its program sees, too.
fn toss(time: f64) -> Toss {
    let launch = Launch::new(Vector3::new(1.5, -0.5, 1.0), TimeOfFlight::Given(time)).expect("a valid launch");
    Toss::new(Coin::PAPER, launch.with_tilt(0.3).expect("a valid tilt"))
}

/// What `solver` answers on tosses of 1, 2, … s.
fn landings(solver: &dyn Solver, count: u32) -> Vec<Result<Landing, String>> {
    let land = |time| solver.land(&toss(f64::from(time))).map_err(|error| error.to_string());
    (1..=count).map(land).collect()
}

/// The ids of the processes of this program that match `is`, out of `/proc`.
fn children(is: impl Fn(&str) -> bool) -> Vec<u32> {
    let stat = |entry: std::fs::DirEntry| {
        let text = std::fs::read_to_string(entry.path().join("stat")).ok()?;
        let (head, rest) = text.rsplit_once(") ")?;
        let (id, mut fields) = (head.split(' ').next()?.parse().ok()?, rest.split(' '));
        let (state, parent) = (fields.next()?, fields.next()?.parse::<u32>().ok()?);
        (parent == std::process::id() && is(state)).then_some(id)
    };
    std::fs::read_dir("/proc").expect("Linux").flatten().filter_map(stat).collect()
}

#[test]
fn what_is_no_solver_is_an_error_that_says_why_in_bounded_time() {
    for (command, whys) in [
        ("true", ["ended (exit status: 0) without an answer"].as_slice()),
        ("false", &["ended (exit status: 1) without an answer"]),
        ("echo 'no such module' >&2; exit 3", &["ended (exit status: 3) without an answer: no such module"]),
        ("/no/such/program", &["ended (exit status: 127) without an answer", "not found"]),
        ("kill -SEGV $$", &["ended (signal: 11"]),
        ("cat", &["wrote \"id,i1,i3"]),
        ("yes", &["wrote \"y\""]),
        ("tr -d '\\n' < /dev/zero", &["wrote \"\\0"]),
        ("sleep 1000", &["gave no first answer within 3 s of its start (--answer-seconds 0.5 times 6)"]),
        ("cat > /dev/null", &["read question 1, wrote no answer within 3 s and waits for more", "without buffering"]),
        ("exec 0<&-; sleep 1000", &["answer"]),
        ("exec 1>&-; sleep 1000", &["closed its standard input or output"]),
        ("echo Welcome; cat > /dev/null", &["wrote \"Welcome\""]),
        (&answering("echo $id"), &["1 columns where 1,w,x,y,z is expected"]),
        (&answering("echo $id,1,0,0"), &["4 columns"]),
        (&answering("echo $w,$x,$y,$z,0"), &["it begins with '0.98"]),
        (&answering("echo $id,1,0,0,zero"), &["'zero' is no number"]),
        (&answering("printf '%s,1,0,0,0' $id; exit"), &["ended (exit status: 0)"]),
    ] {
        let began = Instant::now();
        let found = landings(&*made(&hanging(command)), 200);
        let error = found[0].as_ref().unwrap_err();
        assert!(whys.iter().all(|why| error.contains(why)), "{command}: {error}");
        let last = found[199].as_ref().unwrap_err();
        assert!(last.starts_with("solver 'program' failed: is no longer asked: it "), "{command}: {last}");
        assert!(began.elapsed() < Duration::from_secs(12), "{command}: {:?}", began.elapsed());
    }
    // Those of the tests that run at the same time may have just ended.
    for _ in 0..50 {
        if children(|state| state == "Z").is_empty() {
            return;
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    panic!("zombies: {:?}", children(|state| state == "Z"));
}

#[test]
fn a_process_that_takes_more_and_more_memory_is_ended() {
    // It looks for the last lines of an input without an end.
    let solver = made(&entry("tail /dev/zero"));
    let error = solver.land(&toss(1.0)).unwrap_err().to_string();
    assert!(error.contains("of memory, and 200 MB are its limit"), "{error}");
}

#[test]
fn answers_that_are_no_attitude_are_errors_of_their_toss_alone() {
    for (answer, why) in [
        ("nan,0,0,0", "the norm of the quaternion = NaN"),
        ("0,0,0,0", "the norm of the quaternion = 0"),
        ("inf,0,0,0", "the norm of the quaternion = inf"),
        ("1,1,0,0", "the norm of the quaternion = 1.414"),
        ("failed,too far for me", "failed: too far for me"),
        ("1,0,0,0,error=-1", "claims an error of -1"),
    ] {
        let body = format!("case $time in 2.0) echo $id,{answer};; *) echo $id,$w,$x,$y,$z,error=1e-9;; esac");
        let only = answering(&body);
        let solver = made(&entry(&only));
        let outcomes: Vec<Result<_, SolveError>> = [1.0, 2.0, 3.0].map(|time| solver.tilt(&toss(time))).into();
        assert!(outcomes[0].is_ok() && outcomes[2].is_ok(), "{answer}: {outcomes:?}");
        let error = outcomes[1].as_ref().unwrap_err().to_string();
        // An answer without the field `error` where the others have it is refused before its numbers are.
        let told = error.contains(why) || error.contains("an error with some of its answers");
        assert!(told, "{answer}: {error}");
    }
}

#[test]
fn a_process_that_dies_or_hangs_now_and_then_is_started_again() {
    let dies = answering("case $time in 3.0) kill -SEGV $$;; *) echo $id,$w,$x,$y,$z;; esac");
    let hangs = answering("case $time in 3.0) sleep 9;; *) echo $id,$w,$x,$y,$z;; esac");
    for (command, why) in
        [(dies, "ended (signal: 11"), (hangs, "gave no answer to question 3 within 0.5 s (--answer-seconds)")]
    {
        let found = landings(&*made(&hanging(&command)), 6);
        let failed: Vec<usize> = (0..6).filter(|index| found[*index].is_err()).collect();
        assert_eq!(failed, [2], "{command}: {found:?}");
        assert!(found[2].as_ref().unwrap_err().contains(why), "{found:?}");
    }
}

#[test]
fn a_process_that_hangs_often_is_given_up_with_what_it_did() {
    let hangs = answering("case $time in 1.0) echo $id,$w,$x,$y,$z;; *) sleep 9;; esac");
    let began = Instant::now();
    let found = landings(&*made(&hanging(&hangs)), 300);
    assert!(found[0].is_ok() && found[1..].iter().all(Result::is_err));
    let last = found[299].as_ref().unwrap_err();
    assert!(last.contains("is no longer asked: it gave no answer to question"), "{last}");
    assert!(began.elapsed() < Duration::from_secs(20), "{:?}", began.elapsed());
}

/// The first time that it is asked for the third toss, it hangs, as on a machine that was busy.
#[test]
fn a_question_that_took_too_long_is_asked_once_more() {
    let folder = tempfile::tempdir().unwrap();
    let marker = folder.path().join("hung");
    let hangs = format!("if [ $time = 3.0 ] && [ ! -e {0} ]; then touch {0}; sleep 9; fi", marker.display());
    let found = landings(&*made(&hanging(&answering(&format!("{hangs}; echo $id,$w,$x,$y,$z")))), 6);
    assert!(marker.exists() && found.iter().all(Result::is_ok), "{found:?}");
}

#[test]
fn a_program_that_takes_too_much_memory_from_the_start_is_ended() {
    let limits = Limits { memory: 1 << 18, ..PATIENT };
    let solver = made(&Program { limits, ..program(&answering("echo $id,$w,$x,$y,$z")) }.entry("program"));
    let error = solver.land(&toss(1.0)).unwrap_err().to_string();
    assert!(error.contains("of memory, and 0 MB are its limit"), "{error}");
}

/// A program is asked for bodies if its entry or one of its answers says so. Here nothing moves.
#[test]
fn bodies_are_asked_for_by_an_option_or_by_the_answer() {
    let launch = toss(0.0).launch;
    let bodies = [[1.0, 2.0, 2.5, 0.0, 0.0, 0.0], [2.0, 2.2, 1.4, 0.3, -0.1, 0.25]];
    let tosses = bodies.map(|inertia| Toss { body: toss::Body::from_inertia(inertia).unwrap(), launch });
    let coins_alone = made(&entry(&answering("echo $id,$w,$x,$y,$z")));
    let says_so = made(&entry(&answering("echo \"$id,$w,$x,$y,$z,bodies=yes,rate=$a;$b;$c\"")));
    let by_option = Program { takes_bodies: true, ..program(&answering("echo $id,$w,$x,$y,$z")) };
    let by_option = made(&by_option.entry("program"));
    for toss in tosses {
        assert_eq!(coins_alone.land(&toss).unwrap_err().kind(), "not_symmetric");
        for solver in [&says_so, &by_option] {
            let landing = solver.land(&toss).unwrap();
            assert!(landing.state.attitude.angle_to(&launch.attitude()) < 1e-15, "{landing:?}");
            assert!((landing.state.rate - launch.rate()).norm() < 1e-14, "{landing:?}");
        }
    }
}

#[test]
fn a_claim_is_flat_or_by_the_radian() {
    let land = |claim: &str, time| {
        let claim = Some(claim.parse().unwrap());
        let program = Program { claim, ..program(&answering("echo $id,$w,$x,$y,$z")) };
        made(&program.entry("program")).land(&toss(time)).unwrap().error.unwrap()
    };
    assert_eq!((land("1e-9", 1.0), land("1e-9", 9.0)), (1e-9, 1e-9));
    let phase = dynamics::Phases::new(&toss(9.0)).unwrap().largest;
    assert_eq!(land("1e-12/rad", 9.0), 1e-12 * (1.0 + phase));
    for refused in ["0", "-1", "1", "2", "nan", "inf", "x", "1e-9/m", "/rad", "", "0/rad"] {
        assert!(refused.parse::<Claim>().is_err(), "{refused}");
    }
}

#[test]
fn a_line_too_many_is_noticed_and_not_taken_for_an_answer() {
    let chatters = answering("echo $id,$w,$x,$y,$z; echo done with $id; sleep 0.05");
    let found = landings(&*made(&entry(&chatters)), 4);
    assert!(found[0].is_ok());
    let error = found[1].as_ref().unwrap_err();
    assert!(error.contains("wrote \"done with 1\""), "{error}");
    // The next toss is asked of a new process.
    assert!(found[2].is_ok(), "{found:?}");
}

#[test]
fn the_limit_of_all_answers_ends_a_slow_program() {
    let slow = answering("sleep 0.4; echo $id,$w,$x,$y,$z");
    let limits = Limits { total: Duration::from_secs(3), ..PATIENT };
    let solver = made(&Program { limits, ..Program::new(slow) }.entry("program"));
    let found = landings(&*solver, 12);
    assert!(found[0].is_ok());
    let error = found[11].as_ref().unwrap_err();
    assert!(error.contains("took more than 3 s for all its answers"), "{error}");
}

#[test]
fn processes_and_their_children_end_with_the_solver() {
    let marker = format!("999{}", std::process::id());
    let solver = made(&entry(&answering(&format!("sleep {marker} & echo $id,$w,$x,$y,$z; wait"))));
    assert!(solver.land(&toss(1.0)).is_ok());
    let asleep = || {
        let is_it = |entry: &std::fs::DirEntry| {
            let line = std::fs::read(entry.path().join("cmdline")).unwrap_or_default();
            line == format!("sleep\0{marker}\0").as_bytes()
        };
        std::fs::read_dir("/proc").unwrap().flatten().filter(is_it).count()
    };
    // Between fork and exec a child still has the command line of its parent.
    let becomes = |count: usize| {
        (0..100).any(|_| {
            std::thread::sleep(Duration::from_millis(20));
            asleep() == count
        })
    };
    assert!(becomes(1), "{} children", asleep());
    drop(solver);
    assert!(becomes(0), "the child of the process runs on");
}

#[test]
fn a_program_is_judged_by_its_claim_or_by_the_tolerance_or_by_its_own_error() {
    let toss = toss(0.5);
    let repeats = answering("echo $id,$w,$x,$y,$z");
    let solver = made(&entry(&repeats));
    let by_tolerance = Stepping::adaptive(OWN, 1e-10).unwrap().error_estimate(&toss).unwrap();
    assert_eq!(solver.land(&toss).unwrap().error, by_tolerance);
    assert!(entry(&repeats).integrates());
    let own = made(&entry(&answering("echo $id,$w,$x,$y,$z,error=$tolerance,calls=7")));
    let landing = own.land(&toss).unwrap();
    assert_eq!((landing.error, landing.work.rhs_calls), (Some(1e-10), 7));
    let claims = Program { claim: Claim::flat(0.25).ok(), ..program(&repeats) }.entry("program");
    assert!(!claims.integrates());
    let claims = made(&claims);
    assert_eq!((claims.land(&toss).unwrap().error, claims.stepping()), (Some(0.25), None));
    for claim in [0.0, -1.0, 1.0, f64::NAN] {
        assert_eq!(Claim::flat(claim).unwrap_err().field(), "claim");
    }
    // The coin lands as it was launched, so that the body rate is not that of the motion, but its momentum is.
    let landing = solver.land(&toss).unwrap();
    assert!(landing.state.attitude.angle_to(&toss.launch.attitude()) < 1e-15);
    assert!((landing.state.rate - toss.launch.rate()).norm() < 1e-14);
    assert!((landing.cos_tilt - ExactSolver.tilt(&toss).unwrap().cos_tilt).abs() > 1e-3);
}

#[test]
fn the_program_of_the_documentation_lands_as_the_exact_motion() {
    if !has("python3") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let solver = made(&entry(&example(folder.path())));
    for time in 0..200 {
        let toss = toss(0.1 * f64::from(time));
        let (found, exact) = (solver.land(&toss).unwrap(), ExactSolver.land(&toss).unwrap());
        assert!((found.cos_tilt - exact.cos_tilt).abs() < 1e-13, "{found:?}, not {exact:?}");
        assert!((found.state.rate - exact.state.rate).norm() < 1e-12);
    }
}

#[test]
fn the_page_for_authors_states_the_columns_and_the_limits() {
    let page = include_str!("../../../docs/your-solver.md");
    assert!(page.contains(&format!("```text\n{}\n1,", verify::process::HEADER)));
    let limits = Limits::default();
    let start = 6 * limits.answer;
    let says = [
        format!("within {} s ({} s for the first", limits.answer.as_secs(), start.as_secs()),
        format!("more than {} GB", limits.memory >> 30),
        format!("wastes {} s so, or has used {} minutes", start.as_secs(), limits.total.as_secs() / 60),
    ];
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    for words in says {
        assert!(page.contains(&words), "{words}");
    }
}
