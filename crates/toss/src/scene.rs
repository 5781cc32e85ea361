//! A scene is a question to the planner: what is wanted, of which toss or space of launches, and how accurately. It is
//! plain data, so that it can be written to and read from a TOML or JSON file:
//!
//! ```toml
//! accuracy = 1e-9
//!
//! [want.tilt]   # or outcome, attitude; [want.trace] has toss and points, [want.probability] a space
//! coin = "us-quarter"
//! launch = { rate = [20.0, 0.0, 5.0], speed = 3.0 }
//! ```
//!
//! The coin may be any rigid body.

use dynamics::Toss;
use sampling::Space;
#[cfg(feature = "serde")]
use serde::{Deserialize, Serialize};

/// A question about a toss or a space of launches, with the accuracy wanted.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize), serde(deny_unknown_fields))]
pub struct Scene {
    /// What is wanted.
    pub want: Want,
    /// The largest acceptable error, > 0: of cos θ, of attitudes (rad) or of the probability. It has no influence on an
    /// outcome, which is proven; an outcome by an integrator is decided where |cos θ| exceeds it.
    pub accuracy: f64,
    /// An integrator that is used instead of the cheapest model, as a cross-check.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub by: Option<Integrator>,
}

/// What is wanted, and of which toss or space.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(Serialize, Deserialize),
    serde(rename_all = "kebab-case", try_from = "data::Wanted")
)]
pub enum Want {
    /// Heads or tails.
    Outcome(Toss),
    /// cos θ at landing.
    Tilt(Toss),
    /// Attitude and body rate at landing.
    Attitude(Toss),
    /// The flight at equally spaced times.
    Trace {
        /// The toss whose flight it is.
        toss: Toss,
        /// Number of times, launch and landing included.
        points: usize,
    },
    /// The probability of heads over a space of launches.
    Probability(Space),
}

/// An integrator that a scene asks for, with or without its scheme. Its tolerance follows from the accuracy by
/// flights of the toss: by their errors against the exact motion, or, of one that proves, by their proven bounds.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(Serialize, Deserialize), serde(deny_unknown_fields))]
pub struct Integrator {
    /// Name of the solver in the [`Registry`](crate::Registry).
    pub solver: String,
    /// Name of the scheme, one that takes a tolerance; if it is `None`, the cheapest one is taken.
    #[cfg_attr(feature = "serde", serde(alias = "method", skip_serializing_if = "Option::is_none"))]
    pub scheme: Option<String>,
    /// Whether the error, of cos θ or of an attitude, has to be proven to be within the accuracy; the answer is an
    /// [`Answer::Enclosed`](crate::Answer).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "std::ops::Not::not"))]
    pub prove: bool,
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
    /// The flight at equally spaced times.
    Trace,
    /// The probability of heads.
    Probability,
}

impl WantKind {
    /// All kinds.
    pub const ALL: [Self; 5] = [Self::Outcome, Self::Tilt, Self::Attitude, Self::Trace, Self::Probability];

    /// Its name in files and options, such as `outcome`.
    pub fn name(self) -> &'static str {
        ["outcome", "tilt", "attitude", "trace", "probability"][self as usize]
    }

    /// What is wanted, for the help text of an option.
    pub fn summary(self) -> &'static str {
        [
            "Heads or tails",
            "cos θ at landing",
            "The attitude at landing",
            "The flight at equally spaced times",
            "The probability of heads over a space of launches",
        ][self as usize]
    }

    /// What is wanted, in words.
    pub fn words(self) -> &'static str {
        ["the outcome", "cos θ", "one landing", "a flight", "a probability"][self as usize]
    }
}

impl Want {
    /// The kind of what is wanted.
    pub fn kind(&self) -> WantKind {
        match self {
            Self::Outcome(_) => WantKind::Outcome,
            Self::Tilt(_) => WantKind::Tilt,
            Self::Attitude(_) => WantKind::Attitude,
            Self::Trace { .. } => WantKind::Trace,
            Self::Probability(_) => WantKind::Probability,
        }
    }

    /// The number of points of a trace; 1 for anything else.
    pub(crate) fn points(&self) -> usize {
        if let Self::Trace { points, .. } = self { *points } else { 1 }
    }

    /// The toss of the question; `None` for a space.
    pub fn toss(&self) -> Option<&Toss> {
        match self {
            Self::Outcome(toss) | Self::Tilt(toss) | Self::Attitude(toss) | Self::Trace { toss, .. } => Some(toss),
            Self::Probability(_) => None,
        }
    }

