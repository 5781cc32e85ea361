//! Answers as plain data that serde writes, with one set of names for every program that shows them: the command line, the page
//! in the browser, and yours. A report only reads what was computed, and nothing is read back from it.

use dynamics::{
    Body, Formulation, InputError, Landing as Landed, Outcome, SolveError, Solver, SolverConfig, StepControl,
    TimeOfFlight, Toss, Work,
};
use exact::{ExactSolver, Sensitivity, Stage};
use kinematics_quat::{IntegratedCounts, Integration, QuaternionSolver};
use sampling::{Counts, Found, IntervalKind, Plan, Rest, Scrambled};
use serde::{Serialize, Serializer};

use crate::choice::{Candidate, Choice, Decision, How};
use crate::reason::Reason;
use crate::registry::{Backend, Registry};
use crate::rounding::Rounding;
use crate::scene::{Scene, Want};

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
    /// `None` for a body with I1 ≠ I2, unless it was asked for.
    pub margin: Option<Margin>,
    /// Of a body with I1 ≠ I2, unless it leaves the range of f64; see [`Landing::with_sensitivity`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sensitivity: Option<Slopes>,
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

/// The derivatives of cos θ at landing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Slopes {
    /// With respect to ωx, ωy and ωz (s).
    pub rate: [f64; 3],
    /// With respect to the time of flight (1/s).
    pub time: f64,
}

/// For each input alone, the change to the nearest value that flips the outcome of the exact motion; `None` where none does, or,
/// of a rate, none up to a change of `rate_range`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Margin {
    /// Of the time of flight (s).
    pub time: Option<f64>,
    /// Of the speed (m/s).
    pub speed: Option<f64>,
    /// Of gravity (m/s²).
    pub gravity: Option<f64>,
    /// Of the tilt (rad).
    pub tilt: Option<f64>,
    /// Of each rate (rad/s).
    pub rate: [Option<f64>; 3],
    /// How far each rate was searched (rad/s).
    pub rate_range: [f64; 3],
    /// The changes of the time of flight that were searched, earlier and later (s), for a body with I1 ≠ I2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_range: Option<[f64; 2]>,
    /// Whether a speed was given, and not a time.
    #[serde(skip)]
    pub thrown: bool,
}

impl Margin {
    /// The margin of `toss`. Of a body with I1 ≠ I2 it takes up to some seconds.
    ///
    /// # Errors
    /// As for [`exact::margin()`].
    pub fn new(toss: &Toss) -> Result<Self, SolveError> {
        let exact::Margin { time, speed, gravity, tilt, rate, rate_range, time_range } = exact::margin(toss)?;
        let thrown = !matches!(toss.launch.time_of_flight(), TimeOfFlight::Given(_));
        let time_range = toss.body.coin().is_none().then_some(time_range);
        Ok(Self { time, speed, gravity, tilt, rate, rate_range, time_range, thrown })
    }
}

impl Slopes {
    /// `None` where they leave the range of f64, which the landing does not.
    fn new(toss: &Toss) -> Result<Option<Self>, SolveError> {
        let derivatives = match Sensitivity::new(toss) {
            Err(SolveError::NotFinite { .. }) => return Ok(None),
            derivatives => derivatives?,
        };
        let [x, y, z, time] = <[f64; 4]>::from(derivatives.cos_tilt).map(without_sign_of_zero);
        Ok(Some(Self { rate: [x, y, z], time }))
    }
}

