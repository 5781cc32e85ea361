//! A check is a claim about the solvers or the library, the kind of evidence for it, and how it is measured. Most checks are
//! data: a deviation of one toss, the tosses on which it is taken, and how the deviations become one number. What does not
//! fit that has a function of its own.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

use dynamics::Toss;
use rayon::prelude::*;
use serde::Serialize;
use toss::{CoinToss, Landing, SolveError};

use crate::measure::context::Context;
use crate::measure::families::Family;
use crate::measure::reference::{self, Reference};
use crate::measure::run::Allowance;
use crate::measure::subject::Subject;
use crate::measure::survey::{Landings, Survey};
use crate::measure::tosses::tries;
use crate::measure::trial::{Deviation, Measurement, Trial, Worst};
pub use crate::measure::trial::{Fold, Judges};

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
#[derive(Debug, Clone, Copy)]
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
    /// These, one after the other.
    Both(&'static [Measure; 2]),
    /// What no deviation of a single toss is.
    Own(fn(&Context) -> anyhow::Result<Vec<Measurement>>),
}

/// A named set of tosses, and a deviation that is taken on each of them.
pub struct Set {
    subject: String,
    of_coins: bool,
    tosses: Tosses,
    deviation: OfToss,
}

type Tosses = Box<dyn Fn(&Context) -> anyhow::Result<Vec<Toss>> + Sync>;

type OfToss = Box<dyn Fn(&Toss, &Reference) -> Deviation + Sync>;

impl Set {
    /// The tosses of any bodies that `tosses` makes, in the row of `subject`.
    pub(super) fn new(
        subject: impl Into<String>,
        tosses: impl Fn(&Context) -> anyhow::Result<Vec<Toss>> + Sync + 'static,
        deviation: impl Fn(&Toss, &Reference) -> Deviation + Sync + 'static,
    ) -> Self {
        Self { subject: subject.into(), of_coins: false, tosses: Box::new(tosses), deviation: Box::new(deviation) }
    }

    /// A set for each of `families`, in the row of its name, of the tosses that `tosses` makes of it.
    pub(super) fn of_families(
        families: &'static [Family],
        tosses: fn(&'static Family, &Context) -> Vec<Toss>,
        deviation: impl Fn(&Toss, &Reference) -> Deviation + Copy + Sync + 'static,
    ) -> Vec<Self> {
        let set =
            |family: &'static Family| Self::new(family.name, move |context| Ok(tosses(family, context)), deviation);
        families.iter().map(set).collect()
    }

    /// The same set, whose deviation is taken on coins alone.
    pub(super) fn of_coins(self) -> Self {
        Self { of_coins: true, ..self }
    }

    /// The tosses of coins that `tosses` makes of a [number](tries).
    pub(super) fn of_tries(
        subject: &str,
        tosses: impl Fn(u64) -> anyhow::Result<Vec<Toss>> + Sync + 'static,
        deviation: impl Fn(&Toss, &Reference) -> Deviation + Sync + 'static,
    ) -> Self {
        Self::new(subject, move |context: &Context| tosses(tries(context.effort)), deviation).of_coins()
    }

    fn measured(&self, fold: Fold, tosses: &[Toss], context: &Context) -> Measurement {
        let tried = |toss: &Toss| {
            let exact = context.exact.of(toss)?;
            Some(Trial::of_library(toss, guarded(|| (self.deviation)(toss, &exact))))
        };
        let trials: Vec<Trial<'_>> = tosses.par_iter().filter_map(tried).collect();
        fold.of(&self.subject, &trials).of_the_library().beside_unjudged(tosses.len() - trials.len())
    }
}

/// The toss of a coin, for a deviation that is taken on coins alone.
pub(super) fn coin(toss: &Toss) -> Result<CoinToss, SolveError> {
    toss.of_coin("the measure", "it is taken on coins alone")
}

/// What `measure` finds, or an error if it panics, so that a fault of the library is a row that fails and not the end of
/// the run.
pub(super) fn guarded(measure: impl FnOnce() -> Deviation) -> Deviation {
    catch_unwind(AssertUnwindSafe(measure)).unwrap_or_else(|payload| {
        let text = message(&*payload);
        Err(SolveError::failed("the library", std::io::Error::other(format!("it panicked: {text}"))))
    })
}

/// The message of a panic.
pub(crate) fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<&str>().copied();
    text.or_else(|| panic.downcast_ref::<String>().map(String::as_str)).unwrap_or("without a message")
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

impl Allowed {
    /// What is allowed `subject` on `toss`, where its error estimate is `estimate`.
    fn of(self, subject: &Subject, toss: &Toss, estimate: Option<f64>) -> Option<f64> {
        match self {
            Self::By(part) => Allowance::new(subject, toss, estimate).as_ref().map(part),
            Self::UpTo(most) => Some(most),
            Self::NotJudged => None,
        }
    }
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
    let trial = |(index, landing): (usize, &Result<Landing, SolveError>)| {
        let (toss, exact) = (&survey.tosses[index], survey.exact[index].as_ref()?);
        let family = survey.families.get(index).copied().unwrap_or_default();
        let of = |landing: &Landing| Some((deviation(&Landed { toss, family, exact, landing })?, landing.error));
        let found = landing.as_ref().map(of).map_err(Clone::clone).transpose()?;
        Some(Trial::by(subject, toss, found.map(|(size, estimate)| (size, allowed.of(subject, toss, estimate)))))
    };
    let trials: Vec<Trial<'_>> = landings.iter().enumerate().filter_map(trial).collect();
    let unjudged = survey.exact.iter().filter(|exact| exact.is_none()).count();
    let found = Fold::Largest.of(&subject.name, &trials).beside_unjudged(unjudged);
    Some(if matches!(allowed, Allowed::NotJudged) { found.without_claim() } else { found })
}

impl Check {
    /// A check of solvers by a closed form in more digits, under which nothing may deviate.
    pub const fn of_solvers(id: &'static str, measure: Measure) -> Self {
        let (basis, judges) = (Basis::ClosedForm, Judges::Solver);
        Self { id, claim: "", basis, judges, ceiling: 0.0, unit: "1", measure }
    }

