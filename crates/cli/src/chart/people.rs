//! Draws people's same-side shares as a forest plot: a row for each person with the interval of that person alone, and below
//! them those of these flips, of all people and of a further person.

use chart::{Axis, BLUE, ChartError, Drawn, FAINT, Frame, GREY, Panel, TEXT, VERMILION, frame, pixel, svg};
use plotters::prelude::*;
use sampling::{Interval, SameSide, SameSideBias};

/// More people than this make a picture that nobody looks at.
pub(crate) const MOST_PEOPLE: usize = 1000;

/// Height of a row, and of what is above and below them (pixels, twice as they are read).
const ROW: u32 = 44;
const AROUND: u32 = 190;
const WIDTH: u32 = 1800;
/// Room for the names and counts (pixels).
const NAMES: u32 = 560;
/// Longer names are cut.
const LONGEST_NAME: usize = 18;

/// A person: the name, the counts and the interval of the share.
pub(crate) type Row<'a> = (&'a str, SameSide, Interval);

/// One line of the plot.
struct Line {
    words: String,
    /// The middle, if it is known.
    at: Option<f64>,
    interval: Interval,
    colour: RGBColor,
    width: u32,
}

/// The plot of `found`, whose people are `rows`, as SVG.
pub(crate) fn people(found: &SameSideBias, rows: &[Row<'_>]) -> Result<String, ChartError> {
    let lines: Vec<Line> = rows.iter().map(of_person).chain(of_all(found)).collect();
    let number = u32::try_from(lines.len()).unwrap_or(u32::MAX);
    let ends = lines.iter().flat_map(|line| [line.interval.lo, line.interval.hi]);
    let (lo, hi) = ends.fold((0.5_f64, 0.5_f64), |(lo, hi), end| (lo.min(end), hi.max(end)));
    let room = 0.04 * (hi - lo).max(0.01);
    svg((WIDTH, AROUND + ROW * number), |root| {
        let range = (lo - room).max(0.0)..(hi + room).min(1.0);
        let x = Axis::linear("share of landings on the side that had been up, with its 95 % interval", range);
        let y = Axis::named(vec![String::new(); lines.len()]);
        let title =
            format!("{} of {} landings on the side that had been up", found.counts.same(), found.counts.tosses());
        let mut chart = frame(root, &title, (&x, &y), NAMES)?;
        let top = lines.len() as f64 - 0.5;
        let fair = [(0.5, -0.5), (0.5, top)];
        chart.draw_series(DashedLineSeries::new(fair, 12, 8, GREY.stroke_width(3)))?;
        if !rows.is_empty() {
            let between = lines.len() as f64 - rows.len() as f64 - 0.5;
            chart.draw_series(LineSeries::new([(x.start(), between), (x.end(), between)], GREY.stroke_width(2)))?;
        }
        for (row, line) in lines.iter().rev().enumerate() {
            draw(root, &mut chart, (x.end(), row as f64), line)?;
        }
        Ok(())
    })
}

fn of_person((name, counts, interval): &Row<'_>) -> Line {
    let name: String = match name.char_indices().nth(LONGEST_NAME) {
        Some((end, _)) => format!("{}…", &name[..end]),
        None => (*name).to_owned(),
    };
    let words = format!("{name}: {} of {}", counts.same(), counts.tosses());
    Line { words, at: Some(counts.share()), interval: *interval, colour: BLUE, width: 4 }
}

/// The lines below those of the people.
fn of_all(found: &SameSideBias) -> impl Iterator<Item = Line> {
    let line = |words: &str, at, interval, colour, width| Line { words: words.to_owned(), at, interval, colour, width };
    let said = |words: &str, at: f64, Interval { lo, hi }: Interval| format!("{words}: {at:.4}, {lo:.4} to {hi:.4}");
    let flips =
        line(&said("these flips", found.share, found.these_flips), Some(found.share), found.these_flips, BLACK, 6);
    let is_one = found.people == 1;
    let all = (!is_one)
        .then(|| line(&said("all people", found.mean, found.interval), Some(found.mean), found.interval, VERMILION, 8));
    let next = found.next_person.map(|interval| line("a further person", None, interval, FAINT, 6));
    [Some(flips), all, next].into_iter().flatten()
}

fn draw(root: &Panel<'_>, chart: &mut Frame<'_, '_>, (right, row): (f64, f64), line: &Line) -> Drawn {
    let Line { words, at, interval: Interval { lo, hi }, colour, width } = line;
    let ends = [(*lo, row), (*hi, row)];
    chart.draw_series(LineSeries::new(ends, colour.stroke_width(*width)))?;
    for (end, row) in ends {
        chart.draw_series(LineSeries::new([(end, row - 0.2), (end, row + 0.2)], colour.stroke_width(3)))?;
    }
    if let Some(at) = at {
        chart.draw_series([Circle::new((*at, row), 9, colour.filled())])?;
    }
    let (x, y) = pixel(root, chart, (right, row));
    root.draw(&Text::new(
        words.clone(),
        (x + 20, y - 12),
        TEXT.into_font().color(&if *colour == FAINT { GREY } else { *colour }),
    ))?;
    Ok(())
}
