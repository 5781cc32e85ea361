//! The parts of the checks of integrated proofs that fly by Runge-Kutta schemes, whose steps are compared with series.

use rayon::prelude::*;
use toss::{Formulation, QuaternionSolver, Scheme, SolveError, StepControl, Stepping, Toss};

use super::enclosed::{distance, require_short, share};
use super::integrated_bodies::bounds_of_family;
use crate::measure::bodies::FAMILIES;
use crate::measure::case::Case;
use crate::measure::hard_cases::{adversarial, few_turns, random};
use crate::measure::measurement::{Deviation, Measurement};
use crate::measure::reference::Reference;

/// The sets of launches whose bounds are measured, each with the scheme and the step control of its flights.
pub(super) const SETS: [(&str, Scheme, StepControl); 5] = [
    ("dop853, phases to 1e2", Scheme::DOP853, StepControl::Tolerance(Stepping::DEFAULT_TOLERANCE)),
    ("dopri5, phases to 1e2, tolerance 1e-6", Scheme::DOPRI5, StepControl::Tolerance(1e-6)),
    ("rk4, phases to 1e2, steps of 1 ms", Scheme::RK4, StepControl::Step(1e-3)),
    ("dop853, phases to 6e4, tolerance 1e-9", Scheme::DOP853, StepControl::Tolerance(1e-9)),
    ("dop853, adversarial, tolerance 1e-12", Scheme::DOP853, StepControl::Tolerance(1e-12)),
];

/// The flights whose bounds are compared with their errors.
const TIGHTNESS: [(&str, Scheme, f64); 4] = [
    ("dop853, phases to 1e3, tolerance 1e-9", Scheme::DOP853, 1e-9),
    ("dop853, phases to 1e3, tolerance 1e-12", Scheme::DOP853, 1e-12),
    ("dopri5, phases to 1e3, tolerance 1e-9", Scheme::DOPRI5, 1e-9),
    ("dopri5, phases to 1e3, tolerance 1e-12", Scheme::DOPRI5, 1e-12),
];

fn solver(scheme: Scheme, control: StepControl) -> Result<QuaternionSolver, SolveError> {
    let stepping = Stepping::new(scheme, Some(control));
    let stepping = stepping.map_err(|error| SolveError::failed(QuaternionSolver::NAME, error))?;
    Ok(QuaternionSolver::new(stepping, Formulation::default()))
}

/// The share of the bound that an error takes, by the scheme of the set with this number.
pub(super) fn share_of_set<const SET: usize>(toss: &Toss, _: &Reference) -> Deviation {
    require_short(toss)?;
    let (_, scheme, control) = SETS[SET];
    share(&solver(scheme, control)?, toss)
}

/// The largest share of a bound that an error takes, of coins and of each family of bodies.
pub(super) fn bounds(check: &str, number: u64) -> anyhow::Result<Vec<Measurement>> {
    let cases = [
        random(number, 1e2, 41)?,
        random(number, 1e2, 42)?,
        random(number / 10, 1e2, 43)?,
        random(number / 400, 6e4, 44)?,
        adversarial(number / 4, few_turns)?,
    ];
    let measure = |((name, scheme, control), cases): ((&'static str, Scheme, StepControl), Vec<Case>)| {
        let solver = solver(scheme, control)?;
        let shares: Vec<_> = cases.par_iter().map(|case| share(&solver, &case.toss)).collect();
        Ok(Measurement::of_set(name, &shares, |index| cases[index]))
    };
    let coins: anyhow::Result<Vec<Measurement>> = SETS.into_iter().zip(cases).map(measure).collect();
    let steppings = [(Scheme::DOP853, 1e-10), (Scheme::DOPRI5, 1e-7), (Scheme::DOP853, 1e-6)];
    let of = |(scheme, tolerance)| -> Result<_, SolveError> {
        Ok((solver(scheme, StepControl::Tolerance(tolerance))?, tolerance))
    };
    let solvers: Vec<_> = steppings.into_iter().map(of).collect::<Result<_, _>>()?;
    let of_family = |family| bounds_of_family(check, "dop853 and dopri5, bodies", family, &solvers, number / 20);
    Ok(coins?.into_iter().chain(FAMILIES.iter().map(of_family)).collect())
}

/// The numbers of outcomes that differ from the reference, proven first by loose steps.
pub(super) fn outcomes(number: u64) -> anyhow::Result<Vec<Measurement>> {
    let solver = solver(Scheme::DOPRI5, StepControl::Tolerance(1e-6))?;
    let sets = [
        ("dopri5, random", random(number / 4, 1e2, 45)?),
        ("dopri5, adversarial", adversarial(number / 16, few_turns)?),
    ];
    let measure = |(name, cases): (&str, Vec<Case>)| {
        let differs = |case: &Case| -> Result<bool, SolveError> {
            Ok(solver.certify(&case.toss)?.outcome() != Reference::new(&case.toss).outcome())
        };
        let differs: Vec<_> = cases.par_iter().map(differs).collect();
        Measurement::count_of_set(name, &differs, |index| cases[index])
    };
    Ok(sets.into_iter().map(measure).collect())
}

/// The medians of the bound of the attitude divided by its error.
pub(super) fn tightness(check: &str, number: u64) -> anyhow::Result<Vec<Measurement>> {
    let measure = |(name, scheme, tolerance)| {
        let (solver, cases) = (solver(scheme, StepControl::Tolerance(tolerance))?, random(number, 1e3, 46)?);
        let ratio = |case: &Case| -> Deviation {
            let found = solver.enclose(&case.toss)?;
            Ok(found.attitude_error_bound() / distance(&found, &Reference::new(&case.toss)))
        };
        let ratios: Result<Vec<f64>, _> = cases.par_iter().map(ratio).collect();
        let mut ratios = ratios?;
        ratios.sort_by(f64::total_cmp);
        let largest = ratios[ratios.len() * 95 / 100];
        let median = ratios[ratios.len() / 2];
        Ok(Measurement::figure(check, name, median, number, format!("95 % are below {largest:.0}")))
    };
    TIGHTNESS.into_iter().map(measure).collect()
}
