//! The wobble that explains how often coins landed on the side that had been up. In the limit of long flights from horizontal
//! the share p of such landings follows from the angle ψ between the coin's normal and its angular momentum, p = ½ +
//! asin(cot²ψ)/π; see [`long_flight_probability`](crate::long_flight_probability). This file turns counts into ψ.
//!
//! It assumes that all launches leave flat, turn many times and have the same ψ. The angle 180° - ψ, of the opposite spin,
//! explains them as well. As ψ differs between people, several people have an interval with the people as its sample.

use dynamics::InputError;
use dynamics::error::require;

use crate::estimate::LEVEL;
use crate::interval::{Interval, clopper_pearson, from_scrambles};
use crate::long_flight::long_flight_cone;

/// How many of the tosses of a person landed on the side that had been up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SameSide {
    same: u64,
    tosses: u64,
}

impl SameSide {
    /// `same` of `tosses`.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] for no tosses, and for more landings on the same side than tosses.
    #[expect(clippy::cast_precision_loss, reason = "shown, not computed with")]
    pub fn new(same: u64, tosses: u64) -> Result<Self, InputError> {
        require("tosses", tosses as f64, "at least 1", tosses > 0)?;
        require("same", same as f64, "0 to the number of tosses", same <= tosses)?;
        Ok(Self { same, tosses })
    }

    /// The number of landings on the same side.
    pub fn same(self) -> u64 {
        self.same
    }

    /// The number of tosses.
    pub fn tosses(self) -> u64 {
        self.tosses
    }
}

/// The wobble that explains counts.
#[derive(Debug, Clone, PartialEq)]
pub struct Wobble {
    /// The counts of all people together.
    pub counts: SameSide,
    /// The share of landings on the same side.
    pub share: f64,
    /// The interval of the share, at the confidence [`LEVEL`].
    pub interval: Interval,
    /// What the interval means.
    pub interval_kind: String,
    /// ψ (rad), from π/4 for a share of 1, which every smaller angle has too, to π/2 for a share of ½ or less.
    pub angle: f64,
    /// The smallest and the largest ψ (rad) that have a share in the interval.
    pub angles: [f64; 2],
}

impl Wobble {
    /// The wobble of `people`, of whom there is at least one. A single person, or all tosses together, have Clopper and
    /// Pearson's interval; several people have Student's, with the people as the sample.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] if there are no people; [`InputError::Malformed`] if they tossed 2^64 coins or more;
    /// [`InputError::OutsideModel`] if even the upper end of the interval
    /// is below ½, which no wobble explains.
    #[expect(clippy::cast_precision_loss, reason = "nobody tosses 2^53 coins")]
    pub fn of(people: &[SameSide]) -> Result<Self, InputError> {
        let sum = |field, part: fn(SameSide) -> u64| {
            let sum = people.iter().try_fold(0_u64, |sum, person| sum.checked_add(part(*person)));
            let value = "2^64 or more".to_owned();
            sum.ok_or(InputError::Malformed { field, value, expected: "fewer for all people together" })
        };
        let counts = SameSide::new(sum("same", SameSide::same)?, sum("tosses", SameSide::tosses)?)?;
        let share = counts.same as f64 / counts.tosses as f64;
        // The share is a ratio of two sums over people, which to first order is the mean of one number for each person.
        let weight = people.len() as f64 / counts.tosses as f64;
        let of_one = |one: &SameSide| share + (one.same as f64 - share * one.tosses as f64) * weight;
        let of_people = from_scrambles(&people.iter().map(of_one).collect::<Vec<_>>(), LEVEL);
        let (interval, interval_kind) = match of_people {
            Some(interval) => (interval, format!("student 95 % of {} people", people.len())),
            None => (clopper_pearson(counts.same, counts.tosses, LEVEL), "clopper-pearson 95 %".to_owned()),
        };
        if interval.hi < 0.5 {
            let why = "no wobble explains so few landings on the same side: in long flights from horizontal they are at \
                       least half";
            return Err(InputError::OutsideModel { field: "same", why });
        }
        let angle = |share: f64| long_flight_cone(share.clamp(0.5, 1.0));
        let least = if interval.hi >= 1.0 { 0.0 } else { angle(interval.hi)? };
        Ok(Self { counts, share, interval, interval_kind, angle: angle(share)?, angles: [least, angle(interval.lo)?] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::long_flight::long_flight_probability;

    #[test]
    fn the_wobble_has_the_share_that_was_counted_and_contains_the_ends_of_its_interval() {
        for (same, tosses) in [(178_078, 350_757), (60, 100), (99, 100), (50, 100), (45, 100)] {
            let found = Wobble::of(&[SameSide::new(same, tosses).unwrap()]).unwrap();
            let share = |angle: f64| long_flight_probability(angle, angle);
            assert!((share(found.angle) - found.share.max(0.5)).abs() < 1e-12, "{found:?}");
            let [least, most] = found.angles;
            assert!(least <= found.angle && found.angle <= most, "{found:?}");
            assert!((share(most) - found.interval.lo.max(0.5)).abs() < 1e-12, "{found:?}");
            assert!((share(least) - found.interval.hi).abs() < 1e-12, "{found:?}");
        }
        let certain = Wobble::of(&[SameSide::new(9, 9).unwrap()]).unwrap();
        assert_eq!((certain.angle, certain.angles[0]), (std::f64::consts::FRAC_PI_4, 0.0));
    }

    #[test]
    fn people_who_differ_have_a_wider_interval_than_their_tosses_together() {
        let people = [(510, 1000), (590, 1000), (480, 1000)].map(|(same, tosses)| SameSide::new(same, tosses).unwrap());
        let (apart, together) =
            (Wobble::of(&people).unwrap(), Wobble::of(&[SameSide::new(1580, 3000).unwrap()]).unwrap());
        assert_eq!((apart.counts, apart.share), (together.counts, together.share));
        assert!(apart.interval.width() > 2.0 * together.interval.width());
        assert_eq!(apart.interval_kind, "student 95 % of 3 people");
    }

    #[test]
    fn counts_that_cannot_be_or_that_no_wobble_explains_are_refused() {
        assert_eq!(SameSide::new(0, 0).unwrap_err().field(), "tosses");
        assert_eq!(SameSide::new(2, 1).unwrap_err().field(), "same");
        assert_eq!(Wobble::of(&[]).unwrap_err().field(), "tosses");
        let many = SameSide::new(u64::MAX, u64::MAX).unwrap();
        assert_eq!(Wobble::of(&[many, many]).unwrap_err().field(), "same");
        let few = Wobble::of(&[SameSide::new(10, 100).unwrap()]).unwrap_err();
        assert!(matches!(few, InputError::OutsideModel { field: "same", .. }), "{few}");
    }
}
