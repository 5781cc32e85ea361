//! Draws labels beside the ends of lines. They are pushed apart so that none covers another.

use plotters::prelude::*;

use crate::{Drawn, Panel, TEXT};

/// Height of a line of text (pixels).
const LINE: i32 = 36;

/// A label at the height of what it names.
#[derive(Debug, Clone, PartialEq)]
pub struct EndLabel {
    /// Where the line ends (pixels from the top).
    pub y: i32,
    /// Its name.
    pub text: String,
    /// Its colour.
    pub colour: RGBColor,
}

/// Draws `labels` in a column at `x` (pixels), from the top down and none over another.
pub fn end_labels(panel: &Panel<'_>, x: i32, mut labels: Vec<EndLabel>) -> Drawn {
    labels.sort_by_key(|label| label.y);
    let mut lowest = i32::MIN;
    for EndLabel { y, text, colour } in labels {
        lowest = (y - LINE / 2 + 3).max(lowest.saturating_add(LINE));
        panel.draw(&Text::new(text, (x, lowest), TEXT.into_font().color(&colour)))?;
    }
    Ok(())
}
