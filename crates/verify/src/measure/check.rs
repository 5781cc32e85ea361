//! A check is a claim about the solvers, the kind of evidence for it, and a function that measures it for every
//! subject. All checks have this one type, so that they are run, judged and reported by the same code.

use serde::Serialize;

use crate::measure::context::Context;
pub use crate::measure::measurement::Judges;
use crate::measure::measurement::Measurement;

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
    /// Unique short name; the key of its bounds.
    pub id: &'static str,
    /// What is measured, against what, and when it fails, in plain sentences for the report.
    pub claim: &'static str,
    /// The kind of evidence.
    pub basis: Basis,
    /// What its rows judge. A [`Measurement`] may say otherwise for its own row.
    pub judges: Judges,
    /// The largest bound that a table of bounds may give, in the check's unit. It follows from what the check means,
    /// not from what was measured: what deviates more is no solver, or a proof that proves nothing.
    pub ceiling: f64,
    /// Unit of the measured value; "1" for a pure number.
    pub unit: &'static str,
    /// Measures every subject; one measurement for each row of the report.
    pub measure: fn(&Context) -> anyhow::Result<Vec<Measurement>>,
}
