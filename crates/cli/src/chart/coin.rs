//! Positions of the coin at equal times, going up and down: a disc whose heads side is white and whose tails side is dark.

use std::f64::consts::TAU;

use chart::{ChartError, Drawn, Panel, TEXT};
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use plotters::prelude::*;
use toss::{Attitude, Outcome, TimeOfFlight, Toss, TracePoint, Vector3};

use crate::chart::layout::{FACE, NORMAL, NUMBERS, times};
use crate::chart::projection::project;

/// How many are drawn at most.
const COINS: usize = 11;
/// Radius of the coin (pixels).
const RADIUS: f64 = 36.0;
/// Thickness of the coin, in radii.
const THICKNESS: f64 = 0.14;
/// Layers that its edge is drawn in.
const LAYERS: u32 = 6;

const TAILS: RGBColor = RGBColor(70, 70, 70);
const EDGE: RGBColor = RGBColor(170, 170, 170);

/// Draws the coins of `flight`, the trace of `toss`.
pub(super) fn draw_coins(panel: &Panel<'_>, flight: &[TracePoint], toss: &Toss, outcome: Outcome) -> Drawn {
    let thrown = Thrown::new(toss.launch.time_of_flight());
    let heights: Vec<f64> = flight.iter().map(|point| thrown.height(point.time)).collect();
    let (lowest, highest) = heights.iter().fold((0.0_f64, 0.0_f64), |(lo, hi), at| (lo.min(*at), hi.max(*at)));
    let room = 0.14 * (highest - lowest).max(f64::MIN_POSITIVE);
    if !room.is_finite() {
        return Err(ChartError("a flight so high can't be drawn".to_owned()).into());
    }
    let rate = toss.launch.rate();
    let title = format!("ω = ({}, {}, {}) rad/s: {}", rate.x, rate.y, rate.z, landing(outcome));
    let mut chart = ChartBuilder::on(panel)
        .margin(24)
        .margin_bottom(8)
        .caption(title, TEXT)
        .x_label_area_size(44)
        .y_label_area_size(NUMBERS)
        .build_cartesian_2d(times(flight), lowest - room..highest + room)?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .y_desc(format!("height [m], at g = {} m/s²", thrown.gravity))
        .y_labels(6)
        .label_style(TEXT)
        .axis_desc_style(TEXT)
        .draw()?;
    let (left, top) = panel.get_base_pixel();
    let last = flight.len() - 1;
    let drawn = COINS.min(flight.len());
    for index in (0..drawn).map(|coin| coin * last / (drawn - 1)) {
        let (x, y) = chart.plotting_area().map_coordinate(&(flight[index].time, heights[index]));
        draw_coin(panel, (x - left, y - top), &flight[index].attitude)?;
    }
    draw_legend(panel)
}

fn landing(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Heads => "the coin lands heads",
        Outcome::Tails => "the coin lands tails",
        Outcome::Undecided => "how the coin lands is undecided",
    }
}

/// The vertical motion.
struct Thrown {
    /// v0 (m/s).
    speed: f64,
    /// g (m/s²).
    gravity: f64,
}

impl Thrown {
    /// Of a time alone: the throw that lands at the height it left from.
    fn new(time_of_flight: TimeOfFlight) -> Self {
        match time_of_flight {
            TimeOfFlight::Ballistic { speed, gravity } | TimeOfFlight::BallisticTo { speed, gravity, .. } => {
                Self { speed, gravity }
            }
            TimeOfFlight::Given(time) => Self { speed: 0.5 * DEFAULT_GRAVITY * time, gravity: DEFAULT_GRAVITY },
        }
    }

    /// Above the launch (m), at a time after it (s).
    fn height(&self, time: f64) -> f64 {
        (self.speed - 0.5 * self.gravity * time) * time
    }
}

/// The coin about `centre` (pixels), with n and the vector in the face.
fn draw_coin(panel: &Panel<'_>, centre: (i32, i32), attitude: &Attitude) -> Drawn {
    let normal = attitude.normal();
    let shows_heads = project(&normal).near >= 0.0;
    let side = if shows_heads { 0.5 * THICKNESS } else { -0.5 * THICKNESS };
    let at =
        |across: f64, along: f64, out: f64| pixel(centre, &attitude.body_to_lab(&Vector3::new(across, along, out)));
    let n = PathElement::new([at(0.0, 0.0, 0.5 * THICKNESS), at(0.0, 0.0, 1.0)], NORMAL.stroke_width(5));
    if !shows_heads {
        panel.draw(&n)?;
    }
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
    let face = [at(0.0, 0.0, side), at(1.0, 0.0, side)];
    panel.draw(&PathElement::new(face, WHITE.stroke_width(9)))?;
    panel.draw(&PathElement::new(face, FACE.stroke_width(5)))?;
    if shows_heads {
        panel.draw(&n)?;
    }
    Ok(())
}

/// Where the end of `vector` (LF, in radii) from `centre` is seen (pixels).
#[expect(clippy::cast_possible_truncation, reason = "within the canvas")]
fn pixel(centre: (i32, i32), vector: &Vector3<f64>) -> (i32, i32) {
    let seen = project(vector);
    (centre.0 + (RADIUS * seen.right).round() as i32, centre.1 - (RADIUS * seen.up).round() as i32)
}

fn draw_legend(panel: &Panel<'_>) -> Drawn {
    let (width, height) = panel.dim_in_pixel();
    let (x, y) = (i32::try_from(width).unwrap_or(0) / 2 - 150, i32::try_from(height).unwrap_or(0) - 250);
    let half_turn = std::f64::consts::PI;
    for (row, words, tilt) in [(0, "heads side", 0.0), (1, "tails side", half_turn)] {
        draw_coin(panel, (x, y + 90 * row), &Attitude::about_x(tilt))?;
        panel.draw(&Text::new(words, (x + 60, y + 90 * row - 12), TEXT))?;
    }
    panel.draw(&Text::new("not to scale: coins are enlarged", (x - 40, y + 134), TEXT))?;
    Ok(())
}