    /// The same question about another toss. A question about a space is returned unchanged.
    #[must_use]
    pub fn of(&self, toss: impl Into<Toss>) -> Self {
        let toss = toss.into();
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
    /// A scene that is answered by the cheapest model.
    pub fn new(want: Want, accuracy: f64) -> Self {
        Self { want, accuracy, by: None }
    }

    /// The same scene, answered by the integrator called `solver`; without a `scheme`, by its cheapest one.
    #[must_use]
    pub fn by(self, solver: &str, scheme: Option<&str>) -> Self {
        let by = Integrator { solver: solver.to_owned(), scheme: scheme.map(str::to_owned), prove: false };
        Self { by: Some(by), ..self }
    }

    /// The same scene, answered by an integration that proves its error to be within the accuracy, without the closed form.
    #[must_use]
    pub fn proven(self) -> Self {
        let by = Integrator { solver: "quaternion".to_owned(), scheme: None, prove: true };
        Self { by: Some(by), ..self }
    }
}

#[cfg(feature = "serde")]
mod data {
    use dynamics::Toss;
    use sampling::Space;
    use serde::Deserialize;

    use super::Want;

    /// What is wanted as it stands in a file: one of these tables.
    #[derive(Deserialize)]
    #[serde(
        deny_unknown_fields,
        expecting = "a table below its name, as in [want.tilt] launch = { rate = .., speed = .. }"
    )]
    pub(super) struct Wanted {
        outcome: Option<Toss>,
        tilt: Option<Toss>,
        attitude: Option<Toss>,
        trace: Option<Trace>,
        probability: Option<Space>,
    }

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Trace {
        toss: Toss,
        points: usize,
    }

    impl TryFrom<Wanted> for Want {
        type Error = String;

        fn try_from(wanted: Wanted) -> Result<Self, String> {
            let trace = wanted.trace.map(|Trace { toss, points }| Self::Trace { toss, points });
            let tosses = [
                wanted.outcome.map(Self::Outcome),
                wanted.tilt.map(Self::Tilt),
                wanted.attitude.map(Self::Attitude),
                trace,
                wanted.probability.map(Self::Probability),
            ];
            let mut given = tosses.into_iter().flatten();
            match (given.next(), given.next()) {
                (Some(want), None) => Ok(want),
                (Some(one), Some(other)) => {
                    let [one, other] = [one, other].map(|want| want.kind().name());
                    Err(format!("want is '{one}' and '{other}': expected one of them"))
                }
                _ => Err("want is empty: expected one of outcome, tilt, attitude, trace and probability".to_owned()),
            }
        }
    }
}

#[cfg(feature = "serde")]
#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_survives_toml_and_back() {
        let text =
            "accuracy = 1e-9\n[want.trace]\npoints = 50\n[want.trace.toss.launch]\nrate = [1, 1, 2.5]\nspeed = 3.0\n";
        let scene: Scene = toml::from_str(text).unwrap();
        assert!(matches!(scene.want, Want::Trace { points: 50, .. }));
        let asked = Scene::new(scene.want, 1e-3).by("gamma", Some("dopri5"));
        let back: Scene = toml::from_str(&toml::to_string(&asked).unwrap()).unwrap();
        assert_eq!(back, asked);
        let proven = Scene::new(back.want, 1e-3).proven();
        let text = toml::to_string(&proven).unwrap();
        assert!(text.contains("prove = true"), "{text}");
        assert_eq!(toml::from_str::<Scene>(&text).unwrap(), proven);
        let text = "accuracy = 1e-3\n[want.probability]\nrate_x = '0:9'\nrate_y = 'x'\nrate_z = 5\nspeed = '3:5'\n";
        let space: Scene = toml::from_str(text).unwrap();
        assert_eq!(toml::from_str::<Scene>(&toml::to_string(&space).unwrap()).unwrap(), space);
    }

    #[test]
    fn scene_files_with_misspelt_fields_or_drag_are_refused() {
        let launch = "launch = { rate = [1, 1, 2.5], speed = 3.0 }\n";
        for (text, message) in [
            (format!("acuracy = 1\n[want.tilt]\n{launch}"), "unknown field `acuracy`"),
            (
                format!("accuracy = 1\n[want.heads]\n{launch}"),
                "unknown field `heads`, expected one of `outcome`, `tilt`",
            ),
            (
                "accuracy = 1\nwant = 'outcome'".to_owned(),
                "invalid type: string \"outcome\", expected a table below its name, as in [want.tilt] launch",
            ),
            ("accuracy = 1\nwant = {}".to_owned(), "want is empty"),
            (
                format!("accuracy = 1\n[want.tilt]\n{launch}[want.outcome]\n{launch}"),
                "want is 'outcome' and 'tilt': expected one of them",
            ),
            ("accuracy = 1\n[want]\ntrace = 5".to_owned(), "invalid type"),
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
