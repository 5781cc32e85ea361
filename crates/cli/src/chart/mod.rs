//! Charts as SVG, a file each; here is what they share.

mod convergence;
mod errors;
mod flight;
mod map;

pub(crate) use convergence::{Step, convergence};
pub(crate) use errors::{ErrorLine, Reference, errors};
pub(crate) use flight::flight;
pub(crate) use map::map;

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::failure::Failure;

/// From the palette of Okabe and Ito, whose colours every kind of colour vision tells apart.
const BLUE: RGBColor = RGBColor(0, 114, 178);
const VERMILION: RGBColor = RGBColor(213, 94, 0);
const GREEN: RGBColor = RGBColor(0, 158, 115);
const PURPLE: RGBColor = RGBColor(204, 121, 167);
const FAINT: RGBColor = RGBColor(150, 150, 150);
const GREY: RGBColor = RGBColor(100, 100, 100);
/// Twice the size at which it is read: the backend draws on whole pixels, and lines turn out smoother for it.
const SIZE: (u32, u32) = (2000, 880);
const TEXT: (&str, u32) = ("sans-serif", 30);

type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// The SVG of what `draw` draws on white.
fn svg(size: (u32, u32), draw: impl FnOnce(&Panel<'_>) -> Drawn) -> Result<String, Failure> {
    let mut text = String::new();
    let drawn = || -> Drawn {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE)?;
        draw(&root)?;
        root.present()?;
        Ok(())
    };
    drawn().map_err(|error| Failure::Chart(error.to_string()))?;
    Ok(text)
}
