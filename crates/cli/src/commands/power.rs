//! `unfair-toss power` says how many flips it takes to see that coins land more often on the side that had been up, and what a
//! class can see.

use sampling::Power;
use serde::Serialize;

use crate::failure::Failure;
use crate::output::{Asked, FormatArgs, row, table};
use crate::quantity;

/// Flips of each person in the table of people.
const FLIPS: [f64; 6] = [20.0, 100.0, 200.0, 500.0, 1000.0, 5000.0];

/// More people or flips than this are refused.
const MOST: u64 = 1_000_000_000_000;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// The share of landings on the side that had been up that shall be told from 1/2
    #[arg(long, value_name = "P", default_value = "0.508", allow_hyphen_values = true, value_parser = quantity::fraction)]
    share: f64,
    /// Standard deviation of the probability between people; that of 48 people was 0.016
    #[arg(long, value_name = "S", default_value = "0.016", allow_hyphen_values = true, value_parser = quantity::fraction)]
    sd: f64,
    /// How surely the 95 % interval shall leave out 1/2
    #[arg(long, value_name = "P", default_value = "80%", allow_hyphen_values = true, value_parser = quantity::fraction)]
    power: f64,
    /// Number of people
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = quantity::count::<u64>(2..=MOST))]
    people: Option<u64>,
    /// Flips of each person
    #[arg(long, value_name = "M", allow_hyphen_values = true, value_parser = quantity::count::<u64>(1..=MOST))]
    flips: Option<u64>,
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct Answer {
    #[serde(flatten)]
    wanted: Power,
    /// Flips that one hand needs.
    flips_of_one: f64,
    /// The people that are needed for these flips of each.
    needed: Vec<Needed>,
    /// The flips of each that the people need; `None` if no number suffices.
    #[serde(skip_serializing_if = "Option::is_none")]
    flips_needed: Option<Option<f64>>,
    /// The experiment that was given whole.
    #[serde(skip_serializing_if = "Option::is_none")]
    experiment: Option<Experiment>,
}

#[derive(Serialize)]
struct Needed {
    flips: f64,
    people: f64,
}

#[derive(Serialize)]
struct Experiment {
    people: f64,
    flips: f64,
    /// The probability that its interval leaves out ½.
    chance: f64,
    /// The least share that it finds with the wanted power; `None` if it finds none.
    least_share: Option<f64>,
}

impl Args {
    pub(crate) fn run(&self, asked: &Asked) -> Result<String, Failure> {
        let wanted = Power::new(self.share, self.sd, self.power)?;
        #[expect(clippy::cast_precision_loss, reason = "at most 10^12")]
        let [people, flips] = [self.people, self.flips].map(|count| count.map(|count| count as f64));
        let each = flips.map_or(FLIPS.to_vec(), |flips| vec![flips]);
        let needed = each.into_iter().map(|flips| Needed { flips, people: wanted.people(flips) }).collect();
        let experiment = people.zip(flips).map(|(people, flips)| Experiment {
            people,
            flips,
            chance: wanted.chance(people, flips),
            least_share: wanted.least_share(people, flips),
        });
        let flips_needed = people.filter(|_| flips.is_none()).map(|people| wanted.flips(people));
        let answer = Answer { wanted, flips_of_one: wanted.flips_of_one(), needed, flips_needed, experiment };
        Ok(self.format.print(asked, &answer, || self.text(&answer)))
    }

    fn text(&self, answer: &Answer) -> String {
        let Self { share, sd, power, .. } = self;
        let mut lines = vec![
            format!("wanted       {share} told from 1/2 in {} of such experiments", quantity::percent(*power)),
            format!("one hand     {} flips, which say nothing about other hands", answer.flips_of_one),
        ];
        if let (Some(people), Some(flips)) = (self.people, &answer.flips_needed) {
            lines.push(match flips {
                Some(flips) => format!("{people} people    {flips} flips of each"),
                None => format!("{people} people    no number of flips suffices, as people differ by {sd}"),
            });
        }
        if let Some(Experiment { people, flips, chance, least_share }) = &answer.experiment {
            let least = least_share.map_or_else(
                || "it finds no share so surely".to_owned(),
                |least| format!("it finds {least:.3} and more in {}", quantity::percent(*power)),
            );
            lines.push(format!(
                "this class   {people} people with {flips} flips each find {share} in {chance:.1} % of such experiments; {least}",
                chance = 100.0 * chance
            ));
        }
        let rows = answer.needed.iter().map(|Needed { flips, people }| {
            let all = people * flips;
            row([&flips.to_string(), &people.to_string(), &all.to_string()])
        });
        lines.push(table(
            &std::iter::once(row(["flips each", "people", "flips in all"])).chain(rows).collect::<Vec<_>>(),
        ));
        lines.push(format!("people       differ by a standard deviation of {sd}; by Student's interval, while that of inverse --counts finds a little less"));
        lines.join("\n")
    }
}
