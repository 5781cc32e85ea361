//! Integrators of other people under the checks of this workspace: what each reaches, at what cost, and where it fails.
//!
//! This crate stands outside the workspace and uses it as any other crate would. It brings packages for ordinary
//! differential equations, a Lie-group method, a physics engine and SciPy; each is one file of [`solvers`].

pub mod contest;
pub mod page;
pub mod record;
pub mod solvers;

use std::path::Path;

use toss::SolverEntry;

/// The contestants that need nothing but Rust.
pub fn in_rust() -> Vec<SolverEntry> {
    vec![
        solvers::differential_equations::entry(),
        solvers::ivp::entry(),
        solvers::diffsol::entry(),
        solvers::rkmk4::entry(),
        solvers::rapier::entry(),
    ]
}

/// All contestants, and why those that are missing are. `environment` is the folder of a virtual environment of Python,
/// which is made if no Python with SciPy is found.
pub fn all(environment: &Path) -> (Vec<SolverEntry>, Option<String>) {
    let mut entries = in_rust();
    match solvers::scipy::entry(environment) {
        Ok(entry) => {
            entries.push(entry);
            (entries, None)
        }
        Err(why) => (entries, Some(format!("scipy is left out: {why}"))),
    }
}
