//! The commands `coins`, `solvers`, `models` and `spaces` of `unfair-toss` list the names that the other commands
//! accept. The lists come from the libraries, so that they are complete.

use std::collections::BTreeMap;

use sampling::{Coordinate, DescribedSpace, named_spaces};
use serde::Serialize;
use toss::catalogue::{Entry, Shape, entries};
use toss::planner::{MODELS, Model};
use toss::report::Moments;
use toss::{Registry, SolverEntry};

use crate::failure::Failure;
use crate::output::{Asked, FormatArgs, row, table};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    format: FormatArgs,
}

#[derive(Serialize)]
struct CoinLine {
    name: &'static str,
    description: &'static str,
    mass_g: Option<f64>,
    diameter_mm: Option<f64>,
    thickness_mm: Option<f64>,
    i1: f64,
    i2: f64,
    i3: f64,
    /// The tensor of a body whose principal axes are not x, y and z.
    inertia: Option<[f64; 6]>,
    /// Of a coin.
    inertia_ratio: Option<f64>,
    source: &'static str,
}

impl CoinLine {
    fn of(entry: &Entry) -> Result<Self, Failure> {
        let [mass_g, diameter_mm, thickness_mm] = match entry.shape {
            Shape::Cylinder { mass_g, diameter_mm, thickness_mm }
            | Shape::Engraved { mass_g, diameter_mm, thickness_mm, .. } => {
                [mass_g, diameter_mm, thickness_mm].map(Some)
            }
            Shape::Cuboid { mass_g, .. } => [Some(mass_g), None, None],
            Shape::Moments(_) => [None; 3],
        };
        let (body, &Entry { name, description, source, .. }) = (entry.body()?, entry);
        let Moments { i1, i2, i3, inertia } = Moments::from(&body);
        let inertia_ratio = body.coin().map(|coin| coin.inertia_ratio());
        Ok(Self { name, description, mass_g, diameter_mm, thickness_mm, i1, i2, i3, inertia, inertia_ratio, source })
    }

    fn cells(&self) -> [String; 9] {
        let optional = |value: Option<f64>, digits| value.map_or_else(|| "-".to_owned(), |v| format!("{v:.digits$}"));
        let [i1, i2, i3] = [self.i1, self.i2, self.i3].map(|moment| format!("{moment:.4e}"));
        let size = [optional(self.mass_g, 3), optional(self.diameter_mm, 2), optional(self.thickness_mm, 2)];
        let ([mass, diameter, thickness], ratio) = (size, optional(self.inertia_ratio, 4));
        [self.name.to_owned(), mass, diameter, thickness, i1, i2, i3, ratio, self.description.to_owned()]
    }
}

pub(crate) fn coins(args: &Args, asked: &Asked) -> Result<String, Failure> {
    const HEADING: [&str; 9] =
        ["name", "mass/g", "diameter/mm", "thickness/mm", "I1/(kg m²)", "I2/(kg m²)", "I3/(kg m²)", "k", "what"];
    let lines = entries().map(CoinLine::of).collect::<Result<Vec<_>, _>>()?;
    let mut sources: Vec<&str> = lines.iter().map(|line| line.source).collect();
    sources.dedup();
    let sources = format!("\n\nsources:\n  {}", sources.join("\n  "));
    Ok(list(args, asked, ("coins", &lines), HEADING, CoinLine::cells, &sources))
}

#[derive(Serialize)]
struct SolverLine<'a> {
    name: &'a str,
    summary: &'a str,
    integrates: bool,
    schemes: Vec<&'a str>,
    formulations: Vec<&'a str>,
}

pub(crate) fn solvers(args: &Args, registry: &Registry, asked: &Asked) -> String {
    let line = |entry| SolverLine {
        name: SolverEntry::name(entry),
        summary: entry.summary(),
        integrates: entry.integrates(),
        schemes: entry.schemes().iter().map(|scheme| scheme.name()).collect(),
        formulations: entry.formulations().iter().map(|formulation| formulation.name()).collect(),
    };
    let lines: Vec<SolverLine<'_>> = registry.entries().iter().map(line).collect();
    let names = |names: &[&str]| if names.is_empty() { "-".to_owned() } else { names.join(", ") };
    let cells = |line: &SolverLine<'_>| {
        [line.name.to_owned(), names(&line.schemes), names(&line.formulations), line.summary.to_owned()]
    };
    list(args, asked, ("solvers", &lines), ["name", "schemes", "formulations", "what"], cells, "")
}

#[derive(Serialize)]
struct ModelLine {
    name: &'static str,
    assumes: &'static str,
    gives: &'static str,
    /// The recorded cost (ns) of a model in closed form.
    cost_ns: Option<f64>,
}

pub(crate) fn models(args: &Args, asked: &Asked) -> String {
    let line = |model: &Model| ModelLine {
        name: model.name,
        assumes: model.assumes,
        gives: model.gives,
        cost_ns: model.cost_ns(),
    };
    let lines: Vec<ModelLine> = MODELS.iter().map(line).collect();
    let cost = |line: &ModelLine| line.cost_ns.map_or_else(|| "-".to_owned(), |cost| format!("{cost:.0}"));
    let cells = |line: &ModelLine| [line.name.to_owned(), cost(line), line.gives.to_owned(), line.assumes.to_owned()];
    list(args, asked, ("models", &lines), ["name", "ns", "gives", "assumes"], cells, "")
}

#[derive(Serialize)]
struct SpaceLine {
    name: &'static str,
    description: String,
    rate_x: String,
    rate_y: String,
    rate_z: String,
    speed: String,
    gravity: String,
    tilt: String,
    grid_points: u64,
}

pub(crate) fn spaces(args: &Args, asked: &Asked) -> Result<String, Failure> {
    let mut lines = Vec::new();
    for (name, DescribedSpace { description, space }) in named_spaces() {
        let [rate_x, rate_y, rate_z, speed, gravity, tilt] =
            Coordinate::OF_LAUNCH.map(|of| space.axis_or_tie(of).map_or_else(String::new, |axis| axis.to_string()));
        let grid_points = space.grid_points()?;
        lines.push(SpaceLine { name, description, rate_x, rate_y, rate_z, speed, gravity, tilt, grid_points });
    }
    let [x, y, z, v, g, t] = Coordinate::OF_LAUNCH.map(Coordinate::symbol);
    let cells = |line: &SpaceLine| {
        let SpaceLine { name, description, rate_x, rate_y, rate_z, speed, gravity, tilt, grid_points } = line;
        let points = grid_points.to_string();
        [*name, rate_x, rate_y, rate_z, speed, gravity, tilt, &points, description].map(str::to_owned)
    };
    Ok(list(args, asked, ("spaces", &lines), ["name", x, y, z, v, g, t, "launches", "what"], cells, ""))
}

/// The lines as `{"name":[..],..}`, or as a table with its heading and a text below it.
fn list<T: Serialize, const N: usize>(
    args: &Args,
    asked: &Asked,
    (name, lines): (&str, &[T]),
    heading: [&str; N],
    cells: impl Fn(&T) -> [String; N],
    below: &str,
) -> String {
    let rows =
        || std::iter::once(row(heading)).chain(lines.iter().map(|line| cells(line).to_vec())).collect::<Vec<_>>();
    args.format.print(asked, &BTreeMap::from([(name, lines)]), || table(&rows()) + below)
}
