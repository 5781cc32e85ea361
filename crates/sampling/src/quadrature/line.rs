//! This file integrates over one coordinate. It divides the line where the integrand has a kink, and then wherever the
//! estimated error is largest, until the sum of these errors is within the tolerance.
//!
//! Kinks are found by marks: continuous functions of the position, at the whole values of which the integrand has a kink.

use dynamics::Error;

use super::kronrod::{self, NODES, Node, Span};

/// Functions of the position, at the whole values of which the integrand has a kink. Every third one is at 0 where the
/// integrand behaves like a square root.
pub(super) type Marks = [f64; MARKS];

/// Number of marks: those of the launches at both ends of a line within. Those that are not needed are 0.
pub(super) const MARKS: usize = 2 * MARKS_EACH;

/// Number of marks of one launch.
pub(super) const MARKS_EACH: usize = 3;

/// Number of the mark of a launch at which the integrand behaves like a square root.
pub(super) const ROOT: usize = 2;

/// The integrand at one position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point {
    pub(super) value: f64,
    /// Errors of the value, which no division of the line makes smaller: that of the rule, and that of rounding.
    pub(super) errors: [f64; 2],
    /// Number of shares that it took.
    pub(super) shares: u64,
    pub(super) marks: Marks,
}

/// What is integrated over a line.
pub(super) trait Integrand {
    /// The integrand at all `positions`.
    fn points(&self, positions: [f64; NODES]) -> Result<[Point; NODES], Error>;

    /// The marks at a position.
    fn marks(&self, position: f64) -> Result<Marks, Error>;
}

/// An integral over a line.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Integral {
    pub(super) value: f64,
    /// The estimated error of the rule, over this line and those within.
    pub(super) rule_error: f64,
    /// The mean rounding error of the shares.
    pub(super) rounding_error: f64,
    /// Number of shares.
    pub(super) shares: u64,
}

/// How a line is divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Limits {
    /// The largest sum of the estimated errors.
    pub(super) tolerance: f64,
    /// Whether the line is divided at all kinks before anything is integrated.
    pub(super) divides_at_kinks: bool,
    /// The largest number of panels.
    pub(super) most_panels: usize,
    /// No panel is divided after this number of shares.
    pub(super) most_shares: u64,
}

/// Number of parts of a line between which kinks are looked for.
const PARTS: usize = 24;

/// The largest number of kinks at which a line is divided from the start; with more, each of them is small.
const MOST_KINKS: f64 = 400.0;

/// The length, as part of the line, within which a kink is located. The error of a panel that ends beside a kink falls
/// with the square of the distance.
const LOCATED: f64 = 1e-9;

struct Panel {
    span: Span,
    nodes: [Node; NODES],
    points: [Point; NODES],
    found: kronrod::Found,
    /// Mean errors of the values.
    errors: [f64; 2],
    /// Whether a division cannot make it more accurate.
    is_final: bool,
}

/// The parts that a line is divided into before anything else, and whether the integrand behaves like a square root at their
/// ends.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Parts {
    pub(super) ends: Vec<f64>,
    pub(super) are_roots: bool,
}

/// The integral over a line.
pub(super) fn integrate(on: &dyn Integrand, parts: &Parts, limits: Limits) -> Result<Integral, Error> {
    let [first, last] = [parts.ends[0], parts.ends[parts.ends.len() - 1]];
    // Positions are told apart only if they differ by more than their rounding.
    let rounding = 4.0 * f64::EPSILON * first.abs().max(last.abs());
    let line = Line { on, located: (LOCATED * (last - first)).max(rounding) };
    let mut panels = line.panels(parts, limits)?;
    let mut shares: u64 = panels.iter().map(Panel::shares).sum();
    let error = |panels: &[Panel]| panels.iter().map(|panel| panel.found.error).sum::<f64>();
    while panels.len() < limits.most_panels && shares < limits.most_shares && error(&panels) > limits.tolerance {
        let open = panels.iter().enumerate().filter(|(_, panel)| !panel.is_final);
        let Some((worst, _)) = open.max_by(|(_, a), (_, b)| a.found.error.total_cmp(&b.found.error)) else { break };
        let [first, second] = line.halves(&panels[worst])?;
        let [first, second] = [line.panel(first)?, line.panel(second)?];
        shares += first.shares() + second.shares();
        panels[worst] = first;
        panels.push(second);
    }
    let total = |part: fn(&Panel) -> f64| panels.iter().map(part).sum();
    Ok(Integral {
        value: total(|panel| panel.found.value),
        rule_error: total(|panel| panel.found.error + panel.errors[0]),
        rounding_error: total(|panel| panel.errors[1]),
        shares,
    })
}

impl Panel {
    fn shares(&self) -> u64 {
        self.points.iter().map(|point| point.shares).sum()
    }
}

struct Line<'a> {
    on: &'a dyn Integrand,
    /// The length within which a kink is located.
    located: f64,
}

/// A position with its marks.
type Marked = (f64, Marks);

/// The first mark that has different whole parts at two positions. Square roots come first, since the other marks mean
/// nothing beyond them.
fn changed(one: &Marks, two: &Marks) -> Option<usize> {
    let differs = |index: &usize| one[*index].floor() != two[*index].floor();
    let of_kind = |is_root: bool| (0..MARKS).filter(move |index| (index % MARKS_EACH == ROOT) == is_root);
    of_kind(true).find(differs).or_else(|| of_kind(false).find(differs))
}

/// The number of whole values that a mark passes between two positions.
fn passed(index: usize, one: &Marks, two: &Marks) -> f64 {
    (one[index].floor() - two[index].floor()).abs()
}

