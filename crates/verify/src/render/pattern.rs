//! Says in one paragraph what the failing rows have in common and what passes, because the pattern names the place of a
//! fault sooner than any single row: all integrators, one scheme, one solver, or the library itself.

use std::collections::BTreeSet;

use super::words::family;
use crate::judge::baseline::{Direction, Move};
use crate::judge::{Row, Status};
use crate::measure::check::Judges;

/// How many names a list shows before it counts the rest.
const LISTED: usize = 6;

/// The paragraph on `rows`: which fail, which pass, and what that points to.
pub(crate) fn of_rows(rows: &[Row]) -> String {
    let items: Vec<Item<'_>> = rows.iter().map(|row| Item::of(row, !row.status.passes())).collect();
    let failing = items.iter().filter(|item| item.bad).count();
    let found = SortedRows::new(&items);
    let passing = found.passing();
    if failing == 0 {
        let whole = found.whole();
        let open = rows.iter().filter(|row| row.status == Status::NotJudged).count();
        let end = if whole.is_empty() { whole } else { format!(": {whole}") };
        let judged = rows.len() - open;
        return match open {
            0 => format!("All {judged} rows pass{end}."),
            _ => format!("All {judged} rows that are judged pass, {open} are not{end}."),
        };
    }
    let mut text = format!("Fails: {}.", found.bad());
    if !passing.is_empty() {
        text += &format!(" Passes: {passing}.");
    }
    text + &found.hint()
}

/// The paragraph on what became worse than the baseline; empty if nothing did.
pub(crate) fn of_moves(moves: &[Move], rows: &[Row]) -> String {
    let worse = |check: &str, subject: &str| {
        let is_it = |moved: &&Move| moved.check == check && moved.subject == subject;
        moves.iter().filter(is_it).any(|moved| moved.direction == Direction::Worse)
    };
    let mut items: Vec<Item<'_>> = rows.iter().map(|row| Item::of(row, worse(&row.check, &row.subject))).collect();
    let without_row = moves.iter().filter(|moved| moved.direction == Direction::Worse);
    let without_row = without_row.filter(|moved| !rows.iter().any(|row| moved.is_of(row)));
    items.extend(without_row.map(|moved| Item {
        check: &moved.check,
        subject: &moved.subject,
        judges: Some(Judges::Solver),
        bad: true,
    }));
    if items.iter().any(|item| item.bad) {
        format!("Worse than the baseline: {}.", SortedRows::new(&items).bad())
    } else {
        String::new()
    }
}

/// What the pattern needs of a row.
struct Item<'a> {
    check: &'a str,
    subject: &'a str,
    judges: Option<Judges>,
    bad: bool,
}

impl<'a> Item<'a> {
    fn of(row: &'a Row, bad: bool) -> Self {
        Self { check: &row.check, subject: &row.subject, judges: row.judges, bad }
    }

    /// The solver, `gamma` of `gamma/dop853/vertical`.
    fn solver(&self) -> Option<&'a str> {
        self.subject.split('/').next()
    }

    /// The scheme, `dop853` of `gamma/dop853/vertical`.
    fn scheme(&self) -> Option<&'a str> {
        self.subject.split('/').nth(1)
    }

    /// The formulation, unless it is the default.
    fn formulation(&self) -> Option<&'a str> {
        self.subject.split('/').nth(2)
    }

    fn is_comparison(&self) -> bool {
        self.subject.contains(" ~ ")
    }

    /// The part of the library that the row judges; the check itself if it belongs to none of the known ones.
    fn family(&self) -> Option<&'a str> {
        Some(family(self.check))
    }
}

struct SortedRows<'a> {
    /// Rows about one solver.
    solvers: Vec<&'a Item<'a>>,
    bad: Vec<&'a Item<'a>>,
    /// Rows that compare two solvers. They say that one of the two is wrong, but not which.
    comparisons: Vec<&'a Item<'a>>,
    /// Rows about the library.
    library: Vec<&'a Item<'a>>,
    /// Rows about the suite: a limit without a measurement, a check that took too long.
    suite: Vec<&'a Item<'a>>,
}

