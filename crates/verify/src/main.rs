//! Runs the verification suite; `cargo xtask verify` starts it.
//!
//! Exit codes: 0 all checks pass; 1 a check fails; 2 bad usage; 3 accuracy or work is worse than the baseline, though
//! within bounds; 4 could not run.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context as _, ensure};
use clap::{Parser, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use toss::SOLVERS;
use verify::atlas::conditioning::Conditioning;
use verify::atlas::expected::Expected;
use verify::bench::Table;
use verify::bench::instructions::{Instructions, work};
use verify::bounds::Bounds;
use verify::case::Case;
use verify::judge::unused_bounds;
use verify::ledger::{Direction, Ledger};
use verify::record::{self, Host};
use verify::report::charts::{self, Chart};
use verify::report::{self, Report, html, junit, moves, runs, table, write_file};
use verify::work_precision::{Sweep, problems};
use verify::{CHECKS, Check, Context, Effort, Row, atlas, judge, planner};

/// Runs the checks and writes report.json and junit.xml.
#[derive(Parser)]
#[command(name = "cargo xtask verify")]
struct Args {
    /// Fewer cases: within a minute on two cores
    #[arg(long, conflicts_with = "deep")]
    quick: bool,
    /// Ten times as many cases
    #[arg(long)]
    deep: bool,
    /// Run this check alone
    #[arg(long, value_name = "ID", value_parser = known_check)]
    only: Option<&'static Check>,
    /// List the checks
    #[arg(long)]
    list: bool,
    /// Fly one toss, given as the hex floats of a worst input, by every solver, method and formulation
    #[arg(long, value_name = "INPUT", value_parser = hex_case, conflicts_with_all = ["quick", "deep", "only", "format"])]
    replay: Option<Case>,
    /// Take what is better or new into the baseline, and write a dated record; what is worse is not taken
    #[arg(long, conflicts_with_all = ["only", "replay"])]
    bless: bool,
    /// Measure the planner's table alone, as --bless does with everything else
    #[arg(long, conflicts_with_all = ["quick", "deep", "only", "replay", "bless", "format"])]
    fit: bool,
    /// Measure what a toss costs
    #[arg(long, hide = true, conflicts_with_all = ["quick", "deep", "only", "replay", "fit", "format"])]
    bench: bool,
    /// With --bench: count instructions instead, and compare them with the baseline
    #[arg(long, hide = true, requires = "bench")]
    instructions: bool,
    /// Do a work of --instructions so many times
    #[arg(long, hide = true, value_name = "NAME")]
    work: Option<String>,
    /// How often
    #[arg(long, hide = true, default_value_t = 1)]
    times: u32,
    /// Draw the accuracy of the committed records
    #[arg(long, hide = true, conflicts_with_all = ["quick", "deep", "only", "replay", "bless", "format"])]
    history: bool,
    /// Draw this figure from what is committed
    #[arg(long, hide = true, value_enum, requires = "svg", conflicts_with_all = ["quick", "deep", "only", "replay", "bless"])]
    figure: Option<Figure>,
    /// With --figure: into this file
    #[arg(long, hide = true, value_name = "FILE", requires = "figure")]
    svg: Option<PathBuf>,
    /// What goes to standard output
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
    /// Where bounds and reference numbers are
    #[arg(long, value_name = "FOLDER", default_value = "validation", hide = true)]
    validation: PathBuf,
    /// Where reports go
    #[arg(long, value_name = "FOLDER", default_value = "target/verify", hide = true)]
    out: PathBuf,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Format {
    Text,
    Json,
    Junit,
}

/// A figure of committed data.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Figure {
    /// What contestants are known to do where methods fail
    AtlasMatrix,
    /// Speed against accuracy, of the newest record
    WorkPrecision,
}

fn known_check(id: &str) -> Result<&'static Check, String> {
    let known = || CHECKS.iter().map(|check| check.id).collect::<Vec<_>>().join(", ");
    CHECKS.iter().find(|check| check.id == id).ok_or_else(|| format!("no such check; known: {}", known()))
}

fn hex_case(line: &str) -> Result<Case, String> {
    Case::from_hex(line).map_err(|error| format!("{error:#}"))
}

fn main() -> ExitCode {
    let args = Args::parse();
    if args.list {
        print!("{}", listing());
        return ExitCode::SUCCESS;
    }
    match run(&args) {
        Ok(code) => ExitCode::from(code),
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(4)
        }
    }
}

fn listing() -> String {
    CHECKS.iter().map(|check| format!("{:<36} [{}] {}\n", check.id, check.basis.name(), check.claim)).collect()
}

/// The exit code.
fn run(args: &Args) -> anyhow::Result<u8> {
    if let Some(case) = &args.replay {
        print!("{}", runs::text(&atlas::replay(SOLVERS, case)?, Conditioning::new(&case.toss)?));
        return Ok(0);
    }
    if let Some(name) = &args.work {
        work(name, args.times)?;
        return Ok(0);
    }
    if args.bench {
        return bench(args);
    }
    if args.history {
        return history(args);
    }
    if args.fit {
        fit(args)?;
        return Ok(0);
    }
    if let (Some(figure), Some(path)) = (args.figure, &args.svg) {
        write_file(path, &figure.svg(&args.validation)?)?;
        return Ok(0);
    }
    verify(args)
}

