//! `unfair-toss inverse` computes how to launch a coin so that it lands heads with a wanted probability in long flights, or how
//! coins were thrown that landed so often on the side that had been up. The result is the ratio of the tumbling rate Ω to the spin
//! ωz, and the angle ψ between the normal and the angular momentum.

use std::path::Path;

use dynamics::quantity::read_count;
use sampling::{
    Cone, Counted, CountsError, FEW_PEOPLE, Named, Person, Practice, SameSide, SameSideBias, Spread, long_flight_cone,
    rate_ratio,
};
use serde::Serialize;
use toss::{Coin, InputError};

use crate::chart;
use crate::failure::Failure;
use crate::output::{self, Asked, ChartArgs, Format, FormatArgs, row, table};
use crate::quantity::{self, interval, outwards};
use crate::toss_args::CoinArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    coin: CoinArgs,
    /// Wanted probability of heads in long flights from horizontal, above 1/2 and at most 1
    #[arg(long, value_name = "P", allow_hyphen_values = true, required_unless_present = "counts",
          value_parser = quantity::fraction)]
    probability: Option<f64>,
    /// Coins that landed on the side that had been up, of all tossed; or a file that ends in .csv, with one person per row
    #[arg(long, value_name = "K/N|FILE.csv", allow_hyphen_values = true, conflicts_with = "probability")]
    counts: Option<String>,
    #[command(flatten)]
    chart: ChartArgs,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Rates {
    /// The wanted probability, or the share that was counted.
    probability: f64,
    inertia_ratio: f64,
    /// Ω/ωz; `None` for a mean share of ½ or less, which needs ωz = 0.
    rate_ratio: Option<f64>,
    /// ψ (rad); `None` if no ψ explains the counts.
    cone_angle: Option<f64>,
    #[serde(flatten)]
    counted: Option<Counted>,
}

impl Args {
    pub(crate) fn run(&self, asked: &Asked) -> Result<String, Failure> {
        let coin = self.coin.coin()?;
        self.chart.validate(self.format.format == Format::Json)?;
        if self.chart.is_some() && self.counts.is_none() {
            return Err(Failure::usage("svg", "--svg draws the counts of people: it needs --counts"));
        }
        let rates = match (&self.counts, self.probability) {
            (Some(counts), _) => Rates::counted(coin, &people(counts)?)?,
            (None, wanted) => Rates::wanted(coin, wanted.unwrap_or(f64::NAN))?,
        };
        let is_of_a_coin = self.coin.given_body()?.is_some();
        let print = || self.format.print(asked, &rates, || rates.text(is_of_a_coin));
        Ok(self.chart.drawn(|| rates.drawn())?.unwrap_or_else(print))
    }
}

/// The people of `K/N` or of a file.
fn people(text: &str) -> Result<Vec<Named>, Failure> {
    const EXPECTED: &str = "K/N with whole numbers, such as 178078/350757, or a file that ends in .csv";
    if output::has_ending(text, ".csv") {
        return in_file(Path::new(text));
    }
    let unreadable = || InputError::unreadable("counts", text, EXPECTED);
    let (same, tosses) = text.split_once('/').ok_or_else(unreadable)?;
    let numbers = read_count(same).zip(read_count(tosses));
    let (same, tosses) = numbers.ok_or_else(unreadable)?;
    let counts = SameSide::new(same, tosses).map_err(|source| Failure::value("counts", source))?;
    Ok(vec![Named { name: "1".to_owned(), counts, landings: None }])
}

fn in_file(path: &Path) -> Result<Vec<Named>, Failure> {
    let bytes = output::read_bytes("counts", path)?;
    let path = || path.display().to_string();
    sampling::people(&bytes).map_err(|wrong| match wrong {
        CountsError::Table(error) => Failure::table(&path(), error),
        CountsError::Cell { line, column, source } => Failure::row(&path(), [line, column as u64], &source),
    })
}

