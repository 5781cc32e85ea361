//! Renders the report as one HTML file that needs no network: the verdict, the checks, the tables and the charts. Each
//! chapter says what to see in it.

mod chapters;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::moves::replay;
use super::words::{Block, margin, measured, number, relation};
use crate::judge::baseline::{Direction, Move};
use crate::judge::time::Timing;
use crate::judge::{Row, Status};
use crate::measure::planner::Line;
use crate::measure::tables::Probability;
use crate::render::charts::Chart;
use crate::render::{Report, left_out};
use chapters::sections;

const STYLE: &str = include_str!("report.css");

/// Renders `report` with its `charts`.
pub fn page(report: &Report<'_>, charts: &[Chart]) -> String {
    let sections = sections(charts);
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
                h1 { "unfair-toss: verification" }
                (verdict(report))
                nav {
                    a href="#checks" { "Checks" }
                    @if report.records.probabilities.is_some() { a href="#probabilities" { "Probabilities" } }
                    @if report.records.planner.is_some() { a href="#planner" { "The planner" } }
                    @for section in &sections { a href={ "#" (section.id) } { (section.title) } }
                }
                (failures(report.rows))
                (moves(report))
                (checks(report))
                @if let Some(lines) = report.records.probabilities { (probabilities(lines)) }
                @if let Some(summary) = &report.records.planner { (planner(&summary.lines)) }
                @for section in &sections { (section.markup()) }
            }
        }
    };
    page.into_string()
}

fn verdict(report: &Report<'_>) -> Markup {
    let passing = report.rows.iter().filter(|row| row.status.passes()).count();
    let worse = report.moves.iter().any(|moved| moved.direction == Direction::Worse);
    html! {
        p class={ "verdict " (if report.passed { "pass" } else { "fail" }) } {
            b { (if report.passed { "PASS" } else { "FAIL" }) }
            ": " (passing) " of " (report.rows.len()) " rows are within their bounds"
        }
        p { (report.pattern) }
        p {
            "A tossed coin is a rigid body in free flight. Each row below is a claim about one of its solvers, or about the \
             library beside them, measured in this run against the exact motion in 256 bits, a conserved quantity or a \
             published figure, with the bound that it may not exceed. Effort: " (report.effort.name()) ". "
            span class=[worse.then_some("fail")] { (report.baseline.words(report.moves)) }
        }
        @for line in left_out::text(report.left_out).lines() { p.faint { (line) } }
    }
}

fn failures(rows: &[Row]) -> Markup {
    let blocks = Block::all(rows);
    let failing: Vec<&Row> =
        blocks.iter().flat_map(|block| block.rows.iter().copied()).filter(|row| !row.status.passes()).collect();
    html! {
        @if !failing.is_empty() {
            h2 class="fail" { "What fails" }
            @for row in failing {
                p { b { (row.check) " / " (row.subject) } ": " (row.status.name()) ", " (margin(row)) ". "
                    @if let Some(failure) = &row.failure { (failure) ". " }
                    @if let Some(replay) = &row.replay { "Repeat with " code { (replay) } } }
            }
        }
    }
}

fn moves(report: &Report<'_>) -> Markup {
    let is_shown = |moved: &&Move| matches!(moved.direction, Direction::Worse | Direction::Better);
    let mut shown: Vec<&Move> = report.moves.iter().filter(is_shown).collect();
    shown.sort_by_key(|moved| moved.direction != Direction::Worse);
    html! {
        @if !shown.is_empty() {
            h2 { "What moved against the baseline" }
            div.wide { table {
                tr { th { "check" } th { "subject" } th { "" } th { "accepted" } th { "now" } th { "" } }
                @for moved in shown { (line_of_move(moved, report.rows)) }
            } }
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
            td.long.faint { @if worse { "repeat with " code { (replay(moved, rows)) } } }
        }
    }
}

fn checks(report: &Report<'_>) -> Markup {
    html! {
        h2 id="checks" { "Checks" }
        p.faint { "The worst first: what fails, then what comes closest to its bound. Open a check for its rows. A margin says how many \
                   times the bound is above what was measured. A solver without a bound is judged by the error that it claims." }
        @for block in Block::all(report.rows) {
            (check(&block, report.checks.iter().find(|timing| timing.check == block.worst().check)))
        }
    }
}

fn check(block: &Block<'_>, timing: Option<&Timing>) -> Markup {
    let (worst, all) = (block.worst(), block.failing() == 0);
    html! {
        details open[!all] {
            summary {
                b class=(if all { "pass" } else { "fail" }) { (if all { "✓ " } else { "✗ " }) (worst.check) }
                " " (worst.claim) " "
                span.faint {
                    (block.rows.len() - block.failing()) " of " (block.rows.len())
                    @if worst.part() > 0.0 { ", " (worst.subject) ": " (margin(worst)) }
                    @if let Some(basis) = worst.basis { ", " (basis.name()) }
                    @if let Some(timing) = timing { ", " (format!("{:.1} s", timing.t_wall_s)) }
                }
            }
            div.wide { table {
                tr { th { "subject" } th { "measured" } th { "" } th { "bound" } th { "unit" } th { "" } th { "cases" } th { "" }
                     th { "judges the" } th { "worst input" } }
                @for row in &block.rows { (line(row)) }
            } }
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
            td { (row.subject) } td { (measured(row)) } td { (relation(row)) } td { (number(row.bound)) }
            td { @if row.unit != "1" { (row.unit) } }
            td { (margin(row)) }
            td { (row.cases) }
            td class=(class) { (row.status.name()) }
            td.faint { @if let Some(judges) = row.judges { (judges.name()) } }
            td.long.faint { @if let Some(input) = &row.worst_input { code { (input) } } }
        }
    }
}

fn probabilities(lines: &[Probability]) -> Markup {
    html! {
        h2 id="probabilities" { "Probabilities" }
        p.faint { "P(heads) of the named spaces by every way of sampling: the space of the paper's 66 % (reconstructed), its cheated toss and \
                   its toss that lands tails. A grid is no sample, so it has no interval." }
        div.wide { table {
            tr { th { "space" } th { "method" } th { "launches" } th { "P(heads)" } th { "95 % interval" } th { "" } }
            @for line in lines {
                tr {
                    td { (line.space) } td { (line.method) } td { (line.points) } td { (format!("{:.6}", line.probability)) }
                    td { @if let Some([lo, hi]) = line.interval { (format!("{lo:.6} to {hi:.6}")) } }
                    td.long.faint { (line.interval_kind) }
                }
            }
        } }
    }
}

fn planner(lines: &[Line]) -> Markup {
    html! {
        h2 id="planner" { "The planner" }
        p.faint { "Random scenes were solved as planned. error/asked and error/expected: the largest error, divided by the accuracy asked for and \
                   by the error expected." }
        div.wide { table {
            tr { th { "wanted" } th { "scenes" } th { "refused" } th { "error/asked" } th { "error/expected" } }
            @for line in lines {
                tr {
                    td { (line.kind) } td { (line.scenes) } td { (line.refused) }
                    td { (number(Some(line.largest_error_by_accuracy))) } td { (number(Some(line.largest_error_by_expected))) }
                }
            }
        } }
    }
}
