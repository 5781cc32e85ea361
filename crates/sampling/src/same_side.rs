//! How often coins land on the side that had been up, and the angle ψ that explains it. In the limit of long flights from horizontal
//! the share p of such landings follows from the angle ψ between the coin's normal and its angular momentum, p = ½ +
//! asin(cot²ψ)/π; see [`long_flight_probability`](crate::long_flight_probability). This file turns counts into ψ.
//!
//! It assumes that all launches leave flat, turn many times and have the same ψ. The angle 180° - ψ, of the opposite spin,
//! explains them as well. People differ, and the ψ of several is that of the mean share [over people](mod@crate::people). As p is
//! nearly quadratic in 90° - ψ, it is the ψ of the root mean square tilt, not the mean ψ.

use dynamics::InputError;
use dynamics::error::require;

use crate::estimate::LEVEL;
use crate::interval::{Interval, clopper_pearson};
use crate::long_flight::long_flight_cone;
use crate::people::{People, Spread};

/// How many of the tosses of a person landed on the side that had been up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SameSide {
    same: u64,
    tosses: u64,
}

impl SameSide {
    /// `same` of `tosses`, which may be 0 of 0 for a person who was absent.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for more landings on the same side than tosses.
    #[expect(clippy::cast_precision_loss, reason = "shown, not computed with")]
    pub fn new(same: u64, tosses: u64) -> Result<Self, InputError> {
        require("same", same as f64, "0 to the number of tosses", same <= tosses)?;
        Ok(Self { same, tosses })
    }

    /// The counts of flips of which each landed on the side that had been up, or did not.
    pub fn of_landings(landings: &[bool]) -> Self {
        Self { same: landings.iter().filter(|same| **same).count() as u64, tosses: landings.len() as u64 }
    }

    /// The number of landings on the same side.
    pub fn same(self) -> u64 {
        self.same
    }

    /// The number of tosses.
    pub fn tosses(self) -> u64 {
        self.tosses
    }

    /// The counts of `people` together.
    ///
    /// # Errors
    /// [`InputError::Malformed`] if they tossed 2^64 coins or more.
    pub fn sum(people: impl IntoIterator<Item = Self>) -> Result<Self, InputError> {
        let add = |sum: Self, one: Self| {
            let tosses = sum.tosses.checked_add(one.tosses)?;
            Some(Self { same: sum.same + one.same, tosses })
        };
        let (value, expected) = ("2^64 or more".to_owned(), "fewer for all people together");
        let sum = people.into_iter().try_fold(Self { same: 0, tosses: 0 }, add);
        sum.ok_or(InputError::Malformed { field: "tosses", value, expected })
    }

    /// The share of landings on the same side, of at least one toss.
    #[expect(clippy::cast_precision_loss, reason = "nobody tosses 2^53 coins")]
    pub fn share(self) -> f64 {
        self.same as f64 / self.tosses as f64
    }
}

/// The same-side bias of people, and the angle ψ that explains it. Intervals are at the confidence [`LEVEL`].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SameSideBias {
    /// The counts of all people together.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub counts: SameSide,
    /// Number of people with at least one toss.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub people: usize,
    /// The share of all landings on the same side.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub share: f64,
    /// Clopper and Pearson's interval of the mean probability of these people, weighted by their tosses. It holds however
    /// people differ, and says nothing about others.
    pub these_flips: Interval,
    /// The mean probability over people like these, each counted once; of one person the share.
    #[cfg_attr(feature = "serde", serde(rename = "mean_over_people"))]
    pub mean: f64,
    /// The interval of the mean over people; of one person `these_flips`.
    pub interval: Interval,
    /// What the interval means.
    pub interval_kind: String,
    /// How much people differ; `None` for one person, and if all landings are the same.
    pub spread: Option<Spread>,
    /// Where the probability of a further person lies; `None` for fewer than three people.
    pub next_person: Option<Interval>,
    /// ψ; `None` if the whole interval is below ½, which no ψ explains. With serde it is its interval.
    #[cfg_attr(feature = "serde", serde(rename = "cone_angle_interval", serialize_with = "interval_of"))]
    pub cone: Option<Cone>,
}

#[cfg(feature = "serde")]
fn interval_of<S: serde::Serializer>(cone: &Option<Cone>, to: S) -> Result<S::Ok, S::Error> {
    serde::Serialize::serialize(&cone.map(|cone| cone.interval), to)
}

/// The angle ψ between normal and angular momentum (rad), from π/4 for a share of 1, which every smaller angle has too, to
/// π/2 for a share of ½ or less.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// ψ of the mean over people.
    pub angle: f64,
    /// The smallest and the largest ψ that have a share in the interval.
    pub interval: [f64; 2],
}

/// Fewer people than these say little about others.
pub const FEW_PEOPLE: usize = 6;

