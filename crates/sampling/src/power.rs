//! How many flips it takes to tell a same-side share p from ½: the power of an experiment, which is the probability that its
//! 95 % interval leaves out ½.
//!
//! The flips of one hand are independent, and the interval leaves out ½ if their share is more than 1.96/(2 √n) from it, so that
//!
//! ```text
//! n = ((1.96/2 + z √(p (1 - p)))/(p - ½))²,        z the normal quantile of the power.
//! ```
//!
//! Of k people with n flips each, whose own probabilities have the standard deviation σ about p, the mean share has the
//! standard error s/√k with s² = σ² + (p (1 - p) - σ²)/n. Student's interval of their mean, with ν = k - 1 degrees of freedom and
//! the quantile t at 97 %, leaves out ½ with the probability that a noncentral t of noncentrality δ = |p - ½| √k/s is above t:
//!
//! ```text
//! Φ((δ - t (1 - 1/(4ν)))/√(1 + t²/(2ν)))     (M. Abramowitz, I. A. Stegun, 26.7.10)
//! ```
//!
//! The interval of the mean [over people](mod@crate::people) is as wide as Student's or wider, so that it finds a little less. Many
//! flips of few people do not help: s never falls below σ.

use dynamics::InputError;
use dynamics::error::require;
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

use crate::people::STUDENT;

/// What an experiment looks for, and how surely it shall find it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Power {
    /// The share of landings on the same side, p.
    share: f64,
    /// The standard deviation of the probability over people, σ.
    sd: f64,
    /// The wanted probability that the interval leaves out ½.
    power: f64,
}

/// No experiment has more people or flips.
const MOST: f64 = 1e15;

impl Power {
    /// # Errors
    /// [`InputError::OutOfRange`] for a share that is ½ or not between 0 and 1, for a standard deviation that no people with
    /// this mean have, and for a power below ½ or not below 1.
    pub fn new(share: f64, sd: f64, power: f64) -> Result<Self, InputError> {
        require("share", share, "between 0 and 1, and at least 1e-6 from 1/2", {
            share > 0.0 && share < 1.0 && (share - 0.5).abs() >= 1e-6
        })?;
        require("sd", sd, "0 to √(share (1 - share))", sd >= 0.0 && sd * sd <= share * (1.0 - share))?;
        require("power", power, "0.5 to 0.9999", (0.5..=0.9999).contains(&power))?;
        Ok(Self { share, sd, power })
    }

    /// The flips of one hand that it takes.
    pub fn flips_of_one(self) -> f64 {
        let normal = Normal::standard();
        let [level, z] = [0.975, self.power].map(|part| normal.inverse_cdf(part));
        ((0.5 * level + z * (self.share * (1.0 - self.share)).sqrt()) / (self.share - 0.5)).powi(2).ceil()
    }

    /// The people that it takes if each flips `flips` times.
    pub fn people(self, flips: f64) -> f64 {
        least(2.0, |people| self.chance(people, flips) >= self.power)
    }

    /// The flips of each of `people` that it takes; `None` if no number of flips suffices, because people differ too much.
    pub fn flips(self, people: f64) -> Option<f64> {
        let enough = |flips: f64| self.chance(people, flips) >= self.power;
        enough(MOST).then(|| least(1.0, enough))
    }

    /// The power of `people` with `flips` flips each.
    pub fn chance(self, people: f64, flips: f64) -> f64 {
        let (freedom, quantile) = (people - 1.0, student(people));
        let noncentrality = (self.share - 0.5).abs() * people.sqrt() / self.deviation(self.share, flips);
        let beyond = noncentrality - quantile * (1.0 - 0.25 / freedom);
        Normal::standard().cdf(beyond / (1.0 + 0.5 * quantile * quantile / freedom).sqrt())
    }

    /// The least share above ½ that `people` with `flips` flips each find with the wanted power; `None` if they find none.
    pub fn least_share(self, people: f64, flips: f64) -> Option<f64> {
        let finds = |share: f64| Self { share, ..self }.chance(people, flips) >= self.power;
        let (mut below, mut above) = (0.5, 1.0 - 1e-12);
        if self.sd > 0.0 {
            above = 0.5 + (0.25 - self.sd * self.sd).max(0.0).sqrt();
        }
        if !finds(above) {
            return None;
        }
        while above - below > 1e-9 {
            let middle = 0.5 * (below + above);
            if finds(middle) { above = middle } else { below = middle }
        }
        Some(above)
    }

