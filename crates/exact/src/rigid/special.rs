//! Motions without elliptic functions, and the kind of any other. A motion of them is known exactly, from the numbers as
//! they were given, or it counts as none of them.

use dynamics::Toss;
use numerics::big::exactly;
use numerics::{Big, Elementary};

use super::given::Given;
use super::quaternion::Quaternion;
use super::tensor::{Symmetric, cross, dot};

/// A motion that is known exactly to be a special one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Special {
    /// About a fixed axis for ever: J ω and ω are parallel. Also rest.
    Spin,
    /// Of a body whose moments about the other two axes of the body frame are equal: a precession and a spin.
    Symmetric(usize),
    /// On the separatrix, towards the axis of the middle moment for ever.
    Separatrix,
}

/// The kind of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Regime {
    /// The body precesses uniformly about the angular momentum and spins uniformly about an axis of symmetry, or it
    /// turns about a principal axis for ever.
    Uniform,
    /// The angular momentum circles the axis of the largest moment.
    AroundLargest,
    /// The angular momentum circles the axis of the smallest moment.
    AroundSmallest,
    /// The angular momentum approaches the axis of the middle moment, once and for ever.
    Separatrix,
}

impl Special {
    /// The special motion that is seen without arithmetic.
    pub(super) fn at_sight(toss: &Toss) -> Option<Self> {
        let (rate, _) = toss.launch.given_rate();
        let moments = toss.body.moments();
        let moving = rate.iter().filter(|part| **part != 0.0).count();
        if moving == 0 || (moving == 1 && moments.is_some()) {
            return Some(Self::Spin);
        }
        let [x, y, z] = moments?;
        [y == z, z == x, x == y].into_iter().position(|is_equal| is_equal).map(Self::Symmetric)
    }

    /// The special motion of a toss, by exact arithmetic.
    pub(super) fn of(toss: &Toss) -> Option<Self> {
        let exact = Exact::new(toss);
        if exact.spins() {
            return Some(Self::Spin);
        }
        (!exact.is_symmetric() && exact.determinant() == Big::ZERO).then_some(Self::Separatrix)
    }
}

impl Regime {
    /// The kind of motion of a toss, by exact arithmetic.
    pub(super) fn of(toss: &Toss) -> Self {
        let exact = Exact::new(toss);
        if exact.spins() || exact.is_symmetric() {
            return Self::Uniform;
        }
        match exact.determinant().partial_cmp(&Big::ZERO) {
            Some(std::cmp::Ordering::Greater) => Self::AroundLargest,
            Some(std::cmp::Ordering::Less) => Self::AroundSmallest,
            _ => Self::Separatrix,
        }
    }
}

/// The turn at a fixed `rate`.
pub(super) fn turned_at<N: Elementary>(rate: &[N; 3], time: &N) -> Quaternion<N> {
    // About an axis of the body frame, the rate may also be 0.
    let is_about = |axis: &usize| (0..3).all(|other| other == *axis || rate[other].bound() == 0.0);
    if let Some(axis) = (0..3).find(is_about) {
        return turned_about(axis, &rate[axis], time);
    }
    let size = dot(rate, rate).sqrt();
    let [sin, cos] = (size.clone() * time.halved()).sine_and_cosine();
    let [x, y, z] = rate.clone().map(|part| part * sin.clone() / size.clone());
    [cos, x, y, z]
}

/// The turn about an axis of the body frame.
fn turned_about<N: Elementary>(axis: usize, rate: &N, time: &N) -> Quaternion<N> {
    let [sin, cos] = (rate.clone() * time.halved()).sine_and_cosine();
    let mut turn = [cos, sin.like(0.0), sin.like(0.0), sin.like(0.0)];
    turn[1 + axis] = sin;
    turn
}

/// The turn of a body that is symmetric about an axis of the body frame is a precession about the angular momentum, at its size over the
/// moment across the axis, after a spin about the axis.
pub(super) fn precession_and_spin<N: Elementary>(
    Given { tensor, rate, time, .. }: &Given<N>,
    axis: usize,
) -> [Quaternion<N>; 2] {
    let moments = tensor.on_diagonal();
    let mut precession = rate.clone();
    precession[axis] = rate[axis].clone() * moments[axis].clone() / moments[(axis + 1) % 3].clone();
    let spin = rate[axis].clone() - precession[axis].clone();
    [turned_at(&precession, time), turned_about(axis, &spin, time)]
}

/// J, ω and m = Jω exactly, but for a common factor of each.
struct Exact {
    tensor: Symmetric<Big>,
    rate: [Big; 3],
    momentum: [Big; 3],
}

impl Exact {
    fn new(toss: &Toss) -> Self {
        let tensor = Symmetric::new(toss.body.inertia().map(exactly));
        let rate = <[f64; 3]>::from(toss.launch.given_rate().0).map(exactly);
        let momentum = tensor.apply(&rate);
        Self { tensor, rate, momentum }
    }

    fn spins(&self) -> bool {
        cross(&self.momentum, &self.rate).iter().all(|part| *part == Big::ZERO)
    }

    /// det(2T J - G²), which has the sign of G² - 2T I₂ with the middle moment I₂.
    fn determinant(&self) -> Big {
        let excess = self.tensor.excess(&self.rate);
        excess.determinant(&excess.cofactors())
    }

    /// Whether two moments are equal: with A = 3J - tr J, whether (tr A²)³ = 54 (det A)².
    fn is_symmetric(&self) -> bool {
        let three = self.tensor.scaled(&exactly(3.0)).less(&self.tensor.trace());
        let (square, determinant) = (three.times(&three).trace(), three.determinant(&three.cofactors()));
        &square * &square * square == exactly(54.0) * &determinant * determinant
    }
}
