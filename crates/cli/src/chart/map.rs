//! Draws P(heads) over two coordinates as a heat map, with the line where heads becomes certain.

use chart::{Axis, ChartError, Drawn, Panel, TEXT, VERMILION, centred, frame, svg};
use plotters::prelude::*;
use sampling::{CertainLine, Map, Node, Piece, Space, certain_line};

/// Twice the size at which it is read.
const SIZE: (u32, u32) = (1500, 1300);

/// Height of the title (pixels).
const HEAD: u32 = 110;

/// Colours of P = 0, ½ and 1: dark blue, grey, pale yellow, after the palette cividis (J. R. Nuñez, C. R. Anderton and
/// R. S. Renslow, PLoS ONE 13 (2018), e0199239), whose lightness grows evenly for every kind of colour vision.
const COLOURS: [(f64, f64, f64); 3] = [(0.0, 34.0, 78.0), (124.0, 123.0, 120.0), (254.0, 232.0, 56.0)];

/// Steps of the colour scale; neighbours in a row with the same step are one rectangle.
const STEPS: f64 = 100.0;

/// The colour of a node; of one where nothing is known, white, which is on no scale.
fn colour_of(node: &Node) -> RGBColor {
    node.probability.map_or(WHITE, colour)
}

fn colour(probability: f64) -> RGBColor {
    let stepped = (probability * STEPS).round() / STEPS;
    let (from, to, part) = if stepped < 0.5 { (0, 1, 2.0 * stepped) } else { (1, 2, 2.0 * stepped - 1.0) };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 255")]
    let mix = |a: f64, b: f64| (a + part * (b - a)).round() as u8;
    let (a, b) = (COLOURS[from], COLOURS[to]);
    RGBColor(mix(a.0, b.0), mix(a.1, b.1), mix(a.2, b.2))
}

/// The map, which is of `space`, as SVG. Its title says `of` what it is.
pub(crate) fn map(map: &Map, space: &Space, of: &str) -> Result<String, ChartError> {
    let line = certain_line(map, space);
    let is_unknown = map.nodes.iter().any(|node| node.probability.is_none());
    let of = &if is_unknown { format!("{of}; white: no launch is decided") } else { of.to_owned() };
    svg(SIZE, |root| {
        let (head, body) = root.split_vertically(HEAD);
        let (left, right) = body.split_horizontally(SIZE.0 - 200);
        draw_head(&head, of, &line)?;
        draw_map(&left, map, line.as_ref().map_or(&[], |line| line.pieces.as_slice()))?;
        draw_scale(&right)
    })
}

/// The edges of the cells around the nodes.
fn edges(nodes: &[f64]) -> Vec<f64> {
    let middles = nodes.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let last = nodes.len() - 1;
    std::iter::once(nodes[0]).chain(middles).chain(std::iter::once(nodes[last])).collect()
}

fn draw_map(panel: &Panel<'_>, map: &Map, line: &[Piece]) -> Drawn {
    let ((across, columns), (up, rows)) = (&map.across, &map.up);
    let (x, y) = (edges(columns), edges(rows));
    let (x_axis, y_axis) =
        (Axis::linear(across.symbol(), x[0]..x[columns.len()]), Axis::linear(up.symbol(), y[0]..y[rows.len()]));
    let mut chart = frame(panel, "", (&x_axis, &y_axis), 20)?;
    for (row, nodes) in map.nodes.chunks(columns.len()).enumerate() {
        let mut start = 0;
        for run in nodes.chunk_by(|a, b| colour_of(a) == colour_of(b)) {
            // It reaches one cell too far, and the next ones are drawn over it: so no seams are seen.
            let end = (x[(start + run.len() + 1).min(columns.len())], y[(row + 2).min(rows.len())]);
            let corners = [(x[start], y[row]), end];
            chart.draw_series([Rectangle::new(corners, colour_of(&run[0]).filled())])?;
            start += run.len();
        }
    }
    // White below, so that the line is seen on every colour.
    for (colour, width) in [(WHITE, 9), (VERMILION, 5)] {
        for piece in line {
            chart.draw_series(LineSeries::new(piece.iter().copied(), colour.stroke_width(width)))?;
        }
    }
    Ok(())
}

/// The title, and below it what the line is or why there is none.
fn draw_head(panel: &Panel<'_>, of: &str, line: &Result<CertainLine, &'static str>) -> Drawn {
    let middle = i32::try_from(SIZE.0 / 2).unwrap_or(0);
    centred(panel, &format!("P(heads), {of}"), (middle, 40))?;
    let words = match line {
        Ok(CertainLine { angles: "", .. }) => "the line where heads becomes certain",
        Ok(CertainLine { angles, .. }) => &format!("the line where heads becomes certain, {angles}"),
        Err(reason) => reason,
    };
    centred(panel, words, (middle, 86))?;
    if line.is_ok() {
        // Left of the words, of which a letter takes some 15 pixels.
        let end = middle - 15 * i32::try_from(words.chars().count()).unwrap_or(0) / 2 - 20;
        panel.draw(&PathElement::new([(end - 80, 88), (end, 88)], VERMILION.stroke_width(5)))?;
    }
    Ok(())
}

fn draw_scale(panel: &Panel<'_>) -> Drawn {
    let mut chart = ChartBuilder::on(panel)
        .margin(24)
        .margin_top(20)
        .margin_bottom(104)
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
