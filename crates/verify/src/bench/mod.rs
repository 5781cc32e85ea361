//! This module measures what a toss costs; `cargo xtask bench` prints the table. It says how fast each way to solve a
//! toss is on your machine, and how large its error is.
//!
//! Times are in nanoseconds and in xR, multiples of the time of a reference (`reference.rs`) that is measured in turn
//! with them, so they can be compared across machines. Each time is the shortest of many runs. All are run in turn, so
//! that a machine that slows down affects all alike. Times are not judged, because they vary from run to run;
//! [`instructions`] are.

mod bodies;
mod contest;
pub(crate) mod instructions;
mod integrators;
mod kernels;
mod launches;
mod reference;
pub(crate) mod to_accuracy;
mod tosses;

use std::fmt;

use crate::host::Host;
use contest::{Contest, race};
use reference::Reference;

/// The table of all contestants, the ways to solve a toss that are timed.
pub(crate) struct Table {
    host: Host,
    reference: String,
    rows: Vec<Row>,
}

struct Row {
    group: &'static str,
    name: String,
    error: Option<f64>,
    nanoseconds: f64,
    by_reference: f64,
}

impl Table {
    /// Times all contestants and measures their errors.
    pub(crate) fn measure() -> anyhow::Result<Self> {
        let (columns, mut reference) = (tosses::Columns::new(tosses::TOSSES), Reference::start().ok());
        let flown = tosses::Columns::new(integrators::FLOWN);
        let mut contests = kernels::contests(&columns);
        contests.extend(launches::contests()?);
        contests.extend(bodies::contests(&flown, &columns));
        contests.extend(integrators::contests(&flown, bodies::body())?);
        let times = race(&mut contests, reference.as_mut())?;
        let row = |contest: &Contest<'_>, nanoseconds: f64| Row {
            group: contest.group,
            name: contest.name.clone(),
            error: contest.error,
            nanoseconds,
            by_reference: nanoseconds / times.reference,
        };
        let mut rows: Vec<Row> =
            contests.iter().zip(&times.contests).map(|(contest, time)| row(contest, *time)).collect();
        if let Some(reference) = &reference {
            rows.insert(0, kernels::reference(&columns, reference, times.reference));
        }
        let reference =
            reference.map(|reference| format!("cos θ by the closed form in C, cc {}, libmvec", reference.flags));
        let without = "cos θ by the closed form, one by one (no C compiler with libmvec)";
        Ok(Self { host: Host::here(), reference: reference.unwrap_or(without.to_owned()), rows })
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Host { cpu, cores, rustc, commit, .. } = &self.host;
        writeln!(f, "host       {cpu}, {cores} cores, {rustc}, {commit}")?;
        writeln!(f, "reference  {}", self.reference)?;
        let mut group = "";
        for row in &self.rows {
            if row.group != group {
                group = row.group;
                writeln!(f, "\n{group:<44} {:>10} {:>10} {:>10}", "ns", "xR", "error")?;
            }
            let error = row.error.map_or(String::new(), |error| format!("{error:.1e}"));
            let Row { name, nanoseconds, by_reference, .. } = row;
            writeln!(f, "  {name:<42} {nanoseconds:>10.2} {by_reference:>10.2} {error:>10}")?;
        }
        Ok(())
    }
}
