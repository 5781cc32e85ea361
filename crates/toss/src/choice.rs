//! The result of planning a scene: the chosen model with its expected error and cost, and why the others were passed
//! over. A plan can be read, checked and reported before anything is computed.

use std::fmt;

use dynamics::{Scheme, SolverEntry, StepControl, Stepping};
use exact::ExactSolver;
use kinematics_quat::QuaternionSolver;

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
    /// The launches of a sample.
    pub points: Option<u64>,
}

/// How a model is to be used.
#[derive(Debug, Clone)]
pub enum How {
    /// The model has no settings.
    ClosedForm,
    /// This integrator with this scheme and tolerance.
    Integrator(SolverEntry, Stepping),
    /// The quaternion with this scheme and tolerance, which proves that no error is larger than the expected one.
    Proof(Stepping),
    /// The launches that are tried.
    Sampling(sampling::Plan),
}

impl Choice {
    /// Name of the solver.
    pub fn solver(&self) -> &str {
        match &self.how {
            How::Integrator(entry, _) => entry.name(),
            How::Proof(_) => QuaternionSolver::NAME,
            How::ClosedForm | How::Sampling(_) => ExactSolver::NAME,
        }
    }

    fn stepping(&self) -> Option<Stepping> {
        match self.how {
            How::Integrator(_, stepping) | How::Proof(stepping) => Some(stepping),
            How::ClosedForm | How::Sampling(_) => None,
        }
    }

    /// Name of the scheme of an integrator.
    pub fn scheme(&self) -> Option<&'static str> {
        self.stepping().map(|stepping| stepping.scheme().name())
    }

    /// The tolerance of an integrator.
    pub fn tolerance(&self) -> Option<f64> {
        match self.stepping()?.control() {
            StepControl::Tolerance(tolerance) => Some(tolerance),
            StepControl::Step(_) => None,
        }
    }

    /// Name of the method by which a sample chooses its launches.
    pub fn method(&self) -> Option<&'static str> {
        if let How::Sampling(plan) = self.how { Some(plan.method().name()) } else { None }
    }

    /// Whether no error is larger than the expected one.
    pub fn is_certified(&self) -> bool {
        matches!(self.how, How::Proof(_) | How::Sampling(sampling::Plan::Enclosure { .. }))
    }
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

#[cfg(feature = "serde")]
impl serde::Serialize for Decision {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        #[derive(serde::Serialize)]
        struct PassedOver {
            model: String,
            why: String,
        }
        let passed_over = self.passed_over.iter();
        let passed_over = passed_over.map(|(other, why)| PassedOver { model: other.to_string(), why: why.to_string() });
        let (choice, mut fields) = (&self.choice, to.serialize_struct("Decision", 10)?);
        fields.serialize_field("model", choice.model.name)?;
        fields.serialize_field("solver", choice.solver())?;
        fields.serialize_field("scheme", &choice.scheme())?;
        fields.serialize_field("method", &choice.method())?;
        fields.serialize_field("tolerance", &choice.tolerance())?;
        fields.serialize_field("points", &choice.points)?;
        fields.serialize_field("expected_error", &choice.expected_error)?;
        fields.serialize_field("certified", &choice.is_certified())?;
        fields.serialize_field("expected_cost_ns", &choice.expected_cost_ns)?;
        fields.serialize_field("passed_over", &passed_over.collect::<Vec<_>>())?;
        fields.end()
    }
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
