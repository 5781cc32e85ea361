//! This file describes how one coordinate of a space of launches is distributed: fixed, uniform over lo ≤ x ≤ hi, or
//! normal with mean μ and standard deviation σ. Each axis can be written as a short text, for command lines and files.

use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

use dynamics::error::require;
use dynamics::quantity::{Given, read_count, read_quantities};
use dynamics::{Dimension, InputError};
use statrs::distribution::{ContinuousCDF, Normal};

use crate::coordinate::Coordinate;

/// Number of standard deviations from the mean within which all values of a normal coordinate lie. A draw is at least
/// 2^-53, and the quantile of 2^-53 is 8.21 standard deviations below the mean.
pub const NORMAL_REACH: f64 = 8.3;

/// The forms of an axis as a text.
const FORMS: &str = "VALUE, LO:HI, LO:HI:POINTS, normal:MEAN:SD or normal:MEAN:SD:POINTS";

/// The same for a text with `±`.
const FORMS_OF_DEVIATION: &str = "normal:MEAN:SD for a mean and a standard deviation, LO:HI for a range, or VALUE";

/// The numbers of points that a grid may have.
const GRIDS: &str =
    "POINTS as a whole number: at least 2 grid points on a range, 1 on a single value or a normal distribution";

/// A fixed value, a range or a normal distribution, with the number of points that a grid has on it.
///
/// An axis holds numbers without a check. Which of them are valid depends on the coordinate, so they are checked when
/// the axis becomes part of a [`Space`](crate::Space).
///
/// ```
/// use sampling::Axis;
///
/// let axes: [Axis; 3] = [3.0.into(), (3.0..=5.0).into(), Axis::normal(20.0, 2.0).with_points(100)];
/// assert_eq!(axes.map(|axis| axis.to_string()), ["3", "3:5", "normal:20:2:100"]);
/// assert_eq!("3:5:500".parse(), Ok(Axis::range(3.0..=5.0).with_points(500)));
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    distribution: Distribution,
    points: Option<u64>,
}

/// The distribution of one coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Distribution {
    /// Uniform from `lo` to `hi`; one value if they are equal.
    Uniform {
        /// Lower bound.
        lo: f64,
        /// Upper bound.
        hi: f64,
    },
    /// Normal distribution.
    Normal {
        /// Mean.
        mean: f64,
        /// Standard deviation, > 0.
        sd: f64,
    },
}

impl Axis {
    /// A single value.
    pub const fn fixed(value: f64) -> Self {
        Self { distribution: Distribution::Uniform { lo: value, hi: value }, points: None }
    }

    /// The uniform distribution over a range, both ends included.
    pub const fn range(range: RangeInclusive<f64>) -> Self {
        let (lo, hi) = (*range.start(), *range.end());
        Self { distribution: Distribution::Uniform { lo, hi }, points: None }
    }

    /// The normal distribution with mean `mean` and standard deviation `sd`.
    pub const fn normal(mean: f64, sd: f64) -> Self {
        Self { distribution: Distribution::Normal { mean, sd }, points: None }
    }

    /// Sets the number of grid points. On a range they are evenly spaced and include both ends; a range of one value
    /// has one point. On a normal distribution they are the medians of `points` parts of equal probability.
    #[must_use]
    pub const fn with_points(self, points: u64) -> Self {
        Self { points: Some(points), ..self }
    }

    /// Checks the numbers of the axis for the coordinate `of`.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] that names `of` for
    /// - a range that is not finite or is reversed,
    /// - a mean that is not finite, a standard deviation that is not positive, or one so large that values leave the
    ///   range of f64.
    ///
    /// [`InputError::Malformed`] for zero grid points, or a single one on a range of more than one value.
    pub(crate) fn validated(self, of: Coordinate) -> Result<Self, InputError> {
        match self.distribution {
            Distribution::Uniform { lo, hi } => {
                require(of.field(), lo, "finite", true)?;
                require(of.field(), hi, "finite and at or above the lower bound", lo <= hi)?;
                require(of.field(), hi - lo, "a range of finite length", true)?;
            }
            Distribution::Normal { mean, sd } => {
                require(of.field(), mean, "a finite mean", true)?;
                require(of.field(), sd, "a standard deviation > 0", sd > 0.0)?;
                let widest = 2.0 * (mean.abs() + NORMAL_REACH * sd);
                require(of.field(), widest, "a normal distribution within the range of f64", true)?;
            }
        }
        let fewest = match self.distribution {
            Distribution::Uniform { lo, hi } if lo < hi => 2,
            _ => 1,
        };
        if self.points.is_some_and(|points| points < fewest) {
            return Err(InputError::Malformed { field: of.field(), value: self.to_string(), expected: GRIDS });
        }
        Ok(self)
    }

    /// Reads an axis as [`str::parse`] does, for the coordinate `of`, whose units its numbers may have.
    ///
    /// # Errors
    /// [`InputError::Malformed`] that names `of`.
    pub fn parse(of: Coordinate, text: &str) -> Result<Self, InputError> {
        let numbers = |texts: &[&str]| {
            // If a number has a unit that does not fit, the units that fit help more than the forms of an axis.
            let starts_as_number =
                |text: &str| text.trim_start_matches(['-', '.']).starts_with(|c: char| c.is_ascii_digit());
            let has_unit = |text: &&str| text.parse::<f64>().is_err() && starts_as_number(text);
            let expected = match texts.iter().any(has_unit) {
                _ if text.contains('±') => FORMS_OF_DEVIATION,
                true => of.dimension().expected(),
                false => FORMS,
            };
            let parts: Vec<(Dimension, &str)> = texts.iter().map(|text| (of.dimension(), *text)).collect();
            let numbers = read_quantities(of.field(), text, expected, &parts)?;
            Ok(numbers.into_iter().map(Given::si).collect())
        };
        Self::read(of.field(), text, numbers)
    }

