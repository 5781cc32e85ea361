//! The options of the commands about many launches: the space, the method that chooses the launches, and the threads.
//! These commands share them, so that an option means the same in each.

use std::path::Path;

use clap::Args;
use dynamics::thrown::{Field, Thrown};
use rayon::ThreadPoolBuilder;
use sampling::{
    Axis, AxisOrTie, Coordinate, DescribedSpace, Method, Plan, Rest, Sampler, Space, named_space, named_spaces,
};
use toss::Error;
use toss::defaults::{LAUNCHES, LAUNCHES_OF_A_NODE, Launches, MOST_OF_BODIES, SEED, Wanted};

use crate::chart::named;
use crate::failure::Failure;
use crate::output;
use crate::quantity;
use crate::toss_args::{self, CoinArgs, Options};
use crate::watch::Watch;

/// Options for a space of launches, which is given by name, as a file, or by its axes.
#[derive(Debug, Args)]
pub(crate) struct SpaceArgs {
    #[command(flatten)]
    pub(crate) coin: CoinArgs,
    /// A named space of launches (`spaces` lists them), or a file that ends in .toml. Options of the coin and --drop replace
    /// what it says, and --spread widens its rates and its speed; the other options of a launch can't be used with it
    #[arg(long, value_name = "NAME|FILE.toml",
          conflicts_with_all = ["rate_x", "rate_y", "rate_z", "turn", "psi", "speed", "gravity", "tilt"])]
    space: Option<String>,
    /// Body rate ωx: VALUE, LO:HI, LO:HI:POINTS, normal:MEAN:SD or normal:MEAN:SD:POINTS; y or z ties it to
    /// that rate
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true, conflicts_with_all = ["turn", "psi"])]
    rate_x: Option<String>,
    /// Body rate ωy, likewise; x for ωy = ωx
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true, conflicts_with_all = ["turn", "psi"])]
    rate_y: Option<String>,
    /// Body rate ωz about the coin's normal, likewise
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true, conflicts_with_all = ["turn", "psi"])]
    rate_z: Option<String>,
    /// Rate |S|/I1 at which the normal n turns about the angular momentum S, likewise; with --psi in place of the body rates
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    turn: Option<String>,
    /// Angle ψ between n and S, from 0 to 180deg, likewise; with --turn. At 90deg the coin turns end over end; below 45deg a
    /// coin that is thrown flat never turns its face over
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    psi: Option<String>,
    /// Upward speed v0 at launch: VALUE, LO:HI or normal:MEAN:SD, each also with :POINTS
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    speed: Option<String>,
    /// Gravity, likewise [default: 9.81]
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    gravity: Option<String>,
    /// Tilt at launch, from horizontal with heads up: a turn about the lab's x axis, likewise. A positive one leans the
    /// normal towards -y [default: 0]
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    tilt: Option<String>,
    /// Height of the launch above the landing, likewise; negative if the coins land higher [default: 0]
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    drop: Option<String>,
    /// A hand: each rate and the speed that has a single value is normal around it, and a turn beside a range of psi, with the standard deviation S times
    /// the value; at most 12%
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = quantity::fraction)]
    spread: Option<f64>,
}

impl SpaceArgs {
    pub(crate) fn space(&self) -> Result<Space, Failure> {
        let space = match &self.space {
            Some(name) => match &self.drop {
                Some(drop) => {
                    space_called(name, &self.coin)?.with_axis(Coordinate::Drop, Axis::parse(Coordinate::Drop, drop)?)?
                }
                None => space_called(name, &self.coin)?,
            },
            None => self.space_of_axes()?,
        };
        Ok(self.spread.map_or(Ok(space), |spread| space.thrown_by_hand(spread))?)
    }

