//! The atlas of failures: what every contestant does at every hazard, and what a return to sin β = 0 costs.

use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;
use toss::{Attitude, ExactMotion, Formulation, Launch, Scheme, SolveError, Solver, SolverEntry, Stepping, Toss};

use crate::measure::atlas::expected::Expectation;
use crate::measure::atlas::hazards::HAZARDS;
use crate::measure::case::Case;
use crate::measure::check::{Basis, Check};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::run::Answer;
use crate::measure::subject::Subject;

pub(super) const ANSWERS: Check = Check {
    id: "atlas-answers",
    claim: "at every distance from every hazard each contestant does what validation/atlas.toml says: the cured are right \
            or refuse, the raw fail as they are known to (measured: hazards at which it does not)",
    basis: Basis::ClosedForm,
    unit: "hazards",
    measure: answers,
};

pub(super) const TILT_WORK: Check = Check {
    id: "work-by-tilt",
    claim: "the work does not depend on how near to the vertical n starts (measured: most calls over fewest, less 1)",
    basis: Basis::Invariant,
    unit: "1",
    measure: tilt_work,
};

pub(super) const RETURN_WORK: Check = Check {
    id: "work-through-returns",
    claim: "horizontal launches cost no more calls, through all their returns to the vertical, than the same flights seen \
            from a frame far from it (measured: the largest ratio)",
    basis: Basis::CrossMethod,
    unit: "1",
    measure: return_work,
};

fn answers(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let atlas = context.atlas()?;
    let row = |subject: &str| {
        let (mut unexpected, mut is_unclaimed) = (Vec::new(), false);
        for hazard in HAZARDS {
            let (found, expected) = (atlas.worst(hazard.id, subject), expected(context, subject, hazard.id));
            is_unclaimed |= found == Some(Answer::Unclaimed);
            if !found.zip(expected).is_some_and(|(found, expected)| expected.allows(found)) {
                let found = found.map_or("nothing", Answer::name);
                unexpected.push(format!("{}: {found}, where {expected:?} is expected", hazard.id));
            }
        }
        let cases = HAZARDS.iter().map(|hazard| hazard.distances.len() as u64).sum();
        let input =
            if unexpected.is_empty() { "as expected at every hazard".to_owned() } else { unexpected.join("; ") };
        let found = Measurement::figure(ANSWERS.id, subject, unexpected.len() as f64, cases, input);
        found.claiming((!is_unclaimed).then_some(0.0))
    };
    Ok(atlas.subjects().into_iter().map(row).collect())
}

/// What is known of `subject`; of one that nothing is known of, that it is never wrong without an error.
fn expected(context: &Context, subject: &str, hazard: &str) -> Option<Expectation> {
    let known = context.expected.knows(subject);
    if known { context.expected.get(subject, hazard) } else { Some(Expectation::RightOrTypedError) }
}

/// Calls over the distances of F1, of the solvers as they are by default.
fn tilt_work(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let atlas = context.atlas()?;
    let row = |subject: &Subject| {
        // A flight that fails has no calls, and takes the whole row with it.
        let calls: Option<Vec<u64>> = atlas.series("F1", &subject.name).map(|spot| spot.run.rhs_calls).collect();
        let calls = calls.unwrap_or_default();
        let (fewest, most) = (calls.iter().min(), calls.iter().max());
        let spread = fewest.zip(most).map_or(f64::NAN, |(fewest, most)| *most as f64 / *fewest as f64 - 1.0);
        let input = format!("{fewest:?} to {most:?} calls for tilts from 1 rad to 0");
        Measurement::figure(TILT_WORK.id, &subject.name, spread, calls.len() as u64, input).without_claim()
    };
    Ok(context.subjects.iter().filter(|subject| subject.stepping.is_some()).map(row).collect())
}

fn return_work(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let horizontal: Vec<Case> = context.survey()?.cases.iter().filter(|case| case.tilt == 0.0).copied().collect();
    let with_angles = |entry: &&SolverEntry| entry.formulations().contains(&Formulation::VERTICAL);
    let adaptive = |entry: &SolverEntry| entry.schemes().iter().copied().find(|scheme| scheme.is_adaptive());
    let row = |(entry, scheme): (&SolverEntry, Scheme)| {
        let stepping = Stepping::adaptive(scheme, Stepping::DEFAULT_TOLERANCE)?;
        let [cured, far] = [Formulation::MOMENTUM, Formulation::VERTICAL]
            .map(|formulation| Subject::new(entry, Some(stepping), formulation));
        let ratio = |case: &Case| -> Option<Result<f64, SolveError>> {
            let seen = far_from_the_vertical(&case.toss)?;
            Some(calls(&*cured.solver, &case.toss).and_then(|here| Ok(here / calls(&*far.solver, &seen)?)))
        };
        let (flown, ratios): (Vec<Case>, Vec<_>) =
            horizontal.par_iter().filter_map(|case| ratio(case).map(|ratio| (*case, ratio))).unzip();
        Ok(Measurement::largest_within(&cured, ratios, |index| flown[index], |_| Ok(None)).without_claim())
    };
    let angles = context.registry.iter().filter(with_angles);
    angles.filter_map(|entry| Some((entry, adaptive(entry)?))).map(row).collect()
}

fn calls(solver: &dyn Solver, toss: &Toss) -> Result<f64, SolveError> {
    Ok(solver.propagate(toss)?.work.rhs_calls as f64)
}

/// The same flight with S tilted from the vertical by half of what would bring n there or to its opposite; `None` where
/// the cone leaves no room for it.
fn far_from_the_vertical(toss: &Toss) -> Option<Toss> {
    const ROOM: f64 = 0.3;
    let cone = ExactMotion::new(toss).cone_angle();
    let room = FRAC_PI_2 - (FRAC_PI_2 - cone).abs();
    if room < ROOM {
        return None;
    }
    let rate = toss.launch.rate();
    // Turned about n until S is over -y, then about x until it is upright, and on.
    let attitude = Attitude::about_x(0.5 * room - cone) * Attitude::about_z(-FRAC_PI_2 - rate.y.atan2(rate.x));
    let launch = Launch::new(rate, toss.launch.time_of_flight()).ok()?.with_attitude(attitude);
    Some(Toss { launch, ..*toss })
}
