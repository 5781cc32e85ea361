//! This file integrates over one coordinate. It divides the line where the integrand has a kink, and then wherever the
//! estimated error is largest, until the sum of these errors is within the tolerance.
//!
//! Kinks are found by marks: continuous functions of the position, at the whole values of which the integrand has a kink. A
//! line is halved until each part is plain, which means that none of its marks can pass a whole value, because they change
//! too slowly; or until the part is so short that it can hide nothing but the kink at which its ends differ. A part that is
//! not plain without such a kink counts as an error of its whole length.

use dynamics::Error;

use super::kronrod::{self, NODES, Span};

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
    /// The probability density at the position, the value's largest size.
    pub(super) density: f64,
}

/// What is integrated over a line.
pub(super) trait Integrand {
    /// The integrand at all `positions`.
    fn points(&self, positions: [f64; NODES]) -> Result<[Point; NODES], Error>;

    /// The marks at a position.
    fn marks(&self, position: f64) -> Result<Marks, Error>;

    /// Whether no mark can pass a whole value between two positions.
    fn is_plain(&self, from: f64, to: f64) -> Result<bool, Error>;

    /// The part, from 0 to 1, of the launches between two positions that may show another face than at all nodes, which
    /// show one face alone.
    fn unproven(&self, from: f64, to: f64) -> Result<f64, Error>;
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
    /// The largest number of panels.
    pub(super) most_panels: usize,
    /// No panel is divided after this number of shares.
    pub(super) most_shares: u64,
}

/// A part of a line with a kink is halved to this length, as part of the line. Three kinks in it would have to be that
/// close, and their pair would matter less than its length.
const SHORT: f64 = 1.0 / 4096.0;

/// A part without a kink that is not plain is halved to this length, as part of the line.
const SHORTEST: f64 = 1.0 / (1 << 30) as f64;

/// The largest number of parts that are looked at.
const MOST_PARTS: usize = 1 << 14;

/// The length, as part of the line, within which a kink is located. The error of a panel that ends beside a kink falls
/// with the square of the distance.
const LOCATED: f64 = 1e-9;

/// A mean share within this of 0 or 1 is taken for that of launches that all show one face.
const ONE_FACE: f64 = 1e-12;

struct Panel {
    span: Span,
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
    let (mut panels, unproven) = line.panels(parts)?;
    let densest = |panel: &Panel| panel.points.iter().map(|point| point.density).fold(0.0, f64::max);
    let unproven = unproven * panels.iter().map(densest).fold(0.0, f64::max);
    let mut shares: u64 = panels.iter().map(Panel::shares).sum();
    let error = |panels: &[Panel]| panels.iter().map(|panel| panel.found.error).sum::<f64>();
    while panels.len() < limits.most_panels && shares < limits.most_shares && error(&panels) > limits.tolerance {
        let open = panels.iter().enumerate().filter(|(_, panel)| !panel.is_final);
        let Some((worst, _)) = open.max_by(|(_, a), (_, b)| a.found.error.total_cmp(&b.found.error)) else { break };
        let span = panels[worst].span;
        let [first, second] = span.parts(span.middle(), false);
        let [first, second] = [line.panel(first)?, line.panel(second)?];
        shares += first.shares() + second.shares();
        panels[worst] = first;
        panels.push(second);
    }
    let total = |part: fn(&Panel) -> f64| panels.iter().map(part).sum();
    Ok(Integral {
        value: total(|panel| panel.found.value),
        rule_error: total(|panel| panel.found.error + panel.errors[0]) + unproven,
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

impl Line<'_> {
    /// The panels from which the division starts, and the length of the parts that may have other kinks.
    fn panels(&self, parts: &Parts) -> Result<(Vec<Panel>, f64), Error> {
        let (mut spans, mut unproven) = (Vec::new(), 0.0);
        for pair in parts.ends.windows(2) {
            let whole = Span { ends: [pair[0], pair[1]], is_root: [parts.are_roots; 2] };
            self.divide(whole, &mut spans, &mut unproven)?;
        }
        let panels = spans.into_iter().map(|span| self.panel(span)).collect::<Result<_, Error>>()?;
        Ok((panels, unproven))
    }

    fn panel(&self, span: Span) -> Result<Panel, Error> {
        let nodes = span.nodes();
        let points = self.on.points(nodes.map(|node| node.at))?;
        let found = kronrod::found(&span, &nodes, &points.map(|point| point.value));
        // Equal samples prove nothing.
        let is_one_face = |face: f64| {
            points.iter().all(|point| (point.value - face * point.density).abs() <= ONE_FACE * point.density)
        };
        let mut errors = [0, 1].map(|of| kronrod::sum(&nodes, &points.map(|point| point.errors[of])));
        if is_one_face(0.0) || is_one_face(1.0) {
            let weight = kronrod::sum(&nodes, &points.map(|point| point.density));
            errors[0] += self.on.unproven(span.ends[0], span.ends[1])? * weight;
        }
        let is_short = span.ends[1] - span.ends[0] <= 4.0 * self.located;
        let is_final = is_short || found.error <= errors[0] + errors[1];
        Ok(Panel { span, points, found, errors, is_final })
    }

    /// Divides a span at its kinks, and adds the length of its parts that may have others to `unproven`.
    fn divide(&self, whole: Span, spans: &mut Vec<Span>, unproven: &mut f64) -> Result<(), Error> {
        let marked = |at: f64| Ok::<Marked, Error>((at, self.on.marks(at)?));
        let [from, to] = whole.ends.map(marked);
        let (mut kinks, mut parts) = (Vec::new(), vec![(from?, to?)]);
        let length = whole.ends[1] - whole.ends[0];
        let mut left = MOST_PARTS;
        while let Some((from, to)) = parts.pop() {
            left = left.saturating_sub(1);
            let part = to.0 - from.0;
            let has_kink = changed(&from.1, &to.1).is_some();
            let shortest = (length * if has_kink { SHORT } else { SHORTEST }).max(self.located);
            if part > shortest && left > 0 && !self.on.is_plain(from.0, to.0)? {
                let middle = marked(0.5 * (from.0 + to.0))?;
                parts.extend([(middle, to), (from, middle)]);
            } else if has_kink {
                self.find_kinks(from, to, &mut kinks)?;
                *unproven += if left > 0 { 0.0 } else { part };
            } else if part <= shortest || left == 0 {
                *unproven += part;
            }
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
