//! This file reads spaces from TOML files, and holds the spaces that come with the crate under a name. Its errors give
//! line and column, because such files are written by hand, like this one:
//!
//! ```toml
//! description = "a hand that spins the coin at 20 ± 2 rad/s"
//! coin = "us-quarter"              # or { moments = [I1, I3] } or { cylinder = [mass, radius, thickness] }, or any body:
//!                                  # { moments = [I1, I2, I3] } or { inertia = [Jxx, Jyy, Jzz, Jxy, Jxz, Jyz] }
//! rate_x = "normal:20:2"           # mean and standard deviation
//! rate_y = "x"                     # the same value as rate_x
//! rate_z = 5                       # fixed
//! speed = "3:5:500"                # a range, with 500 points for a grid
//! gravity = 9.81                   # this and the next are the defaults
//! tilt = "0deg"                    # a text may have a unit
//! drop = 1.2                       # m, how far below its launch the coin lands; by default at the same height
//! ```

use std::ops::Range;

use dynamics::data::in_words;
use dynamics::error::find_named;
use dynamics::{Error, InputError};
use toml::Spanned;

use crate::coordinate::Coordinate;
use crate::space::Space;
use crate::space_data::{Entry, SpaceData};

/// A space with its description.
#[derive(Debug, Clone, PartialEq)]
pub struct DescribedSpace {
    /// The description, in a line; empty if the file has none.
    pub description: String,
    /// The space.
    pub space: Space,
}

impl DescribedSpace {
    /// Reads a space from TOML in the format that [this module](self) shows. If no coin is given, it is the paper's.
    ///
    /// # Errors
    /// [`Error::Text`] with the line and column of the error.
    pub fn from_toml(text: &str) -> Result<Self, Error> {
        // The mark of UTF-8 that some editors put before a text.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut data: SpaceData<Spanned<Entry>> = toml::from_str(text)
            .map_err(|error: toml::de::Error| error_at(text, error.span(), in_words(error.message())))?;
        let given: Vec<(Coordinate, Range<usize>, String)> =
            data.take_coordinates().map(|(of, entry)| (of, entry.span(), entry.into_inner().text())).collect();
        let SpaceData { description, coin, .. } = data;
        let texts: Vec<(Coordinate, &str)> = given.iter().map(|(of, _, text)| (*of, text.as_str())).collect();
        let space = Space::parse(coin, &texts).map_err(|error| {
            let blamed = given.iter().find(|(of, ..)| of.field() == error.field());
            error_at(text, blamed.map(|(_, span, _)| span.clone()), error.to_string())
        })?;
        Ok(Self { description, space })
    }
}

/// An error at the start of `span` in `text`, or at the end of its last line if there is no span because a coordinate is
/// missing.
fn error_at(text: &str, span: Option<Range<usize>>, message: String) -> Error {
    Error::in_text(text, span.map(|span| span.start), message)
}

/// Names and texts of the named spaces.
const NAMED: &[(&str, &str)] = &[
    ("paper-fig4", include_str!("../spaces/paper-fig4.toml")),
    ("cheated", include_str!("../spaces/cheated.toml")),
    ("tails", include_str!("../spaces/tails.toml")),
];

/// All named spaces, with their names.
///
/// # Panics
/// Never, because a test reads all of them.
pub fn named_spaces() -> impl Iterator<Item = (&'static str, DescribedSpace)> {
    NAMED.iter().map(|(name, text)| (*name, DescribedSpace::from_toml(text).expect("a test reads them all")))
}

/// The space called `name`.
///
/// # Errors
/// [`InputError::UnknownName`] with the list of known names.
pub fn named_space(name: &str) -> Result<Space, InputError> {
    let (_, text) = find_named("space", name, NAMED, |(name, _)| name)?;
    Ok(DescribedSpace::from_toml(text).expect("a test reads them all").space)
}

#[cfg(test)]
mod tests {
    use dynamics::Coin;

    use super::*;

    #[test]
    fn named_spaces_have_a_description_and_the_expected_grid() {
        let sizes: Vec<u64> = named_spaces().map(|(_, named)| named.space.grid_points().unwrap()).collect();
        assert_eq!(sizes, [250_000, 500, 500]);
        assert!(named_spaces().all(|(name, named)| {
            !named.description.is_empty()
                && named.space.coin() == Some(Coin::PAPER)
                && named_space(name) == Ok(named.space)
        }));
        let unknown = named_space("moon").unwrap_err().to_string();
        assert!(unknown.contains("known: paper-fig4, cheated, tails"), "{unknown}");
    }

