//! A run: one toss flown by one subject and judged against the exact motion. Records are made of these.

use serde::{Deserialize, Serialize};
use toss::exact::COS_TILT_ERROR;
use toss::{Outcome, Propagation, SolveError, Toss};

use crate::case::Case;
use crate::drift;
use crate::reference::Reference;
use crate::subject::Subject;

/// What an answer is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Answer {
    /// Within the [allowance](Allowance), and no wrong outcome.
    Right,
    /// No answer but an error that says why.
    TypedError,
    /// An answer outside the allowance, or the wrong outcome, without an error.
    SilentlyWrong,
}

impl Answer {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::TypedError => "typed error",
            Self::SilentlyWrong => "silently wrong",
        }
    }
}

/// The errors that an answer may have and still be right.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allowance {
    /// Of cos θ: what the solver answers for.
    pub cos_tilt: f64,
    /// Of the attitude (rad): ten times that.
    pub attitude: f64,
}

impl Allowance {
    /// What `subject` may be off by on `toss`.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    pub fn new(subject: &Subject, toss: &Toss) -> Result<Self, SolveError> {
        let cos_tilt = subject.solver.resolution(toss)?.max(COS_TILT_ERROR);
        Ok(Self { cos_tilt, attitude: 10.0 * cos_tilt })
    }
}

/// A toss flown and judged.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Run {
    /// The subject's name.
    pub subject: String,
    /// The toss, as hex floats.
    pub inputs: String,
    /// What the answer is worth.
    pub answer: Answer,
    /// The error that was returned.
    pub failure: Option<String>,
    /// |Δ cos θ| at landing.
    pub err_cos_tilt: Option<f64>,
    /// Angle to the exact attitude at landing (rad).
    pub err_attitude: Option<f64>,
    /// The attitude's error in parts of what the solver answers for.
    pub err_by_allowance: Option<f64>,
    /// Drift of S in TF, relative; null also for a coin at rest.
    pub err_invariants: Option<f64>,
    /// Whether the outcome is the exact one; null where none was stated.
    pub outcome_ok: Option<bool>,
    /// Loss of norm of an integrated quaternion.
    pub defect: Option<f64>,
    /// Evaluations of the right-hand side.
    pub rhs_calls: Option<u64>,
    /// Steps that were kept.
    pub accepted_steps: Option<u64>,
    /// Steps that were thrown away.
    pub rejected_steps: Option<u64>,
}

impl Run {
    /// Flies `case` by `subject`.
    pub fn new(subject: &Subject, case: &Case, reference: &Reference) -> Self {
        match Judged::new(subject, &case.toss, reference) {
            Ok(judged) => judged.run(subject, case),
            Err(error) => Self {
                subject: subject.name.clone(),
                inputs: case.hex(),
                answer: Answer::TypedError,
                failure: Some(error.to_string()),
                err_cos_tilt: None,
                err_attitude: None,
                err_by_allowance: None,
                err_invariants: None,
                outcome_ok: None,
                defect: None,
                rhs_calls: None,
                accepted_steps: None,
                rejected_steps: None,
            },
        }
    }
}

/// An answer beside the exact one.
struct Judged {
    landing: Propagation,
    err_cos_tilt: f64,
    err_attitude: f64,
    outcome_ok: Option<bool>,
    allowance: Allowance,
}

impl Judged {
    fn new(subject: &Subject, toss: &Toss, reference: &Reference) -> Result<Self, SolveError> {
        let landing = subject.solver.propagate(toss)?;
        let outcome = subject.solver.verdict_at(toss, landing.cos_tilt)?.outcome;
        Ok(Self {
            err_cos_tilt: reference.cos_tilt_error(landing.cos_tilt),
            err_attitude: reference.attitude_error(&landing.state.attitude),
            outcome_ok: (outcome != Outcome::Undecided).then(|| outcome == reference.outcome()),
            allowance: Allowance::new(subject, toss)?,
            landing,
        })
    }

    fn is_right(&self) -> bool {
        self.err_cos_tilt <= self.allowance.cos_tilt
            && self.err_attitude <= self.allowance.attitude
            && self.outcome_ok != Some(false)
    }

    fn run(&self, subject: &Subject, case: &Case) -> Run {
        Run {
            subject: subject.name.clone(),
            inputs: case.hex(),
            answer: if self.is_right() { Answer::Right } else { Answer::SilentlyWrong },
            failure: None,
            err_cos_tilt: Some(self.err_cos_tilt),
            err_attitude: Some(self.err_attitude),
            err_by_allowance: Some(self.err_attitude / self.allowance.attitude),
            err_invariants: Some(drift::momentum_vector(&case.toss, &self.landing.state))
                .filter(|drift| drift.is_finite()),
            outcome_ok: self.outcome_ok,
            defect: Some(self.landing.defect),
            rhs_calls: Some(self.landing.work.rhs_calls),
            accepted_steps: Some(self.landing.work.accepted_steps),
            rejected_steps: Some(self.landing.work.rejected_steps),
        }
    }
}