    /// Reads an axis, whose values `numbers` reads.
    fn read(
        field: &'static str,
        text: &str,
        numbers: impl Fn(&[&str]) -> Result<Vec<f64>, InputError>,
    ) -> Result<Self, InputError> {
        let malformed = || InputError::unreadable(field, text, FORMS);
        let parts: Vec<&str> = text.split(':').map(str::trim).collect();
        let (is_normal, values, points) = match parts[..] {
            ["normal", mean, sd] => (true, vec![mean, sd], None),
            ["normal", mean, sd, points] => (true, vec![mean, sd], Some(points)),
            [value] => (false, vec![value, value], None),
            [lo, hi] => (false, vec![lo, hi], None),
            [lo, hi, points] => (false, vec![lo, hi], Some(points)),
            _ => return Err(malformed()),
        };
        let values = numbers(&values)?;
        let [first, second] = values[..] else { return Err(malformed()) };
        let axis = if is_normal { Self::normal(first, second) } else { Self::range(first..=second) };
        let no_count = || InputError::unreadable(field, text, GRIDS);
        let points = points.map(|points| read_count(points).ok_or_else(no_count)).transpose()?;
        Ok(Self { points, ..axis })
    }

    /// The distribution of the coordinate.
    pub fn distribution(&self) -> Distribution {
        self.distribution
    }

    /// The value, if there is only one.
    pub fn value(&self) -> Option<f64> {
        match self.distribution {
            Distribution::Uniform { lo, hi } if lo == hi => Some(lo),
            _ => None,
        }
    }

    /// The smallest and the largest value that a launch can have.
    pub fn bounds(&self) -> [f64; 2] {
        match self.distribution {
            Distribution::Uniform { lo, hi } => [lo, hi],
            Distribution::Normal { mean, sd } => [mean - NORMAL_REACH * sd, mean + NORMAL_REACH * sd],
        }
    }

    /// Number of grid points: 1 for a single value, else as given; `None` if it was not given.
    pub fn points(&self) -> Option<u64> {
        if self.value().is_some() { Some(1) } else { self.points }
    }

    /// The quantile of `part`, 0 < `part` < 1: the value below which this fraction of the distribution lies.
    pub(crate) fn quantile(&self, part: f64) -> f64 {
        match self.distribution {
            Distribution::Uniform { lo, hi } => lo + part * (hi - lo),
            Distribution::Normal { mean, sd } => mean + sd * Normal::standard().inverse_cdf(part),
        }
    }

    /// Replaces each part, 0 < part < 1, by its quantile.
    pub(crate) fn to_quantiles(self, parts: &mut [f64]) {
        parts.iter_mut().for_each(|part| *part = self.quantile(*part));
    }

    /// Grid point number `index` of `points`. The last one of a range is exactly its upper bound.
    #[expect(clippy::cast_precision_loss, reason = "indices stay far below 2^53")]
    pub(crate) fn grid_point(&self, index: u64, points: u64) -> f64 {
        match self.distribution {
            Distribution::Uniform { hi, .. } if index + 1 == points => hi,
            Distribution::Uniform { lo, hi } => lo + index as f64 / (points - 1) as f64 * (hi - lo),
            Distribution::Normal { .. } => self.quantile((index as f64 + 0.5) / points as f64),
        }
    }
}

impl From<f64> for Axis {
    fn from(value: f64) -> Self {
        Self::fixed(value)
    }
}

impl From<RangeInclusive<f64>> for Axis {
    fn from(range: RangeInclusive<f64>) -> Self {
        Self::range(range)
    }
}

/// `VALUE`, `LO:HI`, `LO:HI:POINTS`, `normal:MEAN:SD` or `normal:MEAN:SD:POINTS`.
impl FromStr for Axis {
    type Err = InputError;

    fn from_str(text: &str) -> Result<Self, InputError> {
        let malformed = |_| InputError::Malformed { field: "axis", value: text.to_owned(), expected: FORMS };
        Self::read("axis", text, |texts| texts.iter().map(|text| text.parse().map_err(malformed)).collect())
    }
}

/// Axes with the same launches are the same: for a single value it makes no difference how many points were asked for.
impl PartialEq for Axis {
    fn eq(&self, other: &Self) -> bool {
        (self.distribution, self.points()) == (other.distribution, other.points())
    }
}

/// The text from which [`str::parse`] reads the same axis.
impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.distribution, self.value()) {
            (_, Some(value)) => return write!(f, "{value}"),
            (Distribution::Uniform { lo, hi }, None) => write!(f, "{lo}:{hi}")?,
            (Distribution::Normal { mean, sd }, None) => write!(f, "normal:{mean}:{sd}")?,
        }
        self.points.map_or(Ok(()), |points| write!(f, ":{points}"))
    }
}

#[cfg(test)]
mod tests;
