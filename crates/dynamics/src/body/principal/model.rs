//! [`ModelBody`], a body whose principal axes are known in balls, also where moments are nearly equal. Proofs of flights
//! about principal axes rest on it.
//!
//! The axes of two moments are known to the rounding of the numbers divided by the gap between the moments. Where this
//! would lose many digits, the axes are computed with more of them. Where the gap is so small that they would be lost
//! there, too, or where there is none, the model has two equal moments: any axes across the third one are then principal
//! axes of the model, and the body differs from it by the gap.

use numerics::{Ball, Big, DoubleDouble, Elementary, WideBall};

use super::{PrincipalAxes, gap, left_off_diagonal};

/// Two moments whose gap is below this part of the largest moment are close: their axes, in double-double, have less than
/// the digits of f64.
pub(super) const CLOSE: f64 = 9.094_947_017_729_282e-13; // 2^-40

/// Binary digits for close moments.
const DIGITS: usize = 320;

/// Two moments whose gap is below this part of the largest moment are equal in the model. With a gap above it, their axes
/// are known to 2^-130.
const EQUAL: f64 = 6.842_277_657_836_021e-49; // 2^-160

/// A body with known principal axes, from which the given body differs by at most `off`. Moments are divided by a power of
/// two near the largest one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelBody {
    /// Moments, the smallest first, and axes.
    pub principal: PrincipalAxes<Ball<DoubleDouble>>,
    /// (I3 - I2)/I1, (I3 - I1)/I2 and (I2 - I1)/I3, none of which is negative. That of equal moments is exactly 0.
    pub couplings: [Ball<DoubleDouble>; 3],
    /// A bound of |J - J'|, where J is the scaled tensor that was given and J' that of the model; 0 if they are the same.
    /// It is more than 0 only if the model has equal moments.
    pub off: f64,
}

impl ModelBody {
    /// The body with these principal axes.
    pub(in crate::body) fn exactly(principal: PrincipalAxes<Ball<DoubleDouble>>) -> Self {
        Self { couplings: couplings(&principal.moments), principal, off: 0.0 }
    }

    /// The model of a scaled `tensor` with close moments.
    ///
    /// Axes that are almost principal ones are made perpendicular in balls, which contain exact axes A then. In these axes
    /// the tensor is diagonal but for what is `left`, whatever the gaps.
    pub(in crate::body) fn of_close_moments(tensor: [[f64; 3]; 3]) -> Self {
        let zero = Big::ZERO.with_precision(DIGITS).value();
        let like = WideBall::new(zero.clone(), &zero);
        let tensor = tensor.map(|row| row.map(|element| like.like(element)));
        let (found, _) = PrincipalAxes::diagonalised(tensor.clone());
        let axes = perpendicular(found.axes.map(|axis| axis.map(|part| WideBall::new(part.midpoint().clone(), &zero))));
        let turned = axes.each_ref().map(|axis| tensor.each_ref().map(|row| dot(row, axis)));
        let diagonal = turned.map(|row| axes.each_ref().map(|axis| dot(axis, &row)));
        let left = left_off_diagonal(&diagonal);
        let moments = [0, 1, 2].map(|index: usize| diagonal[index][index].clone());
        let found = PrincipalAxes { moments, axes };
        let [first, second, third] = found.moments.clone();
        let gaps = [gap(&first, &second), gap(&second, &third)];
        let equal = gaps.map(|gap| gap < EQUAL * third.to_f64());
        let moments = match equal {
            [false, false] => {
                let known = found.enclosing(left);
                let couplings = couplings(&known.moments).each_ref().map(in_double_double);
                return Self { principal: rounded(known), couplings, off: 0.0 };
            }
            [true, true] => [second.clone(), second.clone(), second],
            [true, false] => [first.clone(), first, third],
            [false, true] => [first, second.clone(), second],
        };
        let couplings = couplings(&moments).each_ref().map(in_double_double);
        // The difference of a ball and itself is not exactly 0.
        let none = Ball::new(DoubleDouble::ZERO, 0.0);
        let vanish = [equal[1], equal[0] && equal[1], equal[0]];
        let couplings = [0, 1, 2].map(|index: usize| if vanish[index] { none } else { couplings[index] });
        let apart: f64 = (0..2).filter(|index| equal[*index]).map(|index: usize| gaps[index]).sum();
        let radii: f64 = moments.iter().map(WideBall::error).sum();
        let principal = rounded(PrincipalAxes { moments, axes: found.axes });
        Self { principal, couplings, off: 1.001 * (left + apart + 2.0 * radii) }
    }
}

/// (I3 - I2)/I1, (I3 - I1)/I2 and (I2 - I1)/I3.
fn couplings<N: Elementary>(moments: &[N; 3]) -> [N; 3] {
    let [first, second, third] = moments;
    let differences = [(third, second, first), (third, first, second), (second, first, third)];
    differences.map(|(above, below, moment)| {
        let difference = above.clone() - below.clone();
        // Of a rod about its own axis, the difference is 0, too. A quotient of balls is not exactly 0.
        let vanishes = difference.sign() == 0.0 && difference.error() == 0.0;
        if vanishes || moment.to_f64() == 0.0 { difference } else { difference / moment.clone() }
    })
}

fn dot<N: Elementary>([a, b, c]: &[N; 3], [d, e, f]: &[N; 3]) -> N {
    a.clone() * d.clone() + b.clone() * e.clone() + c.clone() * f.clone()
}

/// Perpendicular unit vectors near those that are almost so, right-handed.
fn perpendicular<N: Elementary>([first, second, _]: [[N; 3]; 3]) -> [[N; 3]; 3] {
    let unit = |vector: [N; 3]| {
        let size = dot(&vector, &vector).sqrt();
        vector.map(|part| part / size.clone())
    };
    let first = unit(first);
    let along = dot(&first, &second);
    let second = unit([0, 1, 2].map(|index: usize| second[index].clone() - along.clone() * first[index].clone()));
    let ([a, b, c], [d, e, f]) = (first.clone(), second.clone());
    let third = [b.clone() * f.clone() - c.clone() * e.clone(), c * d.clone() - a.clone() * f, a * e - b * d];
    [first, second, third]
}

fn rounded(principal: PrincipalAxes<WideBall>) -> PrincipalAxes<Ball<DoubleDouble>> {
    let PrincipalAxes { moments, axes } = principal;
    PrincipalAxes {
        moments: moments.each_ref().map(in_double_double),
        axes: axes.map(|axis| axis.each_ref().map(in_double_double)),
    }
}

/// A ball of double-double that contains this one.
fn in_double_double(ball: &WideBall) -> Ball<DoubleDouble> {
    let like = Ball::new(DoubleDouble::ZERO, 0.0);
    like.like_big(&ball.to_big()).widened(ball.error())
}
