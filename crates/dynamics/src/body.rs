//! Any rigid body: three principal moments of inertia, or a full inertia tensor. A struck coin is not quite a body of
//! revolution, and a book or a satellite is not one at all; what they have in common with the [`Coin`] is this type.
//!
//! # Conventions
//! - The axes x, y, z of the body frame (BF) are the user's. Its z axis is the normal n, whose side up is heads; for a
//!   body without faces, it is the axis whose direction is asked for.
//! - Given by its moments I1, I2, I3, a body has its principal axes along x, y and z, in any order of size. Given by a
//!   tensor J, it has them where J has its eigenvectors. The elements of J off the diagonal are -∫ x y dm and so on.
//! - Principal axes are sorted: the first has the smallest moment. They are right-handed.
//!
//! # Which numbers describe a body
//! No moment is larger than the sum of the other two, because of the integrals ∫ x² dm ≥ 0. Equality holds for plates.
//! A moment of 0 is that of a rod about its own axis, and the other two are then equal. Numbers that break the
//! inequality by no more than their rounding to f64 are accepted, so that the moments 0.1, 0.7, 0.8 of a plate are. A
//! coin with such moments is the flat disc.

mod principal;

use nalgebra::Vector3;
use numerics::scale::{mantissa_and_exponent, power_of_two_scale};
use numerics::{Ball, DoubleDouble, Elementary, UNIT_ROUNDOFF};

pub use principal::{ModelBody, PrincipalAxes, principal_acceleration};

use crate::coin::Coin;
use crate::error::{InputError, require};

/// A body: a coin, which has I1 = I2 exactly, about z, or any other rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a toss is copied, and few of them are at hand at once")]
pub enum Body {
    /// A coin. All that is said of coins holds for it.
    Coin(Coin),
    /// A body with I1 ≠ I2, or with principal axes that are not x, y and z.
    Rigid(RigidBody),
}

/// A rigid body with its principal axes. No constructor makes one that breaks the inequalities of [this module](self).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBody {
    origin: Origin,
    /// Moments (kg m²) and axes in double-double.
    principal: PrincipalAxes<DoubleDouble>,
    /// (I2 - I3)/I1, (I3 - I1)/I2, (I1 - I2)/I3 of the principal moments, by which Euler's equations multiply.
    couplings: [f64; 3],
}

/// What a body was made from.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Origin {
    /// From the moments about x, y, z.
    Moments([f64; 3]),
    /// From a tensor that is not diagonal.
    Tensor([[f64; 3]; 3]),
}

/// The names of the moments about x, y and z, with what limits each of them.
const MOMENTS: [(&str, &str); 3] = [("I1 [kg m²]", "I2 + I3"), ("I2 [kg m²]", "I1 + I3"), ("I3 [kg m²]", "I1 + I2")];

/// The smallest principal moment of a tensor that is not diagonal, relative to the largest.
const THINNEST_TENSOR: f64 = 9.094_947_017_729_282e-13; // 2^-40

impl Body {
    /// A body with the principal moments `moments` = [I1, I2, I3] (kg m²) about the axes x, y and z = n of BF.
    ///
    /// With I1 = I2 it is a [`Coin`]: see [`Body::Coin`]. Fails with [`InputError::OutOfRange`] for a moment that is
    /// not finite, negative, or below 2.3e-308 and not 0; [`InputError::NoBody`] for one that is larger than the sum of
    /// the others.
    pub fn from_moments(moments: [f64; 3]) -> Result<Self, InputError> {
        for ((field, _), moment) in MOMENTS.into_iter().zip(moments) {
            let normal = moment == 0.0 || moment >= f64::MIN_POSITIVE;
            require(field, moment, "finite and >= 0 (0 for a rod, else at least 2.3e-308)", normal)?;
        }
        let largest = (0..3).fold(0, |largest, index| if moments[index] > moments[largest] { index } else { largest });
        let (field, limit) = MOMENTS[largest];
        require(field, moments[largest], "> 0 for the largest moment", moments[largest] > 0.0)?;
        let (excess, allowed) = excess(moments);
        if excess > allowed {
            return Err(InputError::NoBody { field, value: moments[largest], limit, excess });
        }
        if moments[0] == moments[1] {
            return Coin::from_moments(moments[0], moments[2]).map(Self::from);
        }
        Ok(Self::Rigid(RigidBody::of(Origin::Moments(moments))))
    }

