//! This file chooses the order of the lines that quadrature integrates along. From two phases for each coordinate alone, this
//! costs microseconds.

use dynamics::{Coin, Error};

use super::nest::failed;
use super::rest::Rest;
use crate::coordinate::Coordinate;
use crate::exact_speed::Motion;
use crate::space::Space;

/// The change of the phase at landing (rad) over a coordinate, with the others in the middle of their ranges.
fn change(space: &Space, coin: Coin, rest: &[Rest], of: &Rest) -> Result<f64, Error> {
    let mut middle = space.fixed_values();
    if rest.iter().any(Rest::is_across) {
        middle[Coordinate::RateY as usize] = 0.0;
    }
    for rest in rest {
        let [lo, hi] = rest.bounds();
        middle[rest.of as usize] = 0.5 * (lo + hi);
    }
    let phase = |value: f64| -> Result<f64, Error> {
        let mut values = middle;
        values[of.of as usize] = value;
        Ok(Motion::new(space, coin, &values).map_err(failed)?.phases[1])
    };
    let [lo, hi] = of.bounds().map(phase);
    let there = phase(middle[of.of as usize])?;
    Ok((lo? - there).abs() + (hi? - there).abs())
}

/// The coordinates, from the smallest change of the phase over them on. This is the order of the lines from the outermost
/// on: kinks are found along the innermost one, so that it should have most of them.
pub(super) fn ordered(space: &Space, coin: Coin, rest: Vec<Rest>) -> Result<Vec<Rest>, Error> {
    let changes = rest.iter().map(|of| change(space, coin, &rest, of)).collect::<Result<Vec<_>, Error>>()?;
    let mut ordered: Vec<(f64, Rest)> = changes.into_iter().zip(rest).collect();
    ordered.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    Ok(ordered.into_iter().map(|(_, rest)| rest).collect())
}