    #[test]
    fn a_file_can_set_the_coin_and_every_coordinate() {
        let text = "description = 'd'\ncoin = { cylinder = [0.00567, 0.01213, 0.00175] }\nrate_x = 'normal:20:2'\n\
                    rate_y = 'x'\nrate_z = -5e0\nspeed = '3:5:7'\ngravity = '9.78:9.83'\ntilt = 0.1\ndrop = '50cm'";
        let described = DescribedSpace::from_toml(text).unwrap();
        let texts = ["normal:20:2", "x", "-5", "3:5:7", "9.78:9.83", "0.1"];
        let texts: Vec<_> = Coordinate::ALL.into_iter().zip(texts).collect();
        let coin = Coin::from_cylinder(0.00567, 0.01213, 0.00175).unwrap();
        assert_eq!(described.space, Space::parse(coin, &texts).unwrap().with_drop(Some(0.5)).unwrap());
        assert_eq!(described.description, "d");
    }

    #[test]
    fn rates_may_be_called_as_on_the_command_line() {
        let text = "rate-x = '0:1'\nrate-y = 'x'\nrate-z = 0\nspeed = 3\n";
        let named = DescribedSpace::from_toml(&text.replace("rate-", "rate_")).unwrap();
        assert_eq!(DescribedSpace::from_toml(text), Ok(named.clone()));
        assert_eq!(toml::from_str::<Space>(text).unwrap(), named.space);
        let twice = DescribedSpace::from_toml(&format!("{text}rate_x = 3\n")).unwrap_err();
        assert!(twice.to_string().contains("duplicate field `rate_x`"), "{twice}");
    }

    #[test]
    fn errors_give_line_and_column() {
        let valid = "rate_x = '0:1'\nrate_y = 'x'\nrate_z = 0\nspeed = 3\n";
        for (text, line, column, words) in [
            (valid.replace("'0:1'", "'1:0'"), 1, 10, "rate x [rad/s] = 0.0"),
            (valid.replace("= 3", "=   '-1:5'"), 4, 11, "speed [m/s] = -1.0"),
            (valid.replace("= 3", "= 'normal:4:1'"), 4, 9, "speed [m/s] = -4.3"),
            (valid.replace("rate_x = '0:1'\n", ""), 1, 10, "rate y [rad/s] = 'x'"),
            (valid.replace("speed = 3\n", ""), 3, 11, "speed [m/s] is missing"),
            (valid.replace("rate_x = '0:1'", "\u{feff}rate_x = '1:0'"), 1, 10, "rate x [rad/s] = 0.0"),
            (format!("{valid}description = 3"), 5, 15, "invalid type: number `3`, expected a string"),
            (valid.replace("= 0", "= [0, 1]"), 3, 10, "expected a number, or a text like"),
            (valid.replace("= 0", "= "), 3, 10, ""),
            (format!("{valid}ω = 3"), 5, 1, ""),
            (format!("{valid}spin = 3"), 5, 1, "unknown field `spin`"),
            (format!("{valid}gravity = 0"), 5, 11, "gravity [m/s²] = 0.0"),
            (format!("{valid}coin = 'groat'"), 5, 8, "coin = 'groat' is unknown"),
            (format!("{valid}coin = {{ moments = [1, 3] }}"), 5, 8, "I3 [kg m²] = 3.0"),
            (
                format!("{valid}body = {{ moments = [1, 2, 4] }}"),
                5,
                8,
                "I3 [kg m²] = 4.0 is larger than I1 + I2 by 1.0",
            ),
            (
                format!("{valid}coin = {{ mass = 1 }}"),
                5,
                10,
                "unknown field `mass`, expected one of `moments`, `cylinder`, `inertia`",
            ),
            (format!("{valid}tilt = nan"), 5, 8, "tilt [rad] = NaN"),
            (format!("{valid}tilt = '3m'"), 5, 8, "an angle in rad, deg"),
            (format!("{valid}drop = '3s'"), 5, 8, "drop [m] = '3s'"),
            (format!("{valid}drop = -0.459"), 5, 8, "drop [m] = -0.459"),
            (String::new(), 1, 1, "rate x [rad/s] is missing"),
        ] {
            let error = DescribedSpace::from_toml(&text).unwrap_err();
            assert!(error.to_string().starts_with(&format!("line {line}, column {column}: ")), "{text}: {error}");
            assert!(error.to_string().contains(words), "{text}: {error}");
        }
    }
}
