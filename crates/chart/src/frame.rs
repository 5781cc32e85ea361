//! The frame of a chart: its title centred above it, its axes with their marks. Every chart over two axes is drawn in one,
//! so that all look alike.

use std::ops::Range;

use plotters::coord::cartesian::Cartesian2d;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::ticks::{self, Tick};
use crate::{Drawn, Panel, TEXT};

/// Space around a frame (pixels).
const MARGIN: i32 = 20;
/// Height of a title (pixels).
const TITLE: i32 = 56;
/// Room for the numbers and the label below a frame (pixels), and for numbers alone.
const BELOW: i32 = 84;
const NUMBERS_BELOW: i32 = 44;
/// Room for the numbers and the label left of a frame (pixels).
const BESIDE: i32 = 132;
/// Least distance of two marks (pixels), by what their labels need.
const APART_UPWARDS: i32 = 60;
const APART_LINEAR: i32 = 150;
const APART_LOGARITHMIC: i32 = 112;
const APART_NAMES: i32 = 220;

/// Which part of its range a logarithmic axis goes on beyond either end, so that no point lies on the frame.
const PADDING: f64 = 0.03;

/// A frame into which a chart is drawn. Its coordinates are those of [`Axis::position`].
pub type Frame<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Scale, Scale>>;

/// A coordinate of a frame, with its marks.
pub struct Scale {
    positions: RangedCoordf64,
    ticks: Vec<Tick>,
}

impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, at: &f64, limit: (i32, i32)) -> i32 {
        self.positions.map(at, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        // Light points would be lines between the marks.
        if hint.weight().allow_light_points() {
            return Vec::new();
        }
        self.ticks.iter().map(|tick| tick.value).collect()
    }

    fn range(&self) -> Range<f64> {
        self.positions.range()
    }
}

impl ValueFormatter<f64> for Scale {
    /// The label of the mark at a position, which is that of the mark to the last bit.
    fn format_ext(&self, at: &f64) -> String {
        self.ticks.iter().find(|tick| tick.value == *at).map_or_else(String::new, |tick| tick.label.clone())
    }
}

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    label: String,
    range: Range<f64>,
    kind: Kind,
}

#[derive(Debug, Clone, PartialEq)]
enum Kind {
    Linear,
    Logarithmic,
    Named(Vec<String>),
}

impl Axis {
    /// A linear axis for `label`, a quantity and its unit.
    pub fn linear(label: &str, range: Range<f64>) -> Self {
        Self { label: label.to_owned(), range, kind: Kind::Linear }
    }

    /// A logarithmic axis for `label`, a quantity and its unit. Both ends of `range` are positive; it may fall.
    pub fn logarithmic(label: &str, range: Range<f64>) -> Self {
        Self { label: label.to_owned(), range, kind: Kind::Logarithmic }
    }

    /// An axis of things that have names instead of values. They lie at 0, 1, 2 and so on.
    pub fn named(names: Vec<String>) -> Self {
        Self { label: String::new(), range: -0.5..names.len() as f64 - 0.5, kind: Kind::Named(names) }
    }

    /// Where `value` lies in a frame. On a logarithmic axis values outside the range lie at its ends.
    pub fn position(&self, value: f64) -> f64 {
        if self.kind != Kind::Logarithmic {
            return value;
        }
        let Range { start, end } = self.range;
        let sense = if start < end { 1.0 } else { -1.0 };
        sense * value.clamp(start.min(end), start.max(end)).log10()
    }

    /// Its first value.
    pub fn start(&self) -> f64 {
        self.range.start
    }

    /// Its last value.
    pub fn end(&self) -> f64 {
        self.range.end
    }

    /// The positions from one end of the frame to the other.
    pub(crate) fn span(&self) -> Range<f64> {
        let (first, last) = (self.position(self.range.start), self.position(self.range.end));
        let padding = if self.kind == Kind::Logarithmic { PADDING * (last - first) } else { 0.0 };
        first - padding..last + padding
    }

    fn scale(&self, ticks: Vec<Tick>) -> Scale {
        Scale { positions: self.span().into(), ticks }
    }

    /// Its marks, as many as there is room for on so many pixels, with their positions as values.
    fn ticks(&self, pixels: i32, is_upright: bool) -> Vec<Tick> {
        let apart = match self.kind {
            _ if is_upright => APART_UPWARDS,
            Kind::Linear => APART_LINEAR,
            Kind::Logarithmic => APART_LOGARITHMIC,
            Kind::Named(_) => APART_NAMES,
        };
        let most = usize::try_from(pixels / apart).unwrap_or(0).max(2);
        match &self.kind {
            Kind::Linear => ticks::linear(self.range.start, self.range.end, most),
            Kind::Logarithmic => {
                let Range { start, end } = self.range;
                let ticks = ticks::logarithmic(start.min(end), start.max(end), most).into_iter();
                ticks.map(|tick| Tick { value: self.position(tick.value), ..tick }).collect()
            }
            Kind::Named(names) => {
                let tick = |(at, name): (usize, &String)| Tick { value: at as f64, label: name.clone() };
                names.iter().enumerate().step_by(names.len().div_ceil(most).max(1)).map(tick).collect()
            }
        }
    }
}

