//! `unfair-toss toss`: one toss, one answer.

use serde::Serialize;
use toss::{
    Backend, Body, IntegratedCertificate, Landing, Margin, Outcome, QuaternionSolver, Registry, Sensitivity,
    SolveError, Solver, TimeOfFlight, Toss, Work, margin,
};

use crate::failure::Failure;
use crate::output::{self, Format, Input, fixed, without_sign_of_zero};
use crate::toss_args::FlightArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    flight: FlightArgs,
    /// Search the margin of a body with I1 ≠ I2 too, which takes some seconds; that of a coin is always there
    #[arg(long)]
    margin: bool,
    /// Prove the outcome by integration, and bound the errors of cos θ and of the attitude: for the solver
    /// quaternion, whose scheme is then taylor by default
    #[arg(long)]
    prove: bool,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

#[derive(Serialize)]
struct Answer {
    coin: Moments,
    flight_time: f64,
    cos_tilt: f64,
    outcome: &'static str,
    certified: bool,
    /// By what the outcome is proven: `exact` or `integrated`.
    proof: Option<&'static str>,
    /// The proven bounds of the errors of cos θ and of the quaternion.
    error_bound: Option<f64>,
    attitude_error_bound: Option<f64>,
    /// If numbers were rounded as their units were converted: a bound of how far this turns the landing (rad), or null if none
    /// is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    unit_error: Option<Option<f64>>,
    /// What the text adds to the outcome.
    #[serde(skip)]
    remark: String,
    /// None for a body with I1 ≠ I2, unless it is asked for.
    margin: Option<MarginAnswer>,
    /// Of a body with I1 ≠ I2, unless it leaves the range of f64.
    #[serde(skip_serializing_if = "Option::is_none")]
    sensitivity: Option<Slopes>,
    attitude: [f64; 4],
    rate: [f64; 3],
    norm_error: f64,
    solver: String,
    scheme: Option<&'static str>,
    work: WorkCounts,
}

#[derive(Serialize)]
struct Moments {
    i1: f64,
    i2: f64,
    i3: f64,
    /// The tensor, if its principal axes are not x, y and z.
    #[serde(skip_serializing_if = "Option::is_none")]
    inertia: Option<[f64; 6]>,
}

/// The derivatives of cos θ at landing with respect to ωx, ωy, ωz (s) and the time of flight (1/s).
#[derive(Serialize)]
struct Slopes {
    rate: [f64; 3],
    time: f64,
}

#[derive(Serialize)]
struct WorkCounts {
    rhs_calls: u64,
    accepted_steps: u64,
    rejected_steps: u64,
}

/// For each input alone, the change to the nearest value that flips the outcome of the exact motion; null where none does, or,
/// of a rate, none up to a change of `rate_range`.
#[derive(Serialize)]
struct MarginAnswer {
    time: Option<f64>,
    speed: Option<f64>,
    gravity: Option<f64>,
    tilt: Option<f64>,
    rate: [Option<f64>; 3],
    rate_range: [f64; 3],
    /// The changes of the time of flight that were searched, earlier and later (s), for a body with I1 ≠ I2.
    #[serde(skip_serializing_if = "Option::is_none")]
    time_range: Option<[f64; 2]>,
    /// Whether a speed was given, and not a time.
    #[serde(skip)]
    thrown: bool,
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, input: &Input) -> Result<String, Failure> {
        let (toss, outcome, mut answer) = if self.prove {
            let (toss, solver) = (self.flight.toss().toss()?, self.flight.prover(registry)?);
            let (outcome, answer) = Answer::integrated(&toss, &solver)?;
            (toss, outcome, answer)
        } else {
            let (toss, backend) = self.flight.parts(registry)?;
            let (outcome, answer) = Answer::new(&toss, &backend, self.margin)?;
            (toss, outcome, answer)
        };
        let rounding = self.flight.toss().rounding()?;
        answer.unit_error = if rounding.is_none() { None } else { Some(rounding.error_bound(&toss)?) };
        if answer.certified && !rounding.keeps(&toss, outcome)? {
            (answer.certified, answer.proof) = (false, None);
            ", not proven: the conversion of a unit may have changed it".clone_into(&mut answer.remark);
        }
        Ok(match self.format {
            Format::Json => output::json(input, &answer),
            Format::Text => answer.text(&toss.body),
        })
    }
}

