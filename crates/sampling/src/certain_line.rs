//! The line on a map beyond which heads is certain, from its equation instead of the map's cells: it neither bends nor ends
//! with them.
//!
//! The coin shows heads for ever if φ + ψ ≤ 90°, where φ is the angle of S with the vertical and ψ that with n, or if the two
//! are as near to 180°. With s = (ωx, ωy, k ωz), which is S over I1, and the vertical v = (0, sin b, cos b), both in the body
//! frame at a launch with the tilt b, the edge is where (s · v)² = ωx² + ωy² and s · v has the sign of k ωz. From horizontal
//! that is k |ωz| = sqrt(ωx² + ωy²), ψ = 45° or 135°. Over two rates it is a conic section. A launch by turn and ψ has ωy = 0,
//! and the line is straight: tan ψ = ±cos b.

use std::f64::consts::PI;

use crate::coordinate::Coordinate;
use crate::map::Map;
use crate::space::{AxisOrTie, Space};

/// How many places a curved line is computed at, from one side of the map to the other. With more of them the whole pixels
/// of the drawing would make it uneven.
const PLACES: u32 = 80;

/// A piece of the line, as points of the map.
pub type Piece = Vec<(f64, f64)>;

/// The line of a map.
#[derive(Debug, Clone, PartialEq)]
pub struct CertainLine {
    /// Its pieces.
    pub pieces: Vec<Piece>,
    /// The angles ψ on it, where they are the same all along: from horizontal.
    pub angles: &'static str,
}

/// The line on `map`, which is of `space`.
///
/// # Errors
/// The reason why there is none, in words.
pub fn certain_line(map: &Map, space: &Space) -> Result<CertainLine, &'static str> {
    let axes = [map.across.0, map.up.0];
    let is_of_motion = |of: Coordinate| ![Coordinate::Speed, Coordinate::Gravity].contains(&of);
    if space.free().any(|of| is_of_motion(of) && !axes.contains(&of)) {
        return Err("no line: a rate or the tilt varies within each cell");
    }
    if axes.contains(&Coordinate::Tilt) {
        return Err("no line: over the tilt it has no formula");
    }
    if !axes.iter().any(|of| is_of_motion(*of)) {
        return Err("no line: neither axis is a rate");
    }
    let ends = |nodes: &[f64]| [nodes[0], nodes[nodes.len() - 1]];
    let Some(coin) = space.coin() else {
        return Err("no line: with I1 ≠ I2 it has no formula");
    };
    let ranges = [ends(&map.across.1), ends(&map.up.1)];
    let (pieces, spins) = if space.is_of_precession() {
        over_psi(space, axes, ranges)?
    } else {
        let edge = Edge::new(space, axes, coin.inertia_ratio());
        let pieces = edge.pieces(ranges);
        let spins = pieces.iter().flatten().map(|at| value(edge.signs[1], *at)).collect();
        (pieces, spins)
    };
    if pieces.is_empty() {
        return Err("no line: it does not pass through this map");
    }
    let is_horizontal = space.axis(Coordinate::Tilt).value() == Some(0.0);
    Ok(CertainLine { pieces, angles: if is_horizontal { angles(&spins) } else { "" } })
}

/// The pieces over ψ and another coordinate, which has no part in it, and the sense of the spin on each.
fn over_psi(
    space: &Space,
    axes: [Coordinate; 2],
    ranges: [[f64; 2]; 2],
) -> Result<(Vec<Piece>, Vec<f64>), &'static str> {
    let place = axes.iter().position(|of| *of == Coordinate::Psi).ok_or("no line: neither axis is ψ")?;
    let cone = space.axis(Coordinate::Tilt).bounds()[0].cos().atan();
    let [lo, hi] = ranges[place];
    let on_map = [(cone, 1.0), (PI - cone, -1.0)].into_iter().filter(|(psi, _)| cone > 0.0 && (lo..=hi).contains(psi));
    let piece = |(psi, spin): (f64, f64)| {
        let at = |other: f64| if place == 0 { (psi, other) } else { (other, psi) };
        (ranges[1 - place].map(at).to_vec(), spin)
    };
    Ok(on_map.map(piece).unzip())
}

/// The angles ψ on the line of launches from horizontal, by the sense of the spin along it.
fn angles(spins: &[f64]) -> &'static str {
    match (spins.iter().any(|spin| *spin > 0.0), spins.iter().any(|spin| *spin < 0.0)) {
        (true, true) => "ψ = 45° and 135°",
        (false, true) => "ψ = 135°",
        _ => "ψ = 45°",
    }
}

/// A quantity `p[0] u + p[1] v + p[2]`, where u and v are the values of the two axes.
type Linear = [f64; 3];

fn value(p: Linear, (u, v): (f64, f64)) -> f64 {
    p[0] * u + p[1] * v + p[2]
}

/// The edge of the launches that show heads for ever.
struct Edge {
    /// s · v and k ωz.
    signs: [Linear; 2],
    /// ωx² + ωy² - (s · v)², as factors of u², u v, v², u, v and 1.
    conic: [f64; 6],
}