    /// A body with the moments `[I1, I3]` of a coin or `[I1, I2, I3]` (kg m²), as files and options list them. Fails as
    /// [`Coin::from_moments`] and [`Body::from_moments`]; [`InputError::Malformed`] for another number of moments.
    pub fn from_listed_moments(moments: &[f64]) -> Result<Self, InputError> {
        match *moments {
            [i1, i3] => Coin::from_moments(i1, i3).map(Self::from),
            [i1, i2, i3] => Self::from_moments([i1, i2, i3]),
            _ => Err(InputError::Malformed {
                field: "moments [kg m²]",
                value: format!("{moments:?}"),
                expected: "I1,I3 or I1,I2,I3",
            }),
        }
    }

    /// A body with the elements `[Jxx, Jyy, Jzz, Jxy, Jxz, Jyz]` (kg m²) of its inertia tensor; see
    /// [`Body::from_tensor`].
    pub fn from_inertia([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> Result<Self, InputError> {
        Self::from_tensor([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    }

    /// A body with the inertia `tensor` J (kg m²) about its centre of mass, row by row in the axes of BF.
    ///
    /// A diagonal tensor is the same as its moments. A rod that is not along an axis can't be given in this way,
    /// because its moment 0 can't be told from rounding. Fails with [`InputError::OutOfRange`] for an element that is
    /// not finite, a tensor that is 0 or subnormal, or one whose smallest principal moment is not above 1e-12 of the
    /// largest; [`InputError::Malformed`] for a tensor that is not symmetric; [`InputError::NoBody`] for principal
    /// moments that break the inequality.
    pub fn from_tensor(tensor: [[f64; 3]; 3]) -> Result<Self, InputError> {
        let elements = tensor.iter().flatten();
        let finite = elements.clone().all(|element| element.is_finite());
        let largest = elements.fold(0.0_f64, |most, element| most.max(element.abs()));
        let size = if finite { largest } else { f64::NAN };
        let normal = (f64::MIN_POSITIVE..=f64::MAX / 4.0).contains(&largest);
        require("inertia tensor (largest element) [kg m²]", size, "finite, from 2.3e-308 to 4.4e307", normal)?;
        for (field, row, column) in [("Jxy [kg m²]", 0, 1), ("Jxz [kg m²]", 0, 2), ("Jyz [kg m²]", 1, 2)] {
            let [upper, lower] = [tensor[row][column], tensor[column][row]];
            if upper != lower {
                let value = format!("{upper:?}, but {lower:?} below the diagonal");
                return Err(InputError::Malformed { field, value, expected: "a symmetric tensor" });
            }
        }
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = tensor;
        if [xy, xz, yz] == [0.0; 3] {
            return Self::from_moments([xx, yy, zz]);
        }
        let body = RigidBody::of(Origin::Tensor(tensor));
        let [least, _, most] = body.principal_moments();
        let thick = least > THINNEST_TENSOR * most;
        require("inertia tensor (smallest principal moment) [kg m²]", least, "> 1e-12 of the largest one", thick)?;
        let (excess, _) = excess(body.principal_moments());
        // Each element is rounded, and the largest moment is at most three times the largest element.
        if excess > 8.0 * UNIT_ROUNDOFF * most {
            let field = "inertia tensor (largest principal moment) [kg m²]";
            return Err(InputError::NoBody { field, value: most, limit: "the sum of the other two", excess });
        }
        Ok(Self::Rigid(body))
    }

    /// The coin that this body is, if it is one.
    pub fn coin(&self) -> Option<Coin> {
        if let Self::Coin(coin) = self { Some(*coin) } else { None }
    }

    /// The body with its principal axes, also that of a coin.
    pub fn rigid(&self) -> RigidBody {
        match self {
            Self::Coin(coin) => RigidBody::of(Origin::Moments([coin.i1(), coin.i1(), coin.i3()])),
            Self::Rigid(body) => *body,
        }
    }

    /// The moments I1, I2, I3 about x, y and z (kg m²), if these are its principal axes.
    pub fn moments(&self) -> Option<[f64; 3]> {
        match self {
            Self::Coin(coin) => Some([coin.i1(), coin.i1(), coin.i3()]),
            Self::Rigid(RigidBody { origin: Origin::Moments(moments), .. }) => Some(*moments),
            Self::Rigid(_) => None,
        }
    }

    /// The inertia tensor (kg m²), row by row in the axes of BF.
    pub fn tensor(&self) -> [[f64; 3]; 3] {
        let diagonal = |[x, y, z]: [f64; 3]| [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]];
        match self {
            Self::Coin(coin) => diagonal([coin.i1(), coin.i1(), coin.i3()]),
            Self::Rigid(body) => match body.origin {
                Origin::Moments(moments) => diagonal(moments),
                Origin::Tensor(tensor) => tensor,
            },
        }
    }

    /// The elements `[Jxx, Jyy, Jzz, Jxy, Jxz, Jyz]` of the inertia tensor (kg m²).
    pub fn inertia(&self) -> [f64; 6] {
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] = self.tensor();
        [xx, yy, zz, xy, xz, yz]
    }

    /// The principal moments (kg m²), the smallest first.
    pub fn principal_moments(&self) -> [f64; 3] {
        self.rigid().principal_moments()
    }

    /// Angular momentum (kg m²/s, BF) at the body rate `rate` (rad/s, BF). Its size is conserved.
    pub fn angular_momentum(&self, rate: &Vector3<f64>) -> Vector3<f64> {
        let [x, y, z] = self.tensor().map(|row| Vector3::from(row).dot(rate));
        Vector3::new(x, y, z)
    }

    /// Kinetic energy of the rotation (J) at the body rate `rate` (rad/s, BF). It is conserved.
    pub fn kinetic_energy(&self, rate: &Vector3<f64>) -> f64 {
        0.5 * rate.dot(&self.angular_momentum(rate))
    }
}

impl RigidBody {
    fn of(origin: Origin) -> Self {
        let principal = match &origin {
            Origin::Moments(_) => principal_axes(&origin, &DoubleDouble::ZERO),
            Origin::Tensor(tensor) => {
                let (scaled, exponent) = in_own_unit(tensor);
                let found = principal_axes(&Origin::Tensor(scaled), &DoubleDouble::ZERO);
                if found.has_close_moments() {
                    return Self::of_model(origin, &ModelBody::of_close_moments(scaled), exponent);
                }
                found.times_power_of_two(exponent)
            }
        };
        let [a, b, c] = principal.moments;
        // A rod has a moment of 0, and the difference is 0 too: no torque acts about its own axis.
        let coupling = |above: DoubleDouble, below: DoubleDouble| {
            if below.hi() > 0.0 {
                let (_, exponent) = mantissa_and_exponent(below.hi());
                let [above, below] = [above, below].map(|part| part.times_power_of_two(-exponent));
                (above / below).hi()
            } else {
                0.0
            }
        };
        let couplings = [coupling(b - c, a), coupling(c - a, b), coupling(a - b, c)];
        Self { origin, principal, couplings }
    }

    /// The body whose tensor was multiplied by 2^-`exponent` before its `model` was made.
    fn of_model(origin: Origin, model: &ModelBody, exponent: i32) -> Self {
        let PrincipalAxes { moments, axes } = &model.principal;
        let [moments, a, b, c] =
            [moments, &axes[0], &axes[1], &axes[2]].map(|balls| balls.map(|ball| *ball.midpoint()));
        let principal = PrincipalAxes { moments, axes: [a, b, c] }.times_power_of_two(exponent);
        let [a, b, c] = model.couplings.map(|coupling| coupling.to_f64());
        Self { origin, principal, couplings: [-a, b, -c] }
    }

    /// The principal moments (kg m²), the smallest first.
    pub fn principal_moments(&self) -> [f64; 3] {
        self.principal.moments.map(DoubleDouble::hi)
    }

    /// Principal moments and axes in double-double.
    pub fn principal(&self) -> &PrincipalAxes<DoubleDouble> {
        &self.principal
    }

    /// The body with known principal axes that is nearest to this one, for proofs in these axes.
    pub fn model(&self) -> ModelBody {
        match &self.origin {
            Origin::Tensor(tensor) if self.principal.has_close_moments() => {
                ModelBody::of_close_moments(in_own_unit(tensor).0)
            }
            _ => ModelBody::exactly(self.scaled_principal(&Ball::new(DoubleDouble::ZERO, 0.0))),
        }
    }

    /// Principal moments and axes in numbers like `like`, divided by a power of two near the largest moment. They are
    /// exact for a body that was given by its moments. Balls of the axes of a tensor are wide for nearly equal moments, and
    /// infinite for moments that can't be told from equal ones: see [`RigidBody::model`].
    pub fn scaled_principal<N: Elementary>(&self, like: &N) -> PrincipalAxes<N> {
        let scale = power_of_two_scale(self.principal.moments[2].hi());
        let scaled = match self.origin {
            Origin::Moments(moments) => Origin::Moments(moments.map(|moment| moment / scale)),
            Origin::Tensor(tensor) => Origin::Tensor(tensor.map(|row| row.map(|element| element / scale))),
        };
        principal_axes(&scaled, like)
    }

    /// Euler's equations: ω' (rad/s², BF) at the body rate `rate` (rad/s, BF). It does not depend on the attitude.
    ///
    /// In principal axes ω1' = (I2 - I3)/I1 ω2 ω3, and so on.
    pub fn acceleration(&self, rate: &Vector3<f64>) -> Vector3<f64> {
        let rate = self.principal.to_principal(rate);
        self.principal.from_principal(principal_acceleration(self.couplings, rate))
    }

    /// (I2 - I3)/I1, (I3 - I1)/I2 and (I1 - I2)/I3 of the sorted principal moments, by which Euler's equations in
    /// principal axes multiply. They are between -1 and 1 if no moment is larger than the sum of the other two. Moments
    /// that break this by their rounding are accepted, so that the first can be as low as -2 for a plate as thin as
    /// rounding, and the second above 1 by a rounding.
    pub fn couplings(&self) -> [f64; 3] {
        self.couplings
    }

    /// How many times as large as at launch |ω| can become: at most √2, and √3 for a plate as thin as rounding.
    ///
    /// |ω|² - pr ω2², with p and r the first and the last of the [couplings](RigidBody::couplings), does not change: see
    /// [`phase`](crate::phase).
    pub fn largest_growth_of_rate(&self) -> f64 {
        let [p, _, r] = self.couplings;
        (1.0 + (p * r).abs().max(1.0)).sqrt()
    }
}

/// The coin as a body, with all that it was made from.
impl From<Coin> for Body {
    #[inline]
    fn from(coin: Coin) -> Self {
        Self::Coin(coin)
    }
}

/// Principal moments and axes in numbers like `like`.
fn principal_axes<N: Elementary>(origin: &Origin, like: &N) -> PrincipalAxes<N> {
    match origin {
        Origin::Moments(moments) => PrincipalAxes::of_moments(*moments, like),
        Origin::Tensor(tensor) => PrincipalAxes::of_tensor(tensor.map(|row| row.map(|element| like.like(element)))),
    }
}

/// A tensor that is multiplied by a power of two, so that its largest element is between 1 and 2, and the exponent of what
/// it was divided by.
fn in_own_unit(tensor: &[[f64; 3]; 3]) -> ([[f64; 3]; 3], i32) {
    let scale = power_of_two_scale(tensor.iter().flatten().fold(0.0, |most, element| element.abs().max(most)));
    (tensor.map(|row| row.map(|element| element / scale)), mantissa_and_exponent(scale).1)
}

/// Whether the largest moment is above the sum of the others by no more than their rounding.
pub(crate) fn is_rounding(moments: [f64; 3]) -> bool {
    let (excess, allowed) = excess(moments);
    excess <= allowed
}

/// By how much the largest moment is above the sum of the others, and how much of it the rounding of the three
/// explains.
///
/// Of a body so thin that the smallest moment is below that rounding, nothing is excused: it would not move like a
/// body.
fn excess(mut moments: [f64; 3]) -> (f64, f64) {
    moments.sort_unstable_by(f64::total_cmp);
    let [least, middle, largest] = moments;
    // The difference of the larger ones is exact where it matters: if they are within a factor of two.
    let excess = (largest - middle) - least;
    (excess, least.min(UNIT_ROUNDOFF * (0.25 * least + 0.25 * middle + 0.25 * largest) * 4.0))
}

#[cfg(test)]
mod tests;
