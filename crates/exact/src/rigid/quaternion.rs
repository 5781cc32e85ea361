//! Quaternions of any norm in any kind of number. Their norms cancel when a vector is turned by them and divided by
//! |Q|², so that no root and no division rounds on the way.

use numerics::Elementary;

/// (w, x, y, z).
pub(super) type Quaternion<N> = [N; 4];

/// The product a ⊗ b.
pub(super) fn product<N: Elementary>(a: &Quaternion<N>, b: &Quaternion<N>) -> Quaternion<N> {
    let term = |i: usize, j: usize| a[i].clone() * b[j].clone();
    [
        term(0, 0) - term(1, 1) - term(2, 2) - term(3, 3),
        term(0, 1) + term(1, 0) + term(2, 3) - term(3, 2),
        term(0, 2) - term(1, 3) + term(2, 0) + term(3, 1),
        term(0, 3) + term(1, 2) - term(2, 1) + term(3, 0),
    ]
}

/// The conjugate, which is the inverse but for the norm.
pub(super) fn conjugate<N: Elementary>([w, x, y, z]: &Quaternion<N>) -> Quaternion<N> {
    [w.clone(), -x.clone(), -y.clone(), -z.clone()]
}

/// |Q|².
pub(super) fn norm_squared<N: Elementary>([w, x, y, z]: &Quaternion<N>) -> N {
    let square = |part: &N| part.clone() * part.clone();
    square(w) + square(x) + square(y) + square(z)
}

/// The vector turned by Q, times |Q|².
pub(super) fn turned<N: Elementary>(q: &Quaternion<N>, vector: &[N; 3]) -> [N; 3] {
    let [x, y, z] = vector.clone();
    let [_, x, y, z] = product(&product(q, &[q[0].like(0.0), x, y, z]), &conjugate(q));
    [x, y, z]
}

/// ẑ turned by Q, times |Q|².
pub(super) fn turned_normal<N: Elementary>([w, x, y, z]: &Quaternion<N>) -> [N; 3] {
    let term = |a: &N, b: &N| a.clone() * b.clone();
    let twice = |half: N| half.clone() + half;
    [twice(term(x, z) + term(w, y)), twice(term(y, z) - term(w, x)), term(w, w) + term(z, z) - term(x, x) - term(y, y)]
}
