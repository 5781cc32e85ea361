//! Draws lines over two axes, as errors and work need them. Runs that failed are crosses at the upper edge.

use plotters::prelude::*;

use crate::frame::{Axis, Frame, frame, pixel};
use crate::{Drawn, EndLabel, Panel};

/// How the points of a series are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// A filled disc.
    Disc,
    /// A ring.
    Ring,
    /// A triangle.
    Triangle,
    /// A square.
    Square,
    /// Nothing.
    None,
}

/// One line.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name in the legend.
    pub label: String,
    /// Its colour.
    pub colour: RGBColor,
    /// Width of the line (pixels).
    pub width: u32,
    /// Whether it is dashed.
    pub dashed: bool,
    /// The form of its points.
    pub marker: Marker,
    /// Its points. A value outside the range of an axis is drawn at its end.
    pub points: Vec<(f64, f64)>,
    /// Where the run failed, so that there is no point. A cross is drawn there at the upper edge.
    pub failures: Vec<f64>,
}

impl Series {
    /// A line of the usual width, without failures.
    pub fn new(label: &str, colour: RGBColor, marker: Marker, points: Vec<(f64, f64)>) -> Self {
        Self { label: label.to_owned(), colour, width: 4, dashed: false, marker, points, failures: Vec::new() }
    }
}

/// Draws `series` over the axes `x` and `y` on `panel`, and leaves `right` pixels free beside them. Returns a label for each
/// line that has a name and a point, at the height of its last.
pub fn lines(
    panel: &Panel<'_>,
    title: &str,
    (x, y): (&Axis, &Axis),
    series: &[Series],
    right: u32,
) -> Result<Vec<EndLabel>, Box<dyn std::error::Error>> {
    let mut chart = frame(panel, title, (x, y), right)?;
    let mut labels = Vec::new();
    for line in series {
        labels.extend(draw_line(panel, &mut chart, (x, y), line)?);
    }
    Ok(labels)
}

fn draw_line<'b>(
    panel: &Panel<'b>,
    chart: &mut Frame<'_, 'b>,
    (x, y): (&Axis, &Axis),
    line: &Series,
) -> Result<Option<EndLabel>, Box<dyn std::error::Error>> {
    let points: Vec<(f64, f64)> = line.points.iter().map(|point| (x.position(point.0), y.position(point.1))).collect();
    let stroke = line.colour.stroke_width(line.width);
    if line.dashed {
        chart.draw_series(DashedLineSeries::new(points.clone(), 14, 10, stroke))?;
    } else {
        chart.draw_series(LineSeries::new(points.clone(), stroke))?;
    }
    let pixels: Vec<(i32, i32)> = points.iter().map(|point| pixel(panel, chart, *point)).collect();
    for at in &pixels {
        draw_marker(panel, line.marker, *at, line.colour)?;
    }
    for failed in &line.failures {
        let (column, top) = pixel(panel, chart, (x.position(*failed), y.span().end));
        panel.draw(&Cross::new((column, top + 14), 9, line.colour.stroke_width(4)))?;
    }
    // A line without a name takes no room beside the others.
    let end = pixels.last().filter(|_| !line.label.is_empty());
    Ok(end.map(|end| EndLabel { y: end.1, text: line.label.clone(), colour: line.colour }))
}

fn draw_marker(panel: &Panel<'_>, marker: Marker, at: (i32, i32), colour: RGBColor) -> Drawn {
    match marker {
        Marker::Disc => panel.draw(&Circle::new(at, 6, colour.filled()))?,
        Marker::Ring => panel.draw(&Circle::new(at, 8, colour.stroke_width(3)))?,
        Marker::Square => panel.draw(&Rectangle::new([(at.0 - 6, at.1 - 6), (at.0 + 6, at.1 + 6)], colour.filled()))?,
        Marker::Triangle => panel.draw(&TriangleMarker::new(at, 9, colour.filled()))?,
        Marker::None => {}
    }
    Ok(())
}
