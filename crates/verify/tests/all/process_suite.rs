//! Whole runs of the suite over a program: they end in bounded time, with a row that says what it did.

use std::time::{Duration, Instant};

use toss::{Scheme, SolverEntry};
use verify::process::{Claim, Program};
use verify::{CHECKS, Context, Effort};

use crate::programs::{answering, example, has};

/// What `verify run` with a program prints and its exit code.
fn verified(arguments: &[&str]) -> (String, Option<i32>) {
    verify(&[&["--quick", "--only", "random-cos-tilt"], arguments].concat())
}

/// What `verify run` prints, and its exit code.
fn verify(arguments: &[&str]) -> (String, Option<i32>) {
    verify_into(arguments, tempfile::tempdir().expect("a folder").path())
}

/// The same with its reports in the folder `out`.
fn verify_into(arguments: &[&str], out: &std::path::Path) -> (String, Option<i32>) {
    let mut verify = std::process::Command::new(env!("CARGO_BIN_EXE_verify"));
    let found = verify.arg("run").args(arguments).arg("--out").arg(out);
    let found = found.output().expect("it starts");
    let text = [found.stdout, found.stderr].concat();
    (String::from_utf8_lossy(&text).into_owned(), found.status.code())
}

#[test]
fn a_run_of_the_suite_ends_with_a_row_that_says_what_the_program_did() {
    // What else a program may do, `process.rs` asks of its solver.
    for (command, why) in [
        ("cat", "wrote \"id,i1,i3"),
        ("sleep 1000", "gave no first answer within 3 s"),
        (&*answering("echo $id,nan,0,0,0"), "the norm of the quaternion = NaN"),
    ] {
        let began = Instant::now();
        let limits = ["--answer-seconds", "0.5", "--memory-mb", "200"];
        let (text, code) = verified(&[&["--command", command], &limits[..]].concat());
        assert!(code == Some(1) && text.contains(why), "{command}: {code:?}, {text}");
        let repeated = "cargo xtask verify --replay \"";
        assert!(text.contains(repeated) || text.contains("cargo xtask verify --only random-cos-tilt"), "{text}");
        assert!(text.contains(&format!(" --command '{command}' --answer-seconds 0.5 --memory-mb 200")), "{text}");
        assert!(began.elapsed() < Duration::from_secs(60), "{command}: {:?}", began.elapsed());
    }
    for refused in [
        ["--claim", "1e-9"].as_slice(),
        &["--command", "true", "--claim", "0"],
        &["--command", "true", "--claim", "nan"],
        &["--command", "true", "--claim", "1/rad"],
        &["--command", " "],
        &["--bodies"],
    ] {
        assert_eq!(verified(refused).1, Some(2), "{refused:?}");
    }
}

/// The first lines say what the program does wrong, before any table, and a replay shows the question as it got it.
#[test]
fn the_first_lines_name_the_likeliest_cause() {
    let still = answering("echo $id,$w,$x,$y,$z");
    let cause = "command/own: right if nothing moves: it answers the attitude at launch: 143 of 143.";
    let out = tempfile::tempdir().expect("a folder");
    let (text, code) = verify_into(&["--quick", "--command", &still], out.path());
    let first = "Fails: command, in one check (reference-cos-tilt).";
    assert!(code == Some(1) && text.contains(&format!("\n{cause}\n{first}\n")), "{code:?}, {text}");
    // It is said before the checks, too, of which the others would fail for the same reason.
    let early = "As this explains every answer, the run ends with the first check that fails.\nreference-cos-tilt  ";
    assert!(text.contains(&format!("{cause}\n{early}")), "{text}");
    let left_out = "left out, as the likeliest cause explains every answer: reference-attitude, ";
    assert!(text.contains("FAIL: 0 of 1 rows pass") && text.contains(left_out), "{text}");
    for file in ["report.html", "junit.xml", "summary.md"] {
        let report = std::fs::read_to_string(out.path().join(file)).expect(file);
        assert!(report.contains(cause), "{file}: {report}");
    }
    let toss = "moments=1.0,0.5 rate=1.0,0.0,0.0 time=1.0 tilt=0.0";
    let (text, code) = verify(&["--replay", toss, "--command", &still]);
    let shown = "  id,i1,i3,rate_x,rate_y,rate_z,w,x,y,z,time,tolerance,i2\n  \
                 2,1.0,0.5,1.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,1e-10,1.0\n  \
                 answer:   2,1.0,0.0,0.0,0.0\n  expected: 0.877582561890372";
    assert!(code == Some(1) && text.contains(shown) && text.contains("cos θ = 0.5403023058681398"), "{code:?}, {text}");
}

