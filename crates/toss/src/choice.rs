//! What a plan says: the choice with the error and the cost to expect of it, and why others were passed over.

use std::fmt;

use dynamics::{Scheme, SolverEntry, Stepping};

use crate::model::Model;
use crate::reason::Reason;

/// A model with its settings, and what to expect of it.
#[derive(Debug, Clone)]
pub struct Choice {
    /// The model.
    pub model: &'static Model,
    /// Its settings.
    pub how: How,
    /// Its error, as the record has it; 0 for an outcome, which is right or undecided.
    pub expected_error: f64,
    /// Its cost on one core of the machine of the record (ns).
    pub expected_cost_ns: f64,
}

/// How a model is to be used.
#[derive(Debug, Clone)]
pub enum How {
    /// It has no settings.
    ClosedForm,
    /// By an integrator that steps so.
    Integrator(SolverEntry, Stepping),
    /// With these launches.
    Sampling(sampling::Plan),
}

/// What a model has to offer to a scene, or why it has nothing.
pub type Offer = Result<Choice, Reason>;

/// The chosen model, and why others were not.
#[derive(Debug, Clone)]
pub struct Decision {
    /// The choice.
    pub choice: Choice,
    /// Every cheaper model, and every other way of the chosen kind, with the reason.
    pub passed_over: Vec<(Candidate, Reason)>,
}

/// A model that was considered, and the solver and scheme if it is an integrator.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Candidate {
    /// The model.
    pub model: &'static Model,
    /// The integrator's solver and scheme.
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
