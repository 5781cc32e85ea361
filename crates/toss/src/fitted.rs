//! The table of measured errors and costs by which the planner chooses a model. The planner has to predict both before
//! it runs a model, so they are measured beforehand and stored with the crate.
//!
//! The table is `data/fitted.toml`. `cargo xtask verify --bless` measures it anew. Costs are those of one core of the
//! machine that ran it. Errors are the largest that were met, times a factor of safety.
//!
//! Integrators are tabulated by two numbers that describe a flight of duration T: its phase (the angle by which the
//! motion turns) and the ratio of spin to precession |q|/ωL. Here ωL is the rate of the precession about the angular
//! momentum, q = (k - 1) ωz the rate at which the transverse body rate turns in the body frame, and k = I3/I1.

mod parse;

use std::sync::LazyLock;

use dynamics::{RoughPhases, SolveError, Toss};
use serde::{Deserialize, Serialize};

/// The table that this library was built with.
///
/// # Panics
/// Never: a test makes sure that the file can be read.
pub static FITTED: LazyLock<Fitted> =
    LazyLock::new(|| toml::from_str(include_str!("../data/fitted.toml")).expect("a test reads it"));

/// Errors and costs of all models.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Fitted {
    /// The day and the machine on which it was measured.
    pub measured: String,
    /// The models in closed form, which take no steps and no samples; none in a table of integrators from elsewhere.
    #[serde(default)]
    pub closed: Vec<ClosedFit>,
    /// Upper ends of the bins of |q|/ωL, the ratio of spin to precession, for integrators. The last bin has no end.
    pub spins: Vec<f64>,
    /// Upper ends of the bins of the phase (rad), for integrators.
    pub phases: Vec<f64>,
    /// Tolerances of the integrators, from coarse to fine.
    pub tolerances: Vec<f64>,
    /// The integrators, an entry for each scheme.
    pub integrators: Vec<IntegratorFit>,
    /// The models that sample a space; none in a table of integrators from elsewhere.
    #[serde(default)]
    pub sampling: Vec<SamplingFit>,
}

/// A model in closed form.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClosedFit {
    /// The model's name.
    pub model: String,
    /// Cost (ns); for a trace, the cost of each point.
    pub cost_ns: f64,
    /// Largest error at any phase: of cos θ, of the attitude (rad) or of a probability.
    pub error: f64,
}

/// A solver with one of its schemes. Its tables are indexed by the bin of |q|/ωL, the bin of the phase, and the
/// tolerance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct IntegratorFit {
    /// The solver's name in the registry.
    pub solver: String,
    /// The scheme's name.
    pub scheme: String,
    /// Cost of a flight (ns), without its calls of the right-hand side.
    pub cost_ns: f64,
    /// Cost of a call of the right-hand side (ns), with everything whose cost grows with the number of calls.
    pub call_ns: f64,
    /// Error of cos θ for a phase at the upper end of the bin.
    pub tilt_errors: Vec<Vec<Vec<f64>>>,
    /// Error of the attitude (rad) for a phase at the upper end of the bin.
    pub errors: Vec<Vec<Vec<f64>>>,
    /// Mean number of calls of the right-hand side, divided by 1 + phase.
    pub calls: Vec<Vec<Vec<f64>>>,
}

/// A model that samples a space. Its error after N launches is `error` × N^-`power`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SamplingFit {
    /// The model's name.
    pub model: String,
    /// Cost of an estimate (ns), without its launches.
    pub cost_ns: f64,
    /// Cost of a launch (ns).
    pub launch_ns: f64,
    /// The factor of the error: what the error would be with a single launch.
    pub error: f64,
    /// The exponent with which the error falls as N grows.
    pub power: f64,
}

/// How far a flight turns, and how: the place of a toss in the tables of the integrators.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turn {
    /// The larger of ωL T and |q| T (rad).
    pub phase: f64,
    /// |q|/ωL, the ratio of spin to precession; infinite if there is a spin and no precession.
    pub spin: f64,
}

impl Turn {
    /// The turn of the motion of `toss`.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`] for a phase above 2^53 rad.
    pub fn of(toss: &Toss) -> Result<Self, SolveError> {
        let phases = RoughPhases::new(toss);
        // Without a spin the ratio is 0, also for a coin at rest, where it would be 0/0.
        let spin = if phases.spin == 0.0 { 0.0 } else { phases.spin / phases.precession };
        Ok(Self { phase: phases.largest()?, spin })
    }
}

/// A tolerance of an integrator, with the error and the cost to expect from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// The tolerance.
    pub tolerance: f64,
    /// The expected error, of cos θ or of the attitude (rad).
    pub error: f64,
    /// The expected cost (ns).
    pub cost_ns: f64,
}

impl Fitted {
    /// The entry of the closed form called `model`, if it has been measured.
    pub fn closed(&self, model: &str) -> Option<&ClosedFit> {
        self.closed.iter().find(|fit| fit.model == model)
    }