/// The checks and their reports; 1 if a check fails, 3 if something is worse than the baseline.
fn verify(args: &Args) -> anyhow::Result<u8> {
    let effort = effort(args);
    let bounds = Bounds::read(&args.validation.join("bounds.toml"))?;
    let context = Context::new(SOLVERS, effort, &args.validation)?;
    let rows = measure(args, &context, &bounds)?;
    ensure!(!rows.is_empty(), "no check measured anything");
    let baseline_path = args.validation.join("baseline").join(format!("{}.csv", effort.name()));
    let (baseline, found) = (Ledger::read(&baseline_path)?, Ledger::of(&rows, context.records().sweep));
    let moves = baseline.moves(&found, args.only.is_none());
    let report = Report::new(effort, &rows, &moves, context.records());
    write_reports(&report, args)?;
    if !report.passed {
        return Ok(1);
    }
    if args.bless {
        write_file(&baseline_path, &baseline.ratcheted(&found).csv()?)?;
        if let Some(sweep) = context.records().sweep.filter(|_| effort == Effort::Standard) {
            record::write(&args.validation.join("record"), &Host::here(), &found, sweep)?;
            fit(args)?;
        }
    }
    Ok(if moves.iter().any(|moved| moved.direction == Direction::Worse) { 3 } else { 0 })
}

/// Times, or instructions; 3 if those are more than the baseline allows.
fn bench(args: &Args) -> anyhow::Result<u8> {
    if args.bless && !args.instructions {
        eprintln!("error: --bless goes with --instructions: times are never judged");
        return Ok(2);
    }
    if !args.instructions {
        print!("{}", Table::measure()?);
        return Ok(0);
    }
    let path = args.validation.join("baseline").join("instructions.csv");
    let (baseline, found) = (Instructions::read(&path)?, Instructions::count()?);
    let (text, is_worse) = found.compared(&baseline);
    print!("{text}");
    if args.bless {
        found.bless(&baseline, &path)?;
    }
    Ok(if is_worse { 3 } else { 0 })
}

/// Measures the planner's table and writes it where the library is built with it.
fn fit(args: &Args) -> anyhow::Result<()> {
    let Host { date, cpu, .. } = Host::here();
    let fitted = planner::fit::fit(format!("{date} on {cpu}"))?;
    write_file(&args.validation.join("fitted.toml"), &planner::fit::text(&fitted)?)
}

fn effort(args: &Args) -> Effort {
    match (args.quick, args.deep) {
        (true, _) => Effort::Quick,
        (_, true) => Effort::Deep,
        _ => Effort::Standard,
    }
}

/// Into files and, as the arguments ask, to standard output.
fn write_reports(report: &Report<'_>, args: &Args) -> anyhow::Result<()> {
    let (json, junit) = (report.json()?, junit::xml(report.rows)?);
    let charts = charts::charts(&report.records)?;
    let page = args.out.join("report.html");
    write_file(&args.out.join("report.json"), &json)?;
    write_file(&args.out.join("junit.xml"), &junit)?;
    write_file(&page, &html::page(report, &charts))?;
    for Chart { file, svg, .. } in &charts {
        write_file(&args.out.join(file), svg)?;
    }
    match args.format {
        Format::Text => {
            println!("{}{}\nreport: {}", table::text(report.rows), moves::text(report.moves), page.display());
        }
        Format::Json => println!("{json}"),
        Format::Junit => println!("{junit}"),
    }
    Ok(())
}

fn history(args: &Args) -> anyhow::Result<u8> {
    let records = record::read(&args.validation.join("record"))?;
    ensure!(!records.is_empty(), "there are no records yet; `cargo xtask verify --bless` writes one");
    let path = args.out.join("history.svg");
    write_file(&path, &charts::history(&records)?)?;
    println!("{}\nchart: {}", report::history::text(&records), path.display());
    Ok(0)
}

impl Figure {
    fn svg(self, validation: &Path) -> anyhow::Result<String> {
        Ok(match self {
            Self::AtlasMatrix => {
                charts::known_failures(&atlas::names(SOLVERS)?, &Expected::read(&validation.join("atlas.toml"))?)?
            }
            Self::WorkPrecision => {
                let folder = validation.join("record");
                let records = record::read(&folder)?;
                let newest = records.last().context("there are no records")?;
                let problems = problems::read(&validation.join("problems.toml"))?;
                let sweep = Sweep::of(&problems, record::samples(&folder, &newest.host.date)?);
                charts::recorded(&sweep, "ensemble", &newest.host.date)?
            }
        })
    }
}

fn measure(args: &Args, context: &Context, bounds: &Bounds) -> anyhow::Result<Vec<Row>> {
    let checks: Vec<&Check> = CHECKS.iter().filter(|check| args.only.is_none_or(|only| only.id == check.id)).collect();
    let style = ProgressStyle::with_template("{spinner} check {pos} of {len}: {msg} ({elapsed})")?;
    let progress = ProgressBar::new(checks.len() as u64).with_style(style);
    progress.enable_steady_tick(std::time::Duration::from_millis(100));
    let mut rows = Vec::new();
    for check in checks {
        progress.inc(1);
        progress.set_message(check.id);
        rows.extend(judge(check, (check.measure)(context)?, bounds));
    }
    progress.finish_and_clear();
    if args.only.is_none() {
        rows.extend(unused_bounds(&rows, bounds));
    }
    Ok(rows)
}
