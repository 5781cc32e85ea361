//! The three Euler angles of any rigid body, with three rates by Euler's equations in principal axes.
//!
//! The angles z-x-z of an attitude are singular where the third axis of the body is along that of the frame. The two
//! frames differ in both axes:
//!
//! - [`Frame::Momentum`]: the frame's third axis is along the angular momentum m, and the body's third axis is a
//!   principal axis, that of the smallest or of the largest moment. Of a coin the angle β between the two is constant;
//!   here m moves on a curve that crosses the plane of these two axes where it comes nearest to either, at
//!   m1² : m3² = P3 : P1 with P1 = α12 m2² + α13 m3², P3 = α13 m1² + α23 m2² and α_ij = 1/I_i - 1/I_j. The larger
//!   component belongs to one axis, and from the other one m always stays 45° away: its β is between 45° and 135°, for
//!   every body and every launch.
//! - [`Frame::Vertical`]: the frame is the laboratory's and the body's third axis is n, as in the paper. A launch may
//!   start with n along the vertical, on the regular solution
//!
//!   ```text
//!   u = α' cos β = ½ (ωz + (ωx ωy' - ωy ωx')/(ωx² + ωy²)),   γ = atan2(-ωy, ωx)                at sin β = 0
//!   ```
//!
//!   which follows from D = α' sin β = 0 by the rule of l'Hôpital. A return to the vertical is a typed error.
//!
//! Along the momentum the angles of a body that turns about one axis turn evenly. An adaptive scheme has no error to
//! estimate there, and its steps would grow until it is unstable. DOP853 is stable for y' = i y up to steps of 5.9 rad, and
//! disturbances of a plate oscillate up to twice as fast as it turns. No step therefore turns the body by more than 2 rad,
//! see "Runge-Kutta integration" in `DESIGN.md`.

use std::f64::consts::FRAC_PI_2;

use dynamics::body::principal_acceleration;
use dynamics::integrate::OdeSystem;
use dynamics::{
    Attitude, EulerAngles, Flight, Formulation, Frame, Landing, Singularity, SolveError, State, Stepping, Toss, Vector3,
};
use nalgebra::SVector;

use crate::angles::Kinematics;
use crate::initial::Pole;
use crate::passes::Passes;

/// The largest change of the rate across n, by that rate, in the unit of a [`Flight`](dynamics::Flight), with which a
/// flight may start at the vertical. Above it the regular solution has a rate α' that no digit of the angles can follow.
/// It happens to tensors alone, whose rate along n is not steady.
const FASTEST_START: f64 = 1e6;

/// The flight of `toss` in the frame of `formulation`.
pub(crate) fn land(
    toss: &Toss,
    stepping: &Stepping,
    formulation: Formulation,
) -> Result<(Landing, Passes), SolveError> {
    let flight = Flight::new(toss)?;
    let launched = toss.launch.attitude();
    let start = match formulation.frame() {
        Frame::Momentum => Start::along_momentum(toss, &flight),
        Frame::Vertical => Start::vertical(toss, &flight)?,
    };
    let EulerAngles { alpha, beta, gamma } = start.angles;
    let [first, second, third] = flight.rate.into();
    let first = SVector::from([alpha, beta, gamma, first, second, third]);
    let (end, work) = flight.integrate(&start.system, first, stepping)?;
    let attitude = EulerAngles { alpha: end[0], beta: end[1], gamma: end[2] }.attitude();
    let attitude = match formulation.frame() {
        Frame::Vertical => attitude,
        Frame::Momentum => {
            let [w, x, y, z] = (start.angles.attitude().inverse() * attitude).components();
            let [x, y, z] = start.system.about_principal_axes([x, y, z]);
            let turn = Attitude::from_components(flight.turn_in_body([w, x, y, z]));
            launched * turn.map_err(|_| flight.not_finite())?
        }
    };
    let state = State { attitude, rate: flight.rate_at([end[3], end[4], end[5]]) };
    Ok((Landing::new(state, work), start.system.kinematics.passes))
}

/// The angles at launch, and their equations.
struct Start {
    angles: EulerAngles,
    system: RigidAngles,
}

