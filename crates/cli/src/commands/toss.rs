//! `unfair-toss toss`: one toss, one answer.

use serde::Serialize;
use toss::{Backend, Margin, Propagation, TimeOfFlight, Toss, Work, margin};

use crate::failure::Failure;
use crate::output::{self, Format, Input, fixed, without_sign_of_zero};
use crate::toss_args::FlightArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    flight: FlightArgs,
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
    /// What the text adds to the outcome.
    #[serde(skip)]
    remark: &'static str,
    margin: MarginAnswer,
    attitude: [f64; 4],
    rate: [f64; 3],
    norm_error: f64,
    /// The norm error by its former name.
    defect: f64,
    solver: String,
    scheme: Option<&'static str>,
    /// The scheme by its former name.
    method: Option<&'static str>,
    work: WorkCounts,
}

#[derive(Serialize)]
struct Moments {
    i1: f64,
    i2: f64,
    i3: f64,
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
    /// Whether a speed was given, and not a time.
    #[serde(skip)]
    thrown: bool,
}

impl Args {
    pub(crate) fn run(&self, input: &Input) -> Result<String, Failure> {
        let (toss, backend) = self.flight.parts()?;
        let mut answer = Answer::new(&toss, &backend)?;
        if answer.certified && !self.flight.toss().is_beyond_rounding(&toss)? {
            (answer.certified, answer.remark) = (false, ", not proven: the conversion of a unit may have changed it");
        }
        Ok(match self.format {
            Format::Json => output::json(input, &answer),
            Format::Text => answer.text(toss.coin.inertia_ratio()),
        })
    }
}

impl Answer {
    fn new(toss: &Toss, backend: &Backend) -> Result<Self, Failure> {
        let solver = backend.solver();
        let Propagation { state, cos_tilt, norm_error, work, .. } = solver.propagate(toss)?;
        let verdict = backend.verdict(toss, cos_tilt)?;
        let Work { rhs_calls, accepted_steps, rejected_steps } = work;
        let (i1, i3) = (toss.coin.i1(), toss.coin.i3());
        let scheme = solver.stepping().map(|stepping| stepping.scheme().name());
        Ok(Self {
            coin: Moments { i1, i2: i1, i3 },
            flight_time: toss.launch.flight_time(),
            cos_tilt: without_sign_of_zero(cos_tilt),
            outcome: verdict.outcome().name(),
            certified: verdict.is_proven(),
            remark: if verdict.is_proven() { ", proven" } else { "" },
            margin: MarginAnswer::new(toss)?,
            attitude: state.attitude.components().map(without_sign_of_zero),
            rate: state.rate.into(),
            norm_error,
            defect: norm_error,
            solver: solver.name().to_owned(),
            scheme,
            method: scheme,
            work: WorkCounts { rhs_calls, accepted_steps, rejected_steps },
        })
    }

    fn text(&self, inertia_ratio: f64) -> String {
        let [w, x, y, z] = self.attitude.map(|part| fixed(part, 9));
        let scheme = self.scheme.map(|name| format!(", {name}")).unwrap_or_default();
        let mut lines = vec![
            format!("outcome      {}{}", self.outcome, self.remark),
            format!("cos θ        {}", shortest(self.cos_tilt)),
            format!("flight time  {} s", self.flight_time),
            format!("attitude     w {w}  x {x}  y {y}  z {z}"),
            format!("coin         I1 {:e} kg m², I3 {:e} kg m², k = {inertia_ratio}", self.coin.i1, self.coin.i3),
            format!("solver       {}{scheme}", self.solver),
        ];
        lines.insert(1, format!("margin       {}", self.margin.text()));
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

/// The shortest digits that read back as the same number, with an exponent if it is tiny.
fn shortest(number: f64) -> String {
    if number != 0.0 && number.abs() < 1e-4 { format!("{number:e}") } else { number.to_string() }
}

impl MarginAnswer {
    fn new(toss: &Toss) -> Result<Self, Failure> {
        let Margin { time, speed, gravity, tilt, rate, rate_range } = margin(toss)?;
        let thrown = !matches!(toss.launch.time_of_flight(), TimeOfFlight::Given(_));
        Ok(Self { time, speed, gravity, tilt, rate, rate_range, thrown })
    }

    /// In two lines, which the column of the answers fits.
    fn text(&self) -> String {
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
            format!("{}, {}, {tilt}", change(self.speed, "m/s", "v0"), change(self.gravity, "m/s²", "g"))
        } else {
            format!("{}, {tilt}", change(self.time, "s", "the time of flight"))
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