impl Edge {
    fn new(space: &Space, axes: [Coordinate; 2], inertia_ratio: f64) -> Self {
        let rate = |of: Coordinate| -> Linear {
            let own = if let Some(AxisOrTie::SameAs(partner)) = space.axis_or_tie(of) { partner } else { of };
            let along = axes.map(|axis| f64::from(axis == own));
            let constant = if axes.contains(&own) { 0.0 } else { space.axis(own).bounds()[0] };
            [along[0], along[1], constant]
        };
        let [x, y, z] = [Coordinate::RateX, Coordinate::RateY, Coordinate::RateZ].map(rate);
        let (sin, cos) = space.axis(Coordinate::Tilt).bounds()[0].sin_cos();
        let normal = z.map(|part| inertia_ratio * part);
        let vertical: Linear = std::array::from_fn(|part| sin * y[part] + cos * normal[part]);
        let squares = [x, y, vertical].map(square);
        let conic = std::array::from_fn(|part| squares[0][part] + squares[1][part] - squares[2][part]);
        Self { signs: [vertical, normal], conic }
    }

    /// The pieces within the ranges of u and v.
    fn pieces(&self, ranges: [[f64; 2]; 2]) -> Vec<Piece> {
        let [_, mixed, vv, _, v1, _] = self.conic;
        if vv == 0.0 && mixed == 0.0 && v1 == 0.0 {
            // v has no part in it: straight up at fixed u.
            let upright = |u: f64| ranges[1].map(|v| (u, v)).to_vec();
            let pieces = self.roots_at_v(0.0).into_iter().map(upright);
            return pieces.filter(|piece| piece.iter().all(|at| self.is_on_edge(*at, ranges))).collect();
        }
        let mut pieces = Vec::new();
        for branch in 0..2 {
            let point = |u: &f64| {
                let at = (*u, *self.roots_at_u(*u).get(branch)?);
                self.is_on_edge(at, ranges).then_some(at)
            };
            let points: Vec<Option<(f64, f64)>> = self.places(ranges).iter().map(point).collect();
            let runs = points.split(Option::is_none).map(|run| run.iter().flatten().copied());
            pieces.extend(runs.map(without_straight_points).filter(|run| run.len() > 1));
        }
        pieces
    }

    /// Values of u at which the line is computed: evenly spaced, where it turns back, and where it meets the frame.
    fn places(&self, [across, up]: [[f64; 2]; 2]) -> Vec<f64> {
        let [uu, mixed, vv, u1, v1, constant] = self.conic;
        let mut places: Vec<f64> = (0..=PLACES)
            .map(|step| across[0] + f64::from(step) / f64::from(PLACES) * (across[1] - across[0]))
            .collect();
        let turns =
            roots([mixed * mixed - 4.0 * vv * uu, 2.0 * mixed * v1 - 4.0 * vv * u1, v1 * v1 - 4.0 * vv * constant]);
        places.extend(turns);
        places.extend(up.into_iter().flat_map(|v| self.roots_at_v(v)));
        places.retain(|u| (across[0]..=across[1]).contains(u));
        places.sort_by(f64::total_cmp);
        places.dedup();
        places
    }

    fn roots_at_u(&self, u: f64) -> Vec<f64> {
        let [uu, mixed, vv, u1, v1, constant] = self.conic;
        roots([vv, mixed * u + v1, (uu * u + u1) * u + constant])
    }

    fn roots_at_v(&self, v: f64) -> Vec<f64> {
        let [uu, mixed, vv, u1, v1, constant] = self.conic;
        roots([uu, mixed * v + u1, (vv * v + v1) * v + constant])
    }

    /// Whether a root of the conic is on the map and of the right sign, up to rounding.
    fn is_on_edge(&self, at: (f64, f64), ranges: [[f64; 2]; 2]) -> bool {
        let is_within = |value: f64, [lo, hi]: [f64; 2]| {
            let rounding = 1e-9 * (hi - lo);
            (lo - rounding..=hi + rounding).contains(&value)
        };
        let [vertical, normal] = self.signs.map(|of| value(of, at));
        is_within(at.0, ranges[0]) && is_within(at.1, ranges[1]) && vertical * normal >= 0.0
    }
}

/// The points without those that lie straight between their neighbours.
fn without_straight_points(points: impl Iterator<Item = (f64, f64)>) -> Piece {
    let is_straight = |a: (f64, f64), b: (f64, f64), c: (f64, f64)| {
        let (first, second) = ((b.0 - a.0) * (c.1 - a.1), (b.1 - a.1) * (c.0 - a.0));
        (first - second).abs() <= 1e-9 * first.abs().max(second.abs())
    };
    let mut kept = Piece::new();
    for at in points {
        if let [.., a, b] = kept[..]
            && is_straight(a, b, at)
        {
            kept.pop();
        }
        kept.push(at);
    }
    kept
}

/// The factors of u², u v, v², u, v and 1 in the square of `p`.
fn square(p: Linear) -> [f64; 6] {
    [p[0] * p[0], 2.0 * p[0] * p[1], p[1] * p[1], 2.0 * p[0] * p[2], 2.0 * p[1] * p[2], p[2] * p[2]]
}

/// The real roots of a x² + b x + c, in order; a double root counts twice. If every number is a root there are none.
fn roots([a, b, c]: [f64; 3]) -> Vec<f64> {
    if a == 0.0 {
        return if b == 0.0 { Vec::new() } else { vec![-c / b] };
    }
    // Where two branches meet rounding may make it negative.
    let discriminant = b * b - 4.0 * a * c;
    let is_double = discriminant.abs() <= 1e-12 * (b * b).max((4.0 * a * c).abs());
    let root = if is_double { 0.0 } else { discriminant.sqrt() };
    if root.is_nan() {
        return Vec::new();
    }
    // No difference of nearly equal numbers.
    let larger = -0.5 * (b + root.copysign(b));
    let mut roots = if larger == 0.0 { vec![0.0, 0.0] } else { vec![larger / a, c / larger] };
    roots.sort_by(f64::total_cmp);
    roots
}

#[cfg(test)]
mod tests;