impl Rates {
    fn wanted(coin: Coin, probability: f64) -> Result<Self, Failure> {
        let (cone_angle, inertia_ratio) = (Some(long_flight_cone(probability)?), coin.inertia_ratio());
        let rate_ratio = Some(rate_ratio(probability, inertia_ratio)?);
        Ok(Self { probability, inertia_ratio, rate_ratio, cone_angle, counted: None })
    }

    fn counted(coin: Coin, people: &[Named]) -> Result<Self, Failure> {
        let counted = Counted::of(people).map_err(|source| Failure::value("counts", source))?;
        let (found, inertia_ratio) = (&counted.found, coin.inertia_ratio());
        let rate_ratio = (found.mean > 0.5).then(|| rate_ratio(found.mean, inertia_ratio)).transpose()?;
        let (probability, cone_angle) = (found.share, found.cone.map(|cone| cone.angle));
        Ok(Self { probability, inertia_ratio, rate_ratio, cone_angle, counted: Some(counted) })
    }

    /// The forest plot of the counts.
    fn drawn(&self) -> Result<String, Failure> {
        let counted = self.counted.as_ref().ok_or_else(|| Failure::usage("svg", "--svg needs --counts"))?;
        if counted.people.len() > chart::MOST_PEOPLE {
            let (people, most) = (counted.people.len(), chart::MOST_PEOPLE);
            return Err(Failure::usage("svg", format!("--svg: a picture of {people} people: at most {most}")));
        }
        let rows: Vec<_> =
            counted.people.iter().map(|person| (person.person.as_str(), person.counts, person.interval)).collect();
        Ok(chart::people(&counted.found, &rows)?)
    }

    /// `is_of_a_coin`: whether the coin was given. ψ is the same for all coins, the ratio of the rates is not.
    fn text(&self, is_of_a_coin: bool) -> String {
        let Self { probability, inertia_ratio, .. } = self;
        let ratio = self.rate_ratio.map(|ratio| format!("Ω/ωz         {ratio}"));
        let coin = format!("coin         k = {inertia_ratio}");
        let Some(counted) = &self.counted else {
            let wanted = format!("P(heads)     {probability}, in the limit of long flights from horizontal");
            let angle = self.cone_angle.map(|angle| format!("ψ            {}°", angle.to_degrees()));
            return [Some(wanted), ratio, angle, Some(coin)].into_iter().flatten().collect::<Vec<_>>().join("\n");
        };
        let SameSideBias { counts, .. } = &counted.found;
        let mut lines = vec![format!("same side    {} of {}, {probability:.6}", counts.same(), counts.tosses())];
        let shown = Shown(counted);
        lines.extend(shown.shares());
        lines.push(format!("ψ            {}", angle(&counted.found)));
        lines.extend(ratio.filter(|_| is_of_a_coin).map(|ratio| [ratio, coin]).into_iter().flatten());
        lines.push(
            "assumed      independent flips; long flights from horizontal, all with this ψ; 180° - ψ explains them as well"
                .to_owned(),
        );
        lines.extend(shown.notes());
        lines.extend(shown.table());
        lines.join("\n")
    }
}

/// ψ with its interval. At a share of ½ or less it is 90°, and at 1 any angle up to 45° serves.
fn angle(&SameSideBias { cone, mean, interval, .. }: &SameSideBias) -> String {
    let Some(Cone { angle, interval: ends }) = cone else {
        return "none: no ψ explains this, as the whole interval is below 1/2".to_owned();
    };
    let angle = angle.to_degrees();
    let [least, most] = ends_in_degrees(ends);
    match mean {
        share if share < 0.5 => format!("from {least}° to {most}°; none explains a share below 1/2"),
        share if share >= 1.0 => format!("any up to {angle:.2}°, and with the interval up to {most}°"),
        _ if interval.lo <= 0.5 => {
            format!("{angle:.2}°, from {least}° to {most}°, as a share of 1/2 is possible")
        }
        _ => format!("{angle:.2}°, from {least}° to {most}°"),
    }
}

fn p_value_of(p_value: f64) -> String {
    if p_value < 1e-3 { format!("{p_value:.0e}") } else { format!("{p_value:.3}") }
}

