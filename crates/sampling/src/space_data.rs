//! This file reads and writes spaces as plain data by serde, so that they can be part of any file format. A space is
//! written as its coin and, for each coordinate by its name, a number or a text.

use dynamics::{Body, Coin, Dimension, InputError};
use serde::{Deserialize, Serialize};

use crate::coordinate::Coordinate;
use crate::space::Space;

/// The value of a coordinate in a file.
#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "expected a number, or a text like \"3:5:500\"")]
pub(crate) enum Entry {
    Number(f64),
    Text(String),
}

impl Entry {
    /// The value as a text for [`Space::parse`].
    pub(crate) fn text(self) -> String {
        match self {
            // Display writes the fewest digits that read back as the same number.
            Self::Number(number) => number.to_string(),
            Self::Text(text) => text,
        }
    }
}

/// The default body of a space, the coin of the paper.
pub(crate) fn paper() -> Body {
    Coin::PAPER.into()
}

/// A space in a file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpaceData {
    #[serde(default = "paper", alias = "body")]
    coin: Body,
    #[serde(alias = "rate-x", skip_serializing_if = "Option::is_none")]
    rate_x: Option<Entry>,
    #[serde(alias = "rate-y", skip_serializing_if = "Option::is_none")]
    rate_y: Option<Entry>,
    #[serde(alias = "rate-z", skip_serializing_if = "Option::is_none")]
    rate_z: Option<Entry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    speed: Option<Entry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gravity: Option<Entry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt: Option<Entry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    turn: Option<Entry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    psi: Option<Entry>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drop: Option<Entry>,
}

impl TryFrom<SpaceData> for Space {
    type Error = InputError;

    fn try_from(data: SpaceData) -> Result<Self, InputError> {
        let SpaceData { coin, rate_x, rate_y, rate_z, speed, gravity, tilt, turn, psi, drop } = data;
        let entries = Coordinate::ALL.into_iter().zip([rate_x, rate_y, rate_z, speed, gravity, tilt, turn, psi]);
        let texts: Vec<_> = entries.filter_map(|(of, entry)| Some((of, entry?.text()))).collect();
        let texts: Vec<(Coordinate, &str)> = texts.iter().map(|(of, text)| (*of, text.as_str())).collect();
        let drop = drop.map(|drop| Dimension::Length.read("drop [m]", &drop.text())).transpose()?;
        Self::parse(coin, &texts)?.with_drop(drop)
    }
}

impl From<Space> for SpaceData {
    fn from(space: Space) -> Self {
        let entry = |of: Coordinate| Some(Entry::Text(space.axis_or_tie(of)?.to_string()));
        let [rate_x, rate_y, rate_z, speed, gravity, tilt, turn, psi] = Coordinate::ALL.map(entry);
        Self {
            coin: *space.body(),
            rate_x,
            rate_y,
            rate_z,
            speed,
            gravity,
            tilt,
            turn,
            psi,
            drop: space.drop().map(Entry::Number),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space_file::named_spaces;

    #[test]
    fn a_written_space_reads_back_the_same() {
        for (name, named) in named_spaces() {
            let text = toml::to_string(&named.space).unwrap();
            assert_eq!(toml::from_str::<Space>(&text).unwrap(), named.space, "{name}: {text}");
            let dropped = named.space.with_drop(Some(1.25)).unwrap();
            assert_eq!(toml::from_str::<Space>(&toml::to_string(&dropped).unwrap()).unwrap(), dropped);
            let body = named.space.with_body(dynamics::catalogue::named_body("us-quarter-engraved").unwrap()).unwrap();
            assert_eq!(toml::from_str::<Space>(&toml::to_string(&body).unwrap()).unwrap(), body);
        }
    }

    #[test]
    fn errors_name_the_coordinate_or_key() {
        for (text, message) in [
            ("rate_x = 1\nrate_y = 1\nrate_z = 1\nspeed = '5:3'", "speed [m/s] = 3.0"),
            (
                "rate_x = 1\nrate_y = 1\nrate_z = 1\nspeed = 3\nspin = 1",
                "unknown field `spin`, expected one of `body`, `coin`",
            ),
            ("rate_x = 1\nrate_y = 1\nrate_z = 1\nspeed = 1\ndrop = '3s'", "drop [m] = '3s'"),
            ("rate_x = 1\nrate_y = 1\nrate_z = 1", "speed [m/s] is missing"),
        ] {
            let found = toml::from_str::<Space>(text).unwrap_err();
            assert!(found.message().starts_with(message), "{found}");
        }
    }
}
