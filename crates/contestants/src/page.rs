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

/// Where the README's table stands.
const BEGIN: &str = "<!-- the table of the contest: begin -->\n";
const END: &str = "<!-- the table of the contest: end -->";

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

/// `readme` with the short table of the contest in its place; `None` if it has no place for it.
pub fn readme(readme: &str, contest: &Contest) -> Option<String> {
    let (head, rest) = readme.split_once(BEGIN)?;
    let (_, tail) = rest.split_once(END)?;
    Some(format!("{head}{BEGIN}{}{END}{tail}", short(contest)))
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

/// The table of the README.
fn short(contest: &Contest) -> String {
    let mut table = String::from(
        "| contestant | attitude error, default | attitude error, tight | calls, default | time, default | fails |\n\
         |---|---|---|---|---|---|\n",
    );
    let unit = contest.named(UNIT).map_or(f64::NAN, |unit| unit.usual.ns);
    for contestant in &contest.contestants {
        let Contestant { name, usual, tight, .. } = contestant;
        let tight = if tight.setting.is_empty() { String::new() } else { error(tight, tight.err_attitude_rad) };
        let cells = [
            format!("`{name}`"),
            error(usual, usual.err_attitude_rad),
            tight,
            calls(usual),
            relative(usual.ns / unit),
            where_it_fails(contestant),
        ];
        table += &format!("| {} |\n", cells.join(" | "));
    }
    table
}

/// Where a contestant is silently wrong or has no answer, in a few words.
fn where_it_fails(contestant: &Contestant) -> String {
    let wrong = |answer: &Answer| *answer == Answer::SilentlyWrong;
    let mut words = Vec::new();
    if contestant.tight.estimate > SAYS_NOTHING {
        words.push("its error estimate allows any answer".to_owned());
    }
    if contestant.usual.beyond_estimate + contestant.tight.beyond_estimate > 0 {
        words.push("wrong on ordinary launches".to_owned());
    }
    let hazards: Vec<&str> =
        contestant.hazards.iter().filter(|(_, answer)| wrong(answer)).map(|(id, _)| id.as_str()).collect();
    if !hazards.is_empty() {
        words.push(format!("wrong at {}", hazards.join(", ")));
    }
    let speeds: Vec<String> = SPEEDS
        .iter()
        .zip(&contestant.speeds)
        .filter(|(_, answer)| wrong(answer))
        .map(|(factor, _)| format!("{factor:e}"))
        .collect();
    if !speeds.is_empty() {
        words.push(format!("wrong at rates × {}", speeds.join(", ")));
    }
    let refused: Vec<&str> = contestant
        .hazards
        .iter()
        .filter(|(id, answer)| *answer == Answer::TypedError && id != "F6")
        .map(|(id, _)| id.as_str())
        .collect();
    if !refused.is_empty() {
        words.push(format!("no answer at {}", refused.join(", ")));
    }
    words.join("; ")
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
