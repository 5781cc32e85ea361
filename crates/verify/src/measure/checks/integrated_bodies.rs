//! The parts of the checks of integrated proofs that fly bodies with I1 ≠ I2, in families each of which is hard for a
//! method of its own. Next to a turn about the middle axis some flights have no bound; they are no cases.

use dynamics::Toss;
use rayon::prelude::*;
use toss::{ExactSolver, IntegratedCertificate, Outcome, QuaternionSolver, SolveError, Solver, Stepping};

use super::enclosed::{bounds_of, errors};
use super::judged;
use super::rigid::at_an_edge;
use crate::measure::bodies::{FAMILIES, FLOWN, Family, launches};
use crate::measure::measurement::Measurement;
use crate::measure::reference::rigid::RigidReference;
use crate::measure::subject::taylor;

/// The tolerances of the flights, one after the other.
const TOLERANCES: [f64; 4] = [Stepping::DEFAULT_TOLERANCE, 1e-4, 1e-7, f64::EPSILON];

fn subject(family: &Family) -> String {
    format!("bodies: {}", family.name)
}

/// The largest error of cos θ or of the attitude, divided by its bound, in each family.
pub(super) fn bounds(check: &str, number: u64) -> anyhow::Result<Vec<Measurement>> {
    let of = |tolerance| Ok((taylor(tolerance)?, tolerance));
    let solvers: Vec<_> = TOLERANCES.into_iter().map(of).collect::<Result<_, SolveError>>()?;
    Ok(FAMILIES.iter().map(|family| bounds_of_family(check, "bodies", family, &solvers, number)).collect())
}

/// The largest error of cos θ or of the attitude in a family, divided by its bound, by solvers in turn, each with its
/// tolerance. `what` names the rows.
pub(super) fn bounds_of_family(
    check: &str,
    what: &str,
    family: &Family,
    solvers: &[(QuaternionSolver, f64)],
    number: u64,
) -> Measurement {
    let tosses: Vec<Toss> = launches(family, number, FLOWN).collect();
    let fly = |(index, toss): (usize, &Toss)| solvers[index % solvers.len()].0.enclose(toss).ok();
    let found: Vec<_> = tosses.par_iter().enumerate().map(fly).collect();
    let is_bounded = |found: &&IntegratedCertificate| found.error_bound() < 2.0;
    let found: Vec<_> = found.iter().map(|found| found.as_ref().filter(is_bounded)).collect();
    let quick = |index: usize, toss: &Toss| {
        let Some(found) = found[index] else { return Some(0.0) };
        let exact = ExactSolver.land(toss).ok()?;
        judged::by_exact_motion(errors(found, &exact), bounds_of(found))
    };
    let thorough = |index: usize, toss: &Toss| {
        let (Some(found), Some(reference)) = (found[index], RigidReference::new(toss)) else { return Ok(0.0) };
        let of_attitude = 0.5 * reference.attitude_error(&found.landing().state.attitude);
        let of_cos_tilt = reference.cos_tilt_error(found.cos_tilt()) / found.error_bound();
        Ok(of_cos_tilt.max(of_attitude / found.attitude_error_bound()))
    };
    let shares: Vec<Option<f64>> = judged::shares(&tosses, quick, thorough)
        .into_iter()
        .zip(&found)
        .map(|(share, found)| share.ok().filter(|_| found.is_some()))
        .collect();
    let bounded = shares.iter().flatten().count();
    let worst = (0..shares.len()).max_by(|a, b| shares[*a].unwrap_or(0.0).total_cmp(&shares[*b].unwrap_or(0.0)));
    let (measured, input) = worst.map_or((f64::INFINITY, String::new()), |index| {
        let tolerance = solvers[index % solvers.len()].1;
        (shares[index].unwrap_or(f64::INFINITY), format!("{:?} at {tolerance:e}", tosses[index]))
    });
    let input = format!("{bounded} of {} have a bound; {input}", tosses.len());
    Measurement::figure(check, &format!("{what}: {}", family.name), measured, bounded as u64, input)
}

/// The numbers of outcomes that are proven and wrong, of launches and of times within 3 ulp of an edge.
pub(super) fn outcomes(check: &str, number: u64) -> anyhow::Result<Vec<Measurement>> {
    let solver = taylor(Stepping::DEFAULT_TOLERANCE)?;
    let measure = |family: &Family| {
        let each = launches(family, number, FLOWN).flat_map(|toss| [Some(toss), at_an_edge(&toss)]);
        let tosses: Vec<Toss> = each.flatten().collect();
        let is_wrong = |toss: &Toss| {
            let found = solver.certify(toss).map_or(Outcome::Undecided, |found| found.outcome());
            found != Outcome::Undecided && Some(found) != outcome(toss)
        };
        let wrong: Vec<bool> = tosses.par_iter().map(is_wrong).collect();
        let first = wrong.iter().position(|wrong| *wrong).map(|index| format!("{:?}", tosses[index]));
        let number = wrong.iter().filter(|wrong| **wrong).count() as f64;
        Measurement::figure(check, &subject(family), number, tosses.len() as u64, first.unwrap_or_default())
    };
    Ok(FAMILIES.iter().map(measure).collect())
}

/// The outcome by the exact motion where cos θ is far from 0, else by the reference.
fn outcome(toss: &Toss) -> Option<Outcome> {
    match ExactSolver.tilt(toss).map(|tilt| tilt.cos_tilt) {
        Ok(cos_tilt) if cos_tilt.abs() > 1e3 * judged::EXACT => Some(Outcome::of(cos_tilt, 0.0)),
        _ => RigidReference::new(toss).map(|reference| reference.outcome()),
    }
}
