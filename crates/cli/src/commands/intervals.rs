//! `unfair-toss intervals` lists the ranges of launch speed that land heads, for one body rate. A range is where the
//! outcome does not change, so the list shows how precisely a speed has to be met.

use dynamics::quantity::Given;
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use sampling::{Coordinate, Distribution, Space};
use serde::Serialize;
use toss::quantity::Dimension;
use toss::{Coin, ExactMotion, TimeOfFlight, Toss, speeds_of_heads};

use crate::failure::Failure;
use crate::output::{Asked, FormatArgs, row, table};
use crate::quantity::{self, probability, shortest};
use crate::toss_args::{CoinArgs, RateArgs};
use crate::watch::BudgetArgs;

/// The largest number of turns, with one interval each. A longer list would be of no use.
const MOST_TURNS: f64 = 10_000.0;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    coin: CoinArgs,
    #[command(flatten)]
    rate: RateArgs,
    /// Range of launch speeds
    #[arg(long, value_name = "LO:HI", allow_hyphen_values = true)]
    speed: String,
    /// Gravity
    #[arg(long, value_name = "G", allow_hyphen_values = true, default_value_t = DEFAULT_GRAVITY,
          value_parser = quantity::of(Dimension::Acceleration))]
    gravity: f64,
    /// Height of the launch above the landing, negative if the coin lands higher [default: 0]
    #[arg(long, value_name = "H", allow_hyphen_values = true, value_parser = quantity::of(Dimension::Length))]
    drop: Option<f64>,
    /// Tilt at launch, from horizontal with heads up: a turn about the lab's x axis. A positive one leans the normal
    /// towards -y
    #[arg(long, value_name = "B", allow_hyphen_values = true, default_value = "0",
          value_parser = quantity::given(Dimension::Angle))]
    tilt: Given,
    #[command(flatten)]
    budget: BudgetArgs,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Speeds {
    /// The ranges of speed (m/s) in which the toss lands heads.
    heads: Vec<[f64; 2]>,
    /// The share of these ranges in the whole range.
    probability: f64,
}

impl Args {
    pub(crate) fn run(&self, asked: &Asked) -> Result<String, Failure> {
        let body = self.coin.body()?;
        let [slowest, fastest] = speeds(&self.speed)?;
        if slowest == fastest {
            return Err(Failure::usage("speed", "--speed: a range LO:HI of more than one speed is needed"));
        }
        let thrown = |speed: f64| TimeOfFlight::thrown(speed, self.gravity, self.drop);
        // The slowest throw has to reach the landing, too.
        let launch = self.rate.thrown()?.launch(&body, thrown(slowest))?.with_tilt(self.tilt.quantity())?;
        let toss = Toss { body, launch: launch.with_time_of_flight(thrown(fastest))? };
        let phase = ExactMotion::new(&toss).phase(toss.launch.time_of_flight())?;
        if phase > MOST_TURNS * std::f64::consts::TAU {
            let message = format!("the coin turns more than {MOST_TURNS} times; ask for a shorter range");
            return Err(Failure::usage("speed", message));
        }
        asked.watch.show(None, "searches");
        let heads = asked.watch.aside(move || speeds_of_heads(&toss, slowest))??.unwrap_or_default();
        // Folded from 0.0, because `sum` of an empty list is -0.0.
        let length = heads.iter().fold(0.0, |length, [slow, fast]| length + (fast - slow));
        let answer = Speeds { heads, probability: (length / (fastest - slowest)).min(1.0) };
        Ok(self.format.print(asked, &answer, || {
            [answer.text()].into_iter().chain(self.rate.turn_in_words()).collect::<Vec<_>>().join("\n")
        }))
    }
}

/// Parses a range of speeds (m/s) into the slowest and the fastest.
fn speeds(text: &str) -> Result<[f64; 2], Failure> {
    let of_no_turn = Space::builder(Coin::PAPER).rate_x(0.0).rate_y(0.0).rate_z(0.0);
    let axis = of_no_turn.parse(Coordinate::Speed, text)?.build()?.axis(Coordinate::Speed);
    let why = match (axis.distribution(), axis.points()) {
        (Distribution::Uniform { lo, hi }, points) if points.is_none() || lo == hi => return Ok(axis.bounds()),
        (Distribution::Uniform { .. }, _) => "a number of points has no effect, the range is solved as a whole",
        (Distribution::Normal { .. }, _) => {
            "a range LO:HI is needed; `probability --method exact-speed` has the share of a normal distribution"
        }
    };
    Err(Failure::usage("speed", format!("--speed '{text}': {why}")))
}

/// A speed (m/s) to twelve decimal places, or by its digits if it is tiny or huge.
fn speed(speed: f64) -> String {
    if speed == 0.0 || (1e-4..1e16).contains(&speed) { format!("{speed:.12}") } else { shortest(speed) }
}

impl Speeds {
    fn text(&self) -> String {
        let mut rows = vec![row(["from/(m/s)", "to/(m/s)"])];
        rows.extend(self.heads.iter().map(|[slow, fast]| row([&speed(*slow), &speed(*fast)])));
        format!("heads at speeds\n{}\nshare of the range  {}", table(&rows), probability(self.probability, 12))
    }
}
