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
#[cfg_attr(feature = "serde", derive(Serialize), serde(rename_all = "kebab-case"))]
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
    use std::fmt;

    use dynamics::Toss;
    use dynamics::error::find_named;
    use serde::de::{Error, MapAccess, Visitor};
    use serde::{Deserialize, Deserializer};

    use super::{Want, WantKind};

    /// What is wanted by its name, which is refused where it stands.
    struct Kind(WantKind);

    impl<'de> Deserialize<'de> for Kind {
        fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
            let name = String::deserialize(from)?;
            find_named("want", &name, &WantKind::ALL, |kind| kind.name()).copied().map(Self).map_err(D::Error::custom)
        }
    }

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Trace {
        toss: Toss,
        points: usize,
    }

    struct Reader;

    impl<'de> Visitor<'de> for Reader {
        type Value = Want;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("a table with one of outcome, tilt, attitude, trace and probability")
        }

        fn visit_str<E: Error>(self, name: &str) -> Result<Want, E> {
            let kind = find_named("want", name, &WantKind::ALL, |kind| kind.name()).map_err(E::custom)?;
            let of = match kind {
                WantKind::Probability => "the space of launches, as in [want.probability] rate_x = ..",
                WantKind::Trace => "the toss, as in [want.trace] points = .. and [want.trace.toss.launch] rate = ..",
                _ => "the toss, as in [want.tilt] launch = { rate = .., speed = .. }",
            };
            Err(E::custom(format!("want = '{name}' is a name alone: below it stands {}", of.replace("tilt", name))))
        }

        fn visit_map<A: MapAccess<'de>>(self, mut table: A) -> Result<Want, A::Error> {
            let Some(Kind(kind)) = table.next_key()? else {
                return Err(A::Error::custom(
                    "want is empty: expected one of outcome, tilt, attitude, trace and probability",
                ));
            };
            let want = match kind {
                WantKind::Outcome => Want::Outcome(table.next_value()?),
                WantKind::Tilt => Want::Tilt(table.next_value()?),
                WantKind::Attitude => Want::Attitude(table.next_value()?),
                WantKind::Trace => {
                    let Trace { toss, points } = table.next_value()?;
                    Want::Trace { toss, points }
                }
                WantKind::Probability => Want::Probability(table.next_value()?),
            };
            match table.next_key::<String>()? {
                None => Ok(want),
                Some(other) => {
                    let message = format!("want is '{}' and '{other}': expected one of them", kind.name());
                    Err(A::Error::custom(message))
                }
            }
        }
    }

    impl<'de> Deserialize<'de> for Want {
        fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
            from.deserialize_any(Reader)
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
            (format!("accuracy = 1\n[want.heads]\n{launch}"), "want = 'heads' is unknown; known: outcome, tilt"),
            ("accuracy = 1\nwant = 'heads'".to_owned(), "want = 'heads' is unknown; known: outcome, tilt"),
            (
                "accuracy = 1\nwant = 'outcome'".to_owned(),
                "want = 'outcome' is a name alone: below it stands the toss, as in [want.outcome]",
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
