//! Answers as plain data that serde writes, with one set of names for every program that shows them: the command line, the page
//! in the browser, and yours. A report only reads what was computed, and nothing is read back from it.

use dynamics::{
    Body, Formulation, InputError, Landing as Landed, Outcome, SolveError, Solver, SolverConfig, Stage, Toss, Work,
};
use exact::{ExactSolver, Margin, STAGES, Sensitivity, margin};
use kinematics_quat::{IntegratedCounts, QuaternionSolver};
use sampling::{Counts, Found, IntervalKind, Node};
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

use crate::registry::{Backend, Registry};
use crate::rounding::Rounding;

/// The moments of a body (kg m²).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Moments {
    /// About x, or the first principal axis.
    pub i1: f64,
    /// About y, or the second principal axis.
    pub i2: f64,
    /// About z, or the third principal axis.
    pub i3: f64,
    /// The tensor, if its principal axes are not x, y and z.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia: Option<[f64; 6]>,
}

impl From<&Body> for Moments {
    fn from(body: &Body) -> Self {
        let along_axes = body.moments();
        let [i1, i2, i3] = along_axes.unwrap_or_else(|| body.principal_moments());
        Self { i1, i2, i3, inertia: along_axes.is_none().then(|| body.inertia()) }
    }
}

/// How a toss lands.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Landing {
    /// The moments of the body.
    pub coin: Moments,
    /// Time of flight (s).
    pub flight_time: f64,
    /// cos θ at landing.
    pub cos_tilt: f64,
    /// Heads, tails or undecided.
    pub outcome: Outcome,
    /// Whether the outcome is proven.
    pub certified: bool,
    /// By what the outcome is proven: `exact` or `integrated`.
    pub proof: Option<&'static str>,
    /// The proven bound of the error of cos θ.
    pub error_bound: Option<f64>,
    /// The proven bound of the error of the quaternion.
    pub attitude_error_bound: Option<f64>,
    /// If numbers were rounded as their units were converted: a bound of how far this turns the landing (rad), or null if none
    /// is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit_error: Option<Option<f64>>,
    /// In words, what is or is not proven of the outcome.
    #[serde(skip)]
    pub remark: String,
    /// The last stage of the proof by the exact motion, whether it has decided or not.
    #[serde(skip)]
    pub stage: Option<Stage>,
    /// The solver's estimate of the error of cos θ.
    #[serde(skip)]
    pub error_estimate: Option<f64>,
    /// If it was asked for; see [`Landing::with_margin`].
    pub margin: Option<Margin>,
    /// Of a body with I1 ≠ I2, unless it leaves the range of f64; see [`Landing::with_sensitivity`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensitivity: Option<Sensitivity>,
    /// The quaternion (w, x, y, z) from the body to the laboratory.
    pub attitude: [f64; 4],
    /// The body rate (rad/s).
    pub rate: [f64; 3],
    /// Loss of norm of an integrated quaternion.
    pub norm_error: f64,
    /// Name of the solver.
    pub solver: String,
    /// The scheme of an integrator.
    pub scheme: Option<&'static str>,
    /// What it cost.
    pub work: Work,
}

impl Landing {
    /// The landing of `toss` by `backend`.
    ///
    /// # Errors
    /// As for [`Solver::land`] and [`Backend::verdict`].
    pub fn new(toss: &Toss, backend: &Backend) -> Result<Self, SolveError> {
        let landed = backend.solver().land(toss)?;
        let verdict = backend.verdict(toss, landed.tilt())?;
        let mut report = Self::of(toss, &landed, backend.solver(), verdict.outcome());
        report.stage = verdict.stage();
        if verdict.is_proven() {
            report.prove("exact", ", proven".to_owned());
        }
        Ok(report)
    }

    /// The landing of `toss` that is proven by integration, with the bounds of its errors.
    ///
    /// # Errors
    /// As for [`QuaternionSolver::certify`].
    pub fn integrated(toss: &Toss, solver: &QuaternionSolver) -> Result<Self, SolveError> {
        let certificate = solver.certify(toss)?;
        let mut report = Self::of(toss, certificate.landing(), solver, certificate.outcome());
        report.error_bound = Some(certificate.error_bound());
        report.attitude_error_bound = Some(certificate.attitude_error_bound());
        if certificate.outcome() != Outcome::Undecided {
            report.prove("integrated", format!(", proven by integration in {}", certificate.stage()));
        }
        Ok(report)
    }

    /// The landing of numbers that were rounded as their units were converted: what this may have changed is not proven.
    ///
    /// # Errors
    /// As for [`Rounding::keeps`].
    pub fn rounded(mut self, toss: &Toss, rounding: &Rounding) -> Result<Self, SolveError> {
        self.unit_error = if rounding.is_none() { None } else { Some(rounding.error_bound(toss)?) };
        if self.certified && !rounding.keeps(toss, self.outcome)? {
            (self.certified, self.proof) = (false, None);
            ", not proven: the conversion of a unit may have changed it".clone_into(&mut self.remark);
        }
        Ok(self)
    }

