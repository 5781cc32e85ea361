//! The chart of a flight: the coin going up and down, cos θ below it, and the paths on the sphere beside it, with a legend where
//! no flight passes. It shows why a coin lands as it does, as the paper's Figs. 2 and 3.

use std::f64::consts::{PI, TAU};

use chart::{Axis, ChartError, Drawn, FAINT, GREY, Panel, TEXT, centred, frame, pixel, svg};
use dynamics::time_of_flight::DEFAULT_GRAVITY;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use toss::catalogue::entries;
use toss::{Attitude, Body, CoinMotion, ExactMotion, Outcome, Toss, TracePoint, Vector3};

use crate::chart::solid::{EDGE, Seen, Solid, TAILS, draw_cuboid, end_of, project};
use crate::quantity::shortest;

/// Twice the size at which it is read.
const SIZE: (u32, u32) = (1800, 1110);
/// Height of the two lines of the title (pixels).
const HEAD: u32 = 100;
/// Width of the panels over time (pixels).
const LEFT: u32 = 1040;
/// Height of the panel of the coins (pixels).
const OF_COINS: u32 = 570;
/// Height of the panel of the sphere (pixels).
const OF_SPHERE: u32 = 760;

/// The chart of `flight`, the trace of `toss`, as SVG. Its title has the launch in the units in which it was typed, and the solver.
pub(crate) fn flight(
    flight: &[TracePoint],
    toss: &Toss,
    outcome: Outcome,
    (launched, solver): (&str, &str),
) -> Result<String, ChartError> {
    svg(SIZE, |root| {
        let (head, body) = root.split_vertically(HEAD);
        let (over_time, beside) = body.split_horizontally(LEFT);
        let (coins, tilt) = over_time.split_vertically(OF_COINS);
        let (sphere, legend) = beside.split_vertically(OF_SPHERE);
        let middle = i32::try_from(SIZE.0 / 2).unwrap_or(0);
        centred(&head, &title(toss, launched, outcome), (middle, 36))?;
        centred(&head, solver, (middle, 78))?;
        draw_coins(&coins, flight, toss)?;
        draw_tilt(&tilt, flight, toss)?;
        draw_sphere(&sphere, flight, is_too_fast(toss))?;
        draw_legend(&legend, is_too_fast(toss), Solid::new(&toss.body))
    })
}

/// The body, its launch and its landing.
fn title(toss: &Toss, launched: &str, outcome: Outcome) -> String {
    let what = if toss.body.coin().is_some() { "the coin" } else { "it" };
    let landing = match outcome {
        Outcome::Undecided => format!("how {what} lands is undecided"),
        outcome => format!("{what} lands {outcome}"),
    };
    format!("{}, {launched}: {landing}", named(&toss.body))
}

fn rounded(value: f64) -> f64 {
    (1e4 * value).round() / 1e4
}

/// The body's name in the catalogue, if it has one, and what decides its motion.
pub(crate) fn named(body: &Body) -> String {
    let entry = entries().find(|entry| entry.body().is_ok_and(|other| other == *body));
    let name = |kind: &str| {
        entry.map_or_else(|| format!("A {}", kind.to_lowercase()), |entry| format!("{kind} '{}'", entry.name))
    };
    if let Some(coin) = body.coin() {
        return format!("{} (k = {})", name("Coin"), rounded(coin.inertia_ratio()));
    }
    let moments = body.moments().unwrap_or_else(|| body.principal_moments());
    let [one, two, three] = moments.map(|moment| rounded(moment / body.principal_moments()[2]));
    format!("{} (moments {one} : {two} : {three})", name("Body"))
}

/// Draws cos θ as a line, or of too many turns as the band that it fills.
fn draw_tilt(panel: &Panel<'_>, flight: &[TracePoint], toss: &Toss) -> Drawn {
    let (x, y) = (times("time [s]", flight), Axis::linear("cos θ", -1.1..1.1));
    let mut chart = frame(panel, "", (&x, &y), RIGHT)?;
    let [start, end] = [x.start(), x.end()];
    chart.draw_series(LineSeries::new([(start, 0.0), (end, 0.0)], BLACK.stroke_width(2)))?;
    if is_too_fast(toss) {
        chart.draw_series([Polygon::new(band(flight, turns(toss)), NORMAL.mix(0.5).filled())])?;
    } else {
        let line = flight.iter().map(|point| (point.time, point.cos_tilt));
        chart.draw_series(LineSeries::new(line, NORMAL.stroke_width(4)))?;
    }
    // Beside the frame, where no curve comes.
    let (right, level) = pixel(panel, &chart, (end, 0.0));
    panel.draw(&Text::new("heads", (right + 12, level - 40), TEXT))?;
    panel.draw(&Text::new("tails", (right + 12, level + 10), TEXT))?;
    Ok(())
}

