//! `unfair-toss inverse` computes how to launch a coin so that it lands heads with a wanted probability in long flights, or how
//! coins wobbled that landed so often on the side that had been up. The result is the ratio of the tumbling rate Ω to the spin
//! ωz, and the angle ψ between the normal and the angular momentum.

use std::path::Path;

use dynamics::quantity::read_count;
use sampling::{SameSide, Wobble, long_flight_cone, rate_ratio};
use serde::Serialize;
use toss::{Coin, InputError};

use crate::failure::Failure;
use crate::output::{self, FormatArgs, Input, row, table};
use crate::quantity;
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
    format: FormatArgs,
}

#[derive(Serialize)]
struct Rates {
    /// The wanted probability, or the share that was counted.
    probability: f64,
    inertia_ratio: f64,
    /// Ω/ωz; `None` for a share of ½ or less, which needs ωz = 0.
    rate_ratio: Option<f64>,
    /// ψ (rad).
    cone_angle: f64,
    #[serde(flatten)]
    counted: Option<Counted>,
}

/// What is known of a wobble that was found from counts.
#[derive(Serialize)]
struct Counted {
    same: u64,
    tosses: u64,
    interval: [f64; 2],
    interval_kind: String,
    /// The smallest and the largest ψ (rad).
    cone_angle_interval: [f64; 2],
    people: Vec<Person>,
}

/// A person of several, alone.
#[derive(Serialize)]
struct Person {
    same: u64,
    tosses: u64,
    probability: f64,
    /// ψ and its interval (rad); `None` if no wobble explains the counts.
    cone_angle: Option<f64>,
    cone_angle_interval: Option<[f64; 2]>,
}

impl Args {
    pub(crate) fn run(&self, input: &Input) -> Result<String, Failure> {
        let coin = self.coin.coin()?;
        let rates = match (&self.counts, self.probability) {
            (Some(counts), _) => Rates::counted(coin, &people(counts)?)?,
            (None, wanted) => Rates::wanted(coin, wanted.unwrap_or(f64::NAN))?,
        };
        let is_of_a_coin = self.coin.given()?.is_some();
        Ok(self.format.print(input, &rates, || rates.text(is_of_a_coin)))
    }
}

/// The people of `K/N` or of a file.
fn people(text: &str) -> Result<Vec<SameSide>, Failure> {
    const EXPECTED: &str = "K/N with whole numbers, such as 178078/350757, or a file that ends in .csv";
    if text.ends_with(".csv") {
        return read(Path::new(text));
    }
    let unreadable = || InputError::unreadable("counts", text, EXPECTED);
    let (same, tosses) = text.split_once('/').ok_or_else(unreadable)?;
    let numbers = read_count(same).zip(read_count(tosses));
    let (same, tosses) = numbers.ok_or_else(unreadable)?;
    let person = SameSide::new(same, tosses).map_err(|source| Failure::value("counts", source))?;
    Ok(vec![person])
}

/// The people in a file, one a row, in the columns `same` and `tosses`; others are passed over.
fn read(path: &Path) -> Result<Vec<SameSide>, Failure> {
    let text = output::read("counts", path)?;
    let at = |line: u64, source: InputError| Failure::Row { path: path.display().to_string(), line, source };
    let unreadable = |error: &csv::Error| {
        let line = error.position().map_or(1, csv::Position::line);
        at(line, InputError::Malformed { field: "counts", value: error.to_string(), expected: "a table of CSV" })
    };
    let mut table = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let heading = table.headers().map_err(|error| unreadable(&error))?.clone();
    let place = |field: &'static str| {
        let missing = InputError::Missing { field, expected: "the columns same and tosses in the heading" };
        heading.iter().position(|name| name == field).ok_or_else(|| at(1, missing))
    };
    let places = [("same", place("same")?), ("tosses", place("tosses")?)];
    let person = |record: Result<csv::StringRecord, csv::Error>| {
        let record = record.map_err(|error| unreadable(&error))?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |(field, place): (&'static str, usize)| {
            let cell = record.get(place).unwrap_or_default();
            let malformed = || InputError::unreadable(field, cell, "a whole number, such as 1000");
            read_count(cell).ok_or_else(malformed).map_err(|source| at(line, source))
        };
        let [same, tosses] = places;
        SameSide::new(number(same)?, number(tosses)?).map_err(|source| at(line, source))
    };
    let people = table.into_records().map(person).collect::<Result<Vec<_>, _>>()?;
    let nobody = InputError::Missing { field: "counts", expected: "a person in a row below the heading" };
    if people.is_empty() { Err(at(1, nobody)) } else { Ok(people) }
}

impl Rates {
    fn wanted(coin: Coin, probability: f64) -> Result<Self, Failure> {
        let (cone_angle, inertia_ratio) = (long_flight_cone(probability)?, coin.inertia_ratio());
        let rate_ratio = Some(rate_ratio(probability, inertia_ratio)?);
        Ok(Self { probability, inertia_ratio, rate_ratio, cone_angle, counted: None })
    }

