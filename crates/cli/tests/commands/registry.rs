//! These tests run the program with a registry that has a solver from elsewhere. Somebody's own binary offers it by
//! `unfair_toss::main(&registry)`, and every command must then know it.

use std::ffi::OsString;

use toss::{Landing, QuaternionSolver, Registry, Scheme, SolveError, Solver, SolverEntry, Stepping, Toss};
use unfair_toss::{Streams, run_with};

/// The quaternion solver under another name.
struct Mine(QuaternionSolver);

impl Solver for Mine {
    fn name(&self) -> &str {
        "mine"
    }
    fn stepping(&self) -> Option<Stepping> {
        self.0.stepping()
    }
    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        self.0.land(toss)
    }
}

fn registry() -> Registry {
    let mine = SolverEntry::new("mine", "from elsewhere", |settings| {
        Box::new(Mine(QuaternionSolver::new(settings.stepping, settings.formulation)))
    });
    Registry::standard().with(mine.with_schemes(&[Scheme::DOPRI5])).expect("a name of its own")
}

/// What the program answers to these arguments: its exit code, standard output and standard error, without colours.
pub(crate) fn answer<'a>(registry: &Registry, line: impl IntoIterator<Item = &'a str>) -> (u8, String, String) {
    let arguments: Vec<OsString> = std::iter::once("unfair-toss").chain(line).map(OsString::from).collect();
    let (mut out, mut err) = (anstream::StripStream::new(Vec::new()), anstream::StripStream::new(Vec::new()));
    let streams = Streams { input: &mut std::io::empty(), out: &mut out, err: &mut err };
    let code = run_with(registry, &arguments, streams);
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (code, text(out.into_inner()), text(err.into_inner()))
}

#[test]
fn the_commands_know_a_solver_from_elsewhere() {
    const TOSS: &str = "--rate 1,1,2.5 --speed 3";
    let registry = registry();
    let (code, out, err) = answer(&registry, format!("toss {TOSS} --solver mine").split(' '));
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("heads"), "{out}");
    let (_, out, _) = answer(&registry, ["solvers"]);
    assert!(out.lines().any(|line| line.starts_with("mine") && line.contains("dopri5")), "{out}");
    let (_, out, _) = answer(&registry, format!("compare {TOSS}").split(' '));
    assert!(out.lines().any(|line| line.starts_with("mine") && line.contains("dopri5")), "{out}");
    let (_, out, _) = answer(&registry, ["toss", "--help"]);
    assert!(out.contains("quaternion or mine"), "{out}");
    let (code, _, err) = answer(Registry::standard(), format!("toss {TOSS} --solver mine").split(' '));
    assert!(code == 2 && err.contains("mine"), "{err}");
}

#[test]
fn the_planner_takes_a_solver_from_elsewhere() {
    const PLAN: &str = "plan --rate 1,1,2.5 --speed 3 --want tilt --accuracy 1e-6 --solver mine";
    let (code, out, err) = answer(&registry(), PLAN.split(' '));
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("mine, dopri5, tolerance"), "{out}");
}
