//! The paper's own way: Euler angles and the γ-ODE in the vertical frame, from exactly horizontal, where both are
//! singular, to just before n first comes back.

use std::f64::consts::TAU;

use rayon::prelude::*;
use toss::{ExactMotion, Formulation, Launch, TimeOfFlight, Toss};

use crate::measure::case::Case;
use crate::measure::check::{Basis, Check};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::reference::Reference;
use crate::measure::run::Allowance;
use crate::measure::subject::{Subject, tight};

pub(super) const ATTITUDE: Check = Check {
    id: "vertical-frame-to-first-return",
    claim: "in the paper's vertical frame, from sin β = 0 at launch to 0.1 rad before the first return: the exact attitude",
    basis: Basis::ClosedForm,
    unit: "rad",
    measure,
};

/// Distance to the return, in phase (rad).
const DISTANCE: f64 = 0.1;

/// The vertical frame's solvers divide by sin β: spin and cone keep this distance (rad) from the flights on which
/// n stays near the vertical (ψ = 0) or turns end over end (ψ = π/2).
const CLEARANCE: f64 = 0.1;

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let cases = returning_flights(context)?;
    let references: Vec<Reference> = cases.par_iter().map(|case| Reference::new(&case.toss)).collect();
    let mut measurements = Vec::new();
    for entry in context.registry.iter().filter(|entry| entry.formulations().contains(&Formulation::VERTICAL)) {
        for scheme in entry.schemes().iter().filter(|scheme| scheme.is_adaptive()) {
            let subject = Subject::new(entry, Some(tight(*scheme)?), Formulation::VERTICAL);
            let deviation = |(case, reference): (&Case, &Reference)| {
                let landing = subject.solver.propagate(&case.toss)?;
                Ok(reference.attitude_error(&landing.state.attitude))
            };
            let deviations: Vec<_> = cases.par_iter().zip(&references).map(deviation).collect();
            let allowed = |allowance: &Allowance| allowance.attitude;
            measurements.push(Measurement::largest(&subject, deviations, |index| cases[index], allowed));
        }
    }
    Ok(measurements)
}

/// The horizontal launches of the survey, each cut short before its first return.
fn returning_flights(context: &Context) -> anyhow::Result<Vec<Case>> {
    let mut cases = Vec::new();
    for case in context.survey()?.cases.iter().filter(|case| case.tilt == 0.0) {
        let motion = ExactMotion::new(&case.toss);
        let cone = motion.cone_angle();
        let from_right_angle = (cone - TAU / 4.0).abs();
        if from_right_angle < CLEARANCE || TAU / 4.0 - from_right_angle < CLEARANCE {
            continue;
        }
        let time = TimeOfFlight::Given((TAU - DISTANCE) / motion.precession_rate());
        let toss = Toss { launch: Launch::new(case.toss.launch.rate(), time)?, ..case.toss };
        cases.push(Case { toss, ..*case });
    }
    Ok(cases)
}
