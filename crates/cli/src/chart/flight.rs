//! The chart of a flight: what n and a vector in the face trace on the sphere, and cos θ against time.

use chart::{BLUE, ChartError, Drawn, FAINT, Panel, SIZE, TEXT, VERMILION, svg};
use plotters::prelude::*;
use toss::{TracePoint, Vector3};

const NORMAL: RGBColor = BLUE;
const FACE: RGBColor = VERMILION;

/// The chart as SVG.
pub(crate) fn flight(flight: &[TracePoint]) -> Result<String, ChartError> {
    svg(SIZE, |root| {
        let (sphere, time) = root.split_horizontally(SIZE.1);
        draw_sphere(&sphere, flight)?;
        draw_tilt(&time, flight)
    })
}

/// Where the eye is: azimuth and elevation (rad).
const EYE: (f64, f64) = (-0.6, 0.45);

/// Orthographic projection: (right, up, towards the eye).
fn project(v: &Vector3<f64>) -> (f64, f64, f64) {
    let ((sin_a, cos_a), (sin_e, cos_e)) = (EYE.0.sin_cos(), EYE.1.sin_cos());
    let (right, away) = (v.x * cos_a + v.y * sin_a, -v.x * sin_a + v.y * cos_a);
    (right, v.z * cos_e + away * sin_e, v.z * sin_e - away * cos_e)
}

fn draw_sphere(panel: &Panel<'_>, flight: &[TracePoint]) -> Drawn {
    let mut chart = ChartBuilder::on(panel)
        .margin(24)
        .caption("on the sphere, seen from the lab", TEXT)
        .build_cartesian_2d(-1.15..1.15, -1.15..1.15)?;
    let ring =
        |point: fn(f64) -> Vector3<f64>| (0..=180).map(move |i| point(f64::from(i) * std::f64::consts::TAU / 180.0));
    let outline = (0..=180).map(|i| (f64::from(i) * std::f64::consts::TAU / 180.0).sin_cos());
    chart.draw_series(LineSeries::new(outline, FAINT.stroke_width(2)))?;
    let equator = ring(|angle| Vector3::new(angle.cos(), angle.sin(), 0.0));
    chart.draw_series(LineSeries::new(
        equator.map(|v| (project(&v).0, project(&v).1)),
        FAINT.mix(0.6).stroke_width(2),
    ))?;
    for (colour, of) in [(FACE, (|p| p.face) as fn(&TracePoint) -> Vector3<f64>), (NORMAL, |p| p.normal)] {
        let seen: Vec<_> = flight.iter().map(|point| project(&of(point))).collect();
        // The far side of the sphere is drawn faintly.
        for pair in seen.windows(2) {
            let near = pair[0].2 + pair[1].2 >= 0.0;
            let style = if near { colour.mix(1.0).stroke_width(4) } else { colour.mix(0.35).stroke_width(2) };
            chart.draw_series(LineSeries::new(pair.iter().map(|p| (p.0, p.1)), style))?;
        }
        if let (Some(first), Some(last)) = (seen.first(), seen.last()) {
            chart.draw_series([Circle::new((first.0, first.1), 10, colour.stroke_width(4))])?;
            chart.draw_series([Circle::new((last.0, last.1), 10, colour.filled())])?;
        }
    }
    chart.draw_series([
        Text::new("n, the normal", (-1.12, -0.98), TEXT.into_font().color(&NORMAL)),
        Text::new("a vector in the face", (-1.12, -1.09), TEXT.into_font().color(&FACE)),
        Text::new("○ launch   ● landing", (0.42, -1.09), TEXT.into_font().color(&BLACK)),
    ])?;
    Ok(())
}

fn draw_tilt(panel: &Panel<'_>, flight: &[TracePoint]) -> Drawn {
    let end = flight.last().map_or(0.0, |point| point.time);
    let mut chart = ChartBuilder::on(panel)
        .margin(24)
        .margin_right(48)
        .caption("cos θ during the flight", TEXT)
        .x_label_area_size(84)
        .y_label_area_size(112)
        .build_cartesian_2d(0.0..end.max(f64::MIN_POSITIVE), -1.05..1.05)?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .x_desc("time [s]")
        .y_desc("cos θ")
        // Adding zero turns the label -0.0 into 0.0.
        .y_label_formatter(&|cos_tilt: &f64| format!("{:.1}", (10.0 * cos_tilt).round() / 10.0 + 0.0))
        .label_style(TEXT)
        .axis_desc_style(TEXT)
        .draw()?;
    chart.draw_series(LineSeries::new([(0.0, 0.0), (end, 0.0)], BLACK.stroke_width(2)))?;
    let line = flight.iter().map(|point| (point.time, point.cos_tilt));
    chart.draw_series(LineSeries::new(line, NORMAL.stroke_width(4)))?;
    chart.draw_series([
        Text::new("heads", (0.01 * end, 0.12), TEXT.into_font().color(&BLACK)),
        Text::new("tails", (0.01 * end, -0.04), TEXT.into_font().color(&BLACK)),
    ])?;
    Ok(())
}