/// Draws the axes `x` and `y` on `panel` with `title` above them, and leaves `right` pixels free beside them. Neither title
/// nor label take room where they are empty.
pub fn frame<'a, 'b>(
    panel: &'a Panel<'b>,
    title: &str,
    (x, y): (&Axis, &Axis),
    right: u32,
) -> Result<Frame<'a, 'b>, Box<dyn std::error::Error>> {
    let above = if title.is_empty() { MARGIN } else { TITLE + MARGIN };
    let below = if x.label.is_empty() { NUMBERS_BELOW } else { BELOW };
    let (width, height) = size(panel);
    let right = i32::try_from(right).unwrap_or(0);
    let across = x.ticks(width - MARGIN - BESIDE - right, false);
    let upwards = y.ticks(height - above - below - MARGIN, true);
    let mut chart = ChartBuilder::on(panel)
        .margin(MARGIN)
        .margin_top(above)
        .margin_right(right)
        .x_label_area_size(below)
        .y_label_area_size(BESIDE)
        .build_cartesian_2d(x.scale(across), y.scale(upwards))?;
    chart.configure_mesh().x_desc(&x.label).y_desc(&y.label).label_style(TEXT).axis_desc_style(TEXT).draw()?;
    let columns = chart.plotting_area().get_pixel_range().0;
    let middle = (columns.start + columns.end) / 2 - panel.get_base_pixel().0;
    centred(panel, title, (middle, MARGIN + TITLE / 2))?;
    Ok(chart)
}

/// Width and height of `panel` (pixels).
fn size(panel: &Panel<'_>) -> (i32, i32) {
    let (width, height) = panel.dim_in_pixel();
    (i32::try_from(width).unwrap_or(i32::MAX), i32::try_from(height).unwrap_or(i32::MAX))
}

/// Draws `words` with their middle at `at` (pixels of `panel`).
pub fn centred(panel: &Panel<'_>, words: &str, at: (i32, i32)) -> Drawn {
    let style = TEXT.into_font().color(&BLACK).pos(Pos::new(HPos::Center, VPos::Center));
    panel.draw(&Text::new(words.to_owned(), at, style))?;
    Ok(())
}

/// Where a position of `chart`, a frame on `panel`, lies on the panel (pixels).
pub fn pixel(panel: &Panel<'_>, chart: &Frame<'_, '_>, at: (f64, f64)) -> (i32, i32) {
    let ((left, top), (x, y)) = (panel.get_base_pixel(), chart.backend_coord(&at));
    (x - left, y - top)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::svg;

    /// Where the texts of a chart are anchored (pixels from the left), and what they say.
    fn texts(svg: &str) -> Vec<(i32, String)> {
        let lines: Vec<&str> = svg.lines().collect();
        let text = |pair: &[&str]| {
            let x = pair[0].strip_prefix("<text x=\"")?.split('"').next()?.parse().ok()?;
            Some((x, pair[1].to_owned()))
        };
        lines.windows(2).filter_map(text).collect()
    }

    #[test]
    fn a_title_stands_above_the_middle_of_the_frame() {
        let (x, y) = (Axis::linear("x", 0.0..4.0), Axis::linear("y", 0.0..1.0));
        let chart = |right: u32| svg((1000, 500), |root| frame(root, "a title", (&x, &y), right).map(drop)).unwrap();
        for right in [20, 300] {
            let texts = texts(&chart(right));
            let place = |words: &str| texts.iter().find(|(_, found)| found == words).unwrap().0;
            assert!((2 * place("a title") - place("0") - place("4")).abs() <= 4, "{texts:?}");
        }
    }

    #[test]
    fn a_logarithmic_axis_leaves_room_beyond_its_ends() {
        let axis = Axis::logarithmic("distance", 1e-18..1.0);
        let (first, last) = (axis.position(0.0), axis.position(3.0));
        assert_eq!((first, last), (-18.0, 0.0));
        assert!(axis.span().start < first && last < axis.span().end);
        let labels: Vec<String> = axis.ticks(900, false).into_iter().map(|tick| tick.label).collect();
        assert_eq!(labels, ["1e-18", "1e-15", "1e-12", "1e-9", "1e-6", "1e-3", "1e0"]);
        let falling = Axis::logarithmic("error", 10.0..1e-18);
        assert!(falling.position(1.0) < falling.position(1e-9));
    }
}
