//! A [`Context`] holds what all checks of a run share: the subjects, the reference data, and results that several
//! checks read. Each result is computed when the first check asks for it, so a run of one check computes only what
//! that check needs.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use anyhow::{Context as _, ensure};
use dynamics::Toss;
use serde::ser::SerializeStruct;
use serde::{Serialize, Serializer};
use toss::SolverEntry;

use crate::measure::adversary::{Answers, search};
use crate::measure::atlas::Atlas;
use crate::measure::atlas::expected::Expected;
use crate::measure::checks::hard;
use crate::measure::convergence::{Convergence, convergence};
use crate::measure::effort::Effort;
use crate::measure::exact_landings::ExactLandings;
use crate::measure::families::hard_tosses;
use crate::measure::outside::{ReferenceCoin, ReferenceData, ReferenceProbabilities};
use crate::measure::planner::{Planned, random_scenes};
use crate::measure::subject::{Subject, subjects, tight};
use crate::measure::survey::{Survey, random_launches};
use crate::measure::work_precision::problems::{self, Problem};
use crate::measure::work_precision::{Sweep, YARDSTICK};
use crate::shown::shown;

/// The subjects, the reference data and the shared results of a run. As plain data it is the records of the run: the runs
/// behind some of its rows, each null if no check needed it.
pub struct Context {
    /// How many cases are tried.
    pub effort: Effort,
    /// The solvers under verification.
    pub registry: Vec<SolverEntry>,
    /// These solvers with each of their schemes at tight settings.
    pub subjects: Vec<Subject>,
    /// Reference motions from outside the workspace.
    pub(crate) data: ReferenceData,
    pub(crate) reference_probabilities: ReferenceProbabilities,
    /// Moments of the catalogue's coins from outside the workspace.
    pub(crate) coins: Vec<ReferenceCoin>,
    /// The problems on which speed is compared with accuracy.
    pub problems: Vec<Problem>,
    /// What contestants are known to do near the places where methods fail.
    pub(crate) expected: Expected,
    /// The exact landings that checks have asked for.
    pub exact: ExactLandings,
    /// The landings of every subject from random launches.
    pub survey: Shared<Survey>,
    /// The landings of bodies by every subject.
    pub bodies: Shared<Survey>,
    /// Tosses of the hard families within 3 ulp of a time at which their outcome changes.
    pub(crate) hard_edges: Shared<Vec<Vec<Toss>>>,
    /// The landings of the hard families by every subject.
    pub(crate) hard: Shared<Survey>,
    /// The atlas of failures.
    pub atlas: Shared<Atlas>,
    /// The answers to the launches chosen to break solvers.
    pub(crate) search: Shared<Vec<Answers>>,
    /// The sweep of tolerances and steps.
    pub sweep: Shared<Sweep>,
    /// The errors by fixed step.
    pub convergence: Shared<Vec<Convergence>>,
    pub(crate) scenes: Shared<Vec<Planned>>,
}

/// A result that is computed when it is first asked for.
pub struct Shared<T> {
    found: OnceLock<T>,
    make: fn(&Context) -> anyhow::Result<T>,
}

impl<T> Shared<T> {
    fn by(make: fn(&Context) -> anyhow::Result<T>) -> Self {
        Self { found: OnceLock::new(), make }
    }

    /// The result, if a check has asked for it.
    pub fn found(&self) -> Option<&T> {
        self.found.get()
    }

    /// The result for the run of `context`, of which it is a part.
    pub fn get(&self, context: &Context) -> anyhow::Result<&T> {
        if let Some(found) = self.found.get() {
            return Ok(found);
        }
        let made = (self.make)(context)?;
        Ok(self.found.get_or_init(|| made))
    }
}

impl Serialize for Context {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut records = to.serialize_struct("Context", 3)?;
        records.serialize_field("atlas", &self.atlas.found())?;
        records.serialize_field("sweep", &self.sweep.found())?;
        records.serialize_field("convergence", &self.convergence.found())?;
        records.end()
    }
}

impl Context {
    /// How many of the records that a report shows were made so far.
    pub(crate) fn records(&self) -> usize {
        usize::from(self.atlas.found().is_some())
            + usize::from(self.sweep.found().is_some())
            + usize::from(self.convergence.found().is_some())
    }

    /// A context for the solvers of `registry`, and the data inside this crate.
    ///
    /// # Errors
    /// If two solvers have the same name, or a scheme takes neither a tolerance
    /// nor steps.
    pub fn new(registry: &[SolverEntry], effort: Effort) -> anyhow::Result<Self> {
        require_own_names(registry)?;
        Ok(Self {
            effort,
            registry: registry.to_vec(),
            subjects: subjects(registry, tight).context("the registry's solvers can't be made")?,
            data: ReferenceData::inside()?,
            reference_probabilities: ReferenceProbabilities::inside()?,
            coins: ReferenceCoin::inside()?,
            problems: problems::all()?,
            expected: Expected::of_this_workspace()?,
            exact: ExactLandings::default(),
            survey: Shared::by(|context| {
                let launches = random_launches(context.effort.launches([1000, 5000, 50_000]))?;
                Ok(Survey::of(&context.subjects, launches, Vec::new(), &context.exact))
            }),
            bodies: Shared::by(|context| Ok(Survey::of_bodies(context))),
            hard_edges: Shared::by(hard::edges),
            hard: Shared::by(|context| {
                // Longer ones take more steps than a scheme of fixed steps has.
                let is_short = |toss: &Toss| toss.launch.flight_time() <= 50.0;
                let tosses = hard_tosses(context.effort).into_iter().flatten().filter(is_short).collect();
                Ok(Survey::of(&context.subjects, tosses, Vec::new(), &context.exact))
            }),
            atlas: Shared::by(|context| Atlas::new(&context.registry, context.effort)),
            search: Shared::by(search),
            sweep: Shared::by(|context| Ok(Sweep::new(&context.registry, &context.problems, context.effort)?)),
            convergence: Shared::by(|context| convergence(&context.registry)),
            scenes: Shared::by(random_scenes),
        })
    }
}

/// Checks that no two solvers share a name, because their rows could not be told apart.
fn require_own_names(registry: &[SolverEntry]) -> anyhow::Result<()> {
    let mut names = BTreeSet::new();
    for entry in registry {
        let schemes = entry.schemes().iter().map(|scheme| scheme.name());
        for name in std::iter::once(entry.name()).chain(schemes) {
            ensure!(shown(name) == name, "'{}' is no name: it has characters that nobody sees", shown(name));
        }
        ensure!(names.insert(entry.name()), "the registry has two solvers called '{}'", entry.name());
        ensure!(entry.name() != YARDSTICK, "'{YARDSTICK}' is what charts call the library's quaternion");
    }
    Ok(())
}
