//! Draws the coin at equal times of its flight, going up and down. Its heads side is white and its tails side dark, so that
//! one sees which is up.

use std::f64::consts::TAU;

use chart::{Axis, ChartError, Drawn, Panel, frame, pixel};
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use plotters::prelude::*;
use toss::{Attitude, TimeOfFlight, Toss, TracePoint, Vector3};

use crate::chart::layout::{COINS, FACE, NORMAL, RIGHT, times};
use crate::chart::projection::{end_of, project};
use crate::chart::solid::{EDGE, Solid, TAILS, draw_cuboid};

/// Number of layers by which its edge is drawn.
const LAYERS: u32 = 6;

/// Draws the coins of `flight`, the trace of `toss`.
pub(super) fn draw_coins(panel: &Panel<'_>, flight: &[TracePoint], toss: &Toss) -> Drawn {
    let thrown = Thrown::new(toss.launch.time_of_flight());
    let heights: Vec<f64> = flight.iter().map(|point| thrown.height(point.time)).collect();
    let (lowest, highest) = heights.iter().fold((0.0_f64, 0.0_f64), |(lo, hi), at| (lo.min(*at), hi.max(*at)));
    let room = 0.14 * (highest - lowest).max(f64::MIN_POSITIVE);
    if !room.is_finite() {
        return Err(ChartError("a flight so high can't be drawn".to_owned()).into());
    }
    let height = format!("height [m], at g = {} m/s²", thrown.gravity);
    let (x, y) = (times("", flight), Axis::linear(&height, lowest - room..highest + room));
    let chart = frame(panel, "", (&x, &y), RIGHT)?;
    let solid = Solid::new(&toss.body);
    for index in (0..COINS).map(|coin| coin * (flight.len() - 1) / (COINS - 1)) {
        let centre = pixel(panel, &chart, (flight[index].time, heights[index]));
        draw_coin(panel, centre, &flight[index].attitude, solid)?;
    }
    Ok(())
}

/// The vertical motion of a throw.
struct Thrown {
    /// v0 (m/s).
    speed: f64,
    /// g (m/s²).
    gravity: f64,
}

impl Thrown {
    /// The throw that takes as long. If only a time is given, it lands at the height that it left from.
    fn new(time_of_flight: TimeOfFlight) -> Self {
        match time_of_flight {
            TimeOfFlight::Ballistic { speed, gravity } | TimeOfFlight::BallisticTo { speed, gravity, .. } => {
                Self { speed, gravity }
            }
            TimeOfFlight::Given(time) => Self { speed: 0.5 * DEFAULT_GRAVITY * time, gravity: DEFAULT_GRAVITY },
        }
    }

    /// The height above the launch (m) at a time after it (s).
    fn height(&self, time: f64) -> f64 {
        (self.speed - 0.5 * self.gravity * time) * time
    }
}

/// Draws the coin or the `solid` about `centre` (pixels), with n and the vector in the face.
pub(super) fn draw_coin(panel: &Panel<'_>, centre: (i32, i32), attitude: &Attitude, solid: Solid) -> Drawn {
    let normal = attitude.normal();
    let shows_heads = project(&normal).near >= 0.0;
    let (tip, height) = solid.heights();
    let side = if shows_heads { height } else { -height };
    let at =
        |across: f64, along: f64, out: f64| end_of(centre, &attitude.body_to_lab(&Vector3::new(across, along, out)));
    let n = PathElement::new([at(0.0, 0.0, height), at(0.0, 0.0, tip)], NORMAL.stroke_width(5));
    if !shows_heads {
        panel.draw(&n)?;
    }
    match solid {
        Solid::Disc => draw_disc(panel, at, side)?,
        Solid::Cuboid(half) => draw_cuboid(panel, centre, attitude, half)?,
    }
    let face = [at(0.0, 0.0, side), at(solid.reach(), 0.0, side)];
    panel.draw(&PathElement::new(face, WHITE.stroke_width(9)))?;
    panel.draw(&PathElement::new(face, FACE.stroke_width(5)))?;
    if shows_heads {
        panel.draw(&n)?;
    }
    Ok(())
}

/// Draws the disc of a coin, whose face towards the eye is at the height `side` and whose points are `at` pixels.
fn draw_disc(panel: &Panel<'_>, at: impl Fn(f64, f64, f64) -> (i32, i32), side: f64) -> Drawn {
    let shows_heads = side >= 0.0;
    let rim = |out: f64| -> Vec<(i32, i32)> {
        let points = (0..=36).map(|step| (f64::from(step) * TAU / 36.0).sin_cos());
        points.map(|(along, across)| at(across, along, out)).collect()
    };
    for layer in 0..LAYERS {
        let out = side * (2.0 * f64::from(layer) / f64::from(LAYERS) - 1.0);
        panel.draw(&Polygon::new(rim(out), EDGE.filled()))?;
    }
    panel.draw(&PathElement::new(rim(-side), BLACK.stroke_width(1)))?;
    panel.draw(&Polygon::new(rim(side), if shows_heads { WHITE } else { TAILS }.filled()))?;
    panel.draw(&PathElement::new(rim(side), BLACK.stroke_width(2)))?;
    Ok(())
}
