//! The entry for a stepper from elsewhere, which integrates a [`FreeRotation`]. The package that steps needs no type of
//! this workspace but this system.

use std::borrow::Cow;

use super::{COINS_ALONE, ForeignError, failed};
use crate::entry::{Settings, SolverEntry};
use crate::error::SolveError;
use crate::free_rotation::FreeRotation;
use crate::scheme::Scheme;
use crate::solver::{Landing, Solver, Work};
use crate::stepping::Stepping;
use crate::toss::Toss;

impl SolverEntry {
    /// An entry for a stepper from elsewhere, which integrates a [`FreeRotation`] by one of `schemes`.
    ///
    /// `step` is given the system and the scheme with its tolerance or step, in the
    /// [units of the system](FreeRotation::stepping). It returns the state at `system.duration()` and the work, which
    /// [`FreeRotation::work`] makes. The solver is judged by the error that its settings permit,
    /// [`Stepping::error_estimate`], and may be far more accurate.
    pub fn from_stepper(
        name: impl Into<Cow<'static, str>>,
        summary: impl Into<Cow<'static, str>>,
        schemes: &[Scheme],
        step: impl Fn(&FreeRotation, &Stepping) -> Result<([f64; 7], Work), ForeignError> + Clone + Send + Sync + 'static,
    ) -> Self {
        let name = name.into();
        let called = name.clone();
        let build = move |settings: &Settings| -> Box<dyn Solver> {
            Box::new(Stepper { name: called.clone(), stepping: settings.stepping, step: step.clone() })
        };
        Self::new(name, summary, build).with_schemes(schemes)
    }
}

/// A stepper from elsewhere with its settings.
struct Stepper<S> {
    name: Cow<'static, str>,
    stepping: Stepping,
    step: S,
}

impl<S> Solver for Stepper<S>
where
    S: Fn(&FreeRotation, &Stepping) -> Result<([f64; 7], Work), ForeignError> + Send + Sync,
{
    fn name(&self) -> &str {
        &self.name
    }

    fn stepping(&self) -> Option<Stepping> {
        Some(self.stepping)
    }

    fn estimates_its_error(&self) -> bool {
        false
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let system = FreeRotation::new(&toss.of_coin(&self.name, COINS_ALONE)?)?;
        let error = self.stepping.error_estimate(toss)?;
        // Steppers differ in what they do with no time, and with one so short that a step of it is 0.
        if system.duration() < f64::MIN_POSITIVE {
            return Ok(system.landing(&system.start(), Work::default())?.with_error(error));
        }
        let stepping = system.stepping(&self.stepping)?;
        let (end, work) = (self.step)(&system, &stepping).map_err(|error| failed(&self.name, error))?;
        Ok(system.landing(&end, work)?.with_error(error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coin::Coin;
    use crate::launch::Launch;
    use crate::time_of_flight::TimeOfFlight;

    fn toss(rate: [f64; 3], time: f64) -> Toss {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
        Toss::new(Coin::PAPER, launch.with_tilt(0.4).unwrap())
    }

    #[test]
    fn a_stepper_is_not_asked_beyond_the_largest_phase() {
        let entry = SolverEntry::from_stepper("mine", "", &[Scheme::DOP853], |_, _| panic!("out of order"));
        let (far, solver) = (toss([1e20, 0.0, 0.0], 1.0), entry.solver(&Settings::default()).unwrap());
        assert_eq!(solver.land(&far).unwrap_err().kind(), "phase_too_large");
    }

    #[test]
    fn a_stepper_is_given_its_settings_in_the_units_of_the_system() {
        let entry = SolverEntry::from_stepper("mine", "", &[Scheme::RK4], |system, stepping| {
            assert_eq!(format!("{:?}", stepping.control()), format!("Step({:?})", system.duration() / 4.0));
            Ok((system.start(), system.work(4, 0)))
        });
        let stepping = Stepping::fixed(Scheme::RK4, 0.2).unwrap();
        let solver = entry.solver(&Settings { stepping, ..Settings::default() }).unwrap();
        let toss = toss([3.0, 1.0, 2.0], 0.8);
        let landing = solver.land(&toss).unwrap();
        assert_eq!((landing.work.accepted_steps, solver.stepping()), (4, Some(stepping)));
        assert_eq!(Ok(landing.error), stepping.error_estimate(&toss));
        // Without time the stepper is not called.
        assert_eq!(solver.land(&self::toss([3.0, 1.0, 2.0], 0.0)).unwrap().work, Work::default());
    }
}
