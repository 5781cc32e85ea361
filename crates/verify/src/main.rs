//! Runs the verification suite; `cargo xtask verify` starts it.
//!
//! Exit codes: 0 all checks pass; 1 a check fails; 2 bad usage; 4 could not run.

use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::ensure;
use clap::{Parser, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};
use toss::SOLVERS;
use verify::bounds::Bounds;
use verify::case::Case;
use verify::judge::unused_bounds;
use verify::report::charts::{Chart, charts};
use verify::report::{Report, junit, runs, table, write_file};
use verify::{CHECKS, Check, Context, Effort, Row, atlas, judge};

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
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(4)
        }
    }
}

fn listing() -> String {
    CHECKS.iter().map(|check| format!("{:<36} [{}] {}\n", check.id, check.basis.name(), check.claim)).collect()
}

fn run(args: &Args) -> anyhow::Result<bool> {
    if let Some(case) = &args.replay {
        print!("{}", runs::text(&atlas::replay(SOLVERS, case)?));
        return Ok(true);
    }
    let (effort, effort_name) = match (args.quick, args.deep) {
        (true, _) => (Effort::Quick, "quick"),
        (_, true) => (Effort::Deep, "deep"),
        _ => (Effort::Standard, "standard"),
    };
    let bounds = Bounds::read(&args.validation.join("bounds.toml"))?;
    let context = Context::new(SOLVERS, effort, &args.validation)?;
    let rows = measure(args, &context, &bounds)?;
    ensure!(!rows.is_empty(), "no check measured anything");
    let report = Report::new(effort_name, &rows, context.records());
    let (json, junit) = (report.json()?, junit::xml(&rows)?);
    write_file(&args.out.join("report.json"), &json)?;
    write_file(&args.out.join("junit.xml"), &junit)?;
    for Chart { file, svg } in charts(&context.records())? {
        write_file(&args.out.join(file), &svg)?;
    }
    match args.format {
        Format::Text => println!("{}\nreport: {}", table::text(&rows), args.out.join("report.json").display()),
        Format::Json => println!("{json}"),
        Format::Junit => println!("{junit}"),
    }
    Ok(report.passed)
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
