//! Says in one paragraph what the failing rows have in common and what passes, because the pattern names the place of a
//! fault sooner than any single row: all integrators, one scheme, one solver, or the library itself.

use std::collections::{BTreeMap, BTreeSet};

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
    fn solver(&self) -> &'a str {
        self.subject.split('/').next().unwrap_or(self.subject)
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
    fn family(&self) -> &'a str {
        family(self.check)
    }
}

/// The rows, sorted by what they judge.
struct SortedRows<'a> {
    /// Rows about one solver.
    solvers: Vec<&'a Item<'a>>,
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
        let (comparisons, solvers) = by(Some(Judges::Solver)).partition(|item| item.is_comparison());
        Self { solvers, comparisons, library: by(Some(Judges::Library)).collect(), suite: by(None).collect() }
    }

    /// What is bad: solvers, parts of the library, limits without a row.
    fn bad(&self) -> String {
        let mut parts = Vec::new();
        if self.solvers.iter().any(|item| item.bad) {
            parts.push(self.bad_solvers());
        } else {
            let pairs: BTreeSet<&str> = self.comparisons.iter().filter(|i| i.bad).map(|i| i.subject).collect();
            parts.extend((!pairs.is_empty()).then(|| format!("comparisons alone ({})", list(&pairs))));
        }
        for (family, items) in grouped(&self.library, |item| item.family()) {
            let bad = items.iter().filter(|item| item.bad).count();
            parts.extend((bad > 0).then(|| format!("the library's {family} ({bad} of {} rows)", items.len())));
        }
        let suite: BTreeSet<&str> = self.suite.iter().filter(|item| item.bad).map(|item| item.check).collect();
        parts.extend((!suite.is_empty()).then(|| format!("not measured in time or not at all: {}", list(&suite))));
        parts.join("; ")
    }

    /// Solvers and parts of the library without a bad row.
    fn passing(&self) -> String {
        let clean = |items: &[&'a Item<'a>], key: fn(&Item<'a>) -> &'a str| {
            let groups = grouped(items, |item| key(item)).into_iter();
            groups.filter(|(_, items)| !items.iter().any(|i| i.bad)).map(|(name, _)| name).collect::<BTreeSet<&str>>()
        };
        let mut names: Vec<&str> = clean(&self.solvers, Item::solver).into_iter().collect();
        names.extend(clean(&self.library, Item::family));
        names.join(", ")
    }

    /// What was judged, in few words.
    fn whole(&self) -> String {
        let solvers = self.names(|_| true);
        let parts = grouped(&self.library, |item| item.family()).len();
        let parts =
            (parts > 0).then(|| format!("{parts} {} of the library", if parts == 1 { "part" } else { "parts" }));
        [(!solvers.is_empty()).then(|| list(&solvers)), parts].into_iter().flatten().collect::<Vec<_>>().join(" and ")
    }

    fn bad_items(&self) -> Vec<&'a Item<'a>> {
        self.solvers.iter().copied().filter(|item| item.bad).collect()
    }

    /// The names of solvers with a row that `which` selects.
    fn names(&self, which: impl Fn(&Item<'_>) -> bool) -> BTreeSet<&'a str> {
        self.solvers.iter().filter(|item| which(item)).map(|item| item.solver()).collect()
    }

    /// Which solvers, by which schemes, in which formulation, under which checks.
    fn bad_solvers(&self) -> String {
        let checks = self.bad_checks();
        [self.which_solvers(), self.which_schemes(), self.which_formulation(), checks].concat()
    }

    fn which_solvers(&self) -> String {
        let (bad, all) = (self.names(|item| item.bad), self.names(|_| true));
        let integrators = self.names(|item| item.scheme().is_some());
        if bad.len() > 1 && bad == all {
            "all solvers".to_owned()
        } else if bad.len() > 1 && bad == integrators {
            "all integrators".to_owned()
        } else {
            list(&bad)
        }
    }

    fn which_schemes(&self) -> String {
        let bad = self.bad_items();
        let schemes_of = |items: &[&Item<'a>]| items.iter().filter_map(|i| i.scheme()).collect::<BTreeSet<&str>>();
        let of_bad_solvers: Vec<&Item<'a>> =
            self.solvers.iter().copied().filter(|item| bad.iter().any(|b| b.solver() == item.solver())).collect();
        let pairs = |items: &[&Item<'a>]| -> BTreeSet<(&str, &str)> {
            items.iter().filter_map(|item| Some((item.solver(), item.scheme()?))).collect()
        };
        let (failing, existing) = (pairs(&bad), pairs(&of_bad_solvers));
        let schemes = schemes_of(&bad);
        let by_these: BTreeSet<(&str, &str)> =
            existing.iter().copied().filter(|(_, scheme)| schemes.contains(scheme)).collect();
        if failing.is_empty() {
            String::new()
        } else if failing == existing {
            if existing.len() > 1 { ", every scheme".to_owned() } else { String::new() }
        } else if failing == by_these {
            format!(", by {} alone", list(&schemes))
        } else {
            let subjects: Vec<String> = failing.iter().map(|(solver, scheme)| format!("{solver}/{scheme}")).collect();
            format!(", not by every scheme ({})", list(&subjects.iter().map(String::as_str).collect()))
        }
    }

    fn which_formulation(&self) -> String {
        let formulations: BTreeSet<Option<&str>> = self.bad_items().iter().map(|item| item.formulation()).collect();
        match formulations.iter().collect::<Vec<_>>()[..] {
            [Some(formulation)] => format!(", in the formulation {formulation} alone"),
            _ => String::new(),
        }
    }

    fn bad_checks(&self) -> String {
        let bad: BTreeSet<&str> = self.bad_items().iter().map(|item| item.check).collect();
        let all: BTreeSet<&str> = self.solvers.iter().map(|item| item.check).collect();
        if bad.len() == all.len() && all.len() > 1 {
            format!(", in all {} solver checks", all.len())
        } else if bad.len() == 1 {
            format!(", in one check ({})", list(&bad))
        } else {
            format!(", in {} of {} solver checks ({})", bad.len(), all.len(), list(&bad))
        }
    }

    /// Where the fault may be; empty if the pattern does not say.
    fn hint(&self) -> String {
        let (bad, all) = (self.names(|item| item.bad), self.names(|_| true));
        let integrators = self.names(|item| item.scheme().is_some());
        let schemes: BTreeSet<Option<&str>> = self.bad_items().iter().map(|item| item.scheme()).collect();
        let checks: BTreeSet<&str> = self.bad_items().iter().map(|item| item.check).collect();
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

/// `items` by the name that `key` gives them, in the order in which the names appear.
fn grouped<'a>(items: &[&'a Item<'a>], key: impl Fn(&Item<'a>) -> &'a str) -> BTreeMap<&'a str, Vec<&'a Item<'a>>> {
    let mut groups: BTreeMap<&str, Vec<&Item<'_>>> = BTreeMap::new();
    for item in items {
        groups.entry(key(item)).or_default().push(item);
    }
    groups
}

/// The first of `names`, and how many more there are.
fn list(names: &BTreeSet<&str>) -> String {
    let shown: Vec<&str> = names.iter().copied().take(LISTED).collect();
    let rest = names.len() - shown.len();
    shown.join(", ") + &if rest > 0 { format!(" and {rest} more") } else { String::new() }
}

#[cfg(test)]
mod tests;