    fn space_of_axes(&self) -> Result<Space, Failure> {
        let body = self.coin.body()?;
        let rate = self.fixed_precession()?.precession(&body)?.map(|rate| {
            // Display writes the fewest digits that read back as the same number.
            Coordinate::ALL.into_iter().zip([rate.x, rate.y, rate.z].map(|rate| rate.to_string())).collect()
        });
        let rate: Vec<(Coordinate, String)> = rate.unwrap_or_default();
        let given: Vec<(Coordinate, &str)> =
            self.texts().filter(|(of, _)| rate.is_empty() || !Coordinate::OF_PRECESSION.contains(of)).collect();
        let given: Vec<_> = rate.iter().map(|(of, text)| (*of, text.as_str())).chain(given).collect();
        if given.is_empty() {
            let message = "a space is needed: --space, or the axes --rate-x, --rate-y, --rate-z and --speed";
            return Err(Failure::usage("space", message));
        }
        Ok(Space::parse(body, &given)?)
    }

    /// The axes that were typed.
    fn texts(&self) -> impl Iterator<Item = (Coordinate, &str)> {
        let Self { rate_x, rate_y, rate_z, speed, gravity, tilt, turn, psi, drop, .. } = self;
        let texts = [rate_x, rate_y, rate_z, speed, gravity, tilt, turn, psi, drop];
        Coordinate::ALL.into_iter().zip(texts).filter_map(|(of, text)| Some((of, text.as_deref()?)))
    }

    /// The turn and ψ, if both have a single value.
    fn fixed_precession(&self) -> Result<Thrown, Failure> {
        let mut thrown = Thrown::default();
        let typed = [(Field::Turn, self.turn.as_deref()), (Field::Psi, self.psi.as_deref())];
        if !typed.iter().any(|(_, text)| text.is_some_and(|text| text.contains([':', '±']))) {
            typed.iter().try_for_each(|(field, text)| text.map_or(Ok(()), |text| thrown.set(*field, text)))?;
        }
        Ok(thrown)
    }

    /// The space in words, for the title of a chart: by its name, or by its body and its axes as they were typed.
    pub(crate) fn words(&self, space: &Space) -> String {
        let drop = self.drop.as_ref().filter(|_| self.space.is_some()).map(|drop| format!("drop {drop}"));
        let spread = self.spread.map(|spread| format!("spread {}", quantity::percent(spread)));
        let launches = [self.words_of_launches(space)].into_iter().chain(drop).chain(spread);
        launches.collect::<Vec<_>>().join(", ")
    }

    fn words_of_launches(&self, space: &Space) -> String {
        if let Some(name) = &self.space {
            let body = self.coin.given_body().is_ok_and(|body| body.is_some());
            return format!("space {name}") + &if body { format!(", {}", named(space.body())) } else { String::new() };
        }
        let rate = self.fixed_precession().ok().and_then(|thrown| toss_args::words_of_rate(&thrown));
        let is_said = |of: &Coordinate| rate.is_some() && Coordinate::OF_PRECESSION.contains(of);
        let typed = self.texts().filter(|(of, _)| !is_said(of)).map(|(of, text)| {
            let symbol = of.symbol().split('/').next().unwrap_or_default();
            format!("{symbol} {text}")
        });
        let axes: Vec<String> = rate.iter().cloned().chain(typed).collect();
        format!("{}: {}", named(space.body()), axes.join(", "))
    }

    /// The rate at which n turns as it was understood, if it was given so.
    pub(crate) fn turn_in_words(&self) -> Option<String> {
        toss_args::turn_in_words(&self.fixed_precession().ok()?)
    }

    /// Refuses a map over a rate that `--turn` and `--psi` fix.
    pub(crate) fn require_free_rates(&self, axes: [Coordinate; 2]) -> Result<(), Failure> {
        let rates = [Coordinate::RateX, Coordinate::RateY, Coordinate::RateZ];
        let is_fixed = self.fixed_precession()?.has(Field::Turn);
        let Some(of) = axes.into_iter().find(|of| is_fixed && rates.contains(of)) else { return Ok(()) };
        let rate = of.name();
        let message = format!(
            "--turn and --psi fix {rate}: a map of it needs --rate-x, --rate-y and --rate-z, with its own as LO:HI:POINTS"
        );
        Err(Failure::usage("turn", message))
    }

