//! `unfair-toss toss`: one toss, one answer.

use serde::Serialize;
use toss::{Backend, Propagation, Toss, Work, margin};

use crate::failure::Failure;
use crate::output::{self, Format, Input, without_sign_of_zero};
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

/// The smallest change of one input that flips the outcome of the exact motion; null where none does.
#[derive(Serialize)]
struct MarginAnswer {
    time: Option<f64>,
    speed: Option<f64>,
    rate: [Option<f64>; 3],
}

impl Args {
    pub(crate) fn run(&self, input: &Input) -> Result<String, Failure> {
        let (toss, backend) = self.flight.parts()?;
        let answer = Answer::new(&toss, &backend)?;
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
        let margin = margin(toss)?;
        let Work { rhs_calls, accepted_steps, rejected_steps } = work;
        let (i1, i3) = (toss.coin.i1(), toss.coin.i3());
        let scheme = solver.stepping().map(|stepping| stepping.scheme().name());
        Ok(Self {
            coin: Moments { i1, i2: i1, i3 },
            flight_time: toss.launch.flight_time(),
            cos_tilt: without_sign_of_zero(cos_tilt),
            outcome: verdict.outcome().name(),
            certified: verdict.is_proven(),
            margin: MarginAnswer { time: margin.time, speed: margin.speed, rate: margin.rate },
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
        let [w, x, y, z] = self.attitude;
        let scheme = self.scheme.map(|name| format!(", {name}")).unwrap_or_default();
        let mut lines = vec![
            format!("outcome      {}{}", self.outcome, if self.certified { ", proven" } else { "" }),
            format!("cos θ        {}", self.cos_tilt),
            format!("flight time  {} s", self.flight_time),
            format!("attitude     w {w:+.9}  x {x:+.9}  y {y:+.9}  z {z:+.9}"),
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

impl MarginAnswer {
    fn text(&self) -> String {
        let change = |value: Option<f64>, unit| {
            let digits = |value: f64| {
                if (1e-3..1e4).contains(&value.abs()) { format!("{value:+.4}") } else { format!("{value:+.3e}") }
            };
            value.map(|value| format!("{} {unit}", digits(value)))
        };
        let nearest = change(self.speed, "m/s in v0").or_else(|| change(self.time, "s in the time of flight"));
        let rates = ["ωx", "ωy", "ωz"].into_iter().zip(self.rate);
        let rates =
            rates.filter_map(|(name, value)| change(value, "rad/s").map(|change| format!("{change} in {name}")));
        let all: Vec<String> = nearest.into_iter().chain(rates).collect();
        if self.time.is_none() { "no speed changes the outcome".to_owned() } else { all.join(", ") }
    }
}
