//! P(heads) over two coordinates, as a heat map with the line of certainty.

use chart::{ChartError, Drawn, Panel, TEXT, VERMILION, svg};
use plotters::prelude::*;
use sampling::Map;

/// Twice the size at which it is read.
const SIZE: (u32, u32) = (1500, 1200);

/// Colours of P = 0, ½ and 1: dark blue, grey, pale yellow, after the palette cividis (J. R. Nuñez, C. R. Anderton and
/// R. S. Renslow, PLoS ONE 13 (2018), e0199239), whose lightness grows evenly for every kind of colour vision.
const COLOURS: [(f64, f64, f64); 3] = [(0.0, 34.0, 78.0), (124.0, 123.0, 120.0), (254.0, 232.0, 56.0)];

/// Steps of the colour scale; neighbours in a row with the same step are one rectangle.
const STEPS: f64 = 100.0;

fn colour(probability: f64) -> RGBColor {
    let stepped = (probability * STEPS).round() / STEPS;
    let (from, to, part) = if stepped < 0.5 { (0, 1, 2.0 * stepped) } else { (1, 2, 2.0 * stepped - 1.0) };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 255")]
    let mix = |a: f64, b: f64| (a + part * (b - a)).round() as u8;
    let (a, b) = (COLOURS[from], COLOURS[to]);
    RGBColor(mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
}

/// The map as SVG.
pub(crate) fn map(map: &Map) -> Result<String, ChartError> {
    svg(SIZE, |root| {
        let (left, right) = root.split_horizontally(SIZE.0 - 200);
        draw_map(&left, map)?;
        draw_scale(&right)
    })
}

/// Edges of the cells about the nodes.
fn edges(nodes: &[f64]) -> Vec<f64> {
    let middles = nodes.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let last = nodes.len() - 1;
    std::iter::once(nodes[0]).chain(middles).chain(std::iter::once(nodes[last])).collect()
}

fn draw_map(panel: &Panel<'_>, map: &Map) -> Drawn {
    let ((across, columns), (up, rows)) = (&map.across, &map.up);
    let (x, y) = (edges(columns), edges(rows));
    let has_line = map.nodes.iter().any(|node| node.least_cos_tilt.is_some_and(|least| least >= 0.0));
    let caption = if has_line { "P(heads), and the line where heads becomes certain" } else { "P(heads)" };
    let mut chart = ChartBuilder::on(panel)
        .margin(24)
        .caption(caption, TEXT)
        .x_label_area_size(84)
        .y_label_area_size(120)
        .build_cartesian_2d(x[0]..x[columns.len()], y[0]..y[rows.len()])?;
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc(across.symbol())
        .y_desc(up.symbol())
        .label_style(TEXT)
        .axis_desc_style(TEXT)
        .draw()?;
    for (row, nodes) in map.nodes.chunks(columns.len()).enumerate() {
        let mut start = 0;
        for run in nodes.chunk_by(|a, b| colour(a.probability) == colour(b.probability)) {
            // A cell too far, for the next ones to draw over: no seams.
            let end = (x[(start + run.len() + 1).min(columns.len())], y[(row + 2).min(rows.len())]);
            let corners = [(x[start], y[row]), end];
            chart.draw_series([Rectangle::new(corners, colour(run[0].probability).filled())])?;
            start += run.len();
        }
    }
    for segment in certainty_line(map) {
        // White below, so that the line is seen on every colour.
        chart.draw_series(LineSeries::new(segment, WHITE.stroke_width(9)))?;
    }
    for segment in certainty_line(map) {
        chart.draw_series(LineSeries::new(segment, VERMILION.stroke_width(5)))?;
    }
    Ok(())
}

/// The contour where the least cos θ is 0, which is ψ = 45° for horizontal launches: a segment for each cell that it crosses.
fn certainty_line(map: &Map) -> Vec<[(f64, f64); 2]> {
    let ((_, columns), (_, rows)) = (&map.across, &map.up);
    let node = |column: usize, row: usize| {
        let least = map.nodes[row * columns.len() + column].least_cos_tilt;
        least.map(|least| ((columns[column], rows[row]), least))
    };
    let mut segments = Vec::new();
    for row in 0..rows.len() - 1 {
        for column in 0..columns.len() - 1 {
            let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(right, up)| node(column + right, row + up));
            let mut crossings = Vec::new();
            for side in 0..4 {
                let (Some((a, at_a)), Some((b, at_b))) = (corners[side], corners[(side + 1) % 4]) else { continue };
                if (at_a >= 0.0) != (at_b >= 0.0) {
                    let part = at_a / (at_a - at_b);
                    crossings.push((a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1)));
                }
            }
            segments.extend(crossings.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
        }
    }
    segments
}

fn draw_scale(panel: &Panel<'_>) -> Drawn {
    let mut chart = ChartBuilder::on(panel)
        .margin(24)
        .margin_top(60)
        .margin_bottom(108)
        .right_y_label_area_size(90)
        .build_cartesian_2d(0.0..1.0, 0.0..1.0)?
        .set_secondary_coord(0.0..1.0, 0.0..1.0);
    chart.configure_secondary_axes().label_style(TEXT).y_label_formatter(&|p: &f64| format!("{p:.1}")).draw()?;
    chart.draw_series((0..100).map(|step| {
        let from = f64::from(step) / STEPS;
        Rectangle::new([(0.0, from), (1.0, 1.0)], colour(from + 0.5 / STEPS).filled())
    }))?;
    Ok(())
}
