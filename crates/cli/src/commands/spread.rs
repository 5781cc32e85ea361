//! `unfair-toss spread` finds how precise a hand must be for a wanted probability of heads. It prints the largest
//! relative spread of the launch with which heads is still as probable, and that of each input alone, and says how finely
//! smaller spreads were looked at.

use sampling::{LARGEST_SPREAD, LargestSpread, RESOLUTION, SMALLEST_SPREAD, Sampler, Space, Spreads, SufficientSpread};
use toss::Outcome;
use toss::defaults::SEED;

use crate::failure::Failure;
use crate::output::{Asked, FormatArgs};
use crate::quantity;
use crate::space_args::ThreadArgs;
use crate::toss_args::TossArgs;
use crate::watch::BudgetArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    toss: TossArgs,
    /// Wanted probability of heads, such as 0.95 or 95%
    #[arg(long, value_name = "P", allow_hyphen_values = true, value_parser = quantity::fraction)]
    heads: f64,
    /// Number of launches of each estimate, a multiple of 8 [default: 16384, and 2048 for a body with I1 ≠ I2]
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = quantity::count::<u64>(8..=1 << 24))]
    points: Option<u64>,
    /// Seed of the scrambles
    #[arg(long, value_name = "S", default_value_t = SEED, allow_hyphen_values = true, value_parser = quantity::seed)]
    seed: u64,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    budget: BudgetArgs,
    #[command(flatten)]
    format: FormatArgs,
}

impl Args {
    pub(crate) fn run(&self, asked: &Asked) -> Result<String, Failure> {
        let space = Space::of(&self.toss.toss()?)?;
        let spreads = {
            asked.watch.show(None, "spreads");
            let answers = |sampler: &Sampler<'_>| sampler.spreads(&space, self.heads, self.points, self.seed);
            self.threads.run(|| asked.watch.ask(Sampler::exact(), answers))??
        };
        Ok(self.format.print(asked, &spreads, || {
            let lines = text(self.heads, &spreads);
            lines.into_iter().chain(self.toss.turn_in_words()).collect::<Vec<_>>().join("\n")
        }))
    }
}

fn text(heads: f64, Spreads { together, alone, .. }: &Spreads) -> Vec<String> {
    let mut lines = vec![format!("spread       {}", in_words(together))];
    if let Some(SufficientSpread { estimate, looks, at_least, .. }) = together.sufficient() {
        lines.push(format!("P(heads)     {} at this spread", quantity::probability(estimate.probability, 6)));
        let interval = estimate.interval.map(|interval| quantity::interval(interval, 6) + " ");
        lines.push(format!("interval     {}({})", interval.unwrap_or_default(), estimate.interval_kind));
        let (shown, from) = ((at_least * 1e6).floor() / 1e6, 100.0 * SMALLEST_SPREAD);
        lines
            .push(format!("looked at    {looks} spreads from {from:.0e} % on, with P(heads) >= {shown:.6} in between"));
        let enough = heads - RESOLUTION.min(0.1 * (1.0 - heads));
        if estimate.interval.is_some_and(|interval| interval.lo < enough) {
            lines.push(
                "note         the interval reaches lower: it takes more --points to show P(heads) so near to 1"
                    .to_owned(),
            );
        }
        let each = alone.iter().zip(["ωx", "ωy", "ωz", "v0"]);
        let each: Vec<String> = each.map(|(one, name)| format!("{name} {}", in_short(&one.found))).collect();
        lines.push(format!("each alone   {}", each.join(", ")));
        let assumed = "independent normal inputs, with the standard deviation spread·|value|";
        lines.push(format!("assumed      {assumed}"));
    }
    lines
}

fn in_words(found: &LargestSpread) -> String {
    match found {
        LargestSpread::UpTo(..) => format!("{} of each rate and of the speed", in_short(found)),
        LargestSpread::AtLeast(_) => {
            format!("{} of each rate and of the speed; the search ended there, by its budget", in_short(found))
        }
        LargestSpread::Any(_) => format!("any up to {:.0} %, the largest that is tried", 100.0 * LARGEST_SPREAD),
        LargestSpread::TossIsNotHeads(Outcome::Undecided) => {
            "none is small enough: whether the toss itself lands heads is undecided".to_owned()
        }
        LargestSpread::TossIsNotHeads(landing) => {
            format!("none is small enough: the toss itself lands {landing}, and P(heads) goes to 0 with the spread")
        }
        LargestSpread::BelowSmallest(_) => {
            format!("below {SMALLEST_SPREAD:e}, the smallest that is tried: the toss lands next to tails")
        }
    }
}

/// The spread in percent, to three digits.
fn in_short(found: &LargestSpread) -> String {
    match (found, found.sufficient()) {
        (LargestSpread::Any(_), _) => "any".to_owned(),
        (_, Some(sufficient)) => {
            // To three digits, before the point is moved: so it is rounded once.
            let spread = format!("{:.2e}", sufficient.spread).parse().unwrap_or(sufficient.spread);
            let percent = quantity::in_percent(spread);
            let at_least = if matches!(found, LargestSpread::AtLeast(_)) { "at least " } else { "" };
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 12")]
            let digits = (2.0 - percent.log10().floor()).clamp(0.0, 12.0) as usize;
            format!("{at_least}{percent:.digits$} %")
        }
        _ => format!("below {:.0e} %", 100.0 * SMALLEST_SPREAD),
    }
}
