//! The program `contest`, which `cargo xtask contest` starts: it flies the contestants beside the solvers of this
//! workspace, compares what it finds with the newest record, and writes records with their page, table and chart.
//!
//! Exit codes: 0; 1, something is worse than the record, or a page is not current; 2, bad usage; 4, it could not run.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context as _;
use clap::Parser;
use contestants::contest::{Contest, Size};
use contestants::{all, page, record};
use indicatif::{ProgressBar, ProgressStyle};
use verify::files;

/// Flies other people's integrators beside the solvers of this workspace
#[derive(Debug, Parser)]
#[command(name = "contest")]
struct Arguments {
    /// Take 40 launches instead of 1000, and leave out hazards and the chart
    #[arg(long)]
    quick: bool,
    /// Write a dated record, and from it docs/contestants.md and its chart
    #[arg(long, conflicts_with = "quick")]
    bless: bool,
    /// Fly nothing; end with 1 if what --bless writes from the newest record is not current
    #[arg(long, conflicts_with_all = ["quick", "bless"])]
    check: bool,
    /// Fly nothing; write the page, the chart and the table again from the newest record
    #[arg(long, conflicts_with_all = ["quick", "bless", "check"])]
    draw: bool,
}

fn main() -> ExitCode {
    let code = run(&Arguments::parse()).unwrap_or_else(|error| {
        whole_file::report(format_args!("{error:#}"));
        4
    });
    ExitCode::from(code)
}

fn run(arguments: &Arguments) -> anyhow::Result<u8> {
    let records = root().join("crates/contestants/record");
    let recorded = record::newest(&records)?;
    if arguments.check || arguments.draw {
        let (contest, samples) = recorded.context("there is no record")?;
        let pages = pages(&contest, &samples)?;
        return if arguments.check { stale(&pages) } else { write(&pages) };
    }
    let (contest, samples) = hold(if arguments.quick { Size::QUICK } else { Size::FULL })?;
    files::print(&page::page(&contest))?;
    if arguments.bless {
        record::write(&records, &contest, &samples)?;
        return write(&pages(&contest, &samples)?);
    }
    let worse = recorded.map(|(record, _)| contest.worse_than(&record)).unwrap_or_default();
    for line in &worse {
        say(&format!("worse than the record: {line}"));
    }
    Ok(u8::from(!worse.is_empty()))
}

fn hold(size: Size) -> anyhow::Result<(Contest, Vec<verify::measure::work_precision::Sample>)> {
    let progress = ProgressBar::new_spinner().with_style(ProgressStyle::with_template("{spinner} {msg} ({elapsed})")?);
    progress.enable_steady_tick(std::time::Duration::from_millis(100));
    let (entries, missing) = all(&root().join("target/contestants"));
    let show = |text: &str| {
        progress.set_message(text.to_owned());
        // Without a terminal the bar shows nothing.
        if progress.is_hidden() {
            say(text);
        }
    };
    if let Some(missing) = missing {
        show(&missing);
    }
    let held = Contest::hold(&entries, size, show);
    progress.finish_and_clear();
    held
}

/// The files that follow from a record.
fn pages(
    contest: &Contest,
    samples: &[verify::measure::work_precision::Sample],
) -> anyhow::Result<Vec<(PathBuf, String)>> {
    Ok(vec![
        (root().join("docs/contestants.md"), page::page(contest)),
        (root().join("docs/contestants.svg"), page::chart(contest, samples)?),
    ])
}

fn write(pages: &[(PathBuf, String)]) -> anyhow::Result<u8> {
    for (path, text) in pages {
        files::write(path, text)?;
    }
    Ok(0)
}

/// 1 if a file is not as it should be, which is printed.
fn stale(pages: &[(PathBuf, String)]) -> anyhow::Result<u8> {
    let mut code = 0;
    for (path, text) in pages {
        if files::read(path).ok().as_ref() != Some(text) {
            say(&format!("not current: {}; `cargo xtask contest --bless` writes it", path.display()));
            code = 1;
        }
    }
    Ok(code)
}

/// Prints a line to standard error; without one there is nobody to read it.
fn say(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// The root of the workspace beside which this crate stands.
fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}
