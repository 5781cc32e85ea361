//! What a plan says: the choice with the error and the cost to expect of it, and why others were passed over.

use std::fmt;

use dynamics::{Method, Scheme, SolverEntry};

use crate::model::Model;

/// A model with its settings, and what to expect of it.
#[derive(Debug, Clone, Copy)]
pub struct Choice {
    /// The model.
    pub model: Model,
    /// Its settings.
    pub how: How,
    /// Its error, as the record has it; 0 for an outcome, which is right or undecided.
    pub expected_error: f64,
    /// Its cost on one core of the machine of the record (ns).
    pub expected_cost_ns: f64,
}

/// How a model is to be used.
#[derive(Debug, Clone, Copy)]
pub enum How {
    /// It has no settings.
    ClosedForm,
    /// By an integrator with this method and tolerance.
    Integrator(&'static SolverEntry, Method),
    /// With these launches.
    Sampling(sampling::Plan),
}

/// Why a model is passed over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reason {
    /// It answers another question.
    GivesOnly(&'static str),
    /// The motion can show both faces within the flight.
    NotCertain,
    /// ωz ≠ 0, or not launched flat, or numbers beyond its range.
    NotKellers,
    /// cos θ is too near 0 for it.
    OnEdge,
    /// Its error is larger than what is wanted.
    TooRough {
        /// The error.
        expected_error: f64,
    },
    /// An integrator was asked for by name.
    NotAskedFor,
    /// It serves, but costs more.
    Dearer {
        /// Its cost (ns).
        expected_cost_ns: f64,
    },
    /// The speed is fixed.
    SpeedIsFixed,
    /// More than the speed is free.
    MoreIsFree,
    /// It tells no error.
    TellsNoError,
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::GivesOnly(what) => write!(f, "gives only {what}"),
            Self::NotCertain => f.write_str("the motion shows both faces, and the flight may be long enough for it"),
            Self::NotKellers => f.write_str("needs ωz = 0 and a launch from horizontal"),
            Self::OnEdge => f.write_str("cos θ is too near 0 to be sure of its sign"),
            Self::TooRough { expected_error } => write!(f, "its expected error is {expected_error:.1e}"),
            Self::NotAskedFor => f.write_str("an integrator was asked for"),
            Self::Dearer { expected_cost_ns } => write!(f, "serves, but takes {}", Nanoseconds(*expected_cost_ns)),
            Self::SpeedIsFixed => f.write_str("needs a range of speeds"),
            Self::MoreIsFree => f.write_str("more than the speed is free"),
            Self::TellsNoError => f.write_str("tells no error"),
        }
    }
}

/// A time (ns), written with the unit that suits it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nanoseconds(pub f64);

impl fmt::Display for Nanoseconds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            ns if ns < 1e3 => write!(f, "{ns:.0} ns"),
            ns if ns < 1e6 => write!(f, "{:.1} µs", ns / 1e3),
            ns if ns < 1e9 => write!(f, "{:.1} ms", ns / 1e6),
            ns => write!(f, "{:.1} s", ns / 1e9),
        }
    }
}

/// What a rung has to offer to a scene, or why it has nothing.
pub type Offer = Result<Choice, Reason>;

/// The chosen model, and why others were not.
#[derive(Debug, Clone)]
pub struct Decision {
    /// The choice.
    pub choice: Choice,
    /// Every cheaper model, and every other way of the chosen kind, with the reason.
    pub passed_over: Vec<(Candidate, Reason)>,
}

/// What was asked: a model, and the solver and method if it is an integrator.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Candidate {
    /// The model.
    pub model: Model,
    /// The integrator's solver and method.
    pub integrator: Option<(&'static str, Scheme)>,
}

impl From<Model> for Candidate {
    fn from(model: Model) -> Self {
        Self { model, integrator: None }
    }
}

impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.integrator {
            None => f.write_str(self.model.name()),
            Some((solver, scheme)) => write!(f, "{solver}/{}", scheme.name()),
        }
    }
}
