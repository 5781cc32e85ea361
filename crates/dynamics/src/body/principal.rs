//! Principal axes: the eigenvectors of the inertia tensor, by Jacobi's method in any kind of number. In f64 their
//! errors would grow with the phase of a flight, so they are taken in double-double. Axes of nearly equal moments lose
//! digits there, too: [`ModelBody`] has more.

use nalgebra::Vector3;
use numerics::{DoubleDouble, Elementary};

pub use self::model::ModelBody;

mod model;

/// Elements off the diagonal below this part of the largest element are not made 0, because the squares on the way would
/// underflow. They count as what is left off the diagonal.
const NEGLIGIBLE: f64 = 1e-240;

/// More than scaling can take from the elements of a tensor by underflow.
const TINY: f64 = 1e-300;

/// Principal moments, the smallest first, and their axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrincipalAxes<N> {
    /// The moments.
    pub moments: [N; 3],
    /// The directions of the axes in BF, unit vectors; right-handed.
    pub axes: [[N; 3]; 3],
}

/// Euler's equations of any rigid body in its principal axes: ω' (rad/s²) from ω (rad/s) and the
/// [couplings](crate::RigidBody::couplings).
#[inline]
pub fn principal_acceleration([a, b, c]: [f64; 3], [first, second, third]: [f64; 3]) -> [f64; 3] {
    [a * second * third, b * third * first, c * first * second]
}

impl<N: Elementary> PrincipalAxes<N> {
    /// The axes x, y, z of BF in the order of their `moments`. The one in the middle is reversed if that is needed to
    /// make the axes right-handed.
    pub(super) fn of_moments(moments: [f64; 3], like: &N) -> Self {
        let axes = [0, 1, 2].map(|row| [0, 1, 2].map(|column| if row == column { 1.0 } else { 0.0 }));
        let axes = axes.map(|axis: [f64; 3]| axis.map(|part| like.like(part)));
        Self { moments: moments.map(|moment| like.like(moment)), axes }.sorted()
    }

    /// The eigenvalues and eigenvectors of a symmetric `tensor`.
    ///
    /// What is left off the diagonal bounds the error of the moments, and divided by the difference of two moments that of
    /// their axes.
    pub(super) fn of_tensor(tensor: [[N; 3]; 3]) -> Self {
        let (found, left) = Self::diagonalised(tensor);
        found.enclosing(left)
    }

    /// What is [`diagonalised`](Self::diagonalised) but for elements of this size, as enclosures of moments and axes.
    fn enclosing(self, left: f64) -> Self {
        let moments = self.moments.map(|moment| moment.widened(left));
        let nearest = gap(&moments[0], &moments[1]).min(gap(&moments[1], &moments[2]));
        // Of balls, this is infinite for equal moments, whose axes are not determined.
        let turned = 4.0 * left / (nearest - 2.0 * left).max(0.0);
        Self { moments, axes: self.axes.map(|axis| axis.map(|part| part.widened(turned))) }
    }

    /// Axes that are almost those of a symmetric `tensor`, the elements on its diagonal in these axes, and a bound of the
    /// size of what is left off the diagonal.
    ///
    /// Each rotation makes one element off the diagonal 0. After a few sweeps over the three, what is left of them is
    /// below the rounding of the largest moment.
    fn diagonalised(mut tensor: [[N; 3]; 3]) -> (Self, f64) {
        let like = tensor[0][0].clone();
        let mut axes = Self::of_moments([1.0, 2.0, 3.0], &like).axes;
        let largest = tensor.iter().flatten().fold(0.0_f64, |most, element| most.max(element.to_f64().abs()));
        let small = largest * 2f64.powi(-like.digits() - 8);
        for _ in 0..40 {
            if off_diagonal(&tensor) <= small {
                break;
            }
            for (p, q) in [(0, 1), (0, 2), (1, 2)] {
                // An element within its own error is left: a turn to make it 0 has no angle.
                let known = (16.0 * tensor[p][q].error()).max(NEGLIGIBLE * largest);
                if tensor[p][q].to_f64().abs() > known {
                    rotate(&mut tensor, &mut axes, p, q);
                }
            }
        }
        let left = left_off_diagonal(&tensor);
        let moments = [0, 1, 2].map(|index: usize| tensor[index][index].clone());
        (Self { moments, axes }.sorted(), left)
    }

    /// In the order of the moments, right-handed. Moments that differ by less than their rounding to f64 are ordered, too.
    fn sorted(self) -> Self {
        let Self { moments, axes } = self;
        let mut order = [0, 1, 2];
        let above = |a: usize, b: usize| (moments[a].clone() - moments[b].clone()).sign();
        order.sort_by(|a: &usize, b: &usize| above(*a, *b).total_cmp(&0.0));
        // The order is a cyclic one, or it exchanges two axes, which makes a right-handed system left-handed.
        let cyclic = (order[0] + 1) % 3 == order[1];
        let mut axes = order.map(|index| axes[index].clone());
        if !cyclic {
            axes[1] = axes[1].clone().map(|part| -part);
        }
        Self { moments: order.map(|index| moments[index].clone()), axes }
    }
}

