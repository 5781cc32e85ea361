//! Draws what each model of the hierarchy costs: a bar from the 5 % to the 95 % quantile, and a disc at the median. The
//! planner chooses by these costs.

use chart::{BLUE, ChartError, FAINT, GREEN, GREY, Panel, TEXT, VERMILION, svg};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use toss::Nanoseconds;

use crate::measure::planner::summary::Cost;

const LEFT: i32 = 330;
const RIGHT: i32 = 1800;
const TOP: i32 = 70;
const ROW: i32 = 64;

/// The range of the axis, as powers of ten: 10 ns to 10^8 ns.
const DECADES: std::ops::RangeInclusive<i32> = 1..=8;

/// The chart as SVG.
pub(super) fn models(costs: &[Cost]) -> Result<String, ChartError> {
    let bottom = TOP + ROW * i32::try_from(costs.len()).unwrap_or(i32::MAX);
    svg((2000, (bottom + 110).cast_unsigned()), |root| {
        for decade in DECADES {
            let x = place(10f64.powi(decade));
            root.draw(&PathElement::new([(x, TOP - 20), (x, bottom)], FAINT.stroke_width(1)))?;
            let label = ["", "10 ns", "100 ns", "1 µs", "10 µs", "100 µs", "1 ms", "10 ms", "100 ms"]
                [decade.unsigned_abs() as usize];
            text(root, label, (x, bottom + 26), HPos::Center, &BLACK)?;
        }
        for (row, cost) in (0..).zip(costs) {
            bar(root, TOP + ROW * row + ROW / 2, cost)?;
        }
        text(
            root,
            "time of one answer on one core, of a trace for each point; a probability as accurate as asked, 1e-1 to 1e-3",
            (LEFT, bottom + 76),
            HPos::Left,
            &GREY,
        )
    })
}

/// Where a time (ns) lies (pixels).
#[expect(clippy::cast_possible_truncation, reason = "within the canvas")]
fn place(ns: f64) -> i32 {
    let (first, last) = (f64::from(*DECADES.start()), f64::from(*DECADES.end()));
    let part = (ns.log10() - first) / (last - first);
    LEFT + (f64::from(RIGHT - LEFT) * part.clamp(0.0, 1.0)) as i32
}

fn bar(root: &Panel<'_>, y: i32, cost: &Cost) -> chart::Drawn {
    let colour = match cost.model {
        "integrator" => VERMILION,
        "share" | "share-enclosure" | "share-sobol" | "sobol" | "random" => GREEN,
        _ => BLUE,
    };
    let [low, median, high] = [cost.low, cost.median, cost.high].map(place);
    text(root, cost.model, (LEFT - 24, y), HPos::Right, &BLACK)?;
    root.draw(&Rectangle::new([(low, y - 12), (high.max(low + 2), y + 12)], colour.mix(0.35).filled()))?;
    root.draw(&Circle::new((median, y), 9, colour.filled()))?;
    let (label, x) = (Nanoseconds(cost.median).to_string(), high.max(median) + 24);
    // White behind the words, because a line of the grid would strike them through.
    let width = 17 * i32::try_from(label.chars().count()).unwrap_or(0);
    root.draw(&Rectangle::new([(x - 6, y - 18), (x + width, y + 18)], WHITE.filled()))?;
    text(root, &label, (x, y), HPos::Left, &colour)
}

fn text(root: &Panel<'_>, words: &str, at: (i32, i32), anchor: HPos, colour: &RGBColor) -> chart::Drawn {
    let style = TEXT.into_font().color(colour).pos(Pos::new(anchor, VPos::Center));
    root.draw(&Text::new(words.to_owned(), at, style))?;
    Ok(())
}
