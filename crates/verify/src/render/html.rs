//! Renders the report as one HTML file that needs no network. It opens with the answer: the verdict, what each solver
//! reaches at which cost, how solvers answer where methods fail, and one line for each check. Everything else is folded
//! below.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::words::{by_check, comparison, failing, left_out, number, replay, reserve, unjudged, verdict};
use crate::judge::baseline::{Direction, Move};
use crate::judge::{Row, Status};
use crate::measure::atlas::Atlas;
use crate::measure::atlas::hazards::HAZARDS;
use crate::measure::run::Answer;
use crate::measure::work_precision::YARDSTICK;
use crate::render::charts::Chart;
use crate::render::report::{Cost, ENOUGH, Reached, Verdict};
use crate::render::{Report, diagnosis};

const STYLE: &str = include_str!("report.css");

/// So many failing rows are open to see; the rest is folded.
const OPEN: usize = 5;

/// Id, title and caption of every chapter of charts; the files of its charts begin with the id.
const CHAPTERS: [(&str, &str, &str); 2] = [
    (
        "work-precision",
        "Speed against accuracy",
        "Each point is a run at one tolerance or step: the further right, the more \
      accurate; the lower, the cheaper. Each problem has its chart, left in calls, which repeat exactly, and right in time on \
      this machine. The grey band is the front: no integrator's run is better in both error \
      and work.",
    ),
    (
        "order",
        "Order of convergence",
        "With fixed steps the error falls like a power of the step. The fitted power stands \
      beside that of the theory. For DOP853 only one halving of the step lies between steps that are too large for the power law \
      and errors that are rounding alone.",
    ),
];

pub(crate) fn page(report: &Report, charts: &[Chart]) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "unfair-toss: verification" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                (answer(report))
                (failures(&report.failing()))
                (moves(report))
                (reached(report))
                @if let Some(atlas) = report.context.atlas.found() { (matrix(atlas)) }
                h2 id="checks" { "Checks" }
                @for rows in by_check(&report.rows) { (check(&rows, report)) }
                p.faint { "The worst first. The reserve is the limit divided by what was measured; below 1 a row fails. A solver without a \
                           limit is judged by the error that it claims." }
                @for (id, title, caption) in CHAPTERS { (chapter(id, title, caption, charts)) }
                (not_measured(report))
            }
        }
    };
    page.into_string()
}

/// The verdict, and when, where and of what it was found.
fn answer(report: &Report) -> Markup {
    let (word, class) = match report.verdict() {
        Verdict::Pass => ("PASS", "pass"),
        Verdict::Worse => ("WORSE", "fail"),
        Verdict::Fail => ("FAIL", "fail"),
    };
    html! {
        h1 { "unfair-toss: verification" }
        p class={ "verdict " (class) } { b { (word) } " " span { (report.sentence()) } }
        @if !report.diagnoses.is_empty() { p.lines { (diagnosis::paragraph(report)) } }
        @if !report.passed { p { (report.pattern) } }
        dl.facts {
            @for (name, value) in report.facts() { div { dt { (name) } dd { (value) } } }
            div { dt { "baseline" } dd { (report.baseline.words(&report.moves)) } }
        }
    }
}

/// What fails, by how much, and the command that repeats it.
fn failures(failing: &[&Row]) -> Markup {
    let (shown, folded) = failing.split_at(failing.len().min(OPEN));
    html! {
        @if !shown.is_empty() {
            h2 class="fail" { "What fails" }
            @for row in shown { (failure(row)) }
            @if !folded.is_empty() {
                details { summary { (folded.len()) " more" } @for row in folded { (failure(row)) } }
            }
        }
    }
}

fn failure(row: &Row) -> Markup {
    html! {
        p { b { (row.check) " / " (row.subject) } ": " (verdict(row)) ", " (comparison(row)) " (" (reserve(row)) "). "
            @if let Some(failure) = &row.failure { (failure) ". " }
            @if let Some(replay) = &row.replay { "Repeat with " code { (replay) } } }
    }
}

fn moves(report: &Report) -> Markup {
    let is_shown = |moved: &&Move| matches!(moved.direction, Direction::Worse | Direction::Better);
    let mut shown: Vec<&Move> = report.moves.iter().filter(is_shown).collect();
    shown.sort_by_key(|moved| moved.direction != Direction::Worse);
    html! {
        @if !shown.is_empty() {
            details open[shown[0].direction == Direction::Worse] {
                summary { b { "What moved against the baseline" } span.faint { (shown.len()) " rows" } }
                table {
                    tr { th { "check" } th { "subject" } th { "" } th { "accepted" } th { "now" } }
                    @for moved in shown { (line_of_move(moved, &report.rows)) }
                }
            }
        }
    }
}

fn line_of_move(moved: &Move, rows: &[Row]) -> Markup {
    let worse = moved.direction == Direction::Worse;
    html! {
        tr {
            td { (moved.check) } td { (moved.subject) }
            td class=(if worse { "fail" } else { "pass" }) { (if worse { "worse" } else { "better" }) " " (moved.what) }
            td { (number(moved.before)) } td { (number(moved.now)) }
        }
        @if worse { tr.more { td colspan="5" { "repeat with " code { (replay(moved, rows)) } } } }
    }
}