impl PrincipalAxes<DoubleDouble> {
    /// Whether two moments differ by so little that these axes are not known to the digits of f64.
    pub(super) fn has_close_moments(&self) -> bool {
        let [a, b, c] = &self.moments;
        gap(a, b).min(gap(b, c)) < model::CLOSE * c.hi()
    }

    /// The axes of a tensor that is 2^`exponent` times as large.
    pub(super) fn times_power_of_two(self, exponent: i32) -> Self {
        Self { moments: self.moments.map(|moment| moment.times_power_of_two(exponent)), ..self }
    }

    /// The components of a rate (BF) about the principal axes, rounded once.
    pub(crate) fn rates(&self, rate: &Vector3<f64>) -> [f64; 3] {
        self.axes.map(|[x, y, z]| (x * rate.x + y * rate.y + z * rate.z).hi())
    }

    /// The components of a vector along the principal axes.
    pub fn to_principal(&self, vector: &Vector3<f64>) -> [f64; 3] {
        self.axes.map(|[x, y, z]| x.hi() * vector.x + y.hi() * vector.y + z.hi() * vector.z)
    }

    /// The vector (BF) with these components along the principal axes.
    pub fn from_principal(&self, [a, b, c]: [f64; 3]) -> Vector3<f64> {
        let along = |index: usize| {
            let [first, second, third] = self.axes.map(|axis| axis[index].hi());
            first * a + second * b + third * c
        };
        Vector3::new(along(0), along(1), along(2))
    }
}

/// By how much the moment `b` is above `a`, rounded.
fn gap<N: Elementary>(a: &N, b: &N) -> f64 {
    (b.clone() - a.clone()).to_f64().abs()
}

/// The sum of the absolute elements above the diagonal, twice.
fn off_diagonal<N: Elementary>(tensor: &[[N; 3]; 3]) -> f64 {
    let [[_, xy, xz], [_, _, yz], _] = tensor;
    2.0 * (xy.to_f64().abs() + xz.to_f64().abs() + yz.to_f64().abs())
}

/// A bound of the size of the matrix above and below the diagonal, with what the scaling of a tensor took from it.
fn left_off_diagonal<N: Elementary>(tensor: &[[N; 3]; 3]) -> f64 {
    let error = tensor[0][1].error() + tensor[0][2].error() + tensor[1][2].error();
    off_diagonal(tensor) + 2.0 * error + TINY
}

/// The tangent of the smaller angle that makes the element `apq` 0, with this `difference` of the two on the diagonal.
fn tangent<N: Elementary>(apq: &N, difference: N) -> N {
    /// θ² of more may exceed the range of f64, in which balls have their radii.
    const LARGE: f64 = 1e100;
    let (one, twice) = (apq.like(1.0), apq.clone() + apq.clone());
    // Asked before the division, whose quotient may exceed the range of the number.
    if difference.to_f64().abs() > LARGE * twice.to_f64().abs() {
        let root = (difference.clone() * difference.clone() + twice.clone() * twice.clone()).sqrt();
        return twice / if difference.to_f64() >= 0.0 { difference + root } else { difference - root };
    }
    let theta = difference / twice;
    let root = (theta.clone() * theta.clone() + one.clone()).sqrt();
    if theta.to_f64() >= 0.0 { one / (theta + root) } else { -(one / (root - theta)) }
}

/// Turns the axes p and q so that the element between them becomes 0.
fn rotate<N: Elementary>(tensor: &mut [[N; 3]; 3], axes: &mut [[N; 3]; 3], p: usize, q: usize) {
    let one = tensor[p][q].like(1.0);
    let apq = tensor[p][q].clone();
    let tan = tangent(&apq, tensor[q][q].clone() - tensor[p][p].clone());
    let cos = one.clone() / (tan.clone() * tan.clone() + one.clone()).sqrt();
    let sin = tan.clone() * cos.clone();
    let shift = tan * apq;
    tensor[p][p] = tensor[p][p].clone() - shift.clone();
    tensor[q][q] = tensor[q][q].clone() + shift;
    let zero = one.like(0.0);
    (tensor[p][q], tensor[q][p]) = (zero.clone(), zero);
    let turned = |a: &N, b: &N| {
        let product = |x: &N, y: &N| x.clone() * y.clone();
        [product(&cos, a) - product(&sin, b), product(&sin, a) + product(&cos, b)]
    };
    let r = 3 - p - q;
    let [pr, qr] = turned(&tensor[p][r], &tensor[q][r]);
    (tensor[p][r], tensor[r][p]) = (pr.clone(), pr);
    (tensor[q][r], tensor[r][q]) = (qr.clone(), qr);
    let turns = [0, 1, 2].map(|column| turned(&axes[p][column], &axes[q][column]));
    axes[p] = turns.clone().map(|[along_p, _]| along_p);
    axes[q] = turns.map(|[_, along_q]| along_q);
}
