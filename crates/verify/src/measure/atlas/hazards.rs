//! A hazard is a place in the space of tosses where some method fails, given as a series of tosses that come nearer and
//! nearer to it. Apart from its hazard each toss is regular, so a failure has one cause: a flight that tests α' = 0,
//! for example, keeps away from sin β = 0 and cos β = 0.
//!
//! α, β and γ are the Euler angles (precession, nutation, spin), α' the rate of α, n the coin's normal, θ its angle to
//! the vertical, ω the body rate and Ω = √(ωx² + ωy²). Hazards F9 to F12 are those of bodies that are no coins, with the
//! moments I1 ≤ I2 ≤ I3; each of their flights is so short that the error estimates of all integrators say something.

use std::f64::consts::FRAC_PI_2;

use toss::{Body, Coin, CoinMotion, InputError, Launch, TimeOfFlight, Toss};

use crate::measure::tosses::tossed;

/// A place where some method fails.
pub struct Hazard {
    /// Its id, `F1` to `F12`.
    pub id: &'static str,
    /// What happens there, in words.
    pub name: &'static str,
    /// What the distance is and its unit.
    pub distance: &'static str,
    /// The toss at a distance; 0 is the place of the failure itself.
    pub toss: fn(f64) -> Result<Toss, InputError>,
    /// The distances, from far to near.
    pub distances: &'static [f64],
}

impl Hazard {
    /// Whether its tosses are those of coins, which every solver solves.
    pub fn is_of_coins(&self) -> bool {
        self.distances.first().is_some_and(|distance| (self.toss)(*distance).is_ok_and(|toss| toss.coin().is_some()))
    }
}

const DECADES: &[f64] =
    &[1e0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, 1e-16, 0.0];

/// All hazards.
pub const HAZARDS: &[Hazard] = &[
    Hazard {
        id: "F1",
        name: "sin β = 0: n along the vertical",
        distance: "tilt at launch (rad)",
        toss: |distance| coin([9.0, 4.0, 3.0], distance, 1.5),
        distances: DECADES,
    },
    Hazard {
        id: "F2",
        name: "α' = 0: the precession turns back",
        distance: "ωy/ωx at launch, which is α' sin β/ωx",
        toss: |distance| coin([0.3, 0.3 * distance, 5.0], 1.0, 5.0),
        distances: DECADES,
    },
    Hazard {
        id: "F3",
        name: "cos β = 0: launch on edge",
        distance: "angle at launch (rad)",
        toss: |distance| coin([2.0, 5.0, 1.0], FRAC_PI_2 - distance, 0.9),
        distances: DECADES,
    },
    Hazard {
        id: "F4",
        name: "ωz = 0: no spin",
        distance: "ωz/Ω at launch",
        toss: |distance| coin([3.0, 4.0, 5.0 * distance], 0.0, 0.5),
        distances: DECADES,
    },
    Hazard {
        id: "F5",
        name: "Ω = 0: pure spin",
        distance: "Ω/ωz at launch",
        toss: |distance| coin([3.0 * distance, 4.0 * distance, 5.0], 1.0, 2.0),
        distances: DECADES,
    },
    Hazard {
        id: "F6",
        name: "a large phase",
        distance: "1/phase at landing (1/rad)",
        toss: |distance| {
            let rate = motion(&regular(1.0)?).precession_rate();
            regular(if distance == 0.0 { 1e300 } else { 1.0 / (distance * rate) })
        },
        // 1e-5 is left out, because the longest flight of F8 is nearly it, and those between 1e-6 and 1e-16, where an
        // integrator only reaches its largest number of steps. Each takes seconds.
        distances: &[1e0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-16, 0.0],
    },
    Hazard {
        id: "F7",
        name: "cos θ = 0: landing on edge",
        distance: "time left to the flip, in times of flight",
        toss: |distance| {
            let falling = |time| coin([2.0, 5.0, 1.0], 1.0, time);
            let flip = motion(&falling(0.0)?).first_flip().unwrap_or(f64::NAN);
            falling(flip / (1.0 + distance))
        },
        distances: DECADES,
    },
    Hazard {
        id: "F8",
        name: "a long flight",
        distance: "1 s/time of flight",
        toss: |distance| regular(1.0 / distance),
        distances: &[1e0, 1e-1, 1e-2, 1e-3, 1e-4],
    },
    Hazard {
        id: "F9",
        name: "separatrix: from both sides, by turns",
        distance: "relative distance of ω1 from it",
        toss: |distance| body([1.0, 2.0, 2.25], [0.75 * (1.0 + side(distance) * distance), 1.0, 1.0], 10.0),
        distances: DECADES,
    },
    Hazard {
        id: "F10",
        name: "middle axis: a turn next to it",
        distance: "ω1/ω2 and ω3/ω2 at launch",
        toss: |distance| body([1.0, 2.0, 2.25], [2.0 * distance, 2.0, -2.0 * distance], 6.0),
        distances: DECADES,
    },
    Hazard {
        id: "F11",
        name: "nearly round: symmetric or spherical but for a little, by turns",
        distance: "difference of the moments, relative to them",
        toss: |distance| {
            let third = if side(distance) > 0.0 { 1.9 } else { 1.0 - 0.5 * distance };
            body([1.0, 1.0 + distance, third], [3.0, -2.0, 4.0], 2.0)
        },
        distances: &[1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13, 1e-14, 1e-15],
    },
    Hazard {
        id: "F12",
        name: "plate to rod: I3 = I1 + I2, and I1 = 0 at last",
        distance: "I1/I2",
        toss: |distance| body([0.75 * distance, 1.0, 1.0 + 0.75 * distance], [3.0, -2.0, 1.0], 2.0),
        distances: DECADES,
    },
];

