//! What is drawn of a body, and how it is seen: a disc for a coin, and for any other body the homogeneous cuboid with its
//! moments. So the moments can be seen, but not the shape, which does not follow from them.

use chart::{Drawn, Panel};
use plotters::prelude::*;
use toss::{Attitude, Body, Vector3};

/// Where the eye is: azimuth and elevation (rad). A coin with ωx = ωy, as in the paper's figures, tips over across the line of
/// sight and a little away from the eye, so that the side that is up is seen when it lands.
const EYE: (f64, f64) = (2.55, 0.45);

/// A vector as the eye sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen {
    /// To the right.
    pub(super) right: f64,
    /// Upwards.
    pub(super) up: f64,
    /// Towards the eye; negative on the far side.
    pub(super) near: f64,
}

/// `v` (LF) as the eye sees it.
pub(super) fn project(v: &Vector3<f64>) -> Seen {
    let ((sin_a, cos_a), (sin_e, cos_e)) = (EYE.0.sin_cos(), EYE.1.sin_cos());
    let (right, away) = (v.x * cos_a + v.y * sin_a, -v.x * sin_a + v.y * cos_a);
    Seen { right, up: v.z * cos_e + away * sin_e, near: v.z * sin_e - away * cos_e }
}

/// Radius of a coin (pixels).
const RADIUS: f64 = 36.0;

/// Where the end of `vector` (LF, in radii) from `centre` is seen (pixels).
#[expect(clippy::cast_possible_truncation, reason = "within the canvas")]
pub(super) fn end_of(centre: (i32, i32), vector: &Vector3<f64>) -> (i32, i32) {
    let seen = project(vector);
    (centre.0 + (RADIUS * seen.right).round() as i32, centre.1 - (RADIUS * seen.up).round() as i32)
}

/// The tails side and the edge of what is drawn; the heads side is white.
pub(super) const TAILS: RGBColor = RGBColor(70, 70, 70);
pub(super) const EDGE: RGBColor = RGBColor(170, 170, 170);

/// Thickness of a coin, in radii.
const THICKNESS: f64 = 0.14;

/// What is drawn of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Solid {
    /// A coin.
    Disc,
    /// A cuboid with these half-edges along x, y and z, in radii of a coin.
    Cuboid([f64; 3]),
}

/// A body whose Jxx and Jyy differ by less than this part of Jzz is drawn as a coin: nobody sees the difference.
const NEARLY_ROUND: f64 = 0.02;
/// Half the longest edge of a cuboid, in radii of a coin.
const LONGEST: f64 = 1.3;

impl Solid {
    pub(super) fn new(body: &Body) -> Self {
        let [xx, yy, zz, ..] = body.inertia();
        let is_flat = zz > xx.max(yy);
        if body.coin().is_some() || (is_flat && (xx - yy).abs() < NEARLY_ROUND * zz) {
            return Self::Disc;
        }
        // Of a cuboid Jyy + Jzz - Jxx = m a²/6 with the edge a along x; in halves, so that the sums do not overflow.
        let [x, y, z] = [xx, yy, zz].map(|moment| 0.5 * moment);
        let edges = [y + z - x, x + z - y, x + y - z].map(|square| square.max(0.0).sqrt());
        let longest = edges.iter().fold(0.0_f64, |longest, edge| longest.max(*edge));
        Self::Cuboid(edges.map(|edge| (LONGEST * edge / longest).max(0.5 * THICKNESS)))
    }

    /// How far n is drawn from the centre to its end, in radii of a coin, and how far the face is from it.
    pub(super) fn heights(self) -> (f64, f64) {
        match self {
            Self::Disc => (1.0, 0.5 * THICKNESS),
            Self::Cuboid([.., z]) => (z + 1.0, z),
        }
    }

    /// How far the vector in the face reaches, in radii of a coin.
    pub(super) fn reach(self) -> f64 {
        match self {
            Self::Disc => 1.0,
            Self::Cuboid([x, ..]) => x,
        }
    }
}

/// Draws a cuboid with these half-edges about `centre` (pixels): its faces that are seen, of which none hides another.
pub(super) fn draw_cuboid(panel: &Panel<'_>, centre: (i32, i32), attitude: &Attitude, half: [f64; 3]) -> Drawn {
    for axis in 0..3 {
        for sign in [1.0, -1.0] {
            let outward = Vector3::from_fn(|row, _| if row == axis { sign } else { 0.0 });
            if project(&attitude.body_to_lab(&outward)).near <= 0.0 {
                continue;
            }
            let corner = |along: f64, across: f64| {
                let mut at = Vector3::zeros();
                at[axis] = sign * half[axis];
                at[(axis + 1) % 3] = along * half[(axis + 1) % 3];
                at[(axis + 2) % 3] = across * half[(axis + 2) % 3];
                end_of(centre, &attitude.body_to_lab(&at))
            };
            let corners = [corner(1.0, 1.0), corner(1.0, -1.0), corner(-1.0, -1.0), corner(-1.0, 1.0)];
            let colour = if axis < 2 {
                EDGE
            } else if sign > 0.0 {
                WHITE
            } else {
                TAILS
            };
            panel.draw(&Polygon::new(corners, colour.filled()))?;
            let outline = corners.into_iter().chain([corners[0]]).collect::<Vec<_>>();
            panel.draw(&PathElement::new(outline, BLACK.stroke_width(2)))?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_is_drawn_as_the_cuboid_with_its_moments_and_a_coin_as_a_disc() {
        let solid = |moments| Solid::new(&Body::from_moments(moments).unwrap());
        assert_eq!(solid([1.0, 1.0, 1.9]), Solid::Disc);
        assert_eq!(solid([1.0, 1.01, 1.9]), Solid::Disc);
        // Edges of 1, 2 and 3: the squares of two of them make each moment.
        let Solid::Cuboid(half) = solid([13.0, 10.0, 5.0]) else { panic!("a cuboid") };
        for (half, edge) in half.into_iter().zip([1.0, 2.0, 3.0]) {
            assert!((half - LONGEST * edge / 3.0).abs() < 1e-15, "{half}");
        }
        // A plate is not so thin that nobody sees it.
        let Solid::Cuboid([_, _, z]) = solid([1.0, 2.0, 3.0]) else { panic!("a cuboid") };
        assert_eq!(z, 0.5 * THICKNESS);
        assert!(matches!(solid([1e300, 2e300, 2.5e300]), Solid::Cuboid([x, ..]) if x == LONGEST));
    }
}
