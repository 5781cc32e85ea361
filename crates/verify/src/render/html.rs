//! Renders the report as one HTML file that needs no network: the verdict, the checks, the tables and the charts. Each
//! chapter says what to see in it.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::judge::baseline::{Direction, Move};
use crate::judge::{Row, Status};
use crate::measure::planner::summary::Line;
use crate::measure::tables::Probability;
use crate::render::Report;
use crate::render::charts::Chart;

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
                (moves(report.moves))
                (checks(report.rows))
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
    let worse = report.moves.iter().filter(|moved| moved.direction == Direction::Worse).count();
    html! {
        p class={ "verdict " (if report.passed { "pass" } else { "fail" }) } {
            b { (if report.passed { "PASS" } else { "FAIL" }) }
            ": " (passing) " of " (report.rows.len()) " rows are within their bounds"
        }
        p {
            "A tossed coin is a rigid body in free flight. Each row below is a claim about one of its solvers, measured in this \
             run against the exact motion in 256 bits, a conserved quantity or a published figure, with the bound that it may \
             not exceed. Effort: " (report.effort.name()) ". "
            @if worse == 0 { "Nothing is less accurate or more work than the accepted baseline." }
            @else { b class="fail" { (worse) " values are worse than the accepted baseline." } }
        }
    }
}

fn failures(rows: &[Row]) -> Markup {
    let failing: Vec<&Row> = rows.iter().filter(|row| !row.status.passes()).collect();
    html! {
        @if !failing.is_empty() {
            h2 class="fail" { "What fails" }
            @for row in failing {
                p { b { (row.check) " / " (row.subject) } ": " (row.status.name()) ". "
                    @if let Some(failure) = &row.failure { (failure) ". " }
                    @if let Some(replay) = &row.replay { "Repeat with " code { (replay) } } }
            }
        }
    }
}

fn moves(moves: &[Move]) -> Markup {
    let shown: Vec<&Move> =
        moves.iter().filter(|moved| matches!(moved.direction, Direction::Worse | Direction::Better)).collect();
    html! {
        @if !shown.is_empty() {
            h2 { "What moved against the baseline" }
            div.wide { table {
                tr { th { "check" } th { "subject" } th { "" } th { "accepted" } th { "now" } }
                @for moved in shown {
                    tr {
                        td { (moved.check) } td { (moved.subject) }
                        td class=(if moved.direction == Direction::Worse { "fail" } else { "pass" }) {
                            (if moved.direction == Direction::Worse { "worse" } else { "better" }) " " (moved.what)
                        }
                        td { (number(moved.before)) } td { (number(moved.now)) }
                    }
                }
            } }
        }
    }
}

fn checks(rows: &[Row]) -> Markup {
    html! {
        h2 id="checks" { "Checks" }
        p.faint { "Open a check for its rows. The margin is how many times the bound is above what was measured. A solver without a bound is judged by \
                   the error that it claims." }
        @for block in rows.chunk_by(|a, b| a.check == b.check) { (check(block)) }
    }
}

