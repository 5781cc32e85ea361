//! Every row of the verification prints a command that repeats its worst case. This test runs what the command of every row
//! of a quick run asks for, which must be what the row measured.

use toss::Registry;
use verify::judge::Judge;
use verify::judge::limits::Limits;
use verify::measure::atlas::contestants_at;
use verify::measure::case;
use verify::measure::replay::Commands;
use verify::measure::subject::Subject;
use verify::{CHECKS, Context, Effort, Measure, Row};

const TOSS: &str = "cargo xtask verify --replay ";
const CHECK: &str = "cargo xtask verify --only ";

/// Checks that are left out because together they take a minute and a half: each makes its rows' commands by a function
/// that another check calls, too.
const LONG: [&str; 10] = [
    "adversarial-silence",
    "atlas-answers",
    "cheated-heads-forever",
    "enclosure-figures",
    "enclosures-overlap",
    "interval-coverage",
    "plan-delivers",
    "plan-expects",
    "sampling-errors",
    "work-precision",
];

/// What a replay command was seen to run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Replays {
    Toss,
    Row,
    Check,
}

fn rows(context: &Context) -> Vec<Row> {
    let limits = Limits::of_this_workspace().expect("the data inside the crate");
    let judge = Judge { limits: &limits, commands: &Commands::of_this_workspace(), effort: Effort::Quick };
    let short = CHECKS.iter().filter(|check| !LONG.contains(&check.id));
    short.flat_map(|check| judge.rows(check, check.measure(context).expect("a measurement"))).collect()
}

/// Runs the command of `row` in its program, and says what is wrong with it.
fn replay(row: &Row, context: &Context) -> Result<Replays, String> {
    let command = row.replay.as_deref().ok_or("no command")?;
    if let Some(line) = command.strip_prefix(TOSS) {
        return match line.split('"').collect::<Vec<_>>()[..] {
            ["", text, ""] => is_flown(row, text, context).map(|()| Replays::Toss),
            ["", text, " --row ", named, ""] => measured_again(row, text, named, context).map(|()| Replays::Row),
            _ => Err(format!("neither a toss nor a toss and a row: {line}")),
        };
    }
    let arguments = command.strip_prefix(CHECK).ok_or("an unknown program")?;
    let expected = format!("{} --quick", row.check);
    if arguments == expected { Ok(Replays::Check) } else { Err(format!("runs '{arguments}', not '{expected}'")) }
}

/// Whether the command reads the toss and flies it with the solvers of the row's subject, at the settings that the text
/// names.
fn is_flown(row: &Row, text: &str, context: &Context) -> Result<(), String> {
    let (_, control) = case::read_with_settings(text).map_err(|error| error.to_string())?;
    let flown = contestants_at(&context.registry, control).map_err(|error| error.to_string())?;
    let is_at_settings = |one: &Subject| one.stepping.is_none_or(|stepping| Some(stepping.control()) == control);
    let is_flown = flown.iter().any(|one| one.name == row.subject && is_at_settings(one));
    if is_flown { Ok(()) } else { Err(format!("does not fly {} at {control:?}", row.subject)) }
}

/// Whether the command measures the row again, with the deviation of the row.
fn measured_again(row: &Row, text: &str, named: &str, context: &Context) -> Result<(), String> {
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
    let context = Context::new(Registry::standard().entries(), Effort::Sample).expect("the data inside the crate");
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
    assert!([Replays::Toss, Replays::Row, Replays::Check].into_iter().all(|of| number(of) > 20));
    // Each quantity of the library on single tosses is one that a row repeats.
    for check in CHECKS.iter().filter(|check| matches!(check.measure, Measure::Tosses(..))) {
        assert!(rows.iter().any(|row| row.check == check.id), "{} has no row", check.id);
    }
}
