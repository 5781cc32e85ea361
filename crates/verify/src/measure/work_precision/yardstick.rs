//! The library's quaternion under a name of its own. Charts show it beside the solvers of others: whether a solver is fast
//! cannot be seen from its own line alone. It is measured like them and not judged.

use toss::{Landing, QuaternionSolver, Settings, SolveError, Solver, SolverEntry, Stepping, Toss};

/// The name of the library's quaternion in charts and tables of other solvers.
pub const YARDSTICK: &str = "unfair-toss";

struct Yardstick(QuaternionSolver);

impl Solver for Yardstick {
    fn name(&self) -> &str {
        YARDSTICK
    }

    fn stepping(&self) -> Option<Stepping> {
        self.0.stepping()
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        self.0.land(toss)
    }
}

/// The solvers of `registry`, and the library's quaternion after them unless they have it.
pub(super) fn beside(registry: &[SolverEntry]) -> Vec<SolverEntry> {
    let mut entries = registry.to_vec();
    if registry.iter().all(|entry| entry.name() != QuaternionSolver::NAME) {
        let build = |settings: &Settings| -> Box<dyn Solver> {
            Box::new(Yardstick(QuaternionSolver::new(settings.stepping, settings.formulation)))
        };
        let entry = SolverEntry::new(YARDSTICK, "the library's quaternion, to compare with", build);
        entries.push(entry.with_schemes(QuaternionSolver::entry().schemes()));
    }
    entries
}

#[cfg(test)]
mod tests {
    use toss::{Registry, Scheme};

    use super::*;
    use crate::measure::effort::Effort;
    use crate::measure::work_precision::{Sweep, problems};

    #[test]
    fn solvers_of_others_are_compared_with_the_librarys_quaternion_and_the_librarys_own_with_themselves() {
        let standard = Registry::standard().entries();
        let names = |entries: &[SolverEntry]| entries.iter().map(|entry| entry.name().to_owned()).collect::<Vec<_>>();
        assert_eq!(names(&beside(standard)), names(standard));
        let others: Vec<SolverEntry> =
            standard.iter().filter(|entry| entry.name() != QuaternionSolver::NAME).cloned().collect();
        let problems = problems::all().unwrap();
        let sweep = Sweep::new(&others, &problems[..1], Effort::Quick).unwrap();
        let is_ours = |subject: &String| subject.starts_with(YARDSTICK);
        assert_eq!(sweep.subjects().iter().filter(|subject| is_ours(subject)).count(), Scheme::ALL.len());
        assert!(sweep.judged().iter().all(|subject| !is_ours(subject)) && sweep.judged().len() > 1);
    }
}
