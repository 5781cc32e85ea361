//! The result of planning a scene: the chosen model with its expected error and cost, and why the others were passed
//! over. A plan can be read, checked and reported before anything is computed.

use std::fmt;

use dynamics::{Scheme, SolverEntry, Stepping};

use crate::model::Model;
use crate::reason::Reason;

/// A model with its settings, its expected error and its expected cost.
#[derive(Debug, Clone)]
pub struct Choice {
    /// The model.
    pub model: &'static Model,
    /// The settings of the model.
    pub how: How,
    /// The error to expect: of cos θ, of the attitude (rad) or of the probability. That of an integrator is the error of its
    /// flight. It is 0 for an outcome, which is either right or undecided.
    pub expected_error: f64,
    /// The cost to expect (ns), on one core of the machine on which costs were measured.
    pub expected_cost_ns: f64,
}

/// How a model is to be used.
#[derive(Debug, Clone)]
pub enum How {
    /// The model has no settings.
    ClosedForm,
    /// This integrator with this scheme and tolerance.
    Integrator(SolverEntry, Stepping),
    /// The launches that are tried.
    Sampling(sampling::Plan),
}

/// How a model would answer a scene, or the reason why it cannot.
pub type Offer = Result<Choice, Reason>;

/// The chosen model, and why each of the others was passed over.
#[derive(Debug, Clone)]
pub struct Decision {
    /// The choice.
    pub choice: Choice,
    /// The models that were considered and not taken, each with the reason. Where models are tried in the order of
    /// their cost, those after the choice are not considered.
    pub passed_over: Vec<(Candidate, Reason)>,
}

/// A model that was considered; for an integrator also its solver and scheme.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Candidate {
    /// The model.
    pub model: &'static Model,
    /// Name of the solver and its scheme; `None` for a model that is no integrator.
    pub integrator: Option<(String, Scheme)>,
}

impl From<&'static Model> for Candidate {
    fn from(model: &'static Model) -> Self {
        Self { model, integrator: None }
    }
}

impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.integrator {
            None => f.write_str(self.model.name),
            Some((solver, scheme)) => write!(f, "{solver}/{}", scheme.name()),
        }
    }
}
