//! This file measures the planner's table: what each model costs and how large its errors are, on random tosses and
//! spaces. The library is built with the result, so planning itself measures nothing.

use anyhow::ensure;
use toss::fitted::{FITTED, Fitted};
use toss::{Registry, Scheme, SolverEntry};

use super::fit_integrators::{PHASES, SPINS, integrator, tosses_by_turn};
use super::fit_sampling::sampling;
use super::{fit_bodies, fit_closed};

/// The file with which the library is built, relative to the root of the workspace.
pub const FILE: &str = "crates/toss/data/fitted.toml";

/// Measures the whole table; `measured` says when and on which machine, and is written into it.
///
/// # Errors
/// Never for the library's own models.
pub fn fit(measured: String) -> anyhow::Result<Fitted> {
    let tolerances = tolerances();
    let mut integrators = Vec::new();
    let tosses = tosses_by_turn()?;
    for (entry, scheme) in Registry::standard().entries().iter().flat_map(adaptive) {
        integrators.push(integrator(entry, scheme, &tolerances, &tosses)?);
    }
    Ok(Fitted {
        measured,
        closed: fit_closed::closed_forms()?.into_iter().chain(fit_bodies::closed_forms()?).collect(),
        spins: SPINS.to_vec(),
        phases: PHASES.to_vec(),
        tolerances,
        integrators,
        sampling: sampling()?,
    })
}

/// The table that the library was built with, of which the models for a space are measured anew.
///
/// # Errors
/// Never for the library's own models.
pub fn fit_spaces(measured: &str) -> anyhow::Result<Fitted> {
    let before = FITTED.clone();
    let date = before.measured.split("; ").next().unwrap_or_default();
    let measured = format!("{date}; models of a space {measured}");
    Ok(Fitted { measured, sampling: sampling()?, ..before })
}

/// Measures the integrators of `registry` that are not of this workspace, for the planner of somebody who has them.
///
/// # Errors
/// If there are none, or one can't be measured: it counts no calls of its right-hand side, or refuses every flight.
pub fn fit_others(registry: &Registry, measured: String) -> anyhow::Result<Fitted> {
    let is_own = |entry: &&SolverEntry| Registry::standard().named(entry.name()).is_err();
    let own: Vec<_> = registry.entries().iter().filter(is_own).flat_map(adaptive).collect();
    ensure!(
        !own.is_empty(),
        "no integrator to measure: the planner chooses integrators with a tolerance, and the \
                              registry has none beside those of this workspace"
    );
    let (tolerances, tosses) = (tolerances(), tosses_by_turn()?);
    let integrators = own.into_iter().map(|(entry, scheme)| {
        let fit = integrator(entry, scheme, &tolerances, &tosses)?;
        let name = format!("{}/{}", entry.name(), scheme.name());
        ensure!(
            fit.call_ns.is_finite() && fit.call_ns > 0.0,
            "{name}: no call of the right-hand side was counted, and \
                 the planner predicts costs from these counts"
        );
        Ok(fit)
    });
    Ok(Fitted {
        measured,
        closed: Vec::new(),
        spins: SPINS.to_vec(),
        phases: PHASES.to_vec(),
        tolerances: tolerances.clone(),
        integrators: integrators.collect::<anyhow::Result<_>>()?,
        sampling: Vec::new(),
    })
}

/// The solver of `entry` with each of its schemes that take a tolerance.
fn adaptive(entry: &SolverEntry) -> impl Iterator<Item = (&SolverEntry, Scheme)> {
    entry.schemes().iter().copied().filter(|scheme| scheme.is_adaptive()).map(move |scheme| (entry, scheme))
}

fn tolerances() -> Vec<f64> {
    (3..=14).map(|decade| 10f64.powi(-decade)).collect()
}

/// The table as TOML, which the library reads.
///
/// # Errors
/// Never for plain data.
pub fn text(fitted: &Fitted) -> anyhow::Result<String> {
    let head = "# The planner's table: what each model costs and how large its error is. Measured by the command\n\
                # `fit` of the verification suite; do not edit it. Costs are in ns of one core; errors are the\n\
                # largest met, times a safety factor.\n\n";
    let table = toml::to_string(fitted)?;
    Ok(format!("{head}{}", table.split_inclusive(&[' ', ',', '[', ']', '\n']).map(briefly).collect::<String>()))
}

/// `piece` with its number, if it is a long one, written with an exponent, which TOML reads too.
fn briefly(piece: &str) -> String {
    let end = piece.find([' ', ',', '[', ']', '\n']).unwrap_or(piece.len());
    match piece[..end].parse::<f64>() {
        Ok(value) if end > 7 => format!("{value:e}{}", &piece[end..]),
        _ => piece.to_owned(),
    }
}