impl Landing {
    /// The landing of `toss` by `backend`. The margin of a body with I1 ≠ I2 is there if it is asked for.
    ///
    /// # Errors
    /// As for [`Solver::land`] and [`Backend::verdict`].
    pub fn new(toss: &Toss, backend: &Backend, with_margin: bool) -> Result<Self, SolveError> {
        let landed = backend.solver().land(toss)?;
        let verdict = backend.verdict(toss, landed.tilt())?;
        let mut report = Self::of(toss, &landed, backend.solver(), verdict.outcome(), with_margin)?;
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
        let mut report = Self::of(toss, certificate.landing(), solver, certificate.outcome(), false)?;
        report.error_bound = Some(certificate.error_bound());
        report.attitude_error_bound = Some(certificate.attitude_error_bound());
        if certificate.outcome() != Outcome::Undecided {
            report.prove("integrated", format!(", proven by integration in {}", certificate.integration()));
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

    /// The same with the derivatives of cos θ of a body with I1 ≠ I2. A program without this call does not contain their code.
    ///
    /// # Errors
    /// As for [`Sensitivity::new`].
    pub fn with_sensitivity(self, toss: &Toss) -> Result<Self, SolveError> {
        let is_coin = toss.body.coin().is_some();
        Ok(if is_coin { self } else { Self { sensitivity: Slopes::new(toss)?, ..self } })
    }

    fn of(
        toss: &Toss,
        landed: &Landed,
        solver: &dyn Solver,
        outcome: Outcome,
        with_margin: bool,
    ) -> Result<Self, SolveError> {
        let is_coin = toss.body.coin().is_some();
        Ok(Self {
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
            margin: (is_coin || with_margin).then(|| Margin::new(toss)).transpose()?,
            sensitivity: None,
            attitude: landed.state.attitude.components().map(without_sign_of_zero),
            rate: landed.state.rate.into(),
            norm_error: landed.norm_error,
            solver: solver.name().to_owned(),
            scheme: solver.stepping().map(|stepping| stepping.scheme().name()),
            work: landed.work,
        })
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

/// An estimate of P(heads).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Estimate {
    /// The counts of outcomes, if launches were counted.
    #[serde(flatten, serialize_with = "outcomes")]
    pub counts: Option<Counts>,
    /// Number of launches.
    pub points: u64,
    /// The probability of heads, of the decided launches; `None` if none is decided.
    pub probability: Option<f64>,
    /// Without counts: half the width of the interval.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_bound: Option<f64>,
    /// Both ends of the interval.
    pub interval: Option<[f64; 2]>,
    /// What the interval means.
    pub interval_kind: String,
    /// Whether both ends of the interval are proven.
    pub proven: bool,
    /// Whether every outcome is proven.
    pub certified: bool,
    /// The number of outcomes that each stage of the proof decided.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "as_map")]
    pub proven_by: Option<Vec<(&'static str, u64)>>,
    /// The number of outcomes that each kind of integration decided.
    #[serde(skip_serializing_if = "Option::is_none", serialize_with = "as_map")]
    pub integrated_by: Option<Vec<(&'static str, u64)>>,
    /// The seed of what is random.
    #[serde(serialize_with = "seed")]
    pub seed: Option<u64>,
    /// The method by which launches were chosen.
    pub method: &'static str,
}

fn outcomes<S: Serializer>(counts: &Option<Counts>, to: S) -> Result<S::Ok, S::Error> {
    let named = |of: &Counts| [("heads", of.heads()), ("tails", of.tails()), ("undecided", of.undecided())];
    to.collect_map(counts.iter().flat_map(named))
}

fn as_map<S: Serializer>(counts: &Option<Vec<(&'static str, u64)>>, to: S) -> Result<S::Ok, S::Error> {
    to.collect_map(counts.iter().flatten().copied())
}

/// A seed above 2^53 as a text, because readers that take numbers for f64, as JavaScript does, would round it.
fn seed<S: Serializer>(seed: &Option<u64>, to: S) -> Result<S::Ok, S::Error> {
    match seed {
        Some(seed) if *seed > 1 << 53 => to.collect_str(seed),
        seed => seed.serialize(to),
    }
}

impl Estimate {
    /// The estimate that `plan` has `found`.
    pub fn new(found: &sampling::Estimate, plan: Plan) -> Self {
        let (counts, error_bound) = match found.found {
            Found::Counts(counts) => (Some(counts), None),
            Found::Shares { .. } => (None, found.half_width()),
        };
        let proven = counts.filter(Counts::are_certified).map(|counts| counts.proven());
        let names = ["f64", "double_double", "multiprecision"];
        let by_stage =
            proven.map(|proven| names.into_iter().zip(Stage::ALL.map(|stage| proven.by(stage))).collect::<Vec<_>>());
        Self {
            counts,
            points: found.points,
            probability: found.is_known().then_some(found.probability),
            error_bound,
            interval: found.interval.map(|interval| [interval.lo, interval.hi]),
            interval_kind: interval_kind(found, plan),
            proven: found.interval_kind == IntervalKind::Proven,
            certified: proven.is_some(),
            proven_by: by_stage,
            integrated_by: None,
            seed: seed_of(plan),
            method: plan.method().name(),
        }
    }

    /// The same estimate, of which each outcome was decided by integration.
    #[must_use]
    pub fn integrated(self, counts: &IntegratedCounts) -> Self {
        let names = ["coarse", "f64", "finest_tolerance", "double_double", "more_digits"];
        let by_kind = names.into_iter().zip(Integration::ALL.map(|kind| counts.by(kind))).collect();
        Self { certified: counts.undecided() == 0, integrated_by: Some(by_kind), ..self }
    }
}

/// What the interval of an estimate by `plan` means, in words, and whether it is wider than was asked for.
fn interval_kind(found: &sampling::Estimate, plan: Plan) -> String {
    let kind = &found.interval_kind;
    if found.is_wider_than_asked(plan) { format!("{kind}, but wider than was asked for") } else { kind.to_string() }
}

/// The seed of `plan`; `None` if nothing in it is random.
fn seed_of(plan: Plan) -> Option<u64> {
    match plan {
        Plan::Grid | Plan::ExactSpeed(Rest::Grid) | Plan::Enclosure { .. } => None,
        Plan::Random { seed, .. } => Some(seed),
        Plan::Sobol(Scrambled { seed, .. }) | Plan::ExactSpeed(Rest::Sobol(Scrambled { seed, .. })) => Some(seed),
    }
}

/// The model that a plan takes, and the others.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Planned {
    /// Name of the model.
    pub model: &'static str,
    /// Name of the solver.
    pub solver: String,
    /// The scheme of an integrator.
    pub scheme: Option<&'static str>,
    /// The method by which a sample chooses its launches.
    pub method: Option<&'static str>,
    /// The tolerance of an integrator.
    pub tolerance: Option<f64>,
    /// The number of launches of a sample. The cells of an enclosure are not numbered before.
    pub points: Option<u64>,
    /// The error to expect.
    pub expected_error: f64,
    /// Whether no error is larger than that.
    pub certified: bool,
    /// The cost to expect (ns).
    pub expected_cost_ns: f64,
    /// The other models.
    pub passed_over: Vec<PassedOver>,
}

/// A model that a plan does not take.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PassedOver {
    /// Name of the model, or `solver/scheme`.
    pub model: String,
    /// The reason in words.
    pub why: String,
}

impl Planned {
    /// The `decision` on the plan of `scene`.
    pub fn new(scene: &Scene, decision: &Decision) -> Self {
        let Choice { model, how, expected_error, expected_cost_ns } = &decision.choice;
        let (integrator, plan) = match how {
            How::ClosedForm => (None, None),
            How::Integrator(entry, stepping) => (Some((entry, *stepping)), None),
            How::Sampling(plan) => (None, Some(*plan)),
        };
        let space = if let Want::Probability(space) = &scene.want { Some(space) } else { None };
        let other = |(model, why): &(Candidate, Reason)| PassedOver { model: model.to_string(), why: why.to_string() };
        Self {
            model: model.name,
            solver: integrator.map_or(ExactSolver::NAME, |(entry, _)| entry.name()).to_owned(),
            scheme: integrator.map(|(_, stepping)| stepping.scheme().name()),
            method: plan.map(|plan| plan.method().name()),
            tolerance: integrator.and_then(|(_, stepping)| match stepping.control() {
                StepControl::Tolerance(tolerance) => Some(tolerance),
                StepControl::Step(_) => None,
            }),
            points: plan.zip(space).and_then(|(plan, space)| plan.points(space).ok()),
            expected_error: *expected_error,
            certified: scene.by.as_ref().is_some_and(|by| by.prove),
            expected_cost_ns: *expected_cost_ns,
            passed_over: decision.passed_over.iter().map(other).collect(),
        }
    }
}

/// -0 as 0; any other number as it is.
fn without_sign_of_zero(value: f64) -> f64 {
    value + 0.0
}
