//! The chart of a flight: the coin going up and down, cos θ below it, and the paths on the sphere beside it. It shows why a
//! coin lands as it does, as the paper's Figs. 2 and 3.

use chart::{Axis, ChartError, Drawn, Panel, TEXT, centred, frame, pixel, svg};
use plotters::prelude::*;
use toss::catalogue::{BODIES, CATALOGUE};
use toss::{Body, Outcome, Toss, TracePoint};

use crate::chart::coin::draw_coins;
use crate::chart::layout::{NORMAL, RIGHT, is_too_fast, times};
use crate::chart::legend::draw_legend;
use crate::chart::solid::Solid;
use crate::chart::sphere::draw_sphere;

/// Twice the size at which it is read.
const SIZE: (u32, u32) = (1800, 1080);
/// Height of the title (pixels).
const TITLE: u32 = 70;
/// Width of the panels over time (pixels).
const LEFT: u32 = 1040;
/// Height of the panel of the coins (pixels).
const COINS: u32 = 570;
/// Height of the panel of the sphere (pixels).
const SPHERE: u32 = 760;

/// The chart of `flight`, the trace of `toss`, as SVG.
pub(crate) fn flight(flight: &[TracePoint], toss: &Toss, outcome: Outcome) -> Result<String, ChartError> {
    svg(SIZE, |root| {
        let (head, body) = root.split_vertically(TITLE);
        let (over_time, beside) = body.split_horizontally(LEFT);
        let (coins, tilt) = over_time.split_vertically(COINS);
        let (sphere, legend) = beside.split_vertically(SPHERE);
        centred(&head, &title(toss, outcome), (i32::try_from(SIZE.0 / 2).unwrap_or(0), 42))?;
        draw_coins(&coins, flight, toss)?;
        draw_tilt(&tilt, flight)?;
        draw_sphere(&sphere, flight)?;
        draw_legend(&legend, is_too_fast(toss), Solid::new(&toss.body))
    })
}

/// The body, its launch and its landing.
fn title(toss: &Toss, outcome: Outcome) -> String {
    let attitude = toss.launch.attitude();
    let [w, x, ..] = attitude.components();
    let tilt =
        if x == 0.0 { "horizontal".to_owned() } else { format!("at a tilt of {} rad", rounded(2.0 * x.atan2(w))) };
    let rate = toss.launch.rate();
    let (body, what) = (named(&toss.body), if toss.body.coin().is_some() { "the coin" } else { "it" });
    let landing = match outcome {
        Outcome::Heads => format!("{what} lands heads"),
        Outcome::Tails => format!("{what} lands tails"),
        Outcome::Undecided => format!("how {what} lands is undecided"),
    };
    format!("{body}, launched {tilt}, ω = ({}, {}, {}) rad/s: {landing}", rate.x, rate.y, rate.z)
}

fn rounded(value: f64) -> f64 {
    (1e4 * value).round() / 1e4
}

/// The body's name in the catalogue, if it has one, and what decides its motion.
fn named(body: &Body) -> String {
    if let Some(coin) = body.coin() {
        let named = CATALOGUE.iter().find(|entry| entry.coin().is_ok_and(|other| other == coin));
        let name = named.map_or_else(|| "A coin".to_owned(), |entry| format!("Coin '{}'", entry.name));
        return format!("{name} (k = {})", rounded(coin.inertia_ratio()));
    }
    let named = BODIES.iter().find(|entry| entry.body().is_ok_and(|other| other == *body));
    let name = named.map_or_else(|| "A body".to_owned(), |entry| format!("Body '{}'", entry.name));
    let moments = body.moments().unwrap_or_else(|| body.principal_moments());
    let [one, two, three] = moments.map(|moment| rounded(moment / body.principal_moments()[2]));
    format!("{name} (moments {one} : {two} : {three})")
}

fn draw_tilt(panel: &Panel<'_>, flight: &[TracePoint]) -> Drawn {
    let (x, y) = (times("time [s]", flight), Axis::linear("cos θ", -1.1..1.1));
    let mut chart = frame(panel, "", (&x, &y), RIGHT)?;
    let [start, end] = [x.start(), x.end()];
    chart.draw_series(LineSeries::new([(start, 0.0), (end, 0.0)], BLACK.stroke_width(2)))?;
    let line = flight.iter().map(|point| (point.time, point.cos_tilt));
    chart.draw_series(LineSeries::new(line, NORMAL.stroke_width(4)))?;
    // Beside the frame, where no curve comes.
    let (right, level) = pixel(panel, &chart, (end, 0.0));
    panel.draw(&Text::new("heads", (right + 12, level - 40), TEXT))?;
    panel.draw(&Text::new("tails", (right + 12, level + 10), TEXT))?;
    Ok(())
}
