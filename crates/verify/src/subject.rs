//! What is verified: each solver of the registry with each Runge-Kutta method.

use toss::{Frame, InputError, Method, Scheme, Settings, Solver, SolverEntry};

/// Tolerance of the adaptive methods under verification.
pub const TIGHT_TOLERANCE: f64 = 1e-12;

/// Step of RK4 under verification (s).
pub const TIGHT_STEP: f64 = 1e-4;

/// A solver with its settings.
pub struct Subject {
    /// `solver` or `solver/method`; the key of its bounds.
    pub name: String,
    /// Its line of the registry.
    pub entry: SolverEntry,
    /// Its method, if it integrates.
    pub scheme: Option<Scheme>,
    /// The solver.
    pub solver: Box<dyn Solver>,
    /// The options of the command line that make the same solver.
    pub options: String,
}

impl Subject {
    /// `entry` with `scheme` at the tight settings, angles taken in `frame`.
    ///
    /// # Errors
    /// Never for a scheme of the library.
    pub fn new(entry: SolverEntry, scheme: Option<Scheme>, frame: Frame) -> Result<Self, InputError> {
        let method = scheme.map_or(Ok(Method::DEFAULT), tight)?;
        let options = match scheme {
            None => format!("--solver {}", entry.name),
            Some(scheme) => {
                let control = if scheme.is_adaptive() {
                    format!("--tolerance {TIGHT_TOLERANCE:?}")
                } else {
                    format!("--step {TIGHT_STEP:?}")
                };
                let frame =
                    if frame == Frame::default() { String::new() } else { format!(" --frame {}", frame.name()) };
                format!("--solver {} --method {} {control}{frame}", entry.name, scheme.name())
            }
        };
        Ok(Self {
            name: scheme.map_or_else(|| entry.name.to_owned(), |scheme| format!("{}/{}", entry.name, scheme.name())),
            solver: (entry.build)(&Settings { method, frame }),
            entry,
            scheme,
            options,
        })
    }
}

fn tight(scheme: Scheme) -> Result<Method, InputError> {
    if scheme.is_adaptive() { Method::adaptive(scheme, TIGHT_TOLERANCE) } else { Method::fixed(scheme, TIGHT_STEP) }
}

/// Every solver of `registry`, each integrator with every method.
///
/// # Errors
/// Never for the library's schemes.
pub fn subjects(registry: &[SolverEntry]) -> Result<Vec<Subject>, InputError> {
    let mut subjects = Vec::new();
    for &entry in registry {
        if entry.integrates {
            for scheme in Scheme::ALL {
                subjects.push(Subject::new(entry, Some(scheme), Frame::default())?);
            }
        } else {
            subjects.push(Subject::new(entry, None, Frame::default())?);
        }
    }
    Ok(subjects)
}