    /// The same of the library.
    pub const fn of_library(id: &'static str, measure: Measure) -> Self {
        Self { judges: Judges::Library, ..Self::of_solvers(id, measure) }
    }

    /// The same check with this claim.
    #[must_use]
    pub const fn claims(self, claim: &'static str) -> Self {
        Self { claim, ..self }
    }

    /// The same check, of which no table of limits allows more than `ceiling`, in this unit.
    #[must_use]
    pub const fn up_to(self, ceiling: f64, unit: &'static str) -> Self {
        Self { ceiling, unit, ..self }
    }

    /// The same check on another basis.
    #[must_use]
    pub const fn by(self, basis: Basis) -> Self {
        Self { basis, ..self }
    }

    /// Measures every row.
    pub fn measure(&self, context: &Context) -> anyhow::Result<Vec<Measurement>> {
        self.rows(self.measure, context, None)
    }

    /// What the rows that `is_asked` for by their subjects measure on one toss. Rows that are no deviations of single tosses,
    /// or not of such a body, have none.
    pub fn again(
        &self,
        context: &Context,
        toss: &Toss,
        is_asked: &dyn Fn(&str) -> bool,
    ) -> anyhow::Result<Vec<Measurement>> {
        reference::of(toss)?;
        self.rows(self.measure, context, Some((toss, is_asked)))
    }

    /// The rows of all tosses or, of those asked for, of `one` toss.
    fn rows(&self, measure: Measure, context: &Context, one: Option<One<'_>>) -> anyhow::Result<Vec<Measurement>> {
        let rows: Vec<Measurement> = match measure {
            Measure::Own(measure) => return if one.is_none() { measure(context) } else { Ok(Vec::new()) },
            Measure::Both(parts) => {
                let parts = parts.iter().map(|part| self.rows(*part, context, one));
                return Ok(parts.collect::<anyhow::Result<Vec<_>>>()?.concat());
            }
            Measure::Tosses(sets, fold) => {
                let row = |set: &Set| {
                    let tosses = match one {
                        None => (set.tosses)(context)?,
                        Some((toss, is_asked)) if is_asked(&set.subject) && takes(set, toss) => vec![*toss],
                        Some(_) => return Ok(None),
                    };
                    anyhow::Ok(Some(set.measured(fold, &tosses, context)))
                };
                sets().iter().filter_map(|set| row(set).transpose()).collect::<anyhow::Result<_>>()?
            }
            Measure::Landings { of, deviation, allowed } => {
                let again = one.map(|(toss, is_asked)| Survey::of_one(context, toss, is_asked));
                let survey = again.as_ref().map_or_else(|| of(context), Ok)?;
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
}

type One<'a> = (&'a Toss, &'a dyn Fn(&str) -> bool);

/// Whether the deviation of `set` is one of such a body.
fn takes(set: &Set, toss: &Toss) -> bool {
    !set.of_coins || toss.coin().is_some()
}