impl Start {
    /// Angles of a principal axis from the angular momentum.
    fn along_momentum(toss: &Toss, flight: &Flight) -> Self {
        let [i1, i2, i3] = toss.body.principal_moments();
        let (i1, i2) = (i1 / i3, i2 / i3);
        let couplings = toss.body.rigid().couplings();
        let [a, b, c] = couplings.map(|coupling| coupling.abs().sqrt());
        let [first, second, third] = flight.rate.into();
        // √P3 and √P1, but for a common factor.
        let (near_first, near_third) = (i1 * (b * first).hypot(a * second), (c * second).hypot(b * third));
        let order = if near_third >= near_first { [1, 2, 0] } else { [0, 1, 2] };
        let momentum = order.map(|axis: usize| [i1 * first, i2 * second, third][axis]);
        let [x, y, z] = momentum;
        // A rod that spins about itself has no momentum, and any frame does.
        let beta = if momentum == [0.0; 3] { FRAC_PI_2 } else { x.hypot(y).atan2(z) };
        let angles = EulerAngles { alpha: 0.0, beta, gamma: x.atan2(y) };
        let axes = order.map(|axis| [0, 1, 2].map(|column| if column == axis { 1.0 } else { 0.0 }));
        Self { angles, system: RigidAngles::new(axes, couplings, 0.5 * third_of(&axes, flight)) }
    }

    /// Angles of n from the vertical. Fails with [`SolveError::Singular`] if n is along the vertical, and so is ω for a
    /// moment.
    fn vertical(toss: &Toss, flight: &Flight) -> Result<Self, SolveError> {
        let (launched, couplings) = (toss.launch.attitude(), toss.body.rigid().couplings());
        let angles = EulerAngles::principal(&launched);
        let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|axis| flight.in_body(axis));
        let axes = [0, 1, 2].map(|row: usize| columns.map(|column| column[row]));
        let system = |limit_of_u| RigidAngles::new(axes, couplings, limit_of_u);
        let Some(pole) = Pole::of(&launched) else { return Ok(Self { angles, system: system(0.0) }) };
        let rate = flight.in_units(&toss.launch.rate());
        let change = flight.in_body(principal_acceleration(couplings, flight.rate.into()));
        let (across, change_across) = (rate.x.hypot(rate.y), change.x.hypot(change.y));
        if change_across > FASTEST_START * across {
            return Err(SolveError::Singular { point: Singularity::NormalAlongAxis, time: 0.0 });
        }
        let (gamma, limit_of_u) = regular_start(&rate, &change, across);
        Ok(Self { angles: pole.angles(&angles, gamma), system: system(limit_of_u) })
    }
}

/// γ and u of the regular solution at sin β = 0, for the `rate` ω and its `change` ω', and for ω `across` the normal.
fn regular_start(rate: &Vector3<f64>, change: &Vector3<f64>, across: f64) -> (f64, f64) {
    if across == 0.0 {
        // n stays where it is, and α' + γ' = ωz is all that counts.
        return (0.0, 0.5 * rate.z);
    }
    let turning = (rate.x / across * change.y - rate.y / across * change.x) / across;
    ((-rate.y).atan2(rate.x), 0.5 * (rate.z + turning))
}

/// The rate at launch about the third of these axes.
fn third_of(axes: &[[f64; 3]; 3], flight: &Flight) -> f64 {
    Vector3::from(axes[2]).dot(&flight.rate)
}

/// The system over the state (α, β, γ, ω1, ω2, ω3), with the rates about the principal axes.
struct RigidAngles {
    /// The axes x, y, z of the angles in the body, by their components along the principal axes.
    axes: [[f64; 3]; 3],
    /// The couplings of Euler's equations.
    couplings: [f64; 3],
    kinematics: Kinematics,
}

impl RigidAngles {
    fn new(axes: [[f64; 3]; 3], couplings: [f64; 3], limit_of_u: f64) -> Self {
        Self { axes, couplings, kinematics: Kinematics::new(limit_of_u) }
    }

    /// The components along the principal axes of a vector along the axes of the angles.
    fn about_principal_axes(&self, vector: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|column: usize| (0..3).map(|row| self.axes[row][column] * vector[row]).sum())
    }
}

impl OdeSystem<6> for RigidAngles {
    const LARGEST_TURN: f64 = 2.0;

    fn derivative(&self, state: &SVector<f64, 6>) -> SVector<f64, 6> {
        let &[_, beta, gamma, first, second, third] = &state.data.0[0];
        let rates = self.axes.map(|[a, b, c]| a * first + b * second + c * third);
        let [alpha_dot, beta_dot, gamma_dot] = self.kinematics.rates(beta, gamma, rates);
        let [first, second, third] = principal_acceleration(self.couplings, [first, second, third]);
        SVector::from([alpha_dot, beta_dot, gamma_dot, first, second, third])
    }

    fn singularity(&self, before: &SVector<f64, 6>, after: &SVector<f64, 6>) -> Option<Singularity> {
        self.kinematics.singularity(before, after)
    }
}

#[cfg(test)]
mod tests;
