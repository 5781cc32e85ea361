//! These checks compare what every contestant does near the places where methods fail with what is known of it, and
//! count what such a place costs. A contestant is a solver with a scheme and a formulation; a hazard is a place where
//! some method fails. The raw equations of the paper are meant to fail there, so doing better than known fails the
//! check too.

use std::f64::consts::FRAC_PI_2;

use rayon::prelude::*;
use toss::{Attitude, CoinMotion, CoinToss, Formulation, Launch, Scheme, SolveError, Solver, SolverEntry, Stepping};

use crate::measure::atlas::expected::Expectation;
use crate::measure::atlas::hazards::HAZARDS;
use crate::measure::case::Case;
use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::run::Answer;
use crate::measure::subject::Subject;

pub(super) const ANSWERS: Check = Check {
    id: "atlas-answers",
    claim: "Near every place where some method fails, each solver, scheme and formulation does what \
            atlas.toml records: it is right, returns an error, or is wrong as it is known to be. Measured: \
            the number of places where it does anything else; one is enough to fail.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: 0.0,
    unit: "hazards",
    measure: answers,
};

pub(super) const TILT_WORK: Check = Check {
    id: "work-by-tilt",
    claim: "The calls of the right-hand side do not depend on how near to the vertical the coin's normal starts, for \
            tilts from 1 rad to 0. Measured: the most calls divided by the fewest, less 1; it fails above the bound.",
    basis: Basis::Invariant,
    judges: Judges::Solver,
    ceiling: 1.0,
    unit: "1",
    measure: tilt_work,
};

pub(super) const RETURN_WORK: Check = Check {
    id: "work-through-returns",
    claim: "A horizontal launch, on which the coin's normal returns to the vertical again and again, takes by default \
            no more calls of the right-hand side, unless it is short, than the same flight in the vertical formulation, \
            tilted so that the normal stays away from the vertical. Measured: the largest ratio of calls; it fails above \
            the bound.",
    basis: Basis::CrossMethod,
    judges: Judges::Solver,
    ceiling: 3.0,
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
                let expected = expected.map_or("nothing", Expectation::name);
                unexpected.push(format!("{}: {found}, where {expected} is expected", hazard.id));
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

/// What `subject` is known to do at `hazard`. A subject that the table does not list may be right or return a typed
/// error.
fn expected(context: &Context, subject: &str, hazard: &str) -> Option<Expectation> {
    let known = context.expected.knows(subject);
    if known { context.expected.get(subject, hazard) } else { Some(Expectation::RightOrTypedError) }
}

/// The calls of each default solver over the distances of hazard F1, which are the tilts at launch.
fn tilt_work(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let atlas = context.atlas()?;
    let row = |subject: &Subject| {
        // A flight that fails has no count, and then the spread of the whole row is not a number.
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
    // Slow coins do not return to the vertical.
    let returns = |case: &&Case| case.tilt == 0.0 && case.toss.launch.turn_rate() > 1.0;
    let horizontal: Vec<Case> = context.survey()?.cases.iter().filter(returns).copied().collect();
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

fn calls(solver: &dyn Solver, toss: &CoinToss) -> Result<f64, SolveError> {
    Ok(solver.land(&(*toss).into())?.work.rhs_calls as f64)
}

/// The same flight, turned so that the angular momentum S is tilted from the vertical by half of the tilt that would
/// let n pass through the vertical or its opposite; `None` where the cone of n about S leaves too little room for that.
fn far_from_the_vertical(toss: &CoinToss) -> Option<CoinToss> {
    const ROOM: f64 = 0.3;
    let cone = CoinMotion::new(toss).cone_angle();
    let room = FRAC_PI_2 - (FRAC_PI_2 - cone).abs();
    if room < ROOM {
        return None;
    }
    let rate = toss.launch.rate();
    // The turn about n brings S over -y; the turn about x then brings S upright and beyond by half the room.
    let attitude = Attitude::about_x(0.5 * room - cone) * Attitude::about_z(-FRAC_PI_2 - rate.y.atan2(rate.x));
    let launch = Launch::new(rate, toss.launch.time_of_flight()).ok()?.with_attitude(attitude);
    Some(CoinToss { launch, ..*toss })
}
