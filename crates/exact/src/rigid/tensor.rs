//! Functions of the inertia tensor J: the symmetric matrices that commute with J. Products of them are symmetric again.
//! Of a body given by its moments they are diagonal, and no difference of two moments loses a digit.

use numerics::Elementary;

/// A symmetric matrix.
#[derive(Clone, Debug)]
pub(super) struct Symmetric<N> {
    /// xx, yy, zz.
    on: [N; 3],
    /// yz, zx, xy; none of a diagonal matrix.
    off: Option<[N; 3]>,
}

fn times<N: Elementary>(a: &N, b: &N) -> N {
    a.clone() * b.clone()
}

/// The scalar product of two vectors.
pub(super) fn dot<N: Elementary>(a: &[N; 3], b: &[N; 3]) -> N {
    times(&a[0], &b[0]) + times(&a[1], &b[1]) + times(&a[2], &b[2])
}

/// The vector product.
pub(super) fn cross<N: Elementary>(a: &[N; 3], b: &[N; 3]) -> [N; 3] {
    each(|_, j, k| times(&a[j], &b[k]) - times(&a[k], &b[j]))
}

/// What `part` makes of each cyclic order of the indices 0, 1, 2.
fn each<N>(part: impl Fn(usize, usize, usize) -> N) -> [N; 3] {
    [part(0, 1, 2), part(1, 2, 0), part(2, 0, 1)]
}

impl<N> Symmetric<N> {
    /// The matrix with the elements xx, yy, zz, xy, xz, yz.
    pub(super) fn new([xx, yy, zz, xy, xz, yz]: [N; 6]) -> Self {
        Self { on: [xx, yy, zz], off: Some([yz, xz, xy]) }
    }

    pub(super) fn diagonal(on: [N; 3]) -> Self {
        Self { on, off: None }
    }

    pub(super) fn is_diagonal(&self) -> bool {
        self.off.is_none()
    }

    /// The elements xx, yy, zz.
    pub(super) fn on_diagonal(&self) -> &[N; 3] {
        &self.on
    }

    /// The same matrix of other numbers.
    pub(super) fn map<M>(&self, number: impl Fn(&N) -> M) -> Symmetric<M> {
        let three = |part: &[N; 3]| part.each_ref().map(&number);
        Symmetric { on: three(&self.on), off: self.off.as_ref().map(three) }
    }
}

impl<N: Elementary> Symmetric<N> {
    /// What `part` makes of each element of this matrix and of `other`, which are functions of one tensor.
    fn with(&self, other: &Self, part: impl Fn(&N, &N) -> N) -> Self {
        let three = |a: &[N; 3], b: &[N; 3]| each(|i, _, _| part(&a[i], &b[i]));
        let off = self.off.as_ref().zip(other.off.as_ref()).map(|(a, b)| three(a, b));
        Self { on: three(&self.on, &other.on), off }
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        self.with(other, |a, b| a.clone() + b.clone())
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        self.with(other, |a, b| a.clone() - b.clone())
    }

    /// The matrix less `value` × 1.
    pub(super) fn less(&self, value: &N) -> Self {
        Self { on: each(|i, _, _| self.on[i].clone() - value.clone()), off: self.off.clone() }
    }

    pub(super) fn scaled(&self, factor: &N) -> Self {
        self.map(|part| times(part, factor))
    }

    /// The product with a matrix that commutes with this one.
    pub(super) fn times(&self, other: &Self) -> Self {
        let along = |i: usize| times(&self.on[i], &other.on[i]);
        let Some((a, b)) = self.off.as_ref().zip(other.off.as_ref()) else {
            return Self::diagonal(each(|i, _, _| along(i)));
        };
        let on = each(|i, j, k| along(i) + times(&a[j], &b[j]) + times(&a[k], &b[k]));
        let off = each(|i, j, k| times(&a[k], &b[j]) + times(&self.on[j], &b[i]) + times(&a[i], &other.on[k]));
        Self { on, off: Some(off) }
    }

    /// The cofactors: λ₂λ₃, λ₃λ₁, λ₁λ₂ of the eigenvalues λ.
    pub(super) fn cofactors(&self) -> Self {
        let on = each(|_, j, k| times(&self.on[j], &self.on[k]));
        let Some(off) = &self.off else { return Self::diagonal(on) };
        let minors = each(|i, j, k| times(&off[j], &off[k]) - times(&self.on[i], &off[i]));
        Self { on: each(|i, _, _| on[i].clone() - times(&off[i], &off[i])), off: Some(minors) }
    }

    /// The sum of the eigenvalues.
    pub(super) fn trace(&self) -> N {
        let [x, y, z] = self.on.clone();
        x + y + z
    }

    /// The product of the eigenvalues, from the [`cofactors`](Self::cofactors).
    pub(super) fn determinant(&self, cofactors: &Self) -> N {
        let first = times(&self.on[0], &cofactors.on[0]);
        let Some((a, b)) = self.off.as_ref().zip(cofactors.off.as_ref()) else { return first };
        first + times(&a[2], &b[2]) + times(&a[1], &b[1])
    }

    /// The product with a vector.
    pub(super) fn apply(&self, vector: &[N; 3]) -> [N; 3] {
        let along = |i: usize| times(&self.on[i], &vector[i]);
        let Some(off) = &self.off else { return each(|i, _, _| along(i)) };
        each(|i, j, k| along(i) + times(&off[k], &vector[j]) + times(&off[j], &vector[k]))
    }

    /// By how much the element j of a diagonal matrix is above the element i.
    fn gap(&self, i: usize, j: usize) -> N {
        self.on[j].clone() - self.on[i].clone()
    }

