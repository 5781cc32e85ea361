//! This file says how much work a space is for quadrature, before anything is integrated: how many kinks its lines have, and
//! whether the share behaves like a square root within it. From a few corners of the space alone, this costs microseconds.

use std::f64::consts::PI;

use dynamics::{Coin, Error};
use exact::TiltTerms;

use super::nest::failed;
use super::rest::Rest;
use crate::coordinate::Coordinate;
use crate::exact_speed::Motion;
use crate::space::{Space, Values};

/// What the number of shares depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roughness {
    /// The number of coordinates that are integrated over, the speed not included.
    pub coordinates: usize,
    /// About the number of smooth parts: the product over the coordinates of 1 and the change of the phase of the fastest
    /// launch, in half turns.
    pub parts: f64,
    /// Whether a part of the space shows heads always or never, and the rest does not, so that the share behaves like a square
    /// root where they meet.
    pub has_root: bool,
}

/// The launches of a space, its speed left out, with the coordinates that are integrated over at 0.
fn base(space: &Space, rest: &[Rest]) -> Values {
    let mut values = space.fixed_values();
    if rest.iter().any(Rest::is_across) {
        values[Coordinate::RateY as usize] = 0.0;
    }
    values
}

/// The change of the phase at landing (rad) over a coordinate, with the others in the middle of their ranges.
fn change(space: &Space, coin: Coin, rest: &[Rest], of: &Rest) -> Result<f64, Error> {
    let mut middle = base(space, rest);
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

/// The coordinates, each with the change of the phase (rad) over it, from the smallest change on. This is the order of the
/// lines from the outermost on: kinks are found along the innermost one, so that it should have most of them.
pub(super) fn ordered(space: &Space, coin: Coin, rest: Vec<Rest>) -> Result<Vec<(f64, Rest)>, Error> {
    let changes = rest.iter().map(|of| change(space, coin, &rest, of)).collect::<Result<Vec<_>, Error>>()?;
    let mut ordered: Vec<(f64, Rest)> = changes.into_iter().zip(rest).collect();
    ordered.sort_by(|(one, _), (other, _)| one.total_cmp(other));
    Ok(ordered)
}

/// Whether the motions at the ends and in the middle of all coordinates are of both kinds: those that show both faces, and
/// those that show one.
fn has_root(space: &Space, coin: Coin, rest: &[Rest]) -> Result<bool, Error> {
    const PLACES: usize = 3;
    let mut seen = [false; 2];
    for place in 0..rest.iter().fold(1, |places, _| places * PLACES) {
        let (mut values, mut left) = (base(space, rest), place);
        for rest in rest {
            let [lo, hi] = rest.bounds();
            values[rest.of as usize] = [lo, 0.5 * (lo + hi), hi][left % PLACES];
            left /= PLACES;
        }
        let TiltTerms { mean, cosine, sine, .. } = Motion::new(space, coin, &values).map_err(failed)?.terms;
        seen[usize::from(cosine.hypot(sine) > mean.abs())] = true;
    }
    Ok(seen == [true; 2])
}

/// The roughness of a space with these coordinates.
pub(super) fn roughness(space: &Space, coin: Coin, rest: Vec<Rest>) -> Result<Roughness, Error> {
    let (coordinates, has_root) = (rest.len(), has_root(space, coin, &rest)?);
    let parts = ordered(space, coin, rest)?.iter().map(|(change, _)| 1.0 + change / PI).product();
    Ok(Roughness { coordinates, parts, has_root })
}