impl Answer {
    fn new(toss: &Toss, backend: &Backend, with_margin: bool) -> Result<(Outcome, Self), Failure> {
        let solver = backend.solver();
        let landing = solver.land(toss)?;
        let verdict = backend.verdict(toss, landing.tilt())?;
        let mut answer = Self::of(toss, &landing, solver, with_margin)?;
        (answer.outcome, answer.certified) = (verdict.outcome().name(), verdict.is_proven());
        if answer.certified {
            (answer.proof, answer.remark) = (Some("exact"), ", proven".to_owned());
        }
        Ok((verdict.outcome(), answer))
    }

    /// The outcome and the answer that are proven by integration, with their bounds.
    fn integrated(toss: &Toss, solver: &QuaternionSolver) -> Result<(Outcome, Self), Failure> {
        let certificate: IntegratedCertificate = solver.certify(toss)?;
        let mut answer = Self::of(toss, certificate.landing(), solver, false)?;
        let outcome = certificate.outcome();
        (answer.outcome, answer.certified) = (outcome.name(), outcome != Outcome::Undecided);
        (answer.error_bound, answer.attitude_error_bound) =
            (Some(certificate.error_bound()), Some(certificate.attitude_error_bound()));
        if answer.certified {
            (answer.proof, answer.remark) =
                (Some("integrated"), format!(", proven by integration in {}", certificate.integration()));
        }
        Ok((outcome, answer))
    }

    /// The answer of `solver` with this `landing`, whose outcome is not known yet.
    fn of(toss: &Toss, landing: &Landing, solver: &dyn Solver, with_margin: bool) -> Result<Self, Failure> {
        let &Landing { state, cos_tilt, norm_error, work, .. } = landing;
        let Work { rhs_calls, accepted_steps, rejected_steps } = work;
        let is_coin = toss.body.coin().is_some();
        let sensitivity = if is_coin { None } else { Slopes::new(toss)? };
        let scheme = solver.stepping().map(|stepping| stepping.scheme().name());
        Ok(Self {
            coin: Moments::new(&toss.body),
            flight_time: toss.launch.flight_time(),
            cos_tilt: without_sign_of_zero(cos_tilt),
            outcome: Outcome::Undecided.name(),
            certified: false,
            proof: None,
            error_bound: None,
            attitude_error_bound: None,
            unit_error: None,
            remark: String::new(),
            margin: (is_coin || with_margin).then(|| MarginAnswer::new(toss)).transpose()?,
            sensitivity,
            attitude: state.attitude.components().map(without_sign_of_zero),
            rate: state.rate.into(),
            norm_error,
            solver: solver.name().to_owned(),
            scheme,
            work: WorkCounts { rhs_calls, accepted_steps, rejected_steps },
        })
    }

    /// What a change of the launch does: the margin, or the sensitivity where it was not searched.
    fn changes(&self) -> String {
        let slopes = |Slopes { rate: [x, y, z], time }: &Slopes| {
            let [x, y, z, time] = [*x, *y, *z, *time].map(digits);
            format!(
                "sensitivity  cos θ by {x} per rad/s in ωx, {y} in ωy, {z} in ωz,\n             {time} per s in time"
            )
        };
        let margin = self.margin.as_ref().map(|margin| format!("margin       {}", margin.text()));
        let unknown = || "sensitivity  beyond the range of numbers".to_owned();
        margin.or_else(|| self.sensitivity.as_ref().map(slopes)).unwrap_or_else(unknown)
    }

    fn text(&self, body: &Body) -> String {
        let [w, x, y, z] = self.attitude.map(|part| fixed(part, 9));
        let scheme = self.scheme.map(|name| format!(", {name}")).unwrap_or_default();
        let mut lines = vec![
            format!("outcome      {}{}", self.outcome, self.remark),
            format!("cos θ        {}", shortest(self.cos_tilt)),
            format!("flight time  {} s", self.flight_time),
            format!("attitude     w {w}  x {x}  y {y}  z {z}"),
            self.coin.text(body),
            format!("solver       {}{scheme}", self.solver),
        ];
        lines.insert(1, self.changes());
        if let (Some(cos_tilt), Some(attitude)) = (self.error_bound, self.attitude_error_bound) {
            lines.push(format!("error bound  {cos_tilt:.1e} of cos θ, {attitude:.1e} of the attitude's quaternion"));
        }
        // Where it can be seen in the attitude.
        if let Some(Some(turn)) = self.unit_error.filter(|turn| turn.is_some_and(|turn| turn > 1e-10)) {
            lines.push(format!("unit error   at most {turn:.1e} rad of the attitude, by the conversion of units"));
        }
        if self.norm_error > 0.0 {
            lines.push(format!("norm error   {:.1e}, the loss of norm of the quaternion", self.norm_error));
        }
        if self.scheme.is_some() {
            let WorkCounts { rhs_calls, accepted_steps, rejected_steps } = self.work;
            lines.push(format!(
                "work         {rhs_calls} right-hand sides, {accepted_steps} steps, {rejected_steps} rejected"
            ));
        }
        lines.join("\n")
    }
}

