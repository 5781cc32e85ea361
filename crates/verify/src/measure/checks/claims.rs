//! This check compares what solvers claim with what they reach. Other checks judge a solver without bounds by its own
//! error estimate, so that a solver which claims enough would be right everywhere.

use dynamics::phase::RoughPhases;
use toss::{Landing, SolveError};

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;
use crate::measure::subject::Subject;
use crate::measure::survey::Survey;

pub(super) const MEASURED: Check = Check {
    id: "claims-measured",
    claim: "A solver claims no errors that are far larger than its own. Measured: on random launches, the median of its \
            error estimates divided by its largest error of the attitude, which is never smaller than that of cos θ, \
            or by four roundings of the phase if they are larger; horizontal and tilted launches apart. It fails above \
            the bound, or at a thousand without one.",
    basis: Basis::ClosedForm,
    judges: Judges::Solver,
    ceiling: LARGEST_RATIO,
    unit: "1",
    measure,
};

/// The largest ratio that is no fault. Error estimates hold for every launch, also those near the places where a method
/// fails, so that those of honest solvers are a few hundred times too large for most launches.
const LARGEST_RATIO: f64 = 1000.0;

/// |ω| (rad/s) below which launches are left out: whatever a solver claims for a coin that hardly turns, its error is
/// rounding.
const SLOW: f64 = 1.0;

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let survey = context.survey()?;
    let (horizontal, tilted): (Vec<usize>, Vec<usize>) =
        (0..survey.cases.len()).partition(|index| survey.cases[*index].tilt == 0.0);
    let row = |(subject, landings): (&Subject, &Landings)| {
        let classes = [("horizontal", &horizontal), ("tilted", &tilted)];
        Measurement::worst_of(classes.map(|(name, class)| of_class(survey, subject, landings, name, class)).into())
    };
    Ok(context.subjects.iter().zip(&survey.landings).filter_map(row).collect())
}

/// What a solver answered to each launch of the survey.
type Landings = Vec<Result<Landing, SolveError>>;

/// The ratio of `subject` over the launches of one class.
fn of_class(survey: &Survey, subject: &Subject, landings: &Landings, name: &str, class: &[usize]) -> Measurement {
    let (mut claims, mut phases, mut largest) = (Vec::new(), Vec::new(), 0.0_f64);
    for &index in class {
        let toss = &survey.cases[index].toss;
        // Launches that fail are counted by other checks.
        let Ok(landing) = &landings[index] else { continue };
        if toss.launch.turn_rate() < SLOW {
            continue;
        }
        largest = largest.max(survey.references[index].attitude_error(&landing.state.attitude));
        let Some(claim) = landing.error else {
            return figure(subject, f64::NAN, 0, "it claims no error".to_owned()).claiming(None);
        };
        match RoughPhases::new(toss).largest() {
            Ok(phase) => {
                claims.push(claim);
                phases.push(phase);
            }
            Err(error) => return figure(subject, f64::NAN, 0, error.to_string()).claiming(Some(0.0)),
        }
    }
    let (number, claim, phase) = (claims.len() as u64, median(&mut claims), median(&mut phases));
    let rounding = 4.0 * f64::EPSILON * (1.0 + phase);
    let input = format!("{name} launches: claims {claim:.1e} in the median, largest error {largest:.1e} rad");
    figure(subject, claim / largest.max(rounding), number, input).claiming(Some(LARGEST_RATIO))
}

fn figure(subject: &Subject, ratio: f64, cases: u64, input: String) -> Measurement {
    Measurement::figure(MEASURED.id, &subject.name, ratio, cases, input)
}

/// The median; not a number if there are none.
fn median(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers.get(numbers.len() / 2).copied().unwrap_or(f64::NAN)
}