/// A cause that says which launches are wrong leaves open what the checks find beside. Where a program hangs, it is soon ended.
#[test]
fn a_program_that_hangs_on_some_questions_is_told_on_which() {
    if !has("python3") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let command = example(folder.path());
    let script = folder.path().join("mine.py");
    let text = std::fs::read_to_string(&script).unwrap();
    let hangs = "    if i3 > 1.9 * i1:\n        sys.stdin.read()\n    print(row";
    std::fs::write(&script, text.replace("    print(row", hangs)).unwrap();
    let (text, code) = verified(&["--command", &command, "--answer-seconds", "0.5"]);
    assert!(code == Some(1) && text.contains("\ncommand/own: right only where k = i3/i1 < 1.9"), "{code:?}, {text}");
    let told =
        "; no answer there: it answers nothing within 0.1 s.\nThe smallest question that this does not explain:\n";
    assert!(text.contains(told) && text.contains("The checks go on") && text.contains("random-cos-tilt  "), "{text}");
}

/// What the tolerance permits is no claim, so that a right program or stepper may be far more accurate.
#[test]
fn a_solver_that_states_no_error_claims_none() {
    let check = CHECKS.iter().find(|check| check.id == "claims-measured").expect("a check");
    let claims = |entry: SolverEntry| {
        let context = Context::new(&[entry], Effort::Quick).expect("a context");
        check.measure(&context).expect("rows").len()
    };
    let program = |body: &str| Program::new(answering(body));
    assert_eq!(claims(program("echo $id,$w,$x,$y,$z").entry("program")), 0);
    assert_eq!(claims(program("echo $id,$w,$x,$y,$z,error=1e-3").entry("program")), 1);
    let claiming = Program { claim: Claim::flat(1e-3).ok(), ..program("echo $id,$w,$x,$y,$z") };
    assert_eq!(claims(claiming.entry("program")), 1);
    let stepper = SolverEntry::from_stepper("stepper", "", &[Scheme::DOP853], |system, _| {
        Ok((system.start(), system.work(1, 0)))
    });
    assert_eq!(claims(stepper), 0);
}

#[test]
fn restarts_and_launches_without_an_answer_are_counted() {
    let dies = answering("[ $id = 100 ] && exit; echo $id,$w,$x,$y,$z");
    let (text, code) = verified(&["--command", &dies, "--format", "json"]);
    // Behind the report stands what was said on standard error.
    let first = serde_json::Deserializer::from_str(&text).into_iter::<serde_json::Value>().next();
    let report = first.expect("a report").expect(&text);
    let (row, program) = (&report["rows"][0], &report["program"]);
    assert!(code == Some(1) && row["without_answer"].as_u64() >= Some(8), "{row}");
    assert!(program["starts"].as_u64() >= Some(10) && program["without_answer"].as_u64() >= Some(8), "{program}");
    let (text, _) = verified(&["--command", &dies]);
    assert!(text.contains("The program was started ") && text.contains(" launches are without an answer"), "{text}");
    assert!(text.contains("launches without an answer: ") && text.contains(" of 1000\n"), "{text}");
}

#[test]
fn a_program_that_errs_by_more_than_its_claim_fails() {
    if !has("python3") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let command = example(folder.path());
    // The program of the page for authors is off by its rounding errors, which are above this claim.
    let (text, code) = verified(&["--command", &command, "--claim", "1e-18"]);
    assert!(code == Some(1) && text.contains("above its own claim"), "{code:?}, {text}");
}

#[test]
fn a_failure_at_one_tolerance_is_repeated_at_that_tolerance() {
    if !has("python3") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let command = example(folder.path());
    let script = folder.path().join("mine.py");
    let (wrong, print) = (
        "    if float(row['tolerance']) < 5e-12:\n        landing = product(landing, turn(1e-3, 0.0, 0.0))\n",
        "    print(row",
    );
    let text = std::fs::read_to_string(&script).unwrap().replace(print, &format!("{wrong}{print}"));
    std::fs::write(&script, text).unwrap();
    let (text, code) = verify(&["--quick", "--only", "adversarial-silence", "--command", &command]);
    assert!(code == Some(1) && text.contains(" times what its estimate allows"), "{code:?}, {text}");
    let input = text.split("--replay \"").nth(1).and_then(|rest| rest.split('"').next()).expect(&text);
    let (toss, tolerance) = input.split_once(" tolerance=").expect(input);
    assert_eq!(tolerance, "1e-12");
    let replay = |input: &str| verify(&["--replay", input, "--command", &command]);
    let (text, code) = replay(input);
    assert!(code == Some(1) && text.contains("silently wrong"), "{code:?}, {text}");
    let (text, code) = replay(toss);
    assert!(code == Some(0) && text.contains("right"), "at the usual tolerance: {code:?}, {text}");
    let (text, code) = verify(&["--replay", input, "--row", "random-cos-tilt / command/own", "--command", &command]);
    assert!(code == Some(4) && text.contains("leave it out"), "{code:?}, {text}");
}

