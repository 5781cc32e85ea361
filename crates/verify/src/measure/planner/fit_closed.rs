//! This file measures the models in closed form for coins: errors and costs over random tosses and spaces.

use toss::fitted::ClosedFit;
use toss::{Answer, How, MODELS, Model, Scene, Want};

use super::clock::{median, nanoseconds};
use super::delivered::{Truth, true_probability};
use super::figures::{SAFETY, SEED, SHARE, rounded};
use super::scenes::{self, served};

/// One answer of a model in closed form, with its error and cost.
pub(super) struct Flown {
    pub(super) model: &'static Model,
    pub(super) error: f64,
    pub(super) cost_ns: f64,
}

/// The models in closed form, and the one that integrates over the speed.
pub(super) fn closed_forms() -> anyhow::Result<Vec<ClosedFit>> {
    const TOSSES: u64 = 4000;
    let mut flown = Vec::new();
    for index in 0..TOSSES {
        let toss = scenes::toss(SEED, index)?.toss;
        let truth = Truth::new(&toss);
        for want in [
            Want::Outcome(toss.into()),
            Want::Tilt(toss.into()),
            Want::Attitude(toss.into()),
            Want::Trace { toss: toss.into(), points: 5 },
        ] {
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
    Ok(MODELS
        .iter()
        .filter(|model| model.is_closed_form() && !model.is_for_other_bodies())
        .map(of)
        .chain([share()?])
        .collect())
}

pub(super) fn closed_form<'a>(model: &Model, flown: impl Iterator<Item = &'a Flown> + Clone) -> ClosedFit {
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
