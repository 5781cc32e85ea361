//! Draws the atlas of failures. The matrix shows it at a glance: one row for each contestant, one column for each hazard, and
//! in each cell the contestant's worst answer. The lines show error and work against the distance from each hazard, with one
//! panel for each hazard and one line for each solver and formulation. A line is by the first scheme of its solver; the
//! other schemes do the same with more work.

use chart::{
    Axis, ChartError, Drawn, FAINT, GREEN, GREY, LINE_WIDTH, Marker, ORANGE, PURPLE, Panel, Series, TEXT, VERMILION,
    log_log, svg,
};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::palette::Palette;
use super::{legend, legend_height};
use crate::measure::atlas::expected::Expectation;
use crate::measure::atlas::hazards::{HAZARDS, Hazard};
use crate::measure::atlas::{Atlas, Spot};
use crate::measure::run::Answer;

const LEFT: i32 = 360;
const TOP: i32 = 160;
const CELL: (i32, i32) = (177, 46);

/// The matrix as SVG: `worst` is the worst answer of a subject at a hazard.
pub(crate) fn matrix(
    subjects: &[&str],
    worst: impl Fn(&str, &str) -> Option<Expectation>,
) -> Result<String, ChartError> {
    let width = LEFT + CELL.0 * as_i32(HAZARDS.len()) + 40;
    let height = TOP + CELL.1 * as_i32(subjects.len()) + 120;
    svg((width.cast_unsigned(), height.cast_unsigned()), |root| {
        centred(root, "How solvers answer near the places where methods fail", (width / 2, 30), BLACK)?;
        for (column, hazard) in (0..).zip(HAZARDS) {
            let x = LEFT + CELL.0 * column + CELL.0 / 2;
            let what = hazard.name.split_once(": ").map_or(hazard.name, |(what, _)| what);
            centred(root, hazard.id, (x, 86), BLACK)?;
            centred(root, what, (x, 126), GREY)?;
        }
        for (row, subject) in (0..).zip(subjects) {
            let y = TOP + CELL.1 * row;
            let style = TEXT.into_font().color(&BLACK).pos(Pos::new(HPos::Left, VPos::Center));
            root.draw(&Text::new((*subject).to_owned(), (24, y + CELL.1 / 2), style))?;
            for (column, hazard) in (0..).zip(HAZARDS) {
                if let Some(answer) = worst(subject, hazard.id) {
                    draw(root, (LEFT + CELL.0 * column, y), answer)?;
                }
            }
        }
        let remark = "Each cell: the worst answer over all distances from the hazard, 1 to 1e-16 and 0 (F6: up to 2^53 rad; F8: up to 10⁴ s)";
        let below = TOP + CELL.1 * as_i32(subjects.len());
        root.draw(&Text::new(remark, (24, below + 24), TEXT.into_font().color(&GREY)))?;
        let rk4 = "rk4 estimates no error. It is judged by the error that its order promises, and its outcome by the sign of cos θ.";
        root.draw(&Text::new(rk4, (24, below + 66), TEXT.into_font().color(&GREY)))?;
        Ok(())
    })
}

fn as_i32(count: usize) -> i32 {
    i32::try_from(count).unwrap_or(i32::MAX)
}

/// Draws a cell by a colour and a word, so that nobody has to rely on the colour.
fn draw(root: &Panel<'_>, (x, y): (i32, i32), cell: Expectation) -> Drawn {
    let (fill, text, word) = match cell {
        Expectation::Answer(Answer::Right) => (GREEN.mix(0.25), BLACK, "right"),
        Expectation::Answer(Answer::TypedError) => (ORANGE.mix(0.45), BLACK, "typed error"),
        Expectation::Answer(Answer::Unclaimed) => (GREY.mix(0.25), BLACK, "no claim"),
        Expectation::Answer(Answer::SilentlyWrong) => (VERMILION.mix(1.0), WHITE, "WRONG"),
        Expectation::RightOrTypedError => (ORANGE.mix(0.25), BLACK, "right or error"),
    };
    let corners = [(x + 2, y + 2), (x + CELL.0 - 2, y + CELL.1 - 2)];
    root.draw(&Rectangle::new(corners, fill.filled()))?;
    if cell == Expectation::Answer(Answer::SilentlyWrong) {
        root.draw(&Rectangle::new(corners, FAINT.stroke_width(1)))?;
    }
    centred(root, word, (x + CELL.0 / 2, y + CELL.1 / 2), text)
}

