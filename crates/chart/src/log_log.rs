//! Lines over two logarithmic axes, with runs that failed at the upper edge.

use std::ops::Range;

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use crate::{Drawn, EndLabel, GREY, Panel, TEXT};

/// Width of a line (pixels), unless it has a reason to differ.
pub const LINE_WIDTH: u32 = 4;

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
    /// Its points' form.
    pub marker: Marker,
    /// Its points; values outside the axes are drawn at their edge.
    pub points: Vec<(f64, f64)>,
    /// Where it has no point because the run failed: drawn as crosses at the upper edge.
    pub failures: Vec<f64>,
}

/// A logarithmic axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Quantity and unit.
    pub label: String,
    /// From its first to its last value, both positive; it may fall.
    pub range: Range<f64>,
    /// The first value stands for 0, and is so labelled.
    pub starts_at_zero: bool,
}

impl Axis {
    /// An axis that shows nothing but positive values.
    pub fn positive(label: &str, range: Range<f64>) -> Self {
        Self { label: label.to_owned(), range, starts_at_zero: false }
    }

    /// Decades, counted so that they rise along the axis.
    fn position(&self, value: f64) -> f64 {
        let Range { start, end } = self.range;
        self.sense() * value.clamp(start.min(end), start.max(end)).log10()
    }

    fn sense(&self) -> f64 {
        if self.range.start < self.range.end { 1.0 } else { -1.0 }
    }

    fn span(&self) -> Range<f64> {
        self.position(self.range.start)..self.position(self.range.end)
    }

    fn tick(&self, position: f64) -> String {
        let decade = self.sense() * position;
        // Adding zero turns -0 into 0.
        if (decade - decade.round()).abs() < 1e-9 { format!("1e{:.0}", decade.round() + 0.0) } else { String::new() }
    }
}

/// A chart that has been laid out.
type Chart<'a, 'b> =
    ChartContext<'a, SVGBackend<'b>, plotters::coord::cartesian::Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Draws `series` over the axes `x` and `y` on `panel`, with `right` pixels left free beside them, and returns labels for
/// those that have an end.
///
/// # Errors
/// As the backend's.
pub fn log_log(
    panel: &Panel<'_>,
    title: &str,
    (x, y): (&Axis, &Axis),
    series: &[Series],
    right: u32,
) -> Result<Vec<EndLabel>, Box<dyn std::error::Error>> {
    let mut chart = ChartBuilder::on(panel)
        .margin(16)
        .margin_right(right)
        .caption(title, TEXT)
        .x_label_area_size(84)
        .y_label_area_size(132)
        .build_cartesian_2d(x.span(), y.span())?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .x_labels(7)
        .y_labels(9)
        .x_desc(&x.label)
        .y_desc(&y.label)
        .x_label_formatter(&|position: &f64| x.tick(*position))
        .y_label_formatter(&|position: &f64| y.tick(*position))
        .label_style(TEXT)
        .axis_desc_style(TEXT)
        .draw()?;
    let mut labels = Vec::new();
    for line in series {
        labels.extend(draw_line(panel, &mut chart, (x, y), line)?);
    }
    if x.starts_at_zero {
        let (column, bottom) = local(panel, chart.backend_coord(&(x.span().start, y.span().start)));
        panel.draw(&Text::new("0", (column - 8, bottom + 14), TEXT))?;
    }
    Ok(labels)
}

fn draw_line<'b>(
    panel: &Panel<'b>,
    chart: &mut Chart<'_, 'b>,
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
    let pixels: Vec<(i32, i32)> = points.iter().map(|point| local(panel, chart.backend_coord(point))).collect();
    for at in &pixels {
        draw_marker(panel, line.marker, *at, line.colour)?;
    }
    for failed in &line.failures {
        let (column, top) = local(panel, chart.backend_coord(&(x.position(*failed), y.span().end)));
        panel.draw(&Cross::new((column, top + 14), 9, line.colour.stroke_width(4)))?;
    }
    Ok(pixels.last().map(|end| EndLabel { y: end.1, text: line.label.clone(), colour: line.colour }))
}

/// Backend coordinates in those of `panel`.
fn local(panel: &Panel<'_>, (x, y): (i32, i32)) -> (i32, i32) {
    let (left, top) = panel.get_base_pixel();
    (x - left, y - top)
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

/// The names of `series` in rows of `columns`, each `width` pixels wide, with a remark on failures.
///
/// # Errors
/// As the backend's.
pub fn legend(panel: &Panel<'_>, series: &[Series], columns: i32, width: i32) -> Drawn {
    let place = |index: i32| (40 + width * (index % columns), 30 + 44 * (index / columns));
    let mut last = 0;
    for (index, line) in (0..).zip(series) {
        let (x, y) = place(index);
        let dashes = if line.dashed { vec![(0, 24), (36, 60)] } else { vec![(0, 60)] };
        for (from, to) in dashes {
            panel.draw(&PathElement::new([(x + from, y), (x + to, y)], line.colour.stroke_width(4)))?;
        }
        draw_marker(panel, line.marker, (x + 30, y), line.colour)?;
        panel.draw(&Text::new(line.label.clone(), (x + 76, y - 14), TEXT.into_font().color(&line.colour)))?;
        last = index + 1;
    }
    let (x, y) = place(last);
    panel.draw(&Cross::new((x + 30, y), 9, GREY.stroke_width(4)))?;
    panel.draw(&Text::new("a typed error, no answer", (x + 76, y - 14), TEXT.into_font().color(&GREY)))?;
    Ok(())
}