    fn counted(coin: Coin, people: &[SameSide]) -> Result<Self, Failure> {
        let found = Wobble::of(people).map_err(|source| Failure::value("counts", source))?;
        let inertia_ratio = coin.inertia_ratio();
        let rate_ratio = (found.share > 0.5).then(|| rate_ratio(found.share, inertia_ratio)).transpose()?;
        let counted = Counted {
            same: found.counts.same(),
            tosses: found.counts.tosses(),
            interval: [found.interval.lo, found.interval.hi],
            interval_kind: found.interval_kind,
            cone_angle_interval: found.angles,
            people: if people.len() > 1 { people.iter().map(Person::new).collect() } else { Vec::new() },
        };
        let (probability, cone_angle) = (found.share, found.angle);
        Ok(Self { probability, inertia_ratio, rate_ratio, cone_angle, counted: Some(counted) })
    }

    /// `is_of_a_coin`: whether the coin was given. ψ is the same for all coins, the ratio of the rates is not.
    fn text(&self, is_of_a_coin: bool) -> String {
        let Self { probability, inertia_ratio, cone_angle, .. } = self;
        let ratio = self.rate_ratio.map(|ratio| format!("Ω/ωz         {ratio}"));
        let coin = format!("coin         k = {inertia_ratio}");
        let Some(counted) = &self.counted else {
            let wanted = format!("P(heads)     {probability}, in the limit of long flights from horizontal");
            let angle = format!("ψ            {}°", cone_angle.to_degrees());
            return [Some(wanted), ratio, Some(angle), Some(coin)].into_iter().flatten().collect::<Vec<_>>().join("\n");
        };
        let Counted { same, tosses, interval: [lo, hi], interval_kind, .. } = counted;
        let mut lines = vec![
            format!("same side    {same} of {tosses}, {probability:.6}"),
            format!("interval     {lo:.6} to {hi:.6} ({interval_kind})"),
            format!("ψ            {}", self.angle(counted)),
        ];
        lines.extend(ratio.filter(|_| is_of_a_coin).map(|ratio| [ratio, coin]).into_iter().flatten());
        lines.push(
            "assumed      long flights from horizontal, all with this ψ; 180° - ψ explains them as well".to_owned(),
        );
        if !counted.people.is_empty() {
            let heading = row(["person", "same", "tosses", "share", "ψ/°", "from", "to"]);
            let people = counted.people.iter().zip(1..).map(|(person, number)| person.cells(number));
            lines.push(table(&std::iter::once(heading).chain(people).collect::<Vec<_>>()));
        }
        if counted.people.iter().any(|person| person.cone_angle.is_none()) {
            lines.push(
                "-            the whole interval of this person's share is below 1/2, which no ψ explains".to_owned(),
            );
        }
        lines.join("\n")
    }

    /// ψ with its interval. At a share of ½ or less it is 90°, and at 1 any angle up to 45° serves.
    fn angle(&self, Counted { cone_angle_interval, interval: [lo, _], .. }: &Counted) -> String {
        let angle = self.cone_angle.to_degrees();
        let [least, most] = cone_angle_interval.map(f64::to_degrees);
        match self.probability {
            share if share <= 0.5 => format!("from {least:.2}° to {most:.2}°; none explains a share below 1/2"),
            share if share >= 1.0 => format!("any up to {angle:.2}°, and with the interval up to {most:.2}°"),
            _ if *lo <= 0.5 => format!("{angle:.2}°, from {least:.2}° to {most:.2}°, as a share of 1/2 is possible"),
            _ => format!("{angle:.2}°, from {least:.2}° to {most:.2}°"),
        }
    }
}

impl Person {
    fn new(counts: &SameSide) -> Self {
        let found = Wobble::of(&[*counts]).ok();
        #[expect(clippy::cast_precision_loss, reason = "nobody tosses 2^53 coins")]
        let probability = counts.same() as f64 / counts.tosses() as f64;
        Self {
            same: counts.same(),
            tosses: counts.tosses(),
            probability,
            cone_angle: found.as_ref().map(|found| found.angle),
            cone_angle_interval: found.map(|found| found.angles),
        }
    }

    fn cells(&self, number: usize) -> Vec<String> {
        let degrees =
            |angle: Option<f64>| angle.map_or_else(|| "-".to_owned(), |angle| format!("{:.2}", angle.to_degrees()));
        let [least, most] = [0, 1].map(|end| degrees(self.cone_angle_interval.map(|angles| angles[end])));
        let (share, counts) =
            (format!("{:.6}", self.probability), [self.same, self.tosses].map(|count| count.to_string()));
        row([&number.to_string(), &counts[0], &counts[1], &share, &degrees(self.cone_angle), &least, &most])
    }
}
