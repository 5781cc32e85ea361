//! What the counts of people's flips say, of all and of each alone: the answer of every interface.

use dynamics::InputError;

use crate::interval::Interval;
use crate::people_file::Named;
use crate::practice::Practice;
use crate::same_side::{Cone, SameSide, SameSideBias};

/// What is known of people and of ψ from counts.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Counted {
    /// What all flips say.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub found: SameSideBias,
    /// Whether people change as they flip on; `None` without the order of the flips.
    pub practice: Option<Practice>,
    /// Each person with a toss, if there are several.
    pub people: Vec<Person>,
    /// How many people tossed nothing.
    pub absent: usize,
}

/// A person of several, alone.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Person {
    /// The name.
    pub person: String,
    /// The flips.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub counts: SameSide,
    /// The share on the same side.
    pub probability: f64,
    /// The interval of the probability.
    pub interval: Interval,
    /// ψ (rad); `None` if none explains the counts.
    pub cone_angle: Option<f64>,
    /// Its interval (rad).
    pub cone_angle_interval: Option<[f64; 2]>,
}

impl Counted {
    /// What the flips of `people` say.
    ///
    /// # Errors
    /// As [`SameSideBias::of`].
    pub fn of(people: &[Named]) -> Result<Self, InputError> {
        let counts: Vec<SameSide> = people.iter().map(|person| person.counts).collect();
        let found = SameSideBias::of(&counts)?;
        let absent = people.len() - found.people;
        let practice = Practice::of(people);
        let present = people.iter().filter(|person| found.people > 1 && person.counts.tosses() > 0);
        let people = present.map(Person::new).collect::<Result<_, _>>()?;
        Ok(Self { found, practice, people, absent })
    }
}

impl Person {
    fn new(Named { name, counts, .. }: &Named) -> Result<Self, InputError> {
        let alone = SameSideBias::of(&[*counts])?;
        Ok(Self {
            person: name.clone(),
            counts: *counts,
            probability: alone.share,
            interval: alone.interval,
            cone_angle: alone.cone.map(|cone: Cone| cone.angle),
            cone_angle_interval: alone.cone.map(|cone| cone.interval),
        })
    }
}
