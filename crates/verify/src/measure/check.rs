//! A check is a claim about the solvers or the library, the kind of evidence for it, and how it is measured. Most checks are
//! data: a deviation of one toss, the tosses on which it is taken, and how the deviations become one number. What does not
//! fit that has a function of its own.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use dynamics::Toss;
use rayon::prelude::*;
use serde::Serialize;
use toss::{CoinToss, Landing, SolveError};

use crate::measure::cases::Case;
use crate::measure::context::Context;
pub use crate::measure::measurement::Judges;
use crate::measure::measurement::{Deviation, Measurement, Worst};
use crate::measure::reference::Reference;
use crate::measure::run::Allowance;
use crate::measure::subject::Subject;
use crate::measure::survey::{Landings, Survey};
use crate::measure::tosses::tries;

/// The kind of evidence that a claim rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Basis {
    /// A closed form, evaluated in more digits.
    ClosedForm,
    /// A conserved quantity.
    Invariant,
    /// A published number.
    PublishedFigure,
    /// The agreement of different methods.
    CrossMethod,
}

impl Basis {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::ClosedForm => "closed form",
            Self::Invariant => "invariant",
            Self::PublishedFigure => "published figure",
            Self::CrossMethod => "cross-method",
        }
    }
}

/// Ceilings that several checks share. Errors as large as these are not those of a solver: a toss in a thousand would
/// land on the other side.
pub mod ceiling {
    /// An error of cos θ.
    pub const COS_TILT: f64 = 1e-3;
    /// An error of the attitude (rad), a relative drift of a conserved quantity, or an error of a time at rates of
    /// about 1 rad/s.
    pub const ATTITUDE: f64 = 1e-2;
}

/// A claim and how it is measured.
#[derive(Debug)]
pub struct Check {
    /// Unique short name; the key of its limits.
    pub id: &'static str,
    /// What is measured, against what, and when it fails, in plain sentences for the report.
    pub claim: &'static str,
    /// The kind of evidence.
    pub basis: Basis,
    /// What its rows judge. A [`Measurement`] may say otherwise for its own row.
    pub judges: Judges,
    /// The largest limit that a table of limits may give, in the check's unit. It follows from what the check means,
    /// not from what was measured: what deviates more is no solver, or a proof that proves nothing.
    pub ceiling: f64,
    /// Unit of the measured value; "1" for a pure number.
    pub unit: &'static str,
    /// How it is measured; one measurement for each row of the report.
    pub measure: Measure,
}

/// How a check is measured.
#[derive(Debug, Clone, Copy)]
pub enum Measure {
    /// Deviations of what the library says of tosses, in sets of them, one for each row.
    Tosses(fn() -> Vec<Set>, Fold),
    /// Deviations of the landings of a survey, of every subject.
    Landings {
        /// The survey.
        of: fn(&Context) -> anyhow::Result<&Survey>,
        /// The deviation.
        deviation: OfLanding,
        /// What is allowed without a limit.
        allowed: Allowed,
    },
    /// Both of these, one after the other.
    Both(&'static [Measure; 2]),
    /// What no deviation of a single toss is.
    Own(fn(&Context) -> anyhow::Result<Vec<Measurement>>),
}

/// How the deviations of a set become what is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fold {
    /// The largest.
    Largest,
    /// The number of tosses with any.
    Count,
    /// The mean.
    Mean,
    /// The median.
    Median,
}

/// A named set of cases, and a deviation that is taken on each of them.
pub struct Set {
    subject: String,
    of_coins: bool,
    cases: Cases,
    deviation: OfToss,
}

/// Makes the cases of a set.
type Cases = Box<dyn Fn(&Context) -> anyhow::Result<Vec<Case>> + Sync>;

/// A deviation of a toss.
type OfToss = Box<dyn Fn(&Toss, &Reference) -> Deviation + Sync>;

impl Set {
    /// The cases that `cases` makes, in the row of `subject`.
    pub(super) fn of_cases(
        subject: impl Into<String>,
        cases: impl Fn(&Context) -> anyhow::Result<Vec<Case>> + Sync + 'static,
        deviation: impl Fn(&Toss, &Reference) -> Deviation + Sync + 'static,
    ) -> Self {
        Self { subject: subject.into(), of_coins: false, cases: Box::new(cases), deviation: Box::new(deviation) }
    }

    /// The tosses of any bodies that `tosses` makes, in the row of `subject`.
    pub(super) fn new(
        subject: impl Into<String>,
        tosses: impl Fn(&Context) -> anyhow::Result<Vec<Toss>> + Sync + 'static,
        deviation: impl Fn(&Toss, &Reference) -> Deviation + Sync + 'static,
    ) -> Self {
        let case = |toss| Case { toss, reference: None };
        Self::of_cases(subject, move |context| Ok(tosses(context)?.into_iter().map(case).collect()), deviation)
    }