/// The colour of n.
const NORMAL: RGBColor = chart::BLUE;
/// The colour of the vector in the face.
const FACE: RGBColor = chart::VERMILION;

/// Space beside the panels over time (pixels), for "heads" and "tails".
const RIGHT: u32 = 110;

/// How many coins are drawn.
const COINS: usize = 11;

/// Points of a curve for each turn: at 60 a chord is nowhere farther than 0.0014 radii from its circle.
const POINTS_PER_TURN: f64 = 60.0;
/// More turns than these can't be told apart; of a faster flight is drawn where it comes, and not on which way.
const MOST_TURNS: f64 = 60.0;
/// The fewest turns' worth of points, for a flight of less than a turn.
const FEWEST_TURNS: f64 = 2.0;

/// About how many points tell where a fast flight comes.
const POINTS_OF_BAND: f64 = 10_000.0;
/// The part of a turn by which its points go on beside whole turns: the golden section, so that they meet all phases evenly.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// The most parts of a band, and the turns in each of them at least.
const PARTS: f64 = 240.0;
const TURNS_PER_PART: f64 = 6.0;
/// One point of so many of a fast flight is a dot on the sphere.
const POINTS_PER_DOT: usize = 7;

/// The axis of the times that are drawn (s), with room for half a coin at either end.
fn times(label: &str, flight: &[TracePoint]) -> Axis {
    let end = flight.last().map_or(0.0, |point| point.time).max(f64::MIN_POSITIVE);
    Axis::linear(label, -0.06 * end..1.06 * end)
}

/// How many points the curves of `toss` are drawn by. The coins are at points of the curve, at equal times.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 30 000")]
pub(crate) fn points_to_draw(toss: &Toss) -> usize {
    if is_too_fast(toss) {
        return points_of_band(turns(toss)).ceil() as usize + 1;
    }
    let between_coins = POINTS_PER_TURN * turns(toss).clamp(FEWEST_TURNS, MOST_TURNS) / (COINS - 1) as f64;
    between_coins.ceil() as usize * (COINS - 1) + 1
}

/// How many intervals there are between the points of a fast flight. None is near a simple part of a turn: of a flight of
/// 100 000 turns, 30 000 equal intervals would show three phases.
fn points_of_band(turns: f64) -> f64 {
    if turns < POINTS_OF_BAND {
        return turns * ((POINTS_OF_BAND / turns).floor() + GOLDEN);
    }
    // Of more turns than an f64 counts, any number serves.
    let every = (turns / POINTS_OF_BAND).floor() + GOLDEN;
    if every < 1e12 { turns / every } else { POINTS_OF_BAND }
}

/// The outline of the times and of cos θ between which a flight of so many turns comes.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 240")]
fn band(flight: &[TracePoint], turns: f64) -> Vec<(f64, f64)> {
    let parts = (turns / TURNS_PER_PART).min(PARTS) as usize;
    let corners = flight.chunks(flight.len().div_ceil(parts.max(1))).flat_map(|part| {
        let values = || part.iter().map(|point| point.cos_tilt);
        let ends = [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)];
        [part.first(), part.last()].into_iter().flatten().map(move |point| (point.time, ends))
    });
    let corners: Vec<(f64, [f64; 2])> = corners.collect();
    let lower = corners.iter().map(|(time, [low, _])| (*time, *low));
    lower.chain(corners.iter().rev().map(|(time, [_, high])| (*time, *high))).collect()
}

/// Whether the flight has more turns than can be drawn.
fn is_too_fast(toss: &Toss) -> bool {
    turns(toss) > MOST_TURNS
}

/// Turns of the fastest motion of a flight: n goes round S at ωL, and the coin spins about n at (1 - k) ωz as well. Of
/// another body they are twice the larger one of its two phases.
fn turns(toss: &Toss) -> f64 {
    let Some(toss) = toss.coin() else {
        let phase = ExactMotion::new(toss).phase(toss.launch.time_of_flight());
        return phase.map_or(f64::INFINITY, |phase| 2.0 * phase / TAU);
    };
    let spin = (1.0 - toss.coin.inertia_ratio()) * toss.launch.rate().z;
    let rate = CoinMotion::new(&toss).precession_rate() + spin.abs();
    let turns = rate * toss.launch.flight_time() / TAU;
    // An infinite rate for no time at all.
    if turns.is_nan() { 0.0 } else { turns }
}

