//! What a solver is: a pure map from a toss to the state at its landing.
//!
//! A solver is chosen at compile time by its type or at run time by its [`SolverEntry`]. Each lives in one file and
//! has one entry; every test and every check runs over the registry of entries.

use crate::batch::{BatchError, Filtered, Tosses};
use crate::error::{InputError, SolveError, find_named};
use crate::launch::Toss;
use crate::method::{Method, Scheme};
use crate::outcome::{Outcome, Verdict};
use crate::state::State;

/// What a propagation cost, as counts that repeat exactly.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Evaluations of the right-hand side; of Taylor series, a coefficient of the whole state for each order of each step.
    pub rhs_calls: u64,
    /// Steps that were kept.
    pub accepted_steps: u64,
    /// Steps that were tried and thrown away.
    pub rejected_steps: u64,
}

/// The state at landing and what it cost to get there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Propagation {
    /// State at landing.
    pub state: State,
    /// cos θ at landing, as the solver finds it: that of the state's attitude, or better.
    pub cos_tilt: f64,
    /// Loss of norm of an integrated quaternion, ||Q| - 1|; 0 where attitudes need no norm.
    pub defect: f64,
    /// Its cost.
    pub work: Work,
}

impl Propagation {
    /// A landing whose cos θ is that of its attitude.
    pub fn new(state: State, work: Work) -> Self {
        Self { state, cos_tilt: state.attitude.cos_tilt(), defect: 0.0, work }
    }
}

/// Solves the flight of a toss.
pub trait Solver: Send + Sync {
    /// Its name in the registry.
    fn name(&self) -> &'static str;

    /// Its method of integration; `None` for a closed form.
    fn method(&self) -> Option<Method> {
        None
    }

    /// State at landing, `toss.launch.flight_time()` seconds after launch.
    ///
    /// # Errors
    /// [`SolveError`] where the solver cannot go on; never a partial result.
    fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError>;

    /// cos θ at landing; cheaper than the attitude where the solver knows how.
    ///
    /// # Errors
    /// As [`Solver::propagate`].
    fn cos_tilt(&self, toss: &Toss) -> Result<f64, SolveError> {
        self.propagate(toss).map(|landing| landing.cos_tilt)
    }

    /// Error of its cos θ on `toss` that this solver answers for, by its [method](Method::resolution); 0 if it has none.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    fn resolution(&self, toss: &Toss) -> Result<f64, SolveError> {
        self.method().map_or(Ok(0.0), |method| method.resolution(toss))
    }

    /// Heads or tails by a `cos_tilt` of this solver, or undecided where it is within [`Solver::resolution`] of 0.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`].
    fn verdict_at(&self, toss: &Toss, cos_tilt: f64) -> Result<Verdict, SolveError> {
        Ok(Verdict { outcome: Outcome::of(cos_tilt, self.resolution(toss)?), proof: None })
    }

    /// How the toss lands, and whether that is proven.
    ///
    /// # Errors
    /// As [`Solver::propagate`].
    fn verdict(&self, toss: &Toss) -> Result<Verdict, SolveError> {
        self.verdict_at(toss, self.cos_tilt(toss)?)
    }

    /// Counts the outcomes of many tosses: those that are proven in a batch, while `rest` is told the others one by one.
    ///
    /// # Errors
    /// [`BatchError`] for the first toss that has no outcome.
    fn count(&self, tosses: &Tosses<'_>, rest: &mut dyn FnMut(Verdict)) -> Result<Filtered, BatchError> {
        (0..tosses.len()).try_for_each(|index| tosses.solve(index, |toss| self.verdict(toss)).map(&mut *rest))?;
        Ok(Filtered::default())
    }

    /// How the toss lands.
    ///
    /// # Errors
    /// As [`Solver::propagate`].
    fn outcome(&self, toss: &Toss) -> Result<Outcome, SolveError> {
        self.verdict(toss).map(|verdict| verdict.outcome)
    }
}

/// How the kinematics are set up for integration. The motion is the same in each; what differs is where the equations
/// are singular, and what happens there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Formulation {
    /// Euler angles and γ-ODE in the transport frame with z along ±S, the angular momentum, on the side of n: S is fixed
    /// in TF, so β is constant and at most π/2. Quaternions are projected onto unit norm.
    #[default]
    Momentum,
    /// Euler angles and γ-ODE with z up, as the paper has them: singular whenever n is vertical, as at every horizontal
    /// launch, which starts on the regular solution, and at each return, which is a typed error. Quaternions as above.
    Vertical,
    /// The equations exactly as the paper prints them, with z up and nothing to guard their singular points, and the
    /// quaternion without projection. Kept to show where that fails: an answer may be wrong without an error.
    Raw,
}

impl Formulation {
    /// All formulations.
    pub const ALL: [Self; 3] = [Self::Momentum, Self::Vertical, Self::Raw];

    /// The formulation called `name`.
    ///
    /// # Errors
    /// [`InputError::UnknownName`].
    pub fn named(name: &str) -> Result<Self, InputError> {
        find_named("formulation", name, &Self::ALL, |formulation| formulation.name()).copied()
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Momentum => "momentum",
            Self::Vertical => "vertical",
            Self::Raw => "raw",
        }
    }
}

/// What a solver can be told at run time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Method of integration and step control.
    pub method: Method,
    /// How the kinematics are set up.
    pub formulation: Formulation,
}

impl Default for Settings {
    fn default() -> Self {
        Self { method: Method::DEFAULT, formulation: Formulation::default() }
    }
}