    /// The tosses of coins that `tosses` makes, on which alone the deviation is taken.
    pub(super) fn of_coins(
        subject: &str,
        tosses: impl Fn(&Context) -> anyhow::Result<Vec<Toss>> + Sync + 'static,
        deviation: impl Fn(&CoinToss, &Reference) -> Deviation + Sync + 'static,
    ) -> Self {
        let of_coin = move |toss: &Toss, reference: &Reference| {
            deviation(&toss.of_coin("the measure", "it is taken on coins alone")?, reference)
        };
        Self { of_coins: true, ..Self::new(subject, tosses, of_coin) }
    }

    /// The tosses of coins that `tosses` makes of a [number](tries).
    pub(super) fn of_tries(
        subject: &str,
        tosses: impl Fn(u64) -> anyhow::Result<Vec<CoinToss>> + Sync + 'static,
        deviation: impl Fn(&CoinToss, &Reference) -> Deviation + Sync + 'static,
    ) -> Self {
        let all = move |context: &Context| Ok(tosses(tries(context.effort))?.into_iter().map(Toss::from).collect());
        Self::of_coins(subject, all, deviation)
    }

    fn measured(&self, fold: Fold, cases: &[Case]) -> Measurement {
        let name = &*self.subject;
        let deviation = |case: &Case| {
            let reference = case.reference.clone().or_else(|| Reference::of(&case.toss).ok().map(Arc::new))?;
            Some((case.toss, guarded(|| (self.deviation)(&case.toss, &reference))))
        };
        let (tosses, found): (Vec<Toss>, Vec<Deviation>) = cases.par_iter().filter_map(deviation).unzip();
        let worst = |index: usize, failure| Worst::of_library(&tosses[index], failure);
        let mut sizes: Vec<f64> = found.iter().map(|found| found.clone().unwrap_or(f64::INFINITY)).collect();
        let figure = |measured: f64, input| Measurement::figure(name, measured, found.len() as u64, input);
        let measured = match fold {
            Fold::Largest => Measurement::without_estimate(name, &found, worst),
            Fold::Count => Measurement::count(name, &found, worst),
            Fold::Mean => {
                let largest = sizes.iter().copied().fold(0.0, f64::max);
                figure(sizes.iter().sum::<f64>() / sizes.len() as f64, format!("largest error {largest:.3e}"))
            }
            Fold::Median => {
                sizes.sort_by(f64::total_cmp);
                let at = |part: usize| sizes.get(sizes.len() * part / 100).copied().unwrap_or(f64::NAN);
                figure(at(50), format!("95 % are below {:.0}", at(95)))
            }
        };
        measured.of_the_library().beside_unjudged(cases.len() - found.len())
    }
}

/// What `measure` finds, or an error if it panics, so that a fault of the library is a row that fails and not the end of
/// the run.
pub(super) fn guarded(measure: impl FnOnce() -> Deviation) -> Deviation {
    catch_unwind(AssertUnwindSafe(measure)).unwrap_or_else(|payload| {
        let text = payload.downcast_ref::<String>().cloned();
        let text = text.or_else(|| payload.downcast_ref::<&str>().map(|text| (*text).to_owned()));
        let text = text.unwrap_or_else(|| "without a message".to_owned());
        Err(SolveError::failed("the library", std::io::Error::other(format!("it panicked: {text}"))))
    })
}

/// A landing beside the exact one.
#[derive(Clone, Copy)]
pub struct Landed<'a> {
    /// The toss.
    pub toss: &'a Toss,
    /// Its family; empty if there are none.
    pub family: &'static str,
    /// The exact landing.
    pub exact: &'a Reference,
    /// The landing.
    pub landing: &'a Landing,
}