fn check(block: &[Row]) -> Markup {
    let passing = block.iter().filter(|row| row.status.passes()).count();
    let closest = block.iter().filter_map(|row| row.margin).fold(f64::INFINITY, f64::min);
    let all = passing == block.len();
    html! {
        details open[!all] {
            summary {
                b class=(if all { "pass" } else { "fail" }) { (if all { "✓ " } else { "✗ " }) (block[0].check) }
                " " (block[0].claim) " "
                span.faint {
                    (passing) " of " (block.len())
                    @if closest.is_finite() { ", closest margin " (format!("{closest:.1}")) "×" }
                    @if let Some(basis) = block[0].basis { ", " (basis.name()) }
                }
            }
            div.wide { table {
                tr { th { "subject" } th { "measured" } th { "bound" } th { "unit" } th { "margin" } th { "cases" } th { "" } th { "worst input" } }
                @for row in block { (line(row)) }
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
            td { (row.subject) } td { (number(row.measured)) } td { (number(row.bound)) }
            td { @if row.unit != "1" { (row.unit) } }
            td { @if let Some(margin) = row.margin { (format!("{margin:.1}×")) } }
            td { (row.cases) }
            td class=(class) { (row.status.name()) }
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
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    html! {
        h2 id="planner" { "The planner" }
        p.faint { "Random scenes were solved as planned. error/asked and error/expected: the largest error, divided by the accuracy asked for and \
                   by the error expected. expected ≤ 30×: the fraction of scenes whose expected error is at most 30 times the error. \
                   tried: the scenes that were solved by every model. economical: the fraction of these where the chosen model cost at \
                   most 1.2 times the cheapest that served, by recorded and by measured cost." }
        div.wide { table {
            tr { th { "wanted" } th { "scenes" } th { "refused" } th { "error/asked" } th { "error/expected" } th { "expected ≤ 30×" }
                 th { "tried" } th { "economical, recorded" } th { "economical, measured" } th { "largest cost ratio" } }
            @for line in lines {
                tr {
                    td { (line.kind) } td { (line.scenes) } td { (line.refused) }
                    td { (number(Some(line.largest_error_by_accuracy))) } td { (number(Some(line.largest_error_by_expected))) }
                    td { (percent(line.within_30_of_one)) } td { (line.tried) }
                    td { (percent(line.economical)) } td { (percent(line.economical_by_clock)) }
                    td { (format!("{:.2}×", line.largest_cost_ratio_by_clock)) }
                }
            }
        } }
    }
}

/// A chapter of charts.
struct Section<'a> {
    id: &'static str,
    title: &'static str,
    caption: &'static str,
    charts: Vec<&'a Chart>,
}

/// Id, title and caption of every chapter; the files of its charts begin with the id.
const CHAPTERS: [(&str, &str, &str); 6] = [
    (
        "fig4",
        "The paper's Fig. 4",
        "Probability against the number of launches: a grid (A), in the order of its axes, and \
      random launches (B). B converges like one over the root of n; A drifts until its last axis is complete. Both end at the \
      paper's 66 %. The space is reconstructed, since the paper names none.",
    ),
    (
        "work-precision",
        "Speed against accuracy",
        "Each point is a run at one tolerance or step: the further right, the more \
      accurate; the lower, the cheaper. First all problems on one scale, by time on this machine; then each problem, left in \
      calls, which repeat exactly, and right in time. The grey band is the front: no integrator's run is better in both error \
      and work. The exact motion calls nothing and is accurate to the last bit.",
    ),
    (
        "models",
        "The hierarchy of models",
        "What each model costs in this run, over the random scenes that it can serve: median, and the range of nine \
      in ten. The planner takes the cheapest model that is accurate enough.",
    ),
    (
        "order",
        "Order of convergence",
        "With fixed steps the error falls like a power of the step. The fitted power stands \
      beside that of the theory. For DOP853 only one halving of the step lies between steps that are too large for the power law \
      and errors that are rounding alone.",
    ),
    (
        "atlas",
        "Where methods fail",
        "The worst answer of every solver, scheme and formulation near eight hazards. The raw \
      forms are the paper's equations as printed: they report success and are wrong. No default is wrong without an error. Below \
      stand error and work against the distance from each hazard. The purple line is the effect of one rounding of the launch: \
      an error below it cannot be told from an error of the launch.",
    ),
    (
        "long-flights",
        "Long flights",
        "Errors and drifts of the paper's cheated toss, flown for up to 10⁴ s. The error grows \
      in proportion to the time. The conserved quantities drift by some parts in 10⁸ at most.",
    ),
];

/// The chapters that have charts.
fn sections(charts: &[Chart]) -> Vec<Section<'_>> {
    let section = |(id, title, caption): (&'static str, &'static str, &'static str)| {
        let charts: Vec<&Chart> = charts.iter().filter(|chart| chart.file.starts_with(id)).collect();
        (!charts.is_empty()).then_some(Section { id, title, caption, charts })
    };
    CHAPTERS.into_iter().filter_map(section).collect()
}

impl Section<'_> {
    fn markup(&self) -> Markup {
        html! {
            h2 id=(self.id) { (self.title) }
            p.faint { (self.caption) }
            @for chart in &self.charts {
                figure {
                    div.wide { (PreEscaped(&chart.svg)) }
                    @if let Some(caption) = &chart.caption { figcaption { (caption) } }
                }
            }
        }
    }
}

fn number(value: Option<f64>) -> String {
    match value {
        Some(value) if value == 0.0 || (value.fract() == 0.0 && value.abs() < 1e7) => format!("{value}"),
        Some(value) => format!("{value:.2e}"),
        None => "–".to_owned(),
    }
}