impl<'a> SortedRows<'a> {
    fn new(items: &'a [Item<'a>]) -> Self {
        let by = |judges: Option<Judges>| items.iter().filter(move |item| item.judges == judges);
        let (comparisons, solvers): (_, Vec<_>) = by(Some(Judges::Solver)).partition(|item| item.is_comparison());
        let (library, suite) = (by(Some(Judges::Library)).collect(), by(None).collect());
        Self { bad: bad(&solvers), solvers, comparisons, library, suite }
    }

    /// What is bad: solvers, parts of the library, limits without a row.
    fn bad(&self) -> String {
        let mut parts = Vec::new();
        let pairs = names(&bad(&self.comparisons), |item| Some(item.subject));
        if !self.bad.is_empty() {
            parts.push(self.bad_solvers());
        } else if !pairs.is_empty() {
            parts.push(format!("comparisons alone ({})", list(&pairs)));
        }
        let of_library = bad(&self.library);
        for family in names(&of_library, Item::family) {
            let number = |items: &[&Item<'_>]| items.iter().filter(|item| item.family() == Some(family)).count();
            let (bad, all) = (number(&of_library), number(&self.library));
            parts.push(format!("the library's {family} ({bad} of {all} rows)"));
        }
        let suite = names(&bad(&self.suite), |item| Some(item.check));
        parts.extend((!suite.is_empty()).then(|| format!("not measured in time or not at all: {}", list(&suite))));
        parts.join("; ")
    }

    /// Which solvers, by which schemes, in which formulations, under which checks: those among the bad rows, or all.
    fn bad_solvers(&self) -> String {
        let sets = |key: Key<'a>| [names(&self.bad, key), names(&self.solvers, key)];
        let which = |key: Key<'a>, words: &str| {
            let [found, all] = sets(key);
            if found == all && all.len() > 1 { words.to_owned() } else { list(&found) }
        };
        // Where there is one scheme, it need not be named.
        let has_schemes = sets(Item::scheme)[1].len() > 1;
        let schemes = if has_schemes { which(Item::scheme, "every scheme") } else { String::new() };
        let is_by_default = self.bad.iter().any(|item| item.formulation().is_none());
        let formulation = if is_by_default { String::new() } else { list(&names(&self.bad, Item::formulation)) };
        let [found, all] = sets(|item| Some(item.check)).map(|checks| checks.len());
        let checks = list(&names(&self.bad, |item| Some(item.check)));
        let checks = match found {
            _ if found == all && all > 1 => format!("in all {all} solver checks"),
            1 => format!("in one check ({checks})"),
            _ => format!("in {found} of {all} solver checks ({checks})"),
        };
        let after = |before: &str, words: String| if words.is_empty() { words } else { format!(", {before} {words}") };
        let (schemes, formulation) = (after("by", schemes), after("in the formulation", formulation));
        format!("{}{schemes}{formulation}, {checks}", which(Item::solver, "all solvers"))
    }

    /// Solvers and parts of the library without a bad row.
    fn passing(&self) -> String {
        let clean = |items: &[&'a Item<'a>], key: Key<'a>| &names(items, key) - &names(&bad(items), key);
        let names = [clean(&self.solvers, Item::solver), clean(&self.library, Item::family)];
        names.iter().flatten().copied().collect::<Vec<_>>().join(", ")
    }

    /// What was judged, in few words.
    fn whole(&self) -> String {
        let solvers = names(&self.solvers, Item::solver);
        let parts = names(&self.library, Item::family).len();
        let parts =
            (parts > 0).then(|| format!("{parts} {} of the library", if parts == 1 { "part" } else { "parts" }));
        [(!solvers.is_empty()).then(|| list(&solvers)), parts].into_iter().flatten().collect::<Vec<_>>().join(" and ")
    }

    /// Where the fault may be; empty if the pattern does not say.
    fn hint(&self) -> String {
        let [bad, all] = [&self.bad, &self.solvers].map(|items| names(items, Item::solver));
        let integrators = names(&self.solvers, |item| item.scheme().and(item.solver()));
        let schemes: BTreeSet<Option<&str>> = self.bad.iter().map(|item| item.scheme()).collect();
        let checks = names(&self.bad, |item| Some(item.check));
        let hint = if bad.len() > 1 && bad == all {
            "Solvers share the toss, its time of flight, and the suite that judges them."
        } else if bad.len() > 1 && bad == integrators && schemes.len() > 1 {
            "The integrators share the flight, the step control and the body's equations, not the closed form."
        } else if bad.len() > 1 && schemes.len() == 1 && schemes.first().is_some_and(Option::is_some) {
            "The solvers that fail share the scheme, not the equations."
        } else if bad.len() > 1 && checks.len() == 1 {
            "The fault may be in what these solvers share, or in the check."
        } else if bad.is_empty() && self.library.iter().any(|item| item.bad) {
            "No solver is wrong: the fault is in the library beside its solvers."
        } else {
            return String::new();
        };
        format!(" {hint}")
    }
}

type Key<'a> = fn(&Item<'a>) -> Option<&'a str>;

fn names<'a>(items: &[&Item<'a>], key: Key<'a>) -> BTreeSet<&'a str> {
    items.iter().filter_map(|item| key(item)).collect()
}

fn bad<'a>(items: &[&'a Item<'a>]) -> Vec<&'a Item<'a>> {
    items.iter().copied().filter(|item| item.bad).collect()
}

/// The first of `names`, and how many more there are.
fn list(names: &BTreeSet<&str>) -> String {
    let shown: Vec<&str> = names.iter().copied().take(LISTED).collect();
    let rest = names.len() - shown.len();
    shown.join(", ") + &if rest > 0 { format!(" and {rest} more") } else { String::new() }
}

#[cfg(test)]
mod tests;
