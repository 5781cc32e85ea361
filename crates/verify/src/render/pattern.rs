//! Says in one paragraph which solvers, schemes and checks of the library the failing rows are about, and which pass,
//! because that names the place of a fault sooner than any single row.

use std::collections::BTreeSet;

use crate::judge::baseline::{Direction, Move};
use crate::judge::{Row, Status};
use crate::measure::check::Judges;

/// How many names a list shows before it counts the rest.
const LISTED: usize = 6;

/// The paragraph on `rows`: which fail, and which pass.
pub(crate) fn of_rows(rows: &[Row]) -> String {
    let items: Vec<Item<'_>> = rows.iter().map(|row| Item::of(row, !row.status.passes())).collect();
    let solvers = Names::of(&items, Some(Judges::Solver), part(0));
    let library = Names::of(&items, Some(Judges::Library), check);
    let of_library = |number: usize| match number {
        0 => None,
        1 => Some("1 check of the library".to_owned()),
        checks => Some(format!("{checks} checks of the library")),
    };
    if items.iter().any(|item| item.bad) {
        let solvers = solvers.all.difference(&solvers.bad).map(|name| (*name).to_owned());
        let passing: Vec<String> = solvers.chain(of_library(library.all.len() - library.bad.len())).collect();
        let passing = if passing.is_empty() { String::new() } else { format!(" Passes: {}.", passing.join(", ")) };
        return format!("Fails: {}.{passing}", bad(&items));
    }
    let solvers = (!solvers.all.is_empty()).then(|| list(&solvers.all));
    let whole = solvers.into_iter().chain(of_library(library.all.len())).collect::<Vec<_>>().join(" and ");
    let end = if whole.is_empty() { whole } else { format!(": {whole}") };
    let open = rows.iter().filter(|row| row.status == Status::NotJudged).count();
    match rows.len() - open {
        judged if open == 0 => format!("All {judged} rows pass{end}."),
        judged if open == 1 => format!("All {judged} rows that are judged pass, one is not{end}."),
        judged => format!("All {judged} rows that are judged pass, {open} are not{end}."),
    }
}

/// The paragraph on what became worse than the baseline; empty if nothing did.
pub(crate) fn of_moves(moves: &[Move], rows: &[Row]) -> String {
    let worse: Vec<&Move> = moves.iter().filter(|moved| moved.direction == Direction::Worse).collect();
    if worse.is_empty() {
        return String::new();
    }
    let is_worse = |row: &Row| worse.iter().any(|moved| moved.is_of(row));
    let mut items: Vec<Item<'_>> = rows.iter().map(|row| Item::of(row, is_worse(row))).collect();
    // A problem of speed and accuracy has no row.
    let without_row = worse.iter().filter(|moved| !rows.iter().any(|row| moved.is_of(row)));
    let judges = Some(Judges::Solver);
    items.extend(without_row.map(|Move { check, subject, .. }| Item { check, subject, judges, bad: true }));
    format!("Worse than the baseline: {}.", bad(&items))
}

/// What the paragraph needs of a row.
struct Item<'a> {
    check: &'a str,
    /// `solver`, `solver/scheme` or `solver/scheme/formulation`, if it is about a solver.
    subject: &'a str,
    judges: Option<Judges>,
    bad: bool,
}

impl<'a> Item<'a> {
    fn of(row: &'a Row, bad: bool) -> Self {
        Self { check: &row.check, subject: &row.subject, judges: row.judges, bad }
    }
}

fn check<'a>(item: &Item<'a>) -> Option<&'a str> {
    Some(item.check)
}

/// The solver (0), the scheme (1) or the formulation (2) that an item is about.
fn part<'a>(index: usize) -> impl Fn(&Item<'a>) -> Option<&'a str> {
    move |item| item.subject.split('/').nth(index)
}

/// What the items of solvers, of the library or (`None`) of the suite have as a name: all of them, and the bad ones.
struct Names<'a> {
    all: BTreeSet<&'a str>,
    bad: BTreeSet<&'a str>,
}

impl<'a> Names<'a> {
    fn of(items: &[Item<'a>], judges: Option<Judges>, name: impl Fn(&Item<'a>) -> Option<&'a str>) -> Self {
        let of = || items.iter().filter(|item| item.judges == judges);
        Self { all: of().filter_map(&name).collect(), bad: of().filter(|item| item.bad).filter_map(&name).collect() }
    }

    /// The bad ones, or `every` if there are no others.
    fn words(&self, every: &str) -> String {
        if self.bad == self.all && self.all.len() > 1 { every.to_owned() } else { list(&self.bad) }
    }
}

/// What is bad: solvers with their schemes, formulations and checks, checks of the library, and what was not measured.
fn bad(items: &[Item<'_>]) -> String {
    let of_solvers = Some(Judges::Solver);
    let [solvers, schemes, formulations] = [0, 1, 2].map(|index| Names::of(items, of_solvers, part(index)));
    let checks = Names::of(items, of_solvers, check);
    let mut parts = Vec::new();
    if !solvers.bad.is_empty() {
        let after = |before, words: String| if words.is_empty() { words } else { format!(", {before} {words}") };
        // Where there is one scheme, it need not be named.
        let schemes = if schemes.all.len() > 1 { schemes.words("every scheme") } else { String::new() };
        let is_default = |item: &Item<'_>| item.bad && item.judges == of_solvers && part(2)(item).is_none();
        let formulation = if items.iter().any(is_default) { String::new() } else { list(&formulations.bad) };
        let where_bad = match (checks.bad.len(), checks.all.len()) {
            (bad, all) if bad == all && all > 1 => format!("in all {all} solver checks"),
            (1, _) => format!("in one check ({})", list(&checks.bad)),
            (bad, all) => format!("in {bad} of {all} solver checks ({})", list(&checks.bad)),
        };
        let (schemes, formulation) = (after("by", schemes), after("in the formulation", formulation));
        parts.push(format!("{}{schemes}{formulation}, {where_bad}", solvers.words("all solvers")));
    }
    for (judges, what) in [(Some(Judges::Library), "the library, in"), (None, "not measured in time or not at all:")] {
        let bad = Names::of(items, judges, check).bad;
        parts.extend((!bad.is_empty()).then(|| format!("{what} {}", list(&bad))));
    }
    parts.join("; ")
}

/// The first of `names`, and how many more there are.
fn list(names: &BTreeSet<&str>) -> String {
    let shown: Vec<&str> = names.iter().copied().take(LISTED).collect();
    let rest = names.len() - shown.len();
    shown.join(", ") + &if rest > 0 { format!(" and {rest} more") } else { String::new() }
}

#[cfg(test)]
mod tests;
