//! Principal axes: the eigenvectors of the inertia tensor, by Jacobi's method in any kind of number. In f64 their
//! errors would grow with the phase of a flight, so they are taken in double-double.

use nalgebra::Vector3;
use numerics::{DoubleDouble, Elementary};

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
    /// Each rotation makes one element off the diagonal 0. After a few sweeps over the three, what is left of them is
    /// below the rounding of the largest moment; with its own error, it bounds the error of the moments, and divided by the
    /// difference of two moments that of their axes.
    pub(super) fn of_tensor(mut tensor: [[N; 3]; 3]) -> Self {
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
                if tensor[p][q].to_f64().abs() > 16.0 * tensor[p][q].error() {
                    rotate(&mut tensor, &mut axes, p, q);
                }
            }
        }
        let error = tensor[0][1].error() + tensor[0][2].error() + tensor[1][2].error();
        let left = off_diagonal(&tensor) + 2.0 * error;
        let found = Self { moments: [0, 1, 2].map(|index: usize| tensor[index][index].clone().widened(left)), axes };
        let Self { moments, axes } = found.sorted();
        let gap = |a: &N, b: &N| (b.clone() - a.clone()).to_f64().abs();
        let nearest = gap(&moments[0], &moments[1]).min(gap(&moments[1], &moments[2]));
        // Of balls, this is infinite for equal moments, whose axes are not determined.
        let turned = 4.0 * left / (nearest - 2.0 * left).max(0.0);
        let turned = if left == 0.0 { 0.0 } else { turned };
        Self { moments, axes: axes.map(|axis| axis.map(|part| part.widened(turned))) }
    }

    /// In the order of the moments, right-handed.
    fn sorted(self) -> Self {
        let Self { moments, axes } = self;
        let mut order = [0, 1, 2];
        order.sort_by(|a: &usize, b: &usize| moments[*a].to_f64().total_cmp(&moments[*b].to_f64()));
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

/// The sum of the absolute elements above the diagonal, twice.
fn off_diagonal<N: Elementary>(tensor: &[[N; 3]; 3]) -> f64 {
    let [[_, xy, xz], [_, _, yz], _] = tensor;
    2.0 * (xy.to_f64().abs() + xz.to_f64().abs() + yz.to_f64().abs())
}

/// The tangent of the smaller angle that makes the element `apq` 0, with this `difference` of the two on the diagonal.
fn tangent<N: Elementary>(apq: &N, difference: N) -> N {
    /// θ² of more may exceed the range of f64, in which balls have their radii.
    const LARGE: f64 = 1e100;
    let (one, twice) = (apq.like(1.0), apq.clone() + apq.clone());
    let theta = difference.clone() / twice.clone();
    let size = theta.to_f64();
    if size.abs() > LARGE {
        let root = (difference.clone() * difference.clone() + twice.clone() * twice.clone()).sqrt();
        return twice / if difference.to_f64() >= 0.0 { difference + root } else { difference - root };
    }
    let root = (theta.clone() * theta.clone() + one.clone()).sqrt();
    if size >= 0.0 { one / (theta + root) } else { -(one / (root - theta)) }
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
