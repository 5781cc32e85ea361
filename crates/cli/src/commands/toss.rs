//! `unfair-toss toss`: one toss, one answer.

use toss::report::{Landing, Moments};
use toss::{Body, Margin, Registry, Sensitivity, TimeOfFlight, Toss, Work};

use crate::failure::Failure;
use crate::output::{Asked, FormatArgs, fixed};
use crate::quantity::{rounded_up, shortest};
use crate::toss_args::FlightArgs;
use crate::watch::BudgetArgs;

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
    #[command(flatten)]
    budget: BudgetArgs,
    #[command(flatten)]
    format: FormatArgs,
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, asked: &Asked) -> Result<String, Failure> {
        let (toss, landing) = if self.prove {
            let (toss, solver) = (self.flight.toss.toss()?, self.flight.solver.prover(registry)?);
            (toss, Landing::integrated(&toss, &solver)?)
        } else {
            let (toss, backend) = self.flight.parts(registry)?;
            (toss, Landing::new(&toss, &backend)?)
        };
        let landing = if toss.body.coin().is_some() {
            landing.with_margin(&toss)?
        } else if self.margin {
            asked.watch.show(None, "margins");
            let searched = landing.clone();
            // Out of time, the answer is the one without a margin.
            asked.watch.aside(move || searched.with_margin(&toss)).unwrap_or(Ok(landing))?
        } else {
            landing
        };
        let landing = landing.with_sensitivity(&toss)?.rounded(&toss, &self.flight.toss.rounding()?)?;
        Ok(self.format.print(asked, &landing, || text(&landing, &toss, self.flight.toss.turn_in_words())))
    }
}

fn text(landing: &Landing, toss: &Toss, turn: Option<String>) -> String {
    let [w, x, y, z] = landing.attitude.map(|part| fixed(part, 9));
    let scheme = landing.scheme.map(|name| format!(", {name}")).unwrap_or_default();
    let mut lines = vec![
        format!("outcome      {}{}", landing.outcome, landing.remark),
        changes(landing, toss.launch.time_of_flight()),
        format!("cos θ        {}", shortest(landing.cos_tilt)),
        format!("flight time  {} s", shortest(landing.flight_time)),
    ];
    lines.extend(turn);
    lines.extend([
        format!("attitude     w {w}  x {x}  y {y}  z {z}"),
        moments(&landing.coin, &toss.body),
        format!("solver       {}{scheme}", landing.solver),
    ]);
    if let (Some(cos_tilt), Some(attitude)) = (landing.error_bound, landing.attitude_error_bound) {
        lines.push(format!(
            "error bound  {} of cos θ, {} of the attitude's quaternion",
            rounded_up(cos_tilt),
            rounded_up(attitude)
        ));
    }
    // Where it can be seen in the attitude.
    if let Some(turn) = landing.unit_error.flatten().filter(|turn| *turn > 1e-10) {
        lines
            .push(format!("unit error   at most {} rad of the attitude, by the conversion of units", rounded_up(turn)));
    }
    if landing.norm_error > 0.0 {
        lines.push(format!("norm error   {:.1e}, the loss of norm of the quaternion", landing.norm_error));
    }
    if landing.scheme.is_some() {
        let Work { rhs_calls, accepted_steps, rejected_steps } = landing.work;
        lines.push(format!(
            "work         {rhs_calls} right-hand sides, {accepted_steps} steps, {rejected_steps} rejected"
        ));
    }
    lines.join("\n")
}

fn moments(Moments { i1, i2, i3, inertia }: &Moments, body: &Body) -> String {
    match (body.coin(), inertia) {
        (Some(coin), _) => {
            format!("coin         I1 {i1:e} kg m², I3 {i3:e} kg m², k = {}", shortest(coin.inertia_ratio()))
        }
        (None, None) => format!("body         I1 {i1:e} kg m², I2 {i2:e} kg m², I3 {i3:e} kg m²"),
        (None, Some(_)) => format!("body         principal moments {i1:e}, {i2:e} and {i3:e} kg m²"),
    }
}

/// What a change of the launch does: the margin, or the sensitivity where it was not searched.
fn changes(landing: &Landing, flight: TimeOfFlight) -> String {
    let slopes = |found: &Sensitivity| {
        let [x, y, z, time] = <[f64; 4]>::from(found.cos_tilt).map(digits);
        format!("sensitivity  cos θ by {x} per rad/s in ωx, {y} in ωy, {z} in ωz,\n             {time} per s in time")
    };
    let margin = landing.margin.as_ref().map(|found| format!("margin       {}", margin(found, flight)));
    let unknown = || "sensitivity  beyond the range of numbers".to_owned();
    margin.or_else(|| landing.sensitivity.as_ref().map(slopes)).unwrap_or_else(unknown)
}

/// In two lines, which the column of the answers fits.
fn margin(margin: &Margin, flight: TimeOfFlight) -> String {
    let nowhere = [margin.time, margin.speed, margin.gravity].iter().all(Option::is_none);
    let searched = margin.time_range.filter(|[_, later]| nowhere && later.is_finite());
    let searched = searched.map(|[earlier, later]| format!(" from -{} s to +{} s", short(earlier), short(later)));
    let searched = searched.unwrap_or_default();
    let change = |value: Option<f64>, unit: &str, name: &str| match value {
        Some(value) => format!("{} {unit} in {name}", digits(value)),
        None => format!("none in {name}"),
    };
    let rates = ["ωx", "ωy", "ωz"].iter().zip(margin.rate).zip(margin.rate_range).map(|((name, value), range)| {
        let within = if value.is_none() { format!(" within ±{} rad/s", short(range)) } else { String::new() };
        change(value, "rad/s", name) + &within
    });
    let rates: Vec<String> = rates.collect();
    let tilt = change(margin.tilt, "rad", "tilt");
    let rest = if let TimeOfFlight::Given(_) = flight {
        format!("{}{searched}, {tilt}", change(margin.time, "s", "the time of flight"))
    } else {
        format!("{}, {}{searched}, {tilt}", change(margin.speed, "m/s", "v0"), change(margin.gravity, "m/s²", "g"))
    };
    format!("{rest},\n             {}", rates.join(", "))
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
