//! Draws p(ψ), the probability of heads in the limit of long flights, as a curve, and the shares of heads among long flights
//! as points, so that one sees them agree.

use chart::{Axis, BLUE, ChartError, Drawn, Frame, Panel, SIZE, TEXT, VERMILION, frame, pixel, svg};
use plotters::prelude::*;
use sampling::{LONG_FLIGHT_TURNS, LongFlightShare, long_flight_probability};

/// The angles ψ that are drawn (degrees).
const RANGE: std::ops::Range<f64> = 28.0..92.0;

/// The chart as SVG. Its title says `of` what body the flights are.
pub(crate) fn limit(shares: &[LongFlightShare], of: &str) -> Result<String, ChartError> {
    let launches = shares.first().map_or(0, |found| found.estimate.points);
    svg(SIZE, |root| {
        let x = Axis::linear("angle ψ between the coin's normal and its angular momentum [degrees]", RANGE);
        let y = Axis::linear("P(heads)", 0.4..1.04);
        let mut chart = frame(root, &format!("P(heads) of long flights from horizontal, {of}"), (&x, &y), 20)?;
        // One of the steps is 45°, where the curve has a corner.
        let curve = (112..=368).map(|step| 0.25 * f64::from(step)).map(|angle| {
            let cone: f64 = angle.to_radians();
            (angle, long_flight_probability(cone, cone))
        });
        chart.draw_series(LineSeries::new(curve, BLUE.stroke_width(4)))?;
        for found in shares {
            draw_share(&mut chart, found)?;
        }
        let (left, line) = pixel(root, &chart, (RANGE.start, 1.0));
        root.draw(&Text::new("heads is certain", (left + 12, line + 18), TEXT))?;
        draw_legend(root, launches)
    })
}

/// Draws a share as a disc, and its interval as a bar.
fn draw_share(chart: &mut Frame<'_, '_>, found: &LongFlightShare) -> Drawn {
    let angle = found.cone_angle.to_degrees();
    if let Some(interval) = found.estimate.interval {
        let ends = [(angle, interval.lo), (angle, interval.hi)];
        chart.draw_series(LineSeries::new(ends, VERMILION.stroke_width(4)))?;
        for (angle, end) in ends {
            let cap = [(angle - 0.3, end), (angle + 0.3, end)];
            chart.draw_series(LineSeries::new(cap, VERMILION.stroke_width(3)))?;
        }
    }
    if found.estimate.is_known() {
        chart.draw_series([Circle::new((angle, found.estimate.probability), 7, VERMILION.filled())])?;
    }
    Ok(())
}

fn draw_legend(root: &Panel<'_>, launches: u64) -> Drawn {
    let (x, y) = (1060, 110);
    root.draw(&PathElement::new([(x, y + 14), (x + 60, y + 14)], BLUE.stroke_width(4)))?;
    root.draw(&Text::new("the limit, p(ψ) = ½ + asin(cot² ψ)/π", (x + 80, y), TEXT.into_font().color(&BLUE)))?;
    root.draw(&PathElement::new([(x + 30, y + 50), (x + 30, y + 90)], VERMILION.stroke_width(4)))?;
    root.draw(&Circle::new((x + 30, y + 70), 7, VERMILION.filled()))?;
    let [fewest, most] = LONG_FLIGHT_TURNS;
    let words =
        [format!("share of {launches} flights of {fewest:.0} to"), format!("{most:.0} turns, with its 95 % interval")];
    for (row, words) in (0..).zip(words) {
        root.draw(&Text::new(words, (x + 80, y + 44 + 38 * row), TEXT.into_font().color(&VERMILION)))?;
    }
    Ok(())
}
