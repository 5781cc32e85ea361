//! Draws the paths of n and of a vector in the face on the unit sphere. What is on the far side is dashed.

use std::f64::consts::TAU;

use chart::{Drawn, FAINT, Panel, centred};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use toss::{TracePoint, Vector3};

use crate::chart::layout::{FACE, NORMAL};
use crate::chart::projection::{Seen, project};

/// Room for the title, and on the other sides (pixels).
const TITLE: u32 = 76;
const MARGIN: u32 = 16;

/// A chart without axes.
type Chart<'a, 'b> =
    ChartContext<'a, SVGBackend<'b>, plotters::coord::cartesian::Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Draws the paths of `flight`.
pub(super) fn draw_sphere(panel: &Panel<'_>, flight: &[TracePoint]) -> Drawn {
    let (width, height) = panel.dim_in_pixel();
    let (middle, title) = (i32::try_from(width / 2).unwrap_or(0), "The paths on the unit sphere, seen from above");
    centred(panel, title, (middle, 40))?;
    let reach = 1.05 * f64::from(width - 2 * MARGIN) / f64::from(height - TITLE - MARGIN);
    let mut chart =
        ChartBuilder::on(panel).margin(MARGIN).margin_top(TITLE).build_cartesian_2d(-reach..reach, -1.05..1.05)?;
    let angles = || (0..=120).map(|step| f64::from(step) * TAU / 120.0);
    chart.draw_series(LineSeries::new(angles().map(f64::sin_cos), FAINT.stroke_width(2)))?;
    let equator: Vec<Seen> = angles().map(|angle| project(&Vector3::new(angle.cos(), angle.sin(), 0.0))).collect();
    draw_path(&mut chart, &equator, FAINT, 2)?;
    for (colour, of) in
        [(FACE, (|point| point.face) as fn(&TracePoint) -> Vector3<f64>), (NORMAL, |point| point.normal)]
    {
        let seen: Vec<Seen> = flight.iter().map(|point| project(&of(point))).collect();
        draw_path(&mut chart, &seen, colour, 4)?;
        if let (Some(first), Some(last)) = (seen.first(), seen.last()) {
            let launch = Circle::new((first.right, first.up), 11, WHITE.filled());
            let ring = Circle::new((first.right, first.up), 11, colour.stroke_width(4));
            let landing = Circle::new((last.right, last.up), 11, colour.filled());
            chart.draw_series([launch, ring, landing])?;
        }
    }
    Ok(())
}

/// Draws a path on the sphere, dashed where it is on the far side.
fn draw_path(chart: &mut Chart<'_, '_>, path: &[Seen], colour: RGBColor, width: u32) -> Drawn {
    let pairs: Vec<&[Seen]> = path.windows(2).collect();
    let is_near = |pair: &[Seen]| pair[0].near + pair[1].near >= 0.0;
    for run in pairs.chunk_by(|a, b| is_near(a) == is_near(b)) {
        let points: Vec<(f64, f64)> =
            std::iter::once(&run[0][0]).chain(run.iter().map(|pair| &pair[1])).map(|at| (at.right, at.up)).collect();
        if is_near(run[0]) {
            chart.draw_series(LineSeries::new(points, colour.stroke_width(width)))?;
        } else {
            chart.draw_series(DashedLineSeries::new(points, 9, 9, colour.stroke_width(width - 1)))?;
        }
    }
    Ok(())
}
