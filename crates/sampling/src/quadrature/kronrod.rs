//! This file has the rule that integrates over one panel: Kronrod's with 15 nodes, around Gauss's with 7 of them. The two
//! share their nodes, so that their difference, an estimate of the error, costs nothing.
//!
//! Next to an end at which the integrand behaves like a square root, the nodes are those of a smooth substitution, in which
//! it is a polynomial: x = t² at a lower end of 0.
//!
//! Source of the nodes, weights and of the error estimate: R. Piessens et al., QUADPACK, Springer 1983, routine QK15.

/// Number of nodes of a panel.
pub(super) const NODES: usize = 15;

/// Nodes at and above 0 of the rules over (-1, 1), from the outermost on. Every second one is a node of Gauss's rule.
const HALF: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];

/// Kronrod's weights of these nodes.
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_55,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_82,
];

/// Gauss's weights; 0 for the nodes that are Kronrod's alone.
const GAUSS: [f64; 8] = [
    0.0,
    0.129_484_966_168_869_7,
    0.0,
    0.279_705_391_489_276_64,
    0.0,
    0.381_830_050_505_118_9,
    0.0,
    0.417_959_183_673_469_4,
];

/// A part of a line, and at which of its ends the integrand may behave like a square root.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Span {
    pub(super) ends: [f64; 2],
    pub(super) is_root: [bool; 2],
}

/// A node: its position, and its weights by Kronrod's and Gauss's rules, with the factor of the substitution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Node {
    pub(super) at: f64,
    kronrod: f64,
    gauss: f64,
}

/// The integral over a panel, with an estimate of its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Found {
    pub(super) value: f64,
    pub(super) error: f64,
}

impl Span {
    /// The position at the fraction `t` of the substitution, and its derivative.
    fn position(&self, t: f64) -> [f64; 2] {
        let Self { ends: [from, to], is_root } = *self;
        let (length, rest) = (to - from, 1.0 - t);
        match is_root {
            [false, false] => [from + length * t, length],
            [true, false] => [from + length * t * t, 2.0 * length * t],
            [false, true] => [to - length * rest * rest, 2.0 * length * rest],
            [true, true] if t < 0.5 => [from + length * t * t * (3.0 - 2.0 * t), 6.0 * length * t * rest],
            [true, true] => [to - length * rest * rest * (3.0 - 2.0 * rest), 6.0 * length * t * rest],
        }
    }

    /// The nodes, in ascending order.
    pub(super) fn nodes(&self) -> [Node; NODES] {
        std::array::from_fn(|index| {
            let mirrored = index.min(NODES - 1 - index);
            let side = if index < NODES / 2 { -1.0 } else { 1.0 };
            let [at, slope] = self.position(0.5 + 0.5 * side * HALF[mirrored]);
            Node { at, kronrod: 0.5 * slope * KRONROD[mirrored], gauss: 0.5 * slope * GAUSS[mirrored] }
        })
    }

    /// The position that halves the panel.
    pub(super) fn middle(&self) -> f64 {
        self.position(0.5)[0]
    }

    /// The two parts on either side of `at`, where the integrand behaves like a square root if `is_root`.
    pub(super) fn parts(&self, at: f64, is_root: bool) -> [Self; 2] {
        let Self { ends: [from, to], is_root: [first, last] } = *self;
        [Self { ends: [from, at], is_root: [first, is_root] }, Self { ends: [at, to], is_root: [is_root, last] }]
    }
}

/// The mean of `values` with Kronrod's weights, as an integral.
pub(super) fn sum(nodes: &[Node; NODES], values: &[f64; NODES]) -> f64 {
    nodes.iter().zip(values).map(|(node, value)| node.kronrod * value).sum()
}