fn reached(report: &Report) -> Markup {
    let (Some((problem, launches)), all) = (report.ordinary(), report.reached()) else { return html! {} };
    let cells = |cost: Option<Cost>| cost.map_or_else(|| ["–", "–", "–"].map(str::to_owned), Cost::words);
    let line = |Reached { subject, finest, enough }: &Reached| {
        let ([error, calls, time], [_, fewer, less]) = (cells(Some(*finest)), cells(*enough));
        html! { tr {
            th scope="row" { (subject) }
            td { (error) } td.wide { (calls) } td { (time) } td.wide { (fewer) } td { (less) }
        } }
    };
    let enough = html! { span.whole { "to " (format!("{ENOUGH:e}")) " rad" } };
    html! {
        section {
            h2 { "Accuracy and cost of each solver" }
            table.numbers {
                tr { th { "solver" } th { "smallest error" } th.wide { "calls" } th { "time" }
                     th.wide { "calls " (enough) } th { "time " (enough) } }
                @for one in &all { (line(one)) }
            }
            p.faint { "The largest error of the attitude over the " (launches) " launches of the problem " (problem) ", calls of the \
                       right-hand side and time per launch on this machine (of a program, with the pipe to it): of the most accurate run, and of the cheapest run \
                       within " (format!("{ENOUGH:e}")) " rad, among the tolerances and steps that were flown."
                @if all.iter().any(|one| one.subject.starts_with(YARDSTICK)) {
                    " The lines called " (YARDSTICK) " are the library's quaternion, to compare with, here and in the charts; no row judges it."
                }
            }
        }
    }
}

/// How solvers answer near the places where methods fail.
fn matrix(atlas: &Atlas) -> Markup {
    let cell = |subject: &str, hazard: &str| {
        let (class, sign, word) = match atlas.worst(hazard, subject) {
            Some(Answer::Right) => ("right", "✓", "right"),
            Some(Answer::TypedError) if atlas.is_for_coins_alone(hazard, subject) => ("", "–", "coins"),
            Some(Answer::TypedError) => ("error", "!", "error"),
            Some(Answer::Unclaimed) => ("unclaimed", "?", "no claim"),
            Some(Answer::SilentlyWrong) => ("wrong", "✗", "WRONG"),
            None => ("", "–", "–"),
        };
        html! { td class=(class) title=(format!("{subject}, {hazard}: {word}")) { span.sign { (sign) } span.word { (word) } } }
    };
    html! {
        h2 { "Where methods fail" }
        table.atlas {
            tr { th { "" } @for hazard in HAZARDS { th title=(hazard.name) { (hazard.id) } } }
            @for subject in atlas.subjects() {
                tr { th scope="row" { (subject) } @for hazard in HAZARDS { (cell(subject, hazard.id)) } }
            }
        }
        p.faint {
            "The worst answer over all distances from each hazard: right ✓, an error that says why !, an answer without a usable \
             claim ?, wrong without an error ✗, not asked –, or \"coins\" where a solver takes these alone. An error is the only right \
             answer at F6, whose phases go beyond 2⁵³ rad. "
            @for hazard in HAZARDS { b { (hazard.id) } " " (hazard.name) ". " }
        }
    }
}

fn mark(failing: usize, rows: &[&Row]) -> Markup {
    let are_judged = rows.iter().any(|row| row.status != Status::NotJudged);
    html! { @if failing > 0 { span.fail { "✗ " } } @else if are_judged { span.pass { "✓ " } } @else { span.faint { "– " } } }
}

fn check(rows: &[&Row], report: &Report) -> Markup {
    let (worst, failing) = (rows[0], failing(rows.iter().copied()));
    let timing = report.checks.iter().find(|timing| timing.check == worst.check);
    html! {
        details.check open[failing > 0] {
            summary {
                b { (mark(failing, rows)) (worst.check) }
                " " (worst.claim) " "
                span.faint {
                    (rows.len() - failing) " of " (rows.len()) " pass"
                    @if worst.part() > 0.0 { ", " (worst.subject) ": " (reserve(worst)) }
                    @if let Some(basis) = worst.basis { ", by " (basis.name()) }
                    @if let Some(timing) = timing { ", " (format!("{:.1} s", timing.t_wall_s)) }
                }
            }
            table {
                tr { th { "subject" } th { "measured and limit" } th { "reserve" } th.wide { "cases" } th { "verdict" } }
                @for row in rows { (line(row)) }
            }
        }
    }
}

fn line(row: &Row) -> Markup {
    let class = match row.status {
        Status::Pass | Status::PassByClaim => "pass",
        Status::PassLoose | Status::NotJudged => "faint",
        _ => "fail",
    };
    html! {
        tr {
            th scope="row" { (row.subject) } td { (comparison(row)) }
            td { (reserve(row).trim_start_matches("reserve ")) }
            td.wide { (row.cases) (unjudged(row)) }
            td class=(class) { (verdict(row)) }
        }
        @if let Some(input) = &row.worst_input { tr.more { td colspan="5" { "worst input " code { (input) } } } }
    }
}

/// A chapter of charts, folded; nothing if it has none.
fn chapter(id: &str, title: &str, caption: &str, charts: &[Chart]) -> Markup {
    let charts: Vec<&Chart> = charts.iter().filter(|chart| chart.file.starts_with(id)).collect();
    html! {
        @if !charts.is_empty() {
            details id=(id) {
                summary { b { (title) } span.faint { (charts.len()) @if charts.len() == 1 { " chart" } @else { " charts" } } }
                p.faint { (caption) }
                @for chart in &charts {
                    figure {
                        a href=(chart.file) title="the chart by itself" { (PreEscaped(&chart.svg)) }
                        @if let Some(caption) = &chart.caption { figcaption { (caption) } }
                    }
                }
            }
        }
    }
}

/// The checks that gave no row. A run that passes should say what it does not speak of.
fn not_measured(report: &Report) -> Markup {
    html! {
        @if !report.left_out.is_empty() {
            details id="left-out" {
                summary { b { "What was left out" } span.faint { (report.left_out.len()) " checks" } }
                @for line in left_out(&report.left_out).lines() { p.faint { (line) } }
            }
        }
    }
}
