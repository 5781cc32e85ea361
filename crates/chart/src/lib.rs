//! What the charts of the workspace share: the canvas, the palette, frames with axes, lines and their labels. The command
//! line and the verification draw with it, so that their charts look alike.

mod frame;
mod labels;
mod lines;
mod ticks;

pub use frame::{Axis, Frame, centred, frame, pixel};
pub use labels::{EndLabel, end_labels};
pub use lines::{Marker, Series, lines};

use plotters::coord::Shift;
use plotters::prelude::*;
use thiserror::Error;

// From the palette of Okabe and Ito, whose colours every kind of colour vision tells apart.
/// Blue.
pub const BLUE: RGBColor = RGBColor(0, 114, 178);
/// Orange-red.
pub const VERMILION: RGBColor = RGBColor(213, 94, 0);
/// Orange.
pub const ORANGE: RGBColor = RGBColor(230, 159, 0);
/// Blue-green.
pub const GREEN: RGBColor = RGBColor(0, 158, 115);
/// Reddish purple.
pub const PURPLE: RGBColor = RGBColor(204, 121, 167);
/// For what is in the background.
pub const FAINT: RGBColor = RGBColor(150, 150, 150);
/// For remarks.
pub const GREY: RGBColor = RGBColor(100, 100, 100);

/// Width and height of a chart of one row, twice the size at which it is read.
pub const SIZE: (u32, u32) = (1800, 880);

/// Font of all text.
pub const TEXT: (&str, u32) = ("sans-serif", 30);

/// A part of the canvas.
pub type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// What a drawing function returns.
pub type Drawn = Result<(), Box<dyn std::error::Error>>;

/// A chart that could not be drawn.
#[derive(Debug, Error)]
#[error("{0}")]
pub struct ChartError(pub String);

/// The SVG of what `draw` draws on white, `size` pixels wide and high, to be read at half that size: the backend draws on
/// whole pixels, and lines turn out smoother for it.
///
/// # Errors
/// [`ChartError`] if the drawing fails.
pub fn svg(size: (u32, u32), draw: impl FnOnce(&Panel<'_>) -> Drawn) -> Result<String, ChartError> {
    let mut text = String::new();
    let drawn = || -> Drawn {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE)?;
        draw(&root)?;
        root.present()?;
        Ok(())
    };
    drawn().map_err(|error| ChartError(error.to_string()))?;
    let extent = |(width, height): (u32, u32)| format!("<svg width=\"{width}\" height=\"{height}\"");
    Ok(text.replacen(&extent(size), &extent((size.0 / 2, size.1 / 2)), 1))
}
