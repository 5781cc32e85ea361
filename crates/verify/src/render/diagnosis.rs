//! What solvers with failing rows most likely do wrong, in words: the first lines of a report.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::Report;
use crate::judge::Row;
use crate::measure::diagnosis::{Diagnosis, Example};
use crate::process::Tally;

/// A sentence for each solver, with the smallest question that is left where no cause explains all of them, and how a program
/// was asked if not all of its launches have an answer.
pub(crate) fn paragraph(report: &Report) -> String {
    let lines = report.diagnoses.iter().map(of_one).collect::<String>();
    let tally = report.program.filter(|tally| tally.without_answer > 0).map(tally).unwrap_or_default();
    lines + &tally
}

fn of_one(found: &Diagnosis) -> String {
    let sentence = sentence(found);
    if found.explains_all {
        format!("{sentence}\n")
    } else {
        format!("{sentence}\nThe smallest question that this does not explain:\n{}", example(&found.example))
    }
}

/// What is said before the checks begin.
pub(crate) fn early(found: &Diagnosis) -> String {
    let then = match found.explains_all {
        true => "As this explains every answer, the run ends with the first check that fails.\n",
        false => "The checks go on; interrupt them if this is enough.\n",
    };
    of_one(found) + then
}

/// The solver with its likeliest cause.
pub(super) fn sentence(found: &Diagnosis) -> String {
    format!("{}: {}.", found.subject, found.cause)
}

/// The lines of a question and its answer, with what was expected.
pub(crate) fn example(example: &Example) -> String {
    let Example { question, answer, expected } = example;
    let question: String = question.lines().map(|line| format!("  {line}\n")).collect();
    format!("{question}  answer:   {answer}\n  expected: {expected}\n")
}

fn tally(Tally { starts, questions, without_answer }: Tally) -> String {
    let times = if starts == 1 { "once".to_owned() } else { format!("{starts} times") };
    format!("The program was started {times}; {without_answer} of {questions} launches are without an answer.\n")
}

/// The failing rows of which a report says all, and in one line the checks of those that fail for the same reason: those of
/// a solver whose likeliest cause explains all, and those with the same words of failure.
pub(crate) fn folded<'a>(report: &Report, failing: Vec<&'a Row>) -> (Vec<&'a Row>, String) {
    let (mut kept, mut same) = (Vec::new(), BTreeMap::<String, Vec<&str>>::new());
    let explained = |row: &Row| report.diagnoses.iter().any(|found| found.explains_all && found.subject == row.subject);
    for row in failing {
        let key = if explained(row) { Some(row.subject.clone()) } else { row.failure.clone() };
        match key {
            None => kept.push(row),
            Some(key) => {
                let of_key = same.entry(key).or_default();
                if of_key.is_empty() {
                    kept.push(row);
                }
                of_key.push(&row.check);
            }
        }
    }
    let mut text = String::new();
    for checks in same.into_values().filter(|checks| checks.len() > 1) {
        let _ = writeln!(text, "\nMost likely for the same reason as {}: {}", checks[0], checks[1..].join(", "));
    }
    (kept, text)
}
