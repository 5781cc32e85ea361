//! Entries for solvers in other terms than the trait [`Solver`]: a function that gives the attitude at landing, and a
//! stepper from elsewhere. What has an entry is checked, judged and chosen like every other solver.

mod stepper;

use std::borrow::Cow;
use std::error::Error;

use crate::attitude::Attitude;
use crate::body_rate::rate_by_momentum;
use crate::entry::SolverEntry;
use crate::error::{Reason, SolveError};
use crate::phase::Phases;
use crate::solver::{Landing, Solver, Work};
use crate::state::State;
use crate::toss::{CoinToss, Toss};

/// The error of a function from elsewhere. `?` makes it of any error, `into` also of a text.
pub type ForeignError = Box<dyn Error + Send + Sync>;

impl SolverEntry {
    /// An entry for a function that computes the attitude at landing. `summary` says in one line what it solves.
    ///
    /// - `attitude` is given a toss: `toss.coin` has the moments of inertia (kg m²), `toss.launch` the body rate (BF,
    ///   rad/s), the attitude at launch and the time of flight (s). It returns the attitude at landing, from BF (z along
    ///   the coin's normal on the side of heads) to LF (z up). [`Attitude::from_components`] takes (w, x, y, z).
    /// - `error_estimate` returns the error of cos θ at landing that the function claims on a toss. It is judged by it.
    ///
    /// The body rate at landing is that with which the coin at this attitude has the angular momentum of the launch, so
    /// that checks of the angular momentum say nothing about such a solver.
    ///
    /// ```
    /// use dynamics::{Attitude, Settings, SolverEntry};
    ///
    /// // It knows coins that turn about their normal alone.
    /// let entry = SolverEntry::from_attitude("spin", "Q0 turned by ωz T about n", |_| 1e-12, |toss| {
    ///     let rate = toss.launch.rate();
    ///     if rate.x != 0.0 || rate.y != 0.0 {
    ///         return Err("only a spin about the normal".into());
    ///     }
    ///     Ok(toss.launch.attitude() * Attitude::about_z(rate.z * toss.launch.flight_time()))
    /// });
    /// let solver = entry.solver(&Settings::default())?;
    /// assert_eq!(solver.name(), "spin");
    /// # Ok::<(), dynamics::InputError>(())
    /// ```
    pub fn from_attitude(
        name: impl Into<Cow<'static, str>>,
        summary: impl Into<Cow<'static, str>>,
        error_estimate: impl Fn(&CoinToss) -> f64 + Clone + Send + Sync + 'static,
        attitude: impl Fn(&CoinToss) -> Result<Attitude, ForeignError> + Clone + Send + Sync + 'static,
    ) -> Self {
        let name = name.into();
        let solver = ByAttitude { name: name.clone(), error_estimate, attitude };
        Self::new(name, summary, move |_| Box::new(solver.clone()))
    }
}

/// An error of a function from elsewhere as that of the solver `name`. An error of this workspace stays what it is.
fn failed(name: &str, error: ForeignError) -> SolveError {
    match error.downcast::<SolveError>() {
        Ok(error) => *error,
        Err(error) => SolveError::Failed { solver: name.to_owned(), source: Reason::from(error) },
    }
}

/// A function that computes the attitude at landing.
#[derive(Clone)]
struct ByAttitude<E, A> {
    name: Cow<'static, str>,
    error_estimate: E,
    attitude: A,
}

impl<E, A> Solver for ByAttitude<E, A>
where
    E: Fn(&CoinToss) -> f64 + Send + Sync,
    A: Fn(&CoinToss) -> Result<Attitude, ForeignError> + Send + Sync,
{
    fn name(&self) -> &str {
        &self.name
    }

    fn land(&self, toss: &Toss) -> Result<Landing, SolveError> {
        let coin = toss.of_coin(&self.name, COINS_ALONE)?;
        Phases::new(toss)?;
        let attitude = (self.attitude)(&coin).map_err(|error| failed(&self.name, error))?;
        let state = State { attitude, rate: rate_by_momentum(&coin, &attitude) };
        Ok(Landing::new(state, Work::default()).with_error((self.error_estimate)(&coin)))
    }
}

/// Why a solver of coins refuses another body.
const COINS_ALONE: &str = "it has no method for other rigid bodies";

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::coin::Coin;
    use crate::entry::Settings;
    use crate::launch::Launch;
    use crate::time_of_flight::TimeOfFlight;

    fn toss(rate: [f64; 3], time: f64) -> Toss {
        let launch = Launch::new(Vector3::from(rate), TimeOfFlight::Given(time)).unwrap();
        Toss::new(Coin::PAPER, launch.with_tilt(0.4).unwrap())
    }

    /// The solver of a function that returns `attitude`.
    fn answering(
        attitude: impl Fn() -> Result<Attitude, ForeignError> + Clone + Send + Sync + 'static,
    ) -> Box<dyn Solver> {
        let entry = SolverEntry::from_attitude("mine", "", |_| 1e-9, move |_| attitude());
        entry.solver(&Settings::default()).unwrap()
    }

    #[test]
    fn a_function_lands_with_its_attitude_and_the_momentum_of_the_launch() {
        let toss = toss([9.0, -4.0, 3.0], 0.8);
        let landed = Attitude::from_components([0.5, -0.1, 0.7, 0.4]).unwrap();
        let landing = answering(move || Ok(landed)).land(&toss).unwrap();
        assert_eq!((landing.state.attitude, landing.cos_tilt), (landed, landed.cos_tilt()));
        let momentum = |state: &State| state.attitude.body_to_lab(&toss.body.angular_momentum(&state.rate));
        let launched = State { attitude: toss.launch.attitude(), rate: toss.launch.rate() };
        let (before, after) = (momentum(&launched), momentum(&landing.state));
        // The component along the normal is that of the launch whatever the attitude is.
        let normal = landed.normal();
        let across = (after - normal * after.dot(&normal)) - (before - normal * before.dot(&normal));
        assert!(across.norm() < 1e-15 * before.norm(), "{across}");
        assert_eq!(landing.state.rate.z, 3.0);
    }

    #[test]
    fn errors_keep_their_kind_and_their_words() {
        let toss = toss([9.0, -4.0, 3.0], 0.8);
        let error = answering(|| Err("out of fuel".into())).land(&toss).unwrap_err();
        assert_eq!(error.to_string(), "solver 'mine' failed: out of fuel");
        let error = answering(|| Err(Box::new(SolveError::NotFinite { time: 0.5 }))).land(&toss).unwrap_err();
        assert_eq!(error, SolveError::NotFinite { time: 0.5 });
        let error = answering(|| panic!("out of order")).land(&toss).unwrap_err();
        assert_eq!(error.kind(), "misbehaved");
        let error = answering(|| Ok(Attitude::from_components([f64::NAN, 0.0, 0.0, 0.0])?)).land(&toss);
        assert!(error.unwrap_err().to_string().contains("attitude (largest component) = NaN"));
    }

    #[test]
    fn a_function_is_not_asked_beyond_the_largest_phase() {
        let (far, function) = (toss([1e20, 0.0, 0.0], 1.0), answering(|| panic!("out of order")));
        assert_eq!(function.land(&far).unwrap_err().kind(), "phase_too_large");
    }
}