/// Every character that is no letter to a reader: controls, ends of lines, turned directions, and what XML has no place for.
fn hostile() -> String {
    let controls = (1..=0x9f_u8).filter(|code| *code != b'\n' && !(0x20..0x7f).contains(code)).map(char::from);
    let others = "\u{fffe}\u{ffff}\u{1fffe}\u{2028}\u{2029}\u{202e}\u{2066}\u{200f}\u{feff}";
    let text = "]]> <b>&amp; \"'` | ** % ::error::fake \u{1b}]0;title\u{7}\u{1b}[31mred\u{1b}[2J";
    format!("begin {}\0{others}{text} end", controls.collect::<String>())
}

#[test]
fn what_a_program_says_is_one_line_without_controls_in_every_format() {
    let (folder, out) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let (words, summary) = (folder.path().join("words"), folder.path().join("summary"));
    std::fs::write(&words, hostile() + "\n").unwrap();
    let command = answering(&format!("printf %s, $id,failed; cat '{}'", words.display()));
    let command = format!("{command} # \u{1b}[31m\nerror: fake");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_verify"))
        .args(["--quick", "--only", "reference-cos-tilt", "--format", "github", "--command", &command, "--out"])
        .arg(out.path().join("o\u{1b}[31m\nut"))
        .env("GITHUB_STEP_SUMMARY", &summary)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let mut texts = vec![
        ("stdout".to_owned(), String::from_utf8(output.stdout).unwrap()),
        ("stderr".to_owned(), String::from_utf8(output.stderr).unwrap()),
        ("summary".to_owned(), std::fs::read_to_string(&summary).unwrap()),
    ];
    let written = std::fs::read_dir(out.path().join("o\u{1b}[31m\nut")).unwrap().flatten();
    texts.extend(
        written.map(|file| {
            (file.file_name().to_string_lossy().into_owned(), std::fs::read_to_string(file.path()).unwrap())
        }),
    );
    assert_eq!(texts.len(), 7);
    for (name, text) in &texts {
        let unseen = text.chars().find(|character| {
            let is_unseen = character.is_control()
                || "\u{fffe}\u{ffff}\u{1fffe}\u{2028}\u{2029}\u{202e}\u{2066}\u{200f}\u{feff}".contains(*character);
            is_unseen && *character != '\n'
        });
        assert_eq!(unseen, None, "{name}");
        assert!(!text.lines().any(|line| line.trim_start().starts_with("error: fake")), "{name}: {text}");
        assert!(!text.lines().any(|line| line.trim_start().starts_with("::error::fake")), "{name}: {text}");
        let says = ["stdout", "summary", "summary.md", "report.html", "report.json", "junit.xml"].contains(&&**name);
        assert!(!says || text.contains("u{1b}[2J end"), "{name}: {text}");
    }
    let junit = out.path().join("o\u{1b}[31m\nut/junit.xml");
    if has("python3") {
        let parse = "import sys, xml.dom.minidom; xml.dom.minidom.parse(open(sys.argv[1], 'rb'))";
        let parsed = std::process::Command::new("python3").args(["-c", parse]).arg(junit).output().unwrap();
        assert!(parsed.status.success(), "{}", String::from_utf8_lossy(&parsed.stderr));
    }
}

#[test]
fn the_command_of_a_failing_row_ends_with_the_code_of_the_row() {
    let folder = tempfile::tempdir().unwrap();
    let turns = answering("echo $id,$x,$w,$y,$z,error=1e-9");
    let declines = answering("echo $id,failed,it\\'s too far");
    let two_lines = format!("cd /\n{declines}");
    for command in [&*turns, &declines, &two_lines, "exit 3"] {
        for check in ["reference-cos-tilt", "random-cos-tilt", "adversarial-refusals"] {
            let (text, code) = verify(&["--quick", "--only", check, "--command", command]);
            // Wrong answers are no refusals.
            if code == Some(0) && command == turns {
                continue;
            }
            assert_eq!(code, Some(1), "{command}: {text}");
            let again = text.lines().find_map(|line| line.trim().strip_prefix("repeat with: ")).expect(&text);
            let output =
                crate::pages::run(&format!("{again} --out out"), crate::pages::verify_program(), folder.path());
            assert_eq!(output.status.code(), Some(1), "{again}: {output:?}");
        }
    }
}