impl SameSideBias {
    /// The bias of `people`. Those without a toss are passed over.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if nobody tossed a coin, or if several people tossed more than 10^12, whose counts f64
    /// could not tell apart well enough; [`InputError::Malformed`] if they tossed 2^64 coins or more.
    #[expect(clippy::cast_precision_loss, reason = "several people have at most 10^12 tosses")]
    pub fn of(people: &[SameSide]) -> Result<Self, InputError> {
        const MOST: u64 = 1_000_000_000_000;
        let counts = SameSide::sum(people.iter().copied())?;
        require("tosses", counts.tosses as f64, "at least 1", counts.tosses > 0)?;
        let present: Vec<[f64; 2]> =
            people.iter().filter(|one| one.tosses > 0).map(|one| [one.same as f64, one.tosses as f64]).collect();
        let share = counts.share();
        let these_flips = clopper_pearson(counts.same, counts.tosses, LEVEL);
        let alone = Self {
            counts,
            people: present.len(),
            share,
            these_flips,
            mean: share,
            interval: these_flips,
            interval_kind: "clopper-pearson 95 %".to_owned(),
            spread: None,
            next_person: None,
            cone: Cone::of(share, these_flips)?,
        };
        if present.len() == 1 {
            return Ok(alone);
        }
        let valid = "at most 1e12 for several people together";
        require("tosses", counts.tosses as f64, valid, counts.tosses <= MOST)?;
        let people = People::new(present);
        let (mean, interval) = people.mean(these_flips);
        Ok(Self {
            mean,
            interval,
            interval_kind: format!("beta-binomial 95 % of {} people", alone.people),
            spread: people.spread(),
            next_person: people.next_person(),
            cone: Cone::of(mean, interval)?,
            ..alone
        })
    }
}

impl Cone {
    /// ψ of a share in an `interval`; `None` if that is below ½.
    fn of(share: f64, interval: Interval) -> Result<Option<Self>, InputError> {
        if interval.hi < 0.5 {
            return Ok(None);
        }
        let angle = |share: f64| long_flight_cone(share.clamp(0.5, 1.0));
        let least = if interval.hi >= 1.0 { 0.0 } else { angle(interval.hi)? };
        Ok(Some(Self { angle: angle(share)?, interval: [least, angle(interval.lo)?] }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::long_flight::long_flight_probability;

    #[test]
    fn psi_has_the_share_that_was_counted_and_contains_the_ends_of_its_interval() {
        for (same, tosses) in [(178_078, 350_757), (60, 100), (99, 100), (50, 100), (45, 100)] {
            let found = SameSideBias::of(&[SameSide::new(same, tosses).unwrap()]).unwrap();
            let share = |angle: f64| long_flight_probability(angle, angle);
            let Cone { angle, interval: [least, most] } = found.cone.unwrap();
            assert!((share(angle) - found.share.max(0.5)).abs() < 1e-12, "{found:?}");
            assert!(least <= angle && angle <= most, "{found:?}");
            assert!((share(most) - found.interval.lo.max(0.5)).abs() < 1e-12, "{found:?}");
            assert!((share(least) - found.interval.hi).abs() < 1e-12, "{found:?}");
        }
        let certain = SameSideBias::of(&[SameSide::new(9, 9).unwrap()]).unwrap().cone.unwrap();
        assert_eq!((certain.angle, certain.interval[0]), (std::f64::consts::FRAC_PI_4, 0.0));
    }

    #[test]
    fn one_person_has_the_same_answer_alone_and_among_people_who_were_absent() {
        let [absent, one] = [(0, 0), (56, 100)].map(|(same, tosses)| SameSide::new(same, tosses).unwrap());
        let alone = SameSideBias::of(&[one]).unwrap();
        assert_eq!(SameSideBias::of(&[absent, one, absent]).unwrap(), alone);
        assert_eq!((alone.interval, alone.mean), (clopper_pearson(56, 100, LEVEL), 0.56));
        assert_eq!((alone.interval_kind.as_str(), alone.spread), ("clopper-pearson 95 %", None));
    }

    #[test]
    fn counts_that_cannot_be_are_refused_and_few_landings_have_no_psi() {
        assert_eq!(SameSide::new(2, 1).unwrap_err().field(), "same");
        let absent = SameSide::new(0, 0).unwrap();
        assert_eq!(SameSideBias::of(&[]).unwrap_err(), SameSideBias::of(&[absent]).unwrap_err());
        assert_eq!(SameSideBias::of(&[]).unwrap_err().field(), "tosses");
        let [most, many] = [u64::MAX, 500_000_000_001].map(|number| SameSide::new(number / 2, number).unwrap());
        assert!(matches!(SameSideBias::of(&[most, most]).unwrap_err(), InputError::Malformed { field: "tosses", .. }));
        assert!(matches!(SameSideBias::of(&[many, many]).unwrap_err(), InputError::OutOfRange { field: "tosses", .. }));
        assert_eq!(SameSideBias::of(&[most]).unwrap().people, 1);
        assert_eq!(SameSideBias::of(&[SameSide::new(10, 100).unwrap()]).unwrap().cone, None);
    }
}
