//! `unfair-toss map` computes the probability of heads at the nodes of a grid over two coordinates of a space. The
//! other coordinates are sampled at each node.

use sampling::{Coordinate, Map, Method, Node, Plan, Sampler, Space, first_node, map_nodes};
use toss::defaults::LAUNCHES_OF_A_NODE;
use toss::{InputError, Registry, report};

use crate::chart;
use crate::failure::Failure;
use crate::output::{self, Asked, DataFormat, SeriesArgs};
use crate::quantity::{self, shortest};
use crate::solver_args::SolverArgs;
use crate::space_args::{PlanArgs, SpaceArgs, ThreadArgs, lays_grid, require_few};
use crate::watch::BudgetArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    space: SpaceArgs,
    /// Coordinate along a row: rate_x, rate_y, rate_z, turn, psi, speed, gravity, tilt or drop; its axis needs points
    #[arg(long, value_name = "COORDINATE", default_value = "rate_x")]
    across: String,
    /// Coordinate from row to row, likewise
    #[arg(long, value_name = "COORDINATE", default_value = "rate_z")]
    up: String,
    /// How the launches of a node are chosen
    #[arg(long, value_parser = quantity::method(&Method::ALL), default_value_t = Method::ExactSpeed)]
    method: Method,
    #[command(flatten)]
    plan: PlanArgs,
    #[command(flatten)]
    threads: ThreadArgs,
    #[command(flatten)]
    solver: SolverArgs,
    #[command(flatten)]
    budget: BudgetArgs,
    #[command(flatten)]
    pub(crate) series: SeriesArgs,
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, asked: &Asked) -> Result<String, Failure> {
        self.series.validate()?;
        let space = self.space.space()?;
        let backend = self.solver.backend_of_outcomes(registry)?;
        let axes = [Coordinate::named_in("across", &self.across)?, Coordinate::named_in("up", &self.up)?];
        self.space.require_free_rates(axes)?;
        let nodes = map_nodes(&space, axes)?;
        let node = first_node(&space, axes)?;
        let plan = self.plan.plan(self.method, None, &node, LAUNCHES_OF_A_NODE)?;
        self.space.require_grid_where_points_are(&space, |of| axes.contains(&of) || lays_grid(plan, of))?;
        require_few(&backend.sampler(), nodes.saturating_mul(launches_of(plan, &node)?))?;
        let ask = |sampler: &Sampler<'_>| sampler.map(&space, axes, plan);
        let mapped = self.threads.ask(&asked.watch, backend.sampler(), (nodes, "nodes"), ask)?;
        let data = |format| match format {
            DataFormat::Csv => csv(&mapped),
            DataFormat::Json => output::json(asked, &report::Map::from(&mapped)),
        };
        self.series.answer(data, || Ok(chart::map(&mapped, &space, &self.space.words(&space))?))
    }
}

/// The number of launches of a plan. That of the cells of an enclosure is not known before, and counts as it usually is.
fn launches_of(plan: Plan, space: &Space) -> Result<u64, InputError> {
    const USUAL: u64 = 1 << 18;
    if let Plan::Enclosure { .. } = plan { Ok(USUAL) } else { plan.points(space) }
}

/// Formats the map as CSV with one line per node. Undecided launches have a column if there are any, and a node where no
/// launch is decided has no probability. One that was not computed, because it was time to end, has no line.
fn csv(map: &Map) -> String {
    let ((across, columns), (up, rows)) = (&map.across, &map.up);
    let is_undecided = map.nodes.iter().any(|node| node.undecided > 0);
    let undecided = |what: &str| if is_undecided { format!(",{what}") } else { String::new() };
    let heading = format!("{},{},probability{}\n", across.name(), up.name(), undecided("undecided"));
    let places = rows.iter().flat_map(|row| columns.iter().map(move |column| (column, row)));
    let is_computed = |node: &Node| node.probability.is_some() || node.undecided > 0;
    let lines = places.zip(&map.nodes).filter(|(_, node)| is_computed(node)).map(|((column, row), node)| {
        let probability = node.probability.map_or_else(String::new, shortest);
        let [column, row] = [*column, *row].map(shortest);
        format!("{column},{row},{probability}{}\n", undecided(&node.undecided.to_string()))
    });
    std::iter::once(heading).chain(lines).collect()
}