/// One line of the registry: how a solver is named and made at run time.
#[derive(Debug, Clone, Copy)]
pub struct SolverEntry {
    /// Name.
    pub name: &'static str,
    /// What it solves, in a line.
    pub summary: &'static str,
    /// The formulations that differ for it; none for a closed form, which takes no steps.
    pub formulations: &'static [Formulation],
    /// The schemes that it can step by; none for a closed form.
    pub schemes: &'static [Scheme],
    /// Makes the solver. With a scheme that it does not offer, each flight is a [`SolveError::NotOffered`].
    pub build: fn(&Settings) -> Box<dyn Solver>,
}

impl SolverEntry {
    /// Whether it steps through time.
    pub fn integrates(&self) -> bool {
        !self.schemes.is_empty()
    }

    /// Refuses a scheme that the solver does not offer; a closed form has no use for one, and takes any.
    ///
    /// # Errors
    /// [`InputError::UnknownName`] with the names of those that it offers.
    pub fn require_scheme(&self, scheme: Scheme) -> Result<(), InputError> {
        if !self.integrates() {
            return Ok(());
        }
        find_named("method of this solver", scheme.name(), self.schemes, |offered| offered.name()).map(|_| ())
    }

    /// The solver with `settings`.
    ///
    /// # Errors
    /// As [`SolverEntry::require_scheme`].
    pub fn solver(&self, settings: &Settings) -> Result<Box<dyn Solver>, InputError> {
        self.require_scheme(settings.method.scheme())?;
        Ok((self.build)(settings))
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::attitude::Attitude;
    use crate::coin::Coin;
    use crate::exact_solver::ExactSolver;
    use crate::launch::Launch;
    use crate::time_of_flight::TimeOfFlight;

    /// Lands where it was launched, by RK4 or by no method.
    struct Still(Option<Method>);

    impl Solver for Still {
        fn name(&self) -> &'static str {
            "still"
        }

        fn method(&self) -> Option<Method> {
            self.0
        }

        fn propagate(&self, toss: &Toss) -> Result<Propagation, SolveError> {
            let state = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
            Ok(Propagation::new(state, Work::default()))
        }
    }

    fn toss(tilt: f64) -> Toss {
        let launch = Launch::new(Vector3::new(0.1, 0.0, 0.0), TimeOfFlight::Given(0.1)).unwrap();
        Toss { coin: Coin::DISC, launch: launch.with_tilt(tilt).unwrap() }
    }

    #[test]
    fn a_solver_that_propagates_has_outcomes_as_far_as_it_answers_for_them() {
        let method = Method::fixed(Scheme::Rk4, 0.05).unwrap();
        for (solver, resolution) in [(Still(None), 0.0), (Still(Some(method)), method.resolution(&toss(0.0)).unwrap())]
        {
            let quarter = std::f64::consts::FRAC_PI_2;
            for (tilt, outcome) in
                [(0.3, Outcome::Heads), (3.0, Outcome::Tails), (quarter - 2.0 * resolution, Outcome::Heads)]
            {
                let toss = toss(tilt);
                assert_eq!(solver.resolution(&toss), Ok(resolution));
                assert_eq!(solver.cos_tilt(&toss), Ok(Attitude::about_x(tilt).cos_tilt()));
                assert_eq!(solver.verdict(&toss), Ok(Verdict { outcome, proof: None }));
                assert_eq!(solver.outcome(&toss), Ok(outcome));
            }
            assert_eq!(
                solver.outcome(&toss(quarter - 0.5 * resolution)).is_ok_and(|found| found == Outcome::Heads),
                resolution == 0.0
            );
        }
    }

    #[test]
    fn it_counts_a_batch_one_by_one() {
        let [x, y, z, speed] = [[0.0, 1.0], [0.0; 2], [2.0, 3.0], [1.0, 1.5]];
        let tosses = Tosses::new(Coin::DISC, Attitude::IDENTITY, 9.81, [&x, &y, &z], &speed).unwrap();
        let mut verdicts = Vec::new();
        let filtered = Still(None).count(&tosses, &mut |verdict| verdicts.push(verdict)).unwrap();
        assert_eq!(
            (filtered, verdicts),
            (Filtered::default(), vec![Verdict { outcome: Outcome::Heads, proof: None }; 2])
        );
    }

    #[test]
    fn formulations_are_named() {
        for (formulation, name) in Formulation::ALL.into_iter().zip(["momentum", "vertical", "raw"]) {
            assert_eq!((formulation.name(), Formulation::named(name)), (name, Ok(formulation)));
        }
    }

    #[test]
    fn an_entry_builds_what_it_offers() {
        const STILL: SolverEntry = SolverEntry {
            name: "still",
            summary: "",
            formulations: &Formulation::ALL,
            schemes: &Scheme::RUNGE_KUTTA,
            build: |settings| Box::new(Still(Some(settings.method))),
        };
        let by_taylor = Settings { method: Method::adaptive(Scheme::Taylor, 1e-9).unwrap(), ..Settings::default() };
        assert!(STILL.integrates() && !ExactSolver::ENTRY.integrates());
        assert_eq!(STILL.solver(&Settings::default()).unwrap().method(), Some(Method::DEFAULT));
        assert_eq!(STILL.solver(&by_taylor).err().map(|error| error.field()), Some("method of this solver"));
        assert_eq!(ExactSolver::ENTRY.solver(&by_taylor).unwrap().name(), "exact");
    }
}
