//! Changes of the speed and of gravity that change the time of flight by a given amount.
//!
//! Flips are searched along the time of flight, and a throw has another speed or another gravity for each time:
//!
//! ```text
//! v0 = ½ g T - h/T            Δv0 = ΔT (½ g + h/(T T'))                            T' = T + ΔT
//! g  = 2 (v0 T + h)/T²        Δg  = -2 ΔT/(T T') (v0 + h (1/T + 1/T'))
//! ```
//!
//! Both are one to one for the flights that a throw can have, down to the shortest of them.

use dynamics::TimeOfFlight;
use numerics::DoubleDouble;
use numerics::double_double::two_sum;

/// The changes of speed (m/s) and of gravity (m/s²) that change the time of flight by `change` (s), where they exist.
pub(crate) fn speed_and_gravity(flight: TimeOfFlight, change: f64) -> [Option<f64>; 2] {
    let (speed, gravity, drop) = match flight {
        TimeOfFlight::Given(_) => return [None; 2],
        TimeOfFlight::Ballistic { speed, gravity } => (speed, gravity, 0.0),
        TimeOfFlight::BallisticTo { speed, gravity, drop } => (speed, gravity, drop),
    };
    let [time, rest] = flight.compensated();
    let now = two_sum(time, rest);
    let then = now + change.into();
    // No speed is lower than 0 or too low to get there, and no gravity so strong that the coin does not get there.
    let least_by_speed = (2.0 * drop.abs() / gravity).sqrt();
    let least_by_gravity = (2.0 * -drop / speed).max(0.0);
    let by_speed = change * sum(0.5 * gravity, drop, |fall| fall / now / then);
    let by_gravity = -2.0 * (change / now.hi()) / then.hi() * sum(speed, drop, |fall| fall / now + fall / then);
    let exists = |value: f64, exists: bool| Some(value).filter(|value| exists && value.is_finite());
    [exists(by_speed, then.hi() >= least_by_speed), exists(by_gravity, then.hi() >= least_by_gravity)]
}

/// `constant` and what `fall` makes of the `drop`, in double-double: caught above the launch, they nearly cancel.
fn sum(constant: f64, drop: f64, fall: impl Fn(DoubleDouble) -> DoubleDouble) -> f64 {
    if drop == 0.0 { constant } else { (fall(drop.into()) + constant.into()).hi() }
}
