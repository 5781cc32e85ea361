//! One coordinate of a configuration space.

use dynamics::InputError;
use dynamics::error::require;

/// A coordinate that is fixed or runs uniformly over a range. Bounds are finite and in order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    lo: f64,
    hi: f64,
    points: Option<u64>,
}

impl Axis {
    /// One value.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] that names `field` if it is not finite.
    pub fn fixed(field: &'static str, value: f64) -> Result<Self, InputError> {
        Self::range(field, value, value)
    }

    /// The range from `lo` to `hi`, both included.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] that names `field` if a bound is not finite or they are reversed.
    pub fn range(field: &'static str, lo: f64, hi: f64) -> Result<Self, InputError> {
        require(field, lo, "finite", true)?;
        require(field, hi, "finite and at or above the lower bound", lo <= hi)?;
        require(field, hi - lo, "a range of finite length", true)?;
        Ok(Self { lo, hi, points: None })
    }

    /// The same axis with `points` grid points, both ends included; a range of one value is one point.
    ///
    /// # Errors
    /// [`InputError::OutOfRange`] that names `field` for 0 points, and for 1 point on a range of more than one value.
    pub fn with_points(self, field: &'static str, points: u64) -> Result<Self, InputError> {
        let fewest = if self.lo == self.hi { 1 } else { 2 };
        #[expect(clippy::cast_precision_loss, reason = "shown, not computed with")]
        let shown = points as f64;
        require(field, shown, "at least 2 grid points on a range, 1 on a single value", points >= fewest)?;
        Ok(Self { points: Some(if fewest == 1 { 1 } else { points }), ..self })
    }

    /// Reads `VALUE`, `LO:HI` or `LO:HI:POINTS`.
    ///
    /// # Errors
    /// [`InputError`] that names `field`.
    pub fn parse(field: &'static str, text: &str) -> Result<Self, InputError> {
        let malformed =
            || InputError::Malformed { field, value: text.to_owned(), expected: "VALUE, LO:HI or LO:HI:POINTS" };
        let number = |part: &str| part.trim().parse::<f64>().map_err(|_| malformed());
        let parts: Vec<&str> = text.split(':').collect();
        match parts[..] {
            [value] => Self::fixed(field, number(value)?),
            [lo, hi] => Self::range(field, number(lo)?, number(hi)?),
            [lo, hi, points] => {
                let points = points.trim().parse().map_err(|_| malformed())?;
                Self::range(field, number(lo)?, number(hi)?)?.with_points(field, points)
            }
            _ => Err(malformed()),
        }
    }

    /// Lower bound.
    pub fn lo(&self) -> f64 {
        self.lo
    }

    /// Upper bound.
    pub fn hi(&self) -> f64 {
        self.hi
    }

    /// Number of grid points: 1 for a single value, `None` for a range without a number of them.
    pub fn points(&self) -> Option<u64> {
        if self.lo == self.hi { Some(1) } else { self.points }
    }

    /// The value at `part` of the way, from 0 to 1.
    pub(crate) fn at(&self, part: f64) -> f64 {
        self.lo + part * (self.hi - self.lo)
    }

    /// Grid point `index` of `points`; the last is the upper bound exactly.
    #[expect(clippy::cast_precision_loss, reason = "indices stay far below 2^53")]
    pub(crate) fn grid_point(&self, index: u64, points: u64) -> f64 {
        if index + 1 == points { self.hi } else { self.at(index as f64 / (points - 1) as f64) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_includes_both_ends() {
        let axis = Axis::parse("speed [m/s]", "3:5:5").unwrap();
        let points: Vec<f64> = (0..5).map(|index| axis.grid_point(index, 5)).collect();
        assert_eq!(points, [3.0, 3.5, 4.0, 4.5, 5.0]);
    }

    #[test]
    fn a_range_of_one_value_is_one_point() {
        for text in ["4", "4:4", "4:4:500"] {
            let axis = Axis::parse("speed [m/s]", text).unwrap();
            assert_eq!(axis.points(), Some(1));
            assert_eq!(axis.grid_point(0, 1), 4.0);
        }
    }

    #[test]
    fn what_is_no_axis_is_refused_by_name() {
        for text in ["", "a", "1:2:3:4", "5:3", "nan", "1:inf", "1:2:0", "1:2:1", "1:2:-3", "1:2:2.5", "-1e308:1e308"] {
            let error = Axis::parse("speed [m/s]", text).unwrap_err().to_string();
            assert!(error.starts_with("speed [m/s] = "), "{text}: {error}");
        }
    }
}
