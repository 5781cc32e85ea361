//! The numbers that all tosses of a batch of bodies share.

use std::ops::Range;

use dynamics::{Body, Tosses};
use numerics::{Ball, DoubleDouble, Elementary};

/// Largest relative error of a constant before it is rounded.
const ERROR: f64 = 8.673_617_379_884_035e-19; // 2^-60

/// More than balls add to their radii for underflow: a difference that is exactly 0 is known.
const UNDERFLOW: f64 = 1e-240;

/// Largest error of a component of an axis.
const AXIS_ERROR: f64 = 1e-24;

/// Gravities (m/s²) of which 1/(π g) is known. Balls that leave the range of f64 may be of any size about 0.
const GRAVITIES: Range<f64> = 1e-50..1e50;

/// A number with its error bound.
type Known = Ball<DoubleDouble>;

/// Constants of the body, of the vertical and of gravity, each right to its last bit. Moments are in a unit near the
/// largest of them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Constants {
    /// I1 ≤ I2 ≤ I3.
    pub(super) moments: [f64; 3],
    /// α12, α23 and α13, with α_ij = (I_j - I_i)/(I_i I_j).
    pub(super) alpha: [f64; 3],
    /// Their roots.
    pub(super) roots: [f64; 3],
    /// e^(-2ψ) with sinh ψ = √(α23/α12), and with √(α12/α23).
    pub(super) decays: [f64; 2],
    /// 1/I3.
    pub(super) inverse: f64,
    /// 1/(π g), by which a rate times a speed becomes turns.
    pub(super) turns: f64,
    /// How rates in BF become those along principal axes.
    pub(super) axes: Axes,
    /// The normal in principal axes.
    pub(super) normal: [f64; 3],
    /// The vertical at launch in principal axes.
    pub(super) vertical: [f64; 3],
}

/// The principal axes in BF.
#[derive(Debug, Clone, Copy)]
pub(super) enum Axes {
    /// Each is along an axis of BF: its number and its sign.
    Along([(usize, f64); 3]),
    /// Their components, and what rounding took from these.
    Turned([[[f64; 2]; 3]; 3]),
}

impl Constants {
    /// The constants of `tosses`; `None` for those that the filter leaves to the proof of single tosses: of a sphere, of a
    /// body without extent across an axis, of one of whose axes too little is known, and for extreme gravities.
    pub(super) fn new(tosses: &Tosses<'_, Body>) -> Option<Self> {
        let number = |value: f64| Known::new(DoubleDouble::exactly(value), 0.0);
        let principal = tosses.body().rigid().scaled_principal(&number(0.0));
        let moments = principal.moments;
        let alpha = [(0, 1), (1, 2), (0, 2)].map(|(i, j): (usize, usize)| {
            let [first, second] = [moments[i], moments[j]];
            (second - first) / (first * second)
        });
        let decays = [(1, 0), (0, 1)].map(|(of, other): (usize, usize)| decay(alpha[of], alpha[other]));
        let inverse = number(1.0) / moments[2];
        let are_known = moments.iter().chain(&alpha).chain(&decays).all(is_known);
        let axes_are_known = principal.axes.iter().flatten().all(|part| part.radius() <= AXIS_ERROR);
        let turns = number(1.0) / (number(1.0).pi() * number(tosses.gravity()));
        if !(are_known && axes_are_known && alpha[2].has_sign() && GRAVITIES.contains(&tosses.gravity())) {
            return None;
        }
        let up = tosses.attitude().exact_vertical().map(|part| Known::new(part, 0.0));
        Some(Self {
            moments: moments.map(rounded),
            alpha: alpha.map(rounded),
            roots: alpha.map(|difference| rounded(difference.sqrt())),
            decays: decays.map(rounded),
            inverse: rounded(inverse),
            turns: rounded(turns),
            axes: Axes::new(&principal.axes),
            normal: principal.axes.map(|[_, _, z]| rounded(z)),
            vertical: principal.axes.map(|[x, y, z]| rounded(x * up[0] + y * up[1] + z * up[2])),
        })
    }
}

impl Axes {
    fn new(axes: &[[Known; 3]; 3]) -> Self {
        let along =
            axes.map(|axis| (0..3).find(|part| rounded(axis[*part]).abs() == 1.0 && axis[*part].radius() == 0.0));
        if let [Some(first), Some(second), Some(third)] = along {
            let signed = |row: usize, part: usize| (part, rounded(axes[row][part]));
            return Self::Along([signed(0, first), signed(1, second), signed(2, third)]);
        }
        Self::Turned(axes.map(|axis| axis.map(|part| [part.midpoint().hi(), part.midpoint().lo()])))
    }
}

/// e^(-2ψ) with sinh ψ = √(a/b), without a difference.
fn decay(a: Known, b: Known) -> Known {
    let size = (a + b).sqrt() + a.sqrt();
    b / (size * size)
}

fn is_known(number: &Known) -> bool {
    number.radius() <= ERROR * number.midpoint().hi().abs() + UNDERFLOW
}

fn rounded(number: Known) -> f64 {
    number.midpoint().hi()
}