/// A deviation of a landing; `None` if it is not judged.
pub type OfLanding = fn(&Landed<'_>) -> Option<f64>;

/// What is allowed a solver that has no limit.
#[derive(Debug, Clone, Copy)]
pub enum Allowed {
    /// A part of what its estimate allows.
    By(fn(&Allowance) -> f64),
    /// This.
    UpTo(f64),
    /// Nothing is judged without a limit.
    NotJudged,
}

/// The largest deviation of `subject`, which has these `landings`; `None` of a solver for coins among bodies.
pub(super) fn of_landings(
    survey: &Survey,
    (subject, landings): (&Subject, &Landings),
    deviation: OfLanding,
    allowed: Allowed,
) -> Option<Measurement> {
    if landings.is_empty() {
        return None;
    }
    let family = |index: usize| survey.families.get(index).copied().unwrap_or_default();
    let judged = landings.iter().enumerate().filter_map(|(index, landing)| {
        let (toss, exact) = (&survey.tosses[index], survey.exact[index].as_ref()?);
        match landing {
            Ok(landing) => Some((index, Ok(deviation(&Landed { toss, family: family(index), exact, landing })?))),
            Err(error) => Some((index, Err(error.clone()))),
        }
    });
    let (indices, deviations): (Vec<usize>, Vec<Deviation>) = judged.unzip();
    let toss = |index: usize| survey.tosses[indices[index]];
    let found = Measurement::largest(subject, &deviations, toss, |index| match allowed {
        Allowed::By(part) => Ok(survey.allowance(subject, landings, indices[index])?.as_ref().map(part)),
        Allowed::UpTo(most) => Ok(Some(most)),
        Allowed::NotJudged => Ok(None),
    });
    let found = found.beside_unjudged(survey.exact.iter().filter(|exact| exact.is_none()).count());
    Some(if matches!(allowed, Allowed::NotJudged) { found.without_claim() } else { found })
}

impl Check {
    /// What most checks of solvers have in common.
    pub(crate) const OF_SOLVERS: Self = Self {
        id: "",
        claim: "",
        basis: Basis::ClosedForm,
        judges: Judges::Solver,
        ceiling: 0.0,
        unit: "1",
        measure: Measure::Own(|_| Ok(Vec::new())),
    };

    /// What most checks of the library have in common.
    pub(super) const OF_LIBRARY: Self = Self { judges: Judges::Library, ..Self::OF_SOLVERS };

    /// Measures every row.
    ///
    /// # Errors
    /// If what is measured can't be made.
    pub fn measure(&self, context: &Context) -> anyhow::Result<Vec<Measurement>> {
        self.measured(self.measure, context)
    }

    fn measured(&self, measure: Measure, context: &Context) -> anyhow::Result<Vec<Measurement>> {
        let rows: Vec<Measurement> = match measure {
            Measure::Own(measure) => return measure(context),
            Measure::Both([one, other]) => {
                return Ok([self.measured(*one, context)?, self.measured(*other, context)?].concat());
            }
            Measure::Tosses(sets, fold) => {
                let row = |set: Set| anyhow::Ok(set.measured(fold, &(set.cases)(context)?));
                sets().into_iter().map(row).collect::<anyhow::Result<_>>()?
            }
            Measure::Landings { of, deviation, allowed } => {
                let survey = of(context)?;
                let each = context.subjects.par_iter().zip(&survey.landings);
                each.filter_map(|by| of_landings(survey, by, deviation, allowed)).collect()
            }
        };
        Ok(rows.into_iter().map(|row| self.repeating(row)).collect())
    }

    /// The same measurement, whose worst case is repeated by this check's measure.
    fn repeating(&self, measurement: Measurement) -> Measurement {
        let row = format!("{} / {}", self.id, measurement.subject);
        measurement.with_worst(|worst| Worst { replay: worst.replay.map(|toss| toss.in_row(row.clone())), ..worst })
    }

    /// What the rows that `is_asked` for by their subjects measure on one toss. Rows that are no deviations of single tosses,
    /// or not of such a body, have none.
    ///
    /// # Errors
    /// If there is no reference of the toss.
    pub fn again(
        &self,
        context: &Context,
        toss: &Toss,
        is_asked: &dyn Fn(&str) -> bool,
    ) -> anyhow::Result<Vec<Measurement>> {
        self.again_by(self.measure, context, toss, is_asked)
    }

    fn again_by(
        &self,
        measure: Measure,
        context: &Context,
        toss: &Toss,
        is_asked: &dyn Fn(&str) -> bool,
    ) -> anyhow::Result<Vec<Measurement>> {
        Ok(match measure {
            Measure::Own(_) => Vec::new(),
            Measure::Both([one, other]) => {
                let [one, other] = [one, other].map(|part| self.again_by(*part, context, toss, is_asked));
                [one?, other?].concat()
            }
            Measure::Tosses(sets, fold) => {
                let is_solved = Reference::of(toss).is_ok();
                let takes = |set: &Set| is_solved && (!set.of_coins || toss.coin().is_some());
                let sets = sets().into_iter().filter(|set| is_asked(&set.subject) && takes(set));
                let case = Case { toss: *toss, reference: None };
                sets.map(|set| self.repeating(set.measured(fold, std::slice::from_ref(&case)))).collect()
            }
            Measure::Landings { deviation, allowed, .. } => {
                let subjects = context.subjects.iter().filter(|subject| is_asked(&subject.name));
                let again = |subject: &Subject| {
                    let landings = vec![subject.solver.land(toss)];
                    let survey = Survey {
                        tosses: vec![*toss],
                        families: Vec::new(),
                        exact: vec![Some(Arc::new(Reference::of(toss)?))],
                        landings: Vec::new(),
                    };
                    anyhow::Ok(of_landings(&survey, (subject, &landings), deviation, allowed))
                };
                subjects.filter_map(|subject| again(subject).transpose()).collect::<anyhow::Result<_>>()?
            }
        })
    }
}
