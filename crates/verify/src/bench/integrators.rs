//! This file times integrators at the same errors. Each takes the loosest tolerance that keeps the error asked for,
//! because the same tolerance gives different errors with different schemes.

use std::rc::Rc;

use toss::{Attitude, Body, Formulation, QuaternionSolver, Scheme, SimdLevel, Solver, Stepping, TAYLOR, Toss};

use super::contest::Contest;
use super::tosses::{Columns, attitude_error};

/// Number of tosses that each integrator solves.
pub(super) const FLOWN: usize = 1024;

/// Errors of the attitude that are asked for (rad).
const ERRORS: [f64; 4] = [1e-5, 1e-8, 1e-11, 5e-14];

/// Solves all tosses and returns their attitudes at landing.
type Fly = Box<dyn Fn(&[Toss], Stepping) -> Vec<Attitude>>;

/// What is timed of coins, and of a body.
const GROUPS: [&str; 2] =
    ["attitude of a toss by integration, quaternion", "the same of a body with moments 1, 2, 2.25"];

/// Each integrator at each error: with the loosest tolerance that keeps it or, if none does, with the tolerance of its
/// smallest error.
pub(super) fn contests<'a>(columns: &Columns, body: Body) -> anyhow::Result<Vec<Contest<'a>>> {
    let mut contests = contests_of(GROUPS[0], &columns.each())?;
    contests.extend(contests_of(GROUPS[1], &columns.each_of(body))?);
    Ok(contests)
}

fn contests_of<'a>(group: &'static str, tosses: &[Toss]) -> anyhow::Result<Vec<Contest<'a>>> {
    let mut integrators: Vec<(String, Scheme, Fly)> = [Scheme::DOPRI5, Scheme::DOP853, TAYLOR]
        .map(|scheme| (format!("{}, one by one", scheme.name()), scheme, Box::new(one_by_one) as Fly))
        .into();
    for level in SimdLevel::all() {
        let fly = move |tosses: &[Toss], stepping: Stepping| {
            let solver = QuaternionSolver::new(stepping, Formulation::default());
            let landings = solver.land_all(tosses, level).into_iter();
            landings.map(|landing| landing.expect("an ordinary flight").state.attitude).collect()
        };
        integrators.push((format!("taylor, lanes, {}", level.name()), TAYLOR, Box::new(fly)));
    }
    let mut contests = Vec::new();
    for (name, scheme, fly) in integrators {
        let fly = Rc::new(fly);
        for asked in ERRORS {
            let (stepping, error) = loosest(tosses, scheme, &fly, asked)?;
            let (tosses, fly) = (tosses.to_vec(), Rc::clone(&fly));
            let run = move || drop(std::hint::black_box(fly(&tosses, stepping)));
            contests.push(Contest {
                group,
                name: format!("{name}, asked {asked:.0e}"),
                error: Some(error),
                tosses: FLOWN,
                run: Box::new(run),
            });
        }
    }
    Ok(contests)
}

/// The stepping with the loosest tolerance whose error is at most `asked`, and its error (rad); if there is none, that
/// with the smallest error.
fn loosest(tosses: &[Toss], scheme: Scheme, fly: &Fly, asked: f64) -> anyhow::Result<(Stepping, f64)> {
    const A_DECADE: i32 = 5;
    let mut best: Option<(Stepping, f64)> = None;
    for step in 3 * A_DECADE..=15 * A_DECADE {
        let stepping = Stepping::adaptive(scheme, 10f64.powf(-f64::from(step) / f64::from(A_DECADE)))?;
        let error = attitude_error(tosses, fly(tosses, stepping));
        if best.is_none_or(|(_, smallest)| error < smallest) {
            best = Some((stepping, error));
        }
        if error <= asked {
            break;
        }
    }
    anyhow::Context::context(best, "a tolerance was tried")
}

fn one_by_one(tosses: &[Toss], stepping: Stepping) -> Vec<Attitude> {
    let solver = QuaternionSolver::new(stepping, Formulation::default());
    tosses.iter().map(|toss| solver.land(toss).expect("an ordinary flight").state.attitude).collect()
}
