//! This file measures the planner's table: what each model costs and how large its errors are, on random tosses and
//! spaces. The library is built with the result, so planning itself measures nothing.

use toss::fitted::{ClosedFit, Fitted};
use toss::{Answer, How, MODELS, Model, Registry, Scene, Want};

use super::clock::{median, nanoseconds};
use super::delivered::{Truth, true_probability};
use super::figures::{SAFETY, SEED, SHARE, rounded};
use super::fit_integrators::{PHASES, SPINS, integrator, tosses_by_turn};
use super::fit_sampling::sampling;
use super::scenes::{self, served};

/// The file with which the library is built, relative to the root of the workspace.
pub const FILE: &str = "crates/toss/data/fitted.toml";

/// Measures the whole table; `measured` says when and on which machine, and is written into it.
///
/// # Errors
/// Never for the library's own models.
pub fn fit(measured: String) -> anyhow::Result<Fitted> {
    let tolerances: Vec<f64> = (3..=14).map(|decade| 10f64.powi(-decade)).collect();
    let mut integrators = Vec::new();
    let tosses = tosses_by_turn()?;
    for entry in Registry::standard().entries() {
        for scheme in entry.schemes().iter().copied().filter(|scheme| scheme.is_adaptive()) {
            integrators.push(integrator(entry, scheme, &tolerances, &tosses)?);
        }
    }
    Ok(Fitted {
        measured,
        closed: closed_forms()?,
        spins: SPINS.to_vec(),
        phases: PHASES.to_vec(),
        tolerances,
        integrators,
        sampling: sampling()?,
    })
}

/// The table as TOML, which the library reads.
///
/// # Errors
/// Never for plain data.
pub fn text(fitted: &Fitted) -> anyhow::Result<String> {
    let head = "# The planner's table: what each model costs and how large its error is. Measured by\n\
                # `cargo xtask verify --bless`, or `--fit` alone; do not edit it. Costs are in ns of one core; errors\n\
                # are the largest met, times a safety factor.\n\n";
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

/// One answer of a model in closed form, with its error and cost.
struct Flown {
    model: &'static Model,
    error: f64,
    cost_ns: f64,
}

fn closed_forms() -> anyhow::Result<Vec<ClosedFit>> {
    const TOSSES: u64 = 4000;
    let mut flown = Vec::new();
    for index in 0..TOSSES {
        let toss = scenes::toss(SEED, index)?.toss;
        let truth = Truth::new(&toss);
        for want in [Want::Outcome(toss), Want::Tilt(toss), Want::Attitude(toss), Want::Trace { toss, points: 5 }] {
            // With such a rough accuracy every model that can answer the scene also serves it.
            let scene = Scene::new(want, f64::MAX);
            for choice in served(&scene)?.into_iter().filter(|choice| matches!(choice.how, How::ClosedForm)) {
                let error = truth.error(&scene, &choice.run(&scene)?)?;
                let points = if choice.model.name == "trace" { 5.0 } else { 1.0 };
                let cost_ns = if index % 8 == 0 { nanoseconds(|| choice.run(&scene)) / points } else { f64::NAN };
                flown.push(Flown { model: choice.model, error, cost_ns });
            }
        }
    }
    let of = |model: &'static Model| closed_form(model, flown.iter().filter(move |flown| flown.model == model));
    Ok(MODELS.iter().filter(|model| model.is_closed_form()).map(of).chain([share()?]).collect())
}

fn closed_form<'a>(model: &Model, flown: impl Iterator<Item = &'a Flown> + Clone) -> ClosedFit {
    let costs = flown.clone().map(|flown| flown.cost_ns).filter(|cost| !cost.is_nan()).collect();
    let error = flown.map(|flown| flown.error).fold(0.0, f64::max);
    ClosedFit { model: model.name.to_owned(), cost_ns: rounded(median(costs)), error: rounded(SAFETY * error) }
}

fn share() -> anyhow::Result<ClosedFit> {
    let mut errors = Vec::new();
    let mut costs = Vec::new();
    for index in 0..400 {
        let space = scenes::space(SEED, index)?;
        let scene = Scene::new(Want::Probability(space), f64::MAX);
        for choice in served(&scene)?.into_iter().filter(|choice| choice.model.name == SHARE) {
            if let Answer::Probability(found) = choice.run(&scene)? {
                errors.push((found.probability - true_probability(&space, 1 << 12)?).abs());
                costs.push(nanoseconds(|| choice.run(&scene)));
            }
        }
    }
    let error = errors.into_iter().fold(0.0, f64::max);
    Ok(ClosedFit { model: SHARE.to_owned(), cost_ns: rounded(median(costs)), error: rounded(SAFETY * error) })
}
