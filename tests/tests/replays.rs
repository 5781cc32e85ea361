//! Every row of the verification prints a command that repeats its worst case. These tests give the command of every row
//! of a quick run to the program that it names, which has to accept it and to run what the row measured.

use toss::Registry;
use verify::judge::Judge;
use verify::judge::limits::Limits;
use verify::measure::case;
use verify::measure::replay::Commands;
use verify::{CHECKS, Context, Effort, Measure, Row};

const TOSS: &str = "cargo run -q --release --bin unfair-toss -- toss ";
const ALL: &str = "cargo xtask verify --replay ";
const CHECK: &str = "cargo xtask verify --only ";

/// Checks that are left out because together they sample, plan or search for a minute; all their rows are repeated by the
/// whole check.
const LONG: [&str; 8] = [
    "adversarial-silence",
    "atlas-answers",
    "work-precision",
    "sampling-errors",
    "interval-coverage",
    "clopper-pearson-coverage",
    "plan-delivers",
    "plan-expects",
];

/// What a replay command was seen to run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Replays {
    Solver,
    Library,
    Check,
}

fn rows(context: &Context) -> Vec<Row> {
    let limits = Limits::of_this_workspace().expect("the data inside the crate");
    let judge = Judge { limits: &limits, commands: &Commands::Workspace, effort: Effort::Quick };
    let short = CHECKS.iter().filter(|check| !LONG.contains(&check.id));
    short.flat_map(|check| judge.rows(check, check.measure(context).expect("a measurement"))).collect()
}

/// Runs the command of `row` in its program, and says what is wrong with it.
fn replay(row: &Row, context: &Context) -> Result<Replays, String> {
    let command = row.replay.as_deref().ok_or("no command")?;
    if command.starts_with(TOSS) {
        return solved(row, command).map(|()| Replays::Solver);
    }
    if let Some(line) = command.strip_prefix(ALL) {
        return measured_again(row, line, context).map(|()| Replays::Library);
    }
    let arguments = command.strip_prefix(CHECK).ok_or("an unknown program")?;
    let expected = format!("{} --quick", row.check);
    if arguments == expected { Ok(Replays::Check) } else { Err(format!("runs '{arguments}', not '{expected}'")) }
}

/// Whether the program accepts the commands, and solves the toss with the solvers, schemes and formulations of the row's
/// subject. Of two solvers that are compared, the first is named without the scheme, which is that of the second.
fn solved(row: &Row, command: &str) -> Result<(), String> {
    let each = command.split(" && ").map(|one| subject_of(one.strip_prefix(TOSS).unwrap_or(one)));
    let subjects = each.collect::<Result<Vec<String>, String>>()?;
    let is_right = match (&subjects[..], row.subject.split_once(" ~ ")) {
        ([only], None) => *only == row.subject,
        ([first, second], Some((one, other))) => {
            let scheme = other.split_once('/').map(|(_, scheme)| scheme);
            let with_scheme = scheme.map(|scheme| format!("{one}/{scheme}"));
            second == other && (first == one || Some(first) == with_scheme.as_ref())
        }
        _ => false,
    };
    if is_right { Ok(()) } else { Err(format!("solves with {}", subjects.join(" and "))) }
}

/// The solver, scheme and formulation of a command line of the program, which it accepts.
fn subject_of(arguments: &str) -> Result<String, String> {
    let arguments: Vec<&str> = arguments.split_whitespace().collect();
    let line = ["unfair-toss", "toss"].iter().chain(&arguments);
    unfair_toss::program().try_get_matches_from(line).map_err(|error| error.to_string())?;
    let option = |name: &str| arguments.windows(2).find(|pair| pair[0] == name).map(|pair| pair[1]);
    let parts = ["--solver", "--scheme", "--formulation"].into_iter().filter_map(option);
    Ok(parts.collect::<Vec<_>>().join("/"))
}

/// Whether the command measures the row again, with the deviation of the row.
fn measured_again(row: &Row, line: &str, context: &Context) -> Result<(), String> {
    let parts: Vec<&str> = line.split('"').collect();
    let ["", text, " --row ", named, ""] = parts[..] else { return Err(format!("not a toss and a row: {line}")) };
    if named != format!("{} / {}", row.check, row.subject) {
        return Err(format!("measures the row {named}"));
    }
    let toss = case::read(text).map_err(|error| error.to_string())?;
    let check = CHECKS.iter().find(|check| check.id == row.check).ok_or("no such check")?;
    let again = check.again(context, &toss, &|subject| subject == row.subject).map_err(|error| error.to_string())?;
    let measured = again.first().ok_or("does not take its measure")?.measured;
    // A row that counts tosses is of many, of which the command repeats the first.
    let is_same = if row.unit == "tosses" {
        (measured > 0.0) == (row.measured > Some(0.0))
    } else {
        Some(measured) == row.measured
    };
    if is_same { Ok(()) } else { Err(format!("measures {measured:e}, not {:?}", row.measured)) }
}

/// Whether the text of the worst input is that of a toss, or of none.
fn has_a_readable_input(row: &Row) -> bool {
    let text = row.worst_input.as_deref().unwrap_or_default();
    !["rate=", "Launch {", "DoubleDouble"].iter().any(|part| text.contains(part)) || case::read(text).is_ok()
}

#[test]
fn the_command_of_every_row_runs_what_the_row_measured() {
    let context = Context::new(Registry::standard().entries(), Effort::Quick).expect("the data inside the crate");
    let rows = rows(&context);
    let unread: Vec<_> = rows.iter().filter(|row| !has_a_readable_input(row)).collect();
    assert!(unread.is_empty(), "{unread:?}");
    let replayed: Vec<_> = rows.iter().map(|row| (row, replay(row, &context))).collect();
    let wrong = replayed.iter().filter_map(|(row, found)| {
        let error = found.as_ref().err()?;
        Some(format!("{} / {}: {error}\n  {:?}\n", row.check, row.subject, row.replay))
    });
    let wrong: String = wrong.collect();
    assert!(wrong.is_empty(), "{wrong}");
    let number = |of: Replays| replayed.iter().filter(|(_, found)| found == &Ok(of)).count();
    assert!([Replays::Solver, Replays::Library, Replays::Check].into_iter().all(|of| number(of) > 20));
    // Each quantity of the library on single tosses is one that a row repeats.
    for check in CHECKS.iter().filter(|check| matches!(check.measure, Measure::Tosses(..))) {
        assert!(rows.iter().any(|row| row.check == check.id), "{} has no row", check.id);
    }
}