    /// The entry of the integrator `solver` with `scheme`, if it has been measured.
    pub fn integrator(&self, solver: &str, scheme: &str) -> Option<&IntegratorFit> {
        self.integrators.iter().find(|fit| fit.solver == solver && fit.scheme == scheme)
    }

    /// The entry of the sampling model called `model`, if it has been measured.
    pub fn sampling(&self, model: &str) -> Option<&SamplingFit> {
        self.sampling.iter().find(|fit| fit.model == model)
    }

    /// The coarsest tolerance at which the error of `fit` over `turn` is within `accuracy`, interpolated in phase and
    /// tolerance. The error is that of cos θ if `of_tilt`, else that of the attitude (rad).
    ///
    /// # Errors
    /// If no tabulated tolerance is fine enough: the smallest error that is reached.
    pub fn setting(&self, fit: &IntegratorFit, of_tilt: bool, turn: &Turn, accuracy: f64) -> Result<Setting, f64> {
        let spin = self.spin_bin(turn.spin);
        let place = self.place(turn.phase);
        let errors = if of_tilt { &fit.tilt_errors } else { &fit.errors };
        let error = |index: usize| place.of(&errors[spin], index);
        let tolerances = 0..self.tolerances.len();
        let serves = |index: &usize| place.is_within(&errors[spin], *index, accuracy);
        let Some(fine) = tolerances.clone().find(serves) else {
            return Err(tolerances.map(error).fold(f64::INFINITY, f64::min));
        };
        let rough = fine.saturating_sub(1);
        let part = if rough == fine { 1.0 } else { (accuracy / error(rough)).ln() / (error(fine) / error(rough)).ln() };
        let tolerance = between(self.tolerances[rough], self.tolerances[fine], part);
        let error = between(error(rough), error(fine), part);
        Ok(Setting { tolerance, error, cost_ns: self.cost_ns(fit, turn, tolerance) })
    }

    /// The expected cost (ns) of a flight by `fit` over `turn` at a `tolerance`.
    pub fn cost_ns(&self, fit: &IntegratorFit, turn: &Turn, tolerance: f64) -> f64 {
        let calls = &fit.calls[self.spin_bin(turn.spin)][self.place(turn.phase).bin];
        let last = self.tolerances.len() - 1;
        let fine = self.tolerances.iter().position(|finer| *finer <= tolerance).unwrap_or(last).max(1);
        let [rough, fine] = [fine - 1, fine];
        let part = (tolerance / self.tolerances[rough]).ln() / (self.tolerances[fine] / self.tolerances[rough]).ln();
        fit.cost_ns + between(calls[rough], calls[fine], part) * (1.0 + turn.phase) * fit.call_ns
    }

    fn spin_bin(&self, spin: f64) -> usize {
        self.spins.iter().position(|end| spin <= *end).unwrap_or(self.spins.len() - 1)
    }

    fn place(&self, phase: f64) -> Place {
        let last = self.phases.len() - 1;
        let bin = self.phases.iter().position(|end| phase <= *end).unwrap_or(last);
        let end = self.phases[bin];
        let part = if bin == 0 { 1.0 } else { (phase / self.phases[bin - 1]).ln() / (end / self.phases[bin - 1]).ln() };
        Place { bin, part: part.min(1.0), beyond: (phase / end).max(1.0) }
    }
}

/// The place of a phase among the bins.
struct Place {
    bin: usize,
    /// How far the phase is into its bin, from 0 to 1, on a logarithmic scale.
    part: f64,
    /// The phase over the end of the last bin if it lies beyond that, else 1. Errors are taken to grow in proportion to
    /// the phase there, so that the tolerance chosen becomes finer by about as much.
    beyond: f64,
}

impl Place {
    /// The entry of a table (phase × tolerance) for this phase, interpolated between the ends of its bin.
    fn of(&self, table: &[Vec<f64>], tolerance: usize) -> f64 {
        let [from, to] = self.ends(table, tolerance);
        between(from, to, self.part)
    }

    /// Whether that entry is at most `accuracy`. The ends of the bin mostly decide it, which saves a logarithm.
    fn is_within(&self, table: &[Vec<f64>], tolerance: usize, accuracy: f64) -> bool {
        let [from, to] = self.ends(table, tolerance);
        from.min(to) <= accuracy && (from.max(to) <= accuracy || self.of(table, tolerance) <= accuracy)
    }

    fn ends(&self, table: &[Vec<f64>], tolerance: usize) -> [f64; 2] {
        [table[self.bin.saturating_sub(1)][tolerance], table[self.bin][tolerance]].map(|error| error * self.beyond)
    }
}

/// Interpolates between `rough` (`part` = 0) and `fine` (`part` = 1) on a logarithmic scale.
fn between(rough: f64, fine: f64, part: f64) -> f64 {
    rough * (part * (fine / rough).ln()).exp()
}

#[cfg(test)]
mod tests;
