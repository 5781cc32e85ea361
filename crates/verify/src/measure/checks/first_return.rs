//! This check solves horizontal launches as the paper does: Euler angles and the γ-ODE in the vertical frame, from
//! launch to just before the coin's normal n first returns to the vertical. The default solvers use another frame; in
//! this one both systems are singular at launch, sin β = 0, and must leave it with the right attitude.

use std::f64::consts::TAU;

use rayon::prelude::*;
use toss::{CoinMotion, CoinToss, Formulation, Launch, TimeOfFlight};

use crate::measure::case::Case;
use crate::measure::check::{Basis, Check, Judges, ceiling};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::reference::Reference;
use crate::measure::run::Allowance;
use crate::measure::subject::{Subject, tight};

pub(super) const ATTITUDE: Check = Check {
    id: "vertical-frame-to-first-return",
    claim: "In the paper's vertical frame, from sin β = 0 at launch to 0.1 rad of phase before the first return \
            there, the attitude differs from the 256-bit reference by at most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "rad",
    measure,
};

/// Phase (rad) before the first return at which each flight ends.
const DISTANCE: f64 = 0.1;

/// Distance (rad) that the cone angle ψ keeps from 0 and π, where n stays near the vertical, and from π/2, where the
/// coin turns end over end. The vertical frame's solvers divide by sin β, and such flights come too near to sin β = 0.
const CLEARANCE: f64 = 0.1;

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let cases = returning_flights(context)?;
    let references: Vec<Reference> = cases.par_iter().map(|case| Reference::new(&case.toss)).collect();
    let mut measurements = Vec::new();
    for entry in context.registry.iter().filter(|entry| entry.formulations().contains(&Formulation::VERTICAL)) {
        for scheme in entry.schemes().iter().filter(|scheme| scheme.is_adaptive()) {
            let subject = Subject::new(entry, Some(tight(*scheme)?), Formulation::VERTICAL);
            let deviation = |(case, reference): (&Case, &Reference)| {
                let landing = subject.solver.land(&case.toss.into())?;
                Ok(reference.attitude_error(&landing.state.attitude))
            };
            let deviations: Vec<_> = cases.par_iter().zip(&references).map(deviation).collect();
            let allowed = |allowance: &Allowance| allowance.attitude;
            measurements.push(Measurement::largest(&subject, deviations, |index| cases[index], allowed));
        }
    }
    Ok(measurements)
}

/// The horizontal launches of the survey, each ending just before its first return.
fn returning_flights(context: &Context) -> anyhow::Result<Vec<Case>> {
    let mut cases = Vec::new();
    for case in context.survey()?.cases.iter().filter(|case| case.tilt == 0.0) {
        let motion = CoinMotion::new(&case.toss);
        let cone = motion.cone_angle();
        let from_right_angle = (cone - TAU / 4.0).abs();
        if from_right_angle < CLEARANCE || TAU / 4.0 - from_right_angle < CLEARANCE {
            continue;
        }
        let time = TimeOfFlight::Given((TAU - DISTANCE) / motion.precession_rate());
        let toss = CoinToss { launch: Launch::new(case.toss.launch.rate(), time)?, ..case.toss };
        cases.push(Case { toss, ..*case });
    }
    Ok(cases)
}
