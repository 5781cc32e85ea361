//! A run is one toss solved by one subject (a solver with its settings), with its errors against the 256-bit reference.
//! The atlas, the sweep of tolerances, the search by adversarial launches and the records are all made of runs, so that
//! they judge an answer by the same rule.

use dynamics::Toss;
use exact::motion::COS_TILT_ERROR;
use serde::{Deserialize, Serialize};
use toss::{CoinToss, Landing, Outcome, SolveError};

use super::any_case::{AnyCase, AnyReference};
use super::case::Case;
use super::drift;
use super::reference::Reference;
use super::subject::Subject;

/// How good an answer is, from the best to the worst.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Answer {
    /// Within the [allowance](Allowance), and no wrong outcome.
    Right,
    /// No answer, but an error that says why.
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
    ///
    /// # Errors
    /// As [`Solver::tilt`](toss::Solver::tilt).
    pub fn of(subject: &Subject, toss: impl Into<Toss>) -> Result<Option<Self>, SolveError> {
        let toss = toss.into();
        Ok(Self::new(subject, &toss, subject.solver.tilt(&toss)?.error))
    }

    /// The errors that an error estimate allows.
    pub(super) fn by_estimate(estimate: f64) -> Self {
        let cos_tilt = estimate.max(COS_TILT_ERROR);
        Self { cos_tilt, attitude: 10.0 * cos_tilt }
    }
}

/// A solved toss, compared with the 256-bit reference.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Run {
    /// The subject's name.
    pub subject: String,
    /// The toss, as hex floats.
    pub inputs: String,
    /// How good the answer is.
    pub answer: Answer,
    /// The error that the solver returned.
    pub failure: Option<String>,
    /// Error of cos θ at landing.
    pub err_cos_tilt: Option<f64>,
    /// Angle to the exact attitude at landing (rad).
    pub err_attitude: Option<f64>,
    /// The attitude's error, divided by what the solver's error estimate allows.
    pub err_by_allowance: Option<f64>,
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
    /// Solves `case` with `subject` and compares the answer with `reference`.
    pub fn new(subject: &Subject, case: &Case, reference: &Reference) -> Self {
        Self::of_compared(subject, case.hex(), Compared::new(subject, &case.toss, reference))
    }

    /// Solves a `case` of any body with `subject` and compares the answer with `reference`.
    pub fn of_any(subject: &Subject, case: &AnyCase, reference: &AnyReference) -> Self {
        match (case, reference) {
            (AnyCase::Coin(case), AnyReference::Coin(reference)) => Self::new(subject, case, reference),
            (AnyCase::Coin(case), _) => Self::new(subject, case, &Reference::new(&case.toss)),
            (AnyCase::Rigid(case), _) => {
                Self::of_compared(subject, case.hex(), Compared::rigid(subject, &case.toss, reference))
            }
        }
    }

    fn of_compared(subject: &Subject, inputs: String, compared: Result<Compared, SolveError>) -> Self {
        match compared {
            Ok(compared) => compared.run(subject, inputs),
            Err(error) => Self {
                subject: subject.name.clone(),
                inputs,
                answer: Answer::TypedError,
                failure: Some(error.to_string()),
                err_cos_tilt: None,
                err_attitude: None,
                err_by_allowance: None,
                err_invariants: None,
                outcome_ok: None,
                norm_error: None,
                rhs_calls: None,
                accepted_steps: None,
                rejected_steps: None,
            },
        }
    }
}

/// An answer with its errors.
struct Compared {
    landing: Landing,
    err_cos_tilt: f64,
    err_attitude: f64,
    err_invariants: f64,
    outcome_ok: Option<bool>,
    allowance: Option<Allowance>,
}

impl Compared {
    fn new(subject: &Subject, toss: &CoinToss, reference: &Reference) -> Result<Self, SolveError> {
        let landing = subject.solver.land(&(*toss).into())?;
        let outcome = landing.outcome();
        Ok(Self {
            err_cos_tilt: reference.cos_tilt_error(landing.cos_tilt),
            err_attitude: reference.attitude_error(&landing.state.attitude),
            err_invariants: drift::momentum_vector(toss, &landing.state),
            outcome_ok: (outcome != Outcome::Undecided).then(|| outcome == reference.outcome()),
            allowance: Allowance::new(subject, &(*toss).into(), landing.error),
            landing,
        })
    }

    fn rigid(subject: &Subject, toss: &Toss, reference: &AnyReference) -> Result<Self, SolveError> {
        let landing = subject.solver.land(toss)?;
        let outcome = landing.outcome();
        let [.., vector] = drift::of_rigid(toss, &landing.state);
        Ok(Self {
            err_cos_tilt: reference.cos_tilt_error(landing.cos_tilt),
            err_attitude: reference.attitude_error(&landing.state.attitude),
            err_invariants: vector,
            outcome_ok: (outcome != Outcome::Undecided).then(|| outcome == reference.outcome()),
            allowance: Allowance::new(subject, toss, landing.error),
            landing,
        })
    }

    fn answer(&self) -> Answer {
        let within =
            |allowance: Allowance| self.err_cos_tilt <= allowance.cos_tilt && self.err_attitude <= allowance.attitude;
        match self.allowance.map(within) {
            _ if self.outcome_ok == Some(false) => Answer::SilentlyWrong,
            Some(true) => Answer::Right,
            Some(false) => Answer::SilentlyWrong,
            None => Answer::Unclaimed,
        }
    }

    fn run(&self, subject: &Subject, inputs: String) -> Run {
        Run {
            subject: subject.name.clone(),
            inputs,
            answer: self.answer(),
            failure: None,
            err_cos_tilt: Some(self.err_cos_tilt),
            err_attitude: Some(self.err_attitude),
            err_by_allowance: self.allowance.map(|allowance| self.err_attitude / allowance.attitude),
            err_invariants: Some(self.err_invariants).filter(|drift| drift.is_finite()),
            outcome_ok: self.outcome_ok,
            norm_error: Some(self.landing.norm_error),
            rhs_calls: Some(self.landing.work.rhs_calls),
            accepted_steps: Some(self.landing.work.accepted_steps),
            rejected_steps: Some(self.landing.work.rejected_steps),
        }
    }
}
