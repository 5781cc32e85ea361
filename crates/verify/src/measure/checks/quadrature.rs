//! These checks compare probabilities of heads by quadrature with reference numbers of many digits, and its error estimates
//! with its errors over many spaces.

use sampling::quadrature::{coordinates, require_smooth};
use sampling::{Plan, Sampler, Space};

use super::figures;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::effort::Effort;
use crate::measure::measurement::Measurement;
use crate::measure::planner::scenes;

pub(super) const FIGURES: Check = Check {
    id: "quadrature-figures",
    claim: "P(heads) by quadrature to 1e-9 differs from the reference numbers by at most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-9,
    unit: "1",
    measure: figures,
};

pub(super) const ESTIMATES: Check = Check {
    id: "quadrature-estimate",
    claim: "On random spaces, P(heads) by quadrature differs from that by quadrature to a hundredth of its accuracy by at \
            most the stated errors of both. Measured: the largest difference divided by them; it fails above the bound.",
    basis: Basis::CrossMethod,
    judges: Judges::Library,
    ceiling: 1.0,
    unit: "1",
    measure: estimates,
};

fn by(space: &Space, accuracy: f64) -> anyhow::Result<[f64; 2]> {
    let found = Sampler::exact().estimate(space, Plan::Quadrature { accuracy })?;
    Ok([found.probability, found.half_width().unwrap_or(f64::INFINITY)])
}

fn figures(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let mut measurements = Vec::new();
    for of in figures::all()? {
        let space = of.space()?;
        // The flights of some spaces make 10^8 turns, and have more kinks than can be located.
        if require_smooth(&space).is_err() || space.axis(sampling::Coordinate::Speed).bounds()[1] > 1e3 {
            continue;
        }
        let ([found, error], figure) = (by(&space, 1e-9)?, context.reference_probabilities.figure(of.name)?);
        let input = format!("{found:.12} ± {error:.1e} for {figure:.12}");
        measurements.push(Measurement::figure(FIGURES.id, of.name, (found - figure).abs(), 1, input));
    }
    Ok(measurements)
}

/// The spaces are those of the planner's scenes: rates and the tilt are values or ranges, and the speed is a range.
fn estimates(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    const SEED: u64 = 64;
    let spaces = match context.effort {
        Effort::Quick => 30,
        Effort::Standard => 300,
        Effort::Deep => 1500,
    };
    let mut worst = [(0.0, String::new()), (0.0, String::new())];
    let mut cases = [0; 2];
    for index in 0..spaces {
        let space = scenes::space(SEED, index)?;
        let number = coordinates(&space);
        if require_smooth(&space).is_err() || number == 0 {
            continue;
        }
        let accuracy = 100.0 * 10_f64.powi(-(4 + i32::try_from(index % 4)?));
        let ([found, error], [truth, rest]) = (by(&space, accuracy)?, by(&space, 0.01 * accuracy)?);
        let ratio = (found - truth).abs() / (error + rest);
        cases[number - 1] += 1;
        // Spaces whose launches all show one face have no error, and nothing to divide by.
        if ratio > worst[number - 1].0 {
            worst[number - 1] = (ratio, format!("space {index}: {found} ± {error:.1e} for {truth}"));
        }
    }
    let names = ["one coordinate beside the speed", "two coordinates beside the speed"];
    let all = names.into_iter().zip(worst).zip(cases);
    Ok(all
        .map(|((name, (ratio, input)), cases)| Measurement::figure(ESTIMATES.id, name, ratio, cases, input))
        .collect())
}