    /// Refuses a number of points on an axis of the command line that no grid is laid over. A space with a name has its
    /// points for those commands and methods that lay one.
    pub(crate) fn require_grid_where_points_are(
        &self,
        space: &Space,
        has_grid: impl Fn(Coordinate) -> bool,
    ) -> Result<(), Failure> {
        let own_axis = |of: &Coordinate| matches!(space.axis_or_tie(*of), Some(AxisOrTie::Axis(_)));
        let has_points = |of: &Coordinate| own_axis(of) && space.axis(*of).points().is_some();
        let idle = space.free().find(|of| self.space.is_none() && has_points(of) && !has_grid(*of));
        idle.map_or(Ok(()), |of| {
            let axis = space.axis(of);
            let message =
                format!("{} = '{axis}': the number of points has no effect, no grid is laid over it", of.field());
            Err(Failure::usage(of.field(), message))
        })
    }
}

/// The space with this name or in this file. A coin or body that is given replaces that of the space.
pub(crate) fn space_called<const GROUP: usize>(name: &str, coin: &Options<GROUP>) -> Result<Space, Failure> {
    let body = coin.given_body()?;
    let space = if output::has_ending(name, ".toml") {
        let text = output::read("space", Path::new(name))?;
        let described = DescribedSpace::from_toml(&text);
        described.map_err(|source| Failure::text(name, &source))?.space
    } else if name.contains(['.', '/', '\\']) {
        let known: Vec<&str> = named_spaces().map(|(name, _)| name).collect();
        let known = known.join(", ");
        let message = format!("space = '{name}' can't be used: expected a file that ends in .toml, or one of {known}");
        return Err(Failure::usage("space", message));
    } else {
        named_space(name)?
    };
    Ok(body.map_or(Ok(space), |body| space.with_body(body))?)
}

/// Options for the number and the seed of launches.
#[derive(Debug, Args)]
pub(crate) struct PlanArgs {
    #[arg(long, value_name = "N", allow_hyphen_values = true, value_parser = quantity::count::<u64>(1..=u64::MAX),
          help = help_of_points())]
    points: Option<u64>,
    #[arg(long, value_name = "S", allow_hyphen_values = true, value_parser = quantity::seed,
          help = format!("Seed of the random launches or of the scrambles [default: {SEED}]"))]
    seed: Option<u64>,
}

fn help_of_points() -> String {
    let (Launches { random, sobol }, node) = (LAUNCHES, LAUNCHES_OF_A_NODE.sobol);
    format!(
        "Number of launches [default: {random} for random, {sobol} for sobol, {node} per node of a map, at most \
         {MOST_OF_BODIES} of a body with I1 ≠ I2; exact-speed takes the grid of the other axes if all have points, else as \
         many launches as sobol]"
    )
}

impl PlanArgs {
    /// Refuses a number or a seed of launches without a method that they are for.
    pub(crate) fn require_none(&self) -> Result<(), Failure> {
        match (self.points, self.seed) {
            (Some(_), _) => Err(Failure::usage("points", "--points needs --method; without, --accuracy decides")),
            (None, Some(_)) => {
                Err(Failure::usage("seed", "--seed needs --method; without, the plan has a seed of its own"))
            }
            (None, None) => Ok(()),
        }
    }

    /// The plan for sampling `space`, of `usual` launches if no number is given.
    pub(crate) fn plan(
        &self,
        method: Method,
        accuracy: Option<f64>,
        space: &Space,
        usual: Launches,
    ) -> Result<Plan, Failure> {
        let seed = self.seed.unwrap_or(SEED);
        let plan = Wanted { points: self.points, seed, accuracy, ..Wanted::new(method) }.plan(space, usual);
        self.require_effect(plan, space)?;
        Ok(plan)
    }

