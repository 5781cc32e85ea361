//! This file reads and writes spaces as plain data by serde, so that they can be part of any file format. A space is
//! written as its coin and, for each coordinate by its name, a number or a text.

use dynamics::{Body, Coin, InputError};
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

/// A space in a file, with an entry `E` for each coordinate.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpaceData<E = Entry> {
    #[serde(default, skip_serializing)]
    pub(crate) description: String,
    #[serde(default = "paper", alias = "body")]
    pub(crate) coin: Body,
    #[serde(alias = "rate-x", skip_serializing_if = "Option::is_none")]
    rate_x: Option<E>,
    #[serde(alias = "rate-y", skip_serializing_if = "Option::is_none")]
    rate_y: Option<E>,
    #[serde(alias = "rate-z", skip_serializing_if = "Option::is_none")]
    rate_z: Option<E>,
    #[serde(skip_serializing_if = "Option::is_none")]
    speed: Option<E>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gravity: Option<E>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tilt: Option<E>,
    #[serde(skip_serializing_if = "Option::is_none")]
    turn: Option<E>,
    #[serde(skip_serializing_if = "Option::is_none")]
    psi: Option<E>,
    #[serde(skip_serializing_if = "Option::is_none")]
    drop: Option<E>,
}

impl<E> SpaceData<E> {
    /// Takes out the coordinates that are given.
    pub(crate) fn take_coordinates(&mut self) -> impl Iterator<Item = (Coordinate, E)> {
        let Self { rate_x, rate_y, rate_z, speed, gravity, tilt, turn, psi, drop, .. } = self;
        let entries = [rate_x, rate_y, rate_z, speed, gravity, tilt, turn, psi, drop].map(Option::take);
        Coordinate::ALL.into_iter().zip(entries).filter_map(|(of, entry)| Some((of, entry?)))
    }
}

impl TryFrom<SpaceData> for Space {
    type Error = InputError;

    fn try_from(mut data: SpaceData) -> Result<Self, InputError> {
        let texts: Vec<_> = data.take_coordinates().map(|(of, entry)| (of, entry.text())).collect();
        let texts: Vec<(Coordinate, &str)> = texts.iter().map(|(of, text)| (*of, text.as_str())).collect();
        Self::parse(data.coin, &texts)
    }
}

impl From<Space> for SpaceData {
    fn from(space: Space) -> Self {
        let entry = |of: Coordinate| Some(Entry::Text(space.axis_or_tie(of)?.to_string()));
        let [rate_x, rate_y, rate_z, speed, gravity, tilt, turn, psi, drop] = Coordinate::ALL.map(entry);
        Self {
            description: String::new(),
            coin: *space.body(),
            rate_x,
            rate_y,
            rate_z,
            speed,
            gravity,
            tilt,
            turn,
            psi,
            drop,
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
                "unknown field `spin`, expected one of `description`, `body`, `coin`",
            ),
            ("rate_x = 1\nrate_y = 1\nrate_z = 1\nspeed = 1\ndrop = '3s'", "drop [m] = '3s'"),
            ("rate_x = 1\nrate_y = 1\nrate_z = 1", "speed [m/s] is missing"),
        ] {
            let found = toml::from_str::<Space>(text).unwrap_err();
            assert!(found.message().starts_with(message), "{found}");
        }
    }
}
