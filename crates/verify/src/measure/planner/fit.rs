//! The planner's table: what models cost and how far they are off, measured on random tosses and spaces.

use toss::fitted::{ClosedFit, Fitted};
use toss::{Answer, How, MODELS, Model, Registry, Scene, Want};

use super::clock::{median, nanoseconds};
use super::delivered::{Truth, true_probability};
use super::figures::{SAFETY, SEED, SHARE, rounded};
use super::fit_integrators::{PHASES, SPINS, integrator, tosses_by_turn};
use super::fit_sampling::sampling;
use super::scenes::{self, served};

/// Where the library is built with the table, from the root of the workspace.
pub const FILE: &str = "crates/toss/data/fitted.toml";

/// Measures the whole table; `measured` says when and where.
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

/// The table as the library reads it.
///
/// # Errors
/// Never for plain data.
pub fn text(fitted: &Fitted) -> anyhow::Result<String> {
    let head = "# What models cost and how far they are off: what the planner knows. Measured by `cargo xtask verify --bless`, or\n\
                # `--fit` alone; not to be edited. Costs in ns of one core, errors are the largest met times a factor of safety.\n\n";
    let table = toml::to_string(fitted)?;
    Ok(format!("{head}{}", table.split_inclusive(&[' ', ',', '[', ']', '\n']).map(briefly).collect::<String>()))
}

/// A number of many zeros as a power of ten, which TOML reads too.
fn briefly(piece: &str) -> String {
    let end = piece.find([' ', ',', '[', ']', '\n']).unwrap_or(piece.len());
    match piece[..end].parse::<f64>() {
        Ok(value) if end > 7 => format!("{value:e}{}", &piece[end..]),
        _ => piece.to_owned(),
    }
}

/// A run of a model in closed form.
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
            // So rough that every model serves that can.
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
