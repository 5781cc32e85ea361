//! The command `replay` measures one toss again, given by the text of a row's worst input. With the row it prints what that
//! row measures on the toss, and the verdict. Without, it solves the toss with every solver, scheme and formulation, prints
//! their answers side by side, and below them what each check of the library measures.

use std::path::Path;

use anyhow::Context as _;
use clap::Args;
use dynamics::Toss;

use super::program::Foreign;
use crate::measure::atlas;
use crate::measure::atlas::conditioning::Conditioning;
use crate::measure::case;
use crate::render::runs;
use crate::suite::{Suite, check_named};
use crate::{CHECKS, Check, Context, Effort, Judges, files, judge};

/// Measure one toss again: by every solver, scheme and formulation, or as a row does
#[derive(Debug, Args)]
pub(super) struct Replay {
    /// The toss, as in the text of a row's worst input: i1=5e-7 i3=2.5e-7 rate=1,1,2.5 tilt=0 time=0.5
    #[arg(value_parser = input)]
    pub(super) input: Toss,
    /// The row, as CHECK / SUBJECT, whose quantity is measured on the toss and judged
    #[arg(long, value_name = "ROW", value_parser = row)]
    row: Option<Row>,
    #[command(flatten)]
    foreign: Foreign,
}

/// A row: its check and its subject.
#[derive(Debug, Clone)]
struct Row(&'static Check, String);

/// Reads the toss from its text.
pub(super) fn input(text: &str) -> Result<Toss, String> {
    case::read(text).map_err(|error| format!("{error:#}"))
}

fn row(text: &str) -> Result<Row, String> {
    let (check, subject) = text.split_once(" / ").ok_or("a row is CHECK / SUBJECT")?;
    Ok(Row(check_named(check).map_err(|error| error.to_string())?, subject.to_owned()))
}

impl Replay {
    pub(super) fn run(&self, suite: Suite, out: &Path) -> anyhow::Result<u8> {
        let suite = self.foreign.in_place_of(suite, out)?;
        let context = Context::new(suite.registry().entries(), Effort::Quick)?;
        let text = match &self.row {
            Some(row) => self.as_row(row, &suite, &context)?,
            None => self.by_all(&context)?,
        };
        files::print(&text)?;
        Ok(0)
    }

    fn as_row(&self, Row(check, subject): &Row, suite: &Suite, context: &Context) -> anyhow::Result<String> {
        let measured = check.again(context, &self.input, &|name| name == subject)?;
        let judged = judge(check, measured, &suite.all_bounds()?);
        let id = check.id;
        let of_many = || format!("'{id} / {subject}' measures no deviation of one such toss: --only {id} repeats it");
        let found = judged.first().with_context(of_many)?;
        Ok(runs::of_row(found))
    }

    /// The answers of every solver, and what the checks of the library measure; a quantity of several sets once.
    fn by_all(&self, context: &Context) -> anyhow::Result<String> {
        let runs = atlas::replay(&context.registry, &self.input)?;
        let mut text = runs::text(&runs, Conditioning::new(&self.input)?);
        for check in CHECKS.iter().filter(|check| check.judges == Judges::Library) {
            let mut last = None;
            for found in check.again(context, &self.input, &|_| true)? {
                if last.replace(found.measured) != Some(found.measured) {
                    text += &runs::of_library(check, &found);
                }
            }
        }
        Ok(text)
    }
}