    /// The standard deviation of the share that a person of `flips` flips has.
    fn deviation(self, share: f64, flips: f64) -> f64 {
        let between = self.sd * self.sd;
        (between + (share * (1.0 - share) - between).max(0.0) / flips).sqrt()
    }
}

/// Student's quantile of the interval of so many people.
fn student(people: f64) -> f64 {
    let distribution = StudentsT::new(0.0, 1.0, people - 1.0).expect("at least two people");
    distribution.inverse_cdf(0.5 * (1.0 + STUDENT))
}

/// The least whole number from `first` on that suffices. All above it do.
fn least(first: f64, suffices: impl Fn(f64) -> bool) -> f64 {
    let (mut below, mut above) = (first - 1.0, first);
    while !suffices(above) && above < MOST {
        (below, above) = (above, 2.0 * above);
    }
    while above - below > 1.0 {
        let middle = (0.5 * (below + above)).floor();
        if suffices(middle) { above = middle } else { below = middle }
    }
    above
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(share: f64, sd: f64) -> Power {
        Power::new(share, sd, 0.8).unwrap()
    }

    #[test]
    fn one_hand_needs_thousands_of_flips() {
        for (share, power, flips) in [
            (0.508, 0.5, 15_006.0),
            (0.508, 0.8, 30_658.0),
            (0.508, 0.9, 41_041.0),
            (0.51, 0.8, 19_620.0),
            (0.52, 0.8, 4904.0),
            (0.45, 0.8, 783.0),
        ] {
            assert_eq!(Power::new(share, 0.0, power).unwrap().flips_of_one(), flips);
        }
    }

    /// The expected numbers are those of SciPy's noncentral t.
    #[test]
    fn people_who_differ_are_needed_in_numbers() {
        for (flips, of_alike, of_different) in [
            (20.0, 1774.0, 1808.0),
            (100.0, 357.0, 393.0),
            (1000.0, 38.0, 75.0),
            (5000.0, 10.0, 46.0),
            (1e4, 7.0, 43.0),
        ] {
            assert_eq!(of(0.508, 0.0).people(flips), of_alike, "{flips}");
            assert_eq!(of(0.508, 0.016).people(flips), of_different, "{flips}");
        }
        for (share, sd, people, flips, chance, within) in [
            (0.508, 0.016, 25.0, 200.0, 0.117_304, 0.001),
            (0.6, 0.05, 9.0, 50.0, 0.792_980, 0.002),
            (0.55, 0.0, 4.0, 500.0, 0.702_434, 0.015),
            (0.6, 0.1, 3.0, 200.0, 0.103_648, 0.04),
        ] {
            assert!((of(share, sd).chance(people, flips) - chance).abs() < within, "{people} people");
        }
        for (share, sd, people) in [(0.508, 0.016, 46.0), (0.6, 0.05, 9.0), (0.45, 0.02, 20.0)] {
            let wanted = of(share, sd);
            let flips = wanted.flips(people).unwrap();
            assert!(wanted.chance(people, flips) >= 0.8 && wanted.chance(people, flips - 1.0) < 0.8);
            assert!(wanted.people(flips) <= people && wanted.people(0.9 * flips) > people - 1.0);
        }
        assert_eq!(of(0.508, 0.016).flips(30.0), None);
    }

    #[test]
    fn the_least_share_is_found_with_the_wanted_power() {
        for (people, flips, sd) in [(25.0, 100.0, 0.016), (5.0, 100.0, 0.0), (48.0, 7307.0, 0.016), (3.0, 9.0, 0.2)] {
            match of(0.508, sd).least_share(people, flips) {
                Some(share) => assert!((of(share, sd).chance(people, flips) - 0.8).abs() < 1e-4, "{people}, {flips}"),
                None => assert_eq!((people, flips), (3.0, 9.0)),
            }
        }
    }

    #[test]
    fn what_cannot_be_is_refused() {
        for (share, sd, power, field) in [
            (0.5, 0.0, 0.8, "share"),
            (1.0, 0.0, 0.8, "share"),
            (f64::NAN, 0.0, 0.8, "share"),
            (0.6, 0.5, 0.8, "sd"),
            (0.6, -0.1, 0.8, "sd"),
            (0.6, 0.1, 1.0, "power"),
        ] {
            assert_eq!(Power::new(share, sd, power).unwrap_err().field(), field);
        }
    }
}
