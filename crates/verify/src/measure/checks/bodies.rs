//! These checks compare the solvers that solve bodies which are no coins with the 256-bit reference, in the families of
//! the check `rigid-attitude`, and with published motions. Solvers that refuse such bodies have no row: what they must
//! refuse is in the atlas.

use exact::motion::COS_TILT_ERROR;
use rayon::prelude::*;

use crate::measure::any_case::AnyCase;
use crate::measure::bodies::{BodyErrors, BodyFinding, BodyFindings};
use crate::measure::check::{Basis, Check, Judges, ceiling};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::subject::Subject;

pub(super) const WITHIN_ESTIMATE: Check = Check {
    id: "bodies-within-estimate",
    claim: "On bodies of seven families, next to the separatrix and the middle axis too, with phases of 1 to 30 rad, the \
            errors of cos θ and of the attitude are at most what the solver's estimate allows. Measured: the largest \
            error divided by that; it fails above the bound, or at 1 without one. Where a solver states no estimate, it \
            decides nothing and is not judged.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: 1.0,
    unit: "1",
    measure: |context| {
        let row = |subject: &Subject, findings: &[BodyFinding]| {
            let part = |errors: &BodyErrors| {
                let allowed = errors.estimate?.max(COS_TILT_ERROR);
                Some((errors.cos_tilt / allowed).max(errors.attitude / (10.0 * allowed)))
            };
            let silent = findings.iter().filter(|one| matches!(one.errors, Ok(BodyErrors { estimate: None, .. })));
            let note = format!("{} without an estimate; ", silent.count());
            let one = |finding: &BodyFinding| match &finding.errors {
                Ok(errors) => part(errors),
                Err(_) => Some(f64::INFINITY),
            };
            largest(WITHIN_ESTIMATE.id, subject, findings, &note, one).claiming(Some(1.0))
        };
        Ok(rows(context, row))
    },
};

pub(super) const STATED: Check = Check {
    id: "bodies-stated",
    claim: "A solver that lands a body states an estimate of its error. Measured: the share of tosses without one, \
            which no other check judges; of the families of `bodies-within-estimate`.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: 0.5,
    unit: "1",
    measure: |context| {
        let row = |subject: &Subject, findings: &[BodyFinding]| {
            let silent: Vec<&BodyFinding> =
                findings.iter().filter(|one| matches!(one.errors, Ok(BodyErrors { estimate: None, .. }))).collect();
            let share = silent.len() as f64 / findings.len() as f64;
            let input = silent.first().map_or_else(String::new, |one| format!("first {}: {:?}", one.family, one.toss));
            Measurement::figure(STATED.id, &subject.name, share, findings.len() as u64, input).without_claim()
        };
        Ok(rows(context, row))
    },
};

pub(super) const ATTITUDE: Check = Check {
    id: "bodies-attitude",
    claim: "On bodies of five families, away from the separatrix and the middle axis, with phases of 1 to 30 rad, the \
            attitude at landing differs from the 256-bit reference by at most the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "rad",
    measure: |context| {
        let row = |subject: &Subject, findings: &[BodyFinding]| {
            let is_steady = |one: &BodyFinding| !["near the middle axis", "near the separatrix"].contains(&one.family);
            let error = |one: &BodyFinding| {
                let error = one.errors.as_ref().map_or(f64::INFINITY, |errors| errors.attitude);
                is_steady(one).then_some(error)
            };
            // What the estimate allows each of them is judged by the check above.
            largest(ATTITUDE.id, subject, findings, "", error).without_claim()
        };
        Ok(rows(context, row))
    },
};

pub(super) const CONSERVED: Check = Check {
    id: "bodies-conserved",
    claim: "The angular momentum S of any body, its length and the kinetic energy differ at landing from their values at \
            launch by at most the bound, relative to those of a body that turns as fast about its largest axis.",
    basis: Basis::Invariant,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "1",
    measure: |context| {
        let row = |subject: &Subject, findings: &[BodyFinding]| {
            // Next to the separatrix the attitude is off by more, and with it S in the transport frame.
            let drift = |one: &BodyFinding| match &one.errors {
                Ok(errors) => Some(errors.drift),
                Err(_) => Some(f64::INFINITY),
            };
            largest(CONSERVED.id, subject, findings, "", drift).without_claim()
        };
        Ok(rows(context, row))
    },
};

pub(super) const PUBLISHED: Check = Check {
    id: "bodies-published",
    claim: "Published motions of bodies that are no coins, of up to 100 s: the attitudes of seven flights that were \
            computed in 128 bits, two of them next to the separatrix and one on it, and the rates of NASA's check case \
            2, a tumbling brick. Measured: the largest error (rad; of rates, relative to the largest).",
    basis: Basis::PublishedFigure,
    judges: Judges::Solver,
    ceiling: ceiling::ATTITUDE,
    unit: "rad",
    measure: |context| {
        let solves = |subject: &&Subject| {
            context.data.bodies.iter().all(|body| AnyCase::Rigid(body.case).is_solved_by(&*subject.solver))
        };
        Ok(context.subjects.iter().filter(solves).map(|subject| published(context, subject)).collect())
    },
};

/// The largest error of `subject` on the published motions, with the largest ratio to what its estimate allows.
fn published(context: &Context, subject: &Subject) -> Measurement {
    let of_one = |body: &crate::measure::reference::motions::ReferenceBody| {
        let toss = &body.case.toss;
        let landing = subject.solver.land(toss).ok();
        let error = landing.as_ref().map_or(f64::INFINITY, |landing| body.error(&landing.state));
        let estimate = landing.and_then(|landing| landing.error);
        // The published digits are fifteen.
        let allowed = estimate.map_or(f64::INFINITY, |estimate| 10.0 * estimate.max(1e-15));
        let found =
            Measurement::figure(PUBLISHED.id, &subject.name, error, 1, format!("{}: {}", body.name, body.case.hex()));
        found.claiming(Some(allowed))
    };
    let cases = context.data.bodies.len() as u64;
    let all = context.data.bodies.par_iter().map(of_one).collect();
    let worst = Measurement::worst_of(all).unwrap_or_else(|| {
        Measurement::figure(PUBLISHED.id, &subject.name, f64::INFINITY, 0, "no published motions".to_owned())
    });
    Measurement { cases, ..worst }
}

/// The rows of the subjects that solve bodies.
fn rows(context: &Context, row: impl Fn(&Subject, &[BodyFinding]) -> Measurement) -> Vec<Measurement> {
    let row = |BodyFindings { subject, findings }: &BodyFindings| row(&context.subjects[*subject], findings);
    context.bodies().iter().map(row).collect()
}

/// The largest of the deviations; `None` is not judged.
fn largest(
    check: &str,
    subject: &Subject,
    findings: &[BodyFinding],
    note: &str,
    deviation: impl Fn(&BodyFinding) -> Option<f64>,
) -> Measurement {
    let judged: Vec<(f64, &BodyFinding)> =
        findings.iter().filter_map(|one| deviation(one).map(|size| (size, one))).collect();
    let worst = judged.iter().max_by(|a, b| a.0.total_cmp(&b.0));
    let (measured, input) = worst.map_or((f64::INFINITY, "nothing is judged".to_owned()), |(size, one)| {
        let failure = one.errors.as_ref().err().map(|error| format!(", {error}")).unwrap_or_default();
        (*size, format!("{note}worst {}{failure}: {:?}, {:?}", one.family, one.toss.body.tensor(), one.toss.launch))
    });
    Measurement::figure(check, &subject.name, measured, judged.len() as u64, input)
}
