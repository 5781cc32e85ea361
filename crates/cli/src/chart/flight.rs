//! The chart of a flight: the coin going up and down, cos θ below it, and the traces on the sphere beside it.

use chart::{ChartError, Drawn, Panel, TEXT, svg};
use plotters::prelude::*;
use toss::{Outcome, Toss, TracePoint};

use crate::chart::coin::draw_coins;
use crate::chart::layout::{NORMAL, NUMBERS, times};
use crate::chart::sphere::draw_sphere;

/// Twice the size at which it is read.
const SIZE: (u32, u32) = (1800, 940);
/// Width of the panels over time (pixels).
const LEFT: u32 = 1020;
/// Height of the panel of the coins (pixels).
const UPPER: u32 = 580;

/// The chart of `flight`, the trace of `toss`, as SVG.
pub(crate) fn flight(flight: &[TracePoint], toss: &Toss, outcome: Outcome) -> Result<String, ChartError> {
    svg(SIZE, |root| {
        let (over_time, sphere) = root.split_horizontally(LEFT);
        let (coins, tilt) = over_time.split_vertically(UPPER);
        draw_coins(&coins, flight, toss, outcome)?;
        draw_tilt(&tilt, flight)?;
        draw_sphere(&sphere, flight)
    })
}

fn draw_tilt(panel: &Panel<'_>, flight: &[TracePoint]) -> Drawn {
    let times = times(flight);
    let mut chart = ChartBuilder::on(panel)
        .margin(24)
        .x_label_area_size(84)
        .y_label_area_size(NUMBERS)
        .build_cartesian_2d(times.clone(), -1.1..1.1)?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .y_labels(5)
        .x_desc("time [s]")
        .y_desc("cos θ")
        // Adding zero turns the label -0.0 into 0.0.
        .y_label_formatter(&|cos_tilt: &f64| format!("{:.1}", (10.0 * cos_tilt).round() / 10.0 + 0.0))
        .label_style(TEXT)
        .axis_desc_style(TEXT)
        .draw()?;
    chart.draw_series(LineSeries::new([(times.start, 0.0), (times.end, 0.0)], BLACK.stroke_width(2)))?;
    let line = flight.iter().map(|point| (point.time, point.cos_tilt));
    chart.draw_series(LineSeries::new(line, NORMAL.stroke_width(4)))?;
    let (left, level) = chart.plotting_area().map_coordinate(&(times.start, 0.0));
    let (left, level) = (left + 10 - panel.get_base_pixel().0, level - panel.get_base_pixel().1);
    panel.draw(&Text::new("heads", (left, level - 36), TEXT))?;
    panel.draw(&Text::new("tails", (left, level + 10), TEXT))?;
    Ok(())
}
