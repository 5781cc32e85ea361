//! The legend of the chart of a flight: what the coins, the lines and the discs mean. It stands in a panel of its own, where
//! no flight passes.

use std::f64::consts::PI;

use chart::{Drawn, GREY, Panel, TEXT};
use plotters::prelude::*;
use toss::Attitude;

use crate::chart::coin::draw_coin;
use crate::chart::layout::{FACE, NORMAL};
use crate::chart::solid::Solid;

/// Height of a line of text (pixels).
const LINE: i32 = 42;

/// Draws it, with a remark on a flight that is too fast to be drawn turn by turn.
pub(super) fn draw_legend(panel: &Panel<'_>, is_too_fast: bool, solid: Solid) -> Drawn {
    let coins = match (solid, is_too_fast) {
        (Solid::Disc, true) => "coins enlarged; too many turns to draw each",
        (Solid::Disc, false) => "coins enlarged",
        (Solid::Cuboid(_), true) => "a cuboid of its moments; too many turns to draw",
        (Solid::Cuboid(_), false) => "drawn as the cuboid with its moments",
    };
    let rows = [
        ("n, the normal of the heads side", NORMAL),
        ("a vector fixed in the face", FACE),
        ("○ launch, ● landing; dashed: on the far side", BLACK),
        (coins, GREY),
    ];
    for (row, (words, colour)) in (0..).zip(rows) {
        panel.draw(&Text::new(words, (24, LINE * row), TEXT.into_font().color(&colour)))?;
    }
    for (x, words, tilt) in [(66, "heads side", 0.0), (396, "tails side", PI)] {
        let y = 4 * LINE + 44;
        draw_coin(panel, (x, y), &Attitude::about_x(tilt), solid)?;
        panel.draw(&Text::new(words, (x + 60, y - 16), TEXT))?;
    }
    Ok(())
}
