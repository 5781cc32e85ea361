//! `unfair-toss toss`: one toss, one answer.

use serde::Serialize;
use toss::{Propagation, Solver, Toss, Work};

use crate::args::FlightArgs;
use crate::failure::Failure;
use crate::output::{self, Format};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    flight: FlightArgs,
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub(crate) format: Format,
}

#[derive(Serialize)]
struct Answer {
    coin: Moments,
    flight_time: f64,
    cos_tilt: f64,
    outcome: &'static str,
    certified: bool,
    attitude: [f64; 4],
    solver: &'static str,
    method: Option<&'static str>,
    work: WorkCounts,
}

#[derive(Serialize)]
struct Moments {
    i1: f64,
    i3: f64,
}

#[derive(Serialize)]
struct WorkCounts {
    rhs_calls: u64,
    accepted_steps: u64,
    rejected_steps: u64,
}

impl Args {
    pub(crate) fn run(&self) -> Result<String, Failure> {
        let (toss, solver) = self.flight.parts()?;
        let answer = Answer::new(&toss, solver.as_ref())?;
        Ok(match self.format {
            Format::Json => output::json(&answer),
            Format::Text => answer.text(toss.coin.inertia_ratio()),
        })
    }
}

impl Answer {
    fn new(toss: &Toss, solver: &dyn Solver) -> Result<Self, Failure> {
        let Propagation { state, work, .. } = solver.propagate(toss)?;
        // A closed form knows cos θ better than through the attitude; an integrator need not fly twice.
        let cos_tilt = if solver.method().is_some() { state.attitude.cos_tilt() } else { solver.cos_tilt(toss)? };
        let Work { rhs_calls, accepted_steps, rejected_steps } = work;
        Ok(Self {
            coin: Moments { i1: toss.coin.i1(), i3: toss.coin.i3() },
            flight_time: toss.launch.flight_time(),
            cos_tilt,
            outcome: solver.outcome_at(toss, cos_tilt)?.name(),
            // No solver proves its outcome.
            certified: false,
            attitude: state.attitude.components(),
            solver: solver.name(),
            method: solver.method().map(|method| method.scheme().name()),
            work: WorkCounts { rhs_calls, accepted_steps, rejected_steps },
        })
    }

    fn text(&self, inertia_ratio: f64) -> String {
        let [w, x, y, z] = self.attitude;
        let method = self.method.map(|name| format!(", {name}")).unwrap_or_default();
        let mut lines = vec![
            format!("outcome      {}", self.outcome),
            format!("cos θ        {}", self.cos_tilt),
            format!("flight time  {} s", self.flight_time),
            format!("attitude     w {w:+.9}  x {x:+.9}  y {y:+.9}  z {z:+.9}"),
            format!("coin         I1 {:e} kg m², I3 {:e} kg m², k = {inertia_ratio}", self.coin.i1, self.coin.i3),
            format!("solver       {}{method}", self.solver),
        ];
        if self.method.is_some() {
            let WorkCounts { rhs_calls, accepted_steps, rejected_steps } = self.work;
            lines.push(format!(
                "work         {rhs_calls} right-hand sides, {accepted_steps} steps, {rejected_steps} rejected"
            ));
        }
        lines.join("\n")
    }
}
