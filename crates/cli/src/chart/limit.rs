//! p(ψ), the long-flight limit, as a curve, with the shares of heads among long flights on it.

use chart::{BLUE, ChartError, Drawn, Panel, SIZE, TEXT, VERMILION, svg};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use sampling::{LONG_FLIGHT_TURNS, LongFlightShare, long_flight_probability};

/// A chart that has been laid out.
type Chart<'a, 'b> =
    ChartContext<'a, SVGBackend<'b>, plotters::coord::cartesian::Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// Of ψ (degrees).
const RANGE: std::ops::Range<f64> = 28.0..92.0;

/// The chart as SVG.
pub(crate) fn limit(shares: &[LongFlightShare]) -> Result<String, ChartError> {
    let launches = shares.first().map_or(0, |found| found.estimate.points);
    svg(SIZE, |root| {
        let mut chart = ChartBuilder::on(root)
            .margin(24)
            .caption("P(heads) of long flights from horizontal", TEXT)
            .x_label_area_size(84)
            .y_label_area_size(120)
            .build_cartesian_2d(RANGE, 0.4..1.04)?;
        chart
            .configure_mesh()
            .light_line_style(WHITE)
            .x_labels(8)
            .x_desc("angle ψ between the coin's normal and its angular momentum [degrees]")
            .y_desc("P(heads)")
            .x_label_formatter(&|angle: &f64| format!("{angle:.0}"))
            .y_label_formatter(&|p: &f64| format!("{p:.1}"))
            .label_style(TEXT)
            .axis_desc_style(TEXT)
            .draw()?;
        // The steps meet the corner at 45°.
        let curve = (112..=368).map(|step| 0.25 * f64::from(step)).map(|angle| {
            let cone: f64 = angle.to_radians();
            (angle, long_flight_probability(cone, cone))
        });
        chart.draw_series(LineSeries::new(curve, BLUE.stroke_width(4)))?;
        for found in shares {
            draw_share(&mut chart, found)?;
        }
        draw_legend(root, launches)
    })
}

/// A disc with its interval.
fn draw_share(chart: &mut Chart<'_, '_>, found: &LongFlightShare) -> Drawn {
    let angle = found.cone_angle.to_degrees();
    if let Some(interval) = found.estimate.interval {
        let ends = [(angle, interval.lo), (angle, interval.hi)];
        chart.draw_series(LineSeries::new(ends, VERMILION.stroke_width(4)))?;
        for (angle, end) in ends {
            let cap = [(angle - 0.3, end), (angle + 0.3, end)];
            chart.draw_series(LineSeries::new(cap, VERMILION.stroke_width(3)))?;
        }
    }
    chart.draw_series([Circle::new((angle, found.estimate.probability), 7, VERMILION.filled())])?;
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
    root.draw(&Text::new("heads is certain", (160, 120), TEXT))?;
    Ok(())
}
