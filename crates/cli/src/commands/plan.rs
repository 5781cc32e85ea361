//! `unfair-toss plan` chooses the cheapest model that answers a question accurately enough, without running it. It also
//! prints which models were passed over, and why.

use std::path::{Path, PathBuf};

use toss::defaults::PLANNED_POINTS;
use toss::planner::{Decision, Integrator, Nanoseconds, WantKind};
use toss::trace::MOST_POINTS;
use toss::{QuaternionSolver, Registry, Scene, Want};

use crate::failure::Failure;
use crate::output::{self, Asked, FormatArgs, row, table};
use crate::quantity;
use crate::space_args::space_called;
use crate::toss_args::TossArgs;
use crate::watch::BudgetArgs;

#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    toss: TossArgs,
    /// What is wanted
    #[arg(long, value_parser = quantity::want(), required_unless_present = "scene")]
    want: Option<WantKind>,
    /// The largest acceptable error: of cos θ, of an attitude (rad) or of a probability
    #[arg(long, value_name = "EPS", allow_hyphen_values = true, required_unless_present = "scene",
          value_parser = quantity::tolerance)]
    accuracy: Option<f64>,
    #[arg(long, value_name = "N", allow_hyphen_values = true,
          value_parser = quantity::count::<usize>(2..=MOST_POINTS as u64),
          help = format!("Number of times in a trace, launch and landing included [default: {PLANNED_POINTS}]"))]
    points: Option<usize>,
    /// A space of launches for a probability, instead of a toss: a name (`spaces` lists them), or a file
    /// that ends in .toml. Options of the coin replace its body
    #[arg(long, value_name = "NAME|FILE.toml",
          conflicts_with_all = ["rate", "turn", "psi", "speed", "time", "gravity", "drop", "tilt", "attitude", "drag", "bounce"])]
    space: Option<String>,
    #[arg(long, value_name = "NAME")]
    solver: Option<String>,
    #[arg(long, value_name = "NAME", alias = "method", requires = "solver")]
    scheme: Option<String>,
    /// Prove the error of --want tilt or attitude by integration: for the solver quaternion with the scheme taylor, which
    /// is then its default
    #[arg(long)]
    prove: bool,
    /// Read the whole question from this file: JSON if its name ends in .json, else TOML
    #[arg(long, value_name = "FILE",
          conflicts_with_all = ["want", "accuracy", "space", "solver", "scheme", "prove", "points", "coin", "cylinder", "moments", "inertia", "rate", "turn", "psi",
                                "speed", "time", "gravity", "drop", "tilt", "attitude", "drag", "bounce"])]
    scene: Option<PathBuf>,
    #[command(flatten)]
    budget: BudgetArgs,
    #[command(flatten)]
    format: FormatArgs,
}

impl Args {
    pub(crate) fn run(&self, registry: &Registry, asked: &Asked) -> Result<String, Failure> {
        let scene = match &self.scene {
            Some(path) => scene_file(path)?,
            None => self.scene()?,
        };
        asked.watch.show(None, "plans");
        let (flown, registry) = (scene.clone(), registry.clone());
        let decision = asked.watch.aside(move || flown.plan_with(&registry))??;
        Ok(self.format.print(asked, &decision, || text(&decision, &scene)))
    }

    fn scene(&self) -> Result<Scene, Failure> {
        let space = || {
            let missing = || Failure::usage("space", "--space is needed for a probability");
            space_called(self.space.as_deref().ok_or_else(missing)?, &self.toss)
        };
        let want = match self.want {
            Some(want) if want != WantKind::Trace && self.points.is_some() => {
                return Err(Failure::usage(
                    "points",
                    "--points is for --want trace; a plan chooses its launches itself",
                ));
            }
            Some(WantKind::Probability) => Want::Probability(space()?),
            _ if self.space.is_some() => {
                return Err(Failure::usage("space", "--space is for --want probability; a toss has --rate"));
            }
            Some(WantKind::Outcome) => Want::Outcome(self.toss.toss()?),
            Some(WantKind::Tilt) => Want::Tilt(self.toss.toss()?),
            Some(WantKind::Attitude) => Want::Attitude(self.toss.toss()?),
            Some(WantKind::Trace) | None => {
                Want::Trace { toss: self.toss.toss()?, points: self.points.unwrap_or(PLANNED_POINTS) }
            }
        };
        let solver = self.solver.clone().or_else(|| self.prove.then(|| QuaternionSolver::NAME.to_owned()));
        let by = solver.map(|solver| Integrator { solver, scheme: self.scheme.clone(), prove: self.prove });
        Ok(Scene { want, accuracy: self.accuracy.unwrap_or(f64::NAN), by })
    }
}

fn scene_file(path: &Path) -> Result<Scene, Failure> {
    let (text, shown) = (output::read("scene", path)?, path.display().to_string());
    let is_json = output::has_ending(&shown, ".json");
    let scene = if is_json { output::from_json(&text) } else { output::from_toml(&text) };
    scene.map_err(|source| Failure::text(&shown, &source))
}

fn text(Decision { choice, passed_over }: &Decision, scene: &Scene) -> String {
    let mut settings = choice.solver().to_owned();
    settings.extend(choice.scheme().or(choice.method()).map(|name| format!(", {name}")));
    settings.extend(choice.tolerance().map(|tolerance| format!(", tolerance {tolerance:.2e}")));
    settings.extend(choice.points.map(|points| format!(", {points} launches")));
    let expected = match (&scene.want, choice.expected_error) {
        // An outcome has no error: it is right, or undecided.
        (Want::Outcome(_), _) if choice.scheme().is_some() => {
            format!("undecided where |cos θ| ≤ {:e}", scene.accuracy)
        }
        (Want::Outcome(_), _) => "proven".to_owned(),
        (_, error) if choice.is_certified() => format!("error at most {}, proven", quantity::rounded_up(error)),
        (_, error) => format!("error {error:.1e}"),
    };
    let mut rows = vec![
        row(["model", choice.model.name, choice.model.gives]),
        row(["solver", &settings, ""]),
        row(["expected", &expected, &format!("in {}", Nanoseconds(choice.expected_cost_ns))]),
    ];
    let heading = std::iter::once("passed over").chain(std::iter::repeat(""));
    let others = passed_over.iter().zip(heading);
    rows.extend(others.map(|((model, why), heading)| row([heading, &model.to_string(), &why.to_string()])));
    table(&rows)
}
