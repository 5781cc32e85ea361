//! The chapters of charts, each with a caption that says what to see in them.

use maud::{Markup, PreEscaped, html};

use crate::render::charts::Chart;

/// A chapter of charts.
pub(super) struct Section<'a> {
    pub(super) id: &'static str,
    pub(super) title: &'static str,
    caption: &'static str,
    charts: Vec<&'a Chart>,
}

/// Id, title and caption of every chapter; the files of its charts begin with the id.
const CHAPTERS: [(&str, &str, &str); 5] = [
    (
        "fig4",
        "The paper's Fig. 4",
        "Probability against the number of launches: a grid (A), in the order of its axes, and \
      random launches (B). B converges like one over the root of n; A drifts until its last axis is complete. Both end at the \
      paper's 66 %. The space is reconstructed, since the paper names none.",
    ),
    (
        "work-precision",
        "Speed against accuracy",
        "Each point is a run at one tolerance or step: the further right, the more \
      accurate; the lower, the cheaper. First all problems on one scale, by time on this machine; then each problem, left in \
      calls, which repeat exactly, and right in time. The grey band is the front: no integrator's run is better in both error \
      and work. The exact motion calls nothing and is accurate to the last bit.",
    ),
    (
        "order",
        "Order of convergence",
        "With fixed steps the error falls like a power of the step. The fitted power stands \
      beside that of the theory. For DOP853 only one halving of the step lies between steps that are too large for the power law \
      and errors that are rounding alone.",
    ),
    (
        "atlas",
        "Where methods fail",
        "The worst answer of every solver, scheme and formulation near eight hazards. The raw \
      forms are the paper's equations as printed: they report success and are wrong. No default is wrong without an error. Below \
      stand error and work against the distance from each hazard. The purple line is the effect of one rounding of the launch: \
      an error below it cannot be told from an error of the launch.",
    ),
    (
        "long-flights",
        "Long flights",
        "Errors and drifts of the paper's cheated toss, flown for up to 10⁴ s. The error grows \
      in proportion to the time. The conserved quantities drift by some parts in 10⁸ at most.",
    ),
];

/// The chapters that have charts.
pub(super) fn sections(charts: &[Chart]) -> Vec<Section<'_>> {
    let section = |(id, title, caption): (&'static str, &'static str, &'static str)| {
        let charts: Vec<&Chart> = charts.iter().filter(|chart| chart.file.starts_with(id)).collect();
        (!charts.is_empty()).then_some(Section { id, title, caption, charts })
    };
    CHAPTERS.into_iter().filter_map(section).collect()
}

impl Section<'_> {
    pub(super) fn markup(&self) -> Markup {
        html! {
            h2 id=(self.id) { (self.title) }
            p.faint { (self.caption) }
            @for chart in &self.charts {
                figure {
                    div.wide { (PreEscaped(&chart.svg)) }
                    @if let Some(caption) = &chart.caption { figcaption { (caption) } }
                }
            }
        }
    }
}