/// Hazards and distances at which all contestants together take longer than at all others, and whose neighbours have the
/// same worst answers.
pub(super) const SLOW: [(&str, f64); 3] = [("F6", 1e-4), ("F6", 1e-6), ("F8", 1e-3)];

/// 1 or -1 by turns, from decade to decade.
fn side(distance: f64) -> f64 {
    if distance == 0.0 || (distance.log10().round() / 2.0).fract() == 0.0 { 1.0 } else { -1.0 }
}

/// A body with these moments (kg m²) at `rate` (rad/s) from a tilt of 0.5 rad, for `time` (s).
fn body(moments: [f64; 3], rate: [f64; 3], time: f64) -> Result<Toss, InputError> {
    let launch = Launch::new(rate, TimeOfFlight::Given(time))?.with_tilt(0.5)?;
    Ok(Toss { body: Body::from_moments(moments)?, launch })
}

/// The paper's coin at `rate` (rad/s) from `tilt` (rad), for `time` (s).
fn coin(rate: [f64; 3], tilt: f64, time: f64) -> Result<Toss, InputError> {
    tossed(Coin::PAPER, rate, TimeOfFlight::Given(time), tilt)
}

/// The motion of a coin.
fn motion(toss: &Toss) -> CoinMotion {
    CoinMotion::new(&toss.coin().expect("a coin"))
}

/// A flight for `time` (s) on which β stays between 29° and 74°, far from every singular place.
fn regular(time: f64) -> Result<Toss, InputError> {
    coin([0.0, 4.0, 6.5], 0.5, time)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// n moves on a cone about S. It passes the vertical where the cone's angle is that of S to the vertical; α'
    /// vanishes on the way if the cone does not enclose the vertical, and cos β if the two angles add up to more than
    /// 90°.
    #[test]
    fn each_hazard_has_a_single_cause_of_failure() {
        for hazard in HAZARDS {
            for &distance in hazard.distances {
                let Some(toss) = (hazard.toss)(distance).unwrap().coin() else {
                    assert!(!hazard.is_of_coins());
                    continue;
                };
                let motion = CoinMotion::new(&toss);
                let (cone, axis) = (motion.cone_angle(), motion.momentum_tilt());
                let passes_the_vertical = (cone - axis).abs() < 0.2;
                let (stops, levels) = (cone < axis, cone + axis > FRAC_PI_2);
                match hazard.id {
                    "F1" => assert!((cone - axis).abs() <= distance + 1e-15),
                    "F2" => assert!(!passes_the_vertical && stops && !levels),
                    "F3" | "F7" => assert!(!passes_the_vertical && !stops && levels),
                    // It starts horizontal, but lands before it is horizontal again.
                    "F4" => assert!(motion.phase(toss.launch.flight_time()).unwrap() < 3.0),
                    "F5" => assert!(cone <= 2.0 * distance),
                    _ => assert!(!passes_the_vertical && !stops && !levels),
                }
            }
        }
    }
}
