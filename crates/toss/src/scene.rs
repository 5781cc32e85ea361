//! Scenes: what is wanted of which toss, and how accurately.
//!
//! ```toml
//! accuracy = 1e-9
//!
//! [want.tilt]                      # or outcome, attitude; [want.trace] has toss and points, [want.probability] a space
//! coin = "us-quarter"
//! launch = { rate = [20.0, 0.0, 5.0], speed = 3.0 }
//! ```

use dynamics::{InputError, Scheme, SolveError, Toss};
use sampling::{SampleError, Space};
use serde::{Deserialize, Serialize};

use crate::trace::TraceError;

/// A question about a toss or a space of launches.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// What is wanted.
    pub want: Want,
    /// The largest error that is good enough, > 0: of cos θ, of attitudes (rad), of the probability. An outcome is
    /// proven whatever it is; one by an integrator is decided where |cos θ| exceeds it.
    pub accuracy: f64,
    /// The integrator that is to be used instead of the cheapest model, as a cross-check.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub by: Option<Integrator>,
}

/// What is wanted, and of what.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Want {
    /// Heads or tails.
    Outcome(Toss),
    /// cos θ at landing.
    Tilt(Toss),
    /// Attitude and body rate at landing.
    Attitude(Toss),
    /// The flight at equal steps of time.
    Trace {
        /// The toss.
        toss: Toss,
        /// Number of times, launch and landing included.
        points: usize,
    },
    /// The probability of heads.
    Probability(Space),
}

/// An integrator, with the method left open or not; its tolerance follows from the accuracy.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Integrator {
    /// Its solver's name in the [registry](crate::registry).
    pub solver: String,
    /// Its method, one with an error estimate; the cheapest one if it is open.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub method: Option<Scheme>,
}

impl Want {
    /// The toss that is asked about; `None` for a space.
    pub fn toss(&self) -> Option<&Toss> {
        match self {
            Self::Outcome(toss) | Self::Tilt(toss) | Self::Attitude(toss) | Self::Trace { toss, .. } => Some(toss),
            Self::Probability(_) => None,
        }
    }

    /// The same want of another toss; a space stays what it is.
    #[must_use]
    pub fn of(&self, toss: Toss) -> Self {
        match self {
            Self::Outcome(_) => Self::Outcome(toss),
            Self::Tilt(_) => Self::Tilt(toss),
            Self::Attitude(_) => Self::Attitude(toss),
            Self::Trace { points, .. } => Self::Trace { toss, points: *points },
            Self::Probability(_) => self.clone(),
        }
    }
}

/// Why a scene is not served.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// It makes no sense, or asks for more than any model gives.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The solver failed.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The solver failed on a launch of the space.
    #[error(transparent)]
    Sample(#[from] SampleError),
    /// The launches that were allowed did not reach the accuracy.
    #[error("after {points} launches the probability is known to {reached:.1e}, not to {accuracy:e}")]
    NotReached {
        /// Launches that were tried.
        points: u64,
        /// Half the width of the interval.
        reached: f64,
        /// What was asked.
        accuracy: f64,
    },
}

impl From<TraceError> for SceneError {
    fn from(error: TraceError) -> Self {
        match error {
            TraceError::Input(error) => error.into(),
            TraceError::Solve(error) => error.into(),
        }
    }
}

impl Scene {
    /// The scene of `want`, to be answered by the cheapest model.
    pub fn new(want: Want, accuracy: f64) -> Self {
        Self { want, accuracy, by: None }
    }

    /// The same scene, to be answered by an integrator.
    #[must_use]
    pub fn by(self, solver: &str, method: Option<Scheme>) -> Self {
        Self { by: Some(Integrator { solver: solver.to_owned(), method }), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_is_plain_data() {
        let text =
            "accuracy = 1e-9\n[want.trace]\npoints = 50\n[want.trace.toss.launch]\nrate = [1, 1, 2.5]\nspeed = 3.0\n";
        let scene: Scene = toml::from_str(text).unwrap();
        assert!(matches!(scene.want, Want::Trace { points: 50, .. }));
        let asked = Scene::new(scene.want, 1e-3).by("gamma", Some(Scheme::Dopri5));
        let back: Scene = toml::from_str(&toml::to_string(&asked).unwrap()).unwrap();
        assert_eq!(back, asked);
        let text = "accuracy = 1e-3\n[want.probability]\nrate_x = '0:9'\nrate_y = 'x'\nrate_z = 5\nspeed = '3:5'\n";
        let space: Scene = toml::from_str(text).unwrap();
        assert_eq!(toml::from_str::<Scene>(&toml::to_string(&space).unwrap()).unwrap(), space);
    }

    #[test]
    fn what_is_misspelt_or_outside_the_model_is_refused() {
        let launch = "launch = { rate = [1, 1, 2.5], speed = 3.0 }\n";
        for (text, message) in [
            (format!("acuracy = 1\n[want.tilt]\n{launch}"), "unknown field `acuracy`"),
            (format!("accuracy = 1\n[want.heads]\n{launch}"), "unknown variant `heads`"),
            (
                format!("accuracy = 1\nby = {{ solver = 'gamma', method = 'dop8' }}\n[want.tilt]\n{launch}"),
                "unknown variant `dop8`",
            ),
            (
                "accuracy = 1\n[want.tilt]\nlaunch = { rate = [1, 1, 2], speed = 3, drag = 1 }".to_owned(),
                "drag is outside",
            ),
            ("accuracy = 1\n[want.tilt.launch]\nrate = [1, 1, 2]\nspeed = nan".to_owned(), "speed [m/s] = NaN"),
        ] {
            let found = toml::from_str::<Scene>(&text).unwrap_err();
            assert!(found.message().starts_with(message), "{found} for {text}");
        }
    }
}
