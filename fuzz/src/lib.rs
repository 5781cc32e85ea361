//! Fuzz targets: each module has one function `check` that takes any bytes and panics if a claim does not hold for them.
//! `cargo xtask fuzz` runs them by libFuzzer, and the tests of this crate over the seeds.
//!
//! A claim is more than "no panic": an input gives a typed error or a finite answer, what is written reads back as the
//! same, and two ways to one answer agree.

pub mod bodies;
pub mod columns;
pub mod enclosure;
pub mod part;
pub mod program;
pub mod quantity;
pub mod rows;
pub mod scene;
pub mod space;

/// A target.
pub type Target = fn(&[u8]);

/// All targets by their names, which are those of their folders of seeds.
pub const TARGETS: [(&str, Target); 8] = [
    ("bodies", bodies::check),
    ("columns", columns::check),
    ("enclosure", enclosure::check),
    ("part", part::check),
    ("quantity", quantity::check),
    ("rows", rows::check),
    ("scene", scene::check),
    ("space", space::check),
];

/// Checks that `error` says something.
fn assert_said(error: &dyn std::fmt::Display) {
    assert!(!error.to_string().trim().is_empty(), "an error without words");
}

/// Checks that `value` reads back as itself from JSON and from TOML.
fn assert_round_trip<T>(value: &T)
where
    T: serde::Serialize + serde::de::DeserializeOwned + PartialEq + std::fmt::Debug,
{
    let json = serde_json::to_string(value).expect("it can be written as JSON");
    let read: T = serde_json::from_str(&json).unwrap_or_else(|error| panic!("{json}: {error}"));
    assert_eq!(&read, value, "by {json}");
    let toml = toml::to_string(value).expect("it can be written as TOML");
    let read: T = toml::from_str(&toml).unwrap_or_else(|error| panic!("{toml}: {error}"));
    assert_eq!(&read, value, "by {toml}");
}

/// The value in a text of JSON or TOML, tried in this order.
fn read<T: serde::de::DeserializeOwned>(text: &str) -> Option<T> {
    match serde_json::from_str(text) {
        Ok(value) => return Some(value),
        Err(error) => assert_said(&error),
    }
    toml::from_str(text).map_err(|error| assert_said(&error)).ok()
}
