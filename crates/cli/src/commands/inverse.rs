//! `unfair-toss inverse` computes how to launch a coin so that it lands heads with a wanted probability in long
//! flights. The result is the ratio of the tumbling rate Ω to the spin ωz, and the angle ψ between the normal and the
//! angular momentum.

use crate::failure::Failure;
use crate::output::{FormatArgs, Input};
use crate::quantity;
use crate::toss_args::CoinArgs;
use sampling::{long_flight_cone, rate_ratio};
use serde::Serialize;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    coin: CoinArgs,
    /// Wanted probability of heads in long flights from horizontal, above 1/2 and at most 1
    #[arg(long, value_name = "P", allow_hyphen_values = true, value_parser = quantity::fraction)]
    probability: f64,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Rates {
    probability: f64,
    inertia_ratio: f64,
    /// Ω/ωz.
    rate_ratio: f64,
    /// ψ (rad).
    cone_angle: f64,
}

impl Args {
    pub(crate) fn run(&self, input: &Input) -> Result<String, Failure> {
        let coin = self.coin.coin()?;
        let (probability, k) = (self.probability, coin.inertia_ratio());
        let cone_angle = long_flight_cone(probability)?;
        let answer = Rates { probability, inertia_ratio: k, rate_ratio: rate_ratio(probability, k)?, cone_angle };
        Ok(self.format.print(input, &answer, || answer.text()))
    }
}

impl Rates {
    fn text(&self) -> String {
        let Self { probability, inertia_ratio, rate_ratio, cone_angle } = self;
        [
            format!("P(heads)     {probability}, in the limit of long flights from horizontal"),
            format!("Ω/ωz         {rate_ratio}"),
            format!("ψ            {}°", cone_angle.to_degrees()),
            format!("coin         k = {inertia_ratio}"),
        ]
        .join("\n")
    }
}
