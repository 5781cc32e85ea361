//! A run is one toss solved by one subject (a solver with its settings), with its errors against the 256-bit reference.
//! The atlas, the sweep of tolerances, the search by adversarial launches and the records are all made of runs, so that
//! they judge an answer by the same rule.

use dynamics::Toss;
use exact::motion::COS_TILT_ERROR;
use serde::{Deserialize, Serialize};
use toss::{Landing, Outcome, SolveError};

use super::reference::Reference;
use super::subject::Subject;
use super::{case, drift};
use crate::shown::shown;

/// How good an answer is, from the best to the worst.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Answer {
    /// Within the [allowance](Allowance), and no wrong outcome.
    Right,
    /// No answer, but an error that says why.
    #[default]
    TypedError,
    /// An answer of a solver without a usable error estimate, and no wrong outcome.
    Unclaimed,
    /// An answer outside the allowance, or the wrong outcome, without an error.
    SilentlyWrong,
}

impl Answer {
    /// Its name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::TypedError => "typed error",
            Self::Unclaimed => "no usable claim",
            Self::SilentlyWrong => "silently wrong",
        }
    }
}

/// The largest error of cos θ that a solver may claim at tight settings. Any answer at all is within 2.
pub const LARGEST_CLAIM: f64 = 1e-2;

/// The errors that the solver's own error estimate allows an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allowance {
    /// Error of cos θ: the error estimate, or the rounding error of the exact motion if the estimate is smaller.
    pub cos_tilt: f64,
    /// Error of the attitude (rad), and relative errors of conserved quantities: ten times the error of cos θ.
    pub attitude: f64,
}

impl Allowance {
    /// The errors that are allowed `subject` on `toss`, where its error estimate is `estimate`; `None` if it has none, or one
    /// above [`LARGEST_CLAIM`] at [tight](Subject::is_tight) settings, which says nothing.
    pub fn new(subject: &Subject, toss: &Toss, estimate: Option<f64>) -> Option<Self> {
        let is_usable = |estimate: &f64| *estimate <= LARGEST_CLAIM || !subject.is_tight(toss);
        estimate.filter(is_usable).map(Self::by_estimate)
    }

    /// As [`Allowance::new`], by a flight of its own.
    pub fn of(subject: &Subject, toss: &Toss) -> Result<Option<Self>, SolveError> {
        Ok(Self::new(subject, toss, subject.solver.tilt(toss)?.error))
    }

    /// The errors that an error estimate allows.
    pub(crate) fn by_estimate(estimate: f64) -> Self {
        let cos_tilt = estimate.max(COS_TILT_ERROR);
        Self { cos_tilt, attitude: 10.0 * cos_tilt }
    }
}

/// A solved toss, compared with the 256-bit reference.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Run {
    /// The subject's name.
    pub subject: String,
    /// The toss, as text.
    pub inputs: String,
    /// How good the answer is.
    pub answer: Answer,
    /// The error that the solver returned.
    pub failure: Option<String>,
    /// Whether it returned that error because it solves coins alone.
    #[serde(skip)]
    pub is_for_coins: bool,
    /// Whether it returned that error because the toss turns too far for any answer to mean something.
    #[serde(skip)]
    pub is_too_far: bool,
    /// Error of cos θ at landing.
    pub err_cos_tilt: Option<f64>,
    /// Angle to the exact attitude at landing (rad).
    pub err_attitude: Option<f64>,
    /// The attitude's error, divided by what the solver's error estimate allows.
    pub err_by_allowance: Option<f64>,
    /// The error of cos θ or of the attitude, whichever is larger as a part of what the solver's error estimate allows it.
    #[serde(skip)]
    pub part: Option<f64>,
    /// Relative drift of the angular momentum S in the transport frame; null also for a coin at rest.
    pub err_invariants: Option<f64>,
    /// Whether the outcome is the exact one; null if it was left undecided.
    pub outcome_ok: Option<bool>,
    /// Norm error of an integrated quaternion.
    pub norm_error: Option<f64>,
    /// Evaluations of the right-hand side.
    pub rhs_calls: Option<u64>,
    /// Steps that the step control accepted.
    pub accepted_steps: Option<u64>,
    /// Steps that the step control rejected.
    pub rejected_steps: Option<u64>,
}

impl Run {
    /// Solves `toss` with `subject` and compares the answer with the exact one.
    pub fn new(subject: &Subject, toss: &Toss, exact: &Reference) -> Self {
        let failed = Self { subject: subject.name.clone(), inputs: case::text(toss), ..Self::default() };
        match subject.solver.land(toss) {
            Ok(landing) => failed.answered(&landing, toss, exact, Allowance::new(subject, toss, landing.error)),
            Err(error) => {
                let is_for_coins = matches!(error, SolveError::NotSymmetric { .. });
                let is_too_far = matches!(error, SolveError::PhaseTooLarge { .. });
                Self { failure: Some(shown(&error.to_string())), is_for_coins, is_too_far, ..failed }
            }
        }
    }

    /// Whether the toss was answered as it should be: right, or by an error that says why it can't be answered.
    pub(crate) fn passes(&self) -> bool {
        match self.answer {
            Answer::Right => true,
            Answer::TypedError => self.is_for_coins || self.is_too_far,
            Answer::Unclaimed | Answer::SilentlyWrong => false,
        }
    }

    /// The errors in words, with what they are of what is allowed, or the error that the solver returned.
    pub(crate) fn words(&self) -> String {
        let number = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), |value| format!("{value:.1e}"));
        let (cos_tilt, attitude) = (number(self.err_cos_tilt), number(self.err_attitude));
        let of_allowed = match (self.answer, self.part) {
            (Answer::SilentlyWrong, Some(part)) if part > 1.0 => format!(", {part:.1e} times what its estimate allows"),
            (Answer::Unclaimed, _) => format!(", and it claims no error, or one above {LARGEST_CLAIM:e}"),
            _ => String::new(),
        };
        format!("cos θ off by {cos_tilt:>7}, attitude by {attitude:>7} rad{of_allowed}")
    }

    fn answered(self, landing: &Landing, toss: &Toss, exact: &Reference, allowance: Option<Allowance>) -> Self {
        let outcome = landing.outcome();
        let outcome_ok = (outcome != Outcome::Undecided).then(|| outcome == exact.outcome());
        let cos_tilt = exact.cos_tilt_error(landing.cos_tilt);
        let attitude = exact.attitude_error(&landing.state.attitude);
        let within = |allowance: Allowance| cos_tilt <= allowance.cos_tilt && attitude <= allowance.attitude;
        let answer = match allowance.map(within) {
            _ if outcome_ok == Some(false) => Answer::SilentlyWrong,
            Some(true) => Answer::Right,
            Some(false) => Answer::SilentlyWrong,
            None => Answer::Unclaimed,
        };
        let part = allowance.map(|allowed| (cos_tilt / allowed.cos_tilt).max(attitude / allowed.attitude));
        Self {
            answer,
            err_cos_tilt: Some(cos_tilt),
            err_attitude: Some(attitude),
            err_by_allowance: allowance.map(|allowance| attitude / allowance.attitude),
            part,
            err_invariants: Some(drift::momentum_vector(toss, &landing.state)).filter(|drift| drift.is_finite()),
            outcome_ok,
            norm_error: Some(landing.norm_error),
            rhs_calls: Some(landing.work.rhs_calls),
            accepted_steps: Some(landing.work.accepted_steps),
            rejected_steps: Some(landing.work.rejected_steps),
            ..self
        }
    }
}
