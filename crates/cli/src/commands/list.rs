//! The commands `coins`, `solvers`, `models` and `spaces` of `unfair-toss` list the names that the other commands
//! accept. The lists come from the libraries, so that they are complete.

use std::collections::BTreeMap;

use sampling::{Coordinate, DescribedSpace, named_spaces};
use serde::Serialize;
use toss::catalogue::{BODIES, Body, BodyEntry, CATALOGUE, CatalogueEntry, Shape};
use toss::{MODELS, Registry, SolverEntry};

use crate::failure::Failure;
use crate::output::{self, Format, Input, table};

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Output format
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
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
    fn of(entry: &CatalogueEntry) -> Result<Self, Failure> {
        let (mass_g, diameter_mm, thickness_mm) = match entry.body {
            Body::Cylinder { mass_g, diameter_mm, thickness_mm } => {
                (Some(mass_g), Some(diameter_mm), Some(thickness_mm))
            }
            Body::Moments(_) => (None, None, None),
        };
        let coin = entry.coin()?;
        Ok(Self {
            name: entry.name,
            description: entry.description,
            mass_g,
            diameter_mm,
            thickness_mm,
            i1: coin.i1(),
            i2: coin.i1(),
            i3: coin.i3(),
            inertia: None,
            inertia_ratio: Some(coin.inertia_ratio()),
            source: entry.source,
        })
    }

    fn of_body(entry: &BodyEntry) -> Result<Self, Failure> {
        let (mass_g, diameter_mm, thickness_mm) = match entry.shape {
            Shape::Engraved { mass_g, diameter_mm, thickness_mm, .. } => {
                (Some(mass_g), Some(diameter_mm), Some(thickness_mm))
            }
            Shape::Cuboid { mass_g, .. } => (Some(mass_g), None, None),
            Shape::Moments(_) => (None, None, None),
        };
        let body = entry.body()?;
        let [i1, i2, i3] = body.moments().unwrap_or_else(|| body.principal_moments());
        Ok(Self {
            name: entry.name,
            description: entry.description,
            mass_g,
            diameter_mm,
            thickness_mm,
            i1,
            i2,
            i3,
            inertia: body.moments().is_none().then(|| body.inertia()),
            inertia_ratio: None,
            source: entry.source,
        })
    }

    fn row(&self) -> Vec<String> {
        let optional = |value: Option<f64>, digits| value.map_or_else(|| "-".to_owned(), |v| format!("{v:.digits$}"));
        vec![
            self.name.to_owned(),
            optional(self.mass_g, 3),
            optional(self.diameter_mm, 2),
            optional(self.thickness_mm, 2),
            format!("{:.4e}", self.i1),
            format!("{:.4e}", self.i2),
            format!("{:.4e}", self.i3),
            optional(self.inertia_ratio, 4),
            self.description.to_owned(),
        ]
    }
}

pub(crate) fn coins(args: &Args, input: &Input) -> Result<String, Failure> {
    let lines = CATALOGUE.iter().map(CoinLine::of).chain(BODIES.iter().map(CoinLine::of_body));
    let lines = lines.collect::<Result<Vec<_>, _>>()?;
    if args.format == Format::Json {
        return Ok(list(input, "coins", lines));
    }
    let mut rows = vec![row([
        "name",
        "mass/g",
        "diameter/mm",
        "thickness/mm",
        "I1/(kg m²)",
        "I2/(kg m²)",
        "I3/(kg m²)",
        "k",
        "what",
    ])];
    rows.extend(lines.iter().map(CoinLine::row));
    let mut sources: Vec<&str> = lines.iter().map(|line| line.source).collect();
    sources.dedup();
    Ok(format!("{}\n\nsources:\n  {}", table(&rows), sources.join("\n  ")))
}

#[derive(Serialize)]
struct SolverLine<'a> {
    name: &'a str,
    summary: &'a str,
    integrates: bool,
    schemes: Vec<&'a str>,
    formulations: Vec<&'a str>,
}

impl<'a> From<&'a SolverEntry> for SolverLine<'a> {
    fn from(entry: &'a SolverEntry) -> Self {
        let schemes: Vec<&str> = entry.schemes().iter().map(|scheme| scheme.name()).collect();
        Self {
            name: entry.name(),
            summary: entry.summary(),
            integrates: entry.integrates(),
            schemes,
            formulations: entry.formulations().iter().map(|formulation| formulation.name()).collect(),
        }
    }
}

pub(crate) fn solvers(args: &Args, registry: &Registry, input: &Input) -> Result<String, Failure> {
    let lines: Vec<SolverLine<'_>> = registry.entries().iter().map(SolverLine::from).collect();
    if args.format == Format::Json {
        return Ok(list(input, "solvers", lines));
    }
    let mut rows = vec![row(["name", "schemes", "formulations", "what"])];
    rows.extend(lines.iter().map(|line| {
        let [schemes, formulations] = [&line.schemes, &line.formulations]
            .map(|names| if names.is_empty() { "-".to_owned() } else { names.join(", ") });
        row([line.name, &schemes, &formulations, line.summary])
    }));
    Ok(table(&rows))
}

#[derive(Serialize)]
struct ModelLine {
    name: &'static str,
    assumes: &'static str,
    gives: &'static str,
    /// The recorded cost (ns) of a model in closed form.
    cost_ns: Option<f64>,
}

pub(crate) fn models(args: &Args, input: &Input) -> Result<String, Failure> {
    let lines: Vec<ModelLine> = MODELS
        .iter()
        .map(|model| ModelLine {
            name: model.name,
            assumes: model.assumes,
            gives: model.gives,
            cost_ns: model.cost_ns(),
        })
        .collect();
    if args.format == Format::Json {
        return Ok(list(input, "models", lines));
    }
    let mut rows = vec![row(["name", "ns", "gives", "assumes"])];
    rows.extend(lines.iter().map(|line| {
        let cost = line.cost_ns.map_or_else(|| "-".to_owned(), |cost| format!("{cost:.0}"));
        row([line.name, &cost, line.gives, line.assumes])
    }));
    Ok(table(&rows))
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

pub(crate) fn spaces(args: &Args, input: &Input) -> Result<String, Failure> {
    let mut lines = Vec::new();
    for (name, DescribedSpace { description, space }) in named_spaces() {
        let [rate_x, rate_y, rate_z, speed, gravity, tilt] =
            Coordinate::ALL.map(|of| space.axis_or_tie(of).to_string());
        let grid_points = space.grid_points()?;
        lines.push(SpaceLine { name, description, rate_x, rate_y, rate_z, speed, gravity, tilt, grid_points });
    }
    if args.format == Format::Json {
        return Ok(list(input, "spaces", lines));
    }
    let [x, y, z, v, g, t] = Coordinate::ALL.map(Coordinate::symbol);
    let mut rows = vec![row(["name", x, y, z, v, g, t, "launches", "what"])];
    rows.extend(lines.iter().map(|line| {
        let SpaceLine { name, description, rate_x, rate_y, rate_z, speed, gravity, tilt, grid_points } = line;
        row([name, rate_x, rate_y, rate_z, speed, gravity, tilt, &grid_points.to_string(), description])
    }));
    Ok(table(&rows))
}

/// As `{"name":[..],..}`.
fn list(input: &Input, name: &'static str, lines: Vec<impl Serialize>) -> String {
    output::json(input, &BTreeMap::from([(name, lines)]))
}

fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}