fn centred(root: &Panel<'_>, text: &str, at: (i32, i32), colour: RGBColor) -> Drawn {
    let size = 26;
    let style = (TEXT.0, size).into_font().color(&colour).pos(Pos::new(HPos::Center, VPos::Center));
    root.draw(&Text::new(text.to_owned(), at, style))?;
    Ok(())
}

/// Where the distance 0 is drawn.
const ZERO: f64 = 1e-18;

type Quantity = fn(&Spot) -> Option<f64>;

/// The chart of the attitude's error, with the effect of one rounding of the launch.
pub(super) fn errors(atlas: &Atlas, palette: &Palette<'_>) -> Result<String, ChartError> {
    let quantity: Quantity = |spot| spot.run.err_attitude;
    Lines { atlas, palette, quantity, with_rounding: true }.svg("error of the attitude [rad]", 1e-18..1e3)
}

/// The chart of the calls of the right-hand side.
pub(super) fn work(atlas: &Atlas, palette: &Palette<'_>) -> Result<String, ChartError> {
    let quantity: Quantity = |spot| spot.run.rhs_calls.filter(|calls| *calls > 0).map(|calls| calls as f64);
    Lines { atlas, palette, quantity, with_rounding: false }.svg("calls of the right-hand side", 1e1..1e7)
}

struct Lines<'a> {
    atlas: &'a Atlas,
    palette: &'a Palette<'a>,
    quantity: Quantity,
    with_rounding: bool,
}

impl Lines<'_> {
    fn svg(&self, label: &str, range: std::ops::Range<f64>) -> Result<String, ChartError> {
        let rows = HAZARDS.len().div_ceil(2);
        let foot = legend_height(self.of(&HAZARDS[0]).len());
        let height = 540 * u32::try_from(rows).unwrap_or(1) + foot;
        let y = Axis::logarithmic(label, range);
        svg((2000, height), |root| {
            let (body, foot) = root.split_vertically(height - foot);
            for (hazard, panel) in HAZARDS.iter().zip(body.split_evenly((rows, 2))) {
                let title = format!("{}  {}", hazard.id, hazard.name);
                log_log(&panel, &title, (&distance_axis(hazard), &y), &self.of(hazard), 40)?;
            }
            legend(&foot, &self.of(&HAZARDS[0]))
        })
    }

    fn of(&self, hazard: &Hazard) -> Vec<Series> {
        let rounding = self.with_rounding.then(|| self.rounding(hazard));
        let mut lines: Vec<Series> = rounding.into_iter().collect();
        for (subject, colour, dashed, marker) in self.palette.contestants() {
            let (mut points, mut failures) = (Vec::new(), Vec::new());
            for spot in self.atlas.series(hazard.id, &subject) {
                match (self.quantity)(spot) {
                    Some(value) => points.push((at(spot), value)),
                    None if spot.run.failure.is_some() => failures.push(at(spot)),
                    None => {}
                }
            }
            lines.push(Series { label: subject, colour, width: LINE_WIDTH, dashed, marker, points, failures });
        }
        lines
    }

    /// The effect of one rounding of the launch, which is the same for all contestants.
    fn rounding(&self, hazard: &Hazard) -> Series {
        let first = self.atlas.subjects().first().copied().unwrap_or_default();
        let spots = self.atlas.series(hazard.id, first);
        Series {
            label: "one rounding of the launch".to_owned(),
            colour: PURPLE,
            width: LINE_WIDTH,
            dashed: true,
            marker: Marker::None,
            points: spots.filter_map(|spot| Some((at(spot), spot.conditioning?.rounding()))).collect(),
            failures: Vec::new(),
        }
    }
}

fn distance_axis(hazard: &Hazard) -> Axis {
    let nearest = hazard.distances.iter().copied().fold(1.0, f64::min);
    let start = if nearest == 0.0 { ZERO } else { nearest };
    let axis = Axis::logarithmic(hazard.distance, start..1.0);
    if nearest == 0.0 { axis.starting_at_zero() } else { axis }
}

fn at(spot: &Spot) -> f64 {
    spot.distance.max(ZERO)
}
