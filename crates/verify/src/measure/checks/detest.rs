//! This check integrates DETEST B5, the published test problem of an asymmetric rigid body, by each Runge-Kutta scheme.
//! No solver of a coin contains these equations, so this check tests the stepping alone, without any kinematics.

use dynamics::integrate::{OdeSystem, integrate};
use nalgebra::SVector;
use toss::{Scheme, Stepping};

use crate::measure::check::{Basis, Check, Judges};
use crate::measure::context::Context;
use crate::measure::measurement::Measurement;

pub(super) const STATE: Check = Check {
    id: "detest-b5",
    claim: "Each Runge-Kutta scheme solves DETEST B5, an asymmetric rigid body: at t = 20 no component differs from \
            the reference, the Jacobi functions sn, cn and dn of (20 | 0.51), by more than the bound.",
    basis: Basis::ClosedForm,
    judges: Judges::Library,
    ceiling: 1e-6,
    unit: "1",
    measure,
};

struct AsymmetricBody;

impl OdeSystem<3> for AsymmetricBody {
    fn derivative(&self, y: &SVector<f64, 3>) -> SVector<f64, 3> {
        SVector::from([y[1] * y[2], -y[0] * y[2], -0.51 * y[0] * y[1]])
    }
}

fn measure(context: &Context) -> anyhow::Result<Vec<Measurement>> {
    let (time, exact) = context.data.detest_b5;
    let steppings = [
        Stepping::adaptive(Scheme::DOP853, 1e-12)?,
        Stepping::adaptive(Scheme::DOPRI5, 1e-12)?,
        Stepping::fixed(Scheme::RK4, 1e-3)?,
    ];
    let measure = |stepping: &Stepping| {
        let (end, _) = integrate(&AsymmetricBody, SVector::from([0.0, 1.0, 1.0]), time, 1.0, stepping)?;
        let error = (end - SVector::from(exact)).amax();
        let input = format!("y(0) = (0, 1, 1), t = {time}, {:?}", stepping.control());
        Ok(Measurement::figure(STATE.id, stepping.scheme().name(), error, 1, input))
    };
    steppings.iter().map(measure).collect()
}