    /// The same with the margin, whose search takes up to some seconds for a body with I1 ≠ I2.
    ///
    /// # Errors
    /// As for [`margin`](margin()).
    pub fn with_margin(self, toss: &Toss) -> Result<Self, SolveError> {
        Ok(Self { margin: Some(margin(toss)?), ..self })
    }

    /// The same with the derivatives of cos θ of a body with I1 ≠ I2. A program without this call does not contain their code.
    ///
    /// # Errors
    /// As for [`Sensitivity::new`].
    pub fn with_sensitivity(self, toss: &Toss) -> Result<Self, SolveError> {
        if toss.body.coin().is_some() {
            return Ok(self);
        }
        match Sensitivity::new(toss) {
            // They leave the range of f64, which the landing does not.
            Err(SolveError::NotFinite { .. }) => Ok(self),
            derivatives => Ok(Self { sensitivity: Some(derivatives?), ..self }),
        }
    }

    fn of(toss: &Toss, landed: &Landed, solver: &dyn Solver, outcome: Outcome) -> Self {
        Self {
            coin: Moments::from(&toss.body),
            flight_time: toss.launch.flight_time(),
            cos_tilt: without_sign_of_zero(landed.cos_tilt),
            outcome,
            certified: false,
            proof: None,
            error_bound: None,
            attitude_error_bound: None,
            unit_error: None,
            remark: String::new(),
            stage: None,
            error_estimate: landed.error,
            margin: None,
            sensitivity: None,
            attitude: landed.state.attitude.components().map(without_sign_of_zero),
            rate: landed.state.rate.into(),
            norm_error: landed.norm_error,
            solver: solver.name().to_owned(),
            scheme: solver.stepping().map(|stepping| stepping.scheme().name()),
            work: landed.work,
        }
    }

    fn prove(&mut self, proof: &'static str, remark: String) {
        (self.certified, self.proof, self.remark) = (true, Some(proof), remark);
    }
}

/// A solver with its settings beside the exact motion: where it lands, how far it is off, and what it costs.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Comparison {
    /// Name of the solver.
    pub solver: String,
    /// Its scheme.
    pub scheme: Option<String>,
    /// Its formulation, if it has a choice.
    pub formulation: Option<&'static str>,
    /// cos θ at landing.
    pub cos_tilt: Option<f64>,
    /// |Δ cos θ| from the exact motion. The exact motion has no errors here, because they are measured from it, and no work.
    pub cos_tilt_error: Option<f64>,
    /// Angle from the attitude of the exact motion (rad).
    pub attitude_error: Option<f64>,
    /// The outcome.
    pub outcome: Option<&'static str>,
    /// Evaluations of the right-hand side.
    pub rhs_calls: Option<u64>,
    /// Steps that were accepted.
    pub accepted_steps: Option<u64>,
    /// Steps that were rejected.
    pub rejected_steps: Option<u64>,
    /// Time of one flight (ns), if it was measured.
    pub time_ns: Option<f64>,
    /// Why the solver gave no answer.
    pub failure: Option<Failed>,
}

/// The error of a solver.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Failed {
    /// Its kind, such as `step_limit`.
    pub kind: &'static str,
    /// The error in words.
    pub message: String,
}

impl Comparison {
    /// The landing of `toss` by the solver of `config`, beside its `exact` landing.
    ///
    /// # Errors
    /// [`InputError`] for a solver that there is not. That a solver fails is part of the comparison.
    pub fn new(registry: &Registry, config: &SolverConfig, toss: &Toss, exact: &Landed) -> Result<Self, InputError> {
        let backend = registry.configured(config)?;
        let named = Self {
            solver: config.name().to_owned(),
            scheme: config.scheme().map(str::to_owned),
            formulation: config.formulation().map(Formulation::name),
            ..Self::default()
        };
        let landed = backend.solver().land(toss);
        let answered = landed.and_then(|landed| Ok((landed, backend.verdict(toss, landed.tilt())?)));
        Ok(match answered {
            Ok((landed, verdict)) => {
                let answered =
                    Self { cos_tilt: Some(landed.cos_tilt), outcome: Some(verdict.outcome().name()), ..named };
                if config.name() == ExactSolver::NAME { answered } else { answered.measured(&landed, exact) }
            }
            Err(error) => Self { failure: Some(Failed { kind: error.kind(), message: error.to_string() }), ..named },
        })
    }

    fn measured(self, landed: &Landed, exact: &Landed) -> Self {
        Self {
            cos_tilt_error: Some((landed.cos_tilt - exact.cos_tilt).abs()),
            attitude_error: Some(landed.state.attitude.angle_to(&exact.state.attitude)),
            rhs_calls: Some(landed.work.rhs_calls),
            accepted_steps: Some(landed.work.accepted_steps),
            rejected_steps: Some(landed.work.rejected_steps),
            ..self
        }
    }
}