    /// Refuses numbers that `plan` has no use for.
    fn require_effect(&self, plan: Plan, space: &Space) -> Result<(), Failure> {
        let why = match plan {
            Plan::Random { .. } | Plan::Sobol(_) | Plan::ExactSpeed(Rest::Sobol(_)) => return Ok(()),
            Plan::ExactSpeed(Rest::Grid) if space.free().all(|of| of == Coordinate::Speed) => {
                "exact-speed needs no sample where at most the speed is free"
            }
            Plan::Enclosure { .. } => "enclosure is of all launches, by as many cells as its accuracy needs",
            Plan::Grid | Plan::ExactSpeed(Rest::Grid) => "a grid takes its points from the axes, LO:HI:POINTS",
        };
        match (self.points, self.seed) {
            (Some(_), _) => Err(Failure::usage("points", format!("--points: {why}"))),
            (None, Some(_)) => Err(Failure::usage("seed", format!("--seed: no launch is drawn at random, {why}"))),
            (None, None) => Ok(()),
        }
    }
}

/// Whether `plan` lays a grid over the coordinate `of`.
pub(crate) fn lays_grid(plan: Plan, of: Coordinate) -> bool {
    match plan {
        Plan::Grid => true,
        Plan::ExactSpeed(Rest::Grid) => of != Coordinate::Speed,
        Plan::Random { .. } | Plan::Sobol(_) | Plan::ExactSpeed(Rest::Sobol(_)) | Plan::Enclosure { .. } => false,
    }
}

/// More launches than this are refused by the exact motion: from hours for its grids to months where the speed is
/// integrated.
const MOST_LAUNCHES: u64 = 10_000_000_000_000;

/// More launches than this are refused by an integrator, which takes some 10 µs for each.
const MOST_INTEGRATED_LAUNCHES: u64 = 1_000_000_000;

/// Refuses `launches` that would take years.
pub(crate) fn require_few(sampler: &Sampler<'_>, launches: u64) -> Result<(), Failure> {
    let (most, by) = match sampler.is_exact() {
        true => (MOST_LAUNCHES, "the exact motion"),
        false => (MOST_INTEGRATED_LAUNCHES, "an integrator"),
    };
    let refused = || format!("{launches} launches would take too long: at most {most} by {by}");
    if launches > most { Err(Failure::usage("points", refused())) } else { Ok(()) }
}

/// The largest number of threads.
const MOST_THREADS: u64 = 1024;

/// Option for the number of threads.
#[derive(Debug, Args)]
pub(crate) struct ThreadArgs {
    /// Number of threads [default: one per core]
    #[arg(long, value_name = "K", allow_hyphen_values = true, value_parser = quantity::count::<usize>(1..=MOST_THREADS))]
    threads: Option<usize>,
}

impl ThreadArgs {
    /// Runs `question` with `sampler` on these threads, under a watch that counts the `number` of `things`.
    pub(crate) fn ask<T: Send>(
        &self,
        watch: &Watch,
        sampler: Sampler<'_>,
        (number, things): (u64, &'static str),
        question: impl FnOnce(&Sampler<'_>) -> Result<T, Error> + Send,
    ) -> Result<T, Failure> {
        require_few(&sampler, number)?;
        watch.show(Some(number), things);
        Ok(self.run(|| watch.ask(sampler, question))??)
    }

    /// Runs `job` on these threads.
    pub(crate) fn run<T: Send>(&self, job: impl FnOnce() -> T + Send) -> Result<T, Failure> {
        let number = self.threads.unwrap_or_else(one_per_core);
        let is_of_a_pool = rayon::current_thread_index().is_some();
        if number == 1 && is_of_a_pool && rayon::current_num_threads() == 1 {
            return Ok(job());
        }
        let builder = ThreadPoolBuilder::new().num_threads(number);
        // One thread is the one that is there.
        let builder = if number == 1 && !is_of_a_pool { builder.use_current_thread() } else { builder };
        let pool = builder.build().map_err(|error| Failure::threads(number, &error))?;
        Ok(pool.install(job))
    }
}

/// The number of cores, or of threads that the environment asks of rayon.
fn one_per_core() -> usize {
    let asked = std::env::var("RAYON_NUM_THREADS").ok().and_then(|number| number.parse().ok());
    asked.filter(|number| *number > 0).unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from))
}
