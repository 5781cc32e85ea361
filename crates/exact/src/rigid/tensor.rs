//! Functions of the inertia tensor J: the symmetric matrices that commute with J. Products of them are symmetric again.

use numerics::Elementary;

/// A symmetric matrix: xx, yy, zz, xy, xz, yz.
#[derive(Clone, Debug)]
pub(super) struct Symmetric<N>(pub(super) [N; 6]);

/// The elements of the rows of a symmetric matrix.
const ROWS: [[usize; 3]; 3] = [[0, 3, 4], [3, 1, 5], [4, 5, 2]];

/// The row and the column of each element.
const PLACES: [[usize; 2]; 6] = [[0, 0], [1, 1], [2, 2], [0, 1], [0, 2], [1, 2]];

fn times<N: Elementary>(a: &N, b: &N) -> N {
    a.clone() * b.clone()
}

/// The scalar product of two vectors.
pub(super) fn dot<N: Elementary>(a: &[N; 3], b: &[N; 3]) -> N {
    times(&a[0], &b[0]) + times(&a[1], &b[1]) + times(&a[2], &b[2])
}

/// The vector product.
pub(super) fn cross<N: Elementary>(a: &[N; 3], b: &[N; 3]) -> [N; 3] {
    [[1, 2], [2, 0], [0, 1]].map(|[i, j]: [usize; 2]| times(&a[i], &b[j]) - times(&a[j], &b[i]))
}

impl<N: Elementary> Symmetric<N> {
    fn each(part: impl Fn(usize) -> N) -> Self {
        Self(std::array::from_fn(part))
    }

    /// The matrix `value` × 1.
    pub(super) fn multiple(value: &N) -> Self {
        Self::each(|i| if i < 3 { value.clone() } else { value.like(0.0) })
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        Self::each(|i| self.0[i].clone() + other.0[i].clone())
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        Self::each(|i| self.0[i].clone() - other.0[i].clone())
    }

    /// The matrix less `value` × 1.
    pub(super) fn less(&self, value: &N) -> Self {
        Self::each(|i| if i < 3 { self.0[i].clone() - value.clone() } else { self.0[i].clone() })
    }

    /// The product with a matrix that commutes with this one.
    pub(super) fn times(&self, other: &Self) -> Self {
        Self(PLACES.map(|[row, column]| {
            let [a, b] = [ROWS[row], ROWS[column]];
            times(&self.0[a[0]], &other.0[b[0]])
                + times(&self.0[a[1]], &other.0[b[1]])
                + times(&self.0[a[2]], &other.0[b[2]])
        }))
    }

    pub(super) fn scaled(&self, factor: &N) -> Self {
        Self::each(|i| times(&self.0[i], factor))
    }

    /// The cofactors: λ₂λ₃, λ₃λ₁, λ₁λ₂ of the eigenvalues λ.
    pub(super) fn cofactors(&self) -> Self {
        let minor =
            |[a, b]: [usize; 2], [c, d]: [usize; 2]| times(&self.0[a], &self.0[b]) - times(&self.0[c], &self.0[d]);
        Self([
            minor([1, 2], [5, 5]),
            minor([0, 2], [4, 4]),
            minor([0, 1], [3, 3]),
            minor([4, 5], [3, 2]),
            minor([3, 5], [4, 1]),
            minor([3, 4], [0, 5]),
        ])
    }

    /// The sum of the eigenvalues.
    pub(super) fn trace(&self) -> N {
        let [x, y, z, ..] = self.0.clone();
        x + y + z
    }

    /// The product of the eigenvalues, from the [`cofactors`](Self::cofactors).
    pub(super) fn determinant(&self, cofactors: &Self) -> N {
        let part = |i: usize| times(&self.0[i], &cofactors.0[i]);
        part(0) + part(3) + part(4)
    }

    /// The product with a vector.
    pub(super) fn apply(&self, vector: &[N; 3]) -> [N; 3] {
        ROWS.map(|row| dot(&row.map(|place| self.0[place].clone()), vector))
    }