impl Moments {
    fn new(body: &Body) -> Self {
        let principal = body.moments();
        let [i1, i2, i3] = principal.unwrap_or_else(|| body.principal_moments());
        Self { i1, i2, i3, inertia: if principal.is_some() { None } else { Some(body.inertia()) } }
    }

    fn text(&self, body: &Body) -> String {
        let Self { i1, i2, i3, inertia } = self;
        match (body.coin(), inertia) {
            (Some(coin), _) => format!("coin         I1 {i1:e} kg m², I3 {i3:e} kg m², k = {}", coin.inertia_ratio()),
            (None, None) => format!("body         I1 {i1:e} kg m², I2 {i2:e} kg m², I3 {i3:e} kg m²"),
            (None, Some(_)) => format!("body         principal moments {i1:e}, {i2:e} and {i3:e} kg m²"),
        }
    }
}

impl Slopes {
    /// `None` where they leave the range of f64, which the landing does not.
    fn new(toss: &Toss) -> Result<Option<Self>, Failure> {
        let derivatives = match Sensitivity::new(toss) {
            Err(SolveError::NotFinite { .. }) => return Ok(None),
            derivatives => derivatives?,
        };
        let [x, y, z, time] = derivatives.cos_tilt.into();
        Ok(Some(Self { rate: [x, y, z].map(without_sign_of_zero), time: without_sign_of_zero(time) }))
    }
}

/// The shortest digits that read back as the same number, with an exponent if it is tiny.
fn shortest(number: f64) -> String {
    if number != 0.0 && number.abs() < 1e-4 { format!("{number:e}") } else { number.to_string() }
}

impl MarginAnswer {
    fn new(toss: &Toss) -> Result<Self, Failure> {
        let Margin { time, speed, gravity, tilt, rate, rate_range, time_range } = margin(toss)?;
        let thrown = !matches!(toss.launch.time_of_flight(), TimeOfFlight::Given(_));
        let time_range = if toss.body.coin().is_some() { None } else { Some(time_range) };
        Ok(Self { time, speed, gravity, tilt, rate, rate_range, time_range, thrown })
    }

    /// In two lines, which the column of the answers fits.
    fn text(&self) -> String {
        let nowhere = [self.time, self.speed, self.gravity].iter().all(Option::is_none);
        let searched = self.time_range.filter(|[_, later]| nowhere && later.is_finite());
        let searched = searched.map(|[earlier, later]| format!(" from -{} s to +{} s", short(earlier), short(later)));
        let searched = searched.unwrap_or_default();
        let change = |value: Option<f64>, unit: &str, name: &str| match value {
            Some(value) => format!("{} {unit} in {name}", digits(value)),
            None => format!("none in {name}"),
        };
        let rates = ["ωx", "ωy", "ωz"].iter().zip(self.rate).zip(self.rate_range).map(|((name, value), range)| {
            let within = if value.is_none() { format!(" within ±{} rad/s", short(range)) } else { String::new() };
            change(value, "rad/s", name) + &within
        });
        let rates: Vec<String> = rates.collect();
        let tilt = change(self.tilt, "rad", "tilt");
        let rest = if self.thrown {
            format!("{}, {}{searched}, {tilt}", change(self.speed, "m/s", "v0"), change(self.gravity, "m/s²", "g"))
        } else {
            format!("{}{searched}, {tilt}", change(self.time, "s", "the time of flight"))
        };
        format!("{rest},\n             {}", rates.join(", "))
    }
}

/// A change with its sign.
fn digits(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        1e-3..1e4 => format!("{value:+.4}"),
        _ => format!("{value:+.3e}"),
    }
}

/// A range in few digits.
fn short(range: f64) -> String {
    if (1.0..1e6).contains(&range) { format!("{range:.0}") } else { format!("{range:.3e}") }
}
