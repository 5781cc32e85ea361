//! The page, the table and the chart of a record. They follow from the record alone, so that anybody can draw them
//! again and see that they are current.

use verify::measure::run::Answer;
use verify::measure::work_precision::problems::Problem;
use verify::measure::work_precision::{Sample, Sweep};
use verify::render::charts;

use crate::contest::{Contest, Contestant, Flown, SPEEDS, SURVEY, ours};
use crate::in_rust;

/// The contestant to which times are relative.
const UNIT: &str = "quaternion/dop853";

/// The hazards that ordinary launches come near to, with what is special there.
const NEAR: [&str; 6] = ["F1", "F2", "F3", "F4", "F5", "F7"];

/// An error of cos θ above which an error estimate says nothing.
const SAYS_NOTHING: f64 = 0.1;

/// The page `docs/contestants.md`.
pub fn page(contest: &Contest) -> String {
    let (words, host) = (include_str!("page.md"), &contest.host);
    let record = format!(
        "{} random launches, record of {} ({} cores of {}, {})",
        contest.launches, host.date, host.cores, host.cpu, host.rustc
    );
    [
        ("{{record}}", record),
        ("{{reached}}", reached(contest)),
        ("{{fails}}", fails(contest)),
        ("{{special}}", special(contest)),
    ]
    .iter()
    .fold(words.to_owned(), |page, (mark, text)| page.replace(mark, text))
}

/// The chart of work against error as SVG.
///
/// # Errors
/// If it can't be drawn.
pub fn chart(contest: &Contest, samples: &[Sample]) -> anyhow::Result<String> {
    let launches = samples.first().and_then(|sample| sample.inputs.split(' ').next()?.parse().ok()).unwrap_or(1);
    let survey = verify::measure::survey::Survey::random(&[], launches)?;
    let problem = Problem { name: SURVEY.to_owned(), stresses: String::new(), tosses: survey.tosses };
    let sweep = Sweep::of(&[problem], samples.to_vec());
    let colours = [ours(), in_rust(), vec![crate::solvers::scipy::named("true")]].concat();
    Ok(charts::recorded(&sweep, SURVEY, &contest.host.date, &colours)?)
}

/// The table of what each reaches at what cost.
fn reached(contest: &Contest) -> String {
    let mut table = String::from(
        "| contestant | what it is | setting | largest error of cos θ | of the attitude | calls | time | relative |\n\
         |---|---|---|---|---|---|---|---|\n",
    );
    let units = contest.named(UNIT).map(|unit| [unit.usual.ns, unit.tight.ns]).unwrap_or([f64::NAN; 2]);
    for Contestant { name, summary, usual, tight, .. } in &contest.contestants {
        for (flown, unit, name, summary) in [(usual, units[0], &**name, &**summary), (tight, units[1], "", "")] {
            if flown.setting.is_empty() && name.is_empty() {
                continue;
            }
            let cells = [
                if name.is_empty() { String::new() } else { format!("`{name}`") },
                summary.replace('|', "\\|"),
                flown.setting.clone(),
                error(flown, flown.err_cos_tilt),
                error(flown, flown.err_attitude_rad) + if flown.failures == 0 { " rad" } else { "" },
                calls(flown),
                time(flown.ns),
                relative(flown.ns / unit),
            ];
            table += &format!("| {} |\n", cells.join(" | "));
        }
    }
    table
}

/// The table of where each fails.
fn fails(contest: &Contest) -> String {
    let mut table = String::from(
        "| contestant | ordinary launches | near special launches | large phase (F6) | long flight (F8) | after 1000 s |",
    );
    for factor in SPEEDS {
        table += &format!(" rates × {factor:e} |");
    }
    table += &format!("\n|{}\n", "---|".repeat(6 + SPEEDS.len()));
    for contestant in &contest.contestants {
        let hazard = |id: &str| contestant.hazards.iter().find(|(known, _)| known == id).map(|(_, answer)| *answer);
        let near = NEAR.iter().filter_map(|id| hazard(id)).max();
        let mut cells = vec![format!("`{}`", contestant.name), ordinary(contestant), word(near)];
        cells.extend(["F6", "F8"].map(|id| word(hazard(id))));
        cells.push(contestant.long_flight.map_or_else(|| "no answer".to_owned(), |error| format!("{error:.1e} rad")));
        cells.extend(contestant.speeds.iter().map(|answer| word(Some(*answer))));
        table += &format!("| {} |\n", cells.join(" | "));
    }
    table
}

/// The first error of each contestant that had one on ordinary launches.
fn special(contest: &Contest) -> String {
    let mut list = String::new();
    for contestant in &contest.contestants {
        for flown in [&contestant.usual, &contestant.tight] {
            if let Some(failure) = &flown.failure {
                let (name, setting, failures) = (&contestant.name, &flown.setting, flown.failures);
                list += &format!(
                    "- `{name}` at {setting}: {failures} launches without an answer, the first with: {failure}\n"
                );
            }
        }
    }
    if list.is_empty() { "Every contestant answered every ordinary launch.\n".to_owned() } else { list }
}

fn ordinary(contestant: &Contestant) -> String {
    let beyond = contestant.usual.beyond_estimate + contestant.tight.beyond_estimate;
    let failures = contestant.usual.failures + contestant.tight.failures;
    match (beyond, failures) {
        (0, 0) if contestant.tight.estimate > SAYS_NOTHING => {
            format!("right, as an error of {:.0e} is allowed", contestant.tight.estimate)
        }
        (0, 0) => "right".to_owned(),
        (0, failures) => format!("no answer ({failures})"),
        (beyond, _) => format!("**wrong** ({beyond})"),
    }
}

fn word(answer: Option<Answer>) -> String {
    match answer {
        Some(Answer::Right) => "right",
        Some(Answer::TypedError) => "no answer",
        Some(Answer::Unclaimed) => "claims no error",
        Some(Answer::SilentlyWrong) => "**wrong**",
        None => "not flown",
    }
    .to_owned()
}

fn error(flown: &Flown, value: f64) -> String {
    let failed = if flown.failures == 0 { String::new() } else { format!(" ({} without an answer)", flown.failures) };
    format!("{value:.1e}{failed}")
}

fn calls(flown: &Flown) -> String {
    if flown.calls == 0.0 { "—".to_owned() } else { format!("{:.0}", flown.calls) }
}

fn time(ns: f64) -> String {
    match ns {
        ..1e3 => format!("{ns:.0} ns"),
        ..1e6 => format!("{:.1} µs", ns * 1e-3),
        _ => format!("{:.1} ms", ns * 1e-6),
    }
}

fn relative(ratio: f64) -> String {
    match ratio {
        ..0.095 => format!("{ratio:.3}"),
        ..9.5 => format!("{ratio:.1}"),
        _ => format!("{ratio:.0}"),
    }
}