    /// Of J: the function with the eigenvalues (Iⱼ - Iᵢ) yₖ + (Iₖ - Iᵢ) yⱼ, for the eigenvalues y of the function `of`.
    ///
    /// With yⱼ + yₖ = tr y - yᵢ and Iⱼ yₖ + Iₖ yⱼ = 2 Iᵢ yᵢ - Iᵢ tr y - yᵢ tr I + tr I tr y - tr (I y), this is
    /// 3 I y - 2 I tr y - y tr I + (tr I tr y - tr (I y)).
    pub(super) fn differences(&self, of: &Self) -> Self {
        let ([own, other], product) = ([self.trace(), of.trace()], self.times(of));
        let twice = other.clone() + other.clone();
        let constant = times(&own, &other) - product.trace();
        product.scaled(&own.like(3.0)).minus(&self.scaled(&twice)).minus(&of.scaled(&own)).less(&-constant)
    }

    /// Of J: the function with the eigenvalues (Iⱼ - Iᵢ)(Iₖ - Iᵢ), which is 3 I² - 2 I tr I + the sum of the cofactors.
    pub(super) fn gaps(&self) -> Self {
        let trace = self.trace();
        let twice = trace.clone() + trace.clone();
        let constant = self.cofactors().trace();
        self.times(self).scaled(&trace.like(3.0)).minus(&self.scaled(&twice)).less(&-constant)
    }

    /// Of J: 2T J - G² for the rate ω, with 2T = ω·Jω and G = |Jω|.
    pub(super) fn excess(&self, rate: &[N; 3]) -> Self {
        let momentum = self.apply(rate);
        self.scaled(&dot(&momentum, rate)).less(&dot(&momentum, &momentum))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Functions of one diagonal matrix, turned about an axis that is none of its own by the cosine 0.6.
    fn turned([x, y, z]: [f64; 3]) -> Symmetric<f64> {
        let ([c, s], one) = ([0.6, 0.8], Symmetric([x, y, z, 0.0, 0.0, 0.0]));
        let [xx, yy, zz, ..] = one.0;
        let about_z = [c * c * xx + s * s * yy, s * s * xx + c * c * yy, zz, c * s * (xx - yy), 0.0, 0.0];
        let [xx, yy, zz, xy, ..] = about_z;
        Symmetric([xx, c * c * yy + s * s * zz, s * s * yy + c * c * zz, c * xy, s * xy, c * s * (yy - zz)])
    }

    fn assert_near(found: &Symmetric<f64>, eigenvalues: [f64; 3]) {
        let expected = turned(eigenvalues);
        let off = found.minus(&expected).0.into_iter().map(f64::abs).fold(0.0, f64::max);
        assert!(off < 1e-14, "{found:?} {expected:?}");
    }

    #[test]
    fn functions_have_the_eigenvalues_that_they_are_named_for() {
        let ([a, b, c], [x, y, z]) = ([1.0, 1.5, 2.25], [0.75, -0.5, 1.25]);
        let (tensor, other) = (turned([a, b, c]), turned([x, y, z]));
        assert_near(&tensor.times(&other), [a * x, b * y, c * z]);
        assert_near(&tensor.cofactors(), [b * c, c * a, a * b]);
        assert!((tensor.determinant(&tensor.cofactors()) - a * b * c).abs() < 1e-14);
        assert_near(&tensor.gaps(), [(b - a) * (c - a), (c - b) * (a - b), (a - c) * (b - c)]);
        let differences = [(b - a) * z + (c - a) * y, (c - b) * x + (a - b) * z, (a - c) * y + (b - c) * x];
        assert_near(&tensor.differences(&other), differences);
        let rate = [0.5, -1.0, 0.25];
        let momentum = tensor.apply(&rate);
        let [energy, squared] = [dot(&momentum, &rate), dot(&momentum, &momentum)];
        assert_near(&tensor.excess(&rate), [a, b, c].map(|moment| energy * moment - squared));
    }
}
