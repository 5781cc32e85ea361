//! [`RigidFlight`], the toss of any rigid body in dimensionless form for the integrators. It is a [`Flight`] whose rates
//! are those about the principal axes, where Euler's equations are three products.
//!
//! Integrators work in principal axes, and turn back at the end. The axes are known in twice the precision of f64, so
//! that each turn costs one rounding. In the axes of the body frame (BF) each evaluation of Euler's equations would turn
//! forth and back with rounded axes, which is slower, and moves a body whose tensor is not quite the one that was given.
//! Of a body that was given by its moments, the turn exchanges components and signs, without any rounding.

use nalgebra::Vector3;
use numerics::DoubleDouble;

use crate::body::PrincipalAxes;
use crate::error::SolveError;
use crate::flight::Flight;
use crate::phase::turned_at_most;
use crate::toss::Toss;

/// The flight of a rigid body about its principal axes, with its rates divided by σ, a power of two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidFlight {
    flight: Flight,
    axes: PrincipalAxes<DoubleDouble>,
    /// ω at launch (BF, rad/s).
    launched: Vector3<f64>,
    /// The rates about the principal axes at launch, in units of σ.
    pub rates: [f64; 3],
    /// The [couplings](crate::RigidBody::couplings) of Euler's equations.
    pub couplings: [f64; 3],
}

impl RigidFlight {
    /// The dimensionless flight of `toss`.
    ///
    /// # Errors
    /// [`SolveError::PhaseTooLarge`] if the body may turn by more than 2^53 rad.
    pub fn new(toss: &Toss) -> Result<Self, SolveError> {
        let body = toss.body.rigid();
        let flight = Flight::turning_by(&toss.launch, |rate, time| turned_at_most(&body, rate.norm(), time))?;
        let axes = *body.principal();
        let rates = axes.rates(&flight.rate);
        Ok(Self { flight, axes, launched: toss.launch.rate(), rates, couplings: body.couplings() })
    }

    /// The flight's times and tolerances.
    pub fn timing(&self) -> &Flight {
        &self.flight
    }

    /// The quaternion (w, x, y, z) of a turn about the principal axes, in BF.
    pub fn turn_in_body(&self, [w, x, y, z]: [f64; 4]) -> [f64; 4] {
        let vector = self.axes.from_principal([x, y, z]);
        [w, vector.x, vector.y, vector.z]
    }

    /// The vector (BF) with these components along the principal axes.
    pub fn in_body(&self, vector: [f64; 3]) -> Vector3<f64> {
        self.axes.from_principal(vector)
    }

    /// The body rate (BF, rad/s) whose components about the principal axes are `rates` in units of σ. Rates that are
    /// still those of the launch keep all their digits, also where a component underflows in units of σ.
    pub fn rate_at(&self, rates: [f64; 3]) -> Vector3<f64> {
        if rates == self.rates {
            return self.launched;
        }
        self.flight.in_rad_per_s(&self.in_body(rates))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Body;
    use crate::launch::Launch;
    use crate::time_of_flight::TimeOfFlight;

    fn flight(body: Body, rate: [f64; 3]) -> RigidFlight {
        let launch = Launch::new(rate, TimeOfFlight::Given(0.5)).unwrap();
        RigidFlight::new(&Toss { body, launch }).unwrap()
    }

    #[test]
    fn moments_in_any_order_exchange_rates_without_rounding() {
        for moments in [[1.0, 2.0, 2.5], [2.0, 2.5, 1.0], [2.5, 1.0, 2.0], [2.0, 1.0, 2.5], [1.0, 2.5, 2.0]] {
            let flight = flight(Body::from_moments(moments).unwrap(), [60.1, -8.3, 0.7]);
            let sizes = flight.rates.map(|rate| rate.abs() * 32.0);
            let mut order = [0, 1, 2];
            order.sort_by(|a: &usize, b: &usize| moments[*a].total_cmp(&moments[*b]));
            assert_eq!(sizes, order.map(|axis| [60.1, 8.3, 0.7][axis]));
            assert_eq!(flight.in_body(flight.rates), flight.timing().rate);
            assert_eq!(flight.rate_at([0.0; 3]), Vector3::zeros());
            let along = flight.in_body([0.1, 0.2, 0.3]);
            assert_eq!(flight.turn_in_body([0.9, 0.1, 0.2, 0.3]), [0.9, along.x, along.y, along.z]);
        }
    }

    #[test]
    fn the_acceleration_about_principal_axes_is_that_of_the_body() {
        let tensor = [[2.0, 0.3, -0.1], [0.3, 2.2, 0.25], [-0.1, 0.25, 1.4]];
        let body = Body::from_tensor(tensor).unwrap();
        let flight = flight(body, [1.0, -0.5, 1.25]);
        let found = flight.in_body(crate::body::principal_acceleration(flight.couplings, flight.rates));
        let rate = Vector3::new(1.0, -0.5, 1.25);
        let torque = body.angular_momentum(&rate).cross(&rate);
        assert!((body.angular_momentum(&found) - torque).norm() < 1e-14, "{found:?}");
    }

    #[test]
    fn rates_of_the_launch_are_returned_as_they_were_given() {
        for rate in [[1e15, 2.0, 1e-300], [1e-300, 2e-310, 5e-324], [0.0; 3]] {
            let flight = flight(Body::from_moments([1.0, 2.0, 2.5]).unwrap(), rate);
            assert_eq!(flight.rate_at(flight.rates), Vector3::from(rate));
        }
    }
}