/// The ends of an interval of ψ, rounded outwards.
fn ends_in_degrees([least, most]: [f64; 2]) -> [String; 2] {
    [outwards(least.to_degrees(), 2, false), outwards(most.to_degrees(), 2, true)]
}

/// What is printed of counts.
struct Shown<'a>(&'a Counted);

impl Shown<'_> {
    /// The lines about the shares of these people, of all, and of a further one.
    fn shares(&self) -> Vec<String> {
        let SameSideBias { these_flips, mean, interval: whole, interval_kind, spread, next_person, .. } = &self.0.found;
        let number = self.0.people.len();
        if number == 0 {
            let alone = format!("interval     {} ({interval_kind})", interval(*whole, 6));
            return std::iter::once(alone).chain(self.practice()).collect();
        }
        let spread = spread.map_or_else(
            || "not known, as all landings are the same".to_owned(),
            |Spread { sd, interval: ends, p_value, .. }| {
                let (ends, p_value) = (interval(ends, 4), p_value_of(p_value));
                format!("{sd:.4} between people, from {ends} (95 %); if all are alike, p = {p_value}")
            },
        );
        let mut lines = vec![
            format!(
                "these flips  {} (clopper-pearson 95 %: the mean of these {number} people, by their flips)",
                interval(*these_flips, 6)
            ),
            format!(
                "all people   {mean:.6}, from {} (beta-binomial 95 %: the mean over people, of whom these \
                 {number} are a sample)",
                interval(*whole, 6)
            ),
            format!("spread       {spread}"),
        ];
        lines.extend(next_person.map(|ends| format!("next person  from {} (95 %)", interval(ends, 3))));
        lines.extend(self.practice());
        lines
    }

    /// The change from the earlier half of each person's flips to the later, if their order is known.
    fn practice(&self) -> Option<String> {
        let Practice { change, interval: ends, p_value } = self.0.practice?;
        let (ends, p_value) = (interval(ends, 4), p_value_of(p_value));
        Some(format!(
            "practice     {change:+.4} from the earlier half of each one's flips to the later, from {ends} (95 %); if nobody \
             changes, p = {p_value}"
        ))
    }

    fn notes(&self) -> Vec<String> {
        let number = self.0.people.len();
        let few = format!("note         {number} people say little about others");
        let (are, absent) = (if self.0.absent == 1 { "person is" } else { "people are" }, self.0.absent);
        let absent = format!("note         {absent} {are} passed over, without a toss");
        let said = [(self.0.absent > 0, absent), ((2..FEW_PEOPLE).contains(&number), few)];
        said.into_iter().filter_map(|(is_so, note)| is_so.then_some(note)).collect()
    }

    /// Each of several people alone.
    fn table(&self) -> Vec<String> {
        if self.0.people.is_empty() {
            return Vec::new();
        }
        let heading = row(["person", "same", "tosses", "share", "ψ/°", "from", "to"]);
        let rows = std::iter::once(heading).chain(self.0.people.iter().map(cells));
        let mut lines = vec![table(&rows.collect::<Vec<_>>())];
        if self.0.people.iter().any(|person| person.cone_angle.is_none()) {
            lines.push(
                "-            the whole interval of this person's share is below 1/2, which no ψ explains".to_owned(),
            );
        }
        lines.push("from, to     95 % of this person alone; by chance, one row in 20 misses".to_owned());
        lines
    }
}

/// A person as a row of the table.
fn cells(one: &Person) -> Vec<String> {
    let degrees =
        |angle: Option<f64>| angle.map_or_else(|| "-".to_owned(), |angle| format!("{:.2}", angle.to_degrees()));
    let none = || ["-", "-"].map(str::to_owned);
    let [least, most] = one.cone_angle_interval.map_or_else(none, ends_in_degrees);
    let [same, tosses] = [one.counts.same(), one.counts.tosses()].map(|count| count.to_string());
    let share = format!("{:.6}", one.probability);
    row([&one.person, &same, &tosses, &share, &degrees(one.cone_angle), &least, &most])
}