/// Every solver of `registry` with each of its schemes, and with the `formulation`, or with each that it has. A scheme takes the
/// `tolerance` if it can, else the `step` (s).
///
/// # Errors
/// [`InputError`] for a tolerance or a step outside its range.
pub fn candidates(
    registry: &Registry,
    tolerance: f64,
    step: f64,
    formulation: Option<Formulation>,
) -> Result<Vec<SolverConfig>, InputError> {
    let mut all = Vec::new();
    for entry in registry.entries() {
        if !entry.integrates() {
            all.push(SolverConfig::new(entry.name()));
        }
        for scheme in entry.schemes() {
            let config = SolverConfig::new(entry.name()).with_scheme(scheme.name());
            let config =
                if scheme.is_adaptive() { config.with_tolerance(tolerance)? } else { config.with_step(step)? };
            if entry.formulations().is_empty() {
                all.push(config);
                continue;
            }
            let wanted = entry.formulations().iter().filter(|own| formulation.is_none_or(|wanted| wanted == **own));
            all.extend(wanted.map(|own| config.clone().with_formulation(*own)));
        }
    }
    Ok(all)
}

/// A map of P(heads) as plain data.
#[derive(Debug, Serialize)]
pub struct Map<'a> {
    across: &'static str,
    up: &'static str,
    across_values: &'a [f64],
    up_values: &'a [f64],
    /// A row for each value of `up`; `None` where no launch is decided.
    probability: Vec<Vec<Option<f64>>>,
    /// Likewise the numbers of undecided launches, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    undecided: Option<Vec<Vec<u64>>>,
}

impl<'a> From<&'a sampling::Map> for Map<'a> {
    fn from(map: &'a sampling::Map) -> Self {
        let ((across, columns), (up, rows)) = (&map.across, &map.up);
        let is_undecided = map.nodes.iter().any(|node| node.undecided > 0);
        Self {
            across: across.name(),
            up: up.name(),
            across_values: columns,
            up_values: rows,
            probability: rows_of(map, |node| node.probability),
            undecided: is_undecided.then(|| rows_of(map, |node| node.undecided)),
        }
    }
}

/// A value of each node, row by row.
fn rows_of<T>(map: &sampling::Map, value: impl Fn(&Node) -> T) -> Vec<Vec<T>> {
    map.nodes.chunks(map.across.1.len()).map(|row| row.iter().map(&value).collect()).collect()
}

/// An estimate of P(heads) as plain data, with the counts of proofs by integration if they decided all outcomes.
#[derive(Debug, Clone, Copy)]
pub struct Estimate<'a> {
    /// The estimate.
    pub found: &'a sampling::Estimate,
    /// The counts of the proofs by integration.
    pub integrated: Option<&'a IntegratedCounts>,
}

impl Serialize for Estimate<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self { found, integrated } = *self;
        let counts = if let Found::Counts(counts) = found.found { Some(counts) } else { None };
        let proven = counts.filter(Counts::are_certified).map(|counts| counts.proven());
        let mut map = to.serialize_map(None)?;
        if let Some(counts) = counts {
            map.serialize_entry("heads", &counts.heads())?;
            map.serialize_entry("tails", &counts.tails())?;
            map.serialize_entry("undecided", &counts.undecided())?;
        }
        map.serialize_entry("points", &found.points)?;
        map.serialize_entry("probability", &found.is_known().then_some(found.probability))?;
        if let (None, Some(half_width)) = (counts, found.half_width()) {
            map.serialize_entry("error_bound", &half_width)?;
        }
        map.serialize_entry("interval", &found.interval)?;
        map.serialize_entry("interval_kind", &found.interval_in_words())?;
        let is_enclosed = found.interval_kind == IntervalKind::Proven;
        map.serialize_entry("proven", &is_enclosed)?;
        let counts_are_proven = integrated.map_or(proven.is_some(), |counts| counts.undecided == 0);
        map.serialize_entry("certified", &(is_enclosed || counts_are_proven))?;
        if let Some(proven) = proven {
            let names = ["f64", "double_double", "multiprecision"];
            map.serialize_entry("proven_by", &ByStage(names.into_iter().zip(STAGES).collect(), &proven))?;
        }
        if let Some(counts) = integrated {
            let names = ["coarse", "f64", "finest_tolerance", "double_double", "more_digits"];
            map.serialize_entry("integrated_by", &ByStage(names.into_iter().zip(Stage::ALL).collect(), counts))?;
        }
        // A seed above 2^53 is a text, because readers that take numbers for f64, as JavaScript does, would round it.
        match found.plan.seed() {
            Some(seed) if seed > 1 << 53 => map.serialize_entry("seed", &seed.to_string())?,
            seed => map.serialize_entry("seed", &seed)?,
        }
        map.serialize_entry("method", found.plan.method().name())?;
        map.end()
    }
}

/// The numbers of outcomes by these stages, each with its name.
struct ByStage<'a>(Vec<(&'static str, Stage)>, &'a dynamics::Counts);

impl Serialize for ByStage<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_map(self.0.iter().map(|(name, stage)| (name, self.1.by(*stage))))
    }
}

/// -0 as 0; any other number as it is.
fn without_sign_of_zero(value: f64) -> f64 {
    value + 0.0
}