/// Number of layers by which its edge is drawn.
const LAYERS: u32 = 6;

/// Draws the coins of `flight`, the trace of `toss`.
fn draw_coins(panel: &Panel<'_>, flight: &[TracePoint], toss: &Toss) -> Drawn {
    let time_of_flight = toss.launch.time_of_flight();
    // If only a time is given, it lands at the height that it left from.
    let level = || [0.5 * DEFAULT_GRAVITY * time_of_flight.seconds(), DEFAULT_GRAVITY];
    let [speed, gravity] = time_of_flight.throw().unwrap_or_else(level);
    let heights: Vec<f64> =
        flight.iter().map(|&TracePoint { time, .. }| (speed - 0.5 * gravity * time) * time).collect();
    let (lowest, highest) = heights.iter().fold((0.0_f64, 0.0_f64), |(lo, hi), at| (lo.min(*at), hi.max(*at)));
    let room = 0.14 * (highest - lowest).max(f64::MIN_POSITIVE);
    if !room.is_finite() {
        return Err(ChartError("a flight so high can't be drawn".to_owned()).into());
    }
    let height = format!("height [m], at g = {} m/s²", shortest(gravity));
    let (x, y) = (times("", flight), Axis::linear(&height, lowest - room..highest + room));
    let chart = frame(panel, "", (&x, &y), RIGHT)?;
    let solid = Solid::new(&toss.body);
    for index in (0..COINS).map(|coin| coin * (flight.len() - 1) / (COINS - 1)) {
        let centre = pixel(panel, &chart, (flight[index].time, heights[index]));
        draw_coin(panel, centre, &flight[index].attitude, solid)?;
    }
    Ok(())
}