impl Line<'_> {
    /// The panels from which the division starts.
    fn panels(&self, parts: &Parts, limits: Limits) -> Result<Vec<Panel>, Error> {
        let mut spans = Vec::new();
        for pair in parts.ends.windows(2) {
            let whole = Span { ends: [pair[0], pair[1]], is_root: [parts.are_roots; 2] };
            if limits.divides_at_kinks { self.divide(whole, &mut spans)? } else { spans.push(whole) }
        }
        spans.into_iter().map(|span| self.panel(span)).collect()
    }

    fn panel(&self, span: Span) -> Result<Panel, Error> {
        let nodes = span.nodes();
        let points = self.on.points(nodes.map(|node| node.at))?;
        let found = kronrod::found(&span, &nodes, &points.map(|point| point.value));
        let errors = [0, 1].map(|of| kronrod::sum(&nodes, &points.map(|point| point.errors[of])));
        let is_short = span.ends[1] - span.ends[0] <= 4.0 * self.located;
        Ok(Panel { span, nodes, points, found, errors, is_final: is_short || found.error <= errors[0] + errors[1] })
    }

    /// The two parts of a panel: on either side of the kink between two nodes that is nearest to the middle, or its halves.
    fn halves(&self, panel: &Panel) -> Result<[Span; 2], Error> {
        let marks = |at: usize| &panel.points[at].marks;
        let is_change = |at: &usize| {
            changed(marks(*at), marks(at + 1)).is_some_and(|of| passed(of, marks(*at), marks(at + 1)) == 1.0)
        };
        let from_middle = |at: &usize| (2 * at + 2).abs_diff(NODES);
        let Some(at) = (0..NODES - 1).filter(is_change).min_by_key(from_middle) else {
            return Ok(panel.span.parts(panel.span.middle(), false));
        };
        let marked = |index: usize| (panel.nodes[index].at, panel.points[index].marks);
        let (kink, is_root, _) = self.kink(marked(at), marked(at + 1))?;
        Ok(panel.span.parts(kink, is_root))
    }

    /// Divides a span at its kinks.
    fn divide(&self, whole: Span, spans: &mut Vec<Span>) -> Result<(), Error> {
        let [from, to] = whole.ends;
        #[expect(clippy::cast_precision_loss, reason = "dozens")]
        let position = |part: usize| from + (to - from) * (part as f64 / PARTS as f64);
        let marked = |part| Ok((position(part), self.on.marks(position(part))?));
        let marked = (0..=PARTS).map(marked).collect::<Result<Vec<Marked>, Error>>()?;
        let passed = |pair: &[Marked]| (0..MARKS).map(|index| passed(index, &pair[0].1, &pair[1].1)).sum::<f64>();
        let mut kinks = Vec::new();
        if marked.windows(2).map(passed).sum::<f64>() <= MOST_KINKS {
            marked.windows(2).try_for_each(|pair| self.find_kinks(pair[0], pair[1], &mut kinks))?;
        }
        let mut rest = whole;
        for (at, is_root) in kinks {
            if at - rest.ends[0] > self.located && rest.ends[1] - at > self.located {
                let [part, after] = rest.parts(at, is_root);
                spans.push(part);
                rest = after;
            }
        }
        spans.push(rest);
        Ok(())
    }

    /// Adds the kinks between two positions, in ascending order.
    fn find_kinks(&self, from: Marked, to: Marked, kinks: &mut Vec<(f64, bool)>) -> Result<(), Error> {
        if to.0 - from.0 <= self.located || changed(&from.1, &to.1).is_none() {
            return Ok(());
        }
        let (at, is_root, [before, after]) = self.kink(from, to)?;
        self.find_kinks(from, before, kinks)?;
        kinks.push((at, is_root));
        self.find_kinks(after, to, kinks)
    }

    /// A kink between two positions with different marks, whether it is a square root, and positions next to it on either
    /// side. The mark is found by false position in its Illinois form, and by halving where that is slow.
    fn kink(&self, from: Marked, to: Marked) -> Result<(f64, bool, [Marked; 2]), Error> {
        let Some(index) = changed(&from.1, &to.1) else { return Ok((0.5 * (from.0 + to.0), false, [from, to])) };
        // The first whole value that the mark passes on its way.
        let level = from.1[index].floor() + f64::from(u8::from(from.1[index] < to.1[index]));
        let height = |marked: &Marked| marked.1[index] - level;
        let (mut below, mut above) = (from, to);
        let [mut low, mut high] = [height(&below), height(&above)];
        let mut was_below = None;
        for step in 0.. {
            if above.0 - below.0 <= self.located {
                break;
            }
            let by_chord = below.0 - low * (above.0 - below.0) / (high - low);
            let margin = 0.4 * self.located;
            let is_inside = step % 4 != 3 && by_chord.is_finite();
            let at = if is_inside { by_chord } else { 0.5 * (below.0 + above.0) };
            // Steps at least a part of the wanted length inwards, so that both ends close in on the kink.
            let at = at.clamp(below.0 + margin, above.0 - margin);
            let marked = (at, self.on.marks(at)?);
            let here = height(&marked);
            let is_below = (here >= 0.0) == (height(&from) >= 0.0);
            // An end that is kept twice counts half, so that the next chord ends beyond the kink.
            let kept = if was_below == Some(is_below) { 0.5 } else { 1.0 };
            was_below = Some(is_below);
            if is_below {
                (below, low, high) = (marked, here, kept * high);
            } else {
                (above, high, low) = (marked, here, kept * low);
            }
        }
        Ok((0.5 * (below.0 + above.0), index % MARKS_EACH == ROOT, [below, above]))
    }
}

#[cfg(test)]
mod tests;