    /// Of J: the function with the eigenvalues (Iⱼ - Iᵢ) yₖ + (Iₖ - Iᵢ) yⱼ, for the eigenvalues y of the function `of`.
    ///
    /// With yⱼ + yₖ = tr y - yᵢ and Iⱼ yₖ + Iₖ yⱼ = 2 Iᵢ yᵢ - Iᵢ tr y - yᵢ tr I + tr I tr y - tr (I y), this is
    /// 3 I y - 2 I tr y - y tr I + (tr I tr y - tr (I y)).
    pub(super) fn differences(&self, of: &Self) -> Self {
        if self.off.is_none() {
            return Self::diagonal(each(|i, j, k| {
                times(&self.gap(i, j), &of.on[k]) + times(&self.gap(i, k), &of.on[j])
            }));
        }
        let ([own, other], product) = ([self.trace(), of.trace()], self.times(of));
        let twice = other.clone() + other.clone();
        let constant = times(&own, &other) - product.trace();
        product.scaled(&own.like(3.0)).minus(&self.scaled(&twice)).minus(&of.scaled(&own)).less(&-constant)
    }

    /// Of J: the function with the eigenvalues (Iⱼ - Iᵢ)(Iₖ - Iᵢ), which is 3 I² - 2 I tr I + the sum of the cofactors.
    pub(super) fn gaps(&self) -> Self {
        if self.off.is_none() {
            return Self::diagonal(each(|i, j, k| times(&self.gap(i, j), &self.gap(i, k))));
        }
        let trace = self.trace();
        let twice = trace.clone() + trace.clone();
        let constant = self.cofactors().trace();
        self.times(self).scaled(&trace.like(3.0)).minus(&self.scaled(&twice)).less(&-constant)
    }

    /// Of J: 2T J - G² for the rate ω, with 2T = ω·Jω and G = |Jω|. Its eigenvalues are Σ Iₗ (Iᵢ - Iₗ) ωₗ² along the axes.
    pub(super) fn excess(&self, rate: &[N; 3]) -> Self {
        let momentum = self.apply(rate);
        if self.off.is_none() {
            let term = |i: usize, l: usize| times(&self.gap(l, i), &times(&momentum[l], &rate[l]));
            return Self::diagonal(each(|i, j, k| term(i, j) + term(i, k)));
        }
        self.scaled(&dot(&momentum, rate)).less(&dot(&momentum, &momentum))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The matrix with these eigenvalues, and the vector with these components along the axes.
    type Frame = (fn([f64; 3]) -> Symmetric<f64>, fn([f64; 3]) -> [f64; 3]);

    /// The cosine and the sine of the angle by which the axes of all matrices are turned, first about z and then about x.
    const TURN: [f64; 2] = [0.6, 0.8];

    fn turned([x, y, z]: [f64; 3]) -> Symmetric<f64> {
        let [c, s] = TURN;
        let [xx, yy, xy] = [c * c * x + s * s * y, s * s * x + c * c * y, c * s * (x - y)];
        Symmetric::new([xx, c * c * yy + s * s * z, s * s * yy + c * c * z, c * xy, s * xy, c * s * (yy - z)])
    }

    fn turned_vector([x, y, z]: [f64; 3]) -> [f64; 3] {
        let [c, s] = TURN;
        let [x, y] = [c * x - s * y, s * x + c * y];
        [x, c * y - s * z, s * y + c * z]
    }

    fn size(matrix: &Symmetric<f64>) -> f64 {
        matrix.on.into_iter().chain(matrix.off.unwrap_or_default()).map(f64::abs).fold(0.0, f64::max)
    }

    /// Along the axes of the body and turned, a function has the same eigenvalues.
    #[test]
    fn functions_have_the_eigenvalues_that_they_are_named_for() {
        let ([a, b, c], [x, y, z], rate) = ([1.0, 1.5, 2.25], [0.75, -0.5, 1.25], [0.5, -1.0, 0.25]);
        let frames: [Frame; 2] = [(turned, turned_vector), (Symmetric::diagonal, |vector| vector)];
        for (matrix, vector) in frames {
            let assert_near = |found: &Symmetric<f64>, eigenvalues: [f64; 3]| {
                assert!(size(&found.minus(&matrix(eigenvalues))) < 1e-14, "{found:?} {eigenvalues:?}");
            };
            let (tensor, other) = (matrix([a, b, c]), matrix([x, y, z]));
            assert_near(&tensor.plus(&other), [a + x, b + y, c + z]);
            assert_near(&tensor.less(&x), [a - x, b - x, c - x]);
            assert_near(&tensor.scaled(&x), [a * x, b * x, c * x]);
            assert_near(&tensor.times(&other), [a * x, b * y, c * z]);
            assert_near(&tensor.cofactors(), [b * c, c * a, a * b]);
            assert!((tensor.trace() - (a + b + c)).abs() < 1e-14);
            assert!((tensor.determinant(&tensor.cofactors()) - a * b * c).abs() < 1e-14);
            assert_near(&tensor.gaps(), [(b - a) * (c - a), (c - b) * (a - b), (a - c) * (b - c)]);
            let differences = [(b - a) * z + (c - a) * y, (c - b) * x + (a - b) * z, (a - c) * y + (b - c) * x];
            assert_near(&tensor.differences(&other), differences);
            let momentum = [a * rate[0], b * rate[1], c * rate[2]];
            let applied = tensor.apply(&vector(rate));
            assert!(applied.iter().zip(vector(momentum)).all(|(one, two)| (one - two).abs() < 1e-14));
            let [energy, squared] = [dot(&momentum, &rate), dot(&momentum, &momentum)];
            assert_near(&tensor.excess(&vector(rate)), [a, b, c].map(|moment| energy * moment - squared));
        }
    }
}