/// Draws the coin or the `solid` about `centre` (pixels), with n and the vector in the face.
fn draw_coin(panel: &Panel<'_>, centre: (i32, i32), attitude: &Attitude, solid: Solid) -> Drawn {
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

/// Room for the title, and on the other sides (pixels).
const TITLE: u32 = 76;
const MARGIN: u32 = 16;

/// A chart without axes.
type Chart<'a, 'b> =
    ChartContext<'a, SVGBackend<'b>, plotters::coord::cartesian::Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Draws the paths of `flight`, or some of their points if it is too fast.
fn draw_sphere(panel: &Panel<'_>, flight: &[TracePoint], is_too_fast: bool) -> Drawn {
    let (width, height) = panel.dim_in_pixel();
    let (middle, title) = (i32::try_from(width / 2).unwrap_or(0), "The paths on the unit sphere, seen from above");
    centred(panel, title, (middle, 40))?;
    let reach = 1.05 * f64::from(width - 2 * MARGIN) / f64::from(height - TITLE - MARGIN);
    let mut chart =
        ChartBuilder::on(panel).margin(MARGIN).margin_top(TITLE).build_cartesian_2d(-reach..reach, -1.05..1.05)?;
    let angles = || (0..=120).map(|step| f64::from(step) * TAU / 120.0);
    chart.draw_series(LineSeries::new(angles().map(f64::sin_cos), FAINT.stroke_width(2)))?;
    let equator: Vec<Seen> = angles().map(|angle| project(&Vector3::new(angle.cos(), angle.sin(), 0.0))).collect();
    draw_path(&mut chart, &equator, FAINT, 2)?;
    for (colour, of) in
        [(FACE, (|point| point.face) as fn(&TracePoint) -> Vector3<f64>), (NORMAL, |point| point.normal)]
    {
        let seen: Vec<Seen> = flight.iter().map(|point| project(&of(point))).collect();
        if is_too_fast {
            draw_dots(&mut chart, &seen, colour)?;
        } else {
            draw_path(&mut chart, &seen, colour, 4)?;
        }
        if let (Some(first), Some(last)) = (seen.first(), seen.last()) {
            let launch = Circle::new((first.right, first.up), 11, WHITE.filled());
            let ring = Circle::new((first.right, first.up), 11, colour.stroke_width(4));
            let landing = Circle::new((last.right, last.up), 11, colour.filled());
            chart.draw_series([launch, ring, landing])?;
        }
    }
    Ok(())
}

/// Draws a path on the sphere, dashed where it is on the far side.
fn draw_path(chart: &mut Chart<'_, '_>, path: &[Seen], colour: RGBColor, width: u32) -> Drawn {
    let pairs: Vec<&[Seen]> = path.windows(2).collect();
    let is_near = |pair: &[Seen]| pair[0].near + pair[1].near >= 0.0;
    for run in pairs.chunk_by(|a, b| is_near(a) == is_near(b)) {
        let points: Vec<(f64, f64)> =
            std::iter::once(&run[0][0]).chain(run.iter().map(|pair| &pair[1])).map(|at| (at.right, at.up)).collect();
        if is_near(run[0]) {
            chart.draw_series(LineSeries::new(points, colour.stroke_width(width)))?;
        } else {
            chart.draw_series(DashedLineSeries::new(points, 9, 9, colour.stroke_width(width - 1)))?;
        }
    }
    Ok(())
}

/// Draws points of a path on the sphere, pale where they are on the far side.
fn draw_dots(chart: &mut Chart<'_, '_>, path: &[Seen], colour: RGBColor) -> Drawn {
    for (is_near, shade) in [(false, colour.mix(0.3)), (true, colour.mix(1.0))] {
        let dots = path.iter().step_by(POINTS_PER_DOT).filter(|at| (at.near >= 0.0) == is_near);
        chart.draw_series(dots.map(|at| Circle::new((at.right, at.up), 3, shade.filled())))?;
    }
    Ok(())
}

/// Height of a line of text (pixels).
const ROW: i32 = 42;

/// Draws it, with a remark on a flight that is too fast to be drawn turn by turn.
fn draw_legend(panel: &Panel<'_>, is_too_fast: bool, solid: Solid) -> Drawn {
    let coins = match (solid, is_too_fast) {
        (Solid::Disc, true) => "coins enlarged; cos θ fills the band",
        (Solid::Disc, false) => "coins enlarged",
        (Solid::Cuboid(_), true) => "a cuboid of its moments; cos θ fills the band",
        (Solid::Cuboid(_), false) => "drawn as the cuboid with its moments",
    };
    let sides = match is_too_fast {
        true => "○ launch, ● landing; pale: on the far side",
        false => "○ launch, ● landing; dashed: on the far side",
    };
    let rows = [
        ("n, the normal of the heads side", NORMAL),
        ("a vector fixed in the face", FACE),
        (sides, BLACK),
        (coins, GREY),
    ];
    for (row, (words, colour)) in (0..).zip(rows) {
        panel.draw(&Text::new(words, (24, ROW * row), TEXT.into_font().color(&colour)))?;
    }
    for (x, words, tilt) in [(66, "heads side", 0.0), (396, "tails side", PI)] {
        let y = 4 * ROW + 44;
        draw_coin(panel, (x, y), &Attitude::about_x(tilt), solid)?;
        panel.draw(&Text::new(words, (x + 60, y - 16), TEXT))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use toss::{Coin, Launch, TimeOfFlight};

    use super::*;

    fn toss(rate: [f64; 3], time: f64) -> Toss {
        let launch = Launch::new(rate, TimeOfFlight::Given(time)).unwrap();
        Toss { body: Coin::PAPER.into(), launch }
    }

    #[test]
    fn a_body_of_three_moments_has_points_for_each_of_its_turns() {
        let body: Body = "racket".parse().unwrap();
        let drawn = |rate, time| points_to_draw(&Toss { body, ..toss(rate, time) });
        // About y for sixteen turns, which the racket does not do for ever, and about its handle.
        assert!((1900..2000).contains(&drawn([0.0, 10.0, 0.0], 10.0)), "{}", drawn([0.0, 10.0, 0.0], 10.0));
        assert!((950..4000).contains(&drawn([0.01, 10.0, 0.01], 10.0)), "{}", drawn([0.01, 10.0, 0.01], 10.0));
        assert_eq!(drawn([0.0, 1e300, 0.0], 10.0), 10_001);
    }

    #[test]
    fn curves_have_sixty_points_for_each_turn_of_n_and_of_the_face_up_to_sixty_turns() {
        // ωL = 10 rad/s without spin, and ωL = spin = 20 rad/s: 16 and 64 turns in ten seconds.
        let [wobbling, spinning] = [[6.0, 8.0, 0.0], [0.0, 0.0, 40.0]].map(|rate| points_to_draw(&toss(rate, 10.0)));
        assert!((955..980).contains(&wobbling), "{wobbling}");
        assert!((9_000..16_000).contains(&spinning), "{spinning}");
    }

    #[test]
    fn flights_of_no_time_or_of_countless_turns_have_a_bounded_number_of_points() {
        let fastest = [1.7e308; 3];
        for (rate, time, is_fast) in [([0.0; 3], 0.0, false), (fastest, 0.0, false), (fastest, 1e300, true)] {
            let flight = toss(rate, time);
            assert!((121..=30_001).contains(&points_to_draw(&flight)), "{rate:?}");
            assert_eq!(is_too_fast(&flight), is_fast);
        }
    }
}