/// The integral of a function with these `values` at the nodes.
///
/// The error is estimated as in QUADPACK: the difference d of the two rules is the error of the coarser one; that of the finer one
/// is a (200 d/a)^1.5, at most a, where a is the integral of the distance from the mean.
pub(super) fn found(span: &Span, nodes: &[Node; NODES], values: &[f64; NODES]) -> Found {
    let value = sum(nodes, values);
    let coarse: f64 = nodes.iter().zip(values).map(|(node, value)| node.gauss * value).sum();
    let mean = value / (span.ends[1] - span.ends[0]);
    let spread: f64 = nodes.iter().zip(values).map(|(node, value)| node.kronrod * (value - mean).abs()).sum();
    let ratio = 200.0 * (value - coarse).abs() / spread;
    // Without a spread the function is constant, and the ratio has no meaning.
    let error = if spread > 0.0 { spread * (ratio * ratio.sqrt()).min(1.0) } else { 0.0 };
    Found { value, error }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn integral(span: Span, function: impl Fn(f64) -> f64) -> Found {
        let nodes = span.nodes();
        found(&span, &nodes, &nodes.map(|node| function(node.at)))
    }

    #[test]
    fn polynomials_are_integrated_to_rounding() {
        let span = Span { ends: [-1.0, 3.0], is_root: [false; 2] };
        for degree in 0..=22 {
            let expected = (3_f64.powi(degree + 1) - (-1_f64).powi(degree + 1)) / f64::from(degree + 1);
            let error = integral(span, |x| x.powi(degree)).value - expected;
            assert!(error.abs() < 1e-14 * expected.abs().max(1.0), "{degree}: {error:e}");
        }
    }

    #[test]
    fn square_roots_at_the_ends_are_integrated_to_rounding() {
        let root = |from_start: bool, from_end: bool| {
            move |x: f64| {
                (if from_start { x.sqrt() } else { 1.0 }) + (if from_end { (1.0 - x).max(0.0).sqrt() } else { 1.0 })
            }
        };
        for is_root in [[false, false], [true, false], [false, true], [true, true]] {
            let found = integral(Span { ends: [0.0, 1.0], is_root }, root(is_root[0], is_root[1]));
            let expected: f64 = is_root.map(|is_root| if is_root { 2.0 / 3.0 } else { 1.0 }).iter().sum();
            assert!((found.value - expected).abs() < 1e-9 && found.error < 1e-7, "{is_root:?}: {found:?}");
        }
        // Without the substitution the error is a million times larger.
        assert!(integral(Span { ends: [0.0, 1.0], is_root: [false; 2] }, f64::sqrt).error > 1e-5);
    }

    #[test]
    fn the_error_estimate_is_that_of_quadpack() {
        // Both rules and the spread by hand: a step at the middle, where only the middle node is between.
        let span = Span { ends: [-1.0, 1.0], is_root: [false; 2] };
        let step = |x: f64| if x > 0.0 { 1.0 } else { 0.0 };
        let (value, coarse) = (0.5 * (2.0 - KRONROD[7]), 0.5 * (2.0 - GAUSS[7]));
        let mean = 0.5 * value;
        let spread = value * (1.0 - mean) + (2.0 - value) * mean;
        let found = integral(span, step);
        assert!((found.value - value).abs() < 1e-15);
        assert!((found.error - spread * (200.0 * (value - coarse).abs() / spread).powf(1.5).min(1.0)).abs() < 1e-15);
        // Where the difference of the rules is small, the estimate is the power 1.5 of it.
        let found = integral(span, |x| (3.0 * x).cos() + 1.0);
        let nodes = span.nodes();
        let values = nodes.map(|node| (3.0 * node.at).cos() + 1.0);
        let of = |weight: fn(&Node) -> f64, of: &dyn Fn(f64) -> f64| -> f64 {
            nodes.iter().zip(values).map(|(node, value)| weight(node) * of(value)).sum()
        };
        let difference = (of(|node| node.kronrod, &|value| value) - of(|node| node.gauss, &|value| value)).abs();
        let spread = of(|node| node.kronrod, &|value| (value - 0.5 * found.value).abs());
        let expected = spread * (200.0 * difference / spread).powf(1.5);
        assert!((found.error / expected - 1.0).abs() < 1e-9 && expected < 0.1 * spread, "{found:?}, not {expected:e}");
        assert_eq!(integral(span, |_| 0.0), Found { value: 0.0, error: 0.0 });
    }
}
