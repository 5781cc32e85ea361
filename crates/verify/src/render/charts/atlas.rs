//! Draws the atlas of failures at a glance: one row for each contestant, one column for each hazard, and in each cell the
//! contestant's worst answer.

use chart::{ChartError, Drawn, FAINT, GREEN, GREY, ORANGE, Panel, TEXT, VERMILION, svg};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::measure::atlas::expected::Expectation;
use crate::measure::atlas::hazards::HAZARDS;
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
