//! Scenes: what is wanted of which toss, and how accurately.
//!
//! ```toml
//! accuracy = 1e-9
//!
//! [want.tilt]                      # or outcome, attitude; [want.trace] has toss and points, [want.probability] a space
//! coin = "us-quarter"
//! launch = { rate = [20.0, 0.0, 5.0], speed = 3.0 }
//! ```

use dynamics::Toss;
use sampling::Space;
use serde::{Deserialize, Serialize};

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
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
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

/// An integrator, with the scheme left open or not; its tolerance follows from the accuracy.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Integrator {
    /// Its solver's name in the [`Registry`](crate::Registry).
    pub solver: String,
    /// Name of its scheme, one with an error estimate; the cheapest one if it is open.
    #[serde(alias = "method", skip_serializing_if = "Option::is_none")]
    pub scheme: Option<String>,
}

/// The kind of a [`Want`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WantKind {
    /// Heads or tails.
    Outcome,
    /// cos θ at landing.
    Tilt,
    /// Attitude and body rate at landing.
    Attitude,
    /// The flight.
    Trace,
    /// The probability of heads.
    Probability,
}

impl WantKind {
    /// Its name in files and options, as `outcome`.
    pub fn name(self) -> &'static str {
        ["outcome", "tilt", "attitude", "trace", "probability"][self as usize]
    }

    /// What it is, in words.
    pub fn words(self) -> &'static str {
        ["the outcome", "cos θ", "one landing", "a flight", "a probability"][self as usize]
    }
}

impl Want {
    /// Its kind.
    pub fn kind(&self) -> WantKind {
        match self {
            Self::Outcome(_) => WantKind::Outcome,
            Self::Tilt(_) => WantKind::Tilt,
            Self::Attitude(_) => WantKind::Attitude,
            Self::Trace { .. } => WantKind::Trace,
            Self::Probability(_) => WantKind::Probability,
        }
    }

    /// The points of its trace; 1 for anything else.
    pub(crate) fn points(&self) -> usize {
        if let Self::Trace { points, .. } = self { *points } else { 1 }
    }

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

impl Scene {
    /// The scene of `want`, to be answered by the cheapest model.
    pub fn new(want: Want, accuracy: f64) -> Self {
        Self { want, accuracy, by: None }
    }

    /// The same scene, to be answered by an integrator.
    #[must_use]
    pub fn by(self, solver: &str, scheme: Option<&str>) -> Self {
        let by = Integrator { solver: solver.to_owned(), scheme: scheme.map(str::to_owned) };
        Self { by: Some(by), ..self }
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
        let asked = Scene::new(scene.want, 1e-3).by("gamma", Some("dopri5"));
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
